//! What part of the canvas is seen: pan and zoom, and points from one space into the other.

use eframe::egui::{self, Pos2, Rect, Vec2, pos2, vec2};

/// Units between the lines of the grid.
pub(super) const GRID: f32 = 20.0;
/// Smallest and largest zoom, in screen points per unit.
pub(super) const ZOOM: std::ops::RangeInclusive<f32> = 0.08..=2.5;

/// The part that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// The canvas point in the middle of the pane.
    pub(super) center: Pos2,
    /// Screen points per unit.
    pub(super) zoom: f32,
}

/// A view in a pane: both spaces are known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    /// The pane on the screen.
    pub(super) pane: Rect,
    pub(super) view: View,
}

impl Default for View {
    fn default() -> Self {
        View { center: Pos2::ZERO, zoom: 1.0 }
    }
}

impl View {
    /// The view that shows a rectangle of the canvas whole, no larger than life.
    pub(super) fn showing(rect: Rect, pane: Rect) -> View {
        let room = (pane.size() - vec2(64.0, 64.0)).max(vec2(16.0, 16.0));
        let wanted = rect.size().max(vec2(1.0, 1.0));
        let zoom = (room / wanted).min_elem().min(1.0).clamp(*ZOOM.start(), *ZOOM.end());
        View { center: rect.center(), zoom }
    }
}

impl Lens {
    pub(super) fn to_screen(self, point: Pos2) -> Pos2 {
        self.pane.center() + (point - self.view.center) * self.view.zoom
    }

    pub(super) fn to_canvas(self, point: Pos2) -> Pos2 {
        self.view.center + (point - self.pane.center()) / self.view.zoom
    }

    pub(super) fn rect_to_screen(self, rect: Rect) -> Rect {
        Rect::from_min_max(self.to_screen(rect.min), self.to_screen(rect.max))
    }

    /// The point of the canvas in the middle of the pane.
    pub(super) fn pane_center(self) -> Pos2 {
        self.to_canvas(self.pane.center())
    }

    /// The part of the canvas that is seen.
    pub(super) fn seen(self) -> Rect {
        Rect::from_min_max(self.to_canvas(self.pane.min), self.to_canvas(self.pane.max))
    }

    /// The view enlarged by a factor, with a point of the screen kept in place.
    pub(super) fn zoomed(self, factor: f32, at: Pos2) -> View {
        let fixed = self.to_canvas(at);
        let zoom = (self.view.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
        View { center: fixed - (at - self.pane.center()) / zoom, zoom }
    }

    /// The view moved by a way on the screen.
    pub(super) fn panned(self, by: Vec2) -> View {
        View { center: self.view.center - by / self.view.zoom, ..self.view }
    }
}

/// Takes the wheel, the trackpad and pinches. A wheel zooms; two fingers pan, or zoom with the command key.
pub(super) fn wheel(ui: &egui::Ui, lens: Lens, pointer: Pos2) -> View {
    let mut lens = lens;
    ui.input(|input| {
        for event in &input.events {
            match event {
                egui::Event::Zoom(factor) => lens.view = lens.zoomed(*factor, pointer),
                egui::Event::MouseWheel { unit, delta, modifiers, .. } => {
                    let is_wheel = *unit != egui::MouseWheelUnit::Point;
                    lens.view = if modifiers.shift && is_wheel {
                        lens.panned(vec2(delta.y + delta.x, 0.0) * 50.0)
                    } else if is_wheel {
                        lens.zoomed((delta.y * 0.12).exp(), pointer)
                    } else if modifiers.command {
                        lens.zoomed((delta.y * 0.005).exp(), pointer)
                    } else {
                        lens.panned(*delta)
                    };
                }
                _ => {}
            }
        }
    });
    lens.view
}

/// The nearest point of the grid.
pub(super) fn to_grid(point: Pos2) -> Pos2 {
    pos2((point.x / GRID).round() * GRID, (point.y / GRID).round() * GRID)
}
