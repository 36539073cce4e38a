//! The blend modes against the formulas of W3C 2015, "Compositing and Blending Level 1", section 9, computed here in f64.

use super::run::Node;

type Color = [f64; 3];

fn channels(a: Color, b: Color, f: impl Fn(f64, f64) -> f64) -> Color {
    [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])]
}

fn hard_light(b: f64, s: f64) -> f64 {
    if s <= 0.5 { b * 2.0 * s } else { b + (2.0 * s - 1.0) - b * (2.0 * s - 1.0) }
}

fn soft_light(b: f64, s: f64) -> f64 {
    let d = if b <= 0.25 { ((16.0 * b - 12.0) * b + 4.0) * b } else { b.sqrt() };
    if s <= 0.5 { b - (1.0 - 2.0 * s) * b * (1.0 - b) } else { b + (2.0 * s - 1.0) * (d - b) }
}

fn dodge(b: f64, s: f64) -> f64 {
    if b == 0.0 {
        0.0
    } else if s == 1.0 {
        1.0
    } else {
        (b / (1.0 - s)).min(1.0)
    }
}

fn burn(b: f64, s: f64) -> f64 {
    if b == 1.0 {
        1.0
    } else if s == 0.0 {
        0.0
    } else {
        1.0 - ((1.0 - b) / s).min(1.0)
    }
}

fn lum(c: Color) -> f64 {
    0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]
}

fn sat(c: Color) -> f64 {
    c[0].max(c[1]).max(c[2]) - c[0].min(c[1]).min(c[2])
}

fn clip(c: Color) -> Color {
    let l = lum(c);
    let n = c[0].min(c[1]).min(c[2]);
    let x = c[0].max(c[1]).max(c[2]);
    let mut c = c;
    if n < 0.0 {
        c = c.map(|v| l + (v - l) * l / (l - n));
    }
    if x > 1.0 {
        c = c.map(|v| l + (v - l) * (1.0 - l) / (x - l));
    }
    c
}

fn set_lum(c: Color, l: f64) -> Color {
    let d = l - lum(c);
    clip(c.map(|v| v + d))
}

/// The greatest channel becomes s, the least 0, the middle keeps its place between them.
fn set_sat(c: Color, s: f64) -> Color {
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| c[*a].total_cmp(&c[*b]));
    let [min, mid, max] = order;
    let mut out = [0.0; 3];
    if c[max] > c[min] {
        out[mid] = (c[mid] - c[min]) * s / (c[max] - c[min]);
        out[max] = s;
    }
    out
}

fn truth(mode: &str, b: Color, s: Color) -> Color {
    match mode {
        "multiply" => channels(b, s, |b, s| b * s),
        "screen" => channels(b, s, |b, s| b + s - b * s),
        "overlay" => channels(b, s, |b, s| hard_light(s, b)),
        "darken" => channels(b, s, f64::min),
        "lighten" => channels(b, s, f64::max),
        "dodge" => channels(b, s, dodge),
        "burn" => channels(b, s, burn),
        "hard_light" => channels(b, s, hard_light),
        "soft_light" => channels(b, s, soft_light),
        "difference" => channels(b, s, |b, s| (b - s).abs()),
        "exclusion" => channels(b, s, |b, s| b + s - 2.0 * b * s),
        "add" => channels(b, s, |b, s| b + s),
        "hue" => set_lum(set_sat(s, sat(b)), lum(b)),
        "saturation" => set_lum(set_sat(b, sat(s)), lum(b)),
        "color" => set_lum(s, lum(b)),
        "luminosity" => set_lum(b, lum(s)),
        _ => panic!("no formula for {mode}"),
    }
}

#[test]
fn blend_modes_are_those_of_the_w3c() {
    const LEVELS: [f32; 6] = [0.0, 0.13, 0.25, 0.5, 0.8, 1.0];
    let colors: Vec<[f32; 3]> = (0..216).map(|i| [LEVELS[i % 6], LEVELS[i / 6 % 6], LEVELS[i / 36]]).collect();
    for mode in [
        "multiply",
        "screen",
        "overlay",
        "darken",
        "lighten",
        "dodge",
        "burn",
        "hard_light",
        "soft_light",
        "difference",
        "exclusion",
        "add",
        "hue",
        "saturation",
        "color",
        "luminosity",
    ] {
        let node = Node::new(&format!("color/blend_{mode}"));
        let mut rows = Vec::new();
        let mut pairs = Vec::new();
        for (i, base) in colors.iter().enumerate() {
            for (j, top) in colors.iter().enumerate().filter(|(j, _)| (i + j) % 5 == 0) {
                let opacity = [1.0, 0.3][j % 2];
                rows.push(node.row(&[("base", base), ("top", top), ("opacity", &[opacity])]));
                pairs.push((base.map(f64::from), top.map(f64::from), f64::from(opacity)));
            }
        }
        let mut worst: f64 = 0.0;
        for (found, (base, top, opacity)) in node.call::<f32>(&rows).iter().zip(&pairs) {
            let blend = truth(mode, *base, *top);
            for i in 0..3 {
                worst = worst.max((found[i] - (base[i] + (blend[i] - base[i]) * opacity)).abs());
            }
        }
        println!("{mode}: {worst:.1e}");
        assert!(worst < 2e-6, "{mode}: {worst}");
    }
}
