//! SetupPlan threads: their moves, and what they say of themselves.

use std::sync::Arc;

use glam::DVec3;

use super::core::core;
use super::json::ThreadsJson;
use super::section::section;
use super::{TapOperation, prove};
use crate::base::{Code, Finding, Result};
use crate::geom::Line;
use crate::nc::Control;
use crate::operations::core_hole::Core;
use crate::operations::kind::{self, Attempt};
use crate::operations::measured::Proof;
use crate::operations::places::HolePlace;
use crate::operations::{Found, Judged, Pen, PostedPlan, Probes, Setting, Shown, Tally};
use crate::page::Section;
use crate::program::{Cycle, Origin, Role, Speed, Spindle, Tapping};

/// SetupPlan threads.
#[derive(Clone, Debug)]
pub struct PlannedTapping {
    /// The operation.
    pub of: Arc<TapOperation>,
    /// The threads, in the order of tapping.
    pub threads: Vec<PlannedThread>,
    /// Height of the moves between holes, in coordinates of the work offset [mm].
    pub clearance: f64,
}

/// A planned thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedThread {
    /// X and Y, in coordinates of the work offset [mm].
    pub at: [f64; 2],
    /// Its core hole.
    pub core: Core,
    /// The item of the program that cuts it.
    pub item: u32,
}

/// Plans the threads.
///
/// # Errors
/// That of the first hole which the tap does not fit.
pub(super) fn planned(of: &Arc<TapOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedTapping>> {
    let clearance = of.table.clearance.unwrap_or(setting.clamping.safe_height);
    if of.reference() > clearance {
        let what = "the moves between holes run below the start of a thread";
        let finding = Finding::error(Code::JOB_VALUE, what).value_mm(clearance).bound_mm(of.reference());
        return Err(finding
            .help("raise `clearance`, or the safe height of the setup")
            .key("clearance")
            .into());
    }
    let there = setting.holes();
    let (mut threads, mut findings) = (Vec::with_capacity(of.holes.len()), Vec::new());
    for (i, &HolePlace { at }) in of.holes.iter().enumerate() {
        let key = if of.table.points.is_some() { format!("points[{i}]") } else { "pattern".to_owned() };
        let (core, doubt) = core(of, at, &there).map_err(|e| e.under(&key))?;
        // Holes alike have one doubt.
        if findings.is_empty() {
            findings.extend(doubt.map(|f| f.key(key)));
        }
        threads.push(PlannedThread { at, core, item: 0 });
    }
    Ok(Attempt::SetupPlan(PlannedTapping { of: Arc::clone(of), threads, clearance }, findings))
}

impl PlannedTapping {
    /// Feed [mm/s]: pitch times speed.
    pub fn feed(&self) -> f64 {
        self.of.tap.pitch * self.of.milling.spindle / std::f64::consts::TAU
    }

    /// Time of one thread, in and out [s].
    pub fn time(&self) -> f64 {
        2.0 * (self.of.reference() - self.of.bottom()) / self.feed()
    }

    /// The cycle of each thread, in coordinates of the work offset.
    pub fn tapping(&self) -> Tapping {
        let of = &self.of;
        Tapping {
            reference: of.reference(),
            bottom: of.bottom(),
            retract: self.clearance,
            pitch: of.tap.pitch,
            hand: of.hand(),
        }
    }
}

impl kind::Plan for PlannedTapping {
    type Json = ThreadsJson;

    const LIST: &'static str = "threads";

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        if pen.setting.post.control == Control::LinuxCnc {
            pen.text("G33.1 NEEDS AN ENCODER ON THE SPINDLE, AND RUNS ON BELOW Z UNTIL IT HAS REVERSED");
        }
        let cycle = Cycle::Tap(self.tapping());
        for (i, thread) in self.threads.iter_mut().enumerate() {
            let [x, y] = thread.at;
            let mut rapid = |z: f64| {
                let end = DVec3::new(x, y, z);
                pen.along(&Line { start: end, end }.into(), Speed::Rapid { linear: true }, Role::Link);
            };
            // From the tool change the height is not known: first over the place, then down.
            rapid(if i == 0 { f64::NAN } else { self.clearance });
            if i == 0 {
                rapid(self.clearance);
                pen.state.coolant = self.of.milling.coolant;
            }
            thread.item = pen.program.items.len() as u32;
            pen.state.speed = Speed::PerRevolution(self.of.tap.pitch);
            pen.program.push_cycle(cycle, pen.state, Origin { role: Role::Finish, ..pen.origin })?;
        }
        // Whether the spindle turns after a thread is the control's: it is switched off.
        pen.state.spindle = Spindle::Off;
        Ok(())
    }

    /// The lead of the tap runs out of a hole that is open below.
    fn breakthrough(&self) -> f64 {
        if self.threads.iter().any(|t| t.core.through) { self.of.tap.below_thread() } else { 0.0 }
    }

    fn probes(&self, posted: &PostedPlan<'_>, most: usize) -> Probes {
        Probes { points: self.probes_of(posted, most), walls: None }
    }

    fn judge(&mut self, _name: &str, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        self.judged(posted, found)
    }

    fn sum_up(tallies: &[Tally], step: f64) -> (Option<Proof>, Option<String>) {
        prove::sum_up(tallies, step)
    }

    fn sections(all: &[(&PlannedTapping, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(plan, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<ThreadsJson> {
        Some(ThreadsJson::new(self, shown.number))
    }
}
