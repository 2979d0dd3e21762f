//! The height of a cutting edge over its distance from the tool's axis: what a drill point is to the surface it meets.
//!
//! The edge, turned about the axis, is a surface z(r) between an inner and an outer radius. Unlike a
//! [`Profile`](super::Profile) it may fall outwards (the inner edge of a gun drill), step, begin off the axis (an
//! annular drill leaves a core), and it says nothing of what follows above.

use crate::base::{Code, Finding, Result};

/// Most segments of an edge: those of a tool of five diameters, and one more. Few, because edges are copied about.
const MOST: usize = 6;

/// Overlap or gap of neighbouring segments that is rounding [mm].
const JOINED: f64 = 1e-9;

/// A piece of an edge, from the axis outwards [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeSegment {
    /// A straight edge between two points (r, z).
    Line {
        /// Inner and outer radius.
        r: [f64; 2],
        /// Heights there.
        z: [f64; 2],
    },
    /// The lower side of a circle.
    Arc {
        /// Inner and outer radius.
        r: [f64; 2],
        /// Distance of the circle's centre from the axis, and its height.
        centre: [f64; 2],
        /// Radius of the circle.
        radius: f64,
    },
}

impl EdgeSegment {
    /// Inner and outer radius [mm].
    pub fn range(&self) -> [f64; 2] {
        match *self {
            EdgeSegment::Line { r, .. } | EdgeSegment::Arc { r, .. } => r,
        }
    }

    /// Height at a radius within the range [mm].
    #[inline]
    pub fn height(&self, at: f64) -> f64 {
        match *self {
            EdgeSegment::Line { r, z } => z[0] + (z[1] - z[0]) * ((at - r[0]) / (r[1] - r[0])),
            EdgeSegment::Arc { centre, radius, .. } => {
                let d = at - centre[0];
                centre[1] - ((radius - d) * (radius + d)).clamp(0.0, f64::INFINITY).sqrt()
            }
        }
    }

    /// Rise per radius at a radius within the range.
    pub fn slope(&self, at: f64) -> f64 {
        match *self {
            EdgeSegment::Line { r, z } => (z[1] - z[0]) / (r[1] - r[0]),
            EdgeSegment::Arc { centre, radius, .. } => {
                let d = at - centre[0];
                d / ((radius - d) * (radius + d)).sqrt()
            }
        }
    }

    /// Lowest and highest height [mm].
    fn extent(&self) -> [f64; 2] {
        let [a, b] = self.range();
        let (za, zb) = (self.height(a), self.height(b));
        let (mut low, high) = if za < zb { (za, zb) } else { (zb, za) };
        if let EdgeSegment::Arc { centre, radius, .. } = *self
            && centre[0] > a
            && centre[0] < b
        {
            low = centre[1] - radius;
        }
        [low, high]
    }

    /// The part between two radii within the range.
    fn cut(&self, from: f64, to: f64) -> EdgeSegment {
        match *self {
            EdgeSegment::Line { .. } => {
                EdgeSegment::Line { r: [from, to], z: [self.height(from), self.height(to)] }
            }
            EdgeSegment::Arc { centre, radius, .. } => EdgeSegment::Arc { r: [from, to], centre, radius },
        }
    }

    fn is_finite(&self) -> bool {
        let numbers = match *self {
            EdgeSegment::Line { r, z } => [r[0], r[1], z[0], z[1], 0.0],
            EdgeSegment::Arc { r, centre, radius } => [r[0], r[1], centre[0], centre[1], radius],
        };
        numbers.iter().all(|v| v.is_finite())
    }
}

/// The cutting edge of a tool of revolution: height over distance from the axis. Heights are counted from the tool's
/// lowest cutting point, its reference point. Kept in place: copying it allocates nothing.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::EdgeProfile;
/// // A twist drill of 20 mm with a point of 118 degrees.
/// let edge = EdgeProfile::polyline(&[[0.0, 0.0], [10.0, 10.0 / 59f64.to_radians().tan()]]).unwrap();
/// assert!((edge.extent()[1] - 6.008606).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EdgeProfile {
    segments: [EdgeSegment; MOST],
    count: usize,
}

impl PartialEq for EdgeProfile {
    fn eq(&self, other: &EdgeProfile) -> bool {
        self.segments() == other.segments()
    }
}

impl EdgeProfile {
    /// An edge of segments from the axis outwards. Between two of them the height may step.
    ///
    /// # Errors
    /// `KC0801` when it has no segment or too many, a number is not finite, radii do not ascend or join, or an arc is
    /// wider than its circle.
    pub fn new(segments: &[EdgeSegment]) -> Result<EdgeProfile> {
        let fail = |what: &str, value: f64| -> Result<EdgeProfile> {
            Err(Finding::error(Code::GEOMETRY, what).value_mm(value).into())
        };
        if segments.is_empty() || segments.len() > MOST {
            return Err(Finding::error(Code::GEOMETRY, "a cutting edge has no segments or too many")
                .value(segments.len() as f64, "")
                .bound(MOST as f64, "")
                .into());
        }
        let mut at = None;
        for s in segments {
            let [a, b] = s.range();
            if !s.is_finite() {
                return fail("a cutting edge has a number that is not finite", f64::NAN);
            }
            if !(a >= 0.0 && b > a) {
                return fail("the radii of a cutting edge must ascend", b);
            }
            if at.is_some_and(|r: f64| (r - a).abs() > JOINED) {
                return fail("a cutting edge has a gap at this radius", a);
            }
            if let EdgeSegment::Arc { centre, radius, .. } = *s
                && !(radius > 0.0 && b - centre[0] <= radius + JOINED && centre[0] - a <= radius + JOINED)
            {
                return fail("an arc of a cutting edge is wider than its circle", radius);
            }
            at = Some(b);
        }
        let mut edge = EdgeProfile { segments: [segments[0]; MOST], count: segments.len() };
        edge.segments[..segments.len()].copy_from_slice(segments);
        Ok(edge)
    }

    /// An edge of straight segments through points (r, z); two points of the same radius are a step.
    ///
    /// # Errors
    /// As [`EdgeProfile::new`].
    pub fn polyline(points: &[[f64; 2]]) -> Result<EdgeProfile> {
        let mut segments = [EdgeSegment::Line { r: [0.0; 2], z: [0.0; 2] }; MOST];
        let mut count = 0;
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            // Also what is not a number goes on, to be refused.
            if a[0] == b[0] {
                continue;
            }
            if count == MOST {
                return Err(Finding::error(Code::GEOMETRY, "a cutting edge has too many segments")
                    .value(points.len() as f64, "points")
                    .bound(MOST as f64, "segments")
                    .into());
            }
            segments[count] = EdgeSegment::Line { r: [a[0], b[0]], z: [a[1], b[1]] };
            count += 1;
        }
        EdgeProfile::new(&segments[..count])
    }

    /// The segments, from the axis outwards.
    #[inline]
    pub fn segments(&self) -> &[EdgeSegment] {
        &self.segments[..self.count]
    }

    /// Least radius that cuts [mm].
    #[inline]
    pub fn inner_radius(&self) -> f64 {
        self.segments[0].range()[0]
    }

    /// Greatest radius [mm].
    #[inline]
    pub fn outer_radius(&self) -> f64 {
        self.segments[self.count - 1].range()[1]
    }

    /// Lowest and highest height [mm].
    pub fn extent(&self) -> [f64; 2] {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for s in self.segments() {
            let [low, high] = s.extent();
            if low < range[0] {
                range[0] = low;
            }
            if high > range[1] {
                range[1] = high;
            }
        }
        range
    }

    /// Height at a radius [mm], at a step the lower one; `None` where nothing cuts.
    pub fn height(&self, at: f64) -> Option<f64> {
        let here = self.segments().iter().filter(|s| at >= s.range()[0] && at <= s.range()[1]);
        here.map(|s| s.height(at)).min_by(f64::total_cmp)
    }

    /// The edge between two radii [mm]: what cuts in an annulus (a hole that is there), or up to a diameter that is
    /// reached. `None` when nothing is left.
    pub fn clipped(&self, from: f64, to: f64) -> Option<EdgeProfile> {
        if from <= self.inner_radius() && to >= self.outer_radius() {
            return Some(*self);
        }
        let mut kept = EdgeProfile { segments: self.segments, count: 0 };
        for s in self.segments() {
            let [a, b] = s.range();
            let (a, b) = (if a > from { a } else { from }, if b < to { b } else { to });
            if b > a + JOINED {
                kept.segments[kept.count] = s.cut(a, b);
                kept.count += 1;
            }
        }
        (kept.count > 0).then_some(kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_clipped_without_changing_its_heights() {
        let cannon = EdgeProfile::polyline(&[[0.0, 0.07], [0.4, 0.0], [0.4, 0.14], [10.0, 1.83]]).unwrap();
        assert_eq!(cannon.segments().len(), 2, "a step is no segment");
        assert_eq!(cannon.height(0.4), Some(0.0));
        let outer = cannon.clipped(0.4, 8.0).unwrap();
        assert_eq!((outer.inner_radius(), outer.outer_radius()), (0.4, 8.0));
        assert!((outer.height(5.0).unwrap() - cannon.height(5.0).unwrap()).abs() < 1e-15);
        assert_eq!(outer.height(0.2), None);
        assert!(cannon.clipped(10.0, 12.0).is_none());
        assert_eq!(cannon.extent(), [0.0, 1.83]);
    }

    #[test]
    fn an_arc_is_the_lower_side_of_its_circle() {
        let ball = EdgeSegment::Arc { r: [0.0, 10.0], centre: [0.0, 14.0], radius: 14.0 };
        let cap = EdgeProfile::new(&[ball]).unwrap();
        assert!((cap.extent()[1] - (14.0 - 96f64.sqrt())).abs() < 1e-12);
        assert!((ball.slope(8.0) - 8.0 / 132f64.sqrt()).abs() < 1e-12);
        let valley = EdgeSegment::Arc { r: [1.0, 9.0], centre: [5.0, 6.0], radius: 6.0 };
        assert_eq!(EdgeProfile::new(&[valley]).unwrap().extent()[0], 0.0);
    }

    #[test]
    fn what_is_no_edge_is_refused() {
        let line = |r: [f64; 2]| EdgeSegment::Line { r, z: [0.0, 1.0] };
        let wide = EdgeSegment::Arc { r: [0.0, 10.0], centre: [0.0, 9.0], radius: 9.0 };
        for bad in [
            &[][..],
            &[line([1.0, 1.0])],
            &[line([-1.0, 1.0])],
            &[line([0.0, f64::NAN])],
            &[line([0.0, 1.0]), line([1.5, 2.0])],
            &[wide],
            &[line([0.0, 1.0]); MOST + 1],
        ] {
            assert_eq!(EdgeProfile::new(bad).unwrap_err().code(), Code::GEOMETRY);
        }
        assert!(EdgeProfile::polyline(&[[0.0, 0.0]]).is_err());
    }
}
