//! A chain in one line: workpiece, axes, bed, axes, tool, with the signs of kinematic schemes.

use maud::{Markup, html};

use super::figure::{arrow, polyline};
use crate::machine::{CoordinateCode, Elementary};
use crate::page::chart::px;

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
pub(crate) fn scheme_group(code: &CoordinateCode, at: [f64; 2]) -> Markup {
    let (work, tool) = code.word().0.split_at(code.bed());
    let step = BOX + GAP;
    let x = |i: usize| at[0] + i as f64 * step;
    let y = at[1] + 4.0;
    let count = code.word().0.len() + 3;
    html! {
        g {
            @for i in 1..count {
                path.move d=(polyline(&[[x(i) - GAP, y + 0.5 * BOX], [x(i), y + 0.5 * BOX]])) {}
            }
            (block(x(0), y, "kp0"))
            (caption(x(0), y, "w"))
            @for (n, motion) in work.iter().enumerate() { (joint(x(n + 1), y, *motion, true)) }
            (bed(x(code.bed() + 1), y))
            @for (n, motion) in tool.iter().enumerate() { (joint(x(code.bed() + 2 + n), y, *motion, false)) }
            (cutter(x(count - 1), y))
            (caption(x(count - 1), y, "t"))
        }
    }
}

fn block(x: f64, y: f64, class: &str) -> Markup {
    html! { rect class=(format!("face {class}")) x=(px(x)) y=(px(y)) width=(px(BOX)) height=(px(BOX)) rx="3" {} }
}

fn caption(x: f64, y: f64, text: &str) -> Markup {
    html! { text.quiet x=(px(x + 0.5 * BOX)) y=(px(y + BOX + 15.0)) text-anchor="middle" { (text) } }
}

/// A translation: an arrow in a box along its direction; a rotation: a turning arrow.
fn joint(x: f64, y: f64, motion: Elementary, work: bool) -> Markup {
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
    let name = format!("{}{}", motion.iso(), if work { "\u{2032}" } else { "" });
    html! {
        (block(x, y, if work { "kw0" } else { "kt0" }))
        (arrow(&points, "thin"))
        text.letter x=(px(cx)) y=(px(y + BOX + 17.0)) text-anchor="middle" { (name) }
    }
}

/// The sign of the ground.
fn bed(x: f64, y: f64) -> Markup {
    let base = y + 0.78 * BOX;
    let hatch: String = (0..5)
        .map(|i| {
            let from = x + BOX * (0.1 + 0.2 * f64::from(i));
            polyline(&[[from, base], [from - 4.0, base + 6.0]])
        })
        .collect();
    let line = polyline(&[[x, base], [x + BOX, base]]);
    let post = polyline(&[[x, y + 0.5 * BOX], [x + BOX, y + 0.5 * BOX]])
        + &polyline(&[[x + 0.5 * BOX, y + 0.5 * BOX], [x + 0.5 * BOX, base]]);
    html! {
        path.move d=(post + &line) {}
        path.ground d=(hatch) {}
        text.letter x=(px(x + 0.5 * BOX)) y=(px(y + BOX + 17.0)) text-anchor="middle" { "0" }
    }
}

fn cutter(x: f64, y: f64) -> Markup {
    let at = |a: f64, b: f64| [x + a * BOX, y + b * BOX];
    let outline = polyline(&[
        at(0.0, 0.2),
        at(0.55, 0.2),
        at(0.55, 0.36),
        at(1.0, 0.36),
        at(1.0, 0.64),
        at(0.55, 0.64),
        at(0.55, 0.8),
        at(0.0, 0.8),
    ]) + "Z";
    html! { path.face.ks0 d=(outline) {} }
}
