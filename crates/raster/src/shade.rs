//! The fragment stage: from samples of triangles to colours.

use halfvector_interp::{Column, Derivatives, Float, Limits, Machine, Outputs, Program, Resources, RunError};

use crate::geometry::{Triangle, Vertices};
use crate::program::{Part, parts};

/// One invocation of the fragment stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lane {
    /// Index of the triangle in its draw.
    pub(crate) triangle: u32,
    /// Column of the sample.
    pub(crate) x: u32,
    /// Row.
    pub(crate) y: u32,
    /// Whether the result counts; the others only help with derivatives.
    pub(crate) counts: bool,
}

/// A fragment program with what it reads.
#[derive(Debug)]
pub(crate) struct Shading<'a> {
    pub(crate) program: &'a Program,
    pub(crate) resources: Resources<'a>,
    /// What each scalar of its input is.
    inputs: Vec<Part>,
    /// The columns of the colour's components.
    color: [Option<usize>; 4],
}

/// The linear functions of a triangle over the samples from which everything on it follows.
///
/// Olano and Greer 1997, "Triangle Scan Conversion using 2D Homogeneous Coordinates": with the corners (x w, y w, w) in
/// samples as columns of a matrix, its inverse times (x, y, 1) is each corner's weight divided by w. It holds for triangles
/// that reach behind the viewer, too.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights([[f64; 3]; 3]);

impl Weights {
    /// Of a triangle with these clip positions on a grid of so many samples. All are 0 for one that is seen edge-on.
    pub(crate) fn new(clip: [[f64; 4]; 3], grid: [f64; 2]) -> Weights {
        let [a, b, c] = clip.map(|[x, y, _, w]| [(x + w) * 0.5 * grid[0], (w - y) * 0.5 * grid[1], w]);
        let cross = |p: [f64; 3], q: [f64; 3]| {
            [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        };
        let first = cross(b, c);
        let determinant = first[0] * a[0] + first[1] * a[1] + first[2] * a[2];
        let scale = if determinant == 0.0 { 0.0 } else { 1.0 / determinant };
        Weights([first, cross(c, a), cross(a, b)].map(|row| row.map(|x| x * scale)))
    }

    /// The weights divided by w in the middle of a sample; their sum is 1 / w.
    pub(crate) fn at(&self, x: u32, y: u32) -> [f64; 3] {
        let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        self.0.map(|[a, b, c]| a * x + b * y + c)
    }

    /// The depth in the middle of a sample: z / w is linear over the samples.
    pub(crate) fn depth(&self, clip: [[f64; 4]; 3], x: u32, y: u32) -> f32 {
        let [a, b, c] = self.at(x, y);
        (a * clip[0][2] + b * clip[1][2] + c * clip[2][2]) as f32
    }
}

impl<'a> Shading<'a> {
    pub(crate) fn new(program: &'a Program, resources: Resources<'a>) -> Shading<'a> {
        let outputs = parts(program.outputs());
        let color = std::array::from_fn(|i| outputs.iter().position(|part| *part == Part::Location(0, i)));
        Shading { program, resources, inputs: parts(program.inputs()), color }
    }

    /// Whether samples are shaded in blocks of two by two.
    pub(crate) fn in_quads(&self) -> bool {
        self.program.uses_derivatives()
    }

    /// The colour of each lane, or `None` where it was discarded. In blocks of two by two lanes come as
    /// [`Derivatives::Quads`] wants them.
    pub(crate) fn run<'p, F: Float>(
        &'p self,
        machine: &mut Option<Machine<'p, F>>,
        vertices: &Vertices,
        triangles: &[Triangle],
        grid: [f64; 2],
        lanes: &[Lane],
    ) -> Result<Vec<Option<[f32; 4]>>, RunError> {
        let weights = perspective(vertices, triangles, grid, lanes);
        let mut floats: Vec<Vec<F>> = Vec::with_capacity(self.inputs.len());
        let mut words: Vec<Vec<u32>> = Vec::new();
        for part in &self.inputs {
            match *part {
                Part::Location(location, component) => {
                    let key = (location, component);
                    let varying = vertices.varyings.iter().find(|(of, _)| *of == key).map(|(_, all)| all.as_slice());
                    floats.push(interpolated(varying.unwrap_or_default(), triangles, lanes, &weights));
                }
                Part::Position(component) => {
                    let of = |(lane, weights): (&Lane, &Perspective)| {
                        F::from_f64(match component {
                            0 => f64::from(lane.x) + 0.5,
                            1 => f64::from(lane.y) + 0.5,
                            2 => weights.depth,
                            _ => weights.one_over_w,
                        })
                    };
                    floats.push(lanes.iter().zip(&weights).map(of).collect());
                }
                Part::FrontFacing => {
                    words.push(lanes.iter().map(|l| u32::from(triangles[l.triangle as usize].front)).collect());
                }
                // Refused when the program was compiled.
                Part::Other => {}
            }
        }
        let (mut floats, mut words) = (floats.iter(), words.iter());
        let columns: Vec<Column<'_, F>> = self
            .inputs
            .iter()
            .map(|part| match part {
                Part::FrontFacing | Part::Other => Column::Word(words.next().map_or(&[], Vec::as_slice)),
                Part::Location(..) | Part::Position(_) => Column::Float(floats.next().map_or(&[], Vec::as_slice)),
            })
            .collect();
        self.run_columns(machine, &columns, lanes.len())
    }

    /// The colours for given columns of inputs.
    pub(crate) fn run_columns<'p, F: Float>(
        &'p self,
        machine: &mut Option<Machine<'p, F>>,
        columns: &[Column<'_, F>],
        lanes: usize,
    ) -> Result<Vec<Option<[f32; 4]>>, RunError> {
        if lanes == 0 {
            return Ok(Vec::new());
        }
        let machine = match machine {
            Some(machine) => machine,
            None => machine.insert(self.program.machine(Limits::default())?),
        };
        let mut outputs = Outputs::default();
        let derivatives = if self.in_quads() { Derivatives::Quads } else { Derivatives::Zero };
        machine.run(columns, lanes, &mut outputs, &self.resources, derivatives)?;
        let component = |lane: usize, i: usize| {
            let column = self.color[i].and_then(|column| outputs.columns.get(column));
            match column {
                Some(halfvector_interp::OutputColumn::Float(all)) => all[lane].to_f32(),
                _ => 0.0,
            }
        };
        Ok((0..lanes)
            .map(|lane| (!outputs.killed[lane]).then(|| std::array::from_fn(|i| component(lane, i))))
            .collect())
    }
}

/// A lane's weights of its triangle's corners.
#[derive(Clone, Copy, Debug)]
struct Perspective {
    weights: [f64; 3],
    one_over_w: f64,
    depth: f64,
}

fn perspective(vertices: &Vertices, triangles: &[Triangle], grid: [f64; 2], lanes: &[Lane]) -> Vec<Perspective> {
    let mut known = None;
    let of = |lane: &Lane| {
        let clip = triangles[lane.triangle as usize].vertices.map(|vertex| vertices.clip[vertex as usize]);
        let weights = match known {
            Some((triangle, weights)) if triangle == lane.triangle => weights,
            _ => Weights::new(clip, grid),
        };
        known = Some((lane.triangle, weights));
        let parts = weights.at(lane.x, lane.y);
        let one_over_w = parts[0] + parts[1] + parts[2];
        let depth = parts[0] * clip[0][2] + parts[1] * clip[1][2] + parts[2] * clip[2][2];
        Perspective { weights: parts.map(|part| part / one_over_w), one_over_w, depth }
    };
    lanes.iter().map(of).collect()
}

/// A varying at each lane: differences from the first corner are weighted, so that what is the same at all corners stays so.
fn interpolated<F: Float>(varying: &[f64], triangles: &[Triangle], lanes: &[Lane], weights: &[Perspective]) -> Vec<F> {
    let corner = |vertex: u32| varying.get(vertex as usize).copied().unwrap_or_default();
    let of = |(lane, at): (&Lane, &Perspective)| {
        let [a, b, c] = triangles[lane.triangle as usize].vertices.map(corner);
        F::from_f64(a + at.weights[1] * (b - a) + at.weights[2] * (c - a))
    };
    lanes.iter().zip(weights).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_one_at_their_corners() {
        let clip = [[-1.0, -1.0, 0.1, 2.0], [3.0, 0.0, 0.1, 4.0], [0.0, 0.5, 0.1, 1.0]];
        let weights = Weights::new(clip, [10.0, 20.0]);
        for (corner, [x, y, _, w]) in clip.into_iter().enumerate() {
            let (x, y) = ((x / w + 1.0) * 5.0, (1.0 - y / w) * 10.0);
            for (other, [a, b, c]) in weights.0.into_iter().enumerate() {
                let weight = (a * x + b * y + c) * w;
                assert!((weight - f64::from(corner == other)).abs() < 1e-12, "{corner} {other} {weight}");
            }
        }
        assert_eq!(Weights::new([clip[0]; 3], [10.0, 20.0]).at(3, 4), [0.0; 3]);
    }
}
