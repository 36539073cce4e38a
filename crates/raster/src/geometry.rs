//! From a mesh to triangles on the grid of samples: the vertex stage, clipping, snapping, culling.

use halfvector_codegen::reflection::Reflection;
use halfvector_interp::{Column, Derivatives, Float, Limits, OutputColumn, Outputs, Program, Resources, RunError};
use halfvector_scene::{FacePass, Mesh, Side};
use rayon::prelude::*;

use crate::program::{Part, parts};

/// Steps from sample to sample that corners are snapped to; a power of two, as on GPUs.
pub(crate) const SNAP: i64 = 256;

/// Farthest that a clipped corner lies from the first sample, in samples: products of two such distances, snapped, have
/// room in 64 bits.
const GUARD: f64 = (1 << 22) as f64;

/// Vertices that one thread takes at a time.
const VERTEX_CHUNK: usize = 4096;

/// The results of the vertex stage.
#[derive(Debug)]
pub(crate) struct Vertices {
    /// Clip position of each vertex.
    pub(crate) clip: Vec<[f64; 4]>,
    /// What goes to the fragment stage: (location, component) and a number for each vertex.
    pub(crate) varyings: Vec<((u32, usize), Vec<f64>)>,
}

/// A triangle with its corners on the grid, counter-clockwise or not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangle {
    /// Indices of the vertices of the triangle that it is, or is a part of.
    pub(crate) vertices: [u32; 3],
    /// Columns and rows of the corners in parts of [`SNAP`] of a sample, from the middle of the first sample, in the order
    /// that makes the area positive (rows go down).
    pub(crate) corners: [[i64; 2]; 3],
    /// Whether its front is seen.
    pub(crate) front: bool,
}

impl Vertices {
    /// Runs the vertex stage over a mesh, on all cores.
    pub(crate) fn run<F: Float>(
        program: &Program,
        reflection: &Reflection,
        mesh: &Mesh,
        resources: &Resources<'_>,
    ) -> Result<Vertices, RunError> {
        let columns: Vec<Vec<F>> = parts(program.inputs())
            .into_iter()
            .map(|part| match part {
                Part::Location(location, component) => {
                    let input = reflection.vertex_inputs.iter().find(|input| input.location == location);
                    input.map(|input| attribute(mesh, &input.name, component)).unwrap_or_default()
                }
                Part::Position(_) | Part::FrontFacing | Part::Other => Vec::new(),
            })
            .collect();
        let count = mesh.positions.len();
        let starts: Vec<usize> = (0..count).step_by(VERTEX_CHUNK).collect();
        let chunks = starts
            .par_iter()
            .map(|&start| {
                let lanes = VERTEX_CHUNK.min(count - start);
                let inputs: Vec<Column<'_, F>> = columns
                    .iter()
                    .map(|column| Column::Float(column.get(start..start + lanes).unwrap_or_default()))
                    .collect();
                let mut outputs = Outputs::default();
                program.run(&inputs, lanes, &mut outputs, resources, Derivatives::Zero, Limits::default())?;
                Ok(outputs.columns.iter().map(OutputColumn::to_f64).collect::<Vec<_>>())
            })
            .collect::<Result<Vec<_>, RunError>>()?;
        let mut vertices = Vertices { clip: vec![[0.0; 4]; count], varyings: Vec::new() };
        for (index, part) in parts(program.outputs()).into_iter().enumerate() {
            let all = chunks.iter().flat_map(|chunk| chunk[index].iter().copied());
            match part {
                Part::Position(component) => {
                    vertices.clip.iter_mut().zip(all).for_each(|(clip, x)| clip[component] = x);
                }
                Part::Location(location, component) => vertices.varyings.push(((location, component), all.collect())),
                Part::FrontFacing | Part::Other => {}
            }
        }
        Ok(vertices)
    }

    /// The triangles of a mesh that may be seen on a grid of `columns` x `rows` samples, in the mesh's order.
    pub(crate) fn triangles(&self, mesh: &Mesh, pass: FacePass, columns: u32, rows: u32) -> Vec<Triangle> {
        let grid = [f64::from(columns), f64::from(rows)];
        mesh.indices
            .par_chunks_exact(3)
            .flat_map_iter(|triangle| {
                let vertices = [triangle[0], triangle[1], triangle[2]];
                on_grid(vertices.map(|vertex| self.clip[vertex as usize]), grid)
                    .filter_map(move |corners| wound(vertices, corners, pass))
            })
            .collect()
    }
}

/// One component of an attribute for all vertices.
fn attribute<F: Float>(mesh: &Mesh, name: &str, component: usize) -> Vec<F> {
    fn column<F: Float, const N: usize>(all: &[[f32; N]], component: usize) -> Vec<F> {
        all.iter().map(|values| F::from_f64(f64::from(values[component]))).collect()
    }
    match name {
        "position" => column(&mesh.positions, component),
        "normal" => column(&mesh.normals, component),
        "tangent" => column(&mesh.tangents, component),
        "uv0" => column(&mesh.uv0, component),
        "uv1" => column(&mesh.uv1, component),
        "color" => column(&mesh.colors, component),
        _ => Vec::new(),
    }
}

/// The corners, snapped, of what is left of a triangle between the near plane (z = w), infinity (z = 0) and the guard: a fan.
fn on_grid(clip: [[f64; 4]; 3], grid: [f64; 2]) -> impl Iterator<Item = [[i64; 2]; 3]> {
    let guard = [2.0 * GUARD / grid[0] - 1.0, 2.0 * GUARD / grid[1] - 1.0];
    let polygon = clipped(clip, guard);
    let snapped: Vec<[i64; 2]> = polygon
        .iter()
        .map(|[x, y, _, w]| {
            let snap = |sample: f64| ((sample - 0.5) * SNAP as f64).round_ties_even() as i64;
            [snap((x / w * 0.5 + 0.5) * grid[0]), snap((0.5 - y / w * 0.5) * grid[1])]
        })
        .collect();
    (2..snapped.len()).map(move |i| [snapped[0], snapped[i - 1], snapped[i]])
}

/// The part of a triangle inside of all planes; empty for corners that are no numbers.
fn clipped(clip: [[f64; 4]; 3], guard: [f64; 2]) -> Vec<[f64; 4]> {
    let inside = |plane: usize, [x, y, z, w]: [f64; 4]| match plane {
        0 => w - z,
        1 => z,
        2 => guard[0] * w - x,
        3 => guard[0] * w + x,
        4 => guard[1] * w - y,
        _ => guard[1] * w + y,
    };
    if !clip.iter().flatten().all(|x| x.is_finite()) {
        return Vec::new();
    }
    let mut polygon = clip.to_vec();
    for plane in 0..6 {
        if polygon.iter().all(|&corner| inside(plane, corner) >= 0.0) {
            continue;
        }
        let before = std::mem::take(&mut polygon);
        for (i, &a) in before.iter().enumerate() {
            let b = before[(i + 1) % before.len()];
            let (in_a, in_b) = (inside(plane, a), inside(plane, b));
            if in_a >= 0.0 {
                polygon.push(a);
            }
            if (in_a >= 0.0) != (in_b >= 0.0) {
                // From the inner corner, so that triangles that share an edge are cut at the same point.
                let (from, to, t) =
                    if in_a >= 0.0 { (a, b, in_a / (in_a - in_b)) } else { (b, a, in_b / (in_b - in_a)) };
                polygon.push(std::array::from_fn(|k| from[k] + (to[k] - from[k]) * t));
            }
        }
    }
    // Where w is 0 so are x, y and z: a point without a place.
    if polygon.iter().any(|corner| corner[3] <= 0.0) { Vec::new() } else { polygon }
}

/// The triangle with a positive area, unless it has none or its side is left out.
fn wound(vertices: [u32; 3], corners: [[i64; 2]; 3], pass: FacePass) -> Option<Triangle> {
    let [a, b, c] = corners;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if area == 0 {
        return None;
    }
    // Rows go down: counter-clockwise triangles, which are fronts, have a negative area.
    let front = (area < 0) != pass.mirrored;
    let side = if front { Side::Front } else { Side::Back };
    let corners = if area > 0 { corners } else { [a, c, b] };
    (pass.cull != Some(side)).then_some(Triangle { vertices, corners, front })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PASS: FacePass = FacePass { mirrored: false, cull: Some(Side::Back), blend: false };

    fn clip(x: f64, y: f64, w: f64) -> [f64; 4] {
        [x * w, y * w, 0.1, w]
    }

    #[test]
    fn corners_are_snapped_around_the_middles_of_samples() {
        let all: Vec<_> =
            on_grid([clip(-1.0, 1.0, 1.0), clip(1.0, 1.0, 2.0), clip(-1.0, -1.0, 3.0)], [4.0, 8.0]).collect();
        assert_eq!(all, [[[-128, -128], [4 * 256 - 128, -128], [-128, 8 * 256 - 128]]]);
    }

    #[test]
    fn counter_clockwise_is_the_front() {
        let corners: Vec<_> =
            on_grid([clip(-1.0, -1.0, 1.0), clip(1.0, -1.0, 1.0), clip(0.0, 1.0, 1.0)], [8.0, 8.0]).collect();
        assert!(wound([0, 1, 2], corners[0], PASS).is_some_and(|triangle| triangle.front));
        let [a, b, c] = corners[0];
        assert!(wound([0, 2, 1], [a, c, b], PASS).is_none());
        let mirrored = FacePass { mirrored: true, ..PASS };
        assert!(wound([0, 1, 2], corners[0], mirrored).is_none());
        assert!(wound([0, 1, 1], [a, b, b], FacePass { cull: None, ..PASS }).is_none());
    }

    #[test]
    fn what_lies_before_the_near_plane_is_cut_off() {
        // One corner behind the camera: two are left of the edges' four ends, and the cuts lie at z = w.
        let polygon = clipped([[0.0, 0.0, 0.1, 1.0], [1.0, 0.0, 0.1, 1.0], [0.0, 1.0, 0.1, -1.0]], [1e6, 1e6]);
        assert_eq!(polygon.len(), 4);
        assert!(polygon.iter().all(|corner| corner[3] >= corner[2] - 1e-12));
        let behind = clipped([[0.0, 0.0, 0.1, -1.0], [1.0, 0.0, 0.1, -1.0], [0.0, 1.0, 0.1, -1.0]], [1e6, 1e6]);
        assert!(behind.is_empty());
        assert!(clipped([[f64::NAN; 4]; 3], [1e6, 1e6]).is_empty());
    }

    #[test]
    fn far_corners_stay_within_the_guard() {
        let wide = [[-1e9, 0.0, 0.1, 1.0], [1e9, 1e9, 0.1, 1.0], [0.0, -1e9, 0.1, 1.0]];
        for corners in on_grid(wide, [64.0, 64.0]) {
            assert!(corners.iter().flatten().all(|x| x.abs() <= GUARD as i64 * SNAP + SNAP), "{corners:?}");
        }
    }
}
