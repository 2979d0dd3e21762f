//! Threads to be milled in the planner's words.

use glam::DVec2;

use super::{Flank, MillProfile, Thread, ThreadCutter, ThreadSide, ThreadTravel};
use crate::holes::{Sense, Wear};

/// Milling of threads of one size [mm, mm/s, rad].
#[derive(Clone, Debug, PartialEq)]
pub struct ThreadMillSpec {
    /// The thread.
    pub thread: Thread,
    /// Added to its diameters: half of its tolerance, for one in its middle.
    pub oversize: f64,
    /// In holes or on bosses.
    pub side: ThreadSide,
    /// The cutter.
    pub cutter: ThreadCutter,
    /// Whether the spindle turns counter-clockwise.
    pub left_hand: bool,
    /// Climb or conventional.
    pub sense: Sense,
    /// Height at which the thread begins.
    pub top: f64,
    /// Depth of full thread below it.
    pub depth: f64,
    /// Radial passes as shares of the thread's depth; the last is 1.
    pub infeed: Vec<f64>,
    /// Further passes at full depth.
    pub spring_passes: u32,
    /// Feed of the edge at the major diameter: in a hole of the crests in each pass.
    pub feed: f64,
    /// Wear register of the last passes.
    pub wear: Option<Wear>,
    /// The axes of the threads.
    pub places: Vec<DVec2>,
    /// Height of the moves between them.
    pub retract_z: f64,
    /// Height at which rapids down end over the material.
    pub approach_z: f64,
}

impl ThreadMillSpec {
    /// One thread at the origin with usual values: climb, one pass, no wear register.
    pub fn new(thread: Thread, depth: f64, cutter: ThreadCutter, feed: f64) -> ThreadMillSpec {
        ThreadMillSpec {
            thread,
            oversize: 0.0,
            side: ThreadSide::Inside,
            cutter,
            left_hand: false,
            sense: Sense::Climb,
            top: 0.0,
            depth,
            infeed: vec![1.0],
            spring_passes: 0,
            feed,
            wear: None,
            places: vec![DVec2::ZERO],
            retract_z: 20.0,
            approach_z: 2.0,
        }
    }

    /// The way in which the helix is run.
    pub fn travel(&self) -> ThreadTravel {
        ThreadTravel::of(self.side, self.thread.hand, self.sense, self.left_hand)
    }

    /// Radius of the pitch line at a depth below the mouth.
    pub fn pitch_radius(&self, depth: f64) -> f64 {
        0.5 * (self.thread.pitch_diameter() + self.oversize) + self.thread.widening(self.side, depth)
    }

    /// Radius of the tool at its pitch line.
    pub fn tool_radius(&self) -> f64 {
        0.5 * self.cutter.mill.diameter - self.thread.crest_height(self.side)
    }

    /// Radius of the path of the tool's centre at a depth as the sections say, without a correction.
    pub fn nominal_radius(&self, depth: f64) -> f64 {
        match self.side {
            ThreadSide::Inside => self.pitch_radius(depth) - self.tool_radius(),
            ThreadSide::Outside => self.pitch_radius(depth) + self.tool_radius(),
        }
    }

    /// The flanks of the thread.
    pub fn flank(&self) -> Flank {
        Flank::new(self.thread.pitch, self.thread.form.half_angle())
    }

    /// Radius of the path at a depth, at which the pitch diameter comes out; `None` where the helix is too steep.
    pub fn centre_radius(&self, depth: f64) -> Option<f64> {
        let wanted = self.pitch_radius(depth);
        let radius = match self.cutter.profile {
            MillProfile::Standard => self.flank().centre_radius(self.side, wanted, self.tool_radius())?,
            MillProfile::Corrected => self.nominal_radius(depth),
        };
        (radius > 0.0).then_some(radius)
    }

    /// Share of the feed at the edge that the centre runs at by the nominal diameters: without a correction, at full depth.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::*;
    /// use kinecut::tool::ThreadMill;
    /// let mill = ThreadMill { diameter: 12.0, pitch: 2.5, rows: 1, half_angle: 30f64.to_radians(), neck: None };
    /// let cutter = ThreadCutter { mill, profile: MillProfile::Standard, flute_length: 25.0, shank_diameter: 8.0, stickout: 40.0 };
    /// let spec = ThreadMillSpec::new(Thread::new(ThreadForm::Metric, 20.0, 2.5), 20.0, cutter, 10.0);
    /// assert!((spec.feed_share() - 0.4).abs() < 1e-12);
    /// ```
    pub fn feed_share(&self) -> f64 {
        let (major, cutter) = (self.thread.diameter, self.cutter.mill.diameter);
        match self.side {
            ThreadSide::Inside => (major - cutter) / major,
            ThreadSide::Outside => (major + cutter) / major,
        }
    }

    /// Feed of the tool's centre on a radius [mm] of the path [mm/s]: in a hole its crests run at [`ThreadMillSpec::feed`], about a boss
    /// the edge at the major diameter of the full depth does; less by the cosine of the slope.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::*;
    /// use kinecut::tool::ThreadMill;
    /// let mill = ThreadMill { diameter: 16.0, pitch: 2.5, rows: 1, half_angle: 30f64.to_radians(), neck: None };
    /// let cutter = ThreadCutter { mill, profile: MillProfile::Standard, flute_length: 25.0, shank_diameter: 8.0, stickout: 40.0 };
    /// let spec = ThreadMillSpec::new(Thread::new(ThreadForm::Metric, 20.0, 2.5), 20.0, cutter, 10.0);
    /// // A fifth, and a ninth on the half: cosines of 11.25 and 21.70 degrees.
    /// assert!((spec.feed_on(2.0) - 1.961559).abs() < 1e-6 && (spec.feed_on(1.0) - 1.032391).abs() < 1e-6);
    /// ```
    pub fn feed_on(&self, radius: f64) -> f64 {
        let share = match self.side {
            ThreadSide::Inside => radius / (radius + 0.5 * self.cutter.mill.diameter),
            ThreadSide::Outside => self.feed_share(),
        };
        self.feed * share * (self.thread.pitch / (std::f64::consts::TAU * radius)).atan().cos()
    }

    /// Turns of a helix: of one row as many as the thread has and a half, since a groove whose middle lies half a pitch over the
    /// mouth still opens below it; of more rows one and an eighth.
    pub(super) fn turns(&self) -> f64 {
        match self.cutter.mill.rows {
            1 => self.depth / self.thread.pitch + 0.5,
            _ => 1.125,
        }
    }

    /// Heights of the helices above the lowest, in pitches: of more rows each begins where the last row of the one before has cut,
    /// the last as high as is needed.
    pub(super) fn steps(&self) -> Vec<u32> {
        /// Pitches that are rounding.
        const ROUNDING: f64 = 1e-9;
        let rows = self.cutter.mill.rows;
        if rows <= 1 {
            return vec![0];
        }
        let missing = self.depth / self.thread.pitch - f64::from(rows - 1);
        let last = (missing - ROUNDING).ceil().clamp(0.0, f64::from(u32::MAX)) as u32;
        let mut steps: Vec<u32> = (0..last).step_by((rows - 1) as usize).collect();
        steps.push(last);
        steps
    }

    /// Height of the path's lowest point below the lowest middle of a tooth: the way in or out, on the slope.
    pub(super) fn lead_rise(&self, radius: f64) -> f64 {
        let pitch = self.thread.pitch;
        match self.side {
            ThreadSide::Inside => 0.25 * pitch,
            ThreadSide::Outside => 0.25 * pitch * self.lead_radius() / radius,
        }
    }

    /// Radius of the quarter circle on which a thread on a boss is joined and left: from clear of the boss.
    pub(super) fn lead_radius(&self) -> f64 {
        /// Way between tool and boss where it comes down [mm].
        const CLEAR: f64 = 2.0;
        self.thread.height(self.side) + self.thread.widening(self.side, self.depth).abs() + CLEAR
    }

    /// Height of the tool's lowest point.
    pub fn lowest(&self) -> f64 {
        let radius = self.centre_radius(self.depth).unwrap_or(f64::INFINITY);
        self.top - self.depth - 0.5 * self.cutter.mill.pitch - self.lead_rise(radius)
    }
}
