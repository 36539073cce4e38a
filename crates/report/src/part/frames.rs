//! Normal mapping on meshes: the angle between what each frame makes of a texel and what the surface says, on shapes that a mesh
//! only stands for, unwrapped evenly, mirrored, and scaled unevenly.
//!
//! The truth is the limit of fine geometry: the exact surface's tangents, p_u and p_v, made square to its exact normal, carried
//! by the object's matrix. Positions, normals and texture coordinates are a mesh's: exact at vertices, interpolated between.

use halfvector_maps::derivative::normal_tbn_derivative;
use halfvector_maps::frame::{normal_from_object, transformed};
use halfvector_maps::normal::{normal_rotation_fixed, normal_rotation_report, normal_tbn};
use halfvector_maps::tangents;

use rayon::prelude::*;

use super::ibl::unit;
use super::texels::degrees_between;
use crate::search::Search;
use crate::{Effort, Row};

type Vector = [f64; 3];

/// A surface over texture coordinates, and the object's matrix.
struct Shape {
    name: &'static str,
    /// Where a pair of parameters in 0..1 lies.
    position: fn([f64; 2]) -> Vector,
    /// The texture coordinates of the parameters.
    uv: fn([f64; 2]) -> [f64; 2],
    world_from_object: [Vector; 3],
}

const AS_IT_IS: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const STRETCHED: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.5]];

/// A part of a sphere, away from its poles.
fn ball([s, t]: [f64; 2]) -> Vector {
    let (phi, theta) = (2.5 * (s - 0.5), 1.0 + 1.2 * t);
    [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()]
}

fn flat([s, t]: [f64; 2]) -> Vector {
    [2.0 * s - 1.0, 1.0 - 2.0 * t, 0.0]
}

/// Saddle: bent both ways.
fn saddle([s, t]: [f64; 2]) -> Vector {
    let [x, y] = [2.0 * s - 1.0, 1.0 - 2.0 * t];
    [x, y, 0.4 * (x * x - y * y) + 0.2 * x * y]
}

fn plain(st: [f64; 2]) -> [f64; 2] {
    st
}

/// u runs the other way.
fn mirrored([s, t]: [f64; 2]) -> [f64; 2] {
    [1.0 - s, t]
}

/// Squeezed and skewed, as unwrapped charts are.
fn skewed([s, t]: [f64; 2]) -> [f64; 2] {
    [s + 0.4 * t, 0.6 * t + 0.15 * s * s]
}

const SHAPES: &[Shape] = &[
    Shape { name: "flat", position: flat, uv: plain, world_from_object: AS_IT_IS },
    Shape { name: "flat, skewed coordinates", position: flat, uv: skewed, world_from_object: AS_IT_IS },
    Shape { name: "ball", position: ball, uv: plain, world_from_object: AS_IT_IS },
    Shape { name: "ball, mirrored coordinates", position: ball, uv: mirrored, world_from_object: AS_IT_IS },
    Shape { name: "ball scaled by 1, 3 and 0.5", position: ball, uv: plain, world_from_object: STRETCHED },
    Shape { name: "saddle, skewed coordinates", position: saddle, uv: skewed, world_from_object: AS_IT_IS },
];

/// Squares along a side of the mesh.
const SQUARES: usize = 12;

/// A frame by name.
const FRAMES: [&str; 5] =
    ["tbn, exact tangents interpolated", "tbn", "tbn_derivative", "rotation_report", "rotation_fixed"];

/// Tilts of texels from straight up [deg].
const TILTS: [f64; 3] = [10.0, 30.0, 60.0];

/// How much is searched for the largest error of a frame.
const SEARCH: Search = Search { starts: 10, rounds: 10 };

/// One row for each frame on each shape and tilt.
pub(super) fn rows(effort: Effort) -> Vec<Row> {
    SHAPES.par_iter().flat_map_iter(|shape| shape.rows(effort.pick(2000, 16_000))).collect()
}

/// What a vertex has.
#[derive(Clone, Copy)]
struct Vertex {
    position: Vector,
    normal: Vector,
    /// Exact, and by MikkTSpace.
    tangents: [[f64; 4]; 2],
    uv: [f64; 2],
    /// The place on the surface, for the truth.
    place: [f64; 2],
}

impl Shape {
    /// p_u, p_v by texture coordinates, and the unit normal, towards the viewer as triangles are.
    fn exact(&self, st: [f64; 2]) -> [Vector; 3] {
        const STEP: f64 = 1e-5;
        let by = |k: usize| {
            let moved = |sign: f64| std::array::from_fn(|i| st[i] + if i == k { sign * STEP } else { 0.0 });
            let (a, b): ([f64; 2], [f64; 2]) = (moved(1.0), moved(-1.0));
            let (p, q) = ((self.position)(a), (self.position)(b));
            let (u, v) = ((self.uv)(a), (self.uv)(b));
            let slope: Vector = std::array::from_fn(|i| (p[i] - q[i]) / (2.0 * STEP));
            (slope, [(u[0] - v[0]) / (2.0 * STEP), (u[1] - v[1]) / (2.0 * STEP)])
        };
        let ((p_s, [u_s, v_s]), (p_t, [u_t, v_t])) = (by(0), by(1));
        let d = u_s * v_t - u_t * v_s;
        let p_u = std::array::from_fn(|i| (p_s[i] * v_t - p_t[i] * v_s) / d);
        let p_v = std::array::from_fn(|i| (p_t[i] * u_s - p_s[i] * u_t) / d);
        // t runs down.
        [p_u, p_v, unit(cross(p_t, p_s))]
    }

    fn mesh(&self) -> (Vec<Vertex>, Vec<u32>) {
        let n = SQUARES + 1;
        let mut vertices: Vec<Vertex> = (0..n * n)
            .map(|k| {
                let place = [k % n, k / n].map(|i| i as f64 / SQUARES as f64);
                let [p_u, p_v, normal] = self.exact(place);
                let tangent = square_to(p_u, normal);
                // v runs down the picture, against the bitangent.
                let handed = if dot(cross(normal, tangent), p_v) > 0.0 { -1.0 } else { 1.0 };
                let [x, y, z] = tangent;
                Vertex {
                    position: (self.position)(place),
                    normal,
                    tangents: [[x, y, z, handed]; 2],
                    uv: (self.uv)(place),
                    place,
                }
            })
            .collect();
        let square = |k: usize| {
            let a = (k / SQUARES * n + k % SQUARES) as u32;
            [a, a + n as u32, a + 1, a + 1, a + n as u32, a + n as u32 + 1]
        };
        let indices: Vec<u32> = (0..SQUARES * SQUARES).flat_map(square).collect();
        let narrow = |v: Vector| v.map(|x| x as f32);
        let positions: Vec<_> = vertices.iter().map(|v| narrow(v.position)).collect();
        let normals: Vec<_> = vertices.iter().map(|v| narrow(v.normal)).collect();
        let uvs: Vec<_> = vertices.iter().map(|v| v.uv.map(|x| x as f32)).collect();
        for (vertex, made) in vertices.iter_mut().zip(tangents(&positions, &normals, &uvs, &indices)) {
            vertex.tangents[1] = made.map(f64::from);
        }
        (vertices, indices)
    }

    fn rows(&self, points: usize) -> Vec<Row> {
        let (vertices, indices) = self.mesh();
        let triangles: Vec<[Vertex; 3]> =
            indices.chunks_exact(3).map(|t| [0, 1, 2].map(|i| vertices[t[i] as usize])).collect();
        // A place on the surface and an azimuth, each 0..1.
        let at = |[s, t, turn]: [f64; 3]| {
            let (triangle, weights) = on_mesh([s, t]);
            (&triangles[triangle], weights, std::f64::consts::TAU * turn)
        };
        let mut rows = Vec::new();
        for tilt in TILTS {
            let (sine, cosine) = tilt.to_radians().sin_cos();
            let angles = |place: [f64; 3]| -> [f64; FRAMES.len()] {
                let (triangle, weights, azimuth) = at(place);
                let texel = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
                let truth = self.truth(triangle, weights, texel);
                self.found(triangle, weights, texel).map(|n| degrees_between(n, truth))
            };
            let said = |[s, t, turn]: [f64; 3]| format!("place = [{s:?}, {t:?}], azimuth = {:?} deg", 360.0 * turn);
            let place = |k: usize| {
                [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3]
                    .map(|step| (0.5 + step * k as f64).fract())
            };
            let drawn: Vec<_> = (0..points).map(|k| (place(k), angles(place(k)))).collect();
            let errors: [_; FRAMES.len()] = std::array::from_fn(|frame| {
                let own: Vec<_> = drawn.iter().map(|(place, angles)| (*place, angles[frame])).collect();
                SEARCH.errors_of(own, |place| angles(place)[frame], said)
            });
            let domain = format!(
                "{}, texels tilted by {tilt} deg: a mesh of {SQUARES} x {SQUARES} squares, all azimuths; angle to the exact \
                 surface's normal in degrees",
                self.name
            );
            rows.extend(FRAMES.iter().zip(errors).map(|(name, errors)| {
                let mut row = Row::new("normal_frame", name, &domain);
                errors.fill(&mut row);
                row
            }));
        }
        rows
    }

    /// The normal that the texel means, by the exact surface below the point of the triangle.
    fn truth(&self, triangle: &[Vertex; 3], weights: Vector, texel: Vector) -> Vector {
        let place = [0, 1].map(|i| (0..3).map(|k| weights[k] * triangle[k].place[i]).sum::<f64>());
        let [p_u, p_v, normal] = self.exact(place);
        let m = self.world_from_object;
        let normal = unit(transformed(normal_from_object(m), normal));
        let tangent = square_to(transformed(m, p_u), normal);
        let bitangent = cross(normal, tangent);
        let against = if dot(bitangent, transformed(m, p_v)) > 0.0 { -1.0 } else { 1.0 };
        let n =
            std::array::from_fn(|i| texel[0] * tangent[i] + texel[1] * against * bitangent[i] + texel[2] * normal[i]);
        unit(n)
    }

    /// What each of [`FRAMES`] makes of it, from what a fragment stage is given.
    fn found(&self, triangle: &[Vertex; 3], weights: Vector, texel: Vector) -> [Vector; FRAMES.len()] {
        let m = self.world_from_object;
        let mixed = |of: &dyn Fn(&Vertex) -> Vector| -> Vector {
            std::array::from_fn(|i| (0..3).map(|k| weights[k] * of(&triangle[k])[i]).sum())
        };
        let carried = normal_from_object(m);
        let normal = unit(mixed(&|v| unit(transformed(carried, v.normal))));
        let tbn = |which: usize| {
            let [x, y, z] = mixed(&|v| {
                let [x, y, z, _] = v.tangents[which];
                unit(transformed(m, [x, y, z]))
            });
            normal_tbn(texel, normal, [x, y, z, triangle[0].tangents[which][3]])
        };
        let edge = |k: usize| {
            let (a, b) = (transformed(m, triangle[0].position), transformed(m, triangle[k].position));
            let p: Vector = std::array::from_fn(|i| b[i] - a[i]);
            (p, [0, 1].map(|i| triangle[k].uv[i] - triangle[0].uv[i]))
        };
        // Any two directions of the screen have the same derivatives in them: the triangle's edges are taken.
        let ((p_x, uv_x), (p_y, uv_y)) = (edge(1), edge(2));
        [
            tbn(0),
            tbn(1),
            normal_tbn_derivative(texel, p_x, p_y, normal, uv_x, uv_y),
            normal_rotation_report(texel, normal),
            normal_rotation_fixed(texel, normal),
        ]
    }
}

/// The triangle of a mesh at a place in 0..1, by its number, and the weights of its corners there.
fn on_mesh(place: [f64; 2]) -> (usize, Vector) {
    let corner = place.map(|x| ((x * SQUARES as f64) as usize).min(SQUARES - 1));
    let [x, y] = [0, 1].map(|i| place[i] * SQUARES as f64 - corner[i] as f64);
    let square = 2 * (corner[1] * SQUARES + corner[0]);
    if x + y <= 1.0 { (square, [1.0 - x - y, y, x]) } else { (square + 1, [1.0 - y, 1.0 - x, x + y - 1.0]) }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector along `v` and square to the unit normal.
fn square_to(v: Vector, normal: Vector) -> Vector {
    let along = dot(v, normal);
    unit(std::array::from_fn(|i| v[i] - along * normal[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place of a mesh is where the weights of the triangle's corners say.
    #[test]
    fn places_lie_in_their_triangles() {
        let (vertices, indices) = SHAPES[0].mesh();
        for place in [[0.0, 0.0], [0.51, 0.26], [0.999, 0.998], [1.0, 1.0], [0.08, 0.07]] {
            let (triangle, weights) = on_mesh(place);
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12 && weights.iter().all(|w| *w >= -1e-12));
            let corners = &indices[3 * triangle..][..3];
            for i in 0..2 {
                let there: f64 = corners.iter().zip(weights).map(|(&c, w)| w * vertices[c as usize].place[i]).sum();
                assert!((there - place[i]).abs() < 1e-9, "{place:?}: {there}");
            }
        }
    }

    /// Ten times as many places and azimuths, drawn by chance, find nothing that errs more, but for a little.
    #[test]
    fn largest_angles_are_the_largest() {
        let mut state = 5_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let shape = &SHAPES[5];
        let rows = shape.rows(2000);
        let (vertices, indices) = shape.mesh();
        let (sine, cosine) = TILTS[1].to_radians().sin_cos();
        let mut most = [0.0_f64; FRAMES.len()];
        for _ in 0..20_000 {
            let (triangle, weights) = on_mesh([number(), number()]);
            let triangle: [Vertex; 3] = [0, 1, 2].map(|i| vertices[indices[3 * triangle + i] as usize]);
            let azimuth = std::f64::consts::TAU * number();
            let texel = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
            let truth = shape.truth(&triangle, weights, texel);
            for (most, n) in most.iter_mut().zip(shape.found(&triangle, weights, texel)) {
                *most = most.max(degrees_between(n, truth));
            }
        }
        for (method, most) in FRAMES.iter().zip(most) {
            let is_own = |row: &&Row| row.method == *method && row.domain.contains("tilted by 30 deg");
            let said = rows.iter().find(is_own).and_then(|row| row.error_max).expect("a row");
            assert!(said >= 0.97 * most, "{method}: {said}, but {most}");
        }
    }

    /// Tangent frames are exact where the mesh is the surface, and stay near it where it is bent; rotations go astray
    /// on every shape but one that faces +Z.
    #[test]
    fn tangent_frames_follow_the_surface() {
        let rows = rows(Effort::Quick);
        let worst = |method: &str, shape: &str| {
            let those = rows.iter().filter(|row| row.method == method && row.domain.starts_with(shape));
            those.filter_map(|row| row.error_max).fold(0.0, f64::max)
        };
        for method in &FRAMES[..3] {
            assert!(worst(method, "flat, texels") < 1e-3, "{method}: {}", worst(method, "flat, texels"));
            assert!(worst(method, "ball") < 15.0, "{method}: {}", worst(method, "ball"));
        }
        assert!(worst("rotation_report", "ball") > 60.0);
        assert_eq!(rows.len(), SHAPES.len() * TILTS.len() * FRAMES.len());
    }
}
