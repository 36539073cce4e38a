// Calls one function of the library once per invocation. The words in capitals are put in by gpu.rs, from the types that
// naga finds in the function's signature.
@group(0) @binding(0) var<storage, read> arguments: array<f32>;
@group(0) @binding(1) var<storage, read_write> results: array<f32>;

@compute @workgroup_size(64)
fn call(@builtin(global_invocation_id) id: vec3<u32>) {
    let argument = id.x * ARGUMENTS;
    let result = id.x * RESULTS;
    if result >= arrayLength(&results) {
        return;
    }
    let r = CALL;
    STORE
}
