//! GGX specular lobe times cosine: batches, the scalar function, and what one would write by hand with glam; then samples of
//! it, and the diffuse lobe. The same 4,096 points for all; they and the results lie in the L2 cache.
//! `peers/mitsuba_brdf.py` sets Mitsuba 3 beside it.
//!
//! `scalar` and `glam` are one call a point. `scalar_columns` is the scalar function in a loop over the very slices that the
//! batches read; `scalar_inlined` the same over an array of points, which the compiler can widen to the 4 lanes of SSE2.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use halfvector_brdf::batch::kernels::{DiffuseEval, SpecularEval, SpecularSample};
use halfvector_brdf::batch::{Kernel, Level, Simd};
use halfvector_brdf::frame::frame_from_normal;
use halfvector_brdf::lobe_specular::{Specular, specular_eval};
use std::f32::consts::{FRAC_1_PI, TAU};
use std::hint::black_box;

const POINTS: usize = 4096;

/// A point as a renderer that shades one at a time has it.
#[derive(Clone, Copy)]
struct Point {
    normal: [f32; 3],
    view: [f32; 3],
    light: [f32; 3],
    alpha: f32,
    f0: [f32; 3],
}

/// Numbers in [0, 1), the same every run.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    fn hemisphere(&mut self) -> [f32; 3] {
        let (z, phi) = (self.next(), TAU * self.next());
        let sine = (1.0 - z * z).sqrt();
        [sine * phi.cos(), sine * phi.sin(), z]
    }
}

fn points() -> Vec<Point> {
    let mut random = Random(1);
    let mut point = || Point {
        normal: [0.0, 0.0, 1.0],
        view: random.hemisphere(),
        light: random.hemisphere(),
        alpha: (0.1 + 0.9 * random.next()).powi(2),
        f0: [random.next(), random.next(), random.next()],
    };
    (0..POINTS).map(|_| point()).collect()
}

/// One call of the library's scalar function, as shading code of one point makes it: the caller is no loop that the
/// compiler could widen.
#[inline(never)]
fn scalar(p: &Point) -> [f32; 3] {
    specular_eval(frame_from_normal(p.normal, p.view), p.light, Specular { f0: p.f0, f90: [1.0; 3], alpha: p.alpha })
}

/// The same work by hand: the same terms, guards and floors.
#[inline(never)]
fn by_hand(p: &Point) -> [f32; 3] {
    let [n, v, l, f0] = [p.normal, p.view, p.light, p.f0].map(Vec3::from_array);
    let n_dot_v = n.dot(v).clamp(1e-7, 1.0);
    let n_dot_l = n.dot(l).clamp(0.0, 1.0);
    let sum = v + l;
    let length2 = sum.length_squared();
    let inv_length = if length2 > 1e-37 { 1.0 / length2.sqrt() } else { 0.0 };
    let h = sum * inv_length;
    let n_dot_h = n.dot(h);
    let sin2_theta_h = if length2 > 1e-37 { n.cross(h).length_squared() } else { 1.0 };
    let l_dot_h = 0.5 * length2 * inv_length;

    let a = n_dot_h * p.alpha;
    let k = p.alpha / (a * a + sin2_theta_h).max(1e-18);
    let d = k * (k * FRAC_1_PI);
    let a2 = p.alpha * p.alpha;
    let view = n_dot_l * (a2 + (1.0 - a2) * n_dot_v * n_dot_v).sqrt();
    let light = n_dot_v * (a2 + (1.0 - a2) * n_dot_l * n_dot_l).sqrt();
    let visibility = 0.5 / (view + light).max(1e-36);
    let m = (1.0 - l_dot_h).clamp(0.0, 1.0);
    let weight = (m * m) * (m * m) * m;
    let value = (f0 + (Vec3::ONE - f0) * weight) * (visibility * n_dot_l * d);
    Vec3::select(value.abs().cmplt(Vec3::splat(3e38)), value, Vec3::ZERO).to_array()
}

/// The lobe at one point, one call.
type Call = fn(&Point) -> [f32; 3];

fn levels() -> impl Iterator<Item = Simd> {
    [Level::Baseline, Level::Avx2, Level::Avx512].into_iter().filter_map(Simd::at)
}

fn eval(c: &mut Criterion) {
    let points = points();
    let mut group = c.benchmark_group("specular_eval");
    group.throughput(Throughput::Elements(POINTS as u64));
    let mut results = vec![[0.0; 3]; POINTS];
    let calls: [(&str, Call); 2] = [("scalar", scalar), ("glam", by_hand)];
    for (name, call) in calls {
        group.bench_function(name, |b| {
            b.iter(|| {
                for (point, result) in points.iter().zip(&mut results) {
                    *result = call(point);
                }
                black_box(&mut results);
            });
        });
    }
    group.bench_function("scalar_inlined", |b| {
        b.iter(|| {
            for (p, result) in points.iter().zip(&mut results) {
                let specular = Specular { f0: p.f0, f90: [1.0; 3], alpha: p.alpha };
                *result = specular_eval(frame_from_normal(p.normal, p.view), p.light, specular);
            }
            black_box(&mut results);
        });
    });
    let column = |f: &dyn Fn(&Point) -> f32| points.iter().map(f).collect::<Vec<_>>();
    let axis = [0, 1, 2];
    let view = axis.map(|i| column(&|p| p.view[i]));
    let light = axis.map(|i| column(&|p| p.light[i]));
    let f0 = axis.map(|i| column(&|p| p.f0[i]));
    let alpha = column(&|p| p.alpha);
    let [vx, vy, vz] = view.each_ref().map(|v| &v[..]);
    let [lx, ly, lz] = light.each_ref().map(|v| &v[..]);
    let [r, g, b] = f0.each_ref().map(|v| &v[..]);
    let mut columns = [(); 3].map(|()| vec![0.0; POINTS]);
    group.bench_function("scalar_columns", |bencher| {
        bencher.iter(|| {
            for i in 0..POINTS {
                let frame = frame_from_normal([0.0, 0.0, 1.0], [vx[i], vy[i], vz[i]]);
                let specular = Specular { f0: [r[i], g[i], b[i]], f90: [1.0; 3], alpha: alpha[i] };
                let value = specular_eval(frame, [lx[i], ly[i], lz[i]], specular);
                axis.iter().for_each(|&k| columns[k][i] = value[k]);
            }
            black_box(&mut columns);
        });
    });
    batch(&mut group, &SpecularEval, [vx, vy, vz, lx, ly, lz, &alpha, r, g, b]);
    group.finish();

    let mut group = c.benchmark_group("diffuse_eval");
    group.throughput(Throughput::Elements(POINTS as u64));
    batch(&mut group, &DiffuseEval, [vx, vy, vz, lx, ly, lz, &alpha, r, g, b]);
    group.finish();

    let mut group = c.benchmark_group("specular_sample");
    group.throughput(Throughput::Elements(POINTS as u64));
    let mut random = Random(7);
    let u = [0, 1].map(|_| (0..POINTS).map(|_| random.next()).collect::<Vec<_>>());
    let inputs = [vx, vy, vz, &alpha, r, g, b, &u[0], &u[1]];
    let mut results = vec![[0.0; 7]; POINTS];
    group.bench_function("scalar", |b| {
        b.iter(|| {
            for (i, result) in results.iter_mut().enumerate() {
                *result = sample_scalar(inputs.map(|column| column[i]));
            }
            black_box(&mut results);
        });
    });
    batch(&mut group, &SpecularSample, inputs);
    group.finish();
}

#[inline(never)]
fn sample_scalar(input: [f32; 9]) -> [f32; 7] {
    SpecularSample.call(input)
}

/// A kernel at each level of the machine.
fn batch<K: Kernel<I, O>, const I: usize, const O: usize>(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    kernel: &K,
    inputs: [&[f32]; I],
) {
    let mut outputs = vec![[0.0; POINTS]; O];
    for simd in levels() {
        group.bench_function(BenchmarkId::new("batch", format!("{:?}", simd.level())), |b| {
            b.iter(|| {
                let mut columns = outputs.iter_mut();
                let outputs = [(); O].map(|()| columns.next().map_or(&mut [][..], |c| &mut c[..]));
                simd.run(kernel, inputs, outputs).expect("columns of one length");
                black_box(&mut columns);
            });
            black_box(&mut outputs);
        });
    }
}

criterion_group!(benches, eval);
criterion_main!(benches);
