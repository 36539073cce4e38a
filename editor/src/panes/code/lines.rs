//! The lines of a text and where each comes from.

use std::ops::Range;

use halfvector_codegen::{Origin, Segment};

/// A line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Line {
    /// Its bytes, without the end of line.
    pub(super) bytes: Range<usize>,
    /// Where it comes from: of several the first node, or the first of all.
    pub(super) origin: Option<Origin>,
}

/// Cuts a text into lines. Both lists are in order, so one walk does.
pub(super) fn lines(text: &str, segments: &[Segment]) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut start = 0;
    let mut first = 0;
    for line in text.split('\n') {
        let end = start + line.len();
        while segments.get(first).is_some_and(|segment| segment.end <= start) {
            first += 1;
        }
        let here = || segments[first.min(segments.len())..].iter().take_while(|segment| segment.start < end);
        let is_written = |segment: &&Segment| {
            text.get(segment.start.max(start)..segment.end.min(end)).is_some_and(|part| !part.trim().is_empty())
        };
        let node = here().filter(is_written).find(|segment| matches!(segment.origin, Origin::Node(_)));
        let origin = node.or_else(|| here().find(is_written)).map(|segment| segment.origin.clone());
        lines.push(Line { bytes: start..line.trim_end_matches('\r').len() + start, origin });
        start = end + 1;
    }
    lines
}
