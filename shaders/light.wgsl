// Punctual lights: what arrives at a point from a light without extent. Units are photometric or radiometric alike;
// there is no hidden pi: a white Lambert surface facing 1 lx has radiance 1 / pi.

/// A light so far away that its rays are parallel.
struct DirectionalLight {
    /// Unit direction from the surface to the light, in world space.
    direction: vec3f,
    /// Illuminance of a surface that faces it [lx].
    illuminance: vec3f,
}

/// A light that shines from one point into all directions alike.
struct PointLight {
    /// Where it is, in world space [m].
    position: vec3f,
    /// Luminous intensity [cd].
    intensity: vec3f,
}

/// A light that shines from one point into a cone.
struct SpotLight {
    /// Where it is, in world space [m].
    position: vec3f,
    /// Scale that takes the cosine to the axis, with cos_offset, to 0 at the outer and 1 at the inner cone. Each number
    /// fills the fourth of a vector: every shading language lays that out alike.
    cos_scale: f32,
    /// Luminous intensity on the axis [cd].
    intensity: vec3f,
    /// Offset of the scaled cosine.
    cos_offset: f32,
    /// Unit direction of the axis, the way the light shines, in world space.
    direction: vec3f,
}

/// What arrives at a point from a light.
struct LightSample {
    /// Unit direction from the point to the light, in world space; zero where the point is the light itself.
    dir: vec3f,
    /// Illuminance at normal incidence [lx].
    illuminance: vec3f,
}

/// Squared distance below which the inverse square law stops [m^2]: 1 cm keeps the illuminance finite at the light.
const LIGHT_MIN_DISTANCE_SQUARED: f32 = 1e-4;

// E = E_light everywhere.
fn directional_light_sample(light: DirectionalLight, position: vec3f) -> LightSample {
    return LightSample(light.direction, light.illuminance);
}

// Lambert 1760, "Photometria": E = I / d^2, with d^2 >= 1e-4 m^2.
fn point_light_sample(light: PointLight, position: vec3f) -> LightSample {
    let to_light = light.position - position;
    let distance_squared = dot(to_light, to_light);
    // 1e-30 keeps the division finite in the light itself, where the direction becomes zero.
    let dir = to_light / sqrt(max(distance_squared, 1e-30));
    return LightSample(dir, light.intensity / max(distance_squared, LIGHT_MIN_DISTANCE_SQUARED));
}

// Khronos 2017, "KHR_lights_punctual", inner and outer cone angles: E = I / d^2 * a^2,
// a = saturate((cos - cos_outer) / (cos_inner - cos_outer)), as one multiplication and one addition.
fn spot_light_sample(light: SpotLight, position: vec3f) -> LightSample {
    let all_around = point_light_sample(PointLight(light.position, light.intensity), position);
    let cos_to_axis = -dot(light.direction, all_around.dir);
    let cone = saturate(cos_to_axis * light.cos_scale + light.cos_offset);
    return LightSample(all_around.dir, all_around.illuminance * (cone * cone));
}
