//! What functions there are on both sides, with their arguments, in one notation: naga reads the WGSL, syn the Rust.

use std::path::PathBuf;

use halfvector_shaders::function::library_files;
use naga::{Module, TypeInner};
use syn::visit::Visit;

use crate::support::root;

/// A function's name and arguments (name, type); types are written as WGSL writes them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Signature {
    /// Its name.
    pub(crate) name: String,
    /// Its arguments in order.
    pub(crate) arguments: Vec<(String, String)>,
    /// What it returns.
    pub(crate) result: String,
}

/// The Rust file that holds the twins of a WGSL file.
pub(crate) fn rust_twin(wgsl_path: &str) -> PathBuf {
    let stem = wgsl_path.strip_suffix(".wgsl").expect("a WGSL file");
    let (package, module) = match stem.split_once('/') {
        Some((package @ ("brdf" | "maps" | "ibl"), module)) => (package, module),
        None if stem == "math" => ("brdf", stem),
        None if stem == "color" => ("maps", stem),
        None => ("scene", stem),
        Some(_) => panic!("{wgsl_path}: say here where the Rust twins of this folder are"),
    };
    root().join(format!("crates/{package}/src/{module}.rs"))
}

/// All functions of a file of the WGSL library.
pub(crate) fn wgsl_functions(path: &str, module: &Module) -> Vec<Signature> {
    let file = library_files().find(|f| f.path == path).expect("a file of the library");
    let items = halfvector_shaders::slicer::slice(file.source).expect("the library slices");
    let is_here = |name: &str| items.iter().any(|i| i.name == name);
    let type_name = |ty: naga::Handle<naga::Type>| wgsl_type(module, ty);
    module
        .functions
        .iter()
        .filter_map(|(_, f)| f.name.as_deref().filter(|name| is_here(name)).map(|name| (name, f)))
        .map(|(name, f)| Signature {
            name: name.to_string(),
            arguments: f
                .arguments
                .iter()
                .map(|a| (a.name.clone().expect("a named argument"), type_name(a.ty)))
                .collect(),
            result: f.result.as_ref().map_or_else(String::new, |r| type_name(r.ty)),
        })
        .collect()
}

fn wgsl_type(module: &Module, ty: naga::Handle<naga::Type>) -> String {
    let ty = &module.types[ty];
    match &ty.inner {
        TypeInner::Scalar(s) if s.kind == naga::ScalarKind::Bool => "bool".into(),
        TypeInner::Scalar(_) => "f32".into(),
        TypeInner::Vector { size, .. } => format!("vec{}f", *size as u8),
        TypeInner::Array { base, size: naga::ArraySize::Constant(n), .. } => {
            format!("array<{}, {n}>", wgsl_type(module, *base))
        }
        _ => ty.name.clone().unwrap_or_else(|| "handle".into()),
    }
}

/// All public functions of the Rust file that holds the twins of a WGSL file; none where there is no such file.
pub(crate) fn rust_functions(path: &str) -> Vec<Signature> {
    let file = rust_twin(path);
    let Ok(text) = std::fs::read_to_string(&file) else { return Vec::new() };
    let tree = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let mut found = PublicFunctions(Vec::new());
    found.visit_file(&tree);
    found.0
}

struct PublicFunctions(Vec<Signature>);

impl<'ast> Visit<'ast> for PublicFunctions {
    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        if !matches!(f.vis, syn::Visibility::Public(_)) {
            return;
        }
        let arguments = f.sig.inputs.iter().filter_map(|argument| match argument {
            syn::FnArg::Typed(typed) => Some((argument_name(&typed.pat), rust_type(&typed.ty))),
            syn::FnArg::Receiver(_) => None,
        });
        let result = match &f.sig.output {
            syn::ReturnType::Type(_, ty) => rust_type(ty),
            syn::ReturnType::Default => String::new(),
        };
        self.0.push(Signature { name: f.sig.ident.to_string(), arguments: arguments.collect(), result });
    }
}

/// An argument's name, without the underscore that says that it is not used.
fn argument_name(pattern: &syn::Pat) -> String {
    match pattern {
        syn::Pat::Ident(ident) => ident.ident.to_string().trim_start_matches('_').to_string(),
        _ => "?".into(),
    }
}

/// A Rust type as its WGSL twin is written: `R` is f32, arrays of two to four are vectors, structs have one name.
fn rust_type(ty: &syn::Type) -> String {
    match ty {
        syn::Type::Path(path) => match path.path.segments.last().map(|s| s.ident.to_string()).as_deref() {
            Some("R" | "f64" | "f32") => "f32".into(),
            Some(name) => name.into(),
            None => "?".into(),
        },
        syn::Type::Array(array) => {
            let element = rust_type(&array.elem);
            let count = match &array.len {
                syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(n), .. }) => n.base10_parse::<u32>().unwrap_or(0),
                _ => 0,
            };
            if element == "f32" { format!("vec{count}f") } else { format!("array<{element}, {count}>") }
        }
        _ => "?".into(),
    }
}
