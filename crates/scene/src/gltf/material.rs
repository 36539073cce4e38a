//! Materials: glTF's metallic-roughness model becomes a material document made of the same nodes that a person would wire.

mod lobes;

use std::collections::{BTreeMap, HashSet};

use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::{AlphaMode as GltfAlphaMode, Material};
use gltf::json::mesh::Semantic;
use gltf::json::texture::{MagFilter, Texture, WrappingMode};
use gltf::json::validation::Checked;
use gltf::json::{self, Index};
use halfvector_graph::document::{AlphaMode, Document, Link, Node, SocketRef, SurfaceSettings};
use halfvector_graph::value::{ColorSpace, Filter, ImageRef, Value, Wrap};

use super::asset::Asset;
use super::{Fault, Result, entry};
use crate::scene::surface_document;

/// The material of primitives that name none: glTF's default values.
pub(super) fn default_material(is_tinted: bool) -> Document {
    let mut document = surface_document(
        "glTF default",
        [
            ("base_color", Value::Vec3([1.0; 3])),
            ("metallic", Value::Number(1.0)),
            ("perceptual_roughness", Value::Number(1.0)),
        ],
    );
    if is_tinted {
        add_node(&mut document, VERTEX_COLOR, "geometry/vertex_color", None, []);
        add_link(&mut document, VERTEX_COLOR, "color", "surface", "base_color");
    }
    document
}

/// The node that reads the colours of vertices.
const VERTEX_COLOR: &str = "vertex_color";

/// The materials of which any primitive has colours at its vertices, by which glTF 2.0, section 3.7.2.1, multiplies the base colour; `None` is
/// the default one. Primitives without are white there.
pub(super) fn tinted_materials(asset: &Asset) -> HashSet<Option<usize>> {
    let primitives = asset.root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    primitives
        .filter(|primitive| primitive.attributes.contains_key(&Checked::Valid(Semantic::Colors(0))))
        .map(|primitive| primitive.material.map(|index| index.value()))
        .collect()
}

/// Which texture coordinates the material's normal map reads, as its tangents have to follow those: 0 or 1.
pub(super) fn normal_uv_set(material: &Material) -> u32 {
    let Some(texture) = &material.normal_texture else { return 0 };
    let others = texture.extensions.as_ref().map(|e| &e.others);
    let transform = others.and_then(transform_of);
    transform.and_then(|t| t.tex_coord).unwrap_or(texture.tex_coord)
}

/// How a material reads a texture.
struct Use<'a> {
    texture: Index<Texture>,
    uv_set: u32,
    transform: Option<TextureTransform>,
    color_space: ColorSpace,
    /// Name of the node.
    name: &'a str,
}

/// A document in the making.
struct Builder<'a> {
    asset: &'a Asset,
    place: String,
    document: Document,
    /// Image nodes by what they read, so that packed maps are read once.
    images: BTreeMap<String, String>,
    /// Whether the colours of vertices multiply the base colour.
    is_tinted: bool,
    notes: &'a mut Vec<String>,
}

/// The document of material `index`, which the colours of vertices multiply where it `is_tinted`. What has no counterpart is noted.
pub(super) fn document(asset: &Asset, index: usize, is_tinted: bool, notes: &mut Vec<String>) -> Result<Document> {
    let material = &asset.root.materials[index];
    let place = format!("materials[{index}]");
    let name = material.name.clone().unwrap_or_else(|| format!("Material {index}"));
    let document = surface_document(&name, []);
    let mut builder = Builder { asset, place, document, images: BTreeMap::new(), is_tinted, notes };
    builder.fill(material)?;
    Ok(builder.document)
}

impl Builder<'_> {
    fn fill(&mut self, material: &Material) -> Result<()> {
        let pbr = &material.pbr_metallic_roughness;
        let mode = match material.alpha_mode {
            Checked::Valid(GltfAlphaMode::Opaque) => AlphaMode::Opaque,
            Checked::Valid(GltfAlphaMode::Mask) => AlphaMode::Mask,
            Checked::Valid(GltfAlphaMode::Blend) => AlphaMode::Blend,
            Checked::Invalid => return Err(Fault::new(&self.place, "alphaMode is none of OPAQUE, MASK, BLEND")),
        };
        self.document.surface = SurfaceSettings {
            alpha_mode: mode,
            alpha_cutoff: self.number(material.alpha_cutoff.unwrap_or_default().0, "alphaCutoff")?,
            double_sided: material.double_sided,
            thin_walled: false,
        };

        let [r, g, b, alpha] = pbr.base_color_factor.0;
        let color = [
            self.number(r, "baseColorFactor")?,
            self.number(g, "baseColorFactor")?,
            self.number(b, "baseColorFactor")?,
        ];
        let alpha = self.number(alpha, "baseColorFactor")?;
        let map =
            self.image(pbr.base_color_texture.as_ref().map(|info| info_use(info, ColorSpace::Srgb, "base_color_map")))?;
        if self.is_tinted {
            self.node(VERTEX_COLOR, "geometry/vertex_color", None, []);
        }
        self.tinted("base_color", map.as_deref(), "color", Value::Vec3(color));
        if mode != AlphaMode::Opaque {
            self.tinted("opacity", map.as_deref(), "alpha", Value::Number(alpha));
        }

        let metallic = self.number(pbr.metallic_factor.0, "metallicFactor")?;
        let roughness = self.number(pbr.roughness_factor.0, "roughnessFactor")?;
        let map = pbr.metallic_roughness_texture.as_ref();
        let map = self.image(map.map(|info| info_use(info, ColorSpace::Linear, "metallic_roughness_map")))?;
        let map = map.as_deref();
        self.scaled("metallic", map.map(|m| (m, "b")), Value::Number(metallic), "metallic_factor");
        self.scaled("perceptual_roughness", map.map(|m| (m, "g")), Value::Number(roughness), "roughness_factor");

        self.fill_normal(material)?;
        self.fill_occlusion(material)?;
        self.fill_emission(material)?;
        self.fill_specular(material)?;
        self.fill_lobes(material)
    }

    fn fill_normal(&mut self, material: &Material) -> Result<()> {
        let Some(texture) = &material.normal_texture else { return Ok(()) };
        let transform = texture.extensions.as_ref().and_then(|e| transform_of(&e.others));
        let map = self.image(Some(Use {
            texture: texture.index,
            uv_set: texture.tex_coord,
            transform,
            color_space: ColorSpace::Linear,
            name: "normal_map",
        }))?;
        let strength = self.number(texture.scale, "normalTexture.scale")?;
        let values = [("strength", Value::Number(strength))];
        let node = self.node("normal", "textures/normal_map", None, values);
        if let Some(map) = map {
            self.link(&map, "color", &node, "color");
        }
        self.link(&node, "out", "surface", "normal");
        Ok(())
    }

    fn fill_occlusion(&mut self, material: &Material) -> Result<()> {
        let Some(texture) = &material.occlusion_texture else { return Ok(()) };
        let transform = texture.extensions.as_ref().and_then(|e| transform_of(&e.others));
        let map = self.image(Some(Use {
            texture: texture.index,
            uv_set: texture.tex_coord,
            transform,
            color_space: ColorSpace::Linear,
            name: "occlusion_map",
        }))?;
        let Some(map) = map else { return Ok(()) };
        let strength = self.number(texture.strength.0, "occlusionTexture.strength")?;
        if strength == 1.0 {
            self.link(&map, "r", "surface", "occlusion");
        } else {
            // glTF 2.0, section 3.9.3: 1 + strength (value - 1).
            let values = [("a", Value::Number(1.0)), ("t", Value::Number(strength))];
            let node = self.node("occlusion", "math/mix", None, values);
            self.link(&map, "r", &node, "b");
            self.link(&node, "out", "surface", "occlusion");
        }
        Ok(())
    }

    fn fill_emission(&mut self, material: &Material) -> Result<()> {
        let strength = material.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |e| e.emissive_strength.0);
        let mut emission = material.emissive_factor.0;
        for channel in &mut emission {
            *channel = self.number(*channel * strength, "emissiveFactor")?;
        }
        if emission == [0.0; 3] {
            return Ok(());
        }
        let map = material.emissive_texture.as_ref();
        let map = self.image(map.map(|info| info_use(info, ColorSpace::Srgb, "emission_map")))?;
        self.scaled("emission", map.as_deref().map(|m| (m, "color")), Value::Vec3(emission), "emission_factor");
        Ok(())
    }

    fn fill_specular(&mut self, material: &Material) -> Result<()> {
        let Some(extensions) = &material.extensions else { return Ok(()) };
        if let Some(ior) = &extensions.ior {
            let ior = self.number(ior.ior.0, "KHR_materials_ior.ior")?;
            self.set("ior", Value::Number(ior));
        }
        let Some(specular) = &extensions.specular else { return Ok(()) };
        let weight = self.number(specular.specular_factor.0, "specularFactor")?;
        let map = specular.specular_texture.as_ref();
        let map = self.image(map.map(|info| info_use(info, ColorSpace::Linear, "specular_map")))?;
        if weight != 1.0 || map.is_some() {
            self.scaled("specular", map.as_deref().map(|m| (m, "alpha")), Value::Number(weight), "specular_factor");
        }
        if specular.specular_color_factor.0 != [1.0; 3] || specular.specular_color_texture.is_some() {
            self.notes.push("specular colours (KHR_materials_specular) are passed over".to_owned());
        }
        Ok(())
    }

    /// Sets an input of the surface to `factor`, times a map's output and the same one of the vertices where there are such.
    fn tinted(&mut self, input: &str, map: Option<&str>, output: &str, factor: Value) {
        let name = format!("{input}_factor");
        let Some(map) = map else {
            return self.scaled(input, self.is_tinted.then_some((VERTEX_COLOR, output)), factor, &name);
        };
        if !self.is_tinted {
            return self.scaled(input, Some((map, output)), factor, &name);
        }
        let tint = self.node(&format!("{input}_tint"), "math/multiply", None, []);
        self.link(map, output, &tint, "a");
        self.link(VERTEX_COLOR, output, &tint, "b");
        self.scaled(input, Some((&tint, "out")), factor, &name);
    }

    /// Sets an input of the surface to `factor`, or to a map's output times `factor`.
    fn scaled(&mut self, input: &str, map: Option<(&str, &str)>, factor: Value, name: &str) {
        let Some((map, output)) = map else { return self.set(input, factor) };
        if factor.components().is_some_and(|c| c.iter().all(|&x| x == 1.0)) {
            self.link(map, output, "surface", input);
        } else {
            let node = self.node(name, "math/multiply", None, [("b", factor)]);
            self.link(map, output, &node, "a");
            self.link(&node, "out", "surface", input);
        }
    }

    /// The image node for a texture, made on first use.
    fn image(&mut self, wanted: Option<Use<'_>>) -> Result<Option<String>> {
        let Some(wanted) = wanted else { return Ok(None) };
        let root = &self.asset.root;
        let place = format!("textures[{}]", wanted.texture.value());
        let texture = entry(&root.textures, "textures", wanted.texture.value(), &self.place)?;
        let source = texture.source.value();
        let image = entry(&root.images, "images", source, &place)?;
        let mut reference = ImageRef {
            file: self.asset.image_file(source).unwrap_or_else(|| self.within_model(source)),
            color_space: wanted.color_space,
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::Repeat,
            filter: Filter::Linear,
        };
        if let Some(sampler) = texture.sampler {
            let sampler = entry(&root.samplers, "samplers", sampler.value(), &place)?;
            reference.wrap_u = wrap(sampler.wrap_s);
            reference.wrap_v = wrap(sampler.wrap_t);
            if matches!(sampler.mag_filter, Some(Checked::Valid(MagFilter::Nearest))) {
                reference.filter = Filter::Nearest;
            }
        }
        let transform = wanted.transform.unwrap_or_default();
        let mut uv_set = transform.tex_coord.unwrap_or(wanted.uv_set);
        if uv_set > 1 {
            let name = &self.document.name;
            self.notes.push(format!("material `{name}`: texture coordinates {uv_set} are not read; 0 are used"));
            uv_set = 0;
        }
        let mut numbers = [
            transform.offset.0[0],
            transform.offset.0[1],
            transform.rotation.0,
            transform.scale.0[0],
            transform.scale.0[1],
        ];
        for number in &mut numbers {
            *number = self.number(*number, "KHR_texture_transform")?;
        }
        let key = format!("{reference:?} {uv_set} {numbers:?}");
        if let Some(node) = self.images.get(&key) {
            return Ok(Some(node.clone()));
        }
        let file_name = || reference.file.rsplit('/').next().unwrap_or_default().to_owned();
        let label = image.name.clone().filter(|n| !n.is_empty()).unwrap_or_else(file_name);
        let node = self.node(wanted.name, "textures/image", Some(label), [("image", Value::Image(reference))]);
        let mut uv = None;
        if uv_set == 1 {
            uv = Some(self.node(&format!("{}_uv1", wanted.name), "coordinates/uv1", None, []));
        }
        let [offset_u, offset_v, rotation, scale_u, scale_v] = numbers;
        if numbers != [0.0, 0.0, 0.0, 1.0, 1.0] {
            let values = [
                ("offset", Value::Vec2([offset_u, offset_v])),
                ("rotation", Value::Number(rotation.to_degrees())),
                ("scale", Value::Vec2([scale_u, scale_v])),
            ];
            let moved = self.node(&format!("{}_transform", wanted.name), "coordinates/uv_transform", None, values);
            if let Some(uv) = uv {
                self.link(&uv, "out", &moved, "uv");
            }
            uv = Some(moved);
        }
        if let Some(uv) = uv {
            self.link(&uv, "out", &node, "uv");
        }
        self.images.insert(key, node.clone());
        Ok(Some(node))
    }

    /// `MODEL.glb#N`, relative to the model's folder.
    fn within_model(&self, image: usize) -> String {
        let name = self.asset.path().file_name().unwrap_or_default().to_string_lossy();
        format!("{name}#{image}")
    }

    fn number(&self, x: f32, what: &str) -> Result<f32> {
        if x.is_finite() { Ok(x) } else { Err(Fault::new(&self.place, format!("{what} is not finite"))) }
    }

    fn set(&mut self, input: &str, value: Value) {
        if let Some(surface) = self.document.graph.nodes.get_mut("surface") {
            surface.values.insert(input.to_owned(), value);
        }
    }

    /// Adds a node; `name` is not taken yet, as each place in the model has its own.
    fn node<const N: usize>(
        &mut self,
        name: &str,
        definition: &str,
        label: Option<String>,
        values: [(&str, Value); N],
    ) -> String {
        add_node(&mut self.document, name, definition, label, values);
        name.to_owned()
    }

    fn link(&mut self, from: &str, output: &str, to: &str, input: &str) {
        add_link(&mut self.document, from, output, to, input);
    }
}

fn add_node<const N: usize>(
    document: &mut Document,
    name: &str,
    definition: &str,
    label: Option<String>,
    values: [(&str, Value); N],
) {
    let values = values.into_iter().map(|(socket, value)| (socket.to_owned(), value)).collect();
    let node = Node { node: definition.to_owned(), label, values, unknown: Default::default() };
    document.graph.nodes.insert(name.to_owned(), node);
}

fn add_link(document: &mut Document, from: &str, output: &str, to: &str, input: &str) {
    let socket = |node: &str, socket: &str| SocketRef { node: node.to_owned(), socket: socket.to_owned() };
    document.graph.links.push(Link { from: socket(from, output), to: socket(to, input) });
}

fn info_use<'a>(info: &json::texture::Info, color_space: ColorSpace, name: &'a str) -> Use<'a> {
    let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.clone());
    Use { texture: info.index, uv_set: info.tex_coord, transform, color_space, name }
}

/// KHR_texture_transform among the extensions of a normal or occlusion texture, where the `gltf` crate leaves it as JSON.
fn transform_of(others: &serde_json::Map<String, json::Value>) -> Option<TextureTransform> {
    json::deserialize::from_value(others.get("KHR_texture_transform")?.clone()).ok()
}

fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}
