//! Coordinate frames in which a program's points are given.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geom::Rigid;

/// Index of a frame in a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FrameId(pub u32);

/// A work offset of a control: `G54`, `G59.1`, `G505`, `G54.1 P12`.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::program::WorkOffset;
/// assert_eq!(WorkOffset::parse("g59.1").unwrap().to_string(), "G59.1");
/// assert!(WorkOffset::parse("G53").is_none());
/// let extended = WorkOffset::extended(12).unwrap();
/// assert_eq!([WorkOffset::parse("G54.1 P12"), WorkOffset::parse("g154p12")], [Some(extended); 2]);
/// assert_eq!((extended.to_string(), extended.extension()), ("G54.1 P12".to_owned(), Some(12)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct WorkOffset {
    /// The G code times ten: 540 for G54, 591 for G59.1; [`EXTENDED`] and the number of an extended one.
    tenths: u16,
}

/// Beyond all G codes times ten.
const EXTENDED: u16 = 10_000;
/// Most extended work offsets that a control has (FANUC 30i).
const MOST_EXTENDED: u32 = 300;

impl WorkOffset {
    /// `G54`.
    pub const G54: WorkOffset = WorkOffset { tenths: 540 };

    /// The work offset with this G code times ten, if it is one: G54 to G59, G59.1 to G59.3, G505 to G599.
    pub fn from_tenths(tenths: u32) -> Option<WorkOffset> {
        let whole = tenths.is_multiple_of(10);
        let ok = (540..=590).contains(&tenths) && whole
            || (591..=593).contains(&tenths)
            || (5050..=5990).contains(&tenths) && whole;
        ok.then_some(WorkOffset { tenths: tenths as u16 })
    }

    /// The further work offset of this number, from 1 to 300: `G54.1 P` of FANUC, `G154 P` of Haas.
    pub fn extended(number: u32) -> Option<WorkOffset> {
        (1..=MOST_EXTENDED).contains(&number).then(|| WorkOffset { tenths: EXTENDED + number as u16 })
    }

    /// Its number, where it is an extended one.
    pub fn extension(self) -> Option<u16> {
        self.tenths.checked_sub(EXTENDED).filter(|number| *number > 0)
    }

    /// The G code times ten; 10000 and the number of an extended one.
    pub fn tenths(self) -> u16 {
        self.tenths
    }

    /// The work offset of this name, if it is one.
    pub fn parse(text: &str) -> Option<WorkOffset> {
        let number = text.strip_prefix(['G', 'g'])?;
        let further = ["54.1", "154"].iter().find_map(|code| number.strip_prefix(code));
        if let Some(p) = further.and_then(|rest| rest.trim_start().strip_prefix(['P', 'p'])) {
            let digits = !p.is_empty() && p.bytes().all(|b| b.is_ascii_digit());
            return WorkOffset::extended(digits.then(|| p.parse().ok()).flatten()?);
        }
        let (whole, part) = number.split_once('.').unwrap_or((number, "0"));
        let digit = |t: &str| t.bytes().all(|b| b.is_ascii_digit()).then(|| t.parse::<u32>().ok()).flatten();
        let part = if part.len() == 1 { digit(part)? } else { return None };
        WorkOffset::from_tenths(digit(whole)?.checked_mul(10)? + part)
    }
}

impl std::fmt::Display for WorkOffset {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(number) = self.extension() {
            return write!(f, "G54.1 P{number}");
        }
        match self.tenths % 10 {
            0 => write!(f, "G{}", self.tenths / 10),
            part => write!(f, "G{}.{part}", self.tenths / 10),
        }
    }
}

/// Solution of a tilted plane that the rotary axes take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RotarySolution {
    /// The control chooses.
    #[default]
    Free,
    /// The first rotary axis positive.
    Positive,
    /// The first rotary axis negative.
    Negative,
}

/// A coordinate frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frame {
    /// Axis positions of the machine.
    Machine,
    /// A work offset of the setup.
    Work(WorkOffset),
    /// A frame moved within another: `motion` maps this frame's points into the parent.
    Shift {
        /// The frame it is moved in.
        parent: FrameId,
        /// Maps points of this frame into the parent.
        motion: Rigid,
    },
    /// A tilted working plane: the tool axis is this frame's Z, once [`Target::Orient`](super::Target::Orient) has run.
    Tilted {
        /// The frame it is tilted in.
        parent: FrameId,
        /// Maps points of this frame into the parent.
        motion: Rigid,
        /// Choice of the rotary axes' solution.
        branch: RotarySolution,
    },
}
