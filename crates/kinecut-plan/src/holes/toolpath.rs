//! The list of moves of a plan, built move by move so that each starts where the last one ended.
//!
//! Built counter-clockwise about the origin; a clockwise plan is its mirror image x -> -x. Placed in the setup's
//! frame when a move is added.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::spec::{BoreSpec, Sense};
use crate::base::Result;
use crate::geom::{Arc, Curve, Line, PlaneCurve, Rise, on_circle};

/// Purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolpathRole {
    /// Rapid down towards the material.
    Approach,
    /// Feed down into it.
    Entry,
    /// Spiral outwards.
    Rough,
    /// Circle that leaves an even wall or floor.
    Circle,
    /// Tangential way to the wall.
    LeadIn,
    /// Circle at the finished wall.
    Finish,
    /// Tangential way from the wall.
    LeadOut,
    /// Rapid between passes, inside the bore.
    Link,
    /// Rapid up to the safe plane.
    Retract,
}

/// Speed of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolpathPace {
    /// As fast as the machine can.
    Rapid,
    /// At a path speed [mm/s].
    Feed(f64),
}

/// A move of the cutter's tip centre.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedMove {
    /// Purpose.
    pub role: ToolpathRole,
    /// The exact curve, in the frame of the setup [mm].
    pub curve: Curve,
    /// Speed.
    pub pace: ToolpathPace,
    /// Level, from 0 for each of roughing and finishing.
    pub level: u32,
    /// Whether it belongs to finishing.
    pub finishing: bool,
    /// Whether the control compensates it by the wear register. The first move that it compensates, and the first
    /// after the last, are straight.
    pub comp: bool,
}

/// Moves shorter than this are dropped [mm]: rounding of a place that is reached already.
const NOTHING: f64 = 1e-9;

/// The moves so far.
pub(super) struct Toolpath {
    pub(super) moves: Vec<PlannedMove>,
    /// Position, counter-clockwise about the origin.
    here: Option<DVec3>,
    pub(super) level: u32,
    pub(super) finishing: bool,
    pub(super) comp: bool,
    mirrored: bool,
    centre: DVec2,
}

impl Toolpath {
    pub(super) fn new(spec: &BoreSpec) -> Toolpath {
        Toolpath {
            moves: Vec::new(),
            here: None,
            level: 0,
            finishing: false,
            comp: false,
            mirrored: spec.sense == Sense::Conventional,
            centre: DVec2::from_array(spec.centre),
        }
    }

    fn place(&self, p: DVec3) -> DVec3 {
        let x = if self.mirrored { -p.x } else { p.x };
        DVec3::new(x + self.centre.x, p.y + self.centre.y, p.z)
    }

    pub(super) fn is_clockwise(&self) -> bool {
        self.mirrored
    }

    /// A curve of the plan as it is run, still about the bore's centre.
    pub(super) fn turned(&self, curve: &PlaneCurve) -> PlaneCurve {
        if self.mirrored { curve.mirrored() } else { *curve }
    }

    fn add(&mut self, role: ToolpathRole, pace: ToolpathPace, curve: Curve) {
        let (level, finishing, comp) = (self.level, self.finishing, self.comp);
        self.moves.push(PlannedMove { role, curve, pace, level, finishing, comp });
    }

    /// Height of the tip [mm]; infinitely high before the first move.
    pub(super) fn height(&self) -> f64 {
        self.here.map_or(f64::INFINITY, |p| p.z)
    }

    /// Straight to a place; the first call only says where the toolpath begins.
    pub(super) fn to(&mut self, role: ToolpathRole, pace: ToolpathPace, to: DVec3) {
        if let Some(from) = self.here
            && (to - from).length() > NOTHING
        {
            let curve = Line { start: self.place(from), end: self.place(to) }.into();
            self.add(role, pace, curve);
        }
        self.here = Some(to);
    }

    /// Straight up or down.
    pub(super) fn vertically(&mut self, role: ToolpathRole, pace: ToolpathPace, z: f64) {
        if let Some(from) = self.here {
            self.to(role, pace, DVec3::new(from.x, from.y, z));
        }
    }

    /// Along a curve in the plane of the present height.
    pub(super) fn along(&mut self, role: ToolpathRole, feed: f64, curve: &PlaneCurve) {
        self.along_rising(role, feed, curve, Rise::NONE);
    }

    /// Along a curve while the height changes; spirals turn by turn.
    pub(super) fn along_rising(&mut self, role: ToolpathRole, feed: f64, curve: &PlaneCurve, rise: Rise) {
        let z = self.height();
        let pace = ToolpathPace::Feed(feed);
        match self.turned(curve).shifted(self.centre) {
            PlaneCurve::Spiral(spiral) => {
                let mut from = 0.0;
                for part in spiral.parts(TAU) {
                    let to = spiral.length_to(part.parameters()[1]) / spiral.length();
                    self.add(role, pace, Curve::spiral(part, z + rise.at(from), rise.part(from, to)));
                    from = to;
                }
            }
            record => self.add(role, pace, record.at_height(z, rise.total())),
        }
        self.here = Some(curve.end().extend(z + rise.total()));
    }

    /// Counter-clockwise about the centre, from the place of tangent angle `psi` on the circle of `radius`, while
    /// the height changes by `rise`.
    pub(super) fn around(
        &mut self,
        role: ToolpathRole,
        feed: f64,
        radius: f64,
        psi: f64,
        sweep: f64,
        rise: f64,
    ) -> Result<()> {
        let z = self.height();
        let start = on_circle(radius, psi).extend(z);
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        let arc = Arc::new(self.place(start), self.centre.extend(z), DVec3::Z, sign * sweep, rise)?;
        self.add(role, ToolpathPace::Feed(feed), arc.into());
        self.here = Some(on_circle(radius, psi + sweep).extend(z + rise));
        Ok(())
    }

    /// A whole turn in the plane, back to where it began.
    pub(super) fn circle(&mut self, role: ToolpathRole, feed: f64, radius: f64, psi: f64) -> Result<()> {
        self.around(role, feed, radius, psi, TAU, 0.0)?;
        // Exactly there, whatever the sine of a whole turn says.
        self.here = self.here.map(|p| on_circle(radius, psi).extend(p.z));
        Ok(())
    }

    /// The exact place that a curve has reached, whatever the sines of its last angle say.
    pub(super) fn settle(&mut self, radius: f64, psi: f64, z: f64) {
        self.here = Some(on_circle(radius, psi).extend(z));
    }
}
