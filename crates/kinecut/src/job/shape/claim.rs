//! The wanted surface that an end of a line of the stock belongs to, and its distance from the surface.

use glam::DVec3;

use super::wanted::Wanted;
use crate::stock::{CutId, EndPoint};

/// Ends this near to rim and floor belong to both faces and are measured on neither [mm].
pub(super) const EDGE: f64 = 1e-3;

/// Cosine above which a face counts as floor or ceiling, not as wall.
const FACES_UP: f64 = 0.7;

/// Part of its normal that a face has towards a wall's cut, at the least, where it is the bottom of a groove in the wall.
const SQUARELY: f64 = 0.9;

/// Questions about the cut that made an end of a line.
pub(super) trait Cuts {
    /// Whether the wall's own operation made a cut.
    fn own(&mut self, cut: CutId) -> bool;

    /// Whether another operation wanted to cut at a point [part coordinates].
    fn elsewhere(&self, cut: CutId, p: DVec3) -> bool;

    /// The diameter of the cutter that made a cut [mm], if its operation says nothing of the surfaces that it leaves.
    fn unwanted(&self, cut: CutId) -> Option<f64>;
}

/// The part of a wanted surface that an end is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Its wall.
    Wall,
    /// Its floor, or a milled face.
    Floor,
    /// The face beside its edge, which it does not cut: that of a chamfer.
    Beside,
    /// Nothing of it: the end lies inside of what is to be cut, on a face that is no wall.
    Within,
}

/// An end compared with a wanted surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Claim {
    /// Number of the wanted surface.
    pub(super) of: u32,
    /// The part of it.
    pub(super) side: Side,
    /// Distance [mm]: positive where stock is left, negative where the surface is gouged.
    pub(super) deviation: f32,
}

impl Claim {
    /// An end that no surface is wanted at.
    pub(super) const NONE: Claim = Claim { of: 0, side: Side::Within, deviation: f32::NAN };

    /// The claim that counts at an end: material in what anything wants cut is stock left, and the most counts; otherwise the
    /// end belongs to the nearest wanted surface. Of equal claims the first counts.
    pub(super) fn or(self, new: Claim) -> Claim {
        let (old, d) = (self.deviation, new.deviation);
        let better = if old.is_nan() {
            !d.is_nan()
        } else if old > 0.0 || d > 0.0 {
            d > old
        } else {
            d.abs() < old.abs()
        };
        if better { new } else { self }
    }
}

impl Wanted<'_> {
    /// The claim of this bore on an end at `p` [part coordinates], before which `free` of the line is empty, square to the
    /// face [mm].
    pub(super) fn claim(
        &self,
        of: u32,
        (p, end, free): (DVec3, EndPoint, f64),
        cuts: &mut impl Cuts,
    ) -> Option<Claim> {
        let q = self.to_work.point(p);
        let off = q.truncate() - self.centre;
        let radial = off.length();
        // Nothing beyond twice the size can belong to the bore.
        let size = self.wall.radius(self.top);
        if radial > 2.0 * size || q.z > self.top + size {
            return None;
        }
        if self.slug > 0.0 && radial < self.slug + EDGE {
            return None;
        }
        let claim = |side: Side, deviation: f64| Some(Claim { of, side, deviation: deviation as f32 });
        let normal = self.to_work.vector(end.normal.normal());
        let depth = self.wall.compared(off, q.z);
        let inside = depth > 0.0;
        // Above the floor, what ends on its border belongs to the wall: a step of a conical one.
        let least = |floor: f64| if q.z > floor + EDGE { EDGE } else { -EDGE };
        if let Some(floor) = self.floor
            && let over = self.wall.over_floor(off, floor)
            && normal.z > FACES_UP
            && q.z < self.top - EDGE
            && over > least(floor)
            && (inside || over > 0.0 || cuts.own(end.cut))
        {
            let above = q.z - floor;
            let others = above < -EDGE && cuts.elsewhere(end.cut, p);
            return if others { None } else { claim(Side::Floor, above) };
        }
        if let Some(slope) = self.wall.slope()
            && self.wall.beside_edge(off)
            && normal.z > FACES_UP
            && q.z > self.bottom
        {
            // A face that is higher or lower makes the chamfer wider or narrower; what another operation cuts there is its own.
            let error = (q.z - self.top) * slope.lean;
            return if cuts.elsewhere(end.cut, p) { None } else { claim(Side::Beside, error) };
        }
        let level = self.level();
        let between = q.z < self.top - EDGE && q.z > self.bottom + EDGE;
        if !between || normal.z.abs() > level {
            // Material above the floor inside the bore is stock left, whatever its face looks like.
            return if between && inside { claim(Side::Within, depth) } else { None };
        }
        let towards = || self.wall.towards_cut(off, normal.truncate());
        let wall = inside
            || cuts.own(end.cut) && towards() > 0.0
            || self.is_groove((depth, free), end.cut, cuts, towards);
        if wall { claim(Side::Wall, depth) } else { None }
    }

    /// Whether an end beyond the wall is the bottom of a groove in it that nobody wants: what looks to the wall over an empty way,
    /// cut by an operation that says nothing of its surfaces. What lies more than the cutter's diameter behind the wall is a
    /// shape of its own beside it, or one that runs out of it.
    fn is_groove(
        &self,
        (depth, free): (f64, f64),
        cut: CutId,
        cuts: &impl Cuts,
        towards: impl Fn() -> f64,
    ) -> bool {
        depth < -EDGE
            && free >= -depth
            && cuts.unwanted(cut).is_some_and(|diameter| -depth < diameter)
            && towards() > SQUARELY
    }

    /// Cosine above which a face counts as floor or ceiling: between that of the wall and that of a level face.
    fn level(&self) -> f64 {
        let upward = self.wall.slope().map_or(0.0, |slope| slope.upward());
        let between = 0.5 * (1.0 + upward);
        if between > FACES_UP { between } else { FACES_UP }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stock_left_outweighs_a_nearer_surface_and_else_the_nearest_counts() {
        let claim = |of: u32, deviation: f32| Claim { of, side: Side::Wall, deviation };
        // A drilled hole that was to be reamed: the wall is right for the drill, and 0.1 mm short for the reamer.
        assert_eq!(claim(0, 0.0).or(claim(1, 0.1)).of, 1);
        assert_eq!(claim(1, 0.1).or(claim(0, 0.0)).of, 1);
        // Reamed: beyond the wall of the drill, on that of the reamer.
        assert_eq!(claim(0, -0.1).or(claim(1, -1e-6)).of, 1);
        assert_eq!(Claim::NONE.or(claim(2, -0.3)).of, 2);
        assert_eq!(claim(2, -0.3).or(Claim::NONE).of, 2);
    }
}
