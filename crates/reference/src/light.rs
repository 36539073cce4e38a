//! Punctual lights in f64.

use halfvector_scene::Light;
use halfvector_scene::light::{
    DirectionalLight, LightSample, PointLight, SpotLight, directional_light_sample, lights_by_kind, point_light_sample,
    spot_light_sample,
};

/// The lights of a scene.
pub(crate) struct Lights {
    directional: Vec<DirectionalLight<f64>>,
    point: Vec<PointLight<f64>>,
    spot: Vec<SpotLight<f64>>,
}

impl Lights {
    pub(crate) fn new(lights: &[Light]) -> Lights {
        let sorted = lights_by_kind(lights);
        let wide = |x: [f32; 3]| x.map(f64::from);
        Lights {
            directional: sorted
                .directional
                .iter()
                .map(|light| DirectionalLight {
                    direction: wide(light.direction),
                    illuminance: wide(light.illuminance),
                })
                .collect(),
            point: sorted
                .point
                .iter()
                .map(|light| PointLight { position: wide(light.position), intensity: wide(light.intensity) })
                .collect(),
            spot: sorted
                .spot
                .iter()
                .map(|light| SpotLight {
                    position: wide(light.position),
                    intensity: wide(light.intensity),
                    direction: wide(light.direction),
                    cos_scale: f64::from(light.cos_scale),
                    cos_offset: f64::from(light.cos_offset),
                })
                .collect(),
        }
    }

    /// What arrives at a point from each light, and how far the light is.
    pub(crate) fn at(&self, position: [f64; 3]) -> impl Iterator<Item = (LightSample<f64>, f64)> {
        let distance = move |from: [f64; 3]| {
            let way: [f64; 3] = std::array::from_fn(|i| from[i] - position[i]);
            way.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        let directional = self.directional.iter().map(move |l| (directional_light_sample(*l, position), f64::INFINITY));
        let point = self.point.iter().map(move |l| (point_light_sample(*l, position), distance(l.position)));
        let spot = self.spot.iter().map(move |l| (spot_light_sample(*l, position), distance(l.position)));
        directional.chain(point).chain(spot)
    }
}
