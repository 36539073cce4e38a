//! Every built-in shape is closed where it should be, faces outwards, carries a picture upright, and has sound tangents.

use glam::Vec2;

use super::*;

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [usize; 3]> + '_ {
    mesh.indices.chunks_exact(3).map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
}

fn all_parts() -> Vec<(BuiltinMesh, Part)> {
    BuiltinMesh::ALL.into_iter().flat_map(|shape| shape.parts().into_iter().map(move |part| (shape, part))).collect()
}

#[test]
fn shapes_are_sound_and_face_outwards() {
    for (shape, part) in all_parts() {
        let (name, mesh) = (part.name, &part.mesh);
        let vertices = mesh.positions.len();
        assert!(vertices > 1000, "{shape:?} {name} is fine enough to be displaced");
        for length in [mesh.normals.len(), mesh.tangents.len(), mesh.uv0.len(), mesh.uv1.len(), mesh.colors.len()] {
            assert_eq!(length, vertices, "{shape:?} {name}");
        }
        for triangle in triangles(mesh) {
            let [a, b, c] = triangle.map(|i| Vec3::from(mesh.positions[i]));
            let area = (b - a).cross(c - a);
            assert!(area.length() > 0.0, "{shape:?} {name} has a triangle without area");
            for i in triangle {
                assert!(area.dot(Vec3::from(mesh.normals[i])) > 0.0, "{shape:?} {name} faces inwards at {a}");
            }
        }
    }
}

#[test]
fn normals_and_tangents_are_a_frame() {
    for (shape, part) in all_parts() {
        for (normal, tangent) in part.mesh.normals.iter().zip(&part.mesh.tangents) {
            let (normal, tangent) = (Vec3::from(*normal), Vec4Parts::from(*tangent));
            assert!((normal.length() - 1.0).abs() < 1e-5);
            assert!((tangent.direction.length() - 1.0).abs() < 1e-4);
            assert!(
                normal.dot(tangent.direction).abs() < 1e-3,
                "{shape:?} {}: {normal} {:?}",
                part.name,
                tangent.direction
            );
            assert_eq!(tangent.handedness, 1.0, "{shape:?} {}: no picture is mirrored", part.name);
        }
    }
}

struct Vec4Parts {
    direction: Vec3,
    handedness: f32,
}

impl From<[f32; 4]> for Vec4Parts {
    fn from([x, y, z, handedness]: [f32; 4]) -> Self {
        Vec4Parts { direction: Vec3::new(x, y, z), handedness }
    }
}

/// Along every triangle u grows with the tangent and v against the bitangent: upright and unmirrored from outside.
#[test]
fn tangents_follow_the_texture() {
    for (shape, part) in all_parts() {
        let mesh = &part.mesh;
        let mut wrong = 0;
        let mut seen = 0;
        for [a, b, c] in triangles(mesh) {
            let tangent = Vec4Parts::from(mesh.tangents[a]);
            let bitangent = Vec3::from(mesh.normals[a]).cross(tangent.direction) * tangent.handedness;
            let edge = |i: usize| Vec3::from(mesh.positions[i]) - Vec3::from(mesh.positions[a]);
            let uv = |i: usize| Vec2::from(mesh.uv0[i]) - Vec2::from(mesh.uv0[a]);
            // Positions as a linear function of texture coordinates.
            let (uv_b, uv_c) = (uv(b), uv(c));
            let det = uv_b.perp_dot(uv_c);
            let along_u = (edge(b) * uv_c.y - edge(c) * uv_b.y) / det;
            let along_v = (edge(c) * uv_b.x - edge(b) * uv_c.x) / det;
            seen += 1;
            if along_u.dot(tangent.direction) <= 0.0 || along_v.dot(bitangent) >= 0.0 {
                wrong += 1;
            }
        }
        assert_eq!(wrong, 0, "{shape:?} {} of {seen} triangles", part.name);
    }
}

#[test]
fn the_picture_stands_upright_towards_the_default_camera() {
    // At the point of the shape nearest to the camera, u grows to the right and v downwards.
    for shape in [BuiltinMesh::Sphere, BuiltinMesh::Plane, BuiltinMesh::Cube] {
        let parts = shape.parts();
        let mesh = &parts[0].mesh;
        let at = |x: f32, y: f32| {
            let nearest = |&i: &usize| {
                let p = Vec3::from(mesh.positions[i]);
                (p.truncate() - Vec2::new(x, y)).length() - 10.0 * p.z
            };
            let best = (0..mesh.positions.len()).min_by(|a, b| nearest(a).total_cmp(&nearest(b))).unwrap();
            mesh.uv0[best]
        };
        let (left, right, up, down) = (at(-0.3, 0.0), at(0.3, 0.0), at(0.0, 0.3), at(0.0, -0.3));
        assert!(left[0] <= right[0] && up[1] <= down[1], "{shape:?}");
    }
    let front = sphere_uv(Vec3::Z);
    assert!((front - Vec2::splat(0.5)).length() < 1e-6);
    assert!(sphere_uv(Vec3::new(0.1, 0.0, 1.0)).x > 0.5 && sphere_uv(Vec3::Y).y == 0.0);
}

#[test]
fn the_sphere_is_where_its_texture_says() {
    let sphere = &BuiltinMesh::Sphere.parts()[0].mesh;
    for (position, uv) in sphere.positions.iter().zip(&sphere.uv0) {
        let p = Vec3::from(*position);
        assert!((p.length() - 1.0).abs() < 1e-6);
        let pole = p.x == 0.0 && p.z == 0.0;
        let expected = sphere_uv(p);
        let turn = (expected.x - uv[0]).rem_euclid(1.0);
        assert!(pole || turn.min(1.0 - turn) < 1e-5, "{p} has u {} instead of {}", uv[0], expected.x);
        assert!((expected.y - uv[1]).abs() < 1e-3);
    }
}

#[test]
fn closed_shapes_have_no_cracks() {
    // Every edge, by the positions of its ends, belongs to two triangles that run along it in opposite directions.
    for shape in [BuiltinMesh::Sphere, BuiltinMesh::Torus, BuiltinMesh::Cube] {
        let parts = shape.parts();
        let mesh = &parts[0].mesh;
        let key = |i: usize| mesh.positions[i].map(|x| (x + 0.0).to_bits());
        let mut edges = std::collections::HashMap::new();
        for [a, b, c] in triangles(mesh) {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((key(from), key(to))).or_insert(0) += 1;
            }
        }
        for (&(from, to), &count) in &edges {
            assert_eq!(count, 1, "{shape:?}");
            assert_eq!(edges.get(&(to, from)), Some(&1), "{shape:?} has a crack at {from:?}");
        }
    }
}

#[test]
fn missing_attributes_are_made() {
    let quad = MeshData {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..MeshData::default()
    };
    let mesh = Mesh::build(quad.clone()).unwrap();
    assert_eq!(mesh.positions.len(), 6, "flat normals want vertices of their own");
    assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]));
    assert!(mesh.tangents.iter().all(|t| t[3] == 1.0 && t[2].abs() < 1e-6));
    assert_eq!(mesh.colors, [[1.0; 4]; 6]);
    let colors = [0.1, 0.2, 0.3, 0.4].map(|x| [x, 0.0, 1.0, 0.5]);
    let mesh = Mesh::build(MeshData { colors: Some(colors.to_vec()), ..quad.clone() }).unwrap();
    assert_eq!(mesh.colors, [0, 1, 2, 0, 2, 3].map(|i: usize| colors[i]), "they follow their vertices");

    let with_uv = MeshData {
        normals: Some(vec![[0.0, 0.0, 2.0]; 4]),
        uv0: Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]),
        ..quad
    };
    let mesh = Mesh::build(with_uv.clone()).unwrap();
    assert_eq!(mesh.positions.len(), 4);
    assert_eq!(mesh.uv1, mesh.uv0);
    assert!(mesh.normals.iter().all(|n| *n == [0.0, 0.0, 1.0]), "normals are made unit");
    assert!(mesh.tangents.iter().all(|t| *t == [1.0, 0.0, 0.0, 1.0]));

    // A mirrored half keeps its own handedness: the shared vertices are split.
    let mirrored = MeshData {
        positions: vec![[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
        colors: Some(colors.to_vec()),
        uv0: Some(vec![[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [1.0, 1.0]]),
        indices: vec![0, 1, 2, 1, 3, 2],
        ..MeshData::default()
    };
    let mesh = Mesh::build(mirrored).unwrap();
    assert_eq!(mesh.positions.len(), 6);
    let w: Vec<_> = mesh.indices.iter().map(|&i| mesh.tangents[i as usize][3]).collect();
    assert_eq!(w, [-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]);
    let shown: Vec<_> = mesh.indices.iter().map(|&i| mesh.colors[i as usize]).collect();
    assert_eq!(shown, [0, 1, 2, 1, 3, 2].map(|i: usize| colors[i]));

    // A normal map on the second coordinates has its tangents along those.
    let turned = MeshData {
        uv1: Some(vec![[1.0, 1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]),
        tangents_along_uv1: true,
        ..with_uv
    };
    let mesh = Mesh::build(turned).unwrap();
    assert!(mesh.tangents.iter().all(|t| (t[1] + 1.0).abs() < 1e-6), "{:?}", mesh.tangents);
}

#[test]
fn broken_meshes_say_what_is_wrong() {
    let good = MeshData { positions: vec![[0.0; 3]; 3], indices: vec![0, 1, 2], ..MeshData::default() };
    let cases = [
        (MeshData { indices: vec![0, 1], ..good.clone() }, "no multiple of 3"),
        (MeshData { indices: vec![0, 1, 3], ..good.clone() }, "index 2 is 3"),
        (MeshData { normals: Some(vec![[0.0; 3]; 2]), ..good.clone() }, "3 positions but 2 normals"),
        (MeshData { uv1: Some(vec![]), ..good.clone() }, "0 second texture coordinates"),
        (MeshData { colors: Some(vec![[1.0; 4]; 2]), ..good.clone() }, "3 positions but 2 colours"),
        (MeshData { colors: Some(vec![[f32::NAN; 4]; 3]), ..good.clone() }, "vertex 0 has colours"),
        (MeshData { positions: vec![[0.0; 3], [f32::NAN; 3], [0.0; 3]], ..good.clone() }, "vertex 1 has positions"),
        (MeshData { uv0: Some(vec![[f32::INFINITY; 2]; 3]), ..good.clone() }, "first texture coordinates"),
    ];
    for (data, reason) in cases {
        let message = Mesh::build(data).unwrap_err().to_string();
        assert!(message.contains(reason), "{message}");
    }
    // Degenerate triangles and useless normals are served.
    let mesh = Mesh::build(MeshData { normals: Some(vec![[f32::NAN; 3]; 3]), ..good }).unwrap();
    assert!(mesh.normals.iter().flatten().chain(mesh.tangents.iter().flatten()).all(|x| x.is_finite()));
    assert_eq!(Mesh::build(MeshData::default()).unwrap().bounds(), None);
}

/// The place in a picture for a direction on the unit sphere: u = 1/2 + atan2(x, z) / (2 pi), v = acos(y) / pi, so that
/// a picture stands upright and unmirrored when the sphere is seen from outside, its middle at +Z.
fn sphere_uv(direction: Vec3) -> Vec2 {
    let turns = direction.x.atan2(direction.z) / (2.0 * std::f32::consts::PI);
    Vec2::new(0.5 + turns, direction.y.clamp(-1.0, 1.0).acos() / std::f32::consts::PI)
}
