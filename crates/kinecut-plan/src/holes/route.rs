//! The moves of a plan, made one after the other: straight, up and down, along edges.

use glam::{DVec2, DVec3};

use super::{PlannedMove, ToolpathPace, ToolpathRole};
use crate::base::Result;
use crate::geom::{Arc, Curve, Line, OutlineEdge};

/// Moves shorter than this are dropped [mm].
const NOTHING: f64 = 1e-9;

/// The moves so far.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    pub(crate) moves: Vec<PlannedMove>,
    here: Option<DVec3>,
    pub(crate) level: u32,
    pub(crate) finishing: bool,
    pub(crate) comp: bool,
    /// Height of the moves over the part [mm].
    retract_z: f64,
    /// Height at which rapids down end [mm].
    approach_z: f64,
}

impl Route {
    pub(crate) fn new(retract_z: f64, approach_z: f64) -> Route {
        Route {
            moves: Vec::new(),
            here: None,
            level: 0,
            finishing: false,
            comp: false,
            retract_z,
            approach_z,
        }
    }

    fn add(&mut self, role: ToolpathRole, pace: ToolpathPace, curve: Curve) {
        let (level, finishing, comp) = (self.level, self.finishing, self.comp);
        self.moves.push(PlannedMove { role, curve, pace, level, finishing, comp });
    }

    /// Straight to a place; the first call only says where the moves begin.
    pub(crate) fn to(&mut self, role: ToolpathRole, pace: ToolpathPace, end: DVec3) {
        if let Some(start) = self.here
            && start.distance(end) > NOTHING
        {
            self.add(role, pace, Line { start, end }.into());
        }
        self.here = Some(end);
    }

    /// Straight up or down.
    pub(crate) fn vertically(&mut self, role: ToolpathRole, pace: ToolpathPace, z: f64) {
        if let Some(here) = self.here {
            self.to(role, pace, DVec3::new(here.x, here.y, z));
        }
    }

    /// Up, over to a place, and down to the height at which feeds begin.
    pub(crate) fn over(&mut self, at: DVec2) {
        self.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, self.retract_z);
        self.to(ToolpathRole::Link, ToolpathPace::Rapid, at.extend(self.retract_z));
        self.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, self.approach_z);
    }

    /// Up to the height of the moves over the part.
    pub(crate) fn retract(&mut self) {
        self.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, self.retract_z);
    }

    /// Place of the tip, once the moves have begun.
    pub(crate) fn place(&self) -> Option<DVec3> {
        self.here
    }

    /// Along a curve from the present place to an end, which is said exactly.
    pub(crate) fn along(&mut self, role: ToolpathRole, pace: ToolpathPace, curve: Curve, end: DVec3) {
        self.add(role, pace, curve);
        self.here = Some(end);
    }

    /// Height of the tip; infinitely high before the first move [mm].
    pub(crate) fn height(&self) -> f64 {
        self.here.map_or(f64::INFINITY, |here| here.z)
    }

    /// Along edges at the present height.
    ///
    /// # Errors
    /// Those of arcs.
    pub(crate) fn edges(&mut self, role: ToolpathRole, feed: f64, edges: &[OutlineEdge]) -> Result<()> {
        let z = self.height();
        edges.iter().try_for_each(|edge| self.edge(role, ToolpathPace::Feed(feed), edge, [z, z]))
    }

    /// Along an edge between two heights.
    ///
    /// # Errors
    /// Those of arcs.
    pub(crate) fn edge(
        &mut self,
        role: ToolpathRole,
        pace: ToolpathPace,
        edge: &OutlineEdge,
        [from, to]: [f64; 2],
    ) -> Result<()> {
        // From where the last move has ended: rounding of places along a track must not leave a gap.
        let start = self.here.map_or(edge.start, DVec3::truncate).extend(from);
        let curve = match edge.turn {
            None => Line { start, end: edge.end.extend(to) }.into(),
            Some(t) => Arc::new(start, t.centre.extend(from), DVec3::Z, t.sweep, to - from)?.into(),
        };
        self.add(role, pace, curve);
        self.here = Some(edge.end.extend(to));
        Ok(())
    }
}
