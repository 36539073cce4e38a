//! What WGSL's own functions take and give (WGSL 17), each in a few letters.

use super::types::{Scalar, Ty, remedy};

/// Arguments, `>`, result. Arguments of one capital letter are of one type:
///
/// * `F` f32 or a vector of it, `V` a vector of f32, `N` a number or a vector of them, `W` a vector of numbers, `I` a whole number or
///   a vector of them, `B` a condition or a vector of them, `M` a matrix;
/// * `f` f32, `u` u32, `b` bool, `2` `3` `4` a vector of f32, `e` the element of the vector, `t` the turned matrix;
/// * `m` and `x` are what `modf` and `frexp` give, `i` whole numbers as many as the first argument has values, `?` what is not followed.
const FUNCTIONS: [(&str, &[&str]); 26] = [
    (
        "F>F",
        &[
            "acos",
            "acosh",
            "asin",
            "asinh",
            "atan",
            "atanh",
            "ceil",
            "cos",
            "cosh",
            "degrees",
            "dpdx",
            "dpdxCoarse",
            "dpdxFine",
            "dpdy",
            "dpdyCoarse",
            "dpdyFine",
            "exp",
            "exp2",
            "floor",
            "fract",
            "fwidth",
            "fwidthCoarse",
            "fwidthFine",
            "inverseSqrt",
            "log",
            "log2",
            "quantizeToF16",
            "radians",
            "round",
            "saturate",
            "sin",
            "sinh",
            "sqrt",
            "tan",
            "tanh",
            "trunc",
        ],
    ),
    ("FF>F", &["atan2", "pow", "step"]),
    ("FFF>F", &["fma", "smoothstep"]),
    ("N>N", &["abs", "sign"]),
    ("NN>N", &["max", "min"]),
    ("NNN>N", &["clamp"]),
    ("V>V", &["normalize"]),
    ("VV>V", &["reflect"]),
    ("VVf>V", &["refract"]),
    ("VVV>V", &["faceForward"]),
    ("F>f", &["length"]),
    ("FF>f", &["distance"]),
    ("WW>e", &["dot"]),
    ("33>3", &["cross"]),
    ("M>f", &["determinant"]),
    ("M>t", &["transpose"]),
    (
        "I>I",
        &[
            "countLeadingZeros",
            "countOneBits",
            "countTrailingZeros",
            "firstLeadingBit",
            "firstTrailingBit",
            "reverseBits",
        ],
    ),
    ("Iuu>I", &["extractBits"]),
    ("IIuu>I", &["insertBits"]),
    ("Fi>F", &["ldexp"]),
    ("F>m", &["modf"]),
    ("F>x", &["frexp"]),
    ("4>u", &["pack4x8snorm", "pack4x8unorm"]),
    ("2>u", &["pack2x16snorm", "pack2x16unorm", "pack2x16float"]),
    ("u>?", &["unpack4x8snorm", "unpack4x8unorm", "unpack2x16snorm", "unpack2x16unorm", "unpack2x16float"]),
    ("B>b", &["all", "any"]),
];

/// An argument: its type, how it is written, and the byte at which it begins.
pub(super) struct Given<'a> {
    pub(super) ty: Ty,
    pub(super) written: &'a str,
    pub(super) at: usize,
}

/// What a call of a function of WGSL's gives, or what is wrong with it; `None` where the function is none of these.
pub(super) fn call(name: &str, at: usize, given: &[Given]) -> Option<Result<Ty, (usize, String)>> {
    if name == "mix" {
        // The third may be one number for vectors, too.
        let is_one =
            given.get(2).is_some_and(|third| third.ty.size() == 1) && given[0].ty.size().max(given[1].ty.size()) > 1;
        return Some(judge(name, at, given, if is_one { "FFf>F" } else { "FFF>F" }));
    }
    let (shape, _) = FUNCTIONS.iter().find(|(_, names)| names.contains(&name))?;
    Some(judge(name, at, given, shape))
}

fn judge(name: &str, at: usize, given: &[Given], shape: &str) -> Result<Ty, (usize, String)> {
    let (wanted, result) = shape.split_once('>').unwrap_or((shape, "?"));
    if wanted.len() != given.len() {
        return Err((at, count(name, wanted.len(), given.len())));
    }
    if given.iter().any(|one| one.ty.is_unknown()) {
        return Ok(Ty::Unknown);
    }
    for (one, letter) in given.iter().zip(wanted.chars()) {
        if !belongs(&one.ty, letter) {
            let like = like(letter, given, wanted, one.ty.size());
            let cure = match (name, one.ty.scalar()) {
                ("mix", Some(Scalar::Bool)) => "; by a condition chooses `select(a, b, condition)`".into(),
                _ => like.map_or_else(String::new, |like| remedy(&like, &one.ty, one.written)),
            };
            let told = format!("`{name}` takes {} here, and this is {}{cure}", words(letter), one.ty.name());
            return Err((one.at, told));
        }
    }
    let mut of_letter = Ty::Unknown;
    for letter in "FVNWIBM3".chars() {
        let alike: Vec<&Given> =
            given.iter().zip(wanted.chars()).filter(|(_, l)| *l == letter).map(|(g, _)| g).collect();
        if let Some(ty) = common(name, &alike, letter)? {
            of_letter = ty;
        }
    }
    let size = of_letter.size();
    if let Some((one, _)) = given.iter().zip(wanted.chars()).find(|(one, l)| *l == 'i' && one.ty.size() != size) {
        return Err((one.at, format!("`{name}` takes as many whole numbers as it is given values, {size} here")));
    }
    let element = of_letter.scalar().unwrap_or(Scalar::F32);
    Ok(match result {
        "f" => Ty::F32,
        "u" => Ty::Scalar(Scalar::U32),
        "b" => Ty::BOOL,
        "3" => Ty::Vector(3, Scalar::F32),
        "e" => Ty::Scalar(element),
        "t" => match of_letter {
            Ty::Matrix(columns, rows) => Ty::Matrix(rows, columns),
            _ => Ty::Unknown,
        },
        "m" => Ty::Parts("fract", "whole"),
        "x" => Ty::Parts("fract", "exp"),
        "?" => Ty::Unknown,
        _ => of_letter,
    })
}

/// The type that arguments of one letter have in common; `None` where there are none.
fn common(name: &str, alike: &[&Given], letter: char) -> Result<Option<Ty>, (usize, String)> {
    let Some(first) = alike.first() else { return Ok(None) };
    if letter == 'M' {
        return Ok(Some(first.ty.clone()));
    }
    // The first vector says how many values; what is f32, or else comes first, says of what kind.
    let size = alike.iter().map(|one| one.ty.size()).find(|size| *size > 1).unwrap_or(1);
    let scalars: Vec<Scalar> = alike.iter().filter_map(|one| one.ty.scalar()).collect();
    let is_plain = |scalar: &Scalar| matches!(scalar, Scalar::Integer);
    let kind = [Scalar::F32, Scalar::Decimal].into_iter().find(|kind| scalars.contains(kind));
    let kind = kind.or_else(|| scalars.iter().copied().find(|scalar| !is_plain(scalar))).unwrap_or(Scalar::Integer);
    let kind = if "FV3".contains(letter) && kind == Scalar::Integer { Scalar::Decimal } else { kind };
    let wanted = Ty::of(size, kind);
    match alike.iter().find(|one| !one.ty.fits(&wanted)) {
        None => Ok(Some(wanted)),
        Some(wrong) => {
            let number = ["", "a value", "two values", "three values"].get(alike.len()).copied().unwrap_or("values");
            let names: Vec<String> = alike.iter().map(|one| one.ty.name()).collect();
            let (last, front) = names.split_last().map_or(("", &[][..]), |(last, front)| (last.as_str(), front));
            let told = format!(
                "`{name}` takes {number} of one type, and here they are {} and {last}{}",
                front.join(", "),
                remedy(&wanted, &wrong.ty, wrong.written)
            );
            Err((wrong.at, told))
        }
    }
}

/// How many arguments are wanted and given.
pub(super) fn count(name: &str, wanted: usize, given: usize) -> String {
    let wanted = if wanted == 1 { "1 argument".to_owned() } else { format!("{wanted} arguments") };
    let given = if given == 1 { "1 is".to_owned() } else { format!("{given} are") };
    let two_angles = if name == "atan" { "; of two numbers there is `atan2`" } else { "" };
    format!("`{name}` takes {wanted}, and {given} given{two_angles}")
}

/// Whether a type is one of those of a letter.
fn belongs(ty: &Ty, letter: char) -> bool {
    let scalar = ty.scalar();
    let (is_value, is_vector) = (ty.size() > 0, ty.size() > 1);
    let is = |test: fn(Scalar) -> bool| scalar.is_some_and(test);
    match letter {
        'F' => is_value && is(Scalar::is_float),
        'V' => is_vector && is(Scalar::is_float),
        'N' => is_value && is(|scalar| scalar != Scalar::Bool),
        'W' => is_vector && is(|scalar| scalar != Scalar::Bool),
        'I' | 'i' => is_value && is(Scalar::is_whole),
        'B' => is_value && is(|scalar| scalar == Scalar::Bool),
        'M' => matches!(ty, Ty::Matrix(..)),
        'f' => ty.fits(&Ty::F32),
        'u' => ty.fits(&Ty::Scalar(Scalar::U32)),
        size => ty.fits(&Ty::Vector(size.to_digit(10).unwrap_or(0) as u8, Scalar::F32)),
    }
}

/// What would belong there and is nearest to what the other arguments are.
fn like(letter: char, given: &[Given], wanted: &str, own: u8) -> Option<Ty> {
    let mut others = given.iter().zip(wanted.chars()).filter(|(one, l)| *l == letter && belongs(&one.ty, letter));
    let size = others.next().map_or(own.max(1), |(one, _)| one.ty.size());
    match letter {
        'F' | 'f' => Some(Ty::of(if letter == 'f' { 1 } else { size }, Scalar::F32)),
        'V' | 'W' if size > 1 => Some(Ty::Vector(size, Scalar::F32)),
        'I' | 'i' => Some(Ty::Scalar(Scalar::I32)),
        'u' => Some(Ty::Scalar(Scalar::U32)),
        'B' => Some(Ty::BOOL),
        '2'..='4' => Some(Ty::Vector(letter.to_digit(10)? as u8, Scalar::F32)),
        _ => None,
    }
}

fn words(letter: char) -> &'static str {
    match letter {
        'F' => "f32 or a vector of f32",
        'V' => "a vector of f32",
        'N' => "a number or a vector of numbers",
        'W' => "a vector of numbers",
        'I' | 'i' => "a whole number, i32 or u32, or a vector of them",
        'B' => "a condition or a vector of conditions",
        'M' => "a matrix",
        'f' => "f32",
        'u' => "u32",
        '2' => "vec2f",
        '3' => "vec3f",
        _ => "vec4f",
    }
}
