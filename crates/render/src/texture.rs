//! Pictures, cubes and tables on the GPU: formats, mip levels and samplers. It computes no texel but what a format asks for.

use halfvector_codegen::reflection::SamplerSource;
use halfvector_graph::value::{ColorSpace, Filter, Wrap};
use halfvector_ibl::{Cube, DfgTable};
use halfvector_maps::{Image, Texels};
use halfvector_scene::texels::{TexelFormat, cube_bytes, dfg_bytes, image_bytes};
use halfvector_scene::texture_levels;

use crate::device::Gpu;
use crate::error::RenderError;

/// A picture with all its mip levels. `name` stands in the error when it is too large.
pub(crate) fn image(
    gpu: &Gpu,
    name: &str,
    image: &Image,
    color_space: ColorSpace,
) -> Result<wgpu::TextureView, RenderError> {
    let (width, height) = (image.width(), image.height());
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if width > limit || height > limit {
        return Err(RenderError::ImageTooLarge {
            file: name.to_owned(),
            width,
            height,
            limit,
            adapter: gpu.name.clone(),
        });
    }
    let levels = texture_levels(image, color_space);
    let (format, texels) = match (image.texels(), levels.color_space) {
        (Texels::U8(_), ColorSpace::Srgb) => (wgpu::TextureFormat::Rgba8UnormSrgb, TexelFormat::Unorm8),
        (Texels::U8(_), ColorSpace::Linear) if !rounds(gpu, image) => {
            (wgpu::TextureFormat::Rgba8Unorm, TexelFormat::Unorm8)
        }
        _ if gpu.filters_f32() => (wgpu::TextureFormat::Rgba32Float, TexelFormat::Float32),
        _ => (wgpu::TextureFormat::Rgba16Float, TexelFormat::Float16),
    };
    let texture = new_texture(gpu, format, [width, height, 1], 1 + levels.smaller.len() as u32);
    for (level, image) in levels.all().enumerate() {
        let bytes = image_bytes(image, texels);
        write(gpu, &texture, level as u32, [image.width(), image.height(), 1], &bytes);
    }
    Ok(texture.create_view(&Default::default()))
}

/// Whether what is read between the texels of a linear picture of 8 bits would be rounded to 8 bits again, which shows as steps in a
/// normal map: llvmpipe does so to save time. As floats, in four times the memory, it is read as cards read it.
fn rounds(gpu: &Gpu, image: &Image) -> bool {
    /// Larger pictures are left as they are: these take 64 MiB.
    const MOST_TEXELS: u64 = 1 << 22;
    gpu.software && gpu.filters_f32() && u64::from(image.width()) * u64::from(image.height()) <= MOST_TEXELS
}

/// A cube with one level for each cube of `levels`; each has half the size of the one before. 16-bit floats. The fourth
/// channel is each level's slopes where there are any, else 1.
pub(crate) fn cube(gpu: &Gpu, levels: &[Cube], slopes: &[Vec<f32>]) -> wgpu::TextureView {
    let size = levels.first().map_or(1, |cube| cube.size as u32);
    let texture = new_texture(gpu, wgpu::TextureFormat::Rgba16Float, [size, size, 6], levels.len().max(1) as u32);
    for (level, cube) in levels.iter().enumerate() {
        let bytes = cube_bytes(cube, slopes.get(level).map(Vec::as_slice));
        write(gpu, &texture, level as u32, [cube.size as u32, cube.size as u32, 6], &bytes);
    }
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::Cube),
        ..Default::default()
    })
}

/// The (scale, bias) table: x = n.v, y = perceptual roughness.
pub(crate) fn dfg(gpu: &Gpu, table: &DfgTable) -> wgpu::TextureView {
    let size = table.size as u32;
    let texture = new_texture(gpu, wgpu::TextureFormat::Rg16Float, [size, size, 1], 1);
    write(gpu, &texture, 0, [size, size, 1], &dfg_bytes(table));
    texture.create_view(&Default::default())
}

/// A sampler.
pub(crate) fn sampler(gpu: &Gpu, source: &SamplerSource) -> wgpu::Sampler {
    let (wrap_u, wrap_v, filter) = match source {
        SamplerSource::Image { wrap_u, wrap_v, filter } => (*wrap_u, *wrap_v, *filter),
        SamplerSource::LinearClamp => (Wrap::Clamp, Wrap::Clamp, Filter::Linear),
    };
    let (texels, levels) = match filter {
        Filter::Linear => (wgpu::FilterMode::Linear, wgpu::MipmapFilterMode::Linear),
        Filter::Nearest => (wgpu::FilterMode::Nearest, wgpu::MipmapFilterMode::Nearest),
    };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: None,
        address_mode_u: address_mode(wrap_u),
        address_mode_v: address_mode(wrap_v),
        address_mode_w: wgpu::AddressMode::ClampToEdge,
        mag_filter: texels,
        min_filter: texels,
        mipmap_filter: levels,
        ..Default::default()
    })
}

fn address_mode(wrap: Wrap) -> wgpu::AddressMode {
    match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
    }
}

fn new_texture(gpu: &Gpu, format: wgpu::TextureFormat, size: [u32; 3], levels: u32) -> wgpu::Texture {
    let [width, height, depth_or_array_layers] = size;
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn write(gpu: &Gpu, texture: &wgpu::Texture, mip_level: u32, size: [u32; 3], bytes: &[u8]) {
    let [width, height, depth_or_array_layers] = size;
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level,
            origin: wgpu::Origin3d::ZERO,
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * texture.format().block_copy_size(None).unwrap_or(4)),
            rows_per_image: Some(height),
        },
        wgpu::Extent3d { width, height, depth_or_array_layers },
    );
}
