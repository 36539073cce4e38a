//! Errors over a number: a line for each case, named at its end; an SVG of its own.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{BEATEN, Drawn, FRONT, GRID, INK, MUTED, SIZE, escaped, in_page};

/// A line of a plot.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What stands at its end.
    pub name: String,
    /// Places along x, rising, and errors as parts.
    pub points: Vec<(f64, f64)>,
}

/// Room at the right for names [px].
const NAMES: i32 = 96;

/// Lines of names lie at least this far apart [px].
const APART: i32 = 17;

/// Draws errors, in percent from 0 up. `title` is what the plot shows, for those who do not see it.
pub fn curves(title: &str, x_title: &str, y_title: &str, curves: &[Curve]) -> String {
    let mut svg = String::new();
    draw(x_title, y_title, curves, SVGBackend::with_string(&mut svg, SIZE).into_drawing_area())
        .expect("a string takes every drawing");
    in_page(&svg, &escaped(title))
}

fn draw(x_title: &str, y_title: &str, curves: &[Curve], root: super::Area<'_>) -> Drawn {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let (low, high) = points().fold((f64::INFINITY, 0.0_f64), |(low, high), &(x, _)| (low.min(x), high.max(x)));
    let most = points().map(|&(_, y)| y).fold(1e-3, f64::max);
    // A line, or a point, has room on both sides.
    let room = (0.04 * (high - low)).max(0.01);
    let text = |size: i32, color: &RGBColor| ("sans-serif", size).into_font().color(color);
    let mut chart = ChartBuilder::on(&root)
        .margin(10)
        .margin_right(NAMES)
        .set_label_area_size(LabelAreaPosition::Left, 74)
        .set_label_area_size(LabelAreaPosition::Bottom, 48)
        .build_cartesian_2d(low - room..high + room, 0.0..1.08 * most)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(BEATEN)
        .x_labels(9)
        .y_labels(8)
        .x_desc(x_title)
        .y_desc(y_title)
        .axis_desc_style(text(15, &MUTED))
        .label_style(text(14, &MUTED))
        .x_label_formatter(&|x| format!("{x:.1}"))
        .y_label_formatter(&|y| format!("{:.0} %", 100.0 * y))
        .draw()?;
    const COLORS: [RGBColor; 4] = [FRONT, INK, MUTED, BEATEN];
    let mut ends: Vec<(i32, i32, usize)> = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        let color = COLORS[number % COLORS.len()];
        chart.draw_series([PathElement::new(curve.points.clone(), color.stroke_width(2))])?;
        chart.draw_series(curve.points.iter().map(|&point| Circle::new(point, 4, color.filled())))?;
        if let Some(last) = curve.points.last() {
            let (x, y) = chart.backend_coord(last);
            ends.push((x, y, number));
        }
    }
    drop(chart);
    // From the top down each name goes below the one before.
    ends.sort_by_key(|&(_, y, _)| y);
    let mut above = i32::MIN / 2;
    for (x, y, number) in ends {
        let y = y.max(above + APART);
        above = y;
        // The palest color is for lines: words want more contrast.
        let color = if number % COLORS.len() == 3 { MUTED } else { COLORS[number % COLORS.len()] };
        let style = text(15, &color).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw(&Text::new(curves[number].name.clone(), (x + 24, y), style))?;
    }
    root.present()
}
