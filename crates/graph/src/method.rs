//! The terms of shading that have more than one method, and the methods by name: the one list that the command line,
//! the code generator and the bakes read. It holds names and sources; what a method computes stands in its twin files.

/// A term of shading with selectable methods.
#[derive(Debug, PartialEq, Eq)]
pub struct Term {
    /// Name on the command line.
    pub name: &'static str,
    /// What it stands for.
    pub help: &'static str,
    /// The methods; the first is the default.
    pub methods: &'static [Method],
    /// The method that the report which started the project uses.
    pub report: &'static str,
}

/// One way to compute a term.
#[derive(Debug, PartialEq, Eq)]
pub struct Method {
    /// Name on the command line.
    pub name: &'static str,
    /// What it does and where it comes from.
    pub source: &'static str,
    /// The library function that computes it, for methods that replace the default's function of the same signature.
    pub function: Option<&'static str>,
}

const fn method(name: &'static str, function: Option<&'static str>, source: &'static str) -> Method {
    Method { name, source, function }
}

/// All terms, in the order shown.
pub const TERMS: &[Term] = &[
    Term {
        name: "d",
        help: "distribution of microfacet normals",
        methods: &[
            method("ggx", Some("d_ggx"), "Walter et al. 2007, with |n x h|^2 instead of 1 - (n.h)^2"),
            method(
                "beckmann",
                Some("d_beckmann"),
                "Beckmann and Spizzichino 1963, Cook and Torrance 1982: Gaussian slopes",
            ),
        ],
        report: "ggx",
    },
    Term {
        name: "v",
        help: "visibility: masking and shadowing over 4 (n.l)(n.v)",
        methods: &[
            method("correlated", Some("v_smith_ggx_correlated"), "Heitz 2014, height-correlated Smith"),
            method("separable", Some("v_smith_ggx_separable"), "Walter et al. 2007, G1(v) G1(l)"),
            method("hammon", Some("v_hammon"), "Hammon 2017: the correlated form without square roots"),
            method("schlick_smith", Some("v_schlick_smith"), "Schlick 1994, Karis 2013: k = (roughness + 1)^2 / 8"),
            method("cook_torrance", Some("v_cook_torrance"), "Torrance and Sparrow 1967: V-shaped grooves"),
            method("kelemen", Some("v_kelemen"), "Kelemen and Szirmay-Kalos 2001: 1 / (4 (l.h)^2)"),
            method("neubelt", Some("v_neubelt"), "Neubelt and Pettineo 2013: for cloth"),
            method(
                "beckmann_correlated",
                Some("v_smith_beckmann_correlated"),
                "Heitz 2014, Walter's fit of Beckmann's Lambda",
            ),
            method(
                "beckmann_separable",
                Some("v_smith_beckmann_separable"),
                "Walter et al. 2007: G1(v) G1(l) for Beckmann",
            ),
        ],
        report: "separable",
    },
    Term {
        name: "fresnel",
        help: "Fresnel reflectance",
        methods: &[
            method("schlick", Some("f_schlick"), "Schlick 1994"),
            method("exact", Some("f_exact"), "Fresnel's equations for a dielectric of the ior that f0 implies"),
        ],
        report: "schlick",
    },
    Term {
        name: "diffuse",
        help: "diffuse reflection",
        methods: &[
            method("lambert", Some("diffuse_lambert"), "Lambert 1760"),
            method("burley", Some("diffuse_burley"), "Burley 2012"),
            method("oren_nayar", Some("diffuse_oren_nayar"), "Oren and Nayar 1994, qualitative form"),
            method("fon", Some("diffuse_fon"), "Fujii's Oren-Nayar, Portsmouth et al. 2025"),
            method("eon", Some("diffuse_eon"), "Portsmouth, Kutz, Hill 2025: Fujii's Oren-Nayar, keeps energy"),
        ],
        report: "lambert",
    },
    Term {
        name: "compensation",
        help: "energy that single scattering loses",
        methods: &[
            method("turquin", Some("energy_compensation"), "Turquin 2019: 1 + f0 (1/E - 1)"),
            method("fdez_aguera", Some("energy_compensation_fdez_aguera"), "Fdez-Aguera 2019: 1 / (1 - F_avg (1 - E))"),
            method("kulla_conty", None, "Kulla and Conty 2017: a reciprocal lobe of its own"),
            method("none", None, "single scattering only"),
        ],
        report: "none",
    },
    Term {
        name: "coupling",
        help: "what a dielectric's reflection leaves to the diffuse base under it",
        methods: &[
            method("view", None, "OpenPBR 1.1, albedo scaling: 1 - E(v); white reflects what arrives"),
            method("reciprocal", None, "Shirley et al. 1997: (1 - E(v)) (1 - E(l)) / (1 - E_avg)"),
            method("none", None, "the base is lit as if nothing lay over it"),
        ],
        report: "none",
    },
    Term {
        name: "dfg",
        help: "directional albedo of the specular lobe",
        methods: &[
            method("table", None, "Karis 2013: a table over n.v and perceptual roughness"),
            method("fit", Some("dfg_fit"), "analytic fit of our own, no texture"),
            method("karis", Some("dfg_karis"), "Karis 2014: analytic fit"),
        ],
        report: "table",
    },
    Term {
        name: "prefilter",
        help: "filter of the environment's levels",
        methods: &[
            method("ggx", None, "Karis 2013: n = v = r, GGX"),
            method("hdre", None, "writers of HDRE files: n.l to a power that falls with the roughness"),
        ],
        report: "ggx",
    },
    Term {
        name: "level_map",
        help: "perceptual roughness to level",
        methods: &[
            method(
                "hermite",
                Some("lod_geometric"),
                "levels at equal steps of log roughness from 0.1; logarithms mixed by stored slopes",
            ),
            method("geometric", Some("lod_geometric"), "levels at equal steps of log roughness from 0.1; linear mix"),
            method("linear", Some("lod_linear"), "lod = roughness (levels - 1)"),
            method("report", Some("lod_report"), "six levels, lod = 5 roughness"),
        ],
        report: "report",
    },
    Term {
        name: "irradiance",
        help: "diffuse light of the environment",
        methods: &[
            method("cube", None, "cosine-filtered cube"),
            method("sh2", Some("irradiance_sh2"), "Ramamoorthi and Hanrahan 2001: nine coefficients"),
            method("last_level", None, "the last prefiltered level in the mirror direction"),
        ],
        report: "last_level",
    },
    Term {
        name: "specular_occlusion",
        help: "occlusion of the environment's reflection",
        methods: &[
            method(
                "cone",
                Some("specular_occlusion_cone"),
                "part of the lobe inside the cone that the occlusion means",
            ),
            method("lagarde", Some("specular_occlusion_lagarde"), "Lagarde and de Rousiers 2014"),
            method("plain", None, "the occlusion of diffuse light as it is"),
        ],
        report: "plain",
    },
    Term {
        name: "horizon",
        help: "reflections from below the geometry's horizon, where the normal is mapped",
        methods: &[
            method("cone", Some("horizon_cone"), "part of the lobe above the horizon"),
            method("squared", Some("horizon_squared"), "Lagarde and de Rousiers 2014: saturate(1 + r.g)^2"),
            method("none", None, "kept"),
        ],
        report: "none",
    },
    Term {
        name: "specular_aa",
        help: "roughness for a normal that turns within a pixel, so that sharp highlights do not sparkle",
        methods: &[
            method("none", None, "the surface's own"),
            method(
                "box",
                Some("perceptual_roughness_filtered_box"),
                "variance over the pixel's square: alpha^2 + (|dn/dx|^2 + |dn/dy|^2) / 12",
            ),
            method(
                "tokuyoshi",
                Some("perceptual_roughness_filtered_tokuyoshi"),
                "Tokuyoshi and Kaplanyan 2019: under a Gaussian filter, 1/pi in the place of 1/12",
            ),
        ],
        report: "none",
    },
    Term {
        name: "reflection",
        help: "where a rough surface's reflection of the environment is looked up",
        methods: &[
            method(
                "leaning",
                Some("specular_direction"),
                "the mirror direction leaning to the normal by roughness^3, after Lagarde and de Rousiers 2014",
            ),
            method("mirror", None, "Karis 2013: the mirror direction at any roughness"),
        ],
        report: "mirror",
    },
    Term {
        name: "sheen",
        help: "light of the environment that the sheen reflects",
        methods: &[
            method("ring", Some("sheen_ring"), "two lookups: irradiance about a leaning normal, less the middle"),
            method("irradiance", None, "the irradiance of the normal"),
        ],
        report: "irradiance",
    },
    Term {
        name: "anisotropy",
        help: "the environment's reflection on a brushed surface",
        methods: &[
            method(
                "strips",
                Some("anisotropic_strip"),
                "five lookups along the tangent, each as narrow as the lobe is across",
            ),
            method(
                "bent",
                Some("anisotropic_reflection"),
                "Khronos 2023, after McAuley 2015: one lookup about a bent normal",
            ),
        ],
        report: "strips",
    },
    Term {
        name: "normal",
        help: "normal mapping",
        methods: &[
            method("tbn", Some("normal_tbn"), "tangent frame, MikkTSpace"),
            method(
                "tbn_derivative",
                Some("normal_tbn_derivative"),
                "tangent frame from the pixel's derivatives, Mikkelsen 2010, Schueler 2013: needs no tangents",
            ),
            method(
                "rotation_report",
                Some("normal_rotation_report"),
                "three angles, Rz Ry Rx, as the report gives them",
            ),
            method("rotation_fixed", Some("normal_rotation_fixed"), "signs mended, without Rz"),
        ],
        report: "rotation_report",
    },
    Term {
        name: "normal_decode",
        help: "what the texels of normal maps mean",
        methods: &[
            method("unorm", Some("normal_from_texel"), "2 c - 1; 8-bit (128, 128, 255) leans by 0.318 degrees"),
            method("snorm", Some("normal_from_texel_snorm"), "(255 c - 128) / 127; (128, 128, 255) is straight up"),
            method(
                "two_channel",
                Some("normal_from_texel_two_channel"),
                "x and y by 2 c - 1, z = sqrt(1 - x^2 - y^2): BC5, 3Dc",
            ),
        ],
        report: "unorm",
    },
    Term {
        name: "height_normals",
        help: "shading normal of a displaced surface",
        methods: &[
            method("derived", None, "Mikkelsen 2010: from the height's screen-space gradient"),
            method("report", None, "the undisplaced surface's normal"),
        ],
        report: "report",
    },
    Term {
        name: "encode",
        help: "where the display's coding is applied",
        methods: &[
            method("srgb", None, "after the tone map, IEC 61966-2-1"),
            method("report", None, "pow(1/2.2) on the reflection, before the albedo"),
        ],
        report: "report",
    },
    Term {
        name: "env_decode",
        help: "what the environment's pixels mean",
        methods: &[
            method("linear", None, "radiance as stored; LDR files are sRGB-decoded"),
            method("report", None, "tone-mapped and linearised: L/(1+L) for HDR, sRGB-decoded for LDR"),
        ],
        report: "report",
    },
];

/// The term with this name.
pub fn term(name: &str) -> Option<&'static Term> {
    TERMS.iter().find(|t| t.name == name)
}

/// A choice of one method for each term; terms not named have their default.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Methods {
    /// One index into `Term::methods` per term, in the order of [`TERMS`].
    chosen: Vec<u8>,
}

/// Why a choice of method was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MethodError {
    /// No such term.
    #[error("there is no term `{term}`; the terms are {}", TERMS.iter().map(|t| t.name).collect::<Vec<_>>().join(", "))]
    UnknownTerm {
        /// As given.
        term: String,
    },
    /// No such method of the term.
    #[error("the term `{term}` has no method `{method}`; it has {known}")]
    UnknownMethod {
        /// As given.
        term: String,
        /// As given.
        method: String,
        /// What there is.
        known: String,
    },
}

impl Default for Methods {
    fn default() -> Self {
        Methods { chosen: vec![0; TERMS.len()] }
    }
}

impl Methods {
    /// The report's own form of each term.
    pub fn report() -> Self {
        let mut methods = Methods::default();
        for term in TERMS {
            methods.set(term.name, term.report).expect("the report's methods are in the list");
        }
        methods
    }

    /// Chooses a method by name.
    pub fn set(&mut self, term: &str, method: &str) -> Result<(), MethodError> {
        let index =
            TERMS.iter().position(|t| t.name == term).ok_or_else(|| MethodError::UnknownTerm { term: term.into() })?;
        let methods = TERMS[index].methods;
        let chosen = methods.iter().position(|m| m.name == method).ok_or_else(|| MethodError::UnknownMethod {
            term: term.into(),
            method: method.into(),
            known: methods.iter().map(|m| m.name).collect::<Vec<_>>().join(", "),
        })?;
        self.chosen[index] = chosen as u8;
        Ok(())
    }

    /// The chosen method of a term. Panics when `term` is not in [`TERMS`]: a mistake of the caller.
    pub fn get(&self, term: &str) -> &'static Method {
        let index = TERMS.iter().position(|t| t.name == term).expect("a term of the list");
        &TERMS[index].methods[self.chosen[index] as usize]
    }

    /// Whether the chosen method of `term` is `method`.
    pub fn is(&self, term: &str, method: &str) -> bool {
        self.get(term).name == method
    }
}
