//! Every planted fault is found and named, and every other example is quiet.

use std::path::{Path, PathBuf};

use halfvector_reference::{Precision, Stability, stability};
use halfvector_scene::{BuiltinMesh, MeshSource, Scene};

use crate::data;

/// Fewest planted cases.
const CASES: usize = 19;

fn materials(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../").join(folder);
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(&folder).expect("the folder").map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(".material.json"));
    files.sort();
    files
}

fn judged(path: &Path) -> Stability {
    let document = halfvector_graph::file::load(path).unwrap_or_else(|e| panic!("{e}"));
    let folder = path.parent().expect("a folder");
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, folder, &sphere).unwrap_or_else(|e| panic!("{e}"));
    let judged = stability(&scene, 0, Precision::Single).unwrap_or_else(|e| panic!("{e}"));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    for f in &judged.unstable {
        println!("{name}: unstable: {}.{} {} for {} at {:?}", f.node, f.output, f.narrow, f.exact, f.input);
    }
    for e in &judged.edges {
        println!("{name}: edge: {}.{} from {} to {} at {:?}", e.node, e.output, e.from, e.to, e.input);
    }
    judged
}

/// Judges a document without pictures.
fn judged_text(text: &str, precision: Precision) -> Stability {
    let document = halfvector_graph::file::from_json(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, Path::new(""), &sphere).expect("a scene");
    stability(&scene, 0, precision).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Sockets of the surface for a number each.
const SOCKETS: [&str; 10] = [
    "metallic",
    "perceptual_roughness",
    "ior",
    "specular",
    "occlusion",
    "height",
    "coat_weight",
    "coat_roughness",
    "coat_ior",
    "sheen_roughness",
];

/// Judges functions of `uv`, at most as many as there are sockets, as the nodes `f0`, `f1`, ...
fn judged_functions(bodies: &[&str]) -> Stability {
    let (mut nodes, mut links, mut functions) = (String::new(), Vec::new(), Vec::new());
    for (number, (body, socket)) in bodies.iter().zip(SOCKETS).enumerate() {
        nodes += &format!(r#""f{number}": {{"node": "custom/f{number}"}}, "#);
        links.push(format!(r#"{{"from": "f{number}.out", "to": "surface.{socket}"}}"#));
        functions.push(format!(
            r#""f{number}": ["/// F", "///", "/// Test.", "/// @node custom/f{number}", "/// - uv: where [context uv0]",
            "/// - return: y", "fn f{number}(uv: vec2f) -> f32 {{", "{body}", "}}"]"#
        ));
    }
    let (links, functions) = (links.join(", "), functions.join(", "));
    let text = format!(
        r#"{{"halfvector": 1, "name": "F", "nodes": {{{nodes}"surface": {{"node": "surface/surface"}}}},
        "links": [{links}], "functions": {{{functions}}}}}"#
    );
    judged_text(&text, Precision::Single)
}

/// Judges a function of `uv`, as the node `f0`.
fn judged_function(body: &str) -> Stability {
    judged_functions(&[body])
}

/// A material whose metallic is the output of the chain of nodes `nodes`, fed by uv0.x from `parts.x`.
fn chain(nodes: &str, links: &str) -> String {
    format!(
        r#"{{"halfvector": 1, "name": "Chain", "nodes": {{{nodes},
        "uv": {{"node": "coordinates/uv"}}, "parts": {{"node": "vector/separate2"}}, "surface": {{"node": "surface/surface"}}}},
        "links": [{{"from": "uv.out", "to": "parts.v"}}, {links}]}}"#
    )
}

fn unstable_nodes(judged: &Stability) -> Vec<&str> {
    judged.unstable.iter().map(|finding| finding.node.as_str()).collect()
}

fn edge_nodes(judged: &Stability) -> Vec<&str> {
    judged.edges.iter().map(|edge| edge.node.as_str()).collect()
}

#[test]
fn planted_faults_are_found_and_named() {
    let files = materials("examples/unstable");
    assert!(files.len() >= CASES);
    let mut wrong = Vec::new();
    for path in files {
        let found: Vec<String> = judged(&path).unstable.into_iter().map(|finding| finding.node).collect();
        if found != ["culprit"] {
            wrong.push(format!("{}: {found:?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn other_examples_are_quiet() {
    let mut loud = materials("examples");
    loud.extend(materials("examples/nodes"));
    let mut loud: Vec<PathBuf> =
        loud.into_iter().filter_map(|path| crate::models::with_models(path, || data("models"))).collect();
    loud.retain(|path| !judged(path).unstable.is_empty());
    assert!(loud.is_empty(), "{loud:?}");
}

/// A checker and the borders of Worley's cells jump; that is no fault, and they are told apart.
#[test]
fn steps_are_edges() {
    let text = r#"{"halfvector": 1, "name": "Steps",
        "nodes": {
            "far": {"node": "coordinates/uv_transform", "values": {"scale": [3.3, 3.3], "offset": [40.1, 40.7]}},
            "checker": {"node": "procedural/checker"},
            "surface": {"node": "surface/surface"}
        },
        "links": [{"from": "far.out", "to": "checker.uv"}, {"from": "checker.out", "to": "surface.metallic"}]}"#;
    let found = judged_text(text, Precision::Single);
    assert_eq!((unstable_nodes(&found), edge_nodes(&found)), (vec![], vec!["checker"]));
}

/// What is no number in f64 as well is named, with how often and where.
#[test]
fn no_number_from_finite_inputs_is_unstable_in_any_arithmetic() {
    let nan = [
        "acos(1.5 * uv.x)",
        "pow(uv.x, 2.2)",
        "sqrt(uv.x - 0.5)",
        "(uv.x - 0.5) / (uv.x - 0.5)",
        "normalize(uv - 0.5).x",
    ];
    let infinite = ["1.0 / (uv.x - 0.5)", "log(abs(uv.x - 0.25))", "1.0 / (uv.x - uv.x)", "inverseSqrt(uv.x - uv.x)"];
    for (bodies, is_nan) in [(&nan[..], true), (&infinite[..], false)] {
        let bodies: Vec<String> = bodies.iter().map(|body| format!("return {body};")).collect();
        let judged = judged_functions(&bodies.iter().map(String::as_str).collect::<Vec<_>>());
        let nodes: Vec<String> = (0..bodies.len()).map(|number| format!("f{number}")).collect();
        assert_eq!(unstable_nodes(&judged), nodes, "{bodies:?}: {judged:?}");
        for found in &judged.unstable {
            assert!(!found.exact.is_finite() && !found.narrow.is_finite() && found.error().is_infinite(), "{found:?}");
            assert!(if is_nan { found.nan > 0 } else { found.infinite > 0 }, "{found:?}");
        }
    }
}

/// A pole that no sample lies on is met when the jump there is looked at.
#[test]
fn a_pole_between_the_samples_is_found() {
    let judged = judged_function("return 1.0 / (uv.x - 0.3);");
    let [found] = judged.unstable.as_slice() else { panic!("{judged:?}") };
    assert_eq!(found.input, [("uv0.x".to_owned(), f64::from(0.3_f32))]);
    assert!(found.infinite > 0 && found.exact.is_infinite());
}

/// A single point of the plane or line that no sample lies on is found by what leads there.
#[test]
fn isolated_points_are_found() {
    let bodies = [
        "return log(abs(uv.x - 0.3721));",
        "return normalize(uv - vec2f(0.3721, 0.2)).x;",
        "return 1.0 / length(uv - vec2f(-2.3721, 3.217));",
        "return 1.0 / (uv.x - uv.y);",
        "return inverseSqrt(dot(uv - 0.617, uv - 0.617));",
        "let d = uv - vec2f(0.3721, 0.2); return d.x * d.y / dot(d, d);",
        // Its neighbours are negative and positive.
        "return pow(uv.x - 1.3721 + abs(uv.x - 1.3721), -0.1);",
        "let d = uv.x - 0.3721; return (1.0 - cos(d)) / (d * d);",
    ];
    let bodies: Vec<&str> = bodies.to_vec();
    let judged = judged_functions(&bodies);
    let nodes: Vec<String> = (0..bodies.len()).map(|number| format!("f{number}")).collect();
    assert_eq!(unstable_nodes(&judged), nodes, "{judged:#?}");
    assert!(judged.unstable.iter().all(|found| !found.narrow.is_finite()), "{:#?}", judged.unstable);
    let [_, direction, ..] = judged.unstable.as_slice() else { panic!() };
    let at = [("uv0.x".to_owned(), f64::from(0.3721_f32)), ("uv0.y".to_owned(), f64::from(0.2_f32))];
    assert_eq!(direction.input, at);
}

/// What f32 gets wrong in a thousandth of the way between two whole coordinates, or in a disc as wide.
#[test]
fn narrow_bands_are_found() {
    let bodies = [
        "return select(uv.x, (uv.x + 1e7) - 1e7, abs(uv.x - 0.3721) < 0.0005);",
        "if length(uv - vec2f(0.3721, 0.2)) < 0.0005 { return (uv.x + 1e7) - 1e7; } return uv.x;",
        // Nothing is decided: only the error is there to be seen.
        "let t = (uv.y - 0.3721) / 0.0002; let b = 1e7 * exp(-t * t); return (uv.y + b) - b;",
    ];
    let judged = judged_functions(&bodies);
    assert_eq!(unstable_nodes(&judged), ["f0", "f1", "f2"], "{judged:#?}");
}

/// Steps that are finer than what f32 may be off, or that no line of samples meets.
#[test]
fn fine_and_small_jumps_are_edges() {
    let bodies = [
        "return round(uv.x * 1000.0) / 1000.0;",
        "return floor(uv.y * 20000.0) / 20000.0;",
        "return step(length(uv - vec2f(0.3721, 0.2)), 0.01);",
        "return step(length(uv - vec2f(-2.3721, 3.217)), 0.0005);",
        "return select(0.0, 1.0, abs(uv.x - 0.3721) < 0.0005);",
        "return select(0.5, 0.6, all(abs(uv - vec2f(0.1234, 0.7)) < vec2f(0.003)));",
        "return f32(i32(uv.x * 300.0) & 1);",
        "return sign(0.999 - sin(uv.x * 3.0) * sin(uv.y * 3.0));",
    ];
    let judged = judged_functions(&bodies);
    let nodes: Vec<String> = (0..bodies.len()).map(|number| format!("f{number}")).collect();
    assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (nodes.iter().map(String::as_str).collect(), vec![]));
}

/// The node that makes it is named, and those that it feeds are told as not judged.
#[test]
fn no_number_is_blamed_on_the_node_that_makes_it() {
    let text = chain(
        r#""less": {"node": "math/subtract", "values": {"b": 0.5}}, "root": {"node": "custom/root"},
           "half": {"node": "math/multiply", "values": {"b": 0.5}}"#,
        r#"{"from": "parts.x", "to": "less.a"}, {"from": "less.out", "to": "root.x"}, {"from": "root.out", "to": "half.a"},
           {"from": "half.out", "to": "surface.metallic"}"#,
    );
    let functions = r#", "functions": {"root": ["/// Root", "///", "/// Test.", "/// @node custom/root", "/// - x: x [0]",
        "/// - return: y", "fn root(x: f32) -> f32 {", "return sqrt(x);", "}"]}}"#;
    let text = format!("{}{functions}", text.strip_suffix('}').expect("an object"));
    let judged = judged_text(&text, Precision::Single);
    assert_eq!(unstable_nodes(&judged), ["root"]);
    assert_eq!(judged.unstable[0].behind, ["half"]);
}

/// Of a chain only the first culprit can be judged; a second one is told to be behind it. What a node does not read is not
/// told.
#[test]
fn a_culprit_behind_a_culprit_is_told() {
    let text = chain(
        r#""far": {"node": "math/add", "values": {"b": 1000000}}, "first": {"node": "math/subtract", "values": {"b": 1000000}},
           "farther": {"node": "math/add", "values": {"b": 10000000}},
           "second": {"node": "math/subtract", "values": {"b": 10000000}}, "other": {"node": "math/add", "values": {"b": 1}}"#,
        r#"{"from": "parts.x", "to": "far.a"}, {"from": "far.out", "to": "first.a"}, {"from": "first.out", "to": "farther.a"},
           {"from": "farther.out", "to": "second.a"}, {"from": "second.out", "to": "surface.metallic"},
           {"from": "parts.y", "to": "other.a"}, {"from": "other.out", "to": "surface.perceptual_roughness"}"#,
    );
    let judged = judged_text(&text, Precision::Single);
    let [found] = judged.unstable.as_slice() else { panic!("{judged:?}") };
    assert_eq!((found.node.as_str(), found.behind.as_slice()), ("first", &["second".to_owned()][..]));
    assert_eq!(found.input.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["uv0.x"]);
}

/// Exposed parameters are moved as other inputs: f32 has 1 where f64 has 0.99999998, next to the jump at 1.
#[test]
fn a_parameter_at_a_jump_is_an_edge() {
    let text = r#"{"halfvector": 1, "name": "Parameter",
        "nodes": {
            "tenth": {"node": "math/multiply", "values": {"a": 1, "b": 0.1}},
            "sum": {"node": "math/add", "values": {"b": 0.9}},
            "floor": {"node": "math/floor"},
            "surface": {"node": "surface/surface"}
        },
        "links": [{"from": "tenth.out", "to": "sum.a"}, {"from": "sum.out", "to": "floor.x"},
            {"from": "floor.out", "to": "surface.metallic"}],
        "parameters": [{"name": "amount", "socket": "tenth.a", "range": [0, 1]}]}"#;
    let judged = judged_text(text, Precision::Single);
    assert!(judged.unstable.is_empty(), "{:?}", judged.unstable);
    let [edge] = judged.edges.as_slice() else { panic!("{judged:?}") };
    assert_eq!((edge.node.as_str(), edge.from.min(edge.to), edge.from.max(edge.to)), ("floor", 0.0, 1.0));
    let [(name, x)] = edge.input.as_slice() else { panic!("{edge:?}") };
    assert!(name == "amount" && (x - 1.0).abs() < 1e-6, "{edge:?}");
}

/// What is computed before a shader is made is judged as it stands in the document, in groups, too.
#[test]
fn constants_are_judged() {
    let nodes = r#""far": {"node": "math/add", "values": {"a": 0.3, "b": 10000000}},
        "back": {"node": "math/subtract", "values": {"b": 10000000}}"#;
    let link = r#"{"from": "far.out", "to": "back.a"}"#;
    let plain = format!(
        r#"{{"halfvector": 1, "name": "Constants", "nodes": {{{nodes}, "surface": {{"node": "surface/surface"}}}},
        "links": [{link}, {{"from": "back.out", "to": "surface.metallic"}}]}}"#
    );
    let judged = judged_text(&plain, Precision::Single);
    let [found] = judged.unstable.as_slice() else { panic!("{judged:?}") };
    assert_eq!((found.node.as_str(), found.narrow, found.input.len()), ("back", 0.0, 0));
    assert!((found.exact - 0.3).abs() < 1e-6, "{found:?}");
    let grouped = format!(
        r#"{{"halfvector": 1, "name": "Group",
        "nodes": {{"odd": {{"node": "group/odd"}}, "surface": {{"node": "surface/surface"}}}},
        "links": [{{"from": "odd.out", "to": "surface.metallic"}}],
        "groups": {{"odd": {{"inputs": [], "outputs": [{{"name": "out", "type": "f32"}}],
            "nodes": {{{nodes}, "output": {{"node": "group/output"}}}},
            "links": [{link}, {{"from": "back.out", "to": "output.out"}}]}}}}}}"#
    );
    assert_eq!(unstable_nodes(&judged_text(&grouped, Precision::Single)), ["odd/back"]);
    // Well-conditioned constants, and what is left of equal ones.
    for values in [r#"{"a": 0.3, "b": 0.4}"#, r#"{"a": 0.1, "b": -0.1}"#] {
        let text = plain.replace(r#"{"a": 0.3, "b": 10000000}"#, values).replace(r#"{"b": 10000000}"#, r#"{"b": 0.7}"#);
        assert_eq!(unstable_nodes(&judged_text(&text, Precision::Single)), Vec::<&str>::new(), "{values}");
    }
}

/// Jumps are found wherever they are, not only where a sample falls on one.
#[test]
fn jumps_are_looked_for() {
    let node = |node: &str, socket: &str, output: &str| {
        chain(
            &format!(r#""scaled": {{"node": "math/multiply", "values": {{"b": 7.3}}}}, "f": {{"node": "{node}"}}"#),
            &format!(
                r#"{{"from": "parts.x", "to": "scaled.a"}}, {{"from": "scaled.out", "to": "f.{socket}"}},
                {{"from": "f.{output}", "to": "surface.metallic"}}"#
            ),
        )
    };
    for kind in ["math/floor", "math/round", "math/fract", "math/sign"] {
        let judged = judged_text(&node(kind, "x", "out"), Precision::Single);
        assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (vec!["f"], vec![]), "{kind}");
    }
    let patterns =
        ["checker.out", "worley_2d.id", "cell_noise_2d.out", "brick.id", "hexagons.id", "white_noise_2d.value"];
    for pattern in patterns {
        let (kind, output) = pattern.split_once('.').expect("a socket");
        let text = format!(
            r#"{{"halfvector": 1, "name": "Pattern", "nodes": {{"f": {{"node": "procedural/{kind}"}},
            "surface": {{"node": "surface/surface"}}}}, "links": [{{"from": "f.{output}", "to": "surface.metallic"}}]}}"#
        );
        let judged = judged_text(&text, Precision::Single);
        assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (vec!["f"], vec![]), "{pattern}");
    }
    let bodies = [
        "return step(0.37, uv.x);",
        "return fract(uv.x * 13.0);",
        "return uv.x % 0.3;",
        "return atan2(uv.y - 0.5, uv.x - 0.5);",
    ];
    let judged = judged_functions(&bodies);
    assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (vec!["f0", "f1", "f2", "f3"], vec![]));
    for edge in &judged.edges {
        assert!((edge.from - edge.to).abs() > 0.2 && !edge.input.is_empty(), "{edge:?}");
    }
}

/// A cartoon's border of light and shade lies in the directions.
#[test]
fn a_jump_of_directions_is_found() {
    let text = r#"{"halfvector": 1, "name": "Toon", "nodes": {"f": {"node": "custom/f"}, "surface": {"node": "surface/surface"}},
        "links": [{"from": "f.out", "to": "surface.metallic"}],
        "functions": {"f": ["/// F", "///", "/// Test.", "/// @node custom/f", "/// - n: normal [context world_normal]",
            "/// - v: view [context view_dir]", "/// - return: y", "fn f(n: vec3f, v: vec3f) -> f32 {",
            "return step(0.6, dot(n, v));", "}"]}}"#;
    let judged = judged_text(text, Precision::Single);
    assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (vec!["f"], vec![]));
}

/// What f32 computes well is neither unstable nor an edge, however steep or near a pole it may be.
#[test]
fn well_conditioned_functions_are_quiet() {
    let bodies = [
        "return uv.x * uv.x * 3.0 - uv.y;",
        "return sin(uv.x * 6.0) * 0.5 + 0.5;",
        "return 1.0 / (uv.x * uv.x + 0.1);",
        "return exp(-uv.x * uv.x);",
        "return pow(abs(uv.x), 2.2);",
        "return acos(clamp(uv.x, -1.0, 1.0));",
        "return smoothstep(0.2, 0.8, uv.x);",
        "return abs(fract(uv.x * 10.0) - 0.5);",
        "return sqrt(abs(uv.x));",
        "return sign(uv.x) * pow(abs(uv.x), 1.0 / 3.0);",
        "return log(abs(uv.x) + 0.01);",
        "return length(uv - 0.5);",
        "return tanh(uv.x * 3.0);",
        "return smoothstep(0.0, 0.01, length(uv - 0.5) - 0.3);",
        "return sqrt(max(1.0 - dot(uv, uv), 0.0));",
        "return inverseSqrt(dot(uv, uv) + 1e-4);",
        "return log2(abs(uv.x) + 1e-6);",
        "return sin(length(uv) * 300.0);",
        "return pow(abs(sin(uv.x * 20.0)), 50.0);",
    ];
    for bodies in bodies.chunks(SOCKETS.len()) {
        let judged = judged_functions(bodies);
        assert_eq!((edge_nodes(&judged), unstable_nodes(&judged)), (vec![], vec![]), "{bodies:?}: {judged:?}");
    }
    let judged = judged_function("return tan(uv.x * 3.0);");
    assert_eq!(unstable_nodes(&judged), Vec::<&str>::new(), "{judged:?}");
}

/// Only what is itself below f32's range underflows: a difference that f32 has as 0 does not.
#[test]
fn a_cancellation_is_no_underflow() {
    let judged = judged_function("return (uv.x + 1e6) - 1e6;");
    let [found] = judged.unstable.as_slice() else { panic!("{judged:?}") };
    assert_eq!(found.underflows, 0);
    let judged = judged_function("let tiny = (uv.x + 5.0) * 1e-25; return tiny * tiny;");
    let [found] = judged.unstable.as_slice() else { panic!("{judged:?}") };
    assert!(found.underflows >= 1024, "{found:?}");
}

/// What goes up and down within 2 ulp of an input is excused by that, though it is the same at the ends of that way, and told as an edge:
/// strokes finer than f16 tells coordinates apart, and a sine that turns once from one number of f32 to the next.
#[test]
fn what_is_finer_than_the_numbers_is_an_edge() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/brushed-aluminium.material.json");
    let document = halfvector_graph::file::load(&path).unwrap_or_else(|e| panic!("{e}"));
    let sphere = MeshSource::Builtin(BuiltinMesh::Sphere);
    let scene = Scene::from_material(document, Path::new(""), &sphere).unwrap_or_else(|e| panic!("{e}"));
    let judged = |precision| stability(&scene, 0, precision).unwrap_or_else(|e| panic!("{e}"));
    let (half, single) = (judged(Precision::Half), judged(Precision::Single));
    assert!(half.unstable.is_empty(), "{:?}", half.unstable);
    assert_eq!(edge_nodes(&half), ["strokes"]);
    assert_eq!(single, Stability::default());
    let sine = judged_function("return sin(uv.x * 52707180.0);");
    assert_eq!((unstable_nodes(&sine), edge_nodes(&sine)), (vec![], vec!["f0"]), "{sine:?}");
}

/// What f32 does well f16 may not: a product beyond its largest number. What f16 computes well is not named.
#[test]
fn f16_is_judged_where_it_is_asked_for() {
    let text = r#"{"halfvector": 1, "name": "Half",
        "nodes": {
            "large": {"node": "math/multiply", "label": "Large", "values": {"b": 10000}},
            "larger": {"node": "math/multiply", "label": "Larger", "values": {"b": 10000}},
            "back": {"node": "math/divide", "label": "Back", "values": {"b": 1e8}},
            "tint": {"node": "math/multiply", "label": "Tint", "values": {"b": 0.5}},
            "uv": {"node": "coordinates/uv"},
            "parts": {"node": "vector/separate2"},
            "surface": {"node": "surface/surface"}
        },
        "links": [
            {"from": "uv.out", "to": "parts.v"},
            {"from": "parts.x", "to": "large.a"}, {"from": "large.out", "to": "larger.a"}, {"from": "larger.out", "to": "back.a"},
            {"from": "parts.y", "to": "tint.a"},
            {"from": "back.out", "to": "surface.metallic"}, {"from": "tint.out", "to": "surface.perceptual_roughness"}
        ]}"#;
    let single = judged_text(text, Precision::Single);
    assert!(single.unstable.is_empty(), "{:?}", single.unstable);
    let half = judged_text(text, Precision::Half);
    let [found] = half.unstable.as_slice() else { panic!("{:?}", half.unstable) };
    assert_eq!((found.node.as_str(), found.narrow.is_finite()), ("larger", false), "{found:?}");
    assert!(found.infinite > 0 && found.exact.is_finite() && found.error().is_infinite());
    let plain = r#"{"halfvector": 1, "name": "Plain", "nodes": {"surface": {"node": "surface/surface"},
        "tint": {"node": "math/multiply", "values": {"b": 0.5}}, "uv": {"node": "coordinates/uv"},
        "parts": {"node": "vector/separate2"}}, "links": [{"from": "uv.out", "to": "parts.v"},
        {"from": "parts.x", "to": "tint.a"}, {"from": "tint.out", "to": "surface.metallic"}]}"#;
    let half = judged_text(plain, Precision::Half);
    assert!(half.unstable.is_empty(), "{:?}", half.unstable);
}
