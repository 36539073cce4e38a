//! The camera: where it stands, what it frames, how near it has to see. Matrices are the renderers' business.

use glam::Vec3;

use crate::mesh::Bounds;

/// A pinhole camera. The default is the framing of a unit sphere at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// In world space [m].
    pub position: Vec3,
    /// The point in the middle of the picture, in world space [m].
    pub target: Vec3,
    /// Points to the top of the picture as far as it can.
    pub up: Vec3,
    /// Vertical field of view [deg], more than 0 and less than 180.
    pub vertical_fov: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Camera { position: Vec3::new(0.0, 0.0, 5.0), target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 30.0 }
    }
}

/// How much larger than the box a framed picture is.
const MARGIN: f32 = 1.08;

impl Camera {
    /// A camera on +Z of the box that looks along -Z at its middle and has all of it in a square picture.
    pub fn framing(bounds: Bounds) -> Camera {
        let target = bounds.center();
        let half = bounds.max * 0.5 - bounds.min * 0.5;
        let vertical_fov = Camera::default().vertical_fov;
        let slope = (0.5 * vertical_fov).to_radians().tan();
        // A point has its smallest positive normal number as extent, so that the camera does not stand in it.
        let extent = half.max_element().max(1e-6 * target.abs().max_element()).max(1e-18);
        let distance = (half.x.max(half.y) * MARGIN / slope + half.z).max(extent);
        Camera { position: target + Vec3::Z * distance, target, up: Vec3::Y, vertical_fov }
    }

    /// Distance of the near plane [m], as far out as a box with everything in it lets it be and never 0. The surface may
    /// stand out of the box by half of the way to the camera, as displaced ones do. Models of millimetres and of
    /// hundreds of metres both work.
    pub fn near(&self, bounds: Option<Bounds>) -> f32 {
        let Some(bounds) = bounds else { return 0.01 };
        let forward = (self.target - self.position).normalize_or(Vec3::NEG_Z);
        let depths = bounds.corners().map(|corner| (corner - self.position).dot(forward));
        let nearest = depths.into_iter().fold(f32::INFINITY, f32::min);
        let farthest = depths.into_iter().fold(0.0, f32::max);
        (0.5 * nearest).max(1e-4 * farthest).max(1e-18)
    }

    /// What makes the camera useless, in the user's words.
    pub fn check(&self) -> Result<(), String> {
        if !(self.position.is_finite() && self.target.is_finite() && self.up.is_finite()) {
            return Err("position, target and up must be finite".into());
        }
        if !(self.vertical_fov > 0.0 && self.vertical_fov < 180.0) {
            return Err(format!("the vertical field of view is {} degrees; 0 to 180 is possible", self.vertical_fov));
        }
        if (self.target - self.position).try_normalize().is_none() {
            return Err("position and target are the same point; move one of them".into());
        }
        if self.up.try_normalize().is_none() {
            return Err("up has no length; 0,1,0 is usual".into());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(size: f32, at: Vec3) -> Bounds {
        Bounds { min: at - Vec3::splat(size), max: at + Vec3::splat(size) }
    }

    #[test]
    fn tiny_and_huge_models_are_framed() {
        for size in [1e-12, 0.0025, 1.0, 250.0, 1e12] {
            for at in [Vec3::ZERO, Vec3::new(3.0, -2.0, 7.0) * size] {
                let bounds = bounds(size, at);
                let camera = Camera::framing(bounds);
                camera.check().unwrap();
                let near = camera.near(Some(bounds));
                let slope = (0.5 * camera.vertical_fov).to_radians().tan();
                for corner in bounds.corners() {
                    let depth = camera.position.z - corner.z;
                    assert!(depth > near, "size {size}: near plane {near} cuts at {depth}");
                    let offset = corner - camera.target;
                    let reach = offset.x.abs().max(offset.y.abs()) / (depth * slope);
                    assert!(reach < 1.0, "size {size}: a corner lies at {reach} of the half picture");
                    assert!(reach > 0.5, "size {size}: the model fills only {reach} of the half picture");
                }
            }
        }
    }

    #[test]
    fn a_point_and_a_flat_model_are_framed() {
        for bounds in [bounds(0.0, Vec3::ZERO), bounds(0.0, Vec3::splat(1e6))] {
            let camera = Camera::framing(bounds);
            camera.check().unwrap();
            assert!(camera.near(Some(bounds)) > 0.0);
        }
    }

    #[test]
    fn near_is_positive_inside_of_the_model() {
        let camera = Camera { position: Vec3::ZERO, target: Vec3::NEG_Z, ..Camera::default() };
        let near = camera.near(Some(bounds(10.0, Vec3::ZERO)));
        assert!(near > 0.0 && near < 0.01);
        // Everything behind the camera.
        assert!(camera.near(Some(bounds(1.0, Vec3::Z * 10.0))) > 0.0);
        assert!(camera.near(None) > 0.0);
    }

    #[test]
    fn useless_cameras_say_why() {
        let camera = Camera::default();
        let cases = [
            (Camera { vertical_fov: 0.0, ..camera }, "field of view"),
            (Camera { vertical_fov: f32::NAN, ..camera }, "field of view"),
            (Camera { target: camera.position, ..camera }, "same point"),
            (Camera { up: Vec3::ZERO, ..camera }, "up has no length"),
            (Camera { position: Vec3::INFINITY, ..camera }, "finite"),
        ];
        for (camera, reason) in cases {
            assert!(camera.check().unwrap_err().contains(reason), "{camera:?}");
        }
    }
}
