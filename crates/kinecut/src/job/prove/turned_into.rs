//! Moves of a tool that leans or turns and that certainly runs through material: rapids, a standing spindle, shank and holder.
//!
//! The stock is not cut along these moves. What is left of it at the end was there before, unless a cutting move that was not
//! cut would have taken it: where no such move before reaches a point of the final stock, and a body of the tool that does not
//! cut holds that point, the two have met.

use glam::DVec3;

use super::Simulated;
use super::swept::{RevolvedBody, ToolPart, bodies, is_uncut, keeps_positive, most_moved, place, to_piece};
use super::turned::near_stock;
use crate::base::{Code, Finding};
use crate::geom::Aabb;
use crate::stock::{Axis, DexelGrid, TriDexel, unfixed};
use crate::trace::{Segment, SegmentPace};

/// A point lies so far inside a body, or it does not count [mm].
const INSIDE: f64 = 0.05;
/// Points of the stock that are looked at for one body of one segment.
const POINTS: usize = 24;
/// Places of one segment that are looked at.
const PLACES: f64 = 400.0;
/// Comparisons of a point with an earlier move that are made in all; beyond it the doubt about moves that are not cut stays.
const WORK: usize = 4_000_000;

/// Rapid moves, moves with a standing spindle, shanks and holders that run through material while the tool leans or turns.
pub(super) fn turned_into(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    let mut work = WORK;
    for (setup, done) in simulated.setups.iter().enumerate() {
        let segments = &done.trace.segments;
        let mut told: Vec<(u32, Code)> = Vec::new();
        for &index in near_stock(simulated.job, done) {
            let segment = &segments[index];
            let Some(bodies) = tool(simulated, segment) else { continue };
            for body in &bodies {
                let Some(kind) = kind(segment, body.part) else { continue };
                if told.contains(&(segment.item, kind.0)) {
                    continue;
                }
                let last = if segment.motion == SegmentPace::Rapid { index } else { index + 1 };
                let met = inside(&simulated.simulation.stock, segment, body)
                    .into_iter()
                    .find(|&(point, _)| !may_be_gone(simulated, point, (setup, last), &mut work));
                if let Some((point, depth)) = met {
                    told.push((segment.item, kind.0));
                    let finding = Finding::error(kind.0, kind.1).value_mm(depth).point(point.to_array());
                    let place = simulated.place(setup, segment.item);
                    found.push(Finding { place, ..finding.help(kind.2) });
                }
            }
        }
    }
    found
}

/// The code, message and help of a body that meets material on a segment; none where it may cut.
fn kind(segment: &Segment, part: ToolPart) -> Option<(Code, &'static str, &'static str)> {
    let turns = segment.turning.is_some();
    let rapid = segment.motion == SegmentPace::Rapid;
    Some(match part {
        _ if rapid && turns => (
            Code::TURNED_INTO_STOCK,
            match part {
                ToolPart::Cutting => "the tool turns through stock at rapid",
                ToolPart::Shank => "the shank turns through stock at rapid",
                ToolPart::Holder => "the holder turns through stock at rapid",
            },
            "retract the tool before the rotary axes turn",
        ),
        ToolPart::Cutting if rapid => (
            Code::RAPID_IN_STOCK,
            "a rapid move of a leaning tool goes through stock",
            "retract along the tool first, or come in at feed",
        ),
        ToolPart::Cutting if segment.spindle_on => return None,
        ToolPart::Cutting => (
            Code::SPINDLE_OFF,
            "the tool is driven through stock while the spindle stands still",
            "start the spindle before the cut",
        ),
        ToolPart::Shank => (
            Code::SHANK_IN_STOCK,
            "the shank meets stock while the tool leans",
            "use longer flutes, or lean the tool the other way",
        ),
        ToolPart::Holder => (
            Code::HOLDER_IN_STOCK,
            "the holder meets stock while the tool leans",
            "use more stickout, or lean the tool the other way",
        ),
    })
}

fn tool(simulated: &Simulated<'_>, segment: &Segment) -> Option<Vec<RevolvedBody>> {
    let tool = simulated.job.tools.iter().find(|t| Some(t.number) == segment.tool)?;
    bodies(tool).ok()
}

/// Points of the stock inside a body somewhere on a segment, each with its depth along the axis of the tool [mm]: the
/// deepest first, a few only.
fn inside(stock: &TriDexel, segment: &Segment, body: &RevolvedBody) -> Vec<(DVec3, f64)> {
    let step = stock.lattice().step;
    let [low, high] = body.heights();
    let box_of_stock = stock.bounds().grown(step);
    let way = most_moved(segment, high, 1.0);
    let places = (way / (2.0 * step).max(0.25 * body.radius())).ceil().clamp(1.0, PLACES);
    let heights = ((high - low) / (2.0 * step)).ceil().clamp(1.0, 64.0);
    let mut found: Vec<(DVec3, f64)> = Vec::new();
    for k in 0..=places as u32 {
        let (tip, axis) = place(segment, f64::from(k) / places);
        let ends = Aabb::of_points([tip + axis * low, tip + axis * high]);
        if !ends.grown(body.radius()).meets(box_of_stock) {
            continue;
        }
        let (u, v) = axis.any_orthonormal_pair();
        for h in 0..=heights as u32 {
            let height = low + (high - low) * f64::from(h) / heights;
            let ring = body.profile.radius(height - body.at) - step;
            let centre = tip + axis * height;
            let around = (0..8).map(|i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
                centre + (u * cos + v * sin) * ring.max(0.0)
            });
            for point in std::iter::once(centre).chain(around.filter(|_| ring > 0.0)) {
                let Some(point) = material(stock, point) else { continue };
                let depth = depth(body, point - tip, axis);
                if depth > INSIDE {
                    found.push((point, depth));
                }
            }
        }
        if found.len() > 4096 {
            thin(&mut found);
        }
    }
    thin(&mut found);
    found
}

/// Keeps the deepest points.
fn thin(found: &mut Vec<(DVec3, f64)>) {
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    // Points of one place tell the same: every other of the rest.
    if found.len() > POINTS {
        let apart = found.len() / POINTS;
        *found = found.iter().copied().step_by(apart.max(1)).take(POINTS).collect();
    }
}

/// The material nearest to a point on the lines along Z, at the height of the point.
fn material(stock: &TriDexel, point: DVec3) -> Option<DVec3> {
    let lattice = stock.lattice();
    let at = ((point - lattice.origin) / lattice.step).round();
    let inside = |i: usize| at[i] >= 0.0 && at[i] < f64::from(lattice.counts[i]);
    if !(inside(0) && inside(1)) {
        return None;
    }
    let (i, j) = (at.x as u32, at.y as u32);
    let line = stock.line(Axis::Z, i, j).iter();
    let holds = line.map(|part| [unfixed(part.lo.at), unfixed(part.hi.at)]);
    let [low, high] = holds.into_iter().find(|[low, high]| point.z > *low && point.z < *high)?;
    // At the surface a point counts as deep as the model is exact.
    let z = point.z.clamp(low + INSIDE.min(0.5 * (high - low)), high - INSIDE.min(0.5 * (high - low)));
    Some(DVec3::new(lattice.coordinate(Axis::X, i), lattice.coordinate(Axis::Y, j), z))
}

/// Least depth of a point [from the tip] inside a body [mm]; negative outside.
fn depth(body: &RevolvedBody, from_tip: DVec3, axis: DVec3) -> f64 {
    let [low, high] = body.heights();
    let height = from_tip.dot(axis);
    let beside = (from_tip - axis * height).length();
    if height < low || height > high {
        return -1.0;
    }
    // The radius never falls with the height: below the point the body is the narrower.
    let of_radius = |down: f64| body.profile.radius(height - body.at - down) - beside;
    let (mut least, mut most) = (0.0, (height - low).min(high - height));
    // The largest ball of the section that reaches down as far as out.
    for _ in 0..30 {
        let middle = 0.5 * (least + most);
        if of_radius(middle) >= middle { least = middle } else { most = middle }
    }
    if of_radius(0.0) > 0.0 { least } else { -1.0 }
}

/// Whether a cutting move that was not cut may have taken a point before; `until`: the setup, and the first of its segments
/// that comes too late.
fn may_be_gone(
    simulated: &Simulated<'_>,
    point: DVec3,
    (setup, until): (usize, usize),
    work: &mut usize,
) -> bool {
    /// Distance from the edge of a cutter at which material may be gone [mm].
    const BESIDE: f64 = 0.1;
    for (number, done) in simulated.setups.iter().enumerate().take(setup + 1) {
        let segments = &done.trace.segments;
        let before = &segments[..if number == setup { until } else { segments.len() }];
        for segment in before.iter().filter(|s| is_uncut(s) && s.motion != SegmentPace::Rapid && s.spindle_on)
        {
            *work = work.saturating_sub(1);
            if *work == 0 {
                return true;
            }
            let Some(tool) = simulated.job.tools.iter().find(|t| Some(t.number) == segment.tool) else {
                return true;
            };
            let (height, radius) = (tool.flute_length, 0.5 * tool.cutter.diameter(tool.flute_length));
            let radius = radius + BESIDE + done.trace.chord_error;
            let reach = segment.curve.bounds().grown(height + radius);
            if !reach.meets(Aabb { min: point, max: point }) {
                continue;
            }
            let gap = |t: f64| {
                let (tip, axis) = place(segment, t);
                to_piece(point, [tip, tip + axis * height]) - radius
            };
            if !keeps_positive(&gap, &|by| most_moved(segment, height, by), 0.0, 1.0) {
                return true;
            }
        }
    }
    false
}
