//! The built-in shapes: closed formulas, fine enough to be displaced by a height map.
//!
//! On all of them (0, 0) of the texture coordinates is the top left of a picture that stands upright and unmirrored
//! where the shape faces the default camera at (0, 0, 5).

use glam::{Mat4, Quat};

use super::revolve::{ProfilePoint, add_grid, add_revolved, arc, smooth_profile};
use super::{Mesh, MeshData};

/// A built-in shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BuiltinMesh {
    /// Unit sphere at the origin; the picture's middle is at +Z, its seam at -Z, its top edge the pole at +Y.
    Sphere,
    /// From (-1, -1, 0) to (1, 1, 0), facing +Z.
    Plane,
    /// Edge 1.4 about the origin; each face shows the whole picture, upright on the four sides, with the top's lower
    /// edge and the bottom's upper edge towards +Z.
    Cube,
    /// About the Z axis: a ring that faces +Z, radius 0.7 to the tube's middle and tube radius 0.3; u runs clockwise
    /// as seen from +Z with the seam below, v around the tube from behind over the outside.
    Torus,
    /// A shell over a core on a stand, 2 high: parts `ball`, `core` and `stand`.
    Shaderball,
}

/// A part of a shape that may have its own material.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its name in scene files.
    pub name: &'static str,
    /// Its surface.
    pub mesh: Mesh,
    /// Whether a material given for the whole shape goes here; the other parts stay neutral grey.
    pub takes_material: bool,
}

impl BuiltinMesh {
    /// All, in the order shown.
    pub const ALL: [BuiltinMesh; 5] =
        [BuiltinMesh::Sphere, BuiltinMesh::Plane, BuiltinMesh::Cube, BuiltinMesh::Torus, BuiltinMesh::Shaderball];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            BuiltinMesh::Sphere => "sphere",
            BuiltinMesh::Plane => "plane",
            BuiltinMesh::Cube => "cube",
            BuiltinMesh::Torus => "torus",
            BuiltinMesh::Shaderball => "shaderball",
        }
    }

    /// The shape with this name.
    pub fn from_name(name: &str) -> Option<BuiltinMesh> {
        BuiltinMesh::ALL.into_iter().find(|m| m.name() == name)
    }

    /// How a bare material shows it: the cube and the torus turned so that they are seen as solids.
    pub fn preview_transform(self) -> Mat4 {
        let turned = |x: f32, y: f32| {
            Mat4::from_quat(Quat::from_rotation_x(x.to_radians()) * Quat::from_rotation_y(y.to_radians()))
        };
        match self {
            BuiltinMesh::Cube => turned(28.0, -35.0),
            BuiltinMesh::Torus => turned(-40.0, 0.0),
            BuiltinMesh::Sphere | BuiltinMesh::Plane | BuiltinMesh::Shaderball => Mat4::IDENTITY,
        }
    }

    /// Its parts.
    pub fn parts(self) -> Vec<Part> {
        let whole = |data: MeshData| vec![part(self.name(), data, true)];
        match self {
            BuiltinMesh::Sphere => whole(sphere(256, 128)),
            BuiltinMesh::Plane => whole(plane(256)),
            BuiltinMesh::Cube => whole(cube(96)),
            BuiltinMesh::Torus => whole(torus(256, 96)),
            BuiltinMesh::Shaderball => shaderball(192),
        }
    }
}

fn part(name: &'static str, data: MeshData, takes_material: bool) -> Part {
    let mesh = Mesh::build(data).expect("a built-in shape is sound: a test builds each");
    Part { name, mesh, takes_material }
}

fn sphere(segments: usize, rows: usize) -> MeshData {
    let profile: Vec<ProfilePoint> = (0..=rows)
        .map(|row| {
            let v = row as f64 / rows as f64;
            let (sin, cos) = (std::f64::consts::PI * v).sin_cos();
            let radius = if row == 0 || row == rows { 0.0 } else { sin };
            ProfilePoint { radius, height: cos, normal: [radius, cos], v }
        })
        .collect();
    let mut data = MeshData::default();
    add_revolved(&mut data, segments, &profile);
    data
}

fn plane(quads: usize) -> MeshData {
    let mut data = MeshData::default();
    let at = |i: usize| 2.0 * i as f64 / quads as f64 - 1.0;
    add_grid(&mut data, [quads; 2], |column, row| ([at(column), -at(row), 0.0], [0.0, 0.0, 1.0]));
    data
}

fn cube(quads: usize) -> MeshData {
    const HALF: f64 = 0.7;
    // Of each face: outward normal, direction of u, direction of v.
    const FACES: [[[f64; 3]; 3]; 6] = [
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
        [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]],
        [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
        [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
    ];
    let mut data = MeshData::default();
    let at = |i: usize| 2.0 * i as f64 / quads as f64 - 1.0;
    for [normal, along_u, along_v] in FACES {
        add_grid(&mut data, [quads; 2], |column, row| {
            let (u, v) = (at(column), at(row));
            (std::array::from_fn(|i| HALF * (normal[i] + u * along_u[i] + v * along_v[i])), normal)
        });
    }
    data
}

fn torus(segments: usize, tube_segments: usize) -> MeshData {
    const MAJOR: f64 = 0.7;
    const MINOR: f64 = 0.3;
    let turn = |i: usize, n: usize| 2.0 * std::f64::consts::PI * ((i % n) as f64 / n as f64 - 0.5);
    let mut data = MeshData::default();
    add_grid(&mut data, [segments, tube_segments], |column, row| {
        // 0 at the top of the ring, growing clockwise; 0 at the front of the tube, growing inwards.
        let (ring_sin, ring_cos) = turn(column, segments).sin_cos();
        let (tube_sin, tube_cos) = turn(row, tube_segments).sin_cos();
        let out = [ring_sin, ring_cos];
        let radius = MAJOR - MINOR * tube_sin;
        ([radius * out[0], radius * out[1], MINOR * tube_cos], [-tube_sin * out[0], -tube_sin * out[1], tube_cos])
    });
    data
}

/// A sphere of radius 0.75 about (0, 0.25, 0), cut open by a groove through which the core shows, on a flared stand that
/// reaches down to y = -1. Every edge is rounded, so that it catches light.
fn shaderball(segments: usize) -> Vec<Part> {
    const CENTER: [f64; 2] = [0.0, 0.25];
    const RADIUS: f64 = 0.75;
    const LIP: f64 = 0.025;
    // The middle of the lip's arc for an edge of the shell at this angle from the top.
    let lip_center = |angle: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        [CENTER[0] + (RADIUS - LIP) * sin, CENTER[1] + (RADIUS - LIP) * cos]
    };
    let (upper, lower) = (104.0, 122.0);

    let mut shell = arc(CENTER, RADIUS, 0.0, upper, 112);
    shell.extend(arc(lip_center(upper), LIP, upper, upper + 180.0, 12).into_iter().skip(1));
    let mut bowl = arc(lip_center(lower), LIP, lower - 180.0, lower, 12);
    bowl.extend(arc(CENTER, RADIUS, lower, 180.0, 72).into_iter().skip(1));
    let mut ball = MeshData::default();
    add_revolved(&mut ball, segments, &smooth_profile(&shell));
    add_revolved(&mut ball, segments, &smooth_profile(&bowl));

    let mut core = MeshData::default();
    add_revolved(&mut core, segments, &smooth_profile(&arc(CENTER, RADIUS - LIP, 90.0, 136.0, 32)));

    // From the neck, hidden in the ball, out over a hollow flare to a rounded rim and back to the axis below.
    let mut stand = arc([0.62, -0.42], 0.42, 270.0, 180.0, 40);
    stand.extend(arc([0.62, -0.92], 0.08, 0.0, 90.0, 12).into_iter().skip(1));
    stand.extend(arc([0.66, -0.96], 0.04, 90.0, 180.0, 8));
    stand.push([0.0, -1.0]);
    let mut base = MeshData::default();
    add_revolved(&mut base, segments, &smooth_profile(&stand));

    vec![part("ball", ball, true), part("core", core, false), part("stand", base, false)]
}
