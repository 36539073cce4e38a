//! Pictures as textures of the interpreter: texels decoded to linear floats, each picture once. Only the finest level is
//! kept, for a pixel's many samples are the filter.

use std::collections::HashMap;
use std::sync::Arc;

use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Wrap};
use halfvector_interp::{Address, Level, Sampler, Shape, Texture};
use halfvector_maps::color::linear_from_srgb;
use halfvector_maps::{Image, Texels};
use halfvector_scene::{Scene, SceneMaterial};

use crate::ReferenceError;

/// The textures made so far, by number in the scene's store and coding.
#[derive(Default)]
pub(crate) struct Textures(HashMap<(usize, ColorSpace), Arc<Texture>>);

impl Textures {
    pub(crate) fn get(
        &mut self,
        scene: &Scene,
        material: &SceneMaterial,
        reference: &ImageRef,
    ) -> Result<Arc<Texture>, ReferenceError> {
        let name = &material.document.name;
        let missing = || ReferenceError::MissingImage { material: name.clone(), file: reference.file.clone() };
        let index = scene.images.index(&material.directory, reference).ok_or_else(missing)?;
        if let Some(known) = self.0.get(&(index, reference.color_space)) {
            return Ok(known.clone());
        }
        let image = scene.images.images().get(index).ok_or_else(missing)?;
        let level = Level {
            width: image.width(),
            height: image.height(),
            depth: 1,
            texels: decoded(image, reference.color_space),
        };
        let made = Texture::new(Shape::D2, 1, vec![level])
            .map_err(|error| ReferenceError::Material { material: name.clone(), why: error.to_string() })?;
        let made = Arc::new(made);
        self.0.insert((index, reference.color_space), made.clone());
        Ok(made)
    }
}

/// The texels as linear floats; alpha is linear as it is.
fn decoded(image: &Image, space: ColorSpace) -> Vec<[f32; 4]> {
    let linear = |texel: [f64; 4]| -> [f32; 4] {
        let [r, g, b, a] = texel;
        let [r, g, b] = if space == ColorSpace::Srgb { linear_from_srgb([r, g, b]) } else { [r, g, b] };
        [r, g, b, a].map(|x| x as f32)
    };
    match image.texels() {
        Texels::U8(texels) => texels.iter().map(|texel| linear(texel.map(|c| f64::from(c) / 255.0))).collect(),
        Texels::U16(texels) => texels.iter().map(|texel| linear(texel.map(|c| f64::from(c) / 65535.0))).collect(),
        Texels::F32(texels) => texels.iter().map(|texel| linear(texel.map(f64::from))).collect(),
    }
}

/// The interpreter's sampler.
pub(crate) fn sampler(wrap_u: Wrap, wrap_v: Wrap, filter: Filter) -> Sampler {
    let address = |wrap| match wrap {
        Wrap::Repeat => Address::Repeat,
        Wrap::Clamp => Address::Clamp,
        Wrap::Mirror => Address::Mirror,
    };
    let filter = match filter {
        Filter::Linear => halfvector_interp::Filter::Linear,
        Filter::Nearest => halfvector_interp::Filter::Nearest,
    };
    Sampler {
        address: [address(wrap_u), address(wrap_v), Address::Clamp],
        magnify: filter,
        minify: filter,
        levels: filter,
        ..Sampler::default()
    }
}
