//! Packed maps: which channel of an image holds which map, taking maps out and putting them in. Values are moved, never
//! scaled: a code that goes in is the code that comes out. Does not resize.

use rayon::prelude::*;

use crate::image::{Channels, Image, Texels};
use crate::mip::{ColorSpace, MapKind};

/// What a texture map says of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Map {
    /// Base colour, sRGB.
    Albedo,
    /// Perceptual roughness, 0 smooth.
    Roughness,
    /// 1 where the surface is metal.
    Metalness,
    /// Share of the environment that reaches the point, 1 all of it.
    Occlusion,
    /// Emitted colour, sRGB.
    Emission,
    /// 1 where the surface is opaque.
    Opacity,
    /// Height along the normal, white is high.
    Height,
    /// Tangent-space normal, see [`crate::normal`].
    Normal,
}

impl Map {
    /// How its files are coded.
    pub fn color_space(self) -> ColorSpace {
        match self {
            Self::Albedo | Self::Emission => ColorSpace::Srgb,
            _ => ColorSpace::Linear,
        }
    }

    /// How its texels are averaged.
    pub fn kind(self) -> MapKind {
        match self {
            Self::Albedo | Self::Emission => MapKind::Color,
            Self::Normal => MapKind::Normal,
            _ => MapKind::Data,
        }
    }

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Albedo => "albedo",
            Self::Roughness => "roughness",
            Self::Metalness => "metalness",
            Self::Occlusion => "occlusion",
            Self::Emission => "emission",
            Self::Opacity => "opacity",
            Self::Height => "height",
            Self::Normal => "normal",
        }
    }

    /// What stands in a channel whose map is not given: the value that changes nothing.
    fn neutral(self) -> f32 {
        match self {
            Self::Metalness | Self::Height | Self::Emission => 0.0,
            _ => 1.0,
        }
    }
}

/// The map in one channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// Which.
    pub map: Map,
    /// Whether the channel holds one minus it: smoothness for roughness.
    pub inverted: bool,
}

/// Which map stands in red, green, blue and alpha. A channel of no map is ignored when maps are taken out; when they are
/// put in it is 0, alpha 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name on a command line.
    pub name: &'static str,
    /// Who uses it.
    pub help: &'static str,
    /// Red, green, blue, alpha.
    pub channels: [Option<Slot>; 4],
}

const fn slot(map: Map) -> Option<Slot> {
    Some(Slot { map, inverted: false })
}

const SMOOTHNESS: Option<Slot> = Some(Slot { map: Map::Roughness, inverted: true });

/// The layouts known by name.
pub const LAYOUTS: [Layout; 6] = [
    Layout {
        name: "orm",
        help: "occlusion, roughness, metalness: Unreal, and glTF where one image is both of its textures",
        channels: [slot(Map::Occlusion), slot(Map::Roughness), slot(Map::Metalness), None],
    },
    Layout {
        name: "gltf_metallic_roughness",
        help: "glTF 2.0 metallicRoughnessTexture: roughness in green, metalness in blue",
        channels: [None, slot(Map::Roughness), slot(Map::Metalness), None],
    },
    Layout {
        name: "gltf_occlusion",
        help: "glTF 2.0 occlusionTexture: red",
        channels: [slot(Map::Occlusion), None, None, None],
    },
    Layout {
        name: "rma",
        help: "roughness, metalness, occlusion",
        channels: [slot(Map::Roughness), slot(Map::Metalness), slot(Map::Occlusion), None],
    },
    Layout {
        name: "unity_metallic",
        help: "Unity's metallic map (built-in, URP): metalness in red, smoothness in alpha",
        channels: [slot(Map::Metalness), None, None, SMOOTHNESS],
    },
    Layout {
        name: "unity_mask",
        help: "Unity's mask map (HDRP): metalness, occlusion, detail mask (not read), smoothness",
        channels: [slot(Map::Metalness), slot(Map::Occlusion), None, SMOOTHNESS],
    },
];

/// The layout of this name.
pub fn layout(name: &str) -> Option<&'static Layout> {
    LAYOUTS.iter().find(|layout| layout.name == name)
}

/// Why maps were not packed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PackError {
    /// No map was given.
    #[error("there is nothing to pack into {layout}; give at least one of its maps")]
    Empty {
        /// The layout's name.
        layout: &'static str,
    },
    /// The layout has no channel for a map that was given.
    #[error("{layout} has no channel for {map}; leave it out or choose another layout")]
    NoChannel {
        /// The layout's name.
        layout: &'static str,
        /// The map.
        map: &'static str,
    },
    /// Two maps differ in size.
    #[error("the {map} map has {} x {} texels and another has {} x {}; resize one of them", size[0], size[1], other[0], other[1])]
    Size {
        /// The map.
        map: &'static str,
        /// Its size.
        size: [u32; 2],
        /// The size of the first map.
        other: [u32; 2],
    },
}

/// The maps in one image: the red channel of each, at the depth of the deepest. 8-bit codes in a 16-bit image are
/// multiplied by 257 and codes in a float image divided by the largest, which is exact. A map that is not given has the
/// value that changes nothing: 1 for occlusion, roughness, opacity, 0 for metalness and height.
///
/// # Errors
/// When no map is given, one has no channel, or sizes differ.
pub fn pack(layout: &Layout, maps: &[(Map, &Image)]) -> Result<Image, PackError> {
    let &[(_, first), ..] = maps else { return Err(PackError::Empty { layout: layout.name }) };
    let size = |image: &Image| [image.width(), image.height()];
    for (map, image) in maps {
        if !layout.channels.iter().flatten().any(|slot| slot.map == *map) {
            return Err(PackError::NoChannel { layout: layout.name, map: map.name() });
        }
        if size(image) != size(first) {
            return Err(PackError::Size { map: map.name(), size: size(image), other: size(first) });
        }
    }
    let image_of = |slot: &Option<Slot>| slot.and_then(|s| maps.iter().find(|(map, _)| *map == s.map)).map(|&(_, i)| i);
    let sources = [0, 1, 2, 3].map(|k| (layout.channels[k], image_of(&layout.channels[k])));
    let constant = |k: usize| match layout.channels[k] {
        Some(Slot { map, inverted }) => {
            if inverted {
                1.0 - map.neutral()
            } else {
                map.neutral()
            }
        }
        None if k == 3 => 1.0,
        None => 0.0,
    };
    let count = first.texels().len();
    let any = |is: fn(&Texels) -> bool| maps.iter().any(|(_, image)| is(image.texels()));
    let texels = if any(|t| matches!(t, Texels::F32(_))) {
        let code = |image: &Image, i: usize| match image.texels() {
            Texels::U8(t) => f32::from(t[i][0]) / 255.0,
            Texels::U16(t) => f32::from(t[i][0]) / 65_535.0,
            Texels::F32(t) => t[i][0],
        };
        Texels::F32(gathered(count, sources, code, |c| 1.0 - c, constant))
    } else if any(|t| matches!(t, Texels::U16(_))) {
        let code = |image: &Image, i: usize| match image.texels() {
            Texels::U8(t) => u16::from(t[i][0]) * 257,
            Texels::U16(t) => t[i][0],
            Texels::F32(_) => 0,
        };
        Texels::U16(gathered(count, sources, code, |c| 65_535 - c, |k| constant(k) as u16 * 65_535))
    } else {
        let code = |image: &Image, i: usize| match image.texels() {
            Texels::U8(t) => t[i][0],
            _ => 0,
        };
        Texels::U8(gathered(count, sources, code, |c| 255 - c, |k| constant(k) as u8 * 255))
    };
    let channels = if layout.channels[3].is_some() { Channels::Rgba } else { Channels::Rgb };
    Ok(Image::from_parts(first.width(), first.height(), channels, texels))
}

/// Four channels from where they stand, or constants.
fn gathered<T: Copy + Send + Sync>(
    count: usize,
    sources: [(Option<Slot>, Option<&Image>); 4],
    code: impl Fn(&Image, usize) -> T + Sync,
    one_minus: impl Fn(T) -> T + Sync,
    constant: impl Fn(usize) -> T + Sync,
) -> Vec<[T; 4]> {
    let channel = |i: usize, k: usize| match sources[k] {
        (Some(slot), Some(image)) if slot.inverted => one_minus(code(image, i)),
        (_, Some(image)) => code(image, i),
        _ => constant(k),
    };
    (0..count).into_par_iter().with_min_len(1 << 14).map(|i| [0, 1, 2, 3].map(|k| channel(i, k))).collect()
}

/// The maps of a packed image, grey and of its depth, in the order of its channels. A channel that the file has not is
/// passed over (alpha of a file without), as is blue and green of a grey file where red is not meant.
pub fn unpack(layout: &Layout, image: &Image) -> Vec<(Map, Image)> {
    let has = |k: usize| if k == 3 { image.channels().has_alpha() } else { k == 0 || image.channels().has_color() };
    let slots = layout.channels.iter().enumerate().filter(|&(k, _)| has(k));
    slots.filter_map(|(k, slot)| slot.map(|slot| (slot.map, channel(image, k, slot.inverted)))).collect()
}

/// One channel (0 red .. 3 alpha) as a grey image of the same depth; `inverted` gives one minus it.
///
/// # Panics
/// For a channel past 3.
pub fn channel(image: &Image, channel: usize, inverted: bool) -> Image {
    fn grey<T: Copy + Send + Sync>(texels: &[[T; 4]], opaque: T, code: impl Fn([T; 4]) -> T + Sync) -> Vec<[T; 4]> {
        let texel = |texel: &[T; 4]| {
            let c = code(*texel);
            [c, c, c, opaque]
        };
        texels.par_iter().with_min_len(1 << 14).map(texel).collect()
    }
    let texels = match image.texels() {
        Texels::U8(t) => Texels::U8(grey(t, 255, |t| if inverted { 255 - t[channel] } else { t[channel] })),
        Texels::U16(t) => Texels::U16(grey(t, 65_535, |t| if inverted { 65_535 - t[channel] } else { t[channel] })),
        Texels::F32(t) => Texels::F32(grey(t, 1.0, |t| if inverted { 1.0 - t[channel] } else { t[channel] })),
    };
    Image::from_parts(image.width(), image.height(), Channels::Grey, texels)
}
