//! What of a lamp of one texel arrives in the levels, wherever in the map it stands.

use crate::full;
use halfvector_ibl::{
    BakeOptions, Cube, Equirect, LevelMap, Quality, bake, cube_from_equirect, direction_from_equirect,
    direction_from_face, equirect_from_direction, equirect_texel_solid_angle, texel_solid_angle,
};

/// The integral of a cube over the sphere.
fn energy(cube: &Cube) -> [f64; 3] {
    let n = cube.size;
    let mut sum = [0.0; 3];
    for (k, texel) in cube.texels.iter().enumerate() {
        let area = texel_solid_angle(n, k % n, k / n % n);
        for c in 0..3 {
            sum[c] += area * f64::from(texel[c]);
        }
    }
    sum
}

/// A black map with a lamp of 65504 in each colour, and the integral of each.
fn lamps(width: usize, height: usize, places: [(usize, usize); 3]) -> (Equirect, [f64; 3]) {
    let mut map = Equirect { width, height, pixels: vec![[0.0; 3]; width * height] };
    for (c, (row, column)) in places.into_iter().enumerate() {
        map.pixels[row * width + column][c] = 65504.0;
    }
    (map, places.map(|(row, _)| 65504.0 * equirect_texel_solid_angle(width, height, row)))
}

/// Rows at the poles, at the equator, where faces of the cube meet and between, with columns at the seam, along the
/// edges and corners of faces and between.
fn places(width: usize, height: usize) -> Vec<(usize, usize)> {
    let row = |share: usize| share * height / 512;
    let column = |share: usize| share * width / 1024;
    let mut places = Vec::new();
    for (k, share) in [0, 1, 2, 3, 17, 60, 100, 127, 128, 129, 180, 255, 256, 300, 383, 384, 440, 508, 510, 511]
        .into_iter()
        .enumerate()
    {
        let row = if share > 500 { height - 512 + share } else { row(share).max(share.min(3)) };
        places.extend([0, column(128) - 1, column(333 + 37 * k) % width].map(|column| (row, column)));
    }
    // Exactly on a corner of the cube, and beside it.
    let (u, v) = equirect_from_direction([1.0, 1.0, 1.0]);
    let corner = ((v * height as f64) as usize, (u * width as f64) as usize);
    places.extend([corner, (corner.0 - 1, corner.1), (corner.0, corner.1 - 1)]);
    places
}

/// Level 0, which is the same at every quality, of maps finer and coarser than the cube.
#[test]
fn level_0_keeps_every_lamp() {
    for (width, height, size) in
        [(1024, 512, 256), (1024, 512, 100), (1024, 512, 500), (2048, 1024, 64), (1022, 512, 256)]
    {
        let mut worst = (0.0f64, (0, 0));
        // The size that bakes are measured at with every place, the others with some, or all with `HALFVECTOR_FULL=1`.
        let usual = (width, size) == (1024, 256);
        let step = if full() || usual { 1 } else { 4 };
        for three in places(width, height).chunks_exact(3).step_by(step) {
            let (map, truth) = lamps(width, height, [three[0], three[1], three[2]]);
            let cube = cube_from_equirect(&map, size);
            let found = energy(&cube);
            for c in 0..3 {
                let error = (found[c] / truth[c] - 1.0).abs();
                if error > worst.0 {
                    worst = (error, three[c]);
                }
                // And it stands where it stood.
                let brightest = (0..cube.texels.len()).max_by(|&a, &b| cube.texels[a][c].total_cmp(&cube.texels[b][c]));
                let k = brightest.expect("a cube has texels");
                let place = |i: usize| (2.0 * i as f64 + 1.0) / size as f64 - 1.0;
                let seen = direction_from_face(k / (size * size), place(k % size), place(k / size % size));
                let (row, column) = three[c];
                let lamp =
                    direction_from_equirect((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
                let length = seen.iter().map(|x| x * x).sum::<f64>().sqrt();
                let distance = (0..3).map(|c| (seen[c] / length - lamp[c]).powi(2)).sum::<f64>().sqrt();
                let reach = 1.5 / size as f64 + 3.0 / height as f64;
                assert!(distance < reach, "{width} x {height} to {size}, row {row}, column {column}: {distance} away");
            }
        }
        let (error, (row, column)) = worst;
        println!(
            "{width} x {height} to {size}: a lamp's energy in level 0 within {:.3} % (row {row}, column {column})",
            100.0 * error
        );
        // Least exact are places where an edge of a row and one of the cube's texels cross.
        assert!(error < if usual { 1e-3 } else { 4e-3 }, "{error}");
    }
}

/// Levels 0 and 0.1 of a bake with faces of 256 and 128 texels, at preview and default quality, with `HALFVECTOR_FULL=1`
/// at best, too.
#[test]
fn levels_keep_every_lamp() {
    for places in [[(0, 5), (1, 700), (3, 701)], [(60, 500), (180, 333), (255, 0)], [(256, 1023), (300, 640), (511, 9)]]
    {
        let (map, truth) = lamps(1024, 512, places);
        let environment = map.into();
        let qualities = [Quality::Preview, Quality::Default, Quality::Best];
        for quality in qualities.into_iter().take(if full() { 3 } else { 2 }) {
            let options = BakeOptions {
                size: 256,
                level_map: LevelMap::Listed(vec![0.0, 0.1]),
                irradiance_size: 1,
                quality,
                ..BakeOptions::default()
            };
            let baked = bake(&environment, &options);
            for (cube, roughness) in baked.radiance.iter().zip(&baked.roughness) {
                let found = energy(cube);
                let percent: [f64; 3] = std::array::from_fn(|c| 100.0 * (found[c] / truth[c] - 1.0));
                println!("{places:?}, {quality:?}, roughness {roughness}: off by {percent:.3?} %");
                assert!(percent.iter().all(|x| x.abs() < 0.5), "{percent:?}");
            }
        }
    }
}

/// White stays white, and a smooth map is what it is at the middles of texels, whatever is finer.
#[test]
fn level_0_is_the_map() {
    for (width, height, size) in
        [(1024, 512, 256), (9, 200, 64), (7, 5, 2), (8, 4, 96), (2, 2, 1), (1, 3, 1), (1, 1, 5)]
    {
        let even = cube_from_equirect(&Equirect { width, height, pixels: vec![[1.0; 3]; width * height] }, size);
        assert!(even.texels.iter().flatten().all(|x| (x - 1.0).abs() < 1e-6), "{width} x {height} to {size}");
    }
    for (width, height, size) in [(1024, 512, 256), (256, 128, 256), (128, 64, 501)] {
        let map = Equirect::from_fn(width, height, |d| [2.0 + d[0], 2.0 + d[1] * d[2], 2.0 - d[2]].map(|x| x as f32));
        let cube = cube_from_equirect(&map, size);
        let mut worst = 0.0f32;
        for (k, texel) in cube.texels.iter().enumerate() {
            let place = |i: usize| (2.0 * i as f64 + 1.0) / size as f64 - 1.0;
            let there = map.sample(direction_from_face(k / (size * size), place(k % size), place(k / size % size)));
            worst = (0..3).fold(worst, |worst, c| worst.max((texel[c] - there[c]).abs()));
        }
        println!("{width} x {height} to {size}: a smooth map within {worst:.5}");
        // Between middles of texels the two differ by a part of a step from one to the next.
        assert!(worst < 1.0 / height as f32, "{worst}");
    }
}
