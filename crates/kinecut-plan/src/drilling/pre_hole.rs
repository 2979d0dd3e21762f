//! A hole that is there before the drill comes: what it leaves to cut, and the bottom of one that does not go through.
//!
//! The bottom of a blind pre-hole has the shape of the tool that made it. Over a line through both axes its height and
//! that of the edge are lines and arcs, so that every place where their difference can be extreme is known: knots, equal
//! slopes, and away from that line the crossings of circles of both (elsewhere the gradients of two bodies of revolution
//! point along different lines).

use glam::DVec2;

use super::Transient;
use super::region::Disc;
use super::transient::Search;
use crate::base::{Code, Finding, Result};
use crate::geom::{EdgeProfile, EdgeSegment};

/// Axes nearer than this are one [mm].
const CONCENTRIC: f64 = 1e-9;
/// Largest difference between the edge that made a bottom and the pre-hole's radius [mm].
const SAME: f64 = 1e-6;

/// A hole that is there, round and parallel to the drill [mm].
#[derive(Clone, Debug, PartialEq)]
pub struct PreHole {
    /// Its diameter.
    pub diameter: f64,
    /// Place of its axis across the drill's: along the x axis of the hole, and square to it.
    pub at: [f64; 2],
    /// Its bottom; none if it goes through.
    pub bottom: Option<Bottom>,
}

/// The bottom of a blind pre-hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bottom {
    /// Z of its lowest point [mm].
    pub height: f64,
    /// The edge that made it, from the axis to the pre-hole's radius.
    pub edge: EdgeProfile,
}

impl PreHole {
    /// A concentric hole that goes through.
    pub fn through(diameter: f64) -> PreHole {
        PreHole { diameter, at: [0.0; 2], bottom: None }
    }

    /// A concentric blind hole, its lowest point at a height, made by an edge.
    pub fn blind(diameter: f64, height: f64, edge: EdgeProfile) -> PreHole {
        PreHole { diameter, at: [0.0; 2], bottom: Some(Bottom { height, edge }) }
    }

    /// A concentric blind hole with a flat bottom.
    ///
    /// # Errors
    /// `KC0801` when the diameter is not positive.
    pub fn flat(diameter: f64, height: f64) -> Result<PreHole> {
        let edge = EdgeProfile::polyline(&[[0.0, 0.0], [0.5 * diameter, 0.0]])?;
        Ok(PreHole::blind(diameter, height, edge))
    }

    /// The same hole with its axis elsewhere [mm].
    #[must_use]
    pub fn moved(mut self, at: [f64; 2]) -> PreHole {
        self.at = at;
        self
    }

    /// True if its axis is the drill's.
    pub fn is_concentric(&self) -> bool {
        self.at[0].hypot(self.at[1]) < CONCENTRIC
    }

    /// True if it leaves an annulus to a drill all the way: it goes through, about the same axis.
    pub fn leaves_annulus(&self) -> bool {
        self.bottom.is_none() && self.is_concentric()
    }

    pub(super) fn disc(&self) -> Disc {
        Disc { centre: DVec2::from(self.at), radius: 0.5 * self.diameter }
    }

    /// True if it takes anything of what a drill would cut.
    pub(super) fn meets(&self, edge: &EdgeProfile) -> bool {
        let (disc, inner) = (self.disc(), edge.inner_radius());
        let d = disc.centre.length();
        d < disc.radius + edge.outer_radius() && !(inner > 0.0 && d + disc.radius <= inner)
    }

    /// Checks that the numbers make a hole in which the drill finds something to cut.
    pub(super) fn check(&self, edge: &EdgeProfile) -> Result<()> {
        let fail = |what: &str, value: f64, bound: f64, help: &str| {
            let finding = Finding::error(Code::DRILL_CASE, what).value_mm(value).bound_mm(bound);
            Err(finding.help(help).key("pre_hole").into())
        };
        if !(self.diameter > 0.0 && self.diameter.is_finite() && self.at.iter().all(|v| v.is_finite())) {
            let what = "the diameter of a pre-hole must be positive and its place finite";
            return fail(what, self.diameter, 0.0, "");
        }
        let reach = DVec2::from(self.at).length() + edge.outer_radius();
        let Some(bottom) = &self.bottom else {
            if reach <= 0.5 * self.diameter + CONCENTRIC {
                let what = "the pre-hole leaves nothing to cut";
                return fail(what, self.diameter, 2.0 * reach, "use a larger drill");
            }
            return Ok(());
        };
        let (inner, outer) = (bottom.edge.inner_radius(), bottom.edge.outer_radius());
        if inner > 0.0 {
            let what = "the edge that made the bottom of a pre-hole must reach its axis";
            return fail(what, inner, 0.0, "give the bottom as it stands, without a core");
        }
        if !((outer - 0.5 * self.diameter).abs() <= SAME) {
            let what = "the edge that made the bottom of a pre-hole must reach its radius";
            return fail(what, outer, 0.5 * self.diameter, "");
        }
        if !bottom.height.is_finite() {
            return fail("the bottom of a pre-hole is not at a finite height", bottom.height, 0.0, "");
        }
        Ok(())
    }

    /// The transient of an edge at the bottom, exactly; `None` if there is no bottom over the edge.
    pub(super) fn bottom_transient(&self, edge: &EdgeProfile) -> Option<Transient> {
        let bottom = self.bottom.as_ref()?;
        let distance = if self.is_concentric() { 0.0 } else { self.disc().centre.length() };
        meeting(edge, [bottom.height, 1.0], &bottom.edge, distance)
    }
}

/// The transient of an edge at a surface that another edge has made, their axes a distance apart [mm]: its height where that edge
/// has the height 0, and 1 if the two look the same way, -1 if they look at one another. `None` where they do not overlap.
pub(super) fn meeting(
    edge: &EdgeProfile,
    [height, sense]: [f64; 2],
    made: &EdgeProfile,
    distance: f64,
) -> Option<Transient> {
    let mut search = Search::new();
    for one in edge.segments() {
        for other in made.segments() {
            let pair = Pair { one, other, distance, sense };
            pair.candidates(|r, z| search.note(height + z, height + z, r));
        }
    }
    search.found.first.is_finite().then_some(search.found)
}

/// A segment of the drill's edge and one of the edge that made the surface, their axes a distance apart.
struct Pair<'a> {
    one: &'a EdgeSegment,
    other: &'a EdgeSegment,
    distance: f64,
    /// 1 where the other looks the same way, -1 where it looks at the drill.
    sense: f64,
}

impl Pair<'_> {
    /// Calls `note` with the radius about the drill and the height of the surface less that of the edge.
    fn candidates(&self, mut note: impl FnMut(f64, f64)) {
        let d = self.distance;
        let [a, b] = self.one.range();
        let [p, q] = self.other.range();
        let mut at = |r: f64, s: f64| {
            if r >= a && r <= b && s >= p && s <= q {
                note(r, self.sense * self.other.height(s) - self.one.height(r));
            }
        };
        let circles = |s: &EdgeSegment| {
            let [from, to] = s.range();
            [from, to, if let EdgeSegment::Arc { centre, .. } = s { centre[0] } else { from }]
        };
        for r in circles(self.one) {
            for s in circles(self.other) {
                if (r - s).abs() <= d && d <= r + s {
                    at(r, s);
                }
            }
            // On the line through both axes.
            at(r, (r - d).abs());
            at(r, r + d);
        }
        for s in circles(self.other) {
            at((d + s).abs(), s);
            at((d - s).abs(), s);
        }
        // Equal slopes on that line, of each branch of both.
        for side in [1.0, -1.0] {
            for other_side in [1.0, -1.0] {
                let other = branch(self.other, d, other_side).seen(self.sense);
                let x = equal_slopes(branch(self.one, 0.0, side), other);
                if let Some(x) = x.filter(|x| x * side >= 0.0 && (x - d) * other_side >= 0.0) {
                    at(x.abs(), (x - d).abs());
                }
            }
        }
    }
}

/// A segment along a line through its axis: a slope, or a circle's centre and radius.
enum Branch {
    Line(f64),
    Arc(f64, f64),
}

impl Branch {
    /// Upside down for a sense of -1: a slope is the other one, and a circle's radius counts from the other side.
    fn seen(self, sense: f64) -> Branch {
        match self {
            Branch::Line(slope) => Branch::Line(sense * slope),
            Branch::Arc(centre, radius) => Branch::Arc(centre, sense * radius),
        }
    }
}

fn branch(segment: &EdgeSegment, axis: f64, side: f64) -> Branch {
    match *segment {
        EdgeSegment::Line { r, .. } => Branch::Line(side * segment.slope(r[0])),
        EdgeSegment::Arc { centre, radius, .. } => Branch::Arc(axis + side * centre[0], radius),
    }
}

/// Place at which two branches are equally steep, along the line; `None` without one.
fn equal_slopes(one: Branch, other: Branch) -> Option<f64> {
    let x = match (one, other) {
        (Branch::Line(_), Branch::Line(_)) => return None,
        (Branch::Line(k), Branch::Arc(c, rho)) | (Branch::Arc(c, rho), Branch::Line(k)) => {
            c + rho * k / k.hypot(1.0)
        }
        (Branch::Arc(c, rho), Branch::Arc(e, sigma)) => (c * sigma - e * rho) / (sigma - rho),
    };
    x.is_finite().then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::DrillPoint;
    use proptest::prelude::*;

    fn point(kind: usize, diameter: f64) -> EdgeProfile {
        let deg = f64::to_radians;
        let points = [
            DrillPoint::SinglePlane { angle: deg(118.0) },
            DrillPoint::Flat,
            DrillPoint::Rounded { radius: 0.6 * diameter },
            DrillPoint::CornerRadius { angle: deg(118.0), radius: 0.2 * diameter },
            DrillPoint::Gun { apex: Some(0.2 * diameter), outer_angle: deg(60.0), inner_angle: deg(70.0) },
            DrillPoint::Cannon { overlap: 0.05 * diameter, edge_angle: deg(80.0) },
        ];
        points[kind].edge(diameter).unwrap()
    }

    #[test]
    fn a_flatter_bottom_is_met_by_the_tip_first() {
        // Bottom of 140 degrees and 6 mm at -20, drill of 118 degrees: tip first, the corner of the bottom last.
        let made = DrillPoint::SinglePlane { angle: 140f64.to_radians() }.edge(6.0).unwrap();
        let t = PreHole::blind(6.0, -20.0, made).bottom_transient(&point(0, 10.0)).unwrap();
        let cot = |a: f64| 1.0 / a.to_radians().tan();
        assert_eq!((t.first, t.first_radius, t.last_radius), (-20.0, 0.0, 3.0));
        assert!((t.last - (-20.0 + 3.0 * (cot(70.0) - cot(59.0)))).abs() < 1e-12);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(300))]
        /// A grid over the bottom never lies beyond its transient and comes near to it.
        #[test]
        fn no_place_of_a_bottom_is_beyond_its_transient(
            kind in 0usize..6, made in 0usize..6, diameter in 1.0..12.0f64, x in 0.0..6.0f64, centred in any::<bool>(),
        ) {
            let edge = point(kind, 10.0);
            let x = if centred { 0.0 } else { x };
            prop_assume!(x < 5.0 + 0.5 * diameter - 0.2);
            let bottom = point(made, diameter);
            let hole = PreHole::blind(diameter, -7.0, bottom).moved([0.6 * x, 0.8 * x]);
            let t = hole.bottom_transient(&edge).unwrap();
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            let n = 60;
            for s in bottom.segments() {
                let [a, b] = s.range();
                for i in 0..=n {
                    let q = a + (b - a) * f64::from(i) / f64::from(n);
                    for k in 0..2 * n {
                        let angle = std::f64::consts::PI * f64::from(k) / f64::from(n);
                        let r = (DVec2::from_angle(angle) * q + DVec2::from(hole.at)).length();
                        for e in edge.segments().iter().filter(|e| r >= e.range()[0] && r <= e.range()[1]) {
                            let z = -7.0 + s.height(q) - e.height(r);
                            low = low.min(z);
                            high = high.max(z);
                        }
                    }
                }
            }
            prop_assert!(low >= t.last - 1e-9 && high <= t.first + 1e-9, "{low} {high} {t:?}");
            prop_assert!(low - t.last < 0.6 && t.first - high < 0.6, "{low} {high} {t:?}");
        }
    }
}
