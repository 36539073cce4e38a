//! The points and parameters that a material is tried at.

use halfvector_interp::{Float, Half};

use crate::stability::trace::Trace;

/// The arithmetic that is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// f32: what nearly all shaders compute in.
    #[default]
    Single,
    /// f16 throughout, inputs and parameters as well: what `mediump` and `half` targets may compute in.
    Half,
}

impl Precision {
    /// Bits of the fraction.
    fn bits(self) -> i32 {
        match self {
            Precision::Single => 23,
            Precision::Half => 10,
        }
    }

    /// The least number of the normal range.
    pub(super) fn least_normal(self) -> f64 {
        match self {
            Precision::Single => f64::from(f32::MIN_POSITIVE),
            Precision::Half => 2.0_f64.powi(-14),
        }
    }

    /// Error that is no fault, relative to the value or to the output's rms: a quarter of a step of an 8-bit display; of f16,
    /// which is a quarter of a step apart itself, eight times that.
    pub(super) fn tolerance(self) -> f64 {
        match self {
            Precision::Single => 1e-3,
            Precision::Half => 8e-3,
        }
    }

    /// How far away a jump may lie that a point was taken across: about 800 units of the last place of f32 at 1, 20 of f16.
    pub(super) fn reach(self) -> f64 {
        match self {
            Precision::Single => 1e-4,
            Precision::Half => 2e-2,
        }
    }

    /// The nearest number.
    pub(super) fn rounded(self, x: f64) -> f64 {
        match self {
            Precision::Single => f64::from(x as f32),
            Precision::Half => Half::from_f64(x).to_f64(),
        }
    }

    /// A number moved by so many of its units in the last place.
    pub(super) fn moved(self, x: f64, ulps: f64) -> f64 {
        let exponent = if x.abs() < self.least_normal() { self.least_normal().log2() } else { x.abs().log2().floor() };
        x + ulps * 2.0_f64.powi(exponent as i32 - self.bits())
    }
}

/// Points for each setting of the parameters.
pub(super) const POINTS: usize = 1024;

/// Settings: the defaults, all at the low end, all at the high end, and some between.
pub(super) const SETTINGS: usize = 6;

/// Numbers that look random and are the same on every machine: Steele, Lea and Flood 2014, "Fast splittable pseudorandom
/// number generators" (SplitMix64).
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// From 0 to 1.
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn direction(&mut self) -> [f64; 3] {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (std::f64::consts::TAU * self.unit()).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        [r * cos, r * sin, z]
    }
}

/// Columns of the contexts' scalars, all numbers of the precision. One point in four lies on a coarse lattice, where patterns have
/// their corners; texture coordinates go from 0 to 1, every other time from -4 to 4; positions from -2 to 2 m; colours of
/// vertices from 0 to 1; an hour of time.
pub(super) fn contexts(trace: &Trace<'_>, precision: Precision, random: &mut Random) -> Vec<Vec<f64>> {
    let mut points = Vec::with_capacity(POINTS);
    for number in 0..POINTS {
        let mut lattice = |low: f64, high: f64| {
            let x = random.between(low, high);
            if number % 4 == 0 { (x * 4.0).round() / 4.0 } else { x }
        };
        let reach = if number % 2 == 0 { [0.0, 1.0] } else { [-4.0, 4.0] };
        let uv0 = [lattice(reach[0], reach[1]), lattice(reach[0], reach[1])];
        let uv1 = [lattice(reach[0], reach[1]), lattice(reach[0], reach[1])];
        let world = [0; 3].map(|_| lattice(-2.0, 2.0));
        let object = [0; 3].map(|_| lattice(-2.0, 2.0));
        let time = lattice(0.0, 3600.0);
        let (normal, other) = (random.direction(), random.direction());
        let [n, o] = [normal, other];
        let across = [n[1] * o[2] - n[2] * o[1], n[2] * o[0] - n[0] * o[2], n[0] * o[1] - n[1] * o[0]];
        let length = across.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-6);
        let view = if dot(n, o) < 0.0 { o.map(|x| -x) } else { o };
        points.push((uv0, uv1, world, object, normal, across.map(|x| x / length), view, time));
    }
    trace
        .inputs()
        .map(|name| {
            let mut parts = name.split('.').skip(1);
            let context = parts.next().unwrap_or_default();
            let (part, row) = (parts.next(), parts.next());
            if context == "vertex_color" {
                return points.iter().map(|_| precision.rounded(random.unit())).collect();
            }
            let component = part.map_or(0, |c| "xyzw".find(c).unwrap_or_default());
            // The object stands where it was modelled, before a viewer at the origin.
            let on_diagonal = part.and_then(|column| column.parse().ok()) == row.and_then(|row| "xyzw".find(row));
            let of =
                |(uv0, uv1, world, object, normal, tangent, view, time): &([f64; 2], [f64; 2], V, V, V, V, V, f64)| {
                    let number = match context {
                        "uv0" => uv0[component],
                        "uv1" => uv1[component],
                        "world_position" => world[component],
                        "object_position" => object[component],
                        "world_normal" => normal[component],
                        "world_tangent" => tangent.get(component).copied().unwrap_or(1.0),
                        "view_dir" => view[component],
                        "time" => *time,
                        _ if row.is_some() => f64::from(u8::from(on_diagonal)),
                        _ => 0.0,
                    };
                    precision.rounded(number)
                };
            points.iter().map(of).collect()
        })
        .collect()
}

type V = [f64; 3];

fn dot(a: V, b: V) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The numbers of each parameter in setting number `setting`.
pub(super) fn setting(trace: &Trace<'_>, precision: Precision, setting: usize, random: &mut Random) -> Vec<Vec<f32>> {
    let of = |parameter: &crate::stability::trace::Parameter| {
        let [low, high] = parameter.range;
        let mut number = |default: f32| match setting {
            0 => default,
            1 => low,
            2 => high,
            _ => random.between(f64::from(low), f64::from(high)) as f32,
        };
        parameter.default.iter().map(|&default| precision.rounded(f64::from(number(default))) as f32).collect()
    };
    trace.parameters.iter().map(of).collect()
}
