//! Punctual lights: what arrives at a point from a light without extent (twins of `light.wgsl`, generic over f32 and
//! f64), the lights of a scene, and the command line's way to write one.
//!
//! There is no hidden pi: a white Lambert surface facing 1 lx has radiance 1 / pi. Colours are linear Rec. 709.

use glam::Vec3;
use halfvector_maps::Real;

use crate::real::{clamp, dot, max, real};

/// Squared distance below which the inverse square law stops [m^2]: 1 cm keeps the illuminance finite at the light.
pub const LIGHT_MIN_DISTANCE_SQUARED: f64 = 1e-4;

/// A light so far away that its rays are parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight<R> {
    /// Unit direction from the surface to the light, in world space.
    pub direction: [R; 3],
    /// Illuminance of a surface that faces it [lx].
    pub illuminance: [R; 3],
}

/// A light that shines from one point into all directions alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight<R> {
    /// Where it is, in world space [m].
    pub position: [R; 3],
    /// Luminous intensity [cd].
    pub intensity: [R; 3],
}

/// A light that shines from one point into a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight<R> {
    /// Where it is, in world space [m].
    pub position: [R; 3],
    /// Scale that takes the cosine to the axis, with `cos_offset`, to 0 at the outer and 1 at the inner cone.
    pub cos_scale: R,
    /// Luminous intensity on the axis [cd].
    pub intensity: [R; 3],
    /// Offset of the scaled cosine.
    pub cos_offset: R,
    /// Unit direction of the axis, the way the light shines, in world space.
    pub direction: [R; 3],
}

/// What arrives at a point from a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample<R> {
    /// Unit direction from the point to the light, in world space; zero where the point is the light itself.
    pub dir: [R; 3],
    /// Illuminance at normal incidence [lx].
    pub illuminance: [R; 3],
}

/// E = E_light everywhere.
pub fn directional_light_sample<R: Real>(light: DirectionalLight<R>, _position: [R; 3]) -> LightSample<R> {
    LightSample { dir: light.direction, illuminance: light.illuminance }
}

/// Lambert 1760, "Photometria": E = I / d^2, with d^2 >= 1e-4 m^2.
pub fn point_light_sample<R: Real>(light: PointLight<R>, position: [R; 3]) -> LightSample<R> {
    let to_light = [0, 1, 2].map(|i| light.position[i] - position[i]);
    let distance_squared = dot(to_light, to_light);
    // 1e-30 keeps the division finite in the light itself, where the direction becomes zero.
    let distance = max(distance_squared, real(1e-30)).sqrt();
    let attenuation = max(distance_squared, real(LIGHT_MIN_DISTANCE_SQUARED));
    LightSample { dir: to_light.map(|x| x / distance), illuminance: light.intensity.map(|i| i / attenuation) }
}

/// Khronos 2017, "KHR_lights_punctual", inner and outer cone angles: E = I / d^2 * a^2,
/// a = saturate((cos - cos_outer) / (cos_inner - cos_outer)), as one multiplication and one addition.
pub fn spot_light_sample<R: Real>(light: SpotLight<R>, position: [R; 3]) -> LightSample<R> {
    let all_around = point_light_sample(PointLight { position: light.position, intensity: light.intensity }, position);
    let cos_to_axis = -dot(light.direction, all_around.dir);
    let cone = clamp(cos_to_axis * light.cos_scale + light.cos_offset, real(0.0), real(1.0));
    LightSample { dir: all_around.dir, illuminance: all_around.illuminance.map(|e| e * (cone * cone)) }
}

/// A light of a scene. Directions are unit, colours are multiplied in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Parallel rays.
    Directional {
        /// Unit direction towards the light, in world space.
        direction_to_light: Vec3,
        /// Illuminance of a surface that faces it [lx], times the colour.
        illuminance: Vec3,
    },
    /// All directions alike.
    Point {
        /// In world space [m].
        position: Vec3,
        /// [cd], times the colour.
        intensity: Vec3,
    },
    /// A cone.
    Spot {
        /// In world space [m].
        position: Vec3,
        /// Unit direction of the axis, the way the light shines, in world space.
        direction: Vec3,
        /// On the axis [cd], times the colour.
        intensity: Vec3,
        /// Angle from the axis within which the light is full [rad], 0 to `outer_angle`.
        inner_angle: f32,
        /// Angle from the axis beyond which there is none [rad], to pi / 2.
        outer_angle: f32,
    },
}

/// The lights of a scene by kind, as shaders read them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightsByKind {
    /// In the scene's order.
    pub directional: Vec<DirectionalLight<f32>>,
    /// In the scene's order.
    pub point: Vec<PointLight<f32>>,
    /// In the scene's order.
    pub spot: Vec<SpotLight<f32>>,
}

impl LightsByKind {
    /// The numbers of the directional, the point and the spot lights, in the order of the members of their WGSL structs.
    pub fn numbers(&self) -> [Vec<f32>; 3] {
        let directional = self.directional.iter().flat_map(|light| [light.direction, light.illuminance]);
        let point = self.point.iter().flat_map(|light| [light.position, light.intensity]);
        let spot = self.spot.iter().flat_map(|light| {
            let ([x, y, z], [r, g, b]) = (light.position, light.intensity);
            [x, y, z, light.cos_scale, r, g, b, light.cos_offset].into_iter().chain(light.direction)
        });
        [directional.flatten().collect(), point.flatten().collect(), spot.collect()]
    }
}

/// Sorts lights by kind, keeping the order within a kind.
pub fn lights_by_kind(lights: &[Light]) -> LightsByKind {
    let mut sorted = LightsByKind::default();
    for light in lights {
        match *light {
            Light::Directional { direction_to_light, illuminance } => sorted.directional.push(DirectionalLight {
                direction: direction_to_light.to_array(),
                illuminance: illuminance.to_array(),
            }),
            Light::Point { position, intensity } => {
                sorted.point.push(PointLight { position: position.to_array(), intensity: intensity.to_array() });
            }
            Light::Spot { position, direction, intensity, inner_angle, outer_angle } => {
                let [cos_scale, cos_offset] = spot_cos_scale_offset(inner_angle, outer_angle);
                sorted.spot.push(SpotLight {
                    position: position.to_array(),
                    cos_scale,
                    intensity: intensity.to_array(),
                    cos_offset,
                    direction: direction.to_array(),
                });
            }
        }
    }
    sorted
}

/// (scale, offset) with scale cos(outer) + offset = 0 and scale cos(inner) + offset = 1, angles in radians. As in
/// KHR_lights_punctual the cosines are taken as at least 0.001 apart, which keeps a hard edge finite.
pub fn spot_cos_scale_offset(inner_angle: f32, outer_angle: f32) -> [f32; 2] {
    let cos_outer = outer_angle.cos();
    let scale = 1.0 / (inner_angle.cos() - cos_outer).max(1e-3);
    [scale, -cos_outer * scale]
}

/// Solid angle that an isotropic light of the spot's axial intensity needs for the spot's flux [sr]:
/// 2 pi ((1 - cos_inner) + (cos_inner - cos_outer) / 3), the integral of a^2 over the sphere.
pub fn spot_effective_solid_angle(inner_angle: f32, outer_angle: f32) -> f32 {
    let (cos_inner, cos_outer) = (inner_angle.cos(), outer_angle.cos());
    2.0 * std::f32::consts::PI * ((1.0 - cos_inner) + (cos_inner - cos_outer) / 3.0)
}

/// How a light is written on the command line; for help texts.
pub const LIGHT_SYNTAX: &str = "\
directional:X,Y,Z:LUX[:R,G,B]                          X,Y,Z points FROM the surface TO the light (0,1,0 = from above)
point:X,Y,Z:CANDELA[:R,G,B]                            X,Y,Z is where the light is, in metres
spot:X,Y,Z:DX,DY,DZ:CANDELA:INNER:OUTER[:R,G,B]        DX,DY,DZ is the way the light SHINES (0,-1,0 = downwards);
                                                       INNER and OUTER are degrees from the axis, 0 <= INNER <= OUTER <= 90, 0 < OUTER
R,G,B is a linear Rec. 709 colour that multiplies the intensity; 1,1,1 when left out.";

/// Why a light as written was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("light `{spec}`: {reason}; a light is written\n{LIGHT_SYNTAX}")]
pub struct LightSpecError {
    /// As given.
    pub spec: String,
    /// What is wrong.
    pub reason: String,
}

/// Reads a light as written on the command line, see [`LIGHT_SYNTAX`]. Directions are normalised.
pub fn parse_light(spec: &str) -> Result<Light, LightSpecError> {
    parse(spec).map_err(|reason| LightSpecError { spec: spec.to_owned(), reason })
}

fn parse(spec: &str) -> Result<Light, String> {
    let fields: Vec<&str> = spec.split(':').collect();
    let (required, kind) = match fields[0] {
        "directional" => (3, "directional"),
        "point" => (3, "point"),
        "spot" => (6, "spot"),
        other => return Err(format!("`{other}` is no kind of light (directional, point, spot)")),
    };
    if fields.len() < required || fields.len() > required + 1 {
        return Err(format!(
            "a {kind} light has {required} fields, or {} with a colour, not {}",
            required + 1,
            fields.len()
        ));
    }
    let color = match fields.get(required) {
        Some(text) => non_negative_color(vector(text, "the colour")?)?,
        None => Vec3::ONE,
    };
    Ok(match kind {
        "directional" => Light::Directional {
            direction_to_light: unit(vector(fields[1], "the direction to the light")?)?,
            illuminance: color * non_negative(fields[2], "the illuminance")?,
        },
        "point" => Light::Point {
            position: vector(fields[1], "the position")?,
            intensity: color * non_negative(fields[2], "the intensity")?,
        },
        _ => {
            let (inner, outer) = (number(fields[4], "the inner angle")?, number(fields[5], "the outer angle")?);
            let [inner_angle, outer_angle] = cone(inner, outer)?;
            Light::Spot {
                position: vector(fields[1], "the position")?,
                direction: unit(vector(fields[2], "the direction")?)?,
                intensity: color * non_negative(fields[3], "the intensity")?,
                inner_angle,
                outer_angle,
            }
        }
    })
}

/// Cone angles from degrees to radians, checked: 0 <= inner <= outer <= 90 and outer > 0.
pub(crate) fn cone(inner: f32, outer: f32) -> Result<[f32; 2], String> {
    if 0.0 <= inner && inner <= outer && outer <= 90.0 && outer > 0.0 {
        Ok([inner.to_radians(), outer.to_radians()])
    } else {
        Err(format!(
            "the cone is {inner} to {outer} degrees from the axis; 0 <= inner <= outer <= 90 and outer > 0 is needed"
        ))
    }
}

/// The unit vector, or why there is none.
pub(crate) fn unit(v: Vec3) -> Result<Vec3, String> {
    v.try_normalize().ok_or_else(|| format!("the direction {},{},{} has no length", v.x, v.y, v.z))
}

/// The colour itself when no channel is negative.
pub(crate) fn non_negative_color(v: Vec3) -> Result<Vec3, String> {
    if v.cmpge(Vec3::ZERO).all() { Ok(v) } else { Err(format!("the colour {},{},{} is negative", v.x, v.y, v.z)) }
}

fn number(text: &str, what: &str) -> Result<f32, String> {
    let value = text.trim().parse::<f32>().map_err(|_| format!("{what} `{text}` is no number"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("{what} `{text}` is not finite")) }
}

fn non_negative(text: &str, what: &str) -> Result<f32, String> {
    let value = number(text, what)?;
    if value >= 0.0 { Ok(value) } else { Err(format!("{what} is negative ({text})")) }
}

fn vector(text: &str, what: &str) -> Result<Vec3, String> {
    let parts: Vec<&str> = text.split(',').collect();
    let [x, y, z] = parts[..] else {
        return Err(format!("{what} `{text}` has {} numbers, not 3 separated by commas", parts.len()));
    };
    Ok(Vec3::new(number(x, what)?, number(y, what)?, number(z, what)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_square_and_its_floor() {
        let light = PointLight { position: [0.0, 3.0, 0.0], intensity: [18.0, 9.0, 0.0] };
        let sample = point_light_sample(light, [0.0, 0.0, 0.0]);
        assert_eq!(sample, LightSample { dir: [0.0, 1.0, 0.0], illuminance: [2.0, 1.0, 0.0] });
        let inside = point_light_sample(light, light.position);
        assert_eq!(inside.dir, [0.0; 3]);
        assert!(inside.illuminance.iter().all(|e: &f64| e.is_finite()));
        assert_eq!(inside.illuminance[0], 18.0 / 1e-4);
    }

    #[test]
    fn spot_is_full_inside_and_dark_outside() {
        let (inner, outer) = (20f32.to_radians(), 30f32.to_radians());
        let [cos_scale, cos_offset] = spot_cos_scale_offset(inner, outer);
        let light = SpotLight {
            position: [0.0, 2.0, 0.0],
            cos_scale,
            intensity: [4.0f32; 3],
            cos_offset,
            direction: [0.0, -1.0, 0.0],
        };
        let at = |degrees: f32| {
            let sample = spot_light_sample(light, [2.0 * degrees.to_radians().tan(), 0.0, 0.0]);
            let d2 = 4.0 / degrees.to_radians().cos().powi(2);
            sample.illuminance[0] * d2 / 4.0
        };
        assert!((at(0.0) - 1.0).abs() < 1e-6);
        assert!((at(19.9) - 1.0).abs() < 1e-5);
        assert_eq!(at(30.1), 0.0);
        // Halfway in cosine: a = 1/2, a^2 = 1/4.
        let half = ((inner.cos() + outer.cos()) / 2.0).acos().to_degrees();
        assert!((at(half) - 0.25).abs() < 1e-4, "{}", at(half));
    }

    #[test]
    fn effective_solid_angle_is_the_integral_of_the_cone() {
        let (inner, outer) = (0.3f32, 0.7f32);
        let [scale, offset] = spot_cos_scale_offset(inner, outer);
        let steps = 200_000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let cos = (i as f64 + 0.5) / steps as f64;
                (cos * f64::from(scale) + f64::from(offset)).clamp(0.0, 1.0).powi(2)
            })
            .sum();
        let integral = 2.0 * std::f64::consts::PI * sum / steps as f64;
        assert!((f64::from(spot_effective_solid_angle(inner, outer)) - integral).abs() < 1e-4);
    }

    #[test]
    fn lights_as_written() {
        assert_eq!(
            parse_light("directional:0,2,0:3").unwrap(),
            Light::Directional { direction_to_light: Vec3::Y, illuminance: Vec3::splat(3.0) }
        );
        assert_eq!(
            parse_light("point:1,2,3:10:1,0.5,0").unwrap(),
            Light::Point { position: Vec3::new(1.0, 2.0, 3.0), intensity: Vec3::new(10.0, 5.0, 0.0) }
        );
        let Light::Spot { direction, inner_angle, outer_angle, .. } =
            parse_light("spot:0,5,0:0,-3,0:100:10:20").unwrap()
        else {
            panic!("a spot light was written");
        };
        assert_eq!(direction, Vec3::NEG_Y);
        assert!((inner_angle - 10f32.to_radians()).abs() < 1e-7 && (outer_angle - 20f32.to_radians()).abs() < 1e-7);
    }

    #[test]
    fn wrong_lights_say_what_is_wrong() {
        for (spec, reason) in [
            ("", "no kind of light"),
            ("area:0,0,0:1", "`area` is no kind"),
            ("point:0,0:1", "2 numbers"),
            ("point:0,0,0", "3 fields"),
            ("point:0,0,0:x", "`x` is no number"),
            ("point:0,0,0:inf", "not finite"),
            ("point:0,0,0:-1", "negative"),
            ("point:0,0,0:1:1,1,-1", "negative"),
            ("directional:0,0,0:1", "no length"),
            ("spot:0,0,0:0,-1,0:1:30:20", "30 to 20 degrees"),
            ("spot:0,0,0:0,-1,0:1:0:0", "outer > 0"),
            ("point:0,0,0:1:1,1,1:9", "not 5"),
        ] {
            let error = parse_light(spec).unwrap_err();
            assert!(error.reason.contains(reason), "{spec}: {}", error.reason);
        }
    }

    #[test]
    fn sorting_keeps_the_order() {
        let lights = [
            parse_light("point:1,0,0:1").unwrap(),
            parse_light("directional:0,1,0:2").unwrap(),
            parse_light("point:2,0,0:1").unwrap(),
        ];
        let sorted = lights_by_kind(&lights);
        assert_eq!(sorted.directional.len(), 1);
        assert_eq!(sorted.point.iter().map(|l| l.position[0]).collect::<Vec<_>>(), [1.0, 2.0]);
        assert!(sorted.spot.is_empty());
    }
}
