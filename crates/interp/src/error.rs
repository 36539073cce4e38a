//! What can go wrong, in the words of the person who wrote the shader.

use std::fmt;
use std::ops::Range;

/// A place in a shader: a function, and the bytes of the text where naga knows them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Name of the function or entry point; empty for the module's own constants.
    pub function: String,
    /// Bytes of the text that was parsed.
    pub span: Option<Range<usize>>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.function {
            name if name.is_empty() => write!(f, "a constant of the module"),
            name => write!(f, "`{name}`"),
        }
    }
}

/// Why a function cannot be compiled for the CPU. It is said before anything runs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unsupported {
    /// The module has nothing of this name.
    #[error("the module has no {kind} `{name}`")]
    Missing {
        /// "function" or "entry point".
        kind: &'static str,
        /// What was asked for.
        name: String,
    },
    /// The function uses something that this interpreter does not do.
    #[error("{place} uses {what}, which cannot run on the CPU: {instead}")]
    Feature {
        /// In the language of WGSL.
        what: String,
        /// What to write in its place.
        instead: &'static str,
        /// Where it is used.
        place: Place,
    },
    /// With all of its calls put in place the function is larger than the limit.
    #[error("{place} has more than {limit} {what}: use smaller arrays or fewer nested calls")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        limit: usize,
        /// Where the limit was passed.
        place: Place,
    },
}

/// What to write in the place of what is not supported: by a word that names it, the first that fits.
const INSTEAD: [(&str, &str); 21] = [
    ("the type i", "use i32"),
    ("the type u", "use u32"),
    ("the type f", "use f32"),
    ("an f64", "use f32"),
    ("atomic", "invocations run side by side and share nothing; give each its own result"),
    ("workgroup memory", "invocations run side by side and share nothing; compute it in each"),
    ("a barrier", "invocations run side by side and share nothing; compute it in each"),
    ("subgroup", "invocations run side by side and share nothing; compute it in each"),
    ("depth texture", "read a texture_2d<f32> and compare in the shader"),
    ("multisampled", "read a texture_2d<f32>, resolved before"),
    ("texture of integers", "read a texture_2d<f32> or a buffer"),
    ("storage texture", "read a texture_2d<f32>, and give what is computed as the result"),
    ("writing to a texture", "give it as the result, or write it to a buffer"),
    ("external texture", "read a texture_2d<f32>"),
    ("texture offset", "add it to the coordinates"),
    ("not a global variable", "name the binding itself where it is read"),
    ("runtime-sized array", "read its elements one by one"),
    ("override constant", "write the number as a `const`"),
    ("arrays of bindings", "use one binding for each"),
    ("no binding", "give it @group and @binding, or make it an argument"),
    ("scalars", "use a smaller array"),
];

impl Unsupported {
    pub(crate) fn feature(what: String, place: Place) -> Unsupported {
        let known = INSTEAD.iter().find(|(word, _)| what.contains(word)).map(|(_, instead)| *instead);
        Unsupported::Feature { what, instead: known.unwrap_or("compute it another way"), place }
    }
}

/// Why a run ended without a result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RunError {
    /// A loop did not end.
    #[error("a loop in {place} did not end within {limit} steps: it may be endless")]
    Steps {
        /// Most instructions that one batch may take.
        limit: u64,
        /// The function that the loop is in.
        place: Place,
    },
    /// The registers of one batch need more memory than allowed.
    #[error("the program needs {needed} bytes for one batch, and {limit} are allowed: use smaller arrays")]
    Memory {
        /// Bytes of all registers.
        needed: u64,
        /// Bytes that are allowed.
        limit: u64,
    },
    /// An input column is missing, has the wrong kind of numbers or too few.
    #[error("input {index} (`{name}`) {reason}")]
    Input {
        /// Index in [`crate::Program::inputs`].
        index: usize,
        /// Its path.
        name: String,
        /// What is the matter.
        reason: &'static str,
    },
    /// A resource that the program reads is missing or does not fit its declaration.
    #[error("the resource `{name}` at @group({group}) @binding({binding}) {reason}")]
    Resource {
        /// Name of the global variable.
        name: String,
        /// Its group.
        group: u32,
        /// Its binding.
        binding: u32,
        /// What is the matter.
        reason: &'static str,
    },
}
