//! A drawing to scale as a draughtsman makes it: outlines, hatched sections, dimension lines, angles, marked places.
//!
//! For the pictures of tools and of holes, and for whoever else has a section to show. The drawing is plain data in mm;
//! [`layout`](self) places dimension lines in lanes and words in a column, so that nothing lies on anything else, and
//! `figure` draws it as SVG in the colours of the page. x runs to the right, y upwards.
//!
//! In a text, `_` lowers what follows it up to the next blank: `L_vr1`.

mod figure;
mod hatch;
mod lanes;
mod layout;
mod words;

pub(crate) use figure::figure;

use serde::{Deserialize, Serialize};

use super::{Colour, Dash, Ink, Width, serde_gap};

/// A drawing to scale [mm].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Subject of the drawing.
    pub title: String,
    /// Sentences below it.
    pub notes: Vec<String>,
    /// Lower left and upper right corner of what is shown; lines that reach beyond are cut there.
    pub window: [[f64; 2]; 2],
    /// Stretches of y that are left out, each drawn as a break: from, to.
    pub breaks: Vec<[f64; 2]>,
    /// Closed outlines of hatched sections; one within another is a hole in it.
    pub hatched: Vec<Vec<[f64; 2]>>,
    /// Lines.
    pub strokes: Vec<Stroke>,
    /// Dimension lines.
    pub spans: Vec<Dimension>,
    /// Angles.
    pub angles: Vec<Angle>,
    /// Places with words.
    pub callouts: Vec<Callout>,
}

/// Style of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Look {
    /// A visible edge.
    #[default]
    Edge,
    /// A thin line.
    Thin,
    /// An axis.
    Axis,
    /// Parts that are gone, or lie behind.
    Hidden,
    /// First of up to four things told apart.
    First,
    /// Second.
    Second,
    /// Third.
    Third,
    /// Fourth.
    Fourth,
}

/// A line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Style of the line.
    pub look: Look,
    /// Name in the legend; may be empty.
    pub name: String,
    /// The polyline; a NaN (`null` in JSON) breaks it.
    #[serde(with = "serde_gap::points")]
    pub points: Vec<[f64; 2]>,
}

/// Place of a dimension line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Along {
    /// Upright, left of the drawing: measures y.
    #[default]
    Left,
    /// Level, above it: measures x.
    Above,
    /// Level, below it: measures x.
    Below,
    /// Along the line itself, beside it.
    Line,
}

/// A dimension line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dimension {
    /// One end of what is measured.
    pub from: [f64; 2],
    /// The other end.
    pub to: [f64; 2],
    /// Place of the line.
    pub along: Along,
    /// Name and value.
    pub text: String,
}

/// An angle between two directions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Angle {
    /// Its corner.
    pub at: [f64; 2],
    /// Direction of one side, counterclockwise from x [rad].
    pub from: f64,
    /// Direction of the other, greater than `from`.
    pub to: f64,
    /// Radius of the arc [mm].
    pub radius: f64,
    /// Name and value.
    pub text: String,
}

/// A place with words beside the drawing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Callout {
    /// The place.
    pub at: [f64; 2],
    /// Whether it is a point to see, not only a height.
    pub point: bool,
    /// The words, line by line.
    pub lines: Vec<String>,
}

impl Drawing {
    /// An empty drawing of a window.
    pub fn new(title: impl Into<String>, window: [[f64; 2]; 2]) -> Drawing {
        Drawing { title: title.into(), window, ..Drawing::default() }
    }

    /// A line without a name.
    pub(crate) fn line(&mut self, look: Look, points: Vec<[f64; 2]>) {
        self.strokes.push(Stroke { look, name: String::new(), points });
    }

    /// A dimension line.
    pub(crate) fn span(&mut self, along: Along, from: [f64; 2], to: [f64; 2], text: impl Into<String>) {
        self.spans.push(Dimension { from, to, along, text: text.into() });
    }

    /// Words for a height.
    pub(crate) fn level(&mut self, at: [f64; 2], lines: Vec<String>) {
        self.callouts.push(Callout { at, point: false, lines });
    }

    /// Words for a point.
    pub(crate) fn point(&mut self, at: [f64; 2], lines: Vec<String>) {
        self.callouts.push(Callout { at, point: true, lines });
    }
}

impl Look {
    /// Ink of the line.
    pub(crate) fn ink(self) -> Ink {
        match self {
            Look::Edge => Ink::line(Colour::Ink, Width::Thin),
            Look::Thin => Ink::line(Colour::Ink, Width::Hair),
            Look::Axis => Ink::Line(Colour::Quiet, Width::Hair, Dash::Chain),
            Look::Hidden => Ink::Line(Colour::Quiet, Width::Fine, Dash::Hidden),
            Look::First => Ink::series(0),
            Look::Second => Ink::series(1),
            Look::Third => Ink::series(2),
            Look::Fourth => Ink::series(3),
        }
    }
}
