//! Textures: addressing, filtering, levels, cubes, arrays, queries.

use halfvector_interp::{
    Address, Column, Derivatives, Entry, Filter, Level, LevelRule, Limits, Outputs, Program, Resources, Sampler, Shape,
    Texture, TextureError,
};

use super::support::valid;

fn level(width: u32, height: u32, depth: u32, value: impl Fn(usize) -> f32) -> Level {
    let count = (width * height * depth) as usize;
    Level { width, height, depth, texels: (0..count).map(|i| [value(i), i as f32, 0.5, 1.0]).collect() }
}

/// Runs `f(x, y, z)` of a source with a texture at binding 0 and a sampler at 1; rows of results.
fn sample(source: &str, texture: &Texture, sampler: Sampler, points: &[[f32; 3]]) -> Vec<Vec<f64>> {
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, Entry::Function("f")).unwrap_or_else(|e| panic!("{e}"));
    let columns: Vec<Vec<f32>> = (0..3).map(|i| points.iter().map(|p| p[i]).collect()).collect();
    let inputs: Vec<Column<'_, f32>> = columns.iter().map(|c| Column::Float(c)).collect();
    let resources = Resources::default().texture(0, 0, texture).sampler(0, 1, sampler);
    let mut out = Outputs::default();
    program
        .run(&inputs, points.len(), &mut out, &resources, Derivatives::Quads, Limits::default())
        .unwrap_or_else(|e| panic!("{e}"));
    let columns: Vec<Vec<f64>> = out.columns.iter().map(|c| c.to_f64()).collect();
    (0..points.len()).map(|i| columns.iter().map(|c| c[i]).collect()).collect()
}

fn source(ty: &str, result: &str, body: &str) -> String {
    format!(
        "@group(0) @binding(0) var t: {ty}; @group(0) @binding(1) var s: sampler;
        fn f(x: f32, y: f32, z: f32) -> {result} {{ return {body}; }}"
    )
}

fn reds(rows: &[Vec<f64>]) -> Vec<f64> {
    rows.iter().map(|r| r[0]).collect()
}

#[test]
fn address_modes() {
    let texture = Texture::new(Shape::D2, 1, vec![level(4, 1, 1, |i| i as f32)]).expect("fits");
    let source = source("texture_2d<f32>", "f32", "textureSampleLevel(t, s, vec2f(x, y), 0.0).x");
    let points: Vec<[f32; 3]> = [-0.3, 0.1, 0.9, 1.1, 1.6, 9.1].iter().map(|x| [*x, 0.5, 0.0]).collect();
    let nearest = |address| Sampler { address: [address; 3], ..Sampler::default() };
    assert_eq!(reds(&sample(&source, &texture, nearest(Address::Clamp), &points)), [0.0, 0.0, 3.0, 3.0, 3.0, 3.0]);
    assert_eq!(reds(&sample(&source, &texture, nearest(Address::Repeat), &points)), [2.0, 0.0, 3.0, 0.0, 2.0, 0.0]);
    assert_eq!(reds(&sample(&source, &texture, nearest(Address::Mirror), &points)), [1.0, 0.0, 3.0, 3.0, 1.0, 3.0]);
    let linear = sample(&source, &texture, Sampler::linear(Address::Repeat), &[[0.0, 0.5, 0.0], [0.25, 0.5, 0.0]]);
    assert_eq!(reds(&linear), [1.5, 0.5]);
    let wild = sample(
        &source,
        &texture,
        Sampler::linear(Address::Repeat),
        &[[f32::NAN, 1e30, 0.0], [f32::INFINITY, 0.0, 0.0]],
    );
    assert!(reds(&wild).iter().all(|x| (0.0..=3.0).contains(x)), "{wild:?}");
}

#[test]
fn filters_and_levels() {
    let levels = vec![level(4, 4, 1, |_| 0.0), level(2, 2, 1, |_| 10.0), level(1, 1, 1, |_| 20.0)];
    let texture = Texture::new(Shape::D2, 1, levels).expect("fits");
    let at = source("texture_2d<f32>", "f32", "textureSampleLevel(t, s, vec2f(0.5), x).x");
    let points = [[-1.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.6, 0.0, 0.0], [1.5, 0.0, 0.0], [9.0, 0.0, 0.0]];
    assert_eq!(reds(&sample(&at, &texture, Sampler::default(), &points)), [0.0, 0.0, 10.0, 20.0, 20.0]);
    let trilinear = reds(&sample(&at, &texture, Sampler::linear(Address::Clamp), &points));
    for (found, expected) in trilinear.iter().zip([0.0, 4.0, 6.0, 15.0, 20.0]) {
        assert!((found - expected).abs() < 1e-5, "{trilinear:?}");
    }
    let limited = Sampler { level_range: [0.0, 1.0], ..Sampler::linear(Address::Clamp) };
    assert_eq!(reds(&sample(&at, &texture, limited, &points))[4], 10.0);
    // A step of half the texture is two texels of the finest level: level 1.
    let grad = source("texture_2d<f32>", "f32", "textureSampleGrad(t, s, vec2f(0.5), vec2f(x, 0.0), vec2f(0.0)).x");
    assert_eq!(
        reds(&sample(&grad, &texture, Sampler::linear(Address::Clamp), &[[0.5, 0.0, 0.0], [0.1, 0.0, 0.0]])),
        [10.0, 0.0]
    );
    // Lengths of 1, sqrt 2 and 1.25 texels, in steps of 1/4 of the texture, and one that overflows: chords are below log2 but
    // at powers of two of the square.
    let chords = Sampler { level_rule: LevelRule::Chords, ..Sampler::linear(Address::Clamp) };
    let steps = [0.25, 2.0_f32.sqrt() / 4.0, 1.25 / 4.0, 0.5, 0.0, 1e30].map(|x| [x, 0.0, 0.0]);
    for (found, expected) in
        reds(&sample(&grad, &texture, chords, &steps)).iter().zip([0.0, 5.0, 2.8125, 10.0, 0.0, 20.0])
    {
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }
    let exact = reds(&sample(&grad, &texture, Sampler::linear(Address::Clamp), &steps))[2];
    assert!((exact - 10.0 * 1.25_f64.log2()).abs() < 1e-5 && exact < 2.8125 + 0.431, "{exact}");
    let bias = source("texture_2d<f32>", "f32", "textureSampleBias(t, s, vec2f(x, y), z).x");
    let quad = [[0.2, 0.2, 0.5], [0.7, 0.2, 0.5], [0.2, 0.3, 0.5], [0.7, 0.3, 0.5]];
    for found in reds(&sample(&bias, &texture, Sampler::linear(Address::Clamp), &quad)) {
        assert!((found - 15.0).abs() < 1e-4, "{found}");
    }
    // One level for the block: the jump in its second row and column does not choose it.
    let auto = source("texture_2d<f32>", "f32", "textureSample(t, s, vec2f(x, y)).x");
    let jump = [[0.2, 0.2, 0.0], [0.45, 0.2, 0.0], [0.2, 0.3, 0.0], [0.95, 0.9, 0.0]];
    assert_eq!(reds(&sample(&auto, &texture, Sampler::linear(Address::Clamp), &jump)), [0.0; 4]);
}

#[test]
fn one_and_three_dimensions() {
    let one = Texture::new(Shape::D1, 1, vec![level(4, 1, 1, |i| i as f32)]).expect("fits");
    let at = source("texture_1d<f32>", "f32", "textureSampleLevel(t, s, x, 0.0).x");
    assert_eq!(reds(&sample(&at, &one, Sampler::linear(Address::Clamp), &[[0.5, 0.0, 0.0]])), [1.5]);
    let three = Texture::new(Shape::D3, 1, vec![level(2, 2, 2, |i| (i / 4) as f32)]).expect("fits");
    let at = source("texture_3d<f32>", "f32", "textureSampleLevel(t, s, vec3f(x, y, z), 0.0).x");
    let found = reds(&sample(&at, &three, Sampler::linear(Address::Clamp), &[[0.5, 0.5, 0.5], [0.3, 0.1, 0.9]]));
    assert_eq!(found, [0.5, 1.0]);
}

#[test]
fn loads_arrays_and_queries() {
    let texels = (0..12).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
    let array = Texture::new(Shape::D2, 3, vec![Level { width: 2, height: 2, depth: 1, texels }]).expect("fits");
    let load = source("texture_2d_array<f32>", "f32", "textureLoad(t, vec2i(i32(x), i32(y)), i32(z), 0).x");
    let points = [[1.0, 0.0, 2.0], [0.0, 1.0, 1.0], [2.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 3.0]];
    assert_eq!(reds(&sample(&load, &array, Sampler::default(), &points)), [9.0, 6.0, 0.0, 0.0, 0.0]);
    let at = source("texture_2d_array<f32>", "f32", "textureSampleLevel(t, s, vec2f(x, y), i32(z), 0.0).x");
    let found = reds(&sample(&at, &array, Sampler::default(), &[[0.9, 0.1, 1.0], [0.1, 0.1, 9.0]]));
    assert_eq!(found, [5.0, 8.0]);
    let query = source(
        "texture_2d_array<f32>",
        "vec4u",
        "vec4u(textureDimensions(t), textureNumLayers(t), textureNumLevels(t))",
    );
    assert_eq!(sample(&query, &array, Sampler::default(), &[[0.0; 3]]), [[2.0, 2.0, 3.0, 1.0]]);
    let gather = source("texture_2d<f32>", "vec4f", "textureGather(0, t, s, vec2f(x, y))");
    let flat = Texture::new(Shape::D2, 1, vec![level(2, 2, 1, |i| i as f32)]).expect("fits");
    assert_eq!(sample(&gather, &flat, Sampler::default(), &[[0.5, 0.5, 0.0]]), [[2.0, 3.0, 1.0, 0.0]]);
}

/// A cube whose texel holds the direction of its centre.
fn directions(n: u32) -> Texture {
    let mut texels = Vec::new();
    for face in 0..6 {
        for y in 0..n {
            for x in 0..n {
                let place = |i: u32| (2.0 * i as f32 + 1.0) / n as f32 - 1.0;
                let (s, t) = (place(x), place(y));
                let d = match face {
                    0 => [1.0, -t, -s],
                    1 => [-1.0, -t, s],
                    2 => [s, 1.0, t],
                    3 => [s, -1.0, -t],
                    4 => [s, -t, 1.0],
                    _ => [-s, -t, -1.0],
                };
                let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                texels.push([d[0] / length, d[1] / length, d[2] / length, face as f32]);
            }
        }
    }
    Texture::new(Shape::Cube, 6, vec![Level { width: n, height: n, depth: 1, texels }]).expect("fits")
}

#[test]
fn cubes_have_no_seams() {
    let cube = directions(32);
    let at = source("texture_cube<f32>", "vec4f", "textureSampleLevel(t, s, vec3f(x, y, z), 0.0)");
    let axes =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let faces: Vec<f64> = sample(&at, &cube, Sampler::default(), &axes).iter().map(|r| r[3]).collect();
    assert_eq!(faces, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    // All around, edges and corners among them: what is read is the direction, to the curvature within a texel.
    let mut points = Vec::new();
    for i in 0..4000 {
        let z = 1.0 - 2.0 * (i as f32 + 0.5) / 4000.0;
        let a = i as f32 * 2.399_963;
        points.push([(1.0 - z * z).sqrt() * a.cos(), (1.0 - z * z).sqrt() * a.sin(), z]);
    }
    for (a, b) in [(1.0_f32, 1.0_f32), (1.0, 0.999), (-1.0, 1.0), (0.999, 1.0)] {
        points.extend([[a, b, 0.3], [a, 0.2, b], [0.1, a, b], [a, b, 0.999], [a, b, 1.0]]);
    }
    for (point, row) in points.iter().zip(sample(&at, &cube, Sampler::linear(Address::Clamp), &points)) {
        let length = point.iter().map(|x| x * x).sum::<f32>().sqrt();
        for i in 0..3 {
            let error = (row[i] - f64::from(point[i] / length)).abs();
            assert!(error < 0.02, "{point:?}: {row:?}");
        }
    }
}

#[test]
fn what_is_no_texture_is_refused() {
    assert_eq!(Texture::new(Shape::D2, 1, vec![]), Err(TextureError::Empty));
    assert_eq!(Texture::new(Shape::D2, 2, vec![level(2, 2, 1, |_| 0.0)]), Err(TextureError::Texels(0)));
    assert_eq!(Texture::new(Shape::Cube, 1, vec![level(2, 2, 1, |_| 0.0)]), Err(TextureError::Cube));
    let sampler = Sampler { magnify: Filter::Linear, ..Sampler::default() };
    let flat = Texture::new(Shape::D2, 1, vec![level(2, 2, 1, |_| 0.0)]).expect("fits");
    let (module, info) = valid(&source("texture_cube<f32>", "vec4f", "textureSample(t, s, vec3f(x, y, z))"));
    let program = Program::compile(&module, &info, Entry::Function("f")).expect("supported");
    let resources = Resources::default().texture(0, 0, &flat).sampler(0, 1, sampler);
    let one = [Column::Float(&[1.0_f32][..]); 3];
    let run = program.run(&one, 1, &mut Outputs::default(), &resources, Derivatives::Zero, Limits::default());
    assert!(run.expect_err("a plane").to_string().contains("other dimensions"));
}
