//! Expressions and types of a text as trees, as far as they are WGSL: what is not, the parser of naga tells.

use std::ops::Range;

use halfvector_shaders::{Token, TokenKind, tokens};

/// A value as it is written.
#[derive(Debug)]
pub(super) struct Expr<'t> {
    /// Its bytes, brackets about it included.
    pub(super) range: Range<usize>,
    pub(super) kind: Kind<'t>,
}

#[derive(Debug)]
pub(super) enum Kind<'t> {
    Number,
    Bool,
    Name,
    /// A call of a function or of a type's constructor.
    Call {
        callee: Type<'t>,
        arguments: Vec<Expr<'t>>,
    },
    Index(Box<Expr<'t>>, Box<Expr<'t>>),
    Member(Box<Expr<'t>>, Range<usize>),
    Unary(char, Box<Expr<'t>>),
    Binary {
        sign: &'static str,
        at: usize,
        left: Box<Expr<'t>>,
        right: Box<Expr<'t>>,
    },
    Brackets(Box<Expr<'t>>),
}

/// A type, or the name of a function.
#[derive(Clone, Debug)]
pub(super) struct Type<'t> {
    pub(super) name: &'t str,
    pub(super) arguments: Vec<Argument<'t>>,
}

/// What stands in the angle brackets of a type.
#[derive(Clone, Debug)]
pub(super) enum Argument<'t> {
    Type(Type<'t>),
    Number(&'t str),
}

/// Types that take arguments in angle brackets, in front of which `<` is no comparison.
const TAKES_TYPES: [&str; 5] = ["vec", "mat", "array", "texture_", "bitcast"];

/// Binary operators by their strength, the longer ones first.
const BINARY: [(&str, u8); 18] = [
    ("||", 1),
    ("&&", 2),
    ("==", 6),
    ("!=", 6),
    ("<<", 8),
    (">>", 8),
    ("<=", 7),
    (">=", 7),
    ("|", 3),
    ("^", 4),
    ("&", 5),
    ("<", 7),
    (">", 7),
    ("+", 9),
    ("-", 9),
    ("*", 10),
    ("/", 10),
    ("%", 10),
];

/// Reads a text from its front. Everything gives `None` where the text is no WGSL.
pub(super) struct Reader<'t> {
    pub(super) text: &'t str,
    code: Vec<Token>,
    at: usize,
}

impl<'t> Reader<'t> {
    pub(super) fn new(text: &'t str) -> Reader<'t> {
        Reader { text, code: tokens(text).into_iter().filter(|token| !token.kind.is_comment()).collect(), at: 0 }
    }

    /// Goes to the first token from a byte on.
    pub(super) fn seek(&mut self, at: usize) {
        self.at = self.code.partition_point(|token| token.start < at);
    }

    /// The word or sign `ahead` of the place; empty behind the end.
    pub(super) fn peek(&self, ahead: usize) -> &'t str {
        self.code.get(self.at + ahead).map_or("", |token| token.text(self.text))
    }

    /// The byte at which the next token begins.
    pub(super) fn start(&self) -> usize {
        self.code.get(self.at).map_or(self.text.len(), |token| token.start)
    }

    /// The byte at which the last token ended.
    fn end(&self) -> usize {
        self.at.checked_sub(1).and_then(|at| self.code.get(at)).map_or(0, |token| token.end)
    }

    /// Takes a word or sign if it is next.
    pub(super) fn take(&mut self, word: &str) -> bool {
        let is = self.peek(0) == word;
        self.at += usize::from(is);
        is
    }

    pub(super) fn want(&mut self, word: &str) -> Option<()> {
        self.take(word).then_some(())
    }

    pub(super) fn name(&mut self) -> Option<(&'t str, Range<usize>)> {
        let token = self.code.get(self.at).filter(|token| token.kind == TokenKind::Identifier)?;
        self.at += 1;
        Some((token.text(self.text), token.start..token.end))
    }

    /// Whether the next tokens are this sign, with nothing between its characters.
    pub(super) fn is_sign(&self, sign: &str) -> bool {
        let fits = |(i, c): (usize, char)| {
            let token = self.code.get(self.at + i);
            token.is_some_and(|token| token.text(self.text).starts_with(c) && token.start == self.start() + i)
        };
        sign.chars().enumerate().all(fits)
    }

    pub(super) fn take_sign(&mut self, sign: &str) -> bool {
        let is = self.is_sign(sign);
        self.at += if is { sign.len() } else { 0 };
        is
    }

    /// The operator that is next, if a value follows it: `+=` and `++` end a value.
    fn operator(&self) -> Option<(&'static str, u8)> {
        let (sign, strength) = BINARY.into_iter().find(|(sign, _)| self.is_sign(sign))?;
        let ends = |more: &str| self.is_sign(&format!("{sign}{more}"));
        let is_comparison = matches!(sign, "==" | "!=" | "<=" | ">=");
        let is_end = (!is_comparison && ends("=")) || (matches!(sign, "+" | "-") && ends(sign));
        (!is_end).then_some((sign, strength))
    }

    pub(super) fn expression(&mut self) -> Option<Expr<'t>> {
        self.above(0)
    }

    /// A value whose operators are stronger than this.
    fn above(&mut self, strength: u8) -> Option<Expr<'t>> {
        let mut left = self.unary()?;
        while let Some((sign, own)) = self.operator().filter(|(_, own)| *own > strength) {
            let at = self.start();
            self.at += sign.len();
            let right = self.above(own)?;
            let range = left.range.start..right.range.end;
            left = Expr { range, kind: Kind::Binary { sign, at, left: Box::new(left), right: Box::new(right) } };
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<Expr<'t>> {
        let start = self.start();
        let Some(sign) = ['-', '!', '~'].into_iter().find(|sign| self.is_sign(&sign.to_string())) else {
            return self.postfix();
        };
        self.at += 1;
        let inner = self.unary()?;
        Some(Expr { range: start..inner.range.end, kind: Kind::Unary(sign, Box::new(inner)) })
    }

    fn postfix(&mut self) -> Option<Expr<'t>> {
        let mut value = self.primary()?;
        loop {
            let start = value.range.start;
            if self.take("[") {
                let index = self.expression()?;
                self.want("]")?;
                value = Expr { range: start..self.end(), kind: Kind::Index(Box::new(value), Box::new(index)) };
            } else if self.take(".") {
                let (_, member) = self.name()?;
                value = Expr { range: start..member.end, kind: Kind::Member(Box::new(value), member) };
            } else {
                return Some(value);
            }
        }
    }

    fn primary(&mut self) -> Option<Expr<'t>> {
        let token = *self.code.get(self.at)?;
        let range = token.start..token.end;
        match (token.kind, token.text(self.text)) {
            (TokenKind::Number, _) => {
                self.at += 1;
                Some(Expr { range, kind: Kind::Number })
            }
            (_, "(") => {
                self.at += 1;
                let inner = self.expression()?;
                self.want(")")?;
                Some(Expr { range: token.start..self.end(), kind: Kind::Brackets(Box::new(inner)) })
            }
            (TokenKind::Identifier, "true" | "false") => {
                self.at += 1;
                Some(Expr { range, kind: Kind::Bool })
            }
            (TokenKind::Identifier, _) => {
                let callee = self.ty()?;
                if self.peek(0) == "(" {
                    let arguments = self.arguments()?;
                    Some(Expr { range: token.start..self.end(), kind: Kind::Call { callee, arguments } })
                } else {
                    callee.arguments.is_empty().then_some(Expr { range, kind: Kind::Name })
                }
            }
            _ => None,
        }
    }

    /// What stands in the brackets of a call.
    fn arguments(&mut self) -> Option<Vec<Expr<'t>>> {
        self.want("(")?;
        let mut arguments = Vec::new();
        while !self.take(")") {
            arguments.push(self.expression()?);
            if !self.take(",") {
                self.want(")")?;
                break;
            }
        }
        Some(arguments)
    }

    pub(super) fn ty(&mut self) -> Option<Type<'t>> {
        let (name, _) = self.name()?;
        let mut arguments = Vec::new();
        if TAKES_TYPES.iter().any(|head| name.starts_with(head)) && self.take("<") {
            while !self.take(">") {
                let next = *self.code.get(self.at)?;
                arguments.push(if next.kind == TokenKind::Number {
                    self.at += 1;
                    Argument::Number(next.text(self.text))
                } else {
                    Argument::Type(self.ty()?)
                });
                if !self.take(",") {
                    self.want(">")?;
                    break;
                }
            }
        }
        Some(Type { name, arguments })
    }
}
