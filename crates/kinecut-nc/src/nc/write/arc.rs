//! Arcs and helices in numbers of limited resolution.
//!
//! All is decided on the rounded numbers, in steps of the resolution, so that writing what was read decides alike:
//! 1. start and end are rounded, the exact centre is moved onto their bisector;
//! 2. the centre is rounded so that the bisector passes as near as the grid allows: the coordinate along which the
//!    bisector runs is rounded, the other follows from the bisector;
//! 3. an arc flatter than a quarter of a step becomes a line; one that the control could take for another arc
//!    (small against the resolution) becomes short lines. So a short arc never becomes a full circle.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::base::Result;
use crate::geom::{Arc, Curve};
use crate::nc::arc_fit::fit;
use crate::nc::dialect::{OFFSETS, Plane};
use crate::nc::grid::LARGEST;
use crate::program::Speed;

use super::{Writer, unsupported};

/// An arc flatter than this is written as a line [steps]: half the error of rounding.
pub(super) const FLAT: f64 = 0.25;
/// Largest difference between an arc and its rounded form along the path [steps]: the rounding of two ends and a
/// centre explains less than 4.
const ALIKE: f64 = 8.0;
/// Largest difference of angle between the arc from the written centre and from the moved one [rad]: beyond it the
/// resolution is too coarse for this arc, and a control that takes the written centre could turn the other way.
const SAME_SENSE: f64 = 0.5;
/// Largest difference of the radii at start and end [steps].
const ROUND: f64 = 2.0;
/// Least radius [steps]: below it the rounded centre may fall on an end.
const LEAST_RADIUS: f64 = 4.0;
/// Least radius [mm]: LinuxCNC takes less than 0.00127 mm for zero and stops.
const LEAST_RADIUS_MM: f64 = 0.0015;
/// Largest distance of the fitted centre from the exact one, for an arc of more than half a turn [steps]: where the
/// ends lie close together, their rounding turns the bisector, and with it the far side of the arc. Rounding alone
/// explains 1.3.
const SHIFT: f64 = 1.5;
/// Chord error of the lines that replace an arc [steps].
pub(super) const CHORD: f64 = 0.5;
/// Rise of the axis of an upright arc: rounding of unit vectors.
const LEVEL: f64 = 1e-9;
/// Cosine between an arc's axis and a machine axis from which they are parallel: rounding of unit vectors.
const PARALLEL: f64 = 1.0 - 1e-9;

/// An arc in steps relative to its start, as the words say it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rounded {
    /// Too flat or too small.
    Straight,
    /// Centre offset, further whole turns.
    Arc { centre: [i64; 2], turns: u32, difference: f64 },
    /// Representable only by short lines.
    Chords,
    /// In one block the far side would lie off: whole turns first, then halves.
    Split { turns: u32 },
}

/// Rounds an arc: `end` and `centre` relative to the start [steps], `sweep` signed [rad], `least_radius`
/// [steps].
pub(super) fn round(end: [i64; 2], centre: DVec2, sweep: f64, least_radius: f64) -> Rounded {
    let ccw = sweep >= 0.0;
    let goal = DVec2::new(end[0] as f64, end[1] as f64);
    let offset = if end == [0, 0] {
        centre.round()
    } else {
        let (on, _) = fit(DVec2::ZERO, goal, centre, ccw);
        let middle = 0.5 * goal;
        if goal.x.abs() >= goal.y.abs() {
            let y = on.y.round();
            DVec2::new((middle.x - (y - middle.y) * goal.y / goal.x).round(), y)
        } else {
            let x = on.x.round();
            DVec2::new(x, (middle.y - (x - middle.x) * goal.x / goal.y).round())
        }
    };
    let (moved, turned) = fit(DVec2::ZERO, goal, offset, ccw);
    let turned = turned.abs();
    let turns = ((sweep.abs() - turned) / TAU).round();
    let radius = moved.length();
    let (r1, r2) = (offset.length(), (goal - offset).length());
    if turns < 0.0 || r1 < least_radius || r2 < least_radius {
        return Rounded::Chords;
    }
    if turns == 0.0 && turned < PI && radius * (1.0 - (0.5 * turned).cos()) < FLAT {
        return Rounded::Straight;
    }
    let along = (sweep.abs() - turned - TAU * turns).abs() * radius;
    let seen = if end == [0, 0] { turned } else { control_angle(goal, offset, ccw) };
    if (turns > 0.0 || turned > PI) && (moved - centre).length() > SHIFT {
        return Rounded::Split { turns: turns as u32 };
    }
    if along > ALIKE || (r1 - r2).abs() > ROUND || (seen - turned).abs() > SAME_SENSE {
        return Rounded::Chords;
    }
    Rounded::Arc {
        centre: [offset.x as i64, offset.y as i64],
        turns: turns as u32,
        difference: (r1 - r2).abs(),
    }
}

/// The angle that a control finds that does not move the centre [rad].
fn control_angle(goal: DVec2, centre: DVec2, ccw: bool) -> f64 {
    let between = (-centre).angle_to(goal - centre);
    (if ccw { between } else { -between }).rem_euclid(TAU)
}

impl Writer<'_> {
    /// An arc or helix that ends at `point`.
    pub(super) fn arc(&mut self, arc: &Arc, point: DVec3, speed: Speed) -> Result<()> {
        // Turned coordinates may have turned its plane.
        if arc.axis.z.abs() < LEVEL && plane_of(arc.axis).is_err() {
            return self.arc_as_chords(arc, point, speed);
        }
        let (plane, sign) = plane_of(arc.axis)?;
        let [a, b, normal] = plane.axes();
        let sweep = sign * arc.sweep;
        let most = f64::from(self.dialect.most_turns);
        if !(sweep.is_finite() && sweep.abs() < TAU * most) {
            return Err(unsupported("a helix has too many turns for one block")
                .value(sweep.abs() / TAU, "turns")
                .bound(most, "turns")
                .into());
        }
        if (self.klartext() || self.turned_plane_only()) && plane != Plane::Xy {
            return self.arc_as_chords(arc, point, speed);
        }
        let (end, exact_centre) = (point.to_array(), arc.centre.to_array());
        let start = [self.written(a)?, self.written(b)?];
        let goal = [self.grid.round(end[a])? - start[0], self.grid.round(end[b])? - start[1]];
        let centre = DVec2::new(
            self.grid.steps(exact_centre[a]) - start[0] as f64,
            self.grid.steps(exact_centre[b]) - start[1] as f64,
        );
        let least = LEAST_RADIUS.max(self.grid.steps(LEAST_RADIUS_MM));
        let level = self.grid.round(end[normal])? == self.written(normal)?;
        // No number of the control reaches so far.
        let far = exact_centre[a].abs().max(exact_centre[b].abs()).max(arc.radius()) > LARGEST;
        if self.klartext() && !level && !far {
            return self.polar_arc(arc, sweep, least, point, speed);
        }
        let (centre, turns) = match round(goal, centre, sweep, least) {
            Rounded::Straight => {
                self.notes.straightened += 1;
                return self.line(end, speed);
            }
            Rounded::Chords => return self.flat_arc(arc, point, speed),
            Rounded::Arc { .. } | Rounded::Split { .. } if far => return self.flat_arc(arc, point, speed),
            // This control counts turns only on a helix, or not at all.
            Rounded::Arc { turns, .. }
                if turns > 0 && (self.dialect.turns.is_none() || level && !self.dialect.turns_in_plane) =>
            {
                return self.split(arc, TAU / sweep.abs(), true, point, speed);
            }
            Rounded::Split { turns: 0 } => return self.split(arc, 0.5, false, point, speed),
            Rounded::Split { turns } => {
                return self.split(arc, TAU * f64::from(turns) / sweep.abs(), true, point, speed);
            }
            Rounded::Arc { centre, turns, difference } => {
                let difference = difference * self.grid.unit();
                self.notes.radius_difference = self.notes.radius_difference.max(difference);
                (centre, turns)
            }
        };
        let word = if sweep >= 0.0 { "G3" } else { "G2" };
        self.arc_block(plane, word, end, centre, turns, speed)
    }

    /// An arc that no arc of the control is near to, as lines.
    pub(super) fn flat_arc(&mut self, arc: &Arc, point: DVec3, speed: Speed) -> Result<()> {
        self.notes.straightened += 1;
        let curve = Curve::from(*arc);
        if arc.radius() > 0.0 && curve.length() > CHORD * self.grid.unit() {
            self.chords(&curve, CHORD * self.grid.unit(), speed)?;
        }
        self.line(point.to_array(), speed)
    }

    /// An arc outside the planes of the control, as lines.
    fn arc_as_chords(&mut self, arc: &Arc, point: DVec3, speed: Speed) -> Result<()> {
        let tolerance = self.settings.arc_tolerance;
        self.notes.chain_tolerance = self.notes.chain_tolerance.max(tolerance);
        self.chords(&Curve::from(*arc), tolerance, speed)?;
        self.line(point.to_array(), speed)
    }

    /// Writes an arc in two parts, cut at the fraction `cut` of its sweep; `whole`: after whole turns.
    pub(super) fn split(
        &mut self,
        arc: &Arc,
        cut: f64,
        whole: bool,
        point: DVec3,
        speed: Speed,
    ) -> Result<()> {
        let part = |from: f64, to: f64| Arc {
            start: arc.point(from),
            centre: arc.centre + arc.axis * (arc.rise * from),
            sweep: arc.sweep * (to - from),
            rise: arc.rise * (to - from),
            ..*arc
        };
        let (first, second) = (part(0.0, cut), part(cut, 1.0));
        // Whole turns end where they began, to the last bit, so that both ends are rounded alike.
        let end = if whole { arc.start + arc.axis * first.rise } else { first.point(1.0) };
        self.arc(&first, end, speed)?;
        self.arc(&second, point, speed)
    }

    /// Length of the arc that the control makes of a block [mm].
    fn arc_length(
        &self,
        plane: Plane,
        ccw: bool,
        end: [f64; 3],
        centre: [i64; 2],
        turns: u32,
    ) -> Result<f64> {
        let mut way = [0.0; 3];
        for axis in 0..3 {
            way[axis] = (self.grid.round(end[axis])? - self.written(axis)?) as f64;
        }
        let [a, b, normal] = plane.axes();
        let centre = DVec2::new(centre[0] as f64, centre[1] as f64);
        let (centre, sweep) = fit(DVec2::ZERO, DVec2::new(way[a], way[b]), centre, ccw);
        let angle = sweep.abs() + TAU * f64::from(turns);
        Ok((centre.length() * angle).hypot(way[normal]) * self.grid.unit())
    }

    pub(super) fn arc_block(
        &mut self,
        plane: Plane,
        word: &'static str,
        end: [f64; 3],
        centre: [i64; 2],
        turns: u32,
        speed: Speed,
    ) -> Result<()> {
        let speed = self.timed(speed, self.arc_length(plane, word == "G3", end, centre, turns)?);
        if self.klartext() {
            return self.klartext_arc(end, centre, word == "G3", speed);
        }
        let [a, b, normal] = plane.axes();
        let mut axes = String::new();
        // In the order X Y Z, I J K whatever the plane.
        for (axis, value) in end.into_iter().enumerate() {
            self.axis(&mut axes, axis, value, axis != normal)?;
        }
        if self.dialect.axes.vector.is_some_and(|v| v.0 == OFFSETS) && self.modal.rotary_axes.takes_vectors()
        {
            return Err(unsupported("an arc where I, J and K are the tool axis")
                .help("give it as lines")
                .into());
        }
        self.rotary_words(&mut axes);
        for (axis, word) in OFFSETS.into_iter().enumerate() {
            if axis != normal {
                let count = if axis == a { centre[0] } else { centre[1] };
                debug_assert!(axis == a || axis == b);
                self.grid.word(&mut axes, word, count);
            }
        }
        if let (true, Some((turn_word, base))) = (turns > 0, self.dialect.turns) {
            axes.push_str(&format!(" {turn_word}{}", turns + base));
        }
        self.modal.motion = Some(word);
        self.emit(Some(plane), Some(word), &axes, speed)
    }
}

/// The plane of an arc, and the sign of its axis in it.
fn plane_of(axis: DVec3) -> Result<(Plane, f64)> {
    for plane in [Plane::Xy, Plane::Zx, Plane::Yz] {
        let along = axis[plane.axes()[2]];
        if along.abs() >= PARALLEL {
            return Ok((plane, along.signum()));
        }
    }
    Err(unsupported("an arc must lie in G17, G18 or G19")
        .help("turn the frame or replace it by lines")
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn round(end: [i64; 2], centre: DVec2, sweep: f64) -> Rounded {
        super::round(end, centre, sweep, LEAST_RADIUS)
    }

    #[test]
    fn a_vanishing_arc_is_never_a_circle() {
        // 0.3 steps long about a centre far away: the ends fall together.
        assert_eq!(round([0, 0], DVec2::new(0.0, 8e5), 0.3 / 8e5), Rounded::Chords);
        // And one step long, flat.
        assert_eq!(round([1, 0], DVec2::new(0.3, 8e5), 0.9 / 8e5), Rounded::Straight);
        assert_eq!(round([0, 1], DVec2::new(0.3, 8e5), 0.9 / 8e5), Rounded::Chords);
    }

    #[test]
    fn circles_and_turns_are_counted() {
        let centre = DVec2::new(-300.2, 0.1);
        let circle = |sweep| round([0, 0], centre, sweep);
        let arc = |turns| Rounded::Arc { centre: [-300, 0], turns, difference: 0.0 };
        assert_eq!(circle(TAU), arc(0));
        assert_eq!(circle(-2.0 * TAU), arc(1));
        assert_eq!(circle(TAU - 1e-9), arc(0));
        // A turn and a radian about a centre 30 000 steps away.
        let Rounded::Arc { turns: 1, .. } = round([-13_791, 25_244], DVec2::new(-30_000.0, 0.0), TAU + 1.0)
        else {
            panic!("a radian more than a turn")
        };
        // A hundredth more: the ends are too close together to carry the far side.
        let close = round([-1, 300], DVec2::new(-30_000.0, 0.0), TAU + 0.01);
        assert_eq!(close, Rounded::Split { turns: 1 });
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        /// The angle a control would turn by is that of the exact arc, whatever the rounding.
        #[test]
        fn the_rounded_arc_turns_alike(r in 1.0..2e6f64, from in -4.0..4.0f64, sweep in -7.0..7.0f64, x in 0.0..1.0f64, y in 0.0..1.0f64) {
            let start = DVec2::new(x, y);
            let centre = start - DVec2::from_angle(from) * r;
            let end = centre + DVec2::from_angle(from + sweep) * r;
            let s = start.round();
            let goal = end.round() - s;
            match round([goal.x as i64, goal.y as i64], centre - s, sweep) {
                Rounded::Arc { centre: c, turns, difference } => {
                    prop_assert!(difference < 2.0);
                    let c = DVec2::new(c[0] as f64, c[1] as f64);
                    let angle = |p: DVec2| p.y.atan2(p.x);
                    let mut turned = (angle(goal - c) - angle(-c)) * sweep.signum();
                    if goal == DVec2::ZERO { turned = TAU } else if turned < 0.0 { turned += TAU }
                    let turned = turned + f64::from(turns) * TAU;
                    prop_assert!((turned - sweep.abs()).abs() < 0.51, "{turned} {sweep}");
                    // The middle of the arc stays where it was, to the rounding.
                    let exact = centre + DVec2::from_angle(from + 0.5 * sweep) * r;
                    let near = ((exact - s - c).length() - c.length()).abs();
                    prop_assert!(near < 4.0, "{near}");
                }
                Rounded::Straight => prop_assert!(r * (1.0 - (0.5 * sweep).cos()) < 2.0),
                Rounded::Split { .. } => prop_assert!(sweep.abs() > PI),
                Rounded::Chords => prop_assert!(r * sweep.abs() < 3.0 || r < 60.0, "{r} {sweep}"),
            }
        }

        /// Numbers that were read are written again with the same digits.
        #[test]
        fn rounding_is_stable(r in 3.0..2e6f64, from in -4.0..4.0f64, sweep in -6.2..6.2f64) {
            let centre = DVec2::from_angle(from) * r;
            let end = centre - DVec2::from_angle(from + sweep) * r;
            let end = [end.x.round() as i64, end.y.round() as i64];
            if let Rounded::Arc { centre: c, turns, .. } = round(end, centre, sweep) {
                let goal = DVec2::new(end[0] as f64, end[1] as f64);
                let (moved, turned) = fit(DVec2::ZERO, goal, DVec2::new(c[0] as f64, c[1] as f64), sweep >= 0.0);
                let again = round(end, moved, turned + f64::from(turns) * TAU * sweep.signum());
                let Rounded::Arc { centre: d, turns: n, .. } = again else { panic!("{again:?}") };
                prop_assert_eq!((d, n), (c, turns));
            }
        }
    }
}
