//! What fills each member of a uniform block: the view, the lights, the environment, the document, the object.

use glam::{Mat4, Vec3};
use halfvector_codegen::input_value;
use halfvector_codegen::reflection::{LightKind, UniformBlock, UniformSource, UniformType};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_scene::Object;
use halfvector_scene::light::LightsByKind;

/// What a frame or tile knows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a> {
    /// Clip space of the tile from world space.
    pub(crate) clip_from_world: Mat4,
    /// In world space.
    pub(crate) camera_position: Vec3,
    /// Factor from radiance to display units.
    pub(crate) exposure: f32,
    /// (cos, sin) of the environment's rotation.
    pub(crate) environment_rotation: [f32; 2],
    /// Levels of the prefiltered radiance.
    pub(crate) environment_levels: u32,
    /// Irradiance over pi.
    pub(crate) irradiance_sh: [[f32; 3]; 9],
    /// The scene's lights.
    pub(crate) lights: &'a LightsByKind,
}

impl Frame<'_> {
    /// Appends the numbers of a source that belongs to the frame; others append nothing.
    pub(crate) fn fill(&self, source: &UniformSource, numbers: &mut Vec<f32>) {
        match source {
            UniformSource::ClipFromWorld => numbers.extend(self.clip_from_world.to_cols_array()),
            UniformSource::CameraPosition => numbers.extend(self.camera_position.to_array()),
            UniformSource::Time => numbers.push(0.0),
            UniformSource::Exposure => numbers.push(self.exposure),
            UniformSource::EnvironmentRotation => numbers.extend(self.environment_rotation),
            UniformSource::EnvironmentLevels => numbers.push(self.environment_levels as f32),
            UniformSource::IrradianceSh => numbers.extend(self.irradiance_sh.as_flattened()),
            UniformSource::Lights(LightKind::Directional) => {
                for light in &self.lights.directional {
                    numbers.extend(light.direction.iter().chain(&light.illuminance));
                }
            }
            UniformSource::Lights(LightKind::Point) => {
                for light in &self.lights.point {
                    numbers.extend(light.position.iter().chain(&light.intensity));
                }
            }
            UniformSource::Lights(LightKind::Spot) => {
                for light in &self.lights.spot {
                    numbers.extend(light.position.iter().chain(&light.intensity));
                    numbers.extend(light.direction.iter().chain(&light.cos_scale_offset));
                }
            }
            UniformSource::Input(_) | UniformSource::WorldFromObject | UniformSource::NormalFromObject => {}
        }
    }
}

/// Appends the numbers of a source that belongs to an object; others append nothing.
pub(crate) fn fill_object(object: &Object, source: &UniformSource, numbers: &mut Vec<f32>) {
    match source {
        UniformSource::WorldFromObject => numbers.extend(object.world_from_object.to_cols_array()),
        UniformSource::NormalFromObject => numbers.extend(object.normal_from_object().to_cols_array()),
        _ => {}
    }
}

/// Appends the numbers of an input of a node of the document, as the block `block` wants them: the value set, else the
/// library's default. Sources of other kinds append nothing.
pub(crate) fn fill_input(
    document: &Document,
    library: &Library,
    block: &UniformBlock,
    source: &UniformSource,
    numbers: &mut Vec<f32>,
) {
    let UniformSource::Input(socket) = source else { return };
    let ty = block.members.iter().find(|member| member.source == *source).map(|member| member.ty);
    let Some(UniformType::Value(ty)) = ty else { return };
    numbers.extend(input_value(document, library, socket, ty).unwrap_or_default());
}
