//! Names in the WGSL library: none shadows a built-in, a type or a reserved word, none stands twice.

use std::collections::BTreeMap;

use halfvector_shaders::{FILES, slicer};

use super::files;
use crate::support::root;

#[test]
fn no_item_has_the_name_of_a_builtin() {
    let mut places: BTreeMap<String, &str> = BTreeMap::new();
    for file in FILES {
        for item in slicer::slice(file.source).unwrap_or_else(|e| panic!("{}: {e}", file.path)) {
            // Each generic file has its own `T`; the linker puts the type in its place.
            if item.name == "T" {
                continue;
            }
            assert!(
                !naga::keywords::wgsl::RESERVED.contains(&item.name.as_str())
                    && !naga::keywords::wgsl::BUILTIN_IDENTIFIERS.contains(&item.name.as_str()),
                "{}: `{}` is a word of WGSL itself",
                file.path,
                item.name
            );
            if let Some(other) = places.insert(item.name.clone(), file.path) {
                panic!("`{}` stands in {other} and in {}", item.name, file.path);
            }
        }
    }
}

#[test]
fn every_shader_file_is_listed() {
    let listed: Vec<_> = FILES.iter().map(|f| f.path.to_string()).collect();
    let folder = root().join("shaders");
    let there: Vec<_> = files("shaders", ".wgsl")
        .iter()
        .map(|p| p.strip_prefix(&folder).expect("below shaders/").to_string_lossy().replace('\\', "/"))
        // What stands there is put in front of the library's text, and is none of it.
        .filter(|path| !path.starts_with("src/"))
        .collect();
    let mut sorted = listed.clone();
    sorted.sort();
    assert_eq!(listed, sorted, "the list in shaders/src/lib.rs is sorted by path");
    let mut there = there;
    there.sort();
    assert_eq!(sorted, there, "the list in shaders/src/lib.rs against the folder");
}
