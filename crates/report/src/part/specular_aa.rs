//! Specular anti-aliasing: what one sample for each pixel misses of a highlight, by method. Pictures of one sample against the
//! mean of many, in linear radiance, of metals on which the normal turns within the pixel: a small sphere, and bumps.

use glam::Vec3;
use halfvector_codegen::Fold;
use halfvector_graph::document::{Document, Link, Node, SocketRef};
use halfvector_graph::method::term;
use halfvector_graph::value::Value;
use halfvector_raster::{RasterOptions, draw};
use halfvector_scene::light::parse_light;
use halfvector_scene::{Background, BuiltinMesh, EnvironmentSource, MeshSource, Scene};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

use crate::error::Errors;
use crate::{Effort, Row, Run};

const TERM: &str = "specular_aa";

/// Pixels along a side.
const SIZE: u32 = 32;

/// Where the sun stands, one picture for each: where a highlight lies between pixels is chance.
const SUNS: [&str; 5] = ["0.3,0.4,1", "-0.5,0.1,1", "0.1,-0.55,1", "-0.2,0.33,1", "0.62,-0.21,1"];

const ROUGHNESS: [f64; 2] = [0.15, 0.3];

/// A function of a document: waves as a normal map has them.
const BUMPS: &str = include_str!("../../data/bumps.wgsl");

/// What is drawn: its name, its shape, whether it has bumps, and how far away it is.
const PLACES: [(&str, BuiltinMesh, bool, f32); 3] = [
    ("sphere of 12 pixels", BuiltinMesh::Sphere, false, 10.0),
    ("bumps of 3 pixels", BuiltinMesh::Plane, true, 5.0),
    ("bumps of 2 pixels", BuiltinMesh::Plane, true, 8.0),
];

/// Measures the part: a row for each method on each thing that is drawn, the default first.
pub fn rows(run: &Run<'_>) -> Vec<Row> {
    let effort = run.effort();
    let cases: Vec<_> = PLACES.into_iter().flat_map(|place| ROUGHNESS.map(|roughness| (place, roughness))).collect();
    // Nothing is timed, and a picture is drawn by one thread.
    let finished: Mutex<Vec<(usize, Vec<Row>)>> = Mutex::default();
    let in_order = |finished: &[(usize, Vec<Row>)]| -> Vec<Row> {
        (0..cases.len())
            .filter_map(|number| finished.iter().find(|(own, _)| *own == number))
            .flat_map(|(_, rows)| rows.clone())
            .collect()
    };
    cases.par_iter().enumerate().for_each(|(number, &((name, mesh, bumpy, distance), roughness))| {
        let what = format!("{name}, roughness {roughness}");
        let rows = scene(mesh, bumpy, roughness, distance).and_then(|scene| methods(scene, &what, effort));
        let mut finished = finished.lock().unwrap_or_else(PoisonError::into_inner);
        match rows {
            Some(rows) => finished.push((number, rows)),
            None => run.leave_out(TERM, Some(&what), "it could not be drawn".to_owned()),
        }
        run.keep(&in_order(&finished), finished.len() as f64 / cases.len() as f64);
    });
    in_order(&finished.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A metal of this roughness in the dark, bumpy or smooth, this far away.
fn scene(mesh: BuiltinMesh, bumpy: bool, roughness: f64, distance: f32) -> Option<Scene> {
    let mut document = Document::with_surface("bumps");
    let surface = document.graph.nodes.get_mut("surface")?;
    surface.values.insert("metallic".into(), Value::Number(1.0));
    surface.values.insert("perceptual_roughness".into(), Value::Number(roughness as f32));
    if bumpy {
        document.functions.insert("bumps".into(), BUMPS.into());
        document.graph.nodes.insert("waves".into(), Node::new("custom/bumps"));
        document.graph.nodes.insert("map".into(), Node::new("textures/normal_map"));
        for (from, to) in [("waves", ("map", "color")), ("map", ("surface", "normal"))] {
            document.graph.links.push(Link::new(SocketRef::new(from, "out"), SocketRef::new(to.0, to.1)));
        }
    }
    let mut scene = Scene::from_material(document, std::path::Path::new(""), &MeshSource::Builtin(mesh)).ok()?;
    (scene.environment, scene.background) = (EnvironmentSource::None, Background::None);
    // Not quite on the axis: there the sphere's highlights would lie as symmetrically as pixels do.
    scene.camera.position = Vec3::new(0.013, 0.007, distance);
    Some(scene)
}

/// Radiance and coverage of each pixel.
fn drawn(scene: &Scene, samples_per_side: u32) -> Option<Vec<[f32; 4]>> {
    let options = RasterOptions { width: SIZE, height: SIZE, samples_per_side, fold: Fold::Export };
    Some(draw::<f32>(scene, None, &options, |_| {}).ok()?.pixels)
}

/// The errors of each method on covered pixels, over all suns, beside the mean of what many samples give. The metal is grey: one channel
/// tells of all.
fn methods(mut scene: Scene, what: &str, effort: Effort) -> Option<Vec<Row>> {
    let (suns, many) = (effort.pick(2, SUNS.len()), effort.pick(8, 16) as u32);
    let names: Vec<&str> = term(TERM)?.methods.iter().map(|method| method.name).collect();
    // In units of radiance as yet: the mean is known when all is drawn.
    let mut differences = vec![Vec::<(f64, usize)>::new(); names.len()];
    let (mut sum, mut count) = (0.0, 0.0);
    for (number, sun) in SUNS[..suns].iter().enumerate() {
        scene.lights = vec![parse_light(&format!("directional:{sun}:3")).ok()?];
        scene.methods.set(TERM, "none").ok()?;
        let truth = drawn(&scene, many)?;
        let covered: Vec<usize> = (0..truth.len()).filter(|&pixel| truth[pixel][3] == 1.0).collect();
        let gray = |pixels: &[[f32; 4]], pixel: usize| f64::from(pixels[pixel][0]);
        sum += covered.iter().map(|&pixel| gray(&truth, pixel)).sum::<f64>();
        count += covered.len() as f64;
        for (name, differences) in names.iter().zip(&mut differences) {
            scene.methods.set(TERM, name).ok()?;
            let one = drawn(&scene, 1)?;
            let difference = |&pixel: &usize| (gray(&one, pixel) - gray(&truth, pixel), number * truth.len() + pixel);
            differences.extend(covered.iter().map(difference));
        }
    }
    let mean = sum / f64::max(count, 1.0);
    let domain = format!(
        "{what}: a metal under {suns} suns one after the other, {SIZE} x {SIZE} pixels of one sample; relative to the mean radiance of the \
         mean of {} samples a pixel",
        many * many
    );
    let row = |(name, differences): (&&str, &Vec<(f64, usize)>)| {
        let mut errors = Errors::default();
        for &(difference, place) in differences {
            let (sun, pixel) = (place / (SIZE * SIZE) as usize, place % (SIZE * SIZE) as usize);
            let (column, line) = (pixel % SIZE as usize, pixel / SIZE as usize);
            errors.add(difference / mean, || format!("sun = [{}], column = {column}, row = {line}", SUNS[sun]));
        }
        let mut row = Row::new(TERM, name, &domain);
        errors.fill(&mut row);
        row
    };
    Some(names.iter().zip(&differences).map(row).collect())
}
