//! Where a text that is no WGSL goes wrong by its types, and what would be right, in the text's own words. naga alone decides whether a
//! text is sound; it is asked here only after a refusal, since naga's words name numbers of its own and its places are often where
//! a value was made. Types are followed as far as they are known, and nothing is said of what is not.

mod builtins;
mod call;
mod syntax;
mod types;
mod value;

use std::collections::HashMap;

use halfvector_shaders::{Item, ItemKind, slice};

use super::complaint::Complaint;
use syntax::{Argument, Expr, Kind, Reader, Type};
use types::{Scalar, Ty, remedy, value_type};

/// Why a text is not followed further: something is wrong at a place, or, without one, it is no WGSL that is known here.
pub(super) type Stop = Option<Complaint>;

/// What is known of a function.
struct Signature<'t> {
    arguments: Vec<(&'t str, Ty)>,
    result: Ty,
}

/// A name in a function.
struct Local<'t> {
    name: &'t str,
    ty: Ty,
    /// Its value where it is a whole number that is known.
    value: Option<i64>,
    /// Whether it is a `var`.
    changes: bool,
    /// The whole numbers without a suffix that its type is from, where no type was written.
    whole: Option<std::ops::Range<usize>>,
}

/// What a text declares, and the function that is read.
struct World<'t> {
    reader: Reader<'t>,
    aliases: HashMap<&'t str, Type<'t>>,
    structs: HashMap<&'t str, Vec<(&'t str, Type<'t>)>>,
    functions: HashMap<&'t str, Signature<'t>>,
    constants: Vec<Local<'t>>,
    locals: Vec<Local<'t>>,
    /// Name and result of the function that is read.
    within: (&'t str, Ty),
}

/// The first value whose type is wrong in the first `own` bytes of a text, of which the rest is sound.
///
/// # Errors
/// What is wrong, or nothing where the text was not followed to its end.
pub(super) fn explain(text: &str, own: usize) -> Result<(), Stop> {
    let items = slice(text).map_err(|_| None)?;
    let mut world = World {
        reader: Reader::new(text),
        aliases: HashMap::new(),
        structs: HashMap::new(),
        functions: HashMap::new(),
        constants: Vec::new(),
        locals: Vec::new(),
        within: ("", Ty::Nothing),
    };
    for item in items.iter().filter(|item| matches!(item.kind, ItemKind::Alias | ItemKind::Struct)) {
        world.declare_type(item)?;
    }
    for item in items.iter().filter(|item| item.kind == ItemKind::Fn) {
        world.declare_function(item)?;
    }
    // What one constant is made of may stand behind it.
    let constants = || items.iter().filter(|item| item.kind == ItemKind::Const);
    for item in constants() {
        world.constant(item).or_else(|stop| if stop.is_some() { Ok(()) } else { Err(stop) })?;
    }
    for item in constants().filter(|item| item.code_start < own) {
        world.constant(item)?;
    }
    for item in items.iter().filter(|item| item.kind == ItemKind::Fn && item.code_start < own) {
        world.function(item)?;
    }
    Ok(())
}

impl<'t> World<'t> {
    /// The text of some bytes.
    fn written(&self, range: &std::ops::Range<usize>) -> &'t str {
        &self.reader.text[range.clone()]
    }

    fn seek(&mut self, at: usize) {
        self.reader.seek(at);
    }

    fn declare_type(&mut self, item: &Item) -> Result<(), Stop> {
        self.seek(item.name_range.end);
        let name = self.written(&item.name_range);
        if item.kind == ItemKind::Alias {
            self.reader.want("=").ok_or(None)?;
            let ty = self.reader.ty().ok_or(None)?;
            self.aliases.insert(name, ty);
            return Ok(());
        }
        self.reader.want("{").ok_or(None)?;
        let mut members = Vec::new();
        while !self.reader.take("}") {
            let (member, _) = self.reader.name().ok_or(None)?;
            self.reader.want(":").ok_or(None)?;
            members.push((member, self.reader.ty().ok_or(None)?));
            self.reader.take(",");
        }
        self.structs.insert(name, members);
        Ok(())
    }

    /// Reads a function up to its body.
    fn head(&mut self, item: &Item) -> Result<Signature<'t>, Stop> {
        self.seek(item.name_range.end);
        self.reader.want("(").ok_or(None)?;
        let mut arguments = Vec::new();
        while !self.reader.take(")") {
            let (name, _) = self.reader.name().ok_or(None)?;
            self.reader.want(":").ok_or(None)?;
            let ty = self.reader.ty().ok_or(None)?;
            arguments.push((name, self.resolve(&ty)));
            self.reader.take(",");
        }
        let result = if self.reader.take_sign("->") {
            let ty = self.reader.ty().ok_or(None)?;
            self.resolve(&ty)
        } else {
            Ty::Nothing
        };
        Ok(Signature { arguments, result })
    }

    fn declare_function(&mut self, item: &Item) -> Result<(), Stop> {
        let signature = self.head(item)?;
        self.functions.insert(self.written(&item.name_range), signature);
        Ok(())
    }

    fn constant(&mut self, item: &Item) -> Result<(), Stop> {
        self.seek(item.name_range.start);
        let mut local = self.declaration()?;
        self.constants.retain(|known| known.name != local.name);
        // It takes the type that it is used with.
        if local.ty.is_unknown() {
            local.value = None;
        }
        self.constants.push(local);
        Ok(())
    }

    fn function(&mut self, item: &Item) -> Result<(), Stop> {
        let signature = self.head(item)?;
        self.within = (self.written(&item.name_range), signature.result);
        self.locals = signature
            .arguments
            .into_iter()
            .map(|(name, ty)| Local { name, ty, value: None, changes: false, whole: None })
            .collect();
        self.block()
    }

    /// `name: type = value`, from the name on; the type as it was found, which numbers without a suffix keep.
    fn declaration(&mut self) -> Result<Local<'t>, Stop> {
        let (name, _) = self.reader.name().ok_or(None)?;
        let declared = if self.reader.take(":") {
            let ty = self.reader.ty().ok_or(None)?;
            Some(self.resolve(&ty))
        } else {
            None
        };
        if !self.reader.take("=") {
            let ty = declared.unwrap_or(Ty::Unknown);
            return Ok(Local { name, ty, value: None, changes: false, whole: None });
        }
        let value = self.reader.expression().ok_or(None)?;
        let ty = self.ty(&value)?;
        self.refuse_nothing(&value, &ty)?;
        let number = self.number(&value);
        match declared {
            Some(wanted) => {
                if !ty.fits(&wanted) {
                    let told = format!("`{name}` is to be {}, and this is {}", wanted.name(), ty.name());
                    return Err(Some((value.range.start, told + &remedy(&wanted, &ty, self.written(&value.range)))));
                }
                Ok(Local { name, ty: wanted, value: number, changes: false, whole: None })
            }
            None => {
                let whole = (ty.scalar() == Some(Scalar::Integer)).then_some(value.range);
                Ok(Local { name, ty, value: number, changes: false, whole })
            }
        }
    }

    fn block(&mut self) -> Result<(), Stop> {
        self.reader.want("{").ok_or(None)?;
        let outer = self.locals.len();
        while !self.reader.take("}") {
            self.statement()?;
        }
        self.locals.truncate(outer);
        Ok(())
    }

    fn statement(&mut self) -> Result<(), Stop> {
        match self.reader.peek(0) {
            "{" => return self.block(),
            ";" => {}
            "let" | "var" | "const" => {
                let keyword = self.reader.name().map_or("", |(keyword, _)| keyword);
                let mut local = self.declaration()?;
                if keyword != "const" {
                    local.ty = local.ty.concrete();
                }
                if keyword == "var" {
                    (local.value, local.changes) = (None, true);
                }
                self.locals.push(local);
            }
            "return" => {
                self.reader.take("return");
                if self.reader.peek(0) != ";" {
                    let value = self.reader.expression().ok_or(None)?;
                    self.returned(&value)?;
                }
            }
            "if" => return self.branch(),
            "for" => return self.counted(),
            "switch" => return self.switch(),
            "break" | "continue" => {
                self.reader.name();
            }
            _ => self.change()?,
        }
        self.reader.want(";").ok_or(None)
    }

    fn returned(&mut self, value: &Expr<'t>) -> Result<(), Stop> {
        let actual = self.ty(value)?;
        let (name, wanted) = &self.within;
        let (at, written) = (value.range.start, self.written(&value.range));
        if *wanted == Ty::Nothing {
            let told = format!(
                "`{name}` gives nothing; write `-> {}` after its arguments, or `return;` here",
                actual.concrete().name()
            );
            return Err(Some((at, told)));
        }
        if actual.fits(wanted) {
            return Ok(());
        }
        let told = format!("`{name}` gives {}, as stands after its `->`, and this is {}", wanted.name(), actual.name());
        Err(Some((at, told + &remedy(wanted, &actual, written))))
    }

    fn branch(&mut self) -> Result<(), Stop> {
        self.reader.take("if");
        let condition = self.reader.expression().ok_or(None)?;
        self.condition(&condition)?;
        self.block()?;
        if self.reader.take("else") {
            return if self.reader.peek(0) == "if" { self.branch() } else { self.block() };
        }
        Ok(())
    }

    fn condition(&mut self, condition: &Expr<'t>) -> Result<(), Stop> {
        let told = match self.ty(condition)? {
            Ty::Unknown | Ty::BOOL => return Ok(()),
            Ty::Vector(size, Scalar::Bool) => format!(
                "a condition is true or false, and this is {size} of them; write `all(...)` or `any(...)` about it"
            ),
            other => {
                format!("a condition is true or false, and this is {}; compare it, such as `x > 0.0`", other.name())
            }
        };
        Err(Some((unbracketed(condition).range.start, told)))
    }

    fn counted(&mut self) -> Result<(), Stop> {
        let outer = self.locals.len();
        self.reader.take("for");
        self.reader.want("(").ok_or(None)?;
        self.statement()?;
        let condition = self.reader.expression().ok_or(None)?;
        self.condition(&condition)?;
        self.reader.want(";").ok_or(None)?;
        self.change()?;
        self.reader.want(")").ok_or(None)?;
        self.block()?;
        self.locals.truncate(outer);
        Ok(())
    }

    fn switch(&mut self) -> Result<(), Stop> {
        self.reader.take("switch");
        let chosen = self.reader.expression().ok_or(None)?;
        let ty = self.ty(&chosen)?.concrete();
        if !ty.is_unknown() && !matches!(ty, Ty::Scalar(Scalar::I32 | Scalar::U32)) {
            let told = format!(
                "`switch` chooses by a whole number, i32 or u32, and this is {}{}",
                ty.name(),
                remedy(&Ty::Scalar(Scalar::I32), &ty, self.written(&unbracketed(&chosen).range))
            );
            return Err(Some((unbracketed(&chosen).range.start, told)));
        }
        self.reader.want("{").ok_or(None)?;
        let (mut seen, mut has_default) = (Vec::new(), false);
        while !self.reader.take("}") {
            let at = self.reader.start();
            let is_case = self.reader.take("case");
            if !is_case {
                self.reader.want("default").ok_or(None)?;
            }
            loop {
                let here = if is_case { self.reader.start() } else { at };
                if !is_case || self.reader.take("default") {
                    if has_default {
                        return Err(Some((here, "`default` stands twice in this `switch`".into())));
                    }
                    has_default = true;
                } else if matches!(self.reader.peek(0), ":" | "{") {
                    break;
                } else {
                    let case = self.reader.expression().ok_or(None)?;
                    let own = self.ty(&case)?;
                    if !own.fits(&ty) {
                        let told = format!("`switch` chooses by {} here, and this is {}", ty.name(), own.name());
                        return Err(Some((here, told)));
                    }
                    if let Some(number) = self.number(&case) {
                        if seen.contains(&number) {
                            return Err(Some((here, format!("`case {number}` stands twice in this `switch`"))));
                        }
                        seen.push(number);
                    }
                }
                if !is_case || !self.reader.take(",") {
                    break;
                }
            }
            self.reader.take(":");
            self.block()?;
        }
        Ok(())
    }

    /// An assignment, `i++`, or a call.
    fn change(&mut self) -> Result<(), Stop> {
        if self.reader.take("_") {
            self.reader.want("=").ok_or(None)?;
            let value = self.reader.expression().ok_or(None)?;
            return self.ty(&value).map(|_| ());
        }
        let place = self.reader.expression().ok_or(None)?;
        let held = self.ty(&place)?;
        let name = self.written(&place.range);
        for sign in ["++", "--"] {
            if self.reader.is_sign(sign) {
                let fixed =
                    self.locals.iter().rev().find(|local| local.name == name).is_some_and(|local| !local.changes);
                if fixed {
                    return Err(Some((place.range.start, super::complaint::does_not_change(name))));
                }
                if held.scalar().is_some_and(|scalar| !scalar.is_whole()) || held.size() > 1 {
                    let told = format!(
                        "`{sign}` counts i32 and u32, and this is {}; write `{name} {}= 1.0`",
                        held.name(),
                        &sign[..1]
                    );
                    return Err(Some((place.range.start, told)));
                }
                self.reader.take_sign(sign);
                return Ok(());
            }
        }
        let compound = ["<<=", ">>=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="];
        if let Some(sign) = compound.into_iter().find(|sign| self.reader.is_sign(sign)) {
            let at = self.reader.start();
            self.reader.take_sign(sign);
            let value = self.reader.expression().ok_or(None)?;
            let given = self.ty(&value)?;
            let operator = &sign[..sign.len() - 1];
            // What is held keeps its type: the other side is to follow it.
            if let (Some(own), Some(other)) = (held.scalar(), given.scalar())
                && own.common(other).is_none()
                && own != Scalar::Bool
                && matches!(operator, "+" | "-" | "*" | "/" | "%")
            {
                self.refuse_whole(&place, &given)?;
                let told = format!("`{name}` is {}, and this is {}", held.name(), given.name());
                let cure = remedy(&Ty::of(given.size(), own), &given, self.written(&value.range));
                return Err(Some((value.range.start, told + &cure)));
            }
            let made = self.binary(operator, at, (&place, &held), (&value, &given))?;
            if !made.fits(&held) {
                let told = format!(
                    "`{name}` is {}, and {} `{operator}` {} makes {} of it",
                    held.name(),
                    held.name(),
                    given.name(),
                    made.name()
                );
                return Err(Some((at, told)));
            }
            return Ok(());
        }
        if self.reader.take("=") {
            let value = self.reader.expression().ok_or(None)?;
            let given = self.ty(&value)?;
            self.refuse_nothing(&value, &given)?;
            if !given.fits(&held) {
                self.refuse_whole(&place, &given)?;
                let told = format!("`{name}` is {}, and this is {}", held.name(), given.name());
                let cure = remedy(&held, &given, self.written(&value.range));
                return Err(Some((value.range.start, told + &cure)));
            }
        }
        Ok(())
    }

    /// Refuses the whole number that a variable was made of, where it is to hold what is none.
    fn refuse_whole(&self, place: &Expr<'t>, given: &Ty) -> Result<(), Stop> {
        let mut root = place;
        while let Kind::Brackets(of) | Kind::Member(of, _) | Kind::Index(of, _) = &root.kind {
            root = of;
        }
        let name = self.written(&root.range);
        let Some(local) = self.locals.iter().rev().find(|local| local.name == name) else { return Ok(()) };
        let Some(range) = local.whole.clone().filter(|_| matches!(given.scalar(), Some(Scalar::F32 | Scalar::Decimal)))
        else {
            return Ok(());
        };
        let written = self.written(&range);
        let cure = if written.bytes().all(|b| b.is_ascii_digit()) {
            format!("write `{written}.0`")
        } else {
            "write its numbers with a point, such as `0.0`".into()
        };
        let told = format!("by this `{name}` is {}, and it takes f32 below; {cure}", local.ty.name());
        Err(Some((range.start, told)))
    }

    /// A type as it is written.
    fn resolve(&self, ty: &Type<'t>) -> Ty {
        self.resolved(ty, 0)
    }

    fn resolved(&self, ty: &Type<'t>, depth: usize) -> Ty {
        // Of aliases in a ring nothing is said here.
        if depth > 16 {
            return Ty::Unknown;
        }
        if let Some(alias) = self.aliases.get(ty.name) {
            return self.resolved(alias, depth + 1);
        }
        if self.structs.contains_key(ty.name) {
            return Ty::Struct(ty.name.into());
        }
        let argument = |index: usize| match ty.arguments.get(index) {
            Some(Argument::Type(inner)) => self.resolved(inner, depth + 1),
            _ => Ty::Unknown,
        };
        match ty.name {
            "array" => {
                let size = match ty.arguments.get(1) {
                    Some(Argument::Number(digits)) => super::custom::integer(digits),
                    Some(Argument::Type(of)) => {
                        let known = self.constants.iter().find(|local| local.name == of.name);
                        known.and_then(|local| u64::try_from(local.value?).ok())
                    }
                    _ => None,
                };
                Ty::Array(Box::new(argument(0)), size)
            }
            "sampler" => Ty::Sampler,
            "texture_2d" => Ty::Texture(2),
            "texture_cube" | "texture_3d" => Ty::Texture(3),
            name => value_type(name, argument(0)),
        }
    }
}

/// What stands in brackets, without them.
fn unbracketed<'e, 't>(expression: &'e Expr<'t>) -> &'e Expr<'t> {
    match &expression.kind {
        Kind::Brackets(inner) => unbracketed(inner),
        _ => expression,
    }
}

#[cfg(test)]
mod tests {
    use super::explain;
    use halfvector_shaders::{FILES, generic_types};

    /// All of the library is followed to its end, and nothing is found in it: what is said of a text that is wrong is no guess.
    #[test]
    fn nothing_is_said_of_what_is_sound() {
        let files = || FILES.iter().filter(|file| !file.path.starts_with("entry/"));
        let plain = files().filter(|file| generic_types(file.source).is_none());
        let plain: String = plain.map(|file| format!("{}\n", file.source)).collect();
        assert_eq!(explain(&plain, plain.len()), Ok(()), "{}", shown(&plain, plain.len()));
        for file in files().filter(|file| generic_types(file.source).is_some()) {
            let text = format!("{}\n{plain}", file.source);
            let own = file.source.len();
            assert_eq!(explain(&text, own), Ok(()), "{}: {}", file.path, shown(&text, own));
        }
    }

    fn shown(text: &str, own: usize) -> String {
        match explain(text, own) {
            Err(Some((at, _))) => text[at.saturating_sub(200)..].chars().take(400).collect(),
            _ => String::new(),
        }
    }
}
