//! A stretch of a line and a stretch of a move: the box of both is divided until the tool is seen to be met or not.

use glam::DVec3;

use super::gauge::{Gauge, GaugePart, Gauges};
use super::moment::{Moment, ROOM};
use super::{GAP, Task};

/// Stretches of a move whose moments are kept, in halvings.
const KEPT: u32 = 7;

/// Size below which a box is no longer divided [mm].
const SMALLEST: f64 = GAP / 16.0;

/// Sums over boxes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Checked {
    /// Greatest depth in a part down to which material may be left [mm].
    pub(super) gap: f64,
    /// Stretches in which a tool was met, and its greatest depth there.
    pub(super) taken: usize,
    pub(super) deepest: f64,
    /// Boxes that were bounded.
    pub(super) boxes: u64,
}

impl Checked {
    pub(super) fn add(&mut self, other: &Checked) {
        self.gap = self.gap.max(other.gap);
        self.taken += other.taken;
        self.deepest = self.deepest.max(other.deepest);
        self.boxes += other.boxes;
    }
}

/// A stretch of a move by the number of its halvings and its place among them, as the node of a heap: 1 is the move,
/// `2 n` and `2 n + 1` the halves of `n`.
pub(super) type Node = u64;

/// The moments of one move that were asked for.
pub(super) struct Moments<'a> {
    pub(super) task: &'a Task<'a>,
    kept: Vec<Option<Moment>>,
}

impl<'a> Moments<'a> {
    pub(super) fn of(task: &'a Task<'a>) -> Moments<'a> {
        Moments { task, kept: vec![None; 1 << KEPT] }
    }

    /// The moment at the middle of a stretch.
    pub(super) fn at(&mut self, node: Node) -> Moment {
        let depth = 63 - node.leading_zeros();
        let width = 1.0 / (1u64 << depth) as f64;
        let from = (node - (1 << depth)) as f64 * width;
        let make = || Moment::of(&self.task.motion, [from, from + width], self.task.tool.reach);
        match self.kept.get_mut(node as usize) {
            Some(kept) => *kept.get_or_insert_with(make),
            None => make(),
        }
    }
}

/// True if a ball is nearer to the tool than bounds of a moment hold, so that box or move have to be divided before.
pub(super) fn is_wide(tool: &Gauges, moment: &Moment, radius: f64) -> bool {
    moment.travel + radius > (ROOM - 1.0) * 0.5 * tool.reach
}

/// True if a ball about a point stays outside of a tool, its faces moved inwards by the gap, on a whole stretch of its move.
pub(super) fn stays_out(tool: &Gauges, moment: &Moment, centre: DVec3, radius: f64) -> bool {
    let seen = moment.see(centre);
    if seen.x.length() > tool.reach + moment.travel + radius {
        return true;
    }
    if is_wide(tool, moment, radius) {
        return false;
    }
    tool.parts.iter().all(|part| {
        let Gauge { value, normal } = part.at(seen.x);
        value - normal.dot(seen.way).abs() - moment.stray - radius * (1.0 + moment.turn) >= -GAP
    })
}

/// A place of a line at a time at which a part is met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) s: f64,
    pub(super) t: f64,
    pub(super) depth: f64,
}

/// A line along a coordinate of the stock through a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// Its point at the coordinate 0.
    pub(super) start: DVec3,
    pub(super) along: usize,
}

impl Ray {
    pub(super) fn point(&self, s: f64) -> DVec3 {
        let mut p = self.start;
        p[self.along] += s;
        p
    }
}

/// Looks for a part, its faces moved inwards by the gap, in a stretch of a line during a stretch of its move: where it is deepest
/// there, to within a quarter of the gap.
pub(super) fn meets(
    ray: &Ray,
    stretch: [f64; 2],
    part: &GaugePart,
    moments: &mut Moments,
    node: Node,
    sums: &mut Checked,
) -> Option<Met> {
    let mut open = vec![(stretch, node)];
    let mut deepest: Option<Met> = None;
    while let Some(([from, to], node)) = open.pop() {
        let moment = moments.at(node);
        let (s, half) = (0.5 * (from + to), 0.5 * (to - from));
        let reach = moments.task.tool.reach;
        let seen = moment.see(ray.point(s));
        sums.boxes += 1;
        if seen.x.length() > reach + moment.travel + half {
            continue;
        }
        let smallest = moment.travel + half < SMALLEST;
        if !is_wide(moments.task.tool, &moment, half) || smallest {
            let Gauge { value, normal } = part.at(seen.x);
            let counts = deepest.map_or(GAP, |met| met.depth + 0.25 * GAP);
            if -value > counts {
                deepest = Some(Met { s, t: moment.t, depth: -value });
                open.push(([from, to], node));
                continue;
            }
            let along = normal.dot(moment.direction(DVec3::AXES[ray.along])).abs() * half;
            let least = value - along - normal.dot(seen.way).abs() - moment.stray - half * moment.turn;
            if -least <= counts || smallest {
                // Where the part is met the stretch is taken out, and the rest looked through again.
                if deepest.is_none() {
                    sums.gap = sums.gap.max(-least);
                }
                continue;
            }
        }
        if half > moment.travel {
            open.push(([s, to], node));
            open.push(([from, s], node));
        } else {
            open.push(([from, to], 2 * node + 1));
            open.push(([from, to], 2 * node));
        }
    }
    deepest
}

/// The stretch of a line inside a part at a time, with the normals of the part there [stock coordinates]; `s` lies inside.
pub(super) fn chord(ray: &Ray, part: &GaugePart, task: &Task, met: &Met) -> ([f64; 2], [DVec3; 2]) {
    let pose = task.motion.pose(met.t);
    let gauge = |s: f64| part.at(pose.rotation.transpose() * (ray.point(s) - pose.translation));
    let end = |sign: f64| {
        let (mut inside, mut outside) = (met.s, met.s + sign * 4.0 * task.tool.reach);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if gauge(middle).value < 0.0 {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        (inside, pose.rotation * -gauge(outside).normal)
    };
    let (lo, hi) = (end(-1.0), end(1.0));
    ([lo.0, hi.0], [lo.1, hi.1])
}
