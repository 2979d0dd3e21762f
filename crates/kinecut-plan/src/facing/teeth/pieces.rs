//! Pieces of an edge that the teeth cross one revolution after another.
//!
//! The point (x, y) of the part, y over the centre line, is met by a tooth of phase 0 in the front or back half at the
//! phase u = -+ arccos(-y/R), in the revolution
//! n = (x/r -+ sqrt(R^2 - y^2)/r +- arccos(-y/R)) / 2 pi, a real number: a tooth of phase p meets the point if
//! n + p / 2 pi is an integer. Along an edge n is a smooth function, and its slope vanishes exactly where the tooth's
//! velocity lies along the edge. Between those tangencies, and the places where the edge leaves the band |y| < R, n
//! is monotone: the crossings of a piece are the integers between the values at its ends. None can be missed, and
//! because neighbouring edges share the value at their vertex, none is lost or doubled there by rounding.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use crate::facing::level::{direction, level, meetings};
use crate::num::angle::wrap;

/// Tangency of a tooth with an edge: nearer than this, per radius, is no crossing.
const GRAZING: f64 = 1e-12;

/// Least slope of an edge's normal towards the feed with which a grazing distance is turned into revolutions; below
/// it, the distance is ruled by the curvature of the edge.
const LEAST_SLOPE: f64 = 1e-6;

/// Revolutions up to here are distinguished by their numbers.
const TOLD_APART: f64 = 1e15;

/// Trochoid of a tooth: phase apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Trochoid {
    /// [mm].
    pub(super) radius: f64,
    /// Feed per radian [mm].
    pub(super) feed: f64,
}

/// An edge in the frame of the pass, heights counted from the centre line.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedEdge {
    pub(super) start: DVec2,
    pub(super) end: DVec2,
    pub(super) form: Form,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    Line,
    Arc { centre: DVec2, radius: f64, from: f64, sweep: f64 },
}

/// A piece crossed in one half of the cutter and in one sense, one crossing for each integer from `first` to `last`.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrossedPiece {
    pub(super) front: bool,
    pub(super) exit: bool,
    /// Ends: gone along the edge, share of a line's length or angle of an arc.
    pub(super) gone: [f64; 2],
    /// Revolution at both ends.
    pub(super) turns: [f64; 2],
    /// Integers that count at each end: distance that is cut off from the end, and true if the rest is closed.
    cut: [(f64, bool); 2],
}

impl CrossedPiece {
    /// First and last integer of a tooth with this phase in turns; none if the first exceeds the last.
    pub(super) fn revolutions(&self, phase_turns: f64) -> [f64; 2] {
        let (low, high) = if self.turns[0] < self.turns[1] { (0, 1) } else { (1, 0) };
        let lo = self.turns[low] + phase_turns + self.cut[low].0;
        let hi = self.turns[high] + phase_turns - self.cut[high].0;
        let first = if self.cut[low].1 { lo.ceil() } else { lo.floor() + 1.0 };
        let last = if self.cut[high].1 { hi.floor() } else { hi.ceil() - 1.0 };
        // Beyond this, integers are no longer told apart.
        if first > -TOLD_APART && last < TOLD_APART { [first, last] } else { [1.0, 0.0] }
    }
}

/// End of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Start,
    Finish,
    /// The edge leaves the band of the cutter here, at its top (1) or bottom (-1).
    Band(f64),
    /// A tooth of this half (front?) moves along the edge; so much of a revolution is grazing.
    Tangent(bool, f64),
}

impl Trochoid {
    pub(super) fn rho(&self) -> f64 {
        self.feed / self.radius
    }

    /// The revolution in which a tooth of phase 0 meets a point.
    pub(super) fn turns(&self, point: DVec2, front: bool) -> f64 {
        let q = -point.y / self.radius;
        let q = if q > 1.0 { 1.0 } else { q };
        let q = if q < -1.0 { -1.0 } else { q };
        let root = self.radius * ((1.0 - q) * (1.0 + q)).sqrt();
        let behind = if front { -root } else { root };
        let phase = if front { -q.acos() } else { q.acos() };
        ((point.x + behind) / self.feed - phase) / TAU
    }

    /// Phase at which a tooth of that half is at a height over the centre line.
    pub(super) fn phase(&self, y: f64, front: bool) -> f64 {
        let u = (-y / self.radius).clamp(-1.0, 1.0).acos();
        if front { -u } else { u }
    }

    /// True if a tooth of that half leaves the material on the edge of this heading [rad] at this height [mm].
    fn leaves(&self, y: f64, heading: f64, front: bool) -> bool {
        let eta = (y / self.radius).clamp(-1.0, 1.0);
        wrap(direction(eta, self.rho(), front) - heading) > 0.0
    }

    /// Share of a revolution that is grazing where the outward normal has this component along the feed.
    fn grazing(&self, slope: f64) -> f64 {
        GRAZING / (TAU * self.rho() * slope.abs())
    }

    /// Appends the pieces of an edge.
    pub(super) fn pieces(&self, edge: &PlacedEdge, pieces: &mut Vec<CrossedPiece>) {
        match edge.form {
            Form::Line => self.line_pieces(edge, pieces),
            Form::Arc { centre, radius, from, sweep } => {
                self.arc_pieces(edge, centre, radius, from, sweep, pieces);
            }
        }
    }

    fn line_pieces(&self, edge: &PlacedEdge, pieces: &mut Vec<CrossedPiece>) {
        let (a, b) = (edge.start, edge.end);
        let rise = b.y - a.y;
        let along = b - a;
        let heading = along.y.atan2(along.x);
        let slope = along.y / along.length();
        let grazes = |y: f64| (y.abs() - self.radius).abs() <= GRAZING * self.radius;
        if grazes(a.y) && grazes(b.y) && a.y * b.y > 0.0 {
            return;
        }
        let at = |s: f64| DVec2::new(a.x + s * along.x, a.y + s * rise);
        // The part of the edge in the band.
        let (mut from, mut to) = ((0.0, End::Start), (1.0, End::Finish));
        for side in [1.0, -1.0] {
            let (out_a, out_b) = (side * a.y > self.radius, side * b.y > self.radius);
            if (out_a || side * a.y == self.radius) && (out_b || side * b.y == self.radius) {
                return;
            }
            let s = (side * self.radius - a.y) / rise;
            if out_a {
                from = (s, End::Band(side));
            } else if out_b {
                to = (s, End::Band(side));
            }
        }
        for front in [true, false] {
            // The tooth of this half that moves along the edge, one way or the other.
            let towards = if (heading < 0.0) == front { heading } else { heading + PI };
            let s = (self.radius * level(towards, self.rho()) - a.y) / rise;
            let mut ends = [from, to, to];
            let mut count = 2;
            if from.0 < s && s < to.0 {
                ends[1] = (s, End::Tangent(front, self.grazing(slope)));
                count = 3;
            }
            for w in ends[..count].windows(2) {
                let exit = self.leaves(at(0.5 * (w[0].0 + w[1].0)).y, heading, front);
                self.piece(edge, at, front, exit, [w[0], w[1]], pieces);
            }
        }
    }

    fn arc_pieces(
        &self,
        edge: &PlacedEdge,
        centre: DVec2,
        radius: f64,
        from: f64,
        sweep: f64,
        pieces: &mut Vec<CrossedPiece>,
    ) {
        let sign = sweep.signum();
        let span = sweep.abs();
        let at = |gone: f64| centre + radius * DVec2::from_angle(from + sign * gone);
        let mut ends = vec![(0.0, End::Start), (span, End::Finish)];
        let mut at_angle = |phi: f64, end: End| {
            let gone = (sign * (phi - from)).rem_euclid(TAU);
            if 0.0 < gone && gone < span {
                ends.push((gone, end));
            }
        };
        for side in [1.0, -1.0] {
            let sin = (side * self.radius - centre.y) / radius;
            if sin.abs() < 1.0 {
                at_angle(sin.asin(), End::Band(side));
                at_angle(PI - sin.asin(), End::Band(side));
            }
        }
        let (rise, arc) = (centre.y / self.radius, radius / self.radius);
        for turn in [FRAC_PI_2, -FRAC_PI_2] {
            meetings(rise, arc, self.rho(), turn, |phi| {
                let slope = phi.cos().abs();
                let slope = if slope > LEAST_SLOPE { slope } else { LEAST_SLOPE };
                let front = (phi + turn).sin() < 0.0;
                at_angle(phi, End::Tangent(front, self.grazing(slope)));
            });
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        for front in [true, false] {
            for w in ends.windows(2) {
                let middle = 0.5 * (w[0].0 + w[1].0);
                let y = at(middle).y;
                if y.abs() < self.radius {
                    let heading = from + sign * (middle + FRAC_PI_2);
                    let exit = self.leaves(y, heading, front);
                    self.piece(edge, at, front, exit, [w[0], w[1]], pieces);
                }
            }
        }
    }

    fn piece(
        &self,
        edge: &PlacedEdge,
        at: impl Fn(f64) -> DVec2,
        front: bool,
        exit: bool,
        ends: [(f64, End); 2],
        pieces: &mut Vec<CrossedPiece>,
    ) {
        if !(ends[0].0 < ends[1].0) {
            return;
        }
        let point = |(gone, end): (f64, End)| match end {
            End::Start => edge.start,
            End::Finish => edge.end,
            End::Band(side) => DVec2::new(at(gone).x, side * self.radius),
            End::Tangent(..) => at(gone),
        };
        // Half-open: the start of an edge belongs to it, its end does not. The top and bottom of the circle, where
        // the halves meet, belong to the back.
        let cut = |(gone, end): (f64, End), first: bool| match end {
            End::Start => (0.0, !front || edge.start.y.abs() < self.radius),
            End::Finish => (0.0, false),
            End::Band(_) => (0.0, !front),
            End::Tangent(of_front, grazing) if of_front == front => (grazing, true),
            End::Tangent(..) => (0.0, first && gone > 0.0),
        };
        pieces.push(CrossedPiece {
            front,
            exit,
            gone: ends.map(|e| e.0),
            turns: ends.map(|e| self.turns(point(e), front)),
            cut: [cut(ends[0], true), cut(ends[1], false)],
        });
    }
}
