//! Moves between two stops, and their time.

use rayon::prelude::*;

use super::super::course::Stretch as Part;
use super::super::law::cells_of;
use super::super::{AxisLimit, Course, End, SCurve, TimeLaw, WithoutJerk};
use super::joint::{AXES, Joint};
use super::law::Law;
use super::level::level;
use super::motion::{Motion, Pace, RunMotion};
use super::ramp::Ramp;
use super::run::{Moving, Piece, Run};
use super::setting::{Setting, without_jerk};
use super::smoothed_joint::SmoothedJoint;
use super::straight::{Apart, along, axis_by_axis};
use crate::base::Result;
use crate::machine::Rapids;

/// Moves between two stops.
#[derive(Default)]
pub(super) struct Leg<'a> {
    pub(super) pieces: Vec<Piece<'a>>,
    /// Joints between them; `None` where nothing steps.
    pub(super) joints: Vec<Option<Joint>>,
    /// Distance by which the path may be left at each joint [mm].
    pub(super) allowed: Vec<f64>,
}

/// Task for the stretches that are not run evenly.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Task {
    /// Their cells are counted.
    Count,
    /// They are solved.
    Solve,
    /// They are solved without the limits of jerk: they are too many.
    SolveWithoutJerk,
}

/// Result for a leg.
#[derive(Default)]
pub(super) struct LegTime<'a> {
    /// Time of each move [s].
    pub(super) times: Vec<f64>,
    /// Time of all where jerk has no limit [s].
    pub(super) without_jerk: f64,
    /// Moves on which a limit of jerk does not count.
    pub(super) jerk_left_out: usize,
    /// Smoothed joints that are farthest off the programmed path.
    pub(super) farthest: Vec<SmoothedJoint>,
    /// Largest factor by which a stretch was slowed.
    pub(super) dilation: f64,
    /// Cells times axes, of [`Task::Count`].
    pub(super) cells: usize,
    /// Its motion, where that is kept.
    pub(super) motion: Option<Motion<'a>>,
    /// The laws of a run one after the other, where they are kept.
    paces: Vec<Pace>,
}

impl<'a> Leg<'a> {
    /// The time of its moves; `None` if an axis that moves has no limits.
    ///
    /// # Errors
    /// Those of [`TimeLaw::between`].
    pub(super) fn time(self, setting: &Setting, task: Task) -> Result<Option<LegTime<'a>>> {
        if let [piece] = &self.pieces[..]
            && let Some(rates) = piece.rates
        {
            return Ok(alone(piece, &rates, setting));
        }
        let count = self.pieces.len();
        let run = Run::new(self.pieces, self.joints, &self.allowed);
        let time = match run.moving()[..] {
            [] => Ok(Some(LegTime { times: vec![0.0; count], ..LegTime::default() })),
            [a] => law(&run, [a], setting, task),
            [a, b] => law(&run, [a, b], setting, task),
            [a, b, c] => law(&run, [a, b, c], setting, task),
            [a, b, c, d] => law(&run, [a, b, c, d], setting, task),
            [a, b, c, d, e] => law(&run, [a, b, c, d, e], setting, task),
            _ => law(&run, [0, 1, 2, 3, 4, 5], setting, task),
        };
        let Some(mut time) = time? else { return Ok(None) };
        time.farthest = run.farthest();
        if setting.keeps_motion && !time.paces.is_empty() {
            let paces = std::mem::take(&mut time.paces);
            time.motion = Some(Motion::Run(Box::new(RunMotion::new(run, paces))));
        }
        Ok(Some(time))
    }
}

/// The time of a straight move from rest to rest.
fn alone<'a>(piece: &Piece<'a>, rates: &[f64; AXES], setting: &Setting) -> Option<LegTime<'a>> {
    let unbound = |(rate, limit): (&f64, &Option<AxisLimit>)| *rate != 0.0 && limit.is_none();
    if rates.iter().zip(&setting.limits).any(unbound) {
        return None;
    }
    let length = piece.path.length();
    let apart = piece.feed.is_infinite() && setting.machine.rapids == Some(Rapids::AxisByAxis);
    let time = |limits: &[Option<AxisLimit>; AXES]| {
        if apart {
            axis_by_axis(rates, length, limits)
        } else {
            SCurve::new(length, along(rates, limits, piece.feed)).duration()
        }
    };
    let no_jerk = time(&without_jerk(&setting.limits));
    let motion = setting.keeps_motion.then(|| match apart {
        true => Motion::Apart {
            segment: piece.segment,
            from: piece.at(0.0).map(|jet| jet.q),
            axes: Box::new(Apart::new(&rates.map(|rate| rate * length), &setting.limits)),
        },
        false => Motion::Straight {
            piece: piece.clone(),
            curve: SCurve::new(length, along(rates, &setting.limits, piece.feed)),
        },
    });
    let times = vec![time(&setting.limits)];
    Some(LegTime { times, without_jerk: no_jerk, motion, ..LegTime::default() })
}

/// The time of a run over these axes.
fn law<'a, const A: usize>(
    run: &Run<'_>,
    axes: [usize; A],
    setting: &Setting,
    task: Task,
) -> Result<Option<LegTime<'a>>> {
    let mut limits = [AxisLimit { velocity: 0.0, acceleration: 0.0, jerk: 0.0 }; A];
    for (limit, axis) in limits.iter_mut().zip(axes) {
        match setting.limits[axis] {
            Some(given) => *limit = given,
            None => return Ok(None),
        }
    }
    let course = run.over(axes);
    let parts = parts(&course, &level(&course, &limits));
    if task == Task::Count {
        let cells: Result<Vec<usize>> = parts
            .par_iter()
            .filter(|part| part.is_uneven() && run.straight(part.uneven).is_none())
            .map(|part| cells_of(&Part::new(&course, part.uneven), &limits, part.ends))
            .collect();
        let cells = A * cells?.iter().sum::<usize>();
        return Ok(Some(LegTime { cells, times: vec![0.0; run.starts().len() - 1], ..LegTime::default() }));
    }
    let laws = laws(run, &course, &limits, &parts, setting, task)?;
    if arrive(&course, &parts, &laws) {
        return Ok(Some(put_together(&course, &limits, &parts, laws, setting.keeps_motion)));
    }
    // A run that does not get to its feed where it should go on evenly: all of it is solved.
    let whole = self::parts(&course, &[]);
    let laws = self::laws(run, &course, &limits, &whole, setting, task)?;
    Ok(Some(put_together(&course, &limits, &whole, laws, setting.keeps_motion)))
}

/// A stretch that is to be solved, and the level one behind it [mm].
struct Parts {
    uneven: [f64; 2],
    ends: [End; 2],
    /// End of the level stretch behind the uneven one; without a level stretch, the end of the uneven one [mm].
    level_to: f64,
}

impl Parts {
    fn is_uneven(&self) -> bool {
        self.uneven[1] > self.uneven[0]
    }
}

/// The stretches of a course between these level ones.
fn parts<const A: usize>(course: &Moving<A>, levels: &[[f64; 2]]) -> Vec<Parts> {
    let end = course.length();
    let mut from = 0.0;
    let mut parts = Vec::with_capacity(levels.len() + 1);
    for [to, level_to] in levels.iter().copied().chain([[end, end]]) {
        let state = |is_stop: bool| if is_stop { End::Rest } else { End::Even };
        parts.push(Parts { uneven: [from, to], ends: [state(from == 0.0), state(to == end)], level_to });
        from = level_to;
    }
    parts
}

/// The law of each uneven stretch.
fn laws<const A: usize>(
    run: &Run,
    course: &Moving<A>,
    limits: &[AxisLimit; A],
    parts: &[Parts],
    setting: &Setting,
    task: Task,
) -> Result<Vec<Option<Law>>> {
    let with_jerk = task == Task::Solve && limits.iter().all(|limit| limit.jerk.is_finite());
    let solve = |part: &Parts| -> Result<Option<Law>> {
        let [from, to] = part.uneven;
        if !part.is_uneven() {
            return Ok(None);
        }
        if part.ends.contains(&End::Rest)
            && let Some(rates) = run.straight(part.uneven)
        {
            let feed = course.feed(0.5 * (from + to));
            let ramp =
                Ramp::new(to - from, part.ends, |limits| along(&rates, &limits, feed), &setting.limits);
            return Ok(Some(Law::Straight(ramp)));
        }
        let stretch = Part::new(course, part.uneven);
        Ok(Some(if with_jerk {
            Law::Limited(Box::new(TimeLaw::between(&stretch, limits, part.ends, setting.progress)?))
        } else {
            Law::WithoutJerk(WithoutJerk::within(&stretch, limits, part.ends)?)
        }))
    };
    parts.par_iter().with_max_len(1).map(solve).collect()
}

/// True if each law has the feed where a level stretch follows or went before.
fn arrive<const A: usize>(course: &Moving<A>, parts: &[Parts], laws: &[Option<Law>]) -> bool {
    /// Rest of the speed that the solver leaves.
    const REST: f64 = 1e-4;
    parts.iter().zip(laws).all(|(part, law)| {
        let Some(law) = law else { return true };
        let arrives = |e: usize| {
            // As it was found: the whole run is slowed by the same factor.
            let rate = law.ends()[e] * law.dilations()[1];
            part.ends[e] == End::Rest || rate >= (1.0 - REST) * course.feed(part.uneven[e])
        };
        arrives(0) && arrives(1)
    })
}

/// The times of all moves of a run. All of it is slowed as the stretch whose ends are slowed most: its speed has no steps.
fn put_together<'a, const A: usize>(
    course: &Moving<A>,
    limits: &[AxisLimit; A],
    parts: &[Parts],
    laws: Vec<Option<Law>>,
    keeps: bool,
) -> LegTime<'a> {
    let starts = course.run().starts();
    let most = |i: usize| laws.iter().flatten().map(|law| law.dilations()[i]).fold(1.0, f64::max);
    let slower_all = most(1);
    let mut time = LegTime { dilation: most(0), ..LegTime::default() };
    let mut ends = starts[1..].iter().copied().peekable();
    let mut moments = Vec::with_capacity(starts.len() - 1);
    let mut clock = 0.0;
    for (part, law) in parts.iter().zip(laws) {
        let [from, to] = part.uneven;
        if let Some(law) = law {
            if matches!(law, Law::WithoutJerk(_)) && limits.iter().any(|limit| limit.jerk.is_finite()) {
                let before = starts.partition_point(|s| *s <= from);
                time.jerk_left_out += starts.partition_point(|s| *s < to) - before + 1;
            }
            let slower = slower_all / law.dilations()[1];
            while let Some(s) = ends.next_if(|s| *s <= to) {
                moments.push(clock + slower * law.moment(s - from));
            }
            clock += slower * law.duration();
            time.without_jerk += law.without_jerk();
            if keeps {
                time.paces.push(Pace::of_law(from, law, slower));
            }
        }
        if part.level_to > to {
            let feed = course.feed(0.5 * (to + part.level_to)) / slower_all;
            while let Some(s) = ends.next_if(|s| *s <= part.level_to) {
                moments.push(clock + (s - to) / feed);
            }
            let even = (part.level_to - to) / feed;
            clock += even;
            time.without_jerk += even / slower_all;
            if keeps {
                time.paces.push(Pace::even([to, part.level_to], feed));
            }
        }
    }
    let mut before = 0.0;
    time.times = moments
        .into_iter()
        .map(|moment| {
            let own = moment - before;
            before = moment;
            own
        })
        .collect();
    time
}
