//! The material alone, without lights: `material(context) -> Surface`, for those who bring their own shading.

use crate::CodegenError;
use crate::emit::expression::{Entrance, Names, Uses, Writer};
use crate::emit::text::Text;
use crate::ir::Program;
use crate::link::Index;
use crate::names::Namer;

/// Writes `material`. The program's fragment stage has the call of the surface node as its root `surface`.
pub(crate) fn material(program: &Program<'_>, index: &Index, names: &Names) -> Result<(Text, Uses), CodegenError> {
    let mut writer = Writer::new(program, index, names, Entrance::Material, false);
    let mut namer = Namer::new(index);
    writer.expressions(&program.fragment, &mut namer)?;
    let surface = program.fragment.root("surface").map(|id| writer.atom(id).to_owned()).unwrap_or_default();
    let result = writer.library("Surface")?;
    let argument = if writer.uses.contexts.is_empty() { "" } else { "context: Context" };
    let mut text = Text::default();
    text.line(&format!("fn material({argument}) -> {result} {{"));
    text.append(&writer.body);
    text.line(&format!("    return {surface};"));
    text.line("}");
    Ok((text, writer.uses))
}
