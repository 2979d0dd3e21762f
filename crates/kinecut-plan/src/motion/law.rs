//! The fastest run along a path, from rest to rest, under velocity, acceleration and jerk of each axis.

use super::easing::eased;
use super::reach::{Kept, WithoutJerk, without_jerk};
use super::shape::{Shape, places};
use super::shares::{CellShares, Shares, at_rests, of_all, of_cells, of_run};
use super::solution::{Precision, Solution};
use super::start::Start;
use super::windows::solution;
use super::{AxisLimit, Course, End, Speed, grid};
use crate::base::{Code, Finding, Progress, Result, Silent};

/// The fastest run: feed, speed, acceleration and jerk of each axis hold at fifteen places of each cell. Cells that exceeded
/// one by little are passed slower; for the last digits the whole run was slowed ([`TimeLaw::dilation`]).
///
/// The path is followed exactly. Which of its joints may be passed without a stop is the course's matter.
#[derive(Clone, Debug)]
pub struct TimeLaw {
    speed: Speed,
    without_jerk: f64,
    dilation: f64,
    at_ends: f64,
    steps: u32,
}

/// Times that the grid is made finer where a rough solution shows that the shape changes inside of cells.
const ROUGH_REFINEMENTS: u32 = 3;
/// Factor of time that such a cell asks for, less 1.
const ROUGHLY_SLOWED: f64 = 1e-3;
/// Times that the grid is made finer where limits are still exceeded.
const REFINEMENTS: u32 = 6;
/// Factor of time by which a run may be slowed rather than solved on a finer grid, less 1.
const SLOWED: f64 = 1e-4;

/// Ways from rest to the feed in which a run that is slowed inside gets to the speed of its ends.
const BESIDE: f64 = 1.0;

/// A course with its knots.
struct Gridded {
    length: f64,
    /// Shortest way from rest to the feed [mm].
    way: f64,
    ends: [End; 2],
    knots: Vec<f64>,
}

impl Gridded {
    fn new<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        ends: [End; 2],
    ) -> Result<Gridded> {
        let length = course.length();
        if !(length > 0.0 && length.is_finite()) {
            return Err(Finding::error(Code::PLAN_VALUE, "a path needs a length").value(length, "mm").into());
        }
        let start = Start::of(course, limits);
        if !(start.way > 0.0) {
            return Err(Finding::error(Code::PLAN_VALUE, "a path needs a feed").bound(0.0, "mm/s").into());
        }
        let knots = grid::knots(course, limits, start, ends)?;
        Ok(Gridded { length, way: start.way, ends, knots })
    }

    /// The fastest run on these knots, from an earlier one on them where there is one.
    fn solved<const A: usize, C: Course<A>>(
        &self,
        course: &C,
        limits: &[AxisLimit; A],
        precision: Precision,
        before: Option<Solution>,
        progress: &dyn Progress,
    ) -> Result<(Solution, Speed)> {
        let places = places(course, limits, &self.knots)?;
        let shape = Shape::new(&self.knots, self.length, &places, limits);
        let solution = solution(course, limits, &shape, precision, before, progress)?;
        let speed = Speed::new([0.0, self.length], &self.knots, &solution.coefficients);
        Ok((solution, speed))
    }

    /// Halves the cells that ask for a factor of time of more than 1 + `most`: the shape changes inside of them. The solution
    /// on the new cells, and whether there are any.
    fn refined(&mut self, solution: Solution, found: &[CellShares], most: f64) -> (Solution, bool) {
        let halved: Vec<bool> = found.iter().map(|cell| cell.all.dilation() > 1.0 + most).collect();
        if !halved.contains(&true) {
            return (solution, false);
        }
        let solution = solution.on_halved(&self.knots, &halved);
        let mut knots = Vec::with_capacity(self.knots.len());
        for (pair, is_halved) in self.knots.windows(2).zip(halved) {
            knots.push(pair[0]);
            if is_halved {
                knots.push(0.5 * (pair[0] + pair[1]));
            }
        }
        knots.extend(self.knots.last());
        self.knots = knots;
        (solution, true)
    }

    fn without_jerk<const A: usize, C: Course<A>>(
        &self,
        course: &C,
        limits: &[AxisLimit; A],
        kept: Kept,
    ) -> Result<WithoutJerk> {
        let mut knots = [&[0.0][..], &self.knots, &[self.length]].concat();
        knots.dedup();
        without_jerk(course, limits, knots, self.ends, kept)
    }
}

/// Cells that the law of a course would have.
///
/// # Errors
/// As [`TimeLaw::new`].
pub(super) fn cells_of<const A: usize, C: Course<A>>(
    course: &C,
    limits: &[AxisLimit; A],
    ends: [End; 2],
) -> Result<usize> {
    Ok(Gridded::new(course, limits, ends)?.knots.len() - 1)
}

impl WithoutJerk {
    /// The fastest run along a course from rest to rest where jerk has no limit.
    ///
    /// # Errors
    /// As [`TimeLaw::new`].
    pub fn new<const A: usize, C: Course<A>>(course: &C, limits: &[AxisLimit; A]) -> Result<WithoutJerk> {
        WithoutJerk::between(course, limits, [End::Rest; 2])
    }

    /// The same along a course that begins and ends like this.
    ///
    /// # Errors
    /// As [`TimeLaw::new`].
    pub fn between<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        ends: [End; 2],
    ) -> Result<WithoutJerk> {
        WithoutJerk::keeping(course, limits, ends, Kept::Middle)
    }

    /// The same for a control that makes this run: at both ends of each cell, too, no axis is beyond its limit.
    ///
    /// # Errors
    /// As [`TimeLaw::new`].
    pub(super) fn within<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        ends: [End; 2],
    ) -> Result<WithoutJerk> {
        WithoutJerk::keeping(course, limits, ends, Kept::Everywhere)
    }

    fn keeping<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        ends: [End; 2],
        kept: Kept,
    ) -> Result<WithoutJerk> {
        let law = Gridded::new(course, limits, ends)?.without_jerk(course, limits, kept)?;
        if !(law.duration() > 0.0 && law.duration().is_finite()) {
            return Err(Finding::error(Code::PLAN_VALUE, "no law was found for this path").into());
        }
        Ok(law)
    }
}

impl TimeLaw {
    /// The fastest run along a course from rest to rest; each jerk limit is finite.
    ///
    /// # Errors
    /// `KC0404` where the course cannot be run: it has no length, or a derivative or the feed is not finite.
    pub fn new<const A: usize, C: Course<A>>(course: &C, limits: &[AxisLimit; A]) -> Result<TimeLaw> {
        TimeLaw::between(course, limits, [End::Rest; 2], &Silent)
    }

    /// The fastest run along a course that begins and ends like this; `progress` may cancel it.
    ///
    /// # Errors
    /// As [`TimeLaw::new`]; `KC0009` when it was cancelled.
    pub fn between<const A: usize, C: Course<A>>(
        course: &C,
        limits: &[AxisLimit; A],
        ends: [End; 2],
        progress: &dyn Progress,
    ) -> Result<TimeLaw> {
        let mut grid = Gridded::new(course, limits, ends)?;
        let mut steps = 0;
        let mut before = None;
        for _ in 0..ROUGH_REFINEMENTS {
            let (solution, speed) = grid.solved(course, limits, Precision::Rough, before, progress)?;
            steps += solution.steps;
            let found = of_cells(course, limits, &speed, 0..speed.cells());
            let (solution, is_finer) = grid.refined(solution, &found, ROUGHLY_SLOWED);
            before = Some(solution);
            if !is_finer {
                break;
            }
        }
        let mut left = REFINEMENTS;
        let (mut speed, cells) = loop {
            let (solution, speed) = grid.solved(course, limits, Precision::Settled, before, progress)?;
            steps += solution.steps;
            let (speed, found) = eased(course, limits, speed, ends);
            let (solution, is_finer) = grid.refined(solution, &found, SLOWED);
            if left == 0 || !is_finer {
                break (speed, found);
            }
            left -= 1;
            before = Some(solution);
        };
        let without_jerk = grid.without_jerk(course, limits, Kept::Middle)?.duration();
        let mut dilation = at_rests(course, limits, &speed).max(of_all(&cells)).dilation();
        let mut at_ends = 1.0;
        if dilation > 1.0 && dilation.is_finite() {
            // Ends that are no rests keep their speed; in the rest of the limits that is left there it goes over.
            if ends.contains(&End::Even) {
                let way = (BESIDE * grid.way).min(0.5 * grid.length);
                speed = speed.slower_inside(dilation, ends, way);
                at_ends = of_run(course, limits, &speed).dilation();
                dilation *= at_ends;
            } else {
                at_ends = dilation;
            }
            if at_ends > 1.0 {
                speed = speed.slower(at_ends);
            }
        }
        if !(speed.duration().is_finite() && dilation.is_finite()) {
            return Err(Finding::error(Code::PLAN_VALUE, "no law was found for this path").into());
        }
        Ok(TimeLaw { speed, without_jerk, dilation, at_ends, steps })
    }

    /// Time from rest to rest [s].
    pub fn duration(&self) -> f64 {
        self.speed.duration()
    }

    /// Time of the fastest run without a limit of jerk [s]. No run that keeps the limits is faster but by the error of this
    /// number, which is computed on the same cells: of second order in their length.
    pub fn without_jerk(&self) -> f64 {
        self.without_jerk
    }

    /// The speed over the path.
    pub fn speed(&self) -> &Speed {
        &self.speed
    }

    /// Largest shares of the limits, looked at again.
    pub fn shares<const A: usize, C: Course<A>>(&self, course: &C, limits: &[AxisLimit; A]) -> Shares {
        of_run(course, limits, &self.speed)
    }

    /// Factor by which the run was slowed so that every limit holds: 1 where none was exceeded.
    pub fn dilation(&self) -> f64 {
        self.dilation
    }

    /// Factor by which the speed at the ends was slowed: 1 where the inside alone was.
    pub(super) fn dilation_at_ends(&self) -> f64 {
        self.at_ends
    }

    /// Steps of the solver.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// Cells of the law.
    pub fn cells(&self) -> usize {
        self.speed.knots().len() - 1
    }
}
