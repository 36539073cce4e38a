//! Packing: every layout gives back the codes that went in, at every depth.

use halfvector_maps::pack::{LAYOUTS, channel, layout};
use halfvector_maps::{Channels, ColorSpace, Image, Map, MapKind, PackError, Texels, pack, unpack};

/// A grey map of all codes times an odd factor, so that maps differ.
fn grey8(factor: u32) -> Image {
    let texels = (0..256_u32).map(|i| (i * factor) as u8).map(|c| [c, c, c, 255]).collect();
    Image::new(16, 16, Channels::Grey, Texels::U8(texels)).unwrap()
}

fn grey16(factor: u32) -> Image {
    let texels = (0..65_536_u32).map(|i| (i * factor) as u16).map(|c| [c, c, c, 65_535]).collect();
    Image::new(256, 256, Channels::Grey, Texels::U16(texels)).unwrap()
}

/// Every code of 8 and 16 bits through every layout, inverted channels too.
#[test]
fn every_layout_is_exact() {
    for layout in &LAYOUTS {
        for map in [grey8 as fn(u32) -> Image, grey16] {
            let slots: Vec<Map> = layout.channels.iter().flatten().map(|slot| slot.map).collect();
            let maps: Vec<(Map, Image)> =
                slots.iter().zip([3, 5, 7, 11]).map(|(&slot, factor)| (slot, map(factor))).collect();
            let given: Vec<(Map, &Image)> = maps.iter().map(|(slot, image)| (*slot, image)).collect();
            assert_eq!(unpack(layout, &pack(layout, &given).unwrap()), maps, "{}", layout.name);
        }
    }
}

/// The channels are where the formats say: Unity's smoothness is in alpha, the other way round.
#[test]
fn channels_are_where_they_belong() {
    let one = |code: u8| Image::new(1, 1, Channels::Grey, Texels::U8(vec![[code, code, code, 255]])).unwrap();
    let (occlusion, roughness, metalness) = (one(10), one(20), one(30));
    let all = [(Map::Metalness, &metalness), (Map::Roughness, &roughness), (Map::Occlusion, &occlusion)];
    for (name, maps, want) in [
        ("orm", &all[..], [10, 20, 30, 255]),
        ("rma", &all[..], [20, 30, 10, 255]),
        ("unity_mask", &all[..], [30, 10, 0, 235]),
        ("gltf_metallic_roughness", &all[..2], [0, 20, 30, 255]),
        ("unity_metallic", &all[..2], [30, 0, 0, 235]),
        ("gltf_occlusion", &all[2..], [10, 0, 0, 255]),
        // What is not given changes nothing: no occlusion, rough, no metal.
        ("orm", &all[1..2], [255, 20, 0, 255]),
        ("unity_mask", &all[..1], [30, 255, 0, 0]),
    ] {
        let packed = pack(layout(name).unwrap(), maps).unwrap();
        assert_eq!(packed.texels(), &Texels::U8(vec![want]), "{name}");
    }
    let grey = unpack(layout("orm").unwrap(), &occlusion);
    assert_eq!(grey, [(Map::Occlusion, occlusion.clone())], "a grey file has red only");
    assert!(layout("unknown").is_none());
}

/// Depths mix upwards, exactly; floats are inverted as floats.
#[test]
fn depths_mix() {
    let (narrow, wide) = (grey8(1), Image::new(16, 16, Channels::Grey, Texels::U16(vec![[77; 4]; 256])).unwrap());
    let packed = pack(layout("orm").unwrap(), &[(Map::Roughness, &narrow), (Map::Metalness, &wide)]).unwrap();
    let Texels::U16(texels) = packed.texels() else { panic!("16 bits expected") };
    assert!((0..256).all(|i| texels[i] == [65_535, i as u16 * 257, 77, 65_535]));
    let float = Image::new(1, 1, Channels::Grey, Texels::F32(vec![[0.25, 0.25, 0.25, 1.0]])).unwrap();
    let packed = pack(layout("unity_metallic").unwrap(), &[(Map::Roughness, &float)]).unwrap();
    assert_eq!(packed.texels(), &Texels::F32(vec![[0.0, 0.0, 0.0, 0.75]]));
    assert_eq!(channel(&packed, 3, true).texels(), &Texels::F32(vec![[0.25, 0.25, 0.25, 1.0]]));
}

#[test]
fn wrong_maps_are_named() {
    let (small, large) = (grey8(1), grey16(1));
    let orm = layout("orm").unwrap();
    assert_eq!(pack(orm, &[]), Err(PackError::Empty { layout: "orm" }));
    assert!(pack(orm, &[(Map::Height, &small)]).unwrap_err().to_string().contains("no channel for height"));
    let error = pack(orm, &[(Map::Roughness, &small), (Map::Metalness, &large)]).unwrap_err();
    assert!(error.to_string().contains("metalness map has 256 x 256 texels and another has 16 x 16"), "{error}");
}

/// Colours are sRGB and weighted by alpha, everything else is data or normals.
#[test]
fn maps_know_their_coding() {
    for map in [Map::Albedo, Map::Emission] {
        assert_eq!((map.color_space(), map.kind()), (ColorSpace::Srgb, MapKind::Color));
    }
    for map in [Map::Roughness, Map::Metalness, Map::Occlusion, Map::Opacity, Map::Height] {
        assert_eq!((map.color_space(), map.kind()), (ColorSpace::Linear, MapKind::Data), "{}", map.name());
    }
    assert_eq!((Map::Normal.color_space(), Map::Normal.kind()), (ColorSpace::Linear, MapKind::Normal));
}
