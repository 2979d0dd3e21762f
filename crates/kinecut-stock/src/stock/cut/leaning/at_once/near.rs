//! A convex part over a span, seen from a point: what it keeps away from, and what it swallows.
//!
//! Source: the gauge of a convex part is convex in the frame of the tool, and falls by no more than the distance. So the part stays
//! behind its tangent plane at any point, which moves as the point does in the frame of the tool.

use glam::DVec3;

use super::super::super::body::ConvexPart;
use super::super::chord::{curved_gauge_at, gauge_at};
use super::super::span::Pose;
use super::super::swept::SpanPoses;
use super::super::task::SpanTask;
use super::about::ABOUT;
use super::cells::Cell;
use super::lanes::{LANES, WAY};
use crate::geom::Aabb;

/// Way by which a cell, or a line, lies within a tool that takes all of it: more than the rounding of ends [mm].
const WITHIN: f64 = 1e-4;

/// A convex part over a span.
pub(super) struct SweptPart<'a> {
    pub(super) task: &'a SpanTask<'a>,
    /// The pose in the middle, near at hand, and how fast the tool turns there [rad by the span's parameter].
    middle: Pose,
    turn: f64,
    pub(super) part: &'a ConvexPart,
    /// Index of the part in its tool.
    pub(super) index: usize,
    /// All that it sweeps.
    pub(super) bounds: Aabb,
    /// Bend of the way of the tip, seen from the tool [mm], and what each millimetre from the tip adds.
    bends: [f64; 2],
    /// As lanes hold it, near at hand: tip and axis as cubics, and what their way is bent by.
    pub(super) way: [f64; WAY],
}

/// A plane that a part stays behind, near a cell: all it sweeps of the cell has `normal . (q - centre) <= reach`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangent {
    /// Outward normal of the part, no longer than 1.
    pub(super) normal: DVec3,
    /// Most that the part reaches beyond the centre of the cell [mm]; negative when it ends before it.
    pub(super) reach: f64,
    /// A guess at that reach, without the slack of the bound [mm].
    pub(super) likely: f64,
}

/// The gauge of a part near the centre of a cell, over the time of a span, but for what is of the third order: it is
/// `value + normal . d + |curves . d - carried t|^2 / 2 - closing t + gains t^2 / 2`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearby {
    /// Gauge at the centre in the middle of the time [mm], and its gradient.
    pub(super) value: f64,
    pub(super) normal: DVec3,
    /// Its second derivative: the squares of two vectors.
    pub(super) curves: [DVec3; 2],
    /// The way of the centre by the time, along these vectors.
    pub(super) carried: [f64; 2],
    /// Rate at which the gauge falls [mm by the span's parameter], and its change by the turn of the tool.
    pub(super) closing: f64,
    pub(super) gains: f64,
}

/// A plane that a part stays behind, near a place: all it sweeps has `normal . (q - place) <= reach`, and `widens` more for each
/// millimetre by which q is farther than it was made for.
#[derive(Default)]
pub(super) struct Beside {
    pub(super) normal: DVec3,
    pub(super) reach: f64,
    pub(super) widens: f64,
}

impl Beside {
    /// The plane of a lane.
    pub(super) fn of(about: &[[f64; LANES]; ABOUT], lane: usize) -> Beside {
        let normal = DVec3::new(about[0][lane], about[1][lane], about[2][lane]);
        Beside { normal, reach: about[3][lane], widens: about[ABOUT - 1][lane] }
    }
}

impl<'a> SweptPart<'a> {
    pub(super) fn new(task: &'a SpanTask<'a>, part: &'a ConvexPart, index: usize) -> SweptPart<'a> {
        let pose = &task.poses.poses[1];
        let span = &task.poses.span;
        let far = part.top.max(-part.z0).hypot(part.r1);
        let ends = [part.z0, part.top].map(|z| pose.tip + pose.axis * z);
        SweptPart {
            bounds: Aabb::of_points(ends).grown(part.r1 + span.stray(far)),
            bends: [task.poses.bend_seen(span.bend(0.0)), span.bend(1.0) - span.bend(0.0)],
            middle: *pose,
            turn: pose.axis_rate.length(),
            way: way(&task.poses),
            task,
            part,
            index,
        }
    }

    /// As a bundle holds them: place and axis in the middle, their rates, turn and bends.
    pub(super) fn numbers(&self) -> [f64; 15] {
        let Pose { tip, axis, tip_rate, axis_rate } = self.middle;
        let [p, u, v, w] = [tip, axis, tip_rate, axis_rate];
        let [tip, by_reach] = self.bends;
        [p.x, p.y, p.z, u.x, u.y, u.z, v.x, v.y, v.z, w.x, w.y, w.z, self.turn, tip, by_reach]
    }

    /// Most that the part reaches beyond the centre of what is no farther from it than `radius` [mm].
    pub(super) fn reach(&self, centre: DVec3, radius: f64) -> f64 {
        self.tangent(centre, radius).reach
    }

    /// The tangent plane of the part about what is no farther from a place than `radius`.
    fn tangent(&self, centre: DVec3, radius: f64) -> Tangent {
        let pose = &self.middle;
        let gauge = gauge_at(self.part, pose, centre);
        let rate = gauge.normal.dot(pose.velocity(centre - pose.tip)).abs();
        let slack = 0.5 * (rate + radius * self.turn) + 2.0 * self.bend(centre, radius);
        Tangent { normal: gauge.normal, reach: slack - gauge.value, likely: -gauge.value }
    }

    /// The plane that keeps closest to the part, about a place.
    pub(super) fn beside(&self, place: DVec3, radius: f64) -> Beside {
        let Tangent { normal, reach, .. } = self.closely(place, radius);
        Beside { normal, reach, widens: self.turn() + self.task.poses.nearer_by_way() }
    }

    /// The tangent plane about a cell at the middle of the time, or one that keeps closer to the part.
    pub(super) fn tangent_closely(&self, cell: &Cell) -> Tangent {
        self.closely(cell.centre, cell.radius)
    }

    /// The gauge about the centre of a cell.
    pub(super) fn nearby(&self, cell: &Cell) -> Nearby {
        let pose = &self.middle;
        let (gauge, curves) = curved_gauge_at(self.part, pose, cell.centre);
        let place = cell.centre - pose.tip;
        let velocity = pose.velocity(place);
        Nearby {
            value: gauge.value,
            normal: gauge.normal,
            curves,
            carried: curves.map(|c| c.dot(velocity)),
            closing: gauge.normal.dot(velocity),
            gains: SpanPoses::curved(pose, gauge.normal, place),
        }
    }

    /// The tangent plane at the middle of the time, or one that keeps closer to the part: that and the one at the end of the time to
    /// which the part comes nearer, in shares with which what both say of the centre does not change in time.
    fn closely(&self, centre: DVec3, radius: f64) -> Tangent {
        let poses = &self.task.poses.poses;
        let at = |pose: &Pose| {
            let gauge = gauge_at(self.part, pose, centre);
            let place = centre - pose.tip;
            let nearer = self.task.poses.nearer(pose, gauge.normal, place, self.part);
            (gauge, -gauge.normal.dot(pose.velocity(place)), nearer)
        };
        let (middle, rate, [nearer, _]) = at(&poses[1]);
        let (time, end) = if rate > 0.0 { (-0.5, &poses[0]) } else { (0.5, &poses[2]) };
        let (last, last_rate, [_, last_nearer]) = at(end);
        // Share of the plane at the middle: none if the part comes nearer up to the end, all if it stands still in the middle.
        let turns_back = (rate > 0.0) != (last_rate > 0.0);
        let share = if turns_back { last_rate / (last_rate - rate) } else { 0.0 };
        let both = |a: f64, b: f64| share * a + (1.0 - share) * b;
        // At the end the rate lets the gauge rise from there; else both rates together come to nothing.
        let value = both(middle.value, if share > 0.0 { last.value - last_rate * time } else { last.value });
        // What is beside the centre may come nearer by so much more.
        let beside = radius * self.task.poses.nearer_by_way();
        let slack = both(0.5, 1.0) * radius * self.turn() + both(nearer, last_nearer) + beside;
        let wide = 0.5 * (rate.abs() + radius * self.turn) + nearer + beside;
        let likely = -value;
        if slack - value < wide - middle.value {
            let normal = middle.normal * share + last.normal * (1.0 - share);
            Tangent { normal, reach: slack - value, likely }
        } else {
            Tangent { normal: middle.normal, reach: wide - middle.value, likely }
        }
    }

    /// How fast the tool turns at most [rad by the span's parameter].
    fn turn(&self) -> f64 {
        self.task.poses.rates[1]
    }

    /// The bend of the way that a part takes past what is near a place, seen from the tool [mm].
    fn bend(&self, centre: DVec3, radius: f64) -> f64 {
        let [tip, by_reach] = self.bends;
        let reach = centre.distance(self.middle.tip) + radius + 2.0 * self.part.r1;
        tip + by_reach * reach
    }

    /// True if a stretch of a line lies within the part at the start, the middle or the end.
    pub(super) fn holds(&self, ends: [DVec3; 2]) -> bool {
        let within = |pose: &Pose| ends.iter().all(|end| gauge_at(self.part, pose, *end).value < -WITHIN);
        self.task.poses.poses.iter().any(within)
    }

    /// True if the cell lies within the part at the start, the middle or the end.
    pub(super) fn swallows(&self, cell: &Cell) -> bool {
        let within = |pose: &Pose| gauge_at(self.part, pose, cell.centre).value < -cell.radius - WITHIN;
        self.task.poses.poses.iter().any(within)
    }
}

/// Tip and axis of a span as cubics, and what their way is bent by.
fn way(poses: &SpanPoses) -> [f64; WAY] {
    let ([[a, b, c, d], [e, f, g, h]], [bend, by_reach]) = (poses.span.cubics(), poses.unsteady);
    let [way, turns] = poses.rates;
    [
        a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z, e.x, e.y, e.z, f.x, f.y, f.z, g.x, g.y,
        g.z, h.x, h.y, h.z, bend, by_reach, way, turns,
    ]
}

#[cfg(test)]
mod tests {
    use super::super::super::super::body::Foot;
    use super::super::super::super::{CutList, CutMove, CutOptions, ToolBody};
    use super::super::super::task::Batch;
    use super::super::about::about;
    use super::super::away::AwayBounds;
    use super::super::bundle::{Bundle, Shape};
    use super::super::cells::Cells;
    use super::super::lanes::put;
    use super::super::places::Places;
    use super::*;
    use crate::geom::{Arc, Curve, Line, Profile};
    use crate::stock::{DexelGrid, TriDexel};
    use crate::sweep::ToolMotion;
    use pulp::Arch;

    /// Numbers in [0, 1) that leave no place out.
    fn spread(n: u32, k: usize) -> f64 {
        let [a, b, c] = [0.819_172_513, 0.671_043_607, 0.549_700_478];
        (f64::from(n) * [a, b, c][k]).fract()
    }

    /// Lines along the edges of a cell, from either end, that are told to be missed: at no time is one of their places in the part.
    fn sift(swept: &SweptPart, cell: &Cell, n: u32) -> usize {
        let mut missed = 0;
        for k in 0..3 {
            let start = cell.low + (cell.high - cell.low) * spread(n, k);
            let mut ends = [start; 2];
            (ends[0][k], ends[1][k]) = (cell.low[k], cell.high[k]);
            for ends in [ends, [ends[1], ends[0]]] {
                if !(AwayBounds::default().bounds(std::iter::once((swept, ends)))[0] > 0.0) {
                    continue;
                }
                missed += 1;
                for i in 0..200 {
                    let place = ends[0] + (ends[1] - ends[0]) * (f64::from(i % 14) / 13.0);
                    let pose = swept.task.poses.span.at(f64::from(i) / 199.0 - 0.5);
                    assert!(gauge_at(swept.part, &pose, place).value > -1e-9, "{ends:?}");
                }
            }
        }
        missed
    }

    /// Distances of planes from what they bound [mm]: the least, over all poses and all places of cells that a tool holds; how many those
    /// are, and how many lines are missed.
    fn least_room(motion: &ToolMotion, curve: Curve, profile: &Profile) -> (f64, usize, usize) {
        let bounds = Aabb { min: DVec3::splat(-8.0), max: DVec3::splat(8.0) };
        let stock = TriDexel::from_box(bounds, 0.25).unwrap();
        let options = CutOptions::default();
        let bodies = [ToolBody::new(profile.clone())];
        let moves = vec![CutMove::leaning(motion.clone(), curve, 0)];
        let list = CutList::new(&bodies, moves, &options, 0.25).unwrap();
        let batch = Batch::new((stock.lattice(), stock.bounds()), &list, 0..1);
        let cells = Cells::new(&stock);
        let (mut least, mut held, mut sifted) = (f64::INFINITY, 0, 0);
        for (task, part) in batch.tasks.iter().flat_map(|t| t.tool.cutting.parts.iter().map(move |p| (t, p)))
        {
            let swept = SweptPart::new(task, part, 0);
            for (n, size) in (0..60).flat_map(|n| [16, 4].map(|size| (n, size))) {
                let first = [0, 1, 2].map(|k| (spread(n, k) * 64.0 / f64::from(size)) as u32 * size);
                // Those in the middle are where moves through the middle are nearest in the middle of their time.
                let first = if n % 3 == 0 { [first[0], 32 - size / 2, first[2]] } else { first };
                let cell = cells.cell(first, size);
                let mut bundle = Bundle::default();
                bundle.fill(std::slice::from_ref(&swept), &[0]);
                bundle.ask(std::slice::from_ref(&swept), cell.centre, cell.radius);
                let reach = swept.reach(cell.centre, cell.radius);
                assert!((bundle.reaches[0] - reach).abs() < 1e-9 || matches!(part.foot, Foot::Flat));
                let planes = [swept.tangent(cell.centre, cell.radius), swept.tangent_closely(&cell)];
                let shape = Shape::of(part).unwrap();
                let mut ways = [[0.0; LANES]; WAY];
                put(&mut ways, 3, &swept);
                let about = about(Arch::default(), shape, &ways, cell.centre.to_array(), cell.radius);
                let beside = Beside::of(&about, 3);
                let mut places = Places::default();
                places.add(5, [cell.centre.x, cell.centre.y, cell.centre.z, cell.radius]);
                places.ask(&swept);
                let mut is_near = false;
                places.each_reached(&mut |_, bound| {
                    is_near = true;
                    assert!((bound - reach).abs() < 1e-9 || matches!(part.foot, Foot::Flat));
                });
                sifted += sift(&swept, &cell, n);
                for i in 0..400 {
                    let at = DVec3::from_array([0, 1, 2].map(|k| spread(i, k)));
                    let point = cell.low + (cell.high - cell.low) * at;
                    let pose = task.poses.span.at(f64::from(i % 41) / 40.0 - 0.5);
                    if gauge_at(part, &pose, point).value > 0.0 {
                        continue;
                    }
                    held += 1;
                    assert!(reach >= -cell.radius && bundle.reaches[0] >= -cell.radius);
                    assert!(is_near);
                    least = least.min(beside.reach - beside.normal.dot(point - cell.centre));
                    for plane in planes {
                        least = least.min(plane.reach - plane.normal.dot(point - cell.centre));
                    }
                }
            }
        }
        (least, held, sifted)
    }

    #[test]
    fn a_part_stays_behind_its_planes() {
        let axis = DVec3::new(0.4, 0.0, 1.0);
        for profile in [
            Profile::bull_nose(6.0, 3.0, 12.0).unwrap(),
            Profile::bull_nose(6.0, 1.0, 12.0).unwrap(),
            Profile::cylinder(5.0, 12.0).unwrap(),
        ] {
            // Straight across the middle of cells, aslant, turning, and round.
            let level = Line { start: DVec3::new(0.3, -1.0, 1.0), end: DVec3::new(0.3, 1.0, 1.0) };
            let aslant = Line { start: DVec3::new(-3.0, -2.0, 2.0), end: DVec3::new(3.0, 1.5, -1.0) };
            let round =
                Arc::new(DVec3::new(2.0, 0.0, 0.5), DVec3::new(-1.0, 0.0, 0.0), DVec3::Z, 3.0, 0.5).unwrap();
            let motions = [
                (ToolMotion::fixed(level.into(), axis).unwrap(), Curve::from(level)),
                (ToolMotion::fixed(aslant.into(), axis).unwrap(), aslant.into()),
                (
                    ToolMotion::between(aslant.into(), axis, DVec3::new(-0.5, 0.8, 0.6)).unwrap(),
                    aslant.into(),
                ),
                (ToolMotion::fixed(round.into(), axis).unwrap(), round.into()),
            ];
            for (motion, curve) in motions {
                let (least, held, sifted) = least_room(&motion, curve.clone(), &profile);
                assert!(sifted > 100, "{profile:?} {curve:?} {sifted}");
                assert!(held > 1000 && least > -1e-9, "{profile:?} {curve:?} {held} {least}");
            }
        }
    }
}
