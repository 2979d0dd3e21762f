//! Shapes of moves as the planner runs along them: straight lines, circular arcs, and the arcs that it puts into corners.

use glam::{DQuat, DVec3};

use super::super::joint::AXES;
use crate::trace::{AxisJet, AxisPath};

/// Axes along a length: that of X Y Z together [mm], or of the rotary axes where those stand [rad].
#[derive(Clone, Debug)]
pub(super) enum Shape<'a> {
    Line {
        from: [f64; AXES],
        rates: [f64; AXES],
    },
    Arc(Arc),
    Corner(Corner),
    /// A move in which the tool turns while its tip keeps to its way, along its own parameter.
    Turning(AxisPath<'a>),
}

/// A circular arc or helix.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    /// On the axis, at the height of the start [mm].
    pub(super) centre: DVec3,
    /// From there to the start [mm].
    pub(super) start: DVec3,
    /// Unit vector about which it turns counter-clockwise.
    pub(super) normal: DVec3,
    /// How far it turns [rad], above zero.
    pub(super) angle: f64,
    /// Along the normal [mm].
    pub(super) rise: f64,
    /// Rotary axes at its start, and their rates by its length.
    pub(super) rotary: [[f64; 3]; 2],
}

/// An arc in a corner, behind what is left of a line that it took.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    /// Length of that line, before `start` [mm].
    pub(super) line: f64,
    /// Direction of the move before.
    pub(super) along: DVec3,
    /// Unit vector about which it turns.
    pub(super) binormal: DVec3,
    pub(super) start: DVec3,
    pub(super) centre: DVec3,
    /// From the centre to its start and to its end [mm].
    pub(super) radii: [DVec3; 2],
    pub(super) angle: f64,
    /// Rotary axes, which stand.
    pub(super) rotary: [f64; 3],
}

impl Shape<'_> {
    /// Unit vector along the way of X Y Z at the start, or of the arc's circle at its end; zero where they stand.
    pub(super) fn tangent(&self, at_end: bool) -> DVec3 {
        match self {
            Shape::Line { rates, .. } => DVec3::from_slice(rates).normalize_or_zero(),
            Shape::Arc(arc) => arc.tangent(if at_end { arc.angle } else { 0.0 }),
            Shape::Corner(corner) => corner.tangent(at_end),
            Shape::Turning(path) => {
                let jets = path.at(if at_end { path.length() } else { 0.0 });
                DVec3::new(jets[0].d1, jets[1].d1, jets[2].d1).normalize_or_zero()
            }
        }
    }

    /// Axes at a place, with their derivatives by it.
    pub(super) fn at(&self, s: f64) -> [AxisJet; AXES] {
        let jet = |q: f64, d1: f64, d2: f64| AxisJet { q, d1, d2, d3: 0.0 };
        match self {
            Shape::Line { from, rates } => {
                std::array::from_fn(|a| jet(from[a] + rates[a] * s, rates[a], 0.0))
            }
            Shape::Arc(arc) => {
                let rate = arc.angle / arc.length();
                let radial = arc.radial(rate * s);
                let p = arc.centre + radial + arc.normal * (arc.rise / arc.length() * s);
                let d1 = arc.normal.cross(radial) * rate + arc.normal * (arc.rise / arc.length());
                let d2 = -radial * rate * rate;
                let [from, rates] = arc.rotary;
                std::array::from_fn(|a| match a {
                    0..3 => jet(p[a], d1[a], d2[a]),
                    _ => jet(from[a - 3] + rates[a - 3] * s, rates[a - 3], 0.0),
                })
            }
            Shape::Corner(corner) => {
                let [p, d1, d2] = corner.at(s);
                std::array::from_fn(|a| match a {
                    0..3 => jet(p[a], d1[a], d2[a]),
                    _ => jet(corner.rotary[a - 3], 0.0, 0.0),
                })
            }
            Shape::Turning(path) => path.at(s.min(path.length())),
        }
    }
}

impl Arc {
    pub(super) fn radius(&self) -> f64 {
        self.start.length()
    }

    pub(super) fn length(&self) -> f64 {
        (self.radius() * self.angle).hypot(self.rise)
    }

    fn radial(&self, angle: f64) -> DVec3 {
        DQuat::from_axis_angle(self.normal, angle) * self.start
    }

    /// Point after an angle [rad].
    pub(super) fn point(&self, angle: f64) -> DVec3 {
        self.centre + self.radial(angle) + self.normal * (self.rise * angle / self.angle)
    }

    pub(super) fn tangent(&self, angle: f64) -> DVec3 {
        (self.normal.cross(self.radial(angle)) + self.normal * (self.rise / self.angle)).normalize_or_zero()
    }

    /// The same arc of a smaller angle, from its start or up to its end; `None` of a helix, which is never cut.
    pub(super) fn cut(&self, angle: f64, keeps_end: bool) -> Option<Arc> {
        /// Square of the rise from which an arc is a helix [mm^2].
        const HELIX: f64 = 1e-6;
        if !(angle > 1e-8) || self.rise * self.rise > HELIX {
            return None;
        }
        let start = if keeps_end { self.radial(self.angle - angle) } else { self.start };
        Some(Arc { start, angle, rise: self.rise * angle / self.angle, ..self.clone() })
    }
}

impl Corner {
    /// Radius at its start [mm].
    pub(super) fn radius(&self) -> f64 {
        self.radii[0].length()
    }

    pub(super) fn length(&self) -> f64 {
        self.radius() * self.angle + self.line
    }

    pub(super) fn tangent(&self, at_end: bool) -> DVec3 {
        let radial = self.radii[usize::from(at_end)];
        let spiral = (self.radii[1].length() - self.radius()) / self.angle;
        (radial.normalize_or_zero() * spiral + self.binormal.cross(radial)).normalize_or_zero()
    }

    fn at(&self, s: f64) -> [DVec3; 3] {
        let net = s - self.line;
        if net <= 0.0 && self.line > 0.0 {
            return [self.start + self.along * net, self.along, DVec3::ZERO];
        }
        let (radius, sine) = (self.radius(), self.angle.sin());
        let angle = net / radius;
        let [from, to] = self.radii;
        let radial = (from * (self.angle - angle).sin() + to * angle.sin()) / sine;
        let d1 = (to * angle.cos() - from * (self.angle - angle).cos()) / (sine * radius);
        [self.centre + radial, d1, -radial / (radius * radius)]
    }
}
