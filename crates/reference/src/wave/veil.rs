//! What stands between a shaded point and its light.

use glam::DVec3;
use halfvector_graph::document::AlphaMode;

use super::MOST_PASSED;
use crate::ReferenceError;
use crate::bsdf::Bsdf;
use crate::geometry::Ray;
use crate::material::{Evaluator, Surface};
use crate::render::Reference;

/// A point that is shaded.
pub(super) struct Place<'p> {
    pub(super) bsdf: &'p Bsdf<'p>,
    pub(super) position: DVec3,
    pub(super) geometric_normal: DVec3,
    pub(super) primitive: u32,
}

impl Place<'_> {
    /// Whether a direction lies behind the shading normal: into the body.
    pub(super) fn is_behind(&self, dir: [f64; 3]) -> bool {
        DVec3::from(dir).dot(DVec3::from(self.bsdf.normal())) <= 0.0
    }
}

/// What stands between a point and its light.
pub(super) struct Veil<'w, 'r> {
    pub(super) reference: &'r Reference<'r>,
    pub(super) evaluators: &'w mut [Option<Evaluator<'r>>],
    pub(super) surfaces: &'w mut Vec<Surface>,
}

impl Veil<'_, '_> {
    /// The share of the light from a direction that arrives. What enters a body is taken to leave it again on the other
    /// side.
    pub(super) fn sees(&mut self, place: &Place<'_>, dir: [f64; 3], distance: f64) -> Result<f64, ReferenceError> {
        if !self.reference.options.shadows || place.is_behind(dir) {
            return Ok(1.0);
        }
        let ray = Ray { origin: place.position, dir: DVec3::from(dir) };
        if ray.dir.dot(place.geometric_normal) <= 0.0 {
            return Ok(0.0);
        }
        if self.reference.is_opaque {
            let blocked = self.reference.geometry.is_blocked(&ray, place.primitive, distance);
            return Ok(if blocked { 0.0 } else { 1.0 });
        }
        self.passed(ray, place.primitive, distance)
    }

    /// The same where surfaces are cut out or blended: each one on the way is evaluated.
    fn passed(&mut self, mut ray: Ray, mut from: u32, mut distance: f64) -> Result<f64, ReferenceError> {
        let geometry = &self.reference.geometry;
        let mut share = 1.0;
        for _ in 0..MOST_PASSED {
            let Some(hit) = geometry.first(&ray, from).filter(|hit| hit.t < distance) else { return Ok(share) };
            let index = self.reference.material_of(&hit);
            let (Some(material), Some(evaluator)) = (&self.reference.materials[index], &mut self.evaluators[index])
            else {
                return Ok(0.0);
            };
            if material.settings.alpha_mode == AlphaMode::Opaque {
                return Ok(0.0);
            }
            let mut point = [geometry.point(&ray, &hit, material.detail)];
            if material.detail.places {
                geometry.wrap(&mut point);
            }
            let beside = point;
            let steps = material.derives.then_some([beside.as_slice(), beside.as_slice()]);
            evaluator.surfaces(&mut point, steps, self.surfaces)?;
            let opacity = self.surfaces.first().map_or(1.0, |surface| surface.opacity.clamp(0.0, 1.0));
            share *= match material.settings.alpha_mode {
                AlphaMode::Mask if opacity < f64::from(material.settings.alpha_cutoff) => 1.0,
                AlphaMode::Mask | AlphaMode::Opaque => 0.0,
                AlphaMode::Blend => 1.0 - opacity,
            };
            if share == 0.0 {
                return Ok(0.0);
            }
            distance -= hit.t;
            ray.origin += hit.t * ray.dir;
            from = hit.primitive;
        }
        Ok(0.0)
    }
}
