//! Blends of normal maps against true composites, normals from derivatives, and directions in few bits.

use halfvector_maps::Real;
use halfvector_maps::blend::{
    blend_linear, blend_partial_derivatives, blend_rnm, blend_udn, blend_whiteout, normal_with_strength,
    texel_from_normal,
};
use halfvector_maps::derivative::{normal_from_slopes, normal_tbn_derivative, tangent_from_derivatives};
use halfvector_maps::normal::{normal_from_texel, normal_tbn, tangent_from_normal};
use halfvector_maps::octahedral::{direction_from_octahedral, octahedral_from_direction};

use crate::{assert_near, cross, degrees_between, is_unit, r, unit, v, wide};

pub(crate) type Blend<R> = fn([R; 3], [R; 3]) -> [R; 3];

pub(crate) fn blends<R: Real>() -> [(&'static str, Blend<R>); 5] {
    [
        ("rnm", blend_rnm),
        ("partial_derivatives", blend_partial_derivatives),
        ("whiteout", blend_whiteout),
        ("udn", blend_udn),
        ("linear", blend_linear),
    ]
}

/// The base is a hill of slopes up to 1.2 (50 degrees), the detail ripples of slopes up to 0.6, ten times as fine.
fn base(x: f64, y: f64) -> f64 {
    0.4 * (3.0 * x).sin() * (2.0 * y + 0.3).cos()
}

fn detail(x: f64, y: f64) -> f64 {
    0.01 * (41.0 * x + 7.0 * y).sin() + 0.01 * (37.0 * y - 5.0 * x).cos()
}

/// A derivative by central differences.
fn along(f: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1e-5;
    (f(STEP) - f(-STEP)) / (2.0 * STEP)
}

fn normal_of(f: fn(f64, f64) -> f64, x: f64, y: f64) -> [f64; 3] {
    normal_from_slopes(along(|d| f(x + d, y)), along(|d| f(x, y + d)))
}

/// The normal of the surface (x, y, base + detail).
fn of_sum(x: f64, y: f64) -> [f64; 3] {
    normal_of(|x, y| base(x, y) + detail(x, y), x, y)
}

/// The normal of the base moved along its own normals by the detail: both fields over the same coordinates.
fn of_raised(x: f64, y: f64) -> [f64; 3] {
    let point = |x: f64, y: f64| {
        let n = normal_of(base, x, y);
        let h = detail(x, y);
        [x + h * n[0], y + h * n[1], base(x, y) + h * n[2]]
    };
    const STEP: f64 = 1e-4;
    let between = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i] - b[i]);
    let along_x = between(point(x + STEP, y), point(x - STEP, y));
    let along_y = between(point(x, y + STEP), point(x, y - STEP));
    unit(cross(along_x, along_y))
}

/// Mean and largest angle to a truth over the fields.
fn error<R: Real>(blend: Blend<R>, truth: fn(f64, f64) -> [f64; 3]) -> (f64, f64) {
    let (mut sum, mut max, mut count) = (0.0, 0.0_f64, 0.0);
    for i in 0..200 {
        for j in 0..200 {
            let (x, y) = (f64::from(i) * 0.0107, f64::from(j) * 0.0093);
            let n = blend(v(normal_of(base, x, y)), v(normal_of(detail, x, y)));
            assert!(is_unit(n));
            let angle = degrees_between(wide(n), truth(x, y));
            (sum, max, count) = (sum + angle, max.max(angle), count + 1.0);
        }
    }
    (sum / count, max)
}

/// The table, which the README carries. `cargo test -p halfvector-maps blend -- --nocapture` prints it.
#[test]
fn table_of_blends() {
    let mut known = true;
    println!("| blend | heights added | detail raised along the base's normal |\n|---|---|---|");
    for ((name, wide), (_, narrow)) in blends::<f64>().into_iter().zip(blends::<f32>()) {
        let [added, raised] = [of_sum, of_raised].map(|truth| error(wide, truth));
        let row = format!("| `{name}` | {:.2} / {:.2} | {:.2} / {:.2} |", added.0, added.1, raised.0, raised.1);
        println!("{row}");
        known &= include_str!("../../README.md").contains(&row);
        assert!((error(narrow, of_sum).1 - added.1).abs() < 1e-3);
    }
    assert!(known, "the README has other rows");
    assert!(error::<f64>(blend_partial_derivatives, of_sum).1 < 1e-4);
}

/// A flat detail leaves the base, but for the linear blend; a flat base gives the detail.
fn flat_is_neutral<R: Real>() {
    let (flat, n) = (v::<R>([0.0, 0.0, 1.0]), v::<R>(unit([0.3, -0.5, 0.7])));
    for (name, blend) in blends::<R>() {
        if name != "linear" {
            assert_near(blend(n, flat), wide(n), 1e-6);
        }
        // UDN keeps the base's z.
        if name != "linear" && name != "udn" {
            assert_near(blend(flat, n), wide(n), 1e-6);
        }
        for a in BAD {
            for b in BAD {
                for c in BAD {
                    assert!(is_unit(blend(v([a, b, c]), n)) && is_unit(blend(n, v([c, a, b]))), "{name} {a} {b} {c}");
                    assert!(is_unit(blend(v([a, b, c]), v([b, c, a]))), "{name} {a} {b} {c}");
                }
            }
        }
    }
    assert_near(blend_linear(n, wide(n).map(|x| r::<R>(-x))), wide(n), 1e-6);
    assert_near(blend_rnm::<R>(v([0.0, 0.0, -1.0]), n), [0.0, 0.0, -1.0], 1e-6);
}

const BAD: [f64; 7] = [0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 3e38];

#[test]
fn flat_is_neutral_and_any_input_is_unit() {
    flat_is_neutral::<f32>();
    flat_is_neutral::<f64>();
}

/// Strength is a factor of slopes, and a colour says its normal.
#[test]
fn strength_scales_slopes() {
    let n = unit([0.3, -0.2, 1.0]);
    assert_near(normal_with_strength(n, 2.0), unit([0.6, -0.4, 1.0]), 1e-12);
    assert_near(normal_with_strength(n, 0.0), [0.0, 0.0, 1.0], 0.0);
    assert_near(normal_with_strength(n, -1.0), unit([-0.3, 0.2, 1.0]), 1e-12);
    assert_near(normal_from_texel(texel_from_normal(n), 1.0, false), n, 1e-12);
    assert_near(normal_with_strength([1.0, 0.0, 0.0], 0.0), [0.0, 0.0, 1.0], 0.0);
}

/// On any plane with any texture that is not skewed, the tangent from derivatives is the tangent, along any two directions
/// of the screen, mirrored or not.
fn derivatives_give_the_tangent<R: Real>() {
    for (normal, tangent) in [([0.0, 0.0, 1.0], [0.6, 0.8, 0.0]), ([0.6, 0.0, 0.8], [0.8, 0.0, -0.6])] {
        for w in [1.0, -1.0] {
            for size in [1e-5, 0.3, 4e3] {
                let bitangent = cross(normal, tangent).map(|x| w * x);
                // The picture is `size` wide; v runs down, against the bitangent.
                let point = |[a, b]: [f64; 2]| [0, 1, 2].map(|i| size * (a * tangent[i] - b * bitangent[i]));
                for [x, y] in [[[1e-3, 0.0], [0.0, 1e-3]], [[2e-3, 1e-3], [1e-3, -3e-3]]] {
                    let got = tangent_from_derivatives::<R>(v(point(x)), v(point(y)), v(normal), x.map(r), y.map(r));
                    assert_near([got[0], got[1], got[2]], tangent, 2e-6);
                    assert_eq!(got[3].to_f64(), w, "{normal:?} {x:?} {y:?}");
                    let n = v::<R>(unit([0.3, -0.4, 0.8]));
                    let [tx, ty, tz] = tangent.map(r);
                    let mesh = normal_tbn(n, v(normal), [tx, ty, tz, r(w)]);
                    let pixel = normal_tbn_derivative(n, v(point(x)), v(point(y)), v(normal), x.map(r), y.map(r));
                    assert_near(pixel, wide(mesh), 4e-6);
                }
            }
        }
    }
    // Nothing to go by: no tangent, and the texel still lies about the normal.
    let up = v::<R>([0.0, 0.0, 1.0]);
    for (p, uv) in [([0.0; 3], [1.0, 0.0]), ([1.0, 0.0, 0.0], [0.0; 2]), ([0.0, 0.0, 1.0], [1.0, 0.0])] {
        let got = tangent_from_derivatives::<R>(v(p), v([0.0, 1.0, 0.0]), up, uv.map(r), [r(0.0), r(0.0)]);
        assert_eq!(wide([got[0], got[1], got[2]]), [0.0; 3]);
        let n = normal_tbn_derivative(up, v(p), v(p), up, uv.map(r), uv.map(r));
        assert_near(n, [0.0, 0.0, 1.0], 1e-6);
    }
    for a in BAD {
        for b in BAD {
            let (p, uv) = (v::<R>([a, b, 1.0]), [r(b), r(a)]);
            assert!(is_unit(normal_tbn_derivative(
                v([0.6, 0.0, 0.8]),
                p,
                v([b, a, 0.0]),
                v([a, 0.0, 1.0]),
                uv,
                [r(1.0), r(b)]
            )));
        }
    }
}

#[test]
fn tangents_from_derivatives() {
    derivatives_give_the_tangent::<f32>();
    derivatives_give_the_tangent::<f64>();
}

/// Directions over the sphere, poles, axes and the fold's edges among them.
fn directions() -> impl Iterator<Item = [f64; 3]> {
    let spiral = (0..200_000).map(|i| {
        let z = 1.0 - (f64::from(i) + 0.5) / 100_000.0;
        let (s, c) = (f64::from(i) * 2.399_963).sin_cos();
        let sine = (1.0 - z * z).sqrt();
        [sine * c, sine * s, z]
    });
    let few = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let grid =
        few.into_iter().flat_map(move |x| few.into_iter().flat_map(move |y| few.into_iter().map(move |z| [x, y, z])));
    spiral.chain(grid.filter(|n| *n != [0.0; 3]).map(unit))
}

/// The largest angle that storing does to a direction.
fn storing(store: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
    directions().map(|n| degrees_between(store(n), n)).fold(0.0, f64::max)
}

fn snorm(x: f64, bits: u32) -> f64 {
    let steps = f64::from((1u32 << (bits - 1)) - 1);
    (x.clamp(-1.0, 1.0) * steps).round() / steps
}

fn f16(x: f64) -> f64 {
    half::f16::from_f64(x).to_f64()
}

/// What becomes of a direction that is stored and read again.
type Store<'a> = &'a dyn Fn([f64; 3]) -> [f64; 3];

/// What N and T lose in few bits, in degrees: the stored vector, and the mapped normal when both are stored. T needs no
/// more than N: an error of either turns the result by about as much.
#[test]
fn frames_in_few_bits() {
    let octahedral =
        |bits: u32| move |n: [f64; 3]| direction_from_octahedral(octahedral_from_direction(n).map(|x| snorm(x, bits)));
    let octahedral_f16 = |n: [f64; 3]| direction_from_octahedral(octahedral_from_direction(n).map(f16));
    let stores: [(&str, u32, Store<'_>, f64); 6] = [
        ("three f16", 48, &|n: [f64; 3]| n.map(f16), 0.03),
        ("three snorm16", 48, &|n: [f64; 3]| n.map(|x| snorm(x, 16)), 0.0016),
        ("three snorm8", 24, &|n: [f64; 3]| n.map(|x| snorm(x, 8)), 0.4),
        ("octahedral snorm16", 32, &octahedral(16), 0.0037),
        ("octahedral f16", 32, &octahedral_f16, 0.06),
        ("octahedral snorm8", 16, &octahedral(8), 0.95),
    ];
    println!("| stored as | bits | direction, max | mapped normal, max |\n|---|---|---|---|");
    let texels = [[0.0, 0.0, 1.0], unit([0.6, 0.3, 0.8]), unit([-0.9, 0.2, 0.3])];
    for (name, bits, store, most) in stores {
        let direction = storing(store);
        let mapped = directions().step_by(7).flat_map(|n| texels.map(|t| (n, t))).map(|(n, t)| {
            let tangent = tangent_from_normal(n);
            let frame = |n: [f64; 3], [x, y, z]: [f64; 3]| normal_tbn(t, n, [x, y, z, 1.0]);
            degrees_between(frame(store(n), store(tangent)), frame(n, tangent))
        });
        let mapped = mapped.fold(0.0, f64::max);
        println!("| {name} | {bits} | {direction:.4} | {mapped:.4} |");
        assert!(direction <= most && mapped <= 2.2 * most, "{name}: {direction} {mapped}");
    }
}

/// Exact but for rounding, in both types; finite for what a buffer holds by mistake.
fn octahedral_and_back<R: Real>(most: f64) {
    for n in directions() {
        let p = octahedral_from_direction::<R>(v(n));
        assert!(p.iter().all(|x| x.to_f64().abs() <= 1.0 + 1e-6));
        assert!(degrees_between(wide(direction_from_octahedral(p)), n) < most, "{n:?}");
    }
    for a in BAD {
        for b in BAD {
            assert!(is_unit(direction_from_octahedral([r::<R>(a), r(b)])));
            assert!(octahedral_from_direction(v::<R>([a, b, a])).iter().all(|x| x.to_f64().is_finite()));
        }
    }
}

#[test]
fn octahedral_is_exact_but_for_rounding() {
    octahedral_and_back::<f32>(2e-5);
    octahedral_and_back::<f64>(1e-12);
    // Every code of two times 8 bits is a direction.
    for code in 0..1_u32 << 16 {
        let p = [code & 255, code >> 8].map(|c| (c as f32 - 127.0) / 127.0);
        assert!(is_unit(direction_from_octahedral(p)));
    }
}
