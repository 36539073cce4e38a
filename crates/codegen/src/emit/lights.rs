//! The lights' part of the fragment stage: what each lobe reflects of each light, once for each kind of light.

use crate::CodegenError;
use crate::emit::expression::lights_member;
use crate::emit::fragment::Shading;
use crate::emit::terms::Terms;
use crate::passes::plan::Coupling;
use crate::reflection::LightKind;

impl Shading<'_, '_, '_> {
    /// Adds what each lobe reflects of each light.
    pub(crate) fn lights(&mut self) -> Result<(), CodegenError> {
        for &(kind, count) in &self.parts.plan.lights {
            if count == 1 {
                let light = single(kind);
                if self.film_with_light().is_none() {
                    self.light_sample(kind)?;
                }
                for line in self.light_lines(&light)? {
                    self.line(&line);
                }
                let (lines, sum) = self.light_terms(&light)?.summed(&format!("{}_lit", lights_member(kind)));
                for line in lines {
                    self.line(&line);
                }
                self.add(&format!("{sum} * {light}.illuminance"));
            } else {
                if std::mem::take(&mut self.first) {
                    self.line("var radiance = vec3f(0.0);");
                }
                let light = self.light_at(kind, "[i]")?;
                self.line(&format!("for (var i = 0u; i < {count}u; i++) {{"));
                self.line(&format!("    let light = {light};"));
                let mut lines = self.light_lines("light")?;
                let (sums, sum) = self.light_terms("light")?.summed("lit");
                lines.extend(sums);
                lines.push(format!("radiance += {sum} * light.illuminance;"));
                for line in lines {
                    self.line(&format!("    {line}"));
                }
                self.line("}");
            }
        }
        Ok(())
    }

    /// What arrives from a light of a kind, of which there may be a list.
    fn light_at(&mut self, kind: LightKind, index: &str) -> Result<String, CodegenError> {
        self.writer.uses.lights = true;
        let sample = self.writer.library(match kind {
            LightKind::Directional => "directional_light_sample",
            LightKind::Point => "point_light_sample",
            LightKind::Spot => "spot_light_sample",
        })?;
        // A directional light is the same everywhere: for it alone no position is interpolated.
        let position = if kind == LightKind::Directional && !self.parts.plan.looks_at_view {
            "vec3f(0.0)".to_owned()
        } else {
            self.writer.member("world_position")
        };
        Ok(format!("{sample}(lights.{}{index}, {position})", lights_member(kind)))
    }

    /// The one light of its kind.
    pub(crate) fn light_sample(&mut self, kind: LightKind) -> Result<(), CodegenError> {
        let light = self.light_at(kind, "")?;
        self.line(&format!("let {} = {light};", single(kind)));
        Ok(())
    }

    /// The light whose film is looked at together with that of the lobe: the only one.
    pub(crate) fn film_with_light(&self) -> Option<LightKind> {
        let plan = self.parts.plan;
        match plan.lights[..] {
            [(kind, 1)] if plan.thin_film && plan.reads_dfg() => Some(kind),
            _ => None,
        }
    }

    /// What several terms of a light share: the split sum's pair towards it, and what the film reflects of it.
    fn light_lines(&mut self, light: &str) -> Result<Vec<String>, CodegenError> {
        let plan = self.parts.plan;
        let mut lines = Vec::new();
        if plan.reads_light_dfg() {
            let roughness = self.specular_roughness.clone();
            let lookup = self.dfg(&format!("saturate(dot(frame.normal, {light}.dir))"), &roughness)?;
            lines.push(format!("let {light}_dfg = {lookup};"));
        }
        if plan.thin_film && self.film_with_light().is_none() {
            let fresnel = self.writer.library("thin_film_fresnel")?;
            let (f0, f90) = (self.root("f0", "vec3f(0.04)"), self.root("f90", "vec3f(1.0)"));
            let cosine = self.light_cosine(light)?;
            lines.push(format!("let {light}_film = {fresnel}({f0}, {f90}, film, {cosine});"));
        }
        Ok(lines)
    }

    /// l.h of a light.
    pub(crate) fn light_cosine(&mut self, light: &str) -> Result<String, CodegenError> {
        Ok(format!("{}(frame, {light}.dir).l_dot_h", self.writer.library("half_from_light")?))
    }

    /// What one light through the surface is multiplied by: what brings back the loss of single scattering, and for a body
    /// eta^2, for light that enters it leaves it again. An environment's lookup has both already.
    pub(crate) fn transmission_gain(&mut self) -> Result<Option<String>, CodegenError> {
        let plan = self.parts.plan;
        if plan.lights.is_empty() {
            return Ok(None);
        }
        let gains = !self.parts.needs.methods.is("compensation", "none");
        Ok(match (plan.thin_walled, gains) {
            (true, false) => None,
            (true, true) => {
                let f0 = self.root("dielectric_f0", "0.0");
                Some(format!("{}({f0}, dfg)", self.writer.library("transmission_thin_compensation")?))
            }
            (false, false) => Some("transmission.eta * transmission.eta".to_owned()),
            (false, true) => {
                let compensation = self.writer.library("transmission_compensation")?;
                Some(format!("transmission.eta * transmission.eta * {compensation}(frame.n_dot_v, transmission)"))
            }
        })
    }

    /// What each lobe reflects of one light, for an illuminance of 1.
    fn light_terms(&mut self, light: &str) -> Result<Terms, CodegenError> {
        let plan = self.parts.plan;
        let mut terms = Terms::default();
        if plan.diffuse {
            let lobe = self.writer.library("diffuse_eval")?;
            let mut share = String::new();
            if plan.coupling == Coupling::Reciprocal {
                let coupling = self.writer.library("coupling_light")?;
                let ((f0, f90), roughness) = (self.dielectric(), &self.specular_roughness);
                share = format!(" * {coupling}({f0}, {f90}, {light}_dfg, {roughness})");
            }
            terms.base.push(format!("{lobe}(frame, {light}.dir, diffuse){share}"));
        }
        if plan.specular {
            // Under a film the reflectance is that light's own.
            let film = match self.film_with_light() {
                _ if !plan.thin_film => String::new(),
                Some(_) => " * film_lit.fresnel".to_owned(),
                None => format!(" * {light}_film"),
            };
            let lobe = self.writer.library(match (plan.anisotropy, plan.thin_film) {
                (false, false) => "specular_eval",
                (false, true) => "specular_lit",
                (true, false) => "anisotropic_eval",
                (true, true) => "anisotropic_lit",
            })?;
            let compensated = if plan.compensation { " * compensation" } else { "" };
            terms.base.push(format!("{lobe}(frame, {light}.dir, specular){film}{compensated}"));
        }
        if plan.multiscatter {
            let lobe = self.writer.library("multiscatter_eval")?;
            terms.base.push(format!("{lobe}(frame, {light}.dir, multiscatter, {light}_dfg)"));
        }
        if plan.transmission {
            let eval = if plan.thin_walled { "transmission_thin_eval" } else { "transmission_eval" };
            let lobe = self.writer.library(eval)?;
            let gain = if self.transmission_gain()?.is_some() { " * transmission_gain" } else { "" };
            terms.base.push(format!("{lobe}(frame, {light}.dir, transmission){gain}"));
        }
        if plan.coat {
            let (lobe, frame) = (self.writer.library("coat_eval")?, self.coat_frame);
            terms.coat = Some(format!("{lobe}({frame}, {light}.dir, coat)"));
        }
        if plan.sheen {
            let lobe = self.writer.library("sheen_eval")?;
            terms.sheen = Some(format!("{lobe}(frame, {light}.dir, sheen)"));
        }
        Ok(terms)
    }
}

/// What the only light of a kind is called.
pub(crate) fn single(kind: LightKind) -> String {
    format!("{}_light", lights_member(kind))
}
