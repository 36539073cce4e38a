//! Implicit derivatives only in uniform control flow: what browsers refuse and naga lets pass, found by a walk over the
//! IR, transitively. Stricter than WGSL: any branch counts as non-uniform, whatever its condition.

use halfvector_shaders::FILES;
use naga::{Block, Expression, Function, Handle, Module, SampleLevel, Statement};

/// The whole library as one module: files with entry points or a `T` of their own are made to fit.
fn library() -> (String, Module) {
    let mut source = String::from("alias T = vec3f;\n");
    for file in FILES.iter().filter(|f| !f.path.starts_with("entry/")) {
        for line in file.source.lines().filter(|l| !l.trim_start().starts_with("alias T")) {
            source.push_str(line);
            source.push('\n');
        }
    }
    let module = naga::front::wgsl::parse_str(&source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
    (source, module)
}

fn is_implicit(expression: &Expression) -> bool {
    matches!(
        expression,
        Expression::Derivative { .. } | Expression::ImageSample { level: SampleLevel::Auto | SampleLevel::Bias(_), .. }
    )
}

/// Calls anywhere in a block.
fn calls(block: &Block, found: &mut Vec<Handle<Function>>) {
    for statement in block {
        match statement {
            Statement::Call { function, .. } => found.push(*function),
            Statement::Block(inner) => calls(inner, found),
            Statement::If { accept, reject, .. } => {
                calls(accept, found);
                calls(reject, found);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|c| calls(&c.body, found)),
            Statement::Loop { body, continuing, .. } => {
                calls(body, found);
                calls(continuing, found);
            }
            _ => {}
        }
    }
}

/// The functions that take implicit derivatives, themselves or through what they call.
fn implicit_functions(module: &Module) -> Vec<Handle<Function>> {
    let mut found: Vec<Handle<Function>> = Vec::new();
    // naga keeps functions in order of dependency: what is called stands before its caller.
    for (handle, function) in module.functions.iter() {
        let mut called = Vec::new();
        calls(&function.body, &mut called);
        if function.expressions.iter().any(|(_, e)| is_implicit(e)) || called.iter().any(|c| found.contains(c)) {
            found.push(handle);
        }
    }
    found
}

/// Whether a block can leave its function or loop early.
fn leaves(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } | Statement::Kill | Statement::Break | Statement::Continue => true,
        Statement::Block(inner) => leaves(inner),
        Statement::If { accept, reject, .. } => leaves(accept) || leaves(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|c| leaves(&c.body)),
        Statement::Loop { body, continuing, .. } => leaves(body) || leaves(continuing),
        _ => false,
    })
}

/// Implicit derivatives that stand where control flow may differ between neighbouring pixels.
fn violations(function: &Function, implicit: &[Handle<Function>], block: &Block, mut uniform: bool, found: &mut u32) {
    for statement in block {
        match statement {
            Statement::Emit(range) if !uniform => {
                *found += range.clone().filter(|e| is_implicit(&function.expressions[*e])).count() as u32;
            }
            Statement::Call { function: called, .. } if !uniform && implicit.contains(called) => *found += 1,
            Statement::Block(inner) => violations(function, implicit, inner, uniform, found),
            Statement::If { accept, reject, .. } => {
                violations(function, implicit, accept, false, found);
                violations(function, implicit, reject, false, found);
                uniform &= !(leaves(accept) || leaves(reject));
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    violations(function, implicit, &case.body, false, found);
                }
                uniform &= !cases.iter().any(|c| leaves(&c.body));
            }
            Statement::Loop { body, continuing, .. } => {
                violations(function, implicit, body, false, found);
                violations(function, implicit, continuing, false, found);
                uniform = false;
            }
            _ => {}
        }
    }
}

fn count(module: &Module) -> Vec<(String, u32)> {
    let implicit = implicit_functions(module);
    let mut result = Vec::new();
    for (_, function) in module.functions.iter() {
        let mut found = 0;
        violations(function, &implicit, &function.body, true, &mut found);
        if found > 0 {
            result.push((function.name.clone().unwrap_or_default(), found));
        }
    }
    result
}

#[test]
fn implicit_derivatives_stand_in_uniform_flow() {
    let (_, module) = library();
    assert!(!implicit_functions(&module).is_empty(), "the library has nodes that sample textures");
    assert_eq!(count(&module), [], "functions with implicit derivatives under control flow");
}

#[test]
fn the_walk_finds_what_browsers_refuse() {
    let cases = [
        ("if (c) { return textureSample(t, s, uv); } return vec4f(0.0);", 1),
        ("if (c) { return vec4f(0.0); } return textureSample(t, s, uv);", 1),
        ("if (c) { return sampled(t, s, uv); } return vec4f(0.0);", 1),
        ("for (var i = 0; i < 2; i++) { if (dpdx(uv.x) > 1.0) { break; } } return vec4f(0.0);", 1),
        ("let x = sampled(t, s, uv); if (c) { return x; } return vec4f(0.0);", 0),
        ("if (c) { return textureSampleLevel(t, s, uv, 0.0); } return vec4f(0.0);", 0),
    ];
    for (body, expected) in cases {
        let source = format!(
            "fn sampled(t: texture_2d<f32>, s: sampler, uv: vec2f) -> vec4f {{ return textureSample(t, s, uv); }}
             fn tested(t: texture_2d<f32>, s: sampler, uv: vec2f, c: bool) -> vec4f {{ {body} }}"
        );
        let module = naga::front::wgsl::parse_str(&source).expect("a valid case");
        let found: u32 = count(&module).iter().map(|(_, n)| n).sum();
        assert_eq!(found.min(1), expected, "{body}");
    }
}
