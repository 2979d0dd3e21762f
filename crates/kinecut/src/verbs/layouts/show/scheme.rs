//! A chain in one line: workpiece, axes, bed, axes, tool, with the signs of kinematic schemes.

use super::figure::SHAFT;
use super::looks;
use crate::machine::{CoordinateCode, Elementary};
use crate::page::draw::{arrow, line};
use crate::page::{Anchor, Colour, Ink, Lettering, Picture, Shape, Tint, Width};

/// Size of a sign [px].
const BOX: f64 = 30.0;
/// Room between two signs [px].
const GAP: f64 = 14.0;
/// Height of the line [px].
pub(crate) const HEIGHT: f64 = 66.0;

/// Width of the scheme of a code [px].
pub(crate) fn scheme_width(code: &CoordinateCode) -> f64 {
    let signs = code.word().0.len() + 3;
    signs as f64 * BOX + (signs - 1) as f64 * GAP
}

/// The chain in one line at a place [px].
pub(crate) fn put_scheme(picture: &mut Picture, code: &CoordinateCode, at: [f64; 2]) {
    let (work, tool) = code.word().0.split_at(code.bed());
    let step = BOX + GAP;
    let x = |i: usize| at[0] + i as f64 * step;
    let y = at[1] + 4.0;
    let count = code.word().0.len() + 3;
    let middle = y + 0.5 * BOX;
    picture.path(SHAFT, (1..count).map(|i| line([[x(i) - GAP, middle], [x(i), middle]])).collect::<String>());
    block(picture, [x(0), y], looks::PART);
    caption(picture, [x(0), y], "w");
    for (n, motion) in work.iter().enumerate() {
        joint(picture, [x(n + 1), y], *motion, true);
    }
    bed(picture, [x(code.bed() + 1), y]);
    for (n, motion) in tool.iter().enumerate() {
        joint(picture, [x(code.bed() + 2 + n), y], *motion, false);
    }
    cutter(picture, [x(count - 1), y]);
    caption(picture, [x(count - 1), y], "t");
}

/// An area with an edge.
fn area(picture: &mut Picture, tint: Tint, corners: &[[f64; 2]]) {
    let d = line(corners.iter().copied()) + "Z";
    picture.path(Ink::Face(tint, 1), d.clone());
    picture.path(Ink::line(Colour::Ink, Width::Hair), d);
}

fn block(picture: &mut Picture, [x, y]: [f64; 2], tint: Tint) {
    area(picture, tint, &[[x, y], [x + BOX, y], [x + BOX, y + BOX], [x, y + BOX]]);
}

fn caption(picture: &mut Picture, [x, y]: [f64; 2], text: &str) {
    picture.tick([x + 0.5 * BOX, y + BOX + 15.0], Anchor::Middle, text);
}

fn name(picture: &mut Picture, [x, y]: [f64; 2], text: String) {
    let at = [x + 0.5 * BOX, y + BOX + 17.0];
    let lettering = Lettering::Name(Colour::Ink);
    picture.shapes.push(Shape::Word { at, anchor: Anchor::Middle, text, lettering });
}

/// A translation: an arrow in a box along its direction; a rotation: a turning arrow.
fn joint(picture: &mut Picture, [x, y]: [f64; 2], motion: Elementary, work: bool) {
    let (cx, cy) = (x + 0.5 * BOX, y + 0.5 * BOX);
    let r = 0.33 * BOX;
    // X level, Y slanting as what goes back, Z upright; the slide of an axis that carries the work goes the other way.
    let sign = if work { -1.0 } else { 1.0 };
    let points: Vec<[f64; 2]> = if motion.is_rotation() {
        (0..=24)
            .map(|i| {
                let angle = sign * (-2.2 + 4.6 * f64::from(i) / 24.0);
                [cx + r * angle.cos(), cy - r * angle.sin()]
            })
            .collect()
    } else {
        let [u, v] = match motion {
            Elementary::X => [1.0, 0.0],
            Elementary::Y => [0.75, -0.6],
            _ => [0.0, -1.0],
        };
        [-1.0, 1.0].map(|s| [cx + sign * s * 1.05 * r * u, cy + sign * s * 1.05 * r * v]).to_vec()
    };
    block(picture, [x, y], if work { looks::WORK } else { looks::TOOL });
    let shaft = Ink::line(Colour::Ink, Width::Thin);
    // No halo inside of a box.
    let from = picture.shapes.len();
    arrow(picture, &points, shaft, Colour::Ink);
    picture.shapes.remove(from);
    name(picture, [x, y], format!("{}{}", motion.iso(), if work { "\u{2032}" } else { "" }));
}

/// The sign of the ground.
fn bed(picture: &mut Picture, [x, y]: [f64; 2]) {
    let base = y + 0.78 * BOX;
    let hatch = (0..5).map(|i| x + BOX * (0.1 + 0.2 * f64::from(i)));
    let hatch: String = hatch.map(|from| line([[from, base], [from - 4.0, base + 6.0]])).collect();
    let sign = line([[x, y + 0.5 * BOX], [x + BOX, y + 0.5 * BOX]])
        + &line([[x + 0.5 * BOX, y + 0.5 * BOX], [x + 0.5 * BOX, base]])
        + &line([[x, base], [x + BOX, base]]);
    picture.path(SHAFT, sign);
    picture.path(Ink::line(Colour::Quiet, Width::Hair), hatch);
    name(picture, [x, y], "0".to_owned());
}

fn cutter(picture: &mut Picture, [x, y]: [f64; 2]) {
    let outline = [
        [0.0, 0.2],
        [0.55, 0.2],
        [0.55, 0.36],
        [1.0, 0.36],
        [1.0, 0.64],
        [0.55, 0.64],
        [0.55, 0.8],
        [0.0, 0.8],
    ];
    area(picture, looks::STEEL, &outline.map(|[a, b]| [x + a * BOX, y + b * BOX]));
}
