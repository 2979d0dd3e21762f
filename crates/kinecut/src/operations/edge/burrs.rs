//! Edges that are chosen by the burr which the face milling before has left.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EdgeKeys, FaceEdges};
use crate::base::{Code, Finding, Result};
use crate::contouring::{CutPiece, LoopStretches, OutlinePiece};
use crate::facing::burrs::{
    BurrChoice, BurrPart, BurrPieces, BurrState, BurrTable, PieceLengths, burr_parts, burr_pieces,
};
use crate::geom::Outline;
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
        let on_wanted = |p: &&BurrPart| of_loop(p.edge).is_some_and(&is_wanted);
        let lowered = of_state(&parts, BurrState::Lowered).filter(on_wanted).map(BurrPart::length).sum();
        let left = of_state(&parts, BurrState::Chosen).map(BurrPart::length).sum();
        Ok(Err(nothing(wanted, &whose(face), left, lowered)))
    }

    /// The face in words.
    pub(super) fn whose(&self) -> String {
        whose(&self.face)
    }

    /// The burrs of a state, divided by what some cuts have the path beside.
    fn divided<'a>(&self, state: BurrState, cuts: impl Iterator<Item = &'a CutPiece>) -> DividedBurrs {
        let outline = &self.face.edges.case.outline;
        let beside: Vec<OutlinePiece> = cuts.flat_map(|c| c.beside.iter().copied()).collect();
        let stretches = LoopStretches::new(outline, &beside);
        let mut all = DividedBurrs::default();
        of_state(&self.parts, state).for_each(|part| all.add(part, outline, &stretches));
        all
    }

    /// The chosen burrs that a cut takes off.
    pub(super) fn treated(&self, cut: &CutPiece) -> Vec<BurrPart> {
        self.divided(BurrState::Chosen, std::iter::once(cut)).on
    }

    /// The chosen burrs that none of some cuts takes off: too short, before inside corners, or on loops that are not cut.
    pub(super) fn left<'a>(&self, cuts: impl Iterator<Item = &'a CutPiece>) -> Vec<BurrPart> {
        self.divided(BurrState::Chosen, cuts).off
    }

    /// The other burrs of a state, each with whether one of some cuts runs over it.
    pub(super) fn others<'a>(
        &self,
        state: BurrState,
        cuts: impl Iterator<Item = &'a CutPiece>,
    ) -> Vec<(BurrPart, bool)> {
        let DividedBurrs { on, off } = self.divided(state, cuts);
        let mut all: Vec<(BurrPart, bool)> =
            on.into_iter().map(|p| (p, true)).chain(off.into_iter().map(|p| (p, false))).collect();
        all.sort_by(|(a, _), (b, _)| a.edge.cmp(&b.edge).then(a.along[0].total_cmp(&b.along[0])));
        all
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

/// Burrs beside a path, and the others. Of a burr that is divided each part has the angles and the height of all of it.
#[derive(Clone, Debug, Default, PartialEq)]
struct DividedBurrs {
    on: Vec<BurrPart>,
    off: Vec<BurrPart>,
}

impl DividedBurrs {
    /// Adds a burr, divided by stretches of the loops of its outline.
    fn add(&mut self, part: &BurrPart, outline: &Outline, stretches: &LoopStretches) {
        let of_loop = outline.loops().iter().position(|l| l.edges.contains(&part.edge));
        let Some(of_loop) = of_loop else { return self.off.push(*part) };
        let first = outline.loops()[of_loop].edges.start;
        let begin: f64 = outline.edges()[first..part.edge].iter().map(|e| e.length()).sum();
        let split = stretches.split(of_loop, part.along.map(|s| begin + s));
        let one = |along: [f64; 2]| BurrPart { along: along.map(|s| s - begin), ..*part };
        self.on.extend(split.on.into_iter().map(one));
        self.off.extend(split.off.into_iter().map(one));
    }
}

/// A face in words.
fn whose(face: &FaceEdges) -> String {
    format!("operation {} ({})", face.operation + 1, face.name)
}

/// The reason to leave out an operation for whose choice nothing is to be cut; `left`: length of chosen burrs that are too short or on
/// other loops, `lowered`: of edges onto which the cutter was lowered [mm].
fn nothing(wanted: &WantedEdges, whose: &str, left: f64, lowered: f64) -> Finding {
    let what = match wanted.above {
        Some(limit) => {
            format!("above = {}: {whose} left no burr higher than that by your table", trimmed(limit, 4))
        }
        None => format!("edges = \"bad\": {whose} left no bad edge"),
    };
    let what = match left > 0.0 {
        true => format!("{what} that is cut: {} mm are too short or on other loops", trimmed(left, 2)),
        false => what,
    };
    let finding = match lowered > 0.0 {
        true => Finding::warning(Code::BURRS, format!("{what}; {}", lowered_onto(lowered)))
            .help("nothing is cut, and the operation is left out: look at these edges, or mill from beside the part"),
        false => {
            Finding::note(Code::BURRS, what).help("nothing is cut, and the operation is left out")
        }
    };
    finding.key(wanted.key())
}

/// Edges without an exit angle in words.
pub(super) fn lowered_onto(length: f64) -> String {
    format!(
        "onto {} mm of its edges the cutter was lowered, where no exit angle tells of a burr",
        trimmed(length, 2)
    )
}

/// The parts of a state.
pub(super) fn of_state(parts: &[BurrPart], state: BurrState) -> impl Iterator<Item = &BurrPart> {
    parts.iter().filter(move |p| p.state == state)
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::base::Severity;

    #[test]
    fn burrs_are_divided_where_the_path_ends() {
        let corners = [dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 30.0), dvec2(0.0, 30.0)];
        let outline = Outline::polygon(&corners).unwrap();
        let first = outline.edges()[0].length();
        let part = BurrPart {
            edge: 1,
            along: [2.0, 20.0],
            exit_angles: [0.3, 0.4],
            height: Some(0.2),
            state: BurrState::Chosen,
        };
        let beside = [[first + 5.0, first + 8.0], [first + 12.0, first + 50.0]];
        let beside = beside.map(|along| OutlinePiece { of_loop: 0, along });
        let mut all = DividedBurrs::default();
        all.add(&part, &outline, &LoopStretches::new(&outline, &beside));
        let on: Vec<[f64; 2]> = all.on.iter().map(|p| p.along).collect();
        let off: Vec<[f64; 2]> = all.off.iter().map(|p| p.along).collect();
        for (found, wanted) in [(on, [[5.0, 8.0], [12.0, 20.0]]), (off, [[2.0, 5.0], [8.0, 12.0]])] {
            let found: Vec<f64> = found.into_iter().flatten().collect();
            let wanted = wanted.concat();
            assert!(
                found.len() == 4 && found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-9),
                "{found:?} {wanted:?}"
            );
        }
    }

    #[test]
    fn edges_onto_which_the_cutter_was_lowered_are_no_silent_good_ones() {
        let bad = WantedEdges { above: None, table: None };
        let good = nothing(&bad, "operation 1 (face)", 0.0, 0.0);
        assert_eq!((good.severity, good.key.as_deref()), (Severity::Note, Some("edges")));
        let lowered = nothing(&bad, "operation 1 (face)", 0.0, 12.5);
        assert_eq!((lowered.code, lowered.severity), (Code::BURRS, Severity::Warning));
        assert!(
            lowered.message.contains("left no bad edge; onto 12.5 mm of its edges"),
            "{}",
            lowered.message
        );
        let above = WantedEdges { above: Some(0.1), table: None };
        let short = nothing(&above, "operation 1 (face)", 0.4, 3.0);
        assert!(
            short.message.contains("0.4 mm are too short or on other loops; onto 3 mm"),
            "{}",
            short.message
        );
        assert_eq!((short.severity, short.key.as_deref()), (Severity::Warning, Some("above")));
    }
}
