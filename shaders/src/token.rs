//! WGSL text as tokens: the one tokenizer of the project. It knows where words, numbers and comments begin and end, and
//! nothing of grammar. Every byte that is not white space belongs to exactly one token, whatever the text.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A word: keyword, type, or name.
    Identifier,
    /// A number, with its suffix.
    Number,
    /// One character of anything else.
    Punctuation,
    /// `// ...`, without the line break.
    LineComment,
    /// `/* ... */`, nested ones included; up to the end of the text when it is not closed.
    BlockComment,
    /// `/// ...` or `/** ... */`: belongs to what follows.
    DocComment,
    /// `//! ...` or `/*! ... */`: belongs to the file.
    ModuleComment,
}

impl TokenKind {
    /// Whether it is one of the four kinds of comment.
    pub fn is_comment(self) -> bool {
        !matches!(self, TokenKind::Identifier | TokenKind::Number | TokenKind::Punctuation)
    }
}

/// A token: its kind and its bytes `start..end` in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Token {
    /// Its text. `source` is the text that [`tokens`] was given.
    pub fn text<'s>(&self, source: &'s str) -> &'s str {
        &source[self.start..self.end]
    }
}

/// Cuts a text into tokens, in order; white space is left out. Any text gives some tokens: no error, no panic.
pub fn tokens(source: &str) -> Vec<Token> {
    let mut result = Vec::new();
    let mut start = 0;
    while let Some(first) = source[start..].chars().next() {
        let rest = &source[start..];
        if is_space(first) {
            start += first.len_utf8();
            continue;
        }
        let (kind, length) = if rest.starts_with("//") {
            let length = rest.find(is_line_break).unwrap_or(rest.len());
            (comment_kind(rest, TokenKind::LineComment), length)
        } else if rest.starts_with("/*") {
            (comment_kind(rest, TokenKind::BlockComment), block_comment_length(rest))
        } else if is_word_start(first) {
            (TokenKind::Identifier, rest.find(|c| !is_word_part(c)).unwrap_or(rest.len()))
        } else if starts_number(rest) {
            (TokenKind::Number, number_length(rest))
        } else {
            (TokenKind::Punctuation, first.len_utf8())
        };
        result.push(Token { kind, start, end: start + length });
        start += length;
    }
    result
}

fn comment_kind(comment: &str, plain: TokenKind) -> TokenKind {
    match comment.as_bytes().get(2) {
        Some(b'!') => TokenKind::ModuleComment,
        Some(b'/') if plain == TokenKind::LineComment => TokenKind::DocComment,
        // `/**/` is an empty comment, not the start of a doc comment.
        Some(b'*') if plain == TokenKind::BlockComment && !comment.starts_with("/**/") => TokenKind::DocComment,
        _ => plain,
    }
}

fn block_comment_length(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let (mut depth, mut at) = (1_usize, 2);
    while at < bytes.len() {
        match bytes.get(at..at + 2) {
            Some(b"/*") => {
                depth += 1;
                at += 2;
            }
            Some(b"*/") => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return at;
                }
            }
            _ => at += 1,
        }
    }
    rest.len()
}

fn starts_number(rest: &str) -> bool {
    let rest = rest.strip_prefix('.').unwrap_or(rest);
    rest.starts_with(|c: char| c.is_ascii_digit())
}

/// Numbers as in WGSL 6.2.2: `7`, `7u`, `.5`, `1.`, `1e-5f`, `0x1.8p-3`. Longest run of characters that could belong,
/// up to a second point.
fn number_length(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let hexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
    let exponent: &[u8] = if hexadecimal { b"pP" } else { b"eE" };
    let mut at = 0;
    while at < bytes.len() {
        let belongs = bytes[at].is_ascii_alphanumeric()
            || (bytes[at] == b'.' && !bytes[..at].contains(&b'.'))
            || (at > 0 && matches!(bytes[at], b'+' | b'-') && exponent.contains(&bytes[at - 1]));
        if !belongs {
            break;
        }
        at += 1;
    }
    at
}

/// Pattern_White_Space, as WGSL has it.
fn is_space(c: char) -> bool {
    matches!(c, '\u{9}'..='\u{d}' | ' ' | '\u{85}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}')
}

/// What ends a line in WGSL.
pub(crate) fn is_line_break(c: char) -> bool {
    matches!(c, '\u{a}'..='\u{d}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

fn is_word_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn is_word_part(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(source: &str) -> Vec<(TokenKind, &str)> {
        tokens(source).iter().map(|t| (t.kind, t.text(source))).collect()
    }

    #[test]
    fn words_numbers_and_signs() {
        use TokenKind::*;
        assert_eq!(
            kinds("a_1=1e-5f-.5*0x1.8p-3+v.x"),
            [
                (Identifier, "a_1"),
                (Punctuation, "="),
                (Number, "1e-5f"),
                (Punctuation, "-"),
                (Number, ".5"),
                (Punctuation, "*"),
                (Number, "0x1.8p-3"),
                (Punctuation, "+"),
                (Identifier, "v"),
                (Punctuation, "."),
                (Identifier, "x"),
            ]
        );
        // 0xE-1 is a subtraction: E is a digit there, not an exponent.
        assert_eq!(kinds("0xE-1"), [(Number, "0xE"), (Punctuation, "-"), (Number, "1")]);
    }

    #[test]
    fn comments() {
        use TokenKind::*;
        assert_eq!(
            kinds("//! m\n/// d\n// l\n/* a /* b */ c */x/**/y/** d */ /* open /* */"),
            [
                (ModuleComment, "//! m"),
                (DocComment, "/// d"),
                (LineComment, "// l"),
                (BlockComment, "/* a /* b */ c */"),
                (Identifier, "x"),
                (BlockComment, "/**/"),
                (Identifier, "y"),
                (DocComment, "/** d */"),
                (BlockComment, "/* open /* */"),
            ]
        );
        // WGSL ends a line at these too; a word after them is code.
        assert_eq!(kinds("//a\u{2028}b\u{85}c").len(), 3);
    }
}
