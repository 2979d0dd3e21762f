//! A drawing as SVG.

use std::f64::consts::PI;

use glam::DVec2;
use maud::{Markup, html};

use super::lanes::{ARROW, Placed};
use super::layout::{Band, LINE, Layout, MARGIN, WIDTHS, Words};
use super::{Along, Angle, Dimension, Drawing, hatch, words};
use crate::page::draw::{LinePath, head};
use crate::page::picture::sample;
use crate::page::px;
use crate::page::{Ink, simplify, visible};

/// Distance of hatching lines [px].
const HATCH: f64 = 7.0;
/// Half the width of an arrow [px].
const ARROW_HALF: f64 = 2.2;
/// Error of a drawn line [px].
const ERROR: f64 = 0.05;
/// A drawing taller than this many widths shares its row with two others.
const TALL: f64 = 1.05;
/// Radius of a point [px].
const POINT: f64 = 3.2;
/// Room between a dimension line and its words, lowered letters included [px].
const BESIDE: f64 = 5.0;
/// Teeth of a break [px].
const TOOTH: f64 = 5.0;

/// The drawing as a figure.
pub(crate) fn figure(drawing: &Drawing) -> Markup {
    let mut legend: Vec<(Ink, &str)> = Vec::new();
    for s in drawing.strokes.iter().filter(|s| !s.name.is_empty()) {
        if !legend.contains(&(s.look.ink(), s.name.as_str())) {
            legend.push((s.look.ink(), &s.name));
        }
    }
    let [wide, narrow] = WIDTHS.map(|width| Layout::new(drawing, width));
    let Some((wide, narrow)) = wide.zip(narrow) else {
        return html! {
            figure.drawing { figcaption { b { (visible(&drawing.title)) } } p.quiet { "There is nothing to draw." } }
        };
    };
    html! {
        figure.drawing.tall[wide.height() > TALL * wide.width] {
            figcaption { b { (visible(&drawing.title)) } }
            @if !legend.is_empty() {
                ul.legend { @for (ink, name) in legend { li { (sample(ink)) (visible(name)) } } }
            }
            (svg(drawing, &wide, "wide"))
            (svg(drawing, &narrow, "narrow"))
            @for note in &drawing.notes { p.remark { (visible(note)) } }
        }
    }
}

/// The drawing as it is laid out.
fn svg(drawing: &Drawing, layout: &Layout, class: &str) -> Markup {
    let [width, height] = [layout.width, layout.height()].map(px);
    html! {
            svg class=(class) viewBox=(format!("0 {} {width} {height}", px(layout.extent[0] - MARGIN))) width=(width) height=(height) role="img" aria-label=(summary(drawing))
                data-mm=(layout.scale) {
                @for band in &layout.bands { (inside(drawing, layout, band)) }
                (breaks(layout))
                @for (span, placed) in &layout.left { (upright(layout, span, placed)) }
                @for (span, placed) in layout.above.iter().chain(&layout.below) { (level(layout, span, placed)) }
                @for (span, ends) in &layout.along { (along(layout, span, *ends)) }
                @for angle in &drawing.angles { (arc(layout, angle)) }
                @for w in &layout.column { (leader(layout, w)) }
                // Words last: nothing is drawn over them.
                @for (span, placed) in &layout.left {
                    @let x = layout.lane_x(placed.lane) - BESIDE;
                    text transform=(format!("translate({} {}) rotate(-90)", px(x), px(placed.middle))) text-anchor="middle" {
                        (words::markup(&span.text))
                    }
                }
                @for (span, placed) in layout.above.iter().chain(&layout.below) {
                    @let y = layout.lane_y(span.along, placed.lane) - BESIDE;
                    text x=(px(placed.middle)) y=(px(y)) text-anchor="middle" { (words::markup(&span.text)) }
                }
                @for w in &layout.column { (beside(layout, w)) }
            }
    }
}

/// Markup of one band, cut at its edges.
fn inside(drawing: &Drawing, layout: &Layout, band: &Band) -> Markup {
    let [left, right] = layout.x;
    let (x, y, w, h) = (px(left), px(band.top), px(right - left), px(band.height));
    let at = |p: &[f64; 2]| [layout.px(p[0]), band.py(p[1], layout.scale)];
    let mut hatching = LinePath::default();
    let outlines: Vec<Vec<[f64; 2]>> = drawing.hatched.iter().map(|o| o.iter().map(at).collect()).collect();
    for [a, b] in hatch::lines(&outlines, HATCH) {
        let seen = a[1].min(b[1]) < band.top + band.height && a[1].max(b[1]) > band.top;
        if seen && a[0].min(b[0]) < right && a[0].max(b[0]) > left {
            hatching.add([a, b]);
        }
    }
    html! {
        svg x=(x) y=(y) width=(w) height=(h) viewBox=(format!("{x} {y} {w} {h}")) {
            @if !hatching.d.is_empty() { path.hatch d=(hatching.d) {} }
            @for s in &drawing.strokes {
                @let d = line(s.points.iter().map(at));
                @if !d.is_empty() { path class=(s.look.ink().class()) d=(d) {} }
            }
        }
    }
}

fn line(points: impl Iterator<Item = [f64; 2]>) -> String {
    let points: Vec<[f64; 2]> = points.collect();
    let mut path = LinePath::default();
    for run in points.split(|p| !(p[0].is_finite() && p[1].is_finite())).filter(|r| !r.is_empty()) {
        let kept = simplify::kept(run, ERROR);
        path.add(kept.into_iter().map(|i| run[i]));
    }
    path.d
}

/// The torn edges of the breaks.
fn breaks(layout: &Layout) -> Markup {
    let [left, right] = layout.x;
    let mut d = String::new();
    for pair in layout.bands.windows(2) {
        for y in [pair[0].top + pair[0].height, pair[1].top] {
            let steps = ((right - left) / (2.0 * TOOTH)).ceil() as usize;
            let mut path = LinePath::default();
            path.add((0..=2 * steps).map(|i| {
                let x = left + (right - left) * i as f64 / (2 * steps) as f64;
                [x, y + if i % 2 == 0 { 0.0 } else { 2.5 }]
            }));
            d.push_str(&path.d);
        }
    }
    html! { @if !d.is_empty() { path.torn d=(d) {} } }
}

/// An arrow with its point at a place, in a direction.
fn arrow(d: &mut String, at: [f64; 2], direction: [f64; 2]) {
    *d += &head(DVec2::from(at), DVec2::from(direction).normalize_or_zero(), [ARROW, ARROW_HALF]);
}

/// The arrows of a dimension line from one end to the other, and the line's own ends.
fn arrows(from: [f64; 2], to: [f64; 2], outside: bool, tail: f64) -> (String, [[f64; 2]; 2]) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let mut d = String::new();
    let direction = if dx == 0.0 && dy == 0.0 { [0.0, 1.0] } else { [dx, dy] };
    let length = direction[0].hypot(direction[1]);
    let [u, v] = direction.map(|c| c / length);
    let sign = if outside { 1.0 } else { -1.0 };
    arrow(&mut d, from, [sign * u, sign * v]);
    arrow(&mut d, to, [-sign * u, -sign * v]);
    let out = if outside { tail } else { 0.0 };
    (d, [[from[0] - out * u, from[1] - out * v], [to[0] + out * u, to[1] + out * v]])
}

fn segment(a: [f64; 2], b: [f64; 2]) -> String {
    format!("M{} {}L{} {}", px(a[0]), px(a[1]), px(b[0]), px(b[1]))
}

/// An upright dimension line with its extension lines.
fn upright(layout: &Layout, span: &Dimension, placed: &Placed) -> Markup {
    let x = layout.lane_x(placed.lane);
    let (from, to) = ([x, placed.from], [x, placed.to]);
    let (d, ends) = if placed.to > placed.from {
        arrows(from, to, placed.outside, 1.7 * ARROW)
    } else {
        let (mut d, tail) = (String::new(), 1.7 * ARROW);
        arrow(&mut d, from, [0.0, 1.0]);
        arrow(&mut d, to, [0.0, -1.0]);
        (d, [[x, placed.from - tail], [x, placed.to + tail]])
    };
    let extension = |p: [f64; 2]| segment([x - 3.0, layout.py(p[1])], [layout.px(p[0]), layout.py(p[1])]);
    html! {
        path.extension d=(extension(span.from) + &extension(span.to)) {}
        path.dimension d=(segment(ends[0], ends[1])) {}
        path.arrow d=(d) {}
    }
}

/// A level dimension line above or below.
fn level(layout: &Layout, span: &Dimension, placed: &Placed) -> Markup {
    let y = layout.lane_y(span.along, placed.lane);
    let (d, ends) = arrows([placed.from, y], [placed.to, y], placed.outside, 1.7 * ARROW);
    let beyond = if span.along == Along::Above { -3.0 } else { 3.0 };
    let extension = |p: [f64; 2]| segment([layout.px(p[0]), layout.py(p[1])], [layout.px(p[0]), y + beyond]);
    html! {
        path.extension d=(extension(span.from) + &extension(span.to)) {}
        path.dimension d=(segment(ends[0], ends[1])) {}
        path.arrow d=(d) {}
    }
}

/// A dimension line beside a line.
fn along(layout: &Layout, span: &Dimension, ends: [[f64; 2]; 2]) -> Markup {
    let [a, b] = ends;
    let outside = (b[0] - a[0]).hypot(b[1] - a[1]) < 2.5 * ARROW;
    let (d, line) = arrows(a, b, outside, 1.7 * ARROW);
    let on = [span.from, span.to].map(|p| [layout.px(p[0]), layout.py(p[1])]);
    html! {
        path.extension d=(segment(on[0], a) + &segment(on[1], b)) {}
        path.dimension d=(segment(line[0], line[1])) {}
        path.arrow d=(d) {}
    }
}

/// The arc of an angle.
fn arc(layout: &Layout, angle: &Angle) -> Markup {
    let at = |t: f64| {
        [layout.px(angle.at[0] + angle.radius * t.cos()), layout.py(angle.at[1] + angle.radius * t.sin())]
    };
    let radius = angle.radius * layout.scale;
    if !(radius.is_finite() && radius > 0.0 && angle.to > angle.from) {
        return Markup::default();
    }
    let (a, b) = (at(angle.from), at(angle.to));
    let large = u8::from(angle.to - angle.from > PI);
    let mut d = String::new();
    // Along the arc, seen on paper where y runs down.
    arrow(&mut d, a, [angle.from.sin(), angle.from.cos()]);
    arrow(&mut d, b, [-angle.to.sin(), -angle.to.cos()]);
    let r = px(radius);
    html! {
        path.dimension d=(format!("M{} {}A{r} {r} 0 {large} 0 {} {}", px(a[0]), px(a[1]), px(b[0]), px(b[1]))) {}
        path.arrow d=(d) {}
    }
}

/// The leader of words in the column.
fn leader(layout: &Layout, w: &Words) -> Markup {
    let edge = layout.x[1].max(w.at[0]);
    let mut leader = LinePath::default();
    leader.add([w.at, [edge, w.at[1]], [layout.column_x() - 3.0, w.middle]]);
    html! {
        path.leader d=(leader.d) {}
        @if w.point { circle.point cx=(px(w.at[0])) cy=(px(w.at[1])) r=(POINT) {} }
    }
}

/// Words in the column.
fn beside(layout: &Layout, w: &Words) -> Markup {
    let top = w.middle - LINE * w.lines.len() as f64 / 2.0;
    html! {
        @for (i, line) in w.lines.iter().enumerate() {
            text.beside[i > 0] x=(px(layout.column_x())) y=(px(top + LINE * (i as f64 + 0.8))) { (words::markup(line)) }
        }
    }
}

fn summary(drawing: &Drawing) -> String {
    let spans = drawing.spans.iter().map(|s| s.text.clone());
    let angles = drawing.angles.iter().map(|a| a.text.clone());
    let callouts = drawing.callouts.iter().map(|c| c.lines.join(" "));
    let all: Vec<String> = spans.chain(angles).chain(callouts).collect();
    format!("{}: {}.", visible(&drawing.title), visible(&all.join("; ")))
}
