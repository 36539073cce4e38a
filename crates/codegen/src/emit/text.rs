//! Text that remembers where each part of it comes from.

use std::ops::Range;

use halfvector_graph::document::NodeId;

/// Where a part of a shader comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A node of the document.
    Node(NodeId),
    /// A file of the shader library, such as `brdf/ggx.wgsl`, or a function of the document, such as `custom/stripes`.
    Library(String),
    /// What codegen writes around them: interface, transforms, lighting.
    Frame,
}

/// A part of a shader and where it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// First byte in [`crate::Shader::wgsl`].
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// Where it comes from.
    pub origin: Origin,
}

impl Segment {
    /// Its bytes.
    pub fn range(&self) -> Range<usize> {
        self.start..self.end
    }
}

/// Text under construction. Its segments follow each other without gaps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Text {
    pub(crate) text: String,
    pub(crate) segments: Vec<Segment>,
}

impl Text {
    pub(crate) fn push(&mut self, origin: Origin, part: &str) {
        let start = self.text.len();
        self.text.push_str(part);
        let end = self.text.len();
        match self.segments.last_mut() {
            Some(last) if last.origin == origin => last.end = end,
            _ if end > start => self.segments.push(Segment { start, end, origin }),
            _ => {}
        }
    }

    /// A line of the frame.
    pub(crate) fn line(&mut self, line: &str) {
        self.push(Origin::Frame, line);
        self.push(Origin::Frame, "\n");
    }

    pub(crate) fn append(&mut self, other: &Text) {
        for segment in &other.segments {
            self.push(segment.origin.clone(), &other.text[segment.range()]);
        }
    }
}
