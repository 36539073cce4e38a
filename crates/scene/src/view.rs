//! Where a camera looks, as matrices: the projection of a tile, and the directions behind it.
//!
//! Depth is 1 at the near plane and 0 at infinity; clip space is WebGPU's, y up. Nothing is drawn here.

use glam::{Mat4, Vec3, Vec4};

use crate::camera::Camera;
use crate::picture::Tile;

/// A camera with a picture's proportions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub position: Vec3,
    /// Where it looks: unit.
    pub forward: Vec3,
    /// Unit, to the right of the picture.
    right: Vec3,
    /// Unit, to the top of the picture.
    up: Vec3,
    /// Half of the picture's width and height at distance 1.
    half: [f32; 2],
    near: f32,
}

impl View {
    /// What a camera sees in a picture of this aspect ratio (width / height), from the distance `near` on. Degenerate
    /// cameras (nothing to look at, `up` along the view) fall back on axes.
    pub fn new(camera: &Camera, near: f32, aspect: f32) -> View {
        let forward = (camera.target - camera.position).try_normalize().unwrap_or(Vec3::NEG_Z);
        let right = forward
            .cross(camera.up)
            .try_normalize()
            .or_else(|| forward.cross(Vec3::Z).try_normalize())
            .unwrap_or(Vec3::X);
        let half_height = (0.5 * camera.vertical_fov.to_radians()).tan();
        View {
            position: camera.position,
            forward,
            right,
            up: right.cross(forward),
            half: [half_height * aspect, half_height],
            near: near.max(f32::MIN_POSITIVE),
        }
    }

    /// View from world: the viewer at the origin, +x right, +y up, looking along -z.
    pub fn view_from_world(&self) -> Mat4 {
        Mat4::from_cols(self.right.extend(0.0), self.up.extend(0.0), (-self.forward).extend(0.0), Vec4::W).transpose()
            * Mat4::from_translation(-self.position)
    }

    /// Clip from world for a tile of a picture, with depth 1 at the near plane and 0 at infinity. The tile's rectangle
    /// fills the clip square: x and y of the whole picture's clip space are stretched and shifted.
    pub fn clip_from_world(&self, width: u32, height: u32, tile: Tile) -> Mat4 {
        let [half_x, half_y] = self.half;
        let clip_from_view = Mat4::from_cols(
            Vec4::new(1.0 / half_x, 0.0, 0.0, 0.0),
            Vec4::new(0.0, 1.0 / half_y, 0.0, 0.0),
            Vec4::new(0.0, 0.0, 0.0, -1.0),
            Vec4::new(0.0, 0.0, self.near, 0.0),
        );
        let [scale_x, offset_x, scale_y, offset_y] = tile_crop(width, height, tile);
        let tile_from_clip = Mat4::from_cols(
            Vec4::new(scale_x, 0.0, 0.0, 0.0),
            Vec4::new(0.0, scale_y, 0.0, 0.0),
            Vec4::Z,
            Vec4::new(offset_x, offset_y, 0.0, 1.0),
        );
        tile_from_clip * clip_from_view * self.view_from_world()
    }

    /// (right, up, forward) so that forward + x right + y up is the world direction, not unit, through clip position
    /// (x, y) of a tile.
    pub fn tile_directions(&self, width: u32, height: u32, tile: Tile) -> [Vec3; 3] {
        let [scale_x, offset_x, scale_y, offset_y] = tile_crop(width, height, tile);
        let [right, up] = [self.right * self.half[0], self.up * self.half[1]];
        let forward = self.forward - right * (offset_x / scale_x) - up * (offset_y / scale_y);
        [right / scale_x, up / scale_y, forward]
    }

    /// The numbers of the uniform struct `Background` of `entry/background.wgsl` for a tile, padding among them: right, up
    /// and forward on 16 bytes each, (cos, sin) of the environment's rotation, and 1 where the picture holds display values
    /// by the report's gamma instead of radiance.
    pub fn background_numbers(
        &self,
        width: u32,
        height: u32,
        tile: Tile,
        environment_rotation: [f32; 2],
        gamma_coded: bool,
    ) -> [f32; 16] {
        let [right, up, forward] = self.tile_directions(width, height, tile);
        let [cos, sin] = environment_rotation;
        let coded = f32::from(gamma_coded);
        let (r, u, f) = (right, up, forward);
        [r.x, r.y, r.z, 0.0, u.x, u.y, u.z, 0.0, f.x, f.y, f.z, 0.0, cos, sin, coded, 0.0]
    }
}

/// (scale x, offset x, scale y, offset y) that take the picture's clip square to the tile's.
fn tile_crop(width: u32, height: u32, tile: Tile) -> [f32; 4] {
    let axis = |whole: u32, start: u32, length: u32| {
        let (whole, start, length) = (f64::from(whole), f64::from(start), f64::from(length));
        [whole / length, (whole - 2.0 * start - length) / length]
    };
    let [scale_x, offset_x] = axis(width, tile.x, tile.width);
    let [scale_y, offset_y] = axis(height, tile.y, tile.height);
    // Rows go down, clip y goes up.
    [scale_x, offset_x, scale_y, -offset_y].map(|x| x as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        let camera = Camera {
            position: Vec3::new(1.0, 2.0, 5.0),
            target: Vec3::new(0.0, 0.5, 0.0),
            up: Vec3::Y,
            vertical_fov: 40.0,
        };
        View::new(&camera, 0.1, 2.0)
    }

    #[test]
    fn a_tile_shows_its_part_of_the_picture() {
        let whole = Tile { x: 0, y: 0, width: 40, height: 20 };
        let tile = Tile { x: 10, y: 5, width: 15, height: 10 };
        let point = Vec3::new(0.1, 0.6, 0.2);
        let project = |tile| {
            let clip = view().clip_from_world(40, 20, tile) * point.extend(1.0);
            [clip.x / clip.w, clip.y / clip.w, clip.z / clip.w]
        };
        let pixel = |tile: Tile| {
            let [x, y, _] = project(tile);
            [tile.x as f32 + (x + 1.0) * 0.5 * tile.width as f32, tile.y as f32 + (1.0 - y) * 0.5 * tile.height as f32]
        };
        for (a, b) in pixel(whole).iter().zip(pixel(tile)) {
            assert!((a - b).abs() < 1e-4, "{:?} {:?}", pixel(whole), pixel(tile));
        }
        assert_eq!(project(whole)[2], project(tile)[2]);
    }

    #[test]
    fn directions_and_projection_agree() {
        let view = view();
        let tile = Tile { x: 3, y: 7, width: 9, height: 4 };
        let [right, up, forward] = view.tile_directions(40, 20, tile);
        for (x, y) in [(0.0, 0.0), (-1.0, 1.0), (0.3, -0.8)] {
            let point = view.position + 3.0 * (forward + x * right + y * up);
            let clip = view.clip_from_world(40, 20, tile) * point.extend(1.0);
            assert!((clip.x / clip.w - x).abs() < 1e-4 && (clip.y / clip.w - y).abs() < 1e-4);
        }
    }

    #[test]
    fn depth_is_one_at_the_near_plane_and_falls() {
        let view = view();
        let whole = Tile { x: 0, y: 0, width: 40, height: 20 };
        let depth = |distance: f32| {
            let clip = view.clip_from_world(40, 20, whole) * (view.position + view.forward * distance).extend(1.0);
            clip.z / clip.w
        };
        assert!((depth(0.1) - 1.0).abs() < 1e-4);
        assert!(depth(1.0) > depth(2.0) && depth(1e6) > 0.0);
    }

    #[test]
    fn looking_along_up_still_gives_a_frame() {
        let camera = Camera { position: Vec3::Y, ..Camera::default() };
        let view = View::new(&camera, 0.1, 1.0);
        assert!(view.right.is_finite() && (view.right.length() - 1.0).abs() < 1e-6);
        let stuck = View::new(&Camera { target: Vec3::Y, up: Vec3::ZERO, ..camera }, 0.0, 1.0);
        assert!(stuck.up.is_finite() && stuck.right.is_finite());
    }
}
