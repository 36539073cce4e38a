//! Tangents of meshes: directions, handedness, seams, bad input, and the data folder's model against its own tangents.

use halfvector_maps::{split_tangents, tangents};
use proptest::prelude::*;

use crate::{cross, decode::cases, degrees_between, dot, is_unit, length, unit, wide};

const QUAD: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const QUAD_INDICES: [u32; 6] = [0, 1, 2, 0, 2, 3];
const UP: [f32; 3] = [0.0, 0.0, 1.0];

/// A picture hung upright on a quad, v running down: T along u, B = w cross(N, T) up the picture.
#[test]
fn an_upright_picture_is_right_handed() {
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    assert_eq!(tangents(&QUAD, &[UP; 4], &uvs, &QUAD_INDICES), [[1.0, 0.0, 0.0, 1.0]; 4]);
}

/// Row "mirrored UV": the same picture mirrored in u, and one with v running up, are left-handed.
#[test]
fn mirrored_uv_is_left_handed() {
    let mirrored = [[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0]];
    assert_eq!(tangents(&QUAD, &[UP; 4], &mirrored, &QUAD_INDICES), [[-1.0, 0.0, 0.0, -1.0]; 4]);
    let upside_down = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(tangents(&QUAD, &[UP; 4], &upside_down, &QUAD_INDICES), [[1.0, 0.0, 0.0, -1.0]; 4]);
}

/// Two quads that share an edge where the texture is mirrored: the edge's vertices are doubled, one for each hand.
#[test]
fn a_mirror_seam_is_split() {
    let positions: Vec<[f32; 3]> = [-1.0, 0.0, 1.0].iter().flat_map(|&x| [[x, 0.0, 0.0], [x, 1.0, 0.0]]).collect();
    let uvs: Vec<[f32; 2]> = [1.0, 0.0, 1.0].iter().flat_map(|&u| [[u, 1.0], [u, 0.0]]).collect();
    let indices = [0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3];
    let split = split_tangents(&positions, &[UP; 6], &uvs, &indices);
    assert_eq!(split.source, [0, 1, 2, 3, 4, 5, 2, 3]);
    assert_eq!(split.tangents.len(), 8);
    for (corner, &vertex) in split.indices.iter().enumerate() {
        assert_eq!(split.source[vertex as usize], indices[corner]);
        let hand = if corner < 6 { -1.0 } else { 1.0 };
        assert_eq!(split.tangents[vertex as usize], [hand, 0.0, 0.0, hand]);
    }
    // Unsplit, each vertex still has one sound tangent.
    assert!(tangents(&positions, &[UP; 6], &uvs, &indices).iter().all(|&t| is_sound(t)));
}

/// A mesh whose tangents agree is not split.
#[test]
fn a_smooth_mesh_is_not_split() {
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let split = split_tangents(&QUAD, &[UP; 4], &uvs, &QUAD_INDICES);
    assert_eq!(split.indices, QUAD_INDICES);
    assert_eq!(split.source, [0, 1, 2, 3]);
}

#[test]
fn bad_input_is_served() {
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let all_sound = |positions: &[[f32; 3]], normals: &[[f32; 3]], uvs: &[[f32; 2]], indices: &[u32]| {
        let got = tangents(positions, normals, uvs, indices);
        assert_eq!(got.len(), positions.len());
        assert!(got.iter().all(|&t| is_sound(t)), "{got:?}");
        let split = split_tangents(positions, normals, uvs, indices);
        assert_eq!(split.indices.len(), indices.len());
        assert_eq!(split.source.len(), split.tangents.len());
        assert!(split.tangents.iter().all(|&t| is_sound(t)));
    };
    all_sound(&[], &[], &[], &[0, 1, 2]);
    all_sound(&QUAD, &[UP; 4], &uvs, &[]);
    all_sound(&QUAD, &[UP; 4], &uvs, &[0, 1, 2, 0]);
    all_sound(&QUAD, &[UP; 4], &uvs, &[0, 1, 9, u32::MAX, 2, 3]);
    all_sound(&QUAD, &[UP; 2], &uvs[..3], &QUAD_INDICES);
    all_sound(&QUAD, &[[0.0; 3]; 4], &uvs, &QUAD_INDICES);
    all_sound(&QUAD, &[[f32::NAN; 3]; 4], &uvs, &QUAD_INDICES);
    all_sound(&QUAD, &[[1.0, 0.0, 0.0]; 4], &uvs, &QUAD_INDICES);
    all_sound(&[[f32::INFINITY; 3]; 4], &[UP; 4], &uvs, &QUAD_INDICES);
    all_sound(&[[3e38; 3]; 4], &[UP; 4], &uvs, &QUAD_INDICES);
    all_sound(&QUAD, &[UP; 4], &[[f32::NAN; 2]; 4], &QUAD_INDICES);
    all_sound(&QUAD, &[UP; 4], &[[3e38, -3e38], [-3e38, 3e38], [1.0, 2.0], [0.0, 0.0]], &QUAD_INDICES);
}

/// Finite, of unit length, with a handedness.
fn is_sound([x, y, z, w]: [f32; 4]) -> bool {
    (length(wide([x, y, z])) - 1.0).abs() < 2e-3 && w.abs() == 1.0
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..ProptestConfig::default() })]

    /// Soup of triangles, with coordinates from few values so that all kinds of degeneracy come up.
    #[test]
    fn any_soup_has_sound_tangents(
        vertices in prop::collection::vec((prop::array::uniform3(-2..=2_i8), prop::array::uniform3(-1..=1_i8), prop::array::uniform2(-1..=2_i8)), 1..12),
        indices in prop::collection::vec(0..14_u32, 0..60),
    ) {
        let positions: Vec<[f32; 3]> = vertices.iter().map(|v| v.0.map(f32::from)).collect();
        let normals: Vec<[f32; 3]> = vertices.iter().map(|v| v.1.map(f32::from)).collect();
        let uvs: Vec<[f32; 2]> = vertices.iter().map(|v| v.2.map(f32::from)).collect();
        prop_assert!(tangents(&positions, &normals, &uvs, &indices).iter().all(|&t| is_sound(t)));
        let split = split_tangents(&positions, &normals, &uvs, &indices);
        prop_assert!(split.tangents.iter().all(|&t| is_sound(t)));
        for (&new, &old) in split.indices.iter().zip(&indices) {
            let want = if (old as usize) < positions.len() { old } else { u32::MAX };
            prop_assert_eq!(split.source.get(new as usize).copied().unwrap_or(new), want);
        }
    }
}

/// A curved, skewed sheet: tangents lie in the surface, along u, and the bitangent against v.
#[test]
fn tangents_follow_the_surface() {
    let point = |u: f64, v: f64| [u + 0.3 * v, -v, 0.4 * (2.0 * u).sin() * (3.0 * v).cos()];
    let derivative = |f: &dyn Fn(f64) -> [f64; 3], x: f64| {
        let (a, b) = (f(x - 1e-5), f(x + 1e-5));
        [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
    };
    let n = 40_u32;
    let grid: Vec<[f64; 2]> =
        (0..=n).flat_map(|j| (0..=n).map(move |i| [i, j].map(|k| f64::from(k) / f64::from(n)))).collect();
    let along = |[u, v]: [f64; 2]| (derivative(&|u| point(u, v), u), derivative(&|v| point(u, v), v));
    let normals: Vec<[f32; 3]> = grid
        .iter()
        .map(|&uv| {
            let (du, dv) = along(uv);
            unit(cross(dv, du)).map(|x| x as f32)
        })
        .collect();
    let positions: Vec<[f32; 3]> = grid.iter().map(|&[u, v]| point(u, v).map(|x| x as f32)).collect();
    let uvs: Vec<[f32; 2]> = grid.iter().map(|uv| uv.map(|x| x as f32)).collect();
    let indices: Vec<u32> = (0..n * n)
        .flat_map(|k| {
            let a = k / n * (n + 1) + k % n;
            [a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2]
        })
        .collect();
    for (k, &[x, y, z, w]) in tangents(&positions, &normals, &uvs, &indices).iter().enumerate() {
        let (du, dv) = along(grid[k]);
        let (t, normal) = (wide([x, y, z]), wide(normals[k]));
        assert!(is_unit([x, y, z]) && dot(t, normal).abs() < 1e-5 && w == 1.0);
        assert!(degrees_between(t, du) < 3.0, "{:?}: {}", grid[k], degrees_between(t, du));
        assert!(dot(cross(normal, t), dv) < 0.0);
    }
}

/// The data folder's helmet carries the tangents that another tool made, of its own weights and maybe of other polygons:
/// ours have the same hand and on the mean nearly the same direction.
#[test]
fn the_helmet_has_the_tangents_it_says() {
    let folder = crate::data().join("models/FlightHelmet");
    let (Ok(text), Ok(bytes)) =
        (std::fs::read_to_string(folder.join("FlightHelmet.gltf")), std::fs::read(folder.join("FlightHelmet.bin")))
    else {
        println!("skipped: no model in {}", folder.display());
        return;
    };
    let gltf: serde_json::Value = serde_json::from_str(&text).unwrap();
    let floats = |accessor: &serde_json::Value| {
        let accessor = &gltf["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &gltf["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let start = accessor["byteOffset"].as_u64().unwrap_or(0) + view["byteOffset"].as_u64().unwrap_or(0);
        let count = accessor["count"].as_u64().unwrap() as usize;
        (&bytes[start as usize..], count, accessor["componentType"].as_u64().unwrap())
    };
    fn vectors<const N: usize>((bytes, count, kind): (&[u8], usize, u64)) -> Vec<[f32; N]> {
        assert_eq!(kind, 5126);
        bytes[..4 * N * count]
            .chunks_exact(4 * N)
            .map(|b| std::array::from_fn(|i| f32::from_le_bytes(std::array::from_fn(|j| b[4 * i + j]))))
            .collect()
    }
    for mesh in gltf["meshes"].as_array().unwrap() {
        let primitive = &mesh["primitives"][0];
        let attribute = |name: &str| floats(&primitive["attributes"][name]);
        let (positions, normals) = (vectors::<3>(attribute("POSITION")), vectors::<3>(attribute("NORMAL")));
        let (uvs, theirs) = (vectors::<2>(attribute("TEXCOORD_0")), vectors::<4>(attribute("TANGENT")));
        let (raw, count, kind) = floats(&primitive["indices"]);
        let indices: Vec<u32> = match kind {
            5123 => raw[..2 * count].chunks_exact(2).map(|b| u32::from(u16::from_le_bytes([b[0], b[1]]))).collect(),
            _ => raw[..4 * count].chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect(),
        };
        let ours = tangents(&positions, &normals, &uvs, &indices);
        let same_hand = ours.iter().zip(&theirs).filter(|(a, b)| a[3] == b[3]).count();
        let angles = || {
            ours.iter().zip(&theirs).map(|(a, b)| degrees_between(wide([a[0], a[1], a[2]]), wide([b[0], b[1], b[2]])))
        };
        let close = angles().filter(|&angle| angle < 1.0).count();
        let mean = angles().sum::<f64>() / ours.len() as f64;
        println!(
            "{}: {} vertices, same hand {same_hand}, within 1 degree {close}, mean angle {mean:.4} degrees",
            mesh["name"],
            ours.len()
        );
        assert!(same_hand as f64 >= 0.99 * ours.len() as f64);
        assert!(mean < 2.5);
    }
}
