//! The environment behind the objects: `shaders/entry/background.wgsl`, run for the samples that nothing covers.

use halfvector_codegen::reflection::SamplerSource;
use halfvector_interp::{Column, Float, Machine, Program, Resources, RunError, Texture};

use crate::program::{Part, compile, parts};
use crate::shade::Shading;
use crate::texture;

/// Compiles the background's fragment stage. Its vertex stage makes one triangle over everything: that is done here.
pub(crate) fn compiled() -> Result<Program, String> {
    compile(&halfvector_shaders::background(), ["fs_background"]).map(|[fragment]| fragment)
}

/// The background's fragment stage with what it reads; `uniforms` are the bytes of its block.
pub(crate) fn shading<'a>(program: &'a Program, uniforms: &'a [u8], radiance: &'a Texture) -> Shading<'a> {
    let resources = Resources::default().buffer(0, 0, uniforms).texture(0, 1, radiance).sampler(
        0,
        2,
        texture::sampler(&SamplerSource::LinearClamp),
    );
    Shading::new(program, resources)
}

/// The colours of samples at these columns and rows of a grid.
pub(crate) fn run<'p, F: Float>(
    shading: &'p Shading<'_>,
    machine: &mut Option<Machine<'p, F>>,
    samples: &[[u32; 2]],
    grid: [f64; 2],
) -> Result<Vec<Option<[f32; 4]>>, RunError> {
    // Its only varying is the place in clip space.
    let clip = |axis: usize| -> Vec<F> {
        let sign = if axis == 0 { 1.0 } else { -1.0 };
        let place = |sample: &[u32; 2]| sign * ((f64::from(sample[axis]) + 0.5) / grid[axis] * 2.0 - 1.0);
        samples.iter().map(|sample| F::from_f64(place(sample))).collect()
    };
    let (x, y, zero) = (clip(0), clip(1), [F::default()]);
    let columns: Vec<Column<'_, F>> = parts(shading.program.inputs())
        .into_iter()
        .map(|part| match part {
            Part::Location(0, 0) => Column::Float(&x),
            Part::Location(0, 1) => Column::Float(&y),
            _ => Column::Float(&zero),
        })
        .collect();
    shading.run_columns(machine, &columns, samples.len())
}
