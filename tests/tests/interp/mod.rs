//! The interpreter on the library's own functions, against their Rust twins and against a GPU; and on programs that
//! nobody wrote, against a GPU.

mod bake;
mod builtins;
mod library;
mod random;

use halfvector_interp::{Entry, Program};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

/// Parses and validates a text.
pub(crate) fn valid(source: &str) -> Result<(naga::Module, ModuleInfo), String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|e| e.emit_to_string(source))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .map_err(|e| e.emit_to_string(source))?;
    Ok((module, info))
}

/// Compiles one function of a text.
pub(crate) fn compile(source: &str, function: &str) -> Program {
    let (module, info) = valid(source).unwrap_or_else(|e| panic!("{function}: {e}"));
    Program::compile(&module, &info, Entry::Function(function)).unwrap_or_else(|e| panic!("{e}"))
}
