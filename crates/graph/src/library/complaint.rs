//! What naga has against a function of a document, in words of WGSL and at the place in the text that is to be changed: its own
//! words name numbers of expressions, and its places are often where a value was made, not where it does not fit.

use halfvector_shaders::{TokenKind, slice, tokens};
use naga::front::Typifier;
use naga::proc::{ResolveContext, TypeResolution};
use naga::valid::{CallError, ComposeError, ExpressionError, FunctionError, ValidationError};
use naga::{Block, Expression, Function, Handle, Module, ScalarKind, Span, Statement, TypeInner, WithSpan};

/// A byte of the text and what is wrong there.
pub(super) type Complaint = (usize, String);

/// What the parser has against a text: at a byte, its message and notes beside.
pub(super) fn of_parser(text: &str, at: Option<usize>, message: &str, notes: &[&str]) -> Complaint {
    let place = at.unwrap_or_else(|| first_function(text));
    let word = word_at(text, place);
    if message.starts_with("invalid left-hand side") {
        let told = if notes.iter().any(|note| note.contains("immutable")) {
            format!(
                "`{word}` does not change: arguments and what `let` makes keep their value; make it with `var`, such as `var result = {word};`"
            )
        } else {
            "only a whole variable or one component of it takes a value; set `.x`, `.y` and so on one by one".into()
        };
        return (place, told);
    }
    if message.starts_with("redefinition of") {
        return (
            place,
            format!("there is a `{word}` already: an argument or what was made above; choose another name"),
        );
    }
    if message.starts_with("invalid field accessor") {
        return (
            place,
            format!(
                "what stands before it has no `.{word}`: a vec2f has x and y, a vec3f also z, a vec4f also w; a number has none"
            ),
        );
    }
    if message.starts_with("expected assignment or increment") {
        return (
            place,
            format!("no statement begins so; to make a value write `let {word} = ...;`, to change one `{word} = ...;`"),
        );
    }
    if message.starts_with("expected `;`") {
        let before = text[..place].trim_end();
        let is_on_another_line = text[before.len()..place].contains('\n');
        return match word_or_sign_at(text, place) {
            "?" => (place, "WGSL has no `? :`; write `select(otherwise, value, condition)`".into()),
            _ if is_on_another_line => (before.len(), "a `;` is missing here".into()),
            sign => (place, format!("a `;` is missing before `{sign}`, or it does not belong here")),
        };
    }
    if message.contains("not supported in a const context") {
        return (place, "a `const` is made of numbers and constants alone; write `let`".into());
    }
    if let Some(rest) = message.strip_prefix("declaration of ") {
        let told = match rest.strip_suffix(" is recursive") {
            Some(name) => format!("{name} is recursive: it calls itself, which WGSL does not allow; write a loop"),
            None => format!("{rest}: functions call each other in a ring, which WGSL does not allow"),
        };
        return (place, told);
    }
    if message.ends_with("operation overflowed") {
        return (place, "what stands here is known before the shader runs, and it is no finite number".into());
    }
    if message.starts_with("Incompatible operands: Logical") {
        let at = only(text, "&&").or_else(|| only(text, "||")).unwrap_or(place);
        return (at, "`&&` and `||` join conditions, and one side is none; compare it, such as `x > 0.0`".into());
    }
    if message.starts_with("Invalid access into expression") {
        return (place, "somewhere in the text `[...]` stands after what has no elements: a number has none".into());
    }
    // Notes that say the same again, or nothing.
    let says_more = |note: &&&str| !message.contains(**note) && **note != "see msg";
    let notes: Vec<&str> = notes.iter().filter(says_more).copied().collect();
    (place, if notes.is_empty() { message.to_owned() } else { format!("{message} ({})", notes.join("; ")) })
}

/// What the validator has against a module that was made of a text.
pub(super) fn of_validator(module: &Module, text: &str, error: &WithSpan<ValidationError>) -> Complaint {
    let at = error.spans().filter_map(|(span, _)| start(*span)).last().unwrap_or(0);
    match error.as_inner() {
        ValidationError::Function { handle, name, source } => {
            let function = &module.functions[*handle];
            let (types, known) = types(module, function);
            In { module, text, name, function, types, known }.told(at, source)
        }
        other => (at, deepest(other)),
    }
}

/// A function that is wrong.
struct In<'m> {
    module: &'m Module,
    text: &'m str,
    name: &'m str,
    function: &'m Function,
    /// Of its first `known` expressions: of all up to one that has none.
    types: Typifier,
    known: usize,
}

impl In<'_> {
    fn told(&self, at: usize, error: &FunctionError) -> Complaint {
        let name = self.name;
        match error {
            FunctionError::InvalidReturnType { expression: Some(value), expected_ty } => {
                let is =
                    |statement: &Statement| matches!(statement, Statement::Return { value: Some(v) } if v == value);
                let at = self.statement(&is).map_or(at, |at| self.after("return", at));
                let actual = self.ty(*value);
                let told = match expected_ty {
                    Some(ty) => {
                        let wanted = type_name(self.module, &TypeResolution::Handle(*ty));
                        format!(
                            "`{name}` gives {wanted}, as stands after its `->`, and this is {actual}{}",
                            remedy(&wanted, &actual)
                        )
                    }
                    None => {
                        format!("`{name}` gives nothing; write `-> {actual}` after its arguments, or `return;` here")
                    }
                };
                (at, told)
            }
            FunctionError::InvalidReturnType { expression: None, expected_ty } => {
                let wanted =
                    expected_ty.map_or_else(String::new, |ty| type_name(self.module, &TypeResolution::Handle(ty)));
                let is = |statement: &Statement| matches!(statement, Statement::Return { value: None });
                match self.statement(&is).filter(|at| self.text[*at..].starts_with("return")) {
                    Some(at) => (at, format!("`{name}` gives {wanted}; write a value after `return`")),
                    None => (self.end(), format!("`{name}` gives {wanted}, and here it ends without a `return`")),
                }
            }
            FunctionError::InvalidIfType(condition) => {
                let is = |s: &Statement| matches!(s, Statement::If { condition: c, .. } if c == condition);
                let at = self.statement(&is).map_or(at, |at| self.after("if", at));
                (
                    at,
                    format!(
                        "a condition is true or false, and this is {}; compare it, such as `x > 0.0`",
                        self.ty(*condition)
                    ),
                )
            }
            FunctionError::InvalidCall { function, error } => self.call(at, *function, error),
            FunctionError::Expression { handle, source } => {
                let own = start(self.function.expressions.get_span(*handle)).unwrap_or(at);
                self.expression(own, *handle, source)
            }
            FunctionError::MissingDefaultCase => (at, "the `switch` needs a last `default: { }`".into()),
            FunctionError::BreakOutsideOfLoopOrSwitch => (at, "`break` stands in no loop and no `switch`".into()),
            FunctionError::ContinueOutsideOfLoop => (at, "`continue` stands in no loop".into()),
            other => (at, deepest(other)),
        }
    }

    fn call(&self, at: usize, callee: Handle<Function>, error: &CallError) -> Complaint {
        let called = &self.module.functions[callee];
        let name = called.name.as_deref().unwrap_or_default();
        match error {
            CallError::ArgumentCount { required, seen } => {
                let is = |s: &Statement| matches!(s, Statement::Call { function, arguments, .. } if *function == callee && arguments.len() == *seen);
                let count = if *required == 1 { "1 argument".to_owned() } else { format!("{required} arguments") };
                let given = if *seen == 1 { "1 is".to_owned() } else { format!("{seen} are") };
                (self.statement(&is).unwrap_or(at), format!("`{name}` takes {count}, and {given} given"))
            }
            CallError::ArgumentType { index, required, seen_expression } => {
                let is = |s: &Statement| {
                    matches!(s, Statement::Call { function, arguments, .. }
                        if *function == callee && arguments.get(*index) == Some(seen_expression))
                };
                let at = self.statement(&is).map_or(at, |at| argument_at(self.text, at, *index));
                let (wanted, actual) =
                    (type_name(self.module, &TypeResolution::Handle(*required)), self.ty(*seen_expression));
                let argument = called.arguments.get(*index).and_then(|a| a.name.as_deref()).unwrap_or_default();
                (
                    at,
                    format!(
                        "`{name}` takes {wanted} as `{argument}`, and this is {actual}{}",
                        remedy(&wanted, &actual)
                    ),
                )
            }
            other => (at, deepest(other)),
        }
    }

    fn expression(&self, at: usize, handle: Handle<Expression>, error: &ExpressionError) -> Complaint {
        let name = |inner: &TypeInner| inner_name(self.module, inner);
        let told = match error {
            ExpressionError::InvalidBinaryOperandTypes { op, lhs_type, rhs_type, .. } => {
                let (left, right) = (name(lhs_type), name(rhs_type));
                format!("`{}` takes no {left} with {right}{}", operator(*op), remedy(&left, &right))
            }
            ExpressionError::InvalidUnaryOperandType(op, operand) => {
                let sign = match op {
                    naga::UnaryOperator::Negate => "-",
                    naga::UnaryOperator::LogicalNot => "!",
                    naga::UnaryOperator::BitwiseNot => "~",
                };
                format!("`{sign}` takes no {}", self.ty(*operand))
            }
            ExpressionError::SelectConditionNotABool { actual } => format!(
                "the third argument of `select` is a condition, and here it is {}; compare it, such as `x > 0.0`",
                name(actual)
            ),
            ExpressionError::SelectValuesTypeMismatch { accept, reject } => {
                format!(
                    "`select` chooses between two values of one type, and here they are {} and {}",
                    name(reject),
                    name(accept)
                )
            }
            ExpressionError::Compose(ComposeError::ComponentCount { given, expected }) => {
                format!("{} is made of {expected} values, and {given} are given", self.ty(handle))
            }
            ExpressionError::Compose(ComposeError::ComponentType { index }) => {
                format!("value {} of those that {} is made of has another type", index + 1, self.ty(handle))
            }
            ExpressionError::IndexOutOfBounds(_, index) => {
                format!("there is no element {index} here; they are counted from 0")
            }
            ExpressionError::Literal(_) => "more is given here than it is made of, or a number of another type".into(),
            other => deepest(other),
        };
        (at, told)
    }

    /// The type of an expression.
    fn ty(&self, expression: Handle<Expression>) -> String {
        if expression.index() >= self.known {
            return "another type".into();
        }
        type_name(self.module, &self.types[expression])
    }

    /// Where the first statement of a kind begins.
    fn statement(&self, is: &dyn Fn(&Statement) -> bool) -> Option<usize> {
        find(&self.function.body, is).and_then(start)
    }

    /// The first word after a keyword.
    fn after(&self, keyword: &str, at: usize) -> usize {
        let rest = self.text[at..].strip_prefix(keyword).map(str::trim_start);
        rest.map_or(at, |rest| self.text.len() - rest.len())
    }

    /// The bracket that ends the function.
    fn end(&self) -> usize {
        let items = slice(self.text).unwrap_or_default();
        let item = items.iter().find(|item| item.name == self.name);
        item.and_then(|item| Some(item.code_start + self.text[item.code_start..item.end].rfind('}')?)).unwrap_or(0)
    }
}

/// The types of a function's expressions, up to the first that has none, and how many they are.
fn types(module: &Module, function: &Function) -> (Typifier, usize) {
    let context = ResolveContext::with_locals(module, &function.local_variables, &function.arguments);
    let mut types = Typifier::new();
    let grown = function
        .expressions
        .iter()
        .take_while(|(handle, _)| types.grow(*handle, &function.expressions, &context).is_ok());
    let known = grown.count();
    (types, known)
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

/// Where argument `index` of the call that begins at a byte stands.
fn argument_at(text: &str, call: usize, index: usize) -> usize {
    let (mut depth, mut commas, mut is_next) = (0usize, 0, false);
    for token in tokens(&text[call..]).into_iter().filter(|token| !token.kind.is_comment()) {
        if is_next {
            return call + token.start;
        }
        match token.text(&text[call..]) {
            "(" | "[" => {
                depth += 1;
                is_next = depth == 1 && index == 0;
            }
            ")" | "]" if depth <= 1 => break,
            ")" | "]" => depth -= 1,
            "," if depth == 1 => {
                commas += 1;
                is_next = commas == index;
            }
            _ => {}
        }
    }
    call
}

/// The words of the innermost cause.
fn deepest(error: &dyn std::error::Error) -> String {
    let mut cause = error;
    while let Some(next) = cause.source() {
        cause = next;
    }
    cause.to_string()
}

/// What makes one type of another, where that is one call.
fn remedy(wanted: &str, actual: &str) -> &'static str {
    let is_whole = |ty: &str| matches!(ty, "i32" | "u32");
    match (wanted, actual) {
        ("f32", actual) if is_whole(actual) => "; write `f32(...)` about it",
        (wanted, "f32") if is_whole(wanted) => {
            "; write `f32(...)` about the whole number, or `i32(...)` about the other"
        }
        ("f32", "bool") | ("bool", "f32") => "; `select(0.0, 1.0, condition)` makes a number of a condition",
        ("f32", actual) if actual.starts_with("vec") => "; take one of its components, such as `.x`",
        _ => "",
    }
}

fn type_name(module: &Module, ty: &TypeResolution) -> String {
    match ty {
        TypeResolution::Handle(handle) => match (&module.types[*handle].name, &module.types[*handle].inner) {
            (Some(name), TypeInner::Struct { .. }) => name.clone(),
            (_, inner) => inner_name(module, inner),
        },
        TypeResolution::Value(inner) => inner_name(module, inner),
    }
}

/// A type as WGSL has it.
fn inner_name(module: &Module, inner: &TypeInner) -> String {
    let letter = |kind: ScalarKind| match kind {
        ScalarKind::Sint => 'i',
        ScalarKind::Uint => 'u',
        _ => 'f',
    };
    match *inner {
        TypeInner::Scalar(scalar) => match scalar.kind {
            ScalarKind::Sint => "i32".into(),
            ScalarKind::Uint => "u32".into(),
            ScalarKind::Bool => "bool".into(),
            _ => "f32".into(),
        },
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Bool => format!("vec{}<bool>", size as u8),
        TypeInner::Vector { size, scalar } => format!("vec{}{}", size as u8, letter(scalar.kind)),
        TypeInner::Matrix { columns, rows, .. } => format!("mat{}x{}f", columns as u8, rows as u8),
        TypeInner::Pointer { base, .. } => type_name(module, &TypeResolution::Handle(base)),
        TypeInner::Array { .. } => "an array".into(),
        TypeInner::Image { .. } => "a texture".into(),
        TypeInner::Sampler { .. } => "a sampler".into(),
        TypeInner::Struct { .. } => "a struct".into(),
        _ => "another type".into(),
    }
}

fn operator(op: naga::BinaryOperator) -> &'static str {
    use naga::BinaryOperator as Op;
    match op {
        Op::Add => "+",
        Op::Subtract => "-",
        Op::Multiply => "*",
        Op::Divide => "/",
        Op::Modulo => "%",
        Op::Equal => "==",
        Op::NotEqual => "!=",
        Op::Less => "<",
        Op::LessEqual => "<=",
        Op::Greater => ">",
        Op::GreaterEqual => ">=",
        Op::And => "&",
        Op::ExclusiveOr => "^",
        Op::InclusiveOr => "|",
        Op::LogicalAnd => "&&",
        Op::LogicalOr => "||",
        Op::ShiftLeft => "<<",
        Op::ShiftRight => ">>",
    }
}

/// The first function of a text, for what has no place.
fn first_function(text: &str) -> usize {
    let items = slice(text).unwrap_or_default();
    items.iter().find(|item| item.kind == halfvector_shaders::ItemKind::Fn).map_or(0, |item| item.code_start)
}

/// Where a text stands, if in one place alone.
fn only(text: &str, part: &str) -> Option<usize> {
    let mut places = text.match_indices(part).map(|(at, _)| at);
    places.next().filter(|_| places.next().is_none())
}

/// The word that begins at a byte; empty where none does.
pub(super) fn word_at(text: &str, at: usize) -> &str {
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
