//! Types of values, and how they are called.

/// A type; numbers without a suffix have one of their own until something asks for another.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Ty {
    /// Nothing is said of it.
    Unknown,
    Scalar(Scalar),
    Vector(u8, Scalar),
    /// Columns and rows.
    Matrix(u8, u8),
    Array(Box<Ty>, Option<u64>),
    Struct(String),
    /// What `modf` or `frexp` gives, and its second member.
    Parts(&'static str, &'static str),
    /// Values of a place in it.
    Texture(u8),
    Sampler,
    /// What a function gives that gives nothing.
    Nothing,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scalar {
    /// `1`
    Integer,
    /// `1.0`
    Decimal,
    F32,
    I32,
    U32,
    Bool,
}

impl Scalar {
    pub(super) fn is_float(self) -> bool {
        matches!(self, Scalar::Integer | Scalar::Decimal | Scalar::F32)
    }

    pub(super) fn is_whole(self) -> bool {
        matches!(self, Scalar::Integer | Scalar::I32 | Scalar::U32)
    }

    /// The type of both, if there is one.
    pub(super) fn common(self, other: Scalar) -> Option<Scalar> {
        match (self, other) {
            (a, b) if a == b => Some(a),
            (Scalar::Integer, number) | (number, Scalar::Integer) if number != Scalar::Bool => Some(number),
            (Scalar::Decimal, Scalar::F32) | (Scalar::F32, Scalar::Decimal) => Some(Scalar::F32),
            _ => None,
        }
    }

    /// What a variable of it holds.
    pub(super) fn concrete(self) -> Scalar {
        match self {
            Scalar::Integer => Scalar::I32,
            Scalar::Decimal => Scalar::F32,
            other => other,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Scalar::Integer => "a number",
            Scalar::Decimal | Scalar::F32 => "f32",
            Scalar::I32 => "i32",
            Scalar::U32 => "u32",
            Scalar::Bool => "bool",
        }
    }
}

impl Ty {
    pub(super) const BOOL: Ty = Ty::Scalar(Scalar::Bool);
    pub(super) const F32: Ty = Ty::Scalar(Scalar::F32);

    pub(super) fn scalar(&self) -> Option<Scalar> {
        match self {
            Ty::Scalar(scalar) | Ty::Vector(_, scalar) => Some(*scalar),
            Ty::Matrix(..) => Some(Scalar::F32),
            _ => None,
        }
    }

    /// Values of a vector or scalar; 0 of all else.
    pub(super) fn size(&self) -> u8 {
        match self {
            Ty::Scalar(_) => 1,
            Ty::Vector(size, _) => *size,
            _ => 0,
        }
    }

    /// A scalar or vector of so many values.
    pub(super) fn of(size: u8, scalar: Scalar) -> Ty {
        if size == 1 { Ty::Scalar(scalar) } else { Ty::Vector(size, scalar) }
    }

    pub(super) fn is_unknown(&self) -> bool {
        matches!(self, Ty::Unknown)
    }

    pub(super) fn concrete(self) -> Ty {
        match self {
            Ty::Scalar(scalar) => Ty::Scalar(scalar.concrete()),
            Ty::Vector(size, scalar) => Ty::Vector(size, scalar.concrete()),
            Ty::Array(element, size) => Ty::Array(Box::new(element.concrete()), size),
            other => other,
        }
    }

    /// Whether a value of this type stands where one of another is wanted.
    pub(super) fn fits(&self, wanted: &Ty) -> bool {
        match (self, wanted) {
            (Ty::Unknown, _) | (_, Ty::Unknown) => true,
            (Ty::Scalar(a), Ty::Scalar(b)) => a.common(*b) == Some(*b),
            (Ty::Vector(m, a), Ty::Vector(n, b)) => m == n && a.common(*b) == Some(*b),
            (Ty::Array(a, m), Ty::Array(b, n)) => a.fits(b) && (m == n || m.is_none() || n.is_none()),
            (a, b) => a == b,
        }
    }

    /// As it is called.
    pub(super) fn name(&self) -> String {
        match self {
            Ty::Unknown => "something else".into(),
            Ty::Scalar(scalar) => scalar.name().into(),
            Ty::Vector(size, Scalar::Bool) => format!("vec{size}<bool>"),
            Ty::Vector(size, scalar) => {
                let letter = match scalar {
                    Scalar::I32 => 'i',
                    Scalar::U32 => 'u',
                    _ => 'f',
                };
                format!("vec{size}{letter}")
            }
            Ty::Matrix(columns, rows) => format!("mat{columns}x{rows}f"),
            Ty::Array(element, Some(size)) => format!("array<{}, {size}>", element.clone().concrete().name()),
            Ty::Array(..) => "an array".into(),
            Ty::Struct(name) => name.clone(),
            Ty::Parts("whole", _) | Ty::Parts(_, "whole") => "what `modf` gives".into(),
            Ty::Parts(..) => "what `frexp` gives".into(),
            Ty::Texture(_) => "a texture".into(),
            Ty::Sampler => "a sampler".into(),
            Ty::Nothing => "nothing".into(),
        }
    }
}

/// A scalar, vector or matrix by its name; vectors in angle brackets by what they are of.
pub(super) fn value_type(name: &str, inner: Ty) -> Ty {
    let letter = |letter: u8| match letter {
        b'f' => Some(Scalar::F32),
        b'i' => Some(Scalar::I32),
        b'u' => Some(Scalar::U32),
        _ => None,
    };
    let inner = match inner {
        Ty::Scalar(scalar) => Some(scalar),
        _ => None,
    };
    let vector = |size: u8, of: Option<Scalar>| of.map_or(Ty::Unknown, |of| Ty::Vector(size - b'0', of));
    match name.as_bytes() {
        b"f32" => Ty::F32,
        b"i32" => Ty::Scalar(Scalar::I32),
        b"u32" => Ty::Scalar(Scalar::U32),
        b"bool" => Ty::BOOL,
        [b'v', b'e', b'c', size @ b'2'..=b'4'] => vector(*size, inner),
        [b'v', b'e', b'c', size @ b'2'..=b'4', of] => vector(*size, letter(*of)),
        [b'm', b'a', b't', columns @ b'2'..=b'4', b'x', rows @ b'2'..=b'4', of @ ..]
            if matches!((of, inner), (b"f", None) | (b"", Some(Scalar::F32))) =>
        {
            Ty::Matrix(columns - b'0', rows - b'0')
        }
        _ => Ty::Unknown,
    }
}

/// What makes the wanted type of a value, as it is written: "; write ..." or nothing.
pub(super) fn remedy(wanted: &Ty, actual: &Ty, written: &str) -> String {
    let written = within_brackets(written);
    // What is long or on several lines is not repeated.
    let is_short = written.len() <= 32 && !written.contains('\n');
    let about = |name: &str| {
        if is_short { format!("; write `{name}({written})`") } else { format!("; write `{name}(...)` about it") }
    };
    let letters = "xyzw";
    match (wanted, actual) {
        (Ty::Scalar(Scalar::Bool), Ty::Scalar(_)) => "; compare it, such as `x > 0.0`".into(),
        (Ty::Scalar(_), Ty::Scalar(Scalar::Bool)) => {
            "; `select(0.0, 1.0, condition)` makes a number of a condition".into()
        }
        (Ty::Scalar(scalar), Ty::Scalar(_)) => about(scalar.concrete().name()),
        (Ty::Vector(_, a), Ty::Scalar(b)) if *a != Scalar::Bool && *b != Scalar::Bool => match b.common(*a) {
            Some(_) => about(&wanted.name()),
            None if is_short => format!("; write `{}({}({written}))`", wanted.name(), a.concrete().name()),
            None => String::new(),
        },
        (Ty::Scalar(a), Ty::Vector(_, b)) if b.common(*a).is_some() => {
            "; take one of its components, such as `.x`".into()
        }
        (Ty::Vector(m, a), Ty::Vector(n, b)) if *a != Scalar::Bool && *b != Scalar::Bool => {
            if m == n {
                about(&wanted.name())
            } else if m < n {
                format!("; take `.{}` of it", &letters[..usize::from(*m)])
            } else if is_short && m - n == 1 {
                format!("; write `{}({written}, 0.0)`", wanted.name())
            } else {
                String::new()
            }
        }
        _ => String::new(),
    }
}

/// A text without the brackets that are about all of it.
fn within_brackets(written: &str) -> &str {
    let Some(inner) = written.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')) else { return written };
    let mut depth = 0;
    let stays_open = inner.chars().all(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth >= 0
    });
    if stays_open { inner } else { written }
}
