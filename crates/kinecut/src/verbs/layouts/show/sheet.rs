//! Files and figures: one layout, a chain in one line, a sheet of many layouts.

use super::bodies::Bodies;
use super::figure::{put, put_layout};
use super::given::given_bodies;
use super::scheme::{HEIGHT, put_scheme, scheme_width};
use super::usual::{usual, usual_sizes};
use crate::machine::layouts::{Attitude, Layout, Sizes};
use crate::machine::{CoordinateCode, Machine};
use crate::page::{Picture, draw};

/// Size of the picture of one layout [px].
const PICTURE: [f64; 2] = [512.0, 440.0];
/// Size of a picture of a sheet [px].
const CELL: [f64; 2] = [300.0, 260.0];
/// Room beside the chain in one line [px].
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
    alone(layout_figure(code, attitude, sizes))
}

/// The same as a picture of a page.
pub fn layout_figure(code: &CoordinateCode, attitude: Attitude, sizes: &Sizes) -> Picture {
    with_scheme(code, attitude, |picture, at| put_layout(picture, code, attitude, sizes, at))
}

/// A machine as an SVG file, its axes at home: the bodies that its file gives, or, where it gives none, its strokes to
/// scale and the directions of its inclined axes.
pub fn machine_drawing(machine: &Machine, attitude: Attitude) -> String {
    machine_drawing_at(machine, attitude, &[])
}

/// A machine with its bodies at joint positions `q` [mm or rad], as an SVG file; one without bodies with the usual ones,
/// which turn about their own middles.
pub fn machine_drawing_at(machine: &Machine, attitude: Attitude, q: &[f64]) -> String {
    let picture =
        |made: &Bodies| alone(with_scheme(&machine.code, attitude, |picture, at| put(picture, made, at)));
    if let Some(made) = given_bodies(machine, attitude, q) {
        return picture(&made);
    }
    let sizes = usual_sizes(machine);
    if q.iter().all(|q| *q == 0.0) {
        return layout_drawing(&machine.code, attitude, &sizes);
    }
    let (moving, home) = usual(machine, attitude, &sizes);
    let mut made = given_bodies(&moving, attitude, q).unwrap_or_default();
    made.solids.iter_mut().zip(&home.solids).for_each(|(moved, own)| moved.tint = own.tint);
    picture(&made)
}

/// The chain of a code in one line as an SVG file.
pub fn layout_scheme(code: &CoordinateCode) -> String {
    let mut picture = Picture { title: code.iso(), ..Picture::default() };
    picture.size = [scheme_width(code) + 2.0 * MARGIN, HEIGHT];
    put_scheme(&mut picture, code, [MARGIN, 4.0]);
    alone(picture)
}

/// Many layouts on a sheet as an SVG file, `columns` beside each other, each with its digits, chain and kind; their
/// strokes are those of the layouts.
pub fn layout_sheet(title: &str, layouts: &[Layout], sizes: &Sizes, columns: usize) -> String {
    let one = |layout: &Layout| {
        let sizes = Sizes { stroke: layout.stroke, ..sizes.clone() };
        let mark = if layout.pareto { " \u{2605}" } else { "" };
        let mut picture = Picture {
            title: format!("{}{mark}, {}, {}", layout.code, layout.kind, layout.attitude.name()),
            about: layout.code.iso(),
            size: CELL,
            ..Picture::default()
        };
        put_layout(&mut picture, &layout.code, layout.attitude, &sizes, [0.0, 0.0, CELL[0], CELL[1]]);
        picture
    };
    draw::sheet(title, &layouts.iter().map(one).collect::<Vec<_>>(), columns)
}

/// A picture with the chain in one line below.
fn with_scheme(code: &CoordinateCode, attitude: Attitude, draw: impl Fn(&mut Picture, [f64; 4])) -> Picture {
    let width = PICTURE[0].max(scheme_width(code) + 2.0 * MARGIN);
    let mut picture = Picture {
        title: code.to_string(),
        about: format!("{}, spindle {}", code.iso(), attitude.name()),
        summary: format!("Machine {code}, {}, spindle {}", code.iso(), attitude.name()),
        size: [width, PICTURE[1] + HEIGHT],
        ..Picture::default()
    };
    draw(&mut picture, [0.0, 0.0, width, PICTURE[1]]);
    put_scheme(&mut picture, code, [0.5 * (width - scheme_width(code)), PICTURE[1]]);
    picture
}

/// A picture as a file.
fn alone(picture: Picture) -> String {
    draw::sheet(&picture.title.clone(), &[picture], 1)
}
