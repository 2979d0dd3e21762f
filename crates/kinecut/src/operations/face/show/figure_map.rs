//! The objective over all placements of one straight pass, and curves over the orientation.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::DVec2;

use super::tables::turn;
use super::{MilledFace, looks};
use crate::facing::optimum::{ObjectiveMap, map_size, objective_map};
use crate::facing::{Placement, bad_length};
use crate::page::draw::{BELOW, Labels, Plot, Ticks, WIDTHS, room_left};
use crate::page::px;
use crate::page::{Anchor, Chart, Ink, Picture, fixed};

/// Orientations and offsets of the map.
const COLUMNS: usize = 180;
const ROWS: usize = 41;
/// Width of the picture, height of its plot [px].
const WIDTH: f64 = WIDTHS[0];
const HEIGHT: f64 = 260.0;
/// Room above for the scale [px].
const ABOVE: f64 = 46.0;
/// Room at the right [px].
const ROOM: f64 = 14.0;

/// The map of a face; none where no placement is allowed.
pub(super) fn objective<'a>(face: &MilledFace<'a>) -> Option<Cow<'a, ObjectiveMap>> {
    let map = match face.map {
        Some(map) => Cow::Borrowed(map),
        None => {
            let case = &face.plan.guarded;
            let [columns, rows] = map_size([COLUMNS, ROWS], case.outline.edges().len());
            Cow::Owned(objective_map(case, &face.options, columns, rows).ok()?)
        }
    };
    map.values.iter().any(Option::is_some).then_some(map)
}

/// Place of a placement on the map: the part's turn [deg], the centre line from the middle of its width [mm].
struct Places<'a> {
    face: &'a MilledFace<'a>,
}

impl Places<'_> {
    fn middle(&self, angle: f64) -> f64 {
        let [low, high] = self.face.plan.case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        0.5 * (low + high)
    }

    fn of(&self, p: Placement) -> [f64; 2] {
        let beside = p.offset - self.middle(p.angle);
        let seen = self.face.seen(Placement { offset: beside, ..p });
        [turn(seen.angle), seen.offset]
    }
}

/// Colours of values.
struct Scale {
    least: f64,
    most: f64,
}

impl Scale {
    fn of(map: &ObjectiveMap) -> Scale {
        let all = map.values.iter().flatten();
        let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
        Scale { least, most: if most > least { most } else { least + 1.0 } }
    }

    fn shade(&self, value: f64) -> u8 {
        let share = (value - self.least) / (self.most - self.least);
        (share * f64::from(Ink::STEPS)).clamp(0.0, f64::from(Ink::STEPS - 1)) as u8
    }
}

/// The objective over orientation and offset, with the optimum, other minima, and the ends of the paper's method.
pub(super) fn map_picture(face: &MilledFace<'_>, map: &ObjectiveMap) -> Picture {
    let mut picture = Picture {
        id: format!("{}-map", face.id),
        title: "Bad length over all placements".to_owned(),
        about: "of one straight pass, as it was optimised; upwards: centre line beside the middle of its width [mm]".to_owned(),
        ..Picture::default()
    };
    let places = Places { face };
    let scale = Scale::of(map);
    let half = half_range(face, map);
    let left = room_left(["-1234"]);
    let plot = Plot {
        corner: [left, ABOVE],
        size: [WIDTH - left - ROOM, HEIGHT],
        x: [0.0, 360.0],
        y: [-half, half],
    };
    picture.size = [WIDTH, ABOVE + HEIGHT + BELOW];
    picture.path(looks::FORBIDDEN, plot.area());
    let ticks = [Ticks::every(plot.x[0], plot.x[1], 45.0), Ticks::new(plot.y[0], plot.y[1], 6)];
    plot.axes(&mut picture, &ticks[0], &ticks[1], "turn of the part [deg, counter-clockwise]");
    cells(&mut picture, face, map, &plot, &scale);
    // The grid would lie under the cells.
    plot.border(&mut picture);
    scale_bar(&mut picture, &scale, left);
    let room = plot.bounds();
    let mut words = Labels::new(room);
    let mut legend = Vec::new();
    // A descent that saw no placement covering the part ends with a value beyond all others.
    let beyond = 2.0 * face.plan.guarded.weighted_perimeter();
    for d in face.descents.iter().filter(|d| d.value < beyond) {
        picture.circle(looks::BASELINE, plot.at(places.of(d.placement)), 2.6);
    }
    if !face.descents.is_empty() {
        legend.push((looks::BASELINE, format!("ends of {} Nelder-Mead descents", face.descents.len())));
    }
    if let Some(p) = face.plan.as_drawn {
        let at = plot.at(places.of(p));
        picture.circle(looks::POINT, at, 4.0);
        let value = bad_length(&face.plan.guarded, p);
        words.put(&mut picture, &format!("as drawn {}", fixed(value, 1)), [beside(at, room, -14.0)]);
        legend.push((looks::POINT, "as drawn, cutter over the middle".to_owned()));
    }
    if let Ok(optimum) = &face.plan.optimum {
        for other in &optimum.alternatives {
            picture.circle(looks::OTHER, plot.at(places.of(other.placement)), 3.6);
        }
        if !optimum.alternatives.is_empty() {
            legend.push((looks::OTHER, "other local minima".to_owned()));
        }
        let at = plot.at(places.of(optimum.placement));
        picture.circle(looks::BEST, at, 5.0);
        words.put(&mut picture, &format!("optimum {}", fixed(optimum.value, 3)), [beside(at, room, 15.0)]);
        legend.push((looks::BEST, "certified optimum".to_owned()));
    }
    legend.push((looks::FORBIDDEN, "not allowed: too wide, or forbidden".to_owned()));
    picture.legend = legend;
    picture.summary = format!(
        "Bad length over the turn of the part and the place of the centre line: from {} to {} mm.",
        fixed(scale.least, 3),
        fixed(scale.most, 3)
    );
    picture
}

/// Largest distance of the centre line from the middle, with a little room.
fn half_range(face: &MilledFace<'_>, map: &ObjectiveMap) -> f64 {
    let places = Places { face };
    let far = |(i, o): (usize, &[f64; 2])| {
        let middle = places.middle(TAU * i as f64 / map.columns as f64);
        if o[0] <= o[1] { (o[0] - middle).abs().max((o[1] - middle).abs()) } else { 0.0 }
    };
    1.08 * map.offsets.iter().enumerate().map(far).fold(1e-3, f64::max)
}

/// The cells of each shade as one path; neighbours of one shade in a column are one box.
fn cells(picture: &mut Picture, face: &MilledFace<'_>, map: &ObjectiveMap, plot: &Plot, scale: &Scale) {
    let places = Places { face };
    let mut paths = vec![String::new(); usize::from(Ink::STEPS)];
    let wide = 360.0 / map.columns as f64;
    let turned =
        |degrees: f64| if face.plan.left_hand { (360.0 - degrees).rem_euclid(360.0) } else { degrees };
    for i in 0..map.columns {
        let [low, high] = map.offsets[i];
        let values = &map.values[i * map.rows..(i + 1) * map.rows];
        if low > high {
            continue;
        }
        let middle = places.middle(TAU * i as f64 / map.columns as f64);
        let at = |j: f64| {
            let share = ((j - 0.5) / (map.rows - 1).max(1) as f64).clamp(0.0, 1.0);
            let beside = low + share * (high - low) - middle;
            plot.py(if face.plan.left_hand { -beside } else { beside })
        };
        let x = turned(i as f64 * wide);
        let mut j = 0;
        while j < map.rows {
            let shade = values[j].map(|v| scale.shade(v));
            let first = j;
            while j < map.rows && values[j].map(|v| scale.shade(v)) == shade {
                j += 1;
            }
            let Some(shade) = shade else { continue };
            let (y0, y1) = (at(first as f64), at(j as f64));
            // The column at 0 reaches over both ends.
            let ends = if x < 0.5 * wide {
                vec![[0.0, x + 0.5 * wide], [x + 360.0 - 0.5 * wide, 360.0]]
            } else {
                vec![[x - 0.5 * wide, (x + 0.5 * wide).min(360.0)]]
            };
            for [a, b] in ends {
                let (xa, xb) = (plot.px(a), plot.px(b));
                paths[usize::from(shade)] +=
                    &format!("M{} {}H{}V{}H{}Z", px(xa), px(y0), px(xb), px(y1), px(xa));
            }
        }
    }
    for (n, d) in paths.into_iter().enumerate() {
        picture.path(Ink::Step(n as u8), d);
    }
}

/// Scale of the colours.
fn scale_bar(picture: &mut Picture, scale: &Scale, left: f64) {
    /// Width and height [px].
    const WIDE: f64 = 256.0;
    const HIGH: f64 = 10.0;
    let step = WIDE / f64::from(Ink::STEPS);
    for n in 0..Ink::STEPS {
        let x = left + step * f64::from(n);
        picture.path(Ink::Step(n), format!("M{} 6h{}v{HIGH}h{}Z", px(x), px(step), px(-step)));
    }
    let ticks = Ticks::new(scale.least, scale.most, 5);
    for &v in &ticks.values {
        let x = left + WIDE * (v - scale.least) / (scale.most - scale.least);
        picture.tick([x, 6.0 + HIGH + 13.0], Anchor::Middle, ticks.label(v));
    }
    picture.tick([left + WIDE + 22.0, 6.0 + HIGH], Anchor::Start, "mm of edge with a bad exit");
}

/// Above or below a point, within the window.
fn beside(at: [f64; 2], room: [f64; 4], down: f64) -> [f64; 2] {
    /// Half of the longest word [px].
    const HALF: f64 = 62.0;
    let x = at[0].clamp(room[0] + HALF, room[2] - HALF);
    let y = if at[1] + down < room[1] + 8.0 || at[1] + down > room[3] - 8.0 {
        at[1] - down
    } else {
        at[1] + down
    };
    [x, y]
}

/// Largest exit angle over the orientation with the cutter over the middle (the paper's figure 5), and the bad length
/// there and at the best offset.
pub(super) fn survey_charts(face: &MilledFace<'_>, map: &ObjectiveMap) -> Vec<Chart> {
    let mut charts = Vec::new();
    let seen = |angle: f64| turn(if face.plan.left_hand { -angle } else { angle });
    let ordered = |mut points: Vec<[f64; 2]>| {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    };
    let x = ("turn of the part", "deg");
    let mut bad = Chart::new("Bad length over the orientation", x, ("bad length", "mm"));
    let least = |i: usize| {
        let values = map.values[i * map.rows..(i + 1) * map.rows].iter().flatten();
        let least = values.fold(f64::INFINITY, |a, &b| a.min(b));
        [seen(TAU * i as f64 / map.columns as f64), if least.is_finite() { least } else { f64::NAN }]
    };
    bad = bad.series("at the best offset", ordered((0..map.columns).map(least).collect()));
    if !face.survey.is_empty() {
        let value = |p: &crate::facing::SurveyPoint| {
            [seen(p.placement.angle), if p.covered { p.bad } else { f64::NAN }]
        };
        bad = bad.series("cutter over the middle", ordered(face.survey.iter().map(value).collect()));
        let largest = |p: &crate::facing::SurveyPoint| {
            [seen(p.placement.angle), if p.covered { p.largest_exit_angle.to_degrees() } else { f64::NAN }]
        };
        charts.push(
            Chart::new("Largest exit angle over the orientation", x, ("largest exit angle", "deg"))
                .series("cutter over the middle", ordered(face.survey.iter().map(largest).collect())),
        );
    }
    if let Ok(optimum) = &face.plan.optimum {
        bad = bad
            .mark(turn(face.seen(optimum.placement).angle), "optimum")
            .level(optimum.lower_bound, "certified lower bound");
    }
    charts.push(bad);
    charts
}
