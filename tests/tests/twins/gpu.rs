//! The GPU that tests run functions of the WGSL library on: what `halfvector_render` offers, with a panic for an error.

use halfvector_render::Renderer;
use halfvector_render::function::Results;
use naga::Module;

pub(crate) use halfvector_render::function::Number;

use crate::support::required;

/// An opened GPU.
pub(crate) struct Gpu {
    renderer: Renderer,
    /// For people.
    pub(crate) name: String,
    /// Whether it computes in f64.
    pub(crate) has_f64: bool,
    /// Whether it computes in f16.
    pub(crate) has_f16: bool,
}

/// All of the library's functions as one module.
pub(crate) fn library() -> Module {
    halfvector_render::function::library().unwrap_or_else(|error| panic!("{error}"))
}

impl Gpu {
    /// Opens a GPU. Where there is none it prints so and returns `None`, or fails where one is required.
    pub(crate) fn open() -> Option<Gpu> {
        let renderer = match Renderer::new() {
            Ok(renderer) => renderer,
            Err(error) => {
                assert!(!required("HALFVECTOR_REQUIRE_GPU"), "a GPU is required: {error}");
                println!("skipped: no GPU ({error})");
                return None;
            }
        };
        let name = renderer.adapter().to_owned();
        let (has_f64, has_f16) = (renderer.computes_in::<f64>(), renderer.computes_in::<half::f16>());
        Some(Gpu { renderer, name, has_f64, has_f16 })
    }

    /// Calls a function of the library once for each row of `arguments`.
    pub(crate) fn call<N: Number>(&self, module: &Module, function: &str, arguments: &[f32]) -> Results {
        self.renderer.call::<N>(module, function, arguments).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Runs the entry point `call` of a shader with `input` at binding 0, `rows` times, and returns the bytes at binding 1.
    pub(crate) fn run(&self, source: &str, input: &[u8], output_bytes: u64, rows: usize) -> Vec<u8> {
        self.renderer.compute(source, input, output_bytes, rows).unwrap_or_else(|error| panic!("{error}\n{source}"))
    }
}
