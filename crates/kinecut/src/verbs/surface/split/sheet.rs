//! Sketches as files and figures.

use maud::{Markup, html};

use super::labels::place;
use super::motion::{Arrow, arrows};
use super::view::View;
use super::{MotionRole, SketchTool, SplitSketch};
use crate::page::chart::px;
use crate::page::visible;
use crate::verbs::layouts::show::{arrow, file, polyline};

/// Size of a sketch [px].
const SKETCH: [f64; 2] = [460.0, 400.0];
/// Size of a cell of a sheet [px].
const CELL: [f64; 2] = [330.0, 330.0];
/// Height of the words above a sketch [px].
const WORDS: f64 = 44.0;
/// Room at the edges [px].
const MARGIN: f64 = 12.0;
/// Height of the legend [px].
const LEGEND: f64 = 28.0;
/// Distance of points along a line that names keep off [px].
const APART: f64 = 5.0;
/// Most points of a stretch of a line.
const MOST: f64 = 400.0;
/// Mean width of a letter of a name [px].
const LETTER: f64 = 7.4;

/// A split as an SVG file.
///
/// ```
/// use kinecut::verbs::surface::{MotionRole, SketchMotion, SketchTool, SplitSketch, split_drawing};
/// let ring = |z: f64| (0..13).map(|i| f64::from(i) * 0.5236).map(|f| [30.0 * f.cos(), 30.0 * f.sin(), z]).collect();
/// let svg = split_drawing(&SplitSketch {
///     title: "machine 613".into(),
///     surface: vec![ring(0.0), ring(40.0)],
///     tool: SketchTool::Point([30.0, 0.0, 40.0]),
///     motions: vec![SketchMotion {
///         name: "C \u{3c6}".into(), direction: [0.0, 0.0, 1.0], axis_point: Some([0.0; 3]), role: MotionRole::Forming,
///     }],
///     ..SplitSketch::default()
/// });
/// assert!(svg.starts_with("<svg") && svg.contains("C \u{3c6}"));
/// ```
pub fn split_drawing(sketch: &SplitSketch) -> String {
    let size = [SKETCH[0], SKETCH[1] + LEGEND];
    file(size, &sketch.title, &whole(sketch))
}

/// The same for a page that has the rules of [`crate::verbs::layouts::layout_style`].
pub fn split_figure(sketch: &SplitSketch) -> Markup {
    let view = format!("0 0 {} {}", px(SKETCH[0]), px(SKETCH[1] + LEGEND));
    html! { svg viewBox=(view) role="img" aria-label=(visible(&sketch.title)) { g.kc { (whole(sketch)) } } }
}

/// Many splits on a sheet as an SVG file, `columns` beside each other.
pub fn split_sheet(title: &str, sketches: &[SplitSketch], columns: usize) -> String {
    let columns = columns.clamp(1, sketches.len().max(1));
    let rows = sketches.len().div_ceil(columns);
    let top = MARGIN + 26.0;
    let bottom = top + rows as f64 * CELL[1];
    let size = [2.0 * MARGIN + columns as f64 * CELL[0], bottom + LEGEND + 4.0];
    let all = || sketches.iter();
    let body = html! {
        text.title x=(px(MARGIN + 4.0)) y=(px(MARGIN + 12.0)) { (visible(title)) }
        @for (i, sketch) in sketches.iter().enumerate() {
            @let at = [MARGIN + (i % columns) as f64 * CELL[0], top + (i / columns) as f64 * CELL[1]];
            rect.cell x=(px(at[0] + 2.0)) y=(px(at[1] + 2.0)) width=(px(CELL[0] - 4.0)) height=(px(CELL[1] - 4.0)) rx="4" {}
            (one(sketch, at, CELL))
        }
        (legend([MARGIN + 4.0, bottom + 16.0], all()))
    };
    file(size, title, &body)
}

fn whole(sketch: &SplitSketch) -> Markup {
    html! {
        (one(sketch, [0.0; 2], SKETCH))
        (legend([MARGIN, SKETCH[1] + 12.0], [sketch].into_iter()))
    }
}

fn one(sketch: &SplitSketch, at: [f64; 2], size: [f64; 2]) -> Markup {
    let area = [at[0] + MARGIN, at[1] + WORDS, at[0] + size[0] - MARGIN, at[1] + size[1] - MARGIN];
    let (corner, room) = ([area[0], area[1]], [area[2] - area[0], area[3] - area[1]]);
    let view = View::new(sketch, corner, room).map(|view| {
        let drawn = motions_of(sketch, &view);
        let points = drawn.into_iter().flat_map(|a| a.line.into_iter().chain(a.axis.into_iter().flatten()));
        let points: Vec<[f64; 2]> = points.collect();
        view.with_room_for(points.into_iter(), corner, room)
    });
    html! {
        text.title x=(px(at[0] + MARGIN)) y=(px(at[1] + 21.0)) { (visible(&sketch.title)) }
        text.quiet x=(px(at[0] + MARGIN)) y=(px(at[1] + 37.0)) { (visible(&sketch.about)) }
        @match view {
            Some(view) => (picture(sketch, &view, area)),
            None => text.quiet x=(px(at[0] + MARGIN)) y=(px(at[1] + WORDS + 14.0)) { "There is nothing to draw." },
        }
    }
}

fn picture(sketch: &SplitSketch, view: &View, area: [f64; 4]) -> Markup {
    let arrows = motions_of(sketch, view);
    let named: Vec<&Arrow> = arrows.iter().filter(|a| !a.name.is_empty()).collect();
    let wanted: Vec<(f64, [f64; 2])> = named
        .iter()
        .filter_map(|a| Some((LETTER * a.name.chars().count() as f64, *a.line.last()?)))
        .collect();
    let mut free: Vec<[f64; 2]> = Vec::new();
    for a in &arrows {
        free.extend(dense(&a.line));
        // A thin line may be written on rather than an arrow.
        free.extend(a.axis.iter().flat_map(|axis| dense(axis).into_iter().step_by(3)));
    }
    if let SketchTool::Edge(points) = &sketch.tool {
        free.extend(dense(&view.line(points)).into_iter().step_by(2));
    }
    let labels = place(&wanted, &free, area);
    html! {
        @for arrow in &arrows {
            @if let Some(axis) = &arrow.axis { path.axis d=(polyline(axis)) {} }
        }
        @for (shade, corners) in view.quads(&sketch.surface) {
            path class=(format!("patch kp{shade}")) d=(polyline(&corners) + "Z") {}
        }
        (tool(&sketch.tool, view))
        @for a in &arrows { (arrow(&a.line, a.role.class())) }
        @for (a, label) in named.iter().zip(&labels) {
            text class=(format!("letter on {}", a.role.class())) x=(px(label.at[0])) y=(px(label.at[1])) { (visible(&a.name)) }
        }
    }
}

fn motions_of(sketch: &SplitSketch, view: &View) -> Vec<Arrow> {
    arrows(&sketch.motions, middle_of(&sketch.tool).unwrap_or(view.middle), view)
}

/// Points along a line, a few pixels apart.
fn dense(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for pair in line.windows(2) {
        let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        let steps = (length / APART).ceil().clamp(1.0, MOST) as usize;
        points.extend((0..steps).map(|i| {
            let t = i as f64 / steps as f64;
            [0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]))
        }));
    }
    points.extend(line.last());
    points
}

/// What the tool has, with a body behind point and edge that stands off the surface.
fn tool(tool: &SketchTool, view: &View) -> Markup {
    match tool {
        SketchTool::None => Markup::default(),
        SketchTool::Point(p) => {
            let at = view.px(*p);
            let away = away(at, view);
            let corner = |along: f64, side: f64| {
                [at[0] + along * away[0] - side * away[1], at[1] + along * away[1] + side * away[0]]
            };
            let insert =
                [at, corner(20.0, -11.0), corner(36.0, -11.0), corner(36.0, 11.0), corner(20.0, 11.0)];
            html! {
                path.body d=(polyline(&insert) + "Z") {}
                circle.point cx=(px(at[0])) cy=(px(at[1])) r="4" {}
            }
        }
        SketchTool::Edge(points) => {
            let line = view.line(points);
            let Some(middle) = line.get(line.len() / 2) else { return Markup::default() };
            let away = beside(&line, away(*middle, view));
            let mut body = line.clone();
            body.extend(line.iter().rev().map(|p| [p[0] + 24.0 * away[0], p[1] + 24.0 * away[1]]));
            html! {
                path.body d=(polyline(&body) + "Z") {}
                path.generated d=(polyline(&line)) {}
            }
        }
        SketchTool::Patch(rows) => html! {
            @for (_, corners) in view.quads(rows) { path.tool-patch d=(polyline(&corners) + "Z") {} }
        },
    }
}

/// The direction across an edge on the side that is wanted; the wanted one where the ends of the edge are one place.
fn beside(line: &[[f64; 2]], wanted: [f64; 2]) -> [f64; 2] {
    let (Some(a), Some(b)) = (line.first(), line.last()) else { return wanted };
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length = dx.hypot(dy);
    if length < 1.0 {
        return wanted;
    }
    let across = [-dy / length, dx / length];
    let side = across[0] * wanted[0] + across[1] * wanted[1];
    // Where neither side is the one, the right one: there the drawing has room.
    let sign = if side.abs() > 0.1 { side.signum() } else { across[0].signum() };
    across.map(|c| sign * c)
}

/// The direction on paper away from the middle of the surface.
fn away(from: [f64; 2], view: &View) -> [f64; 2] {
    let middle = view.px(view.middle);
    let [dx, dy] = [from[0] - middle[0], from[1] - middle[1]];
    let length = dx.hypot(dy);
    if length > 1.0 { [dx / length, dy / length] } else { [0.0, -1.0] }
}

/// The place of the tool from which its translations start.
fn middle_of(tool: &SketchTool) -> Option<[f64; 3]> {
    let mean = |points: &[[f64; 3]]| {
        let count = points.len() as f64;
        (!points.is_empty()).then(|| [0, 1, 2].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / count))
    };
    match tool {
        SketchTool::None => None,
        SketchTool::Point(p) => Some(*p),
        SketchTool::Edge(points) => points.get(points.len() / 2).copied(),
        SketchTool::Patch(rows) => mean(&rows.concat()),
    }
    .filter(|p| p.iter().all(|v| v.is_finite()))
}

/// What colours mean, of what occurs.
fn legend<'a>(at: [f64; 2], sketches: impl Iterator<Item = &'a SplitSketch>) -> Markup {
    let sketches: Vec<&SplitSketch> = sketches.collect();
    let occurs = |role: MotionRole| sketches.iter().any(|s| s.motions.iter().any(|m| m.role == role));
    let roles: Vec<MotionRole> = MotionRole::ALL.into_iter().filter(|r| occurs(*r)).collect();
    let words = |role: MotionRole| match role {
        MotionRole::Forming => "forming",
        MotionRole::Linked => "linked by a law",
        MotionRole::Setting => "set",
        MotionRole::SetUp => "set-up",
    };
    html! {
        @for (i, role) in roles.iter().copied().enumerate() {
            @let x = at[0] + roles[..i].iter().map(|r| 56.0 + 6.4 * words(*r).len() as f64).sum::<f64>();
            (arrow(&[[x, at[1]], [x + 26.0, at[1]]], role.class()))
            text.quiet x=(px(x + 33.0)) y=(px(at[1] + 4.0)) { (words(role)) }
        }
    }
}
