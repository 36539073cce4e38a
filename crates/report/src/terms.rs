//! What the list of methods says of a term: its help, its default, the form of the report that started the project; and what the
//! page says of terms that are in no list.

use halfvector_graph::method::{Term, term};

/// The layout of the table that shaders read: `dfg=table`.
const TABLE: &str = "45^2 f16, vertex-centred, both warped";

/// What a term stands for; of the terms that have no choice of methods, too.
pub(crate) fn help(name: &str) -> &'static str {
    match name {
        "coat" => "what a clear coat reflects of an environment",
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
        "thin_film" => "what a thin film reflects of an environment",
        "transmission" => "what a surface lets through of an environment",
        _ => term(name).map_or("", |term| term.help),
    }
}

/// What one has to know to read a chapter's figures.
pub(crate) fn explained(name: &str) -> &'static str {
    match name {
        "picture" => {
            "The project's examples, drawn small; those that could not be drawn are named at the head of the page. `gpu` and `cpu` draw an \
             example's specialised shader: every number of the material is known when the \
             shader is made. They are held against the reference, which leaves out shadows and light from other surfaces here, because shaders have neither; where its noise could be all of the difference the \
             rms error is not known, and what it is at most is said. The largest error is what is left of the largest \
             difference without four standard errors, and so a bound from below. `gpu, unspecialised` draws the same picture with every \
             number of its surfaces as a uniform, so that every lobe stays in; its error is the difference of the two \
             pictures. `preset report` takes the report's forms and is held against the picture with the defaults."
        }
        "precision" => {
            "Each form on inputs at the ends of its domain: cosines from 1e-6, roughness from 0.0001. On the CPU in Rust, f16 with \
             each operation rounded; on the device in WGSL. The truth is the same form in 64 bits, which has a row only where it gives what is no \
             number. An ulp is the distance of neighbouring numbers of the format."
        }
        "peer" => {
            "The same work by other programs. What is recorded was measured once, on the machine and day that its line names, \
             and not in this run, for the reason that stands there."
        }
        "split_sum" => {
            "A shader takes the light that a lobe gathers for two factors: prefiltered light, and the lobe's albedo. Here both are exact, \
             and held against the sum of light times the lobe over the whole environment: what is left is the error of splitting the sum, \
             which no filter and no table can mend."
        }
        _ => "",
    }
}

/// A term of the list: that of methods which are measured on meshes, too.
fn listed(name: &str) -> Option<&'static Term> {
    term(if name == "normal_frame" { "normal" } else { name })
}

/// Whether the method is what is taken when nothing is chosen.
pub(crate) fn is_default(name: &str, method: &str) -> bool {
    listed(name).is_some_and(|term| term.methods[0].name == method) || is_table(name, method)
}

fn is_table(name: &str, method: &str) -> bool {
    name == "dfg" && method == TABLE
}

/// Whether `--method`, or an option of a bake or a file, can choose it: a row may say more behind the method's name.
pub(crate) fn is_known(name: &str, method: &str) -> bool {
    let first = method.split([',', ' ']).next().unwrap_or_default();
    // On meshes the methods are measured beside what no shader has.
    let word = if name == "normal_frame" || name == "irradiance" { method } else { first };
    listed(name).is_some_and(|term| term.methods.iter().any(|known| known.name == word)) || is_table(name, method)
}

/// The place of a method in the list of its term's methods; behind all of them where it is in none.
pub(crate) fn place(name: &str, method: &str) -> usize {
    let first = method.split([',', ' ']).next().unwrap_or_default();
    let position = |term: &Term| term.methods.iter().position(|known| known.name == method || known.name == first);
    listed(name).and_then(position).unwrap_or(usize::MAX)
}

/// Whether the method is that of the report that started the project.
pub(crate) fn is_report(name: &str, method: &str) -> bool {
    listed(name).is_some_and(|term| term.report == method)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_can_be_named_is_told_from_what_cannot() {
        for (term, method, known) in [
            ("anisotropy", "strips", true),
            ("anisotropy", "round", false),
            ("diffuse", "eon_exact", false),
            ("prefilter", "ggx preview", true),
            ("normal_decode", "two_channel, BC5", true),
            ("normal_frame", "tbn, exact tangents interpolated", false),
            ("normal_frame", "tbn", true),
            ("irradiance", "sh2 windowed", false),
            ("normal_blend", "udn", false),
            ("dfg", TABLE, true),
        ] {
            assert_eq!(is_known(term, method), known, "{term} {method}");
        }
        assert!(is_default("normal_frame", "tbn") && is_default("dfg", "table") && is_default("dfg", TABLE));
        assert!(!is_default("normal_decode", "unorm, 16 bits"));
    }
}
