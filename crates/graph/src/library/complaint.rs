//! What naga has against a function of a document, in words of WGSL and at the place in the text that is to be changed: its own
//! words name numbers of expressions, and its places are often where a value was made, not where it does not fit. What is wrong with
//! types says `explain`; here is the rest.

mod habits;
mod parser;
mod slices;

use halfvector_shaders::{TokenKind, slice, tokens};
use naga::valid::{ExpressionError, FunctionError, TypeError, ValidationError};
use naga::{Block, Module, ScalarKind, Span, Statement, TypeInner, WithSpan};

pub(super) use parser::{is_of_types, of_parser};
pub(super) use slices::of_slicer;

/// A byte of the text and what is wrong there.
pub(super) type Complaint = (usize, String);

/// What the validator has against a module that was made of a text.
pub(super) fn of_validator(module: &Module, text: &str, error: &WithSpan<ValidationError>) -> Complaint {
    let at = error.spans().filter_map(|(span, _)| start(*span)).last().unwrap_or(0);
    match error.as_inner() {
        ValidationError::Function { handle, name, source } => {
            let body = &module.functions[*handle].body;
            match source {
                FunctionError::InvalidReturnType { expression: None, expected_ty } => {
                    let wanted = expected_ty.map_or_else(String::new, |ty| type_name(module, ty));
                    let is = |statement: &Statement| matches!(statement, Statement::Return { value: None });
                    let plain = find(body, &is).and_then(start).filter(|at| text[*at..].starts_with("return"));
                    match plain {
                        Some(at) => (at, format!("`{name}` gives {wanted}; write a value after `return`")),
                        None => (
                            end_of(text, name),
                            format!("`{name}` gives {wanted}, and here it ends without a `return`"),
                        ),
                    }
                }
                other => (at, of_function(other)),
            }
        }
        ValidationError::Type { source: TypeError::EmptyStruct, .. } => (at, "a struct has at least one member".into()),
        ValidationError::Type { .. } | ValidationError::Layouter(_) => {
            (at, "a value of this type is not there on every device".into())
        }
        _ => (at, GENERAL.into()),
    }
}

/// What is said of a change of what is no `var`.
pub(super) fn does_not_change(word: &str) -> String {
    format!(
        "`{word}` does not change: arguments and what `let` makes keep their value; make it with `var`, such as `var result = {word};`"
    )
}

/// What is said of a change of a `const`.
pub(super) fn is_constant(word: &str) -> String {
    format!("`{word}` does not change: it is a `const`; make what changes with `var`, such as `var result = {word};`")
}

/// What is said where nothing closer is known.
const GENERAL: &str = "this is no WGSL: types, or what stands about it, do not go together";

fn of_function(error: &FunctionError) -> String {
    let told = match error {
        FunctionError::MissingDefaultCase => "the `switch` needs a last `default: { }`",
        FunctionError::BreakOutsideOfLoopOrSwitch => "`break` stands in no loop and no `switch`",
        FunctionError::ContinueOutsideOfLoop => "`continue` stands in no loop",
        FunctionError::ConflictingSwitchCase(_) | FunctionError::MultipleDefaultCases => {
            "a case stands twice in this `switch`"
        }
        FunctionError::MissingCapability(_) | FunctionError::InvalidSubgroup(_) | FunctionError::InvalidAtomic(_) => {
            "not every device can do this; leave it out"
        }
        FunctionError::Expression { source, .. } => match source {
            ExpressionError::MissingCapabilities(_) => "not every device can do this; leave it out",
            ExpressionError::ShiftAmountTooLarge { .. } => "a number of 32 bits is shifted by 32 or more",
            ExpressionError::DivideByZero => "a whole number is divided by 0 here",
            ExpressionError::Literal(_) => "this number has a type that not every device knows, or is not finite",
            ExpressionError::InvalidCastArgument => "no value of this type is made of this one",
            _ => GENERAL,
        },
        _ => GENERAL,
    };
    told.into()
}

/// The bracket that ends a function.
fn end_of(text: &str, name: &str) -> usize {
    let items = slice(text).unwrap_or_default();
    let item = items.iter().find(|item| item.name == name);
    item.and_then(|item| Some(item.code_start + text[item.code_start..item.end].rfind('}')?)).unwrap_or(0)
}

fn find(block: &Block, is: &dyn Fn(&Statement) -> bool) -> Option<Span> {
    block.span_iter().find_map(|(statement, span)| {
        if is(statement) {
            return Some(*span);
        }
        match statement {
            Statement::Block(block) => find(block, is),
            Statement::If { accept, reject, .. } => find(accept, is).or_else(|| find(reject, is)),
            Statement::Switch { cases, .. } => cases.iter().find_map(|case| find(&case.body, is)),
            Statement::Loop { body, continuing, .. } => find(body, is).or_else(|| find(continuing, is)),
            _ => None,
        }
    })
}

/// The first byte of a span that is one.
fn start(span: Span) -> Option<usize> {
    span.to_range().map(|range| range.start)
}

/// A type as WGSL has it.
fn type_name(module: &Module, ty: naga::Handle<naga::Type>) -> String {
    let ty = &module.types[ty];
    let letter = |kind: ScalarKind| match kind {
        ScalarKind::Sint => 'i',
        ScalarKind::Uint => 'u',
        _ => 'f',
    };
    match ty.inner {
        TypeInner::Scalar(scalar) => match scalar.kind {
            ScalarKind::Sint => "i32".into(),
            ScalarKind::Uint => "u32".into(),
            ScalarKind::Bool => "bool".into(),
            _ => "f32".into(),
        },
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Bool => format!("vec{}<bool>", size as u8),
        TypeInner::Vector { size, scalar } => format!("vec{}{}", size as u8, letter(scalar.kind)),
        TypeInner::Matrix { columns, rows, .. } => format!("mat{}x{}f", columns as u8, rows as u8),
        TypeInner::Array { .. } => "an array".into(),
        _ => ty.name.clone().unwrap_or_else(|| "a value".into()),
    }
}

/// The word that begins at a byte; empty where none does.
fn word_at(text: &str, at: usize) -> &str {
    let rest = text.get(at..).unwrap_or("");
    &rest[..rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len())]
}

fn word_or_sign_at(text: &str, at: usize) -> &str {
    let rest = text.get(at..).unwrap_or("");
    let first = tokens(rest).into_iter().next().filter(|token| token.start == 0);
    match first {
        Some(token) if token.kind == TokenKind::Punctuation => token.text(rest),
        _ => word_at(text, at),
    }
}
