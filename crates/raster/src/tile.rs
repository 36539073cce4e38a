//! One tile of samples: coverage, depth, which samples are shaded when, blending.
//!
//! What is opaque is shaded once per sample, at the end, when it is known what is nearest. What may be discarded is
//! shaded when its draw comes, for only its shader knows whether it hides what lies behind.

use halfvector_interp::{Float, Machine, RunError};

use crate::geometry::{SNAP, Triangle, Vertices};
use crate::shade::{Lane, Shading, Weights};
use crate::sky;

/// One draw of one object, ready for its samples.
#[derive(Debug)]
pub(crate) struct Draw<'a> {
    pub(crate) shading: Shading<'a>,
    pub(crate) vertices: &'a Vertices,
    pub(crate) triangles: Vec<Triangle>,
    /// The material's name.
    pub(crate) material: &'a str,
    /// Index of the material in the scene.
    pub(crate) material_index: usize,
    pub(crate) blend: bool,
}

/// Everything that a tile draws, in order.
#[derive(Debug)]
pub(crate) struct Frame<'a> {
    pub(crate) draws: Vec<Draw<'a>>,
    pub(crate) sky: Option<Shading<'a>>,
    pub(crate) clear: [f32; 4],
    /// Samples of the whole picture.
    pub(crate) grid: [u32; 2],
}

/// The machines of one thread: one for each draw, and the sky's.
#[derive(Debug)]
pub(crate) struct Machines<'p, F> {
    draws: Vec<Option<Machine<'p, F>>>,
    sky: Option<Machine<'p, F>>,
}

/// Why a tile was not drawn: the index of the draw, or none for the sky.
pub(crate) type Fault = (Option<usize>, RunError);

/// Nothing covers the sample yet, or what does is shaded already.
const NOBODY: u32 = u32::MAX;

/// A rectangle of samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rect {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl<F: Float> Machines<'_, F> {
    pub(crate) fn new(frame: &Frame<'_>) -> Self {
        Machines { draws: frame.draws.iter().map(|_| None).collect(), sky: None }
    }
}

/// Draws a tile: the colours of its samples, row by row. `bin` has (draw, triangle) of what may touch it, in order.
pub(crate) fn draw<'p, F: Float>(
    frame: &'p Frame<'_>,
    machines: &mut Machines<'p, F>,
    rect: Rect,
    bin: &[(u32, u32)],
) -> Result<Vec<[f32; 4]>, Fault> {
    let samples = rect.width as usize * rect.height as usize;
    let mut tile = Tile {
        frame,
        rect,
        color: vec![frame.clear; samples],
        depth: vec![0.0; samples],
        owner: vec![(NOBODY, 0); samples],
    };
    let mut blended = Vec::new();
    for part in bin.chunk_by(|a, b| a.0 == b.0) {
        let draw = &frame.draws[part[0].0 as usize];
        if draw.blend {
            blended.push(part);
        } else if draw.shading.program.discards() {
            tile.masked(machines, part)?;
        } else {
            tile.opaque(part);
        }
    }
    tile.shade_opaque(machines)?;
    tile.shade_sky(machines)?;
    for part in blended {
        tile.blended(machines, part)?;
    }
    Ok(tile.color)
}

struct Tile<'f, 'p> {
    frame: &'p Frame<'f>,
    rect: Rect,
    color: Vec<[f32; 4]>,
    depth: Vec<f32>,
    /// (draw, triangle) of the opaque surface that is nearest.
    owner: Vec<(u32, u32)>,
}

impl<'p> Tile<'_, 'p> {
    /// Index of a sample, `None` outside of the tile.
    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let Rect { x: left, y: top, width, height } = self.rect;
        let (column, row) = (x.wrapping_sub(left), y.wrapping_sub(top));
        (column < width && row < height).then(|| row as usize * width as usize + column as usize)
    }

    fn opaque(&mut self, part: &[(u32, u32)]) {
        for &(number, triangle) in part {
            let draw = &self.frame.draws[number as usize];
            for_covered(&draw.triangles[triangle as usize], self.rect, draw, self.frame.grid, |index, _, _, depth| {
                if depth > self.depth[index] {
                    self.depth[index] = depth;
                    self.owner[index] = (number, triangle);
                }
            });
        }
    }

    /// The lanes of a draw's triangles that pass the depth test as it is now, whole blocks where they are wanted, and the
    /// depth of those that count.
    fn lanes(&self, part: &[(u32, u32)]) -> (Vec<Lane>, Vec<f32>) {
        let (mut lanes, mut depths) = (Vec::new(), Vec::new());
        for &(number, triangle) in part {
            let draw = &self.frame.draws[number as usize];
            let first = lanes.len();
            let mut block = BlockOf { quads: draw.shading.in_quads(), first, lanes: &mut lanes };
            for_covered(&draw.triangles[triangle as usize], self.rect, draw, self.frame.grid, |index, x, y, depth| {
                if depth > self.depth[index] {
                    block.add(triangle, x, y);
                }
            });
            let clip = draw.triangles[triangle as usize].vertices.map(|vertex| draw.vertices.clip[vertex as usize]);
            let weights = Weights::new(clip, self.frame.grid.map(f64::from));
            depths.extend(lanes[first..].iter().map(|lane| weights.depth(clip, lane.x, lane.y)));
        }
        (lanes, depths)
    }

    fn masked<F: Float>(&mut self, machines: &mut Machines<'p, F>, part: &[(u32, u32)]) -> Result<(), Fault> {
        let (lanes, depths) = self.lanes(part);
        let colors = self.shade(machines, part[0].0 as usize, &lanes)?;
        for ((lane, depth), color) in lanes.iter().zip(depths).zip(colors) {
            let (Some(color), true, Some(index)) = (color, lane.counts, self.index(lane.x, lane.y)) else { continue };
            // Triangles of the same draw may hide each other.
            if depth > self.depth[index] {
                self.depth[index] = depth;
                self.owner[index] = (NOBODY, 0);
                self.color[index] = color;
            }
        }
        Ok(())
    }

    fn blended<F: Float>(&mut self, machines: &mut Machines<'p, F>, part: &[(u32, u32)]) -> Result<(), Fault> {
        let (lanes, _) = self.lanes(part);
        let colors = self.shade(machines, part[0].0 as usize, &lanes)?;
        for (lane, color) in lanes.iter().zip(colors) {
            let (Some(color), true, Some(index)) = (color, lane.counts, self.index(lane.x, lane.y)) else { continue };
            let through = 1.0 - color[3];
            let behind = self.color[index];
            self.color[index] = std::array::from_fn(|i| color[i] + behind[i] * through);
        }
        Ok(())
    }

    /// Shades each opaque sample that is seen, draw by draw.
    fn shade_opaque<F: Float>(&mut self, machines: &mut Machines<'p, F>) -> Result<(), Fault> {
        let mut by_draw: Vec<(u32, Vec<Lane>)> = Vec::new();
        let Rect { x: left, y: top, width, height } = self.rect;
        for y in (top & !1..top + height).step_by(2) {
            for x in (left & !1..left + width).step_by(2) {
                let block = BLOCK.map(|[dx, dy]| {
                    let index = self.index(x + dx, y + dy)?;
                    (self.owner[index].0 != NOBODY).then_some(self.owner[index])
                });
                for (i, owner) in block.into_iter().enumerate() {
                    let Some((number, triangle)) = owner.filter(|_| !block[..i].contains(&owner)) else { continue };
                    let lanes = match by_draw.iter_mut().find(|(of, _)| *of == number) {
                        Some((_, lanes)) => lanes,
                        None => {
                            by_draw.push((number, Vec::new()));
                            let Some((_, lanes)) = by_draw.last_mut() else { continue };
                            lanes
                        }
                    };
                    let quads = self.frame.draws[number as usize].shading.in_quads();
                    for ([dx, dy], other) in BLOCK.into_iter().zip(block) {
                        let counts = other == owner;
                        if quads || counts {
                            lanes.push(Lane { triangle, x: x + dx, y: y + dy, counts });
                        }
                    }
                }
            }
        }
        for (number, lanes) in by_draw {
            let colors = self.shade(machines, number as usize, &lanes)?;
            for (lane, color) in lanes.iter().zip(colors).filter(|(lane, _)| lane.counts) {
                if let (Some(color), Some(index)) = (color, self.index(lane.x, lane.y)) {
                    self.color[index] = color;
                }
            }
        }
        Ok(())
    }

    fn shade<F: Float>(
        &self,
        machines: &mut Machines<'p, F>,
        number: usize,
        lanes: &[Lane],
    ) -> Result<Vec<Option<[f32; 4]>>, Fault> {
        let draw = &self.frame.draws[number];
        let grid = self.frame.grid.map(f64::from);
        draw.shading
            .run(&mut machines.draws[number], draw.vertices, &draw.triangles, grid, lanes)
            .map_err(|error| (Some(number), error))
    }

    fn shade_sky<F: Float>(&mut self, machines: &mut Machines<'p, F>) -> Result<(), Fault> {
        let Some(sky) = &self.frame.sky else { return Ok(()) };
        let width = self.rect.width as usize;
        let free: Vec<usize> = (0..self.depth.len()).filter(|&index| self.depth[index] == 0.0).collect();
        let place = |index: &usize| [self.rect.x + (index % width) as u32, self.rect.y + (index / width) as u32];
        let samples: Vec<[u32; 2]> = free.iter().map(place).collect();
        let colors = sky::run(sky, &mut machines.sky, &samples, self.frame.grid.map(f64::from))
            .map_err(|error| (None, error))?;
        for (index, color) in free.into_iter().zip(colors) {
            self.color[index] = color.unwrap_or_default();
        }
        Ok(())
    }
}

/// The samples of a block of two by two, in the interpreter's order.
const BLOCK: [[u32; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// Collects the lanes of one triangle.
struct BlockOf<'l> {
    quads: bool,
    /// Where the triangle's lanes begin.
    first: usize,
    lanes: &'l mut Vec<Lane>,
}

impl BlockOf<'_> {
    /// Adds a sample that counts; with the three that make it a block, when they are not there yet.
    fn add(&mut self, triangle: u32, x: u32, y: u32) {
        if !self.quads {
            self.lanes.push(Lane { triangle, x, y, counts: true });
            return;
        }
        let (left, top) = (x & !1, y & !1);
        let known = self.lanes[self.first..].chunks_exact(4).rposition(|block| block[0].x == left && block[0].y == top);
        let start = match known {
            Some(block) => self.first + 4 * block,
            None => {
                let start = self.lanes.len();
                let lane = |[dx, dy]: [u32; 2]| Lane { triangle, x: left + dx, y: top + dy, counts: false };
                self.lanes.extend(BLOCK.map(lane));
                start
            }
        };
        self.lanes[start + (x - left) as usize + 2 * (y - top) as usize].counts = true;
    }
}

/// Calls `visit` with (index in the tile, column, row, depth) of each sample that a triangle covers in a tile: those whose
/// middle lies inside, or on an edge that is a top or a left one, so that a sample on a shared edge belongs to one of two.
fn for_covered(
    triangle: &Triangle,
    rect: Rect,
    draw: &Draw<'_>,
    grid: [u32; 2],
    mut visit: impl FnMut(usize, u32, u32, f32),
) {
    let [a, b, c] = triangle.corners;
    let bounds = |axis: usize, start: u32, length: u32| {
        let low = a[axis].min(b[axis]).min(c[axis]);
        let high = a[axis].max(b[axis]).max(c[axis]);
        let (start, end) = (i64::from(start), i64::from(start + length) - 1);
        ((low + SNAP - 1).div_euclid(SNAP).max(start), high.div_euclid(SNAP).min(end))
    };
    let (left, right) = bounds(0, rect.x, rect.width);
    let (top, bottom) = bounds(1, rect.y, rect.height);
    if left > right || top > bottom {
        return;
    }
    let clip = triangle.vertices.map(|vertex| draw.vertices.clip[vertex as usize]);
    let weights = Weights::new(clip, grid.map(f64::from));
    let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| Edge::new(from, to, left, top));
    let mut rows = edges.map(|edge| edge.start);
    for y in top..=bottom {
        let mut at = rows;
        for x in left..=right {
            if at.iter().all(|&value| value >= 0) {
                let (x, y) = (x as u32, y as u32);
                let index = (y - rect.y) as usize * rect.width as usize + (x - rect.x) as usize;
                visit(index, x, y, weights.depth(clip, x, y));
            }
            for (value, edge) in at.iter_mut().zip(&edges) {
                *value += edge.along_x;
            }
        }
        for (value, edge) in rows.iter_mut().zip(&edges) {
            *value += edge.along_y;
        }
    }
}

/// An edge's function over the samples: not negative inside.
#[derive(Clone, Copy)]
struct Edge {
    /// At the first sample.
    start: i64,
    along_x: i64,
    along_y: i64,
}

impl Edge {
    fn new(from: [i64; 2], to: [i64; 2], x: i64, y: i64) -> Edge {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        // Corners go clockwise on the screen: a top edge runs to the right, a left one upwards.
        let owns_its_samples = dy < 0 || (dy == 0 && dx > 0);
        let value = dx * (y * SNAP - from[1]) - dy * (x * SNAP - from[0]);
        Edge { start: value - i64::from(!owns_its_samples), along_x: -dy * SNAP, along_y: dx * SNAP }
    }
}
