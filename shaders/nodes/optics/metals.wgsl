// Metals: reflectance at normal incidence and its departure from Schlick's curve at 82 degrees, from published optical constants. The
// spectrum of Fresnel's reflectance of eta + i k under D65 is seen by the CIE 1931 observer, in linear
// Rec. 709, held in 0..1.

/// The outputs of the nodes of metals, and of optics/conductor.
struct MetalOutputs {
    /// reflectance at normal incidence: the base colour of a surface of metallic 1
    color: vec3f,
    /// reflectance at 82 degrees over Schlick's there: the F82 tint of OpenPBR and of the Adobe Standard Material
    edge_tint: vec3f,
}

/// Gold
///
/// Colour and edge tint of polished gold for a surface of metallic 1. Optical constants of Johnson and Christy 1972,
/// "Optical constants of the noble metals". Its red leaves Rec. 709 (1.04) and is 1 here.
/// @node optics/gold   @also metal, conductor, au, yellow metal
fn node_optics_gold() -> MetalOutputs {
    return MetalOutputs(vec3f(1.0, 0.7286, 0.3646), vec3f(0.9909, 1.0, 0.9814));
}

/// Silver
///
/// Colour and edge tint of polished silver for a surface of metallic 1. Optical constants of Johnson and Christy 1972,
/// "Optical constants of the noble metals".
/// @node optics/silver   @also metal, conductor, ag, white metal
fn node_optics_silver() -> MetalOutputs {
    return MetalOutputs(vec3f(0.9894, 0.9839, 0.9779), vec3f(0.9932, 0.9946, 0.9989));
}

/// Copper
///
/// Colour and edge tint of polished copper for a surface of metallic 1. Optical constants of Johnson and Christy 1972,
/// "Optical constants of the noble metals".
/// @node optics/copper   @also metal, conductor, cu, red metal
fn node_optics_copper() -> MetalOutputs {
    return MetalOutputs(vec3f(0.9317, 0.6226, 0.5224), vec3f(0.9819, 0.9469, 0.9449));
}

/// Aluminium
///
/// Colour and edge tint of polished aluminium for a surface of metallic 1. Optical constants of Rakic 1995, "Algorithm for the
/// determination of intrinsic optical constants of metal films: application to aluminum".
/// @node optics/aluminium   @also metal, conductor, al, aluminum, foil
fn node_optics_aluminium() -> MetalOutputs {
    return MetalOutputs(vec3f(0.9073, 0.9159, 0.9223), vec3f(0.8737, 0.903, 0.9327));
}

/// Iron
///
/// Colour and edge tint of polished iron for a surface of metallic 1. Optical constants of Johnson and Christy 1974,
/// "Optical constants of transition metals".
/// @node optics/iron   @also metal, conductor, fe, steel, cast iron
fn node_optics_iron() -> MetalOutputs {
    return MetalOutputs(vec3f(0.5297, 0.5132, 0.4942), vec3f(0.7649, 0.7673, 0.8015));
}

/// Chromium
///
/// Colour and edge tint of polished chromium for a surface of metallic 1. Optical constants of Johnson and Christy 1974,
/// "Optical constants of transition metals".
/// @node optics/chromium   @also metal, conductor, cr, chrome, plating
fn node_optics_chromium() -> MetalOutputs {
    return MetalOutputs(vec3f(0.5496, 0.556, 0.5543), vec3f(0.7407, 0.7488, 0.8139));
}

/// Titanium
///
/// Colour and edge tint of polished titanium for a surface of metallic 1. Optical constants of Johnson and Christy 1974,
/// "Optical constants of transition metals".
/// @node optics/titanium   @also metal, conductor, ti, grey metal
fn node_optics_titanium() -> MetalOutputs {
    return MetalOutputs(vec3f(0.6186, 0.5794, 0.5425), vec3f(0.7686, 0.7905, 0.8206));
}

/// Nickel
///
/// Colour and edge tint of polished nickel for a surface of metallic 1. Optical constants of Johnson and Christy 1974,
/// "Optical constants of transition metals".
/// @node optics/nickel   @also metal, conductor, ni, coin, plating
fn node_optics_nickel() -> MetalOutputs {
    return MetalOutputs(vec3f(0.6971, 0.6405, 0.5633), vec3f(0.8152, 0.8341, 0.8707));
}

/// Platinum
///
/// Colour and edge tint of polished platinum for a surface of metallic 1. Optical constants of the Brendel-Bormann fit of
/// Rakic, Djurisic, Elazar and Majewski 1998, "Optical properties of metallic films for vertical-cavity optoelectronic devices".
/// @node optics/platinum   @also metal, conductor, pt, jewellery
fn node_optics_platinum() -> MetalOutputs {
    return MetalOutputs(vec3f(0.6788, 0.6395, 0.5836), vec3f(0.792, 0.819, 0.8541));
}

/// Tungsten
///
/// Colour and edge tint of polished tungsten for a surface of metallic 1. Optical constants of Weaver, Olson and Lynch 1975,
/// "Optical properties of crystalline tungsten".
/// @node optics/tungsten   @also metal, conductor, w, wolfram, filament
fn node_optics_tungsten() -> MetalOutputs {
    return MetalOutputs(vec3f(0.5158, 0.4963, 0.4675), vec3f(0.7191, 0.7292, 0.7441));
}

/// Brass
///
/// Colour and edge tint of polished brass for a surface of metallic 1. Optical constants of Querry 1985, "Optical constants"
/// (CRDC-CR-85034), for 70 % copper and 30 % zinc.
/// @node optics/brass   @also metal, conductor, cuzn, alloy, yellow metal
fn node_optics_brass() -> MetalOutputs {
    return MetalOutputs(vec3f(0.9095, 0.7778, 0.4235), vec3f(0.9518, 0.9786, 1.0));
}
