//! Drawings to scale as SVG: the path seen along an axis with walls and tools, each stretch linked to its program line.
//!
//! All lines of a look are one `<path>`, so a long program stays light. The attribute `data-blocks` names the
//! program line of each of its subpaths in order; the page's script finds the line under the pointer with it. The plan of
//! the whole path has no list: there the script uses the path itself, and layers that look alike are drawn once.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::draw::{BELOW, CHARACTER, Ink, LinePath, Plot, Ticks};
use super::picture::{Anchor, Picture, drawn, in_widths, sample};
use super::px;
use super::{Colour, Plan, fixed, simplify, visible};

/// Greatest and least height of the plot area [px].
const HEIGHT: (f64, f64) = (420.0, 90.0);
/// Room at the right and above [px].
const MARGIN: f64 = 14.0;
/// Width for one number [px].
const NUMBER: f64 = 64.0;
/// Error of a drawn line [px].
const ERROR: f64 = 0.08;

/// The plan as a figure.
pub(crate) fn figure(plan: &Plan) -> Markup {
    let mut looks: Vec<(Ink, &str)> = Vec::new();
    for line in plan.lines.iter().filter(|l| l.points.len() > 1) {
        if !looks.contains(&(line.ink, line.name.as_str())) {
            looks.push((line.ink, &line.name));
        }
    }
    html! {
        figure.plan {
            @if let Some(extent) = extent(plan) {
                figcaption { b { (visible(&plan.title)) } span.axes { " " (visible(&plan.x)) " to the right, " (visible(&plan.y)) " upwards [mm]" } }
                @if !looks.is_empty() {
                    ul.legend { @for (ink, name) in &looks { li { (sample(*ink)) (visible(name)) } } }
                }
                (in_widths(|width, class| svg(plan, &looks, extent, width, class)))
            } @else {
                figcaption { b { (visible(&plan.title)) } }
                p.quiet { "There is nothing to draw." }
            }
        }
    }
}

/// The plan laid out for a width [px].
fn svg(plan: &Plan, looks: &[(Ink, &str)], extent: [[f64; 2]; 2], width: f64, class: &str) -> Markup {
    let Some(plot) = plot(extent, width) else { return Markup::default() };
    let (scale, height) = (plot.kx(), plot.bounds()[3] + BELOW);
    let (xt, yt) = ticks(&plot);
    let (mut under, mut over) = (Picture::default(), Picture::default());
    plot.axes(&mut under, &xt, &yt, format!("{} [mm]", visible(&plan.x)));
    plot.border(&mut under);
    for c in plan.circles.iter().filter(|c| usable(c.centre, c.radius)) {
        under.circle(c.ink, plot.at(c.centre), c.radius * scale);
        if !c.text.is_empty() {
            let [x, y] = plot.at([c.centre[0], c.centre[1] + c.radius]);
            under.word([x, y - 4.0], Anchor::Middle, c.text.as_str());
        }
    }
    for (p, word) in plan.points.iter().filter(|(p, _)| usable(*p, 0.0)) {
        let [x, y] = plot.at(*p);
        over.circle(Ink::Area(Colour::Ink), [x, y], 2.5);
        over.word([x + 6.0, y - 5.0], Anchor::Start, word.as_str());
    }
    html! {
        svg class=(class) viewBox=(format!("0 0 {width} {}", px(height))) width=(width) height=(px(height)) role="img" aria-label=(summary(plan, looks))
            data-scale=(scale) data-x0=(plot.px(0.0)) data-y0=(plot.py(0.0)) {
            @for shape in &under.shapes { (drawn(shape)) }
            @for look in looks {
                @let (d, blocks) = lines(plan, *look, &plot);
                @let blocks = blocks.contains(|c: char| c.is_ascii_digit()).then_some(blocks);
                path class=(format!("{} curve", look.0.class())) d=(d) data-blocks=[blocks] {}
            }
            @for shape in &over.shapes { (drawn(shape)) }
        }
    }
}

fn usable(p: [f64; 2], radius: f64) -> bool {
    p[0].is_finite() && p[1].is_finite() && radius.is_finite() && radius >= 0.0
}

/// Least and greatest corner of what is drawn, with a little room; none without a point.
fn extent(plan: &Plan) -> Option<[[f64; 2]; 2]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut grow = |p: [f64; 2], r: f64| {
        if usable(p, r) {
            (low, high) = ([0, 1].map(|k| low[k].min(p[k] - r)), [0, 1].map(|k| high[k].max(p[k] + r)));
        }
    };
    plan.lines.iter().flat_map(|l| &l.points).for_each(|p| grow(*p, 0.0));
    plan.circles.iter().for_each(|c| grow(c.centre, c.radius));
    plan.points.iter().for_each(|p| grow(p.0, 0.0));
    let span = (high[0] - low[0]).max(high[1] - low[1]);
    // A drawing of one point shows a millimetre around it.
    let room = if span > 0.0 { span * 0.04 } else { 1.0 };
    (low[0] <= high[0]).then(|| [low.map(|v| v - room), high.map(|v| v + room)])
}

/// The plot of an extent in a width [px], to scale; none of one without bounds.
fn plot([low, high]: [[f64; 2]; 2], width: f64) -> Option<Plot> {
    // Labels of y are "-123.4" at most for what fits here; the exact width hardly moves the picture.
    let left = 14.0 + CHARACTER * 6.0;
    let wide = width - MARGIN - left;
    let scale = (wide / (high[0] - low[0])).min(HEIGHT.0 / (high[1] - low[1]));
    let tall = ((high[1] - low[1]) * scale).max(HEIGHT.1);
    let range = |k: usize, size: f64| {
        let (middle, half) = (0.5 * (low[k] + high[k]), 0.5 * size / scale);
        [middle - half, middle + half]
    };
    let plot = Plot { corner: [left, MARGIN], size: [wide, tall], x: range(0, wide), y: range(1, tall) };
    scale.is_finite().then_some(plot)
}

/// Ticks of both axes with one distance, so that the grid shows squares.
fn ticks(plot: &Plot) -> (Ticks, Ticks) {
    let longest = plot.size[0].max(plot.size[1]);
    let span = longest / plot.kx();
    let step = Ticks::new(0.0, span, (longest / NUMBER).round() as usize).step;
    (Ticks::every(plot.x[0], plot.x[1], step), Ticks::every(plot.y[0], plot.y[1], step))
}

/// The lines of one look: `d` and the program line of each subpath, `-` for none.
fn lines(plan: &Plan, (ink, name): (Ink, &str), plot: &Plot) -> (String, String) {
    let (mut all, mut drawn) = (String::new(), BTreeSet::new());
    let mut blocks: Vec<String> = Vec::new();
    for line in plan.lines.iter().filter(|l| l.ink == ink && l.name == name) {
        for run in line.points.split(|p| !usable(*p, 0.0)).filter(|r| !r.is_empty()) {
            let points: Vec<[f64; 2]> = run.iter().map(|p| plot.at(*p)).collect();
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

fn summary(plan: &Plan, looks: &[(Ink, &str)]) -> String {
    let mut text = format!("{}:", visible(&plan.title));
    for (_, name) in looks {
        text += &format!(" {} path,", visible(name));
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
    use crate::page::{Circle, PlanLine, Width};

    const CUT: Ink = Ink::line(Colour::Path(5), Width::Bold);

    fn attribute<'a>(svg: &'a str, after: &str, name: &str) -> &'a str {
        let rest = svg.split(after).nth(1).unwrap();
        rest.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap()
    }

    #[test]
    fn the_drawing_is_to_scale_and_up_is_up() {
        let mut plan = Plan::new("p");
        plan.circles.push(Circle { centre: [10.0, 20.0], radius: 100.0, ..Circle::default() });
        plan.lines.push(PlanLine {
            ink: CUT,
            name: "finish".into(),
            block: Some(7),
            points: vec![[10.0, 20.0], [110.0, 20.0], [110.0, 120.0]],
        });
        let svg = figure(&plan).into_string();
        let r: f64 = attribute(&svg, "<circle ", "r").parse().unwrap();
        let cx: f64 = attribute(&svg, "<circle ", "cx").parse().unwrap();
        let cy: f64 = attribute(&svg, "<circle ", "cy").parse().unwrap();
        let d = attribute(&svg, "curve\"", "d");
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
        let mut line =
            |block, points| plan.lines.push(PlanLine { ink: CUT, name: "rough".into(), block, points });
        line(Some(3), vec![[0.0, 0.0], [1.0, 0.0], nan, [2.0, 0.0], [3.0, 1.0]]);
        line(None, vec![[3.0, 1.0], [5.0, 5.0]]);
        let plot = plot(extent(&plan).unwrap(), 512.0).unwrap();
        let (d, blocks) = lines(&plan, (CUT, "rough"), &plot);
        assert_eq!((d.matches('M').count(), blocks.as_str()), (3, "3 3 -"));
    }
}
