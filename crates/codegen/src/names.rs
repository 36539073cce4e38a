//! The namer: every name in generated WGSL that a document has a say in comes from here. Labels are anyone's text, in any
//! script; what leaves this file is an identifier of ASCII letters, digits and `_` that is free, or a comment that ends
//! where its line ends.

use std::collections::{HashMap, HashSet};
use std::sync::OnceLock;

use crate::link::Index;

/// Names of the frame that codegen writes around the nodes.
const FRAME: &[&str] = &[
    "in",
    "out",
    "view",
    "lights",
    "parameters",
    "object",
    "context",
    "View",
    "Lights",
    "Parameters",
    "Object",
    "Context",
    "VertexInput",
    "Varyings",
    "vs_main",
    "fs_main",
    "material",
    "front_facing",
    "prefiltered_radiance",
    "irradiance_over_pi",
    "dfg_table",
    "linear_clamp",
    "world_position",
    "surface_position",
    "object_position",
    "clip_position",
    "world_normal",
    "world_tangent",
    "view_dir",
    "normal",
    "frame",
    "diffuse",
    "specular",
    "dfg",
    "light_dfg",
    "directional_light_dfg",
    "point_light_dfg",
    "spot_light_dfg",
    "compensation",
    "tangent",
    "strip",
    "strips",
    "behind",
    "mirror_dir",
    "geometric_normal",
    "horizon",
    "transmission",
    "transmission_gain",
    "transmitted",
    "coat",
    "coat_frame",
    "coat_dfg",
    "coat_mirror_dir",
    "coat_reflection",
    "coat_geometric_normal",
    "coat_horizon",
    "sheen",
    "sheen_around",
    "sheen_middle",
    "under_coat",
    "under_sheen",
    "lit",
    "directional_lit",
    "point_lit",
    "spot_lit",
    "reflected",
    "lookup",
    "seen",
    "weight",
    "alphas",
    "specular_roughness",
    "film",
    "film_cosine",
    "film_lit",
    "film_shift",
    "dielectric_shift",
    "film_through",
    "light_film",
    "directional_light_film",
    "point_light_film",
    "spot_light_film",
    "multiscatter",
    "coupling",
    "light",
    "radiance",
    "irradiance",
    "reflection",
    "reflection_dir",
    "directional_light",
    "point_light",
    "spot_light",
    "displaced_position",
    "occlusion",
    "opacity",
    "display",
    "handedness",
    "i",
];

/// Longest name made of a label.
const MAX_LENGTH: usize = 48;

/// Gives each thing a name of its own.
pub(crate) struct Namer<'i> {
    index: &'i Index,
    taken: HashSet<String>,
    /// By base: the last number appended.
    numbers: HashMap<String, u32>,
    scope: Scope,
}

/// Where names must be free.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scope {
    /// Beside the library, the frame and WGSL itself.
    Module,
    /// Among the members of a struct: only WGSL's keywords are in the way.
    Members,
}

impl<'i> Namer<'i> {
    /// For module-scope and local names.
    pub(crate) fn new(index: &'i Index) -> Self {
        Namer { index, taken: HashSet::new(), numbers: HashMap::new(), scope: Scope::Module }
    }

    /// For the members of one struct.
    pub(crate) fn of_members(index: &'i Index) -> Self {
        Namer { index, taken: HashSet::new(), numbers: HashMap::new(), scope: Scope::Members }
    }

    /// A free name like `wished`, or like `otherwise` when nothing of `wished` can be kept.
    pub(crate) fn name(&mut self, wished: &str, otherwise: &str) -> String {
        let mut base = identifier(wished);
        if base.is_empty() {
            base = identifier(otherwise);
        }
        if base.is_empty() {
            base = "value".into();
        }
        if base.starts_with(|c: char| c.is_ascii_digit()) {
            base.insert_str(0, "n_");
        }
        if self.scope == Scope::Module && base.starts_with("node_") {
            base.insert_str(0, "n_");
        }
        let mut name = base.clone();
        // Where the last one of this base ended: ten thousand nodes may have one label.
        let mut number = self.numbers.get(&base).copied().unwrap_or(1);
        while self.is_taken(&name) {
            number += 1;
            name = format!("{base}_{number}");
        }
        self.numbers.insert(base, number);
        self.taken.insert(name.clone());
        name
    }

    /// `wished` itself where it is a free identifier, else a free name like it.
    pub(crate) fn exact(&mut self, wished: &str) -> String {
        let letters = wished.chars().all(|c| c == '_' || c.is_ascii_alphanumeric());
        let begins = wished.starts_with(|c: char| c.is_ascii_alphabetic());
        if letters && begins && wished.len() <= MAX_LENGTH && !self.is_taken(wished) {
            self.taken.insert(wished.to_owned());
            return wished.to_owned();
        }
        self.name(wished, "parameter")
    }

    fn is_taken(&self, name: &str) -> bool {
        self.taken.contains(name)
            || keywords().contains(name)
            || (self.scope == Scope::Module && (own_words().contains(name) || self.index.has(name)))
    }
}

/// Words that WGSL reserves.
fn keywords() -> &'static HashSet<&'static str> {
    static WORDS: OnceLock<HashSet<&'static str>> = OnceLock::new();
    WORDS.get_or_init(|| naga::keywords::wgsl::RESERVED.iter().copied().collect())
}

/// Names of the frame, and WGSL's built-in functions and types.
fn own_words() -> &'static HashSet<&'static str> {
    static WORDS: OnceLock<HashSet<&'static str>> = OnceLock::new();
    WORDS.get_or_init(|| {
        let types = ["vec2f", "vec3f", "vec4f", "mat3x3f", "mat4x4f", "texture_2d", "texture_cube"];
        FRAME.iter().chain(naga::keywords::wgsl::BUILTIN_IDENTIFIERS).copied().chain(types).collect()
    })
}

/// Lower snake case of the ASCII letters and digits in a text: `Rust (old) Höhe 2` is `rust_old_h_he_2`. Runs of anything
/// else are one `_`; a text of more foreign letters than ASCII ones gives nothing, since what is left would mislead.
fn identifier(text: &str) -> String {
    let foreign = text.chars().filter(|c| c.is_alphabetic() && !c.is_ascii()).count();
    let own = text.chars().filter(char::is_ascii_alphanumeric).count();
    if foreign > own {
        return String::new();
    }
    let mut name = String::new();
    let mut previous_lower = false;
    for c in text.chars() {
        if c.is_ascii_alphanumeric() {
            if c.is_ascii_uppercase() && previous_lower {
                name.push('_');
            }
            name.push(c.to_ascii_lowercase());
            previous_lower = c.is_ascii_lowercase() || c.is_ascii_digit();
        } else {
            if !name.is_empty() && !name.ends_with('_') {
                name.push('_');
            }
            previous_lower = false;
        }
        if name.len() >= MAX_LENGTH {
            break;
        }
    }
    name.truncate(name.trim_end_matches('_').len());
    name
}

/// A text that is safe inside a line comment: one line (every line break that WGSL, GLSL or a terminal knows becomes a
/// space), no control or direction-changing characters, not ending in a backslash (a C preprocessor would go on to the
/// next line), and no `*/` or `/*` for those who wrap it.
pub(crate) fn comment(text: &str) -> String {
    const MAX_CHARS: usize = 200;
    let mut safe = String::new();
    for c in text.chars().take(MAX_CHARS) {
        match c {
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200b}'..='\u{200f}' | '\u{feff}' => {}
            '\u{2028}' | '\u{2029}' => safe.push(' '),
            '\\' => safe.push('/'),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe.replace("*/", "* /").replace("/*", "/ *").trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_free_identifiers() {
        let mut namer = Namer::new(Index::standard());
        let mut name = |wished: &str| namer.name(wished, "node_7");
        assert_eq!(name("Base Color"), "base_color");
        assert_eq!(name("Base Color"), "base_color_2");
        assert_eq!(name("baseColor"), "base_color_3");
        assert_eq!(name("2nd layer"), "n_2nd_layer");
        assert_eq!(name("mix"), "mix_2", "a built-in");
        assert_eq!(name("let"), "let_2", "a keyword");
        assert_eq!(name("d_ggx"), "d_ggx_2", "the library's");
        assert_eq!(name("vec3f"), "vec3f_2", "a type");
        assert_eq!(name("__x__"), "x");
        assert_eq!(name("金属"), "n_node_7");
        assert_eq!(name(""), "n_node_7_2");
        assert_eq!(name("ржавчина rust; discard"), "rust_discard");
        assert!(name(&"a".repeat(9999)).len() < 60);
    }

    #[test]
    fn comments_end_where_their_line_ends() {
        assert_eq!(comment("a\nb\r\nc\u{85}d\u{2028}e\u{b}f"), "a b  c d e f");
        assert_eq!(comment("x */ discard; /* y \\"), "x * / discard; / * y /");
        assert_eq!(comment("a\u{202e}b"), "ab");
    }
}
