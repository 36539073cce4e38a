//! Pictures, cubes and tables as the interpreter samples them.

use halfvector_codegen::reflection::SamplerSource;
use halfvector_graph::value::{ColorSpace, Filter, Wrap};
use halfvector_ibl::{Cube, DfgTable};
use halfvector_interp::{Address, Level, LevelRule, Sampler, Shape, Texture};
use halfvector_maps::{Image, Texels};
use halfvector_scene::texture_levels;

/// A picture with all its mip levels; 8-bit ones stay coded. `None` when it has no texel.
pub fn image(image: &Image, color_space: ColorSpace) -> Option<Texture> {
    let levels = texture_levels(image, color_space);
    if matches!(image.texels(), Texels::U8(_)) {
        let coded = levels.all().map(|image| Level {
            width: image.width(),
            height: image.height(),
            depth: 1,
            texels: match image.texels() {
                Texels::U8(texels) => texels.clone(),
                Texels::U16(_) | Texels::F32(_) => Vec::new(),
            },
        });
        return Texture::from_codes(Shape::D2, 1, coded.collect(), levels.color_space == ColorSpace::Srgb).ok();
    }
    let floats = levels.all().map(|image| Level {
        width: image.width(),
        height: image.height(),
        depth: 1,
        texels: match image.texels() {
            Texels::U8(_) => Vec::new(),
            Texels::U16(texels) => texels.iter().map(|texel| texel.map(|c| f32::from(c) / 65535.0)).collect(),
            Texels::F32(texels) => texels.clone(),
        },
    });
    Texture::new(Shape::D2, 1, floats.collect()).ok()
}

/// A cube with one level for each cube of `levels`. The fourth channel is each level's slopes where there are any, else 1.
pub(crate) fn cube(levels: &[Cube], slopes: &[Vec<f32>]) -> Option<Texture> {
    let level = |(number, cube): (usize, &Cube)| Level {
        width: cube.size as u32,
        height: cube.size as u32,
        depth: 1,
        texels: {
            let slope = |texel: usize| slopes.get(number).map_or(1.0, |slopes| slopes[texel]);
            cube.texels.iter().enumerate().map(|(i, &[r, g, b])| [r, g, b, slope(i)]).collect()
        },
    };
    Texture::new(Shape::Cube, 6, levels.iter().enumerate().map(level).collect()).ok()
}

/// The (scale, bias) table: x = n.v, y = perceptual roughness.
pub(crate) fn dfg(table: &DfgTable) -> Option<Texture> {
    let size = table.size as u32;
    let texels = table.texels.iter().map(|&[scale, bias]| [scale, bias, 0.0, 1.0]).collect();
    Texture::new(Shape::D2, 1, vec![Level { width: size, height: size, depth: 1, texels }]).ok()
}

/// A sampler. Levels are found as a software GPU finds them, so that its pictures and these are alike.
pub fn sampler(source: &SamplerSource) -> Sampler {
    let (wrap_u, wrap_v, filter) = match source {
        SamplerSource::Image { wrap_u, wrap_v, filter } => (*wrap_u, *wrap_v, *filter),
        SamplerSource::LinearClamp => (Wrap::Clamp, Wrap::Clamp, Filter::Linear),
    };
    let address = [wrap_u, wrap_v, Wrap::Clamp].map(|wrap| match wrap {
        Wrap::Repeat => Address::Repeat,
        Wrap::Clamp => Address::Clamp,
        Wrap::Mirror => Address::Mirror,
    });
    let level_rule = LevelRule::Chords;
    match filter {
        Filter::Linear => Sampler { address, level_rule, ..Sampler::linear(Address::Clamp) },
        Filter::Nearest => Sampler { address, level_rule, ..Sampler::default() },
    }
}
