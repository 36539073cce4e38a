//! What the shaders of a scene's materials have to serve.

use halfvector_graph::needs::{EnvironmentNeeds, Needs, ShaderOutput};

use crate::environment::EnvironmentSource;
use crate::light::lights_by_kind;
use crate::scene::Scene;

/// What a shader needs in this scene; the same for all of its materials.
pub fn needs(scene: &Scene, output: ShaderOutput) -> Needs {
    let lights = lights_by_kind(&scene.lights);
    let environment = match scene.environment {
        EnvironmentSource::None => None,
        _ => Some(EnvironmentNeeds { rotated: scene.environment_rotation.rem_euclid(360.0) != 0.0 }),
    };
    Needs {
        directional_lights: lights.directional.len() as u32,
        point_lights: lights.point.len() as u32,
        spot_lights: lights.spot.len() as u32,
        environment,
        output,
        methods: scene.methods.clone(),
    }
}
