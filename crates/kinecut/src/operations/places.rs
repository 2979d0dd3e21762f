//! Places of holes: a list, or a pattern of rows, of a circle, of a line.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, Finding, Result};

/// Most holes of an operation: a run with 40 000 of them takes 1.4 GB, 34 kB each, so that these keep within 2 GB.
const MOST_HOLES: usize = 50_000;

/// The place of a hole, in coordinates of the work offset [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HolePlace {
    /// X and Y.
    pub at: [f64; 2],
}

/// Places of holes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PatternTable {
    /// Rows and columns, drilled to and fro.
    Grid(GridTable),
    /// On a circle.
    Circle(CircleTable),
    /// On a line.
    Line(LineTable),
}

/// Rows and columns of holes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridTable {
    /// Place of the first hole.
    #[schemars(example = vec![0, 0])]
    pub at: [f64; 2],
    /// Distances of columns and rows.
    #[schemars(example = vec![20, 20])]
    pub step: [f64; 2],
    /// Numbers of columns and rows.
    #[schemars(example = vec![3, 2])]
    pub count: [u32; 2],
    /// Direction of the rows from X, degrees; default 0.
    #[serde(default)]
    pub angle: f64,
}

/// Holes on a circle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircleTable {
    /// Centre.
    #[schemars(example = vec![0, 0])]
    pub at: [f64; 2],
    /// Diameter.
    #[schemars(example = 60)]
    pub diameter: f64,
    /// Number of holes.
    #[schemars(example = 6)]
    pub count: u32,
    /// Direction of the first hole from X, degrees; default 0.
    #[serde(default)]
    pub start_angle: f64,
    /// Angle between neighbours, degrees; default: all round.
    #[serde(default)]
    pub step_angle: Option<f64>,
}

/// Holes on a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineTable {
    /// Place of the first hole.
    #[schemars(example = vec![0, 0])]
    pub at: [f64; 2],
    /// Distance of neighbours.
    #[schemars(example = 20)]
    pub step: f64,
    /// Number of holes.
    #[schemars(example = 4)]
    pub count: u32,
    /// Direction from X, degrees; default 0.
    #[serde(default)]
    pub angle: f64,
}

/// The places of a list or a pattern.
///
/// # Errors
/// One finding with the key `points` or `pattern`: both or none is given, or one of their values is out of range.
pub(crate) fn places(points: Option<&[[f64; 2]]>, pattern: Option<&PatternTable>) -> Result<Vec<HolePlace>> {
    let (key, places) = match (points, pattern) {
        (Some(points), None) => ("points", points.to_vec()),
        (None, Some(pattern)) => ("pattern", of_pattern(pattern).map_err(|e| e.under("pattern"))?),
        _ => {
            let finding = Finding::error(Code::JOB_SHAPE, "the holes need `points` or a `pattern`");
            return Err(finding
                .help("give points = [[0, 0], [40, 0]] (mm), or a pattern")
                .key("points")
                .into());
        }
    };
    let count = places.len();
    if count == 0 || count > MOST_HOLES {
        return Err(Finding::error(Code::JOB_VALUE, "the number of holes is out of range")
            .value(count as f64, "")
            .bound(if count == 0 { 1.0 } else { MOST_HOLES as f64 }, "")
            .key(key)
            .into());
    }
    for (i, p) in places.iter().enumerate() {
        for (k, v) in p.iter().enumerate() {
            let key = if key == "points" { format!("points[{i}][{k}]") } else { key.to_owned() };
            length(&key, *v, -MAX_LENGTH, MAX_LENGTH)?;
        }
    }
    Ok(places.into_iter().map(|at| HolePlace { at }).collect())
}

fn of_pattern(pattern: &PatternTable) -> Result<Vec<[f64; 2]>> {
    let count = |key: &str, n: u32| -> Result<u32> {
        if (1..=MOST_HOLES as u32).contains(&n) {
            return Ok(n);
        }
        Err(Finding::error(Code::JOB_VALUE, "the number of holes is out of range")
            .value(f64::from(n), "")
            .bound(if n == 0 { 1.0 } else { MOST_HOLES as f64 }, "")
            .key(key)
            .into())
    };
    let at = |from: [f64; 2], angle: f64, along: f64, across: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        [from[0] + along * cos - across * sin, from[1] + along * sin + across * cos]
    };
    Ok(match pattern {
        PatternTable::Grid(g) => {
            let (columns, rows) = (count("grid.count", g.count[0])?, count("grid.count", g.count[1])?);
            if u64::from(columns) * u64::from(rows) > MOST_HOLES as u64 {
                count("grid.count", u32::MAX)?;
            }
            let places = (0..rows).flat_map(|row| {
                // To and fro: the shortest way that a person expects.
                (0..columns).map(move |i| (if row % 2 == 0 { i } else { columns - 1 - i }, row))
            });
            places
                .map(|(i, row)| at(g.at, g.angle, g.step[0] * f64::from(i), g.step[1] * f64::from(row)))
                .collect()
        }
        PatternTable::Circle(c) => {
            positive("circle.diameter", c.diameter, MAX_LENGTH, "mm")?;
            let n = count("circle.count", c.count)?;
            let step = c.step_angle.unwrap_or(360.0 / f64::from(n));
            bounded("circle.step_angle", step, -360.0, 360.0, "deg")?;
            bounded("circle.start_angle", c.start_angle, -360.0, 360.0, "deg")?;
            (0..n).map(|i| at(c.at, c.start_angle + step * f64::from(i), c.diameter / 2.0, 0.0)).collect()
        }
        PatternTable::Line(l) => {
            let n = count("line.count", l.count)?;
            (0..n).map(|i| at(l.at, l.angle, l.step * f64::from(i), 0.0)).collect()
        }
    })
}
