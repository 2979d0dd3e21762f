//! Joints between the parallels of two neighbouring elements.
//!
//! For the compensation only. Outside a corner the tool goes round the contour's point on an arc (`G450`; LinuxCNC);
//! inside, and where the directions differ by little, both parallels end in their intersection. A joint whose
//! directions are the same needs nothing. Lines and arcs intersect in closed form, involutes by Newton's method.
//!
//! Notation: `a` ends and `b` begins at the corner; `phi` is the angle from `a`'s direction to `b`'s, positive to the
//! left; `d` the offset to the left; `back` the length taken off the end of `a`, `forth` off the start of `b`
//! (negative: prolonged).

use glam::DVec2;

use super::flat::Flat;

/// Angle up to which a corner is closed by prolonging or shortening both elements instead of going round it [rad]:
/// LinuxCNC's own limit, up to which a corner counts as straight.
pub(super) const SMALL: f64 = 0.05;
/// Distance of the ends of two parallels that is rounding [mm]; well below what a joint may gape.
const CLOSED: f64 = 1e-9;
/// Angle from a fold-back on that counts as outside [rad]: rounding of two opposite directions.
const FOLD: f64 = 1e-9;
/// Angle from which on a contour turns back on the side of the tool [rad], 150 degrees: where the joint then takes most of an
/// element, the contour is a slip (G2 for G3), and controls differ in what they make of it.
const BACKWARDS: f64 = 2.6;
/// Slack of an intersection at the end of an element [mm]: rounding of coordinates of metres.
const SLACK: f64 = 1e-9;
/// Share of an element that a joint straight on may take off: the joint at its other end may take as much.
const MOST: f64 = 0.45;
/// Residual of an intersection found by iteration [mm].
const MET: f64 = 1e-10;
/// Steps of Newton's method: quadratic from a start that is right to second order, halved steps included.
const STEPS: u32 = 40;

/// The joint of two parallels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Corner {
    /// They meet when so much is taken off [mm].
    Meet { back: f64, forth: f64 },
    /// An arc about the corner lies between them, of this sweep [rad].
    Round { sweep: f64 },
    /// They end square to the corner, as they are, with a step between: an element of rounding's size, nearly straight
    /// on, that is shorter than what the intersection takes off.
    Step,
    /// They do not meet: the corner has no room for the tool.
    NoRoom,
}

/// Joins the parallels `a` and `b` at `d` to the left of elements whose directions are `phi` apart.
pub(super) fn corner(a: &Flat, b: &Flat, phi: f64, d: f64) -> Corner {
    let (ends, starts) = (a.end(), b.at(0.0));
    if ends.0.distance(starts.0) <= CLOSED {
        return Corner::Meet { back: 0.0, forth: 0.0 };
    }
    let outside = if phi.abs() > std::f64::consts::PI - FOLD {
        // The contour folds back: which way it opens is a matter of curvature; two lines are gone round.
        d * (a.curvature(a.length()) + b.curvature(0.0)) >= 0.0
    } else {
        phi * d < 0.0
    };
    if outside && phi.abs() > SMALL {
        // On the side of the tool, also when the contour folds back.
        return Corner::Round { sweep: -phi.abs() * d.signum() };
    }
    let guess = d * (0.5 * phi).tan();
    if phi.abs() <= SMALL {
        return nearly_straight(a, b, guess);
    }
    let met = match (line_or_circle(a), line_or_circle(b)) {
        (Some(x), Some(y)) => nearest(a, b, &intersections(x, y)),
        _ => {
            // A sharp corner asks for more than there is; the middle is then as good a start as any.
            let within = |flat: &Flat| guess.clamp(0.0, 0.5 * flat.length());
            newton(a, b, [within(a), within(b)]).filter(|m| fits(a, b, *m))
        }
    };
    met.filter(|m| phi.abs() <= BACKWARDS || keeps_half(a, b, *m))
        .map_or(Corner::NoRoom, |[back, forth]| Corner::Meet { back, forth })
}

/// True if a joint leaves at least half of both elements.
fn keeps_half(a: &Flat, b: &Flat, [back, forth]: [f64; 2]) -> bool {
    back <= 0.5 * a.length() && forth <= 0.5 * b.length()
}

/// Two elements with nearly one direction: as if both were lines, then corrected where that gapes.
fn nearly_straight(a: &Flat, b: &Flat, guess: f64) -> Corner {
    let gap = a.at(a.length() - guess).0.distance(b.at(guess).0);
    let first = [guess, guess];
    let [back, forth] = if gap <= CLOSED {
        first
    } else {
        // A correction larger than the guess is another intersection.
        newton(a, b, first).filter(|m| m.iter().all(|v| (v - guess).abs() <= guess.abs())).unwrap_or(first)
    };
    let room = |taken: f64, flat: &Flat| taken <= MOST * flat.length();
    if room(back, a) && room(forth, b) { Corner::Meet { back, forth } } else { Corner::Step }
}

fn fits(a: &Flat, b: &Flat, [back, forth]: [f64; 2]) -> bool {
    (-SLACK..=a.length() + SLACK).contains(&back) && (-SLACK..=b.length() + SLACK).contains(&forth)
}

/// The intersection with the continuations by Newton's method: `[back, forth]`.
fn newton(a: &Flat, b: &Flat, start: [f64; 2]) -> Option<[f64; 2]> {
    let length = a.length();
    let gap = |[back, forth]: [f64; 2]| {
        let ((p, t), (q, u)) = (a.at(length - back), b.at(forth));
        (q - p, t, u)
    };
    let mut now = start;
    let (mut miss, mut t, mut u) = gap(now);
    for _ in 0..STEPS {
        if miss.length() <= MET {
            return Some(now);
        }
        // d(miss) = t d(back) + u d(forth).
        let det = t.perp_dot(u);
        if det == 0.0 || !det.is_finite() {
            return None;
        }
        let step = [u.perp_dot(miss) / det, miss.perp_dot(t) / det];
        let mut share = 1.0;
        let (next, found) = loop {
            let next = [now[0] + share * step[0], now[1] + share * step[1]];
            let found = gap(next);
            if found.0.length() < miss.length() {
                break (next, found);
            }
            share *= 0.5;
            if share < 1e-6 {
                return None;
            }
        };
        now = next;
        (miss, t, u) = found;
    }
    None
}

/// The whole line or circle of a line or arc.
#[derive(Clone, Copy)]
enum Support {
    Line { point: DVec2, along: DVec2 },
    Circle { centre: DVec2, radius: f64 },
}

fn line_or_circle(flat: &Flat) -> Option<Support> {
    Some(match *flat {
        Flat::Line { start, end } => Support::Line { point: start, along: (end - start).normalize_or_zero() },
        Flat::Arc { start, centre, .. } => Support::Circle { centre, radius: start.distance(centre) },
        Flat::Involute(_) => return None,
    })
}

/// Points that two lines or circles have in common.
fn intersections(a: Support, b: Support) -> Vec<DVec2> {
    match (a, b) {
        (Support::Line { point: p, along: t }, Support::Line { point: q, along: u }) => {
            let det = t.perp_dot(u);
            if det == 0.0 { Vec::new() } else { vec![p + t * ((q - p).perp_dot(u) / det)] }
        }
        (Support::Line { point, along }, Support::Circle { centre, radius })
        | (Support::Circle { centre, radius }, Support::Line { point, along }) => {
            let foot = point + along * (centre - point).dot(along);
            let h = foot.distance(centre);
            chord(foot, along, (radius - h) * (radius + h))
        }
        (Support::Circle { centre: c, radius: r }, Support::Circle { centre: k, radius: l }) => {
            let apart = k - c;
            let distance = apart.length();
            if distance == 0.0 {
                return Vec::new();
            }
            let x = 0.5 * (distance + (r - l) * (r + l) / distance);
            let along = apart / distance;
            chord(c + along * x, along.perp(), (r - x) * (r + x))
        }
    }
}

fn chord(foot: DVec2, along: DVec2, half_squared: f64) -> Vec<DVec2> {
    if half_squared < 0.0 {
        return Vec::new();
    }
    let half = along * half_squared.sqrt();
    vec![foot - half, foot + half]
}

/// The point that takes least off both elements: `[back, forth]`.
fn nearest(a: &Flat, b: &Flat, points: &[DVec2]) -> Option<[f64; 2]> {
    let mut best: Option<[f64; 2]> = None;
    for point in points {
        let found = [a.length() - place(a, *point, true), place(b, *point, false)];
        let better = best.is_none_or(|m| found[0] + found[1] < m[0] + m[1]);
        if fits(a, b, found) && better {
            best = Some(found);
        }
    }
    best
}

/// Arc length of a point on a line or arc [mm]: on an arc of several turns that nearest its end, or its start.
fn place(flat: &Flat, point: DVec2, near_end: bool) -> f64 {
    match *flat {
        Flat::Line { start, .. } => (point - start).dot(flat.at(0.0).1),
        Flat::Arc { start, centre, sweep } => {
            let radius = start.distance(centre);
            let anchor = if near_end { flat.end().0 } else { start };
            // Angle from the anchor into the arc; a point a little before the anchor keeps its small negative angle.
            let into = if near_end { -sweep.signum() } else { sweep.signum() };
            let angle = into * (anchor - centre).angle_to(point - centre);
            let angle = if angle * radius < -SLACK { angle + std::f64::consts::TAU } else { angle };
            if near_end { radius * (sweep.abs() - angle) } else { radius * angle }
        }
        Flat::Involute(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::InvoluteRecord;

    fn line(a: [f64; 2], b: [f64; 2]) -> Flat {
        Flat::Line { start: a.into(), end: b.into() }
    }

    fn meet(a: &Flat, b: &Flat, phi: f64, d: f64) -> [f64; 2] {
        let (x, y) = (a.offset(d).unwrap(), b.offset(d).unwrap());
        let Corner::Meet { back, forth } = corner(&x, &y, phi, d) else { panic!("{a:?} {b:?}") };
        let (p, q) = (x.at(x.length() - back).0, y.at(forth).0);
        assert!(p.distance(q) < 1e-9, "{p} {q}");
        [back, forth]
    }

    #[test]
    fn an_inside_right_angle_takes_the_offset_off_both() {
        let (a, b) = (line([0.0, 0.0], [10.0, 0.0]), line([10.0, 0.0], [10.0, 10.0]));
        let taken = meet(&a, &b, std::f64::consts::FRAC_PI_2, 2.0);
        assert!(taken.iter().all(|t| (t - 2.0).abs() < 1e-14));
        let (x, y) = (a.offset(-2.0).unwrap(), b.offset(-2.0).unwrap());
        assert_eq!(
            corner(&x, &y, std::f64::consts::FRAC_PI_2, -2.0),
            Corner::Round { sweep: std::f64::consts::FRAC_PI_2 }
        );
        // 11 mm do not fit into 10.
        let (x, y) = (a.offset(11.0).unwrap(), b.offset(11.0).unwrap());
        assert_eq!(corner(&x, &y, std::f64::consts::FRAC_PI_2, 11.0), Corner::NoRoom);
    }

    #[test]
    fn a_contour_that_turns_back_and_loses_most_of_an_element_has_no_room() {
        let back = |degrees: f64, length: f64| {
            let end = DVec2::new(length, 0.0) + DVec2::from_angle(degrees.to_radians()) * length;
            let (a, b) = (line([0.0, 0.0], [length, 0.0]), line([length, 0.0], end.to_array()));
            corner(&a.offset(4.0).unwrap(), &b.offset(4.0).unwrap(), degrees.to_radians(), 4.0)
        };
        // The joint takes 4 tan(80) = 22.7 mm off both lines.
        assert_eq!(back(160.0, 40.0), Corner::NoRoom);
        assert!(matches!(back(160.0, 50.0), Corner::Meet { .. }));
        assert!(matches!(back(120.0, 10.0), Corner::Meet { .. }));
    }

    #[test]
    fn a_line_meets_an_arc_and_an_arc_an_arc() {
        // LinuxCNC: line y = 0 right of it by 2, half circle about (30, 0) from (20, 0), radius 12: x = 18.1678.
        let (a, b) = (
            line([10.0, 0.0], [20.0, 0.0]),
            Flat::Arc {
                start: DVec2::new(20.0, 0.0),
                centre: DVec2::new(30.0, 0.0),
                sweep: std::f64::consts::PI,
            },
        );
        let [back, _] = meet(&a, &b, -std::f64::consts::FRAC_PI_2, -2.0);
        assert!((20.0 - back - 18.167_840_433_800_58).abs() < 1e-10, "{back}");
        // Two half circles of radius 10 about (0, 0) and (20, 0), cusp inside: parallels of 12 meet over x = 10.
        let a =
            Flat::Arc { start: DVec2::new(-10.0, 0.0), centre: DVec2::ZERO, sweep: -std::f64::consts::PI };
        let b = Flat::Arc {
            start: DVec2::new(10.0, 0.0),
            centre: DVec2::new(20.0, 0.0),
            sweep: -std::f64::consts::PI,
        };
        let x = a.offset(2.0).unwrap();
        // Direction at the end is down, at the start of the next up: a fold, inside on the left.
        let Corner::Meet { back, .. } = corner(&x, &b.offset(2.0).unwrap(), std::f64::consts::PI, 2.0) else {
            panic!()
        };
        let p = x.at(x.length() - back).0;
        assert!((p - DVec2::new(10.0, 44f64.sqrt())).length() < 1e-9, "{p}");
    }

    #[test]
    fn an_involute_meets_a_line_where_both_are_as_far_from_the_contour() {
        let record = InvoluteRecord::new(30.0, [0.0, 0.0], 0.3, 4.0, 12.0).unwrap();
        let (end, angle) = (record.end(), record.at(30.0).angle);
        for turn in [0.5, 1.2, 1e-5, -1e-4] {
            let b = line(end.into(), (end + DVec2::from_angle(angle + turn) * 20.0).into());
            let taken = meet(&Flat::Involute(record), &b, turn, 1.5);
            assert!(taken.iter().all(|t| t * turn > 0.0 && t.abs() < 4.0), "{turn} {taken:?}");
        }
    }

    #[test]
    fn a_joint_of_one_direction_is_left_alone() {
        let a = line([0.0, 0.0], [10.0, 0.0]);
        let b = Flat::Arc { start: DVec2::new(10.0, 0.0), centre: DVec2::new(10.0, 5.0), sweep: 2.0 };
        assert_eq!(meet(&a, &b, 0.0, 1.0), [0.0, 0.0]);
    }
}
