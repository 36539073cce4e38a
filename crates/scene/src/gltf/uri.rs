//! URIs of glTF files: `data:` and paths relative to the file. Others, and absolute paths, are refused.

/// What a URI means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Uri {
    /// The bytes themselves.
    Data(Vec<u8>),
    /// A path relative to the file, percent-decoded, with `/` between its parts.
    Relative {
        path: String,
        /// It leads above the file's folder.
        leaves_folder: bool,
    },
}

/// Reads a URI; the error says what is wrong with it.
pub(super) fn parse(uri: &str) -> Result<Uri, String> {
    if let Some(rest) = uri.strip_prefix("data:") {
        let (header, data) = rest.split_once(',').ok_or("the data: URI has no comma before its data")?;
        return if header.ends_with(";base64") { base64(data).map(Uri::Data) } else { percent(data).map(Uri::Data) };
    }
    if let Some((scheme, _)) = uri.split_once(':').filter(|(s, _)| is_scheme(s)) {
        return Err(format!("the URI begins with `{scheme}:`; only data: and paths relative to the file are read"));
    }
    let path = String::from_utf8(percent(uri)?).map_err(|_| format!("the path `{uri}` is no UTF-8"))?;
    let path = path.replace('\\', "/");
    if path.starts_with('/') {
        return Err(format!("the path `{path}` is absolute; paths are relative to the file"));
    }
    if path.is_empty() || path.contains('\0') {
        return Err("the path names no file".into());
    }
    let mut depth = 0i64;
    let mut leaves_folder = false;
    for part in path.split('/') {
        match part {
            ".." => depth -= 1,
            "" | "." => {}
            _ => depth += 1,
        }
        leaves_folder |= depth < 0;
    }
    Ok(Uri::Relative { path, leaves_folder })
}

fn is_scheme(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'))
}

/// RFC 3986, section 2.1.
fn percent(text: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digits = [rest.next(), rest.next()].map(|b| b.and_then(|b| char::from(b).to_digit(16)));
        let [Some(high), Some(low)] = digits else {
            return Err("a % in the URI is not followed by two hexadecimal digits".into());
        };
        bytes.push((high * 16 + low) as u8);
    }
    Ok(bytes)
}

/// RFC 4648, section 4; padding may be missing.
fn base64(text: &str) -> Result<Vec<u8>, String> {
    let text = text.trim_end_matches('=').as_bytes();
    if text.len() % 4 == 1 {
        return Err("the base64 data is cut off".into());
    }
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0u32;
        for &letter in group {
            let value = match letter {
                b'A'..=b'Z' => letter - b'A',
                b'a'..=b'z' => letter - b'a' + 26,
                b'0'..=b'9' => letter - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                _ => return Err(format!("`{}` is no base64 letter", char::from(letter).escape_default())),
            };
            bits = bits << 6 | u32::from(value);
        }
        bits <<= 6 * (4 - group.len());
        bytes.extend_from_slice(&bits.to_be_bytes()[1..group.len()]);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relative(path: &str, leaves_folder: bool) -> Result<Uri, String> {
        Ok(Uri::Relative { path: path.into(), leaves_folder })
    }

    #[test]
    fn data_is_decoded() {
        // RFC 4648, section 10.
        for (text, bytes) in
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg", "foob"), ("Zm9vYmFy", "foobar")]
        {
            let uri = parse(&format!("data:application/octet-stream;base64,{text}"));
            assert_eq!(uri, Ok(Uri::Data(bytes.into())), "{text}");
        }
        assert_eq!(parse("data:text/plain,a%20b"), Ok(Uri::Data(b"a b".to_vec())));
        assert!(parse("data:;base64,Z").unwrap_err().contains("cut off"));
        assert!(parse("data:;base64,Z!==").unwrap_err().contains("`!`"));
        assert!(parse("data:nothing").unwrap_err().contains("comma"));
    }

    #[test]
    fn paths_stay_relative() {
        assert_eq!(parse("a%20b/c.png"), relative("a b/c.png", false));
        assert_eq!(parse("a/../b.bin"), relative("a/../b.bin", false));
        assert_eq!(parse("../b.bin"), relative("../b.bin", true));
        assert_eq!(parse("a/../../b.bin"), relative("a/../../b.bin", true));
        assert!(parse("a:b").unwrap_err().contains("`a:`"));
        for wrong in
            ["/etc/passwd", "%2Fetc/passwd", "C:\\x.bin", "https://example.com/x", "file:///x", "", "a%2", "%00"]
        {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(parse("..\\b.bin"), relative("../b.bin", true));
    }
}
