//! What the list of methods says of a term: its help, its default, the form of the report that started the project.

use halfvector_graph::method::term;

/// What a term stands for; of the terms that have no choice of methods, too.
pub(crate) fn help(name: &str) -> &'static str {
    match name {
        "energy" => "what the whole material reflects",
        "normal_blend" => "a detail normal map over a base",
        "normal_mips" => "smaller levels of normal maps",
        "normal_frame" => "normal maps on meshes",
        "peer" => "other programs at the same work",
        "picture" => "whole pictures, against the reference",
        "precision" => "what a number format does to the hard cases",
        "sheen" => "cloth",
        "specular" => "the whole specular lobe",
        "split_sum" => "what the split sum itself leaves out",
        _ => term(name).map_or("", |term| term.help),
    }
}

/// Whether the method is what is taken when nothing is chosen.
pub(crate) fn is_default(name: &str, method: &str) -> bool {
    term(name).is_some_and(|term| term.methods[0].name == method)
}

/// Whether the method is that of the report that started the project.
pub(crate) fn is_report(name: &str, method: &str) -> bool {
    term(name).is_some_and(|term| term.report == method)
}
