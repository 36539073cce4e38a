//! A comparison as a plot: cost across, error upward, both logarithmic; an SVG of its own.
//!
//! Colours are presentation attributes of a light page. A page that is dark, too, overrides them by their value
//! ([`DARK`]).

pub mod curves;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::comparison::{Comparison, Entry};
use crate::cost::Cost;
use crate::unit::{Budget, Unit};
use crate::words;

/// Size of a plot [px].
const SIZE: (u32, u32) = (760, 420);

const INK: RGBColor = RGBColor(0x1F, 0x24, 0x30);
const MUTED: RGBColor = RGBColor(0x6B, 0x72, 0x80);
const GRID: RGBColor = RGBColor(0xE6, 0xE8, 0xEC);
const FRONT: RGBColor = RGBColor(0x2F, 0x5B, 0xEA);
const BEATEN: RGBColor = RGBColor(0xA3, 0xA9, 0xB6);

/// Each colour of a light page, and what stands for it on a dark one.
pub const DARK: [(&str, &str); 5] = [
    ("#1F2430", "#E8EAF0"),
    ("#6B7280", "#9AA3B5"),
    ("#E6E8EC", "#2B313D"),
    ("#2F5BEA", "#8AA8FF"),
    ("#A3A9B6", "#646D7F"),
];

/// Style rules that put the colours of a dark page in the place of the light ones.
pub fn dark_rules() -> String {
    DARK.iter()
        .map(|(light, dark)| format!("svg [fill=\"{light}\"]{{fill:{dark}}}svg [stroke=\"{light}\"]{{stroke:{dark}}}"))
        .collect()
}

/// A plot that stands alone: it follows the reader's choice of light or dark by itself.
pub fn alone(svg: &str) -> String {
    let style = format!(
        "<style>text{{font-family:system-ui,sans-serif;paint-order:stroke;stroke:#fff;stroke-width:3px}}\
         @media(prefers-color-scheme:dark){{text{{stroke:#0d1117}}{}}}</style>",
        dark_rules()
    );
    svg.replacen(">\n", &format!(">\n{style}\n"), 1)
}

/// One method in a plot.
struct Dot {
    name: String,
    x: f64,
    y: f64,
    least: f64,
    front: bool,
}

/// A method's name in a plot: with a star when it is the default, with its error when it stands on the floor.
fn name(entry: &Entry<'_>, unit: Unit) -> String {
    let star = if crate::terms::is_default(&entry.row.term, &entry.row.method) { " ★" } else { "" };
    match entry.rms {
        0.0 => format!("{}{star} (exact)", entry.row.method),
        rms if rms < unit.limit(Budget::Film) => format!("{}{star} ({})", entry.row.method, words::error(rms, unit)),
        _ => format!("{}{star}", entry.row.method),
    }
}

/// Draws a comparison.
pub fn scatter(comparison: &Comparison<'_>) -> String {
    let mut svg = String::new();
    draw(comparison, SVGBackend::with_string(&mut svg, SIZE).into_drawing_area())
        .expect("a string takes every drawing");
    in_page(&svg, &escaped(&words::finding(comparison).replace('`', "")))
}

/// A drawing for a page, with what it shows for those who do not see it.
fn in_page(svg: &str, title: &str) -> String {
    svg.replacen("<svg ", "<svg role=\"img\" ", 1).replacen(">\n", &format!(">\n<title>{title}</title>\n"), 1)
}

/// Text for HTML and SVG.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

fn draw(comparison: &Comparison<'_>, root: Area<'_>) -> Drawn {
    let unit = comparison.unit;
    // Errors that are rounding, and those of exactly 0, stand on the floor: on their own scale they would leave no room.
    let counts = |x: &f64| *x >= unit.limit(Budget::Film);
    let rms = || comparison.entries.iter().flat_map(|entry| [entry.rms, entry.least_rms]).filter(counts);
    let most = rms().fold(0.0, f64::max).max(unit.limit(Budget::Film));
    let least = rms().fold(most, f64::min);
    let top = 10_f64.powf((most * 1.25).log10().ceil());
    let has_floor = comparison.entries.iter().any(|entry| !counts(&entry.least_rms));
    let last_mark = 10_f64.powf((least * 0.8).log10().floor());
    // The floor is a band below the last mark.
    let bottom = last_mark * (top / last_mark).powf(if has_floor { -0.16 } else { 0.0 });
    let floor = (bottom * last_mark).sqrt();
    let positive = |x: &f64| *x > 0.0;
    let costs = || comparison.entries.iter().map(|entry| entry.cost).filter(positive);
    let (low, high) = (costs().fold(f64::INFINITY, f64::min), costs().fold(0.0, f64::max));
    let room = (high / low).powf(0.12).max(1.35);
    let range = [low / room, high * room * room];
    let dots: Vec<Dot> = comparison
        .entries
        .iter()
        .map(|entry| Dot {
            name: name(entry, unit),
            x: entry.cost.max(low),
            y: if counts(&entry.rms) { entry.rms } else { floor },
            least: if counts(&entry.least_rms) { entry.least_rms } else { floor },
            front: entry.front,
        })
        .collect();

    let text = |size: i32, color: &RGBColor| ("sans-serif", size).into_font().color(color);
    let mut chart = ChartBuilder::on(&root)
        .margin(10)
        .margin_right(18)
        .set_label_area_size(LabelAreaPosition::Left, 74)
        .set_label_area_size(LabelAreaPosition::Bottom, 48)
        .build_cartesian_2d(
            (range[0]..range[1]).log_scale().with_key_points(marks(range)),
            (bottom..top).log_scale().with_key_points(marks([last_mark, top])),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(BEATEN)
        .x_labels(24)
        .y_labels(24)
        .x_desc(comparison.cost_title())
        .y_desc(unit.title())
        .axis_desc_style(text(15, &MUTED))
        .label_style(text(14, &MUTED))
        .x_label_formatter(&|x| cost_mark(*x, comparison.cost))
        .y_label_formatter(&|y| error_mark(*y, unit))
        .draw()?;

    if has_floor {
        let band = Rectangle::new([(range[0], bottom), (range[1], last_mark)], GRID.mix(0.45).filled());
        chart.draw_series([band])?;
        let (left, middle) = chart.backend_coord(&(range[0], floor));
        let style = text(14, &MUTED).pos(Pos::new(HPos::Right, VPos::Center));
        root.draw(&Text::new("rounding", (left - 8, middle), style))?;
    }

    // The front as steps: to be beaten, a method has to lie below and to the left of it.
    let mut steps: Vec<(f64, f64)> = dots.iter().filter(|dot| dot.front).map(|dot| (dot.x, dot.y)).collect();
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut line: Vec<(f64, f64)> = Vec::new();
    for (x, y) in steps {
        line.extend(line.last().map(|&(_, before)| (x, before)));
        line.push((x, y));
    }
    let corners: Vec<(i32, i32)> = line.iter().map(|point| chart.backend_coord(point)).collect();
    chart.draw_series([PathElement::new(line, FRONT.stroke_width(1))])?;
    for dot in &dots {
        let color = if dot.front { FRONT } else { BEATEN };
        chart.draw_series([PathElement::new(vec![(dot.x, dot.least), (dot.x, dot.y)], color.stroke_width(2))])?;
        chart.draw_series([Circle::new((dot.x, dot.y), 5, color.filled())])?;
    }
    let places: Vec<(i32, i32)> = dots.iter().map(|dot| chart.backend_coord(&(dot.x, dot.y))).collect();
    let lines: Vec<Bounds> = dots
        .iter()
        .zip(&places)
        .map(|(dot, &(x, y))| [x - 2, y, x + 2, chart.backend_coord(&(dot.x, dot.least)).1])
        .collect();
    drop(chart);
    labels(&root, &dots, &places, &corners, &lines)?;
    root.present()
}

/// Left, top, right, bottom [px].
type Bounds = [i32; 4];

fn overlap(a: Bounds, b: Bounds) -> i32 {
    let side = |low: usize, high: usize| (a[high].min(b[high]) - a[low].max(b[low])).max(0);
    side(0, 2) * side(1, 3)
}

/// Names beside their dots, where they cover the least of what is there already; a name that has to go farther away is
/// tied to its dot.
fn labels(root: &Area<'_>, dots: &[Dot], places: &[(i32, i32)], corners: &[(i32, i32)], lines: &[Bounds]) -> Drawn {
    let frame = [88, 6, SIZE.0 as i32 - 6, SIZE.1 as i32 - 62];
    let mut taken: Vec<Bounds> = places.iter().map(|&(x, y)| [x - 6, y - 6, x + 6, y + 6]).collect();
    taken.extend(corners.windows(2).map(|ends| {
        let ((a, b), (c, d)) = (ends[0], ends[1]);
        [a.min(c) - 2, b.min(d) - 2, a.max(c) + 2, b.max(d) + 2]
    }));
    // Those down to a method's best inputs.
    taken.extend(lines);
    for (dot, &(x, y)) in dots.iter().zip(places) {
        let (width, height) = ((7.7 * dot.name.chars().count() as f64) as i32, 16);
        let mut best: Option<(i32, Bounds)> = None;
        for distance in [0, 16, 32, 48] {
            let beside = [
                (9 + distance, -height / 2),
                (9, -height - distance),
                (9, distance),
                (-9 - distance - width, -height / 2),
                (-9 - width, -height - distance),
                (-9 - width, distance),
                (-width / 2, -height - 6 - distance),
                (-width / 2, 6 + distance),
            ];
            for (dx, dy) in beside {
                let place = [x + dx, y + dy, x + dx + width, y + dy + height];
                let outside = width * height - overlap(place, frame);
                let cost = 4 * taken.iter().map(|&other| overlap(place, other)).sum::<i32>() + 20 * outside + distance;
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, place));
                }
            }
        }
        let Some((_, place)) = best else { continue };
        taken.push(place);
        let (left, middle) = (place[0], (place[1] + place[3]) / 2);
        let near = x.clamp(place[0], place[2]);
        if (near - x).abs() + (middle - y).abs() > 26 {
            root.draw(&PathElement::new(vec![(x, y), (near, middle)], BEATEN.stroke_width(1)))?;
        }
        let color = if dot.front { INK } else { MUTED };
        // How wide a name is is a guess: it grows away from its dot.
        let (anchor, from) = if place[2] <= x { (HPos::Right, place[2]) } else { (HPos::Left, left) };
        let style = ("sans-serif", 15).into_font().color(&color).pos(Pos::new(anchor, VPos::Center));
        root.draw(&Text::new(dot.name.clone(), (from, middle), style))?;
    }
    Ok(())
}

/// Where an axis has its marks: 1, 2 and 5 in every decade, or decades alone where there are many.
fn marks([low, high]: [f64; 2]) -> Vec<f64> {
    let decades = (high / low).log10();
    let digits: &[f64] = if decades < 0.7 {
        &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0]
    } else if decades < 2.5 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let first = low.log10().floor() as i32;
    let last = high.log10().ceil() as i32;
    let all = (first..=last).flat_map(|exponent| digits.iter().map(move |digit| digit * 10_f64.powi(exponent)));
    // The ends of decades come out a rounding error away.
    all.filter(|x| (low * 0.999..=high * 1.001).contains(x)).map(|x| x.clamp(low, high)).collect()
}

/// A mark of the axis of costs.
fn cost_mark(x: f64, cost: Cost) -> String {
    match cost {
        Cost::Bytes => words::cost(x, cost),
        Cost::Batch | Cost::Call | Cost::Device | Cost::Instructions => plain(x),
    }
}

/// A mark of the axis of errors.
fn error_mark(y: f64, unit: Unit) -> String {
    match unit {
        Unit::Relative => format!("{} %", short(100.0 * y)),
        Unit::Degrees => format!("{}°", short(y)),
        Unit::Ulps | Unit::Plain => short(y),
    }
}

/// A round number, as a power of ten where it is small.
fn short(x: f64) -> String {
    if x >= 0.9e-3 { plain(x) } else { words::power_of_ten(x.log10().round() as i32) }
}

/// A round number as it is said: 0.2, 50, 2000.
fn plain(x: f64) -> String {
    let digits = (1.0 - (x * 1.000_001).log10().floor()).max(0.0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
