//! Socket types and the values that stand in a document.
//!
//! Does not convert between types (see `check`) and does not print WGSL (see the code generator).

use serde::{Deserialize, Serialize};

/// A type that a value on a wire can have, named as in WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Type {
    /// `bool`
    Bool,
    /// `i32`
    I32,
    /// `f32`
    F32,
    /// `vec2f`
    Vec2,
    /// `vec3f`
    Vec3,
    /// `vec4f`
    Vec4,
}

impl Type {
    /// The name in WGSL.
    pub fn wgsl(self) -> &'static str {
        match self {
            Type::Bool => "bool",
            Type::I32 => "i32",
            Type::F32 => "f32",
            Type::Vec2 => "vec2f",
            Type::Vec3 => "vec3f",
            Type::Vec4 => "vec4f",
        }
    }

    /// The type with this WGSL name.
    pub fn from_wgsl(name: &str) -> Option<Type> {
        Some(match name {
            "bool" => Type::Bool,
            "i32" => Type::I32,
            "f32" => Type::F32,
            "vec2f" => Type::Vec2,
            "vec3f" => Type::Vec3,
            "vec4f" => Type::Vec4,
            _ => return None,
        })
    }

    /// Number of scalar components: 1 to 4.
    pub fn components(self) -> usize {
        match self {
            Type::Bool | Type::I32 | Type::F32 => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 => 4,
        }
    }

    /// Whether a value of this type can stand where `to` is wanted, and nothing is lost:
    /// the same type, a scalar spread over a float vector, a whole number as a float.
    pub fn converts_to(self, to: Type) -> bool {
        self == to
            || (matches!(self, Type::F32 | Type::I32) && matches!(to, Type::F32 | Type::Vec2 | Type::Vec3 | Type::Vec4))
    }
}

/// What a socket takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SocketType {
    /// One fixed type.
    Value(Type),
    /// The node's own `T`, resolved for each use.
    Generic,
    /// A 2D texture; its sampler goes with it.
    Texture,
    /// The result of a surface node.
    Surface,
}

/// How the components of a picture are coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ColorSpace {
    /// IEC 61966-2-1, decoded on sampling; alpha is linear.
    Srgb,
    /// The stored numbers are the values.
    Linear,
}

/// What a texture returns outside of [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// Its edge.
    Clamp,
    /// The picture mirrored at each whole number.
    Mirror,
}

/// How a texture is read between its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// Trilinear, with mip levels.
    #[default]
    Linear,
    /// The nearest texel of the nearest mip level.
    Nearest,
}

/// A picture that a document refers to.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageRef {
    /// Path relative to the document; `MODEL.glb#N` is image N of a glTF file.
    pub file: String,
    /// How its components are coded; alpha is always linear.
    pub color_space: ColorSpace,
    /// What lies left and right of it.
    #[serde(default)]
    pub wrap_u: Wrap,
    /// What lies above and below it.
    #[serde(default)]
    pub wrap_v: Wrap,
    /// How it is read between texels.
    #[serde(default)]
    pub filter: Filter,
}

/// A value set on a socket. Numbers are finite in a sound document; `check` reports those that are not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// For `bool`.
    Bool(bool),
    /// For `f32`, and for `i32` when whole.
    Number(f32),
    /// For `i32`: a whole number that no `f32` holds, such as 16777217; see [`Value::whole`].
    Integer(i32),
    /// For `f32`, and for no `i32`: what was written is none, though the nearest `f32` is, such as 16777217.5 or -2147483649; see
    /// [`Value::from_digits`].
    Decimal {
        /// What an `f32` holds of it.
        nearest: f32,
        /// What was written.
        exact: f64,
    },
    /// For `vec2f`.
    Vec2([f32; 2]),
    /// For `vec3f`.
    Vec3([f32; 3]),
    /// For `vec4f`.
    Vec4([f32; 4]),
    /// For a texture.
    Image(ImageRef),
}

impl Value {
    /// A whole number: as [`Value::Number`] where an `f32` holds it.
    pub fn whole(x: i32) -> Value {
        let near = x as f32;
        if near as i64 == i64::from(x) { Value::Number(near) } else { Value::Integer(x) }
    }

    /// A number as it is written: exact where it is an `i32`, else for a float. `None` where it is no number; what is too large for an
    /// `f32` is infinite.
    pub fn from_digits(digits: &str) -> Option<Value> {
        // Straight to f32: through f64 it could be rounded twice.
        let (nearest, exact): (f32, f64) = (digits.parse().ok()?, digits.parse().ok()?);
        let is_i32 = |x: f64| x.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&x);
        // A fraction that no f64 holds is one all the same.
        let exact = match (exact.is_finite() && exact.fract() == 0.0 && !is_whole(digits), digits.starts_with('-')) {
            (false, _) => exact,
            (true, false) => exact.next_up(),
            (true, true) => exact.next_down(),
        };
        Some(match is_i32(exact).then(|| Value::whole(exact as i32)) {
            Some(integer @ Value::Integer(_)) => integer,
            None if is_i32(f64::from(nearest)) => Value::Decimal { nearest, exact },
            _ => Value::Number(nearest),
        })
    }

    /// The components of a number or vector; a bool is 0 or 1; none for an image, or for an integer that no `f32` holds:
    /// [`Value::numbers`] has it.
    pub fn components(&self) -> Option<&[f32]> {
        Some(match self {
            Value::Bool(false) => &[0.0],
            Value::Bool(true) => &[1.0],
            Value::Number(x) | Value::Decimal { nearest: x, .. } => std::slice::from_ref(x),
            Value::Vec2(v) => v,
            Value::Vec3(v) => v,
            Value::Vec4(v) => v,
            Value::Integer(_) | Value::Image(_) => return None,
        })
    }

    /// The components of any number, as exact as sockets have them; none for an image.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        match self {
            Value::Integer(x) => Some(vec![f64::from(*x)]),
            other => Some(other.components()?.iter().map(|x| f64::from(*x)).collect()),
        }
    }
}

/// Whether a number is whole as it is written, however many digits it has.
fn is_whole(digits: &str) -> bool {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let (front, back) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = || front.bytes().chain(back.bytes()).filter(u8::is_ascii_digit);
    // An exponent that no i64 holds is out of all bounds: what it leaves is 0 or larger than any fraction.
    let exponent =
        exponent.parse::<i64>().unwrap_or(if exponent.starts_with('-') { i64::MIN / 2 } else { i64::MAX / 2 });
    let behind = usize::try_from((back.len() as i64).saturating_sub(exponent)).unwrap_or(0);
    let count = digits().count();
    digits().skip(count.saturating_sub(behind)).all(|digit| digit == b'0')
}

impl Value {
    /// The components that this value has on a socket of type `ty`: its own, or one number spread over a vector; of an integer that
    /// no `f32` holds, the nearest. None when the
    /// value does not fit: a vector of another size, a bool as a number, a fraction as an `i32`, an image.
    pub fn components_as(&self, ty: Type) -> Option<Vec<f32>> {
        match (self, ty) {
            (Value::Bool(b), Type::Bool) => Some(vec![f32::from(*b)]),
            (Value::Number(x), Type::I32) => {
                (x.fract() == 0.0 && (-2_147_483_648.0..2_147_483_648.0).contains(x)).then(|| vec![*x])
            }
            (Value::Integer(x), Type::I32) => Some(vec![*x as f32]),
            (
                Value::Number(x) | Value::Decimal { nearest: x, .. },
                Type::F32 | Type::Vec2 | Type::Vec3 | Type::Vec4,
            ) => Some(vec![*x; ty.components()]),
            (Value::Integer(x), Type::F32 | Type::Vec2 | Type::Vec3 | Type::Vec4) => {
                Some(vec![*x as f32; ty.components()])
            }
            (Value::Vec2(_) | Value::Vec3(_) | Value::Vec4(_), _) => {
                (self.ty() == Some(ty)).then(|| self.components().map(<[f32]>::to_vec)).flatten()
            }
            _ => None,
        }
    }

    /// The type as which the value was written: `f32` for every single number; none for an image.
    pub fn ty(&self) -> Option<Type> {
        match self {
            Value::Bool(_) => Some(Type::Bool),
            Value::Number(_) | Value::Integer(_) | Value::Decimal { .. } => Some(Type::F32),
            Value::Vec2(_) => Some(Type::Vec2),
            Value::Vec3(_) => Some(Type::Vec3),
            Value::Vec4(_) => Some(Type::Vec4),
            Value::Image(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_whole_as_it_is_written() {
        for (digits, whole) in [
            ("3", true),
            ("3.0", true),
            ("3.50e1", true),
            ("3.50e0", false),
            ("1e3", true),
            ("1200e-2", true),
            ("1200e-3", false),
            ("-0.000", true),
            ("0e-400", true),
            ("1e-400", false),
            ("1e-99999999999999999999", false),
            ("2147483647.0000000000000000000001", false),
            ("2147483647.0000000000000000000000", true),
            ("-16777216.00000000000000000000000001", false),
        ] {
            assert_eq!(is_whole(digits), whole, "{digits}");
            let value = Value::from_digits(digits).expect("a number");
            assert_eq!(value.components_as(Type::I32).is_some(), whole, "{digits}: {value:?}");
            // As a float it is the nearest.
            let nearest: f32 = digits.parse().expect("a number");
            assert_eq!(value.components_as(Type::F32), Some(vec![nearest]), "{digits}");
        }
    }

    /// What is written of a fraction that no f64 holds is read as a fraction again.
    #[test]
    fn a_fraction_stays_one() {
        for digits in ["1e-400", "-1e-400", "16777216.0000000000000000001", "-3.00000000000000000000001"] {
            let Some(Value::Decimal { exact, .. }) = Value::from_digits(digits) else { panic!("{digits}") };
            let again = Value::from_digits(&format!("{exact:?}"));
            assert!(again.is_some_and(|value| value.components_as(Type::I32).is_none()), "{digits}: {exact:?}");
        }
    }
}
