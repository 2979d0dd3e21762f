//! All ways to mill a face that are looked at, and the one chosen.

use glam::DVec2;

use super::optimum::Optimum;
use super::passes::{PassPath, Rows, path_burr, uncovered};
use super::{FaceCase, FaceSpec, PassesChoice, Placement, PlacementChoice, Way};
use crate::base::{Code, Error, Finding, Progress, Result};

/// What the ways are made from: everything as an M3 spindle sees it, but for the spec.
pub(super) struct Ways<'a> {
    pub(super) spec: &'a FaceSpec,
    pub(super) case: &'a FaceCase,
    pub(super) guarded: &'a FaceCase,
    pub(super) optimum: &'a std::result::Result<Optimum, Finding>,
}

/// The placement of a part turned by `angle` with the cutter over the middle of its width.
pub(super) fn middle(case: &FaceCase, angle: f64) -> Placement {
    let [low, high] = case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
    Placement { angle, offset: 0.5 * (low + high) }
}

/// The placement, if the part lies within the cutter's reach less the margin [mm].
pub(super) fn fits(case: &FaceCase, placement: Placement, margin: f64) -> Option<Placement> {
    let [from, to] = case.offsets(placement.angle, margin);
    /// Rounding of a part as wide as the cutter [mm].
    const ROUNDING: f64 = 1e-9;
    (from - ROUNDING <= placement.offset && placement.offset <= to + ROUNDING).then_some(placement)
}

impl Ways<'_> {
    /// All ways by time, and the index of the one chosen.
    ///
    /// # Errors
    /// As [`plan_face`](super::plan_face).
    pub(super) fn all(&self, _progress: &dyn Progress) -> Result<(Vec<Way>, usize)> {
        let placement = self.placement()?;
        Ok((vec![self.one(placement, "one straight pass")], 0))
    }

    /// The placement of the one straight pass asked for.
    fn placement(&self) -> Result<Placement> {
        let seen = |v: f64| if self.spec.left_hand { -v } else { v };
        let asked = match self.spec.placement {
            PlacementChoice::LeastBurr => {
                return match self.optimum {
                    Ok(optimum) => Ok(optimum.placement),
                    Err(finding) => Err(Error::from(finding.clone())),
                };
            }
            PlacementChoice::AsDrawn => middle(self.case, 0.0),
            PlacementChoice::Given { angle, offset: None } => middle(self.case, seen(angle)),
            PlacementChoice::Given { angle, offset: Some(offset) } => {
                Placement { angle: seen(angle), offset: seen(offset) }
            }
        };
        fits(self.case, asked, 0.0).ok_or_else(|| {
            let [from, to] = self.case.offsets(asked.angle, 0.0);
            let finding = if from > to {
                let rows = Rows::least(self.case, asked.angle, self.spec.options.margin).unwrap_or(0);
                Finding::error(Code::FACE_TOO_WIDE, "the part is wider than the cutter")
                    .value_mm(from - to + 2.0 * self.case.radius)
                    .bound_mm(2.0 * self.case.radius)
                    .cure(format!("mill it in {rows} rows, turn it, or take a larger cutter"))
            } else {
                let bound = if asked.offset < from { from } else { to };
                Finding::error(Code::FACE_TOO_WIDE, "the part reaches beyond the cutter at this offset")
                    .value_mm(seen(asked.offset))
                    .bound_mm(seen(bound))
                    .cure("move the centre line, or leave out `offset`")
            };
            finding.into()
        })
    }

    fn one(&self, placement: Placement, name: &str) -> Way {
        let run = self.case.radius + self.spec.clearance;
        let along = self.case.outline.extent(placement.feed_in_part());
        let path = PassPath::straight(placement, along, run);
        self.way(name, path, Some(placement.angle), Some(placement.offset))
    }

    fn way(&self, name: &str, path: PassPath, angle: Option<f64>, offset: Option<f64>) -> Way {
        /// How far the places are told apart that a path does not reach: halvings of the face.
        const DEPTH: u32 = 9;
        let burr = path_burr(self.case, &path);
        let feed_length = path.feed_length();
        let time = feed_length / self.spec.feed + path.link_length() / self.spec.rapid;
        Way {
            name: name.to_owned(),
            angle,
            offset,
            bad: burr.bad,
            guarded: path_burr(self.guarded, &path).bad,
            unreached: uncovered(self.case, &path, 0.0, DEPTH).map(|p| p.to_array()),
            burr,
            feed_length,
            time,
            unbeaten: true,
            path,
        }
    }
}
