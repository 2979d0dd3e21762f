//! Directions that the tool's axis reaches within the ranges of the rotary axes.
//!
//! Counted on directions spread evenly, both solutions of each; with more than two rotary axes the first ones are
//! stepped through their range. Half spheres and tilts are about the spindle at home.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::Sizes;
use crate::machine::kinematics::{Travels, sphere_directions};
use crate::machine::{Elementary, Kinematics, Word};

/// Directions that are tried.
const DIRECTIONS: usize = 2000;
/// Steps of each rotary axis before the last two.
const STEPS: u32 = 12;

/// Directions that the tool's axis reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Share of all directions.
    pub cover: f64,
    /// Share of the directions of the half sphere about the direction at home.
    pub upper_cover: f64,
    /// All directions within this angle of that at home are reached [rad]; to the spacing of the directions tried, about
    /// 2.5 degrees.
    pub tilt: f64,
}

/// Which directions a word reaches with the ranges given; the single ones of a machine with fewer than two rotary axes
/// are no cover.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Word, layouts::{Sizes, reach}};
/// let bridge = reach(&Word::parse("12365").unwrap(), &Sizes::default()); // B to 120 degrees
/// assert_eq!((bridge.cover, bridge.upper_cover), (0.75, 1.0));
/// ```
pub fn reach(word: &Word, sizes: &Sizes) -> Reach {
    let rotary = Word(word.0.iter().copied().filter(|m| m.is_rotation()).collect());
    let axes = Axes::new(&rotary.0, sizes);
    let spindle = sizes.spindle();
    let to_spindle = DQuat::from_rotation_arc(DVec3::Z, spindle);
    let (mut all, mut above, mut upper, mut least_missed) = (0usize, 0usize, 0usize, PI);
    for direction in sphere_directions(DIRECTIONS) {
        let reached = axes.as_ref().is_some_and(|a| a.reach(0, to_spindle * direction, &mut [0.0; 8]));
        let side = direction.z > 0.0;
        all += usize::from(reached);
        above += usize::from(side);
        upper += usize::from(side && reached);
        if !reached {
            least_missed = f64::min(least_missed, direction.z.acos());
        }
    }
    // Of a direction next to home nothing is known below the spacing.
    let spacing = (4.0 * PI / DIRECTIONS as f64).sqrt();
    Reach {
        cover: all as f64 / DIRECTIONS as f64,
        upper_cover: upper as f64 / above.max(1) as f64,
        tilt: if least_missed < spacing { 0.0 } else { least_missed },
    }
}

/// The rotary axes alone.
struct Axes {
    chain: Kinematics,
    travels: Travels,
    /// Ranges through which the axes before the last two step.
    stepped: Vec<[f64; 2]>,
    locked: Vec<bool>,
}

impl Axes {
    fn new(rotary: &[Elementary], sizes: &Sizes) -> Option<Axes> {
        let first = rotary.len().checked_sub(2)?;
        let mut travels = Travels::default();
        for (slot, &motion) in travels.0.iter_mut().zip(rotary) {
            *slot = sizes.limit(motion);
        }
        Some(Axes {
            chain: sizes.kinematics(&Word(rotary.to_vec())),
            travels,
            stepped: rotary[..first].iter().map(|&m| sizes.range(m)).collect(),
            locked: (0..rotary.len()).map(|i| i < first).collect(),
        })
    }

    /// True if a direction is reached with the axes before `next` at their positions of `at`.
    fn reach(&self, next: usize, wanted: DVec3, at: &mut [f64; 8]) -> bool {
        let Some(&[low, high]) = self.stepped.get(next) else {
            let reach =
                self.chain.direction_reach(wanted, &self.travels, &at[..self.locked.len()], &self.locked);
            return reach.is_ok_and(|r| r.reached());
        };
        (0..=STEPS).any(|i| {
            at[next] = low + (high - low) * f64::from(i) / f64::from(STEPS);
            self.reach(next + 1, wanted, at)
        })
    }
}
