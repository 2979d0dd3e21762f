//! Outlines as JSON: loops of points with bulges, and circles.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::marker::PhantomData;

use glam::DVec2;
use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::drawing::{Drawing, Origin};
use super::source::Source;
use super::{LengthUnit, OutlineEdge, OutlineOptions, OutlineRead};
use crate::base::{Code, Finding, Result};

/// An outline as a JSON file gives it. Loops in any order and direction; those inside an odd number of others are holes. Open lines are
/// for a cutter that runs along them; where a face is wanted, lines have to close at their ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlineFile {
    /// Description for the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<String>,
    /// Unit of all numbers; default mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// The loops.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(example = vec![vec![[0, 0], [40, 0], [40, 20]]])]
    pub loops: Vec<LoopEntry>,
    /// Open lines, each in its direction: lists of points, or tables with `points`; the last point is not joined to the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(example = vec![vec![[0, 0], [40, 0]]])]
    pub lines: Vec<LoopEntry>,
    /// Weight of the edges of a label; edges without one weigh 1.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub weights: BTreeMap<String, f64>,
}

/// A loop: a list of points, or a table.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum LoopEntry {
    /// Its points in order; the last is joined to the first.
    Points(Vec<PointEntry>),
    /// A circle, or points with a label for all edges.
    Table(LoopTable),
}

impl LoopEntry {
    /// The label of all of its edges.
    fn label(&self) -> Option<&String> {
        match self {
            LoopEntry::Points(_) => None,
            LoopEntry::Table(table) => table.label.as_ref(),
        }
    }
}

/// A loop with a label: either `points`, or `centre` and `radius` of a circle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoopTable {
    /// Its points in order; the last is joined to the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Vec<PointEntry>>,
    /// Centre of a circle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre: Option<[f64; 2]>,
    /// Radius of a circle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Name of its edges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Weight of its edges; default that of the label.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

/// A point: `[x, y]`, `[x, y, bulge]`, or a table.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum PointEntry {
    /// Coordinates, and the bulge of the edge that begins here: tan(sweep / 4), counter-clockwise positive.
    Numbers(#[schemars(length(min = 2, max = 3))] Vec<f64>),
    /// With a name or weight of the edge that begins here.
    Table(OutlinePoint),
}

/// A point, and the edge that begins there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlinePoint {
    /// Coordinate.
    #[schemars(example = 0)]
    pub x: f64,
    /// Coordinate.
    #[schemars(example = 0)]
    pub y: f64,
    /// tan(sweep / 4) of the edge, no unit, counter-clockwise positive; default 0, straight.
    #[serde(default)]
    pub bulge: f64,
    /// Name of the edge; default that of the loop.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// Weight of the edge; default that of its label.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

/// Reads a list as `S`, a table as `M`: errors keep their line, which an untagged enum would lose.
struct ListOrTable<S, M, T> {
    list: fn(S) -> T,
    table: fn(M) -> T,
    expecting: &'static str,
    kinds: PhantomData<(S, M)>,
}

impl<'de, S: Deserialize<'de>, M: Deserialize<'de>, T> Visitor<'de> for ListOrTable<S, M, T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expecting)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> std::result::Result<T, A::Error> {
        S::deserialize(SeqAccessDeserializer::new(seq)).map(self.list)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> std::result::Result<T, A::Error> {
        M::deserialize(MapAccessDeserializer::new(map)).map(self.table)
    }
}

impl<'de> Deserialize<'de> for LoopEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<LoopEntry, D::Error> {
        let expecting = "a list of points, or a table with `points` or `centre` and `radius`";
        deserializer.deserialize_any(ListOrTable {
            list: LoopEntry::Points,
            table: LoopEntry::Table,
            expecting,
            kinds: PhantomData,
        })
    }
}

impl<'de> Deserialize<'de> for PointEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<PointEntry, D::Error> {
        let expecting = "a point [x, y], [x, y, bulge] or {\"x\": .., \"y\": ..}";
        deserializer.deserialize_any(ListOrTable {
            list: PointEntry::Numbers,
            table: PointEntry::Table,
            expecting,
            kinds: PhantomData,
        })
    }
}

impl OutlineFile {
    /// The outline or the lines, as the options say.
    ///
    /// # Errors
    /// `KC0802` for a loop that is neither points nor a circle, for points that are not two or three numbers and for
    /// weights that are negative or not finite, with the key; else as [`Outline::new`](super::Outline::new).
    pub fn outline(&self, options: &OutlineOptions) -> Result<OutlineRead> {
        self.read(Source::new("outline", b""), options)
    }

    fn read(&self, source: Source, options: &OutlineOptions) -> Result<OutlineRead> {
        let mm = options.unit.or(self.unit).unwrap_or(LengthUnit::Millimetre).mm();
        let mut drawing = Drawing::new(source);
        for (label, &weight) in &self.weights {
            check_weight(Some(weight)).map_err(|e| at(&drawing, e, format!("weights.{label}")))?;
        }
        let layers = &options.layers;
        self.has_labels(layers).map_err(|finding| finding.at(drawing.source.file()))?;
        for (key, entries) in [("loops", &self.loops), ("lines", &self.lines)] {
            for (i, entry) in entries.iter().enumerate() {
                let table = match entry {
                    LoopEntry::Points(points) => {
                        &LoopTable { points: Some(points.clone()), ..LoopTable::default() }
                    }
                    LoopEntry::Table(table) => table,
                };
                if !(layers.is_empty() || table.label.as_ref().is_some_and(|l| layers.contains(l))) {
                    continue;
                }
                let place = format!("{key}[{i}]");
                let edges = self.edges(table, &place, (key == "loops", mm), &mut drawing);
                let edges = edges.map_err(|e| at(&drawing, e, place))?;
                if key == "loops" { drawing.loops.push(edges) } else { drawing.paths.push(edges) }
            }
        }
        // Numbers are exact: only ends that are the same point are joined.
        drawing.finish_with(&OutlineOptions { snap: 0.0, half_section: None, ..options.clone() })
    }

    /// Each layer that is wanted is the label of a loop or a line.
    fn has_labels(&self, layers: &[String]) -> std::result::Result<(), Finding> {
        let labels: BTreeSet<&String> =
            self.loops.iter().chain(&self.lines).filter_map(LoopEntry::label).collect();
        let Some(missing) = layers.iter().find(|l| !labels.contains(l)) else { return Ok(()) };
        let there: Vec<String> = labels.iter().map(|l| format!("{l:?}")).collect();
        let help = match there.is_empty() {
            true => "no loop has a label: leave out `layers`".to_owned(),
            false => format!("labels of the file: {}", there.join(", ")),
        };
        Err(bad(&format!("no loop or line has the label {missing:?}")).help(help).key("layers"))
    }

    /// The edges of a loop or, if it is not to be closed, of a line; `mm`: size of its unit.
    fn edges(
        &self,
        table: &LoopTable,
        place: &str,
        (closed, mm): (bool, f64),
        drawing: &mut Drawing,
    ) -> Result<Vec<OutlineEdge>> {
        check_weight(table.weight)?;
        let mut origin = |what: String, label: Option<&String>, weight: Option<f64>| {
            let label = label.or(table.label.as_ref());
            let weight = weight.or(table.weight).or_else(|| self.weights.get(label?).copied());
            drawing.origin(Origin { what, offset: None, label: label.cloned(), weight })
        };
        let points = match (&table.points, table.centre, table.radius) {
            (Some(points), None, None) => points,
            (None, Some(centre), Some(radius)) if closed => {
                if !(radius > 0.0) {
                    return Err(bad("a circle needs a positive radius").value_mm(radius * mm).into());
                }
                let label = origin(format!("circle {place}"), None, None);
                let circle =
                    OutlineEdge::arc(DVec2::from(centre) * mm, radius * mm, 0.0, std::f64::consts::TAU);
                return Ok(vec![circle.labelled(label)]);
            }
            _ if closed => {
                return Err(bad("a loop is either `points`, or `centre` and `radius` of a circle").into());
            }
            _ => return Err(bad("a line is `points`; a circle belongs to `loops`").into()),
        };
        let mut vertices = Vec::with_capacity(points.len());
        for (k, point) in points.iter().enumerate() {
            let (p, bulge, label, weight) = match point {
                PointEntry::Numbers(n) => match n[..] {
                    [x, y] => (DVec2::new(x, y), 0.0, None, None),
                    [x, y, bulge] => (DVec2::new(x, y), bulge, None, None),
                    _ => {
                        return Err(bad("a point is two coordinates, or three numbers with the bulge")
                            .value(n.len() as f64, "numbers")
                            .key(format!("[{k}]"))
                            .into());
                    }
                },
                PointEntry::Table(t) => (DVec2::new(t.x, t.y), t.bulge, t.label.as_ref(), t.weight),
            };
            check_weight(weight).map_err(|e| e.under(&format!("[{k}]")))?;
            let label = origin(format!("{place}[{k}]"), label, weight);
            vertices.push((p * mm, bulge, label));
        }
        if !closed {
            if vertices.len() < 2 {
                let finding = bad("a line has two points at least").value(vertices.len() as f64, "points");
                return Err(finding.bound(2.0, "points").into());
            }
            let edge = |w: &[(DVec2, f64, u32)]| OutlineEdge::bulge(w[0].0, w[1].0, w[0].1).labelled(w[0].2);
            return Ok(vertices.windows(2).map(edge).collect());
        }
        // Some writers give the first point again at the end.
        if vertices.len() > 1 && vertices[0].0 == vertices[vertices.len() - 1].0 {
            vertices.pop();
        }
        if vertices.is_empty() {
            return Err(bad("a loop has no points").into());
        }
        let next = |k: usize| vertices[(k + 1) % vertices.len()].0;
        let edge = |(k, &(p, bulge, label)): (usize, &(DVec2, f64, u32))| {
            OutlineEdge::bulge(p, next(k), bulge).labelled(label)
        };
        Ok(vertices.iter().enumerate().map(edge).collect())
    }
}

/// Reads an outline file.
pub(super) fn read_json(name: &str, bytes: &[u8], options: &OutlineOptions) -> Result<OutlineRead> {
    let source = Source::new(name, bytes);
    let text = source.text();
    let file: OutlineFile = serde_json::from_str(&text).map_err(|e| {
        let words = e.to_string();
        let words = words.split(" at line ").next().unwrap_or_default();
        let offset = source.offset_of_line(e.line()) + e.column().saturating_sub(1);
        crate::base::Error::from(
            source
                .error(offset, format!("the outline is not as it must be: {words}"))
                .help("see `kinecut schema outline`"),
        )
    })?;
    file.read(source, options)
}

fn check_weight(weight: Option<f64>) -> Result<()> {
    match weight {
        Some(w) if !(w >= 0.0 && w.is_finite()) => {
            Err(bad("a weight is negative or not finite").value(w, "").bound(0.0, "").into())
        }
        _ => Ok(()),
    }
}

fn bad(message: &str) -> Finding {
    Finding::error(Code::OUTLINE_FILE, message)
}

fn at(drawing: &Drawing, error: crate::base::Error, key: String) -> crate::base::Error {
    let mut error = if error.0.key.is_some() { error.under(&key) } else { error.0.key(key).into() };
    let place = drawing.source.file();
    let key = error.0.key.clone().unwrap_or_default();
    error.0.message = format!("{key}: {}", error.0.message);
    error.0.place = Some(place);
    error
}

#[cfg(test)]
mod tests;
