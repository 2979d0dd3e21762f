//! Ways of a rapid move of several axes on a machine, by the speeds of its axes.

use glam::DVec3;

use super::follow::Follow;
use super::rapids::legs;
use crate::base::Result;
use crate::machine::Rapids;
use crate::program::{Speed, State};

/// Speed of a linear axis [mm/s] and of a rotary one [rad/s] that nobody gave: only their ratio counts.
const USUAL: [f64; 2] = [500.0, 2.0];

/// Ratio taken for the speeds of rotary and linear axes where it is not known: one kind has arrived before the other
/// has moved.
const FIRST: f64 = 1e6;

impl Follow<'_> {
    /// True if the axes of a rapid may run each for itself: as the machine says, else unless the control keeps to the
    /// line.
    pub(super) fn runs_apart(&self, state: &State) -> bool {
        let Speed::Rapid { linear } = state.speed else { return false };
        let said = self.options.machine.and_then(|m| m.rapids);
        !self.on_leg
            && match said {
                Some(Rapids::Straight) => false,
                Some(Rapids::AxisByAxis) => true,
                None => !linear,
            }
    }

    /// Rapid speeds of X, Y, Z [mm/s], if all are known.
    pub(super) fn rapid_speeds(&self) -> Option<DVec3> {
        let machine = self.options.machine?;
        let of = |letter| {
            let own = machine.joint(letter).and_then(|(_, joint)| joint.dynamics.rapid);
            own.or(machine.dynamics.rapid)
        };
        Some(DVec3::new(of('X')?, of('Y')?, of('Z')?))
    }

    /// Follows the ways of a rapid in which rotary axes turn: linear axes between `linear`, rotary axes between `rotary`.
    pub(super) fn legs(
        &mut self,
        index: usize,
        linear: [DVec3; 2],
        rotary: [[f64; 3]; 2],
        state: &State,
    ) -> Result<()> {
        let Some(chain) = self.chain.clone().filter(|_| self.runs_apart(state)) else { return Ok(()) };
        let all =
            |i: usize| [linear[i].x, linear[i].y, linear[i].z, rotary[i][0], rotary[i][1], rotary[i][2]];
        let (from, to) = (all(0), all(1));
        let standing = (self.rotary, self.axis, self.trace.segments.len());
        self.on_leg = true;
        for speeds in self.all_speeds() {
            for [start, end] in legs(&from, &to, &speeds) {
                let linear = |q: [f64; 6]| DVec3::new(q[0], q[1], q[2]);
                let turned = |q: [f64; 6]| [q[3], q[4], q[5]];
                self.rotary = turned(start);
                self.chords_of(index, &chain, (linear(start), linear(end)), turned(end), None, state)?;
            }
        }
        self.on_leg = false;
        (self.rotary, self.axis) = (standing.0, standing.1);
        for segment in &mut self.trace.segments[standing.2..] {
            segment.alternative = true;
        }
        Ok(())
    }

    /// Speeds of all axes with which a rapid may be run [mm/s, rad/s].
    fn all_speeds(&self) -> Vec<[f64; 6]> {
        let machine = self.options.machine;
        let mut complete = true;
        let mut speeds = [0.0; 6];
        for (i, letter) in super::chain::LETTERS.into_iter().enumerate() {
            let own = machine.and_then(|m| m.joint(letter)).and_then(|(_, joint)| joint.dynamics.rapid);
            let known = own.or(machine.and_then(|m| m.dynamics.rapid).filter(|_| i < 3));
            complete &= known.is_some() || machine.is_none_or(|m| m.joint(letter).is_none());
            speeds[i] = known.unwrap_or(USUAL[usize::from(i > 2)]);
        }
        let rotary = |by: f64| [0, 1, 2, 3, 4, 5].map(|i| speeds[i] * if i > 2 { by } else { 1.0 });
        if complete { vec![speeds] } else { vec![speeds, rotary(FIRST), rotary(1.0 / FIRST)] }
    }
}
