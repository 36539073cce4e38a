// A random program. The words in capitals are put in by random.rs.
@group(0) @binding(0) var<storage, read> arguments: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> results: array<Row>;

struct Row {
    words: vec4<u32>,
    /// What the program itself reads and writes.
    kept: array<u32, 3>,
}

/// The invocation's own row.
var<private> row: u32;

FUNCTIONS

@compute @workgroup_size(64)
fn call(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    row = id.x;
    let a = arguments[row];
    let r = program(bitcast<f32>(a.x), bitcast<f32>(a.y), bitcast<i32>(a.z), a.w);
    results[row].words = vec4<u32>(bitcast<u32>(r.x), bitcast<u32>(r.i), r.u, u32(r.b));
}
