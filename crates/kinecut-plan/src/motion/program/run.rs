//! Moves that follow one another without a stop, as one course.

use super::super::Course;
use super::joint::{AXES, Joint};
use super::joints::Joints;
use super::smoothed_joint::SmoothedJoint;
use super::swing::BESIDE;
use crate::trace::{AxisJet, AxisPath};

/// A move of a run.
#[derive(Clone)]
pub(super) struct Piece<'a> {
    /// The axes over the parameter of the move.
    pub(super) path: AxisPath<'a>,
    /// Rate of the parameter at the programmed feed [mm/s]; infinite for a rapid.
    pub(super) feed: f64,
    /// Index of its segment in the trace, and of the program item of that.
    pub(super) segment: usize,
    pub(super) item: u32,
    /// Whether the tip stands: the parameter is then an angle.
    pub(super) stands: bool,
    /// Whether axes turn on the spot at its start and end.
    pub(super) turned: [bool; 2],
    /// First derivatives of the axes where they are constant.
    pub(super) rates: Option<[f64; AXES]>,
}

impl Piece<'_> {
    /// The axes at a place [mm], beside its ends where they turn on the spot there.
    pub(super) fn at(&self, s: f64) -> [AxisJet; AXES] {
        let length = self.path.length();
        let [start, end] = self.turned.map(|turned| if turned { BESIDE * length } else { 0.0 });
        self.path.at(s.clamp(start, length - end))
    }

    /// First three derivatives of all axes at a place [mm].
    pub(super) fn derivatives(&self, s: f64) -> [[f64; 3]; AXES] {
        match self.rates {
            Some(rates) => rates.map(|rate| [rate, 0.0, 0.0]),
            None => derivatives(&self.path, s),
        }
    }
}

/// A run from rest to rest.
pub(super) struct Run<'a> {
    pieces: Vec<Piece<'a>>,
    /// Start of each move, and the end of the last one [mm].
    starts: Vec<f64>,
    joints: Joints,
    /// Ends of moves and of smoothings that stand alone [mm].
    knots: Vec<f64>,
}

/// A run over the axes that move.
pub(super) struct Moving<'a, const A: usize> {
    run: &'a Run<'a>,
    axes: [usize; A],
}

/// First three derivatives of all axes at a place of a move [mm].
pub(super) fn derivatives(path: &AxisPath, s: f64) -> [[f64; 3]; AXES] {
    path.at(s).map(|jet| [jet.d1, jet.d2, jet.d3])
}

impl<'a> Run<'a> {
    /// The run over these moves; `joints`: of each end of a move but the last the smoothing, or nothing where nothing steps.
    ///
    /// Smoothings become shorter where they would reach over an end of the run, or leave the path by more than `tolerance`
    /// together.
    pub(super) fn new(pieces: Vec<Piece<'a>>, joints: Vec<Option<Joint>>, tolerance: &[f64]) -> Run<'a> {
        let mut starts = vec![0.0];
        for piece in &pieces {
            starts.push(starts[starts.len() - 1] + piece.path.length());
        }
        let length = starts[pieces.len()];
        let mut placed = Vec::new();
        let mut allowed = Vec::new();
        for ((joint, at), tolerance) in joints.iter().zip(&starts[1..]).zip(tolerance) {
            if let Some(joint) = joint {
                placed.push(Joint { at: *at, half: joint.half.min(*at).min(length - *at), ..*joint });
                allowed.push(*tolerance);
            }
        }
        let joints = Joints::within(placed, &allowed);
        let mut knots = starts[1..pieces.len()].to_vec();
        // A joint between longer smoothings is nothing that the speed has to follow.
        let mut last = 0.0;
        knots.retain(|at| {
            let kept = joints.alone(*at) || *at - last > joints.finest(*at);
            if kept {
                last = *at;
            }
            kept
        });
        knots.extend(joints.ends());
        knots.sort_by(f64::total_cmp);
        Run { pieces, starts, joints, knots }
    }

    /// The smoothed joints that are farthest off the programmed path.
    pub(super) fn farthest(&self) -> Vec<SmoothedJoint> {
        let joint = |joint: &Joint| SmoothedJoint {
            item: self.pieces[self.piece(joint.at)].item,
            off: self.joints.off(joint),
            corner: joint.step.corner(),
        };
        SmoothedJoint::farthest(self.joints.all().iter().map(joint).collect())
    }

    /// Start of each move, and the end of the last one [mm].
    pub(super) fn starts(&self) -> &[f64] {
        &self.starts
    }

    /// Places in the middle of the smoothings at both ends of a move, those outside of it left out [mm].
    pub(super) fn marks(&self, i: usize) -> [Option<f64>; 2] {
        let [from, to] = [self.starts[i], self.starts[i + 1]];
        let inside = |s: f64| (from < s && s < to).then_some(s);
        let half = |at: f64| self.joints.at(at).map(|joint| 0.5 * joint.half);
        [half(from).and_then(|h| inside(from + h)), half(to).and_then(|h| inside(to - h))]
    }

    /// First derivatives of the axes on a stretch [mm] on which they are constant; `None` on others.
    pub(super) fn straight(&self, [from, to]: [f64; 2]) -> Option<[f64; AXES]> {
        let (first, last) = (self.piece(from), self.piece(to));
        // A stretch of many moves is hardly ever straight.
        const MOST: usize = 4;
        if last - first > MOST || self.joints.covers([from, to]) {
            return None;
        }
        let mut all: Option<[f64; AXES]> = None;
        for piece in &self.pieces[first..=last] {
            let rates = piece.rates?;
            let before = *all.get_or_insert(rates);
            if rates.iter().zip(before).any(|(a, b)| (a - b).abs() > 1e-9)
                || piece.feed != self.pieces[first].feed
            {
                return None;
            }
        }
        all
    }

    fn piece(&self, s: f64) -> usize {
        self.starts.partition_point(|start| *start <= s).clamp(1, self.pieces.len()) - 1
    }

    /// The move at a place [mm], and the derivatives of the axes there on the smoothed path.
    fn derivatives(&self, s: f64) -> (&Piece<'a>, [[f64; 3]; AXES]) {
        let i = self.piece(s);
        let mut jets = self.pieces[i].derivatives(s - self.starts[i]);
        self.joints.about(s, |joint| joint.smooth(s, &mut jets));
        (&self.pieces[i], jets)
    }

    /// The move at a place [mm], and the axes there on the smoothed path.
    pub(super) fn at(&self, s: f64) -> (&Piece<'a>, [AxisJet; AXES]) {
        let i = self.piece(s);
        let jets = self.pieces[i].at(s - self.starts[i]);
        let mut places = jets.map(|jet| jet.q);
        let mut derivatives = jets.map(|jet| [jet.d1, jet.d2, jet.d3]);
        self.joints.about(s, |joint| {
            joint.shift(s, &mut places);
            joint.smooth(s, &mut derivatives);
        });
        let jet = |a: usize| {
            let [d1, d2, d3] = derivatives[a];
            AxisJet { q: places[a], d1, d2, d3 }
        };
        (&self.pieces[i], std::array::from_fn(jet))
    }

    /// Axes that move.
    pub(super) fn moving(&self) -> Vec<usize> {
        const NONE: f64 = 1e-12;
        let mut moves = [false; AXES];
        for piece in &self.pieces {
            for part in [0.0, 0.3, 0.5, 0.8, 1.0] {
                let jets = piece.derivatives(part * piece.path.length());
                for (moves, jet) in moves.iter_mut().zip(jets) {
                    *moves |= jet.iter().any(|d| d.abs() > NONE);
                }
            }
        }
        (0..AXES).filter(|a| moves[*a]).collect()
    }

    /// The run over these axes.
    pub(super) fn over<const A: usize>(&'a self, axes: [usize; A]) -> Moving<'a, A> {
        Moving { run: self, axes }
    }
}

impl<'a, const A: usize> Moving<'a, A> {
    /// All axes of the run.
    pub(super) fn run(&self) -> &'a Run<'a> {
        self.run
    }
}

impl<const A: usize> Course<A> for Moving<'_, A> {
    fn length(&self) -> f64 {
        self.run.starts[self.run.pieces.len()]
    }

    fn derivatives(&self, s: f64) -> [[f64; 3]; A] {
        let (_, all) = self.run.derivatives(s);
        self.axes.map(|a| all[a])
    }

    fn feed(&self, s: f64) -> f64 {
        self.run.pieces[self.run.piece(s)].feed
    }

    fn derivatives_and_feed(&self, s: f64) -> ([[f64; 3]; A], f64) {
        let (piece, all) = self.run.derivatives(s);
        (self.axes.map(|a| all[a]), piece.feed)
    }

    fn knots(&self) -> &[f64] {
        &self.run.knots
    }

    fn finest(&self, s: f64) -> f64 {
        self.run.joints.finest(s)
    }
}
