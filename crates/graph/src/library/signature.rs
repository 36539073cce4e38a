//! Signatures of the library's functions, from naga: argument and result types, docs of struct members, implicit derivatives.
//! Beside `complaint` the only file of this crate that names naga.

use std::collections::HashMap;

use super::explain::explain;
use super::{LibraryProblem, Source, complaint, line_of};
use crate::value::{SocketType, Type};

/// What a function takes and gives.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Signature {
    pub(super) arguments: Vec<(String, ArgumentType)>,
    pub(super) result: ResultType,
    pub(super) implicit_derivatives: bool,
}

/// The struct whose value a material is.
pub(super) const SURFACE_STRUCT: &str = "Surface";

/// Type of an argument or member.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ArgumentType {
    Socket(SocketType),
    Sampler,
    /// `mat4x4f`
    Matrix,
    /// One that no socket has.
    Other,
}

/// Type of a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ResultType {
    None,
    Plain(ArgumentType),
    Struct { name: String, members: Vec<Member> },
}

/// Member of a result struct.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    pub(super) name: String,
    pub(super) ty: ArgumentType,
    /// Its doc comment, lines joined.
    pub(super) help: String,
}

/// The signatures of all functions of a library.
pub(super) struct Signatures {
    /// By name; for each the one with `T` as its file's first type and the one with the second.
    functions: HashMap<String, [Signature; 2]>,
}

/// Stack for naga, which recurses; the slicer has bounded the nesting before.
const STACK: usize = 64 << 20;

impl Signatures {
    /// Whether a function of this name compares neighbouring pixels.
    pub(super) fn takes_derivatives(&self, name: &str) -> bool {
        self.functions.get(name).is_some_and(|[signature, _]| signature.implicit_derivatives)
    }

    /// The same under other names: those that `name` exchanges.
    pub(super) fn renamed(self, name: impl Fn(&str) -> Option<String>) -> Signatures {
        let new = |(old, signatures): (String, [Signature; 2])| (name(&old).unwrap_or(old), signatures);
        Signatures { functions: self.functions.into_iter().map(new).collect() }
    }

    /// Parses the files as one module, once for each of two types of `T`.
    pub(super) fn read(sources: &[Source]) -> Result<Signatures, LibraryProblem> {
        let both = [0, 1].map(|choice| {
            let joined: Vec<String> = sources
                .iter()
                .enumerate()
                .map(|(i, source)| source.with_generic(&format!("T_{i}"), source.generic.get(choice).copied()))
                .collect();
            joined.join("\n")
        });
        let parsed = std::thread::scope(|scope| {
            let workers = both
                .each_ref()
                .map(|text| std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || read_module(text)));
            workers.map(|worker| match worker {
                Ok(worker) => worker.join().unwrap_or_else(|_| Err((0, "the WGSL parser failed".into()))),
                Err(e) => Err((0, format!("no thread to parse in: {e}"))),
            })
        });
        let [first, second] = parsed;
        let (first, mut second) =
            (first.map_err(|e| locate(e, sources, &both[0]))?, second.map_err(|e| locate(e, sources, &both[1]))?);
        let pair = |(name, signature)| {
            let other = second.remove(&name).unwrap_or_else(|| Signature::clone(&signature));
            (name, [signature, other])
        };
        Ok(Signatures { functions: first.into_iter().map(pair).collect() })
    }

    /// The signature of a function of `source`, with `T` as [`SocketType::Generic`].
    pub(super) fn get(&self, source: &Source, name: &str) -> Option<Signature> {
        let [first, second] = self.functions.get(name)?;
        let merge = |a: &ArgumentType, b: &ArgumentType| {
            if a == b { a.clone() } else { ArgumentType::Socket(SocketType::Generic) }
        };
        let mut merged = first.clone();
        if source.generic.is_empty() {
            return Some(merged);
        }
        for (argument, other) in merged.arguments.iter_mut().zip(&second.arguments) {
            argument.1 = merge(&argument.1, &other.1);
        }
        match (&mut merged.result, &second.result) {
            (ResultType::Plain(ty), ResultType::Plain(other)) => *ty = merge(ty, other),
            (ResultType::Struct { members, .. }, ResultType::Struct { members: others, .. }) => {
                for (member, other) in members.iter_mut().zip(others) {
                    member.ty = merge(&member.ty, &other.ty);
                }
            }
            _ => {}
        }
        Some(merged)
    }
}

/// A place in the joined text and what is wrong there.
type ParseError = (usize, String);

/// What shaders may use of WGSL beyond the least that naga allows: the built-ins that pack f16 into words, which every device
/// of WebGPU has.
pub const CAPABILITIES: naga::valid::Capabilities = naga::valid::Capabilities::SHADER_FLOAT16_IN_FLOAT32;

/// Parses and validates a text by itself, on a large stack, and reads the signatures of its functions, none of which is generic. The
/// text's nesting is bounded before, and its first `own` bytes are the user's.
///
/// # Errors
/// What is wrong with it, and at which byte.
pub(super) fn judge(text: &str, own: usize) -> Result<Signatures, (usize, String)> {
    // What is known of the types is said before what naga says.
    let told = |complaint: (usize, String)| match explain(text, own) {
        Err(Some(better)) => better,
        _ => complaint,
    };
    let work = || {
        let module =
            parsed(text).map_err(|error| if error.is_of_types { told(error.complaint) } else { error.complaint })?;
        let too_large = module.types.iter().find(|(_, ty)| ty.inner.size(module.to_ctx()) > MAX_TYPE_BYTES);
        if let Some((handle, _)) = too_large {
            let at = module.types.get_span(handle).to_range().map_or(0, |range| range.start);
            return Err((at, "a value of this type is too large".into()));
        }
        let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), CAPABILITIES);
        validator.validate(&module).map_err(|e| told(complaint::of_validator(&module, text, &e)))?;
        let both = |(name, signature): (String, Signature)| (name, [signature.clone(), signature]);
        Ok(Signatures { functions: signatures(&module).into_iter().map(both).collect() })
    };
    std::thread::scope(|scope| match std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work) {
        Ok(worker) => worker.join().unwrap_or_else(|_| Err((0, "the WGSL parser failed".into()))),
        Err(e) => Err((0, format!("no thread to parse in: {e}"))),
    })
}

/// Names of WGSL's own functions and types.
pub(super) fn wgsl_names() -> impl Iterator<Item = &'static str> {
    naga::keywords::wgsl::BUILTIN_IDENTIFIERS.iter().copied()
}

/// Largest value that a document's function may handle.
const MAX_TYPE_BYTES: u32 = 64 << 10;

fn locate((at, message): ParseError, sources: &[Source], joined: &str) -> LibraryProblem {
    let mut line = line_of(joined, at.min(joined.len()));
    for source in sources {
        let lines = source.text.matches('\n').count() + 1;
        if line <= lines {
            return LibraryProblem { file: source.path.into(), line, message };
        }
        line -= lines;
    }
    LibraryProblem { file: sources.last().map_or("", |s| s.path).into(), line, message }
}

/// What the parser has against a text.
struct Refusal {
    complaint: ParseError,
    /// Whether it is a matter of types.
    is_of_types: bool,
}

fn parsed(text: &str) -> Result<naga::Module, Refusal> {
    let mut options = naga::front::wgsl::Options::new();
    options.parse_doc_comments = true;
    naga::front::wgsl::Frontend::new_with_options(options).parse(text).map_err(|e| {
        let at = e.location(text).map(|location| location.offset as usize);
        let notes: Vec<&str> = e.labels().map(|(_, label)| label).collect();
        Refusal {
            complaint: complaint::of_parser(text, at, e.message(), &notes),
            is_of_types: complaint::is_of_types(e.message()),
        }
    })
}

fn read_module(text: &str) -> Result<HashMap<String, Signature>, ParseError> {
    parsed(text).map(|module| signatures(&module)).map_err(|refusal| refusal.complaint)
}

/// The signatures of a module's functions by name.
fn signatures(module: &naga::Module) -> HashMap<String, Signature> {
    let mut implicit = Vec::with_capacity(module.functions.len());
    let mut signatures = HashMap::new();
    for (_, function) in module.functions.iter() {
        // Callees come first in naga's arena, so one pass is enough.
        let takes = takes_derivatives(function, &implicit);
        implicit.push(takes);
        let arguments = function
            .arguments
            .iter()
            .map(|a| (a.name.clone().unwrap_or_default(), argument_type(&module.types[a.ty])))
            .collect();
        let result = function.result.as_ref().map_or(ResultType::None, |result| result_type(module, result.ty));
        let name = function.name.clone().unwrap_or_default();
        signatures.insert(name, Signature { arguments, result, implicit_derivatives: takes });
    }
    signatures
}

/// Whether a function takes implicit derivatives, itself or through a callee; `of_callees` holds the answer for each function before it.
fn takes_derivatives(function: &naga::Function, of_callees: &[bool]) -> bool {
    use naga::{Expression, SampleLevel, Statement};
    let own = function.expressions.iter().any(|(_, expression)| match expression {
        Expression::Derivative { .. } => true,
        Expression::ImageSample { level, .. } => matches!(level, SampleLevel::Auto | SampleLevel::Bias(_)),
        _ => false,
    });
    let mut blocks = vec![&function.body];
    while let (false, Some(block)) = (own, blocks.pop()) {
        for statement in block {
            match statement {
                Statement::Call { function, .. } if of_callees.get(function.index()).copied().unwrap_or(false) => {
                    return true;
                }
                Statement::Block(block) => blocks.push(block),
                Statement::If { accept, reject, .. } => blocks.extend([accept, reject]),
                Statement::Switch { cases, .. } => blocks.extend(cases.iter().map(|case| &case.body)),
                Statement::Loop { body, continuing, .. } => blocks.extend([body, continuing]),
                _ => {}
            }
        }
    }
    own
}

fn argument_type(ty: &naga::Type) -> ArgumentType {
    use naga::{ImageClass, ImageDimension, Scalar, ScalarKind, TypeInner, VectorSize};
    let ty = match ty.inner {
        TypeInner::Scalar(Scalar::BOOL) => Type::Bool,
        TypeInner::Scalar(Scalar::I32) => Type::I32,
        TypeInner::Scalar(Scalar::F32) => Type::F32,
        TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::F32 } => Type::Vec2,
        TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 } => Type::Vec3,
        TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 } => Type::Vec4,
        TypeInner::Sampler { comparison: false } => return ArgumentType::Sampler,
        TypeInner::Matrix { columns: VectorSize::Quad, rows: VectorSize::Quad, scalar: Scalar::F32 } => {
            return ArgumentType::Matrix;
        }
        TypeInner::Image {
            dim: ImageDimension::D2,
            arrayed: false,
            class: ImageClass::Sampled { kind: ScalarKind::Float, multi: false },
        } => return ArgumentType::Socket(SocketType::Texture),
        TypeInner::Struct { .. } if ty.name.as_deref() == Some(SURFACE_STRUCT) => {
            return ArgumentType::Socket(SocketType::Surface);
        }
        _ => return ArgumentType::Other,
    };
    ArgumentType::Socket(SocketType::Value(ty))
}

fn result_type(module: &naga::Module, ty: naga::Handle<naga::Type>) -> ResultType {
    let naga::TypeInner::Struct { members, .. } = &module.types[ty].inner else {
        return ResultType::Plain(argument_type(&module.types[ty]));
    };
    let docs = module.doc_comments.as_deref();
    let read = |(i, member): (usize, &naga::StructMember)| {
        let lines = docs.and_then(|docs| docs.struct_members.get(&(ty, i)));
        let lines = lines.into_iter().flatten().map(|line| line.trim_start_matches('/').trim());
        Member {
            name: member.name.clone().unwrap_or_default(),
            ty: argument_type(&module.types[member.ty]),
            help: lines.collect::<Vec<_>>().join(" "),
        }
    };
    ResultType::Struct {
        name: module.types[ty].name.clone().unwrap_or_default(),
        members: members.iter().enumerate().map(read).collect(),
    }
}
