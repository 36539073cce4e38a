//! How exactly the normal map of Khronos' NormalTangentTest says what its reliefs are: its texels, at their own centres,
//! against the normals of the relief above the same point of the quad.
//!
//! No filter and no shader enters, so this is a floor: a renderer that shows the map as it is cannot be nearer to the
//! relief than this at those points. `normal_tangent` measures what the shader shows.

use std::collections::HashMap;

use glam::{DMat2, DVec2, DVec3};
use halfvector_graph::document::SocketRef;
use halfvector_graph::value::Value;
use halfvector_maps::Image;
use halfvector_scene::{Mesh, Scene};

use crate::support::data;

/// From a relief to its quad, along x [m].
const OFFSET: f64 = 0.32;
/// The least width and height by which a triangle of a quad is known: those of the reliefs are far shorter [m].
const QUAD: f64 = 0.25;
/// The outermost part of a quad that is left out, as in `normal_tangent` [m].
const RIM: f64 = 0.012;
/// Side of a cell of the grid in which reliefs are looked up [m].
const CELL: f64 = 0.01;

struct Reliefs<'a> {
    mesh: &'a Mesh,
    by_cell: HashMap<[i64; 2], Vec<usize>>,
}

fn corners(mesh: &Mesh, triangle: usize) -> [usize; 3] {
    [0, 1, 2].map(|k| mesh.indices[3 * triangle + k] as usize)
}

fn position(mesh: &Mesh, vertex: usize) -> DVec3 {
    DVec3::from(mesh.positions[vertex].map(f64::from))
}

fn cell(p: DVec2) -> [i64; 2] {
    (p / CELL).floor().to_array().map(|c| c as i64)
}

impl<'a> Reliefs<'a> {
    /// All triangles that face +Z.
    fn of(mesh: &'a Mesh) -> Self {
        let mut by_cell: HashMap<_, Vec<_>> = HashMap::new();
        for triangle in 0..mesh.indices.len() / 3 {
            let [a, b, c] = corners(mesh, triangle).map(|v| position(mesh, v).truncate());
            let [low, high] = [cell(a.min(b).min(c)), cell(a.max(b).max(c))];
            if (b - a).perp_dot(c - a) <= 1e-12 {
                continue;
            }
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    by_cell.entry([x, y]).or_default().push(triangle);
                }
            }
        }
        Self { mesh, by_cell }
    }

    /// The shading normal of the topmost relief at a point of the plane.
    fn normal(&self, p: DVec2) -> Option<DVec3> {
        let mut top: Option<(f64, DVec3)> = None;
        for &triangle in self.by_cell.get(&cell(p))? {
            let vertices = corners(self.mesh, triangle);
            let at = vertices.map(|v| position(self.mesh, v));
            let [a, b, c] = at.map(|p| p.truncate());
            let area = (b - a).perp_dot(c - a);
            let [u, v] = [(p - a).perp_dot(c - a) / area, (b - a).perp_dot(p - a) / area];
            let weights = [1.0 - u - v, u, v];
            if weights.iter().any(|w| *w < -1e-9) {
                continue;
            }
            let mix = |of: [DVec3; 3]| of.iter().zip(weights).map(|(x, w)| *x * w).sum::<DVec3>();
            let z = mix(at).z;
            if top.is_none_or(|(height, _)| z > height) {
                top = Some((z, mix(vertices.map(|v| DVec3::from(self.mesh.normals[v].map(f64::from))))));
            }
        }
        top.map(|(_, normal)| normal.normalize())
    }
}

/// Calls `each` with the angle [degrees] between relief and map at every texel centre of one triangle of a quad.
fn compare(reliefs: &Reliefs, triangle: usize, map: &Image, each: &mut impl FnMut(f64)) {
    let mesh = reliefs.mesh;
    let vertices = corners(mesh, triangle);
    let [a, b, c] = vertices.map(|v| position(mesh, v).truncate());
    let size = DVec2::new(f64::from(map.width()), f64::from(map.height()));
    let [ta, tb, tc] = vertices.map(|v| DVec2::from(mesh.uv0[v].map(f64::from)) * size);
    let texels = DMat2::from_cols(tb - ta, tc - ta);
    let position_by_texel = DMat2::from_cols(b - a, c - a) * texels.inverse();
    // Texture coordinates grow downwards and +Y of the map upwards.
    let [tangent, bitangent] = [position_by_texel.x_axis, -position_by_texel.y_axis].map(|d| d.normalize());
    let [low, high] = [a.min(b).min(c), a.max(b).max(c)];
    let [first, last] = [ta.min(tb).min(tc), ta.max(tb).max(tc)].map(|t| t.floor().as_u64vec2());
    for row in first.y..=last.y {
        for column in first.x..=last.x {
            let texel = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let weights = texels.inverse() * (texel - ta);
            let p = a + position_by_texel * (texel - ta);
            let is_inside = weights.min_element() >= 0.0 && weights.element_sum() <= 1.0;
            if !is_inside || (p - low).min_element() < RIM || (high - p).min_element() < RIM {
                continue;
            }
            let Some(relief) = reliefs.normal(p - DVec2::X * OFFSET) else { continue };
            let [x, y, z, _] = map.texel(column as u32 % map.width(), row as u32 % map.height());
            let [x, y, z] = [x, y, z].map(|c| 2.0 * f64::from(c) - 1.0);
            let shown = (tangent * x + bitangent * y).extend(z);
            each(relief.cross(shown).length().atan2(relief.dot(shown)).to_degrees());
        }
    }
}

#[test]
fn texels_of_the_map_are_as_near_as_four_degrees_to_the_relief() {
    let Some(path) = data("models/NormalTangentTest.glb") else { return };
    let scene = Scene::from_model(&path).unwrap_or_else(|e| panic!("{e}"));
    let material = &scene.materials[0];
    let graph = &material.document.graph;
    let (surface, _) = graph.nodes.iter().find(|(_, n)| n.node == "surface/surface").expect("a surface");
    let normal_map = &graph.incoming(&SocketRef::new(surface, "normal")).expect("a normal map").node;
    let image = &graph.incoming(&SocketRef::new(normal_map, "color")).expect("an image").node;
    let Some(Value::Image(image)) = graph.nodes[image].values.get("image") else { panic!("no picture in {image}") };
    let map = scene.images.get(&material.directory, image).expect("the map is loaded");

    let mesh = &*scene.meshes[0];
    let reliefs = Reliefs::of(mesh);
    let (mut count, mut sum, mut max, mut above) = (0.0, 0.0, 0.0_f64, 0.0);
    for triangle in 0..mesh.indices.len() / 3 {
        let [a, b, c] = corners(mesh, triangle).map(|v| position(mesh, v));
        let extent = a.max(b).max(c) - a.min(b).min(c);
        if extent.truncate().min_element() < QUAD || extent.z > 1e-4 {
            continue;
        }
        compare(&reliefs, triangle, map, &mut |angle| {
            (count, sum, max) = (count + 1.0, sum + angle, max.max(angle));
            above += f64::from(u8::from(angle > 3.0));
        });
    }
    let (mean, above) = (sum / count, 100.0 * above / count);
    println!("{count} texels of the map: mean {mean:.3}, max {max:.3} degrees off the relief, {above:.3} % above 3");
    // The map alone, read without any error, is more than 3 degrees off somewhere: no shader can be held to that there.
    assert!(count > 6e5 && mean < 0.3 && (3.0..4.0).contains(&max) && above < 0.05);
}
