//! The material alone, without lights: `material(context) -> Surface`, or its height, for those who bring their own shading.

use crate::CodegenError;
use crate::emit::expression::{Entrance, Names, Uses, Writer};
use crate::emit::text::{Part, Text};
use crate::ir::Program;
use crate::link::Index;
use crate::names::Namer;

/// What of the material a function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Product {
    /// `material(context) -> Surface`: the fragment stage's root `surface`.
    Surface,
    /// `height(context) -> f32`: the vertex stage's root `height`.
    Height,
    /// `height_change(context) -> vec2f`: the derivatives of the fragment stage's root `height`.
    HeightChange,
}

/// Writes the function. Its stage of the program has its root.
pub(crate) fn material(
    program: &Program<'_>,
    product: Product,
    index: &Index,
    names: &Names,
) -> Result<(Text, Uses), CodegenError> {
    let mut writer = Writer::new(program, index, names, Entrance::Material, false);
    let mut namer = Namer::new(index);
    let stage = if product == Product::Height { &program.vertex } else { &program.fragment };
    writer.expressions(stage, &mut namer)?;
    let root = |name: &str| stage.root(name).map(|id| writer.atom(id).to_owned()).unwrap_or_default();
    let (name, result, value) = match product {
        Product::Surface => {
            let value = root("surface");
            ("material", writer.library("Surface")?, value)
        }
        Product::Height => ("height", "f32", root("height")),
        Product::HeightChange => {
            let height = root("height");
            ("height_change", "vec2f", format!("vec2f(dpdx({height}), dpdy({height}))"))
        }
    };
    let argument = if writer.uses.contexts.is_empty() { "" } else { "context: Context" };
    let mut text = Text::of(Part::Material);
    text.line(&format!("fn {name}({argument}) -> {result} {{"));
    text.append(&writer.body);
    text.line(&format!("    return {value};"));
    text.line("}");
    Ok((text, writer.uses))
}
