//! The chain of the axes that are free, with those that are held folded into it.

use super::super::{Kinematics, Screw};
use super::pair::Pair;
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::JointValues;

/// Most free axes of the closed form: three translations and two rotations.
pub(super) const MOST_FREE: usize = 5;

/// A chain of free axes.
pub(in super::super) struct Free<'a> {
    screws: [Screw; MOST_FREE],
    /// Places in the whole chain.
    pub(in super::super) place: [usize; MOST_FREE],
    count: usize,
    /// The tip frame at home of this chain.
    pub(in super::super) tool: Rigid,
    /// Positions of the whole chain: held ones given, free ones zero.
    pub(super) start: JointValues,
    /// Places of the rotations among the free axes.
    rotaries: [usize; 2],
    rotary_count: usize,
    /// Geometry of its two rotary axes that is the same for all directions, if it is known already.
    pub(in super::super) pair: Option<&'a Pair>,
}

impl<'a> Free<'a> {
    /// A held axis moves all axes after it once and for all:
    /// `exp(x1 q1) E exp(x2 q2) T = exp(x1 q1) exp((Ad E x2) q2) E T`.
    #[inline]
    pub(in super::super) fn new(chain: &'a Kinematics, given: &[f64], locked: &[bool]) -> Result<Free<'a>> {
        let mut free = Free {
            screws: [Screw::NONE; MOST_FREE],
            place: [0; MOST_FREE],
            count: 0,
            tool: chain.tool,
            start: JointValues::zero(chain.count),
            rotaries: [0; 2],
            rotary_count: 0,
            pair: None,
        };
        let mut held: Option<Rigid> = None;
        for (i, screw) in chain.screws[..chain.count].iter().enumerate() {
            let moved = held.as_ref().map_or(*screw, |by| screw.moved(by));
            if locked.get(i).copied().unwrap_or(false) {
                let value = given.get(i).copied().unwrap_or(0.0);
                free.start[i] = value;
                let motion = moved.motion(value);
                held = Some(held.map_or(motion, |by| motion.after(&by)));
                continue;
            }
            let shifts = free.count - free.rotary_count;
            if screw.rotary && free.rotary_count == 2 || !screw.rotary && shifts == 3 {
                return Err(too_many(chain, locked));
            }
            if screw.rotary {
                free.rotaries[free.rotary_count] = free.count;
                free.rotary_count += 1;
            }
            free.screws[free.count] = moved;
            free.place[free.count] = i;
            free.count += 1;
        }
        match held {
            Some(by) => free.tool = by.after(&free.tool),
            None => free.pair = chain.pair.as_ref(),
        }
        Ok(free)
    }

    /// The free axes.
    pub(in super::super) fn screws(&self) -> &[Screw] {
        &self.screws[..self.count]
    }

    /// Places of the rotations among the free axes.
    pub(in super::super) fn rotaries(&self) -> &[usize] {
        &self.rotaries[..self.rotary_count]
    }

    /// The given position of a free axis.
    pub(in super::super) fn given(&self, k: usize, given: &[f64]) -> f64 {
        given.get(self.place[k]).copied().unwrap_or(0.0)
    }
}

fn too_many(chain: &Kinematics, locked: &[bool]) -> crate::base::Error {
    let held = |i: &usize| locked.get(*i).copied().unwrap_or(false);
    let free = (0..chain.count).filter(|i| !held(i));
    let rotaries = free.clone().filter(|&i| chain.screws[i].rotary).count();
    let shifts = free.count() - rotaries;
    Finding::error(
        Code::NO_CLOSED_FORM,
        format!("a pose does not determine {rotaries} rotary axes and {shifts} translations"),
    )
    .value((rotaries + shifts) as f64, "axes")
    .bound(MOST_FREE as f64, "axes: two rotary axes and three translations")
    .help("hold the other axes at given positions")
    .into()
}
