//! Surfaces mixed of surfaces.

use super::{document, environment, exported, made, material, nothing, sun};
use crate::Fold;

/// A document of the surfaces `a` and `b` with these values, mixed by `t` (a number, or the output of a node `weight`).
fn mixed(a: &str, b: &str, t: &str, nodes: &str, links: &str) -> halfvector_graph::document::Document {
    document(&format!(
        r#"{{ "halfvector": 1, "name": "Test",
            "nodes": {{ "a": {{"node": "surface/surface", "values": {{{a}}}}}, "b": {{"node": "surface/surface", "values": {{{b}}}}},
                "end": {{"node": "surface/mix", "label": "Both", "values": {{{t}}}}} {nodes} }},
            "links": [{{"from": "a.out", "to": "end.a"}}, {{"from": "b.out", "to": "end.b"}} {links}] }}"#
    ))
}

const NOISE: &str = r#", "weight": {"node": "procedural/value_noise_2d"}"#;
const BY_NOISE: &str = r#", {"from": "weight.out", "to": "end.t"}"#;

/// The lines that are no comments.
fn code(wgsl: &str) -> String {
    wgsl.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// A mixture of constants is the surface of the mixed constants: every socket, and the same text.
#[test]
fn constants_are_mixed_socket_by_socket() {
    let a = r#""base_color": [0, 0.5, 1], "metallic": 0, "perceptual_roughness": 0.25, "ior": 1.5, "specular": 1,
        "occlusion": 1, "emission": [0, 1, 2], "opacity": 1, "height": 0.25, "coat_weight": 0.5, "coat_color": [1, 0.5, 0.25],
        "coat_roughness": 0.5, "coat_ior": 1.5, "sheen_color": [0, 0.5, 0], "sheen_roughness": 0.25, "transmission_weight": 0.25,
        "anisotropy": 0.5, "anisotropy_rotation": 1, "thin_film_weight": 1, "thin_film_thickness": 0.5, "thin_film_ior": 1.5"#;
    let b = r#""base_color": [1, 0.5, 0], "metallic": 1, "perceptual_roughness": 0.75, "ior": 2.5, "specular": 0.5,
        "occlusion": 0.5, "emission": [2, 1, 0], "opacity": 0.5, "height": 0.75, "coat_weight": 1, "coat_color": [0, 0.5, 0.75],
        "coat_roughness": 0.25, "coat_ior": 2, "sheen_color": [1, 0, 0], "sheen_roughness": 0.5, "transmission_weight": 0.75,
        "anisotropy": 0.25, "anisotropy_rotation": 2, "thin_film_weight": 0.5, "thin_film_thickness": 0.25, "thin_film_ior": 2"#;
    let quarter = r#""base_color": [0.25, 0.5, 0.75], "metallic": 0.25, "perceptual_roughness": 0.375, "ior": 1.75, "specular": 0.875,
        "occlusion": 0.875, "emission": [0.5, 1, 1.5], "opacity": 0.875, "height": 0.375, "coat_weight": 0.625,
        "coat_color": [0.75, 0.5, 0.375], "coat_roughness": 0.4375, "coat_ior": 1.625, "sheen_color": [0.25, 0.375, 0],
        "sheen_roughness": 0.3125, "transmission_weight": 0.375, "anisotropy": 0.4375, "anisotropy_rotation": 1.25,
        "thin_film_weight": 0.875, "thin_film_thickness": 0.4375, "thin_film_ior": 1.625"#;
    for needs in [sun(), environment()] {
        for (t, values) in
            [(r#""t": 0.25"#, quarter), (r#""t": 0"#, a), (r#""t": 1"#, b), (r#""t": -3"#, a), (r#""t": 7"#, b)]
        {
            let (mixture, plain) =
                (exported(&mixed(a, b, t, "", ""), &needs), exported(&material(values, "", ""), &needs));
            assert_eq!(mixture.wgsl, plain.wgsl, "{t}");
        }
        let alike = exported(&mixed(a, a, "", NOISE, BY_NOISE), &needs);
        assert_eq!(alike.wgsl, exported(&material(a, "", ""), &needs).wgsl, "two that are alike need no weight");
    }
}

/// A lobe is left out where both sides lack it, and only there; the numbers of a document decide the same.
#[test]
fn a_lobe_goes_where_both_sides_lack_it() {
    let (red, gold) = (r#""base_color": [1, 0, 0]"#, r#""metallic": 1, "emission": [0, 0, 0]"#);
    for needs in [sun(), environment()] {
        for fold in [Fold::Live, Fold::Export] {
            let bare = code(&made(&mixed(red, gold, "", NOISE, BY_NOISE), &needs, fold).wgsl);
            for word in [
                "coat",
                "sheen",
                "transmission",
                "anisotropic",
                "film",
                "emission",
                "normal_from_height",
                "horizon_fade",
            ] {
                assert!(!bare.contains(word), "{word}: {bare}");
            }
            assert!(bare.contains("both_base_color = mix(") && bare.contains("let diffuse_albedo"), "{bare}");
            let layered =
                made(&mixed(&format!(r#"{red}, "coat_weight": 1"#), gold, "", NOISE, BY_NOISE), &needs, fold).wgsl;
            assert!(layered.contains("both_coat_weight = mix(") && layered.contains("coat_base("), "{layered}");
            assert!(!layered.contains("sheen"), "{layered}");
            let metals = made(&mixed(gold, gold, "", NOISE, BY_NOISE), &needs, fold).wgsl;
            assert!(!metals.contains("diffuse_eval") && !metals.contains("diffuse_environment"), "{metals}");
        }
    }
}

/// Where the weight is a number of the document, the live shader leaves out what the exported one does.
#[test]
fn a_weight_of_zero_leaves_one_side() {
    let (bare, layered) = (r#""metallic": 0"#, r#""coat_weight": 1, "sheen_color": [1, 1, 1], "metallic": 1"#);
    for (t, word) in [(0, false), (1, true)] {
        let live = made(&mixed(bare, layered, &format!(r#""t": {t}"#), "", ""), &environment(), Fold::Live);
        assert_eq!(live.wgsl.contains("coat_environment("), word, "{}", live.wgsl);
        assert!(!live.wgsl.contains("diffuse_albedo"), "{}", live.wgsl);
    }
}

/// Normals are mixed only where they differ, and are unit; a mixture of mixtures goes on.
#[test]
fn normals_and_mixtures_of_mixtures() {
    let map = r#", "map": {"node": "textures/normal_map", "values": {"color": [0.6, 0.5, 1]}}"#;
    let bent = format!(r#"{BY_NOISE}, {{"from": "map.out", "to": "b.normal"}}"#);
    let text = exported(&mixed("", "", "", &format!("{NOISE}{map}"), &bent), &environment()).wgsl;
    assert_eq!(text.matches("surface_mix_normals(").count(), 2, "a call and the function: {text}");
    assert!(text.contains("frame_from_normal(both_normal, view_dir)"), "no further normalising: {text}");
    let same = format!(r#"{bent}, {{"from": "map.out", "to": "a.normal"}}"#);
    let text = exported(&mixed("", "", "", &format!("{NOISE}{map}"), &same), &environment()).wgsl;
    assert!(!text.contains("surface_mix_normals("), "{text}");

    let third = format!(
        r#"{NOISE}, "c": {{"node": "surface/surface", "values": {{"coat_weight": 1}}}}, "last": {{"node": "surface/mix"}}"#
    );
    let links = format!(
        r#"{BY_NOISE}, {{"from": "end.out", "to": "last.a"}}, {{"from": "c.out", "to": "last.b"}}, {{"from": "weight.out", "to": "last.t"}}"#
    );
    let text = exported(&mixed(r#""metallic": 1"#, "", "", &third, &links), &sun()).wgsl;
    assert!(text.contains("mix_surfaces_metallic = mix(both_metallic, 0.0, "), "{text}");
    assert!(text.contains("mix_surfaces_coat_weight = mix(0.0, 1.0, "), "{text}");
}

/// A weight that only the fragment stage has is no hindrance where nothing is displaced.
#[test]
fn a_weight_of_the_fragment_stage() {
    let curved = r#", "weight": {"node": "geometry/curvature"}"#;
    let d = mixed(r#""metallic": 1"#, "", "", curved, BY_NOISE);
    for fold in [Fold::Live, Fold::Export] {
        made(&d, &sun(), fold);
    }
    let high = mixed(r#""height": 0.1"#, "", "", curved, BY_NOISE);
    let problems = halfvector_graph::check::check(&high, halfvector_graph::library::Library::standard());
    assert!(
        problems.iter().any(|p| p.node.as_deref() == Some("weight") && p.message.contains("vertex")),
        "{problems:?}"
    );
    assert!(crate::shader(&high, halfvector_graph::library::Library::standard(), &nothing(), Fold::Export).is_err());
}
