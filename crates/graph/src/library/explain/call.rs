//! Calls: of functions of the text, of WGSL's own, and of types, which make a value.

use super::builtins::{self, Given, count};
use super::syntax::{Argument, Expr, Type};
use super::types::{Scalar, Ty, remedy};
use super::{Stop, World};

impl<'t> World<'t> {
    pub(super) fn call(&mut self, whole: &Expr<'t>, callee: &Type<'t>, arguments: &[Expr<'t>]) -> Result<Ty, Stop> {
        let (name, at) = (callee.name, whole.range.start);
        let given: Vec<Given> = arguments.iter().map(|argument| self.given(argument)).collect::<Result<_, _>>()?;
        if let Some(local) = self.locals.iter().rev().find(|local| local.name == name) {
            let told = format!("`{name}` is a value here, {}, and cannot be called", local.ty.name());
            return Err(Some((at, told)));
        }
        if let Some(signature) = self.functions.get(name) {
            if signature.arguments.len() != given.len() {
                return Err(Some((at, count(name, signature.arguments.len(), given.len()))));
            }
            for (one, (argument, wanted)) in given.iter().zip(&signature.arguments) {
                if !one.ty.fits(wanted) {
                    let told = format!(
                        "`{name}` takes {} as `{argument}`, and this is {}{}",
                        wanted.name(),
                        one.ty.name(),
                        remedy(wanted, &one.ty, one.written)
                    );
                    return Err(Some((one.at, told)));
                }
            }
            return Ok(signature.result.clone());
        }
        if name == "select" {
            return select(at, &given);
        }
        if name.starts_with("texture") {
            return texture(name, at, &given);
        }
        if name == "bitcast" {
            return Ok(match callee.arguments.first() {
                Some(Argument::Type(ty)) => self.resolve(ty),
                _ => Ty::Unknown,
            });
        }
        if let Some(answer) = builtins::call(name, at, &given) {
            return answer.map_err(Some);
        }
        let made = self.resolve(callee);
        match (&made, name) {
            (Ty::Unknown, "vec2" | "vec3" | "vec4") if callee.arguments.is_empty() => of_parts(name, at, &given),
            (Ty::Unknown, _) if callee.arguments.is_empty() && name.starts_with("mat") => Ok(matrix_of_parts(name)),
            (Ty::Struct(_), _) => {
                let members = self.structs.get(name).cloned().unwrap_or_default();
                let wanted: Vec<(String, Ty)> =
                    members.iter().map(|(name, ty)| (format!("`{name}`"), self.resolve(ty))).collect();
                made_of(made, at, &given, &wanted)
            }
            (Ty::Array(element, size), _) => {
                let size = size.and_then(|size| usize::try_from(size).ok()).unwrap_or(given.len());
                let wanted: Vec<(String, Ty)> =
                    (0..size).map(|i| (format!("element {i}"), (**element).clone())).collect();
                made_of(made.clone(), at, &given, &wanted)
            }
            _ => converted(made, at, &given),
        }
    }
}

/// A struct or array of values, one for each of its parts; of none it is made of zeros.
fn made_of(made: Ty, at: usize, given: &[Given], wanted: &[(String, Ty)]) -> Result<Ty, Stop> {
    if given.is_empty() {
        return Ok(made);
    }
    if given.len() != wanted.len() {
        return Err(Some((at, numbers(&made, wanted.len(), given.len()))));
    }
    for (one, (part, ty)) in given.iter().zip(wanted) {
        if !one.ty.fits(ty) {
            let told = format!("{part} of {} is {}, and this is {}", made.name(), ty.name(), one.ty.name());
            return Err(Some((one.at, told + &remedy(ty, &one.ty, one.written))));
        }
    }
    Ok(made)
}

fn numbers(made: &Ty, wanted: usize, given: usize) -> String {
    let name = made.clone().concrete().name();
    let values = if wanted == 1 { "1 value".to_owned() } else { format!("{wanted} values") };
    let are = if given == 1 { "1 is" } else { "are" };
    if given == 1 {
        format!("{name} is made of {values}, and {are} given")
    } else {
        format!("{name} is made of {values}, and {given} {are} given")
    }
}

/// A scalar, vector or matrix made of other values.
fn converted(made: Ty, at: usize, given: &[Given]) -> Result<Ty, Stop> {
    if given.is_empty() || made.is_unknown() || given.iter().any(|one| one.ty.is_unknown()) {
        return Ok(made);
    }
    let Some(of) = made.scalar() else { return Ok(made) };
    let name = made.name();
    if let Some(odd) = given.iter().find(|one| one.ty.scalar().is_none()) {
        return Err(Some((odd.at, format!("{name} is made of numbers, and this is {}", odd.ty.name()))));
    }
    match (&made, given) {
        (Ty::Matrix(columns, rows), _) => {
            let (columns, rows) = (usize::from(*columns), usize::from(*rows));
            let is_columns = given.len() == columns && given.iter().all(|one| usize::from(one.ty.size()) == rows);
            let is_numbers = given.len() == columns * rows && given.iter().all(|one| one.ty.size() == 1);
            let is_copy = given.len() == 1 && given[0].ty == made;
            if is_columns || is_numbers || is_copy {
                return Ok(made);
            }
            let told = format!("{name} is made of {columns} vec{rows}f, its columns, or of {} numbers", columns * rows);
            let odd = given.iter().find(|one| usize::from(one.ty.size()) != rows).filter(|_| given.len() == columns);
            Err(Some(odd.map_or((at, told.clone()), |odd| (odd.at, format!("{told}, and this is {}", odd.ty.name())))))
        }
        (Ty::Scalar(_), [one]) => {
            if one.ty.size() == 1 {
                return Ok(made);
            }
            let told = format!("{name} is made of one number, and this is {}", one.ty.name());
            Err(Some((one.at, told + "; take one of its components, such as `.x`")))
        }
        (Ty::Vector(size, _), [one]) if one.ty.size() > 1 => {
            if one.ty.size() == *size {
                return Ok(made);
            }
            let wanted = Ty::Vector(*size, one.ty.scalar().unwrap_or(of));
            let told = format!("{name} is made of {size} values, and this has {}", one.ty.size());
            Err(Some((one.at, told + &remedy(&wanted, &one.ty, one.written))))
        }
        _ => {
            let values: usize = given.iter().map(|one| usize::from(one.ty.size().max(1))).sum();
            let is_all = given.len() == 1 && made.size() > 1;
            if values != usize::from(made.size()) && !is_all {
                return Err(Some((at, numbers(&made, usize::from(made.size()), values))));
            }
            let odd = given.iter().find(|one| one.ty.scalar().is_some_and(|own| own.common(of) != Some(of)));
            match odd {
                Some(odd) => {
                    let told = format!("{name} is made of {}, and this is {}", Ty::Scalar(of).name(), odd.ty.name());
                    let wanted = Ty::of(odd.ty.size(), of);
                    Err(Some((odd.at, told + &remedy(&wanted, &odd.ty, odd.written))))
                }
                None => Ok(made),
            }
        }
    }
}

/// `vec3(...)`, whose type is that of its values.
fn of_parts(name: &str, at: usize, given: &[Given]) -> Result<Ty, Stop> {
    let size = name.bytes().last().map_or(0, |digit| digit - b'0');
    if given.iter().any(|one| one.ty.is_unknown() || one.ty.scalar().is_none()) {
        return Ok(Ty::Unknown);
    }
    let scalars: Vec<Scalar> = given.iter().filter_map(|one| one.ty.scalar()).collect();
    let mut common = Scalar::Integer;
    for scalar in scalars {
        // The first that does not go with those before it is told below.
        common = common.common(scalar).unwrap_or(common);
    }
    let is_mixed = given.iter().any(|one| one.ty.scalar().is_some_and(|own| own.common(common) != Some(common)));
    if is_mixed && common.concrete() != Scalar::F32 && given.iter().any(|one| one.ty.scalar() == Some(Scalar::F32)) {
        common = Scalar::F32;
    }
    converted(Ty::Vector(size, common), at, given)
}

fn matrix_of_parts(name: &str) -> Ty {
    match name.as_bytes() {
        [b'm', b'a', b't', columns @ b'2'..=b'4', b'x', rows @ b'2'..=b'4'] => Ty::Matrix(columns - b'0', rows - b'0'),
        _ => Ty::Unknown,
    }
}

/// `select(otherwise, value, condition)`.
fn select(at: usize, given: &[Given]) -> Result<Ty, Stop> {
    let [otherwise, value, condition] = given else { return Err(Some((at, count("select", 3, given.len())))) };
    if given.iter().any(|one| one.ty.is_unknown()) {
        return Ok(Ty::Unknown);
    }
    if condition.ty.scalar() != Some(Scalar::Bool) {
        let first = if otherwise.ty == Ty::BOOL { "; the order is `select(otherwise, value, condition)`" } else { "" };
        let cure = if first.is_empty() { "; compare it, such as `x > 0.0`" } else { first };
        let told =
            format!("the third argument of `select` is a condition, and here it is {}{cure}", condition.ty.name());
        return Err(Some((condition.at, told)));
    }
    let wanted = if value.ty.fits(&otherwise.ty) { &otherwise.ty } else { &value.ty };
    if !otherwise.ty.fits(wanted) {
        let (wrong, other) =
            if otherwise.ty.size() < value.ty.size() { (otherwise, value) } else { (value, otherwise) };
        let told = format!(
            "`select` chooses between two values of one type, and here they are {} and {}{}",
            otherwise.ty.name(),
            value.ty.name(),
            remedy(&other.ty.clone().concrete(), &wrong.ty, wrong.written)
        );
        return Err(Some((wrong.at, told)));
    }
    if condition.ty.size() != 1 && condition.ty.size() != wanted.size() {
        let told = format!(
            "the condition of `select` is one bool or as many as there are values, {}, and this is {}",
            wanted.size(),
            condition.ty.name()
        );
        return Err(Some((condition.at, told)));
    }
    // What is chosen while the shader runs has a type of its own.
    Ok(wanted.clone().concrete())
}

/// A read of a texture.
fn texture(name: &str, call: usize, given: &[Given]) -> Result<Ty, Stop> {
    let known = |index: usize| given.get(index).filter(|one| !one.ty.is_unknown());
    let size = match known(0) {
        None => return Ok(Ty::Unknown),
        Some(Given { ty: Ty::Texture(size), .. }) => *size,
        Some(one) => {
            let told = format!(
                "`{name}` reads a texture, and this is {}; a node gets one as an argument, such as `image: texture_2d<f32>`",
                one.ty.name()
            );
            return Err(Some((one.at, told)));
        }
    };
    if let Some(one) = known(1).filter(|one| one.ty != Ty::Sampler && name.starts_with("textureSample")) {
        let told = format!(
            "`{name}` reads by a sampler, and this is {}; a texture `image` has the argument `image_sampler: sampler` beside it",
            one.ty.name()
        );
        return Err(Some((one.at, told)));
    }
    let at = Ty::Vector(size, Scalar::F32);
    let reads: &[Ty] = match name {
        "textureSample" => std::slice::from_ref(&at),
        "textureSampleLevel" | "textureSampleBias" => &[at.clone(), Ty::F32],
        "textureSampleGrad" => &[at.clone(), at.clone(), at.clone()],
        "textureLoad" => return load(call, size, given),
        _ => return Ok(Ty::Unknown),
    };
    // One more is an offset.
    if given.len() < reads.len() + 2 || given.len() > reads.len() + 3 {
        return Err(Some((call, count(name, reads.len() + 2, given.len()))));
    }
    match given.iter().skip(2).zip(reads).find(|(one, wanted)| !one.ty.fits(wanted)) {
        Some((one, wanted)) => {
            let told = format!("`{name}` takes {} here, and this is {}", wanted.name(), one.ty.name());
            Err(Some((one.at, told + &remedy(wanted, &one.ty, one.written))))
        }
        None => Ok(Ty::Vector(4, Scalar::F32)),
    }
}

/// `textureLoad(image, place, level)`, whose places and levels are whole numbers.
fn load(call: usize, size: u8, given: &[Given]) -> Result<Ty, Stop> {
    if given.len() != 3 {
        return Err(Some((call, count("textureLoad", 3, given.len()))));
    }
    for (one, size) in given.iter().skip(1).zip([size, 1]) {
        let is_whole = one.ty.scalar().is_some_and(Scalar::is_whole) && one.ty.size() == size;
        if !is_whole && !one.ty.is_unknown() {
            let wanted = Ty::of(size, Scalar::I32);
            let told = format!(
                "`textureLoad` takes {} here, or the same of u32, and this is {}",
                wanted.name(),
                one.ty.name()
            );
            return Err(Some((one.at, told + &remedy(&wanted, &one.ty, one.written))));
        }
    }
    Ok(Ty::Vector(4, Scalar::F32))
}
