//! The Rust half of the Bevy target: the material's type, its fields, their defaults and how images are loaded.

use std::fmt::Write;

use halfvector_graph::document::AlphaMode;
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Type, Wrap};

use super::{BEVY, Field, is_of_engine};
use crate::names::comment;
use crate::reflection::{Reflection, Resource, SamplerSource, TextureSource, UniformBlock, UniformSource, UniformType};

/// A file name of letters, digits and `_`: a module of that name can be declared.
pub(super) fn snake(name: &str) -> String {
    let words: Vec<String> = words(name).map(|word| word.to_ascii_lowercase()).collect();
    let joined = words.join("_");
    if joined.starts_with(|c: char| c.is_ascii_alphabetic()) { joined } else { format!("material_{joined}") }
}

/// The type's name.
fn pascal(name: &str) -> String {
    let mut joined = String::new();
    for word in words(name) {
        let mut letters = word.chars();
        joined.extend(letters.next().map(|c| c.to_ascii_uppercase()));
        joined.extend(letters);
    }
    let lead = if joined.starts_with(|c: char| c.is_ascii_alphabetic()) { "" } else { "Exported" };
    // The ending keeps it apart from the types that the file imports.
    format!("{lead}{joined}Material")
}

fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty())
}

/// The Rust file.
pub(super) fn plugin(reflection: &Reflection, fields: &[Field<'_>], name: &str, stem: &str, wgsl: &str) -> String {
    let ty = pascal(name);
    let images: Vec<(&Field<'_>, &ImageRef)> = fields.iter().filter_map(|field| Some((field, image(field)?))).collect();
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "//! {}: a material made by Halfvector, for Bevy {BEVY}.\n\
         //!\n\
         //! Put this file and `{stem}.wgsl` side by side, add [`{ty}Plugin`] to the app, and give meshes\n\
         //! `MeshMaterial3d<{ty}>`. Meshes want normals, and texture coordinates and tangents where images are read.\n\n",
        comment(name)
    );
    text += "use bevy::asset::{load_internal_asset, uuid_handle};\n";
    if !images.is_empty() {
        text += "use bevy::image::{ImageAddressMode, ImageFilterMode, ImageLoaderSettings, ImageSampler, ImageSamplerDescriptor};\n";
    }
    text += "use bevy::material::AlphaMode;\n";
    let mut resources = vec!["AsBindGroup"];
    if reflection.double_sided {
        text += "use bevy::mesh::MeshVertexBufferLayoutRef;\nuse bevy::pbr::{MaterialPipeline, MaterialPipelineKey};\n";
        resources.extend(["RenderPipelineDescriptor", "SpecializedMeshPipelineError"]);
    }
    text += "use bevy::prelude::*;\n";
    resources.extend(fields.iter().any(|field| block(field).is_some()).then_some("ShaderType"));
    let _ = writeln!(text, "use bevy::render::render_resource::{{{}}};", resources.join(", "));
    text += "use bevy::shader::ShaderRef;\n\n";
    let _ = writeln!(text, "const SHADER: Handle<Shader> = uuid_handle!(\"{}\");\n", uuid(wgsl));

    let _ = write!(
        text,
        "/// Registers the material and its shader.\n\
         pub struct {ty}Plugin;\n\n\
         impl Plugin for {ty}Plugin {{\n    \
             fn build(&self, app: &mut App) {{\n        \
                 load_internal_asset!(app, SHADER, \"{stem}.wgsl\", Shader::from_wgsl);\n        \
                 app.add_plugins(MaterialPlugin::<{ty}>::default());\n    \
             }}\n}}\n\n"
    );
    blocks(reflection, fields, &mut text);
    material(fields, &ty, &mut text);
    implementation(reflection, &ty, &mut text);
    if !images.is_empty() {
        loading(fields, &images, &ty, &mut text);
    }
    text
}

fn block<'s>(field: &Field<'s>) -> Option<&'s UniformBlock> {
    match &field.binding.resource {
        Resource::Uniform(block) => Some(block),
        _ => None,
    }
}

fn image<'s>(field: &Field<'s>) -> Option<&'s ImageRef> {
    match &field.binding.resource {
        Resource::Texture(TextureSource::Image(image)) => Some(image),
        _ => None,
    }
}

/// The name of a block's type: `View` is Bevy's own.
fn type_name(block: &UniformBlock) -> &str {
    if block.struct_name == "View" { "Surroundings" } else { &block.struct_name }
}

/// The structs of uniforms, with the material's numbers as defaults.
fn blocks(reflection: &Reflection, fields: &[Field<'_>], text: &mut String) {
    for block in fields.iter().filter_map(block) {
        let name = type_name(block);
        let about = if name == "Parameters" { "What may be set." } else { "The environment's part of the shading." };
        let _ = writeln!(text, "/// {about}\n#[derive(Clone, Copy, Debug, ShaderType)]\npub struct {name} {{");
        let members: Vec<_> = block.members.iter().filter(|member| !is_of_engine(&member.source)).collect();
        for member in &members {
            let parameter = reflection.parameters.iter().find(|parameter| parameter.name == member.name);
            let about = match (&member.source, parameter) {
                (UniformSource::EnvironmentRotation, _) => "Cosine and sine of the environment's turn about +Y.".into(),
                (UniformSource::EnvironmentLevels, _) => "Number of levels of the prefiltered radiance.".into(),
                (UniformSource::IrradianceSh, _) => {
                    "Irradiance over pi, nine coefficients (`halfvector bake --sh`).".into()
                }
                (_, Some(parameter)) => {
                    let range = parameter.range.map(|[low, high]| format!(", {low} to {high}")).unwrap_or_default();
                    format!("{}{range}.", comment(&parameter.label))
                }
                _ => "A number of the material.".to_owned(),
            };
            let _ = writeln!(text, "    /// {about}\n    pub {}: {},", rust_name(&member.name), rust_type(member.ty));
        }
        let _ = write!(text, "}}\n\nimpl Default for {name} {{\n    fn default() -> Self {{\n        {name} {{\n");
        for member in &members {
            let parameter = reflection.parameters.iter().find(|parameter| parameter.name == member.name);
            let value = match (&member.source, parameter) {
                (UniformSource::EnvironmentRotation, _) => "Vec2::new(1.0, 0.0)".to_owned(),
                (UniformSource::EnvironmentLevels, _) => "6.0".to_owned(),
                (UniformSource::IrradianceSh, _) => "[Vec4::ZERO; 9]".to_owned(),
                (_, Some(parameter)) => rust_value(member.ty, &parameter.default),
                _ => rust_value(member.ty, &[]),
            };
            let _ = writeln!(text, "            {}: {value},", rust_name(&member.name));
        }
        *text += "        }\n    }\n}\n\n";
    }
}

/// A name that is no word of Rust.
fn rust_name(name: &str) -> String {
    const WORDS: &[&str] = &[
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else", "enum",
        "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
        "move", "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait", "true", "try", "type",
        "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
    ];
    if WORDS.contains(&name) { format!("r#{name}") } else { name.to_owned() }
}

fn rust_type(ty: UniformType) -> &'static str {
    match ty {
        UniformType::Value(Type::F32) => "f32",
        UniformType::Value(Type::I32 | Type::Bool) => "i32",
        UniformType::Value(Type::Vec2) => "Vec2",
        UniformType::Value(Type::Vec3) => "Vec3",
        UniformType::Value(Type::Vec4) => "Vec4",
        UniformType::Mat4 => "Mat4",
        UniformType::Mat3 => "Mat3",
        // Lights are the app's.
        UniformType::Sh9 | UniformType::Lights(..) => "[Vec4; 9]",
    }
}

fn rust_value(ty: UniformType, numbers: &[f64]) -> String {
    let number = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
    match ty {
        UniformType::Value(Type::I32 | Type::Bool) => format!("{}", number(0) as i32),
        UniformType::Value(Type::F32) => format!("{:?}", number(0) as f32),
        UniformType::Value(ty) => {
            let numbers: Vec<String> = (0..ty.components()).map(|i| format!("{:?}", number(i) as f32)).collect();
            format!("{}::new({})", rust_type(UniformType::Value(ty)), numbers.join(", "))
        }
        _ => "Default::default()".to_owned(),
    }
}

/// The material's type.
fn material(fields: &[Field<'_>], ty: &str, text: &mut String) {
    let _ = writeln!(
        text,
        "/// The material.\n#[derive(Asset, AsBindGroup, TypePath, Clone, Debug, Default)]\npub struct {ty} {{"
    );
    for field in fields {
        let (number, name) = (field.number, rust_name(&field.binding.name));
        match &field.binding.resource {
            Resource::Uniform(block) => {
                let about = if type_name(block) == "Parameters" { "What may be set." } else { "Of the environment." };
                let _ =
                    writeln!(text, "    /// {about}\n    #[uniform({number})]\n    pub {name}: {},", type_name(block));
            }
            Resource::Texture(source) => {
                let (about, dimension) = match source {
                    TextureSource::Image(image) => (format!("`{}`.", comment(&image.file)), ""),
                    TextureSource::PrefilteredRadiance => (
                        "The environment, from `halfvector bake ENV -o FILE.ktx2`.".to_owned(),
                        ", dimension = \"cube\"",
                    ),
                    TextureSource::IrradianceOverPi => {
                        ("Its diffuse light, from `--irradiance FILE.ktx2`.".to_owned(), ", dimension = \"cube\"")
                    }
                    TextureSource::Dfg => ("The table of albedos.".to_owned(), ""),
                };
                let _ = writeln!(text, "    /// {about}\n    #[texture({number}{dimension})]");
                if let Some(sampler) = fields.iter().find(|sampler| first_texture(fields, sampler) == Some(number)) {
                    let _ = writeln!(text, "    #[sampler({})]", sampler.number);
                }
                let _ = writeln!(text, "    pub {name}: Handle<Image>,");
            }
            // Comes with its first texture.
            Resource::Sampler(_) => {}
        }
    }
    *text += "}\n\n";
}

/// The number of the first texture that a sampler is for: in Bevy samplers belong to images.
fn first_texture(fields: &[Field<'_>], sampler: &Field<'_>) -> Option<u32> {
    let Resource::Sampler(source) = &sampler.binding.resource else { return None };
    let fits = |field: &&Field<'_>| match (&field.binding.resource, source) {
        (Resource::Texture(TextureSource::Image(image)), SamplerSource::Image { wrap_u, wrap_v, filter }) => {
            (image.wrap_u, image.wrap_v, image.filter) == (*wrap_u, *wrap_v, *filter)
        }
        (Resource::Texture(TextureSource::Image(_)), SamplerSource::LinearClamp) => false,
        (Resource::Texture(_), SamplerSource::LinearClamp) => true,
        _ => false,
    };
    fields.iter().find(fits).map(|field| field.number)
}

/// What Bevy asks of a material.
fn implementation(reflection: &Reflection, ty: &str, text: &mut String) {
    let (mode, prepass) = match reflection.alpha_mode {
        AlphaMode::Opaque => ("AlphaMode::Opaque", true),
        // The cutoff is applied by the shader, which Bevy's own depth passes do not run.
        AlphaMode::Mask => ("AlphaMode::Mask(0.5)", false),
        AlphaMode::Blend => ("AlphaMode::Premultiplied", false),
    };
    let _ = write!(
        text,
        "impl Material for {ty} {{\n    \
             fn fragment_shader() -> ShaderRef {{\n        SHADER.into()\n    }}\n\n    \
             fn alpha_mode(&self) -> AlphaMode {{\n        {mode}\n    }}\n\n    \
             fn enable_prepass() -> bool {{\n        {prepass}\n    }}\n"
    );
    if reflection.double_sided {
        *text += "\n    /// Both sides are seen.\n    \
                  fn specialize(\n        \
                      _: &MaterialPipeline,\n        \
                      descriptor: &mut RenderPipelineDescriptor,\n        \
                      _: &MeshVertexBufferLayoutRef,\n        \
                      _: MaterialPipelineKey<Self>,\n    \
                  ) -> Result<(), SpecializedMeshPipelineError> {\n        \
                      descriptor.primitive.cull_mode = None;\n        \
                      Ok(())\n    \
                  }\n";
    }
    *text += "}\n";
}

/// How the images are loaded.
fn loading(fields: &[Field<'_>], images: &[(&Field<'_>, &ImageRef)], ty: &str, text: &mut String) {
    let _ = write!(
        text,
        "\nimpl {ty} {{\n    \
             /// The material with its images, from a folder of the app's assets.\n    \
             pub fn load(assets: &AssetServer, folder: &str) -> Self {{\n        \
                 {ty} {{\n"
    );
    for (field, image) in images {
        let mode = |wrap| match wrap {
            Wrap::Repeat => "Repeat",
            Wrap::Clamp => "ClampToEdge",
            Wrap::Mirror => "MirrorRepeat",
        };
        let filter = match image.filter {
            Filter::Linear => "Linear",
            Filter::Nearest => "Nearest",
        };
        let _ = writeln!(
            text,
            "            {}: image(assets, format!(\"{{folder}}/{{}}\", {:?}), {}, [ImageAddressMode::{}, \
             ImageAddressMode::{}], ImageFilterMode::{filter}),",
            rust_name(&field.binding.name),
            image.file,
            image.color_space == ColorSpace::Srgb,
            mode(image.wrap_u),
            mode(image.wrap_v)
        );
    }
    if images.len() < fields.iter().filter(|field| !matches!(field.binding.resource, Resource::Sampler(_))).count() {
        *text += "            ..Default::default()\n";
    }
    *text += "        }\n    }\n}\n\n";
    *text += "/// An image as the shader reads it.\n\
              fn image(\n    \
                  assets: &AssetServer,\n    \
                  path: String,\n    \
                  is_srgb: bool,\n    \
                  wrap: [ImageAddressMode; 2],\n    \
                  filter: ImageFilterMode,\n\
              ) -> Handle<Image> {\n    \
                  let settings = move |settings: &mut ImageLoaderSettings| {\n        \
                      settings.is_srgb = is_srgb;\n        \
                      settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {\n            \
                          address_mode_u: wrap[0],\n            \
                          address_mode_v: wrap[1],\n            \
                          mag_filter: filter,\n            \
                          min_filter: filter,\n            \
                          mipmap_filter: filter,\n            \
                          ..Default::default()\n        \
                      });\n    \
                  };\n    \
                  assets.load_builder().with_settings(settings).load(path)\n\
              }\n";
}

/// A name for the shader that follows from its text: FNV-1a in 128 bits (Fowler, Noll, Vo), as a UUID of version 8.
fn uuid(text: &str) -> String {
    let hash = text.bytes().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, |hash, byte| {
        (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
    });
    let versioned = (hash & !(0xf << 76) & !(0x3 << 62)) | (0x8 << 76) | (0x2 << 62);
    let digits = format!("{versioned:032x}");
    [&digits[..8], &digits[8..12], &digits[12..16], &digits[16..20], &digits[20..]].join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_file_name_gives_names_of_rust() {
        for (name, file, ty) in [
            ("car-paint", "car_paint", "CarPaintMaterial"),
            ("4 walls!", "material_4_walls", "Exported4WallsMaterial"),
            ("", "material_", "ExportedMaterial"),
            ("lack/rot\n", "lack_rot", "LackRotMaterial"),
        ] {
            assert_eq!((snake(name).as_str(), pascal(name).as_str()), (file, ty), "{name:?}");
        }
    }

    #[test]
    fn the_same_text_has_the_same_uuid() {
        // FNV-1a's offset basis, with version and variant put in.
        assert_eq!(uuid(""), "6c62272e-07bb-8142-a2b8-21756295c58d");
        assert_ne!(uuid("a"), uuid("b"));
    }
}
