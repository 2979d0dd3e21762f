//! A picture that a planner draws itself, in pixels: shapes in the inks of the page, a legend, and where wanted a motion
//! that a small script plays. Without the script the picture stands complete.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::chart::px;
use super::plan::legend_sample;
use super::{duration, visible};

/// A picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// Its name in the page, for links and for whoever cuts it out: letters, digits, hyphens.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// Said beside the title.
    pub about: String,
    /// The picture in words.
    pub summary: String,
    /// What inks mean.
    pub legend: Vec<(Ink, String)>,
    /// Width and height, in pixels.
    pub size: [f64; 2],
    /// From the lowest to the topmost.
    pub shapes: Vec<Shape>,
    /// Remarks below.
    pub notes: Vec<String>,
    /// What moves in it.
    pub motion: Option<Motion>,
}

/// How a shape looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ink {
    /// An edge of which nothing is said.
    #[default]
    Edge,
    /// Teeth enter here.
    Entry,
    /// Teeth leave here, well.
    GoodExit,
    /// Teeth leave here, badly.
    BadExit,
    /// Teeth leave here badly, where it does not count.
    Excused,
    /// Not met, or lowered onto.
    Unmet,
    /// The material of a face.
    Face,
    /// The cutter.
    Cutter,
    /// The way of a tooth through the material.
    Tooth,
    /// The way of the cutter's centre.
    Way,
    /// A rapid link of that way.
    Link,
    /// A head of an arrow on it.
    Arrow,
    /// Lines of an axis.
    Grid,
    /// The border of a plot.
    Frame,
    /// A thing pointed at.
    Point,
    /// The best one.
    Best,
    /// Another one.
    Other,
    /// The one in use.
    Chosen,
    /// What a search that may fail came to.
    Baseline,
    /// What is not allowed.
    Forbidden,
    /// Measured: teeth enter.
    MeasuredEntry,
    /// Measured: teeth leave well.
    MeasuredGood,
    /// Measured: teeth leave badly.
    MeasuredBad,
    /// As measured, and otherwise than planned.
    Differing,
    /// A step of a scale, from 0, the least, to [`Ink::SHADES`] less one.
    Shade(u8),
    /// Surface of a tool that enters, by its shade from 0, the lightest, to 2.
    Enters(u8),
    /// Surface of a tool that leaves, by its shade.
    Leaves(u8),
    /// A segment of a grazing curve, by its kind from 0 to 7.
    Segment(u8),
    /// The same, hidden behind the tool.
    HiddenSegment(u8),
    /// A circle or surface that grazes as a whole.
    Grazes,
    /// The same, hidden behind the tool.
    HiddenGrazes,
    /// A fold of a grazing curve.
    Fold,
    /// The outline of a tool.
    Outline,
    /// A face of what a tool sweeps: its part (wall, start, end, inside) and its shade from 0, the lightest, to 7.
    Swept(u8, u8),
    /// A curve on it.
    Curve,
    /// The same, hidden.
    HiddenCurve,
    /// The outline of a tool that is elsewhere too.
    Phantom,
}

impl Ink {
    /// Steps of the scale.
    pub const SHADES: u8 = 16;

    pub(crate) fn class(self) -> String {
        let word = match self {
            Ink::Edge => "p-edge",
            Ink::Entry => "p-entry",
            Ink::GoodExit => "p-good",
            Ink::BadExit => "p-bad",
            Ink::Excused => "p-excused",
            Ink::Unmet => "p-unmet",
            Ink::Face => "p-face",
            Ink::Cutter => "p-cutter",
            Ink::Tooth => "p-tooth",
            Ink::Way => "p-way",
            Ink::Link => "p-link",
            Ink::Arrow => "p-arrow",
            Ink::Grid => "grid",
            Ink::Frame => "frame",
            Ink::Point => "p-point",
            Ink::Best => "p-best",
            Ink::Other => "p-other",
            Ink::Chosen => "p-chosen",
            Ink::Baseline => "p-baseline",
            Ink::Forbidden => "p-forbidden",
            Ink::MeasuredEntry => "p-measured p-entry-dot",
            Ink::MeasuredGood => "p-measured p-good-dot",
            Ink::MeasuredBad => "p-measured p-bad-dot",
            Ink::Differing => "p-differing",
            Ink::Shade(n) => return format!("p-m{}", n.min(Ink::SHADES - 1)),
            Ink::Enters(n) => return format!("g-in{}", n.min(2)),
            Ink::Leaves(n) => return format!("g-out{}", n.min(2)),
            Ink::Segment(n) => return format!("g-s{}", n.min(7)),
            Ink::HiddenSegment(n) => return format!("g-s{} g-hidden", n.min(7)),
            Ink::Grazes => "g-whole",
            Ink::HiddenGrazes => "g-whole g-hidden",
            Ink::Fold => "g-fold",
            Ink::Outline => "g-outline",
            Ink::Swept(part, n) => return format!("v-{}{}", part.min(3), n.min(7)),
            Ink::Curve => "e-curve",
            Ink::HiddenCurve => "e-hidden",
            Ink::Phantom => "e-phantom",
        };
        word.to_owned()
    }
}

/// On which side of its point a word stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Anchor {
    /// It begins there.
    #[default]
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A shape of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// Lines, arcs, areas.
    Path {
        /// Look.
        ink: Ink,
        /// The data of an SVG path.
        d: String,
        /// While the motion plays, shown from this time on [s].
        from: Option<f64>,
    },
    /// A circle.
    Circle {
        /// Look.
        ink: Ink,
        /// Centre, in pixels.
        centre: [f64; 2],
        /// Radius, in pixels.
        radius: f64,
    },
    /// A word.
    Word {
        /// Where, in pixels.
        at: [f64; 2],
        /// How it stands there.
        anchor: Anchor,
        /// The word.
        text: String,
        /// Whether it belongs to an axis and stands back.
        quiet: bool,
    },
}

/// What moves in a picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Places of the centre, in pixels, and their times [s], ascending.
    pub way: Vec<[f64; 3]>,
    /// Radius of the circle that moves, in pixels.
    pub radius: f64,
    /// In the report of a job: the program's time at 0, and its whole time [s]; the picture then follows the page's cursor.
    pub program: Option<[f64; 2]>,
}

impl Picture {
    /// A path.
    pub(crate) fn path(&mut self, ink: Ink, d: impl Into<String>) {
        let d = d.into();
        if !d.is_empty() {
            self.shapes.push(Shape::Path { ink, d, from: None });
        }
    }

    /// A circle.
    pub(crate) fn circle(&mut self, ink: Ink, centre: [f64; 2], radius: f64) {
        self.shapes.push(Shape::Circle { ink, centre, radius });
    }

    /// A word.
    pub(crate) fn word(&mut self, at: [f64; 2], anchor: Anchor, text: impl Into<String>) {
        self.shapes.push(Shape::Word { at, anchor, text: text.into(), quiet: false });
    }

    /// A word of an axis.
    pub(crate) fn tick(&mut self, at: [f64; 2], anchor: Anchor, text: impl Into<String>) {
        self.shapes.push(Shape::Word { at, anchor, text: text.into(), quiet: true });
    }
}

/// The picture as a figure.
pub(crate) fn figure(picture: &Picture) -> Markup {
    let [width, height] = picture.size;
    let id: String = picture.id.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    let id = (!id.is_empty()).then_some(id);
    html! {
        figure.picture id=[id] {
            figcaption {
                b { (visible(&picture.title)) }
                @if !picture.about.is_empty() { span.axes { " " (visible(&picture.about)) } }
            }
            @if !picture.legend.is_empty() {
                ul.legend {
                    @for (ink, word) in &picture.legend { li { (sample(*ink)) (visible(word)) } }
                }
            }
            svg viewBox=(format!("0 0 {} {}", px(width), px(height))) role="img" aria-label=(visible(&picture.summary))
                data-way=[picture.motion.as_ref().map(way)]
                data-program=[picture.motion.as_ref().and_then(|m| m.program).map(|[from, all]| format!("{from} {all}"))] {
                @for shape in &picture.shapes { (drawn(shape)) }
                @if let Some(motion) = &picture.motion { (mover(motion)) }
            }
            @if let Some(end) = picture.motion.as_ref().and_then(|m| m.way.last()) { (player(end[2])) }
            @for note in &picture.notes { p.remark { (visible(note)) } }
        }
    }
}

pub(crate) fn sample(ink: Ink) -> Markup {
    let dot = matches!(ink, Ink::Point | Ink::Best | Ink::Other | Ink::Chosen | Ink::Baseline | Ink::Fold);
    let area = matches!(
        ink,
        Ink::Face
            | Ink::Cutter
            | Ink::Forbidden
            | Ink::Shade(_)
            | Ink::Enters(_)
            | Ink::Leaves(_)
            | Ink::Swept(..)
    );
    let class = ink.class();
    html! {
        @if dot || area {
            svg.sample viewBox="0 0 16 10" width="16" height="10" aria-hidden="true" {
                @if dot { circle class=(class) cx="8" cy="5" r="4" {} }
                @else { path class=(class) d="M1 1H15V9H1Z" {} }
            }
        } @else { (legend_sample(&class)) }
    }
}

pub(crate) fn drawn(shape: &Shape) -> Markup {
    let finite = |p: &[f64; 2]| p[0].is_finite() && p[1].is_finite();
    match shape {
        Shape::Path { ink, d, from } => {
            html! { path class=(ink.class()) d=(d) data-t=[from.map(|t| format!("{t:.3}"))] {} }
        }
        Shape::Circle { ink, centre, radius } if finite(centre) && radius.is_finite() => {
            html! { circle class=(ink.class()) cx=(px(centre[0])) cy=(px(centre[1])) r=(px(radius.abs())) {} }
        }
        Shape::Word { at, anchor, text, quiet } if finite(at) => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let class = if *quiet { "tick" } else { "word" };
            html! { text class=(class) x=(px(at[0])) y=(px(at[1])) text-anchor=(anchor) { (visible(text)) } }
        }
        _ => Markup::default(),
    }
}

fn way(motion: &Motion) -> String {
    let one = |p: &[f64; 3]| format!("{} {} {:.3}", px(p[0]), px(p[1]), p[2]);
    motion.way.iter().filter(|p| p.iter().all(|v| v.is_finite())).map(one).collect::<Vec<_>>().join(" ")
}

/// What moves; hidden until the script shows it.
fn mover(motion: &Motion) -> Markup {
    html! {
        g.p-mover visibility="hidden" {
            circle.p-cutter cx="0" cy="0" r=(px(motion.radius.abs())) {}
            circle.p-point cx="0" cy="0" r="3" {}
        }
    }
}

fn player(end: f64) -> Markup {
    html! {
        div.player.p-player role="group" aria-label="Playback of this picture" {
            button type="button" aria-label="Play" { "▶" }
            input type="range" min="0" max="1000" value="1000" step="1" aria-label="Time";
            output { (duration(end)) }
        }
    }
}
