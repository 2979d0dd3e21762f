//! Motion of the axes over time, of moves that were solved.

use super::super::{Moment, SCurve};
use super::joint::AXES;
use super::junction::{Chords, OnChord};
use super::law::Law;
use super::linuxcnc::{OnElements, Planned};
use super::run::{Piece, Run};
use super::straight::Apart;
use super::swing::around_ends;
use crate::trace::AxisJet;

/// Motion of one axis at a moment: mm and s, of rotary axes rad and s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisMoment {
    /// Position [mm, rad].
    pub position: f64,
    /// Velocity.
    pub velocity: f64,
    /// Acceleration.
    pub acceleration: f64,
    /// Jerk.
    pub jerk: f64,
}

/// All axes at a moment.
#[derive(Clone, Copy)]
pub(super) struct AllAxes {
    /// Index of the segment.
    pub(super) segment: usize,
    /// Speed of the tip along the programmed path [mm/s].
    pub(super) feed: f64,
    pub(super) axes: [AxisMoment; AXES],
}

/// Motion between two stops.
pub(super) enum Motion<'a> {
    /// A straight move, its axes together.
    Straight { piece: Piece<'a>, curve: SCurve },
    /// Axes that run for themselves from these positions.
    Apart { segment: usize, from: [f64; AXES], axes: Box<Apart> },
    /// Moves without a stop.
    Run(Box<RunMotion<'a>>),
    /// The same by chords.
    Chords(Chords),
    /// The same as LinuxCNC plans it.
    LinuxCnc(Planned<'a>),
}

impl<'a> Motion<'a> {
    /// The turn on the spot at the start (0) or at the end (1) of a move, if an axis makes one.
    pub(super) fn swing(piece: &Piece<'a>, end: usize, limits: &Limits) -> Option<Motion<'a>> {
        if !piece.turned[end] {
            return None;
        }
        let [from, to] = around_ends(&piece.path)[end];
        let ways = std::array::from_fn(|a| to[a] - from[a]);
        Some(Motion::Apart { segment: piece.segment, from, axes: Box::new(Apart::new(&ways, limits)) })
    }

    /// Time [s].
    pub(super) fn duration(&self) -> f64 {
        match self {
            Motion::Straight { curve, .. } => curve.duration(),
            Motion::Apart { axes, .. } => axes.duration(),
            Motion::Run(run) => run.duration,
            Motion::Chords(chords) => chords.duration(),
            Motion::LinuxCnc(planned) => planned.duration(),
        }
    }

    /// The axes at a moment after the start [s]; `None` where nothing moves.
    pub(super) fn at(&self, time: f64) -> Option<AllAxes> {
        match self {
            Motion::Straight { piece, curve } => {
                let at = curve.at(time);
                Some(along((piece.segment, piece.stands), &piece.at(at.way), at))
            }
            Motion::Apart { segment, from, axes } => {
                let moments = axes.at(time);
                let axes = std::array::from_fn(|a| {
                    let Moment { way, velocity, acceleration, jerk } = moments[a];
                    AxisMoment { position: from[a] + way, velocity, acceleration, jerk }
                });
                // On straight ways of axes square to one another the tip is as fast as they are together.
                let feed = moments[..3].iter().map(|m| m.velocity * m.velocity).sum::<f64>().sqrt();
                Some(AllAxes { segment: *segment, feed, axes })
            }
            Motion::Run(run) => run.at(time),
            Motion::Chords(chords) => {
                let OnChord { of, at, axes } = chords.at(time)?;
                Some(along(of, &axes.map(|[q, d1]| AxisJet { q, d1, d2: 0.0, d3: 0.0 }), at))
            }
            Motion::LinuxCnc(planned) => {
                let OnElements { of, this, next } = planned.at(time)?;
                let all = along(of, &this.axes, this.at);
                let Some(next) = next else { return Some(all) };
                let added = along(of, &next.axes, next.at);
                let axes: [AxisMoment; AXES] = std::array::from_fn(|a| AxisMoment {
                    position: all.axes[a].position + added.axes[a].position - next.from[a],
                    velocity: all.axes[a].velocity + added.axes[a].velocity,
                    acceleration: all.axes[a].acceleration + added.axes[a].acceleration,
                    jerk: 0.0,
                });
                let feed = axes[..3].iter().map(|axis| axis.velocity * axis.velocity).sum::<f64>().sqrt();
                Some(AllAxes { feed, axes, ..all })
            }
        }
    }
}

type Limits = [Option<super::super::AxisLimit>; AXES];

/// Axes along the path of a segment whose parameter moves so; second: whether the tip stands there.
fn along((segment, stands): (usize, bool), jets: &[AxisJet; AXES], at: Moment) -> AllAxes {
    let Moment { velocity: v, acceleration: a, jerk: j, .. } = at;
    // A cusp is left from rest, where its endless curvature is none of the motion yet.
    let bent = |derivative: f64| if v == 0.0 { 0.0 } else { derivative };
    let axes = jets.map(|jet| {
        let [d2, d3] = [jet.d2, jet.d3].map(bent);
        AxisMoment {
            position: jet.q,
            velocity: jet.d1 * v,
            acceleration: d2 * v * v + jet.d1 * a,
            jerk: d3 * v * v * v + 3.0 * d2 * v * a + jet.d1 * j,
        }
    });
    AllAxes { segment, feed: if stands { 0.0 } else { v }, axes }
}

/// A law, or an even way, from a place of a run on.
pub(super) struct Pace {
    /// Place [mm].
    from: f64,
    /// Moment [s] after the start of the run.
    start: f64,
    duration: f64,
    /// The law with the factor by which it is slower here; none where the way is run at the feed.
    law: Option<(Law, f64)>,
    /// The feed [mm/s].
    feed: f64,
}

impl Pace {
    /// A law from a place on [mm], `slower` times as slow.
    pub(super) fn of_law(from: f64, law: Law, slower: f64) -> Pace {
        Pace { from, start: 0.0, duration: slower * law.duration(), law: Some((law, slower)), feed: 0.0 }
    }

    /// An even way between two places [mm] at a feed [mm/s].
    pub(super) fn even([from, to]: [f64; 2], feed: f64) -> Pace {
        Pace { from, start: 0.0, duration: (to - from) / feed, law: None, feed }
    }

    /// Motion of the parameter of the run at a moment after its start [s].
    fn at(&self, time: f64) -> Moment {
        let time = time - self.start;
        let even = || Moment { way: self.feed * time, velocity: self.feed, acceleration: 0.0, jerk: 0.0 };
        let at = self.law.as_ref().map_or_else(even, |(law, slower)| law.at(time / slower).slower(*slower));
        Moment { way: self.from + at.way, ..at }
    }
}

/// Motion of a run: its paces one after the other.
pub(super) struct RunMotion<'a> {
    run: Run<'a>,
    paces: Vec<Pace>,
    duration: f64,
}

impl<'a> RunMotion<'a> {
    pub(super) fn new(run: Run<'a>, mut paces: Vec<Pace>) -> RunMotion<'a> {
        let mut duration = 0.0;
        for pace in &mut paces {
            pace.start = duration;
            duration += pace.duration;
        }
        RunMotion { run, paces, duration }
    }

    fn at(&self, time: f64) -> Option<AllAxes> {
        let k = self.paces.partition_point(|pace| pace.start <= time).max(1) - 1;
        let at = self.paces.get(k)?.at(time);
        let (piece, jets) = self.run.at(at.way);
        Some(along((piece.segment, piece.stands), &jets, at))
    }
}
