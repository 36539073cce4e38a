//! The comment at the top of a shader: what it is, what it serves, what was left out and why.

use halfvector_graph::document::Document;
use halfvector_graph::method::TERMS;
use halfvector_graph::needs::{Needs, ShaderOutput};

use crate::emit::material::Product;
use crate::emit::text::Text;
use crate::names::comment;
use crate::passes::plan::{Keep, Plan};
use crate::reflection::LightKind;
use crate::{Dropped, Remark};

/// Widest line of the header.
const WIDTH: usize = 118;

pub(crate) fn header(document: &Document, plan: &Plan, needs: &Needs, remarks: &[Remark], text: &mut Text) {
    paragraph("", &title(document), text);
    paragraph("serves: ", &serves(plan, needs), text);
    if plan.is_lit() {
        let chosen = methods(plan, needs).iter().map(|(term, method)| format!("{term}={method}")).collect::<Vec<_>>();
        paragraph("methods: ", &chosen.join(", "), text);
    }
    for remark in remarks {
        let words: Vec<String> = remark.text.split_whitespace().map(comment).collect();
        paragraph(&format!("{}: ", remark.lead), &words.join(" "), text);
    }
    left_out(&plan.dropped, text);
    text.line("");
}

/// What the shader does without. A lobe of weight 0 leaves no trace, not even its name: of those it is told what they save.
fn left_out(dropped: &[Dropped], text: &mut Text) {
    let (lobes, others): (Vec<_>, Vec<_>) = dropped.iter().partition(|one| matches!(one.kept_by, Keep::Lobe(_)));
    for Dropped { what, why, instructions, .. } in others {
        let saved = instructions.map_or_else(String::new, |count| match count {
            1 => " (saves 1 instruction)".to_owned(),
            _ => format!(" (saves {count} instructions)"),
        });
        paragraph("left out: ", &format!("{what}: {why}{saved}"), text);
    }
    let saved: Option<Vec<u32>> = lobes.iter().map(|one| one.instructions).collect();
    if let Some(saved) = saved.filter(|saved| !saved.is_empty()) {
        let (count, most, least) = (saved.len(), saved.iter().max(), saved.iter().min());
        let range = match (least, most) {
            (Some(least), Some(most)) if least < most => format!("{least} to {most} instructions each"),
            (Some(least), _) => format!("{least} instructions"),
            _ => return,
        };
        let (lobes, weights) = if count == 1 { ("lobe", "its weight is") } else { ("lobes", "their weights are") };
        paragraph("left out: ", &format!("{count} {lobes}: {weights} 0 (saves {range})"), text);
    }
}

pub(crate) fn material_header(document: &Document, product: Product, text: &mut Text) {
    let serves = match product {
        Product::Surface => "your own lights: `material` returns the surface, nothing is shaded here",
        Product::Height => {
            "your own displacement: `height` returns the length by which a vertex moves along its normal"
        }
        Product::HeightChange => "your own normals: `height_change` returns the derivatives of the height",
    };
    paragraph("", &title(document), text);
    paragraph("serves: ", serves, text);
    text.line("");
}

fn title(document: &Document) -> String {
    let name = comment(&document.name);
    format!("{}, made by Halfvector", if name.is_empty() { "A material" } else { &name })
}

fn serves(plan: &Plan, needs: &Needs) -> String {
    let mut parts: Vec<String> = plan
        .lights
        .iter()
        .map(|(kind, count)| {
            let kind = match kind {
                LightKind::Directional => "directional",
                LightKind::Point => "point",
                LightKind::Spot => "spot",
            };
            format!("{count} {kind} light{}", if *count == 1 { "" } else { "s" })
        })
        .collect();
    match plan.environment {
        Some(true) => parts.push("an environment, turned about +Y".into()),
        Some(false) => parts.push("an environment".into()),
        None => {}
    }
    if parts.is_empty() {
        parts.push("no light".into());
    }
    let output = match needs.output {
        ShaderOutput::Radiance => "returns linear radiance, Rec. 709".to_owned(),
        ShaderOutput::Display(tone_map) => format!("returns display values through the tone map `{}`", tone_map.name()),
    };
    format!("{}; {output}", parts.join(", "))
}

/// The methods that this shader uses; the terms that it has no part of are left out.
pub(crate) fn methods(plan: &Plan, needs: &Needs) -> Vec<(&'static str, &'static str)> {
    if !plan.is_lit() {
        return Vec::new();
    }
    let environment = plan.environment.is_some();
    let used = |term: &str| match term {
        "d" | "v" => ((plan.specular && !plan.anisotropy) || plan.coat) && !plan.lights.is_empty(),
        "fresnel" => (plan.specular || plan.coat) && !plan.lights.is_empty(),
        "diffuse" => plan.diffuse && !plan.lights.is_empty(),
        "compensation" => plan.compensation || plan.multiscatter,
        "coupling" => plan.diffuse && plan.specular,
        "dfg" => plan.reads_dfg() || plan.coat,
        "level_map" | "prefilter" => (plan.specular || plan.coat || plan.transmission) && environment,
        "reflection" => {
            let thin = plan.transmission && plan.thin_walled;
            (plan.specular || plan.coat || thin) && environment
        }
        "sheen" => plan.sheen && environment,
        "specular_occlusion" => (plan.specular || plan.coat) && plan.occlusion,
        "specular_aa" => plan.is_filtered,
        "horizon" => plan.horizon || plan.coat_horizon,
        "anisotropy" => plan.anisotropy && environment,
        "irradiance" => plan.reads_irradiance() || (plan.sheen && environment),
        "encode" => environment && needs.methods.is("encode", "report"),
        "height_normals" => plan.height,
        _ => false,
    };
    let chosen = TERMS.iter().filter(|term| used(term.name));
    chosen.map(|term| (term.name, needs.methods.get(term.name).name)).collect()
}

/// A paragraph of comment lines, broken between words.
fn paragraph(lead: &str, content: &str, text: &mut Text) {
    let mut line = format!("// {lead}");
    let indent = format!("//   {}", if lead.is_empty() { "" } else { "  " });
    let mut has_word = false;
    for word in content.split_whitespace() {
        if has_word && line.chars().count() + 1 + word.chars().count() > WIDTH {
            text.line(line.trim_end());
            line = indent.clone();
            has_word = false;
        }
        if has_word {
            line.push(' ');
        }
        line.push_str(word);
        has_word = true;
    }
    text.line(line.trim_end());
}
