//! Edges that are chosen by the burr which the face milling before has left.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EdgeKeys, FaceEdges};
use crate::base::{Code, Finding, Result};
use crate::facing::burrs::{
    BurrChoice, BurrPart, BurrPieces, BurrState, BurrTable, PieceLengths, burr_parts, burr_pieces,
};
use crate::operations::face::{FaceOperation, PsiSide};
use crate::operations::kind::Table as _;
use crate::operations::{Around, OperationTable, Setting};
use crate::page::trimmed;

/// Edges of the face before that are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EdgesName {
    /// Those at which teeth have left at a bad exit angle.
    Bad,
}

/// Edges of a face that are chosen by their burr.
#[derive(Clone, Debug, PartialEq)]
pub struct WantedEdges {
    /// Burrs above this by the table; `None`: those with a bad exit angle [mm].
    pub above: Option<f64>,
    /// Height over the exit angle, from the side from which the face gives its angles.
    pub table: Option<BurrTable>,
}

impl WantedEdges {
    /// The choice of a table with the face to which it belongs; `None` for whole loops.
    ///
    /// # Errors
    /// `KC1006` without a face before it, and without a table of heights where one is needed; `KC0102` for keys that exclude each
    /// other, `KC1001` for a table that makes no sense.
    pub(super) fn of(
        keys: &EdgeKeys<'_>,
        around: &Around<'_>,
    ) -> Result<Option<(WantedEdges, FaceOperation)>> {
        let shape = |what: &str, help: &str, key: &str| {
            Err(Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into())
        };
        let (key, above) = match (keys.edges, keys.above) {
            (None, None) if keys.burr.is_some() => {
                let help = "add edges = \"bad\", or above = 0.1 for burrs higher than that";
                return shape("`burr` says heights, but no edges are chosen by them", help, "burr");
            }
            (None, None) => return Ok(None),
            (Some(_), Some(_)) => {
                return shape("`edges` and `above` exclude each other", "give one of them", "above");
            }
            (Some(EdgesName::Bad), None) => ("edges", None),
            (None, Some(above)) => ("above", Some(above)),
        };
        if keys.of.is_some() || !keys.own.is_empty() {
            let what =
                format!("`{key}` takes the outline of the face before: `of` and an outline exclude it");
            return shape(&what, "leave them out, or leave out `edges` and `above`", key);
        }
        for (other, given) in [("start", keys.start.is_some()), ("overlap", keys.overlap.is_some())] {
            if given {
                let what = format!("`{key}` cuts pieces, which have no `{other}`");
                return shape(&what, "leave it out", other);
            }
        }
        if keys.plane.is_some() {
            return shape(
                &format!("`{key}` works on a face, which has no plane"),
                "leave out `plane`",
                "plane",
            );
        }
        let table = match keys.burr {
            Some(points) => {
                let points = points.iter().map(|&[psi, h]| [psi.to_radians(), h]).collect();
                Some(BurrTable::new(points).map_err(|e| e.under("burr"))?)
            }
            None => None,
        };
        if let Some(above) = above {
            BurrChoice::above(above)?;
            if table.is_none() {
                let what = "`burr` is missing: the program can say where, not how high";
                let help = "give pairs of exit angle and height as measured: burr = [[0, 0.30], [60, 0.12], [90, 0.05]]";
                return Err(Finding::error(Code::BURRS, what).help(help).key("burr").into());
            }
        }
        let face = around.before.iter().rev().find_map(OperationTable::face);
        let Some(face) = face else { return Err(no_face(key).into()) };
        // Where it is wrong, it was refused by itself before.
        let face = face.check(around)?;
        Ok(Some((WantedEdges { above, table }, face)))
    }

    /// The key that chooses.
    pub(super) fn key(&self) -> &'static str {
        if self.above.is_some() { "above" } else { "edges" }
    }

    /// The edges in words.
    pub(super) fn in_words(&self) -> String {
        match self.above {
            Some(limit) => format!("edges with burrs above {}", trimmed(limit, 3)),
            None => "bad edges".to_owned(),
        }
    }
}

/// The error where no face is milled before.
fn no_face(key: &str) -> Finding {
    let what = format!("`{key}` needs a face operation before it in this setup");
    Finding::error(Code::BURRS, what).help("mill the face before, or give an outline").key(key)
}

/// The burrs of a face, and the pieces along which they are taken off.
#[derive(Clone, Debug)]
pub(super) struct FoundBurrs {
    /// The face.
    pub(super) face: FaceEdges,
    /// All stretches on which teeth leave.
    pub(super) parts: Vec<BurrPart>,
    /// The pieces.
    pub(super) pieces: BurrPieces,
}

impl FoundBurrs {
    /// Of the face before an operation; `is_wanted` tells which loops may be treated.
    ///
    /// # Errors
    /// `KC1006` where no face was milled before; a note of the same code where nothing is to be done.
    pub(super) fn of(
        wanted: &WantedEdges,
        setting: &Setting<'_>,
        diameter: f64,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Result<std::result::Result<FoundBurrs, Finding>> {
        let Some(face) = setting.milled else { return Err(no_face(wanted.key()).into()) };
        let choice = match wanted.above {
            Some(limit) => BurrChoice::Above(limit),
            None => BurrChoice::Bad(face.edges.case.bad.clone()),
        };
        let table = wanted.table.as_ref().map(|t| match face.psi_side {
            PsiSide::Paper => t.clone(),
            PsiSide::Supplement => t.supplement(),
        });
        let parts = burr_parts(&face.edges, &choice, table.as_ref());
        let outline = &face.edges.case.outline;
        let of_loop = |edge: usize| outline.loops().iter().position(|l| l.edges.contains(&edge));
        let cut: Vec<BurrPart> =
            parts.iter().copied().filter(|p| of_loop(p.edge).is_some_and(&is_wanted)).collect();
        let pieces = burr_pieces(outline, &cut, PieceLengths::of_tool(diameter));
        if !pieces.pieces.is_empty() {
            return Ok(Ok(FoundBurrs { face: face.clone(), parts, pieces }));
        }
        let whose = format!("operation {} ({})", face.operation + 1, face.name);
        let what = match wanted.above {
            Some(limit) => {
                format!("above = {}: {whose} left no burr higher than that by your table", trimmed(limit, 4))
            }
            None => format!("edges = \"bad\": {whose} left no bad edge"),
        };
        let left: f64 = of_state(&parts, BurrState::Chosen).map(BurrPart::length).sum();
        let what = match left > 0.0 {
            true => format!("{what} that is cut: {} mm are too short or on other loops", trimmed(left, 2)),
            false => what,
        };
        Ok(Err(Finding::note(Code::BURRS, what)
            .help("nothing is cut, and the operation is left out")
            .key(wanted.key())))
    }

    /// The chosen burrs that no piece of a list treats: too short, or on loops that are not cut.
    pub(super) fn left(&self, treated: impl Fn(usize) -> bool) -> Vec<BurrPart> {
        let on_piece = |part: &BurrPart| {
            let pieces = self.pieces.pieces.iter().enumerate();
            pieces.filter(|(i, _)| treated(*i)).any(|(_, piece)| piece.parts.contains(part))
        };
        of_state(&self.parts, BurrState::Chosen).filter(|p| !on_piece(p)).copied().collect()
    }

    /// Exit angles of a part as the job gives them, the lesser first [rad].
    pub(super) fn shown_angles(&self, part: &BurrPart) -> [f64; 2] {
        let [a, b] = part.exit_angles;
        match self.face.psi_side {
            PsiSide::Paper => [a, b],
            PsiSide::Supplement => [PI - b, PI - a],
        }
    }

    /// An edge in words: its label, or its number.
    pub(super) fn edge_name(&self, edge: usize) -> String {
        let label = self.face.edges.case.outline.label(edge);
        label.map_or_else(|| format!("edge {edge}"), |label| format!("edge {label}"))
    }

    /// A part in words, as a comment of the program has it.
    pub(super) fn told(&self, part: &BurrPart) -> String {
        let [from, to] = part.along.map(|s| trimmed(s, 1));
        let name = self.edge_name(part.edge);
        match part.height {
            Some(height) => format!("{name} {from}..{to}: burr to {}", trimmed(height, 3)),
            None => format!("{name} {from}..{to}: {} mm of burr", trimmed(part.length(), 1)),
        }
    }
}

/// The parts of a state.
pub(super) fn of_state(parts: &[BurrPart], state: BurrState) -> impl Iterator<Item = &BurrPart> {
    parts.iter().filter(move |p| p.state == state)
}
