//! The points that a material is tried at: contexts and exposed parameters, one column of numbers each.

use std::f64::consts::TAU;

use halfvector_interp::{Float, Half};

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

/// Settings: the defaults, all at the low end, all at the high end, and three with other numbers at each point.
const SETTINGS: usize = 6;

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

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn direction(&mut self) -> [f64; 3] {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        [r * cos, r * sin, z]
    }
}

/// A scalar that a material reads.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Input {
    /// For people: `uv0.x`, `tint.y`.
    pub(super) name: String,
    /// Where its numbers come from.
    pub(super) source: Source,
    /// What the program takes it as.
    pub(super) number: Number,
}

/// Where an input's numbers come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// A context that may be anything between two numbers; of texture coordinates the inner half is met more often.
    Range { from: f64, to: f64, is_uv: bool },
    /// A component of one of [`Frame`]'s vectors.
    Frame { vector: usize, component: usize },
    /// Always the same.
    Fixed(f64),
    /// A component of an exposed parameter: its default and its range.
    Parameter { default: f64, from: f64, to: f64 },
}

/// What a program takes an input as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Float,
    Signed,
    Unsigned,
}

impl Source {
    /// A context by its name and the way to the scalar, as the program's slot is named: `uv0`, `x`.
    pub(super) fn of_context(name: &str, way: &[&str]) -> Source {
        let component = way.first().and_then(|part| "xyzw".find(part)).unwrap_or_default();
        match name {
            "uv0" | "uv1" => Source::Range { from: -4.0, to: 4.0, is_uv: true },
            "world_position" | "object_position" => Source::Range { from: -2.0, to: 2.0, is_uv: false },
            "vertex_color" => Source::Range { from: 0.0, to: 1.0, is_uv: false },
            // An hour.
            "time" => Source::Range { from: 0.0, to: 3600.0, is_uv: false },
            "world_normal" => Source::Frame { vector: 0, component },
            // The fourth is the handedness.
            "world_tangent" if component < 3 => Source::Frame { vector: 1, component },
            "world_tangent" => Source::Fixed(1.0),
            "view_dir" => Source::Frame { vector: 2, component },
            // The object stands where it was modelled, before a viewer at the origin.
            _ => match way {
                [column, row] => Source::Fixed(f64::from(u8::from(column.parse().ok() == "xyzw".find(row)))),
                _ => Source::Fixed(0.0),
            },
        }
    }
}

impl Input {
    /// Between which numbers it may be moved alone.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        match self.source {
            Source::Range { from, to, .. } => Some([from, to]),
            Source::Parameter { from, to, .. } if from < to => Some([from, to]),
            Source::Parameter { .. } | Source::Frame { .. } | Source::Fixed(_) => None,
        }
    }

    /// Whether a number that it is given may lie between two neighbours.
    pub(super) fn is_float(&self) -> bool {
        self.number == Number::Float
    }

    /// How far it may move: its range, or that of a component of a direction; none where it stays.
    pub(super) fn span(&self) -> Option<f64> {
        match self.source {
            Source::Frame { .. } => Some(2.0),
            _ => self.range().map(|[from, to]| to - from).filter(|_| self.is_float()),
        }
    }

    fn is_parameter(&self) -> bool {
        matches!(self.source, Source::Parameter { .. })
    }

    /// The nearest number that it can be.
    pub(super) fn rounded(&self, precision: Precision, x: f64) -> f64 {
        if self.is_float() { precision.rounded(x) } else { x.round() }
    }
}

/// A place on a surface as it is seen: normal, tangent and the direction to the viewer, all of length 1; the tangent lies across
/// the normal and the viewer not behind the surface.
#[derive(Clone, Copy, Debug)]
struct Frame([[f64; 3]; 3]);

impl Frame {
    fn new(random: &mut Random) -> Frame {
        let (normal, other) = (random.direction(), random.direction());
        let behind = dot(normal, other) < 0.0;
        Frame([normal, other, if behind { other.map(|x| -x) } else { other }]).straight()
    }

    /// With lengths of 1, and the tangent across the normal.
    fn straight(self) -> Frame {
        let [normal, tangent, view] = self.0;
        let normal = unit(normal);
        let along = dot(normal, tangent);
        let tangent = [0, 1, 2].map(|i| tangent[i] - along * normal[i]);
        Frame([normal, unit(tangent), unit(view)])
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt().max(1e-6);
    v.map(|x| x / length)
}

/// Points: a column for each input.
#[derive(Clone, Debug)]
pub(super) struct Points {
    pub(super) columns: Vec<Vec<f64>>,
    pub(super) count: usize,
}

impl Points {
    /// Of points that are rows of numbers.
    pub(super) fn of<'p>(inputs: &[Input], points: impl IntoIterator<Item = &'p [f64]>) -> Points {
        let mut all = Points { columns: vec![Vec::new(); inputs.len()], count: 0 };
        for point in points {
            all.columns.iter_mut().zip(point).for_each(|(column, x)| column.push(*x));
            all.count += 1;
        }
        all
    }

    /// Some of them.
    pub(super) fn of_numbers(&self, numbers: &[usize]) -> Points {
        let columns = self.columns.iter().map(|column| numbers.iter().map(|number| column[*number]).collect());
        Points { columns: columns.collect(), count: numbers.len() }
    }

    /// One of them.
    pub(super) fn point(&self, number: usize) -> Vec<f64> {
        self.columns.iter().map(|column| column[number]).collect()
    }
}

/// What is tried, one element for each setting of the parameters; all are numbers of the precision. One point in four lies on a
/// coarse lattice, where patterns have their corners; texture coordinates are from 0 to 1 at every other point.
pub(super) fn domain(inputs: &[Input], precision: Precision, random: &mut Random) -> Vec<Points> {
    let settings = if inputs.iter().any(Input::is_parameter) { SETTINGS } else { 1 };
    (0..settings).map(|setting| points(inputs, precision, setting, random)).collect()
}

fn points(inputs: &[Input], precision: Precision, setting: usize, random: &mut Random) -> Points {
    let mut columns = vec![Vec::with_capacity(POINTS); inputs.len()];
    for number in 0..POINTS {
        let Frame(frame) = Frame::new(random);
        for (input, column) in inputs.iter().zip(&mut columns) {
            let x = match input.source {
                Source::Range { from, to, is_uv } => {
                    let [from, to] = if is_uv && number % 2 == 0 { [0.0, 1.0] } else { [from, to] };
                    let x = random.between(from, to);
                    if number % 4 == 0 { (x * 4.0).round() / 4.0 } else { x }
                }
                Source::Frame { vector, component } => frame[vector][component],
                Source::Fixed(x) => x,
                Source::Parameter { default, from, to } => match setting {
                    0 => default,
                    1 => from,
                    2 => to,
                    _ => random.between(from, to),
                },
            };
            column.push(input.rounded(precision, x));
        }
    }
    Points { columns, count: POINTS }
}

/// The point halfway between two.
pub(super) fn between(inputs: &[Input], a: &[f64], b: &[f64]) -> Vec<f64> {
    on_the_way(inputs, a, b, 0.5)
}

/// The point at a part of the way from one to another. Where they differ in a direction the frame is made straight again.
pub(super) fn on_the_way(inputs: &[Input], a: &[f64], b: &[f64], part: f64) -> Vec<f64> {
    let at = |(a, b): (&f64, &f64)| if a == b { *a } else { a * (1.0 - part) + b * part };
    settled(inputs, a, a.iter().zip(b).map(at).collect())
}

/// A point that was moved away from another one: with its numbers within their ranges, and its frame straight if that was turned.
pub(super) fn settled(inputs: &[Input], from: &[f64], mut to: Vec<f64>) -> Vec<f64> {
    let mut turns = false;
    for ((input, from), to) in inputs.iter().zip(from).zip(&mut to) {
        if let Some([low, high]) = input.range() {
            *to = to.clamp(low, high);
        }
        turns |= matches!(input.source, Source::Frame { .. }) && from != to;
    }
    if turns {
        // A normal that the material does not read is 0: no tangent is held across it.
        let mut frame = [[0.0; 3]; 3];
        for (input, x) in inputs.iter().zip(&to) {
            if let Source::Frame { vector, component } = input.source {
                frame[vector][component] = *x;
            }
        }
        let Frame(frame) = Frame(frame).straight();
        for (input, x) in inputs.iter().zip(&mut to) {
            if let Source::Frame { vector, component } = input.source {
                *x = frame[vector][component];
            }
        }
    }
    to
}
