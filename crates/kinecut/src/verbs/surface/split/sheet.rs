//! Sketches as pictures and files.

use glam::{DVec2, DVec3};

use super::motion::{Arrow, arrows};
use super::view::Placed;
use super::{MotionRole, SketchTool, SplitSketch};
use crate::page::draw::{self, Labels, arrow, line, put_faces};
use crate::page::{Anchor, Colour, Dash, Ink, Lettering, Picture, Shape, Tint, Width};

/// Size of a sketch [px].
const SIZE: [f64; 2] = [340.0, 310.0];
/// Room at the edges [px].
const MARGIN: f64 = 10.0;
/// Mean width of a letter of a name [px].
const LETTER: f64 = 7.4;
/// Colour of what the tool has.
const TOOL: Colour = Colour::Series(1);

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
    draw::sheet(&sketch.title, &[split_figure(sketch)], 1)
}

/// Many splits on a sheet as an SVG file, `columns` beside each other.
pub fn split_sheet(title: &str, sketches: &[SplitSketch], columns: usize) -> String {
    draw::sheet(title, &sketches.iter().map(split_figure).collect::<Vec<_>>(), columns)
}

/// A split as a picture of a page.
pub fn split_figure(sketch: &SplitSketch) -> Picture {
    let mut picture = Picture {
        title: sketch.title.clone(),
        about: sketch.about.clone(),
        summary: sketch.title.clone(),
        size: SIZE,
        legend: legend(sketch),
        ..Picture::default()
    };
    let at = [MARGIN, MARGIN, SIZE[0] - 2.0 * MARGIN, SIZE[1] - 2.0 * MARGIN];
    match Placed::new(sketch, at) {
        Some(placed) => {
            let drawn = motions_of(sketch, &placed).into_iter();
            let points = drawn.flat_map(|a| a.line.into_iter().chain(a.axis.into_iter().flatten()));
            let placed = placed.with_room_for(points.collect::<Vec<_>>().into_iter(), at);
            put(&mut picture, sketch, &placed);
        }
        None => picture.tick([MARGIN, MARGIN + 14.0], Anchor::Start, "There is nothing to draw."),
    }
    picture
}

impl MotionRole {
    /// Line and colour of its arrow, and its word.
    fn look(self) -> (Ink, Colour, &'static str) {
        let (colour, dash, word) = match self {
            MotionRole::Forming => (Colour::Series(0), Dash::Full, "forming"),
            MotionRole::Linked => (Colour::Series(3), Dash::Full, "linked by a law"),
            MotionRole::Setting => (Colour::Series(5), Dash::Dashes, "set"),
            MotionRole::SetUp => (Colour::Series(1), Dash::Dots, "set-up"),
        };
        (Ink::Line(colour, Width::Middle, dash), colour, word)
    }
}

fn put(picture: &mut Picture, sketch: &SplitSketch, on: &Placed) {
    let arrows = motions_of(sketch, on);
    let mut labels = Labels::new([MARGIN, MARGIN, SIZE[0] - MARGIN, SIZE[1] - MARGIN]);
    for a in &arrows {
        labels.keep_off_line(&a.line, 1);
        if let Some(axis) = &a.axis {
            // A thin line may be written on rather than an arrow.
            labels.keep_off_line(axis, 3);
            picture.path(Ink::Line(Colour::Quiet, Width::Fine, Dash::Chain), line(*axis));
        }
    }
    if let SketchTool::Edge(points) = &sketch.tool {
        labels.keep_off_line(&on.line(points), 2);
    }
    let mut faces = on.faces(&sketch.surface, 0);
    if let SketchTool::Patch(rows) = &sketch.tool {
        faces.extend(on.faces(rows, 1));
    }
    put_faces(picture, &on.view, faces, |body| if body == 0 { Tint::Sand } else { Tint::Orange });
    put_tool(picture, &sketch.tool, on);
    for a in &arrows {
        let (shaft, colour, _) = a.role.look();
        arrow(picture, &a.line, shaft, colour);
    }
    for a in arrows.iter().filter(|a| !a.name.is_empty()) {
        let Some(&tip) = a.line.last() else { continue };
        let [x, y] = labels.beside(LETTER * a.name.chars().count() as f64, tip);
        let lettering = Lettering::Name(a.role.look().1);
        picture.shapes.push(Shape::Word {
            at: [x, y + 4.0],
            anchor: Anchor::Middle,
            text: a.name.clone(),
            lettering,
        });
    }
}

fn motions_of(sketch: &SplitSketch, on: &Placed) -> Vec<Arrow> {
    arrows(&sketch.motions, middle_of(&sketch.tool).unwrap_or(on.middle), on)
}

/// Draws the tool's part of the surface, with a body behind point and edge that is clear of the surface.
fn put_tool(picture: &mut Picture, tool: &SketchTool, on: &Placed) {
    let area = |points: &[[f64; 2]]| line(points.iter().copied()) + "Z";
    match tool {
        SketchTool::None | SketchTool::Patch(_) => {}
        SketchTool::Point(p) => {
            let at = on.px(DVec3::from(*p));
            let away = away(at, on);
            let corner =
                |along: f64, side: f64| (DVec2::from(at) + along * away + side * away.perp()).to_array();
            let insert =
                [at, corner(20.0, -11.0), corner(36.0, -11.0), corner(36.0, 11.0), corner(20.0, 11.0)];
            picture.path(Ink::Glass(Colour::Steel), area(&insert));
            picture.circle(Ink::Dot(TOOL), at, 4.0);
        }
        SketchTool::Edge(points) => {
            let edge = on.line(points);
            let Some(&middle) = edge.get(edge.len() / 2) else { return };
            let away = 24.0 * beside(&edge, away(middle, on));
            let mut body = edge.clone();
            body.extend(edge.iter().rev().map(|p| (DVec2::from(*p) + away).to_array()));
            picture.path(Ink::Glass(Colour::Steel), area(&body));
            picture.path(Ink::line(TOOL, Width::Bold), line(edge));
        }
    }
}

/// The direction across an edge on the side that is wanted; the wanted one where the ends of the edge are one place.
fn beside(edge: &[[f64; 2]], wanted: DVec2) -> DVec2 {
    let (Some(a), Some(b)) = (edge.first(), edge.last()) else { return wanted };
    let along = DVec2::from(*b) - DVec2::from(*a);
    if along.length() < 1.0 {
        return wanted;
    }
    let across = along.normalize_or_zero().perp();
    let side = across.dot(wanted);
    // The right side if neither is the wanted one: there the drawing has room.
    across * if side.abs() > 0.1 { side.signum() } else { across.x.signum() }
}

/// The direction on paper away from the middle of the surface.
fn away(from: [f64; 2], on: &Placed) -> DVec2 {
    let out = DVec2::from(from) - DVec2::from(on.px(on.middle));
    if out.length() > 1.0 { out.normalize_or_zero() } else { DVec2::NEG_Y }
}

/// The place of the tool from which its translations start.
fn middle_of(tool: &SketchTool) -> Option<DVec3> {
    match tool {
        SketchTool::None => None,
        SketchTool::Point(p) => Some(DVec3::from(*p)),
        SketchTool::Edge(points) => points.get(points.len() / 2).map(|p| DVec3::from(*p)),
        SketchTool::Patch(rows) => {
            let count = rows.iter().map(Vec::len).sum::<usize>();
            Some(rows.iter().flatten().map(|p| DVec3::from(*p)).sum::<DVec3>() / count as f64)
        }
    }
    .filter(|p| p.is_finite())
}

/// Meanings of the colours that occur.
fn legend(sketch: &SplitSketch) -> Vec<(Ink, String)> {
    let occurs = |role: &MotionRole| sketch.motions.iter().any(|m| m.role == *role);
    let looks = MotionRole::ALL.into_iter().filter(occurs).map(MotionRole::look);
    looks.map(|(ink, _, word)| (ink, word.to_owned())).collect()
}
