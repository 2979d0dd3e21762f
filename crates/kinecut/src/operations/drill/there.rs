//! Holes that are there before a drill comes, and the part that each plays: opened out, gone on from, come out into.

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::drilling::{Ceiling, Mouth, PreHole};
use crate::geom::{EdgeProfile, Rigid};
use crate::operations::{Drilled, MadeHole};

/// Radii, places and heights nearer than this are equal [mm].
const SAME: f64 = 1e-6;

/// The holes that a drill meets; Z counted from the point where it was asked.
#[derive(Clone, Debug, Default)]
pub(super) struct There {
    /// The hole that it opens out.
    pub(super) opened: Option<PreHole>,
    /// The floor of a hole as wide as itself, or wider, from which it goes on.
    pub(super) floor: Option<Mouth>,
    /// The floor of a hole from the other side, into which it comes out.
    pub(super) ceiling: Option<Ceiling>,
}

/// A hole along the drill, seen from it.
struct Seen {
    /// Its axis from the drill's [mm].
    across: DVec2,
    /// Its radius [mm].
    radius: f64,
    form: Form,
}

enum Form {
    /// Z up to which it is open at its far end, and whether that lies above the near one: it was made from the other side.
    Through(f64, bool),
    /// Open to the drill, or away from it: Z of the tip, and the edge that made the floor.
    Above(f64, EdgeProfile),
    Below(f64, EdgeProfile),
}

/// The place and direction from which holes are looked at: a point, and coordinates of the work offset.
pub(super) struct View<'a> {
    pub(super) to_work: &'a Rigid,
    pub(super) at: DVec3,
    /// Heights of entry and exit on the axis [mm].
    pub(super) faces: [f64; 2],
}

impl View<'_> {
    /// Ends of a line along the drill, from the point; `None` across it.
    fn ends(&self, ends: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [a, b] = ends.map(|p| self.to_work.point(p) - self.at);
        ((b - a).truncate().length() < 1e-9 * (b - a).length()).then_some([a, b])
    }

    /// A hole of the raw stock, whose floor is flat.
    fn raw(&self, hole: &Drilled) -> Option<Seen> {
        let [a, b] = self.ends([hole.base, hole.base + DVec3::Z * hole.height])?;
        let (low, high) = if a.z < b.z { (a.z, b.z) } else { (b.z, a.z) };
        let [entry, exit] = self.faces;
        let radius = 0.5 * hole.diameter;
        let flat = || EdgeProfile::polyline(&[[0.0, 0.0], [radius, 0.0]]).ok();
        let form = match (low <= exit, high >= entry && low <= entry) {
            (true, true) => Form::Through(low, false),
            (false, true) => Form::Above(low, flat()?),
            (true, false) => Form::Below(high, flat()?),
            (false, false) => return None,
        };
        Some(Seen { across: a.truncate(), radius, form })
    }

    /// A hole that an operation before leaves; `None` where the form of its floor is not known.
    fn made(&self, made: &MadeHole) -> Option<Seen> {
        let [top, low] = self.ends(made.ends())?;
        let form = match made.hole.floor {
            _ if made.hole.through => Form::Through(low.z, low.z > top.z),
            Some(floor) if top.z > low.z => Form::Above(low.z, floor.edge),
            Some(floor) => Form::Below(low.z, floor.edge),
            None => return None,
        };
        Some(Seen { across: top.truncate(), radius: 0.5 * made.hole.diameter, form })
    }

    /// The part of each hole for a drill of a radius [mm].
    ///
    /// # Errors
    /// `KC0901` where the drill runs in a through hole.
    pub(super) fn holes(&self, radius: f64, raw: &[Drilled], made: &[MadeHole]) -> Result<There> {
        let mut there = There::default();
        let seen = raw.iter().filter_map(|h| self.raw(h)).chain(made.iter().filter_map(|h| self.made(h)));
        let (through, blind): (Vec<Seen>, Vec<Seen>) =
            seen.partition(|hole| matches!(hole.form, Form::Through(..)));
        for hole in blind {
            there.end_in(hole, radius, self.faces);
        }
        for hole in through {
            there.run_in(&hole, radius, self.faces)?;
        }
        // A hole that ends above the floor from which the drill goes on is no longer there.
        if let (Some(floor), Some(opened)) = (&there.floor, &there.opened)
            && opened.bottom.is_some_and(|b| b.height >= floor.height)
        {
            there.opened = None;
        }
        // Into the other side it is followed from a face, or in a through hole about its axis.
        if there.opened.as_ref().is_some_and(|hole| !hole.leaves_annulus()) {
            there.ceiling = None;
        }
        Ok(there)
    }
}

impl There {
    /// A hole that ends in the stock.
    fn end_in(&mut self, hole: Seen, radius: f64, [entry, exit]: [f64; 2]) {
        let beside = hole.across.length();
        // A face that was milled after it may have taken its floor, or a part of it.
        let rim = |edge: &EdgeProfile| edge.height(edge.outer_radius()).unwrap_or(0.0);
        match hole.form {
            Form::Above(tip, edge) if tip + rim(&edge) <= entry + SAME => {
                if runs_in(&hole, radius) && beside <= SAME && self.floor.is_none_or(|f| f.height > tip) {
                    self.floor = Some(Mouth { height: tip, edge });
                } else if opens(&hole, radius) {
                    self.open(PreHole::blind(2.0 * hole.radius, tip, edge), hole.across);
                }
            }
            Form::Below(height, edge)
                if height - rim(&edge) >= exit - SAME
                    && height < entry
                    && beside <= SAME
                    && self.ceiling.is_none_or(|c| c.height < height) =>
            {
                self.ceiling = Some(Ceiling { height, edge });
            }
            _ => {}
        }
    }

    /// A hole that goes through. Nothing is left to drill in it where it ends at the face or in a hole from the other side; one through a
    /// wall alone, as of a tube, goes no farther.
    ///
    /// # Errors
    /// `KC0901` where the drill runs in it.
    fn run_in(&mut self, hole: &Seen, radius: f64, [entry, exit]: [f64; 2]) -> Result<()> {
        let Form::Through(far, from_below) = hole.form else { return Ok(()) };
        let is_out = match from_below {
            true => far >= entry - SAME || self.floor.is_some_and(|f| far >= f.height - SAME),
            false => far <= exit + SAME || self.ceiling.is_some_and(|c| far <= c.height + SAME),
        };
        if is_out && runs_in(hole, radius) {
            return Err(nothing_left(2.0 * hole.radius, None).into());
        }
        if opens(hole, radius) {
            self.open(PreHole::through(2.0 * hole.radius), hole.across);
        }
        Ok(())
    }

    /// Of several holes that it opens out the widest counts.
    fn open(&mut self, hole: PreHole, across: DVec2) {
        if self.opened.as_ref().is_none_or(|h| h.diameter <= hole.diameter) {
            self.opened = Some(hole.moved(across.to_array()));
        }
    }
}

/// Whether all of a drill runs in a hole.
fn runs_in(hole: &Seen, radius: f64) -> bool {
    hole.across.length() + radius <= hole.radius + SAME
}

/// Whether a drill is wider than a hole all round.
fn opens(hole: &Seen, radius: f64) -> bool {
    hole.across.length() + hole.radius <= radius && hole.radius < radius - SAME
}

/// The error for a hole in which nothing is left for the drill: one of a diameter is there, through or down to a Z [mm].
pub(super) fn nothing_left(diameter: f64, down_to: Option<f64>) -> Finding {
    let diameter = crate::page::trimmed(diameter, 3);
    let extent = down_to.map_or_else(
        || "goes through".to_owned(),
        |z| format!("goes down to Z {}", crate::page::fixed(z, 3)),
    );
    let what = format!("nothing is left to drill: the hole of {diameter} mm that is there {extent}");
    let help = "take this hole out of the operation, or give it a larger diameter or depth";
    Finding::error(Code::DRILL_CASE, what).help(help)
}
