//! Every method of a term whose methods are functions of one signature: it can be exported, the function is in the shader
//! and no other of its term, and a picture drawn with it is finite and lit.

use std::path::Path;

use halfvector_codegen::{Fold, shader};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::method::{Methods, TERMS};
use halfvector_graph::needs::{Needs, ShaderOutput};
use halfvector_render::RenderOptions;
use halfvector_scene::{BuiltinMesh, EnvironmentSource, Light, MeshSource, Scene};

use crate::support::{renderer, root};

/// Terms whose methods the linker exchanges.
const TERMS_OF_FUNCTIONS: [&str; 4] = ["d", "v", "fresnel", "diffuse"];

/// Each method of these terms: term, method, function.
fn methods() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    TERMS.iter().filter(|t| TERMS_OF_FUNCTIONS.contains(&t.name)).flat_map(|term| {
        term.methods.iter().map(|m| (term.name, m.name, m.function.expect("these methods are functions")))
    })
}

fn chosen(term: &str, method: &str) -> Methods {
    let mut methods = Methods::default();
    methods.set(term, method).expect("a method of the list");
    methods
}

#[test]
fn every_method_is_exported_alone() {
    // A material without cloth or coat: their lobes have forms of their own, whatever the method.
    let path = root().join("examples/plain-dielectric.material.json");
    let document = halfvector_graph::file::load(&path).expect("the example loads");
    for (term, method, function) in methods() {
        let needs = Needs {
            directional_lights: 1,
            point_lights: 0,
            spot_lights: 0,
            environment: None,
            output: ShaderOutput::Radiance,
            methods: chosen(term, method),
        };
        let shader = shader(&document, Library::standard(), &needs, Fold::Export)
            .unwrap_or_else(|e| panic!("{term}={method}: {e}"));
        for (other_term, other, name) in methods() {
            let is_there = shader.wgsl.contains(&format!("fn {name}("));
            let is_wanted = if other_term == term { other == method } else { is_default(other_term, other) };
            // One form may be made of another, as f_exact of f_dielectric; no method of a term is of the same term's.
            assert_eq!(is_there, is_wanted, "{term}={method} ({function}): `{name}` of {other_term}={other}");
        }
    }
}

fn is_default(term: &str, method: &str) -> bool {
    Methods::default().is(term, method)
}

#[test]
fn every_method_draws_a_lit_sphere() {
    let Some(renderer) = renderer() else { return };
    let mut document = Document::with_surface("test");
    let values = &mut document.graph.nodes.get_mut("surface").expect("the surface").values;
    values.insert("perceptual_roughness".into(), halfvector_graph::value::Value::Number(0.5));
    let mesh = MeshSource::Builtin(BuiltinMesh::Sphere);
    let mut scene = Scene::from_material(document, Path::new(""), &mesh).expect("a scene");
    scene.environment = EnvironmentSource::None;
    scene.lights = vec![Light::Directional { direction_to_light: glam::Vec3::Z, illuminance: glam::Vec3::ONE }];
    let options = RenderOptions { width: 24, height: 24, samples_per_side: 1, ..RenderOptions::default() };
    for (term, method, _) in methods() {
        scene.methods = chosen(term, method);
        let picture =
            renderer.render(&scene, None, &options, |_| {}).unwrap_or_else(|e| panic!("{term}={method}: {e}"));
        assert!(picture.pixels.iter().flatten().all(|x| x.is_finite() && *x >= 0.0), "{term}={method}: not a number");
        let middle = picture.pixels[12 * 24 + 12];
        assert!(middle[0] > 0.1 && middle[0] < 10.0, "{term}={method}: the middle is {middle:?}");
    }
}
