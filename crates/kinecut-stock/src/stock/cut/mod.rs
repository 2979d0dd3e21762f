//! Cutting: moves of a tool take their swept body out of the stock.
//!
//! Along each line the swept body is computed in closed form, or by a bracketed search where no closed form exists;
//! nothing is stamped. The tool is a union of convex parts (`body.rs`); an edge that leaves a core or a nub within them
//! is cut as it is along its axis (`hollow.rs`). A move is cut into pieces (`piece.rs`): a point, a line, an arc of at
//! most half a turn, each with a constant rise. Lines along the tool axis: `axial.rs`; lines across it: `across.rs`,
//! `across_slope.rs`. Moves that take all above their underside are cut in long runs, many lines at once (`above`); the others,
//! and what depends on the moment, line by line in order (`in_order.rs`). In long runs lines across the axis are left for later
//! (`above/late.rs`): [`TriDexel::settle`](crate::stock::TriDexel::settle) cuts them, or the first who reads one. The unit of work is a tile of lines with all moves in
//! order, so that the result does not depend on the number of threads.
//!
//! A tool that leans or turns ([`Stance::Leaning`]) is cut by the same convex parts on all three grids alike (`leaning`): its
//! motion becomes short spans, and the ends on a line are found by iteration (the tests hold 20 nm).
//!
//! **Contacts** are taken from all three grids. With lines at a distance of s, what a tool meets is found however thin
//! it is if it reaches over a step in height and, in plan, over 1.42 steps in some direction: some layer of lines
//! across the axis runs through it, and a thin strip of length L in that layer spans L / sqrt 2 >= s along one of its
//! two axes, so that a line across that axis crosses it. What is less than a step high is found by the lines along the
//! tool axis if a circle of 1.42 steps fits into it in plan. What remains is narrower than 1.42 steps **and** lower
//! than a step: a tool that clips an edge of the material, or a spike. An edge that may be clipped is found by itself
//! (`edge.rs`, [`MoveEffect::edge`]): it is no contact, and no proof that there was none.
//!
//! **Bound.** Lines, arcs and helices about the tool axis are exact up to rounding to 10 nm. Any other path is
//! replaced within [`CutOptions::path_tolerance`], and by the pose-error principle the body is off by no more:
//! [`MoveEffect::path_error`].

mod above;
mod across;
mod across_helix;
mod across_slope;
mod axial;
mod axial_helix;
mod axis;
mod body;
mod edge;
mod effect;
mod engaged;
mod face;
mod fixed_way;
mod followed;
mod hollow;
mod in_order;
mod leaning;
mod list;
mod noted;
mod piece;
mod plan;
mod playback;
mod run;
mod spared;
mod stance;
mod strip;
mod strip_cut;
mod strip_hollow;
mod strip_look;
mod task;
mod tile_axial;
mod tile_hollow;
mod upright;
mod way;

#[cfg(test)]
mod tests;

use crate::geom::{Aabb, Curve, EdgeProfile, Profile};
use crate::stock::CutId;
use crate::sweep::ToolMotion;

pub(in crate::stock) use above::FromAbove;
pub use axis::CutAxis;
pub use engaged::{EngagedStretch, MoveEngagement, adjust_volumes, engagements};
pub use face::SweptFace;
pub(in crate::stock) use leaning::{OwedAcross, may_meet_at_rest, meets_at_rest};
pub use list::CutList;
pub use playback::{Clock, Playback, PlayedFace, PlayedSurface, REMAINS};
pub use run::{cut, cut_list};
pub use spared::Spared;
pub use stance::Stance;

/// A tool: the part that cuts, and the parts that must not touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolBody {
    /// The cutting part, from the tip at z = 0 up to the end of the edges [mm].
    pub cutting: Profile,
    /// The edge of a tool that works along its axis, when it is to be cut with: then what the edge leaves within
    /// `cutting` (a core, the nub under a gun drill) stays where the tool moves along its axis. Where it moves across
    /// it the tool cuts as `cutting`, see [`MoveEffect::as_filled`].
    pub edge: Option<EdgeProfile>,
    /// Parts of the shank, each with its height above the tip [mm].
    pub shank: Vec<(Profile, f64)>,
    /// Parts of the holder, each with its height above the tip [mm].
    pub holder: Vec<(Profile, f64)>,
}

impl ToolBody {
    /// A cutting part alone.
    pub fn new(cutting: Profile) -> ToolBody {
        ToolBody { cutting, edge: None, shank: vec![], holder: vec![] }
    }
}

/// One move of a tool.
#[derive(Clone, Debug, PartialEq)]
pub struct CutMove {
    /// Path of the tool tip [mm], in the coordinates of the stock; of a move that leans, no more than where it goes about.
    pub curve: Curve,
    /// Direction from tip to holder.
    pub stance: Stance,
    /// Index of the tool in the list of bodies.
    pub body: u32,
    /// The material met is taken out; else it is only looked at.
    pub removes: bool,
    /// The cutting part should meet nothing (a rapid, a spindle at rest): then the lines across the tool axis are
    /// looked at too. Shank and holder are always looked for on all lines.
    pub watch: bool,
}

impl CutMove {
    /// A move that removes what it meets, and is meant to.
    pub fn new(curve: impl Into<Curve>, axis: CutAxis, body: u32) -> CutMove {
        CutMove { curve: curve.into(), stance: Stance::Along(axis), body, removes: true, watch: false }
    }

    /// A move of a tool that leans or turns, as [`CutMove::new`]. Its path is the motion's; an edge that leaves a core is cut
    /// as filled unless it moves along its axis. The lines along the tool axis are
    /// those along the axis of the stock that is nearest to it in the middle of the move; the length that shank or holder meet
    /// is the longest in a short stretch of the move.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use glam::DVec3;
    /// use kinecut::base::Silent;
    /// use kinecut::geom::{Aabb, Line, Profile};
    /// use kinecut::stock::TriDexel;
    /// use kinecut::stock::cut::{CutMove, CutOptions, ToolBody, cut};
    /// use kinecut::sweep::ToolMotion;
    /// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
    /// let mut stock = TriDexel::from_box(plate, 0.25).unwrap();
    /// let ball = ToolBody::new(Profile::bull_nose(8.0, 4.0, 30.0).unwrap());
    /// // The centre of the ball runs along X at the height of the top; the tool leans by 30 degrees, so that its side, too, takes
    /// // something: the part of a triangle beside the round.
    /// let axis = DVec3::new(0.0, 0.5, 0.75f64.sqrt());
    /// let tip = |x: f64| DVec3::new(x, 10.0, 0.0) - axis * 4.0;
    /// let line = Line { start: tip(-10.0), end: tip(50.0) };
    /// let motion = ToolMotion::fixed(line.into(), axis).unwrap();
    /// let moves = [CutMove::leaning(motion, line, 0)];
    /// let effects = cut(&mut stock, &[ball], &moves, &CutOptions::default(), &Silent).unwrap();
    /// let (pi, lean) = (std::f64::consts::PI, 30f64.to_radians());
    /// let section = 8.0 * pi + 8.0 * (lean.tan() - lean);
    /// assert!((effects[0].removed / (section * 40.0) - 1.0).abs() < 0.002);
    /// ```
    pub fn leaning(motion: ToolMotion, curve: impl Into<Curve>, body: u32) -> CutMove {
        let stance = Stance::Leaning(std::sync::Arc::new(motion));
        CutMove { curve: curve.into(), stance, body, removes: true, watch: false }
    }

    /// The move as one that should meet nothing, see [`CutMove::watch`].
    #[must_use]
    pub fn watched(self) -> CutMove {
        CutMove { watch: true, ..self }
    }
}

/// Options of cutting: tolerance of the path, clearance, number of the first cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutOptions {
    /// Most that a path that is no line, arc or helix about the tool axis may be off [mm]; default 0.25 um.
    pub path_tolerance: f64,
    /// Contact counts when it remains after the tool was made smaller by this on all faces [mm]; default 1 um: a
    /// tool that rubs along a wall it has cut is no collision.
    pub clearance: f64,
    /// The first move is the cut `first_cut + 1`; to chain several calls. Default 0.
    pub first_cut: CutId,
}

impl Default for CutOptions {
    fn default() -> CutOptions {
        CutOptions { path_tolerance: 2.5e-4, clearance: 1e-3, first_cut: 0 }
    }
}

/// A touch of shank or holder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyContact {
    /// Longest stretch of material met on a line along the tool axis [mm]; 0 when none of them meets any.
    pub depth: f64,
    /// Longest stretch met on a line across the tool axis [mm], of the two directions the lesser that meets any; 0 when
    /// none does. At a wall along an axis it is how far the touch reaches into the wall; at a slanting wall it is more,
    /// by up to sqrt 2 at 45 degrees.
    pub width: f64,
    /// Its place, in stock coordinates [mm].
    pub point: [f64; 3],
}

/// An edge of material that a body may clip between the lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Height of the edge above the body's underside on a line next to the body [mm]; 0 where the tool leans.
    pub height: f64,
    /// Greatest width of an overlap, about [mm].
    pub width: f64,
    /// Its place, in stock coordinates [mm].
    pub point: [f64; 3],
    /// All places where the edge was seen: an overlap is no farther than the diagonal of four lines from it in plan, and a
    /// step along the tool axis [mm].
    pub bounds: Aabb,
}

/// Effect of a move on the stock: removed volume and depths on the lines along the tool axis, contacts on all lines.
///
/// In long runs of moves that are meant to cut, `removed`, `deepest` and `first_contact` are measured on some of the lines: no more
/// than a quarter of the radius of the run's thinnest tool apart, or all where the lines of the stock are no closer; of tools that lean
/// or turn along the axis of the stock that is nearest to most of the run's tool axes, for a tool within 53 degrees of it, and farther
/// apart where a span of a long tool would pass more than 128 of them. A move
/// between those lines that leaves a surface on lines along that axis is told as removing one square of a step, [`FIXED_STEP`](crate::stock::FIXED_STEP)
/// deep; one that leaves none is told as removing nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MoveEffect {
    /// Volume of stock removed [mm^3].
    pub removed: f64,
    /// Longest stretch of material that the cutting part meets on one line along the tool axis [mm]; 0 when these lines
    /// meet nothing by more than the clearance.
    pub deepest: f64,
    /// Longest stretch that it meets on a line across the tool axis [mm], counted as [`BodyContact::width`]; looked for on
    /// watched moves only, else 0.
    pub widest: f64,
    /// The material met first on the way, by more than the clearance: a point of the stock [mm], within one grid step
    /// of the first touch. Of a move that is not watched it may be another point that is met.
    pub first_contact: Option<[f64; 3]>,
    /// A tool that leaves a core or a nub moved across its axis in material, and was cut as if it did not.
    pub as_filled: bool,
    /// Bound on how far the path that was cut is off the move's curve [mm]; 0 when it is exact.
    pub path_error: f64,
    /// What few moves have.
    rare: Option<Box<RareEffect>>,
}

/// Parts of an effect that few moves have: most of a million have a pointer to nothing instead.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct RareEffect {
    shank: Option<BodyContact>,
    holder: Option<BodyContact>,
    core: Option<BodyContact>,
    edge: Option<Edge>,
}

impl MoveEffect {
    /// Overlap of the cutting part with material [mm]: the lesser of depth and width that was met, 0 when none was.
    pub fn overlap(&self) -> f64 {
        least_met(self.deepest, self.widest)
    }

    /// Deepest touch of the shank.
    pub fn shank(&self) -> Option<BodyContact> {
        self.rare.as_ref()?.shank
    }

    /// Deepest touch of the holder.
    pub fn holder(&self) -> Option<BodyContact> {
        self.rare.as_ref()?.holder
    }

    /// Longest stretch of material within the inner radius of an edge, where nothing cuts: a core inside the tool,
    /// which needs room there. On a tool without that room (a countersink with a blunt nose) it is a collision.
    pub fn core(&self) -> Option<BodyContact> {
        self.rare.as_ref()?.core
    }

    /// An edge of material so near to what should meet none that an overlap may lie between the lines. `None` where
    /// something is met, which says more.
    pub fn edge(&self) -> Option<Edge> {
        self.rare.as_ref()?.edge
    }

    /// Sets the touches of shank and holder, and the edge.
    pub fn set_contacts(&mut self, [shank, holder]: [Option<BodyContact>; 2], edge: Option<Edge>) {
        self.set_rare(RareEffect { shank, holder, core: self.core(), edge });
    }

    fn set_rare(&mut self, rare: RareEffect) {
        self.rare = (rare != RareEffect::default()).then(|| Box::new(rare));
    }
}

impl BodyContact {
    /// Overlap of the body with material [mm]: the lesser of depth and width that was met.
    pub fn overlap(&self) -> f64 {
        least_met(self.depth, self.width)
    }
}

fn least_met(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { a.max(b) } else { a.min(b) }
}
