//! The cycles `CYCLE81` to `CYCLE83` of drilling and `CYCLE84` of rigid tapping: their arguments, and the motion that they ask for.
//!
//! ```text
//! CYCLE81(RTP, RFP, SDIS, DP, DPR)
//! CYCLE82(RTP, RFP, SDIS, DP, DPR, DTB)
//! CYCLE83(RTP, RFP, SDIS, DP, DPR, FDEP, FDPR, DAM, DTB, DTS, FRF, VARI, _AXN, _MDEP, _VRT, _DTD, _DIS1)
//! CYCLE84(RTP, RFP, SDIS, DP, DPR, DTB, SDAC, MPIT, PIT, POSS, SST, SST1, _AXN)
//! ```
//!
//! `RTP` height of the return, `RFP` surface, `SDIS` distance above it from which to feed, `DP` height of the bottom or
//! `DPR` its depth, `DTB` dwell there (`CYCLE83`: after each step). `CYCLE83`: `FDEP` height of the bottom of the first
//! step or `FDPR` its depth below the surface, `DAM` what each next step is shorter, `DTS` dwell after withdrawing,
//! `FRF` part of the feed for the first step (0.001 to 1), `VARI` 1 to withdraw to `RFP + SDIS` after each step and 0 to
//! break the chip only, `_VRT` lift for that (0: 1 mm), `_DTD` dwell at the bottom (0: as `DTB`), `_DIS1` distance above
//! the last depth at which the rapid back in ends (0: from the depth of the hole). Times below zero are revolutions.
//!
//! `CYCLE84`: `SDAC` 3, 4 or 5, what the spindle does after it (`M3`, `M4`, `M5`); the pitch as a size of metric threads, `MPIT`
//! (refused), or as a length, `PIT`, negative for a left-hand thread; `POSS` angle at which the spindle is stopped first; `SST`
//! speed in, `SST1` speed out (0: as in).
//!
//! Source: the argument lists with these meanings are those of the programming guide "Cycles" of the 840D, as quoted in
//! published post-processors. *From memory* of that guide: the lift is made at the feed; the distance of `_DIS1 = 0` is
//! 0.6 mm up to 30 mm of depth, then a fiftieth of it, at most 7 mm; the law of `DAM`; without `DAM` all steps are
//! alike. The treatment of a remainder is not known for certain then: [`Read::disputed`]. Arguments after those above
//! (`_GMODE`, `_DMODE`, `_AMODE`, and the feeds of a pre-drilled and a through-drilled part of newer versions of
//! `CYCLE82`) are refused: no list of them could be found.

use std::f64::consts::TAU;

use crate::program::{Between, Cycle, DeepHole, Shortening, Spindle, Tapping};
use crate::tool::Hand;

/// One of the cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nc) enum Call {
    Cycle81,
    Cycle82,
    Cycle83,
    Cycle84,
}

/// Places of the arguments.
const RTP: usize = 0;
const RFP: usize = 1;
const SDIS: usize = 2;
const DP: usize = 3;
const DPR: usize = 4;
const FDEP: usize = 5;
const FDPR: usize = 6;
const DAM: usize = 7;
const DTS: usize = 9;
const FRF: usize = 10;
const VARI: usize = 11;
const AXN: usize = 12;
const MDEP: usize = 13;
const VRT: usize = 14;
const DTD: usize = 15;
const DIS1: usize = 16;
const SDAC: usize = 6;
const MPIT: usize = 7;
const PIT: usize = 8;
const SST: usize = 10;
const SST1: usize = 11;

/// Names of the arguments of `CYCLE84`.
const TAP_NAMES: [&str; 13] =
    ["RTP", "RFP", "SDIS", "DP", "DPR", "DTB", "SDAC", "MPIT", "PIT", "POSS", "SST", "SST1", "_AXN"];

/// Names of the arguments of `CYCLE83`; `CYCLE81` and `CYCLE82` have the first of them, and `DTB` as their sixth.
const NAMES: [&str; 17] = [
    "RTP", "RFP", "SDIS", "DP", "DPR", "FDEP", "FDPR", "DAM", "DTB", "DTS", "FRF", "VARI", "_AXN", "_MDEP",
    "_VRT", "_DTD", "_DIS1",
];

/// Lift when none is said [mm].
const USUAL_LIFT: f64 = 1.0;
/// Distance above the last depth when none is said [mm]: the least, the part of the depth, the largest.
const LEAST_DISTANCE: f64 = 0.6;
const DISTANCE_PART: f64 = 1.0 / 50.0;
const LARGEST_DISTANCE: f64 = 7.0;
/// Range of the feed factor.
const FACTORS: std::ops::RangeInclusive<f64> = 0.001..=1.0;
/// Heights that are the same [mm]: rounding of sums of decimal numbers.
const SAME: f64 = 1e-9;

/// Content of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::nc) struct Read {
    pub(in crate::nc) cycle: Cycle,
    /// Of a thread: the spindle in it and after it.
    pub(in crate::nc) spindle: Option<[Spindle; 2]>,
    /// Detail of its motion that is not certain.
    pub(in crate::nc) disputed: Option<&'static str>,
}

/// Why a call is not understood, and by which argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::nc) struct Wrong {
    pub(in crate::nc) argument: Option<usize>,
    pub(in crate::nc) why: &'static str,
}

fn wrong(argument: usize, why: &'static str) -> Wrong {
    Wrong { argument: Some(argument), why }
}

impl Call {
    /// The cycle of a name.
    pub(in crate::nc) fn parse(name: &str) -> Option<Call> {
        [Call::Cycle81, Call::Cycle82, Call::Cycle83, Call::Cycle84]
            .into_iter()
            .find(|c| c.name().eq_ignore_ascii_case(name))
    }

    /// Its name.
    pub(in crate::nc) fn name(self) -> &'static str {
        match self {
            Call::Cycle81 => "CYCLE81",
            Call::Cycle82 => "CYCLE82",
            Call::Cycle83 => "CYCLE83",
            Call::Cycle84 => "CYCLE84",
        }
    }

    fn count(self) -> usize {
        match self {
            Call::Cycle81 => 5,
            Call::Cycle82 => 6,
            Call::Cycle83 => NAMES.len(),
            Call::Cycle84 => TAP_NAMES.len(),
        }
    }

    /// Place of the dwell.
    fn dtb(self) -> usize {
        if self == Call::Cycle83 { 8 } else { 5 }
    }

    /// Name of an argument.
    pub(in crate::nc) fn argument(self, place: usize) -> &'static str {
        match self {
            Call::Cycle84 => TAP_NAMES.get(place).copied().unwrap_or("an argument"),
            _ if place == self.dtb() => "DTB",
            _ => NAMES.get(place).copied().unwrap_or("an argument"),
        }
    }

    /// The motion of a call; `unit`: millimetres in its unit of length, `rate`: spindle speed [rad/s].
    pub(in crate::nc) fn read(
        self,
        arguments: &[Option<f64>],
        unit: f64,
        rate: Option<f64>,
    ) -> Result<Read, Wrong> {
        if let Some(place) = (self.count()..arguments.len()).find(|i| arguments[*i].is_some()) {
            return Err(wrong(place, "what it means here is not known"));
        }
        let said = Said { call: self, arguments, unit, rate };
        let heights = said.heights()?;
        let dwell = said.time(self.dtb())?;
        match self {
            Call::Cycle81 | Call::Cycle82 => {
                let Heights { reference, bottom, retract, .. } = heights;
                let cycle = Cycle::Drill { reference, bottom, retract, dwell };
                Ok(Read { cycle, spindle: None, disputed: None })
            }
            Call::Cycle83 => said.deep_hole(&heights, dwell),
            Call::Cycle84 => said.thread(&heights, dwell),
        }
    }
}

/// The heights of a cycle [mm].
struct Heights {
    /// Surface of the work.
    surface: f64,
    /// Height from which to feed.
    reference: f64,
    bottom: f64,
    retract: f64,
}

/// The arguments of a call.
struct Said<'a> {
    call: Call,
    arguments: &'a [Option<f64>],
    /// Millimetres in its unit of length.
    unit: f64,
    /// Spindle speed [rad/s].
    rate: Option<f64>,
}

impl Said<'_> {
    fn said(&self, place: usize) -> Option<f64> {
        self.arguments.get(place).copied().flatten()
    }

    fn length(&self, place: usize) -> Option<f64> {
        self.said(place).map(|v| v * self.unit)
    }

    /// A length above zero, if there is one.
    fn positive(&self, place: usize) -> Result<Option<f64>, Wrong> {
        match self.length(place) {
            Some(value) if value < 0.0 => Err(wrong(place, "it is not negative")),
            value => Ok(value.filter(|v| *v > 0.0)),
        }
    }

    /// Seconds; negative ones of `CYCLE83` are revolutions.
    fn time(&self, place: usize) -> Result<f64, Wrong> {
        match self.said(place) {
            None => Ok(0.0),
            Some(seconds) if seconds >= 0.0 => Ok(seconds),
            Some(_) if self.call != Call::Cycle83 => Err(wrong(place, "it is not negative")),
            Some(turns) => match self.rate.filter(|r| *r > 0.0) {
                Some(rate) => Ok(-turns * TAU / rate),
                None => Err(wrong(place, "revolutions need a spindle speed")),
            },
        }
    }

    fn heights(&self) -> Result<Heights, Wrong> {
        let height = |place: usize| self.length(place).ok_or(wrong(place, "it is needed"));
        let (retract, surface) = (height(RTP)?, height(RFP)?);
        let distance = self.length(SDIS).unwrap_or(0.0);
        if distance < 0.0 {
            return Err(wrong(SDIS, "it is not negative"));
        }
        let reference = surface + distance;
        let bottom = match (self.length(DP), self.length(DPR)) {
            (Some(bottom), None) => bottom,
            (None, Some(depth)) if retract - surface <= SAME && depth > 0.0 => {
                return Err(wrong(DPR, "a relative depth needs RTP above RFP"));
            }
            (None, Some(depth)) if depth > 0.0 => surface - depth,
            (None, Some(_)) => return Err(wrong(DPR, "it is positive")),
            (None, None) => return Err(wrong(DP, "it or DPR is needed")),
            (Some(bottom), Some(depth)) if (surface - depth - bottom).abs() <= SAME => bottom,
            (Some(_), Some(_)) => return Err(wrong(DPR, "it contradicts DP")),
        };
        if bottom >= reference {
            return Err(wrong(DP, "the bottom is not below the surface"));
        }
        if retract < reference {
            return Err(wrong(RTP, "it is below the height from which to feed"));
        }
        Ok(Heights { surface, reference, bottom, retract })
    }

    /// Depth of the first step.
    fn first(&self, heights: &Heights) -> Result<f64, Wrong> {
        let surface = heights.surface;
        let first = match (self.length(FDEP), self.length(FDPR)) {
            (Some(first), None) => first,
            (None, Some(depth)) => surface - depth,
            (None, None) => return Err(wrong(FDEP, "it or FDPR is needed")),
            (Some(first), Some(depth)) if (surface - depth - first).abs() <= SAME => first,
            (Some(_), Some(_)) => return Err(wrong(FDPR, "it contradicts FDEP")),
        };
        if surface - first <= 0.0 || first < heights.bottom - SAME {
            return Err(wrong(FDEP, "the first step does not end between the surface and the bottom"));
        }
        Ok(first)
    }

    /// The steps after the first, which is `stroke` long, over the rest of the hole.
    fn steps(&self, stroke: f64, rest: f64) -> Result<(Shortening, f64, Option<&'static str>), Wrong> {
        let least = self.length(MDEP).unwrap_or(0.0);
        match self.length(DAM).unwrap_or(0.0) {
            amount if amount > 0.0 && least > 0.0 => {
                Err(wrong(MDEP, "how it works together with DAM is not known"))
            }
            amount if amount > stroke => Err(wrong(DAM, "it is larger than the first step")),
            amount if amount > 0.0 => {
                let step = (stroke - amount).max(amount);
                Ok((Shortening::Degressive { amount }, step, Some("how DAM divides the hole into steps")))
            }
            0.0 if least > stroke + SAME => Err(wrong(MDEP, "it is larger than the first step")),
            0.0 => {
                let steps = rest / stroke;
                let whole = (steps - steps.round()).abs() * stroke <= SAME;
                let disputed = "how the rest of the hole below the last full step is drilled";
                Ok((Shortening::None, stroke, (!whole).then_some(disputed)))
            }
            _ => Err(wrong(DAM, "a factor of degression is not read")),
        }
    }

    /// The move between two steps, and what of it is not certain where anything is left to drill after the first.
    fn between(&self, heights: &Heights, rest: f64) -> Result<(Between, Option<&'static str>), Wrong> {
        let (lift, back, dwell) = (self.positive(VRT)?, self.positive(DIS1)?, self.time(DTS)?);
        let (between, disputed) = match self.said(VARI).unwrap_or(0.0) {
            0.0 => (
                Between::Lift { lift: lift.unwrap_or(USUAL_LIFT), at_feed: true },
                Some("that the lift between two steps is made at the feed"),
            ),
            1.0 => {
                let usual = (DISTANCE_PART * (heights.surface - heights.bottom))
                    .clamp(LEAST_DISTANCE, LARGEST_DISTANCE);
                let clearance = back.unwrap_or(usual);
                let unsaid = "how far above the last depth the rapid back in ends (_DIS1)";
                (Between::Withdraw { clearance, dwell }, back.is_none().then_some(unsaid))
            }
            _ => return Err(wrong(VARI, "0 breaks the chip, 1 withdraws")),
        };
        Ok((between, disputed.filter(|_| rest > SAME)))
    }

    fn deep_hole(&self, heights: &Heights, dwell: f64) -> Result<Read, Wrong> {
        let Heights { surface, reference, bottom, retract } = *heights;
        let first = self.first(heights)?;
        let (stroke, rest) = (surface - first, first - bottom);
        let (shortening, step, of_steps) = self.steps(stroke, rest)?;
        let first_feed = self.said(FRF).unwrap_or(1.0);
        if !FACTORS.contains(&first_feed) {
            return Err(wrong(FRF, "the feed factor is from 0.001 to 1"));
        }
        if matches!(self.said(AXN), Some(axis) if axis == 1.0 || axis == 2.0) {
            return Err(wrong(AXN, "only the axis of the tool is drilled along"));
        }
        let (between, of_between) = self.between(heights, rest)?;
        let disputed = of_steps.or(of_between);
        let dwell_bottom = match self.time(DTD)? {
            0.0 => dwell,
            seconds => seconds,
        };
        let cycle = match between {
            Between::Withdraw { clearance, dwell: dwell_top }
                if reference == surface
                    && shortening == Shortening::None
                    && [dwell, dwell_bottom, dwell_top] == [0.0; 3]
                    && first_feed == 1.0 =>
            {
                Cycle::Peck { reference, bottom, retract, step: stroke, clearance }
            }
            _ => Cycle::DeepHole(DeepHole {
                reference,
                first,
                bottom,
                retract,
                step,
                shortening,
                between,
                first_feed,
                dwell,
                dwell_bottom,
            }),
        };
        Ok(Read { cycle, spindle: None, disputed })
    }

    fn thread(&self, heights: &Heights, dwell: f64) -> Result<Read, Wrong> {
        let Heights { reference, bottom, retract, .. } = *heights;
        if self.said(MPIT).is_some_and(|size| size != 0.0) {
            return Err(wrong(MPIT, "the pitch is read from PIT"));
        }
        let pitch = self.length(PIT).filter(|p| *p != 0.0).ok_or(wrong(PIT, "it is needed"))?;
        if matches!(self.said(AXN), Some(axis) if axis == 1.0 || axis == 2.0) {
            return Err(wrong(AXN, "only the axis of the tool is drilled along"));
        }
        let speed = |place: usize| self.said(place).filter(|s| *s > 0.0).map(|s| s * TAU / 60.0);
        let rate = speed(SST).or(self.rate).ok_or(wrong(SST, "it is needed"))?;
        let hand = if pitch > 0.0 { Hand::Right } else { Hand::Left };
        let own = self.rate.unwrap_or(rate);
        let after = match self.said(SDAC).unwrap_or(5.0) {
            3.0 => Spindle::Clockwise(own),
            4.0 => Spindle::CounterClockwise(own),
            0.0 | 5.0 => Spindle::Off,
            _ => return Err(wrong(SDAC, "it is 3, 4 or 5")),
        };
        let other = speed(SST1).is_some_and(|out| out != rate);
        let disputed = match (other, dwell > 0.0) {
            (true, _) => Some("the way out is taken to be as fast as the way in (SST1)"),
            (false, true) => Some("the wait at the bottom is left out of the time (DTB)"),
            (false, false) => None,
        };
        let pitch = pitch.abs();
        let cycle = Cycle::Tap(Tapping { reference, bottom, retract, pitch, hand });
        Ok(Read { cycle, spindle: Some([Spindle::turning(hand, rate), after]), disputed })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some(values: &[f64]) -> Vec<Option<f64>> {
        // Not a number: left out.
        values.iter().map(|v| (!v.is_nan()).then_some(*v)).collect()
    }

    const OUT: f64 = f64::NAN;

    #[test]
    fn a_depth_is_absolute_or_relative() {
        let wanted = Cycle::Drill { reference: 2.0, bottom: -20.0, retract: 10.0, dwell: 0.0 };
        for arguments in
            [vec![10.0, 0.0, 2.0, -20.0], vec![10.0, 0.0, 2.0, OUT, 20.0], vec![10.0, 0.0, 2.0, -20.0, 20.0]]
        {
            let read = Call::Cycle81.read(&some(&arguments), 1.0, None).unwrap();
            assert_eq!(read, Read { cycle: wanted, spindle: None, disputed: None }, "{arguments:?}");
        }
        let inch = Call::Cycle81.read(&some(&[1.0, 0.0, OUT, -1.0]), 25.4, None).unwrap();
        assert_eq!(inch.cycle, Cycle::Drill { reference: 0.0, bottom: -25.4, retract: 25.4, dwell: 0.0 });
    }

    #[test]
    fn what_is_not_known_is_refused_by_its_argument() {
        let of =
            |call: Call, values: &[f64]| call.read(&some(values), 1.0, None).unwrap_err().argument.unwrap();
        assert_eq!(of(Call::Cycle81, &[OUT, 0.0, 2.0, -20.0]), RTP);
        assert_eq!(of(Call::Cycle81, &[10.0, 0.0, 2.0]), DP);
        assert_eq!(of(Call::Cycle81, &[10.0, 0.0, 2.0, -20.0, 19.0]), DPR);
        assert_eq!(of(Call::Cycle81, &[0.0, 0.0, 0.0, OUT, 19.0]), DPR);
        assert_eq!(of(Call::Cycle81, &[10.0, 0.0, 2.0, -20.0, OUT, 0.5]), 5);
        assert_eq!(of(Call::Cycle82, &[10.0, 0.0, 2.0, -20.0, OUT, -0.5]), 5);
        assert_eq!(of(Call::Cycle82, &[10.0, 0.0, 2.0, -20.0, OUT, 0.5, 0.0]), 6);
        let deep = |place: usize, value: f64| {
            let mut values = [OUT; 18];
            values[..6].copy_from_slice(&[10.0, 0.0, 2.0, -20.0, OUT, -5.0]);
            values[place] = value;
            of(Call::Cycle83, &values)
        };
        for (place, value) in
            [(FDEP, -21.0), (FDEP, 1.0), (FDPR, 4.0), (DAM, -0.5), (DAM, 6.0), (FRF, 0.0), (FRF, 100.0)]
        {
            assert_eq!(deep(place, value), if place == FDPR { FDPR } else { place }, "{place} {value}");
        }
        for (place, value) in [(VARI, 2.0), (AXN, 1.0), (VRT, -1.0), (17, 0.0), (8, -3.0), (MDEP, 6.0)] {
            assert_eq!(deep(place, value), place, "{place} {value}");
        }
    }
}
