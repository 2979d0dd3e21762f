//! Finishing that is set at the machine: the approach and departure of a pass that the control compensates.
//!
//! The path stays that of the cutter's centre; the radius register holds the correction only (0 as planned, positive
//! for a smaller bore, negative for a larger one), so that an H7 bore is brought to size by a wear entry of
//! hundredths. The control switches the compensation on along a straight line that is longer than the correction and
//! here tangent to the lead-in, so that it shifts without a kink and ends at the same place by the rules of all
//! controls; it is switched off along the tangent of the lead-out. Both lines, and the ends of the leads shifted to
//! either side, must lie in what is open before finishing.

use glam::DVec2;

use super::spec::Wear;
use crate::base::{Code, Error, Finding, Result};
use crate::geom::PlaneCurve;

/// Lengths of the lines that are tried: a multiple of the largest correction and a constant [mm]. The first is
/// comfortable, the last still clear of what a control refuses (a line not longer than the correction) by far more
/// than its resolution.
const LINES: [(f64, f64); 3] = [(2.0, 1.0), (1.5, 0.5), (1.25, 0.1)];
/// Points at which the curvature of a spiral is looked at, for each turn of it: it changes by less than a tenth
/// between two.
const LOOKS_PER_TURN: f64 = 64.0;
/// Least number of those points.
const LEAST_LOOKS: usize = 16;

/// Start and end of a compensated pass, about the bore's centre, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Switches {
    /// Start of the straight line to the lead-in, on which the compensation is switched on [mm].
    pub(super) start: DVec2,
    /// End of the straight line from the lead-out, on which it is switched off [mm].
    pub(super) end: DVec2,
}

/// The straight lines before `way_in` and after `way_out`, where the cutter's centre is in the open up to the radius
/// `open` about the bore's centre [mm].
///
/// # Errors
/// `KC0404` when a curve of the leads is so tight that the correction would gouge, `KC0402` when the lines or the
/// shifted leads would begin or end in the wall; both with value, bound, key `wear_largest` and help.
pub(super) fn switches(
    way_in: &[PlaneCurve],
    way_out: &[PlaneCurve],
    wear: &Wear,
    open: f64,
) -> Result<Switches> {
    for curve in way_in.iter().chain(way_out) {
        let radius = least_radius(curve);
        if radius <= wear.largest {
            return Err(refused(
                Code::PLAN_VALUE,
                "the lead-in is too tight for this wear correction: its least radius of curvature",
                radius,
                wear.largest,
                "allow a smaller correction, or start the lead-in farther from the centre",
            ));
        }
    }
    let (Some(first), Some(last)) = (way_in.first(), way_out.last()) else {
        return Err(
            Finding::error(Code::PLAN_VALUE, "a compensated pass needs a lead-in and a lead-out").into()
        );
    };
    let (enter, leave) = (first.at(0.0), last.at(last.length()));
    Ok(Switches {
        start: free_end(enter.p, -enter.d1, wear, open, "start")?,
        end: free_end(leave.p, leave.d1, wear, open, "end")?,
    })
}

/// The free end of the line from `point` along `away`.
fn free_end(point: DVec2, away: DVec2, wear: &Wear, open: f64, which: &str) -> Result<DVec2> {
    let shift = away.perp() * wear.largest;
    let mut reach = (point + shift).length();
    let other = (point - shift).length();
    if other > reach {
        reach = other;
    }
    if reach <= open {
        for (share, more) in LINES {
            let free = point + away * (share * wear.largest + more);
            if free.length() <= open {
                return Ok(free);
            }
            reach = free.length();
        }
    }
    Err(refused(
        Code::START_OUTSIDE,
        &format!("there is no room to switch the wear correction at the {which} of the finishing pass"),
        reach,
        open,
        "allow a smaller correction, leave more allowance, or choose a start and end nearer to the bore's centre",
    ))
}

/// Least radius of curvature [mm]; exact for records, along a spiral by looking.
fn least_radius(curve: &PlaneCurve) -> f64 {
    match curve {
        PlaneCurve::Record(record) => {
            let (a, b) = (record.start_radius().abs(), record.end_radius().abs());
            if a < b { a } else { b }
        }
        PlaneCurve::Spiral(_) => {
            let turns = curve.turn() / std::f64::consts::TAU;
            let looks = ((turns * LOOKS_PER_TURN).ceil() as usize).clamp(LEAST_LOOKS, 1 << 16);
            // An infinite curvature is a cusp: no radius. One that is not a number counts as such.
            let tightest = curve.walk(looks).iter().fold(0.0, |most: f64, (_, jet)| {
                let k = jet.curvature.abs();
                if k <= most { most } else { k }
            });
            if tightest.is_nan() { 0.0 } else { 1.0 / tightest }
        }
    }
}

fn refused(code: Code, message: &str, value: f64, bound: f64, help: &str) -> Error {
    Finding::error(code, message).value_mm(value).bound_mm(bound).key("wear_largest").help(help).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::InvoluteRecord;

    /// Half a turn of the involute with base radius 5 that ends on the circle of radius 40 about the origin.
    fn lead(from: f64) -> [PlaneCurve; 1] {
        let r = 5.0;
        let out =
            InvoluteRecord::new(0.5 * (40.0 * 40.0 - from * from) / r, [0.0, 0.0], 0.0, from, 40.0).unwrap();
        // The centre of curvature of the end becomes the origin.
        let end = out.at(out.length());
        [out.shifted(-(end.p + end.d1.perp() * 40.0)).into()]
    }

    fn way_out(way_in: &[PlaneCurve; 1]) -> [PlaneCurve; 1] {
        [way_in[0].mirrored().reversed()]
    }

    #[test]
    fn the_lines_are_tangent_longer_than_the_correction_and_in_the_open() {
        let way_in = lead(24.0);
        let wear = Wear { register: 2, largest: 0.2 };
        let s = switches(&way_in, &way_out(&way_in), &wear, 39.5).unwrap();
        let (p, t) = (way_in[0].start(), way_in[0].at(0.0).d1);
        let line = p - s.start;
        assert!((line.length() - 1.4).abs() < 1e-12 && line.perp_dot(t).abs() < 1e-12 && line.dot(t) > 0.0);
        // The mirror image of the way in.
        assert!((s.end - DVec2::new(-s.start.x, s.start.y)).length() < 1e-12);
    }

    #[test]
    fn a_tight_lead_in_is_refused_with_its_radius() {
        let way_in = lead(0.15);
        let wear = |largest| Wear { register: 2, largest };
        let error = switches(&way_in, &way_out(&way_in), &wear(0.2), 39.5).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::PLAN_VALUE, Some("wear_largest")));
        assert!(error.to_string().contains("0.15 mm, bound 0.2 mm"), "{error}");
        assert!(switches(&way_in, &way_out(&way_in), &wear(0.14), 39.5).is_ok());
    }

    #[test]
    fn without_room_it_is_refused_and_with_little_the_lines_are_short() {
        let way_in = lead(24.0);
        let wear = |largest| Wear { register: 2, largest };
        let at = way_in[0].start().length();
        let error = switches(&way_in, &way_out(&way_in), &wear(0.2), at + 0.01).unwrap_err();
        assert_eq!(error.code(), Code::START_OUTSIDE);
        assert!(error.0.value.as_ref().unwrap().value > at + 0.01);
        // Whatever is accepted is in the open on both sides, and long enough.
        let mut accepted = 0;
        for i in 0..400 {
            let (largest, open) = (0.02 + 0.02 * f64::from(i % 20), at + 0.1 * f64::from(i / 20));
            let Ok(s) = switches(&way_in, &way_out(&way_in), &wear(largest), open) else { continue };
            accepted += 1;
            let (p, n) = (way_in[0].start(), way_in[0].at(0.0).d1.perp());
            assert!(s.start.length() <= open && (p - s.start).length() > largest);
            assert!((p + n * largest).length() <= open && (p - n * largest).length() <= open);
        }
        assert!(accepted > 100 && accepted < 400, "{accepted}");
    }
}
