//! The environment's part of the fragment stage: what each lobe reflects of the prefiltered light, lookup by lookup, and what
//! the surface hides of it.

use crate::CodegenError;
use crate::emit::expression::{EnvironmentTexture, ViewMember};
use crate::emit::fragment::Shading;
use crate::emit::terms::Terms;

/// One lookup of the prefiltered environment by reflection.
struct Mirror<'m> {
    /// What its lines are named after.
    name: &'m str,
    frame: &'m str,
    roughness: &'m str,
    /// The mirror direction in the world.
    dir: &'m str,
    /// Whether it fades below the horizon of the geometry.
    horizon: bool,
}

/// Another lookup of the prefiltered environment.
struct Lookup {
    /// What is seen there.
    name: &'static str,
    /// Direction in the world.
    dir: String,
    roughness: String,
}

impl Shading<'_, '_, '_> {
    /// Adds what each lobe reflects of the environment.
    pub(crate) fn environment(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        if plan.environment.is_none() {
            return Ok(());
        }
        let last_level = self.parts.needs.methods.is("irradiance", "last_level");
        let strips = self.strips();
        let by_mirror = plan.specular && (!strips || plan.horizon);
        if by_mirror || (plan.reads_irradiance() && last_level) {
            let mut direction = self.mirror()?;
            if self.has_mirror() {
                self.line(&format!("let mirror_dir = {direction};"));
                direction = "mirror_dir".into();
            }
            if self.leans() {
                direction = self.leaned("frame", &direction, &self.specular_roughness.clone())?;
            }
            let direction = self.turned(&direction)?;
            self.line(&format!("let reflection_dir = {direction};"));
        }
        if plan.reads_irradiance() {
            let irradiance = self.irradiance()?;
            self.line(&format!("let irradiance = {irradiance};"));
        }
        self.lookups()?;
        let mut terms = Terms::default();
        self.base(&mut terms)?;
        self.layers_above(&mut terms)?;
        self.sum_up(terms);
        Ok(())
    }

    /// Whether the base's reflection is looked up between the mirror direction and the normal.
    fn leans(&self) -> bool {
        self.parts.plan.specular && self.leaning()
    }

    /// Where a lobe about a mirror direction is looked up.
    fn leaned(&mut self, frame: &str, mirror: &str, roughness: &str) -> Result<String, CodegenError> {
        if !self.leaning() {
            return Ok(mirror.to_owned());
        }
        Ok(format!("{}({frame}, {mirror}, {roughness})", self.writer.library("specular_direction")?))
    }

    fn leaning(&self) -> bool {
        self.parts.needs.methods.is("reflection", "leaning")
    }

    /// Whether the mirror direction in the world is not where the base's reflection is looked up, and wanted.
    fn has_mirror(&self) -> bool {
        self.parts.plan.horizon && (self.leans() || self.parts.plan.environment == Some(true))
    }

    /// Whether the base's reflection is a row of lookups.
    fn strips(&self) -> bool {
        self.parts.plan.anisotropy && self.parts.needs.methods.is("anisotropy", "strips")
    }

    /// The light of all lobes: of each lookup of the prefiltered environment a line, but in one loop where the base's
    /// reflection is a row of them.
    fn lookups(&mut self) -> Result<(), CodegenError> {
        let mut lookups = Vec::new();
        if self.parts.plan.transmission {
            lookups.push(self.transmitted()?);
        }
        if self.parts.plan.coat {
            lookups.push(self.coat_reflection()?);
        }
        if self.strips() {
            let (rough, smooth) = lookups.into_iter().partition(|lookup| self.by_hermite(&lookup.roughness));
            self.loop_of_strips(rough)?;
            lookups = smooth;
        } else if self.parts.plan.specular {
            let roughness = self.specular_roughness.clone();
            let sample = self.prefiltered("reflection_dir", &roughness)?;
            self.line(&format!("let reflection = {sample};"));
        }
        for Lookup { name, dir, roughness } in lookups {
            let dir = self.turned(&dir)?;
            let sample = self.prefiltered(&dir, &roughness)?;
            self.line(&format!("let {name} = {sample};"));
        }
        Ok(())
    }

    /// Light that the base reflects along the tangent of a brushed surface, and what other lobes see: a lookup is long, and its
    /// code stands in the shader once.
    fn loop_of_strips(&mut self, others: Vec<Lookup>) -> Result<(), CodegenError> {
        let (strip, strips) = (self.writer.library("anisotropic_strip")?, self.writer.library("ANISOTROPIC_STRIPS")?);
        let strip = format!("let strip = {strip}(frame, tangent, alphas.x, alphas.y, f32(i));");
        let direction = self.leaned("frame", "strip.dir", "strip.perceptual_roughness")?;
        self.line("var strips = vec4f(0.0);");
        for Lookup { name, .. } in &others {
            self.line(&format!("var {name} = vec3f(0.0);"));
        }
        let Some((Lookup { dir, roughness, .. }, rest)) = others.split_first() else {
            let direction = self.turned(&direction)?;
            let sample = self.prefiltered(&direction, "strip.perceptual_roughness")?;
            self.line(&format!("for (var i = 0u; i < {strips}; i++) {{"));
            self.line(&format!("    {strip}"));
            self.line(&format!("    strips += strip.weight * vec4f({sample}, 1.0);"));
            self.line("}");
            self.line("let reflection = strips.rgb / strips.a;");
            return Ok(());
        };
        self.line(&format!("for (var i = 0u; i < {strips} + {}u; i++) {{", others.len()));
        self.line(&format!("    var lookup = vec4f({dir}, {roughness});"));
        self.line("    var weight = 0.0;");
        self.line(&format!("    if i < {strips} {{"));
        self.line(&format!("        {strip}"));
        self.line(&format!("        lookup = vec4f({direction}, strip.perceptual_roughness);"));
        self.line("        weight = strip.weight;");
        for (k, Lookup { dir, roughness, .. }) in rest.iter().enumerate() {
            self.line(&format!("    }} else if i == {strips} + {}u {{", k + 1));
            self.line(&format!("        lookup = vec4f({dir}, {roughness});"));
        }
        self.line("    }");
        let direction = self.turned("lookup.xyz")?;
        let sample = self.prefiltered(&direction, "lookup.w")?;
        self.line(&format!("    let seen = {sample};"));
        self.line("    strips += weight * vec4f(seen, 1.0);");
        // What was seen last is handed on from name to name, so that each has its own in the end.
        let next = rest.iter().map(|lookup| lookup.name).chain(["seen"]);
        for (Lookup { name, .. }, next) in others.iter().zip(next) {
            self.line(&format!("    {name} = {next};"));
        }
        self.line("}");
        self.line("let reflection = strips.rgb / strips.a;");
        Ok(())
    }

    /// Where light comes from that passes the base.
    fn transmitted(&mut self) -> Result<Lookup, CodegenError> {
        let roughness = self.root("perceptual_roughness", "0.5");
        let (dir, roughness) = if self.parts.plan.thin_walled {
            (format!("-{}", self.leaned("frame", "frame.view_dir", &roughness)?), roughness)
        } else {
            let lookup = self.writer.library("transmission_lookup")?;
            self.line(&format!("let behind = {lookup}(frame, transmission.eta, transmission.alpha);"));
            ("behind.dir".to_owned(), "behind.perceptual_roughness".to_owned())
        };
        Ok(Lookup { name: "transmitted", dir, roughness })
    }

    /// Where light comes from that the coat reflects.
    fn coat_reflection(&mut self) -> Result<Lookup, CodegenError> {
        let (frame, roughness) = (self.coat_frame, self.root("coat_roughness", "0.0"));
        self.line(&format!("let coat_mirror_dir = reflect(-{frame}.view_dir, {frame}.normal);"));
        let dir = self.leaned(frame, "coat_mirror_dir", &roughness)?;
        Ok(Lookup { name: "coat_reflection", dir, roughness })
    }

    /// The direction of the base's reflection in the world.
    fn mirror(&mut self) -> Result<String, CodegenError> {
        if !self.parts.plan.anisotropy || self.strips() {
            return Ok("reflect(-frame.view_dir, frame.normal)".into());
        }
        let bent = self.writer.library("anisotropic_reflection")?;
        let (strength, roughness) = (self.root("anisotropy", "0.0"), self.root("perceptual_roughness", "0.5"));
        Ok(format!("{bent}(frame, tangent, {strength}, {roughness})"))
    }

    /// Diffuse light over pi about the normal.
    fn irradiance(&mut self) -> Result<String, CodegenError> {
        if self.parts.needs.methods.is("irradiance", "last_level") {
            return self.prefiltered("reflection_dir", "1.0");
        }
        self.irradiance_about("frame.normal")
    }

    /// Diffuse light over pi about a unit direction of the world, or any where it is a cube.
    fn irradiance_about(&mut self, direction: &str) -> Result<String, CodegenError> {
        let direction = self.turned(direction)?;
        match self.parts.needs.methods.get("irradiance").name {
            "sh2" => {
                let coefficients = self.writer.view(ViewMember::IrradianceSh);
                Ok(format!("{}({coefficients}, {direction})", self.writer.library("irradiance_sh2")?))
            }
            "last_level" => self.prefiltered(&direction, "1.0"),
            _ => {
                let cube = self.writer.environment(EnvironmentTexture::IrradianceOverPi);
                let sample = self.writer.library("environment_sample")?;
                self.encoded(format!("{sample}({cube}, {direction}, 0.0)"))
            }
        }
    }

    /// The lobes of the base.
    fn base(&mut self, terms: &mut Terms) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        let occlusion = self.occlusion();
        if plan.diffuse {
            let lobe = self.writer.library("diffuse_environment")?;
            terms.base.push(format!("{lobe}(diffuse, irradiance){occlusion}"));
        }
        if plan.multiscatter {
            let lobe = self.writer.library("multiscatter_environment")?;
            terms.base.push(format!("{lobe}(multiscatter, irradiance){occlusion}"));
        }
        if plan.specular {
            let width = self.specular_roughness.clone();
            let compensated = if plan.compensation { " * compensation" } else { "" };
            let dir = if self.has_mirror() { "mirror_dir" } else { "reflection_dir" };
            let mirror = Mirror { name: "", frame: "frame", roughness: &width, dir, horizon: plan.horizon };
            let hidden = self.hidden(&mirror)?;
            let lobe = self.writer.library(if plan.anisotropy {
                "anisotropic_environment"
            } else {
                "specular_environment"
            })?;
            terms.base.push(format!("{lobe}(specular, reflection, dfg){compensated}{hidden}"));
        }
        if plan.transmission {
            let (lobe, mut f0) = (self.writer.library("transmission_environment")?, self.root("dielectric_f0", "0.0"));
            if plan.seen_from_inside() {
                // From inside nothing comes through beyond the critical angle, of which f0 knows nothing.
                let fresnel = self.writer.library("f_dielectric")?;
                f0 = format!("select({fresnel}(transmission.eta, frame.n_dot_v), {f0}, front_facing)");
            }
            terms.base.push(format!("{lobe}(transmission, {f0}, transmitted, dfg)"));
        }
        Ok(())
    }

    /// The lobes over it.
    fn layers_above(&mut self, terms: &mut Terms) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        if plan.coat {
            let (frame, roughness) = (self.coat_frame, self.root("coat_roughness", "0.0"));
            let (dir, horizon) = ("coat_mirror_dir", plan.coat_horizon);
            let hidden = self.hidden(&Mirror { name: "coat_", frame, roughness: &roughness, dir, horizon })?;
            let lobe = self.writer.library("coat_environment")?;
            terms.coat = Some(format!("{lobe}(coat, coat_reflection, coat_dfg){hidden}"));
        }
        if plan.sheen {
            let (lobe, occlusion) = (self.writer.library("sheen_environment")?, self.occlusion());
            let light = if plan.sheen_ring { self.sheen_ring()? } else { "irradiance".into() };
            terms.sheen = Some(format!("{lobe}(sheen, frame.n_dot_v, {light}){occlusion}"));
        }
        Ok(())
    }

    /// Adds the terms to what the lights gave.
    fn sum_up(&mut self, terms: Terms) {
        if !terms.is_layered() {
            for term in terms.base {
                self.add(&term);
            }
            return;
        }
        let (lines, sum) = terms.summed("reflected");
        for line in lines {
            self.line(&line);
        }
        self.add(&sum);
    }

    /// The environment's light as the sheen sees it, by two lookups: the second in the last level but one.
    fn sheen_ring(&mut self) -> Result<String, CodegenError> {
        let mut direction = format!("{}(frame)", self.writer.library("sheen_direction")?);
        if self.parts.needs.methods.is("irradiance", "sh2") {
            direction = format!("normalize({direction})");
        }
        let around = self.irradiance_about(&direction)?;
        self.line(&format!("let sheen_around = {around};"));
        let (direction, sample) = (self.turned("frame.normal")?, self.writer.library("environment_sample")?);
        let cube = self.writer.environment(EnvironmentTexture::PrefilteredRadiance);
        let levels = self.writer.view(ViewMember::EnvironmentLevels);
        let middle = self.encoded(format!("{sample}({cube}, {direction}, {levels} - 2.0)"))?;
        self.line(&format!("let sheen_middle = {middle};"));
        Ok(format!("{}(sheen, sheen_around, sheen_middle)", self.writer.library("sheen_ring")?))
    }

    /// The factor of what arrives under an occlusion map.
    fn occlusion(&self) -> String {
        if self.parts.plan.occlusion { format!(" * {}", self.root("occlusion", "1.0")) } else { String::new() }
    }

    /// A lookup of the prefiltered environment in a direction of its own.
    fn prefiltered(&mut self, direction: &str, roughness: &str) -> Result<String, CodegenError> {
        let methods = &self.parts.needs.methods;
        let hermite = self.by_hermite(roughness);
        let sample = self.writer.library(if hermite { "environment_sample_hermite" } else { "environment_sample" })?;
        let lod = self.writer.library(methods.get("level_map").function.unwrap_or("lod_geometric"))?;
        let cube = self.writer.environment(EnvironmentTexture::PrefilteredRadiance);
        let levels = self.writer.view(ViewMember::EnvironmentLevels);
        self.encoded(format!("{sample}({cube}, {direction}, {lod}({roughness}, {levels}))"))
    }

    /// Whether a lookup mixes levels by their slopes: up to the first prefiltered level they are mixed linearly, which is
    /// what the GPU does by itself.
    fn by_hermite(&self, roughness: &str) -> bool {
        let is_smooth = roughness.parse().is_ok_and(|roughness: f32| roughness <= 0.1);
        self.parts.needs.methods.is("level_map", "hermite") && !is_smooth
    }

    /// A reflection as the report codes it, or as it is.
    fn encoded(&mut self, sample: String) -> Result<String, CodegenError> {
        if !self.parts.needs.methods.is("encode", "report") {
            return Ok(sample);
        }
        Ok(format!("{}({sample})", self.writer.library("gamma_from_linear")?))
    }

    /// What a reflection is multiplied by where the surface hides it: under occlusion, and below its own horizon.
    fn hidden(&mut self, mirror: &Mirror<'_>) -> Result<String, CodegenError> {
        let plan = self.parts.plan;
        let Mirror { name, frame, roughness, dir, horizon } = *mirror;
        let mut factors = String::new();
        if plan.occlusion {
            let occlusion = self.root("occlusion", "1.0");
            factors += &match self.parts.needs.methods.get("specular_occlusion").function {
                Some(function) => {
                    format!(" * {}({frame}.n_dot_v, {occlusion}, {roughness})", self.writer.library(function)?)
                }
                None => format!(" * {occlusion}"),
            };
        }
        if let Some(function) = self.parts.needs.methods.get("horizon").function.filter(|_| horizon) {
            let function = self.writer.library(function)?;
            let mut geometric = self.writer.context("world_normal");
            if plan.double_sided {
                let side = format!("{name}geometric_normal");
                self.line(&format!("let {side} = select(-{geometric}, {geometric}, front_facing);"));
                geometric = side;
            }
            self.line(&format!(
                "let {name}horizon = {function}(dot({dir}, {geometric}), dot({frame}.normal, {geometric}), {frame}.n_dot_v, {roughness});"
            ));
            factors += &format!(" * {name}horizon");
        }
        Ok(factors)
    }

    /// A world direction as a direction of the environment.
    fn turned(&mut self, direction: &str) -> Result<String, CodegenError> {
        if self.parts.plan.environment != Some(true) {
            return Ok(direction.to_owned());
        }
        let rotation = self.writer.view(ViewMember::EnvironmentRotation);
        Ok(format!("{}({direction}, {rotation})", self.writer.library("rotate_about_y")?))
    }
}
