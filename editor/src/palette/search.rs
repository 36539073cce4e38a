//! What the palette finds, best first. It knows words only; which nodes are offered is the palette's choice.

use std::cmp::Reverse;

use halfvector_graph::node_def::NodeDef;
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

/// A node that can be added, with the words that it is found by.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Id of the definition, such as `math/mix`.
    pub(crate) id: String,
    /// For people.
    pub(crate) label: String,
    /// `math` of `math/mix`.
    pub(crate) category: String,
    /// Other words for it.
    pub(crate) synonyms: Vec<String>,
    /// What it does.
    pub(crate) help: String,
    lower: Words,
}

#[derive(Clone, Debug)]
struct Words {
    label: String,
    id: String,
    synonyms: Vec<String>,
    help: String,
}

/// Where the words of a search were found: the better the place, the smaller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    LabelStart,
    Label,
    Synonym,
    LooseLabel,
    LooseSynonym,
    Help,
}

impl Entry {
    pub(crate) fn new(def: &NodeDef) -> Entry {
        Entry::of(&def.id, &def.label, def.synonyms.clone(), &def.help)
    }

    /// What is called so, in the category that its id begins with.
    pub(crate) fn of(id: &str, label: &str, synonyms: Vec<String>, help: &str) -> Entry {
        let lower = Words {
            label: label.to_lowercase(),
            id: id.to_lowercase(),
            synonyms: synonyms.iter().map(|word| word.to_lowercase()).collect(),
            help: help.to_lowercase(),
        };
        Entry {
            id: id.to_owned(),
            label: label.to_owned(),
            category: id.split('/').next().unwrap_or_default().to_owned(),
            synonyms,
            help: help.to_owned(),
            lower,
        }
    }
}

/// The entries that a search finds, by their places, best first. Of equal ones those come first that were used last.
pub(crate) fn find(entries: &[Entry], query: &str, recent: &[String], matcher: &mut Matcher) -> Vec<usize> {
    let query = query.trim().to_lowercase();
    let pattern = Pattern::parse(&query, CaseMatching::Ignore, Normalization::Smart);
    let mut found: Vec<(Place, Reverse<u32>, usize, usize, usize)> = Vec::new();
    for (i, entry) in entries.iter().enumerate() {
        if let Some((place, score)) = rank(entry, &query, &pattern, matcher) {
            let used = recent.iter().position(|id| *id == entry.id).unwrap_or(usize::MAX);
            found.push((place, Reverse(score), used, entry.label.len(), i));
        }
    }
    found.sort();
    found.into_iter().map(|(.., i)| i).collect()
}

fn rank(entry: &Entry, query: &str, pattern: &Pattern, matcher: &mut Matcher) -> Option<(Place, u32)> {
    let Words { label, id, synonyms, help } = &entry.lower;
    if label.starts_with(query) {
        return Some((Place::LabelStart, 0));
    }
    if contains_words(label, query) {
        return Some((Place::Label, 0));
    }
    if contains_words(id, query) || synonyms.iter().any(|word| contains_words(word, query)) {
        return Some((Place::Synonym, 0));
    }
    let mut buffer = Vec::new();
    let mut loose = |text: &str| pattern.score(Utf32Str::new(text, &mut buffer), matcher);
    // Letters that lie far apart make nearly every word fit: they must come close to a match in one piece.
    let least = query.chars().filter(|c| !c.is_whitespace()).count() as u32 * 18;
    if let Some(score) = loose(label).filter(|score| *score >= least) {
        return Some((Place::LooseLabel, score));
    }
    if let Some(score) = synonyms.iter().filter_map(|word| loose(word)).max().filter(|score| *score >= least) {
        return Some((Place::LooseSynonym, score));
    }
    contains_words(help, query).then_some((Place::Help, 0))
}

/// Whether each word of a query stands in a text, at the start of one of its words or with three letters or more anywhere.
fn contains_words(text: &str, query: &str) -> bool {
    query.split_whitespace().all(|word| {
        text.match_indices(word).any(|(at, _)| {
            word.len() >= 3 || text[..at].chars().next_back().is_none_or(|before| !before.is_alphanumeric())
        })
    })
}

/// A matcher for words of the palette.
pub(crate) fn matcher() -> Matcher {
    Matcher::new(Config::DEFAULT)
}
