//! Exported pages in a real browser, against the pictures that wgpu draws of the same scenes.

use halfvector_graph::document::{Document, Node, Parameter, SocketRef};
use halfvector_graph::method::Methods;
use halfvector_graph::needs::ToneMap;
use halfvector_graph::value::Value;
use halfvector_ibl::{BakeOptions, BakedEnvironment, bake};
use halfvector_render::{RenderOptions, Renderer};
use halfvector_scene::light::parse_light;
use halfvector_scene::parameters::set_parameter;
use halfvector_scene::{Background, BuiltinMesh, Display, Exposure, MeshSource, Scene};

use crate::browser::{Browser, on_one_device};
use crate::support::{renderer, root};

const SIZE: u32 = 96;

fn scene(example: &str, mesh: BuiltinMesh, parameters: &[(&str, &[f64])]) -> Scene {
    let folder = root().join("examples");
    let mut document = halfvector_graph::file::load(&folder.join(example)).unwrap_or_else(|e| panic!("{e}"));
    for (name, value) in parameters {
        set_parameter(&mut document, name, value).unwrap_or_else(|e| panic!("{e}"));
    }
    Scene::from_material(document, &folder, &MeshSource::Builtin(mesh)).unwrap_or_else(|e| panic!("{e}"))
}

/// What is drawn in both: reflections and colours, images with lights and no environment, a blended body in a turned
/// environment that stands behind it.
fn scenes() -> Vec<(&'static str, Scene)> {
    let gold = [("metallic", &[1.0][..]), ("base_color", &[1.0, 0.766, 0.336]), ("perceptual_roughness", &[0.3])];
    let mut gold = scene("surface.material.json", BuiltinMesh::Torus, &gold);
    gold.background = Background::None;
    gold.environment_rotation = 70.0;
    gold.exposure = Exposure::Stops(-0.5);
    gold.tone_map = ToneMap::Aces;

    let mut panel = scene("painted-panel.material.json", BuiltinMesh::Plane, &[]);
    panel.environment = halfvector_scene::EnvironmentSource::None;
    panel.background = Background::Color([0.1, 0.2, 0.3]);
    panel.lights = vec![
        parse_light("directional:1,1,2:3").expect("a light"),
        parse_light("spot:0,1,2:0,-0.5,-1:9:10:40:1,0.5,0.2").expect("a light"),
    ];

    let coat = [("coat_weight", &[1.0][..]), ("base_color", &[0.5, 0.02, 0.02]), ("sheen_color", &[0.1, 0.1, 0.3])];
    let coat = scene("surface.material.json", BuiltinMesh::Sphere, &coat);

    let mut report = scene("surface.material.json", BuiltinMesh::Sphere, &[("perceptual_roughness", &[0.18])]);
    report.methods = Methods::report();
    vec![("gold", gold), ("panel", panel), ("coat", coat), ("report", report)]
}

fn environment(scene: &Scene) -> Option<BakedEnvironment> {
    let loaded = scene.environment.load().expect("an environment")?;
    let options = halfvector_scene::bake_options(&scene.environment, &scene.methods, &loaded);
    Some(bake(&loaded, &BakeOptions { size: 64, irradiance_size: 16, ..options }))
}

fn bytes_of(base64: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let digits: Vec<u8> = base64.bytes().filter(|c| *c != b'=').map(digit).collect();
    let word = |four: &[u8]| four.iter().enumerate().fold(0_u32, |word, (i, &d)| word | u32::from(d) << (18 - 6 * i));
    digits.chunks(4).flat_map(|four| word(four).to_be_bytes()[1..four.len()].to_vec()).collect()
}

/// How the browser's picture of a scene compares with wgpu's.
struct Compared {
    /// Pixels covered whole in both.
    covered: usize,
    /// Of them those that are more than 1/255 apart.
    off: usize,
    /// Root mean square of the differences, in codes.
    rms: f64,
    /// Pixels covered whole in one alone.
    edges: usize,
}

fn compare(name: &str, scene: &Scene, renderer: &Renderer, browser: &mut Browser) -> Compared {
    let folder = tempfile::tempdir().expect("a folder");
    let environment = environment(scene);
    let options = RenderOptions { width: SIZE, height: SIZE, samples_per_side: 2, ..RenderOptions::default() };
    let drawn = renderer.render(scene, environment.as_ref(), &options, |_| {}).expect("a picture");
    let display = if scene.methods.is("encode", "report") {
        Display::AsIs
    } else {
        Display::ToneMapped { exposure: scene.exposure.factor(), tone_map: scene.tone_map }
    };
    let path = folder.path().join("index.html");
    let page = halfvector_web::page(scene, environment.as_ref()).expect("a page");
    std::fs::write(&path, &page).expect("written");
    let fragment = format!("pixels&size={SIZE}x{SIZE}&samples=2");
    let expression = "[document.getElementById('message').textContent, \
                      document.getElementById('pixels')?.textContent]";
    let said = browser.page(&path, &fragment, expression);
    assert_eq!(said[0], "", "{name}: the page says");
    let shown = bytes_of(said[1].as_str().expect("pixels"));
    assert_eq!(shown.len(), (SIZE * SIZE * 4) as usize, "{name}");

    let pairs: Vec<([u8; 4], &[u8])> = drawn.pixels.iter().map(|p| display.codes(*p)).zip(shown.chunks(4)).collect();
    let difference = |(a, b): &([u8; 4], &[u8])| a.iter().zip(*b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let covered: Vec<u8> = pairs.iter().filter(|(a, b)| a[3] == 255 && b[3] == 255).map(difference).collect();
    let (largest, off) = (covered.iter().max().expect("pixels"), covered.iter().filter(|d| **d > 1).count());
    let edges = pairs.iter().filter(|(a, b)| (a[3] == 255) != (b[3] == 255)).count();
    let squares: f64 = covered.iter().map(|d| f64::from(*d).powi(2)).sum();
    let rms = (squares / covered.len() as f64).sqrt();
    println!(
        "{name}: {} bytes; {} covered pixels: rms {rms:.3}/255, {off} differ by more than 1/255, the most by \
         {largest}/255; {edges} are covered in one picture alone",
        page.len(),
        covered.len(),
    );
    assert!(covered.len() > (SIZE * SIZE / 8) as usize, "{name}");
    Compared { covered: covered.len(), off, rms, edges }
}

#[test]
fn a_browser_draws_what_wgpu_draws() {
    let Some(renderer) = renderer() else { return };
    let Some(mut browser) = Browser::open() else { return };
    for (name, scene) in scenes() {
        let Compared { covered, off, rms, edges } = compare(name, &scene, &renderer, &mut browser);
        // Devices choose levels of images and filter them in their own way: between two of them the pictures may differ by more.
        let (most, share) = match (on_one_device(), name) {
            (true, _) => (0.25, covered + 1),
            (false, "panel") => (2.0, 10),
            (false, _) => (0.6, 500),
        };
        assert!(rms <= most && off * share <= covered, "{name}: the pictures differ");
        assert!(edges * 100 <= covered, "{name}: the outlines differ");
    }
}

#[test]
fn names_in_a_document_run_no_script() {
    let Some(mut browser) = Browser::open() else { return };
    let hostile = "</script></title><img src=x onerror=\"document.title='hacked'\"><script>document.title='hacked'\
                   </script>`${document.title='hacked'}`\\u2028';document.title='hacked';//";
    let mut document = Document::with_surface(hostile);
    let surface = document.graph.nodes.get_mut("surface").expect("the surface");
    surface.label = Some(hostile.into());
    surface.values.insert("metallic".into(), Value::Number(0.5));
    document.graph.nodes.insert("other".into(), Node { label: Some(hostile.into()), ..Node::new("math/sin") });
    let link = |from, to| halfvector_graph::document::Link::new(from, to);
    document.graph.links.push(link(SocketRef::new("other", "out"), SocketRef::new("surface", "perceptual_roughness")));
    document.parameters.push(Parameter {
        name: "metallic".into(),
        label: Some(hostile.into()),
        socket: SocketRef::new("surface", "metallic"),
        range: None,
    });
    let mesh = MeshSource::Builtin(BuiltinMesh::Plane);
    let mut scene = Scene::from_material(document, &root(), &mesh).expect("a scene");
    scene.environment = halfvector_scene::EnvironmentSource::None;
    scene.lights = vec![parse_light("directional:1,1,1:3").expect("a light")];
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("index.html");
    std::fs::write(&path, halfvector_web::page(&scene, None).expect("a page")).expect("written");
    // Drawn as people see it, with the sliders.
    let expression = "[document.title, document.querySelector('h1').textContent, \
                      document.querySelector('label span').textContent, document.images.length, \
                      document.scripts.length, document.getElementById('message').textContent]";
    let said = browser.page(&path, "", expression);
    let same = |text: &serde_json::Value| text.as_str().is_some_and(|text| text.contains(hostile));
    assert!(same(&said[0]) && same(&said[1]) && same(&said[2]), "names are shown as they are: {said}");
    assert_eq!([&said[3], &said[4]], [0, 2], "{said}");
    assert_eq!(said[5], "");
}
