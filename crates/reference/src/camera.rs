//! Rays through the pixels of a picture: a pinhole, as the shaders' projection frames it.

use glam::DVec3;
use halfvector_scene::Camera;

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

    /// Where all rays start.
    pub(crate) fn position(&self) -> DVec3 {
        self.position
    }

    /// The unit direction through a point of the picture in pixels; (0, 0) is its top left corner.
    #[inline(always)]
    pub(crate) fn dir(&self, x: f64, y: f64) -> [f64; 3] {
        let (x, y) = (2.0 * x / self.width - 1.0, 1.0 - 2.0 * y / self.height);
        let along = |forward: f64, right: f64, up: f64| forward + x * right + y * up;
        let dir = [
            along(self.forward.x, self.right.x, self.up.x),
            along(self.forward.y, self.right.y, self.up.y),
            along(self.forward.z, self.right.z, self.up.z),
        ];
        let length = (dir[0] * dir[0] + dir[1] * dir[1] + dir[2] * dir[2]).sqrt();
        dir.map(|x| x * (1.0 / length))
    }

    /// The angle of a pixel in the middle of the picture [rad].
    pub(crate) fn pixel_angle(&self) -> f64 {
        2.0 * self.up.length() / self.height
    }
}
