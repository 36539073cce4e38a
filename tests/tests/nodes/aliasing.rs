//! What the patterns do where a pixel covers much of them: each is evaluated with the pixel's footprint and held against the mean of many
//! samples of it over the pixel, the box-filtered truth. Beside it stands what the pattern without a footprint would show.

use halfvector_graph::library::Library;
use halfvector_graph::node_def::NodeDef;
use halfvector_graph::value::Type;

use super::run::Node;

/// Pixels of each comparison.
const PIXELS: usize = 64;
/// Samples of the truth in a pixel: an evenly spread sequence, for a raster would beat with the patterns.
const SAMPLES: usize = 400;
/// Widths of a pixel in periods, cells or bumps of the pattern.
const WIDTHS: [f32; 4] = [0.25, 1.0, 3.1, 8.3];

/// Outputs that are no average: a normal is unit, a brick's own coordinates and a distance to an outline are not drawn.
const NO_AVERAGE: &[(&str, &[usize])] = &[
    ("procedural/flakes", &[0, 1, 2, 3]),
    ("procedural/brick", &[2, 3]),
    ("procedural/rounded_box", &[1]),
    ("procedural/polygon", &[1]),
    ("procedural/circle", &[1]),
    ("procedural/cloverleaf", &[1]),
    ("procedural/line", &[1]),
];

/// Root of the mean squared error: with the footprint, and without.
struct Errors {
    filtered: f64,
    point: f64,
}

/// A number in 0..1 for a pixel.
fn spread(i: usize, step: f64) -> f32 {
    ((i as f64 + 0.5) * step).fract() as f32
}

/// Periods per unit of the coordinates, along x and y: what the node's `scale` or `count` says.
fn frequency(node: &Node) -> [f32; 2] {
    let defaults = node.defaults();
    let input = node.def.inputs.iter().find(|i| i.name == "scale" || i.name == "count");
    input.map_or([4.0, 4.0], |input| {
        let at = node.at(&input.name);
        let wide = node.widths[node.def.inputs.iter().position(|i| i.name == input.name).unwrap_or(0)] > 1;
        [defaults[at], defaults[at + usize::from(wide)]]
    })
}

fn errors(def: &'static NodeDef, width: f32) -> Vec<Errors> {
    let filtered = Node::of(def, Type::F32, false);
    let point = Node::of(def, Type::F32, true);
    let frequency = frequency(&filtered);
    let is_solid = filtered.widths[0] == 3;
    // A pixel on a slanted plane of space, or along the axes of the plane.
    let sides: [[f32; 3]; 2] = if is_solid {
        [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0]].map(|side| side.map(|x| x * width / frequency[0]))
    } else {
        [[width / frequency[0], 0.0, 0.0], [0.0, width / frequency[1], 0.0]]
    };
    let count: usize = filtered.widths.iter().sum();
    let steps = sides.map(|side| {
        let mut row = vec![0.0; count];
        row[..filtered.widths[0]].copy_from_slice(&side[..filtered.widths[0]]);
        row
    });
    let centers: Vec<Vec<f32>> = (0..PIXELS)
        .map(|i| {
            let mut row = filtered.defaults();
            let at = [spread(i, 0.754_877_67), spread(i, 0.569_840_29), spread(i, 0.819_172_5)];
            row[..filtered.widths[0]].copy_from_slice(&at[..filtered.widths[0]]);
            row
        })
        .collect();
    let mut samples = Vec::with_capacity(PIXELS * SAMPLES);
    for (pixel, center) in centers.iter().enumerate() {
        for s in 0..SAMPLES {
            let shift = [spread(pixel, 0.618_034), spread(pixel, 0.381_3)];
            let [x, y] =
                [spread(s, 0.754_877_67) + shift[0], spread(s, 0.569_840_29) + shift[1]].map(|x| x.fract() - 0.5);
            let mut row = center.clone();
            for i in 0..filtered.widths[0] {
                row[i] += x * sides[0][i] + y * sides[1][i];
            }
            samples.push(row);
        }
    }
    let truth = point.call::<f32>(&samples);
    let with = filtered.run::<f32>(&centers, Some((&steps[0], &steps[1])));
    let without = point.call::<f32>(&centers);
    let skipped = NO_AVERAGE.iter().find(|(id, _)| *id == def.id).map_or(&[][..], |(_, outputs)| outputs);
    (0..with[0].len())
        .filter(|output| !skipped.contains(output))
        .map(|output| {
            let (mut filtered, mut point) = (0.0, 0.0);
            for pixel in 0..PIXELS {
                let rows = &truth[pixel * SAMPLES..][..SAMPLES];
                let mean = rows.iter().map(|row| row[output]).sum::<f64>() / rows.len() as f64;
                filtered += (with[pixel][output] - mean).powi(2);
                point += (without[pixel][output] - mean).powi(2);
            }
            Errors { filtered: (filtered / PIXELS as f64).sqrt(), point: (point / PIXELS as f64).sqrt() }
        })
        .collect()
}

/// Means of the patterns are measured numbers with three digits, and 400 samples of a pixel of many cells are not its whole: this much is not
/// counted.
const MEASURE: f64 = 0.02;

#[test]
fn patterns_do_not_alias() {
    let mut failures = Vec::new();
    println!("rms error with a footprint (and without), by the width of a pixel in periods {WIDTHS:?}");
    for def in
        Library::standard().iter().filter(|def| def.id.starts_with("procedural/") && def.vertex_function.is_some())
    {
        let by_width: Vec<Vec<Errors>> = WIDTHS.iter().map(|width| errors(def, *width)).collect();
        for output in 0..by_width[0].len() {
            let cells: Vec<String> =
                by_width.iter().map(|e| format!("{:.3} ({:.3})", e[output].filtered, e[output].point)).collect();
            println!("{:<36}{}", format!("{} {output}", def.id), cells.join("  "));
            for (errors, width) in by_width.iter().zip(WIDTHS) {
                let Errors { filtered, point } = errors[output];
                // Never worse than no footprint; far away the pattern's mean, but for what a pixel of so many cells still varies.
                let far = if width >= 8.0 {
                    0.05
                } else if width >= 3.0 {
                    0.09
                } else {
                    0.2
                };
                if filtered > point.max(MEASURE) || filtered > far {
                    failures.push(format!("{} {output} at {width}: {filtered:.3}, without {point:.3}", def.id));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Every pattern has a footprint; the ones without are smooth, or numbers of things.
#[test]
fn every_pattern_has_a_footprint() {
    const WITHOUT: &[&str] = &[
        // They change over the unit square and have no detail.
        "procedural/linear_gradient",
        "procedural/radial_gradient",
        // A value of a whole number, for tiles and cells; the cell noises are the patterns.
        "procedural/white_noise_2d",
        "procedural/white_noise_3d",
    ];
    for def in Library::standard().iter().filter(|def| def.id.starts_with("procedural/")) {
        let has = def.function.implicit_derivatives && def.vertex_function.is_some();
        assert_eq!(has, !WITHOUT.contains(&def.id.as_str()), "{}", def.id);
    }
}
