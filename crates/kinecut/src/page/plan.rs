//! Drawings to scale as SVG: the path seen along an axis with walls and tools, each stretch linked to its program line.
//!
//! All lines of a role are one `<path>`, so a long program stays light. The attribute `data-blocks` names the
//! program line of each of its subpaths in order; the page's script finds the line under the pointer with it. The plan of
//! the whole path has no such list: there the script uses the path itself, and layers that look alike are drawn once.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::chart::px;
use super::draw::CHARACTER;
use super::ticks::Ticks;
use super::{CircleKind, PathPiece, PathRole, Plan, PlanLine, fixed, simplify, visible};

/// Width of the drawing [px]; the page scales it.
const WIDTH: f64 = 720.0;
/// Greatest and least height of the plot area [px].
const HEIGHT: (f64, f64) = (560.0, 90.0);
/// Room at the right and above [px].
const MARGIN: f64 = 14.0;
/// Room below for ticks and name [px].
const BELOW: f64 = 38.0;
/// Error of a drawn line [px].
const ERROR: f64 = 0.08;

/// An SVG path of straight lines.
#[derive(Default)]
pub(crate) struct LinePath {
    /// The attribute `d`.
    pub(crate) d: String,
}

impl LinePath {
    /// Adds a polyline; a single point becomes a dot.
    pub(crate) fn add(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut count = 0;
        let mut last = String::new();
        for p in points {
            last = format!("{} {}", px(p[0]), px(p[1]));
            self.d.push(if count == 0 { 'M' } else { 'L' });
            self.d.push_str(&last);
            count += 1;
        }
        if count == 1 {
            self.d.push('L');
            self.d.push_str(&last);
        }
    }
}

/// A short line in the look of a class.
pub(crate) fn legend_sample(class: &str) -> Markup {
    html! {
        svg.sample viewBox="0 0 28 10" width="28" height="10" aria-hidden="true" {
            path class=(format!("curve {class}")) d="M1 5L27 5" {}
        }
    }
}

/// The whole path from above; neighbours of one role are one line, without links.
pub(crate) fn of_path(path: &[PathPiece]) -> Plan {
    let mut plan = Plan::new("Path from above");
    for piece in path {
        let points = piece.points.iter().map(|p| [f64::from(p[0]), f64::from(p[1])]);
        match plan.lines.last_mut().filter(|line| line.role == piece.role) {
            Some(line) => line.points.extend(points),
            None => plan.lines.push(PlanLine { role: piece.role, block: None, points: points.collect() }),
        }
    }
    plan
}

struct Frame {
    left: f64,
    height: f64,
    scale: f64,
    x: (f64, f64),
    y: (f64, f64),
}

impl Frame {
    fn px(&self, x: f64) -> f64 {
        self.left + (x - self.x.0) * self.scale
    }
    fn py(&self, y: f64) -> f64 {
        MARGIN + self.height - (y - self.y.0) * self.scale
    }
}

/// The plan as a figure.
pub(crate) fn figure(plan: &Plan) -> Markup {
    let Some(frame) = frame(plan) else {
        return html! {
            figure.plan { figcaption { b { (visible(&plan.title)) } } p.quiet { "There is nothing to draw." } }
        };
    };
    let right = frame.px(frame.x.1);
    let (bottom, height) = (MARGIN + frame.height, MARGIN + frame.height + BELOW);
    let (xt, yt) = ticks(&frame);
    let roles: Vec<PathRole> = PathRole::ALL
        .into_iter()
        .filter(|r| plan.lines.iter().any(|l| l.role == *r && l.points.len() > 1))
        .collect();
    html! {
        figure.plan {
            figcaption { b { (visible(&plan.title)) } span.axes { " " (visible(&plan.x)) " to the right, " (visible(&plan.y)) " upwards [mm]" } }
            @if !roles.is_empty() {
                ul.legend { @for r in &roles { li { (legend_sample(r.word())) (r.word()) } } }
            }
            svg viewBox=(format!("0 0 {WIDTH} {}", px(height))) role="img" aria-label=(summary(plan, &roles))
                data-scale=(frame.scale) data-x0=(frame.px(0.0)) data-y0=(frame.py(0.0)) {
                @for &v in &xt.values {
                    @let at = px(frame.px(v));
                    line class={ "grid" @if v == 0.0 { " zero" } } x1=(at) x2=(at) y1=(px(MARGIN)) y2=(px(bottom)) {}
                    text.tick x=(at) y=(px(bottom + 15.0)) text-anchor="middle" { (xt.label(v)) }
                }
                @for &v in &yt.values {
                    @let at = px(frame.py(v));
                    line class={ "grid" @if v == 0.0 { " zero" } } x1=(px(frame.left)) x2=(px(right)) y1=(at) y2=(at) {}
                    text.tick x=(px(frame.left - 6.0)) y=(px(frame.py(v) + 4.0)) text-anchor="end" { (yt.label(v)) }
                }
                rect.frame x=(px(frame.left)) y=(px(MARGIN)) width=(px(right - frame.left)) height=(px(frame.height)) {}
                text.axis x=(px(right)) y=(px(bottom + 32.0)) text-anchor="end" { (visible(&plan.x)) " [mm]" }
                @for c in plan.circles.iter().filter(|c| usable(c.centre, c.radius)) {
                    circle class=(circle_class(c.kind)) cx=(px(frame.px(c.centre[0]))) cy=(px(frame.py(c.centre[1])))
                        r=(px(c.radius * frame.scale)) {}
                    @if !c.text.is_empty() {
                        text.word x=(px(frame.px(c.centre[0]))) y=(px(frame.py(c.centre[1] + c.radius) - 4.0))
                            text-anchor="middle" { (visible(&c.text)) }
                    }
                }
                @for role in roles {
                    @let (d, blocks) = lines(plan, role, &frame);
                    @let blocks = blocks.contains(|c: char| c.is_ascii_digit()).then_some(blocks);
                    path class=(format!("curve {}", role.word())) d=(d) data-blocks=[blocks] {}
                }
                @for (p, word) in plan.points.iter().filter(|(p, _)| usable(*p, 0.0)) {
                    circle.point cx=(px(frame.px(p[0]))) cy=(px(frame.py(p[1]))) r="2.5" {}
                    text.word x=(px(frame.px(p[0]) + 6.0)) y=(px(frame.py(p[1]) - 5.0)) { (visible(word)) }
                }
            }
        }
    }
}

fn circle_class(kind: CircleKind) -> &'static str {
    match kind {
        CircleKind::Wall => "wall",
        CircleKind::Tool => "cutter",
        CircleKind::Help => "help",
    }
}

fn usable(p: [f64; 2], radius: f64) -> bool {
    p[0].is_finite() && p[1].is_finite() && radius.is_finite() && radius >= 0.0
}

fn frame(plan: &Plan) -> Option<Frame> {
    let (mut x, mut y) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
    let mut grow = |p: [f64; 2], r: f64| {
        if usable(p, r) {
            x = (x.0.min(p[0] - r), x.1.max(p[0] + r));
            y = (y.0.min(p[1] - r), y.1.max(p[1] + r));
        }
    };
    plan.lines.iter().flat_map(|l| &l.points).for_each(|p| grow(*p, 0.0));
    plan.circles.iter().for_each(|c| grow(c.centre, c.radius));
    plan.points.iter().for_each(|p| grow(p.0, 0.0));
    if x.0 > x.1 {
        return None;
    }
    let span = (x.1 - x.0).max(y.1 - y.0);
    // A drawing of one point shows a millimetre around it.
    let room = if span > 0.0 { span * 0.04 } else { 1.0 };
    let (mut x, mut y) = ((x.0 - room, x.1 + room), (y.0 - room, y.1 + room));
    // Labels of y are "-123.4" at most for what fits here; the exact width hardly moves the picture.
    let left = 14.0 + CHARACTER * 6.0;
    let scale = ((WIDTH - MARGIN - left) / (x.1 - x.0)).min(HEIGHT.0 / (y.1 - y.0));
    let widen = |r: &mut (f64, f64), to: f64| {
        let more = (to - (r.1 - r.0)).max(0.0) / 2.0;
        *r = (r.0 - more, r.1 + more);
    };
    widen(&mut x, (WIDTH - MARGIN - left) / scale);
    widen(&mut y, HEIGHT.1 / scale);
    let height = (y.1 - y.0) * scale;
    scale.is_finite().then_some(Frame { left, height, scale, x, y })
}

/// Ticks of both axes with one distance, so that the grid shows squares.
fn ticks(frame: &Frame) -> (Ticks, Ticks) {
    let (spans, wanted) = ([frame.x.1 - frame.x.0, frame.y.1 - frame.y.0], 8.0);
    let of = |r: (f64, f64), span: f64| {
        Ticks::new(r.0, r.1, (wanted * span / spans[0].max(spans[1])).round().max(2.0) as usize)
    };
    let (x, y) = (of(frame.x, spans[0]), of(frame.y, spans[1]));
    if x.step == y.step {
        return (x, y);
    }
    let step = x.step.max(y.step);
    let count = |span: f64| ((span / step).ceil() as usize).max(1);
    let (x2, y2) = (
        Ticks::new(frame.x.0, frame.x.1, count(spans[0])),
        Ticks::new(frame.y.0, frame.y.1, count(spans[1])),
    );
    if x2.step == y2.step { (x2, y2) } else { (x, y) }
}

/// The lines of one role: `d` and the program line of each subpath, `-` for none.
fn lines(plan: &Plan, role: PathRole, frame: &Frame) -> (String, String) {
    let (mut all, mut drawn) = (String::new(), BTreeSet::new());
    let mut blocks: Vec<String> = Vec::new();
    for line in plan.lines.iter().filter(|l| l.role == role) {
        for run in line.points.split(|p| !usable(*p, 0.0)).filter(|r| !r.is_empty()) {
            let points: Vec<[f64; 2]> = run.iter().map(|p| [frame.px(p[0]), frame.py(p[1])]).collect();
            let kept = simplify::kept(&points, ERROR);
            let mut path = LinePath::default();
            path.add(kept.into_iter().map(|i| points[i]));
            if line.block.is_some() || !drawn.contains(&path.d) {
                all.push_str(&path.d);
                blocks.push(line.block.map_or_else(|| "-".to_owned(), |b| b.to_string()));
            }
            if line.block.is_none() {
                drawn.insert(path.d);
            }
        }
    }
    (all, blocks.join(" "))
}

fn summary(plan: &Plan, roles: &[PathRole]) -> String {
    let mut text = format!("{}:", visible(&plan.title));
    for role in roles {
        text += &format!(" {} path,", role.word());
    }
    for c in &plan.circles {
        let name = if c.text.is_empty() { "circle".into() } else { visible(&c.text) };
        text += &format!(
            " {} of radius {} mm about {}, {};",
            name,
            fixed(c.radius, 3),
            fixed(c.centre[0], 3),
            fixed(c.centre[1], 3)
        );
    }
    text.trim_end_matches([',', ';', ':']).to_owned() + "."
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Circle;

    fn attribute<'a>(svg: &'a str, after: &str, name: &str) -> &'a str {
        let rest = svg.split(after).nth(1).unwrap();
        rest.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap()
    }

    #[test]
    fn the_drawing_is_to_scale_and_up_is_up() {
        let mut plan = Plan::new("p");
        plan.circles.push(Circle { centre: [10.0, 20.0], radius: 100.0, ..Circle::default() });
        plan.lines.push(PlanLine {
            role: PathRole::Finish,
            block: Some(7),
            points: vec![[10.0, 20.0], [110.0, 20.0], [110.0, 120.0]],
        });
        let svg = figure(&plan).into_string();
        let r: f64 = attribute(&svg, "class=\"wall\"", "r").parse().unwrap();
        let cx: f64 = attribute(&svg, "class=\"wall\"", "cx").parse().unwrap();
        let cy: f64 = attribute(&svg, "class=\"wall\"", "cy").parse().unwrap();
        let d = attribute(&svg, "role=\"img\"", "d");
        let p: Vec<f64> =
            d.split(['M', 'L', ' ']).filter(|s| !s.is_empty()).map(|s| s.parse().unwrap()).collect();
        let expected = [cx, cy, cx + r, cy, cx + r, cy - r];
        assert!(p.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.02), "{p:?} {expected:?}");
        let scale: f64 = attribute(&svg, "role=\"img\"", "data-scale").parse().unwrap();
        assert!((scale * 100.0 - r).abs() < 0.01);
        assert_eq!(attribute(&svg, "role=\"img\"", "data-blocks"), "7");
    }

    #[test]
    fn each_subpath_has_its_line_and_gaps_count_twice() {
        let mut plan = Plan::new("p");
        let nan = [f64::NAN; 2];
        let mut line = |block, points| plan.lines.push(PlanLine { role: PathRole::Rough, block, points });
        line(Some(3), vec![[0.0, 0.0], [1.0, 0.0], nan, [2.0, 0.0], [3.0, 1.0]]);
        line(None, vec![[3.0, 1.0], [5.0, 5.0]]);
        let frame = frame(&plan).unwrap();
        let (d, blocks) = lines(&plan, PathRole::Rough, &frame);
        assert_eq!((d.matches('M').count(), blocks.as_str()), (3, "3 3 -"));
    }

    #[test]
    fn layers_that_look_alike_are_drawn_once() {
        let mut path = Vec::new();
        for layer in 0..500u32 {
            let z = -(layer as f32);
            path.push(PathPiece::new(3 * layer, PathRole::Link, vec![[0.0, 0.0, z + 1.0], [0.0, 0.0, z]]));
            path.push(PathPiece::new(3 * layer + 1, PathRole::Rough, vec![[0.0, 0.0, z], [50.0, 0.0, z]]));
            path.push(PathPiece::new(3 * layer + 2, PathRole::Rough, vec![[50.0, 0.0, z], [50.0, 30.0, z]]));
        }
        let plan = of_path(&path);
        assert_eq!(plan.lines.len(), 1000);
        let (d, _) = lines(&plan, PathRole::Rough, &frame(&plan).unwrap());
        assert_eq!((d.matches('M').count(), d.matches('L').count()), (1, 2));
    }

    #[test]
    fn a_strange_path_is_drawn_as_nothing() {
        let strange =
            PathPiece::new(0, PathRole::Rapid, vec![[f32::NAN, 0.0, 0.0], [f32::INFINITY, 1.0, 0.0]]);
        assert!(figure(&of_path(&[strange])).into_string().contains("nothing to draw"));
        let point = PathPiece::new(0, PathRole::Rapid, vec![[5.0, 5.0, 0.0]]);
        assert!(!figure(&of_path(&[point])).into_string().contains("NaN"));
    }
}
