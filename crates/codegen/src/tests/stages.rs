//! What stands in which stage: height, opacity, sides, tangents, contexts.

use halfvector_graph::document::{AlphaMode, Document};
use halfvector_graph::library::Library;
use halfvector_graph::method::Methods;
use halfvector_graph::needs::{Needs, ShaderOutput, ToneMap};
use halfvector_graph::value::{Filter, Value};

use super::{environment, exported, maps, material, methods, nothing, sun};
use crate::Shader;

fn part<'s>(shader: &'s Shader, entry: &str) -> &'s str {
    let start = shader.wgsl.find(&format!("fn {entry}")).expect("the entry point");
    let end = shader.wgsl[start..].find("\n}").expect("its end");
    &shader.wgsl[start..start + end]
}

fn displaced() -> Document {
    material(
        "",
        r#""relief": {"node": "textures/image", "values": {"image": {"file": "h.png", "color_space": "linear"}}},
           "height": {"node": "textures/height"}"#,
        r#"{"from": "relief.r", "to": "height.value"}, {"from": "height.out", "to": "surface.height"}"#,
    )
}

#[test]
fn height_moves_the_vertex_and_tilts_the_normal() {
    let shader = exported(&displaced(), &sun());
    let (vertex, fragment) = (part(&shader, "vs_main"), part(&shader, "fs_main"));
    assert!(vertex.contains("displaced(world_position, world_normal, "), "{vertex}");
    assert!(
        vertex.contains("blended_node_textures_image_vertex("),
        "no implicit derivative in the vertex stage\n{vertex}"
    );
    // Of the place that is seen, so that curved surfaces are right; nothing else asks for the one before displacement.
    assert!(fragment.contains("normal_from_height(dpdx(in.world_position), dpdy(in.world_position)"), "{fragment}");
    assert!(!shader.wgsl.contains("surface_position"));
    let image = shader.reflection.bindings.iter().find(|b| b.name.contains("texture")).expect("the map");
    assert!(image.vertex && image.fragment);

    let needs = Needs { methods: methods(&[("height_normals", "report")]), ..sun() };
    let report = exported(&displaced(), &needs);
    assert!(!part(&report, "fs_main").contains("normal_from_height"));
    assert!(report.dropped.iter().any(|d| d.what.contains("normals of the displaced")));
}

/// Texels of a height are blended by arithmetic, those of anything else by the sampler, and so are those of a map that is
/// to have steps.
#[test]
fn heights_are_blended_by_arithmetic() {
    let mut document = displaced();
    document.graph.links.extend(super::document(
        r#"{"halfvector": 1, "name": "", "nodes": {}, "links": [{"from": "relief.r", "to": "surface.perceptual_roughness"}]}"#,
    ).graph.links);
    let fragment = exported(&document, &sun());
    let fragment = part(&fragment, "fs_main");
    assert!(
        fragment.contains(" blended_node_textures_image(") && fragment.contains(" node_textures_image("),
        "{fragment}"
    );
    let Some(Value::Image(image)) = document.graph.nodes.get_mut("relief").and_then(|n| n.values.get_mut("image"))
    else {
        panic!("the map");
    };
    image.filter = Filter::Nearest;
    let shader = exported(&document, &sun());
    assert!(shader.wgsl.contains("node_textures_image_vertex(") && !shader.wgsl.contains("blended"), "{}", shader.wgsl);
}

/// What is brushed is brushed along the displaced surface, and normal maps lie on it.
#[test]
fn tangents_follow_the_displaced_surface() {
    let mut document = displaced();
    let values = &mut document.graph.nodes.get_mut("surface").expect("the surface").values;
    values.insert("anisotropy".into(), Value::Number(0.5));
    values.insert("metallic".into(), Value::Number(1.0));
    let shader = exported(&document, &sun());
    let fragment = part(&shader, "fs_main");
    assert_eq!(fragment.matches("displaced_tangent(world_normal, in.world_tangent, ").count(), 1, "{fragment}");
    let needs = Needs { methods: methods(&[("height_normals", "report")]), ..sun() };
    assert!(!exported(&document, &needs).wgsl.contains("displaced_tangent"));
    // Without a brushed lobe or a normal map there is none.
    let plain = exported(&displaced(), &sun()).wgsl;
    assert!(!plain.contains("displaced_tangent") && !plain.contains("world_tangent"), "{plain}");
}

#[test]
fn a_constant_height_needs_no_derivatives() {
    let shader = exported(&material(r#""height": 0.5"#, "", ""), &sun());
    assert!(part(&shader, "vs_main").contains("displaced(world_position, world_normal, 0.5)"));
    assert!(!shader.wgsl.contains("dpdx"));
    assert!(!exported(&material("", "", ""), &sun()).wgsl.contains("displaced("));
}

/// The height alone is that of the stages: no implicit derivative for the vertices, and its change for the normals.
#[test]
fn the_height_alone() {
    let of = |document: &Document, chosen: &[(&str, &str)]| {
        crate::height(document, Library::standard(), &methods(chosen)).expect("sound")
    };
    let found = of(&displaced(), &[]).expect("a height");
    let change = found.change.expect("normals bend");
    for shader in [&found.vertex, &change] {
        crate::validate(shader).unwrap_or_else(|e| panic!("{e}\n{}", shader.wgsl));
    }
    let (vertex, change) = (&found.vertex.wgsl, &change.wgsl);
    assert!(vertex.contains("fn height(context: Context) -> f32") && vertex.contains("node_textures_image_vertex("));
    assert!(change.contains("fn height_change(context: Context) -> vec2f"), "{change}");
    assert!(change.contains("return vec2f(dpdx(") && !change.contains("node_textures_image_vertex("), "{change}");
    assert_eq!(of(&displaced(), &[("height_normals", "report")]).map(|height| height.change), Some(None));
    // The same everywhere it bends nothing, and 0 is none.
    assert_eq!(of(&material(r#""height": 0.5"#, "", ""), &[]).map(|height| height.change), Some(None));
    assert_eq!(of(&material("", "", ""), &[]), None);
}

#[test]
fn opacity_by_mode() {
    let of = |mode: AlphaMode, values: &str| {
        let mut document = material(values, "", "");
        document.surface.alpha_mode = mode;
        exported(&document, &sun())
    };
    let half = r#""opacity": 0.5"#;
    assert!(part(&of(AlphaMode::Mask, half), "fs_main").contains("discard"));
    let blend = of(AlphaMode::Blend, half);
    assert!(part(&blend, "fs_main").contains("vec4f(radiance * opacity, opacity)"));
    let opaque = of(AlphaMode::Opaque, half);
    assert!(part(&opaque, "fs_main").contains("vec4f(radiance, 1.0)"));
    assert!(!part(&of(AlphaMode::Mask, ""), "fs_main").contains("discard"), "opacity 1 is never below the cutoff");
}

/// Samples with implicit derivatives come before the discard, which makes control flow non-uniform.
#[test]
fn discard_comes_after_the_samples() {
    let mut document = maps();
    document.surface.alpha_mode = AlphaMode::Mask;
    let link =
        r#"{"halfvector": 1, "name": "", "nodes": {}, "links": [{"from": "albedo.alpha", "to": "surface.opacity"}]}"#;
    document.graph.links.extend(super::document(link).graph.links);
    let shader = exported(&document, &environment());
    let fragment = part(&shader, "fs_main");
    let discard = fragment.find("discard").expect("a discard");
    let last = fragment.rfind("node_textures_image").expect("samples");
    assert!(last < discard, "{fragment}");
}

#[test]
fn both_sides_turn_the_shading_normal() {
    let mut document = material("", "", "");
    document.surface.double_sided = true;
    let shader = exported(&document, &sun());
    assert!(part(&shader, "fs_main").contains("select(-world_normal, world_normal, front_facing)"));
    assert!(!exported(&material("", "", ""), &sun()).wgsl.contains("front_facing"));
}

/// From inside light leaves the body: the index is turned about, and beyond the critical angle nothing comes through.
#[test]
fn a_solid_body_may_be_seen_from_inside() {
    let mut document = material(r#""transmission_weight": 1"#, "", "");
    assert!(!exported(&document, &environment()).wgsl.contains("front_facing"));
    document.surface.double_sided = true;
    let shader = exported(&document, &environment());
    let fragment = part(&shader, "fs_main");
    assert!(fragment.contains("select(1.0 / 1.5, 1.5, front_facing)"), "{fragment}");
    assert!(fragment.contains("f_dielectric(transmission.eta, frame.n_dot_v)"), "{fragment}");
    document.surface.thin_walled = true;
    assert!(!part(&exported(&document, &environment()), "fs_main").contains("1.0 /"));
}

#[test]
fn only_tbn_reads_tangents() {
    let with = |method: &str| {
        let needs = Needs { methods: methods(&[("normal", method)]), ..environment() };
        exported(&maps(), &needs)
    };
    let has_tangent = |shader: &Shader| shader.reflection.vertex_inputs.iter().any(|i| i.name == "tangent");
    assert!(has_tangent(&with("tbn")));
    for method in ["tbn_derivative", "rotation_report", "rotation_fixed"] {
        let shader = with(method);
        assert!(!has_tangent(&shader) && shader.wgsl.contains(&format!("normal_{method}(")), "{method}");
    }
}

#[test]
fn normal_maps_are_read_as_the_scene_says() {
    for (method, function) in [("snorm", "normal_from_texel_snorm("), ("two_channel", "normal_from_texel_two_channel(")]
    {
        let needs = Needs { methods: methods(&[("normal_decode", method)]), ..environment() };
        let text = exported(&maps(), &needs).wgsl;
        assert!(text.contains(function) && !text.contains("normal_from_texel("), "{text}");
    }
}

#[test]
fn methods_exchange_functions() {
    let document = material(r#""metallic": 0.5"#, "", "");
    let chosen =
        [("v", "separable"), ("fresnel", "exact"), ("diffuse", "burley"), ("dfg", "karis"), ("irradiance", "sh2")];
    let needs = Needs { methods: methods(&chosen), directional_lights: 1, ..environment() };
    let text = exported(&document, &needs).wgsl;
    for name in ["v_smith_ggx_separable(", "f_exact(", "diffuse_burley(", "dfg_karis(", "irradiance_sh2("] {
        assert!(text.contains(name), "{name}");
    }
    for name in ["v_smith_ggx_correlated", "f_schlick", "diffuse_lambert", "dfg_from_table", "var irradiance_over_pi"] {
        assert!(!text.contains(name), "{name}");
    }
}

#[test]
fn the_reports_forms() {
    let needs = Needs { methods: Methods::report(), output: ShaderOutput::Display(ToneMap::None), ..environment() };
    let text = exported(&material(r#""metallic": 0.5"#, "", ""), &needs).wgsl;
    assert!(text.contains("gamma_from_linear(environment_sample(prefiltered_radiance"), "{text}");
    assert!(text.contains("lod_report(1.0, view.environment_levels)"), "{text}");
    assert!(!text.contains("srgb_from_linear("), "the PNG is written without a second encoding");
    assert!(!text.contains("energy_compensation("));
}

#[test]
fn lights_are_loops_only_when_there_are_several() {
    let one = exported(&material("", "", ""), &sun()).wgsl;
    assert!(!one.contains("for (") && one.contains("directional: DirectionalLight,"));
    let needs = Needs { directional_lights: 1, point_lights: 2, spot_lights: 3, ..nothing() };
    let several = exported(&material("", "", ""), &needs).wgsl;
    assert_eq!(several.matches("for (").count(), 2, "{several}");
    assert!(several.contains("point: array<PointLight, 2>") && several.contains("spot: array<SpotLight, 3>"));
}

#[test]
fn nothing_to_see_is_nothing_to_compute() {
    let shader = exported(&material("", "", ""), &nothing());
    assert!(part(&shader, "fs_main").contains("vec3f(0.0)"));
    let names: Vec<&str> = shader.reflection.bindings.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["view", "object"]);
    assert_eq!(shader.reflection.vertex_inputs.len(), 1);
}
