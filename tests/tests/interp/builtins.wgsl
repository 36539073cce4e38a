// Built-in functions side by side. The words in capitals are put in by builtins.rs.
@group(0) @binding(0) var<storage, read> arguments: array<vec4<u32>>;
@group(0) @binding(1) var<storage, read_write> results: array<array<u32, COUNT>>;

@compute @workgroup_size(64)
fn call(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let row = id.x;
    let x = bitcast<f32>(arguments[row].x);
    let y = bitcast<f32>(arguments[row].y);
    let i = bitcast<i32>(arguments[row].z);
    let u = arguments[row].w;
    CALLS
}
