//! Words of other languages and of hurry, and what they are in WGSL.

use crate::check::words::nearest;
use crate::library::borrowed;
use crate::library::signature::wgsl_names;

/// Words of other shading languages: what to write.
const ELSEWHERE: [(&str, &str); 62] = [
    ("float", "`f32`"),
    ("double", "`f32`"),
    ("half", "`f32`"),
    ("int", "`i32`"),
    ("uint", "`u32`"),
    ("float2", "`vec2f`"),
    ("float3", "`vec3f`"),
    ("float4", "`vec4f`"),
    ("half2", "`vec2f`"),
    ("half3", "`vec3f`"),
    ("half4", "`vec4f`"),
    ("ivec2", "`vec2i`"),
    ("ivec3", "`vec3i`"),
    ("ivec4", "`vec4i`"),
    ("uvec2", "`vec2u`"),
    ("uvec3", "`vec3u`"),
    ("uvec4", "`vec4u`"),
    ("bvec2", "`vec2<bool>`"),
    ("bvec3", "`vec3<bool>`"),
    ("bvec4", "`vec4<bool>`"),
    ("mat2", "`mat2x2f`"),
    ("mat3", "`mat3x3f`"),
    ("mat4", "`mat4x4f`"),
    ("float2x2", "`mat2x2f`"),
    ("float3x3", "`mat3x3f`"),
    ("float4x4", "`mat4x4f`"),
    ("lerp", "`mix`"),
    ("frac", "`fract`"),
    ("rsqrt", "`inverseSqrt`"),
    ("inversesqrt", "`inverseSqrt`"),
    ("rcp", "`1.0 / x`"),
    ("mad", "`fma`"),
    ("mod", "`a % b`"),
    ("fmod", "`a % b`"),
    ("mul", "`a * b`"),
    ("sqr", "`x * x`"),
    ("square", "`x * x`"),
    ("log10", "`log(x) * 0.4342945`"),
    ("cbrt", "`pow(x, 1.0 / 3.0)`"),
    ("texture", "`textureSampleLevel`"),
    ("texture2D", "`textureSampleLevel`"),
    ("tex2D", "`textureSampleLevel`"),
    ("textureLod", "`textureSampleLevel`"),
    ("tex2Dlod", "`textureSampleLevel`"),
    ("texelFetch", "`textureLoad`"),
    ("not", "`!`"),
    ("lessThan", "`a < b`"),
    ("lessThanEqual", "`a <= b`"),
    ("greaterThan", "`a > b`"),
    ("greaterThanEqual", "`a >= b`"),
    ("equal", "`a == b`"),
    ("notEqual", "`a != b`"),
    ("M_PI", "the library's `PI`"),
    ("Pi", "the library's `PI`"),
    ("pi", "the library's `PI`"),
    ("TAU", "`2.0 * PI`"),
    ("TWO_PI", "`2.0 * PI`"),
    ("M_PI_2", "`0.5 * PI`"),
    ("vec2", "`vec2f`"),
    ("vec3", "`vec3f`"),
    ("vec4", "`vec4f`"),
    ("null", "`0.0`"),
];

/// WGSL's short names of types.
const SHORT: [&str; 18] = [
    "vec2f", "vec3f", "vec4f", "vec2i", "vec3i", "vec4i", "vec2u", "vec3u", "vec4u", "mat2x2f", "mat2x3f", "mat2x4f",
    "mat3x2f", "mat3x3f", "mat3x4f", "mat4x2f", "mat4x3f", "mat4x4f",
];

/// What a word of another language is in WGSL, in the words of a message.
pub(super) fn elsewhere(word: &str) -> Option<&'static str> {
    ELSEWHERE.iter().find(|(other, _)| *other == word).map(|(_, ours)| *ours)
}

/// Whether a word is a type, of WGSL or of another language.
pub(super) fn is_type(word: &str) -> bool {
    let stem = word.trim_end_matches(|c: char| c.is_ascii_digit() || matches!(c, 'x' | 'f' | 'i' | 'u' | 'h'));
    matches!(
        stem,
        "vec" | "mat" | "flo" | "float" | "int" | "uint" | "half" | "double" | "auto" | "ivec" | "uvec" | "bvec"
    ) || matches!(word, "f32" | "i32" | "u32" | "bool" | "array" | "float" | "int" | "uint" | "auto" | "sampler2D")
}

/// Whether a word is one of WGSL's functions.
pub(super) fn is_function(word: &str) -> bool {
    wgsl_names().any(|name| name == word) && !is_type(word)
}

/// What is said of a name that is not known.
pub(super) fn unknown(word: &str, is_called: bool) -> String {
    if !is_called && matches!(word, "texture2D" | "sampler2D" | "Texture2D" | "texture") {
        return format!(
            "there is no `{word}`; a picture is an argument such as `image: texture_2d<f32>`, with `image_sampler: sampler`"
        );
    }
    // What it is in another language comes before what is spelt alike.
    if let Some(ours) = elsewhere(word) {
        return format!("there is no `{word}`; did you mean {ours}?");
    }
    if matches!(word, "ddx" | "ddy" | "dFdx" | "dFdy") {
        return format!("there is no `{word}`, and a node may stand in a branch, where pixels beside are not known");
    }
    if let Some(said) = input(word).filter(|_| !is_called) {
        return format!(
            "there is no `{word}`; what a node reads are its arguments: wire it to one, or give one a context, such as `{said}`"
        );
    }
    let names = || wgsl_names().chain(SHORT);
    if names().any(|name| name == word) {
        return if is_type(word) {
            format!("`{word}` is a type, not a value; write `{word}(...)`, with what it is made of")
        } else {
            format!("`{word}` is a function; call it: `{word}(...)`")
        };
    }
    let same = || names().find(|name| name.eq_ignore_ascii_case(word));
    if let Some(likely) = same().or_else(|| nearest(word, names())) {
        return format!("there is no `{word}`; did you mean `{likely}`?");
    }
    match nearest(word, borrowed::functions()) {
        Some(likely) => format!("there is no `{word}`; did you mean the library's `{likely}`?"),
        None => format!("there is no `{word}`: it is none of WGSL's, of yours and of the library's"),
    }
}

/// The line of an argument that reads what other programs, or a context of here, hand to shaders by this name.
fn input(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    let word = word.strip_prefix("u_").or_else(|| word.strip_prefix("v_")).unwrap_or(&word);
    match word {
        "time" | "itime" | "uv" | "vuv" | "uv0" | "fragcoord" | "iresolution" | "resolution" | "texcoord"
        | "viewdir" => Some("- uv: where [context uv0]"),
        "position" | "pos" | "world_position" | "worldposition" => Some("- position: where [context world_position]"),
        "normal" | "world_normal" | "worldnormal" | "vnormal" => Some("- normal: direction [context world_normal]"),
        _ => None,
    }
}

/// What is said of a word that begins no item, where it begins one in another language.
pub(super) fn no_item(word: &str) -> Option<String> {
    let told = match word {
        "void" | "def" | "func" | "function" | "fun" | "inline" | "static" => {
            "a function is written `fn name(x: f32) -> f32 { ... }`"
        }
        "#include" | "import" | "include" | "use" => {
            "a node brings nothing in; functions of the library are called by their names"
        }
        "#version" | "#extension" | "#pragma" | "precision" => {
            "a node says nothing of versions, extensions and precision; leave it out"
        }
        "uniform" | "varying" | "attribute" | "in" | "out" | "inout" | "layout" | "cbuffer" | "buffer" => {
            "a node has no inputs beside its function; what it reads are the function's arguments"
        }
        word if word.starts_with('#') && word != "#define" => {
            "WGSL has no preprocessor; what is known beforehand is written `const NAME = 1.0;`"
        }
        "let" | "#define" | "constexpr" | "define" => "what is known beforehand is written `const NAME = 1.0;`",
        "type" | "typedef" | "using" => "another name for a type is written `alias Name = vec3f;`",
        word if is_type(word) => {
            "a function is written `fn name(x: f32) -> f32 { ... }`, what is known beforehand `const NAME = 1.0;`"
        }
        _ => return None,
    };
    Some(told.into())
}
