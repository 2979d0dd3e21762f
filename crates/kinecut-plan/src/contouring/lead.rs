//! The ways on and off the path: a straight line and an arc that is tangent to it, where there is room.

use glam::DVec2;

use crate::geom::OutlineEdge;

/// A lead, by its shape before it is placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lead {
    /// Radius of the arc [mm].
    pub(super) radius: f64,
    /// Angle of the arc [rad]: a quarter turn where there is room to the side.
    pub(super) angle: f64,
    /// Length of the line [mm].
    pub(super) line: f64,
}

impl Lead {
    /// No way on and off: straight down and up.
    pub(super) const NONE: Lead = Lead { radius: 0.0, angle: 0.0, line: 0.0 };

    /// The way on to a path at a point with its direction of travel, from its left side or its right: line, then arc.
    pub(super) fn on(&self, at: DVec2, along: DVec2, from_left: bool) -> Vec<OutlineEdge> {
        let off: Vec<OutlineEdge> = self.off(at, -along, !from_left);
        off.iter().rev().map(OutlineEdge::reversed).collect()
    }

    /// The way off it: arc, then line.
    pub(super) fn off(&self, at: DVec2, along: DVec2, to_left: bool) -> Vec<OutlineEdge> {
        if self.radius <= 0.0 {
            return Vec::new();
        }
        let side = if to_left { 1.0 } else { -1.0 };
        let aside = side * along.perp();
        let centre = at + self.radius * aside;
        let from = (-aside).to_angle();
        let arc = OutlineEdge::arc(centre, self.radius, from, side * self.angle);
        let arc = OutlineEdge { start: at, ..arc };
        let ahead = DVec2::from_angle(arc.heading(1.0));
        let mut edges = vec![arc];
        if self.line > 0.0 {
            edges.push(OutlineEdge::line(arc.end, arc.end + self.line * ahead));
        }
        edges
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn leads_are_tangent_and_come_from_their_side() {
        for (angle, line) in [(0.2, 0.3), (0.3, 0.0), (0.5 * std::f64::consts::PI, 1.0)] {
            let lead = Lead { radius: 3.0, angle, line };
            let aside = 3.0 * (1.0 - f64::cos(angle)) + line * f64::sin(angle);
            for left in [true, false] {
                let on = lead.on(dvec2(5.0, 2.0), DVec2::X, left);
                let off = lead.off(dvec2(5.0, 2.0), DVec2::X, left);
                let side = |p: DVec2| if left { p.y - 2.0 } else { 2.0 - p.y };
                for (ends, free) in [(&on, on[0].start), (&off, off[off.len() - 1].end)] {
                    assert!((side(free) - aside).abs() < 1e-12, "{angle} {line} {left} {}", side(free));
                    assert!(ends.windows(2).all(|w| {
                        w[0].end.distance(w[1].start) < 1e-12
                            && crate::num::angle::wrap(w[1].heading(0.0) - w[0].heading(1.0)).abs() < 1e-9
                    }));
                }
                let last = on[on.len() - 1];
                assert!(last.end.distance(dvec2(5.0, 2.0)) < 1e-12 && last.heading(1.0).sin().abs() < 1e-9);
                assert!(last.heading(1.0).cos() > 0.0 && off[0].heading(0.0).cos() > 1.0 - 1e-9);
            }
        }
    }
}
