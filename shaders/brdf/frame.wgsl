// The shading frame of a point, and the half vector of a light in it. Everything that a lobe asks of directions.

// Smallest n.v: below the library's domain of cosines, which starts at 1e-6. A shading normal may face away from the
// viewer (n.v < 0), where no BRDF is defined: such a point is shaded as seen at grazing incidence.
const N_DOT_V_FLOOR: f32 = 1e-7;

/// A shading normal and the viewer.
struct Frame {
    /// Shading normal in world space, unit.
    normal: vec3f,
    /// From the surface to the viewer in world space, unit.
    view_dir: vec3f,
    /// n.v in [1e-7, 1].
    n_dot_v: f32,
}

/// The half vector h = (v + l) / |v + l| of one light, as the cosines that a microfacet lobe needs.
struct Half {
    /// n.l in [0, 1]; 0 where the light is behind the surface.
    n_dot_l: f32,
    /// n.h.
    n_dot_h: f32,
    /// l.h = v.h in [0, 1].
    l_dot_h: f32,
    /// sin^2 of the angle between n and h, as |n x h|^2.
    sin2_theta_h: f32,
    /// h, unit; zero where there is none.
    h: vec3f,
}

/// The frame of a unit shading normal and a unit direction to the viewer, with n.v held in [N_DOT_V_FLOOR, 1].
///
/// NaN in either gives n_dot_v = N_DOT_V_FLOOR.
fn frame_from_normal(normal: vec3f, view_dir: vec3f) -> Frame {
    return Frame(normal, view_dir, clamp(dot(normal, view_dir), N_DOT_V_FLOOR, 1.0));
}

/// The half vector of the unit direction `dir` to a light.
///
/// s = v + l,  l.h = |s| / 2,  n.h = n.s / |s|,  sin^2 = |n x s|^2 / |s|^2.
/// No term subtracts numbers of equal size but the cross product itself: 1 - (n.h)^2 has no correct digit left in f32
/// below an angle of 3e-4, and v.h by a dot product none where l is opposite to v.
/// Where v + l = 0 there is no half vector: l.h = n.h = 0 and sin^2 = 1, which is h in the tangent plane.
fn half_from_light(frame: Frame, dir: vec3f) -> Half {
    let sum = frame.view_dir + dir;
    let length2 = dot(sum, sum);
    let has_half = length2 > LENGTH2_FLOOR;
    let inv_length = select(0.0, inverseSqrt(length2), has_half);
    let h = sum * inv_length;
    let sine = cross(frame.normal, h);
    return Half(
        saturate(dot(frame.normal, dir)),
        dot(frame.normal, h),
        0.5 * length2 * inv_length,
        select(1.0, dot(sine, sine), has_half),
        h,
    );
}
