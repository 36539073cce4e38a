//! The lobes beside metal and diffuse, whose extensions the `gltf` crate leaves as JSON: KHR_materials_clearcoat, _sheen,
//! _transmission, _anisotropy and _iridescence. What a body absorbs (KHR_materials_volume), dispersion and diffuse
//! transmission have no counterpart: they are noted.

use gltf::json;
use gltf::json::material::Material;
use halfvector_graph::value::{ColorSpace, Value};

use super::super::{Fault, Result};
use super::{Builder, Use, info_use, transform_of};

/// The JSON of an extension, with its name for messages.
struct Extension<'a> {
    name: &'a str,
    fields: &'a serde_json::Map<String, json::Value>,
}

impl Builder<'_> {
    /// Fills the inputs of all lobes that a material names.
    pub(super) fn fill_lobes(&mut self, material: &Material) -> Result<()> {
        let Some(extensions) = &material.extensions else { return Ok(()) };
        let find = |name: &'static str| {
            extensions.others.get(name).and_then(|e| e.as_object()).map(|fields| Extension { name, fields })
        };
        if let Some(coat) = find("KHR_materials_clearcoat") {
            self.fill_coat(&coat)?;
        }
        if let Some(sheen) = find("KHR_materials_sheen") {
            self.fill_sheen(&sheen)?;
        }
        if let Some(transmission) = find("KHR_materials_transmission") {
            self.factor(&transmission, "transmissionFactor", 0.0, "transmissionTexture", "r", "transmission_weight")?;
            // Without a volume the surface is a sheet, says the extension.
            let thickness = find("KHR_materials_volume").map(|volume| self.one(&volume, "thicknessFactor", 0.0));
            self.document.surface.thin_walled = thickness.transpose()?.is_none_or(|thickness| thickness == 0.0);
        }
        if let Some(anisotropy) = find("KHR_materials_anisotropy") {
            self.fill_anisotropy(&anisotropy)?;
        }
        if let Some(iridescence) = find("KHR_materials_iridescence") {
            self.fill_film(&iridescence)?;
        }
        for (name, what) in [
            ("KHR_materials_volume", "what a body absorbs"),
            ("KHR_materials_dispersion", "dispersion"),
            ("KHR_materials_diffuse_transmission", "diffuse transmission"),
            ("KHR_materials_unlit", "the material that light does not change"),
        ] {
            if find(name).is_some() {
                let note = format!("material `{}`: {what} ({name}) is passed over", self.document.name);
                self.notes.push(note);
            }
        }
        Ok(())
    }

    fn fill_coat(&mut self, coat: &Extension<'_>) -> Result<()> {
        self.factor(coat, "clearcoatFactor", 0.0, "clearcoatTexture", "r", "coat_weight")?;
        self.factor(coat, "clearcoatRoughnessFactor", 0.0, "clearcoatRoughnessTexture", "g", "coat_roughness")?;
        let Some(texture) = coat.fields.get("clearcoatNormalTexture") else { return Ok(()) };
        let texture: json::material::NormalTexture = self.read(coat, "clearcoatNormalTexture", texture)?;
        let map = self.image(Some(Use {
            texture: texture.index,
            uv_set: texture.tex_coord,
            transform: texture.extensions.as_ref().and_then(|e| transform_of(&e.others)),
            color_space: ColorSpace::Linear,
            name: "coat_normal_map",
        }))?;
        let strength = self.number(texture.scale, "clearcoatNormalTexture.scale")?;
        let node = self.node("coat_normal", "textures/normal_map", None, [("strength", Value::Number(strength))]);
        if let Some(map) = map {
            self.link(&map, "color", &node, "color");
        }
        self.link(&node, "out", "surface", "coat_normal");
        Ok(())
    }

    fn fill_sheen(&mut self, sheen: &Extension<'_>) -> Result<()> {
        let mut color = [0.0; 3];
        if let Some(json) = sheen.fields.get("sheenColorFactor") {
            color = self.read(sheen, "sheenColorFactor", json)?;
        }
        for channel in &mut color {
            *channel = self.number(*channel, "sheenColorFactor")?;
        }
        if color == [0.0; 3] {
            return Ok(());
        }
        let map = self.map(sheen, "sheenColorTexture", ColorSpace::Srgb, "sheen_color_map")?;
        self.scaled("sheen_color", map.as_deref().map(|m| (m, "color")), Value::Vec3(color), "sheen_color_factor");
        self.factor(sheen, "sheenRoughnessFactor", 0.0, "sheenRoughnessTexture", "alpha", "sheen_roughness")
    }

    fn fill_anisotropy(&mut self, anisotropy: &Extension<'_>) -> Result<()> {
        self.factor(anisotropy, "anisotropyStrength", 0.0, "anisotropyTexture", "b", "anisotropy")?;
        let rotation = self.one(anisotropy, "anisotropyRotation", 0.0)?;
        let Some(map) = self.map(anisotropy, "anisotropyTexture", ColorSpace::Linear, "anisotropy_map")? else {
            self.set("anisotropy_rotation", Value::Number(rotation));
            return Ok(());
        };
        // Red and green are a direction in the tangent plane: the angle is that of (2 r - 1, 2 g - 1).
        let wide = [("b", Value::Number(2.0)), ("c", Value::Number(-1.0))];
        let x = self.node("anisotropy_x", "math/multiply_add", None, wide.clone());
        let y = self.node("anisotropy_y", "math/multiply_add", None, wide);
        let angle = self.node("anisotropy_angle", "math/atan2", None, []);
        self.link(&map, "r", &x, "a");
        self.link(&map, "g", &y, "a");
        self.link(&x, "out", &angle, "x");
        self.link(&y, "out", &angle, "y");
        if rotation == 0.0 {
            self.link(&angle, "out", "surface", "anisotropy_rotation");
        } else {
            let turned = self.node("anisotropy_turned", "math/add", None, [("b", Value::Number(rotation))]);
            self.link(&angle, "out", &turned, "a");
            self.link(&turned, "out", "surface", "anisotropy_rotation");
        }
        Ok(())
    }

    /// Thicknesses are nanometres in the file and micrometres in the document.
    fn fill_film(&mut self, film: &Extension<'_>) -> Result<()> {
        self.factor(film, "iridescenceFactor", 0.0, "iridescenceTexture", "r", "thin_film_weight")?;
        let ior = self.one(film, "iridescenceIor", 1.3)?;
        self.set("thin_film_ior", Value::Number(ior));
        let thinnest = self.one(film, "iridescenceThicknessMinimum", 100.0)? / 1000.0;
        let thickest = self.one(film, "iridescenceThicknessMaximum", 400.0)? / 1000.0;
        let map = self.map(film, "iridescenceThicknessTexture", ColorSpace::Linear, "film_thickness_map")?;
        let Some(map) = map else {
            self.set("thin_film_thickness", Value::Number(thickest));
            return Ok(());
        };
        let ends = [("a", Value::Number(thinnest)), ("b", Value::Number(thickest))];
        let node = self.node("film_thickness", "math/mix", None, ends);
        self.link(&map, "g", &node, "t");
        self.link(&node, "out", "surface", "thin_film_thickness");
        Ok(())
    }

    /// Sets an input to a factor, times a channel of a texture where there is one.
    fn factor(
        &mut self,
        extension: &Extension<'_>,
        factor: &str,
        otherwise: f32,
        texture: &str,
        channel: &str,
        input: &str,
    ) -> Result<()> {
        let factor = self.one(extension, factor, otherwise)?;
        let map = self.map(extension, texture, ColorSpace::Linear, &format!("{input}_map"))?;
        self.scaled(input, map.as_deref().map(|m| (m, channel)), Value::Number(factor), &format!("{input}_factor"));
        Ok(())
    }

    /// The image node of a texture of an extension.
    fn map(
        &mut self,
        extension: &Extension<'_>,
        texture: &str,
        color_space: ColorSpace,
        name: &str,
    ) -> Result<Option<String>> {
        let Some(json) = extension.fields.get(texture) else { return Ok(None) };
        let info: json::texture::Info = self.read(extension, texture, json)?;
        self.image(Some(info_use(&info, color_space, name)))
    }

    /// A number of an extension.
    fn one(&self, extension: &Extension<'_>, field: &str, otherwise: f32) -> Result<f32> {
        let Some(json) = extension.fields.get(field) else { return Ok(otherwise) };
        let number: f32 = self.read(extension, field, json)?;
        self.number(number, field)
    }

    fn read<T: for<'de> serde::Deserialize<'de>>(
        &self,
        extension: &Extension<'_>,
        field: &str,
        json: &json::Value,
    ) -> Result<T> {
        json::deserialize::from_value(json.clone())
            .map_err(|error| Fault::new(&self.place, format!("{}.{field}: {error}", extension.name)))
    }
}
