//! A library function alone: cut out with all that it refers to, to be run in f32, f64 or f16.
//!
//! One source serves three formats: an alias in front of it turns `f32` into another type. It knows no node and no entry
//! point.

use std::collections::BTreeSet;

use crate::{FILES, File, Item, slice};

/// In front of texture-free library code: it computes in f64.
pub const F64_PRELUDE: &str = include_str!("function/f64.wgsl");
/// In front of texture-free library code: it computes in f16, with the floors and ceilings that f16 can hold.
pub const F16_PRELUDE: &str = include_str!("function/f16.wgsl");

/// The files of library functions: those that hold neither nodes nor entry points.
pub fn library_files() -> impl Iterator<Item = &'static File> {
    FILES.iter().filter(|f| !f.path.starts_with("nodes/") && !f.path.starts_with("entry/"))
}

/// The function and all that it refers to, directly or not, as text, in the order of the files. What `prelude` defines
/// itself is left out; the prelude is not part of the text. Empty where the library has no such function.
pub fn with_dependencies(function: &str, prelude: &str) -> String {
    // A test of this package slices every file: none fails.
    let items: Vec<(&File, Item)> =
        library_files().flat_map(|f| slice(f.source).unwrap_or_default().into_iter().map(move |i| (f, i))).collect();
    let mut reached = BTreeSet::new();
    let mut open = vec![function.to_string()];
    while let Some(name) = open.pop() {
        if let Some((_, item)) = items.iter().find(|(_, i)| i.name == name)
            && reached.insert(name)
        {
            open.extend(item.dependencies.iter().cloned());
        }
    }
    let own = |name: &str| prelude.contains(&format!("const {name}:"));
    let kept = items.iter().filter(|(_, i)| reached.contains(&i.name) && !own(&i.name));
    kept.map(|(file, item)| format!("{}\n", &file.source[item.code_start..item.end])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_comes_with_what_it_calls_and_nothing_else() {
        let text = with_dependencies("energy_compensation_fdez_aguera", "");
        assert!(text.contains("fn energy_compensation_fdez_aguera(") && text.contains("fn average_fresnel("), "{text}");
        assert!(!text.contains("fn d_ggx("), "{text}");
        assert_eq!(with_dependencies("no_such_function", ""), "");
    }

    #[test]
    fn constants_of_the_prelude_take_the_place_of_the_librarys() {
        let with = |prelude| with_dependencies("d_ggx", prelude).contains("const D_FLOOR");
        assert!(with(""));
        assert!(!with(F16_PRELUDE));
    }
}
