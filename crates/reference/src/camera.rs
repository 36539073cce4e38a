//! Rays through the pixels of a picture: a pinhole, as the shaders' projection frames it.

use glam::DVec3;
use halfvector_scene::Camera;

use crate::geometry::Ray;

/// A camera and the size of its picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pinhole {
    position: DVec3,
    forward: DVec3,
    /// To the right and to the top of the picture, half of it long at distance 1.
    right: DVec3,
    up: DVec3,
    width: f64,
    height: f64,
}

impl Pinhole {
    /// Degenerate cameras (nothing to look at, `up` along the view) fall back on axes.
    pub(crate) fn new(camera: &Camera, width: u32, height: u32) -> Pinhole {
        let forward = (camera.target - camera.position).as_dvec3().try_normalize().unwrap_or(DVec3::NEG_Z);
        let right = forward
            .cross(camera.up.as_dvec3())
            .try_normalize()
            .or_else(|| forward.cross(DVec3::Z).try_normalize())
            .unwrap_or(DVec3::X);
        let half = (0.5 * f64::from(camera.vertical_fov).to_radians()).tan();
        let aspect = f64::from(width) / f64::from(height);
        Pinhole {
            position: camera.position.as_dvec3(),
            forward,
            right: right * (half * aspect),
            up: right.cross(forward) * half,
            width: f64::from(width),
            height: f64::from(height),
        }
    }

    /// The ray through a point of the picture in pixels; (0, 0) is its top left corner.
    pub(crate) fn ray(&self, x: f64, y: f64) -> Ray {
        let (x, y) = (2.0 * x / self.width - 1.0, 1.0 - 2.0 * y / self.height);
        Ray { origin: self.position, dir: (self.forward + x * self.right + y * self.up).normalize() }
    }

    /// The angle of a pixel in the middle of the picture [rad].
    pub(crate) fn pixel_angle(&self) -> f64 {
        2.0 * self.up.length() / self.height
    }
}
