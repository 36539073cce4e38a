//! What the crate promises, from outside: hard cases, exhaustive texels, files, mip chains, tangents, angle errors.

mod agreement;
mod angle_error;
mod batch;
mod blend;
mod decode;
mod exhaustive;
mod fuzz_corpus;
mod hard_cases;
mod jpeg_files;
mod lost_length;
mod mip;
mod pack;
mod profiles;
mod relief;
mod tangents;
mod texel;
mod tga_files;
mod tiff_files;
mod webp_files;

use halfvector_maps::Real;

/// The folder of data that nobody on the project wrote.
fn data() -> std::path::PathBuf {
    std::env::var_os("HALFVECTOR_DATA")
        .map_or_else(|| concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data").into(), Into::into)
}

/// x as a number of type R.
fn r<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

/// A vector or colour of type R.
fn v<R: Real>(x: [f64; 3]) -> [R; 3] {
    x.map(R::from_f64)
}

fn wide<R: Real>(x: [R; 3]) -> [f64; 3] {
    x.map(Real::to_f64)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let l = length(a);
    a.map(|x| x / l)
}

/// The angle between two directions in degrees, exact for small ones.
fn degrees_between(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// Finite and of length 1 to some ulp of f32.
fn is_unit<R: Real>(x: [R; 3]) -> bool {
    let x = wide(x);
    (dot(x, x) - 1.0).abs() < 1e-6
}

#[track_caller]
fn assert_near<R: Real>(got: [R; 3], want: [f64; 3], tolerance: f64) {
    let got = wide(got);
    assert!(length([got[0] - want[0], got[1] - want[1], got[2] - want[2]]) <= tolerance, "{got:?} is not {want:?}");
}
