//! Counts over the grazing curves of many twists: pieces and folds of an element, whether all curves close, whether the
//! windings sum up to an odd number.

use glam::DVec3;

use crate::machine::Twist;
use crate::sweep::{Grazing, GrazingSpan, PieceKind, PieceShape, ProfileChain};

/// Form of the curve on a piece of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PieceOutcome {
    /// No curve.
    Nothing,
    /// Two branches that run through.
    Through,
    /// One curve that comes and goes on the same side.
    OneU,
    /// Two of those curves, one from each side.
    TwoU,
    /// One closed curve.
    Closed,
    /// All of it grazes: it slides along itself.
    Whole,
    /// None of these.
    Other,
}

impl PieceOutcome {
    /// All that a torus can have, in the order of the paper's list.
    pub const ALL: [PieceOutcome; 5] = [
        PieceOutcome::Nothing,
        PieceOutcome::Through,
        PieceOutcome::OneU,
        PieceOutcome::TwoU,
        PieceOutcome::Closed,
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            PieceOutcome::Nothing => "nothing",
            PieceOutcome::Through => "two through-branches",
            PieceOutcome::OneU => "one U",
            PieceOutcome::TwoU => "two U",
            PieceOutcome::Closed => "one closed loop",
            PieceOutcome::Whole => "all of it grazes",
            PieceOutcome::Other => "other",
        }
    }

    /// That of a piece.
    pub fn of(grazing: &Grazing, piece: usize) -> PieceOutcome {
        if grazing.whole.contains(&piece) {
            return PieceOutcome::Whole;
        }
        let spans: Vec<&GrazingSpan> = grazing.spans.iter().filter(|s| s.piece == piece).collect();
        match spans[..] {
            [] => PieceOutcome::Nothing,
            [one] => match one.folds {
                [false, false] => PieceOutcome::Through,
                [true, true] => PieceOutcome::Closed,
                _ => PieceOutcome::OneU,
            },
            [a, b] if a.folds == [false, true] && b.folds == [true, false] => PieceOutcome::TwoU,
            _ => PieceOutcome::Other,
        }
    }
}

/// Counts over many twists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Survey {
    /// Number of twists.
    pub twists: u32,
    /// Counts of each of [`PieceOutcome::ALL`] on the piece asked for, and last of none of them.
    pub outcomes: [u32; 6],
    /// Most spans on one piece.
    pub most_spans: usize,
    /// Most folds on one piece.
    pub most_folds: usize,
    /// Curves that do not close.
    pub open: u32,
    /// Twists with velocity along the axis whose windings have an even sum.
    pub even: u32,
    /// Most curves at one moment.
    pub most_loops: usize,
}

/// Counts over `twists` twists that are the same in every run; `piece` is the one whose outcomes are counted.
pub fn survey(chain: &ProfileChain, piece: usize, twists: u32) -> Survey {
    let mut found =
        Survey { twists, outcomes: [0; 6], most_spans: 0, most_folds: 0, open: 0, even: 0, most_loops: 0 };
    let mut source = Twists::new(chain.reach());
    let mut grazing = Grazing::none();
    for _ in 0..twists {
        let twist = source.next_twist();
        chain.grazing_into(&twist, &mut grazing);
        let outcome = PieceOutcome::of(&grazing, piece);
        let at = PieceOutcome::ALL.iter().position(|o| *o == outcome).unwrap_or(PieceOutcome::ALL.len());
        found.outcomes[at] += 1;
        for index in 0..chain.pieces().len() {
            let of = || grazing.spans.iter().filter(|s| s.piece == index);
            found.most_spans = found.most_spans.max(of().count());
            let folds = of().map(|s| s.folds.iter().filter(|f| **f).count()).sum();
            found.most_folds = found.most_folds.max(folds);
        }
        found.most_loops = found.most_loops.max(grazing.loops.len());
        found.open += grazing.loops.iter().filter(|l| !l.closed).count() as u32;
        let windings: u32 = grazing.loops.iter().map(|l| u32::from(l.winding)).sum();
        found.even += u32::from(twist.shift.z != 0.0 && windings.is_multiple_of(2));
    }
    found
}

/// The first of the same twists under which a piece has an outcome, in round numbers; none of `tries` has it: nothing.
pub(crate) fn twist_with(
    chain: &ProfileChain,
    piece: usize,
    outcome: PieceOutcome,
    tries: u32,
) -> Option<Twist> {
    let mut source = Twists::new(chain.reach());
    (0..tries).map(|_| source.next_twist()).find(|t| PieceOutcome::of(&chain.grazing(t), piece) == outcome)
}

/// The first piece of a tool that is an arc.
pub(crate) fn first_arc(chain: &ProfileChain) -> usize {
    let arc = |p: &crate::sweep::ChainPiece| {
        p.kind == PieceKind::Element && matches!(p.shape, PieceShape::Arc { .. })
    };
    chain.pieces().iter().position(arc).unwrap_or(0)
}

/// Twists from a linear congruence: velocities to 1 mm/s, and to the same at the reach of the tool from turning.
struct Twists {
    state: u64,
    reach: f64,
}

impl Twists {
    fn new(reach: f64) -> Twists {
        Twists { state: 2, reach: if reach > 0.0 { reach } else { 1.0 } }
    }

    /// From -1 to 1 in hundredths.
    fn hundredth(&mut self) -> f64 {
        // Knuth's MMIX generator; its high bits are the good ones.
        self.state =
            self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let upper = (self.state >> 40) as u32;
        f64::from(upper % 201) / 100.0 - 1.0
    }

    fn next_twist(&mut self) -> Twist {
        let [vx, vy, vz, wx, wy] = std::array::from_fn(|_| self.hundredth());
        let lever = 2.0 / self.reach;
        Twist { shift: DVec3::new(vx, vy, vz), turn: DVec3::new(wx * lever, wy * lever, 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::base::MemoryLoader;
    use crate::verbs::grazing::{GrazingTable, grazing_sheet};

    #[test]
    fn a_piece_that_slides_along_itself_is_not_one_without_a_curve() {
        let question = json!({
            "tool": { "shape": { "end-mill": { "diameter": 10, "flute_length": 20 } } },
            "twist": { "velocity": [600, 0, 0] },
        });
        let table: GrazingTable = serde_json::from_value(question).unwrap();
        let sheet = grazing_sheet(&table, &MemoryLoader::default()).unwrap();
        let json: Value = serde_json::to_value(&sheet).unwrap();
        let whole: Vec<u64> = json["whole"].as_array().unwrap().iter().map(|i| i.as_u64().unwrap()).collect();
        let pieces = json["pieces"].as_array().unwrap();
        assert!(!whole.is_empty() && whole.len() < pieces.len(), "{whole:?}");
        for (i, piece) in (0..).zip(pieces) {
            assert_eq!(whole.contains(&i), piece["outcome"] == "all of it grazes", "{piece}");
        }
    }
}
