//! What is left out is told with what it saves, in the comment, too.

use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_graph::needs::Needs;

use super::{environment, exported, maps, material, methods, nothing, sun, with_parameters};
use crate::target::{export, target};
use crate::{Remark, Shader, cost, explained, validate};

fn told(document: &Document, needs: &Needs) -> Shader {
    let shader = explained(document, Library::standard(), needs, &[]).unwrap_or_else(|e| panic!("{e}"));
    validate(&shader).unwrap_or_else(|e| panic!("{e}\n{}", shader.wgsl));
    shader
}

fn total(shader: &Shader) -> u32 {
    let cost = cost(shader).unwrap_or_else(|e| panic!("{e}"));
    cost.vertex.total() + cost.fragment.total()
}

fn saved(shader: &Shader, what: &str) -> u32 {
    let dropped = shader.dropped.iter().find(|dropped| dropped.what == what);
    dropped.unwrap_or_else(|| panic!("{what}")).instructions.unwrap_or_else(|| panic!("{what} is not counted"))
}

/// A parameter on a socket keeps it open: what that costs is what leaving it out saves.
#[test]
fn a_lobe_saves_what_an_open_one_costs() {
    for needs in [sun(), environment()] {
        let shader = told(&material("", "", ""), &needs);
        for (what, socket) in [
            ("coat", "coat_weight"),
            ("sheen", "sheen_color"),
            ("transmission", "transmission_weight"),
            ("anisotropy", "anisotropy"),
            ("thin film", "thin_film_weight"),
            ("emission", "emission"),
        ] {
            let parameter = format!(r#"{{"name": "{socket}", "socket": "surface.{socket}"}}"#);
            let open = exported(&with_parameters("", "", "", &parameter), &needs);
            assert_eq!(saved(&shader, what), total(&open) - total(&shader), "{what}");
        }
        assert!(saved(&shader, "coat") > 30 && saved(&shader, "metal") > 0, "{:?}", shader.dropped);
    }
}

/// Whatever is left out is counted, in every kind of shader; but the header the text is the one that is not explained.
#[test]
fn everything_left_out_is_counted() {
    let bare = Needs { methods: methods(&[("compensation", "none"), ("height_normals", "report")]), ..environment() };
    let waves = r#""noise": {"node": "procedural/value_noise_2d"}"#;
    let high = material("", waves, r#"{"from": "noise.out", "to": "surface.height"}"#);
    for document in [material("", "", ""), maps(), material(r#""metallic": 1"#, "", ""), high] {
        for needs in [nothing(), sun(), environment(), bare.clone()] {
            let (plain, shader) = (exported(&document, &needs), told(&document, &needs));
            for dropped in &shader.dropped {
                assert!(dropped.instructions.is_some(), "{dropped:?}");
            }
            assert_eq!(plain.wgsl[plain.header().len()..], shader.wgsl[shader.header().len()..]);
            let counted = shader.wgsl.matches("(saves ").count();
            assert!(counted > 1 && !plain.wgsl.contains("(saves "), "{}", shader.header());
        }
    }
    let metal = told(&material(r#""metallic": 1"#, "", ""), &environment());
    for what in ["diffuse lobe", "horizon", "occlusion", "displacement"] {
        assert!(saved(&metal, what) > 0, "{what}");
    }
    let single = told(&material(r#""metallic": 1"#, "", ""), &bare);
    assert!(saved(&single, "energy compensation") > 0);
    let smooth = material(r#""perceptual_roughness": 0.3"#, "", "");
    assert!(saved(&told(&smooth, &sun()), "energy compensation") > 0);
}

/// `coat = 0.5 * 0 * noise` leaves no word of it in the text, and is told beside.
#[test]
fn what_a_product_with_zero_switches_off_leaves_no_trace() {
    let document = material(
        "",
        r#""noise": {"node": "procedural/value_noise_2d"},
           "none": {"node": "math/multiply", "values": {"b": 0}}, "half": {"node": "math/multiply", "values": {"b": 0.5}}"#,
        r#"{"from": "noise.out", "to": "none.a"}, {"from": "none.out", "to": "half.a"},
           {"from": "half.out", "to": "surface.coat_weight"}"#,
    );
    let shader = told(&document, &sun());
    for word in ["coat", "noise", "sheen", "film"] {
        assert!(!shader.wgsl.contains(word), "{word}: {}", shader.wgsl);
    }
    assert!(saved(&shader, "coat") > 30);
    assert!(shader.header().contains("// left out: 5 lobes: their weights are 0 (saves "), "{}", shader.header());
}

/// Nodes that reach the surface and are not in the shader are told, each with its reason; those that are in it are not.
#[test]
fn nodes_that_are_left_out_are_told() {
    let shader = told(
        &material(
            "",
            r#""noise": {"node": "procedural/value_noise_2d", "label": "Grain"}, "wave": {"node": "math/sin"},
               "none": {"node": "math/multiply", "label": "None", "values": {"b": 0}}, "same": {"node": "math/multiply", "values": {"b": 1}},
               "sum": {"node": "math/add", "values": {"a": 0.25, "b": 0.5}}, "rough": {"node": "procedural/value_noise_3d"},
               "twin": {"node": "math/sin"}, "both": {"node": "math/add"}, "dead": {"node": "math/cos"}"#,
            r#"{"from": "noise.out", "to": "wave.x"}, {"from": "wave.out", "to": "none.a"}, {"from": "none.out", "to": "surface.coat_weight"},
               {"from": "sum.out", "to": "surface.specular"}, {"from": "rough.out", "to": "surface.coat_roughness"},
               {"from": "noise.out", "to": "same.a"}, {"from": "same.out", "to": "both.a"}, {"from": "noise.out", "to": "twin.x"},
               {"from": "twin.out", "to": "both.b"}, {"from": "both.out", "to": "surface.perceptual_roughness"}"#,
        ),
        &sun(),
    );
    let known = "its value is known: a number stands in its place";
    let told: Vec<(&str, &str, &str)> =
        shader.dropped_nodes.iter().map(|n| (n.node.as_str(), n.label.as_str(), n.why.as_str())).collect();
    assert_eq!(
        told,
        [
            ("none", "None", known),
            ("rough", "Value Noise 3D", "it feeds only `coat_roughness` (coat_weight is 0)"),
            ("same", "Multiply", "it changes nothing: what it gets stands in its place"),
            ("sum", "Add", known),
            ("wave", "Sine", "it feeds only `None`, which needs no computing"),
        ]
    );
    let of = |id: &str| shader.dropped_nodes.iter().find(|n| n.node == id).and_then(|n| n.instructions);
    assert!(of("wave") == Some(1) && of("rough") > Some(30), "{:?}", shader.dropped_nodes);
    let saved: u32 = shader.dropped_nodes.iter().filter_map(|n| n.instructions).sum();
    let line =
        format!("// left out: 5 nodes that nothing reads or whose values are known (save {saved} instructions)\n");
    assert!(shader.header().contains(&line), "{}", shader.header());
    assert!(told_of_none(&maps()), "nothing is left out of it");
}

/// Of nodes that compute the same one is in the shader; the others are told.
#[test]
fn a_node_that_another_one_stands_for_is_told() {
    let shader = told(
        &material(
            "",
            r#""noise": {"node": "procedural/value_noise_2d"}, "one": {"node": "math/sin", "label": "One"},
               "two": {"node": "math/sin", "label": "Two"}, "sum": {"node": "math/add"}"#,
            r#"{"from": "noise.out", "to": "one.x"}, {"from": "noise.out", "to": "two.x"}, {"from": "one.out", "to": "sum.a"},
               {"from": "two.out", "to": "sum.b"}, {"from": "sum.out", "to": "surface.perceptual_roughness"}"#,
        ),
        &sun(),
    );
    let told: Vec<_> =
        shader.dropped_nodes.iter().map(|n| (n.label.as_str(), n.why.as_str(), n.instructions)).collect();
    assert_eq!(told, [("Two", "another node computes the same", Some(1))], "{}", shader.wgsl);
    assert_eq!(shader.wgsl.matches("sin(").count(), 1, "{}", shader.wgsl);
}

fn told_of_none(document: &Document) -> bool {
    let shader = told(document, &sun());
    shader.dropped_nodes.is_empty() && !shader.header().contains("whose value")
}

/// What does not reach the surface changes nothing.
#[test]
fn dead_nodes_change_nothing() {
    let mut document = maps();
    let plain = told(&document, &environment());
    for i in 0..500 {
        let node = halfvector_graph::document::Node::new("procedural/value_noise_2d");
        document.graph.nodes.insert(format!("dead{i}"), node);
    }
    assert_eq!(told(&document, &environment()), plain);
}

/// What is remarked stands in the comment of every language that has comments, and stays in it.
#[test]
fn remarks_stand_in_the_comment() {
    let long = "word ".repeat(60);
    let remarks = [
        Remark { lead: "budget", text: format!("0.05 is kept*/\n}} fn hacked() {{}} \\\nand {long}end") },
        Remark { lead: "chosen", text: "v=hammon".into() },
    ];
    let shader = explained(&maps(), Library::standard(), &sun(), &remarks).unwrap_or_else(|e| panic!("{e}"));
    validate(&shader).unwrap_or_else(|e| panic!("{e}\n{}", shader.wgsl));
    let header = shader.header();
    assert!(header.contains("// budget: 0.05 is kept* / }") && header.contains("// chosen: v=hammon\n"), "{header}");
    assert!(header.contains("end\n") && !header.contains("*/") && !header.contains('\\'), "{header}");
    assert!(header.lines().all(|line| line.starts_with("//") && line.chars().count() <= 118), "{header}");
    for (name, first) in [("glsl", 1), ("glsl-es", 1), ("hlsl", 0), ("msl", 0)] {
        let files = export(&shader, target(name).expect("a target of the list"), "m").expect("files");
        for file in files.iter().filter(|file| !file.name.ends_with(".json")) {
            let text = String::from_utf8_lossy(&file.bytes);
            let lines: Vec<&str> = text.lines().skip(first).take(header.lines().count()).collect();
            assert_eq!(lines, header.lines().collect::<Vec<_>>(), "{name}");
        }
    }
}

/// A picture whose slope is seen is read by arithmetic: which, why and at what price is said.
#[test]
fn slopes_that_are_read_by_arithmetic_are_told() {
    let document = material(
        "",
        r#""relief": {"node": "textures/image", "label": "Relief", "values": {"image": {"file": "relief.png", "color_space": "linear"}}}"#,
        r#"{"from": "relief.r", "to": "surface.height"}, {"from": "relief.color", "to": "surface.base_color"}"#,
    );
    let shader = explained(&document, Library::standard(), &sun(), &[]).unwrap_or_else(|e| panic!("{e}"));
    let [read] = shader.slope_reads.as_slice() else { panic!("{:?}", shader.slope_reads) };
    assert_eq!((read.node.as_str(), read.label.as_str()), ("relief", "Relief"));
    assert!(read.why.contains("8 bits") && read.instructions > Some(20), "{read:?}");
    let said = shader.header().replace("\n//    ", "");
    assert!(said.contains("slopes: where its slope is seen, `Relief` is blended"), "{said}");
    let plain = super::material(
        "",
        r#""relief": {"node": "textures/image", "values": {"image": {"file": "relief.png", "color_space": "linear"}}}"#,
        r#"{"from": "relief.color", "to": "surface.base_color"}"#,
    );
    let shader = explained(&plain, Library::standard(), &sun(), &[]).unwrap_or_else(|e| panic!("{e}"));
    assert!(shader.slope_reads.is_empty() && !shader.header().contains("slopes:"), "{}", shader.header());
}
