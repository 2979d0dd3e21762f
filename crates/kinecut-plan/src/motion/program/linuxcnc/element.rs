//! Elements of the planner's queue: moves, what corners have cut off from them, and the arcs in corners.
//!
//! Source: LinuxCNC 2.10, `src/emc/tp/tc.c`.

use super::shape::Shape;
use super::{CYCLE, NORMAL_SHARE, TANGENTIAL_SHARE};

/// How the planner goes from an element into the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    /// It stops.
    Stop,
    /// It stops, if the directions are not nearly the same.
    Exact,
    /// Both run at once: one slows down while the other one speeds up.
    Overlap,
    /// The next one goes on at the speed at which this one ends.
    Tangent,
}

/// An element of the queue.
#[derive(Clone, Debug)]
pub(super) struct Element<'a> {
    pub(super) shape: Shape<'a>,
    /// Index of its move.
    pub(super) piece: usize,
    pub(super) is_rapid: bool,
    /// Whether rotary axes move: corners with it get no arcs.
    pub(super) turns: bool,
    /// Present length, and that which it had at first [mm].
    pub(super) length: f64,
    pub(super) nominal: f64,
    /// Speeds that the program asks for and that the planner may reach [mm/s].
    pub(super) feed: f64,
    pub(super) fastest: f64,
    /// Acceleration of its way [mm/s^2], and the share of it along an arc.
    pub(super) acceleration: f64,
    pub(super) share: f64,
    /// Speed at which its end passes into the next element though the directions differ [mm/s].
    pub(super) kink: Option<f64>,
    /// Shares of the acceleration that such ends take: at its start, and at its end.
    pub(super) taken: [f64; 2],
    pub(super) overlaps_before: bool,
    pub(super) end: Passage,
    /// Distance by which the end may be left [mm]; zero: a quarter of the move.
    pub(super) tolerance: f64,
    /// Speed at its end that the look-ahead has found [mm/s].
    pub(super) last_speed: f64,
    /// Whether its length will not change any more.
    pub(super) is_fixed: bool,
}

impl Element<'_> {
    /// Speed that it is run at where nothing else binds [mm/s].
    pub(super) fn target(&self) -> f64 {
        self.feed.min(self.fastest)
    }

    /// The acceleration that ends without arcs leave it [mm/s^2].
    fn left(&self) -> f64 {
        self.acceleration * (1.0 - self.taken[0].max(self.taken[1]))
    }

    fn along(&self, acceleration: f64) -> f64 {
        match self.shape {
            Shape::Line { .. } | Shape::Turning(_) => acceleration,
            Shape::Arc(_) | Shape::Corner(_) => acceleration * self.share,
        }
    }

    /// The acceleration that corners are planned with: half where another element runs at the same time [mm/s^2].
    pub(super) fn overall(&self) -> f64 {
        let halved = self.overlaps_before || self.end == Passage::Overlap;
        if halved { 0.5 * self.left() } else { self.left() }
    }

    /// The same along its way.
    pub(super) fn tangential(&self) -> f64 {
        self.along(self.overall())
    }

    /// The acceleration along its way while it runs alone [mm/s^2].
    pub(super) fn alone(&self) -> f64 {
        self.along(self.left())
    }

    /// An end without an arc, for which `share` of the acceleration is taken.
    pub(super) fn set_kink(&mut self, next: &mut Element, speed: f64, share: f64) {
        self.kink = Some(speed);
        self.taken[1] = self.taken[1].max(share);
        next.taken[0] = next.taken[0].max(share);
    }

    pub(super) fn forget_kink(&mut self, next: &mut Element) {
        self.kink = None;
        self.taken[1] = 0.0;
        next.taken[0] = 0.0;
    }

    /// Passes into the next element this way.
    pub(super) fn pass(&mut self, next: &mut Element, end: Passage) {
        self.end = end;
        next.overlaps_before = end == Passage::Overlap;
    }

    /// No element is shorter than one cycle.
    pub(super) fn hold_for_a_cycle(&mut self) {
        self.fastest = self.fastest.min(self.length / CYCLE);
    }

    /// Along an arc the acceleration across it is bounded, and what it leaves is along it.
    pub(super) fn bend(&mut self) {
        /// Angle below which an arc is none [rad].
        const NONE: f64 = 1e-6;
        let (radius, angle) = match &self.shape {
            Shape::Line { .. } | Shape::Turning(_) => return,
            // The planner's own radius of a helix.
            Shape::Arc(arc) => (arc.rise * arc.rise / arc.radius() + arc.radius(), arc.angle),
            Shape::Corner(corner) => (corner.radius(), corner.angle),
        };
        if angle < NONE {
            return;
        }
        let most = self.overall();
        let across = self.fastest * self.fastest / radius;
        self.share = TANGENTIAL_SHARE;
        if across > NORMAL_SHARE * most {
            self.fastest = (NORMAL_SHARE * most * radius).sqrt();
        } else {
            self.share = (1.0 - (across / most).powi(2)).sqrt();
        }
    }

    /// Its length will not change any more.
    pub(super) fn fix(&mut self) {
        if !self.is_fixed {
            self.hold_for_a_cycle();
            self.bend();
            self.is_fixed = true;
        }
    }
}
