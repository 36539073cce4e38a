//! The materials that come with the program, and templates to begin with. Their documents stand in `library/`.

use std::sync::{Arc, LazyLock};

use halfvector_graph::document::Document;

/// A material of the library.
#[derive(Clone, Debug)]
pub(crate) struct LibraryMaterial {
    /// The name of its file without extensions.
    pub(crate) id: &'static str,
    /// Which shelf it stands on.
    pub(crate) shelf: &'static str,
    /// Other words that a search finds it by.
    pub(crate) words: &'static str,
    /// What it is.
    pub(crate) document: Arc<Document>,
}

impl LibraryMaterial {
    /// Whether all words of a search are in its name, shelf or other words.
    pub(crate) fn is_found_by(&self, search: &str) -> bool {
        let text = format!("{} {} {} {}", self.document.name, self.shelf, self.words, self.id).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }
}

/// Shelf, file and other words, in the order shown; the text of each file.
macro_rules! shelves {
    ($($shelf:literal: $($id:literal $words:literal),+;)+) => {
        const FILES: &[(&str, &str, &str, &str)] = &[
            $($(($shelf, $id, $words, include_str!(concat!("../library/", $id, ".material.json"))),)+)+
        ];
    };
}

shelves! {
    "Metals":
        "gold" "metal yellow precious jewel",
        "silver" "metal precious tableware",
        "copper" "metal red pipe",
        "iron" "metal grey pan",
        "chrome" "metal mirror chromium bathroom",
        "titanium" "metal grey aerospace",
        "brushed-aluminium" "metal brushed anisotropic lines",
        "anodised-titanium" "metal thin film rainbow heat tint blue",
        "aged-brass" "metal yellow patina antique",
        "hammered-bronze" "metal brown dents beaten bowl",
        "rusted-iron" "metal corroded orange";
    "Paint":
        "car-paint-red" "car automotive metallic lacquer flakes",
        "car-paint-blue" "car automotive metallic lacquer flakes blue",
        "worn-paint" "enamel chipped steel flaking";
    "Plastic":
        "plastic-glossy" "toy abs red",
        "plastic-textured" "abs grain dashboard black grey",
        "rubber" "tyre black dull",
        "carbon-fibre" "weave composite coated twill";
    "Cloth":
        "velvet" "fabric textile sheen red curtain",
        "satin" "fabric textile silk smooth",
        "denim" "fabric textile jeans blue cotton",
        "linen" "fabric textile natural flax",
        "leather" "brown hide bag sofa";
    "Glass":
        "glass" "clear window transparent",
        "frosted-glass" "matte etched bathroom transparent",
        "bottle-glass" "green wine transparent",
        "ruby" "gem jewel red transparent sapphire",
        "ice" "frozen water cold transparent";
    "Stone":
        "marble" "white veins carrara polished",
        "granite" "grey speckled kitchen polished",
        "wet-stone" "rain puddle slate dark pebble",
        "concrete" "grey cement wall building",
        "brick" "masonry red mortar building",
        "terracotta" "clay pot flower orange",
        "ceramic" "porcelain vase crackle glaze celadon";
    "Wood":
        "oak" "timber furniture floor light",
        "walnut" "timber furniture dark brown";
    "Organic":
        "skin" "face human pores soft",
        "wax" "soft translucent candle paraffin",
        "snow" "winter white sparkle cold",
        "lava" "molten glowing hot volcano emission";
    "Templates":
        "template-plain" "template empty new start",
        "template-two-layers" "template layers mask blend",
        "template-relief" "template bump height normal",
        "template-coated" "template lacquer varnish clear coat";
}

/// All materials, by shelf.
pub(crate) fn materials() -> &'static [LibraryMaterial] {
    static MATERIALS: LazyLock<Vec<LibraryMaterial>> = LazyLock::new(|| {
        let read = |&(shelf, id, words, text): &(&'static str, &'static str, &'static str, &str)| {
            // A test reads them all: one that cannot be read is not shown.
            let document = Arc::new(halfvector_graph::file::from_json(text).ok()?);
            Some(LibraryMaterial { id, shelf, words, document })
        };
        FILES.iter().filter_map(read).collect()
    });
    &MATERIALS
}
