//! The formulas that Belyakov and Seleznev 2023 print (tables 1 to 3), for comparison: a section through the tool axis,
//! the tip always first, one cylinder radius. They are exact for 25 of the 49 pairs of surfaces.

use std::f64::consts::TAU;

use super::lengths::Frames;
use super::{Coordinates, Feeds, Lengths, PartFace, Side, Transient};
use crate::tool::DrillPoint;

/// Results of the paper's formulas; Z in the frame of the entry, mm, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperResult {
    /// Lengths.
    pub lengths: Lengths,
    /// Coordinates.
    pub coordinates: Coordinates,
    /// Times of entry, steady cutting and exit with right arithmetic [s].
    pub times: [f64; 3],
    /// L_vr1 as the scan prints it for a thinned web and a slotted chisel, with a cosine [mm].
    pub point_as_printed: Option<f64>,
    /// The printout of the paper's program.
    pub printed: Printed,
}

/// The paper's printout (figure 7): Z rounded to three decimals, then lengths as differences of absolute values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// L_vr1, L_vr, Z_nvr1, Z_nvr2, L_vyh1, L_vyh2, Z_nvyh1, Z_nvyh2, Z_kvyh1, Z_kvyh2 [mm], as shown.
    pub lengths: [f64; 10],
    /// Times of entry, steady cutting and exit, and their sum [s], as shown.
    pub times: [f64; 4],
}

/// Names of the printed lengths, in order.
pub const PRINTED_LENGTHS: [&str; 10] =
    ["L_vr1", "L_vr", "Z_nvr1", "Z_nvr2", "L_vyh1", "L_vyh2", "Z_nvyh1", "Z_nvyh2", "Z_kvyh1", "Z_kvyh2"];

/// A case in the paper's terms [mm, rad/s, mm/rev].
#[derive(Clone, Debug, PartialEq)]
pub struct PaperCase {
    /// The point.
    pub point: DrillPoint,
    /// Its diameter.
    pub diameter: f64,
    /// The surface it enters.
    pub entry: PartFace,
    /// The surface it leaves.
    pub exit: PartFace,
    /// L.
    pub length: f64,
    /// L_pod.
    pub approach: f64,
    /// L_per.
    pub overrun: f64,
    /// Speed of the spindle.
    pub spindle: f64,
    /// Feeds.
    pub feeds: Feeds,
}

/// Result of the paper's formulas; `None` if it has no formula.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::{PartFace, Feeds, PaperCase, paper};
/// use kinecut::tool::DrillPoint;
/// let case = PaperCase {
///     point: DrillPoint::DoubleGround { angle: 118f64.to_radians(), second: 70f64.to_radians() },
///     diameter: 20.0,
///     entry: PartFace::Plane { inclination: 0.0, offset: 0.0 },
///     exit: PartFace::OuterCylinder { radius: 100.0, offset: 0.0 },
///     length: 50.0, approach: 2.0, overrun: 2.0,
///     spindle: 25e3 / 60.0 / 10.0,
///     feeds: Feeds { entry: 0.6, steady: 0.8, exit: 0.2 },
/// };
/// // Figure 7: the entry takes 5.907 mm of the 9.907, a difference of absolute values.
/// assert_eq!(paper(&case).unwrap().printed.times, [1.485, 26.784, 7.091, 35.360]);
/// ```
pub fn paper(case: &PaperCase) -> Option<PaperResult> {
    let point = point_length(&case.point, case.diameter)?;
    let radius = case.diameter / 2.0;
    let (top, entry_extra) = section(&case.entry, Side::Entry, radius)?;
    let (bottom, exit_extra) = section(&case.exit, Side::Exit, radius)?;
    let at = |first: f64, extra: f64| Transient {
        first,
        last: first - extra - point,
        first_radius: 0.0,
        last_radius: radius,
    };
    let exit = at(bottom - case.length, exit_extra);
    let frames = Frames {
        point,
        entry: at(top, entry_extra),
        exit: Some(exit),
        start: top + case.approach,
        end: exit.last - case.overrun,
        length: case.length,
    };
    let (mut lengths, coordinates) = (frames.lengths(), frames.coordinates());
    lengths.entry_surface = entry_extra;
    lengths.exit_surface = Some(exit_extra);
    let feeds = [case.feeds.entry, case.feeds.steady, case.feeds.exit];
    let time = |length: f64, feed: f64| length / feed * TAU / case.spindle;
    let right = [lengths.entry, lengths.steady, exit.first - frames.end];
    let as_printed = match case.point {
        DrillPoint::ThinnedWeb { angle, flat: l } | DrillPoint::SlottedChisel { angle, slot: l } => {
            Some((radius - l) * (angle / 2.0).cos())
        }
        _ => None,
    };
    Some(PaperResult {
        lengths,
        coordinates,
        times: [0, 1, 2].map(|i| time(right[i], feeds[i])),
        point_as_printed: as_printed,
        printed: printed(&lengths, &coordinates, |i, l| time(l, feeds[i])),
    })
}

/// Three decimals.
fn shown(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// The arithmetic of the paper's program: rounds Z first, then takes | |Z2| - |Z1| | for a length.
fn printed(lengths: &Lengths, z: &Coordinates, time: impl Fn(usize, f64) -> f64) -> Printed {
    let [n1, n2] = z.entry.map(shown);
    let [v1, v2] = z.exit.unwrap_or_default().map(shown);
    let [k1, k2] = z.exit_own.unwrap_or_default().map(shown);
    let length = |a: f64, b: f64| (b.abs() - a.abs()).abs();
    let times = [time(0, length(n1, n2)), time(1, length(n2, v1)), time(2, length(v1, v2))];
    let sum: f64 = times.iter().sum();
    let point = shown(lengths.point);
    let extra = shown(lengths.exit_surface.unwrap_or_default().abs());
    Printed {
        lengths: [point, shown(lengths.entry), n1, n2, point, extra, v1, v2, k1, k2],
        times: [shown(times[0]), shown(times[1]), shown(times[2]), shown(sum)],
    }
}

/// L_vr1 of table 1, rows 5 and 6 with the cotangent.
fn point_length(point: &DrillPoint, diameter: f64) -> Option<f64> {
    let radius = diameter / 2.0;
    let cot = |angle: f64| angle.tan().recip();
    Some(match *point {
        DrillPoint::Annular { .. } | DrillPoint::Flat => 0.0,
        DrillPoint::Rounded { radius: rho } => rho - ((rho - radius) * (rho + radius)).sqrt(),
        DrillPoint::Cannon { overlap, edge_angle } => (radius + overlap) * cot(edge_angle),
        DrillPoint::Gun { apex, outer_angle, .. } => {
            (radius - apex.unwrap_or(diameter / 4.0)) * cot(outer_angle)
        }
        DrillPoint::SinglePlane { angle } | DrillPoint::Auger { angle } | DrillPoint::Ejector { angle } => {
            radius * cot(angle / 2.0)
        }
        DrillPoint::DoubleGround { angle, second } => {
            let b = 0.2 * diameter;
            (radius - b * (second / 2.0).sin()) * cot(angle / 2.0) + b * (second / 2.0).cos()
        }
        DrillPoint::CastIron { angle, second, third, slot } => {
            let (b1, b2) = (0.2 * diameter, 0.15 * diameter);
            let (h1, h2) = (second / 2.0, third / 2.0);
            (radius - slot - b1 * h1.sin() - b2 * h2.sin()) * cot(angle / 2.0) + b1 * h1.cos() + b2 * h2.cos()
        }
        DrillPoint::ThinnedWeb { angle, flat: l } | DrillPoint::SlottedChisel { angle, slot: l } => {
            (radius - l) * cot(angle / 2.0)
        }
        // The other reading of row 4: a radius between lip and margin.
        DrillPoint::CornerRadius { angle, radius: rho } => {
            let (sin, cos) = (angle / 2.0).sin_cos();
            (radius - rho + rho * cos) * cos / sin + rho * sin
        }
        _ => return None,
    })
}

/// Height of the surface on the tool axis and L_vr2 or L_vyh2 of tables 2 and 3, with its sign.
fn section(face: &PartFace, side: Side, radius: f64) -> Option<(f64, f64)> {
    let half = |rs: f64, u: f64| ((rs - u) * (rs + u)).sqrt();
    let (rs, x, outer) = match *face {
        PartFace::Plane { inclination, offset } => {
            let t = inclination.tan();
            return Some((offset * t, radius * t.abs()));
        }
        PartFace::OuterCylinder { radius: rs, offset } => (rs, offset.abs(), true),
        PartFace::InnerCylinder { radius: rs, offset } => (rs, offset.abs(), false),
    };
    let ridge = outer == (side == Side::Entry);
    let (z, extra) = if ridge {
        (half(rs, x), half(rs, x) - half(rs, radius + x))
    } else {
        (-half(rs, x), -(half(rs, x) - half(rs, radius - x)))
    };
    (z.is_finite() && extra.is_finite()).then_some((z, extra))
}
