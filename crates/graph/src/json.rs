//! A JSON reader that remembers where each value stands, so that a wrong field is reported with its line and column.
//!
//! It reads JSON as RFC 8259 has it, refuses a key that stands twice in one object (after a merge one of two nodes of the same
//! name would vanish), and bounds the nesting and the number of values. It does not know documents (see `file`) and does not write.

/// Deepest nesting that is read; a document needs seven.
pub(crate) const MAX_DEPTH: usize = 64;

/// Most values that are read, those in lists and objects counted too: the largest document that is drawn has less than half as many.
pub(crate) const MAX_VALUES: usize = 1_000_000;

/// A value and where it starts, in bytes from the start of the text.
#[derive(Clone, Debug)]
pub(crate) struct Spanned {
    pub(crate) at: usize,
    pub(crate) json: Json,
}

/// A JSON value.
#[derive(Clone, Debug)]
pub(crate) enum Json {
    Null,
    Bool(bool),
    /// The digits as they stand; finite as an `f64`.
    Number(String),
    String(String),
    Array(Vec<Spanned>),
    /// In the text's order; no key twice.
    Object(Vec<Member>),
}

/// A field of an object.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) at: usize,
    pub(crate) key: String,
    pub(crate) value: Spanned,
}

/// Why the text is no JSON, and where.
#[derive(Debug)]
pub(crate) struct SyntaxError {
    pub(crate) at: usize,
    pub(crate) message: String,
}

impl Json {
    /// What it is, in a reader's words.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Json::Null => "null",
            Json::Bool(_) => "true or false",
            Json::Number(_) => "a number",
            Json::String(_) => "a text",
            Json::Array(_) => "a list",
            Json::Object(_) => "an object",
        }
    }

    /// The same value without places.
    pub(crate) fn into_plain(self) -> serde_json::Value {
        match self {
            Json::Null => serde_json::Value::Null,
            Json::Bool(b) => b.into(),
            Json::Number(text) => serde_json::from_str(&text).unwrap_or(serde_json::Value::Null),
            Json::String(s) => s.into(),
            Json::Array(items) => items.into_iter().map(|item| item.json.into_plain()).collect(),
            Json::Object(members) => serde_json::Value::Object(
                members.into_iter().map(|member| (member.key, member.value.json.into_plain())).collect(),
            ),
        }
    }
}

/// Line and column of a byte of the text, both from 1; columns count characters.
pub(crate) fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// Whether two of a few members have the same key.
fn has_twins(members: &[Member]) -> bool {
    members.iter().enumerate().any(|(i, one)| members[..i].iter().any(|other| other.key == one.key))
}

/// Reads a whole text as one value.
pub(crate) fn parse(text: &str) -> Result<Spanned, SyntaxError> {
    let mut parser = Parser { text, at: 0, values: 0 };
    let value = parser.value(0)?;
    parser.skip_space();
    match parser.peek() {
        None => Ok(value),
        Some(_) => Err(parser.error("there is more text after the end of the document")),
    }
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    /// How many were read so far.
    values: usize,
}

impl Parser<'_> {
    fn error(&self, message: impl Into<String>) -> SyntaxError {
        SyntaxError { at: self.at, message: message.into() }
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// What stands here, for messages.
    fn found(&self) -> String {
        match self.text.get(self.at..).and_then(|rest| rest.chars().next()) {
            None => "the text ends".into(),
            Some(c) if c.is_control() => format!("`{}` stands", c.escape_default()),
            Some(c) => format!("`{c}` stands"),
        }
    }

    fn skip_space(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn value(&mut self, depth: usize) -> Result<Spanned, SyntaxError> {
        self.skip_space();
        if depth > MAX_DEPTH {
            return Err(self.error(format!("values are nested more than {MAX_DEPTH} deep")));
        }
        self.values += 1;
        if self.values > MAX_VALUES {
            return Err(self.error(format!("the text has more than {MAX_VALUES} values; is this a material?")));
        }
        let at = self.at;
        let json = match self.peek() {
            Some(b'{') => self.object(depth)?,
            Some(b'[') => self.array(depth)?,
            Some(b'"') => Json::String(self.string()?),
            Some(b'-' | b'0'..=b'9') => self.number()?,
            _ => self.word()?,
        };
        Ok(Spanned { at, json })
    }

    fn word(&mut self) -> Result<Json, SyntaxError> {
        let rest = &self.text[self.at..];
        for (word, json) in [("true", Json::Bool(true)), ("false", Json::Bool(false)), ("null", Json::Null)] {
            if rest.starts_with(word) {
                self.at += word.len();
                return Ok(json);
            }
        }
        Err(self.error(format!("a value is missing: {} here", self.found())))
    }

    fn digits(&mut self) -> Result<(), SyntaxError> {
        if !matches!(self.peek(), Some(b'0'..=b'9')) {
            return Err(self.error(format!("a digit is missing: {} here", self.found())));
        }
        while matches!(self.peek(), Some(b'0'..=b'9')) {
            self.at += 1;
        }
        Ok(())
    }

    fn number(&mut self) -> Result<Json, SyntaxError> {
        let start = self.at;
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        if self.peek() == Some(b'0') {
            self.at += 1;
            if matches!(self.peek(), Some(b'0'..=b'9')) {
                return Err(self.error("a number does not start with 0 before other digits"));
            }
        } else {
            self.digits()?;
        }
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.digits()?;
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            self.digits()?;
        }
        let text = &self.text[start..self.at];
        match text.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(Json::Number(text.into())),
            _ => Err(SyntaxError { at: start, message: "the number is too large".into() }),
        }
    }

    fn string(&mut self) -> Result<String, SyntaxError> {
        let start = self.at;
        self.at += 1;
        let mut out = String::new();
        let mut plain = self.at;
        loop {
            match self.peek() {
                None => {
                    return Err(SyntaxError {
                        at: start,
                        message: "the text that starts here has no closing \"".into(),
                    });
                }
                Some(b'"') => {
                    out.push_str(&self.text[plain..self.at]);
                    self.at += 1;
                    return Ok(out);
                }
                Some(b'\\') => {
                    out.push_str(&self.text[plain..self.at]);
                    self.at += 1;
                    out.push(self.escape()?);
                    plain = self.at;
                }
                Some(0..=0x1f) => {
                    return Err(self
                        .error("a line break or control character stands in a text; write it as \\n, \\t or \\u00XX"));
                }
                Some(_) => self.at += 1,
            }
        }
    }

    /// Reads what follows a backslash.
    fn escape(&mut self) -> Result<char, SyntaxError> {
        let c = match self.peek() {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                self.at += 1;
                return self.unicode_escape();
            }
            _ => return Err(self.error(format!("{} after a backslash; write \\\\ for a backslash", self.found()))),
        };
        self.at += 1;
        Ok(c)
    }

    /// Reads four hexadecimal digits, twice for a character beyond U+FFFF.
    fn unicode_escape(&mut self) -> Result<char, SyntaxError> {
        let high = self.hex4()?;
        let code = if (0xd800..0xdc00).contains(&high) && self.text[self.at..].starts_with("\\u") {
            self.at += 2;
            let low = self.hex4()?;
            if (0xdc00..0xe000).contains(&low) { 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00) } else { high }
        } else {
            high
        };
        char::from_u32(code).ok_or_else(|| self.error("half of a surrogate pair is no character"))
    }

    fn hex4(&mut self) -> Result<u32, SyntaxError> {
        let digits = self.text.get(self.at..self.at + 4).filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
        let code = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
        let code = code.ok_or_else(|| self.error("\\u needs four hexadecimal digits"))?;
        self.at += 4;
        Ok(code)
    }

    fn array(&mut self, depth: usize) -> Result<Json, SyntaxError> {
        self.at += 1;
        let mut items = Vec::new();
        self.skip_space();
        if self.peek() == Some(b']') {
            self.at += 1;
            return Ok(Json::Array(items));
        }
        loop {
            items.push(self.value(depth + 1)?);
            if self.ends_list(b']')? {
                return Ok(Json::Array(items));
            }
        }
    }

    fn object(&mut self, depth: usize) -> Result<Json, SyntaxError> {
        self.at += 1;
        let mut members: Vec<Member> = Vec::new();
        self.skip_space();
        if self.peek() == Some(b'}') {
            self.at += 1;
            return Ok(Json::Object(members));
        }
        loop {
            self.skip_space();
            let at = self.at;
            if self.peek() != Some(b'"') {
                return Err(self.error(format!("a field's name in \" is missing: {} here", self.found())));
            }
            let key = self.string()?;
            self.skip_space();
            if self.peek() != Some(b':') {
                return Err(self.error(format!("a : is missing after the field's name: {} here", self.found())));
            }
            self.at += 1;
            let value = self.value(depth + 1)?;
            members.push(Member { at, key, value });
            if self.ends_list(b'}')? {
                break;
            }
        }
        // Most objects are small: there a look at each pair needs no list.
        const SMALL: usize = 8;
        if members.len() <= SMALL && !has_twins(&members) {
            return Ok(Json::Object(members));
        }
        let mut keys: Vec<(&str, usize)> = members.iter().map(|m| (m.key.as_str(), m.at)).collect();
        keys.sort_unstable();
        match keys.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            None => Ok(Json::Object(members)),
            Some(pair) => {
                let (first_line, _) = line_and_column(self.text, pair[0].1);
                Err(SyntaxError {
                    at: pair[1].1,
                    message: format!(
                        "`{}` stands twice in one object, first in line {first_line}; rename or remove one of them",
                        pair[1].0
                    ),
                })
            }
        }
    }

    /// After an item: whether the list ends (true) or goes on (false).
    fn ends_list(&mut self, close: u8) -> Result<bool, SyntaxError> {
        self.skip_space();
        match self.peek() {
            Some(b',') => {
                self.at += 1;
                Ok(false)
            }
            Some(c) if c == close => {
                self.at += 1;
                Ok(true)
            }
            _ => Err(self.error(format!("a , or {} is missing: {} here", close as char, self.found()))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Accepts what serde_json accepts and reads the same value, on texts made of JSON's own characters.
        #[test]
        fn agrees_with_serde_json(text in r#"([\[\]{}:,"0-9eE.\- \\ntu]|true|null|"a":|1e3){0,24}"#) {
            let ours = parse(&text);
            match serde_json::from_str::<serde_json::Value>(&text) {
                Ok(theirs) => match ours {
                    Ok(value) => prop_assert_eq!(value.json.into_plain(), theirs),
                    Err(e) => prop_assert!(e.message.contains("twice"), "{}: {}", text, e.message),
                },
                Err(_) => prop_assert!(ours.is_err(), "{}", text),
            }
        }
    }

    #[test]
    fn nesting_is_bounded() {
        assert!(parse(&"[".repeat(100_000)).is_err());
        assert!(parse(&format!("{}1{}", "[".repeat(60), "]".repeat(60))).is_ok());
    }

    #[test]
    fn values_are_counted() {
        let list = |count: usize| format!("[{}0]", "0,".repeat(count - 1));
        assert!(parse(&list(MAX_VALUES - 1)).is_ok(), "the list is a value, too");
        let error = parse(&list(MAX_VALUES)).unwrap_err();
        assert!(error.message.contains("1000000 values"), "{}", error.message);
    }

    #[test]
    fn a_key_stands_once_in_objects_of_any_size() {
        for count in [2, 8, 9, 100] {
            let keys: Vec<String> = (0..count).map(|i| format!("\"k{}\": 0", i % (count - 1))).collect();
            let error = parse(&format!("{{{}}}", keys.join(","))).unwrap_err();
            assert!(error.message.contains("`k0` stands twice"), "{count}: {}", error.message);
        }
    }

    #[test]
    fn places_count_characters() {
        let text = "{\n \"ä\": x}";
        let error = parse(text).unwrap_err();
        assert_eq!(line_and_column(text, error.at), (2, 7));
    }
}
