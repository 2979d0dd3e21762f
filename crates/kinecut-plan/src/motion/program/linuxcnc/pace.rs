//! Speeds of the elements over time: ramps at their accelerations, and even ways between them.
//!
//! Source: LinuxCNC 2.10, `src/emc/tp/tp.c`, at `tpCalculateTrapezoidalAccel`, `tpCalculateRampAccel` and
//! `tpDoParabolicBlending`. The planner steps by cycles; here ramps are continuous, and each stop lasts until the next cycle.

use super::CYCLE;
use super::corner::overlap_speeds;
use super::element::{Element, Passage};
use crate::motion::Moment;

/// Time under which a move between two others is one even ramp [s].
const RAMP: f64 = 0.01;

/// A stretch of even acceleration.
#[derive(Clone, Copy, Debug)]
struct Phase {
    duration: f64,
    /// Place, speed and acceleration at its start.
    way: f64,
    speed: f64,
    acceleration: f64,
}

/// Motion along one element.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    /// Moments of its start and of its end, the stop behind it included [s].
    pub(super) start: f64,
    pub(super) end: f64,
    phases: Vec<Phase>,
    length: f64,
}

impl Pace {
    /// Motion along it at a moment [s].
    pub(super) fn at(&self, moment: f64) -> Moment {
        let mut time = moment - self.start;
        for phase in &self.phases {
            if time < phase.duration {
                let Phase { way, speed, acceleration, .. } = *phase;
                return Moment {
                    way: way + time * (speed + 0.5 * acceleration * time),
                    velocity: speed + acceleration * time,
                    acceleration,
                    jerk: 0.0,
                };
            }
            time -= phase.duration;
        }
        Moment { way: self.length, velocity: 0.0, acceleration: 0.0, jerk: 0.0 }
    }
}

/// An element that is run, as far as it has come.
struct Runner {
    pace: Pace,
    way: f64,
    speed: f64,
}

impl Runner {
    fn new(start: f64, length: f64) -> Runner {
        Runner { pace: Pace { start, end: start, phases: Vec::new(), length }, way: 0.0, speed: 0.0 }
    }

    /// Goes on for a time [s].
    fn run(&mut self, duration: f64, acceleration: f64) {
        if duration > 0.0 {
            let (way, speed) = (self.way, self.speed);
            self.pace.phases.push(Phase { duration, way, speed, acceleration });
            self.way += duration * (speed + 0.5 * acceleration * duration);
            self.speed += acceleration * duration;
            self.pace.end += duration;
        }
    }

    /// Changes its speed.
    fn change(&mut self, speed: f64, acceleration: f64) {
        let step = speed - self.speed;
        self.run(step.abs() / acceleration, step.signum() * acceleration);
        self.speed = speed;
    }

    /// Goes on evenly up to a place.
    fn go(&mut self, to: f64) {
        if self.speed > 0.0 {
            self.run((to - self.way) / self.speed, 0.0);
        }
    }
}

/// Runs over the elements.
pub(super) fn run(elements: &[Element]) -> Vec<Pace> {
    let mut paces: Vec<Pace> = Vec::with_capacity(elements.len());
    let mut runner = Runner::new(0.0, elements.first().map_or(0.0, |e| e.length));
    for (k, e) in elements.iter().enumerate() {
        let next = elements.get(k + 1);
        let passes = if next.is_some() { e.end } else { Passage::Stop };
        let target = e.target();
        let last = match next {
            Some(next) if passes == Passage::Tangent => e.last_speed.min(target).min(next.target()),
            _ => 0.0,
        };
        let a = e.alone();
        let left = (e.length - runner.way).max(f64::MIN_POSITIVE);
        let v = runner.speed;
        let hurried = 2.0 * left / (v + e.last_speed.min(target)) < RAMP;
        if hurried && !e.is_rapid && last > 0.0 {
            let wanted = ((last * last - v * v) / (2.0 * left)).clamp(-a, a);
            let end = (v * v + 2.0 * wanted * left).max(0.0).sqrt();
            runner.run(2.0 * left / (v + end), wanted);
            runner.speed = end;
        } else {
            ramps(&mut runner, e, [target, last, a], next.filter(|_| passes == Passage::Overlap));
        }
        let mut following = Runner::new(runner.pace.end, next.map_or(0.0, |next| next.length));
        match (passes, next) {
            (Passage::Tangent, _) => following.speed = runner.speed,
            (Passage::Overlap, Some(next)) => following = overlap(&mut runner, a, next),
            _ => {
                // The next one begins with a cycle.
                runner.pace.end = (runner.pace.end / CYCLE - 1e-6).ceil() * CYCLE;
                following.pace.start = runner.pace.end;
                following.pace.end = runner.pace.end;
            }
        }
        paces.push(std::mem::replace(&mut runner, following).pace);
    }
    paces
}

/// Up to the largest speed, on evenly, and down; where `next` overlaps, down to the speed at which that begins.
fn ramps(runner: &mut Runner, e: &Element, [target, last, a]: [f64; 3], next: Option<&Element>) {
    let (v, left) = (runner.speed, (e.length - runner.way).max(0.0));
    let least = last.min((v * v + 2.0 * a * left).sqrt());
    if v * v - least * least > 2.0 * a * left {
        // It cannot get slow enough.
        let end = (v * v - 2.0 * a * left).max(0.0).sqrt();
        runner.run(2.0 * left / (v + end), -a);
        runner.speed = end;
        return;
    }
    let peak = (0.5 * (v * v + least * least) + a * left).sqrt().min(target.max(least));
    runner.change(peak, a);
    let begin = next.map_or(least, |next| overlap_speeds(e, next)[0].min(peak));
    runner.go(e.length - (peak * peak - least * least) / (2.0 * a));
    runner.change(begin, a);
}

/// Ends an element that slows down with half of its acceleration `a`, while the next one speeds up with half of its own.
fn overlap(runner: &mut Runner, a: f64, next: &Element) -> Runner {
    let mut following = Runner::new(runner.pace.end, next.length);
    let (begin, left) = (runner.speed, runner.pace.length - runner.way);
    let end = (begin * begin - a * left).max(0.0).sqrt();
    let duration = 2.0 * left / (begin + end).max(f64::MIN_POSITIVE);
    runner.run(duration, -0.5 * a);
    let half = 0.5 * next.alone();
    let up = duration.min(next.target() / half);
    following.run(up, half);
    following.run(duration - up, 0.0);
    following
}
