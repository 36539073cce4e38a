//! Normal mapping of single texels and of batches, and tangents of a mesh of a million vertices beside MikkTSpace alone.
//!
//! `cargo bench -p halfvector-benches --bench normals`

use std::hint::black_box;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfvector_maps::batch::{normals_from_texels, normals_rotation_fixed, normals_rotation_report, normals_tbn};
use halfvector_maps::normal::{normal_from_texel, normal_rotation_fixed, normal_rotation_report, normal_tbn};
use halfvector_maps::{split_tangents, tangents};

/// Texels of a batch: their arrays fit the second cache.
const COUNT: usize = 1 << 14;

fn arrays() -> [Vec<f32>; 10] {
    std::array::from_fn(|k| (0..COUNT).map(|i| ((i * 7919 + k * 104_729) % 2003) as f32 / 1001.0 - 1.0).collect())
}

fn methods(c: &mut Criterion) {
    let arrays = arrays();
    let a = arrays.each_ref().map(Vec::as_slice);
    let (n_tangent, normal, tangent) = ([a[0], a[1], a[2]], [a[3], a[4], a[5]], [a[6], a[7], a[8], a[9]]);
    let (n_at, normal_at) = (|i: usize| n_tangent.map(|a| a[i]), |i: usize| normal.map(|a| a[i]));
    let mut out: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; COUNT]);
    let mut singles = vec![[0.0_f32; 3]; COUNT];
    let mut group = c.benchmark_group("normals");
    group.throughput(Throughput::Elements(COUNT as u64));
    macro_rules! pair {
        ($name:literal, |$i:ident| $single:expr, |$out:ident| $batch:expr) => {
            group.bench_function(concat!($name, "/single"), |b| {
                b.iter(|| {
                    for ($i, n) in singles.iter_mut().enumerate() {
                        *n = $single;
                    }
                    black_box(&singles);
                })
            });
            group.bench_function(concat!($name, "/batch"), |b| {
                b.iter(|| {
                    let $out = out.each_mut().map(Vec::as_mut_slice);
                    $batch;
                    black_box(&out);
                })
            });
        };
    }
    pair!("texel", |i| normal_from_texel(n_at(i), 1.0, false), |out| normals_from_texels(n_tangent, 1.0, false, out));
    pair!("tbn", |i| normal_tbn(n_at(i), normal_at(i), tangent.map(|a| a[i])), |out| normals_tbn(
        n_tangent, normal, tangent, out
    ));
    pair!("rotation_report", |i| normal_rotation_report(n_at(i), normal_at(i)), |out| normals_rotation_report(
        n_tangent, normal, out
    ));
    pair!("rotation_fixed", |i| normal_rotation_fixed(n_at(i), normal_at(i)), |out| normals_rotation_fixed(
        n_tangent, normal, out
    ));
    group.finish();
}

/// A torus of 1000 x 1000 vertices and two million triangles.
struct Torus {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    indices: Vec<u32>,
    corners: Vec<[f32; 4]>,
}

impl Torus {
    fn new() -> Self {
        const N: u32 = 1000;
        let (mut positions, mut normals, mut uvs, mut indices) = (vec![], vec![], vec![], vec![]);
        for j in 0..N {
            for i in 0..N {
                let [u, v] = [i, j].map(|k| k as f32 / (N - 1) as f32);
                let ((s, c), (t, d)) = ((std::f32::consts::TAU * u).sin_cos(), (std::f32::consts::TAU * v).sin_cos());
                positions.push([c * (2.0 + d), t, -s * (2.0 + d)]);
                normals.push([c * d, t, -s * d]);
                uvs.push([4.0 * u, -v]);
                if i + 1 < N && j + 1 < N {
                    let at = j * N + i;
                    indices.extend([at, at + 1, at + N + 1, at, at + N + 1, at + N]);
                }
            }
        }
        let corners = vec![[0.0; 4]; indices.len()];
        Torus { positions, normals, uvs, indices, corners }
    }
}

impl Geometry for Torus {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.positions[self.indices[3 * face + vert] as usize]
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.normals[self.indices[3 * face + vert] as usize]
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.uvs[self.indices[3 * face + vert] as usize]
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        self.corners[3 * face + vert] = tangent_space.map_or([0.0; 4], |space| space.tangent_encoded());
    }
}

fn tangents_of_a_mesh(c: &mut Criterion) {
    let mut torus = Torus::new();
    let mut group = c.benchmark_group("tangents");
    group.throughput(Throughput::Elements(torus.positions.len() as u64)).sample_size(10);
    group.bench_function("mikktspace alone", |b| {
        b.iter(|| {
            generate_tangents(&mut torus).expect("tangents");
            black_box(&torus.corners);
        })
    });
    group.bench_function("tangents", |b| {
        b.iter(|| black_box(tangents(&torus.positions, &torus.normals, &torus.uvs, &torus.indices)))
    });
    group.bench_function("split_tangents", |b| {
        b.iter(|| black_box(split_tangents(&torus.positions, &torus.normals, &torus.uvs, &torus.indices)))
    });
    group.finish();
}

criterion_group!(benches, methods, tangents_of_a_mesh);
criterion_main!(benches);
