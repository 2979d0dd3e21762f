//! Settings of a reader.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::FileId;
use crate::machine::OwnCode;
use crate::nc::Kept;

/// Meaning of a coordinate without a decimal point on a FANUC control (parameter 3401#0 DPI).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NumberInput {
    /// Whole units where no coordinate of the program has a point, otherwise least increments.
    #[default]
    Auto,
    /// Whole millimetres, inches, degrees.
    Calculator,
    /// Thousandths of a millimetre or degree, ten-thousandths of an inch.
    LeastIncrement,
}

/// Settings of a reader.
#[derive(Clone, Debug)]
pub struct ReadSettings {
    /// Most blocks that a program runs in loops and calls.
    pub blocks: u64,
    /// Files beside the program that it may call: the name as it is called, without ending and in small letters, and the
    /// file.
    pub files: Vec<(String, FileId)>,
    /// Meaning of coordinates without a decimal point (FANUC).
    pub input: NumberInput,
    /// Place of the tip before the first move, in coordinates of the first work offset [mm], where it is known.
    pub start: Option<[f64; 3]>,
    /// Codes of the machine that the language of the control does not have.
    pub codes: Vec<OwnCode>,
    /// Whether M codes of the machine that move no axis by custom (clamps, gears, relays) are passed over with a warning; they are
    /// errors otherwise.
    pub tolerant: bool,
    /// Tool table and parameters that the control has kept from programs before (LinuxCNC).
    pub kept: Kept,
    /// Whether reading goes on behind a block that is wrong or not understood: no axis is where the program says, until the
    /// program says it again. The errors are in [`Reading::errors`](super::Reading::errors).
    pub reads_on: bool,
}

impl ReadSettings {
    /// Usual number of blocks that a program may run in loops and calls.
    pub const BLOCKS: u64 = 20_000_000;
}

impl Default for ReadSettings {
    fn default() -> ReadSettings {
        ReadSettings {
            blocks: ReadSettings::BLOCKS,
            files: Vec::new(),
            input: NumberInput::Auto,
            start: None,
            codes: Vec::new(),
            tolerant: false,
            kept: Kept::default(),
            reads_on: false,
        }
    }
}
