//! Nothing that is not used: removing any binding, varying, attribute or uniform member breaks the shader.

use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput, ToneMap};

use super::{environment, exported, made, maps, material, methods, nothing, sun, with_parameters};
use crate::Fold;
use crate::passes::plan::{COMPENSATION_BOUND_PERCENT, COMPENSATION_MIN_F0, COMPENSATION_MIN_ROUGHNESS};

const ALL_LOBES: &str = r#""metallic": 0.2, "coat_weight": 0.8, "coat_roughness": 0.1, "coat_color": [1, 0.9, 0.8],
    "sheen_color": [0.2, 0.2, 0.3], "transmission_weight": 0.4, "anisotropy": 0.7, "thin_film_weight": 0.5"#;

/// A lobe whose weight is 0 leaves no trace, whatever its other numbers are; one that is there is one call of each kind.
#[test]
fn a_lobe_of_weight_zero_is_not_there() {
    let off = r#""coat_weight": 0, "coat_roughness": 0.7, "coat_ior": 2, "sheen_roughness": 0.9, "anisotropy": 0,
        "anisotropy_rotation": 1, "thin_film_weight": 0, "thin_film_thickness": 0.2"#;
    for needs in [nothing(), sun(), environment()] {
        for fold in [Fold::Live, Fold::Export] {
            let plain = made(&material("", "", ""), &needs, fold);
            assert_eq!(plain.wgsl, made(&material(off, "", ""), &needs, fold).wgsl);
            for word in ["coat", "sheen", "transmission", "anisotropic", "film", "let tangent"] {
                assert!(!plain.wgsl.contains(word), "{word}");
            }
        }
    }
    for (values, lobe) in [
        (r#""coat_weight": 0.5"#, "coat"),
        (r#""sheen_color": [0.5, 0, 0]"#, "sheen"),
        (r#""transmission_weight": 0.5"#, "transmission"),
    ] {
        let lit = exported(&material(values, "", ""), &sun()).wgsl;
        assert_eq!(lit.matches(&format!("{lobe}_eval(")).count(), 2, "a call and the function itself: {lit}");
        assert!(!lit.contains(&format!("{lobe}_environment")), "{lit}");
        let surrounded = exported(&material(values, "", ""), &environment()).wgsl;
        assert_eq!(surrounded.matches(&format!("{lobe}_environment(")).count(), 2, "{surrounded}");
        assert!(!surrounded.contains(&format!("{lobe}_eval")), "{surrounded}");
        for other in ["coat", "sheen", "transmission"].into_iter().filter(|other| *other != lobe) {
            assert!(!lit.contains(&format!("{other}_")) && !surrounded.contains(&format!("{other}_")), "{other}");
        }
    }
}

/// A brushed base has a lobe of its own and a row of lookups; a film takes the place of the reflectances, for each light
/// its own. What is turned by the document is a sheet instead of a body.
#[test]
fn brushed_filmed_and_thin() {
    let brushed = exported(&material(r#""metallic": 1, "anisotropy": 0.5"#, "", ""), &sun()).wgsl;
    assert!(brushed.contains("anisotropic_eval(") && !brushed.contains("specular_eval("), "{brushed}");
    assert!(brushed.contains("in.world_tangent") && !brushed.contains("thin_film"), "{brushed}");
    let surrounded = exported(&material(r#""metallic": 1, "anisotropy": 0.5"#, "", ""), &environment()).wgsl;
    assert!(surrounded.contains("anisotropic_strip(frame, ") && !surrounded.contains("anisotropic_eval("));
    let bent = Needs { methods: methods(&[("anisotropy", "bent")]), ..environment() };
    let bent = exported(&material(r#""metallic": 1, "anisotropy": 0.5"#, "", ""), &bent).wgsl;
    assert!(bent.contains("anisotropic_reflection(frame, ") && !bent.contains("anisotropic_strip("), "{bent}");
    let pixel = Needs { methods: methods(&[("normal", "tbn_derivative")]), ..sun() };
    let pixel = exported(&material(r#""anisotropy": 0.5"#, "", ""), &pixel).wgsl;
    assert!(pixel.contains("tangent_from_derivatives(") && !pixel.contains("world_tangent"), "{pixel}");

    let film = exported(&material(r#""thin_film_weight": 1"#, "", ""), &sun()).wgsl;
    let lit = "specular_lit(frame, directional_light.dir, specular) * film_lit.fresnel";
    assert!(film.contains(lit) && !film.contains("specular_eval("), "{film}");
    assert!(film.contains("energy_compensation("), "a film may reflect much: {film}");

    let mut sheet = material(r#""transmission_weight": 1"#, "", "");
    for thin_walled in [false, true] {
        sheet.surface.thin_walled = thin_walled;
        let lit = exported(&sheet, &sun()).wgsl;
        assert_eq!(lit.contains("transmission_thin_eval("), thin_walled, "{lit}");
        let surrounded = exported(&sheet, &environment()).wgsl;
        assert_eq!(surrounded.contains("transmission_lookup("), !thin_walled, "{surrounded}");
    }
}

/// One bad texel stays one dark pixel, whatever lobe it meets: what is lit is guarded once, after all is added.
#[test]
fn every_lit_shader_ends_in_a_finite_colour() {
    let emitting = material(r#""emission": [1, 2, 3]"#, "", "");
    for needs in [sun(), environment(), Needs { point_lights: 3, ..environment() }] {
        for document in [material("", "", ""), maps(), emitting.clone(), material(ALL_LOBES, "", "")] {
            for fold in [Fold::Live, Fold::Export] {
                let text = made(&document, &needs, fold).wgsl;
                let guard = text.find("radiance = finite_or_zero(radiance);").expect("a guard");
                assert!(text.rfind("radiance +=").is_none_or(|sum| sum < guard), "{text}");
            }
        }
    }
    assert!(!exported(&emitting, &nothing()).wgsl.contains("finite_or_zero"), "numbers of the document are checked");
}

/// Up to the first prefiltered level the GPU mixes levels as the shader would: a coat that is known to be so smooth is read
/// by one plain lookup.
#[test]
fn a_smooth_coat_is_one_plain_lookup() {
    for (roughness, plain) in [(0.0, true), (0.1, true), (0.11, false)] {
        let coat = format!(r#""metallic": 1, "coat_weight": 1, "coat_roughness": {roughness}"#);
        let text = exported(&material(&coat, "", ""), &environment()).wgsl;
        let coat = text.lines().find(|line| line.contains("let coat_reflection")).expect("the coat's lookup");
        assert_eq!(coat.contains("environment_sample("), plain, "{coat}");
    }
}

/// Labels may be the names of what the shading declares.
#[test]
fn labels_do_not_meet_the_names_of_lobes() {
    let everything = Needs { directional_lights: 1, point_lights: 2, ..environment() };
    let plain = exported(&material(ALL_LOBES, "", ""), &everything).wgsl;
    let declared = |line: &str| {
        let line = line.trim_start();
        let name = line.strip_prefix("let ").or_else(|| line.strip_prefix("var "))?;
        Some(name.split([' ', ':']).next()?.to_owned())
    };
    let body = plain.split("fn fs_main").nth(1).and_then(|text| text.split("\n}").next()).expect("an entry point");
    for name in body.lines().filter_map(declared) {
        let noise = format!(r#""noise": {{"node": "procedural/value_noise_2d", "label": "{name}"}}"#);
        let link = r#"{"from": "noise.out", "to": "surface.perceptual_roughness"}"#;
        made(&material(ALL_LOBES, &noise, link), &everything, Fold::Export);
    }
}

/// Sheen lies over the coat, the coat over the base and over what the base sends out.
#[test]
fn layers_dim_what_lies_below() {
    let values = format!(r#"{ALL_LOBES}, "emission": [1, 2, 3]"#);
    let everything = Needs { directional_lights: 1, point_lights: 2, ..environment() };
    let text = exported(&material(&values, "", ""), &everything).wgsl;
    let (mut kept, mut sums) = (Vec::new(), Vec::new());
    let body = text.split("fn fs_main").nth(1).and_then(|text| text.split("\n}").next()).expect("an entry point");
    for line in body.lines().map(str::trim) {
        let below =
            |name: &str| line.split_once(" = ").is_some_and(|(sum, term)| term.starts_with(&format!("{sum}{name}")));
        for layer in ["coat", "sheen"] {
            let is_layer = ["eval", "environment"].iter().any(|part| line.contains(&format!("{layer}_{part}(")));
            assert_eq!(is_layer, below(&format!(" * under_{layer} + ")), "{line}");
            kept.extend(is_layer.then_some(layer));
        }
        sums.extend(line.strip_prefix("radiance += ").or_else(|| line.strip_prefix("var radiance = ")));
    }
    assert_eq!(kept, ["coat", "sheen"].repeat(3), "{text}");
    let emitted = "vec3f(1.0, 2.0, 3.0) * under_coat * under_sheen;";
    let lit = "directional_lit * directional_light.illuminance;";
    assert_eq!(sums, [lit, "lit * light.illuminance;", "reflected;", emitted], "{text}");
    let unlit = exported(&material(r#""coat_weight": 1, "emission": [1, 2, 3]"#, "", ""), &nothing()).wgsl;
    assert!(unlit.contains("vec3f(1.0, 2.0, 3.0) * under_coat"), "{unlit}");
}

fn valid(text: &str) -> bool {
    let Ok(module) = naga::front::wgsl::parse_str(text) else { return false };
    crate::validate::validate_module(&module).is_ok()
}

#[test]
fn removing_any_declaration_breaks_it() {
    let everything = Needs {
        directional_lights: 2,
        point_lights: 1,
        spot_lights: 3,
        environment: Some(EnvironmentNeeds { rotated: true }),
        output: ShaderOutput::Display(ToneMap::PbrNeutral),
        ..nothing()
    };
    let mut tried = 0;
    for document in [
        material("", "", ""),
        maps(),
        material(r#""metallic": 1"#, "", ""),
        material(r#""specular": 0"#, "", ""),
        material(ALL_LOBES, "", ""),
        material(r#""coat_weight": 1, "emission": [1, 1, 1]"#, "", ""),
        material(r#""transmission_weight": 1"#, "", ""),
    ] {
        for needs in [nothing(), sun(), environment(), everything.clone()] {
            for fold in [Fold::Live, Fold::Export] {
                let shader = made(&document, &needs, fold);
                let library = shader.wgsl.find("// ---- ").unwrap_or(shader.wgsl.len());
                for (start, line) in lines(&shader.wgsl[..library]) {
                    let declares = line.starts_with("@group") || (line.starts_with("    ") && line.ends_with(','));
                    if declares {
                        let without = format!("{}{}", &shader.wgsl[..start], &shader.wgsl[start + line.len()..]);
                        assert!(!valid(&without), "not needed: {line}\n{}", shader.wgsl);
                        tried += 1;
                    }
                }
            }
        }
    }
    assert!(tried > 200, "{tried}");
}

fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split_inclusive('\n').scan(0, |at, line| {
        let start = *at;
        *at += line.len();
        Some((start, line.trim_end_matches('\n')))
    })
}

/// A transform between spaces is a uniform of the stage whose nodes take it, and of no other shader.
#[test]
fn transforms_are_there_where_nodes_take_them() {
    let plain = exported(&material("", "", ""), &sun()).wgsl;
    for name in ["object_from_world", "view_from_world"] {
        assert!(!plain.contains(name), "{plain}");
    }
    let node = |id: &str| format!(r#""n": {{"node": "spaces/{id}"}}"#);
    let link = r#"{"from": "n.out", "to": "surface.base_color"}"#;
    for (id, member) in [
        ("object_from_world_position", "object.object_from_world"),
        ("world_from_object_direction", "object.world_from_object"),
        ("view_from_world_direction", "view.view_from_world"),
    ] {
        for fold in [Fold::Live, Fold::Export] {
            let shader = made(&material("", &node(id), link), &sun(), fold);
            assert!(shader.wgsl.contains(member), "{}", shader.wgsl);
            let object = shader.reflection.bindings.iter().find(|b| b.name == "object").expect("the object");
            assert_eq!((object.vertex, object.fragment), (true, member.starts_with("object.")));
        }
    }
    let high = r#"{"from": "x.out", "to": "surface.height"}, {"from": "n.out", "to": "x.v"}"#;
    let length = format!(r#"{}, "x": {{"node": "vector/length"}}"#, node("object_from_world_position"));
    let shader = exported(&material("", &length, high), &nothing());
    assert!(shader.wgsl.contains("object.object_from_world"), "the vertex stage has them, too: {}", shader.wgsl);
    assert!(shader.reflection.bindings.iter().any(|b| b.name == "object" && !b.fragment));
}

/// Every function of the library that stands in a shader is reached from an entry point.
#[test]
fn no_function_is_idle() {
    for document in [material("", "", ""), maps()] {
        let shader = exported(&document, &environment());
        let module = naga::front::wgsl::parse_str(&shader.wgsl).expect("valid");
        let mut compacted = module.clone();
        naga::compact::compact(&mut compacted, naga::compact::KeepUnused::No);
        assert_eq!(module.functions.len(), compacted.functions.len());
        assert_eq!(module.global_variables.len(), compacted.global_variables.len());
    }
}

#[test]
fn compensation_of_a_smooth_dielectric_is_left_out_with_its_reason() {
    let smooth = exported(&material(r#""perceptual_roughness": 0.3"#, "", ""), &sun());
    assert!(!smooth.wgsl.contains("energy_compensation"), "{}", smooth.wgsl);
    assert!(smooth.dropped.iter().any(|d| d.what == "energy compensation" && d.why.contains("less than")));
    assert!(smooth.wgsl.contains("// left out: energy compensation"));
    let kept = |values: &str| {
        let text = exported(&material(values, "", ""), &sun()).wgsl;
        assert!(text.contains("energy_compensation(specular.f0, specular.f90, dfg)"), "{values}: {text}");
    };
    kept(r#""metallic": 1"#);
    kept(r#""perceptual_roughness": 0.3, "ior": 2.4"#);
    kept(r#""perceptual_roughness": 0.5"#);
    kept(r#""perceptual_roughness": 0.3, "anisotropy": 1"#);
    let open = with_parameters(
        r#""perceptual_roughness": 0.3"#,
        "",
        "",
        r#"{"name": "r", "socket": "surface.perceptual_roughness"}"#,
    );
    assert!(exported(&open, &sun()).wgsl.contains("energy_compensation("), "a roughness that may be set");
    let filtered = Needs { methods: methods(&[("specular_aa", "box")]), ..sun() };
    let filtered = exported(&material(r#""perceptual_roughness": 0.3"#, "", ""), &filtered).wgsl;
    assert!(filtered.contains("energy_compensation("), "a roughness that the normal's turn adds to");
}

/// The stated bound, by quadrature: the greatest f0 (1 - E)/E over n.v and the roughness at the largest f0.
#[test]
fn compensation_bound_holds() {
    let (f0, most) = (f64::from(COMPENSATION_MIN_F0), f64::from(COMPENSATION_MIN_ROUGHNESS));
    let mut greatest = 0.0_f64;
    for r in 1..=20 {
        for v in 1..=40 {
            let (a, b) = dfg((f64::from(v) / 40.0).powi(3), (most * f64::from(r) / 20.0).powi(2));
            greatest = greatest.max(f0 * (1.0 - (a + b)) / (a + b));
        }
    }
    println!("greatest change: {greatest:.5} of what the lobe reflects");
    let bound = f64::from(COMPENSATION_BOUND_PERCENT) / 100.0;
    assert!(greatest < bound, "{greatest}");
    assert!(greatest > 0.7 * bound, "the bound is loose: {greatest}");
}

/// Split-sum terms of GGX with height-correlated Smith and Schlick, by importance sampling on a grid (Karis 2013).
fn dfg(n_dot_v: f64, alpha: f64) -> (f64, f64) {
    const N: u32 = 64;
    let v = [(1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v];
    let (mut a, mut b) = (0.0, 0.0);
    let lambda = |c: f64| (alpha * alpha + (1.0 - alpha * alpha) * c * c).sqrt();
    for i in 0..N {
        for j in 0..N {
            let (u1, u2) = ((f64::from(i) + 0.5) / f64::from(N), (f64::from(j) + 0.5) / f64::from(N));
            let cos2 = (1.0 - u1) / (1.0 + (alpha * alpha - 1.0) * u1);
            let (cos, sin) = (cos2.sqrt(), (1.0 - cos2).max(0.0).sqrt());
            let phi = std::f64::consts::TAU * u2;
            let h = [sin * phi.cos(), sin * phi.sin(), cos];
            let v_dot_h = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
            let n_dot_l = 2.0 * v_dot_h * h[2] - v[2];
            if n_dot_l > 0.0 && v_dot_h > 0.0 {
                let visibility = 0.5 / (n_dot_l * lambda(n_dot_v) + n_dot_v * lambda(n_dot_l));
                let weight = 4.0 * visibility * n_dot_l * v_dot_h / h[2];
                let fresnel = (1.0 - v_dot_h).powi(5);
                a += (1.0 - fresnel) * weight;
                b += fresnel * weight;
            }
        }
    }
    let count = f64::from(N * N);
    (a / count, b / count)
}
