//! The samples of a run: what is kept of them, and the largest of all.

use glam::DVec3;

use super::{END_PARTS, END_SHARE, PassPeaks, RESTS};
use crate::geom::Jet;
use crate::motion::MotionSample;

/// A place of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    pub(super) s: f64,
    pub(super) time: f64,
    pub(super) speed: f64,
    pub(super) along: f64,
    pub(super) acceleration: f64,
    pub(super) jerk_along: Option<f64>,
    pub(super) jerk: Option<f64>,
}

/// Contents of the samples, by the kind of the control.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    /// It limits jerk, so that acceleration does not step.
    pub(super) has_jerk: bool,
    /// It runs along chords: their acceleration is that along the path alone.
    pub(super) by_chords: bool,
}

/// Places of a part of the way that are kept: the slowest, then those with most of each size.
const EXTREMES: usize = 6;

/// Sizes of a place, the largest of which is kept.
fn sizes(place: &Place) -> [f64; EXTREMES] {
    let size = |v: Option<f64>| v.map_or(0.0, f64::abs);
    let Place { speed, along, acceleration, jerk_along, jerk, .. } = *place;
    [-speed, speed, along.abs(), acceleration, size(jerk_along), size(jerk)]
}

/// The samples of a run: what is kept of them, and the largest of all.
pub(super) struct Kept {
    model: Model,
    length: f64,
    /// Length of the stretches at both ends [mm], and number of parts between them.
    end: f64,
    parts: f64,
    last: Option<Place>,
    direction: DVec3,
    /// Index of the present part, and its extreme places.
    present: Option<(u64, [Place; EXTREMES])>,
    places: Vec<Place>,
    peaks: PassPeaks,
}

impl Kept {
    /// Of a way [mm], cut into so many parts and those of the stretches at both ends [mm].
    pub(super) fn new(length: f64, (end, parts): (f64, f64), model: Model) -> Kept {
        let most = END_SHARE * length;
        let zero = model.has_jerk.then_some(0.0);
        Kept {
            model,
            length,
            end: if end < most { end } else { most },
            parts,
            last: None,
            direction: DVec3::ZERO,
            present: None,
            places: Vec::new(),
            peaks: PassPeaks { jerk: zero, jerk_along: zero, axis_jerk: zero, ..PassPeaks::default() },
        }
    }

    /// Adds a sample at a place of the programmed path [mm], with the path there.
    pub(super) fn add(&mut self, sample: &MotionSample, s: f64, path: Option<&Jet>) {
        let [x, y, z, ..] = &sample.axes;
        let velocity = DVec3::new(x.velocity, y.velocity, z.velocity);
        let mut acceleration = DVec3::new(x.acceleration, y.acceleration, z.acceleration);
        let jerk = DVec3::new(x.jerk, y.jerk, z.jerk);
        if velocity.length() > RESTS {
            self.direction = velocity.normalize_or_zero();
        } else if self.last.is_none() {
            // From rest the tool begins to move where jerk and acceleration push it.
            self.direction = (acceleration + jerk).normalize_or_zero();
        }
        let along = acceleration.dot(self.direction);
        if self.model.by_chords
            && let Some(jet) = path
        {
            let across = jet.d2 * sample.feed.powi(2);
            // At a cusp, which is left from rest, there is none.
            acceleration = jet.d1 * along + if across.is_finite() { across } else { DVec3::ZERO };
        }
        let known = |v: f64| self.model.has_jerk.then_some(v);
        let place = Place {
            s,
            time: sample.time,
            speed: sample.feed,
            along,
            acceleration: acceleration.length(),
            jerk_along: known(jerk.dot(self.direction)),
            jerk: known(jerk.length()),
        };
        self.last = Some(place);
        let peaks = &mut self.peaks;
        let largest = |peak: &mut f64, v: f64| {
            if v > *peak {
                *peak = v;
            }
        };
        largest(&mut peaks.speed, place.speed);
        largest(&mut peaks.along, place.along.abs());
        largest(&mut peaks.acceleration, place.acceleration);
        largest(&mut peaks.axis_acceleration, acceleration.abs().max_element());
        let axis = jerk.abs().max_element();
        let own = [place.jerk_along.map(f64::abs), place.jerk, Some(axis)];
        for (peak, v) in [&mut peaks.jerk_along, &mut peaks.jerk, &mut peaks.axis_jerk].into_iter().zip(own) {
            if let (Some(peak), Some(v)) = (peak.as_mut(), v) {
                largest(peak, v);
            }
        }
        let part = self.part(place.s);
        match &mut self.present {
            Some((present, extremes)) if *present == part => {
                for (k, size) in sizes(&place).into_iter().enumerate() {
                    if size > sizes(&extremes[k])[k] {
                        extremes[k] = place;
                    }
                }
            }
            _ => {
                self.end_part();
                self.present = Some((part, [place; EXTREMES]));
            }
        }
    }

    /// Number of the part of the way in which a place is.
    fn part(&self, s: f64) -> u64 {
        let (left, small) = (self.length - s, END_PARTS / self.end);
        let number = if s < self.end {
            s * small
        } else if left < self.end {
            END_PARTS + self.parts + (self.end - left) * small
        } else {
            END_PARTS + (s - self.end) * self.parts / (self.length - 2.0 * self.end)
        };
        // In range: a way has finitely many parts.
        number as u64
    }

    fn end_part(&mut self) {
        let Some((_, mut all)) = self.present.take() else { return };
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        for place in all {
            if self.places.last() != Some(&place) {
                self.places.push(place);
            }
        }
    }

    /// The places in order, the last one too.
    pub(super) fn places(mut self) -> (Vec<Place>, PassPeaks) {
        self.end_part();
        if let Some(last) = self.last.filter(|last| self.places.last() != Some(last)) {
            self.places.push(last);
        }
        (self.places, self.peaks)
    }
}
