//! Special values: what a node must give exactly, or to the digits that are written.

use super::run::Node;

/// Inputs that are set, and the results.
type Case = (&'static str, &'static [(&'static str, &'static [f32])], &'static [f64]);

const CASES: &[Case] = &[
    ("math/sinh", &[("x", &[1.0])], &[1.175_201_2]),
    ("math/cosh", &[("x", &[1.0])], &[1.543_080_6]),
    ("math/tanh", &[("x", &[0.5])], &[0.462_117_2]),
    ("math/tanh", &[("x", &[1e8])], &[1.0]),
    ("math/asinh", &[("x", &[1.0])], &[0.881_373_6]),
    ("math/asinh", &[("x", &[-1000.0])], &[-7.600_902_7]),
    ("math/asinh", &[("x", &[1e-5])], &[1e-5]),
    ("math/acosh", &[("x", &[2.0])], &[1.316_957_9]),
    ("math/acosh", &[("x", &[0.3])], &[0.0]),
    ("math/atanh", &[("x", &[0.5])], &[0.549_306_1]),
    ("math/atan", &[("x", &[1.0])], &[std::f64::consts::FRAC_PI_4]),
    ("math/exp2", &[("x", &[3.0])], &[8.0]),
    ("math/log2", &[("x", &[8.0])], &[3.0]),
    ("math/log_base", &[("x", &[1000.0])], &[3.0]),
    ("math/sin_degrees", &[("x", &[30.0])], &[0.5]),
    ("math/sin_degrees", &[("x", &[180.0])], &[0.0]),
    ("math/sin_degrees", &[("x", &[-450.0])], &[-1.0]),
    ("math/cos_degrees", &[("x", &[90.0])], &[0.0]),
    ("math/cos_degrees", &[("x", &[36_000_060.0])], &[0.5]),
    ("math/tan_degrees", &[("x", &[45.0])], &[1.0]),
    ("math/tan_degrees", &[("x", &[225.0])], &[1.0]),
    ("math/atan2_degrees", &[("y", &[-1.0]), ("x", &[0.0])], &[-90.0]),
    ("math/atan2_degrees", &[("y", &[0.0]), ("x", &[0.0])], &[0.0]),
    ("math/wrap", &[("x", &[7.5]), ("low", &[1.0]), ("high", &[3.0])], &[1.5]),
    ("math/wrap", &[("x", &[-0.5]), ("low", &[1.0]), ("high", &[3.0])], &[1.5]),
    ("math/snap", &[("x", &[0.37]), ("increment", &[0.25])], &[0.25]),
    ("math/snap", &[("x", &[0.37]), ("increment", &[0.0])], &[0.37]),
    ("math/smooth_max", &[("a", &[1.0]), ("b", &[1.0]), ("radius", &[0.4])], &[1.1]),
    ("math/smootherstep", &[("x", &[0.25])], &[0.103_515_6]),
    ("math/to_integer", &[("x", &[-0.5])], &[4_294_967_295.0]),
    ("math/choose", &[("index", &[5.0]), ("v5", &[0.7])], &[0.7]),
    ("math/choose", &[("index", &[99.0]), ("v7", &[0.3])], &[0.3]),
    ("math/curve", &[("x", &[0.6])], &[0.6]),
    ("math/curve", &[("x", &[0.5]), ("at_50", &[0.9])], &[0.9]),
    ("math/step_filtered", &[("x", &[0.51])], &[1.0]),
    ("vector/project", &[("v", &[3.0, 4.0, 0.0]), ("onto", &[0.0, 2.0, 0.0])], &[0.0, 4.0, 0.0, 3.0, 0.0, 0.0, 4.0]),
    ("vector/face_forward", &[("v", &[0.0, 0.0, 1.0]), ("toward", &[0.0, 0.0, -1.0])], &[0.0, 0.0, -1.0]),
    ("vector/rotate_2d", &[("v", &[1.0, 0.0]), ("angle", &[90.0])], &[0.0, 1.0]),
    ("vector/rotate_euler", &[("v", &[0.0, 0.0, 1.0]), ("angles", &[90.0, 0.0, 90.0])], &[1.0, 0.0, 0.0]),
    ("vector/angle", &[("a", &[2.0, 0.0, 0.0]), ("b", &[-3.0, 0.0, 0.0])], &[180.0]),
    ("vector/angle", &[("a", &[1.0, 0.0, 0.0]), ("b", &[1.0, 1e-4, 0.0])], &[0.005_729_58]),
    (
        "vector/world_from_tangent",
        &[("normal", &[0.0, 1.0, 0.0]), ("tangent", &[1.0, 0.0, 0.0, 1.0]), ("v", &[0.0, 1.0, 0.0])],
        &[0.0, 0.0, -1.0],
    ),
    (
        "vector/tangent_from_world",
        &[("normal", &[0.0, 1.0, 0.0]), ("tangent", &[1.0, 0.0, 0.0, 1.0]), ("v", &[0.0, 0.0, -1.0])],
        &[0.0, 1.0, 0.0],
    ),
    (
        "vector/swizzle",
        &[("v", &[0.1, 0.2, 0.3, 0.4]), ("x", &[2.0]), ("y", &[5.0]), ("z", &[4.0]), ("w", &[3.0])],
        &[0.3, 1.0, 0.0, 0.4],
    ),
    (
        "vector/matrix_transform",
        &[("v", &[1.0, 2.0, 3.0]), ("x", &[0.0, 1.0, 0.0]), ("y", &[-1.0, 0.0, 0.0]), ("offset", &[10.0, 0.0, 0.5])],
        &[8.0, 1.0, 3.5],
    ),
    (
        "vector/matrix4_transform",
        &[("v", &[1.0, 2.0, 3.0, 1.0]), ("y", &[0.0, 1.0, 0.0, 0.5]), ("w", &[4.0, 5.0, 6.0, 1.0])],
        &[5.0, 7.0, 9.0, 2.0],
    ),
    (
        "vector/matrix_multiply",
        &[("a_x", &[0.0, 1.0, 0.0]), ("a_y", &[-1.0, 0.0, 0.0]), ("b_x", &[2.0, 3.0, 0.0])],
        &[-3.0, 2.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    ),
    (
        "vector/matrix_transpose",
        &[("x", &[1.0, 2.0, 3.0]), ("y", &[4.0, 5.0, 6.0]), ("z", &[7.0, 8.0, 9.0])],
        &[1.0, 4.0, 7.0, 2.0, 5.0, 8.0, 3.0, 6.0, 9.0],
    ),
    (
        "vector/matrix_inverse",
        &[("x", &[1e6, 0.0, 0.0]), ("y", &[0.0, -2.0, 0.0]), ("z", &[0.0, 0.0, 1e-6])],
        &[1e-6, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1e6],
    ),
    ("vector/matrix_inverse", &[("y", &[2.0, 0.0, 0.0])], &[0.0; 9]),
    ("vector/matrix_determinant", &[("x", &[0.0, 2.0, 0.0]), ("y", &[3.0, 0.0, 0.0])], &[-6.0]),
    ("vector/extract", &[("v", &[0.1, 0.2, 0.3, 0.4]), ("index", &[1.0])], &[0.2]),
    ("color/rgb_from_hsl", &[("hue", &[1.0 / 3.0]), ("lightness", &[0.25])], &[0.0, 0.5, 0.0]),
    ("color/hsl_from_rgb", &[("color", &[0.75, 0.25, 0.25])], &[0.0, 0.5, 0.5]),
    ("color/mix_oklab", &[("a", &[1.0, 1.0, 1.0]), ("b", &[1.0, 1.0, 1.0])], &[1.0, 1.0, 1.0]),
    // Half as light to the eye: 0.5^3 of the light.
    ("color/mix_oklab", &[], &[0.125, 0.125, 0.125]),
    ("color/oklch_adjust", &[("color", &[0.2, 0.5, 0.1])], &[0.2, 0.5, 0.1]),
    // MaterialX's `colorcorrect`: to and from the luminance, through 0 too.
    ("color/correct", &[("color", &[0.2, 0.5, 0.1]), ("saturation", &[0.0])], &[0.40734, 0.40734, 0.40734]),
    ("color/correct", &[("color", &[0.5, 0.2, 0.2]), ("saturation", &[5.0])], &[1.44488, -0.05512, -0.05512]),
    ("color/rec709_from_display_p3", &[("color", &[1.0, 1.0, 1.0])], &[1.0, 1.0, 1.0]),
    ("color/rec709_from_rec2020", &[("color", &[0.0, 1.0, 0.0])], &[-0.587_641, 1.132_9, -0.100_579]),
    ("color/rec709_from_acescg", &[("color", &[1.0, 1.0, 1.0])], &[1.0, 1.0, 1.0]),
    ("color/rec709_from_adobe_rgb", &[("color", &[1.0, 1.0, 1.0])], &[1.0, 1.0, 1.0]),
    ("color/rec709_from_adobe_rgb", &[("color", &[0.0, 1.0, 0.0])], &[-0.398_355_7, 1.0, -0.042_929_0]),
    ("color/blend_subtract", &[("top", &[0.25, 1.0, 0.0]), ("opacity", &[0.5])], &[0.375, 0.0, 0.5]),
    ("color/blend_divide", &[("top", &[0.5, 1.0, 0.0])], &[1.0, 0.5, 500.0]),
    ("color/blend_linear_light", &[("top", &[0.5, 0.75, 0.0])], &[0.5, 1.0, -0.5]),
    ("color/over", &[("top_alpha", &[0.5]), ("base_alpha", &[0.0])], &[1.0, 1.0, 1.0, 0.5]),
    // A half on a half: a quarter of the pixel has both, and where only one may be seen the other one's is black.
    ("color/in", &[("base_alpha", &[0.5]), ("top", &[0.2, 0.4, 0.6]), ("top_alpha", &[0.5])], &[0.2, 0.4, 0.6, 0.25]),
    ("color/in", &[("base_alpha", &[0.0])], &[0.0, 0.0, 0.0, 0.0]),
    ("color/out", &[("base_alpha", &[0.25]), ("top", &[0.2, 0.4, 0.6])], &[0.2, 0.4, 0.6, 0.75]),
    (
        "color/atop",
        &[("base", &[0.0, 0.5, 1.0]), ("base_alpha", &[0.5]), ("top", &[1.0, 0.5, 0.0]), ("top_alpha", &[0.25])],
        &[0.25, 0.5, 0.75, 0.5],
    ),
    (
        "color/xor",
        &[("base", &[0.0, 0.5, 1.0]), ("base_alpha", &[0.5]), ("top", &[1.0, 0.5, 0.0]), ("top_alpha", &[0.5])],
        &[0.5, 0.5, 0.5, 0.5],
    ),
    ("color/xor", &[("top_alpha", &[1.0])], &[0.0, 0.0, 0.0, 0.0]),
    // Room for both: nothing of either is hidden. Without room the lower one has what is left.
    (
        "color/disjoint_over",
        &[("base", &[0.0, 0.5, 1.0]), ("base_alpha", &[0.25]), ("top", &[1.0, 0.5, 0.0]), ("top_alpha", &[0.25])],
        &[0.5, 0.5, 0.5, 0.5],
    ),
    (
        "color/disjoint_over",
        &[("base", &[0.0, 0.5, 1.0]), ("base_alpha", &[1.0]), ("top", &[1.0, 0.5, 0.0]), ("top_alpha", &[0.75])],
        &[0.75, 0.5, 0.25, 1.0],
    ),
    ("color/premultiply", &[("color", &[0.2, 0.4, 0.6]), ("alpha", &[0.5])], &[0.1, 0.2, 0.3]),
    ("color/unpremultiply", &[("color", &[0.1, 0.2, 0.3]), ("alpha", &[0.5])], &[0.2, 0.4, 0.6]),
    ("color/unpremultiply", &[("color", &[0.1, 0.2, 0.3]), ("alpha", &[0.0])], &[0.0, 0.0, 0.0]),
    ("color/four_corners", &[("uv", &[0.25, 2.0])], &[0.25, 1.0, 0.0]),
    ("color/split", &[("uv", &[0.2, 0.8])], &[0.0, 0.0, 0.0]),
    ("color/split", &[("uv", &[0.2, 0.8]), ("rotation", &[90.0])], &[1.0, 1.0, 1.0]),
    ("color/levels", &[("color", &[0.5, 0.25, 0.9]), ("in_low", &[0.25]), ("in_high", &[0.75])], &[0.5, 0.0, 1.0]),
    ("color/key", &[("color", &[1.0, 0.0, 0.0])], &[1.0]),
    ("color/ramp4", &[("t", &[0.25])], &[0.187_519, 0.187_519, 0.187_519]),
    ("coordinates/place2d", &[("uv", &[0.5, 0.5]), ("offset", &[0.25, 0.0]), ("size", &[2.0, 2.0])], &[0.375, 0.5]),
    // Turned counter-clockwise by 90 degrees, the picture's right edge is on top.
    ("coordinates/place2d", &[("uv", &[0.5, 0.0]), ("rotation", &[90.0])], &[1.0, 0.5]),
    ("coordinates/mirror", &[("uv", &[0.25, 0.75])], &[0.5, 0.5]),
    ("coordinates/flipbook", &[("uv", &[0.5, 0.5]), ("frame", &[15.25])], &[0.875, 0.875, 0.125, 0.125, 0.25]),
    ("coordinates/spherical", &[("dir", &[0.0, 0.0, 2.0])], &[0.75, 0.5]),
    ("coordinates/matcap", &[("normal", &[1.0, 0.0, 0.0]), ("view_dir", &[0.0, 0.0, 1.0])], &[1.0, 0.5]),
    ("coordinates/box", &[("position", &[0.3, 0.2, 9.0]), ("normal", &[0.0, 0.0, 1.0])], &[0.3, -0.2]),
    ("optics/f0_from_ior", &[], &[0.04]),
    ("optics/ior_from_f0", &[], &[1.5]),
    ("optics/absorption", &[("color", &[0.5, 1.0, 0.0]), ("thickness", &[2.0])], &[0.25, 1.0, 0.0]),
    // What the node for conductors makes of it is the reflectivity again.
    (
        "optics/artistic_ior",
        &[("reflectivity", &[0.5, 0.5, 0.5]), ("edge_color", &[1.0, 1.0, 1.0])],
        &[0.333_333, 0.333_333, 0.333_333, 0.942_809, 0.942_809, 0.942_809],
    ),
    (
        "optics/from_specular_gloss",
        &[("diffuse", &[0.0, 0.0, 0.0]), ("specular", &[1.0, 0.8, 0.3])],
        &[1.0, 0.8, 0.3, 1.0, 0.5],
    ),
    ("optics/from_specular_gloss", &[("diffuse", &[0.6, 0.3, 0.1])], &[0.6, 0.3, 0.1, 0.0, 0.5]),
    ("textures/normal_two_channel", &[("x", &[0.5]), ("y", &[1.0])], &[0.5, 1.0, 0.5]),
    ("textures/normal_rotate", &[("color", &[1.0, 0.5, 0.5]), ("rotation", &[90.0])], &[0.5, 1.0, 0.5]),
    ("textures/height_blend", &[("height_a", &[0.2]), ("height_b", &[0.9])], &[1.0]),
    ("textures/height_blend", &[], &[0.5]),
    ("procedural/checker", &[("uv", &[0.0, 0.0])], &[0.0]),
    ("procedural/checker", &[("uv", &[0.2, 0.0])], &[1.0]),
    ("procedural/stripes", &[("uv", &[0.01, 0.0])], &[1.0]),
    ("procedural/grid", &[("uv", &[0.0, 0.06])], &[1.0]),
    ("procedural/polygon", &[("uv", &[0.5, 0.8])], &[0.5, 0.0]),
    ("procedural/rounded_box", &[("uv", &[0.5, 0.5])], &[1.0, -0.2]),
    ("procedural/circle", &[("uv", &[0.5, 0.7])], &[1.0, -0.1]),
    ("procedural/circle", &[("uv", &[0.5, 0.5]), ("width", &[0.1])], &[0.0, 0.2]),
    ("procedural/circle", &[("uv", &[0.5, 0.75]), ("width", &[0.1])], &[1.0, -0.05]),
    ("procedural/line", &[("uv", &[0.5, 0.5])], &[1.0, -0.025]),
    ("procedural/line", &[("uv", &[0.2, 1.0])], &[0.0, 0.175]),
    ("procedural/line", &[("uv", &[0.2, 1.0]), ("b", &[0.2, 0.8])], &[0.0, 0.175]),
];

#[test]
fn nodes_give_their_special_values() {
    let mut failures = Vec::new();
    for (id, set, expected) in CASES {
        let node = Node::new(id);
        let found = &node.call::<f32>(&[node.row(set)])[0];
        let near = found.len() == expected.len()
            && found.iter().zip(*expected).all(|(a, b)| (a - b).abs() <= 2e-6 * b.abs().max(1.0) + 1e-6);
        if !near {
            failures.push(format!("{id} of {set:?}: {found:?}, not {expected:?}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Each index of Swizzle and Choose takes what it says.
#[test]
fn numbers_choose_what_they_say() {
    let extract = Node::new("vector/extract");
    let choose = Node::new("math/choose");
    for i in 0..8_u8 {
        let row = choose.row(&[("index", &[f32::from(i)]), (&format!("v{i}"), &[1.0])]);
        assert_eq!(choose.call::<f32>(&[row])[0], [1.0], "choose {i}");
    }
    for (i, expected) in [10.0, 20.0, 30.0, 40.0, 0.0, 1.0].iter().enumerate() {
        let row = extract.row(&[("v", &[10.0, 20.0, 30.0, 40.0]), ("index", &[i as f32])]);
        assert_eq!(extract.call::<f32>(&[row])[0], [*expected], "extract {i}");
    }
}

/// What went one way comes back.
#[test]
fn pairs_of_nodes_are_inverse() {
    let colors: Vec<[f32; 3]> = (0..125).map(|i| [i % 5, i / 5 % 5, i / 25].map(|c| 0.05 + 0.22 * c as f32)).collect();
    let to_hsl = Node::new("color/hsl_from_rgb");
    let from_hsl = Node::new("color/rgb_from_hsl");
    let oklch = Node::new("color/oklch_adjust");
    let artistic = Node::new("optics/artistic_ior");
    let conductor = Node::new("optics/conductor");
    for color in colors {
        let hsl: Vec<f32> = to_hsl.call::<f32>(&[color.to_vec()])[0].iter().map(|x| *x as f32).collect();
        let back = from_hsl.call::<f32>(&[hsl])[0].clone();
        let there = oklch.call::<f64>(&[oklch.row(&[("color", &color), ("hue_shift", &[0.0])])])[0].clone();
        let ior =
            &artistic.call::<f64>(&[artistic.row(&[("reflectivity", &color), ("edge_color", &[0.9, 0.5, 0.2])])])[0];
        let ior: Vec<f32> = ior.iter().map(|x| *x as f32).collect();
        let metal = conductor.call::<f32>(&[ior])[0].clone();
        for i in 0..3 {
            assert!((back[i] - f64::from(color[i])).abs() < 1e-6, "HSL of {color:?}: {back:?}");
            assert!((there[i] - f64::from(color[i])).abs() < 1e-5, "Oklab of {color:?}: {there:?}");
            assert!((metal[i] - f64::from(color[i])).abs() < 1e-5, "index of {color:?}: {metal:?}");
        }
    }
}

/// A matrix times its inverse is 1, both ways; the determinant of the inverse is the determinant's inverse.
#[test]
fn inverse_matrices_undo() {
    let [inverse, multiply, determinant] =
        ["inverse", "multiply", "determinant"].map(|name| Node::new(&format!("vector/matrix_{name}")));
    for i in 0..50 {
        let matrix: Vec<f32> = (0..9).map(|k| (((i * 9 + k) as f64 * 0.618_034).fract() * 6.0 - 3.0) as f32).collect();
        let volume = determinant.call::<f64>(std::slice::from_ref(&matrix))[0][0];
        if volume.abs() < 0.5 {
            continue;
        }
        let back: Vec<f32> = inverse.call::<f64>(std::slice::from_ref(&matrix))[0].iter().map(|x| *x as f32).collect();
        for row in [[matrix.clone(), back.clone()].concat(), [back.clone(), matrix].concat()] {
            for (k, x) in multiply.call::<f64>(&[row])[0].iter().enumerate() {
                assert!((x - f64::from(u8::from(k % 4 == 0))).abs() < 2e-5, "{k}: {x}");
            }
        }
        assert!((determinant.call::<f64>(&[back])[0][0] * volume - 1.0).abs() < 1e-5);
    }
}

/// The curve passes its points and never the values between which it runs.
#[test]
fn curves_do_not_overshoot() {
    let node = Node::new("math/curve");
    let values = [0.0_f32, 0.9, 0.1, 0.1, 1.0];
    let names = ["at_0", "at_25", "at_50", "at_75", "at_100"];
    let rows: Vec<Vec<f32>> = (0..=400)
        .map(|i| {
            let mut row = node.row(&[("x", &[i as f32 / 400.0])]);
            for (name, value) in names.iter().zip(values) {
                let at = node.at(name);
                row[at] = value;
            }
            row
        })
        .collect();
    for (i, found) in node.call::<f32>(&rows).iter().enumerate() {
        let left = (i / 100).min(3);
        let [a, b] = [values[left], values[left + 1]].map(f64::from);
        assert!(found[0] >= a.min(b) - 1e-6 && found[0] <= a.max(b) + 1e-6, "{i}: {found:?}");
        if i % 100 == 0 {
            assert!((found[0] - f64::from(values[i / 100])).abs() < 1e-6, "{i}: {found:?}");
        }
    }
}
