//! A redistribution between machine and tool as a row of a table.

use serde::Serialize;

use crate::machine::Elementary;
use crate::machine::surface::{Candidate, GeneratedSurface, Split, chain_text};

/// Linked motions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LinkRow {
    /// The variable that they share.
    pub variable: String,
    /// The motions with their laws.
    pub motions: String,
    /// Kind of link.
    pub kind: &'static str,
}

/// A motion by which the tool is brought to the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SetupRow {
    /// The way back: "+3".
    pub motion: String,
    /// Its source.
    pub source: &'static str,
    /// Effect on the contact.
    pub verdict: &'static str,
    /// Sine of the draft angle.
    pub margin: f64,
}

/// A redistribution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SplitRow {
    /// Code of the machine's part.
    pub machine_code: String,
    /// Code of the tool's part.
    pub tool_code: String,
    /// The machine's part with its laws.
    pub machine: String,
    /// The tool's part with its laws.
    pub tool: String,
    /// Whether the tool would be rigid.
    pub valid: bool,
    /// Kind of tool.
    pub tool_kind: Option<&'static str>,
    /// Digits of the motions that run while the surface is made.
    pub forming: Vec<u8>,
    /// Digits of the motions that are set.
    pub setting: Vec<u8>,
    /// Linked motions.
    pub links: Vec<LinkRow>,
    /// Constant motions that are ground into the tool.
    pub built_in: String,
    /// Whether a set-up motion is needed.
    pub setup_needed: bool,
    /// The set-up motion that is best; none where none gets the tool out in one piece.
    pub setup: Option<SetupRow>,
    /// All set-up motions that were looked at.
    pub candidates: Vec<SetupRow>,
    /// Methods by which the lines of the surface are made, and the motions in Fedotenok's notation.
    pub methods: Option<String>,
    /// Name of the process in the trade.
    pub process: String,
    /// Remarks.
    pub remarks: Vec<String>,
}

impl SplitRow {
    /// The row of a redistribution of this surface.
    pub fn of(split: &Split, surface: &GeneratedSurface) -> SplitRow {
        let digits = |motions: &[Elementary]| motions.iter().map(|m| m.digit()).collect();
        SplitRow {
            machine_code: split.machine_code().to_string(),
            tool_code: split.tool_code().to_string(),
            machine: chain_text(&split.machine),
            tool: chain_text(&split.tool),
            valid: split.is_valid(),
            tool_kind: split.tool_kind.map(|kind| kind.name()),
            forming: digits(&split.forming),
            setting: digits(&split.setting),
            links: split
                .links
                .iter()
                .map(|link| LinkRow {
                    variable: link.variable.clone(),
                    motions: chain_text(&link.elements),
                    kind: link.kind.name(),
                })
                .collect(),
            built_in: chain_text(&split.built_in),
            setup_needed: split.setup.needed,
            setup: split.setup.chosen.as_ref().map(setup),
            candidates: split.setup.candidates.iter().map(setup).collect(),
            methods: split.methods(surface).map(|methods| methods.to_string()),
            process: split.process.clone(),
            remarks: split.remarks.clone(),
        }
    }
}

fn setup(candidate: &Candidate) -> SetupRow {
    SetupRow {
        motion: candidate.retreat.to_string(),
        source: candidate.source.name(),
        verdict: candidate.verdict.name(),
        margin: candidate.margin,
    }
}
