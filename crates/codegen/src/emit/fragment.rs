//! The fragment stage: the material's nodes, then the lobes as a chain of one-line calls in the order of their layers,
//! once per kind of light and once for the environment, then what is returned.
//!
//! All samples with implicit derivatives are taken by the nodes, before the first branch.

use halfvector_graph::document::AlphaMode;
use halfvector_graph::needs::{Needs, ShaderOutput, ToneMap};

use crate::CodegenError;
use crate::emit::expression::{Entrance, EnvironmentTexture, Names, Uses, ViewMember, Writer};
use crate::emit::lights::single;
use crate::emit::text::{Part, Text};
use crate::emit::value::number;
use crate::ir::Program;
use crate::link::Index;
use crate::names::Namer;
use crate::passes::plan::{Coupling, Plan};

/// What the fragment stage is written from.
pub(crate) struct FragmentParts<'p, 'a> {
    pub(crate) program: &'p Program<'a>,
    pub(crate) plan: &'p Plan,
    pub(crate) needs: &'p Needs,
    pub(crate) alpha_cutoff: f32,
    pub(crate) index: &'p Index,
    pub(crate) names: &'p Names,
}

/// Writes `fs_main`.
pub(crate) fn fragment(parts: &FragmentParts<'_, '_>) -> Result<(Text, Uses), CodegenError> {
    let FragmentParts { program, plan, index, names, .. } = parts;
    let mut writer = Writer::new(program, index, names, Entrance::Fragment, plan.height);
    let mut namer = Namer::new(index);
    writer.expressions(&program.fragment, &mut namer)?;
    let mut shading = Shading {
        parts,
        writer,
        lines: Text::of(Part::Fragment),
        first: true,
        coat_frame: "frame",
        specular_roughness: String::new(),
    };
    shading.discard();
    if plan.is_lit() {
        shading.lines.part = Part::Lobes;
        shading.setup()?;
        shading.lines.part = Part::Lights;
        shading.lights()?;
        shading.lines.part = Part::Environment;
        shading.environment()?;
    }
    shading.lines.part = Part::Output;
    shading.finish()?;
    let Shading { mut writer, lines, .. } = shading;

    let mut before = Text::of(Part::Fragment);
    if writer.uses.contexts.contains("world_normal") {
        let (safe, normal) = (writer.library("normalize_or")?, writer.member("world_normal"));
        before.line(&format!("    let world_normal = {safe}({normal}, vec3f(0.0, 0.0, 1.0));"));
    }
    if writer.uses.contexts.contains("view_dir") {
        let (camera, position) = (writer.view(ViewMember::CameraPosition), writer.member("world_position"));
        before.line(&format!("    let view_dir = normalize({camera} - {position});"));
    }
    let mut arguments = Vec::new();
    if !writer.uses.members.is_empty() {
        arguments.push("in: Varyings");
    }
    if plan.double_sided && plan.is_lit() {
        arguments.push("@builtin(front_facing) front_facing: bool");
    }
    let mut text = Text::of(Part::Fragment);
    text.line("@fragment");
    text.line(&format!("fn fs_main({}) -> @location(0) vec4f {{", arguments.join(", ")));
    text.append(&before);
    text.append(&writer.body);
    text.append(&lines);
    text.line("}");
    Ok((text, writer.uses))
}

/// The lines after the nodes.
pub(crate) struct Shading<'s, 'p, 'a> {
    pub(crate) parts: &'s FragmentParts<'p, 'a>,
    pub(crate) writer: Writer<'p, 'a>,
    lines: Text,
    /// Whether nothing has been added to `radiance` yet.
    pub(crate) first: bool,
    /// The frame of the coat.
    pub(crate) coat_frame: &'static str,
    /// The perceptual roughness at which the specular lobe's albedo is looked up.
    pub(crate) specular_roughness: String,
}

impl Shading<'_, '_, '_> {
    pub(crate) fn line(&mut self, line: &str) {
        self.lines.line(&format!("    {line}"));
    }

    pub(crate) fn root(&self, name: &str, otherwise: &str) -> String {
        self.parts
            .program
            .fragment
            .root(name)
            .map_or_else(|| otherwise.to_owned(), |id| self.writer.atom(id).to_owned())
    }

    pub(crate) fn add(&mut self, term: &str) {
        if std::mem::take(&mut self.first) {
            self.line(&format!("var radiance = {term};"));
        } else {
            self.line(&format!("radiance += {term};"));
        }
    }

    fn discard(&mut self) {
        if self.parts.plan.alpha_mode == AlphaMode::Mask {
            let opacity = self.root("opacity", "1.0");
            let cutoff = number(self.parts.alpha_cutoff);
            self.line(&format!("if {opacity} < {cutoff} {{"));
            self.line("    discard;");
            self.line("}");
        }
    }

    /// The frame, the lobes' parameters, and what scales them.
    fn setup(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        if self.parts.program.fragment.root("normal").is_none() {
            self.writer.context("world_normal");
        }
        let mut normal = self.root("normal", "world_normal");
        if plan.double_sided {
            self.line(&format!("let normal = select(-{normal}, {normal}, front_facing);"));
            normal = "normal".into();
        }
        let frame = self.writer.library("frame_from_normal")?;
        if plan.looks_at_view {
            let view_dir = self.writer.context("view_dir");
            self.line(&format!("let frame = {frame}({normal}, {view_dir});"));
        } else {
            self.line(&format!("let frame = {frame}({normal}, {normal}); // no lobe looks at the viewer"));
        }
        let roughness = self.root("perceptual_roughness", "0.5");
        self.specular()?;
        if plan.compensation {
            let method = self.parts.needs.methods.get("compensation");
            let factor = self.writer.library(method.function.unwrap_or("energy_compensation"))?;
            self.line(&format!("let compensation = {factor}(specular.f0, specular.f90, dfg);"));
        }
        if plan.multiscatter {
            let (lobe, width) = (self.writer.library("multiscatter_from_dfg")?, self.specular_roughness.clone());
            self.line(&format!("let multiscatter = {lobe}(specular.f0, specular.f90, dfg, {width});"));
        }
        if plan.diffuse {
            let (diffuse, mut color) = (self.writer.library("Diffuse")?, self.root("diffuse_color", "vec3f(0.5)"));
            if plan.transmission {
                color = format!("{color} * (1.0 - {})", self.root("transmission_weight", "0.0"));
            }
            if plan.coupling != Coupling::None {
                let compensated = plan.compensation || plan.multiscatter;
                let share = match (plan.thin_film, compensated) {
                    (true, _) => self.coupling_under_film()?,
                    (false, true) => self.coupling("coupling_compensated")?,
                    (false, false) => self.coupling("coupling_single")?,
                };
                color = format!("{color} * {share}");
            }
            self.line(&format!("let diffuse = {diffuse}({color}, {roughness});"));
        }
        if plan.transmission {
            let lobe = self.writer.library("Transmission")?;
            let (color, weight) = (self.root("diffuse_color", "vec3f(0.5)"), self.root("transmission_weight", "0.0"));
            let film = if plan.thin_film { " * film_through" } else { "" };
            let (mut ior, alpha) = (self.root("ior", "1.5"), self.alpha(&roughness)?);
            if plan.seen_from_inside() {
                ior = format!("select(1.0 / {ior}, {ior}, front_facing)");
            }
            self.line(&format!("let transmission = {lobe}({color} * {weight}{film}, {ior}, {alpha});"));
            if let Some(gain) = self.transmission_gain()? {
                self.line(&format!("let transmission_gain = {gain};"));
            }
        }
        self.layers()
    }

    /// The specular lobe, what it is looked up by, and the film on it.
    fn specular(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        self.specular_roughness = self.root("perceptual_roughness", "0.5");
        if plan.specular {
            let (f0, f90) = (self.root("f0", "vec3f(0.04)"), self.root("f90", "vec3f(1.0)"));
            let widths = self.widths()?;
            if plan.anisotropy && (plan.reads_dfg() || plan.environment.is_some()) {
                self.line("let specular_roughness = sqrt(sqrt(alphas.x * alphas.y));");
                self.specular_roughness = "specular_roughness".into();
            }
            let lobe = self.writer.library(if plan.anisotropy { "Anisotropic" } else { "Specular" })?;
            if plan.thin_film {
                self.view_dfg()?;
                self.film(&f0, &f90)?;
                let shift = if plan.reads_dfg() { " + film_shift" } else { "" };
                self.line(&format!("let specular = {lobe}({f0}{shift}, {f90}{shift}, {widths});"));
                return Ok(());
            }
            self.line(&format!("let specular = {lobe}({f0}, {f90}, {widths});"));
        }
        self.view_dfg()
    }

    /// The split sum's pair towards the viewer.
    fn view_dfg(&mut self) -> Result<(), CodegenError> {
        if self.parts.plan.reads_dfg() {
            let roughness = self.specular_roughness.clone();
            let lookup = self.dfg("frame.n_dot_v", &roughness)?;
            self.line(&format!("let dfg = {lookup};"));
        }
        Ok(())
    }

    /// The last arguments of the specular lobe: how wide it is, and along what.
    fn widths(&mut self) -> Result<String, CodegenError> {
        let roughness = self.root("perceptual_roughness", "0.5");
        if !self.parts.plan.anisotropy {
            return self.alpha(&roughness);
        }
        let (tangent, rotation) = (self.root("tangent", "vec4f(0.0)"), self.root("anisotropy_rotation", "0.0"));
        let strength = self.root("anisotropy", "0.0");
        let turned = if rotation == "0.0" {
            format!("{}(frame.normal, {tangent})", self.writer.library("tangent_across")?)
        } else {
            format!("{}(frame.normal, {tangent}, {rotation})", self.writer.library("anisotropic_tangent")?)
        };
        self.line(&format!("let tangent = {turned};"));
        let (alphas, floored) = (self.writer.library("anisotropic_alphas_gltf")?, self.floored(&roughness)?);
        self.line(&format!("let alphas = {alphas}({floored}, {strength});"));
        Ok("tangent, alphas.x, alphas.y".into())
    }

    /// The film on the base: what it adds to the reflection of an environment, which stands for all that is not lit from one
    /// direction. Of what it adds, the dielectric part's share is taken as 1 - metallic of it: exact where there is no metal,
    /// and where all is metal nothing lies below. A film over that part alone would cost 60 instructions more.
    fn film(&mut self, f0: &str, f90: &str) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        let (lobe, weight) = (self.writer.library("ThinFilm")?, self.root("thin_film_weight", "0.0"));
        let (thickness, ior) = (self.root("thin_film_thickness", "0.5"), self.root("thin_film_ior", "1.4"));
        self.line(&format!("let film = {lobe}({weight}, 1000.0 * {thickness}, {ior});"));
        if !plan.reads_dfg() {
            return Ok(());
        }
        let cosine = self.writer.library("thin_film_cosine")?;
        self.line(&format!("let film_cosine = {cosine}(dfg);"));
        if let Some(kind) = self.film_with_light() {
            self.light_sample(kind)?;
            let (both, l_dot_h) = (self.writer.library("thin_film_lit")?, self.light_cosine(&single(kind))?);
            self.line(&format!("let film_lit = {both}({f0}, {f90}, film, film_cosine, {l_dot_h});"));
            self.line("let film_shift = film_lit.shift;");
        } else {
            let shift = self.writer.library("thin_film_shift")?;
            self.line(&format!("let film_shift = {shift}({f0}, {f90}, film, film_cosine);"));
        }
        let (f0, f90) = self.dielectric_colors();
        let below = self.dielectric_shift();
        if plan.parts_film() {
            let metallic = self.root("metallic", "0.0");
            self.line(&format!("let {below} = film_shift * (1.0 - {metallic});"));
        }
        if plan.transmission {
            let through = self.writer.library("thin_film_through")?;
            self.line(&format!("let film_through = {through}({below}, {f0}, {f90}, film_cosine);"));
        }
        Ok(())
    }

    /// What the film adds to the dielectric part's reflection: what it adds at all, where there is no metal.
    fn dielectric_shift(&self) -> &'static str {
        if self.parts.plan.metal_in_part { "dielectric_shift" } else { "film_shift" }
    }

    /// What the interface under a film leaves to the diffuse base.
    fn coupling_under_film(&mut self) -> Result<String, CodegenError> {
        let (share, shift) = (self.writer.library("coupling_colored")?, self.dielectric_shift());
        let (f0, f90) = self.dielectric_colors();
        Ok(format!("{share}({f0} + {shift}, {f90} + {shift}, dfg)"))
    }

    /// What the interface over the diffuse base leaves to it.
    fn coupling(&mut self, share: &'static str) -> Result<String, CodegenError> {
        let (f0, f90) = self.dielectric();
        Ok(format!("{}({f0}, {f90}, dfg)", self.writer.library(share)?))
    }

    /// The layers over the base: their parameters, and what they leave to what lies below.
    fn layers(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        if plan.coat {
            let fragment = &self.parts.program.fragment;
            if fragment.root("coat_normal").is_some_and(|id| Some(id) != fragment.root("normal")) {
                let (normal, view_dir) = (self.root("coat_normal", "world_normal"), self.writer.context("view_dir"));
                let side =
                    if plan.double_sided { format!("select(-{normal}, {normal}, front_facing)") } else { normal };
                let frame = self.writer.library("frame_from_normal")?;
                self.line(&format!("let coat_frame = {frame}({side}, {view_dir});"));
                self.coat_frame = "coat_frame";
            }
            let (lobe, below) = (self.writer.library("Coat")?, self.writer.library("coat_base")?);
            let (weight, color) = (self.root("coat_weight", "0.0"), self.root("coat_color", "vec3f(1.0)"));
            let (f0, roughness) = (self.root("coat_f0", "0.04"), self.root("coat_roughness", "0.0"));
            let (alpha, n_dot_v) = (self.alpha(&roughness)?, format!("{}.n_dot_v", self.coat_frame));
            let dfg = self.dfg(&n_dot_v, &roughness)?;
            self.line(&format!("let coat = {lobe}({weight}, {color}, {f0}, {alpha});"));
            self.line(&format!("let coat_dfg = {dfg};"));
            self.line(&format!("let under_coat = {below}(coat, {n_dot_v}, coat_dfg);"));
        }
        if plan.sheen {
            let (lobe, below) = (self.writer.library("Sheen")?, self.writer.library("sheen_base")?);
            let (color, roughness) = (self.root("sheen_color", "vec3f(0.0)"), self.root("sheen_roughness", "0.3"));
            self.line(&format!("let sheen = {lobe}({color}, {roughness});"));
            self.line(&format!("let under_sheen = {below}(sheen, frame.n_dot_v);"));
        }
        Ok(())
    }

    /// The width of a lobe: not below what a light without extent can be drawn with.
    fn alpha(&mut self, roughness: &str) -> Result<String, CodegenError> {
        let alpha = self.writer.library("alpha_from_perceptual_roughness")?;
        Ok(format!("{alpha}({})", self.floored(roughness)?))
    }

    fn floored(&mut self, roughness: &str) -> Result<String, CodegenError> {
        if self.parts.plan.lights.is_empty() {
            return Ok(roughness.to_owned());
        }
        Ok(format!("max({roughness}, {})", self.writer.library("PUNCTUAL_ROUGHNESS_FLOOR")?))
    }

    /// The split sum's pair of a cosine at a roughness.
    pub(crate) fn dfg(&mut self, cosine: &str, roughness: &str) -> Result<String, CodegenError> {
        if let Some(fit) = self.parts.needs.methods.get("dfg").function {
            return Ok(format!("{}({cosine}, {roughness})", self.writer.library(fit)?));
        }
        let table = self.writer.environment(EnvironmentTexture::Dfg);
        Ok(format!("{}({table}, {cosine}, {roughness})", self.writer.library("dfg_from_table")?))
    }

    /// f0 and f90 of the interface over the diffuse base.
    pub(crate) fn dielectric(&self) -> (String, String) {
        (self.root("dielectric_f0", "0.04"), self.root("dielectric_f90", "1.0"))
    }

    /// The same in each channel.
    fn dielectric_colors(&self) -> (String, String) {
        let (f0, f90) = self.dielectric();
        (format!("vec3f({f0})"), format!("vec3f({f90})"))
    }

    /// Emission, opacity, and the display's coding.
    fn finish(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        if plan.emission {
            let emission = self.root("emission", "vec3f(0.0)");
            let under_coat = if plan.coat { " * under_coat" } else { "" };
            let under_sheen = if plan.sheen { " * under_sheen" } else { "" };
            self.add(&format!("{emission}{under_coat}{under_sheen}"));
        }
        if self.first {
            self.add("vec3f(0.0)");
        }
        if plan.is_lit() {
            let finite = self.writer.library("finite_or_zero")?;
            self.line(&format!("radiance = {finite}(radiance);"));
        }
        let mut color = "radiance".to_owned();
        if let ShaderOutput::Display(tone_map) = self.parts.needs.output {
            let exposure = self.writer.view(ViewMember::Exposure);
            let tone_map = self.writer.library(match tone_map {
                ToneMap::None => "tone_map_none",
                ToneMap::Reinhard => "tone_map_reinhard",
                ToneMap::Aces => "tone_map_aces",
                ToneMap::Agx => "tone_map_agx",
                ToneMap::PbrNeutral => "tone_map_pbr_neutral",
            })?;
            color = format!("{tone_map}(radiance * {exposure})");
            // The report's reflection is coded already.
            if !self.parts.needs.methods.is("encode", "report") {
                color = format!("{}({color})", self.writer.library("srgb_from_linear")?);
            }
            self.line(&format!("let display = {color};"));
            color = "display".into();
        }
        if plan.alpha_mode == AlphaMode::Blend {
            let opacity = self.root("opacity", "1.0");
            self.line(&format!("let opacity = saturate({opacity});"));
            self.line(&format!("return vec4f({color} * opacity, opacity);"));
        } else {
            self.line(&format!("return vec4f({color}, 1.0);"));
        }
        Ok(())
    }
}
