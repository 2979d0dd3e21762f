//! A pass: the way on which the cutter keeps its engagement.

use std::f64::consts::PI;

use glam::DVec2;

use super::region::CentreRegion;
use super::swept::{Clearing, Scratch};
use crate::num::angle::wrap;

/// Length of a step, in radii of the cutter.
const STEP: f64 = 0.05;
/// Longest step [mm].
const LONGEST: f64 = 0.5;
/// Turn of a step from which smaller steps are made [rad], and the smallest step, in whole ones.
const TURN: f64 = 0.1;
const SHORTEST: f64 = 0.1;
/// Least radius of a turn to the right, towards the stock, in radii of the cutter.
const RIGHT_TURN: f64 = 0.5;
/// Farthest turn to the left in one step [rad].
const LEFT_TURN: f64 = 0.75 * PI;
/// Engagement below which the cutter is in the air [rad].
const AIR: f64 = 3.0 / 180.0 * PI;
/// Way through the air after which a pass ends, in radii of the cutter.
const AIR_WAY: f64 = 0.8;
/// Excess over the wanted engagement that a step may have [rad].
const ABOVE: f64 = 2e-4;
/// Lack of engagement with which a step is good [rad].
const BELOW: f64 = 1e-3;
/// Most trials of a step.
const TRIALS: usize = 14;
/// Excess with which a pass goes on where no way has less [rad].
const STUCK: f64 = 1e-6;
/// Grid on which the points [mm] and headings [rad] of a way lie. Each step hangs on all before it: without a grid the last
/// bit of a sine, which may differ between machines and builds, has grown to another way a few passes later.
const GRID: f64 = 1.0 / (1 << 20) as f64;

/// A way of the cutter's centre, point by point.
#[derive(Clone, Debug, Default)]
pub(super) struct Way {
    pub(super) points: Vec<DVec2>,
    /// Length of the way on which the cutter cuts [mm].
    pub(super) cutting: f64,
    /// Largest engagement at a point [rad].
    pub(super) largest: f64,
}

/// A cutter on its way.
pub(super) struct Walker<'a> {
    pub(super) region: &'a CentreRegion,
    pub(super) clearing: &'a mut Clearing,
    /// Radius of the cutter [mm].
    pub(super) radius: f64,
    /// Engagement that is kept [rad].
    pub(super) wanted: f64,
    pub(super) work: &'a mut Scratch,
}

fn on_grid(value: f64) -> f64 {
    (value / GRID).round() * GRID
}

/// A point on the grid of the points of ways.
pub(super) fn point_on_grid(p: DVec2) -> DVec2 {
    DVec2::new(on_grid(p.x), on_grid(p.y))
}

/// Step of the walk for a cutter's radius [mm].
pub(super) fn step_of(radius: f64) -> f64 {
    (STEP * radius).min(LONGEST)
}

impl Walker<'_> {
    /// From a point with a first heading [rad], with the stock on the right, until the cutter is in the air; `most`: steps.
    pub(super) fn pass(&mut self, start: DVec2, heading: f64, most: usize) -> Way {
        let step = step_of(self.radius);
        let sharpest = -2.0 * (0.5 * step / (RIGHT_TURN * self.radius)).asin();
        // The start itself stays: the way to it ends there.
        let mut way = Way { points: vec![start], ..Way::default() };
        let (mut at, mut heading, mut bend) = (start, on_grid(heading), 0.0_f64);
        let mut air = 0.0;
        let mut solid = 1;
        // Steps in the air, swept only when the pass goes on: its end in the air is not run.
        let mut held: Vec<[DVec2; 2]> = Vec::new();
        while way.points.len() < most {
            // Where the way turns much, by smaller steps.
            let mut share = 1.0;
            let mut found = self.step(at, heading, bend, sharpest, step);
            while share > SHORTEST && found.is_some_and(|(_, along, _)| wrap(along - heading).abs() > TURN) {
                share *= 0.5;
                found = self.step(at, heading, bend * share, sharpest * share, step * share).or(found);
            }
            let Some((next, along, engaged)) = found else { break };
            let length = at.distance(next);
            if length < 0.1 * step * share {
                break;
            }
            way.points.push(next);
            way.largest = way.largest.max(engaged);
            held.push([at, next]);
            if engaged < AIR {
                air += length;
                if air > AIR_WAY * self.radius {
                    break;
                }
            } else {
                air = 0.0;
                way.cutting += length;
                solid = way.points.len();
                for [from, to] in held.drain(..) {
                    self.clearing.sweep(from, to, self.radius);
                }
            }
            bend = wrap(along - heading) / share;
            (at, heading) = (next, along);
        }
        way.points.truncate(solid);
        way
    }

    /// The farthest point to the right that the wanted engagement allows: point, heading, engagement there.
    fn step(
        &mut self,
        at: DVec2,
        heading: f64,
        bend: f64,
        sharpest: f64,
        step: f64,
    ) -> Option<(DVec2, f64, f64)> {
        let room = self.region.room_within(at, step);
        let wanted = self.wanted;
        let mut look = |turn: f64| {
            let mut along = heading + on_grid(turn);
            let mut next = point_on_grid(at + step * DVec2::from_angle(along));
            if room < step {
                let inside = self.region.nearest_inside(next);
                if inside != next {
                    let ahead = inside - at;
                    if ahead.dot(DVec2::from_angle(along)) < 0.3 * step {
                        return (next, along, f64::INFINITY);
                    }
                    next = point_on_grid(inside);
                    along = heading + on_grid(wrap(ahead.to_angle() - heading));
                }
            }
            // The way turns on as it has turned: half of it belongs to this point. To the left, where that cuts less, no more
            // than it has turned before.
            let turned = along - heading;
            let lean = 0.5 * turned.min(if bend > 0.0 { bend } else { 0.0 }).clamp(-0.1, 0.1);
            let engaged = self.clearing.engaged(next, along + lean, self.radius, self.work).total;
            (next, along, engaged)
        };
        let mut bad = sharpest;
        let mut good: Option<(f64, (DVec2, f64, f64))> = None;
        let mut turn = bend.clamp(sharpest, LEFT_TURN);
        for trial in 0..TRIALS {
            let found = look(turn);
            let excess = found.2 - wanted;
            if excess <= ABOVE {
                good = Some((turn, found));
                if excess >= -BELOW || turn <= sharpest || turn - bad < 1e-5 && trial > 0 {
                    break;
                }
            } else {
                bad = turn;
            }
            // The heading counts for nearly all of a change of the engagement.
            let guess = turn + excess.clamp(-1.0, 1.0) / 1.06 + 0.5 * ABOVE;
            let high = good.map_or(LEFT_TURN, |(turn, _)| turn);
            turn = match trial {
                0 if excess < 0.0 && found.2 < AIR => sharpest,
                0..=4 if guess > bad && guess < high => guess,
                0..=4 if excess < 0.0 && guess <= sharpest => sharpest,
                _ => match good {
                    Some((turn, _)) => 0.5 * (bad + turn),
                    None => (bad + 0.25).min(LEFT_TURN),
                },
            };
            if good.is_none() && bad >= LEFT_TURN {
                break;
            }
        }
        good.map(|(_, found)| found).filter(|found| found.2 <= wanted + ABOVE + STUCK)
    }
}
