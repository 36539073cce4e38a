//! Colours and measures of the window, dark and light. The one place where a colour is chosen.

use eframe::egui::{self, Color32, CornerRadius, Stroke};
use halfvector_graph::value::{SocketType, Type};

/// The colour of a socket and its wires.
pub(crate) fn socket_color(ty: SocketType) -> Color32 {
    match ty {
        SocketType::Value(Type::F32) => Color32::from_rgb(0xa6, 0xad, 0xba),
        SocketType::Value(Type::I32) => Color32::from_rgb(0x5f, 0xa8, 0x78),
        SocketType::Value(Type::Bool) => Color32::from_rgb(0xd0, 0x7a, 0xa8),
        SocketType::Value(Type::Vec2) => Color32::from_rgb(0x56, 0xb0, 0xc8),
        SocketType::Value(Type::Vec3) => Color32::from_rgb(0xe0, 0xb0, 0x4a),
        SocketType::Value(Type::Vec4) => Color32::from_rgb(0xd9, 0x84, 0x52),
        SocketType::Generic => Color32::from_rgb(0x9a, 0x8c, 0xe0),
        SocketType::Texture => Color32::from_rgb(0xc9, 0x66, 0x66),
        SocketType::Surface => Color32::from_rgb(0x6f, 0xc0, 0x5a),
    }
}

/// The colour of a node's header by the category of its definition, such as `math`.
pub(crate) fn category_color(category: &str) -> Color32 {
    match category {
        "surface" => Color32::from_rgb(0x3f, 0x6f, 0x3a),
        "textures" => Color32::from_rgb(0x7a, 0x42, 0x42),
        "procedural" => Color32::from_rgb(0x7a, 0x5a, 0x2e),
        "color" => Color32::from_rgb(0x78, 0x6a, 0x2c),
        "coordinates" => Color32::from_rgb(0x2e, 0x64, 0x74),
        "geometry" | "spaces" => Color32::from_rgb(0x2f, 0x6b, 0x62),
        "vector" => Color32::from_rgb(0x4a, 0x56, 0x86),
        _ => Color32::from_rgb(0x4c, 0x54, 0x62),
    }
}

// These four are seen on both grounds.

/// Something is wrong.
pub(crate) const ERROR: Color32 = Color32::from_rgb(0xe0, 0x5c, 0x50);
/// Something may be wrong.
pub(crate) const WARNING: Color32 = Color32::from_rgb(0xcf, 0x93, 0x22);
/// Something is well.
pub(crate) const GOOD: Color32 = Color32::from_rgb(0x48, 0xa6, 0x55);
/// What is chosen.
pub(crate) const ACCENT: Color32 = Color32::from_rgb(0x4d, 0x9d, 0xe0);

/// One of them for letters: darker on a light ground, where it would be too pale to be read.
pub(crate) fn letters(color: Color32, visuals: &egui::Visuals) -> Color32 {
    if visuals.dark_mode { color } else { Color32::from_rgb(dark(color.r()), dark(color.g()), dark(color.b())) }
}

fn dark(channel: u8) -> u8 {
    (u16::from(channel) * 7 / 10) as u8
}

/// Colours of the graph's ground and cards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CanvasColors {
    /// Behind everything.
    pub(crate) ground: Color32,
    /// Lines of the grid, and every fifth of them.
    pub(crate) grid: Color32,
    pub(crate) grid_strong: Color32,
    /// A card, its outline, and its outline under the pointer.
    pub(crate) card: Color32,
    pub(crate) line: Color32,
    pub(crate) line_strong: Color32,
    pub(crate) shadow: Color32,
    /// Where a value is changed, and the part of its range that it fills.
    pub(crate) field: Color32,
    pub(crate) filled: Color32,
    /// Letters: of rows, of what matters less, and of titles.
    pub(crate) text: Color32,
    pub(crate) weak: Color32,
    pub(crate) title: Color32,
    /// A comment and its letters.
    pub(crate) note: Color32,
    pub(crate) note_text: Color32,
}

/// The usual colour of a frame.
pub(crate) const FRAME: [u8; 3] = [0x7a, 0x86, 0x96];
/// Colours that a frame can have besides.
pub(crate) const FRAMES: &[[u8; 3]] = &[
    [0xc4, 0x5f, 0x57],
    [0xc9, 0x8a, 0x3c],
    [0x6f, 0xa8, 0x5c],
    [0x3f, 0x9c, 0x9c],
    [0x4d, 0x86, 0xd0],
    [0x95, 0x6f, 0xc4],
];

/// The graph's colours in a theme.
pub(crate) fn canvas(visuals: &egui::Visuals) -> CanvasColors {
    let gray = Color32::from_rgb;
    if visuals.dark_mode {
        CanvasColors {
            ground: gray(0x17, 0x19, 0x1c),
            grid: gray(0x1d, 0x20, 0x24),
            grid_strong: gray(0x25, 0x28, 0x2e),
            card: gray(0x2a, 0x2d, 0x33),
            line: gray(0x10, 0x11, 0x13),
            line_strong: gray(0x6a, 0x72, 0x7e),
            shadow: Color32::from_black_alpha(70),
            field: gray(0x1c, 0x1e, 0x22),
            filled: gray(0x37, 0x4b, 0x60),
            text: gray(0xcf, 0xd4, 0xdb),
            weak: gray(0x86, 0x8e, 0x99),
            title: gray(0xf2, 0xf4, 0xf6),
            note: gray(0x3a, 0x37, 0x2a),
            note_text: gray(0xe4, 0xdc, 0xbe),
        }
    } else {
        CanvasColors {
            ground: gray(0xe4, 0xe6, 0xe9),
            grid: gray(0xdb, 0xdd, 0xe1),
            grid_strong: gray(0xcf, 0xd2, 0xd7),
            card: gray(0xfa, 0xfa, 0xfb),
            line: gray(0xb4, 0xb9, 0xc1),
            line_strong: gray(0x7d, 0x86, 0x93),
            shadow: Color32::from_black_alpha(28),
            field: gray(0xe9, 0xeb, 0xee),
            filled: gray(0xb9, 0xd4, 0xee),
            text: gray(0x2a, 0x2e, 0x34),
            weak: gray(0x77, 0x7f, 0x8a),
            title: gray(0xff, 0xff, 0xff),
            note: gray(0xfb, 0xf4, 0xd3),
            note_text: gray(0x4a, 0x43, 0x28),
        }
    }
}

/// Sets both themes of the window.
pub(crate) fn install(context: &egui::Context) {
    context.options_mut(|options| {
        // As long as other programs wait for the second click.
        options.input_options.max_double_click_delay = 0.5;
        // On a busy machine a frame may lie between press and release that takes a second.
        options.input_options.max_click_duration = 1.5;
    });
    context.style_mut_of(egui::Theme::Dark, |style| {
        style.visuals.panel_fill = Color32::from_rgb(0x1d, 0x1f, 0x23);
        style.visuals.window_fill = Color32::from_rgb(0x24, 0x27, 0x2c);
        style.visuals.extreme_bg_color = Color32::from_rgb(0x14, 0x16, 0x19);
        style.visuals.faint_bg_color = Color32::from_rgb(0x23, 0x26, 0x2b);
        style.visuals.window_stroke = Stroke::new(1.0, Color32::from_rgb(0x3a, 0x3f, 0x47));
    });
    context.style_mut_of(egui::Theme::Light, |style| {
        style.visuals.weak_text_alpha = 0.75;
        style.visuals.widgets.inactive.weak_bg_fill = Color32::from_rgb(0xea, 0xec, 0xef);
        style.visuals.widgets.inactive.bg_stroke = Stroke::new(1.0, Color32::from_rgb(0xd2, 0xd6, 0xdb));
    });
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        context.style_mut_of(theme, |style| {
            // The letters of what is chosen, and links.
            let [chosen, link] = match theme {
                egui::Theme::Dark => [Color32::from_rgb(0xcc, 0xe4, 0xfb), ACCENT],
                egui::Theme::Light => [Color32::from_rgb(0x10, 0x42, 0x70), Color32::from_rgb(0x1c, 0x6c, 0xb0)],
            };
            style.visuals.selection.bg_fill = ACCENT.gamma_multiply(0.45);
            style.visuals.selection.stroke.color = chosen;
            style.visuals.hyperlink_color = link;
            style.visuals.warn_fg_color = WARNING;
            style.visuals.error_fg_color = ERROR;
            style.visuals.window_corner_radius = CornerRadius::same(6);
            style.visuals.menu_corner_radius = CornerRadius::same(6);
            style.spacing.item_spacing = egui::vec2(6.0, 5.0);
            style.spacing.button_padding = egui::vec2(7.0, 3.0);
            // As high as a button is: in lower rows widgets would not stand in one line.
            style.spacing.interact_size.y = 21.0;
        });
    }
}

/// Colours of code: keyword, type, number, comment, call, attribute.
pub(crate) fn code_colors(is_dark: bool) -> [Color32; 6] {
    let colors: [u32; 6] = if is_dark {
        [0xc792ea, 0x82c8e0, 0xf0a36b, 0x7a828e, 0x8fb8f0, 0xa9b665]
    } else {
        [0x7b30a8, 0x0b6e85, 0xa8480c, 0x7a7f87, 0x2458a6, 0x5d6d10]
    };
    colors.map(|rgb| {
        let [_, r, g, b] = rgb.to_be_bytes();
        Color32::from_rgb(r, g, b)
    })
}

/// From cold (0) to hot (1): what costs little and what costs much.
pub(crate) fn heat(share: f32) -> Color32 {
    let share = share.clamp(0.0, 1.0);
    let mix = |a: f32, b: f32| (a + (b - a) * share) as u8;
    Color32::from_rgb(mix(74.0, 232.0), mix(150.0, 88.0), mix(190.0, 70.0))
}
