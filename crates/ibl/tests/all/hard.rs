//! Hard cases of maps and cubes, by the names that the project's catalogue gives them (`brdf/hard_cases.csv` of the data).

use halfvector_ibl::{
    Cube, Equirect, cube_from_equirect, direction_from_face, equirect_from_direction, equirect_texel_solid_angle,
    face_from_direction, texel_solid_angle,
};
use std::f64::consts::PI;

/// A map that is smooth on the sphere, also over the seam and the poles.
fn smooth() -> Equirect {
    Equirect::from_fn(256, 128, |d| [2.0 + d[0], 2.0 + d[1] * d[2], 2.0 - d[2]].map(|x| x as f32))
}

#[test]
fn equirect_pole() {
    for up in [[0.0, 1.0, 0.0], [0.0, 1.000_000_1, 0.0], [-0.0, 1.0, -0.0], [1e-300, 1.0, -1e-300]] {
        let (u, v) = equirect_from_direction(up);
        assert!(v == 0.0 && (0.0..=1.0).contains(&u), "{up:?}: {u}, {v}");
        let down = up.map(|x: f64| -x);
        assert_eq!(equirect_from_direction(down).1, 1.0);
    }
    // Round the pole, a hair from it, the picture is one colour.
    let map = smooth();
    let at_pole = map.sample([0.0, 1.0, 0.0]);
    for k in 0..16 {
        let (sin, cos) = (PI * f64::from(k) / 8.0).sin_cos();
        let near = map.sample([1e-9 * cos, 1.0, 1e-9 * sin]);
        assert!(near.iter().zip(at_pole).all(|(a, b)| (a - b).abs() < 0.02), "{near:?} for {at_pole:?}");
    }
}

#[test]
fn equirect_seam() {
    let map = smooth();
    for y in [-0.9, 0.0, 0.5] {
        let (before, after) = (map.sample([-1.0, y, 1e-12]), map.sample([-1.0, y, -1e-12]));
        assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() < 1e-5), "{before:?}, {after:?}");
    }
    let cube = cube_from_equirect(&map, 64);
    for (value, exact) in cube.sample([-1.0, 0.0, 0.0]).iter().zip([1.0, 2.0, 2.0f32]) {
        assert!((value - exact).abs() < 0.01);
    }
}

#[test]
fn equirect_signed_zero() {
    let map = smooth();
    let (plus, minus) = (map.sample([-1.0, 0.0, 0.0]), map.sample([-1.0, 0.0, -0.0]));
    assert!(plus.iter().zip(minus).all(|(a, b)| (a - b).abs() < 1e-6), "{plus:?}, {minus:?}");
}

#[test]
fn solid_angle_of_an_equirect_row() {
    let first = equirect_texel_solid_angle(1, 512, 0) / (2.0 * PI);
    assert!((first / 1.882_471_7e-5 - 1.0).abs() < 1e-7, "{first}");
}

#[test]
fn solid_angle_of_a_row_in_single_precision() {
    let first = equirect_texel_solid_angle(1, 16384, 0) / (2.0 * PI);
    assert!((first / 1.838_36e-8 - 1.0).abs() < 1e-5, "{first}");
    // What the plain difference of cosines would give in f32.
    assert_eq!(1.0f32 - (PI as f32 / 16384.0).cos(), 0.0);
}

#[test]
fn cube_corner() {
    let one = Cube::from_fn(4, |_| [1.0; 3]);
    for corner in [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0]] {
        let dir = corner.map(|x: f64| x / 3f64.sqrt());
        let (face, s, t) = face_from_direction(dir);
        let back = direction_from_face(face, s, t);
        assert!((0..3).all(|i| (back[i] - corner[i]).abs() < 1e-12), "{corner:?}: {back:?}");
        assert_eq!(one.sample(dir), [1.0; 3]);
    }
}

#[test]
fn cube_texel_solid_angles() {
    let (centre, corner) = (texel_solid_angle(256, 127, 127), texel_solid_angle(256, 0, 0));
    assert!((centre / 6.1035e-5 - 1.0).abs() < 1e-3 && (corner / 1.1816e-5 - 1.0).abs() < 0.01, "{centre}, {corner}");
    assert!((centre / corner / 5.196 - 1.0).abs() < 0.02);
}
