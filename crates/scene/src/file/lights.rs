//! The lights of a scene file: quantities in their units become illuminance and intensity.

use glam::Vec3;

use super::LUMENS_PER_WATT;
use super::format::LightEntry;
use crate::light::{Light, cone, non_negative_color, spot_effective_solid_angle, unit};

/// The light of an entry; the error says what is wrong with it.
pub(super) fn read_light(entry: &LightEntry) -> Result<Light, String> {
    use std::f32::consts::PI;
    match *entry {
        LightEntry::Directional { direction_to_light, illuminance_lx, irradiance_w_m2, color } => {
            let strength = one_of([
                ("illuminance_lx", illuminance_lx, 1.0),
                ("irradiance_w_m2", irradiance_w_m2, LUMENS_PER_WATT),
            ])?;
            Ok(Light::Directional {
                direction_to_light: unit(finite_all(direction_to_light)?.into())?,
                illuminance: colored(color, strength)?,
            })
        }
        LightEntry::Point { position, intensity_cd, power_lm, power_w, color } => {
            let strength = one_of([
                ("intensity_cd", intensity_cd, 1.0),
                ("power_lm", power_lm, 1.0 / (4.0 * PI)),
                ("power_w", power_w, LUMENS_PER_WATT / (4.0 * PI)),
            ])?;
            Ok(Light::Point { position: finite_all(position)?.into(), intensity: colored(color, strength)? })
        }
        LightEntry::Spot { position, direction, intensity_cd, power_lm, power_w, inner_deg, outer_deg, color } => {
            let [inner_angle, outer_angle] = cone(inner_deg, outer_deg)?;
            let solid_angle = spot_effective_solid_angle(inner_angle, outer_angle);
            let strength = one_of([
                ("intensity_cd", intensity_cd, 1.0),
                ("power_lm", power_lm, 1.0 / solid_angle),
                ("power_w", power_w, LUMENS_PER_WATT / solid_angle),
            ])?;
            Ok(Light::Spot {
                position: finite_all(position)?.into(),
                direction: unit(finite_all(direction)?.into())?,
                intensity: colored(color, strength)?,
                inner_angle,
                outer_angle,
            })
        }
    }
}

/// The one quantity that is given, times its factor.
fn one_of<const N: usize>(quantities: [(&str, Option<f32>, f32); N]) -> Result<f32, String> {
    let given: Vec<_> = quantities.iter().filter_map(|&(name, value, factor)| Some((name, value?, factor))).collect();
    let names = quantities.map(|(name, ..)| name).join(", ");
    match given[..] {
        [(name, value, factor)] => {
            let strength = value * factor;
            if value >= 0.0 && strength.is_finite() {
                Ok(strength)
            } else {
                Err(format!("{name} must be finite and not negative"))
            }
        }
        [] => Err(format!("how strong is the light? Give one of {names}")),
        _ => Err(format!("give only one of {names}")),
    }
}

fn colored(color: [f32; 3], strength: f32) -> Result<Vec3, String> {
    let color = non_negative_color(finite_all(color)?.into())? * strength;
    if color.is_finite() { Ok(color) } else { Err("colour times strength is too large".into()) }
}

pub(super) fn finite_all(v: [f32; 3]) -> Result<[f32; 3], String> {
    if v.iter().all(|x| x.is_finite()) { Ok(v) } else { Err("a number is too large".into()) }
}
