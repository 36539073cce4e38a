//! The page's text: what comes from documents put into the template so that it stays text and data.

use serde_json::Value;

/// The template; `{TITLE}`, `{SCENE}` and `{VIEWER}` stand for what is put in.
const TEMPLATE: &str = include_str!("page.html");
/// The script.
const VIEWER: &str = include_str!("viewer.js");

/// The page of a scene.
pub(crate) fn page(title: &str, scene: &Value) -> String {
    let title = if title.trim().is_empty() { "Halfvector" } else { title };
    let parts = [("{TITLE}", escaped_text(title)), ("{SCENE}", escaped_json(scene)), ("{VIEWER}", VIEWER.to_owned())];
    // One walk over the template: what is put in is not searched again.
    let mut page = String::new();
    let mut rest = TEMPLATE;
    while let Some((at, (place, text))) =
        parts.iter().filter_map(|part| Some((rest.find(part.0)?, part))).min_by_key(|(at, _)| *at)
    {
        page.push_str(&rest[..at]);
        page.push_str(text);
        rest = &rest[at + place.len()..];
    }
    page.push_str(rest);
    page
}

/// Text for the content of an HTML element.
fn escaped_text(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            // What HTML does not take as text.
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// JSON for the content of a script element: the characters that could end it or open another stand as escapes. In JSON
/// they occur within strings alone, where an escape means the same.
fn escaped_json(value: &Value) -> String {
    let text = value.to_string();
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => escaped.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// Names that would break out of markup, strings, comments and templates.
    const HOSTILE: &[&str] = &[
        "</script><script>hacked()</script>",
        "</title><img src=x onerror=hacked()>",
        "<!--<script>",
        "]]>\"'`${hacked()}\\",
        "*/ hacked() /*\n// \r\n",
        "{SCENE}{VIEWER}{TITLE}",
        "\u{2028}hacked()\u{2029}\u{0}\u{1b}",
        "&lt;script&gt;",
    ];

    fn data(page: &str) -> &str {
        let open = "<script type=\"application/json\" id=\"scene\">";
        let start = page.find(open).expect("the data") + open.len();
        &page[start..start + page[start..].find("</script>").expect("its end")]
    }

    #[test]
    fn names_stay_text_and_data() {
        let plain = page("plain", &json!({ "label": "plain" }));
        for name in HOSTILE {
            let value = json!({ "label": name, *name: [name] });
            let page = page(name, &value);
            for tag in ["<script", "</script", "<img", "<!--", "</title"] {
                assert_eq!(page.matches(tag).count(), plain.matches(tag).count(), "{tag} by {name:?}");
            }
            let read: Value = serde_json::from_str(data(&page)).expect("JSON");
            assert_eq!(read, value, "the data are what they were");
        }
    }

    #[test]
    fn the_page_asks_for_nothing_from_elsewhere() {
        let page = page("plain", &json!({}));
        for asks in ["http:", "https:", "//cdn", "src=", "href=", "import(", "fetch("] {
            assert!(!page.contains(asks), "{asks}");
        }
        assert!(page.contains("default-src 'none'"));
        assert_eq!(VIEWER.matches("</script").count(), 0, "the script would end there");
    }

    #[test]
    fn a_page_has_a_title_whatever_the_scene_is_called() {
        assert!(page(" ", &json!({})).contains("<title>Halfvector</title>"));
        assert!(page("a < b", &json!({})).contains("<title>a &lt; b</title>"));
    }
}
