//! Surveys as the paper plots them: the largest exit angle and the bad length over the orientation, and pictures of the
//! cutter on its way with the exit angles where its circle crosses the outline.

use std::f64::consts::TAU;

use rayon::prelude::*;
use serde::Serialize;

use super::exits::as_exit;
use super::limit::exit_angle;
use super::{FaceCase, Objective, Placement, largest_exit_angle};
use crate::base::unit::computed_degrees;
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::OutlineEdge;

/// Rule for the centre line at each orientation of a survey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OffsetRule {
    /// At this share of the offsets that cover the part, 0.5 in its middle; where none does, of what would if it did.
    Share(f64),
    /// At this distance from the middle of the part [mm].
    Beside(f64),
}

/// One orientation of a survey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SurveyPoint {
    /// The placement.
    pub placement: Placement,
    /// The cutter covers the part with its margin.
    pub covered: bool,
    /// Largest exit angle of the front half [rad], in JSON degrees; 0 without exits.
    #[serde(serialize_with = "computed_degrees")]
    pub largest_exit_angle: f64,
    /// Bad length [mm].
    pub bad: f64,
}

/// The largest exit angle and the bad length at `count` orientations, evenly over the turn, in parallel.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::base::Silent;
/// use kinecut::facing::{BadSet, FaceCase, Objective, OffsetRule, survey};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 70.0, BadSet::below(90f64.to_radians())?)?;
/// let points = survey(&case, &Objective::Limit, OffsetRule::Share(0.5), 1.0, 360, &Silent)?;
/// assert!((points[0].bad - 130.0).abs() < 1e-9 && points[0].covered);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// As [`Objective::value`]; `KC0009` when cancelled.
pub fn survey(
    case: &FaceCase,
    objective: &Objective,
    rule: OffsetRule,
    margin: f64,
    count: u32,
    progress: &dyn Progress,
) -> Result<Vec<SurveyPoint>> {
    progress.stage("survey", u64::from(count));
    let one = |i: u32| {
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "the survey was cancelled").into());
        }
        let angle = TAU * f64::from(i) / f64::from(count);
        let [low, high] = case.offsets(angle, margin);
        let offset = match rule {
            OffsetRule::Share(share) => low + share * (high - low),
            OffsetRule::Beside(aside) => 0.5 * (low + high) + aside,
        };
        let covered = low <= offset && offset <= high;
        let placement = Placement { angle, offset };
        let largest_exit_angle = match objective.pass(placement)? {
            None => largest_exit_angle(case, placement),
            Some(pass) => {
                let mut largest = 0.0;
                pass.visit(&case.outline, |c| {
                    if c.front && c.exit && c.exit_angle() > largest {
                        largest = c.exit_angle();
                    }
                });
                largest
            }
        };
        let bad = objective.value(case, placement)?;
        progress.advance(1);
        Ok(SurveyPoint { placement, covered, largest_exit_angle, bad })
    };
    (0..count).into_par_iter().map(one).collect()
}

/// A placement with positions of the cutter on its way.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacementPicture {
    /// The part is turned by this [rad].
    pub angle: f64,
    /// Ordinate of the centre line in the turned part's frame [mm].
    pub offset: f64,
    /// Bad length of the placement [mm].
    pub bad: f64,
    /// Its largest exit angle [rad].
    pub largest_exit_angle: f64,
    /// The positions, in the order of feed.
    pub positions: Vec<CutterPosition>,
}

/// A position of the cutter, with the front of its circle crossing the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct CutterPosition {
    /// Cutter centre in the turned part's frame [mm].
    pub centre: [f64; 2],
    /// Crossings of the front with the outline, edge after edge.
    pub crossings: Vec<PictureCrossing>,
}

/// A place where the front of the cutter's circle crosses the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureCrossing {
    /// Index of the edge.
    pub edge: usize,
    /// The place in the turned part's frame [mm].
    pub point: [f64; 2],
    /// Angle from the edge's direction to the tooth's velocity [rad]: an exit between 0 and pi, else an entry.
    pub exit_angle: f64,
    /// Weight of a millimetre of this edge for this angle; 0 if it is not bad.
    pub weight: f64,
}

/// Pictures of placements, each with `count` positions of the cutter, evenly from where it first touches the part to
/// where its front leaves it.
pub fn pictures(case: &FaceCase, placements: &[Placement], count: u32) -> Vec<PlacementPicture> {
    let one = |&placement: &Placement| {
        let Placement { angle, offset } = placement;
        let moved = case.outline.moved(angle, glam::DVec2::ZERO);
        let [x0, x1] = moved.extent(glam::DVec2::X);
        let (first, last) = (x0 - case.radius, x1);
        let positions = (0..count).map(|i| {
            let x = first + (last - first) * (f64::from(i) + 0.5) / f64::from(count);
            let mut crossings = Vec::new();
            for (edge, (own, one)) in case.outline.edges().iter().zip(moved.edges()).enumerate() {
                shares_on_circle(one, glam::DVec2::new(x, offset), case.radius, |share| {
                    let point = one.at(share);
                    if point.x > x {
                        let exit_angle = exit_angle(own, share, case.radius, placement);
                        let weight = case.bad.weight(as_exit(exit_angle)) * case.weights[edge];
                        crossings.push(PictureCrossing { edge, point: point.to_array(), exit_angle, weight });
                    }
                });
            }
            CutterPosition { centre: [x, offset], crossings }
        });
        let positions = positions.collect();
        let bad = super::bad_length(case, placement);
        PlacementPicture {
            angle,
            offset,
            bad,
            largest_exit_angle: largest_exit_angle(case, placement),
            positions,
        }
    };
    placements.iter().map(one).collect()
}

/// Calls `found` with the shares of an edge, 0 included and 1 excluded, that lie on a circle.
fn shares_on_circle(edge: &OutlineEdge, centre: glam::DVec2, radius: f64, mut found: impl FnMut(f64)) {
    let Some(turn) = edge.turn else {
        let (along, away) = (edge.end - edge.start, edge.start - centre);
        let (a, b, c) = (along.length_squared(), along.dot(away), away.length_squared() - radius * radius);
        let square = b * b - a * c;
        if square > 0.0 {
            // The root of larger size first: the other comes from their product without cancellation.
            let large = -(b + square.sqrt().copysign(b));
            let roots = if large == 0.0 { [0.0, 0.0] } else { [large / a, c / large] };
            roots.into_iter().filter(|s| (0.0..1.0).contains(s)).for_each(found);
        }
        return;
    };
    let to = centre - turn.centre;
    let distance = to.length();
    let cos =
        (turn.radius * turn.radius + distance * distance - radius * radius) / (2.0 * turn.radius * distance);
    if cos.abs() < 1.0 {
        let (towards, aside) = (to.y.atan2(to.x), cos.acos());
        for phi in [towards - aside, towards + aside] {
            let share = ((phi - turn.from) * turn.sweep.signum()).rem_euclid(TAU) / turn.sweep.abs();
            if share < 1.0 {
                found(share);
            }
        }
    }
}
