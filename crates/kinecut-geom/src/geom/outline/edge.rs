//! An edge of an outline: a straight line or a circular arc, kept exactly.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use crate::num::angle::wrap_positive;

/// An edge of an outline, travelled from `start` to `end`. In an [`Outline`](super::Outline) the material lies on the
/// right of the direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineEdge {
    /// First point [mm].
    pub start: DVec2,
    /// Last point [mm]; equal to `start` for a full circle.
    pub end: DVec2,
    /// The circle it follows; `None`: it is straight.
    pub turn: Option<Turn>,
    /// Index of the edge's label in the outline; [`OutlineEdge::NO_LABEL`]: none.
    pub label: u32,
}

/// The circle of a circular edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Centre [mm].
    pub centre: DVec2,
    /// Radius [mm].
    pub radius: f64,
    /// Polar angle of the edge's first point [rad].
    pub from: f64,
    /// Angle travelled, counter-clockwise positive [rad]; 2 pi at most.
    pub sweep: f64,
}

impl Turn {
    /// True if material on the right of the travel lies inside the circle.
    pub fn convex(&self) -> bool {
        self.sweep < 0.0
    }

    /// Whether it turns so little that its points are known better from its ends than from its centre.
    fn is_flat(&self) -> bool {
        const FLAT: f64 = 1e-3;
        self.sweep.abs() < FLAT
    }
}

impl OutlineEdge {
    /// The label of an edge that has none, in an outline where others have one.
    pub const NO_LABEL: u32 = u32::MAX;

    /// A straight edge.
    pub fn line(start: DVec2, end: DVec2) -> OutlineEdge {
        OutlineEdge { start, end, turn: None, label: 0 }
    }

    /// A circular edge from polar angle `from` over `sweep` [rad].
    pub fn arc(centre: DVec2, radius: f64, from: f64, sweep: f64) -> OutlineEdge {
        let at = |a: f64| centre + radius * DVec2::from_angle(a);
        let full = sweep.abs() >= TAU;
        OutlineEdge {
            start: at(from),
            end: if full { at(from) } else { at(from + sweep) },
            turn: Some(Turn { centre, radius, from, sweep: sweep.clamp(-TAU, TAU) }),
            label: 0,
        }
    }

    /// The edge of a DXF bulge, tan(sweep / 4), counter-clockwise positive; 0 is straight.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::dvec2;
    /// use kinecut::geom::OutlineEdge;
    /// let half = OutlineEdge::bulge(dvec2(1.0, 0.0), dvec2(-1.0, 0.0), 1.0);
    /// assert!((half.length() - std::f64::consts::PI).abs() < 1e-15);
    /// assert!((half.at(0.5) - dvec2(0.0, 1.0)).length() < 1e-15);
    /// ```
    pub fn bulge(start: DVec2, end: DVec2, bulge: f64) -> OutlineEdge {
        let chord = end - start;
        // The centre lies off the middle of the chord: (1 - b^2) / (4 b) of its length.
        let aside = (1.0 - bulge * bulge) / (4.0 * bulge);
        let centre = 0.5 * (start + end) + aside * chord.perp();
        if bulge == 0.0 || !centre.is_finite() || chord == DVec2::ZERO {
            return OutlineEdge::line(start, end);
        }
        let out = start - centre;
        let turn = Turn { centre, radius: out.length(), from: out.y.atan2(out.x), sweep: 4.0 * bulge.atan() };
        OutlineEdge { start, end, turn: Some(turn), label: 0 }
    }

    /// The same edge with another label.
    #[must_use]
    pub fn labelled(self, label: u32) -> OutlineEdge {
        OutlineEdge { label, ..self }
    }

    /// Length [mm].
    pub fn length(&self) -> f64 {
        match self.turn {
            None => (self.end - self.start).length(),
            Some(t) => t.radius * t.sweep.abs(),
        }
    }

    /// The point at the share `s` of the length, 0 at the start, 1 at the end [mm].
    pub fn at(&self, s: f64) -> DVec2 {
        match self.turn {
            _ if s == 0.0 => self.start,
            _ if s == 1.0 => self.end,
            None => self.start + s * (self.end - self.start),
            // The centre of a flat arc is so far away that its rounding shows: from the start, along the chord.
            Some(t) if t.is_flat() => {
                let half = 0.5 * s * t.sweep;
                self.start + 2.0 * t.radius * half.sin() * DVec2::from_angle(t.from + half).perp()
            }
            Some(t) => t.centre + t.radius * DVec2::from_angle(t.from + s * t.sweep),
        }
    }

    /// Direction of travel at the share `s` of the length [rad].
    pub fn heading(&self, s: f64) -> f64 {
        match self.turn {
            None => {
                let d = self.end - self.start;
                d.y.atan2(d.x)
            }
            Some(t) => t.from + s * t.sweep + FRAC_PI_2.copysign(t.sweep),
        }
    }

    /// Direction away from the material, which lies on the right of the travel [rad].
    pub fn outward(&self, s: f64) -> f64 {
        self.heading(s) + FRAC_PI_2
    }

    /// The part of the edge between two shares of its length.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::DVec2;
    /// use kinecut::geom::OutlineEdge;
    /// let half = OutlineEdge::arc(DVec2::ZERO, 2.0, 0.0, std::f64::consts::PI);
    /// let last = half.part(0.75, 1.0);
    /// assert!((last.length() - 0.25 * half.length()).abs() < 1e-15 && last.end == half.end);
    /// ```
    #[must_use]
    pub fn part(&self, from: f64, to: f64) -> OutlineEdge {
        let turn =
            self.turn.map(|t| Turn { from: t.from + from * t.sweep, sweep: (to - from) * t.sweep, ..t });
        OutlineEdge { start: self.at(from), end: self.at(to), turn, label: self.label }
    }

    /// The same edge travelled the other way.
    #[must_use]
    pub fn reversed(&self) -> OutlineEdge {
        let turn = self.turn.map(|t| Turn { from: t.from + t.sweep, sweep: -t.sweep, ..t });
        OutlineEdge { start: self.end, end: self.start, turn, label: self.label }
    }

    /// The edge turned about the origin by `angle` [rad], then moved by `shift` [mm].
    #[must_use]
    pub fn moved(&self, angle: f64, shift: DVec2) -> OutlineEdge {
        let turned = |p: DVec2| DVec2::from_angle(angle).rotate(p) + shift;
        OutlineEdge {
            start: turned(self.start),
            end: turned(self.end),
            turn: self.turn.map(|t| Turn { centre: turned(t.centre), from: t.from + angle, ..t }),
            label: self.label,
        }
    }

    /// The edge with `y` and `-y` exchanged, travelled the other way: material that was on the right still is.
    #[must_use]
    pub fn mirrored(&self) -> OutlineEdge {
        let flip = |p: DVec2| DVec2::new(p.x, -p.y);
        let flipped = OutlineEdge {
            start: flip(self.start),
            end: flip(self.end),
            turn: self.turn.map(|t| Turn {
                centre: flip(t.centre),
                from: -t.from,
                sweep: -t.sweep,
                radius: t.radius,
            }),
            label: self.label,
        };
        flipped.reversed()
    }

    /// Least and greatest value of `direction . point` over the edge.
    pub fn extent(&self, direction: DVec2) -> [f64; 2] {
        let (a, b) = (direction.dot(self.start), direction.dot(self.end));
        let mut extent = if a < b { [a, b] } else { [b, a] };
        if let Some(t) = self.turn {
            let size = direction.length();
            let middle = direction.dot(t.centre);
            let towards = direction.y.atan2(direction.x);
            if self.passes(towards) {
                extent[1] = middle + t.radius * size;
            }
            if self.passes(towards + PI) {
                extent[0] = middle - t.radius * size;
            }
        }
        extent
    }

    /// True if a circular edge passes the polar angle about its centre [rad]; a straight one never does.
    pub fn passes(&self, angle: f64) -> bool {
        self.turn.is_some_and(|t| {
            let gone = if t.sweep > 0.0 { angle - t.from } else { t.from - angle };
            wrap_positive(gone) <= t.sweep.abs()
        })
    }

    /// The place nearest to a point, as the share of the length, and its distance [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::{DVec2, dvec2};
    /// use kinecut::geom::OutlineEdge;
    /// let quarter = OutlineEdge::arc(DVec2::ZERO, 2.0, 0.0, std::f64::consts::FRAC_PI_2);
    /// let (share, distance) = quarter.nearest(dvec2(3.0, 3.0));
    /// assert!((share - 0.5).abs() < 1e-15 && (distance - (18f64.sqrt() - 2.0)).abs() < 1e-12);
    /// assert_eq!(quarter.nearest(dvec2(5.0, -1.0)).0, 0.0);
    /// ```
    pub fn nearest(&self, point: DVec2) -> (f64, f64) {
        let share = match self.turn {
            None => {
                let along = self.end - self.start;
                ((point - self.start).dot(along) / along.length_squared()).clamp(0.0, 1.0)
            }
            Some(t) => {
                let out = point - t.centre;
                let towards = out.y.atan2(out.x);
                if self.passes(towards) {
                    let gone = if t.sweep > 0.0 { towards - t.from } else { t.from - towards };
                    wrap_positive(gone) / t.sweep.abs()
                } else {
                    f64::from(u8::from(point.distance(self.start) > point.distance(self.end)))
                }
            }
        };
        (share, self.at(share).distance(point))
    }

    /// The place nearest to a point, without angles: its distance, and how far the point is beyond it on the side away from the
    /// material [mm]. [`EdgeFoot::share`] gives the place itself.
    pub(super) fn foot(&self, point: DVec2) -> EdgeFoot {
        let at_end = |is_end: bool| {
            let (end, share) = if is_end { (self.end, 1.0) } else { (self.start, 0.0) };
            let (along, rest) = (self.direction_at(is_end), point - end);
            EdgeFoot { distance: rest.length(), side: along.perp_dot(rest), place: FootPlace::Share(share) }
        };
        match self.turn {
            None => {
                let along = self.end - self.start;
                let share = (point - self.start).dot(along) / along.length_squared();
                // What is not a number is neither.
                if share <= 0.0 || share >= 1.0 {
                    return at_end(share >= 1.0);
                }
                let rest = point - (self.start + share * along);
                let side = along.perp_dot(rest) / along.length();
                EdgeFoot { distance: rest.length(), side, place: FootPlace::Share(share) }
            }
            Some(t) => {
                let out = point - t.centre;
                let sense = t.sweep.signum();
                let (first, last) = (self.start - t.centre, self.end - t.centre);
                let behind = |from: DVec2, to: DVec2| sense * from.perp_dot(to) >= 0.0;
                // A whole circle ends where it began.
                let passes = if t.sweep.abs() >= TAU * (1.0 - 1e-12) {
                    true
                } else if t.sweep.abs() <= PI {
                    behind(first, out) && behind(out, last)
                } else {
                    !(sense * last.perp_dot(out) > 0.0 && sense * out.perp_dot(first) > 0.0)
                };
                if !passes {
                    let is_end = point.distance_squared(self.start) > point.distance_squared(self.end);
                    return at_end(is_end);
                }
                let beyond = if t.is_flat() {
                    (point - self.start).dot(out + first) / (out.length() + first.length())
                } else {
                    out.length() - t.radius
                };
                EdgeFoot { distance: beyond.abs(), side: -sense * beyond, place: FootPlace::Towards(out) }
            }
        }
    }

    /// Unit direction of travel at the start or the end.
    fn direction_at(&self, is_end: bool) -> DVec2 {
        match self.turn {
            None => (self.end - self.start).normalize_or_zero(),
            Some(t) => {
                let out = (if is_end { self.end } else { self.start } - t.centre) / t.radius;
                t.sweep.signum() * out.perp()
            }
        }
    }

    /// The points that lie on a circle too, two at most; where they only touch, one, none or two.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::{DVec2, dvec2};
    /// use kinecut::geom::OutlineEdge;
    /// let line = OutlineEdge::line(dvec2(-5.0, 3.0), dvec2(1.0, 3.0));
    /// let on: Vec<DVec2> = line.on_circle(DVec2::ZERO, 5.0).collect();
    /// assert!(on.len() == 1 && (on[0] - dvec2(-4.0, 3.0)).length() < 1e-15);
    /// ```
    pub fn on_circle(&self, centre: DVec2, radius: f64) -> impl Iterator<Item = DVec2> {
        let mut found = [None; 2];
        match self.turn {
            None => {
                let along = self.end - self.start;
                let length = along.length();
                let t = along / length;
                let foot = (centre - self.start).dot(t);
                let aside = (centre - self.start).perp_dot(t);
                let half = (radius * radius - aside * aside).sqrt();
                for (slot, s) in found.iter_mut().zip([foot - half, foot + half]) {
                    // What is not a number is not within.
                    *slot = (s >= 0.0 && s <= length).then(|| self.start + s * t);
                }
            }
            Some(t) => {
                let off = t.centre - centre;
                let d = off.length();
                // Along the line of the centres, from that of the circle, and square to it.
                let along = (d * d + radius * radius - t.radius * t.radius) / (2.0 * d);
                let half = (radius * radius - along * along).sqrt();
                let out = off / d;
                for (slot, side) in found.iter_mut().zip([half, -half]) {
                    let p = centre + along * out + side * out.perp();
                    let towards = p - t.centre;
                    *slot = (p.is_finite() && self.passes(towards.y.atan2(towards.x))).then_some(p);
                }
            }
        }
        found.into_iter().flatten()
    }

    /// Its curvature, to the left positive (1/mm).
    pub(in crate::geom) fn curvature(&self) -> f64 {
        self.turn.map_or(0.0, |t| t.sweep.signum() / t.radius)
    }

    /// Twice the area between the edge and the origin, counter-clockwise positive [mm2].
    pub(in crate::geom) fn twice_area(&self) -> f64 {
        let triangle = self.start.perp_dot(self.end);
        triangle + self.turn.map_or(0.0, |t| t.radius * t.radius * (t.sweep - t.sweep.sin()))
    }
}

/// The place of an edge that is nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeFoot {
    /// Distance of the point [mm].
    pub(super) distance: f64,
    /// Distance of the point from the tangent there, positive on the side away from the material [mm].
    pub(super) side: f64,
    place: FootPlace,
}

/// A place on an edge.
#[derive(Clone, Copy, Debug)]
enum FootPlace {
    /// At a share of the length.
    Share(f64),
    /// Of an arc, in a direction from its centre.
    Towards(DVec2),
}

impl EdgeFoot {
    /// The share of the length at which it is, on its edge.
    pub(super) fn share(&self, edge: &OutlineEdge) -> f64 {
        match (self.place, edge.turn) {
            (FootPlace::Share(share), _) => share,
            (FootPlace::Towards(out), Some(t)) => {
                let towards = out.y.atan2(out.x);
                let gone = if t.sweep > 0.0 { towards - t.from } else { t.from - towards };
                let share = wrap_positive(gone) / t.sweep.abs();
                // Within rounding before the start.
                if share > 1.0 { f64::from(u8::from(share < 0.5 + PI / t.sweep.abs())) } else { share }
            }
            (FootPlace::Towards(_), None) => 0.0,
        }
    }
}

/// A closed loop of an outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutlineLoop {
    /// Its edges.
    pub edges: std::ops::Range<usize>,
    /// Whether the material lies inside the loop.
    pub outer: bool,
}
