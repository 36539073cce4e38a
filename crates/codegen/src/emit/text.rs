//! Text that remembers where each part of it comes from.

use std::ops::Range;

use halfvector_graph::document::NodeId;

use super::tidy::without_identities;

/// Where a part of a shader comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A node of the document.
    Node(NodeId),
    /// A file of the shader library, such as `brdf/ggx.wgsl`, or a function of the document, such as `custom/stripes`.
    Library(String),
    /// What codegen writes around them.
    Frame(Part),
}

/// A part of what codegen writes around nodes and library.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// The comment at the top.
    #[default]
    Header,
    /// Uniforms, textures and samplers.
    Bindings,
    /// What the vertex stage is fed, and what it hands to the fragment stage.
    Interface,
    /// The vertex stage.
    Vertex,
    /// The fragment stage's beginning and end, and what it discards.
    Fragment,
    /// The shading frame, the lobes' parameters, and what scales them.
    Lobes,
    /// What the lobes reflect of lights.
    Lights,
    /// What the lobes reflect of the environment.
    Environment,
    /// Emission, exposure, tone map and opacity: what is returned.
    Output,
    /// The function that a material alone is, and its context.
    Material,
}

impl Part {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Part::Header => "header",
            Part::Bindings => "bindings",
            Part::Interface => "interface",
            Part::Vertex => "vertex",
            Part::Fragment => "fragment",
            Part::Lobes => "lobes",
            Part::Lights => "lights",
            Part::Environment => "environment",
            Part::Output => "output",
            Part::Material => "material",
        }
    }

    /// What it is, for people.
    pub fn help(self) -> &'static str {
        match self {
            Part::Header => "What the shader serves, and what was left out",
            Part::Bindings => "Uniforms, textures and samplers",
            Part::Interface => "What goes to the vertex stage, and from there to the fragment stage",
            Part::Vertex => "The vertex stage",
            Part::Fragment => "The fragment stage",
            Part::Lobes => "The surface's lobes: their frame and parameters",
            Part::Lights => "What the lobes reflect of lights",
            Part::Environment => "What the lobes reflect of the environment",
            Part::Output => "What is returned: emission, exposure, tone map, opacity",
            Part::Material => "The material as a function",
        }
    }
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
    /// What the next lines of the frame are part of.
    pub(crate) part: Part,
}

impl Text {
    /// Text that begins with lines of a part of the frame.
    pub(crate) fn of(part: Part) -> Text {
        Text { part, ..Text::default() }
    }

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
        self.push(Origin::Frame(self.part), &without_identities(line));
        self.push(Origin::Frame(self.part), "\n");
    }

    pub(crate) fn append(&mut self, other: &Text) {
        for segment in &other.segments {
            self.push(segment.origin.clone(), &other.text[segment.range()]);
        }
    }
}
