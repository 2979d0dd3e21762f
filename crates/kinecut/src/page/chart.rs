//! Line charts as SVG: readable without JavaScript, in both themes and on paper.
//!
//! A curve is told apart by colour, dash and name. Long curves are reduced to what a screen can show: at most four
//! points in each half pixel (first, least, greatest, last, so that no peak is lost), then a tenth of a pixel of error.

use maud::{Markup, html};

use super::draw::{BELOW, Ink, Labels, LinePath, Plot, Ticks, room_left, width};
use super::picture::{Anchor, Picture, drawn, in_widths, sample};
use super::{Chart, Colour, Dash, Follows, Series, Width, simplify, trimmed, visible};

/// Height of the plot area [px].
const PLOT: f64 = 180.0;
/// Room to the right [px].
const RIGHT: f64 = 14.0;
/// Line height of words above the plot [px].
const LINE: f64 = 14.0;
/// Rows of words above the plot for vertical lines.
const MARK_ROWS: usize = 3;
/// Width for one number of x, and height for one of y [px].
const NUMBER: [f64; 2] = [58.0, 38.0];
/// Error of a drawn curve [px].
const ERROR: f64 = 0.1;
/// Vertical lines, and limits.
const MARK: Ink = Ink::Line(Colour::Quiet, Width::Fine, Dash::Dots);
const LEVEL: Ink = Ink::Line(Colour::Bad, Width::Thin, Dash::Long);

/// The chart as a figure.
pub(crate) fn figure(chart: &Chart) -> Markup {
    let Some(ranges) = ranges(chart) else {
        return html! {
            figure.chart { figcaption { (visible(&chart.title)) } p.quiet { "There are no values to draw." } }
        };
    };
    html! {
        figure.chart {
            figcaption {
                b { (visible(&chart.title)) }
                span.axes { " " (named(&chart.y, &chart.y_unit)) " over " (named(&chart.x, &chart.x_unit)) }
            }
            @if chart.series.len() > 1 || chart.series.iter().any(|s| !s.name.is_empty()) {
                ul.legend {
                    @for (i, s) in chart.series.iter().enumerate() { li { (sample(Ink::series(i))) (visible(&s.name)) } }
                }
            }
            (in_widths(|width, class| svg(chart, ranges, width, class)))
            (numbers(chart))
        }
    }
}

/// The chart laid out for a width [px].
fn svg(chart: &Chart, (x, y): ([f64; 2], [f64; 2]), width: f64, class: &str) -> Markup {
    let ticks = |r: [f64; 2], size: f64, one: f64| Ticks::new(r[0], r[1], (size / one).round() as usize);
    let yt = ticks(y, PLOT, NUMBER[1]);
    let left = room_left(yt.labels().iter().map(String::as_str));
    let xt = ticks(x, width - left, NUMBER[0]);
    let mut plot = Plot { corner: [left, 0.0], size: [width - RIGHT - left, PLOT], x, y };
    let marks = place_marks(chart, &plot, width);
    let rows =
        marks.iter().filter_map(|m| m.1).map(|row| row[1] / LINE).fold(0.0, |a: f64, b| a.max(b.ceil()));
    plot.corner[1] = 8.0 + LINE * rows;
    let [_, top, right, bottom] = plot.bounds();
    let mut under = Picture::default();
    plot.axes(&mut under, &xt, &yt, named(&chart.x, &chart.x_unit));
    plot.border(&mut under);
    for (mark, word) in marks {
        under.path(MARK, plot.upright(chart.marks[mark].at));
        if let Some([at, middle]) = word {
            under.word([at, middle + 4.0], Anchor::Middle, chart.marks[mark].text.as_str());
        }
    }
    for level in chart.levels.iter().filter(|l| l.at.is_finite()) {
        under.path(LEVEL, plot.level(level.at));
        under.word([right - 4.0, plot.py(level.at) - 4.0], Anchor::End, level.text.as_str());
    }
    let follows = match chart.follows {
        Follows::Nothing => None,
        Follows::Time => Some("time"),
        Follows::Length => Some("length"),
    };
    let data = |v: f64| follows.map(|_| v.to_string());
    let height = bottom + BELOW;
    html! {
        svg class=(class) viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img" aria-label=(summary(chart))
            data-follows=[follows] data-unit=[follows.map(|_| visible(&chart.y_unit))] data-from=[data(chart.follows_from)]
            data-x0=[data(plot.px(0.0))] data-kx=[data(plot.kx())] data-y0=[data(plot.py(0.0))] data-ky=[data(plot.ky())]
            data-left=[data(left)] data-right=[data(right)] data-top=[data(top)] data-bottom=[data(bottom)] {
            @for shape in &under.shapes { (drawn(shape)) }
            @for (i, s) in chart.series.iter().enumerate() {
                path class=(format!("{} curve", Ink::series(i).class())) d=(curve(s, &plot)) data-name=(visible(&s.name)) {}
            }
        }
    }
}

fn named(name: &str, unit: &str) -> String {
    if unit.is_empty() {
        visible(name).into_owned()
    } else {
        format!("{} [{}]", visible(name), visible(unit))
    }
}

fn finite(p: &[f64; 2]) -> bool {
    p[0].is_finite() && p[1].is_finite()
}

/// The ranges of x and y, y with a little room; `None` without a finite point.
fn ranges(chart: &Chart) -> Option<([f64; 2], [f64; 2])> {
    let (mut x, mut y) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
    let grow = |r: &mut (f64, f64), v: f64| *r = (r.0.min(v), r.1.max(v));
    for p in chart.series.iter().flat_map(|s| &s.points).filter(|p| finite(p)) {
        grow(&mut x, p[0]);
        grow(&mut y, p[1]);
    }
    if x.0 > x.1 {
        return None;
    }
    for level in chart.levels.iter().filter(|l| l.at.is_finite()) {
        grow(&mut y, level.at);
    }
    // A curve that comes near zero is shown from zero: a cut-off axis exaggerates.
    if y.0 > 0.0 && y.0 < 0.4 * y.1 {
        y.0 = 0.0;
    }
    if y.1 < 0.0 && y.1 > 0.4 * y.0 {
        y.1 = 0.0;
    }
    let room = |r: (f64, f64), share: f64| {
        let span = r.1 - r.0;
        // A constant gets a tenth of its size around it, zero gets one unit.
        let span =
            if span > 1e-9 * r.0.abs().max(r.1.abs()) { span * share } else { (r.0.abs() * 0.1).max(1e-9) };
        if r.0 == 0.0 && r.1 == 0.0 {
            (-1.0, 1.0)
        } else {
            (if r.0 == 0.0 { 0.0 } else { r.0 - span }, r.1 + span)
        }
    };
    let (x, y) = (if x.1 > x.0 { x } else { room(x, 0.0) }, room(y, 0.06));
    Some((x.into(), y.into()))
}

/// The marks within the plot from left to right, each with the middle of its word above it; no place when there is no room.
fn place_marks(chart: &Chart, plot: &Plot, whole: f64) -> Vec<(usize, Option<[f64; 2]>)> {
    let within = |i: &usize| plot.x[0] <= chart.marks[*i].at && chart.marks[*i].at <= plot.x[1];
    let mut order: Vec<usize> = (0..chart.marks.len()).filter(within).collect();
    order.sort_by(|&a, &b| chart.marks[a].at.total_cmp(&chart.marks[b].at));
    let mut labels = Labels::new([0.0, 0.0, whole, LINE * (MARK_ROWS + 1) as f64]);
    let place = |i: usize| {
        let mark = &chart.marks[i];
        if mark.text.is_empty() {
            return (i, None);
        }
        let half = (0.5 * width(&mark.text) + 4.0).min(0.5 * whole);
        let at = plot.px(mark.at).clamp(half, whole - half);
        (i, labels.first(&mark.text, (0..MARK_ROWS).map(|row| [at, LINE * (row as f64 + 1.0) - 4.0])))
    };
    order.into_iter().map(place).collect()
}

fn curve(series: &Series, plot: &Plot) -> String {
    let mut path = LinePath::default();
    for run in series.points.split(|p| !finite(p)) {
        let points: Vec<[f64; 2]> = run.iter().map(|p| plot.at(*p)).collect();
        let points = columns(points, plot.size[0]);
        let kept = simplify::kept(&points, ERROR);
        path.add(kept.into_iter().map(|i| points[i]));
    }
    path.d
}

/// At most four points in each half pixel where x rises; other curves stay as they are.
fn columns(points: Vec<[f64; 2]>, width: f64) -> Vec<[f64; 2]> {
    if points.len() < 4 * width as usize || points.windows(2).any(|w| w[1][0] < w[0][0]) {
        return points;
    }
    let mut out = Vec::new();
    for column in points.chunk_by(|a, b| (a[0] * 2.0).floor() == (b[0] * 2.0).floor()) {
        let by_y = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
        let (min, max) = ((0..column.len()).min_by(by_y), (0..column.len()).max_by(by_y));
        let mut picks = [Some(0), min, max, Some(column.len() - 1)].map(|i| i.unwrap_or(0));
        picks.sort_unstable();
        let mut last = usize::MAX;
        for i in picks {
            if i != last {
                out.push(column[i]);
            }
            last = i;
        }
    }
    out
}

/// Least and greatest point of a series.
fn peaks(series: &Series) -> Option<([f64; 2], [f64; 2])> {
    let finite = || series.points.iter().copied().filter(finite);
    let by_y = |a: &[f64; 2], b: &[f64; 2]| a[1].total_cmp(&b[1]);
    Some((finite().min_by(by_y)?, finite().max_by(by_y)?))
}

/// A number with five digits.
pub(crate) fn digits(v: f64) -> String {
    if !v.is_finite() {
        return "–".to_owned();
    }
    if v == 0.0 {
        return "0".to_owned();
    }
    let magnitude = v.abs().log10().floor();
    if !(-6.0..9.0).contains(&magnitude) {
        format!("{v:.4e}")
    } else {
        trimmed(v, (4.0 - magnitude).max(0.0) as usize)
    }
}

fn summary(chart: &Chart) -> String {
    let mut text = format!(
        "{}: {} over {}.",
        visible(&chart.title),
        named(&chart.y, &chart.y_unit),
        named(&chart.x, &chart.x_unit)
    );
    for s in &chart.series {
        if let Some((lo, hi)) = peaks(s) {
            text += &format!(
                " {} from {} at {} to {} at {}.",
                visible(&s.name),
                digits(lo[1]),
                digits(lo[0]),
                digits(hi[1]),
                digits(hi[0])
            );
        }
    }
    text
}

/// The picture in numbers.
fn numbers(chart: &Chart) -> Markup {
    let point = |p: [f64; 2]| html! { td.number { (digits(p[1])) } td.number.at { (digits(p[0])) } };
    html! {
        details.numbers {
            summary { "Numbers" }
            table {
                thead { tr {
                    th scope="col" { (named(&chart.y, &chart.y_unit)) }
                    @for word in ["first", "least", "greatest", "last"] {
                        th.number scope="col" { (word) }
                        th.number.at scope="col" { "at " (visible(&chart.x)) }
                    }
                } }
                tbody {
                    @for s in &chart.series {
                        @if let Some((lo, hi)) = peaks(s) {
                            @let (first, last) = (s.points.iter().find(|p| finite(p)), s.points.iter().rfind(|p| finite(p)));
                            tr {
                                th scope="row" { (visible(&s.name)) }
                                (point(first.copied().unwrap_or(lo))) (point(lo)) (point(hi)) (point(last.copied().unwrap_or(hi)))
                            }
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve_points(svg: &str) -> Vec<[f64; 2]> {
        let d = svg.split(" curve\" d=\"").nth(1).unwrap().split('"').next().unwrap();
        d.split(['M', 'L'])
            .filter(|s| !s.is_empty())
            .map(|p| {
                let (x, y) = p.split_once(' ').unwrap();
                [x.parse().unwrap(), y.parse().unwrap()]
            })
            .collect()
    }

    #[test]
    fn a_million_noisy_points_become_few_and_keep_their_peak() {
        let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0;
        let mut points: Vec<[f64; 2]> = (0..1_000_000).map(|i| [f64::from(i) * 1e-3, noise(i)]).collect();
        points[777_777][1] = 10.0;
        let svg = figure(&Chart::new("noise", ("s", "mm"), ("v", "")).series("a", points)).into_string();
        let drawn = curve_points(&svg);
        assert!(drawn.len() < 6000, "{}", drawn.len());
        let top = drawn.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        // y from 0 to 10.6 over 180 px; the peak is at 777.777 of 1000 between the margins.
        assert!((top[1] - (8.0 + 180.0 * 0.6 / 10.6)).abs() < 0.02, "{top:?}");
        let left = 14.0 + 6.1 * "10".len() as f64;
        assert!((top[0] - (left + (498.0 - left) * 0.777_777)).abs() < 0.5, "{top:?} {left}");
    }

    #[test]
    fn gaps_break_the_curve_and_strange_input_draws_nothing() {
        let chart = Chart::new("g", ("x", ""), ("y", ""))
            .series("a", vec![[0.0, 1.0], [1.0, 2.0], [2.0, f64::NAN], [3.0, 2.0], [4.0, 5.0]]);
        let svg = figure(&chart).into_string();
        let d = svg.split(" curve\" d=\"").last().unwrap().split('"').next().unwrap();
        assert_eq!(d.matches('M').count(), 2);
        for points in [vec![], vec![[f64::NAN, 1.0]], vec![[f64::INFINITY, 0.0]]] {
            let svg = figure(&Chart::new("g", ("x", ""), ("y", "")).series("a", points)).into_string();
            assert!(svg.contains("no values") && !svg.contains("NaN") && !svg.contains("inf"));
        }
        for y in [0.0, -3.0, 1e-30, 1e30] {
            let chart = Chart::new("c", ("x", ""), ("y", "")).series("a", vec![[1.0, y]]).mark(1.0, "m");
            let svg = figure(&chart).into_string();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }

    #[test]
    fn words_of_near_marks_take_rows_or_are_left_out() {
        let mut chart = Chart::new("m", ("x", ""), ("y", "")).series("a", vec![[0.0, 0.0], [100.0, 1.0]]);
        for i in 0..5 {
            chart = chart.mark(50.0 + f64::from(i) * 0.01, "finish turn");
        }
        let svg = figure(&chart).into_string();
        // In each of the two widths.
        assert_eq!(svg.matches("finish turn").count(), 2 * 3);
        assert_eq!(svg.matches(&MARK.class()).count(), 2 * 5);
    }

    #[test]
    fn numbers_have_five_digits() {
        assert_eq!(
            [0.012_345_67, 123_456.0, -2.0, 1e-9].map(digits),
            ["0.012346", "123456", "-2", "1.0000e-9"]
        );
    }
}
