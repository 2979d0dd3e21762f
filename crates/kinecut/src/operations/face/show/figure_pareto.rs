//! Bad length against time of all ways: never one answer without its price.

use super::{MilledFace, looks};
use crate::page::draw::{BELOW, Labels, Plot, Ticks, WIDTHS, room_left};
use crate::page::px;
use crate::page::{Picture, fixed};

/// Width of the picture, height of its plot [px].
const WIDTH: f64 = WIDTHS[0];
const HEIGHT: f64 = 260.0;
/// Room above and at the right [px].
const ROOM: f64 = 14.0;

/// The chart; each point has the number of its way in the table.
pub(super) fn pareto(face: &MilledFace<'_>) -> Picture {
    let ways = &face.plan.ways;
    let mut picture = Picture {
        id: format!("{}-pareto", face.id),
        title: "Bad length against time".to_owned(),
        about: format!("{} ways; numbers as in the table", ways.len()),
        ..Picture::default()
    };
    let range = |values: &dyn Fn(usize) -> f64| {
        let all = (0..ways.len()).map(values).filter(|v| v.is_finite());
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let room = if high > low { 0.08 * (high - low) } else { 0.1 * high.abs().max(1.0) };
        [if low - room < 0.0 || low < 0.4 * high { 0.0 } else { low - room }, high + room]
    };
    let left = room_left(["-123.4"]);
    let mut plot = Plot {
        corner: [left, ROOM],
        size: [WIDTH - left - ROOM, HEIGHT],
        x: range(&|i| ways[i].time),
        y: range(&|i| ways[i].bad),
    };
    // Points at the border would be half hidden.
    for r in [&mut plot.x, &mut plot.y] {
        r[0] -= 0.03 * (r[1] - r[0]);
    }
    picture.size = [WIDTH, ROOM + HEIGHT + BELOW];
    let ticks = [Ticks::new(plot.x[0], plot.x[1], 8), Ticks::new(plot.y[0], plot.y[1], 5)];
    plot.axes(&mut picture, &ticks[0], &ticks[1], "time at feed and rapid [s]; upwards: bad length [mm]");
    let mut unbeaten: Vec<usize> = (0..ways.len()).filter(|&i| ways[i].unbeaten).collect();
    unbeaten.sort_by(|&a, &b| ways[a].time.total_cmp(&ways[b].time));
    let mut steps = String::new();
    for (k, &i) in unbeaten.iter().enumerate() {
        let [x, y] = plot.at([ways[i].time, ways[i].bad]);
        steps += &if k == 0 { format!("M{} {}", px(x), px(y)) } else { format!("H{}V{}", px(x), px(y)) };
    }
    picture.path(looks::ENTRY, steps);
    plot.border(&mut picture);
    let mut words = Labels::new([left, 0.0, WIDTH, ROOM + HEIGHT]);
    for way in ways {
        let [x, y] = plot.at([way.time, way.bad]);
        words.keep_off([x - 3.5, y - 3.5, x + 3.5, y + 3.5]);
    }
    let mut order: Vec<usize> = (0..ways.len()).collect();
    // The chosen and the unbeaten ones have their numbers first, and lie on top.
    order.sort_by_key(|&i| (i != face.plan.chosen, !ways[i].unbeaten));
    for &i in order.iter().rev() {
        let ink = if i == face.plan.chosen {
            looks::CHOSEN
        } else if ways[i].unbeaten {
            looks::BEST
        } else {
            looks::OTHER
        };
        picture.circle(ink, plot.at([ways[i].time, ways[i].bad]), if ways[i].unbeaten { 5.0 } else { 3.5 });
    }
    for &i in &order {
        let [x, y] = plot.at([ways[i].time, ways[i].bad]);
        let number = (i + 1).to_string();
        let places = [[11.0, -11.0], [-11.0, -11.0], [12.0, 11.0], [-12.0, 11.0], [0.0, -13.0], [0.0, 13.0]];
        words.put(&mut picture, &number, places.map(|d| [x + d[0], y + d[1]]));
    }
    picture.legend = vec![(looks::CHOSEN, "chosen".to_owned())];
    if ways.iter().any(|w| w.unbeaten) {
        picture.legend.push((looks::BEST, "unbeaten: nothing is both faster and cleaner".to_owned()));
    }
    if ways.iter().any(|w| !w.unbeaten) {
        picture.legend.push((looks::OTHER, "beaten".to_owned()));
    }
    let list: Vec<String> = unbeaten
        .iter()
        .map(|&i| format!("{} s {} mm ({})", fixed(ways[i].time, 1), fixed(ways[i].bad, 1), ways[i].name))
        .collect();
    picture.summary = format!("Bad length against time. Unbeaten: {}.", list.join("; "));
    picture
}
