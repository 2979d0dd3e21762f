//! The way of a tool in short stretches, and the moment at which it comes to a point.

use std::borrow::Cow;

use glam::DVec3;

use super::Stance;
use super::body::{ConvexPart, Foot, RevolvedParts, bounds};
use super::fixed_way::FixedWay;
use super::leaning::{Pose, PoseSpan, spans};
use super::list::CutList;
use crate::base::Result;
use crate::geom::Aabb;
use crate::sweep::ToolMotion;

/// Travel of a tool in a stretch as a part of the least radius of its parts.
const TRAVEL: f64 = 0.5;
/// Least travel of a tool in a stretch [mm].
const LEAST_TRAVEL: f64 = 0.05;
/// Places of a move at which its speed is looked at.
const SPEEDS: u32 = 16;
/// Most by which a point may lie outside of a tool that holds it: rounding of ends [mm].
const ROUNDING: f64 = 3e-5;
/// Room about what a stretch sweeps in which a point that is cut may lie: rounding of what was cut [mm].
const SLACK: f64 = 0.01;
/// Looks for the time at which a tool is nearest to a point.
const LOOKS: u32 = 12;
/// Looks for the time at which it comes there.
const MOST_LOOKS: u32 = 24;

/// The way of a tool along a move.
#[derive(Debug)]
pub(super) struct ToolWay<'a> {
    motion: Cow<'a, ToolMotion>,
    pub(super) body: &'a RevolvedParts,
    /// Distance of the farthest point of the tool from its tip [mm], at most.
    reach: f64,
    /// Travel of the tool in a stretch that is not straight [mm].
    travel: f64,
    /// The way, where the moment at which the tool comes to a point has a closed form.
    fixed: Option<FixedWay>,
}

/// A stretch of the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct WaySpan {
    span: PoseSpan,
    /// The tool in the middle.
    middle: Pose,
    /// A box about all that it sweeps.
    swept: Aabb,
    /// Most that a point of the tool moves from its place in the middle [mm].
    stray: f64,
    /// Greatest speed of a point of the tool [mm by the parameter of the stretch].
    speed: f64,
    /// Square of the distance from the axis in the middle beyond which nothing is swept [mm^2].
    far: f64,
}

impl WaySpan {
    /// Whether it may reach a point.
    pub(super) fn may_hold(&self, point: DVec3) -> bool {
        self.swept.min.cmple(point).all() && point.cmple(self.swept.max).all()
    }

    /// Whether it may reach into a box.
    pub(super) fn meets(&self, region: Aabb) -> bool {
        self.swept.meets(region)
    }
}

/// A tool as it comes to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coming {
    pub(super) pose: Pose,
    /// Fraction of the move.
    pub(super) at: f64,
    /// Length of the stretch in fractions of the move, in which rates are given.
    pub(super) span: f64,
    /// The part that comes first.
    pub(super) part: usize,
}

impl<'a> ToolWay<'a> {
    /// The way of a move.
    pub(super) fn of_move(list: &'a CutList, index: usize) -> Result<ToolWay<'a>> {
        let one = &list.moves[index];
        let motion = match &one.stance {
            Stance::Leaning(motion) => Cow::Borrowed(&**motion),
            Stance::Along(axis) => Cow::Owned(ToolMotion::fixed(one.curve.clone(), axis.vector())?),
        };
        Ok(ToolWay::new(motion, &list.tools[one.body as usize].cutting))
    }

    fn new(motion: Cow<'a, ToolMotion>, body: &'a RevolvedParts) -> ToolWay<'a> {
        let thinnest = body.parts.iter().map(|part| part.r1).fold(f64::INFINITY, f64::min);
        let travel = (TRAVEL * thinnest).max(LEAST_TRAVEL);
        let fixed = FixedWay::of(&motion);
        ToolWay { motion, body, reach: body.radius + body.top.max(-body.bottom), travel, fixed }
    }

    /// Length of the way of the point that goes farthest [mm], about.
    pub(super) fn length(&self) -> f64 {
        let speed = |k: u32| self.motion.speed((f64::from(k) + 0.5) / f64::from(SPEEDS), self.reach);
        (0..SPEEDS).map(speed).sum::<f64>() / f64::from(SPEEDS)
    }

    /// Whether [`ToolWay::coming`] needs no stretches.
    pub(super) fn is_closed(&self) -> bool {
        self.fixed.is_some()
    }

    /// The stretches in order that may reach into a box.
    pub(super) fn near(&self, region: Aabb) -> Vec<WaySpan> {
        let swept = |pose: (DVec3, DVec3)| bounds(pose.0, pose.1, &[self.body]);
        let is_far = |ends: [crate::geom::Rigid; 2], off: f64| {
            let [from, to] = ends.map(|pose| swept((pose.translation, pose.rotation.z_axis)));
            !from.union(to).grown(off + ROUNDING).meets(region)
        };
        let (spans, _) = spans(&self.motion, self.reach, self.travel, is_far);
        let one = |span: PoseSpan| {
            let (stray, middle) = (span.stray(self.reach), span.at(0.0));
            // Each point of the tool goes nearly straight from its place at the start to that at the end: no farther from the line
            // between them than twice its bend, and the sagitta of the turn about the axis.
            let off = 2.0 * span.bend(self.reach) + 0.125 * span.turn().powi(2) * self.body.radius;
            let [start, end] = [-0.5, 0.5].map(|t| span.at(t)).map(|pose| swept((pose.tip, pose.axis)));
            let swept = start.union(end).grown(off + SLACK);
            let speed = 2.0 * stray + 4.0 * span.bend(self.reach);
            WaySpan { span, middle, swept, stray, speed, far: (self.body.radius + stray + ROUNDING).powi(2) }
        };
        spans.into_iter().map(one).filter(|own| own.meets(region)).collect()
    }

    /// The tool as it first comes to a point in some stretches, or as it comes nearest to it; `short`: part of a stretch up to which the
    /// moment is looked for.
    pub(super) fn coming<'s>(
        &self,
        near: impl Iterator<Item = &'s WaySpan>,
        point: DVec3,
        short: f64,
    ) -> Option<Coming> {
        let Some(fixed) = &self.fixed else { return self.coming_on(near, point, short) };
        match fixed.first(&self.body.parts, point, ROUNDING) {
            Some((t, part)) => Some(Coming { pose: fixed.pose(t), at: t, span: 1.0, part }),
            // Beside the tool by more than rounding: as it comes nearest.
            None => {
                let own = self.near(Aabb { min: point, max: point }.grown(SLACK));
                self.coming_on(own.iter(), point, short)
            }
        }
    }

    /// The same by looking along stretches.
    fn coming_on<'s>(
        &self,
        near: impl Iterator<Item = &'s WaySpan>,
        point: DVec3,
        short: f64,
    ) -> Option<Coming> {
        let mut nearest: Option<(f64, Coming)> = None;
        for own @ WaySpan { span, middle, stray, speed, far, .. } in near {
            if !own.may_hold(point) {
                continue;
            }
            let from_tip = point - middle.tip;
            if from_tip.length_squared() - from_tip.dot(middle.axis).powi(2) > *far {
                continue;
            }
            let off = |t: f64| self.outside(&span.at(t), point);
            let [from, to] = span.fractions;
            let coming = |t: f64, part: usize| Coming {
                pose: span.at(t),
                at: span.fraction(t),
                span: to - from,
                part,
            };
            let middle = self.outside(middle, point);
            if middle.0 > stray + ROUNDING {
                continue;
            }
            let start = off(-0.5);
            if start.0 <= ROUNDING {
                return Some(coming(-0.5, start.1));
            }
            // A moment that is known to be in the tool, else the one that is nearest to it.
            let (t, (least, part)) =
                if middle.0 <= ROUNDING { (0.0, middle) } else { held(off, [start, middle], *speed) };
            if nearest.is_none_or(|(known, _)| least < known) {
                nearest = Some((least, coming(t, part)));
            }
            if least <= ROUNDING {
                let (t, part) = begins(off, start.0, (t, least, part), short);
                return Some(coming(t, part));
            }
        }
        nearest.map(|(_, coming)| coming)
    }

    /// By how far a point is outside of the tool [mm], at most; below zero inside; and the part that is nearest.
    fn outside(&self, pose: &Pose, point: DVec3) -> (f64, usize) {
        let from_tip = point - pose.tip;
        let z = from_tip.dot(pose.axis);
        let rho = (from_tip - pose.axis * z).length();
        let mut least = (f64::INFINITY, 0);
        for (i, part) in self.body.parts.iter().enumerate() {
            let by = outside(part, rho, z);
            if by < least.0 {
                least = (by, i);
            }
        }
        least
    }
}

/// A moment of a stretch at which a tool holds a point that it does not at its start and in its middle, or the moment at which it is
/// nearest; with how far the point then is outside, and the part.
fn held(
    off: impl Fn(f64) -> (f64, usize),
    [start, middle]: [(f64, usize); 2],
    speed: f64,
) -> (f64, (f64, usize)) {
    let end = off(0.5);
    let ends = [(-0.5, start), (0.0, middle), (0.5, end)];
    let mut best = if end.0 < middle.0 { ends[2] } else { ends[1] };
    for pair in ends.windows(2) {
        if best.1.0 <= ROUNDING {
            continue;
        }
        let (mut low, mut high) = ((pair[0].0, pair[0].1.0), (pair[1].0, pair[1].1.0));
        for _ in 0..LOOKS {
            let width = high.0 - low.0;
            // So near no point of the tool can come between the two moments.
            if 0.5 * (low.1 + high.1 - speed * width) > ROUNDING {
                break;
            }
            let (a, b) = (low.0 + 0.382 * width, low.0 + 0.618 * width);
            let [at_a, at_b] = [off(a), off(b)];
            for found in [(a, at_a), (b, at_b)] {
                if found.1.0 < best.1.0 {
                    best = found;
                }
            }
            if at_a.0 <= at_b.0 { high = (b, at_b.0) } else { low = (a, at_a.0) }
        }
    }
    best
}

/// The moment at which a tool comes to a point that is outside by `by` at the start of the stretch and inside at a later moment, by false
/// position (the Illinois rule); with the part.
fn begins(
    off: impl Fn(f64) -> (f64, usize),
    by: f64,
    (t, least, part): (f64, f64, usize),
    short: f64,
) -> (f64, usize) {
    let (mut out, mut held, mut part) = ((-0.5, by - ROUNDING), (t, least - ROUNDING), part);
    let mut last = 0;
    for look in 0..MOST_LOOKS {
        if held.0 - out.0 < short {
            break;
        }
        // A little beyond the expected place, so that both ends come near. The later moment may be one at which the tool leaves the point.
        let share = if look % 3 == 2 { 0.5 } else { (out.1 / (out.1 - held.1) + 0.01).clamp(0.02, 0.98) };
        let t = out.0 + (held.0 - out.0) * share;
        match off(t) {
            (by, first) if by <= ROUNDING => {
                (held, part) = ((t, by - ROUNDING), first);
                if last == 1 {
                    out.1 *= 0.5;
                }
                last = 1;
            }
            (by, _) => {
                out = (t, by - ROUNDING);
                if last == 2 {
                    held.1 *= 0.5;
                }
                last = 2;
            }
        }
    }
    (held.0, part)
}

/// By how far a point at a distance from the axis and a height is outside of a part [mm]: no more than it is.
fn outside(part: &ConvexPart, rho: f64, z: f64) -> f64 {
    let sides = (part.z0 - z).max(z - part.top).max(rho - part.r1);
    let foot = match part.foot {
        Foot::Flat => f64::NEG_INFINITY,
        Foot::Cone { rise } => (rise * (rho - part.r0) - (z - part.z0)) / rise.hypot(1.0),
        Foot::Torus { centre_radius, centre_z, radius } if z < centre_z && rho > centre_radius => {
            (rho - centre_radius).hypot(z - centre_z) - radius
        }
        Foot::Torus { .. } => f64::NEG_INFINITY,
    };
    sides.max(foot)
}
