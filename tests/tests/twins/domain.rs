//! Deterministic arguments for the twins: every number an exact f32, ends of each range among them.

/// What one or more neighbouring arguments are drawn from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Domain {
    /// A number between two, uniform.
    Range(f32, f32),
    /// A cosine in [1e-6, 1].
    Cosine,
    /// Perceptual roughness in [1e-4, 1].
    Roughness,
    /// Square of a perceptual roughness in [1e-4, 1].
    Alpha,
    /// False or true: 0 or 1.
    Bool,
    /// n.h and sin^2 of the angle between (two arguments).
    HalfAngle,
    /// Two numbers between two.
    Pair(f32, f32),
    /// A colour between two values.
    Color(f32, f32),
    /// f0 and f90 with 0 <= f0 <= ratio * f90 and f90 <= 1 (two arguments).
    Reflectances(f32),
    /// A unit vector.
    Unit,
    /// A unit vector with z >= 0.1.
    UnitUp,
    /// A vector of length 1e-3 to 1e3.
    Vector,
    /// A point in a cube about the origin of this half size.
    Point(f32),
    /// A unit tangent of the argument before, within 10 degrees of perpendicular, with handedness +-1.
    TangentOfLast,
    /// Two derivatives of a position, no longer than 0.1, and the unit normal across both (three arguments).
    Footprint,
    /// Two derivatives of texture coordinates, no longer than 0.1 and at least 26 degrees from one line (two arguments).
    UvFootprint,
    /// A frame: unit normal, unit view direction, and n.v (a struct).
    Frame,
    /// A unit direction in front of the frame before.
    FrontOfLast,
    /// A unit direction behind the frame before.
    BackOfLast,
    /// Nine coefficients in [-1, 1], four components each.
    Harmonics,
}

/// A generator of numbers, the same on every machine. Steele, Lea, Flood 2014, Fast Splittable Pseudorandom Number
/// Generators (SplitMix64).
pub(crate) struct Numbers(u64);

impl Numbers {
    pub(crate) fn new(name: &str) -> Self {
        Numbers(name.bytes().fold(0x9e37_79b9, |seed, byte| seed.wrapping_mul(0x100_0193) ^ u64::from(byte)))
    }

    /// Anything that an f32 can be: any bits, the special numbers, or one in [-1, 1].
    pub(crate) fn anything(&mut self) -> f32 {
        const SPECIAL: [f32; 11] =
            [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1.0, -1.0, f32::MAX, f32::MIN, 1e-40, 0.5];
        let bits = self.bits();
        match bits % 4 {
            0 => f32::from_bits((bits >> 32) as u32),
            1 => SPECIAL[(bits >> 8) as usize % SPECIAL.len()],
            _ => (bits >> 40) as f32 / (1 << 24) as f32 * 2.0 - 1.0,
        }
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn coin(&mut self) -> bool {
        self.bits() & 1 == 0
    }

    /// Uniform in [0, 1], each end once in 32 draws.
    fn unit(&mut self) -> f64 {
        match self.bits() % 32 {
            0 => 0.0,
            1 => 1.0,
            _ => (self.bits() >> 11) as f64 / (1_u64 << 53) as f64,
        }
    }

    fn range(&mut self, low: f32, high: f32) -> f32 {
        let (low, high) = (f64::from(low), f64::from(high));
        (low + (high - low) * self.unit()) as f32
    }

    /// Between two positive numbers, as many of each order of magnitude.
    fn magnitude(&mut self, low: f32, high: f32) -> f32 {
        let (from, to) = (f64::from(low).ln(), f64::from(high).ln());
        ((from + (to - from) * self.unit()).exp() as f32).clamp(low, high)
    }

    /// Half of them uniform, half of them logarithmic.
    fn up_to_1_from(&mut self, low: f32) -> f32 {
        if self.coin() { self.range(low, 1.0) } else { self.magnitude(low, 1.0) }
    }

    /// A unit vector, rounded to f32; along an axis once in 32 draws.
    fn direction(&mut self) -> [f32; 3] {
        if self.bits().is_multiple_of(32) {
            let mut axis = [0.0; 3];
            axis[(self.bits() % 3) as usize] = if self.coin() { 1.0 } else { -1.0 };
            return axis;
        }
        let z = 2.0 * self.unit() - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * self.unit()).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [(r * cos) as f32, (r * sin) as f32, z as f32]
    }
}

fn last<const N: usize>(out: &[f32]) -> [f32; N] {
    out[out.len() - N..].try_into().expect("enough arguments before")
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|i| f64::from(a[i]) * f64::from(b[i])).sum()
}

fn unit(v: [f64; 3]) -> [f32; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| (x / length) as f32)
}

/// A unit vector across `axis` (unit), turned about it by a drawn angle.
fn across(axis: [f32; 3], numbers: &mut Numbers) -> [f32; 3] {
    loop {
        let other = numbers.direction();
        let along = dot(axis, other);
        if along.abs() < 0.9 {
            return unit([0, 1, 2].map(|i| f64::from(other[i]) - along * f64::from(axis[i])));
        }
    }
}

impl Domain {
    /// Appends the numbers of one draw.
    pub(crate) fn draw(self, n: &mut Numbers, out: &mut Vec<f32>) {
        match self {
            Domain::Range(low, high) => out.push(n.range(low, high)),
            Domain::Cosine => out.push(n.up_to_1_from(1e-6)),
            Domain::Roughness => out.push(n.up_to_1_from(1e-4)),
            Domain::Alpha => {
                let roughness = n.up_to_1_from(1e-4);
                out.push(roughness * roughness);
            }
            Domain::Bool => out.push((n.bits() % 2) as f32),
            Domain::HalfAngle => {
                let sin2 = n.up_to_1_from(1e-16);
                out.extend([(1.0 - f64::from(sin2)).sqrt() as f32, sin2]);
            }
            Domain::Pair(low, high) => out.extend([n.range(low, high), n.range(low, high)]),
            Domain::Color(low, high) => out.extend([n.range(low, high), n.range(low, high), n.range(low, high)]),
            Domain::Reflectances(ratio) => {
                let f90 = [0; 3].map(|_| n.range(0.0, 1.0));
                out.extend(f90.map(|f| f * n.range(0.0, ratio)));
                out.extend(f90);
            }
            Domain::Unit => out.extend(n.direction()),
            Domain::UnitUp => loop {
                let v = n.direction();
                if v[2] >= 0.1 {
                    return out.extend(v);
                }
            },
            Domain::Vector => {
                let length = n.magnitude(1e-3, 1e3);
                out.extend(n.direction().map(|x| x * length));
            }
            Domain::Point(half) => out.extend([0; 3].map(|_| n.range(-half, half))),
            Domain::TangentOfLast => {
                let normal = last::<3>(out);
                let tangent = across(normal, n);
                let lean = f64::from(n.range(-0.17, 0.17));
                out.extend(unit([0, 1, 2].map(|i| f64::from(tangent[i]) + lean * f64::from(normal[i]))));
                out.push(if n.coin() { 1.0 } else { -1.0 });
            }
            Domain::Footprint => {
                let normal = n.direction();
                let first = across(normal, n);
                let second = loop {
                    let second = across(normal, n);
                    if dot(first, second).abs() < 0.9 {
                        break second;
                    }
                };
                let lengths = [n.magnitude(1e-4, 0.1), n.magnitude(1e-4, 0.1)];
                out.extend(first.map(|x| x * lengths[0]));
                out.extend(second.map(|x| x * lengths[1]));
                out.extend(normal);
            }
            Domain::UvFootprint => loop {
                let [a, b] = [0; 2].map(|_| std::f64::consts::TAU * n.unit());
                if (a - b).sin().abs() > 0.44 {
                    let lengths = [n.magnitude(1e-4, 0.1), n.magnitude(1e-4, 0.1)];
                    return out.extend(
                        [(a, lengths[0]), (b, lengths[1])]
                            .iter()
                            .flat_map(|(a, l)| [a.cos() as f32 * l, a.sin() as f32 * l]),
                    );
                }
            },
            Domain::Frame => loop {
                let (normal, view) = (n.direction(), n.direction());
                let n_dot_v = dot(normal, view);
                if n_dot_v > 1e-3 {
                    out.extend(normal);
                    out.extend(view);
                    return out.push(n_dot_v.min(1.0) as f32);
                }
            },
            Domain::FrontOfLast => loop {
                let [x, y, z, ..] = last::<7>(out);
                let light = n.direction();
                if dot([x, y, z], light) > 1e-3 {
                    return out.extend(light);
                }
            },
            Domain::BackOfLast => {
                Domain::FrontOfLast.draw(n, out);
                let at = out.len() - 3;
                out[at..].iter_mut().for_each(|x| *x = -*x);
            }
            Domain::Harmonics => out.extend([0; 36].map(|_| n.range(-1.0, 1.0))),
        }
    }
}
