//! The types of values: names, numbers, members, elements and operators.

use super::builtins::Given;
use super::syntax::{Expr, Kind};
use super::types::{Scalar, Ty, remedy};
use super::{Stop, World};

impl<'t> World<'t> {
    /// The type of a value, or what is wrong in it.
    pub(super) fn ty(&mut self, value: &Expr<'t>) -> Result<Ty, Stop> {
        match &value.kind {
            Kind::Number => literal(self.written(&value.range), value.range.start),
            Kind::Bool => Ok(Ty::BOOL),
            Kind::Name => {
                let name = self.written(&value.range);
                let known = self.locals.iter().rev().chain(&self.constants).find(|local| local.name == name);
                Ok(known.map_or(Ty::Unknown, |local| local.ty.clone()))
            }
            Kind::Brackets(inner) => self.ty(inner),
            Kind::Call { callee, arguments } => self.call(value, callee, arguments),
            Kind::Index(base, index) => self.element(base, index),
            Kind::Member(base, member) => self.member(base, member),
            Kind::Unary(sign, inner) => self.unary(*sign, value.range.start, inner),
            Kind::Binary { sign, at, left, right } => {
                let (left_ty, right_ty) = (self.ty(left)?, self.ty(right)?);
                self.binary(sign, *at, (left, &left_ty), (right, &right_ty))
            }
        }
    }

    pub(super) fn given(&mut self, value: &Expr<'t>) -> Result<Given<'t>, Stop> {
        let ty = self.ty(value)?;
        self.refuse_nothing(value, &ty)?;
        Ok(Given { ty, written: self.written(&value.range), at: value.range.start })
    }

    /// Refuses a call of a function that gives nothing where a value is wanted.
    pub(super) fn refuse_nothing(&self, value: &Expr<'t>, ty: &Ty) -> Result<(), Stop> {
        if *ty != Ty::Nothing {
            return Ok(());
        }
        let name = self.written(&value.range).split('(').next().unwrap_or_default();
        let told = format!("`{name}` gives nothing; write `-> f32`, or another type, after its arguments");
        Err(Some((value.range.start, told)))
    }

    /// The value of a whole number, where it is known.
    pub(super) fn number(&self, value: &Expr<'t>) -> Option<i64> {
        match &value.kind {
            Kind::Number => whole(self.written(&value.range)),
            Kind::Name => {
                let name = self.written(&value.range);
                self.locals.iter().rev().chain(&self.constants).find(|local| local.name == name)?.value
            }
            Kind::Brackets(inner) => self.number(inner),
            Kind::Unary('-', inner) => self.number(inner)?.checked_neg(),
            Kind::Call { callee, arguments } if matches!(callee.name, "i32" | "u32") => self.number(arguments.first()?),
            Kind::Binary { sign, left, right, .. } => {
                let (a, b) = (self.number(left)?, self.number(right)?);
                match *sign {
                    "+" => a.checked_add(b),
                    "-" => a.checked_sub(b),
                    "*" => a.checked_mul(b),
                    "/" => a.checked_div(b),
                    "%" => a.checked_rem(b),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    fn element(&mut self, base: &Expr<'t>, index: &Expr<'t>) -> Result<Ty, Stop> {
        let (of, by) = (self.ty(base)?, self.ty(index)?);
        let (element, count) = match &of {
            Ty::Unknown => return Ok(Ty::Unknown),
            Ty::Vector(size, scalar) => (Ty::Scalar(*scalar), Some(i64::from(*size))),
            Ty::Matrix(columns, rows) => (Ty::Vector(*rows, Scalar::F32), Some(i64::from(*columns))),
            Ty::Array(element, size) => ((**element).clone(), size.and_then(|size| i64::try_from(size).ok())),
            other => {
                let told = format!("only vectors, matrices and arrays have elements, and this is {}", other.name());
                return Err(Some((base.range.start, told)));
            }
        };
        let at = index.range.start;
        if !by.is_unknown() && !matches!(by, Ty::Scalar(scalar) if scalar.is_whole()) {
            let cure = remedy(&Ty::Scalar(Scalar::I32), &by, self.written(&index.range));
            let told = format!("elements are counted by a whole number, i32 or u32, and this is {}{cure}", by.name());
            return Err(Some((at, told)));
        }
        if let (Some(number), Some(count)) = (self.number(index), count)
            && !(0..count).contains(&number)
        {
            let told = format!("{} has the elements 0 to {}, and this is {number}", of.concrete().name(), count - 1);
            return Err(Some((at, told)));
        }
        Ok(element)
    }

    fn member(&mut self, base: &Expr<'t>, member: &std::ops::Range<usize>) -> Result<Ty, Stop> {
        let (of, name) = (self.ty(base)?, self.written(member));
        let fail = |told: String| Err(Some((member.start, told)));
        match &of {
            Ty::Vector(size, scalar) => {
                let is_of = |letters: &str| name.chars().all(|c| letters.contains(c));
                let known = usize::from(*size);
                if (is_of(&"xyzw"[..known]) || is_of(&"rgba"[..known])) && name.len() <= 4 {
                    return Ok(Ty::of(name.len() as u8, *scalar));
                }
                let has = |letters: &str| letters[..known].chars().map(String::from).collect::<Vec<_>>().join(", ");
                fail(format!(
                    "{} has no `.{name}`: its components are {}, or {}, up to four of one row at a time",
                    of.concrete().name(),
                    has("xyzw"),
                    has("rgba")
                ))
            }
            Ty::Struct(of) => {
                let members = self.structs.get(of.as_str()).cloned().unwrap_or_default();
                match members.iter().find(|(known, _)| *known == name) {
                    Some((_, ty)) => Ok(self.resolve(ty)),
                    None => {
                        let names: Vec<String> = members.iter().map(|(name, _)| format!("`.{name}`")).collect();
                        fail(format!("`{of}` has no `.{name}`; it has {}", names.join(", ")))
                    }
                }
            }
            Ty::Parts(first, second) if name != *first && name != *second => {
                fail(format!("{} has `.{first}` and `.{second}`", of.name()))
            }
            Ty::Unknown | Ty::Parts(..) => Ok(Ty::Unknown),
            Ty::Matrix(..) | Ty::Array(..) => fail(format!(
                "{} has no `.{name}`; its elements are counted, such as `name[0]` for the first",
                of.name()
            )),
            _ => fail(format!("{} has no `.{name}`: it is no vector and no struct", of.name())),
        }
    }

    fn unary(&mut self, sign: char, at: usize, inner: &Expr<'t>) -> Result<Ty, Stop> {
        let ty = self.ty(inner)?;
        let Some(scalar) = ty.scalar() else { return Ok(Ty::Unknown) };
        let takes = match sign {
            '-' => scalar.is_float() || scalar == Scalar::I32,
            '!' => scalar == Scalar::Bool,
            '~' => scalar.is_whole(),
            _ => return Ok(Ty::Unknown),
        };
        let cure = match (sign, scalar) {
            ('-', Scalar::U32) => "; u32 is never below 0",
            ('-', Scalar::Bool) => "; `!` turns a condition about",
            ('!', _) => "; compare it, such as `x > 0.0`",
            _ => "",
        };
        if takes { Ok(ty) } else { Err(Some((at, format!("`{sign}` takes no {}{cure}", bare(&ty))))) }
    }

    /// What an operator gives of two values.
    pub(super) fn binary(
        &self,
        sign: &str,
        at: usize,
        (left, left_ty): (&Expr<'t>, &Ty),
        (right, right_ty): (&Expr<'t>, &Ty),
    ) -> Result<Ty, Stop> {
        self.refuse_nothing(left, left_ty)?;
        self.refuse_nothing(right, right_ty)?;
        if left_ty.is_unknown() || right_ty.is_unknown() {
            return Ok(Ty::Unknown);
        }
        if matches!(sign, "&&" | "||") {
            let sides = [(left, left_ty), (right, right_ty)];
            return match sides.into_iter().find(|(_, ty)| **ty != Ty::BOOL) {
                None => Ok(Ty::BOOL),
                Some((side, ty)) => {
                    let cure = match ty {
                        Ty::Vector(_, Scalar::Bool) => "write `all(...)` or `any(...)` about it",
                        _ => "compare it, such as `x > 0.0`",
                    };
                    let told = format!("`{sign}` joins conditions, and this is {}; {cure}", ty.name());
                    Err(Some((side.range.start, told)))
                }
            };
        }
        match joined(sign, left_ty, right_ty) {
            Some(ty) => Ok(ty),
            None => {
                let (place, told) = self.told(sign, (left, left_ty), (right, right_ty));
                Err(Some((place.unwrap_or(at), told)))
            }
        }
    }

    /// Why an operator does not take two values, and what to write; with the place of the value that is to be written otherwise.
    fn told(&self, sign: &str, (left, a): (&Expr<'t>, &Ty), (right, b): (&Expr<'t>, &Ty)) -> (Option<usize>, String) {
        let told = format!("`{sign}` takes no {} with {}", bare(a), b.name());
        let pieces = |ty: &Ty| match ty {
            Ty::Parts(first, second) => Some(format!("; take its `.{first}` or `.{second}`")),
            _ => None,
        };
        if let Some(cure) = pieces(a).or_else(|| pieces(b)) {
            return (None, told + &cure);
        }
        let (Some(p), Some(q)) = (a.scalar(), b.scalar()) else { return (None, told) };
        let is_float = |scalar: Scalar| matches!(scalar, Scalar::F32 | Scalar::Decimal);
        if sign == "^" && (is_float(p) || is_float(q)) {
            return (None, told + "; a power is `pow(a, b)`");
        }
        if matches!(sign, "&" | "|") && p == Scalar::Bool && q == Scalar::Bool {
            return (None, told + &format!("; of conditions write `{sign}{sign}`"));
        }
        if matches!(sign, "<<" | ">>") && p.is_whole() && q == Scalar::I32 {
            let cure = remedy(&Ty::of(b.size(), Scalar::U32), b, self.written(&right.range));
            return (Some(right.range.start), format!("`{sign}` shifts by u32, and this is {}{cure}", b.name()));
        }
        if matches!(sign, "&" | "|" | "^" | "<<" | ">>") {
            return (None, told + "; it works on the bits of whole numbers");
        }
        let is_comparison = matches!(sign, "==" | "!=" | "<" | ">" | "<=" | ">=");
        if p == Scalar::Bool || q == Scalar::Bool {
            let cure = if is_comparison && matches!(left.kind, Kind::Binary { sign: "<" | ">" | "<=" | ">=", .. }) {
                "; two comparisons are joined: `a < b && b < c`"
            } else if p == q {
                "; of conditions there are `&&`, `||`, `==` and `!=`"
            } else {
                "; `select(0.0, 1.0, condition)` makes a number of a condition"
            };
            return (None, told + cure);
        }
        // The whole number becomes f32, the single number a vector where the operator takes no other.
        let (side, wanted, ty) = if p.common(q).is_none() && is_float(p) != is_float(q) {
            let (side, ty) = if is_float(p) { (right, b) } else { (left, a) };
            (side, Ty::of(ty.size(), Scalar::F32), ty)
        } else if p.common(q).is_none() {
            (right, Ty::of(b.size(), p), b)
        } else if is_comparison && a.size() == 1 {
            (left, b.clone().concrete(), a)
        } else if is_comparison && b.size() == 1 {
            (right, a.clone().concrete(), b)
        } else {
            return (None, told);
        };
        let cure = remedy(&wanted, ty, self.written(&side.range));
        ((!cure.is_empty()).then_some(side.range.start), told + &cure)
    }
}

/// A type's name behind "no".
fn bare(ty: &Ty) -> String {
    let name = ty.name();
    name.strip_prefix("a ").map_or(name.clone(), str::to_owned)
}

/// The type of two values joined by an operator other than `&&` and `||`, if it takes them.
fn joined(sign: &str, left: &Ty, right: &Ty) -> Option<Ty> {
    let is_comparison = matches!(sign, "==" | "!=" | "<" | ">" | "<=" | ">=");
    let (a, b) = (left.scalar()?, right.scalar()?);
    if matches!(left, Ty::Matrix(..)) || matches!(right, Ty::Matrix(..)) {
        return matrices(sign, left, right, a.common(b)?);
    }
    if matches!(sign, "<<" | ">>") {
        let is_right = a.is_whole() && matches!(b, Scalar::U32 | Scalar::Integer) && left.size() == right.size();
        return is_right.then(|| left.clone());
    }
    let common = a.common(b)?;
    let size = match (left.size(), right.size()) {
        (m, n) if m == n => m,
        (1, n) | (n, 1) if matches!(sign, "+" | "-" | "*" | "/" | "%") => n,
        _ => return None,
    };
    let is_bool = common == Scalar::Bool;
    match sign {
        "==" | "!=" => Some(Ty::of(size, Scalar::Bool)),
        _ if is_comparison => (!is_bool).then(|| Ty::of(size, Scalar::Bool)),
        "&" | "|" => (is_bool || common.is_whole()).then(|| Ty::of(size, common)),
        "^" => common.is_whole().then(|| Ty::of(size, common)),
        _ => (!is_bool).then(|| Ty::of(size, common)),
    }
}

fn matrices(sign: &str, left: &Ty, right: &Ty, common: Scalar) -> Option<Ty> {
    if !common.is_float() {
        return None;
    }
    match (sign, left, right) {
        ("+" | "-", a, b) if a == b => Some(a.clone()),
        ("*", Ty::Matrix(..), Ty::Scalar(_)) => Some(left.clone()),
        ("*", Ty::Scalar(_), Ty::Matrix(..)) => Some(right.clone()),
        ("*", Ty::Matrix(columns, rows), Ty::Vector(size, _)) if columns == size => {
            Some(Ty::Vector(*rows, Scalar::F32))
        }
        ("*", Ty::Vector(size, _), Ty::Matrix(columns, rows)) if rows == size => {
            Some(Ty::Vector(*columns, Scalar::F32))
        }
        ("*", Ty::Matrix(columns, rows), Ty::Matrix(more, inner)) if columns == inner => Some(Ty::Matrix(*more, *rows)),
        _ => None,
    }
}

/// The type of a number as it is written.
fn literal(digits: &str, at: usize) -> Result<Ty, Stop> {
    let is_hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    let has_point =
        digits.contains('.') || (!is_hexadecimal && digits.contains(['e', 'E'])) || digits.contains(['p', 'P']);
    if digits.ends_with('h') || digits.ends_with(['f', 'i', 'u']) && digits[..digits.len() - 1].ends_with('l') {
        let told =
            format!("`{digits}` has a type that not every device knows; a number ends in `f`, `i`, `u` or nothing");
        return Err(Some((at, told)));
    }
    let scalar = match digits.bytes().last() {
        Some(b'i') => Scalar::I32,
        Some(b'u') => Scalar::U32,
        Some(b'f') if !is_hexadecimal || has_point => Scalar::F32,
        _ if has_point => Scalar::Decimal,
        _ => Scalar::Integer,
    };
    let size = digits.trim_end_matches('f').parse::<f64>().unwrap_or(0.0);
    if scalar.is_float() && !is_hexadecimal && size > f64::from(f32::MAX) {
        return Err(Some((at, format!("{digits} is more than f32 holds, at most 3.4028234e38"))));
    }
    let most = match scalar {
        Scalar::I32 => f64::from(i32::MAX),
        Scalar::U32 => f64::from(u32::MAX),
        _ => return Ok(Ty::Scalar(scalar)),
    };
    match whole(digits) {
        Some(number) if number as f64 > most => {
            let name = Ty::Scalar(scalar).name();
            Err(Some((at, format!("{digits} is more than {name} holds, at most {most}"))))
        }
        _ => Ok(Ty::Scalar(scalar)),
    }
}

/// The value of a whole number as it is written.
fn whole(digits: &str) -> Option<i64> {
    let digits = digits.trim_end_matches(['i', 'u']);
    match digits.strip_prefix("0x").or_else(|| digits.strip_prefix("0X")) {
        Some(hexadecimal) => i64::from_str_radix(hexadecimal, 16).ok(),
        None => digits.parse().ok(),
    }
}
