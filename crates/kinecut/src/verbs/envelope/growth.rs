//! A move at equal moments: pose, motion and grazing curves of each, and the walls that are traced up to it. With the tool at the first
//! moment and at the last these walls enclose what is swept so far; nothing is trimmed.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Serialize, Serializer};

use super::sheet::{Moved, TOLERANCE, entering_at, moved, still, way_and_turn};
use super::{EnteringAt, EnvelopeTable, MoveSource, moving::motions};
use crate::base::{Code, Finding, Loader, Progress, Result};
use crate::geom::Rigid;
use crate::job::contour::given_contour;
use crate::job::report::{BodyView, packed_body};
use crate::machine::Twist;
use crate::page::{Block, Row, Section, Table, fixed};
use crate::sweep::{Envelope, ProfileChain};
use crate::verbs::Answer;
use crate::verbs::grazing::json::{PieceJson, matrix};

/// Most intervals of a move.
pub const MOST_INTERVALS: u32 = 480;
/// Distance of drawn curves and walls by the size of the tool: below what a screen shows.
const FINENESS: f64 = 1.0 / 600.0;
/// Difference of moments that is rounding.
const SAME: f64 = 1e-9;
/// Most rows of a table of moments; JSON has all.
const ROWS: usize = 13;

/// A moment of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthMoment {
    /// From the tool's coordinates into those of the workpiece.
    pub pose: Rigid,
    /// Velocity of the tool in its own coordinates, by the whole move [mm, rad].
    pub twist: Twist,
    /// Grazing curves in coordinates of the tool, each with its last point at its first where it closes.
    pub curves: Vec<Vec<DVec3>>,
    /// Area and volume that enter.
    pub entering: EnteringAt,
    /// Triangles of the walls up to it.
    pub triangles: usize,
}

/// A move at equal moments.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Title.
    pub title: String,
    /// The chain of pieces of the tool.
    pub chain: ProfileChain,
    /// Motion of the tip or the tool, in words.
    pub way: &'static str,
    /// Rule for the positions between the ends, in words.
    pub mode: &'static str,
    /// Source of the move.
    pub source: MoveSource,
    /// Way of the tip [mm], and angle by which the tool's axis turns along its way [rad].
    pub length_and_turn: [f64; 2],
    /// Share of the move that is swept.
    pub until: f64,
    /// Distance of curves and walls from the true ones [mm].
    pub tolerance: f64,
    /// The moments.
    pub moments: Vec<GrowthMoment>,
    /// Walls and both ends.
    pub envelope: Envelope,
    /// Notes of the tool's reader, and on the tolerance.
    pub notes: Vec<String>,
    /// Findings.
    pub findings: Vec<Finding>,
}

/// The moves of one question: one, or of a line of a program one for each of its moves.
#[derive(Clone, Debug)]
pub struct Growths(pub Vec<Growth>);

/// The moves of a table at the ends of `intervals` equal parts of their time; files come through `loader`.
///
/// # Errors
/// Those of [`envelope_sheets`](super::envelope_sheets).
pub fn growths(
    table: &EnvelopeTable,
    intervals: u32,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<Growths> {
    crate::job::check::numbers::within(table)?;
    let given = given_contour(table.tool.as_ref(), table.tool_file.as_deref(), loader)?;
    let moves = motions(table, given.is_none(), loader)?;
    let one = |moving| growth(table, moved(table, given.clone(), moving)?, intervals as usize, progress);
    moves.into_iter().map(one).collect::<Result<_>>().map(Growths)
}

fn growth(table: &EnvelopeTable, moved: Moved, intervals: usize, progress: &dyn Progress) -> Result<Growth> {
    let Moved { title, contour, motion, until, way, mode, source, mut notes } = moved;
    let chain = ProfileChain::new(&contour);
    let wanted = table.tolerance.unwrap_or(TOLERANCE);
    // One that is no length is refused as it is.
    let tolerance = if wanted > 0.0 { wanted.max(FINENESS * chain.reach()) } else { wanted };
    if tolerance > wanted {
        notes.push(format!(
            "curves and walls are within {} mm, a {:.0}th of the tool's reach, not within the tolerance of {wanted} mm: finer is \
             not seen; `kinecut envelope` without --moments keeps it",
            fixed(tolerance, 4),
            1.0 / FINENESS,
        ));
    }
    let envelope =
        chain.envelope_by(&motion, tolerance, intervals, progress).map_err(|e| match e.code() {
            Code::SWEEP_TOLERANCE | Code::SWEEP_TOO_FINE => e.under("tolerance"),
            _ => e,
        })?;
    let moment = |k: usize| {
        let t = k as f64 / intervals as f64;
        let jet = motion.at(t);
        let grazing = chain.grazing(&jet.twist);
        let curves = grazing.loops.iter().map(|of| {
            let points = chain.curve(&grazing, of, tolerance);
            points.into_iter().map(|p| p.point).collect()
        });
        let before = envelope.moments.iter().rposition(|m| *m <= t + SAME).unwrap_or(0);
        GrowthMoment {
            pose: jet.pose,
            twist: jet.twist,
            curves: curves.collect(),
            entering: entering_at(&chain, &motion, t),
            triangles: envelope.walls[before],
        }
    };
    let times: Vec<f64> = (0..=intervals).map(|k| k as f64 / intervals as f64).collect();
    let findings = Vec::from_iter(still(&chain, &motion, &times));
    let moments = (0..=intervals).into_par_iter().map(moment).collect();
    let length_and_turn = way_and_turn(&motion);
    Ok(Growth {
        title,
        chain,
        way,
        mode,
        source,
        length_and_turn,
        until,
        tolerance,
        moments,
        envelope,
        notes,
        findings,
    })
}

/// The fields of all tables stand in the order of their names.
#[derive(Serialize)]
struct GrowthJson<'a> {
    ends: [[usize; 2]; 2],
    findings: &'a [Finding],
    length: f64,
    mode: &'static str,
    moments: Vec<MomentJson<'a>>,
    notes: &'a [String],
    pieces: Vec<PieceJson>,
    source: &'a MoveSource,
    stream: String,
    title: &'a str,
    tolerance: f64,
    triangles: usize,
    turn: f64,
    until: f64,
    vertices: usize,
    way: &'static str,
}

/// Velocities by the whole move: mm, degrees.
#[derive(Serialize)]
struct MomentJson<'a> {
    #[serde(flatten)]
    entering: &'a EnteringAt,
    paths: Vec<Vec<[f64; 3]>>,
    pose: [[f64; 4]; 3],
    triangles: usize,
    turn: [f64; 3],
    velocity: [f64; 3],
}

impl<'a> MomentJson<'a> {
    fn of(m: &'a GrowthMoment) -> MomentJson<'a> {
        MomentJson {
            entering: &m.entering,
            paths: m.curves.iter().map(|c| c.iter().map(|p| p.to_array()).collect()).collect(),
            pose: matrix(&m.pose),
            triangles: m.triangles,
            turn: m.twist.turn.to_array().map(f64::to_degrees),
            velocity: m.twist.shift.to_array(),
        }
    }
}

impl Serialize for Growth {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let Envelope { mesh, walls, start, .. } = &self.envelope;
        let last = walls.last().copied().unwrap_or(0);
        let body = BodyView {
            name: String::new(),
            vertices: mesh.vertices.iter().map(|v| v.as_vec3().to_array()).collect(),
            triangles: mesh.triangles.clone(),
        };
        GrowthJson {
            ends: [[last, *start], [*start, mesh.triangles.len()]],
            findings: &self.findings,
            length: self.length_and_turn[0],
            mode: self.mode,
            moments: self.moments.iter().map(MomentJson::of).collect(),
            notes: &self.notes,
            pieces: (0..self.chain.pieces().len()).map(|i| PieceJson::of(&self.chain, i, None)).collect(),
            source: &self.source,
            stream: packed_body(&body),
            title: &self.title,
            tolerance: self.tolerance,
            triangles: mesh.triangles.len(),
            turn: self.length_and_turn[1].to_degrees(),
            until: self.until,
            vertices: mesh.vertices.len(),
            way: self.way,
        }
        .serialize(serializer)
    }
}

impl Serialize for Growths {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Moves<'a> {
            moves: &'a [Growth],
        }
        match &self.0[..] {
            [one] => one.serialize(serializer),
            moves => Moves { moves }.serialize(serializer),
        }
    }
}

impl Answer for Growths {
    fn sections(&self) -> Vec<Section> {
        self.0.iter().map(section).collect()
    }

    fn findings(&self) -> Vec<&Finding> {
        self.0.iter().flat_map(|growth| &growth.findings).collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        if let Some(first) = self.0.first_mut() {
            first.findings.extend(findings);
        }
    }
}

fn section(growth: &Growth) -> Section {
    let mut table = Table::new(
        "Moments",
        "t []; x [mm]; y [mm]; z [mm]; curves []; area that enters [mm\u{b2}]; volume entered by the move [mm\u{b3}]",
    );
    let step = growth.moments.len().div_ceil(ROWS).max(1);
    for m in growth.moments.iter().step_by(step) {
        let [x, y, z] = m.pose.translation.to_array().map(|c| fixed(c, 4).into());
        let EnteringAt { area, curves, t, rate } = m.entering;
        let row = vec![
            fixed(t, 4).into(),
            x,
            y,
            z,
            curves.to_string().into(),
            fixed(area, 3).into(),
            fixed(rate, 3).into(),
        ];
        table.rows.push(Row::new(row));
    }
    if step > 1 {
        table.notes.push(format!("Every {step}th of {}; JSON has all.", growth.moments.len()));
    }
    let title = if growth.title.is_empty() { "Move" } else { &growth.title };
    let words = format!("{}; {}", growth.way, growth.mode);
    Section::new(title).with(Block::Text(words)).with(table)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::base::{MemoryLoader, Silent};

    fn growth_of(rest: Value) -> Value {
        let tool = json!({ "shape": { "end-mill": { "diameter": 10, "flute_length": 20 } } });
        let mut question = json!({ "tool": tool });
        for (key, value) in rest.as_object().unwrap() {
            question[key] = value.clone();
        }
        let table: EnvelopeTable = serde_json::from_value(question).unwrap();
        let all = growths(&table, 4, &MemoryLoader::default(), &Silent).unwrap();
        assert_eq!(all.findings().len(), all.0[0].findings.len());
        serde_json::to_value(&all).unwrap()
    }

    #[test]
    fn a_move_of_nothing_is_warned_of() {
        let still = growth_of(json!({ "move": { "from": [0, 0, 0], "to": [0, 0, 0] } }));
        assert_eq!(still["findings"][0]["code"], "KC1201", "{}", still["findings"]);
        let moves = growth_of(json!({ "move": { "from": [0, 0, 0], "to": [9, 0, 0] } }));
        assert_eq!(moves["findings"], json!([]));
    }

    #[test]
    fn a_tolerance_that_is_not_kept_is_told() {
        let along = json!({ "from": [0, 0, 0], "to": [9, 0, 0] });
        let told = |tolerance: f64| {
            let growth = growth_of(json!({ "tolerance": tolerance, "move": along }));
            let kept = growth["tolerance"].as_f64().unwrap() <= tolerance;
            (kept, growth["notes"].to_string().contains("not within the tolerance"))
        };
        assert_eq!(told(0.02), (false, true));
        assert_eq!(told(0.05), (true, false));
    }
}
