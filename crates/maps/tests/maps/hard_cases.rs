//! One test for each row of the hard-case catalogue about texels, normals, tangents, UVs, sRGB and scale, in f32 and f64.

use halfvector_maps::color::{gamma_from_linear, linear_from_srgb, luminance, srgb_from_linear};
use halfvector_maps::derivative::tangent_from_derivatives;
use halfvector_maps::frame::{cofactor, handedness, normal_from_object, transformed};
use halfvector_maps::height::{displaced, normal_from_height};
use halfvector_maps::normal::{
    normal_from_texel, normal_rotation_fixed, normal_rotation_report, normal_tbn, tangent_from_normal,
};
use halfvector_maps::{ColorSpace, Image, MapKind, Real, Texels, mip_chain, tangents};

use crate::{assert_near, cross, degrees_between, dot, is_unit, r, unit, v, wide};

/// A generic test as two tests.
macro_rules! in_f32_and_f64 {
    ($(#[doc = $doc:literal])* fn $name:ident<$real:ident>() $body:block) => {
        mod $name {
            use super::*;
            $(#[doc = $doc])*
            fn check<$real: Real>() $body
            #[test]
            fn in_f32() {
                check::<f32>();
            }
            #[test]
            fn in_f64() {
                check::<f64>();
            }
        }
    };
}

const AXES: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];

/// Values that a buffer may hold by mistake.
const BAD: [f64; 9] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, 1e-30, 1e-45, 1e25, -3e38];

in_f32_and_f64! {
    /// Row "normal texel zero": (.5, .5, .5) is 0/0 when it is only normalised; it is straight up.
    fn normal_texel_zero<R>() {
        assert_eq!(wide(normal_from_texel::<R>(v([0.5; 3]), r(1.0), false)), [0.0, 0.0, 1.0]);
        assert_eq!(wide(normal_from_texel::<R>(v([0.9, 0.1, 0.5]), r(0.0), true)), [0.0, 0.0, 1.0]);
    }
}

in_f32_and_f64! {
    /// Row "normal texel 8-bit flat": read as unorm, (128, 128, 255) leans by .318 degrees and (127, 127, 255) the other way.
    fn normal_texel_8_bit_flat<R>() {
        let texel = |c: f64| wide(normal_from_texel::<R>(v([c / 255.0, c / 255.0, 1.0]), r(1.0), false));
        assert!((degrees_between(texel(128.0), [0.0, 0.0, 1.0]) - 0.3178).abs() < 1e-3);
        assert!(texel(128.0)[0] > 0.0 && texel(127.0)[0] < 0.0);
    }
}

in_f32_and_f64! {
    /// Strength scales the slope, and the flip turns y over: -Y (DirectX) maps become +Y.
    fn texel_strength_and_flip<R>() {
        let color = v([0.75, 0.7, 0.9]);
        let (plain, strong) = (normal_from_texel::<R>(color, r(1.0), false), normal_from_texel(color, r(3.0), false));
        assert_near(strong, unit([1.5, 1.2, 0.8]), 1e-6);
        let flipped = wide(normal_from_texel::<R>(color, r(1.0), true));
        assert_near(plain, [flipped[0], -flipped[1], flipped[2]], 1e-6);
    }
}

in_f32_and_f64! {
    /// Row "normal z=0 rotation": t.z = 0 makes the angles pi/2 by the branch, and with t.y = 0 zero; never NaN.
    fn normal_z_zero_rotation<R>() {
        // ax = ay = az = pi/2 on +Z: Rx sends it to -Y, Ry keeps that, Rz turns it to +X.
        assert_near(normal_rotation_report::<R>(v([0.55, 0.83, 0.0]), v([0.0, 0.0, 1.0])), [1.0, 0.0, 0.0], 1e-6);
        assert_near(normal_rotation_report::<R>(v([0.55, 0.83, -0.0]), v([0.0, 0.0, 1.0])), [1.0, 0.0, 0.0], 1e-6);
        // t.y = t.z = 0: ax = az = 0, ay = pi/2.
        assert_near(normal_rotation_report::<R>(v([1.0, 0.0, 0.0]), v([0.0, 0.0, 1.0])), [1.0, 0.0, 0.0], 1e-6);
        assert_near(normal_rotation_report::<R>(v([-1.0, 0.0, 0.0]), v([0.0, 0.0, 1.0])), [-1.0, 0.0, 0.0], 1e-6);
        // t = 0: no rotation.
        assert_near(normal_rotation_report::<R>(v([0.0; 3]), v([0.0, 0.6, 0.8])), [0.0, 0.6, 0.8], 1e-6);
        assert_near(normal_rotation_fixed::<R>(v([0.0; 3]), v([0.0, 0.6, 0.8])), [0.0, 0.6, 0.8], 1e-6);
        // The tangent frame has no angle to lose.
        let frame = [r(1.0), r(0.0), r(0.0), r(1.0)];
        assert_near(normal_tbn::<R>(v([0.4, 0.6, 0.0]), v([0.0, 0.0, 1.0]), frame), unit([0.4, 0.6, 0.0]), 1e-6);
    }
}

in_f32_and_f64! {
    /// Row "normal z<0 rotation": atan(y / z) loses the quadrant. The report's form keeps that fault, the mended one not.
    fn normal_z_negative_rotation<R>() {
        let t = unit([0.3, 0.4, -0.5]);
        let fixed = wide(normal_rotation_fixed::<R>(v(t), v([0.0, 0.0, 1.0])));
        assert!(fixed[0] > 0.0 && fixed[1] > 0.0 && fixed[2] < 0.0, "{fixed:?}");
        let report = wide(normal_rotation_report::<R>(v(t), v([0.0, 0.0, 1.0])));
        assert_near(v::<R>(report), by_angles(t, [0.0, 0.0, 1.0]), 1e-6);
        assert!(report[2] > 0.0, "the report's atan turns a texel that points down up again");
    }
}

/// The report's words, literally: three angles, three matrices.
fn by_angles(t: [f64; 3], n: [f64; 3]) -> [f64; 3] {
    let atan = |y: f64, x: f64| {
        if x != 0.0 {
            (y / x).atan()
        } else if y == 0.0 {
            0.0
        } else {
            y.signum() * std::f64::consts::FRAC_PI_2
        }
    };
    let (ax, ay, az) = (atan(t[1], t[2]), atan(t[0], t[2]), atan(t[1], t[2]));
    let apply = |m: [[f64; 3]; 3], n: [f64; 3]| m.map(|row| dot(row, n));
    let (s, c) = ax.sin_cos();
    let n = apply([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]], n);
    let (s, c) = ay.sin_cos();
    let n = apply([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]], n);
    let (s, c) = az.sin_cos();
    apply([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], n)
}

in_f32_and_f64! {
    /// The algebraic cosines and sines are the report's angles, on a lattice of texels and normals.
    fn rotation_report_is_the_three_angles<R>() {
        let lattice = || (-4..=4).map(|i| f64::from(i) / 4.0);
        for x in lattice() {
            for y in lattice() {
                for z in lattice() {
                    for n in AXES.into_iter().chain([unit([1.0, -2.0, 3.0]), unit([-3.0, 1.0, -2.0])]) {
                        assert_near(normal_rotation_report::<R>(v([x, y, z]), v(n)), by_angles([x, y, z], n), 1e-6);
                    }
                }
            }
        }
    }
}

in_f32_and_f64! {
    /// Row "rotation method accuracy": two rotations do not commute, and are 11.72 degrees off where the tangent frame is exact.
    fn rotation_method_accuracy<R>() {
        let (t, up) = ([0.6, 0.6, 0.28_f64.sqrt()], [0.0, 0.0, 1.0]);
        let fixed = normal_rotation_fixed::<R>(v(t), v(up));
        assert_near(fixed, [0.496_078_37, 0.75, 0.4375], 1e-6);
        assert!((degrees_between(wide(fixed), t) - 11.72).abs() < 0.01);
        assert_near(normal_tbn::<R>(v(t), v(up), [r(1.0), r(0.0), r(0.0), r(1.0)]), t, 1e-6);
    }
}

in_f32_and_f64! {
    /// Rows "degenerate UV", "near-degenerate UV" and "mirrored UV" where the tangent comes from derivatives.
    fn tangents_of_degenerate_derivatives<R>() {
        let tangent = |[ux, vx, uy, vy]: [f64; 4]| {
            let (px, py, n) = (v([1.0, 0.0, 0.0]), v([0.0, 1.0, 0.0]), v([0.0, 0.0, 1.0]));
            tangent_from_derivatives::<R>(px, py, n, [r(ux), r(vx)], [r(uy), r(vy)])
        };
        for ([ux, vx, uy, vy], want) in [
            ([0.0; 4], [0.0, 0.0, 0.0]),
            ([1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0]),
            ([7.071e-7, 0.0, 0.0, -7.071e-7], [1.0, 0.0, 0.0]),
            ([-1.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]),
        ] {
            let [x, y, z, w] = tangent([ux, vx, uy, vy]);
            assert_near([x, y, z], want, 1e-6);
            if want != [0.0; 3] {
                assert_eq!(w.to_f64(), want[0]);
            }
            // A zero tangent is read as: any will do.
            assert!((wide(normal_tbn(v([0.6, 0.0, 0.8]), v([0.0, 0.0, 1.0]), [x, y, z, w]))[2] - 0.8).abs() < 1e-6);
        }
    }
}

in_f32_and_f64! {
    /// Rows "Frisvad basis": at the south pole and next to it.
    fn frisvad_basis<R>() {
        for n in [[0.0, 0.0, -1.0], [0.000_488_3, 0.0, -0.999_999_881], [0.000_345_3, 0.0, -0.999_999_94]] {
            let t = tangent_from_normal::<R>(v(n));
            assert!(is_unit(t) && dot(wide(t), n).abs() < 1e-6, "{n:?}: {:?}", wide(t));
        }
    }
}

in_f32_and_f64! {
    /// Row "non-unit interpolated n": a normal halfway between +-45 degrees has length .707; results are unit.
    fn non_unit_interpolated_normal<R>() {
        let s = 0.5_f64.sqrt();
        let n = v([0.0, 0.0, s]);
        for t in [[0.0, 0.0, 1.0], unit([0.3, -0.4, 0.9])] {
            assert!(is_unit(normal_tbn::<R>(v(t), n, [r(1.0), r(0.0), r(0.0), r(1.0)])));
            assert!(is_unit(normal_rotation_report::<R>(v(t), n)));
            assert!(is_unit(normal_rotation_fixed::<R>(v(t), n)));
        }
        // MikkTSpace's rule: B and N keep the short length, T its own.
        let got = normal_tbn::<R>(v([0.6, 0.0, 0.8]), n, [r(1.0), r(0.0), r(0.0), r(1.0)]);
        assert_near(got, unit([0.6, 0.0, 0.8 * s]), 1e-6);
    }
}

in_f32_and_f64! {
    /// Row "opposed interpolated n": the midpoint of n and -n is no direction; +Z stands in, finite and unit.
    fn opposed_interpolated_normals<R>() {
        let zero = v([0.0; 3]);
        let t = unit([0.3, -0.4, 0.9]);
        assert_near(normal_tbn::<R>(v(t), zero, [r(1.0), r(0.0), r(0.0), r(1.0)]), t, 1e-6);
        assert!(is_unit(normal_rotation_report::<R>(v(t), zero)));
        assert!(is_unit(normal_rotation_fixed::<R>(v(t), zero)));
    }
}

in_f32_and_f64! {
    /// Row "tangent || normal", and a zero tangent: any perpendicular one, and the tilt of the texel is kept.
    fn tangent_parallel_to_normal<R>() {
        for n in AXES.into_iter().chain([unit([1.0, 2.0, -3.0])]) {
            for tangent in [n, n.map(|x| -x), n.map(|x| 1e-3 * x), [0.0; 3], [f64::NAN; 3], [f64::INFINITY; 3]] {
                let [x, y, z] = v::<R>(tangent);
                let got = normal_tbn::<R>(v([0.6, 0.0, 0.8]), v(n), [x, y, z, r(-1.0)]);
                assert!(is_unit(got));
                assert!((dot(wide(got), n) - 0.8).abs() < 1e-5, "{n:?} {tangent:?}");
                assert_near(normal_tbn::<R>(v([0.0, 0.0, 1.0]), v(n), [x, y, z, r(1.0)]), n, 1e-6);
            }
        }
    }
}

in_f32_and_f64! {
    /// Row "mirrored UV": the bitangent is w cross(N, T); w = -1 turns the y of the map.
    fn mirrored_handedness<R>() {
        let n = v([0.0, 0.0, 1.0]);
        let map = |w| normal_tbn::<R>(v([0.0, 0.6, 0.8]), n, [r(1.0), r(0.0), r(0.0), r(w)]);
        assert_near(map(1.0), [0.0, 0.6, 0.8], 1e-6);
        assert_near(map(-1.0), [0.0, -0.6, 0.8], 1e-6);
        // An interpolated w is off by rounding: only its sign counts.
        assert_eq!(wide(map(-0.999)), wide(map(-1.0)));
    }
}

in_f32_and_f64! {
    /// Every function is finite and unit for every input, also for what a buffer holds by mistake.
    fn finite_and_unit_for_any_input<R>() {
        for a in BAD {
            for b in BAD {
                for c in BAD {
                    for other in [[0.0, 0.0, 1.0], [a, c, b], [f64::NAN; 3], [0.0; 3]] {
                        let (t, n) = (v::<R>([a, b, c]), v::<R>(other));
                        assert!(is_unit(normal_from_texel(t, r(b), false)));
                        for (t, n) in [(t, n), (n, t)] {
                            assert!(is_unit(normal_rotation_report(t, n)), "{t:?} {n:?}", t = wide(t), n = wide(n));
                            assert!(is_unit(normal_rotation_fixed(t, n)));
                            assert!(is_unit(normal_tbn(t, n, [r(1.0), r(0.0), r(0.0), r(1.0)])));
                            assert!(is_unit(normal_tbn(v([0.6, 0.0, 0.8]), n, [t[0], t[1], t[2], r(a)])));
                        }
                    }
                }
            }
        }
    }
}

in_f32_and_f64! {
    /// A basis without a pole: orthonormal on a spiral over the sphere, at both poles and next to them.
    fn basis_without_a_pole<R>() {
        let spiral = (0..10_000).map(|i| {
            let z = 1.0 - (f64::from(i) + 0.5) / 5000.0;
            let (s, c) = (f64::from(i) * 2.399_963).sin_cos();
            let sine = (1.0 - z * z).sqrt();
            [sine * c, sine * s, z]
        });
        let near_poles = [-1.0, 1.0].into_iter().flat_map(|z| {
            [0.0, 1e-7, -1e-7, 1e-4].map(|x| unit([x, -x, z]))
        });
        for n in spiral.chain(near_poles).chain(AXES).chain([[1.0, 0.0, -0.0]]) {
            let n = v::<R>(n);
            let t = tangent_from_normal(n);
            assert!(is_unit(t), "{:?}", wide(n));
            assert!(dot(wide(t), wide(n)).abs() < 1e-6, "{:?}", wide(n));
        }
    }
}

in_f32_and_f64! {
    /// Row "non-uniform scale": scale(1, 1, 10) on (0, .7071, .7071) is (0, .995, .0995), not 78.6 degrees off.
    fn non_uniform_scale<R>() {
        let m = [v([1.0, 0.0, 0.0]), v([0.0, 1.0, 0.0]), v([0.0, 0.0, 10.0])];
        let n = unit(wide(transformed(normal_from_object::<R>(m), v(unit([0.0, 1.0, 1.0])))));
        assert_near(v::<R>(n), [0.0, 0.995_037, 0.099_504], 1e-5);
    }
}

in_f32_and_f64! {
    /// Row "singular scale": scale(1, 1, 0) has no inverse; the cofactor matrix gives the plane's normal.
    fn singular_scale<R>() {
        let m = [v([1.0, 0.0, 0.0]), v([0.0, 1.0, 0.0]), v([0.0; 3])];
        let n = unit(wide(transformed(normal_from_object::<R>(m), v(unit([1.0, 2.0, 3.0])))));
        assert_near(v::<R>(n), [0.0, 0.0, 1.0], 1e-6);
        assert_eq!(handedness::<R>(m).to_f64(), 1.0);
        assert_eq!(wide(cofactor::<R>(m)[2]), [0.0, 0.0, 1.0]);
    }
}

in_f32_and_f64! {
    /// Negative scale: normals stay outside, and handedness keeps the bitangent along the mirrored texture.
    fn negative_scale<R>() {
        for scale in [[-1.0, 1.0, 1.0], [-2.0, 0.5, 3.0], [-1.0, -1.0, -4.0], [1.0, -1.0, -1.0], [1e-20, -1e-20, 1e-20]] {
            let m = [0, 1, 2].map(|i| v(std::array::from_fn(|j| if i == j { scale[i] } else { 0.0 })));
            let mirrors = scale.iter().product::<f64>() < 0.0;
            assert_eq!(handedness::<R>(m).to_f64(), if mirrors { -1.0 } else { 1.0 });
            let (n, t) = ([0.0, 0.6, 0.8], [1.0, 0.0, 0.0]);
            let b = cross(n, t);
            let world_n = unit(wide(transformed(normal_from_object::<R>(m), v(n))));
            // The inverse transpose of a diagonal matrix.
            assert_near(v::<R>(world_n), unit([0, 1, 2].map(|i| n[i] / scale[i])), 1e-5);
            let world_t = unit(wide(transformed::<R>(m, v(t))));
            let world_b = cross(world_n, world_t).map(|x| x * handedness::<R>(m).to_f64());
            assert!(dot(world_b, unit(wide(transformed::<R>(m, v(b))))) > 0.0, "{scale:?}");
        }
    }
}

in_f32_and_f64! {
    /// The normal matrix is perpendicular to what it should be, for a sheared, rotated, scaled frame.
    fn normals_stay_perpendicular<R>() {
        let m = [[0.3, 2.0, -1.0], [-4.0, 0.1, 0.7], [0.2, 0.9, 5.0]].map(v::<R>);
        let (n, t, b) = (unit([1.0, 2.0, 3.0]), unit([3.0, 0.0, -1.0]), unit([2.0, -1.0, 0.0]));
        let world_n = unit(wide(transformed(normal_from_object(m), v(n))));
        for direction in [t, b] {
            assert!(dot(world_n, unit(wide(transformed(m, v(direction))))).abs() < 1e-6);
        }
        assert!(dot(world_n, unit(wide(transformed(m, v(n))))) > 0.0);
    }
}

in_f32_and_f64! {
    /// Row "sRGB decode negative/over": below 0 the line goes on, above 1 the power; never NaN. And back again.
    fn srgb_negative_and_over<R>() {
        assert_near(linear_from_srgb::<R>(v([-0.1, -0.055, -1.0])), [-0.1, -0.055, -1.0].map(|s| s / 12.92), 1e-7);
        assert_near(srgb_from_linear::<R>(v([-0.1, -1e-9, -2.0])), [-1.292, -1.292e-8, -25.84], 1e-5);
        for c in [-2.0, -1e-3, 0.0, 0.003_130_8, 0.003_130_9, 0.18, 1.0, 4.0, 64.0] {
            let back = linear_from_srgb(srgb_from_linear::<R>(v([c; 3])));
            // The standard's two pieces do not quite meet: the knee is off by 3e-8.
            assert_near(back, [c; 3], 1e-6_f64.max(3e-6 * c.abs()));
        }
        assert_near(srgb_from_linear::<R>(v([0.0, 0.214_041_1, 1.0])), [0.0, 0.5, 1.0], 1e-6);
    }
}

in_f32_and_f64! {
    /// Luminance weights sum to 1; the report's gamma keeps off negative numbers.
    fn luminance_and_gamma<R>() {
        assert!((luminance::<R>(v([1.0; 3])).to_f64() - 1.0).abs() < 1e-7);
        assert!((luminance::<R>(v([0.0, 1.0, 0.0])).to_f64() - 0.7152).abs() < 1e-7);
        let want = [0.0, 0.5_f64.powf(1.0 / 2.2), 1.0];
        assert_near(gamma_from_linear::<R>(v([-0.5, 0.5, 1.0])), want, 1e-6);
    }
}

in_f32_and_f64! {
    /// The normal of a raised plane from its derivatives is the geometry's, along any two directions, mirrored or not.
    fn normal_from_height_is_the_geometry<R>() {
        // z = 0.3 x - 0.7 y over the plane z = 0: the normal is (-.3, .7, 1).
        let height = |p: [f64; 3]| 0.3 * p[0] - 0.7 * p[1];
        for (px, py) in [([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), ([0.2, -0.1, 0.0], [0.3, 0.5, 0.0]),
                         ([1e-6, 0.0, 0.0], [0.0, -1e-6, 0.0])] {
            let n = normal_from_height::<R>(v(px), v(py), v([0.0, 0.0, 1.0]), r(height(px)), r(height(py)));
            assert!(degrees_between(wide(n), [-0.3, 0.7, 1.0]) < 1e-4, "{px:?} {py:?}");
        }
        // No footprint, or one along the normal: the normal as it was.
        let n = [0.0, 0.6, 0.8];
        for p in [[0.0; 3], n, [f64::NAN; 3]] {
            assert_near(normal_from_height::<R>(v(p), v(p), v(n), r(1.0), r(2.0)), n, 1e-6);
        }
        let tiny = |x: f64| r::<R>(1e-17 * x);
        let (px, py) = ([tiny(1.0), tiny(0.0), tiny(0.0)], [tiny(0.0), tiny(1.0), tiny(0.0)]);
        assert_near(normal_from_height(px, py, v(n), tiny(1.0), tiny(2.0)), n, 1e-6);
        assert_near(displaced::<R>(v([1.0, 2.0, 3.0]), v(n), r(0.5)), [1.0, 2.3, 3.4], 1e-6);
    }
}

/// Row "degenerate UV": all UVs equal is 0/0; the vertices get a tangent of their normal, and all the same.
#[test]
fn degenerate_uv() {
    let normal = [0.6_f32, 0.0, 0.8];
    for uv in [[0.0, 0.0], [0.25, 0.75]] {
        let positions = [[0.0, 0.0, 0.0], [0.8, 0.0, -0.6], [0.0, 1.0, 0.0]];
        let got = tangents(&positions, &[normal; 3], &[uv; 3], &[0, 1, 2]);
        let [x, y, z] = tangent_from_normal(normal);
        assert_eq!(got, [[x, y, z, 1.0]; 3]);
    }
}

/// Row "near-degenerate UV": a UV area of 5e-13 still has a direction.
#[test]
fn near_degenerate_uv() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let e = 7.071e-7_f32;
    let got = tangents(&positions, &[[0.0, 0.0, 1.0]; 3], &[[0.0, 0.0], [e, 0.0], [0.0, -e]], &[0, 1, 2]);
    for [x, y, z, w] in got {
        assert_near([x, y, z], [1.0, 0.0, 0.0], 1e-5);
        assert_eq!(w, 1.0);
    }
}

/// Row "1x1 mip": a chain of one texel is that texel, with no division by the number of levels less one.
#[test]
fn one_texel_mip() {
    let image = Image::new(1, 1, halfvector_maps::Channels::Rgba, Texels::U8(vec![[1, 2, 3, 0]])).unwrap();
    for kind in [MapKind::Color, MapKind::Normal, MapKind::Data] {
        assert_eq!(mip_chain(&image, ColorSpace::Srgb, kind), std::slice::from_ref(&image));
    }
}
