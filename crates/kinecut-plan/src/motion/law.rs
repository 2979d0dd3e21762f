//! The fastest run along a path, from rest to rest, under velocity, acceleration and jerk of each axis.

use super::reach::{WithoutJerk, without_jerk};
use super::shape::{Shape, places};
use super::shares::{CellShares, Shares, of_cells_at_last, of_run};
use super::start::Start;
use super::windows::coefficients;
use super::{AxisLimit, Course, End, Speed, grid};
use crate::base::{Code, Finding, Progress, Result, Silent};

/// The fastest run: feed, speed, acceleration and jerk of each axis hold at fifteen places of each cell; where they did not
/// to the last digit, the whole run was slowed ([`TimeLaw::dilation`]).
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

/// Times that the grid is made finer where limits are exceeded.
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

    /// The fastest speed on these knots, and the steps of the solver.
    fn solved<const A: usize, C: Course<A>>(
        &self,
        course: &C,
        limits: &[AxisLimit; A],
        progress: &dyn Progress,
    ) -> Result<(Speed, u32)> {
        let places = places(course, limits, &self.knots)?;
        let shape = Shape::new(&self.knots, self.length, &places, limits);
        let (coefficients, steps) = coefficients(course, limits, &shape, progress)?;
        Ok((Speed::new([0.0, self.length], &self.knots, &coefficients), steps))
    }

    /// Halves the cells in which a limit is exceeded between the knots: the shape changes inside of them. False where no cell
    /// is.
    fn refined(&mut self, found: &[CellShares]) -> bool {
        let mut knots = Vec::with_capacity(self.knots.len());
        for (pair, cell) in self.knots.windows(2).zip(found) {
            knots.push(pair[0]);
            if cell.all.dilation() > 1.0 + SLOWED {
                knots.push(0.5 * (pair[0] + pair[1]));
            }
        }
        knots.extend(self.knots.last());
        let is_finer = knots.len() > self.knots.len();
        self.knots = knots;
        is_finer
    }

    fn without_jerk<const A: usize, C: Course<A>>(
        &self,
        course: &C,
        limits: &[AxisLimit; A],
    ) -> Result<WithoutJerk> {
        let mut knots = [&[0.0][..], &self.knots, &[self.length]].concat();
        knots.dedup();
        without_jerk(course, limits, knots, self.ends)
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
        let law = Gridded::new(course, limits, ends)?.without_jerk(course, limits)?;
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
        let (mut speed, mut steps) = grid.solved(course, limits, progress)?;
        for _ in 0..REFINEMENTS {
            if !grid.refined(&of_cells_at_last(course, limits, &speed)) {
                break;
            }
            let (finer, more) = grid.solved(course, limits, progress)?;
            speed = finer;
            steps += more;
        }
        let without_jerk = grid.without_jerk(course, limits)?.duration();
        let mut dilation = of_run(course, limits, &speed).dilation();
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
