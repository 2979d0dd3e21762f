//! Rounded and chamfered corners: where two moves of a plane are cut, and what joins them.
//!
//! A rounding is the arc that touches both moves; its centre lies at its radius from both, on the side to which the path turns.
//! A chamfer is the line between the points of both moves at a straight distance from the corner.

use std::f64::consts::TAU;

use glam::DVec2;

use super::arc_fit::angle_between;

/// Lengths that are equal but for rounding [mm].
const SAME: f64 = 1e-9;

/// A move of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leg {
    pub(super) from: DVec2,
    pub(super) to: DVec2,
    /// Centre and angle of an arc, positive against the clock [rad]; none of a straight move.
    pub(super) arc: Option<(DVec2, f64)>,
}

/// Joint of two moves at their corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Joint {
    /// An arc of this radius [mm].
    Round(f64),
    /// A line between the points at this distance from the corner [mm].
    Chamfer(f64),
}

impl Leg {
    fn line(from: DVec2, to: DVec2) -> Leg {
        Leg { from, to, arc: None }
    }

    /// Direction at its start, or at its end; none of a move of no length.
    fn direction(&self, at_end: bool) -> Option<DVec2> {
        match self.arc {
            None => (self.to - self.from).try_normalize(),
            Some((centre, sweep)) => {
                let place = if at_end { self.to } else { self.from };
                Some((place - centre).try_normalize()?.perp() * sweep.signum())
            }
        }
    }

    /// Angle from its start to a point of its circle, in its sense.
    fn swept(centre: DVec2, from: DVec2, to: DVec2, sense: f64) -> f64 {
        let angle = angle_between(from - centre, to - centre) * sense;
        let way = angle.rem_euclid(TAU);
        // Rounding at the start itself is no whole turn.
        if way > TAU - SAME { 0.0 } else { way }
    }

    /// Whether a point of its line or circle is on it.
    fn holds(&self, point: DVec2) -> bool {
        match self.arc {
            None => {
                let (way, length) = (self.to - self.from, (self.to - self.from).length());
                let along = (point - self.from).dot(way) / length;
                (-SAME..=length + SAME).contains(&along)
            }
            Some((centre, sweep)) => {
                Leg::swept(centre, self.from, point, sweep.signum()) <= sweep.abs() + SAME
            }
        }
    }

    /// The part before a point of it.
    fn before(&self, point: DVec2) -> Leg {
        let arc =
            self.arc.map(|(c, sweep)| (c, sweep.signum() * Leg::swept(c, self.from, point, sweep.signum())));
        Leg { to: point, arc, ..*self }
    }

    /// The part behind a point of it.
    fn behind(&self, point: DVec2) -> Leg {
        let arc = self
            .arc
            .map(|(c, sweep)| (c, sweep - sweep.signum() * Leg::swept(c, self.from, point, sweep.signum())));
        Leg { from: point, arc, ..*self }
    }

    /// The point of it that a circle about `centre` beside it touches.
    fn touched(&self, centre: DVec2) -> Option<DVec2> {
        match self.arc {
            None => {
                let way = (self.to - self.from).try_normalize()?;
                Some(self.from + way * (centre - self.from).dot(way))
            }
            Some((own, _)) => {
                let radius = (self.to - own).length();
                Some(own + (centre - own).try_normalize()? * radius)
            }
        }
    }

    /// The point at a straight distance from its end, or from its start.
    fn at(&self, distance: f64, from_end: bool) -> Option<DVec2> {
        let (corner, sense) = if from_end { (self.to, -1.0) } else { (self.from, 1.0) };
        match self.arc {
            None => Some(corner + self.direction(from_end)? * (distance * sense)),
            Some((centre, sweep)) => {
                let half = distance / (2.0 * (corner - centre).length());
                if half > 1.0 {
                    return None;
                }
                let angle = 2.0 * half.asin() * sense * sweep.signum();
                Some(centre + DVec2::from_angle(angle).rotate(corner - centre))
            }
        }
    }
}

/// A line or circle on which the centre of a rounding lies.
#[derive(Clone, Copy, Debug)]
enum Track {
    Line { point: DVec2, way: DVec2 },
    Circle { centre: DVec2, radius: f64 },
}

impl Track {
    /// That of a move, on the side to which the path turns (`left`: 1 or -1).
    fn of(leg: &Leg, radius: f64, left: f64) -> Option<Track> {
        Some(match leg.arc {
            None => {
                let way = leg.direction(false)?;
                Track::Line { point: leg.from + way.perp() * (radius * left), way }
            }
            Some((centre, sweep)) => {
                let own = (leg.to - centre).length() - radius * left * sweep.signum();
                if own <= 0.0 {
                    return None;
                }
                Track::Circle { centre, radius: own }
            }
        })
    }

    /// Points in which two meet.
    fn meet(self, other: Track) -> Vec<DVec2> {
        match (self, other) {
            (Track::Line { point, way }, Track::Line { point: second, way: along }) => {
                let across = way.perp_dot(along);
                if across == 0.0 {
                    return Vec::new();
                }
                vec![point + way * ((second - point).perp_dot(along) / across)]
            }
            (Track::Line { point, way }, Track::Circle { centre, radius })
            | (Track::Circle { centre, radius }, Track::Line { point, way }) => {
                let foot = point + way * (centre - point).dot(way);
                let apart = (centre - foot).length();
                let half = (radius - apart) * (radius + apart);
                if half < 0.0 {
                    return Vec::new();
                }
                [half.sqrt(), -half.sqrt()].map(|by| foot + way * by).to_vec()
            }
            (Track::Circle { centre, radius }, Track::Circle { centre: second, radius: other }) => {
                let apart = (second - centre).length();
                let Some(way) = (second - centre).try_normalize() else { return Vec::new() };
                let along = 0.5 * (apart + (radius - other) * (radius + other) / apart);
                let half = (radius - along) * (radius + along);
                if half < 0.0 {
                    return Vec::new();
                }
                let foot = centre + way * along;
                [half.sqrt(), -half.sqrt()].map(|by| foot + way.perp() * by).to_vec()
            }
        }
    }
}

/// Two moves that meet at a corner, cut there, and what joins them; `None` where it does not fit between them. The joint is
/// none where the moves go straight on.
pub(super) fn joined(first: &Leg, second: &Leg, joint: Joint) -> Option<(Leg, Option<Leg>, Leg)> {
    let (before, behind) = (first.direction(true)?, second.direction(false)?);
    let turn = angle_between(before, behind);
    if turn.abs() < SAME {
        return Some((*first, None, *second));
    }
    let corner = second.from;
    let (leave, arrive, arc) = match joint {
        Joint::Chamfer(distance) => {
            let (leave, arrive) = (first.at(distance, true)?, second.at(distance, false)?);
            if !(first.holds(leave) && second.holds(arrive)) {
                return None;
            }
            (leave, arrive, None)
        }
        Joint::Round(radius) => {
            let left = turn.signum();
            let tracks = (Track::of(first, radius, left)?, Track::of(second, radius, left)?);
            let mut centres = tracks.0.meet(tracks.1);
            centres.sort_by(|a, b| (*a - corner).length().total_cmp(&(*b - corner).length()));
            let (centre, leave, arrive) = centres.into_iter().find_map(|centre| {
                let (leave, arrive) = (first.touched(centre)?, second.touched(centre)?);
                (first.holds(leave) && second.holds(arrive)).then_some((centre, leave, arrive))
            })?;
            (leave, arrive, Some((centre, left * Leg::swept(centre, leave, arrive, left))))
        }
    };
    Some((first.before(leave), Some(Leg { arc, ..Leg::line(leave, arrive) }), second.behind(arrive)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: DVec2, x: f64, y: f64) -> bool {
        (a - DVec2::new(x, y)).length() < 1e-9
    }

    #[test]
    fn a_square_corner_is_rounded_and_chamfered() {
        let first = Leg::line(DVec2::ZERO, DVec2::X * 10.0);
        let second = Leg::line(DVec2::X * 10.0, DVec2::new(10.0, -8.0));
        let (a, joint, b) = joined(&first, &second, Joint::Round(3.0)).unwrap();
        let joint = joint.unwrap();
        assert!(close(a.to, 7.0, 0.0) && close(joint.to, 10.0, -3.0) && close(b.to, 10.0, -8.0));
        let (centre, sweep) = joint.arc.unwrap();
        assert!(close(centre, 7.0, -3.0) && (sweep + 0.25 * TAU).abs() < 1e-12);
        let (a, joint, _) = joined(&first, &second, Joint::Chamfer(8.0)).unwrap();
        assert!(close(a.to, 2.0, 0.0) && close(joint.unwrap().to, 10.0, -8.0));
        assert_eq!(joined(&first, &second, Joint::Chamfer(8.1)), None);
        assert_eq!(joined(&first, &second, Joint::Round(8.1)), None);
        let on = Leg::line(DVec2::X * 10.0, DVec2::X * 20.0);
        assert_eq!(joined(&first, &on, Joint::Round(1.0)), Some((first, None, on)));
        let back = Leg::line(DVec2::X * 10.0, DVec2::ZERO);
        assert_eq!(joined(&first, &back, Joint::Round(1.0)), None);
    }

    #[test]
    fn a_line_and_an_arc_are_rounded_inside_and_outside_the_arc() {
        // Up the line X10 to the corner (10, 0), then against the clock about (0, 0): to the left, outside of the circle's tangent.
        let arc = Leg { from: DVec2::X * 10.0, to: DVec2::NEG_X * 10.0, arc: Some((DVec2::ZERO, 0.5 * TAU)) };
        // From the outside along X towards the centre, then to the right turn up: the centre of a rounding r 2 lies at distance 12
        // from (0, 0) and 2 above the line: sqrt(144 - 4).
        let line = Leg::line(DVec2::X * 30.0, DVec2::X * 10.0);
        let (a, joint, b) = joined(&line, &arc, Joint::Round(2.0)).unwrap();
        let x = 140.0f64.sqrt();
        assert!(close(a.to, x, 0.0));
        let (centre, sweep) = joint.unwrap().arc.unwrap();
        assert!(close(centre, x, 2.0) && sweep < 0.0);
        assert!(close(b.from, x / 1.2, 2.0 / 1.2));
        // From the inside, to the left: at distance 8, 2 above the line.
        let line = Leg::line(DVec2::ZERO, DVec2::X * 10.0);
        let (a, joint, b) = joined(&line, &arc, Joint::Round(2.0)).unwrap();
        let x = 60.0f64.sqrt();
        let (centre, sweep) = joint.unwrap().arc.unwrap();
        assert!(close(a.to, x, 0.0) && close(centre, x, 2.0) && sweep > 0.0);
        assert!(close(b.from, x * 1.25, 2.5));
        let rest = b.arc.unwrap().1;
        assert!((rest - (0.5 * TAU - (2.0f64 / x).atan())).abs() < 1e-12);
        assert_eq!(joined(&line, &arc, Joint::Round(6.0)), None);
        // A chamfer of chord 10: sixty degrees of the circle.
        let (a, joint, b) = joined(&line, &arc, Joint::Chamfer(10.0)).unwrap();
        assert!(close(a.to, 0.0, 0.0) && close(joint.unwrap().to, 5.0, 75.0f64.sqrt()));
        assert!((b.arc.unwrap().1 - TAU / 3.0).abs() < 1e-12);
    }

    #[test]
    fn two_arcs_are_rounded() {
        // Clockwise about (0, 0), then about (8, 0), both r 5: to the left at (4, 3), outside of both circles.
        let first =
            Leg { from: DVec2::NEG_X * 5.0, to: DVec2::new(4.0, 3.0), arc: Some((DVec2::ZERO, -2.498)) };
        let sweep = -(3.0f64.atan2(-4.0));
        let second =
            Leg { from: DVec2::new(4.0, 3.0), to: DVec2::X * 13.0, arc: Some((DVec2::X * 8.0, sweep)) };
        let (a, joint, b) = joined(&first, &second, Joint::Round(1.0)).unwrap();
        // The centre is at 6 from both.
        let height = 20.0f64.sqrt();
        assert!(close(joint.unwrap().arc.unwrap().0, 4.0, height));
        assert!(close(a.to, 20.0 / 6.0, height * 5.0 / 6.0));
        assert!(close(b.from, 8.0 - 20.0 / 6.0, height * 5.0 / 6.0));
    }
}
