//! The moment at which a tool that keeps its direction comes to a point, in closed form: on level lines and arcs, where the point
//! stays at one height of the tool, and on ways along the axis, where it stays at one distance from it.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::body::ConvexPart;
use super::leaning::Pose;
use crate::geom::CurveKind;
use crate::sweep::ToolMotion;

/// Most that a level way rises, and a way along the axis leaves it [mm].
const LEVEL: f64 = 1e-9;

/// The way of a tool's tip, with the fraction of the move as its parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct FixedWay {
    /// Direction from the tip to the holder.
    axis: DVec3,
    run: Run,
}

#[derive(Clone, Copy, Debug)]
enum Run {
    /// A line square to the axis.
    Level { start: DVec3, way: DVec3 },
    /// A line along the axis.
    Along { start: DVec3, way: f64 },
    /// An arc about the axis: centre, first radius, the direction square to it in which angles grow, the angle that is turned.
    Round { centre: DVec3, out: DVec3, side: DVec3, sweep: f64 },
}

impl FixedWay {
    /// Of a move; none where the closed forms do not hold.
    pub(super) fn of(motion: &ToolMotion) -> Option<FixedWay> {
        let (curve, axis) = motion.as_fixed()?;
        let run = match curve.kind() {
            CurveKind::Line(line) => {
                let way = line.end - line.start;
                let rise = way.dot(axis);
                if rise.abs() <= LEVEL {
                    Run::Level { start: line.start, way }
                } else if (way - axis * rise).length() <= LEVEL {
                    Run::Along { start: line.start, way: rise }
                } else {
                    return None;
                }
            }
            CurveKind::Arc(arc) => {
                let reach = (arc.start - arc.centre).length() + arc.rise.abs();
                if arc.axis.cross(axis).length() * reach > LEVEL || arc.rise.abs() > LEVEL {
                    return None;
                }
                let out = arc.start - arc.centre;
                Run::Round { centre: arc.centre, out, side: arc.axis.cross(out), sweep: arc.sweep }
            }
            _ => return None,
        };
        Some(FixedWay { axis, run })
    }

    /// The first moment, as a fraction of the move, at which some part of the tool holds a point within a distance `slack` [mm],
    /// and that part.
    pub(super) fn first(&self, parts: &[ConvexPart], point: DVec3, slack: f64) -> Option<(f64, usize)> {
        let mut best: Option<(f64, usize)> = None;
        for (i, part) in parts.iter().enumerate() {
            let first = match self.run {
                Run::Along { start, way } => self.along(part, point - start, way, slack),
                Run::Level { start, way } => {
                    let from = point - start;
                    let reach = reach(part, from.dot(self.axis), slack);
                    reach.and_then(|reach| level(from - self.axis * from.dot(self.axis), way, reach))
                }
                Run::Round { centre, out, side, sweep } => {
                    let from = point - centre;
                    let reach = reach(part, from.dot(self.axis), slack);
                    reach.and_then(|reach| round(from, [out, side], sweep, reach))
                }
            };
            if let Some(t) = first
                && best.is_none_or(|(known, _)| t < known)
            {
                best = Some((t, i));
            }
        }
        best
    }

    /// On a way along the axis.
    fn along(&self, part: &ConvexPart, from: DVec3, way: f64, slack: f64) -> Option<f64> {
        let z = from.dot(self.axis);
        let rho = (from - self.axis * z).length();
        if rho > part.r1 + slack {
            return None;
        }
        let low = part.height(rho.min(part.r1)) - slack;
        // Heights of the point above the tip go from z to z - way.
        let [a, b] = [(z - low) / way, (z - part.top - slack) / way];
        within(a.min(b), a.max(b))
    }

    /// The tool at a moment, with rates by the fraction of the move.
    pub(super) fn pose(&self, t: f64) -> Pose {
        let (tip, tip_rate) = match self.run {
            Run::Level { start, way } => (start + way * t, way),
            Run::Along { start, way } => (start + self.axis * (way * t), self.axis * way),
            Run::Round { centre, out, side, sweep } => {
                let (sin, cos) = (sweep * t).sin_cos();
                (centre + out * cos + side * sin, (side * cos - out * sin) * sweep)
            }
        };
        Pose { tip, axis: self.axis, tip_rate, axis_rate: DVec3::ZERO }
    }
}

/// Distance from the axis up to which a part holds a point at a height [mm]; none where it holds nothing.
fn reach(part: &ConvexPart, z: f64, slack: f64) -> Option<f64> {
    if z < part.z0 - slack || z > part.top + slack {
        return None;
    }
    Some(part.radius((z + slack).clamp(part.z0, part.top)) + slack)
}

/// The first moment of an interval that lies in the move.
fn within(from: f64, to: f64) -> Option<f64> {
    (from <= 1.0 && to >= 0.0).then_some(from.max(0.0))
}

/// On a level line: the axis passes the point `from` its start by the way, within a distance.
fn level(from: DVec3, way: DVec3, reach: f64) -> Option<f64> {
    let squared = way.length_squared();
    let off = from.length_squared() - reach * reach;
    if squared == 0.0 {
        return (off <= 0.0).then_some(0.0);
    }
    let half = from.dot(way);
    let root = half * half - squared * off;
    if root < 0.0 {
        return None;
    }
    let root = root.sqrt();
    // The product of the two moments is off / squared: no difference of near numbers.
    let (near, far) = if half > 0.0 {
        (off / (half + root), (half + root) / squared)
    } else if half < root {
        ((half - root) / squared, off / (half - root))
    } else {
        (0.0, 0.0)
    };
    within(near.min(far), near.max(far))
}

/// On an arc about the axis: the point lies `from` its centre.
fn round(from: DVec3, [out, side]: [DVec3; 2], sweep: f64, reach: f64) -> Option<f64> {
    let radius = out.length();
    let (x, y) = (from.dot(out) / radius, from.dot(side) / radius);
    let distance = x.hypot(y);
    let product = 2.0 * distance * radius;
    let least = distance * distance + radius * radius - reach * reach;
    if least <= -product {
        return Some(0.0);
    }
    if least > product {
        return None;
    }
    // Half of the angle in which the axis is near enough.
    let half = (least / product).clamp(-1.0, 1.0).acos();
    // Angle of the start from the point, in the sense of the way.
    let from_point = -y.atan2(x) * sweep.signum();
    let ahead = (from_point + PI).rem_euclid(TAU) - PI;
    let turned = if ahead.abs() <= half {
        0.0
    } else if ahead < 0.0 {
        -half - ahead
    } else {
        TAU - half - ahead
    };
    (turned <= sweep.abs()).then(|| turned / sweep.abs())
}

#[cfg(test)]
mod tests {
    use super::super::body::Foot;
    use super::*;
    use crate::geom::{Arc, Curve, Line};
    use crate::num::random::Random;

    /// Looks along a way.
    const LOOKS: u32 = 4000;

    fn part(foot: Foot, r0: f64, z1: f64) -> ConvexPart {
        ConvexPart { foot, z0: 0.0, r0, z1, r1: 5.0, top: 12.0 }
    }

    /// Whether a tool of a form (cylinder, ball, cone) with its tip at the origin holds a point, by the form itself.
    fn holds(form: usize, p: DVec3) -> bool {
        let rho = p.x.hypot(p.y);
        if p.z < 0.0 || p.z > 12.0 || rho > 5.0 {
            return false;
        }
        match form {
            0 => true,
            1 => p.z >= 5.0 || (p - DVec3::Z * 5.0).length() <= 5.0,
            _ => rho <= p.z,
        }
    }

    #[test]
    fn the_first_moment_is_that_of_dense_looks() {
        let forms = [
            part(Foot::Flat, 5.0, 0.0),
            part(Foot::Torus { centre_radius: 0.0, centre_z: 5.0, radius: 5.0 }, 0.0, 5.0),
            part(Foot::Cone { rise: 1.0 }, 0.0, 5.0),
        ];
        let mut random = Random(11);
        let mut between = |low: f64, high: f64| low + (high - low) * random.share();
        let mut held = [0; 3];
        for number in 0..3000 {
            let form = number % 3;
            let mut vector =
                |size: f64| DVec3::new(between(-size, size), between(-size, size), between(-size, size));
            let (start, point) = (vector(8.0), vector(9.0));
            let curve: Curve = match number % 4 {
                0 => Line { start, end: start + (vector(14.0) * DVec3::new(1.0, 1.0, 0.0)) }.into(),
                1 => Line { start, end: start + DVec3::Z * between(-15.0, 15.0) }.into(),
                _ => {
                    let centre = start + DVec3::new(between(-7.0, 7.0), between(-7.0, 7.0), 0.0);
                    let axis = if number % 8 < 4 { DVec3::Z } else { DVec3::NEG_Z };
                    Arc::new(start, centre, axis, between(-TAU, TAU), 0.0).unwrap().into()
                }
            };
            let motion = ToolMotion::fixed(curve.clone(), DVec3::Z).unwrap();
            let way = FixedWay::of(&motion).unwrap();
            let tip = |t: f64| curve.at(t * curve.length()).p;
            let dense =
                (0..=LOOKS).map(|k| f64::from(k) / f64::from(LOOKS)).find(|t| holds(form, point - tip(*t)));
            let found = way.first(&forms[form..=form], point, 0.0);
            match (dense, found) {
                (Some(t), Some((first, 0))) => {
                    held[form] += 1;
                    assert!(
                        first <= t + 1e-9 && t - first <= 2.0 / f64::from(LOOKS),
                        "{number}: {first} {t}"
                    );
                    let pose = way.pose(first);
                    assert!((pose.tip - tip(first)).length() < 1e-9);
                    let rate = (way.pose(first + 1e-6).tip - pose.tip) * 1e6;
                    assert!((rate - pose.tip_rate).length() < 1e-3 * pose.tip_rate.length().max(1.0));
                }
                (None, None) => {}
                // A touch shorter than the looks are apart.
                (None, Some((t, _))) => assert!(
                    holds(form, (point - tip(t + 1e-9)) * (1.0 - 1e-3) + DVec3::Z * 1e-3 * 6.0),
                    "{number}: {t}"
                ),
                (t, found) => panic!("{number}: {t:?} {found:?}"),
            }
        }
        assert!(held.iter().all(|n| *n > 100), "{held:?}");
    }

    #[test]
    fn a_slope_and_a_helix_have_no_closed_form() {
        let slope = Line { start: DVec3::ZERO, end: DVec3::new(5.0, 0.0, -1.0) };
        assert!(FixedWay::of(&ToolMotion::fixed(slope.into(), DVec3::Z).unwrap()).is_none());
        let helix = Arc::new(DVec3::X, DVec3::ZERO, DVec3::Z, 4.0, -2.0).unwrap();
        assert!(FixedWay::of(&ToolMotion::fixed(helix.into(), DVec3::Z).unwrap()).is_none());
        // About another axis than that of the tool.
        let upright = Arc::new(DVec3::X, DVec3::ZERO, DVec3::Y, 1.0, 0.0).unwrap();
        assert!(FixedWay::of(&ToolMotion::fixed(upright.into(), DVec3::Z).unwrap()).is_none());
    }
}
