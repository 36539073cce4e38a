//! What may stand in a Rust file: the rules that a compiler does not check.

use std::path::PathBuf;

use syn::visit::{self, Visit};

use super::{files, read, short};

/// Words that a folder's sources must not hold, with the reason.
const FORBIDDEN: &[(&str, &[&str], &str)] = &[
    ("crates/brdf/src", &["std::fs", "std::path", "wgpu", "naga"], "brdf is pure math"),
    ("crates/maps/src", &["std::fs", "std::path", "wgpu", "naga"], "maps knows bytes, no path"),
    ("crates/graph/src", &["wgpu"], "only render knows the GPU"),
    ("crates/codegen/src", &["wgpu::", "std::fs"], "codegen makes text and knows no device or file"),
    ("crates/codegen/src", &[".layout"], "positions of nodes have no meaning"),
    ("crates/scene/src", &["wgpu::"], "only render knows the GPU"),
    ("crates/ibl/src", &["wgpu::"], "only render knows the GPU"),
    (
        "crates/reference/src",
        &["wgpu", "dfg_fit", "dfg_karis", "specular_environment", "diffuse_environment", "Baked", "prefilter", "sh2"],
        "the reference uses no fast approximation",
    ),
];

/// Folders with Rust of the project.
const ALL: [&str; 5] = ["crates", "editor", "shaders", "tests", "benches"];

#[test]
fn sources_hold_no_forbidden_word() {
    for (folder, words, reason) in FORBIDDEN {
        // What stands in tests may name what the code may not.
        let is_test =
            |path: &PathBuf| path.components().any(|c| c.as_os_str() == "tests") || path.ends_with("tests.rs");
        for path in files(folder, ".rs").into_iter().filter(|p| !is_test(p)) {
            let text = read(&path);
            let code = text.split("#[cfg(test)]").next().unwrap_or(&text);
            for word in *words {
                for (number, line) in code.lines().enumerate() {
                    let is_comment = line.trim_start().starts_with("//");
                    assert!(is_comment || !line.contains(word), "{}:{}: `{word}`: {reason}", short(&path), number + 1);
                }
            }
        }
    }
}

/// No test is passed over for good, and what must agree is held by one, not by a comment.
#[test]
fn nothing_is_ignored_or_kept_in_sync_by_hand() {
    // Put together, so that this file holds none of them.
    let words = [concat!("#[", "ignore"), concat!("keep in ", "sync"), concat!("keep these in ", "sync")];
    for path in ALL.iter().flat_map(|folder| files(folder, ".rs")) {
        for (number, line) in read(&path).lines().enumerate() {
            let line = line.to_lowercase();
            let found = words.iter().find(|word| line.contains(**word));
            assert!(found.is_none(), "{}:{}: `{}`", short(&path), number + 1, found.unwrap_or(&""));
        }
    }
}

#[test]
fn every_file_says_what_it_is() {
    for folder in ALL {
        for path in files(folder, ".rs") {
            assert!(read(&path).starts_with("//!"), "{}: no module header", short(&path));
        }
    }
}

/// Finds WGSL in string literals: more than one line with a function or entry point in it.
struct ShaderStrings(Vec<String>);

impl<'ast> Visit<'ast> for ShaderStrings {
    fn visit_lit_str(&mut self, literal: &'ast syn::LitStr) {
        let text = literal.value();
        if text.trim().contains('\n') && (text.contains("fn ") || text.contains("@fragment")) && text.contains('{') {
            self.0.push(text);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes
        .iter()
        .any(|a| a.path().is_ident("cfg") && a.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test")))
}

#[test]
fn shader_code_stands_in_wgsl_files() {
    for path in ["crates", "shaders/src", "editor/src"].iter().flat_map(|folder| files(folder, ".rs")) {
        let path = &path;
        if path.components().any(|c| c.as_os_str() == "tests") || path.ends_with("tests.rs") {
            continue;
        }
        let tree = syn::parse_file(&read(path)).unwrap_or_else(|e| panic!("{}: {e}", short(path)));
        let mut found = ShaderStrings(Vec::new());
        found.visit_file(&tree);
        assert!(found.0.is_empty(), "{}: shader code in a string: {}", short(path), found.0[0]);
    }
}

/// Finds paths that begin with `naga` or `wgpu` in the signatures and fields that a crate offers.
struct PublicPaths {
    found: Vec<String>,
}

impl PublicPaths {
    fn check_type(&mut self, ty: &syn::Type) {
        struct Paths<'a>(&'a mut Vec<String>);
        impl<'ast> Visit<'ast> for Paths<'_> {
            fn visit_path(&mut self, path: &'ast syn::Path) {
                if let Some(first) = path.segments.first()
                    && (first.ident == "naga" || first.ident == "wgpu")
                {
                    self.0.push(path.segments.iter().map(|s| s.ident.to_string()).collect::<Vec<_>>().join("::"));
                }
                visit::visit_path(self, path);
            }
        }
        Paths(&mut self.found).visit_type(ty);
    }

    fn check_signature(&mut self, signature: &syn::Signature) {
        for input in &signature.inputs {
            if let syn::FnArg::Typed(argument) = input {
                self.check_type(&argument.ty);
            }
        }
        if let syn::ReturnType::Type(_, ty) = &signature.output {
            self.check_type(ty);
        }
    }
}

impl<'ast> Visit<'ast> for PublicPaths {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if matches!(item.vis, syn::Visibility::Public(_)) {
            self.check_signature(&item.sig);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if matches!(item.vis, syn::Visibility::Public(_)) {
            self.check_signature(&item.sig);
        }
    }

    fn visit_field(&mut self, field: &'ast syn::Field) {
        if matches!(field.vis, syn::Visibility::Public(_)) {
            self.check_type(&field.ty);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !is_test(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }
}

#[test]
fn naga_stays_out_of_public_signatures() {
    for path in files("crates/graph/src", ".rs").iter().chain(&files("crates/codegen/src", ".rs")) {
        let tree = syn::parse_file(&read(path)).unwrap_or_else(|e| panic!("{}: {e}", short(path)));
        let mut paths = PublicPaths { found: Vec::new() };
        paths.visit_file(&tree);
        assert!(paths.found.is_empty(), "{}: {} in a public signature", short(path), paths.found[0]);
    }
}
