// The environment behind the objects: one triangle over the whole target, at the far plane, coloured by the exact
// direction through each sample. A renderer links it with `ibl/environment.wgsl` and `color.wgsl`; materials do not need it.

struct Background {
    /// World direction through clip position (x, y): forward + x right + y up; not unit.
    right: vec3f,
    up: vec3f,
    forward: vec3f,
    /// (cos, sin) of the environment's rotation about +Y.
    environment_rotation: vec2f,
    /// 1 when the picture holds display values by the report's gamma (`encode=report`), 0 for radiance.
    gamma_coded: f32,
}

@group(0) @binding(0) var<uniform> background: Background;
@group(0) @binding(1) var background_radiance: texture_cube<f32>;
@group(0) @binding(2) var background_sampler: sampler;

struct BackgroundVaryings {
    @builtin(position) position: vec4f,
    @location(0) clip: vec2f,
}

/// Corners (-1, -1), (3, -1), (-1, 3): the triangle that holds the whole clip square. Depth 0 is the far plane (reversed z).
@vertex
fn vs_background(@builtin(vertex_index) index: u32) -> BackgroundVaryings {
    let clip = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return BackgroundVaryings(vec4f(clip, 0.0, 1.0), clip);
}

@fragment
fn fs_background(varyings: BackgroundVaryings) -> @location(0) vec4f {
    let dir = background.forward + varyings.clip.x * background.right + varyings.clip.y * background.up;
    let radiance =
        environment_sample(background_radiance, background_sampler, rotate_about_y(dir, background.environment_rotation), 0.0);
    return vec4f(mix(radiance, gamma_from_linear(radiance), background.gamma_coded), 1.0);
}
