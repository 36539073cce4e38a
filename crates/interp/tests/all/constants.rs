//! naga's own evaluator of constant expressions as another opinion: each expression is evaluated by naga with numbers in
//! the text, and by the interpreter with the same numbers as inputs.

use halfvector_interp::Column;

use super::support::{run, valid};

/// The scalars of a constant of the module.
fn constant(source: &str) -> Vec<f64> {
    fn collect(module: &naga::Module, handle: naga::Handle<naga::Expression>, out: &mut Vec<f64>) {
        match &module.global_expressions[handle] {
            naga::Expression::Literal(literal) => out.push(match *literal {
                naga::Literal::F32(x) => f64::from(x),
                naga::Literal::I32(x) => f64::from(x.cast_unsigned()),
                naga::Literal::U32(x) => f64::from(x),
                naga::Literal::Bool(x) => f64::from(u8::from(x)),
                other => panic!("{other:?}"),
            }),
            naga::Expression::Compose { components, .. } => components.iter().for_each(|c| collect(module, *c, out)),
            naga::Expression::Splat { size, value } => {
                for _ in 0..*size as usize {
                    collect(module, *value, out);
                }
            }
            naga::Expression::ZeroValue(_) => out.push(0.0),
            other => panic!("{other:?}"),
        }
    }
    let (module, _) = valid(source);
    let (_, constant) = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some("C")).expect("a constant C");
    let mut out = Vec::new();
    collect(&module, constant.init, &mut out);
    out
}

/// Puts texts in the places of the words A and B.
fn filled(body: &str, a: &str, b: &str) -> String {
    let mut out = String::new();
    for word in body.split_inclusive(|c: char| !c.is_alphanumeric()) {
        let name = word.trim_end_matches(|c: char| !c.is_alphanumeric());
        let value = match name {
            "A" => a,
            "B" => b,
            other => other,
        };
        out += value;
        out += &word[name.len()..];
    }
    out
}

/// Evaluates `body` on `A` and `B` in both ways. `ulp`: how far floats may be apart, in units of the last place.
fn compare(ty: &str, result: &str, body: &str, values: &[(&str, &str)], ulp: f64) {
    for (a, b) in values {
        let source = format!("const C: {result} = {};", filled(body, &format!("({a})"), &format!("({b})")));
        let expected = constant(&source);
        let call = format!(
            "fn inner(a: {ty}, b: {ty}) -> {result} {{ return {}; }} fn f(x: {ty}, y: {ty}) -> {result} {{ return inner(x, y); }}",
            filled(body, "a", "b")
        );
        let number = |text: &str| constant(&format!("const C: {ty} = {text};"))[0];
        let (x, y) = (number(a), number(b));
        let (fx, fy, wx, wy) = ([x as f32], [y as f32], [x as u32], [y as u32]);
        let columns: [Column<'_, f32>; 2] =
            if ty == "f32" { [Column::Float(&fx), Column::Float(&fy)] } else { [Column::Word(&wx), Column::Word(&wy)] };
        let found = run(&call, &columns, 1);
        for (found, expected) in found[0].iter().zip(&expected) {
            let size = expected.abs().max(f64::from(f32::MIN_POSITIVE)) * f64::from(f32::EPSILON);
            assert!(
                found == expected || (found - expected).abs() <= ulp * size,
                "{body} on {a}, {b}: {found}, naga {expected}"
            );
        }
    }
}

#[test]
fn integers_as_naga_has_them() {
    let signed = &[("7i", "3i"), ("-7i", "3i"), ("-2147483647i", "2i"), ("0i", "5i"), ("123456i", "-77i")];
    for body in [
        "A / B",
        "A % B",
        "A - B",
        "A & B",
        "A | B",
        "A ^ B",
        "min(A, B)",
        "max(A, B)",
        "abs(B)",
        "sign(A)",
        "~A",
        "A >> 3u",
        "firstLeadingBit(A)",
        "firstTrailingBit(A)",
        "countOneBits(A)",
        "reverseBits(A)",
        "clamp(A, -100i, B + 10i)",
    ] {
        compare("i32", "i32", body, signed, 0.0);
    }
    let unsigned = &[("7u", "3u"), ("4294967295u", "2u"), ("0u", "5u"), ("2147483648u", "77u")];
    for body in [
        "A / B",
        "A % B",
        "A & B",
        "min(A, B)",
        "max(A, B)",
        "A >> B % 32u",
        "firstLeadingBit(A)",
        "countLeadingZeros(A)",
        "countTrailingZeros(A)",
        "reverseBits(A)",
    ] {
        compare("u32", "u32", body, unsigned, 0.0);
    }
    compare("i32", "bool", "A < B", signed, 0.0);
    compare("u32", "bool", "A >= B", unsigned, 0.0);
    compare("i32", "f32", "f32(A)", signed, 0.0);
    compare("u32", "f32", "f32(A)", unsigned, 0.0);
}

#[test]
fn floats_as_naga_has_them() {
    let values = &[("1.5f", "0.25f"), ("-2.5f", "3.0f"), ("0.1f", "0.7f"), ("100.0f", "1e-3f"), ("-0.3f", "0.9f")];
    for body in [
        "A + B",
        "A - B",
        "A * B",
        "A / B",
        "-A",
        "abs(A)",
        "min(A, B)",
        "max(A, B)",
        "floor(A)",
        "ceil(A)",
        "trunc(A)",
        "round(A)",
        "fract(A)",
        "sign(A)",
        "saturate(A)",
        "clamp(A, 0.0f, B)",
        "step(A, B)",
        "sqrt(B)",
    ] {
        compare("f32", "f32", body, values, 0.0);
    }
    for body in [
        "sin(A)",
        "cos(A)",
        "tan(B)",
        "asin(sin(A))",
        "acos(B / 4.0f)",
        "atan(A)",
        "atan2(A, B)",
        "sinh(A / 10.0f)",
        "cosh(A / 10.0f)",
        "tanh(A)",
        "asinh(A)",
        "atanh(B / 4.0f)",
        "exp(B)",
        "exp2(B)",
        "log(B)",
        "log2(B)",
        "pow(B, A / 10.0f)",
        "radians(A)",
        "degrees(A)",
    ] {
        compare("f32", "f32", body, values, 4.0);
    }
    // naga cancels in f32 there.
    compare("f32", "f32", "acosh(B + 1.0f)", values, 64.0);
    compare("f32", "i32", "i32(A)", values, 0.0);
    compare("f32", "u32", "u32(B)", values, 0.0);
    compare("f32", "vec3<bool>", "vec3f(A, B, 1.0f) < vec3f(B, A, 2.0f)", values, 0.0);
    compare("f32", "f32", "dot(vec3f(A, B, 1.0f), vec3f(2.0f, A, B))", values, 2.0);
    compare("f32", "vec3f", "cross(vec3f(A, B, 1.0f), vec3f(2.0f, A, B))", values, 8.0);
    compare("f32", "vec3f", "vec3f(A, B, 1.0f).zxy * B", values, 0.0);
}
