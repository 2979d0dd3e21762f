//! Files and figures: one layout, a chain in one line, a sheet of many layouts.

use maud::{Markup, PreEscaped, html};

use super::figure::{group, layout_group};
use super::given::given_bodies;
use super::scheme::{HEIGHT, scheme_group, scheme_width};
use super::style::layout_style;
use crate::machine::layouts::{Attitude, Layout, Sizes};
use crate::machine::{CoordinateCode, Machine};
use crate::page::chart::px;
use crate::page::visible;

/// Size of the picture of one layout [px].
const PICTURE: [f64; 2] = [560.0, 470.0];
/// Size of a cell of a sheet [px].
const CELL: [f64; 2] = [300.0, 300.0];
/// Height of the words of a cell [px].
const WORDS: f64 = 40.0;
/// Room at the edges [px].
const MARGIN: f64 = 12.0;

/// A layout as an SVG file: picture and chain.
///
/// ```
/// use kinecut::machine::{CoordinateCode, layouts::{Attitude, Sizes}};
/// let code = CoordinateCode::parse("641203").unwrap();
/// let svg = kinecut::verbs::layouts::layout_drawing(&code, Attitude::Vertical, &Sizes::default());
/// assert!(svg.starts_with("<svg") && svg.contains("C\u{2032}"));
/// ```
pub fn layout_drawing(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes) -> String {
    let size = drawing_size(code);
    file(size, &summary(code, attitude), &drawing(code, attitude, sizes, size))
}

/// The same for a page that has the rules of [`layout_style`].
pub fn layout_figure(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes) -> Markup {
    let size = drawing_size(code);
    let view = format!("0 0 {} {}", px(size[0]), px(size[1]));
    html! {
        svg viewBox=(view) role="img" aria-label=(summary(code, attitude)) { g.kc { (drawing(code, attitude, sizes, size)) } }
    }
}

/// A machine as an SVG file, its axes at home: the bodies that its file gives, or, where it gives none, its strokes to
/// scale and the directions of its inclined axes.
pub fn machine_drawing(machine: &Machine, attitude: Attitude) -> String {
    machine_drawing_at(machine, attitude, &[])
}

/// A machine with its bodies at joint positions `q` [mm or rad], as an SVG file; one without bodies as
/// [`machine_drawing`] shows it.
pub fn machine_drawing_at(machine: &Machine, attitude: Attitude, q: &[f64]) -> String {
    if let Some(made) = given_bodies(machine, attitude, q) {
        let code = &machine.code;
        let size = drawing_size(code);
        let body = around(code, attitude, size, &group(code, &made, [0.0, 30.0], [size[0], PICTURE[1]]));
        return file(size, &summary(code, attitude), &body);
    }
    let mut sizes = Sizes::default();
    for joint in &machine.joints {
        let digit = usize::from(joint.motion.digit());
        match joint.travel {
            Some([low, high]) if digit <= 3 && high - low > 0.0 => sizes.stroke[digit - 1] = high - low,
            _ => {}
        }
        if digit > 6 {
            sizes.inclined[digit - 7] = joint.direction;
        }
    }
    layout_drawing(&machine.code, attitude, &sizes)
}

/// The chain of a code in one line as an SVG file.
pub fn layout_scheme(code: &CoordinateCode) -> String {
    let size = [scheme_width(code) + 2.0 * MARGIN, HEIGHT];
    file(size, &code.iso(), &scheme_group(code, [MARGIN, 4.0]))
}

/// Many layouts on a sheet as an SVG file, `columns` beside each other, each with its digits, chain and kind; their
/// strokes are those of the layouts.
pub fn layout_sheet(title: &str, layouts: &[Layout], sizes: &Sizes, columns: usize) -> String {
    let columns = columns.clamp(1, layouts.len().max(1));
    let rows = layouts.len().div_ceil(columns);
    let top = MARGIN + 26.0;
    let width = 2.0 * MARGIN + columns as f64 * CELL[0];
    let size = [width, top + rows as f64 * CELL[1] + MARGIN];
    let body = html! {
        text.title x=(px(MARGIN + 4.0)) y=(px(MARGIN + 12.0)) { (visible(title)) }
        @for (i, layout) in layouts.iter().enumerate() {
            @let at = [MARGIN + (i % columns) as f64 * CELL[0], top + (i / columns) as f64 * CELL[1]];
            (cell(layout, sizes, at))
        }
    };
    file(size, title, &body)
}

fn cell(layout: &Layout, sizes: &Sizes, at: [f64; 2]) -> Markup {
    let sizes = Sizes { stroke: layout.stroke, ..sizes.clone() };
    let picture = [CELL[0] - 8.0, CELL[1] - WORDS - 12.0];
    let mark = if layout.pareto { " \u{2605}" } else { "" };
    html! {
        rect.cell x=(px(at[0] + 2.0)) y=(px(at[1] + 2.0)) width=(px(CELL[0] - 4.0)) height=(px(CELL[1] - 4.0)) rx="4" {}
        text.title x=(px(at[0] + 12.0)) y=(px(at[1] + 20.0)) { (layout.code) (mark) }
        text.quiet x=(px(at[0] + CELL[0] - 12.0)) y=(px(at[1] + 20.0)) text-anchor="end" { (layout.kind) ", " (layout.attitude.name()) }
        text.quiet x=(px(at[0] + 12.0)) y=(px(at[1] + 36.0)) { (layout.code.iso()) }
        (layout_group(&layout.code, layout.attitude, &sizes, [at[0] + 4.0, at[1] + WORDS + 4.0], picture))
    }
}

fn drawing_size(code: &CoordinateCode) -> [f64; 2] {
    [PICTURE[0].max(scheme_width(code) + 2.0 * MARGIN), PICTURE[1] + HEIGHT + 34.0]
}

fn drawing(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes, size: [f64; 2]) -> Markup {
    around(code, attitude, size, &layout_group(code, attitude, sizes, [0.0, 30.0], [size[0], PICTURE[1]]))
}

/// A picture with its title and the chain in one line.
fn around(code: &CoordinateCode, attitude: Attitude, size: [f64; 2], picture: &Markup) -> Markup {
    html! {
        text.title x=(px(MARGIN)) y="22" { (code) }
        text.quiet x=(px(size[0] - MARGIN)) y="22" text-anchor="end" { (code.iso()) ", spindle " (attitude.name()) }
        (picture)
        (scheme_group(code, [0.5 * (size[0] - scheme_width(code)), 34.0 + PICTURE[1]]))
    }
}

fn summary(code: &CoordinateCode, attitude: Attitude) -> String {
    format!("Machine {code}, {}, spindle {}", code.iso(), attitude.name())
}

/// An SVG file with its colours.
pub(crate) fn file(size: [f64; 2], summary: &str, body: &Markup) -> String {
    let view = format!("0 0 {} {}", px(size[0]), px(size[1]));
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(view) width=(px(size[0])) height=(px(size[1])) role="img" aria-label=(visible(summary)) {
            style { (PreEscaped(layout_style())) }
            g.kc {
                rect.paper x="0" y="0" width=(px(size[0])) height=(px(size[1])) {}
                (body)
            }
        }
    }
    .into_string()
}
