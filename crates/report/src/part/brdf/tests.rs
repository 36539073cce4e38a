//! What the rows of the part are held to.

use super::*;
use std::collections::HashSet;

/// Ten times as many points, drawn by chance, find nothing that errs more.
#[test]
fn largest_errors_are_the_largest() {
    let mut state = 11_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut places: Vec<Cube> = (0..10 << 14).map(|_| std::array::from_fn(|_| number())).collect();
    // What lies on the edges of the domain is part of it.
    places.iter_mut().step_by(3).for_each(|place| *place = place.map(|x| (1.2 * x - 0.1).clamp(0.0, 1.0)));
    let rows = [v(Effort::Quick), diffuse(Effort::Quick), d(Effort::Quick)].concat();
    let against = |floor: f64, found: f32, truth: f64| ((f64::from(found) - truth) / truth.max(floor)).abs();
    let smith = |place: Cube, form: fn(f32, f32, f32, f32) -> f32| {
        let [v, l, h, alpha] = cosines(place, |x| 0.002_f64.powf(x));
        let [wv, wl, wh, walpha] = [v, l, h, alpha].map(f64::from);
        against(0.0, form(v, l, h, alpha), v_smith_ggx_correlated(wv, wl, wh, walpha))
    };
    type Error<'a> = &'a dyn Fn(Cube) -> f64;
    let cases: [(&str, &str, Error<'_>); 5] = [
        ("hammon", "for GGX", &|place| smith(place, v_hammon)),
        ("kelemen", "for GGX", &|place| smith(place, v_kelemen)),
        ("correlated", "for GGX", &|place| smith(place, v_smith_ggx_correlated)),
        ("burley", "exact albedos", &|place| {
            let x = cosines(place, |x| x);
            let [v, l, h, r] = x.map(f64::from);
            let truth = diffuse_eon_exact([0.8; 3], v, l, h, r)[0];
            against(0.025, diffuse_burley([0.8; 3], x[0], x[1], x[2], x[3])[0], truth)
        }),
        ("beckmann", "GGX in f64", &|place| {
            let x = half_angles(place);
            let [n_dot_h, sin2, alpha] = x.map(f64::from);
            against(1e-6, d_beckmann(x[0], x[1], x[2]), d_ggx(n_dot_h, sin2, alpha))
        }),
    ];
    for (method, truth, error) in cases {
        let row = rows.iter().find(|row| row.method == method && row.domain.contains(truth)).expect("a row");
        let found = places.iter().map(|&place| error(place)).fold(0.0, f64::max);
        let said = row.error_max.expect("a largest error");
        // What is rounding alone has no peak to climb: the more points the more of it.
        let part = if method == "correlated" { 0.85 } else { 0.97 };
        assert!(said >= part * found && row.searched, "{method}: {said}, but {found}");
    }
}

/// Every row has its figures and no other row's name; what f32 adds is small, and the forms that stand for Smith's
/// differ from it as their documentation says.
#[test]
fn rows_are_whole_and_the_errors_as_documented() {
    let rows = rows(&Run::alone(Effort::Quick));
    let names: HashSet<_> = rows.iter().map(|row| (&row.term, &row.method, &row.domain)).collect();
    assert_eq!(names.len(), rows.len());
    for row in &rows {
        let figures = [row.error_max, row.error_rms, row.cost_ns, row.cost_batch_ns];
        assert!(figures.iter().all(|x| x.is_some_and(f64::is_finite)), "{row:?}");
        let own = row.domain.ends_with("the same form in f64");
        // Where a form is all but 0 its rounding is the more of it.
        assert!(!own || row.error_max < Some(1e-3), "{row:?}");
    }
    let rms = |method: &str, truth: &str| {
        let mut others = rows.iter().filter(|row| !row.domain.ends_with("the same form in f64"));
        let found = others.find(|row| row.method == method && row.domain.contains(truth));
        found.and_then(|row| row.error_rms).expect("a row")
    };
    assert!(rms("correlated", "for GGX") < 2e-7);
    assert!((0.12..0.14).contains(&rms("hammon", "for GGX")));
    assert!((0.7..0.8).contains(&rms("schlick_smith", "for GGX")));
    assert!(rms("beckmann_correlated", "for Beckmann") < 0.01);
    assert!(rms("eon", "exact albedos") < 0.01);
    assert!(rms("f82_tint", "gold") < rms("schlick", "gold"));
}
