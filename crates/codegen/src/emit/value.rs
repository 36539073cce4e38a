//! Constants as WGSL: the shortest text that reads back as the same number.

use halfvector_graph::value::Type;

use crate::ir::Literal;

/// A finite constant as a WGSL expression. Numbers that are not finite never come here: folding refuses them.
pub(crate) fn literal(literal: &Literal) -> String {
    let components = literal.components();
    match literal.ty {
        Type::Bool => (components[0] != 0.0).to_string(),
        // Its digits alone are no i32.
        Type::I32 => match literal.numbers()[0] as i32 {
            i32::MIN => "i32(-2147483648)".to_owned(),
            integer => format!("{integer}i"),
        },
        Type::F32 => number(components[0]),
        ty if components.iter().all(|c| c.to_bits() == components[0].to_bits()) => {
            format!("{}({})", ty.wgsl(), number(components[0]))
        }
        ty => format!("{}({})", ty.wgsl(), components.iter().map(|c| number(*c)).collect::<Vec<_>>().join(", ")),
    }
}

/// A finite f32 as a WGSL literal: `1.0`, `0.1`, `1e-7`.
pub(crate) fn number(x: f32) -> String {
    // Rust's `{:?}` is the shortest that reads back, with a point or an exponent, as WGSL wants it. Of the largest number it is
    // above that number, and Tint refuses it; this one reads back, too.
    if x.abs() == f32::MAX { format!("{}3.4028234e38", if x < 0.0 { "-" } else { "" }) } else { format!("{x:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortest_and_exact() {
        assert_eq!(
            [1.0, 0.1, 1e-7, -0.0, 1e20, 16777216.0].map(number),
            ["1.0", "0.1", "1e-7", "-0.0", "1e20", "16777216.0"]
        );
        for bits in (0..u32::MAX).step_by(65_537) {
            let x = f32::from_bits(bits);
            if x.is_finite() {
                assert_eq!(number(x).parse::<f32>().unwrap().to_bits(), bits);
            }
        }
        for x in [f32::MAX, -f32::MAX] {
            assert_eq!(number(x).parse::<f32>(), Ok(x));
            assert!(number(x).parse::<f64>().unwrap().abs() <= f64::from(f32::MAX));
        }
        assert_eq!(literal(&Literal::new(Type::Vec3, &[0.5])), "vec3f(0.5)");
        assert_eq!(literal(&Literal::new(Type::Vec2, &[0.5, -1.0])), "vec2f(0.5, -1.0)");
        for integer in [-3, 0, 16_777_217, -16_777_217, i32::MAX, i32::MIN + 1] {
            assert_eq!(literal(&Literal::new(Type::I32, &[f64::from(integer)])), format!("{integer}i"));
        }
        assert_eq!(literal(&Literal::new(Type::I32, &[f64::from(i32::MIN)])), "i32(-2147483648)");
        assert_eq!(literal(&Literal::new(Type::Bool, &[1.0])), "true");
    }
}
