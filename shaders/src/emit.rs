//! The text of an item as it stands in a shader that is taken away: names exchanged, and the lines of the doc comment
//! that only the editor reads left out.

use std::borrow::Cow;

use crate::slicer::Item;

/// The text of an item with its comments, each name exchanged for what `rename` returns (`None`: it stays), and
/// without the grammar lines of [`without_grammar`]. `rename` is asked for the item's own name and for each reference.
///
/// Locals and members keep their names; a new name that equals a local's is the caller's mistake (naga then reports it).
pub fn emit(source: &str, item: &Item, rename: impl Fn(&str) -> Option<String>) -> String {
    let mut text = without_grammar(&source[item.start..item.code_start]).into_owned();
    let mut at = item.code_start;
    let mut names: Vec<_> = item.references.iter().chain([&item.name_range]).collect();
    names.sort_unstable_by_key(|range| range.start);
    for range in names {
        let old = &source[range.clone()];
        text.push_str(&source[at..range.start]);
        match rename(old) {
            Some(new) => text.push_str(&new),
            None => text.push_str(old),
        }
        at = range.end;
    }
    text.push_str(&source[at..item.end]);
    text
}

/// Leaves out of `///` lines what is said to the editor: lines that begin with `@` or with `- name:`, and the indented
/// ones that carry those on. The label, help, equations and sources stay; the blank lines around what went are drawn
/// together. Other lines stay as they are.
pub fn without_grammar(comment: &str) -> Cow<'_, str> {
    if !comment.lines().any(is_grammar) {
        return Cow::Borrowed(comment);
    }
    let mut kept: Vec<&str> = Vec::new();
    let (mut dropped, mut in_entry) = (false, false);
    for line in comment.split_inclusive('\n') {
        if is_grammar(line) || (in_entry && line.trim_start().starts_with("///   ")) {
            dropped = true;
            in_entry = true;
            continue;
        }
        in_entry = false;
        let blank = line.trim() == "///";
        if dropped && blank && kept.last().is_none_or(|last| last.trim() == "///") {
            continue;
        }
        // A blank doc line at the end of the block separated the help from the grammar.
        if !line.trim_start().starts_with("///") {
            drop_blank_end(&mut kept);
        }
        dropped = dropped && blank;
        kept.push(line);
    }
    drop_blank_end(&mut kept);
    Cow::Owned(kept.concat())
}

fn drop_blank_end(lines: &mut Vec<&str>) {
    while lines.last().is_some_and(|line| line.trim() == "///") {
        lines.pop();
    }
}

/// Whether a line of a doc comment speaks to the editor.
fn is_grammar(line: &str) -> bool {
    let Some(content) = line.trim_start().strip_prefix("///") else { return false };
    let content = content.trim_start();
    content.starts_with('@')
        || content
            .strip_prefix("- ")
            .and_then(|rest| rest.split_once(':'))
            .is_some_and(|(name, _)| !name.is_empty() && name.chars().all(|c| c == '_' || c.is_ascii_alphanumeric()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slicer::slice;

    const SOURCE: &str = "/// Mix\n///\n/// a at t = 0.\n/// - no argument, a list\n/// @node math/mix  @also lerp\n\
                          /// - a: first,\n///   and more of it [0]\n/// - t: weight [0.5; 0..1]\n/// - return: the mix\n\
                          fn node_math_mix(a: T, T2: f32) -> T {\n    // keep\n    let d_ggx = d_ggx(a.T);\n    return mix(T(d_ggx), d_ggx);\n}\n";

    #[test]
    fn grammar_goes_and_help_stays() {
        let item = &slice(SOURCE).unwrap()[0];
        let text = emit(SOURCE, item, |name| match name {
            "T" => Some("vec3f".into()),
            "node_math_mix" => Some("node_math_mix_vec3f".into()),
            "d_ggx" => Some("d_other".into()),
            _ => None,
        });
        assert_eq!(
            text,
            "/// Mix\n///\n/// a at t = 0.\n/// - no argument, a list\n\
             fn node_math_mix_vec3f(a: vec3f, T2: f32) -> vec3f {\n    // keep\n    let d_ggx = d_other(a.T);\n    \
             return mix(vec3f(d_ggx), d_ggx);\n}"
        );
    }

    #[test]
    fn blank_lines_are_drawn_together() {
        assert_eq!(without_grammar("/// A\n///\n/// @node a/b\n///\n/// Source.\n"), "/// A\n///\n/// Source.\n");
        assert_eq!(
            without_grammar("/// A\n///\n/// help\n///\n/// @node a/b\n/// - x: y [0]\n"),
            "/// A\n///\n/// help\n"
        );
        assert_eq!(without_grammar("// A\n\n// @b\n"), "// A\n\n// @b\n");
    }
}
