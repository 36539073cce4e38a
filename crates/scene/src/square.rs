//! A material that fills a picture: what the time of its fragment stage is taken of.

use std::sync::Arc;

use glam::{Mat4, Vec3};

use crate::environment::{Background, EnvironmentSource};
use crate::light::Light;
use crate::mesh::{Mesh, MeshData};
use crate::scene::{Object, Scene, SceneError, SceneMaterial};

impl Scene {
    /// A material on a square of two triangles that covers every pixel of a square picture, under one directional light and
    /// nothing else; its images are loaded. Of such a picture the vertices cost nothing that counts, so the device's time for
    /// it is the fragment stage's.
    ///
    /// # Errors
    /// An image of the material is refused.
    pub fn filling_square(material: SceneMaterial) -> Result<Scene, SceneError> {
        let square = MeshData {
            positions: vec![[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]],
            normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
            uv0: Some(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
            indices: vec![0, 2, 1, 1, 2, 3],
            ..MeshData::default()
        };
        let mesh = Mesh::build(square).expect("a square is sound: a test builds it");
        let mut scene = Scene { materials: vec![material], ..Scene::default() };
        scene.meshes.push(Arc::new(mesh));
        let name = "square".to_owned();
        scene.objects.push(Object { name, mesh: 0, material: 0, world_from_object: Mat4::IDENTITY });
        scene.environment = EnvironmentSource::None;
        scene.background = Background::None;
        let direction_to_light = Vec3::new(0.3, 0.5, 0.8).normalize();
        scene.lights = vec![Light::Directional { direction_to_light, illuminance: Vec3::ONE }];
        // Half the height of what is seen is 2 tan(10 degrees) = 0.35.
        scene.camera.position = Vec3::new(0.0, 0.0, 2.0);
        scene.camera.vertical_fov = 20.0;
        scene.load_images()?;
        Ok(scene)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::neutral_material;

    #[test]
    fn the_square_is_sound_and_larger_than_what_is_seen() {
        let scene = Scene::filling_square(neutral_material()).expect("a scene");
        let bounds = scene.bounds().expect("something");
        let seen = scene.camera.position.z * (0.5 * scene.camera.vertical_fov.to_radians()).tan();
        assert!(bounds.min.x < -seen && bounds.max.y > seen && scene.objects.len() == 1);
    }
}
