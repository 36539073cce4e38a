//! What the parser has against a text, by the messages of the naga that the workspace names: all that a text of functions can meet are
//! said in words of WGSL here, and of one that is not known nothing is repeated but its place.

use halfvector_shaders::{ItemKind, Token, TokenKind, slice, tokens};

use super::habits::{elsewhere, is_function, is_type, unknown};
use super::{Complaint, GENERAL, does_not_change, is_constant, word_at, word_or_sign_at};
use crate::check::words::nearest;

/// Whether a message of the parser is about a type, so that following the types says more.
pub(in super::super) fn is_of_types(message: &str) -> bool {
    let others =
        ["expected `", "expected operation", "expected expression", "expected identifier", "expected statement"];
    let more = [
        "expected assignment",
        "expected variable",
        "expected function",
        "expected switch",
        "expected for",
        "expected next",
        "expected global",
        "no definition in scope",
        "redefinition of",
        "invalid left-hand side",
        "name `",
        "Identifier",
        "declaration of",
        "invalid numeric",
    ];
    !others.into_iter().chain(more).any(|start| message.starts_with(start))
}

/// What the parser has against a text: at a byte, its message and notes beside.
pub(in super::super) fn of_parser(text: &str, at: Option<usize>, message: &str, notes: &[&str]) -> Complaint {
    let place = at.unwrap_or_else(|| first_function(text));
    let word = word_at(text, place);
    if let Some(number) = number_about(text, place).filter(|_| message.starts_with("expected")) {
        let rest = &text[number.start..];
        let end = rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.'))).unwrap_or(rest.len());
        let told = format!("`{}` is no number of WGSL: a number ends in `f`, `i`, `u` or nothing", &rest[..end]);
        return (number.start, told);
    }
    if let Some((wanted, _)) = message.strip_prefix("expected ").and_then(|rest| rest.split_once(", found ")) {
        return expected(text, place, wanted);
    }
    let told = match message {
        m if m.starts_with("no definition in scope") => {
            unknown(word, text[place + word.len()..].trim_start().starts_with('('))
        }
        m if m.starts_with("redefinition of") => {
            format!("there is a `{word}` already: an argument or what was made above; choose another name")
        }
        m if m.starts_with("name `") => format!("`{word}` is a word of WGSL's own; choose another name"),
        m if m.starts_with("Identifier can't be") => {
            "`_` is no name; choose one, or write `_ = ...;` to leave a value unused".into()
        }
        m if m.starts_with("Identifier starts with") => format!("`{word}` begins with `__`; choose another name"),
        m if m.starts_with("invalid left-hand side") => {
            // Brackets about a name are no part of it.
            let bare = place + (text[place..].len() - text[place..].trim_start_matches(['(', ' ']).len());
            let word = word_at(text, bare);
            if is_a_constant(text, bare) {
                is_constant(word)
            } else if notes.iter().any(|note| note.contains("immutable")) && !word.is_empty() {
                does_not_change(word)
            } else {
                "only a whole variable or one component of it takes a value; set `.x`, `.y` and so on one by one".into()
            }
        }
        m if m.ends_with("is recursive") => {
            format!("`{word}` is recursive: it calls itself, which WGSL does not allow; write a loop")
        }
        m if m.ends_with("is cyclic") && is_no_function(text, word) => {
            format!("`{word}` is made of itself: what it needs needs it again")
        }
        m if m.ends_with("is cyclic") => {
            format!("`{word}`: functions call each other in a ring, which WGSL does not allow")
        }
        m if m.ends_with("needs a type specifier or initializer") => {
            format!("`{word}` needs a type or a value: `var {word}: f32;` or `var {word} = 0.0;`")
        }
        m if m.starts_with("invalid numeric literal") => {
            let number = number_at(text, place);
            let is_octal = number.starts_with('0') && number[1..].starts_with(|c: char| c.is_ascii_digit());
            let cure = if is_octal { "leave out the 0 at its front" } else { "something is missing at its end" };
            format!("`{number}` is no number of WGSL: {cure}")
        }
        m if m.starts_with("numeric literal not representable") => format!(
            "`{}` is more than its type holds: f32 goes to 3.4028234e38, i32 to 2147483647, u32 to 4294967295",
            number_at(text, place)
        ),
        m if m.starts_with("the concrete type") => {
            let range =
                if m.contains("`u32`") { "u32, from 0 to 4294967295" } else { "i32, from -2147483648 to 2147483647" };
            let range = if m.contains("`f32`") { "f32, at most 3.4028234e38" } else { range };
            format!("this does not fit {range}")
        }
        m if m.ends_with("operation overflowed")
            || m.starts_with("failed to convert")
            || m.starts_with("Float literal") =>
        {
            "what stands here is known before the shader runs, and it is no finite number".into()
        }
        m if m.ends_with("argument is out of valid range") => {
            format!("`{word}` has no value for this number, which is known before the shader runs")
        }
        m if m.starts_with("value of `low`") => "the lower bound of `clamp` is greater than its upper one".into(),
        "Division by zero" | "Remainder by zero" => "a whole number is divided by 0 here".into(),
        m if m.starts_with("RHS of shift") => "a number of 32 bits is shifted by 32 or more".into(),
        m if m.contains("not supported in a const context")
            || m.starts_with("Constants ")
            || m.starts_with("Unexpected runtime")
            || m.starts_with("Subexpression") =>
        {
            "a `const` is made of numbers and constants alone; write `let`".into()
        }
        m if m.starts_with("the operand of the `*`") => {
            return match text[..place].trim_end().ends_with('*') {
                true => (place.saturating_sub(1), "WGSL has no `**`; a power is `pow(a, b)`".into()),
                false => (place, "`*` stands between two values here; a node has no pointers".into()),
            };
        }
        m if m.ends_with("is not constructible") => format!("no value is made by `{word}(...)` of these"),
        m if m.starts_with("function does not return any value") => {
            format!("`{word}` gives nothing; write `-> f32`, or another type, after its arguments")
        }
        m if m.starts_with("unused return value") => {
            format!("`{word}(...)` alone does nothing; write `let value = {word}(...);` and use it")
        }
        m if m.starts_with("local declaration cannot be called") => {
            format!("`{word}` is a value here, made above, and hides the function; choose another name for the value")
        }
        m if m.contains("needs a template argument") => {
            let (name, like) = if word.starts_with("vec") || word.starts_with("mat") {
                (format!("{word}f"), "")
            } else {
                (format!("{word}<f32>"), ", or another type")
            };
            format!("`{word}` of what? write `{name}`{like}")
        }
        m if m.contains("`switch` case selector") => "a `case` is a whole number that stands in the text".into(),
        m if m.contains("`switch` selector") => "`switch` chooses by a whole number, i32 or u32".into(),
        m if m.starts_with("`const_assert` failure") => "this is false".into(),
        m if m.contains("must be positive") => "an array has at least one element".into(),
        m if m.starts_with("unknown scalar type") => {
            format!("a vector or matrix is of f32, i32, u32 or bool, and not of `{word}`")
        }
        m if m.starts_with("matrix scalar type") => "a matrix is made of f32".into(),
        m if m.starts_with("unterminated block comment") => "this comment does not end; write `*/`".into(),
        m if m.contains("xtension") => format!("`{word}` is not there on every device; leave it out"),
        m if m.starts_with("wrong number of arguments") || m.starts_with("too many arguments") => {
            format!("`{word}` takes another number of arguments")
        }
        m if m.contains("type passed as argument") => format!("`{word}` takes arguments of other types"),
        m if m.starts_with("cannot cast") => "no value of this type is made of this one".into(),
        m if m.starts_with("expected an image") => format!("`{word}` is no texture"),
        m if m.starts_with("identifier `") || m.starts_with("unexpected ") || m.starts_with("unused expressions") => {
            format!("`{}` is out of place in these angle brackets", word_or_sign_at(text, place))
        }
        m if m.starts_with("brace nesting") => "nested too deeply; name a part of it with `let`".into(),
        m if m.starts_with("A break if") => "`break if` stands at the end of a `continuing` alone".into(),
        _ => GENERAL.into(),
    };
    (place, told)
}

/// What is said where the parser wants something else than what stands at a byte.
fn expected(text: &str, place: usize, wanted: &str) -> Complaint {
    let sign = word_or_sign_at(text, place);
    let before = text[..place].trim_end();
    let word_before = last_word(before);
    let is_on_another_line = text[before.len()..place].contains('\n');
    let told = match wanted {
        w if w.starts_with("expression") => match sign {
            "\"" | "'" | "“" | "”" | "‘" | "’" | "`" => "WGSL has no text, only numbers and conditions".into(),
            "[" => "an array is written with its type: `array<f32, 2>(1.0, 2.0)`".into(),
            "{" if matches!(word_before, "if" | "switch")
                || before.ends_with(['<', '>', '+', '-', '*', '/', '&', '|', '%']) =>
            {
                "a value is missing before `{`".into()
            }
            "{" => "a value is made by its type: `vec3f(...)`, `array<f32, 2>(...)` or a struct's name".into(),
            "+" if text[place..].starts_with("++") => {
                "`++` stands behind a variable, as a statement of its own: `i++;`".into()
            }
            "-" if text[place..].starts_with("--") => {
                "`--` stands behind a variable, as a statement of its own: `i--;`".into()
            }
            "+" => "no `+` stands before a value; leave it out".into(),
            "=" if before.ends_with("==") => "two values are compared by `==`".into(),
            ">" if before.ends_with('<') => "two values are compared by `!=`".into(),
            "if" => "`if` is no value; write `select(otherwise, value, condition)`".into(),
            "" if place >= text.len() => "a value is missing at the end".into(),
            sign => format!("a value is missing before `{sign}`"),
        },
        w if w.starts_with("identifier") => {
            if sign.starts_with(|c: char| c.is_ascii_digit()) {
                "a name begins with a letter".into()
            } else if before.ends_with("->") || before.ends_with(':') {
                format!("a type is missing before `{sign}`")
            } else {
                format!("a name is missing before `{sign}`")
            }
        }
        "operation (`=`)" => {
            let keyword = last_word(before[..before.len() - word_before.len()].trim_end());
            if is_type(word_before) || elsewhere(word_before).is_some() {
                let ty = elsewhere(word_before).map_or(word_before, |ours| ours.trim_matches('`'));
                format!("the type stands behind the name: `{keyword} {sign}: {ty} = ...;`")
            } else if matches!(sign, ";" | "}") {
                format!("`{keyword} {word_before}` needs a value: `{keyword} {word_before} = ...;`")
            } else if is_type(sign) {
                format!("a `:` is missing before `{sign}`")
            } else if sign == "=" {
                format!("`{keyword} {word_before} = ...;` makes a value, by one `=`")
            } else {
                format!("a `=` is missing before `{sign}`")
            }
        }
        "`:`" if matches!(word_before, "in" | "out" | "inout") => {
            format!("an argument has no `{word_before}`; what a function changes it gives back")
        }
        "`:`" if is_type(word_before) || elsewhere(word_before).is_some() => {
            let ty = elsewhere(word_before).map_or(word_before, |ours| ours.trim_matches('`'));
            format!("the type stands behind the name: `{sign}: {ty}`")
        }
        "`:`" => format!("the type of `{word_before}` is missing: `{word_before}: f32`"),
        "`{`" => match sign {
            "=" if text[place..].starts_with("=>") => "what a function gives stands behind `->`".into(),
            "=" => "`=` gives a value to a variable; two values are compared by `==`".into(),
            "and" => "conditions are joined by `&&`".into(),
            "or" => "conditions are joined by `||`".into(),
            "then" => "WGSL has no `then`; leave it out, and write what is done in `{ }`".into(),
            ":" if before.ends_with(')') => "what a function gives stands behind `->`: `fn f(x: f32) -> f32`".into(),
            sign if before.ends_with(')') && is_type(sign) => format!("a `->` is missing before `{sign}`"),
            sign => format!("a `{{` is missing before `{sign}`; what is done stands in `{{ }}`, one statement, too"),
        },
        w if w.starts_with("statement") => match sign {
            "#" => "WGSL has no preprocessor; write `const NAME = 1.0;` above the function".into(),
            _ => format!("no statement begins with `{}`", number_at(text, place)),
        },
        w if w.starts_with("variable") => {
            let items = slice(text).unwrap_or_default();
            if items.iter().any(|item| item.kind == ItemKind::Fn && item.name == sign) {
                return (place, format!("`{sign}` is a function; call it: `{sign}(...)`"));
            }
            format!("`{sign}` is a type, not a value; write `{sign}(...)`, with what it is made of")
        }
        w if w.starts_with("function") => format!("`{sign}` is no function"),
        w if w.starts_with("assignment") => return no_statement(text, place),
        w if w.starts_with("switch item") => "a `switch` holds `case 1: { }` and `default: { }`".into(),
        w if w.starts_with("for loop") => "a loop is written `for (var i = 0; i < 8; i++) { }`".into(),
        "`;`" => return semicolon(text, place, sign, before, is_on_another_line),
        "`)`" | "`]`" | "`}`" | "`,`" | "`(`" | "`<`" => {
            if let Some(told) = in_brackets(text, place, sign) {
                return told;
            }
            match wanted {
                "`,`" if sign == "=" => {
                    "an argument has no default here: the node's stand in its comment, `- x: help [1.0]`".into()
                }
                "`)`" => format!("a `)` is missing before `{sign}`, or a comma"),
                "`,`" if sign == ";" => "members are parted by `,`, not by `;`".into(),
                "`(`" if sign == "<" => "a function has no types in angle brackets".into(),
                _ => format!("a {wanted} is missing before `{sign}`"),
            }
        }
        _ => format!("`{sign}` is out of place here"),
    };
    (place, told)
}

/// What is said of what begins no statement: something before it.
fn no_statement(text: &str, place: usize) -> Complaint {
    let (before, sign) = (text[..place].trim_end(), word_or_sign_at(text, place));
    let word = last_word(before);
    let start = before.len() - word.len();
    const KEYWORDS: [&str; 9] = ["return", "let", "var", "const", "if", "else", "for", "switch", "break"];
    let told = if matches!(word, "import" | "use" | "include" | "using") {
        "a node brings nothing in; functions of the library are called by their names".into()
    } else if matches!(word, "uniform" | "varying" | "attribute" | "in" | "out" | "inout" | "static" | "precision") {
        return (start, format!("a node has no `{word}`; what it reads are its arguments"));
    } else if matches!(word, "fn" | "struct" | "function" | "alias") {
        format!("`{word}` stands outside of functions; write it above")
    } else if matches!(word, "do" | "while" | "until" | "repeat" | "foreach") {
        "a loop is written `for (var i = 0; i < 8; i++) { }`".into()
    } else if matches!(word, "elseif" | "elif" | "elsif") {
        return (start, "write `else if`".into());
    } else if is_type(word) || elsewhere(word).is_some_and(|ours| is_type(ours.trim_matches('`'))) {
        let ty = elsewhere(word).map_or(word, |ours| ours.trim_matches('`'));
        let end = if ty == "auto" { String::new() } else { format!(": {ty}") };
        format!("the type stands behind the name: `let {sign}{end} = ...;`, or `var` for what changes")
    } else if KEYWORDS.contains(&word) {
        return (start, format!("`{word}` is out of place here"));
    } else if let Some(likely) = nearest(&word.to_lowercase(), KEYWORDS.into_iter()) {
        return (start, format!("there is no `{word}`; did you mean `{likely}`?"));
    } else if let Some(rest) = word.strip_prefix("return").filter(|rest| !rest.is_empty()) {
        return (start, format!("there is no `{word}`; did you mean `return {rest}`?"));
    } else if sign.starts_with(|c: char| c.is_alphabetic()) {
        format!("no statement begins so; to make a value write `let {sign} = ...;`, to change one `{sign} = ...;`")
    } else if sign == ":" {
        format!("a value is made by `let {word} = ...;` and changed by `{word} = ...;`")
    } else {
        return (start, "this alone does nothing: write `return ...;`, `let name = ...;` or `name = ...;`".into());
    };
    (place, told)
}

/// What is said where a statement goes on.
fn semicolon(text: &str, place: usize, sign: &str, before: &str, is_on_another_line: bool) -> Complaint {
    let word = last_word(before);
    let rest = &text[place..];
    let is_member = before[..before.len() - word.len()].ends_with('.');
    let told = match sign {
        "?" => "WGSL has no `? :`; write `select(otherwise, value, condition)`".into(),
        "(" if is_member => {
            let told = format!("WGSL has no methods: `{word}` is called with the value in its brackets, `{word}(...)`");
            return (before.len() - word.len(), told);
        }
        _ if word == "if" => {
            let told = "`if` is no value; write `select(otherwise, value, condition)`".into();
            return (before.len() - word.len(), told);
        }
        _ if is_on_another_line => return (before.len(), "a `;` is missing here".into()),
        ":" if rest.starts_with("::") => "WGSL has no `::`; functions are called by their name alone".into(),
        "-" if rest.starts_with("->") => "a component is taken by `.`, such as `c.x`".into(),
        "+" if rest.starts_with("++") => "`++` is a statement of its own: `i++;`".into(),
        "-" if rest.starts_with("--") => "`--` is a statement of its own: `i--;`".into(),
        "=" if rest.starts_with("=>") => "two values are compared by `>=`".into(),
        "+" | "-" | "*" | "/" if rest[1..].starts_with('=') => {
            format!("`{sign}=` is a statement of its own; a value has none in it")
        }
        "×" | "·" | "∙" => format!("`{sign}` is no sign of WGSL; write `*`"),
        "÷" => "`÷` is no sign of WGSL; write `/`".into(),
        "≤" | "≥" | "≠" => format!("`{sign}` is no sign of WGSL; write `<=`, `>=` or `!=`"),
        "−" | "–" => format!("`{sign}` is no sign of WGSL; write `-`"),
        "$" | "\\" | "`" | "´" | "§" | "°" | "€" | "#" | "'" | "\"" => format!("`{sign}` is no sign of WGSL"),
        "and" => "conditions are joined by `&&`".into(),
        "or" => "conditions are joined by `||`".into(),
        _ if matches!(word, "not" | "new") => {
            let told = if word == "not" { "a condition is turned about by `!`" } else { "leave out `new`" };
            return (before.len() - word.len(), told.into());
        }
        "{" if !word.is_empty() => format!("a value is made in round brackets: `{word}(...)`"),
        "{" if before.ends_with('>') => format!("a value is made in round brackets: `{}(...)`", last_type(before)),
        _ if is_function(word) => format!("brackets are missing: `{word}(...)`"),
        _ if is_type(sign) && last_word(before[..before.len() - word.len()].trim_end()) == "var" => {
            format!("a `:` is missing before `{sign}`")
        }
        _ if is_type(word) && last_word(before[..before.len() - word.len()].trim_end()) == "var" => {
            let ty = elsewhere(word).map_or(word, |ours| ours.trim_matches('`'));
            format!("the type stands behind the name: `var {sign}: {ty};`")
        }
        "as" => "a value is made another type by a call, such as `f32(x)`".into(),
        "," if before.ends_with(|c: char| c.is_ascii_digit())
            && rest[1..].starts_with(|c: char| c.is_ascii_digit()) =>
        {
            "a decimal point is `.`".into()
        }
        ";" | "" => "this does not end as a statement does".into(),
        _ if before.ends_with(')') && sign.starts_with(|c: char| c.is_alphanumeric()) && is_bracketed_type(before) => {
            "a value is made another type by a call, such as `f32(x)`".into()
        }
        sign => format!("a `;` is missing before `{sign}`, or it does not belong here"),
    };
    (place, told)
}

/// Whether a text ends by a type in brackets, as a cast of C does.
fn is_bracketed_type(before: &str) -> bool {
    let open = before.rfind('(').map_or(before.len(), |at| at + 1);
    before.get(open..before.len() - 1).is_some_and(is_type)
}

/// What is said where brackets hold what they do not: of the innermost that is open at a byte.
fn in_brackets(text: &str, place: usize, sign: &str) -> Option<Complaint> {
    let mut open: Vec<Token> = Vec::new();
    for token in tokens(text).into_iter().filter(|token| !token.kind.is_comment() && token.start < place) {
        match token.text(text) {
            "(" | "[" | "{" => open.push(token),
            ")" | "]" | "}" => {
                open.pop();
            }
            _ => {}
        }
    }
    let bracket = open.pop()?;
    let before = text[..bracket.start].trim_end();
    let word = last_word(before);
    let start = before.len() - word.len();
    let is_own = |kind: ItemKind| {
        let items = slice(text).unwrap_or_default();
        items.iter().any(|item| item.kind == kind && item.name == word)
    };
    match bracket.text(text) {
        "[" if before.ends_with('>') => {
            let told = format!("a value is made in round brackets: `{}(...)`", last_type(before));
            Some((bracket.start, told))
        }
        "[" if is_type(word) || is_own(ItemKind::Struct) || is_own(ItemKind::Alias) => {
            Some((bracket.start, format!("a value is made in round brackets: `{word}(...)`")))
        }
        "[" if is_own(ItemKind::Fn) || is_function(word) => {
            Some((bracket.start, format!("a function is called by round brackets: `{word}(...)`")))
        }
        "[" if sign == "," => {
            Some((place, "one number stands in `[ ]`, an element's; of a matrix write `m[column][row]`".into()))
        }
        "(" if sign == "," && word == "if" => {
            Some((place, "a condition is one value; two are joined by `&&` or `||`".into()))
        }
        "(" if sign == "," && word == "switch" => Some((place, "`switch` chooses by one number".into())),
        "(" if last_word(before[..start].trim_end()) != "fn" && !is_own(ItemKind::Fn) => {
            const HEADS: [&str; 3] = ["for", "if", "switch"];
            let likely = nearest(word, HEADS.into_iter()).filter(|_| !HEADS.contains(&word))?;
            Some((start, format!("there is no `{word}`; did you mean `{likely}`?")))
        }
        _ => None,
    }
}

/// The type in angle brackets by which a text ends.
fn last_type(before: &str) -> &str {
    let mut depth = 0;
    let open = before.char_indices().rev().find(|(_, c)| {
        depth += i32::from(*c == '>') - i32::from(*c == '<');
        depth == 0
    });
    let open = open.map_or(0, |(at, _)| at);
    &before[open - last_word(before[..open].trim_end()).len()..]
}

/// Whether the name at a byte is a `const` there, of the text or of its function.
fn is_a_constant(text: &str, place: usize) -> bool {
    let items = slice(text).unwrap_or_default();
    let word = word_at(text, place);
    let is_read = |item: &&halfvector_shaders::Item| item.references.iter().any(|range| range.start == place);
    if items.iter().any(|item| is_read(&item)) {
        return items.iter().any(|item| item.kind == ItemKind::Const && item.name == word);
    }
    let code: Vec<Token> = tokens(&text[..place]).into_iter().filter(|token| !token.kind.is_comment()).collect();
    let made = code
        .windows(2)
        .rev()
        .find(|pair| pair[1].text(text) == word && matches!(pair[0].text(text), "const" | "var" | "let" | "fn" | "("));
    made.is_some_and(|pair| pair[0].text(text) == "const")
}

/// Whether the text has something of this name that is no function.
fn is_no_function(text: &str, word: &str) -> bool {
    let items = slice(text).unwrap_or_default();
    items.iter().any(|item| item.name == word && item.kind != ItemKind::Fn)
}

/// The word by which a text ends; empty where it ends by something else.
fn last_word(text: &str) -> &str {
    let start = text.rfind(|c: char| !(c.is_alphanumeric() || c == '_'));
    let start = start.map_or(0, |at| at + text[at..].chars().next().map_or(1, char::len_utf8));
    &text[start..]
}

/// The number in which a byte is, or behind which something is stuck.
fn number_about(text: &str, place: usize) -> Option<Token> {
    let number = tokens(text).into_iter().find(|token| token.kind == TokenKind::Number && token.end >= place)?;
    let is_stuck = number.end == place && text[place..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
    (number.start < place && (place < number.end || is_stuck)).then_some(number)
}

/// The number that begins at a byte, as it is written.
fn number_at(text: &str, place: usize) -> &str {
    tokens(text).into_iter().find(|token| token.start == place).map_or("", |token| token.text(text))
}

/// The first function of a text, for what has no place.
fn first_function(text: &str) -> usize {
    let items = slice(text).unwrap_or_default();
    items.iter().find(|item| item.kind == ItemKind::Fn).map_or(0, |item| item.code_start)
}
