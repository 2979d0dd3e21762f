//! All ways to mill a face that are looked at, and the one chosen.

use glam::DVec2;

use super::optimum::{Optimum, Options};
use super::passes::plan::{SAME_BAD, SAME_PLACE, efficient};
use super::passes::{
    Corner, Fill, FrameOptions, MilledRows, PassKind, PassOptions, PassPath, PassPlan, RowWays, best_rows,
    frames, pareto, pass_time, path_burr, uncovered,
};
use super::{FaceCase, FaceSpec, MillingWay, PassesChoice, Placement, PlacementChoice};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::num::angle::wrap_positive;

/// Inputs that the ways are made from: everything as an M3 spindle sees it, but for the spec.
pub(super) struct Ways<'a> {
    pub(super) spec: &'a FaceSpec,
    pub(super) options: &'a Options,
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

/// Resolution of the search for places that a path does not reach: halvings of the face.
const DEPTH: u32 = 9;

impl Ways<'_> {
    /// All ways by time, and the index of the one chosen.
    ///
    /// # Errors
    /// As [`plan_face`](super::plan_face).
    pub(super) fn all(&self, progress: &dyn Progress) -> Result<(Vec<MillingWay>, usize)> {
        // A kind of pass that was asked for; without one the best of all ways is chosen below.
        let asked = match self.spec.passes {
            PassesChoice::One => Some(self.one(self.placement()?)),
            PassesChoice::Fewest => Some(self.fewest()?),
            PassesChoice::Rows(count) => Some(self.rows(count as usize)?),
            PassesChoice::Frames(outside) => Some(self.frames(outside)?),
            PassesChoice::LeastBurr | PassesChoice::Fastest => None,
        };
        let mut ways = Vec::new();
        // Other ways are for comparison: when a person is in a hurry the one that was asked for will do.
        if (self.spec.compare || asked.is_none()) && !progress.cancelled() {
            match pareto(self.guarded, &self.straight(), &self.pass_options(), progress) {
                Ok(plans) => ways.extend(plans.into_iter().map(|plan| self.of_plan(plan))),
                Err(e) if e.code() == Code::CANCELLED && asked.is_some() => {}
                Err(e) => return Err(e),
            }
        }
        ways.retain(|w| self.permits(w));
        let near = SAME_PLACE * self.case.radius;
        if let Some(asked) = &asked {
            ways.retain(|w: &MillingWay| !w.path.is_near(&asked.path, near));
            // The first of those that no other beats: equal ones come after it.
            ways.insert(0, asked.clone());
        }
        let prices: Vec<_> = ways.iter().map(|w| (w.guarded, w.time, w.unreached.is_none())).collect();
        for (way, worth) in ways.iter_mut().zip(efficient(&prices, SAME_BAD * self.case.weighted_perimeter()))
        {
            way.unbeaten = worth;
        }
        ways.sort_by(|a, b| a.time.total_cmp(&b.time));
        let chosen = match asked {
            Some(asked) => ways.iter().position(|w| w.path == asked.path),
            None => {
                let whole = ways.iter().enumerate().filter(|(_, w)| w.unreached.is_none());
                let by = |w: &MillingWay| match self.spec.passes {
                    PassesChoice::Fastest => [w.time, w.guarded],
                    _ => [w.guarded, w.time],
                };
                let order = |a: [f64; 2], b: [f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
                whole.min_by(|a, b| order(by(a.1), by(b.1))).map(|(i, _)| i)
            }
        };
        match chosen {
            Some(chosen) => Ok((ways, chosen)),
            None => Err(Finding::error(
                Code::FACE_UNCUT,
                "no way that is allowed was found that reaches the whole face",
            )
            .help("take a larger cutter or a smaller margin, or allow more orientations")
            .into()),
        }
    }

    /// The straight passes that are compared: the one asked for, the certified one, its alternatives.
    fn straight(&self) -> Vec<Placement> {
        let mut list: Vec<Placement> = self.placement().ok().into_iter().collect();
        if let Ok(optimum) = self.optimum {
            list.push(optimum.placement);
            list.extend(optimum.alternatives.iter().map(|a| a.placement));
        }
        list
    }

    fn pass_options(&self) -> PassOptions {
        let usual = PassOptions::default();
        PassOptions {
            margin: self.spec.options.margin,
            clearance: self.spec.clearance,
            feed: self.spec.feed,
            rapid: self.spec.rapid,
            angles: self.angle().into_iter().collect(),
            depth: DEPTH,
            ..usual
        }
    }

    /// True if a part may be turned by this angle [rad].
    fn allows(&self, angle: f64) -> bool {
        self.options.forbidden.iter().all(|[from, to]| {
            let gone = wrap_positive(angle - from);
            !(gone > 0.0 && gone < to - from)
        })
    }

    /// True if a way keeps to the constraints that concern it: straight passes to all, rows to the orientations.
    fn permits(&self, way: &MillingWay) -> bool {
        let Some(angle) = way.angle else { return true };
        let Some(placement) = way.placement() else { return self.allows(angle) };
        /// Rounding of a placement at a bound, per radius.
        const ROUNDING: f64 = 1e-9;
        let near = ROUNDING * self.case.radius;
        let [low, high] = self.case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        let [first, last] = self.options.engagement.map(|a| placement.offset + self.case.radius * a.sin());
        let beside = (placement.offset - 0.5 * (low + high)).abs();
        self.allows(angle)
            && low >= first - near
            && high <= last + near
            && beside >= self.options.least_off_middle - near
    }

    /// The error of a turn that is asked for and forbidden at once.
    fn checked(&self, angle: f64) -> Result<f64> {
        if self.allows(angle) {
            return Ok(angle);
        }
        Err(Finding::error(Code::FACE_CASE, "the turn of the part that is asked for is forbidden")
            .value(self.seen(angle).to_degrees(), "deg")
            .help("ask for another `placement`, or correct `forbidden`")
            .key("placement")
            .into())
    }

    /// The angle that was asked for, as an M3 spindle sees it.
    fn angle(&self) -> Option<f64> {
        match self.spec.placement {
            PlacementChoice::LeastBurr => None,
            PlacementChoice::AsDrawn => Some(0.0),
            PlacementChoice::Given { angle, .. } => Some(self.seen(angle)),
        }
    }

    /// An angle or ordinate as it is seen in the mirror of an M4 spindle, and back.
    fn seen(&self, value: f64) -> f64 {
        if self.spec.left_hand { -value } else { value }
    }

    /// The placement of the one straight pass asked for.
    fn placement(&self) -> Result<Placement> {
        let asked = match self.spec.placement {
            PlacementChoice::LeastBurr => {
                return match self.optimum {
                    Ok(optimum) => Ok(optimum.placement),
                    Err(finding) => Err(Error::from(finding.clone())),
                };
            }
            PlacementChoice::AsDrawn => middle(self.case, 0.0),
            PlacementChoice::Given { angle, offset: None } => middle(self.case, self.seen(angle)),
            PlacementChoice::Given { angle, offset: Some(offset) } => {
                Placement { angle: self.seen(angle), offset: self.seen(offset) }
            }
        };
        self.checked(asked.angle)?;
        fits(self.case, asked, 0.0).ok_or_else(|| {
            let [from, to] = self.case.offsets(asked.angle, 0.0);
            let finding = if from > to {
                let rows = MilledRows::least(self.case, asked.angle, self.spec.options.margin).unwrap_or(0);
                Finding::error(Code::FACE_TOO_WIDE, "the part is wider than the cutter")
                    .value_mm(from - to + 2.0 * self.case.radius)
                    .bound_mm(2.0 * self.case.radius)
                    .help(format!("mill it in {rows} rows, turn it, or take a larger cutter"))
            } else {
                let bound = if asked.offset < from { from } else { to };
                Finding::error(Code::FACE_TOO_WIDE, "the part reaches beyond the cutter at this offset")
                    .value_mm(self.seen(asked.offset))
                    .bound_mm(self.seen(bound))
                    .help("move the centre line, or leave out `offset`")
            };
            finding.into()
        })
    }

    fn one(&self, placement: Placement) -> MillingWay {
        let run = self.case.radius + self.spec.clearance;
        let along = self.case.outline.extent(placement.feed_in_part());
        let path = PassPath::straight(placement, along, run);
        let name = pass_name(self.seen(placement.angle));
        self.way(name, path, Some(placement.angle), Some(placement.offset))
    }

    /// One straight pass, or where the part is too wide for it the best of as few rows as cover it.
    fn fewest(&self) -> Result<MillingWay> {
        let too_wide = match self.placement() {
            Ok(placement) => return Ok(self.one(placement)),
            Err(e) if e.code() == Code::FACE_TOO_WIDE => e,
            Err(e) => return Err(e),
        };
        let angles = match self.spec.placement {
            // An offset is that of one pass.
            PlacementChoice::Given { offset: Some(_), .. } => return Err(too_wide),
            _ => self.angle().map_or_else(|| self.row_angles(), |angle| vec![angle]),
        };
        let margin = self.spec.options.margin;
        let least = angles.iter().filter_map(|a| MilledRows::least(self.case, *a, margin)).min();
        // Rows that cover the face may not be those that may be turned so.
        least.map_or(Err(too_wide), |count| self.rows(count.max(2)).or_else(|_| self.rows(count.max(2) + 1)))
    }

    /// The best rows of this number.
    fn rows(&self, count: usize) -> Result<MillingWay> {
        let margin = self.spec.options.margin;
        let angles = match self.angle() {
            Some(angle) => vec![self.checked(angle)?],
            None => self.row_angles(),
        };
        let turns = angles.iter().flat_map(|a| [*a, a + std::f64::consts::PI]).filter(|a| self.allows(*a));
        let found = turns.filter_map(|a| best_rows(self.guarded, a, count, margin, RowWays::Free));
        let best = found.min_by(|a, b| a.bad_length(self.guarded).total_cmp(&b.bad_length(self.guarded)));
        let Some(rows) = best else {
            let least =
                angles.iter().filter_map(|a| MilledRows::least(self.case, *a, margin)).min().unwrap_or(1);
            return Err(Finding::error(Code::FACE_UNCUT, "so few rows do not cover the face")
                .value(count as f64, "rows")
                .bound(least as f64, "rows")
                .help("mill it in more rows, or take a larger cutter")
                .into());
        };
        let path = rows.path(self.case, self.case.radius + self.spec.clearance);
        let name = row_name(rows.rows.len(), "best", "", self.seen(rows.angle));
        Ok(self.way(name, path, Some(rows.angle), None))
    }

    /// Directions at which rows are tried: along every edge, and even ones between.
    fn row_angles(&self) -> Vec<f64> {
        const EVEN: usize = 12;
        /// Directions nearer than this are one [rad].
        const SAME: f64 = 1e-6;
        let edges = self.case.outline.edges().iter().filter(|e| e.turn.is_none());
        let half = |a: f64| a.rem_euclid(std::f64::consts::PI);
        let mut angles: Vec<f64> = edges.map(|e| half(-e.heading(0.0))).collect();
        angles.extend((0..EVEN).map(|k| std::f64::consts::PI * k as f64 / EVEN as f64));
        angles.sort_by(f64::total_cmp);
        angles.dedup_by(|a, b| (*a - *b).abs() < SAME);
        angles
    }

    /// The best frame at this distance outside of the edge.
    fn frames(&self, outside: f64) -> Result<MillingWay> {
        let mut best: Option<(f64, FrameOptions, PassPath)> = None;
        for corner in [Corner::Round, Corner::Sharp] {
            for fill in [Fill::Rings, Fill::Rows(0.0), Fill::Rows(std::f64::consts::FRAC_PI_2)] {
                let options = FrameOptions {
                    outside,
                    corner,
                    fill,
                    holes: corner == Corner::Round,
                    margin: self.spec.options.margin,
                    clearance: self.spec.clearance,
                };
                let Some(path) = frames(self.guarded, &options) else { continue };
                let bad = path_burr(self.guarded, &path).bad;
                if best.as_ref().is_none_or(|(b, _, _)| bad < *b) {
                    best = Some((bad, options, path));
                }
            }
        }
        let Some((_, options, path)) = best else {
            return Err(Finding::error(
                Code::FACE_UNCUT,
                "a frame at this distance and what is milled inside of it do not reach the whole face",
            )
            .value_mm(outside)
            .bound_mm(self.case.radius)
            .help("take the frame farther in, or mill in rows")
            .into());
        };
        let plan = PassKind::Frames(options);
        Ok(self.way(kind_name(&plan, |a| self.seen(a)), path, None, None))
    }

    fn of_plan(&self, plan: PassPlan) -> MillingWay {
        let (angle, offset) = match &plan.kind {
            PassKind::Straight(p) => (Some(p.angle), Some(p.offset)),
            PassKind::Rows { rows, .. } => (Some(rows.angle), None),
            PassKind::Frames(_) => (None, None),
        };
        let burr = path_burr(self.case, &plan.path);
        MillingWay {
            name: kind_name(&plan.kind, |a| self.seen(a)),
            angle,
            offset,
            bad: burr.bad,
            guarded: plan.burr.bad,
            burr,
            feed_length: plan.feed_length,
            time: plan.time,
            unreached: plan.uncovered.map(|p| p.to_array()),
            unbeaten: plan.efficient,
            path: plan.path,
        }
    }

    fn way(&self, name: String, path: PassPath, angle: Option<f64>, offset: Option<f64>) -> MillingWay {
        let burr = path_burr(self.case, &path);
        MillingWay {
            name,
            angle,
            offset,
            bad: burr.bad,
            guarded: path_burr(self.guarded, &path).bad,
            unreached: uncovered(self.case, &path, 0.0, DEPTH).map(|p| p.to_array()),
            burr,
            feed_length: path.feed_length(),
            time: pass_time(&path, self.spec.feed, self.spec.rapid, PassOptions::default().lift),
            unbeaten: true,
            path,
        }
    }
}

/// Name of a way in reports; `seen` turns an angle into that of the part as it lies.
fn kind_name(kind: &PassKind, seen: impl Fn(f64) -> f64) -> String {
    match kind {
        PassKind::Straight(p) => pass_name(seen(p.angle)),
        PassKind::Rows { rows, ways, best } => {
            let ways = match ways {
                RowWays::Free => "",
                RowWays::OneWay => " one way",
                RowWays::Zigzag => " to and fro",
            };
            row_name(rows.rows.len(), if *best { "best" } else { "even" }, ways, seen(rows.angle))
        }
        PassKind::Frames(f) => {
            let inside = match f.fill {
                Fill::Nothing => "nothing inside",
                Fill::Rings => "rings",
                Fill::Rows(_) => "rows inside",
            };
            let corners = if f.corner == Corner::Round { "round" } else { "sharp" };
            let place = if f.outside >= 0.0 { "outside" } else { "inside" };
            format!("frames {:.1} mm {place}, {corners}, {inside}", f.outside.abs())
        }
    }
}

fn pass_name(turned: f64) -> String {
    format!("one pass, turned {} deg", degrees(turned))
}

fn row_name(count: usize, spread: &str, ways: &str, turned: f64) -> String {
    let rows = if count == 1 { "row" } else { "rows" };
    format!("{count} {spread} {rows}{ways}, turned {} deg", degrees(turned))
}

/// An angle in degrees as reports show it: 0 to below 360, to the tenth.
fn degrees(angle: f64) -> String {
    let tenths = (angle.to_degrees() * 10.0).round().rem_euclid(3600.0);
    // Adding zero makes -0 a plain 0.
    format!("{:.1}", tenths / 10.0 + 0.0)
}
