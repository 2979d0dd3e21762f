//! The building blocks of a section: text, facts, charts, plans.

use serde::{Deserialize, Serialize};

use super::{Colour, Drawing, Fact, Ink, Picture, Table, Width, serde_gap};

/// A part of the report with its own heading.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Shown from top to bottom; neighbouring charts and plans stand side by side where the page is wide enough.
    pub blocks: Vec<Block>,
}

impl Section {
    /// An empty section.
    pub fn new(title: impl Into<String>) -> Section {
        Section { title: title.into(), blocks: Vec::new() }
    }

    /// With one more block.
    #[must_use]
    pub fn with(mut self, block: impl Into<Block>) -> Section {
        self.blocks.push(block.into());
        self
    }
}

/// One thing in a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Block {
    /// A heading inside the section.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A row of facts.
    Facts(Vec<Fact>),
    /// A list of sentences.
    List(Vec<String>),
    /// A table.
    Table(Table),
    /// A chart.
    Chart(Chart),
    /// A path to scale.
    Plan(Plan),
    /// A drawing to scale, with dimension lines.
    Drawing(Drawing),
    /// A picture drawn shape by shape.
    Picture(Picture),
}

impl From<Table> for Block {
    fn from(table: Table) -> Block {
        Block::Table(table)
    }
}

impl From<Chart> for Block {
    fn from(chart: Chart) -> Block {
        Block::Chart(chart)
    }
}

impl From<Plan> for Block {
    fn from(plan: Plan) -> Block {
        Block::Plan(plan)
    }
}

impl From<Drawing> for Block {
    fn from(drawing: Drawing) -> Block {
        Block::Drawing(drawing)
    }
}

impl From<Picture> for Block {
    fn from(picture: Picture) -> Block {
        Block::Picture(picture)
    }
}

/// Meaning of a chart's x axis for the one cursor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Follows {
    /// Nothing: the chart has no cursor.
    #[default]
    Nothing,
    /// Time from the start of the program [s].
    Time,
    /// Length of path from the start of the program [mm].
    Length,
}

/// A line chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Subject of the chart.
    pub title: String,
    /// Name of x.
    pub x: String,
    /// Unit of x.
    pub x_unit: String,
    /// Name of y.
    pub y: String,
    /// Unit of y.
    pub y_unit: String,
    /// The curves.
    pub series: Vec<Series>,
    /// Vertical lines with a word.
    pub marks: Vec<Label>,
    /// Horizontal lines with a word: limits, wanted values.
    pub levels: Vec<LevelLine>,
    /// Meaning of x for the cursor; x then starts at `follows_from`.
    pub follows: Follows,
    /// Program time [s] or length [mm] at x = 0.
    pub follows_from: f64,
}

impl Chart {
    /// An empty chart: title, then name and unit of x and y.
    pub fn new(title: &str, x: (&str, &str), y: (&str, &str)) -> Chart {
        Chart {
            title: title.to_owned(),
            x: x.0.to_owned(),
            x_unit: x.1.to_owned(),
            y: y.0.to_owned(),
            y_unit: y.1.to_owned(),
            ..Chart::default()
        }
    }

    /// With one more curve.
    #[must_use]
    pub fn series(mut self, name: impl Into<String>, points: Vec<[f64; 2]>) -> Chart {
        self.series.push(Series { name: name.into(), points });
        self
    }

    /// With a vertical line.
    #[must_use]
    pub fn mark(mut self, at: f64, text: impl Into<String>) -> Chart {
        self.marks.push(Label { at, text: text.into() });
        self
    }

    /// With a horizontal line.
    #[must_use]
    pub fn level(mut self, at: f64, text: impl Into<String>) -> Chart {
        self.levels.push(LevelLine { at, text: text.into() });
        self
    }

    /// With a cursor: x = 0 is the program's time [s] or length [mm] `from`.
    #[must_use]
    pub fn follows(mut self, follows: Follows, from: f64) -> Chart {
        self.follows = follows;
        self.follows_from = from;
        self
    }
}

/// A curve of a chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// (x, y); a NaN (`null` in JSON) breaks the curve.
    #[serde(with = "serde_gap::points")]
    pub points: Vec<[f64; 2]>,
}

/// A vertical line in a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// x.
    pub at: f64,
    /// The word.
    pub text: String,
}

/// A horizontal line in a chart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelLine {
    /// y.
    pub at: f64,
    /// The word.
    pub text: String,
}

/// A drawing to scale, seen along an axis; x to the right, y upwards [mm].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Subject of the plan.
    pub title: String,
    /// Name of the axis to the right.
    pub x: String,
    /// Name of the axis upwards.
    pub y: String,
    /// Paths.
    pub lines: Vec<PlanLine>,
    /// Circles.
    pub circles: Vec<Circle>,
    /// Points with a word.
    pub points: Vec<([f64; 2], String)>,
}

impl Plan {
    /// An empty plan in X and Y.
    pub fn new(title: impl Into<String>) -> Plan {
        Plan { title: title.into(), x: "X".to_owned(), y: "Y".to_owned(), ..Plan::default() }
    }
}

/// A path in a plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanLine {
    /// Look.
    pub ink: Ink,
    /// Word of the legend.
    pub name: String,
    /// Line of the program, from 0, if a click is to find it.
    pub block: Option<u32>,
    /// The polyline [mm]; a NaN (`null` in JSON) breaks it.
    #[serde(with = "serde_gap::points")]
    pub points: Vec<[f64; 2]>,
}

impl PlanLine {
    /// A line without a link.
    pub fn new(ink: Ink, name: impl Into<String>, points: Vec<[f64; 2]>) -> PlanLine {
        PlanLine { ink, name: name.into(), block: None, points }
    }
}

/// A circle in a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Circle {
    /// Centre [mm].
    pub centre: [f64; 2],
    /// Radius [mm].
    pub radius: f64,
    /// Ink of the line.
    pub ink: Ink,
    /// Word beside it; may be empty.
    pub text: String,
}

impl Default for Circle {
    fn default() -> Circle {
        Circle {
            centre: [0.0; 2],
            radius: 0.0,
            ink: Ink::line(Colour::Ink, Width::Middle),
            text: String::new(),
        }
    }
}
