//! The plan: what of the shading a material in a scene needs, and what is left out.
//!
//! A lobe of weight zero, a light kind without lights, an environment that is not there: none of them is emitted. Each
//! decision that leaves something out says so in words, and what would keep it. It looks at the program and changes nothing.

use std::collections::HashSet;

use halfvector_graph::document::{AlphaMode, SurfaceSettings};
use halfvector_graph::needs::Needs;

use crate::ir::{Expr, Id, Program, Stage};
use crate::reflection::LightKind;
use crate::{Dropped, Fold};

/// Largest reflectance at normal incidence, and largest perceptual roughness, of a dielectric whose multiple-scattering
/// compensation is left out.
pub(crate) const COMPENSATION_MIN_F0: f32 = 0.045;
pub(crate) const COMPENSATION_MIN_ROUGHNESS: f32 = 0.4;

/// The most that leaving the compensation out changes what the specular lobe reflects, in percent: the greatest f0 (1 - E)/E with
/// E = a + b up to these two. On a display, whose codes go with the 2.2nd root of light or slower, it is less than one of 255
/// steps, however bright the light and however dark the base. A test computes it by quadrature.
pub(crate) const COMPENSATION_BOUND_PERCENT: f32 = 0.8;

/// What is left out of the shader of a surface that is no metal anywhere.
pub(crate) const METAL: &str = "metal";

/// What the fragment shader shades with.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Lights by kind, kinds without lights left out.
    pub(crate) lights: Vec<(LightKind, u32)>,
    /// Whether there is an environment, and it is turned.
    pub(crate) environment: Option<bool>,
    pub(crate) diffuse: bool,
    pub(crate) specular: bool,
    /// Whether a factor on the specular lobe brings back what it loses.
    pub(crate) compensation: bool,
    /// Whether a lobe of its own does.
    pub(crate) multiscatter: bool,
    /// What the specular lobe leaves to the diffuse one.
    pub(crate) coupling: Coupling,
    /// Layers over the base, the sheen outermost.
    pub(crate) coat: bool,
    pub(crate) sheen: bool,
    /// Whether the sheen looks up light of its own in an environment.
    pub(crate) sheen_ring: bool,
    /// Light that passes through the dielectric base.
    pub(crate) transmission: bool,
    /// Whether the body that it passes is a sheet.
    pub(crate) thin_walled: bool,
    /// Whether the specular lobe is stretched along a tangent.
    pub(crate) anisotropy: bool,
    /// Whether a thin film lies on the base.
    pub(crate) thin_film: bool,
    /// Whether the base is a mixture of a metal and a dielectric.
    pub(crate) metal_in_part: bool,
    pub(crate) emission: bool,
    /// Occlusion of the environment.
    pub(crate) occlusion: bool,
    /// Whether reflections from below the geometry's horizon are faded: the shading normal is not the geometry's.
    pub(crate) horizon: bool,
    /// The same of the coat's normal.
    pub(crate) coat_horizon: bool,
    /// What opacity does, `Opaque` when it does nothing.
    pub(crate) alpha_mode: AlphaMode,
    pub(crate) height: bool,
    pub(crate) derived_normal: bool,
    pub(crate) double_sided: bool,
    /// Whether the turn of a normal within a pixel goes into the roughness.
    pub(crate) is_filtered: bool,
    /// Whether a lobe looks at the direction to the viewer.
    pub(crate) looks_at_view: bool,
    pub(crate) dropped: Vec<Dropped>,
}

/// How the diffuse lobe gives way to the reflection of the interface above it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Coupling {
    /// It does not, or there is no such pair.
    #[default]
    None,
    /// By what the viewer's direction reflects.
    View,
    /// By what the viewer's and the light's reflect.
    Reciprocal,
}

impl Plan {
    /// Whether shading reads the split sum's pair towards the viewer.
    pub(crate) fn reads_dfg(&self) -> bool {
        let scaled = self.compensation || self.multiscatter || self.coupling != Coupling::None;
        self.transmission || (self.specular && (scaled || self.environment.is_some()))
    }

    /// Whether shading reads the split sum's pair towards each light.
    pub(crate) fn reads_light_dfg(&self) -> bool {
        self.multiscatter || self.coupling == Coupling::Reciprocal
    }

    /// Whether a film lies over a mixture of a metal and a dielectric that lets light through to what lies below.
    pub(crate) fn parts_film(&self) -> bool {
        let below = self.transmission || self.coupling != Coupling::None;
        self.thin_film && self.metal_in_part && below
    }

    pub(crate) fn is_lit(&self) -> bool {
        self.has_base() || self.coat || self.sheen
    }

    /// Whether a lobe of the base is left.
    pub(crate) fn has_base(&self) -> bool {
        self.diffuse || self.specular || self.transmission
    }

    /// Whether the viewer may be in the body that light passes through.
    pub(crate) fn seen_from_inside(&self) -> bool {
        self.transmission && !self.thin_walled && self.double_sided
    }

    /// Whether the irradiance of the environment is read.
    pub(crate) fn reads_irradiance(&self) -> bool {
        self.environment.is_some() && (self.diffuse || self.multiscatter || (self.sheen && !self.sheen_ring))
    }

    pub(crate) fn drop_it(&mut self, what: &str, why: impl Into<String>, kept_by: Keep) {
        self.dropped.push(Dropped { what: what.to_owned(), why: why.into(), instructions: None, kept_by });
    }
}

/// What makes a shader hold something that another one does without, everything else being the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keep {
    /// A socket of the surface whose number stays open.
    Socket(&'static str),
    /// The same of a lobe's weight.
    Lobe(&'static str),
    /// Opacity, open and blended.
    Opacity,
    /// A light.
    Light,
    /// An environment.
    Environment,
    /// Another method of a term.
    Method(&'static str, &'static str),
    /// The compensation of any dielectric.
    Compensation,
    /// The fading of any normal's reflections at the horizon.
    Horizon,
}

impl Keep {
    /// The surface's socket that stays open.
    pub(crate) fn socket(self) -> Option<&'static str> {
        match self {
            Keep::Socket(socket) | Keep::Lobe(socket) => Some(socket),
            Keep::Opacity => Some("opacity"),
            _ => None,
        }
    }
}

/// The decisions that are the same whatever is folded, so that a live shader draws the picture of the exported one:
/// taken on the program as it is exported.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constants {
    /// The dielectric's f0 and perceptual roughness where both are known and nothing can change them.
    pub(crate) dielectric: Option<[f32; 2]>,
}

/// What the surface's sockets are known to be.
pub(super) struct Known<'p, 'a> {
    pub(super) program: &'p Program<'a>,
    pub(super) fold: Fold,
}

impl Known<'_, '_> {
    /// Whether a socket equals `x` in every component: a constant, or a number of the document that is specialised live.
    fn is(&self, stage: &Stage<'_>, socket: &str, x: f32) -> bool {
        let Some(id) = stage.root(socket) else { return false };
        // A mixture equals what all its sides are.
        let (mut open, mut seen) = (vec![id], HashSet::new());
        while let Some(id) = open.pop() {
            if !seen.insert(id) {
                continue;
            }
            match &stage.arena.get(id).expr {
                Expr::Builtin { name: "mix", arguments } => match self.constant(stage, arguments[2]) {
                    Some(0.0) => open.push(arguments[0]),
                    Some(1.0) => open.push(arguments[1]),
                    _ => open.extend(&arguments[..2]),
                },
                Expr::Literal(literal) if literal.is_all(x) => {}
                Expr::Input(input)
                    if self.fold == Fold::Live
                        && self.program.inputs[*input].value.iter().all(|value| *value == f64::from(x)) => {}
                _ => return false,
            }
        }
        true
    }

    /// The weight of a mixture where it is known.
    fn constant(&self, stage: &Stage<'_>, weight: Id) -> Option<f32> {
        match &stage.arena.get(weight).expr {
            Expr::Literal(literal) => literal.components().first().copied(),
            Expr::Input(input) if self.fold == Fold::Live => {
                self.program.inputs[*input].value.first().map(|x| *x as f32)
            }
            Expr::Builtin { name: "saturate", arguments } => match &stage.arena.get(arguments[0]).expr {
                Expr::Input(input) if self.fold == Fold::Live => {
                    self.program.inputs[*input].value.first().map(|x| x.clamp(0.0, 1.0) as f32)
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether a socket of the fragment stage does.
    pub(super) fn surface(&self, socket: &str, x: f32) -> bool {
        self.is(&self.program.fragment, socket, x)
    }
}

/// How metallic a surface is known to be.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Metal {
    None,
    Whole,
    Mixed,
}

/// How metallic the program's surface is known to be.
pub(super) fn metal(program: &Program<'_>, fold: Fold) -> Metal {
    let known = Known { program, fold };
    if known.surface("metallic", 0.0) {
        Metal::None
    } else if known.surface("metallic", 1.0) {
        Metal::Whole
    } else {
        Metal::Mixed
    }
}

/// What a plan is made for.
#[derive(Clone, Copy)]
pub(crate) struct Wanted<'w> {
    /// What the document says to the rasteriser.
    pub(crate) surface: SurfaceSettings,
    pub(crate) needs: &'w Needs,
    pub(crate) fold: Fold,
    pub(crate) constants: Constants,
    /// What is not left out.
    pub(crate) keep: Option<Keep>,
}

/// Decides what is emitted.
pub(super) fn decide(program: &Program<'_>, wanted: Wanted<'_>) -> Plan {
    let Wanted { surface, needs, fold, constants, keep } = wanted;
    let known = Known { program, fold };
    let metal = metal(program, fold);
    let double_sided = surface.double_sided;
    let mut plan = Plan { double_sided, metal_in_part: metal == Metal::Mixed, ..Plan::default() };

    let counts = [needs.directional_lights, needs.point_lights, needs.spot_lights];
    plan.lights = LightKind::ALL.into_iter().zip(counts).filter(|(_, count)| *count > 0).collect();
    plan.environment = needs.environment.map(|e| e.rotated);
    let lit = !plan.lights.is_empty() || plan.environment.is_some();
    if !lit {
        plan.drop_it("lobes", "the scene has no light: only emission is left", Keep::Light);
    }
    if plan.environment.is_none() {
        let why = "the scene has no environment: 2 cubes and their lookups saved";
        plan.drop_it("environment light", why, Keep::Environment);
    }

    let film = !absent(&known, "thin_film_weight");
    plan.transmission = lit && metal != Metal::Whole && !absent(&known, "transmission_weight");
    plan.thin_walled = plan.transmission && surface.thin_walled;
    plan.diffuse = lit && metal != Metal::Whole && !(plan.transmission && known.surface("transmission_weight", 1.0));
    if lit && !plan.diffuse {
        let (why, socket) = match metal {
            Metal::Whole => ("metallic is 1: a metal reflects nothing diffusely", "metallic"),
            _ => ("transmission_weight is 1: what enters the surface leaves it behind", "transmission_weight"),
        };
        plan.drop_it("diffuse lobe", why, Keep::Socket(socket));
    }
    let no_specular = metal == Metal::None && known.surface("specular", 0.0);
    plan.specular = lit && !no_specular;
    if lit && no_specular {
        plan.drop_it(
            "specular lobe",
            "specular is 0 and metallic is 0: its f0 and f90 are 0",
            Keep::Socket("specular"),
        );
    }
    if lit && metal == Metal::None && plan.specular {
        plan.drop_it(METAL, "metallic is 0: f0 comes from the index of refraction alone", Keep::Socket("metallic"));
    }
    // What spreads the lobe beyond its roughness, or changes its f0.
    let spread = film || !absent(&known, "anisotropy") || needs.methods.get("specular_aa").function.is_some();
    let fixed = constants.dielectric.filter(|_| !spread && keep != Some(Keep::Compensation));
    if plan.specular && compensates(&mut plan, needs, fixed) {
        plan.multiscatter = needs.methods.is("compensation", "kulla_conty");
        plan.compensation = !plan.multiscatter;
    }
    if plan.diffuse && plan.specular && !known.surface("specular", 0.0) {
        plan.coupling = match needs.methods.get("coupling").name {
            "none" => Coupling::None,
            "reciprocal" => Coupling::Reciprocal,
            _ => Coupling::View,
        };
    }

    plan.emission = !known.surface("emission", 0.0);
    if !plan.emission {
        plan.drop_it("emission", "it is 0", Keep::Socket("emission"));
    }
    plan.anisotropy = plan.specular && !absent(&known, "anisotropy");
    plan.thin_film = plan.specular && !absent(&known, "thin_film_weight");
    // Layers dim what the surface sends out itself, also where nothing shines on them.
    plan.coat = (lit || plan.emission) && !absent(&known, "coat_weight");
    plan.sheen = (lit || plan.emission) && !absent(&known, "sheen_color");
    plan.sheen_ring = plan.sheen && plan.environment.is_some() && needs.methods.is("sheen", "ring");
    drop_lobes(&mut plan, &known, lit, metal);
    plan.occlusion = plan.environment.is_some() && plan.is_lit() && !known.surface("occlusion", 1.0);
    if plan.environment.is_some() && !plan.occlusion {
        plan.drop_it("occlusion", "it is 1", Keep::Socket("occlusion"));
    }
    decide_horizons(&mut plan, program, needs, keep == Some(Keep::Horizon));
    decide_opacity(&mut plan, &known, surface.alpha_mode, keep == Some(Keep::Opacity));
    decide_height(&mut plan, &known, needs, lit);
    let mirror = plan.environment.is_some() && (plan.specular || needs.methods.is("irradiance", "last_level"));
    let layered = plan.coat || plan.sheen || plan.transmission;
    plan.is_filtered =
        (plan.specular || plan.transmission || plan.coat) && needs.methods.get("specular_aa").function.is_some();
    plan.looks_at_view = plan.specular || mirror || layered || !needs.methods.is("diffuse", "lambert");
    plan
}

/// Says which lobes of the surface are off by their weight. Nothing passes through a metal, whatever its weight.
fn drop_lobes(plan: &mut Plan, known: &Known<'_, '_>, lit: bool, metal: Metal) {
    let lobes = [
        ("coat", "coat_weight", plan.coat),
        ("sheen", "sheen_color", plan.sheen),
        ("transmission", "transmission_weight", plan.transmission || metal == Metal::Whole),
        ("anisotropy", "anisotropy", plan.anisotropy),
        ("thin film", "thin_film_weight", plan.thin_film),
    ];
    for (lobe, socket, _) in
        lobes.into_iter().filter(|(_, socket, is_there)| lit && !is_there && known.surface(socket, 0.0))
    {
        plan.drop_it(lobe, format!("{socket} is 0"), Keep::Lobe(socket));
    }
}

/// Whether a lobe is off: its socket is 0, or the surface node has no such socket.
fn absent(known: &Known<'_, '_>, socket: &str) -> bool {
    known.program.fragment.root(socket).is_none() || known.surface(socket, 0.0)
}

/// `fixed` are f0 and roughness of a dielectric when nothing can change them.
fn compensates(plan: &mut Plan, needs: &Needs, fixed: Option<[f32; 2]>) -> bool {
    if needs.methods.is("compensation", "none") {
        let default = Keep::Method("compensation", "turquin");
        plan.drop_it("energy compensation", "the method is `none`: single scattering only", default);
        return false;
    }
    match fixed {
        Some([f0, roughness]) if f0 <= COMPENSATION_MIN_F0 && roughness <= COMPENSATION_MIN_ROUGHNESS => {
            plan.drop_it(
                "energy compensation",
                format!(
                    "f0 is {f0:.3} and perceptual roughness {roughness:.3}, both fixed: it would change the specular lobe by less \
                     than {COMPENSATION_BOUND_PERCENT} %"
                ),
                Keep::Compensation,
            );
            false
        }
        _ => true,
    }
}

/// Called before displacement is decided: a displaced surface's normal is that of its geometry.
fn decide_horizons(plan: &mut Plan, program: &Program<'_>, needs: &Needs, keep: bool) {
    if plan.environment.is_none() {
        return;
    }
    let stage = &program.fragment;
    let mapped = |socket| stage.root(socket).is_some_and(|id| !stage.arena.is_context(id, "world_normal"));
    let fades = !program.derived_normal && !needs.methods.is("horizon", "none");
    plan.horizon = plan.specular && (mapped("normal") || keep) && fades;
    plan.coat_horizon = plan.coat && mapped("coat_normal") && fades;
    if plan.specular && !mapped("normal") {
        let why = "the shading normal is the geometry's: no reflection comes from below";
        plan.drop_it("horizon", why, Keep::Horizon);
    }
}

fn decide_opacity(plan: &mut Plan, known: &Known<'_, '_>, alpha_mode: AlphaMode, keep: bool) {
    plan.alpha_mode = if keep && alpha_mode == AlphaMode::Opaque { AlphaMode::Blend } else { alpha_mode };
    let why = match plan.alpha_mode {
        AlphaMode::Opaque => "the material is opaque",
        _ if known.surface("opacity", 1.0) => "it is 1",
        _ => return,
    };
    plan.alpha_mode = AlphaMode::Opaque;
    plan.drop_it("opacity", why, Keep::Opacity);
}

fn decide_height(plan: &mut Plan, known: &Known<'_, '_>, needs: &Needs, lit: bool) {
    plan.height = known.program.vertex.root("height").is_some() && !known.is(&known.program.vertex, "height", 0.0);
    if !plan.height {
        plan.drop_it("displacement", "height is 0", Keep::Socket("height"));
        return;
    }
    plan.derived_normal = lit && known.program.derived_normal;
    if needs.methods.is("height_normals", "report") {
        let why = "the method is `report`: the old normal is kept";
        plan.drop_it("normals of the displaced surface", why, Keep::Method("height_normals", "derived"));
    } else if !known.program.derived_normal {
        plan.drop_it("normals of the displaced surface", "height is the same everywhere", Keep::Socket("height"));
    }
}
