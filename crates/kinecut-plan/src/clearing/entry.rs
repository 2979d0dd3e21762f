//! The way down into a part of the region that has no open side and no hole.

use std::f64::consts::PI;

use glam::DVec2;

use super::link::Pose;
use super::medial::{around_widest, longest_piece};
use super::moves::ABOVE;
use super::plan::{HELIX, LEAST_HELIX, place};
use super::region::CentreRegion;
use super::spec::{PocketEntry, PocketSpec};
use crate::base::{Code, Error, Finding};
use crate::geom::{Outline, OutlineEdge, arcs_near};
use crate::holes::levels::Level;

/// Distance between points of the line in the middle, in radii of the cutter.
const STEP: f64 = 0.1;
/// Least length of a ramp, and longest way along the floor after a plunge, in radii of the cutter.
const RAMP: f64 = 2.0;
/// Least radius of a helix at all [mm].
const NO_HELIX: f64 = 1e-3;

/// The ways by which a part may be entered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entering {
    way: PocketEntry,
    /// Radius of the helix [mm], and whether it is asked for.
    helix: f64,
    is_asked: bool,
    centre_cutting: bool,
    /// Radius of the cutter [mm].
    radius: f64,
    /// Length on which a ramp reaches the floor of the deepest level [mm].
    ramp: f64,
}

/// A way down.
#[derive(Clone, Debug)]
pub(super) enum WayIn {
    Helix { middle: DVec2, radius: f64 },
    Ramp(Vec<OutlineEdge>),
    Plunge(DVec2, Vec<OutlineEdge>),
}

/// A part into which no way leads.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoWayIn {
    /// Its widest place.
    pub(super) at: DVec2,
    /// Room of the cutter's centre there [mm].
    pub(super) room: f64,
    /// Length of the longest piece of the line in the middle [mm].
    pub(super) length: f64,
}

impl Entering {
    /// Of a pocket with levels.
    pub(super) fn of(spec: &PocketSpec, levels: &[Level]) -> Entering {
        let a = spec.radius();
        let deepest = levels.iter().map(|l| l.above - l.floor).fold(0.0, f64::max);
        Entering {
            way: spec.entry,
            helix: spec.helix_radius.unwrap_or(HELIX * a),
            is_asked: spec.helix_radius.is_some(),
            centre_cutting: spec.cutter.centre_cutting,
            radius: a,
            ramp: (deepest + ABOVE) / spec.ramp.tan(),
        }
    }

    /// The way into a part; `holds`: whether the cutter's centre may be at a place, `tolerance`: distance of arcs from the line in
    /// the middle [mm].
    pub(super) fn way_in(
        &self,
        of: &Outline,
        holds: impl Fn(DVec2) -> bool,
        tolerance: f64,
    ) -> Result<WayIn, NoWayIn> {
        let wants = |way: PocketEntry| self.way == way || self.way == PocketEntry::Fitting;
        let (middle, room) = CentreRegion::widest(of);
        let radius = self.helix.min(room);
        let least = LEAST_HELIX * self.radius * (1.0 - 1e-9);
        // A smaller one only by a cutter that cuts at its centre, and only where it is asked for.
        let is_small = self.centre_cutting
            && radius > NO_HELIX
            && (self.way == PocketEntry::Helix || self.is_asked && room >= self.helix);
        if wants(PocketEntry::Helix) && (radius >= least || is_small) {
            return Ok(WayIn::Helix { middle, radius });
        }
        let reach = self.ramp.max(RAMP * self.radius);
        let points = longest_piece(of, STEP * self.radius, reach);
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let along = |most: f64| {
            let points = around_widest(of, &points, most);
            let arcs = arcs_near(&points, tolerance);
            let mut places = arcs.iter().flat_map(|edge| (0..=16).map(|k| edge.at(f64::from(k) / 16.0)));
            match places.all(holds) {
                true => arcs,
                false => points.windows(2).map(|pair| OutlineEdge::line(pair[0], pair[1])).collect(),
            }
        };
        if wants(PocketEntry::Ramp) && length >= RAMP * self.radius {
            return Ok(WayIn::Ramp(along(reach)));
        }
        if wants(PocketEntry::Plunge) && self.centre_cutting {
            let edges = along(RAMP * self.radius);
            return Ok(WayIn::Plunge(edges.first().map_or(middle, |e| e.start), edges));
        }
        Err(NoWayIn { at: middle, room, length })
    }
}

impl WayIn {
    /// The edges along which it goes on the floor.
    pub(super) fn edges(&self) -> &[OutlineEdge] {
        match self {
            WayIn::Helix { .. } => &[],
            WayIn::Ramp(edges) | WayIn::Plunge(_, edges) => edges,
        }
    }

    /// The place at which the first pass begins: at the end of the way, back along it.
    pub(super) fn pass_begins(&self) -> Option<Pose> {
        self.edges().last().map(|edge| Pose { at: edge.end, heading: edge.heading(1.0) + PI })
    }
}

impl NoWayIn {
    /// The error about it; `beside`: distance of the region from the wall [mm].
    pub(super) fn error(&self, spec: &PocketSpec, beside: f64) -> Error {
        /// Room around the cutter in a hole by which it goes down [mm].
        const HOLE: f64 = 1.0;
        let a = spec.radius();
        let (at, fits) = (place(self.at), |half: f64| 2.0 * (half + beside));
        let helix = format!(
            "the helix needs a width of {:.3} mm and has {:.3} mm",
            fits(LEAST_HELIX * a),
            fits(self.room.max(0.0))
        );
        let ramp = format!(
            "the ramp needs {:.3} mm along the middle of the walls and has {:.3} mm",
            RAMP * a,
            self.length
        );
        let plunge = "the cutter does not cut at its centre".to_owned();
        let (key, reasons) = match spec.entry {
            PocketEntry::Fitting => ("tool", vec![helix, ramp, plunge]),
            PocketEntry::Helix => ("entry.way", vec![helix]),
            PocketEntry::Ramp => ("entry.way", vec![ramp]),
            PocketEntry::Plunge => ("entry.way", vec![plunge]),
        };
        let help = match (spec.entry, self.room >= 0.5 * HOLE) {
            (PocketEntry::Fitting, true) => {
                format!(
                    "drill {:.1} mm at {at} before, or take a cutter that cuts at its centre",
                    spec.cutter.diameter + HOLE
                )
            }
            (PocketEntry::Fitting, false) => {
                "take a smaller cutter, or one that cuts at its centre".to_owned()
            }
            _ => "leave `way` out: the first way down that fits is taken".to_owned(),
        };
        Finding::error(Code::ENTRY_IMPOSSIBLE, format!("no way in at {at}: {}", reasons.join("; ")))
            .value_mm(self.room)
            .bound_mm(LEAST_HELIX * a)
            .point([self.at.x, self.at.y, 0.0])
            .help(help)
            .key(key)
            .into()
    }
}
