//! Ways that a machine may take in a rapid move of several axes: each axis at its own speed until it has arrived.

use glam::DVec3;

use super::follow::Follow;
use crate::base::Result;
use crate::geom::Line;
use crate::machine::Rapids;
use crate::program::{Speed, State};

/// Speed of a linear axis [mm/s] and of a rotary one [rad/s] that nobody gave: only their ratio counts.
const USUAL: [f64; 2] = [500.0, 2.0];
/// How much faster one kind of axes is taken where the ratio is not known: it has arrived before the other has moved.
const FIRST: f64 = 1e6;

impl Follow<'_> {
    /// Whether the axes of a rapid may run for themselves: as the machine says, else unless the control keeps to the line.
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

/// The ways of a rapid of linear axes: at the same speed and, where they are known, at their own speeds. Empty when all are the
/// straight line.
pub(super) fn ways(start: DVec3, end: DVec3, speeds: Option<DVec3>) -> Vec<Line> {
    let line = |speeds: DVec3| -> Vec<Line> {
        legs(&start.to_array(), &end.to_array(), &speeds.to_array())
            .into_iter()
            .map(|[a, b]| Line { start: DVec3::from_array(a), end: DVec3::from_array(b) })
            .collect()
    };
    let mut all = line(DVec3::ONE);
    let own = speeds.filter(|s| s.min_element() < s.max_element()).map(line);
    all.extend(own.into_iter().flatten());
    all
}

/// The legs of a way on which each axis runs at its speed until it has arrived; none when that is the straight line.
fn legs<const N: usize>(from: &[f64; N], to: &[f64; N], speeds: &[f64; N]) -> Vec<[[f64; N]; 2]> {
    /// What is left of a coordinate that went through a chain of axes and back [mm, rad].
    const ROUNDING: f64 = 1e-9;
    let mut needed = [0.0; N];
    for i in 0..N {
        let way = (to[i] - from[i]).abs();
        needed[i] = if way > ROUNDING { way / speeds[i] } else { 0.0 };
    }
    let mut times: Vec<f64> = needed.iter().copied().filter(|t| *t > 0.0).collect();
    times.sort_by(f64::total_cmp);
    // Times that differ by rounding are one.
    times.dedup_by(|later, earlier| *later <= *earlier * (1.0 + 1e-12));
    let at = |t: f64| -> [f64; N] {
        std::array::from_fn(|i| {
            if needed[i] <= t { to[i] } else { from[i] + (to[i] - from[i]) * (t / needed[i]) }
        })
    };
    let mut legs = Vec::new();
    let mut start = *from;
    for (k, t) in times.iter().enumerate() {
        let end = if k + 1 == times.len() { *to } else { at(*t) };
        legs.push([start, end]);
        start = end;
    }
    if legs.len() > 1 { legs } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rapid_axis_by_axis_first_runs_diagonally_then_along_the_longer_axis() {
        let legs = ways(DVec3::ZERO, DVec3::new(30.0, -10.0, 0.0), None);
        assert_eq!(legs.len(), 2);
        assert_eq!(legs[0].end, DVec3::new(10.0, -10.0, 0.0));
        assert_eq!(legs[1].end, DVec3::new(30.0, -10.0, 0.0));
        assert!(ways(DVec3::ZERO, DVec3::new(5.0, 5.0, 0.0), None).is_empty());
        assert!(ways(DVec3::ZERO, DVec3::Z, None).is_empty());
    }

    #[test]
    fn axes_of_different_speeds_run_another_way_too() {
        let speeds = Some(DVec3::new(10.0, 10.0, 5.0));
        let legs = ways(DVec3::ZERO, DVec3::new(20.0, 0.0, 20.0), speeds);
        // At the same speed it is the straight line; at their own X arrives when Z is half way.
        assert_eq!(legs.len(), 2);
        assert_eq!(legs[0].end, DVec3::new(20.0, 0.0, 10.0));
        assert_eq!(ways(DVec3::ZERO, DVec3::new(20.0, 0.0, 30.0), speeds).len(), 4);
    }
}
