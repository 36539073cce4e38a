//! The lights' part of the fragment stage: what each lobe reflects of each light, once for each kind of light.

use crate::CodegenError;
use crate::emit::expression::lights_member;
use crate::emit::fragment::Shading;
use crate::passes::plan::Coupling;
use crate::reflection::LightKind;

impl Shading<'_, '_, '_> {
    /// Adds what each lobe reflects of each light.
    pub(crate) fn lights(&mut self) -> Result<(), CodegenError> {
        let plan = self.parts.plan;
        for &(kind, count) in &plan.lights {
            self.writer.uses.lights = true;
            let sample = self.writer.library(match kind {
                LightKind::Directional => "directional_light_sample",
                LightKind::Point => "point_light_sample",
                LightKind::Spot => "spot_light_sample",
            })?;
            let member = lights_member(kind);
            // A directional light is the same everywhere: for it alone no position is interpolated.
            let position = if kind == LightKind::Directional && !plan.looks_at_view {
                "vec3f(0.0)".to_owned()
            } else {
                self.writer.member("world_position")
            };
            if count == 1 {
                let light = format!("{member}_light");
                self.line(&format!("let {light} = {sample}(lights.{member}, {position});"));
                for line in self.light_lines(&light)? {
                    self.line(&line);
                }
                for term in self.light_terms(&light)? {
                    self.add(&term);
                }
            } else {
                if std::mem::take(&mut self.first) {
                    self.line("var radiance = vec3f(0.0);");
                }
                self.line(&format!("for (var i = 0u; i < {count}u; i++) {{"));
                self.line(&format!("    let light = {sample}(lights.{member}[i], {position});"));
                for line in self.light_lines("light")? {
                    self.line(&format!("    {line}"));
                }
                for term in self.light_terms("light")? {
                    self.line(&format!("    radiance += {term};"));
                }
                self.line("}");
            }
        }
        Ok(())
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
        if plan.thin_film {
            let (fresnel, half) = (self.writer.library("thin_film_fresnel")?, self.writer.library("half_from_light")?);
            let (f0, f90) = (self.root("f0", "vec3f(0.04)"), self.root("f90", "vec3f(1.0)"));
            let cosine = format!("{half}(frame, {light}.dir).l_dot_h");
            lines.push(format!("let {light}_film = {fresnel}({f0}, {f90}, film, {cosine});"));
        }
        Ok(lines)
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

    /// What one light adds by each lobe.
    fn light_terms(&mut self, light: &str) -> Result<Vec<String>, CodegenError> {
        let plan = self.parts.plan;
        let mut terms = Vec::new();
        let (base, coat_frame) = (self.over_base, self.coat_frame);
        if plan.diffuse {
            let lobe = self.writer.library("diffuse_eval")?;
            let mut share = String::new();
            if plan.coupling == Coupling::Reciprocal {
                let coupling = self.writer.library("coupling_light")?;
                let ((f0, f90), roughness) = (self.dielectric(), &self.specular_roughness);
                share = format!(" * {coupling}({f0}, {f90}, {light}_dfg, {roughness})");
            }
            terms.push(format!("{lobe}(frame, {light}.dir, diffuse){share}{base} * {light}.illuminance"));
        }
        if plan.specular {
            // Under a film the reflectance is that light's own.
            let (lobe, film) = match (plan.anisotropy, plan.thin_film) {
                (false, false) => ("specular_eval", String::new()),
                (false, true) => ("specular_lit", format!(" * {light}_film")),
                (true, false) => ("anisotropic_eval", String::new()),
                (true, true) => ("anisotropic_lit", format!(" * {light}_film")),
            };
            let lobe = self.writer.library(lobe)?;
            let compensated = if plan.compensation { " * compensation" } else { "" };
            terms.push(format!("{lobe}(frame, {light}.dir, specular){film}{compensated}{base} * {light}.illuminance"));
        }
        if plan.multiscatter {
            let lobe = self.writer.library("multiscatter_eval")?;
            terms.push(format!("{lobe}(frame, {light}.dir, multiscatter, {light}_dfg){base} * {light}.illuminance"));
        }
        if plan.transmission {
            let eval = if plan.thin_walled { "transmission_thin_eval" } else { "transmission_eval" };
            let lobe = self.writer.library(eval)?;
            let gain = if self.transmission_gain()?.is_some() { " * transmission_gain" } else { "" };
            terms.push(format!("{lobe}(frame, {light}.dir, transmission){gain}{base} * {light}.illuminance"));
        }
        if plan.coat {
            let (lobe, above) = (self.writer.library("coat_eval")?, self.over_coat);
            terms.push(format!("{lobe}({coat_frame}, {light}.dir, coat){above} * {light}.illuminance"));
        }
        if plan.sheen {
            let lobe = self.writer.library("sheen_eval")?;
            terms.push(format!("{lobe}(frame, {light}.dir, sheen) * {light}.illuminance"));
        }
        Ok(terms)
    }
}
