//! Pass: what the plan's shading is fed with becomes expressions, and what it does not read goes.

use halfvector_graph::document::AlphaMode;
use halfvector_graph::needs::Needs;
use halfvector_graph::value::Type;

use crate::ir::{Expr, Id, Program, Stage};
use crate::link::Index;
use crate::passes::fold::fold_stage;
use crate::passes::lower::{DISPLACED_NORMAL, displaced_tangent};
use crate::passes::plan::{Constants, Coupling, Known, Metal, Plan, Wanted, decide, metal};

/// Takes the decisions that are the same whatever is folded, on a program whose numbers are folded.
pub(crate) fn constants(program: &Program<'_>, index: &Index) -> Constants {
    let stage = &program.fragment;
    let literal = |socket: &str| stage.root(socket).and_then(|id| stage.arena.as_literal(id));
    let is = |socket: &str, x: f32| literal(socket).is_some_and(|l| l.is_all(x));
    let fixed = ["ior", "specular"].iter().all(|socket| literal(socket).is_some());
    let roughness = literal("perceptual_roughness").filter(|_| is("metallic", 0.0) && fixed);
    let Some(roughness) = roughness.map(|l| l.components()[0]) else { return Constants { dielectric: None } };
    let mut probe = Stage::default();
    if let Some(ior) = literal("ior") {
        let id = probe.arena.literal(ior.ty, &ior.numbers());
        probe.roots.insert("ior", id);
    }
    if let Some(specular) = literal("specular") {
        let id = probe.arena.literal(specular.ty, &specular.numbers());
        probe.roots.insert("specular", id);
    }
    let weight = input(&mut probe, "specular", Type::F32, 1.0);
    let f0 = dielectric_f0(&mut probe, weight, is("specular", 1.0), is("specular", 0.0));
    probe.roots.insert("dielectric_f0", f0);
    fold_stage(&mut probe, index, &mut Vec::new());
    let folded = probe.root("dielectric_f0").and_then(|id| probe.arena.as_literal(id));
    Constants { dielectric: folded.map(|l| [l.components()[0], roughness]) }
}

/// The sockets that shading reads, of a surface that has all of them.
pub(crate) const SOCKETS: [&str; 22] = [
    "base_color",
    "metallic",
    "perceptual_roughness",
    "ior",
    "specular",
    "normal",
    "occlusion",
    "emission",
    "opacity",
    "coat_weight",
    "coat_color",
    "coat_roughness",
    "coat_ior",
    "coat_normal",
    "sheen_color",
    "sheen_roughness",
    "transmission_weight",
    "anisotropy",
    "anisotropy_rotation",
    "thin_film_weight",
    "thin_film_thickness",
    "thin_film_ior",
];

/// Those of them that are normals: a displaced surface changes what they are by default.
pub(crate) const NORMALS: [&str; 2] = ["normal", "coat_normal"];

/// Decides what is emitted, and makes what it is fed with.
pub(crate) fn specialise(program: &mut Program<'_>, wanted: Wanted<'_>) -> Plan {
    let plan = decide(program, wanted);
    let Wanted { needs, fold, .. } = wanted;
    let metal = metal(program, fold);
    let weightless = Known { program, fold }.surface("specular", 0.0);
    let full = Known { program, fold }.surface("specular", 1.0);
    let stage = &mut program.fragment;
    if plan.diffuse || plan.transmission {
        let color = diffuse_color(stage, metal);
        stage.roots.insert("diffuse_color", color);
    }
    if plan.specular {
        let sheet = plan.thin_walled;
        let Reflectances { f0, f90, dielectric } = reflectances(stage, metal, weightless, full, sheet);
        stage.roots.insert("f0", f0);
        stage.roots.insert("f90", f90);
        let by_dielectric = plan.coupling != Coupling::None || plan.transmission;
        if let (Some((f0, f90)), true) = (dielectric, by_dielectric) {
            stage.roots.insert("dielectric_f0", f0);
            stage.roots.insert("dielectric_f90", f90);
        }
    }
    if plan.anisotropy {
        let tangent = tangent(stage, needs);
        stage.roots.insert("tangent", tangent);
    }
    if plan.coat {
        let ior = input(stage, "coat_ior", Type::F32, 1.5);
        let call = Expr::Call { function: "f0_from_ior", generic: None, arguments: vec![ior] };
        let f0 = stage.arena.own(call, Type::F32, "coat_f0");
        stage.roots.insert("coat_f0", f0);
    }
    if let Some(function) = needs.methods.get("specular_aa").function.filter(|_| plan.is_filtered) {
        filter_roughness(stage, &plan, function);
    }
    keep_wanted(stage, &plan);
    if !plan.height {
        program.vertex = Stage::default();
    }
    plan
}

/// The roughness of each lobe with its normal's turn within the pixel.
fn filter_roughness(stage: &mut Stage<'_>, plan: &Plan, function: &'static str) {
    let base = plan.specular || plan.transmission;
    for (wanted, roughness, otherwise, normal, name) in [
        (base, "perceptual_roughness", 0.5, "normal", "filtered_roughness"),
        (plan.coat, "coat_roughness", 0.0, "coat_normal", "filtered_coat_roughness"),
    ] {
        if !wanted {
            continue;
        }
        let own = input(stage, roughness, Type::F32, otherwise);
        let normal =
            stage.root(normal).unwrap_or_else(|| stage.arena.own(Expr::Context("world_normal"), Type::Vec3, ""));
        let mut along = |name| stage.arena.own(Expr::Builtin { name, arguments: vec![normal] }, Type::Vec3, "");
        let arguments = vec![own, along("dpdx"), along("dpdy")];
        let filtered = Expr::Call { function, generic: None, arguments };
        let filtered = stage.arena.own(filtered, Type::F32, name);
        stage.roots.insert(roughness, filtered);
    }
}

fn diffuse_color<'a>(stage: &mut Stage<'a>, metal: Metal) -> Id {
    let base_color = input(stage, "base_color", Type::Vec3, 0.5);
    if metal == Metal::None {
        return base_color;
    }
    let metallic = input(stage, "metallic", Type::F32, 0.0);
    let expr = Expr::Call { function: "diffuse_color", generic: None, arguments: vec![base_color, metallic] };
    stage.arena.own(expr, Type::Vec3, "diffuse_albedo")
}

/// Reflectances at normal and at grazing incidence.
struct Reflectances {
    /// Of the specular lobe.
    f0: Id,
    f90: Id,
    /// Of the dielectric part of it alone: two numbers.
    dielectric: Option<(Id, Id)>,
}

/// f0 and f90 of the specular lobe. Khronos 2021, KHR_materials_ior and KHR_materials_specular: the dielectric's are
/// scaled by the weight `specular`, a metal's f0 is its base colour and its f90 is 1.
fn reflectances<'a>(stage: &mut Stage<'a>, metal: Metal, weightless: bool, full: bool, sheet: bool) -> Reflectances {
    let arena_one = |stage: &mut Stage<'a>, x: f64| stage.arena.literal(Type::Vec3, &[x]);
    if metal == Metal::Whole {
        let (f0, f90) = (input(stage, "base_color", Type::Vec3, 0.5), arena_one(stage, 1.0));
        return Reflectances { f0, f90, dielectric: None };
    }
    let weight = if full {
        stage.arena.literal(Type::F32, &[1.0])
    } else if weightless {
        stage.arena.literal(Type::F32, &[0.0])
    } else {
        input(stage, "specular", Type::F32, 1.0)
    };
    let mut dielectric_f0 = dielectric_f0(stage, weight, full, weightless);
    if sheet && !weightless {
        let through = input(stage, "transmission_weight", Type::F32, 0.0);
        let call = Expr::Call { function: "f0_of_sheet", generic: None, arguments: vec![dielectric_f0, through] };
        dielectric_f0 = stage.arena.own(call, Type::F32, "sheet_f0");
    }
    if metal == Metal::None {
        let (f0, f90) = (stage.arena.convert(dielectric_f0, Type::Vec3), stage.arena.convert(weight, Type::Vec3));
        return Reflectances { f0, f90, dielectric: Some((dielectric_f0, weight)) };
    }
    let base_color = input(stage, "base_color", Type::Vec3, 0.5);
    let metallic = input(stage, "metallic", Type::F32, 0.0);
    let arguments = vec![base_color, metallic, dielectric_f0];
    let call = Expr::Call { function: "f0_from_metallic", generic: None, arguments };
    let f0 = stage.arena.own(call, Type::Vec3, "f0");
    let f90 = if full {
        arena_one(stage, 1.0)
    } else {
        let one = stage.arena.literal(Type::F32, &[1.0]);
        let mixed = Expr::Builtin { name: "mix", arguments: vec![weight, one, metallic] };
        let mixed = stage.arena.own(mixed, Type::F32, "f90");
        stage.arena.convert(mixed, Type::Vec3)
    };
    Reflectances { f0, f90, dielectric: Some((dielectric_f0, weight)) }
}

/// The tangent that a brushed surface follows, with its handedness: the mesh's, or the pixel's where normal maps take
/// that one too.
fn tangent(stage: &mut Stage<'_>, needs: &Needs) -> Id {
    let tangent = mesh_tangent(stage, needs);
    match stage.root(DISPLACED_NORMAL) {
        Some(normal) => displaced_tangent(&mut stage.arena, tangent, normal),
        None => tangent,
    }
}

/// The tangent before displacement.
fn mesh_tangent(stage: &mut Stage<'_>, needs: &Needs) -> Id {
    if !needs.methods.is("normal", "tbn_derivative") {
        return stage.arena.own(Expr::Context("world_tangent"), Type::Vec4, "");
    }
    let mut derivatives = |context, ty| {
        let of = stage.arena.own(Expr::Context(context), ty, "");
        let mut along = |name| stage.arena.own(Expr::Builtin { name, arguments: vec![of] }, ty, "");
        [along("dpdx"), along("dpdy")]
    };
    let [position_ddx, position_ddy] = derivatives("world_position", Type::Vec3);
    let [uv_ddx, uv_ddy] = derivatives("uv0", Type::Vec2);
    let normal = stage.arena.own(Expr::Context("world_normal"), Type::Vec3, "");
    let arguments = vec![position_ddx, position_ddy, normal, uv_ddx, uv_ddy];
    let call = Expr::Call { function: "tangent_from_derivatives", generic: None, arguments };
    stage.arena.own(call, Type::Vec4, "pixel_tangent")
}

/// The dielectric's f0: of the index of refraction, times the weight.
fn dielectric_f0(stage: &mut Stage<'_>, weight: Id, full: bool, weightless: bool) -> Id {
    if weightless {
        return weight;
    }
    let ior = input(stage, "ior", Type::F32, 1.5);
    let expr = Expr::Call { function: "f0_from_ior", generic: None, arguments: vec![ior] };
    let f0 = stage.arena.own(expr, Type::F32, "dielectric_f0");
    if full {
        return f0;
    }
    let weighted = Expr::Builtin { name: "*", arguments: vec![f0, weight] };
    stage.arena.own(weighted, Type::F32, "dielectric_f0")
}

/// A socket's value, or a constant for a surface node that has no such socket.
fn input(stage: &mut Stage<'_>, socket: &'static str, ty: Type, otherwise: f64) -> Id {
    match stage.root(socket) {
        Some(id) => id,
        None => stage.arena.literal(ty, &[otherwise]),
    }
}

/// Leaves as roots only what the shading of this plan reads.
fn keep_wanted(stage: &mut Stage<'_>, plan: &Plan) {
    stage.roots.retain(|name, _| match *name {
        "diffuse_color" | "f0" | "f90" | "dielectric_f0" | "dielectric_f90" | "coat_f0" => true,
        "normal" => plan.is_lit(),
        "perceptual_roughness" => plan.has_base(),
        "coat_weight" | "coat_color" | "coat_roughness" | "coat_normal" => plan.coat,
        "sheen_color" | "sheen_roughness" => plan.sheen,
        "transmission_weight" | "ior" => plan.transmission,
        "anisotropy" | "anisotropy_rotation" | "tangent" => plan.anisotropy,
        "thin_film_weight" | "thin_film_thickness" | "thin_film_ior" => plan.thin_film,
        "metallic" => plan.parts_film(),
        "occlusion" => plan.occlusion,
        "emission" => plan.emission,
        "opacity" => plan.alpha_mode != AlphaMode::Opaque,
        _ => false,
    });
}
