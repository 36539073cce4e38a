//! The rows of `hard_cases.csv` that a BRDF meets, as calls of library functions with the right answer. Used twice: by this
//! package in f32 and f64, and by the tests of twins on a GPU in f32, f64 and f16.

/// A call of a function, by the name that it has in Rust and in WGSL, and what is right.
pub(crate) struct Case {
    /// Name of the test.
    pub(crate) name: &'static str,
    /// Columns `case` and the start of `input` of the table's row.
    pub(crate) row: (&'static str, &'static str),
    /// The function, and its arguments one number after another.
    pub(crate) function: &'static str,
    pub(crate) arguments: Vec<f64>,
    /// Which number of the result is meant.
    pub(crate) component: usize,
    /// The right answer: the table's, or the documented one where the table's is infinite or no number.
    pub(crate) answer: f64,
    /// Relative error allowed in f32; in f64 too, because the table's answers have six digits.
    pub(crate) tolerance: f64,
    /// Relative error allowed in f16; none where the answer is outside of f16 or its domain (perceptual roughness from 0.089,
    /// cosines from 1e-3): then the result only has to be finite and not negative.
    pub(crate) half: Option<f64>,
}

/// Names of all cases that a function of the WGSL library answers, for a macro that makes a test of each.
macro_rules! case_names {
    ($make:ident) => {
        $make! {
            d_peak_at_roughness_0, d_peak_at_the_floor, d_peak_at_0p01, d_peak_at_0p02, d_peak_at_0p045, d_peak_at_0p089,
            d_off_peak_at_0p02, d_off_peak_at_0p045, d_off_peak_at_0p089, d_off_peak_at_0p2,
            d_fp16_at_0p089, d_fp16_at_0p2, d_fp16_at_0p3, d_fp16_at_0p5, d_fp16_peak,
            v_grazing_view_0, v_grazing_view_1em4, v_grazing_view_1em20, v_grazing_both_1em30, v_grazing_both_0,
            v_grazing_both_1em6, lobe_grazing_both_0, normal_away_from_viewer, h_zero, h_tiny, voh_from_vol,
            sin2_cancel_1em4, sin2_cancel_3em4, dot_above_1, schlick_of_cosine_above_1, schlick_of_f0_1,
            dielectric_eta_1_grazing, dielectric_eta_1, dielectric_eta_next_to_1_grazing, dielectric_eta_next_to_1,
            dielectric_eta_1p001_grazing, dielectric_eta_1p001, total_internal_reflection_grazing,
            total_internal_reflection, exact_of_f0_1, ior_of_f0_1, conductor_n0p05_k4, conductor_n0p2_k3p9,
            conductor_n0p001_k10, eon_of_albedo_above_1, eon_at_its_pole, compensation_of_f0_above_1, eon_at_roughness_0,
            fon_albedo_at_0, fon_albedo_at_1em6, fon_albedo_at_1em4, fon_albedo_at_0p01, denormal_alpha,
            roughness_0_in_the_mirror_direction
        }
    };
}
pub(crate) use case_names;

/// All cases, with the names of [`case_names`].
pub(crate) fn cases() -> Vec<Case> {
    let none = Case {
        name: "",
        row: ("", ""),
        function: "",
        arguments: Vec::new(),
        component: 0,
        answer: 0.0,
        tolerance: 0.0,
        half: None,
    };
    let mut cases = Vec::new();
    let mut add = |name, row, function, arguments: &[f64], answer, tolerance, half| {
        let arguments = arguments.to_vec();
        cases.push(Case { name, row, function, arguments, answer, tolerance, half, ..none });
    };

    // D = 1 / (pi alpha^2) at the peak: infinite at roughness 0, where the documented value is 0 (a delta).
    add("d_peak_at_roughness_0", ("D_peak_f32", "roughness=0.0,"), "d_ggx", &[1.0, 0.0, 0.0], 0.0, 0.0, Some(0.0));
    let peaks = [
        ("d_peak_at_the_floor", "roughness=0.0001,", 1e-4, 3.1831e15),
        ("d_peak_at_0p01", "roughness=0.01,", 0.01, 3.1831e7),
        ("d_peak_at_0p02", "roughness=0.02,", 0.02, 1.98944e6),
        ("d_peak_at_0p045", "roughness=0.045,", 0.045, 77624.7),
        ("d_peak_at_0p089", "roughness=0.089,", 0.089, 5073.29),
    ];
    for (name, input, r, answer) in peaks {
        let half = (r > 0.08).then_some(0.01);
        add(name, ("D_peak_f32", input), "d_ggx", &[1.0, 0.0, r * r], answer, 1e-5, half);
    }
    // tan(theta_h) = alpha, the half-width of the highlight.
    let sides = [
        ("d_off_peak_at_0p02", "D_offpeak_f32", "r=0.02,", 0.02, 497359.0),
        ("d_off_peak_at_0p045", "D_offpeak_f32", "r=0.045,", 0.045, 19406.3),
        ("d_off_peak_at_0p089", "D_offpeak_f32", "r=0.089,", 0.089, 1268.48),
        ("d_off_peak_at_0p2", "D_offpeak_f32", "r=0.2,", 0.2, 49.8952),
        ("d_fp16_at_0p089", "D_fp16", "r=0.089,", 0.089, 1269.0),
        ("d_fp16_at_0p2", "D_fp16", "r=0.2,", 0.2, 49.95),
        ("d_fp16_at_0p3", "D_fp16", "r=0.3,", 0.3, 9.9783),
        ("d_fp16_at_0p5", "D_fp16", "r=0.5,", 0.5, 1.4374),
    ];
    for (name, case, input, r, answer) in sides {
        let alpha: f64 = r * r;
        let cos2 = 1.0 / (1.0 + alpha * alpha);
        // The table's f16 answers are those of arguments rounded to f16.
        let (tolerance, half) = if case == "D_fp16" { (2e-3, Some(0.01)) } else { (5e-6, (r > 0.08).then_some(0.01)) };
        add(name, (case, input), "d_ggx", &[cos2.sqrt(), alpha * alpha * cos2, alpha], answer, tolerance, half);
    }
    add("d_fp16_peak", ("D_fp16_peak", "r=0.089"), "d_ggx", &[1.0, 0.0, 0.089 * 0.089], 5073.3, 1e-5, Some(0.01));

    let grazing = [
        ("v_grazing_view_0", "n.v=0, n.l=0.5", [0.0, 0.5, 0.5], 4.0, Some(0.01)),
        ("v_grazing_view_1em4", "n.v=0.0001, n.l=0.5", [1e-4, 0.5, 0.5], 3.99826, Some(0.01)),
        ("v_grazing_view_1em20", "n.v=1e-20, n.l=0.5", [1e-20, 0.5, 0.5], 4.0, Some(0.01)),
        ("v_grazing_both_1em30", "n.v=1e-30, n.l=1e-30", [1e-30, 1e-30, 0.5], 1e30, None),
        // Infinite: the documented value, 1/2 over the floor. V n.l is 0, see lobe_grazing_both_0.
        ("v_grazing_both_0", "n.v=0, n.l=0", [0.0, 0.0, 0.5], 5e35, None),
        ("v_grazing_both_1em6", "n.v=1e-06, n.l=1e-06", [1e-6, 1e-6, 1e-4], 2.49988e11, None),
    ];
    for (name, input, [n_dot_v, n_dot_l, r], answer, half) in grazing {
        let arguments = [n_dot_v, n_dot_l, 0.5, r * r];
        add(name, ("V_grazing_f32", input), "v_smith_ggx_correlated", &arguments, answer, 1e-5, half);
    }

    // normal, view, n.v; light; f0, f90, alpha
    let lobe = |view: [f64; 3], light: [f64; 3], alpha: f64| {
        let mut arguments = vec![0.0, 0.0, 1.0, view[0], view[1], view[2], view[2].max(1e-7)];
        arguments.extend(light);
        arguments.extend([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, alpha]);
        arguments
    };
    let both = lobe([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0.25);
    add("lobe_grazing_both_0", ("V_grazing_f32", "n.v=0, n.l=0"), "specular_eval", &both, 0.0, 0.0, Some(0.0));
    let opposite = lobe([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], 0.25);
    add("h_zero", ("h_zero", "v=(1,0,0)"), "specular_eval", &opposite, 0.0, 0.0, Some(0.0));
    let mirror = lobe([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.0);
    let row = ("roughness 0 everything", "alpha=0");
    add("roughness_0_in_the_mirror_direction", row, "specular_eval", &mirror, 0.0, 0.0, Some(0.0));
    // No physical value: the point is shaded as seen at grazing incidence.
    let away = [0.0, 0.0, 1.0, 0.998_749_2, 0.0, -0.05];
    add("normal_away_from_viewer", ("n.v<0", "n.v=-0.05"), "frame_from_normal", &away, 1e-7, 1e-6, None);

    let half_of = |view: [f64; 3], light: [f64; 3]| {
        let mut arguments = vec![0.0, 0.0, 1.0, view[0], view[1], view[2], view[2]];
        arguments.extend(light);
        arguments
    };
    let tiny = half_of([1.0, 0.0, 1e-4], [-1.0, 1e-7, 1e-4]);
    add("h_tiny", ("h_tiny", "v=(1,0,1e-4)"), "half_from_light", &tiny, 1e-4, 1e-6, None);
    add("voh_from_vol", ("voh_from_vol", "same"), "half_from_light", &tiny, 1e-4, 1e-6, None);
    for (name, input, angle, answer) in
        [("sin2_cancel_1em4", "theta_h=1e-4", 1e-4_f64, 1e-8), ("sin2_cancel_3em4", "theta_h=3e-4", 3e-4, 9e-8)]
    {
        let (sin, cos) = (2.0 * angle).sin_cos();
        let arguments = half_of([0.0, 0.0, 1.0], [sin, 0.0, cos]);
        add(name, ("sin2_cancel", input), "half_from_light", &arguments, answer, 1e-5, None);
    }

    let schlick = |f0: f64, cosine: f64| [f0, f0, f0, 1.0, 1.0, 1.0, cosine];
    add("dot_above_1", ("dot>1", "dot(n,n)"), "f_schlick", &schlick(0.0, 1.000_000_4), 0.0, 0.0, Some(0.0));
    let arguments = schlick(0.04, 1.000_000_1);
    add("schlick_of_cosine_above_1", ("schlick_pow", "v.h=1.0000001"), "f_schlick", &arguments, 0.04, 1e-7, Some(1e-3));
    add("schlick_of_f0_1", ("schlick_f0_eq_1", "f0=1"), "f_schlick", &schlick(1.0, 0.3), 1.0, 0.0, Some(0.0));
    let next = 1.0 + f64::from(f32::EPSILON);
    let dielectrics = [
        ("dielectric_eta_1_grazing", "eta=1, cos=0.001", 1.0, 0.001, 0.0, 0.0, Some(0.0)),
        ("dielectric_eta_1", "eta=1, cos=0.7", 1.0, 0.7, 0.0, 0.0, Some(0.0)),
        // Written as eta=1 in the table: the next f32.
        ("dielectric_eta_next_to_1_grazing", "eta=1, cos=0.001", next, 0.001, 0.002_852_4, 2e-5, None),
        ("dielectric_eta_next_to_1", "eta=1, cos=0.7", next, 0.7, 7.401_36e-15, 1e-5, None),
        ("dielectric_eta_1p001_grazing", "eta=1.001, cos=0.001", 1.001, 0.001, 0.914_388, 1e-5, None),
        // The f32 next to 1.001 is 1.6e-8 off, which is 3e-5 of what eta exceeds 1 by.
        ("dielectric_eta_1p001", "eta=1.001, cos=0.7", 1.001, 0.7, 5.192_52e-7, 1e-4, None),
        ("total_internal_reflection_grazing", "eta=0.6666667, cos=0.001", 0.666_666_7, 0.001, 1.0, 0.0, Some(0.0)),
        ("total_internal_reflection", "eta=0.6666667, cos=0.7", 0.666_666_7, 0.7, 1.0, 0.0, Some(0.0)),
    ];
    for (name, input, eta, cosine, answer, tolerance, half) in dielectrics {
        add(name, ("fresnel_diel", input), "f_dielectric", &[eta, cosine], answer, tolerance, half);
    }
    // f0 = 1 implies an infinite index: it is held at 4.2e6, and F at 1.
    let all = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    add("exact_of_f0_1", ("ior_f0", "eta from f0=1"), "f_exact", &all, 1.0, 2e-6, Some(0.03));
    add("ior_of_f0_1", ("ior_f0", "eta from f0=1"), "ior_from_f0", &[1.0], 4.194_302e6, 1e-6, None);
    let conductors = [
        ("conductor_n0p05_k4", "n=0.05,k=4.0", [0.05, 4.0], 0.988_305_803),
        ("conductor_n0p2_k3p9", "n=0.2,k=3.9", [0.2, 3.9], 0.951_951_953),
        ("conductor_n0p001_k10", "n=0.001,k=10.0", [0.001, 10.0], 0.999_960_397),
    ];
    for (name, input, [n, k], answer) in conductors {
        add(name, ("fresnel_cond", input), "f_conductor", &[n, k, 1.0], answer, 5e-7, Some(5e-3));
    }

    // The albedo is held at 1: what 1.2 and the pole at 5.9812 reflect is what 1 does.
    let eon = |albedo: f64, r: f64| [albedo, albedo, albedo, 0.8, 0.6, 0.9, r];
    let white = 0.351_642_961_5;
    add(
        "eon_of_albedo_above_1",
        ("albedo>1", "base_color=1.2"),
        "diffuse_eon",
        &eon(1.2, 1.0),
        white,
        1e-6,
        Some(5e-3),
    );
    add("eon_at_its_pole", ("albedo>1", "base_color=1.2"), "diffuse_eon", &eon(5.981_2, 1.0), white, 1e-6, Some(5e-3));
    let lambert = std::f64::consts::FRAC_1_PI;
    add("eon_at_roughness_0", ("EON r=0", "1-avgE=0"), "diffuse_eon", &eon(1.0, 0.0), lambert, 2e-7, Some(2e-3));
    // f0 is held at 1; the table's row is Kulla and Conty's, which is tested with the other methods.
    let compensation = [1.5, 1.5, 1.5, 1.0, 1.0, 1.0, 0.3, 0.109_137];
    let row = ("f0>1 in Kulla-Conty", "f0=1.5");
    add("compensation_of_f0_above_1", row, "energy_compensation", &compensation, 2.444_174, 1e-5, Some(0.01));
    // By the polynomial, 6e-4 from the exact albedo; the exact one is tested in Rust alone.
    for (name, input, cosine, answer) in [
        ("fon_albedo_at_0", "mu=0.0", 0.0, 1.0),
        ("fon_albedo_at_1em6", "mu=1e-06", 1e-6, 0.999_999_753),
        ("fon_albedo_at_1em4", "mu=0.0001", 1e-4, 0.999_975_281),
        ("fon_albedo_at_0p01", "mu=0.01", 0.01, 0.997_517_224),
    ] {
        add(name, ("FON exact albedo", input), "directional_albedo_fon", &[cosine, 1.0], answer, 6e-4, Some(5e-3));
    }
    // Below alpha = 1e-9 the floor of the denominator, 1e-18, takes over: (1e-20 / 1e-18)^2 / pi.
    let floored = 1e-4 * std::f64::consts::FRAC_1_PI;
    add("denormal_alpha", ("denorm alpha", "r=1e-10"), "d_ggx", &[1.0, 0.0, 1e-20], floored, 1e-5, None);

    for case in &mut cases {
        // Of these the number in question is n.v, l.h, and |n x h|^2.
        case.component = match (case.function, case.name) {
            ("frame_from_normal", _) => 6,
            ("half_from_light", "h_tiny" | "voh_from_vol") => 2,
            ("half_from_light", _) => 3,
            _ => 0,
        };
    }
    cases
}
