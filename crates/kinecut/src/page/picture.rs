//! A picture drawn shape by shape, in pixels: shapes in the inks of the page, a legend, and where wanted a motion
//! that a small script plays. Without the script the picture is complete.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::draw::{Colour, Ink, WIDTHS};
use super::px;
use super::{duration, visible};

/// A picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// Its name in the page, for links and for whoever cuts it out: letters, digits, hyphens.
    pub id: String,
    /// Subject of the picture.
    pub title: String,
    /// Shown next to the title.
    pub about: String,
    /// The picture in words.
    pub summary: String,
    /// Meanings of inks.
    pub legend: Vec<(Ink, String)>,
    /// Width and height, in pixels.
    pub size: [f64; 2],
    /// From the lowest to the topmost.
    pub shapes: Vec<Shape>,
    /// Remarks below.
    pub notes: Vec<String>,
    /// Motion in it.
    pub motion: Option<PictureMotion>,
}

/// Side of its point that a word is on.
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

/// Style of a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lettering {
    /// As a word of the picture.
    #[default]
    Word,
    /// As a number or name of an axis, which recedes.
    Tick,
    /// As a heading.
    Title,
    /// As the name of a thing, in its colour.
    Name(Colour),
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
        /// Place, in pixels.
        at: [f64; 2],
        /// Alignment at the place.
        anchor: Anchor,
        /// The word.
        text: String,
        /// Style of the word.
        lettering: Lettering,
    },
}

/// Motion in a picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PictureMotion {
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
        self.shapes.push(Shape::Word { at, anchor, text: text.into(), lettering: Lettering::Word });
    }

    /// A word of an axis.
    pub(crate) fn tick(&mut self, at: [f64; 2], anchor: Anchor, text: impl Into<String>) {
        self.shapes.push(Shape::Word { at, anchor, text: text.into(), lettering: Lettering::Tick });
    }
}

/// The picture as a figure.
pub(crate) fn figure(picture: &Picture) -> Markup {
    let [width, height] = picture.size;
    let id: String = picture.id.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    let id = (!id.is_empty()).then_some(id);
    html! {
        figure.picture.wide-picture[width > WIDTHS[0]] id=[id] {
            figcaption {
                b { (visible(&picture.title)) }
                @if !picture.about.is_empty() { span.axes { " " (visible(&picture.about)) } }
            }
            @if !picture.legend.is_empty() {
                ul.legend {
                    @for (ink, word) in &picture.legend { li { (sample(*ink)) (visible(word)) } }
                }
            }
            svg viewBox=(format!("0 0 {} {}", px(width), px(height))) width=(px(width)) height=(px(height)) role="img" aria-label=(visible(&picture.summary))
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

/// A drawing in each of the widths; the page shows the one that it has room for.
pub(crate) fn in_widths(draw: impl Fn(f64, &str) -> Markup) -> Markup {
    html! { @for (width, class) in WIDTHS.into_iter().zip(["wide", "narrow"]) { (draw(width, class)) } }
}

/// A sample of a look, for a legend.
pub(crate) fn sample(ink: Ink) -> Markup {
    html! { svg.sample viewBox="0 0 28 10" width="28" height="10" aria-hidden="true" { (mark(ink)) } }
}

/// The same as part of a drawing, 28 px by 10.
pub(crate) fn mark(ink: Ink) -> Markup {
    let class = ink.class();
    html! {
        @match ink {
            Ink::Line(..) | Ink::Halo => path class=(class) d="M1 5L27 5" {},
            Ink::Dot(_) | Ink::Ring(_) => circle class=(class) cx="14" cy="5" r="4" {},
            _ => path class=(class) d="M5 1H23V9H5Z" {},
        }
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
        Shape::Word { at, anchor, text, lettering } if finite(at) => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let class = match lettering {
                Lettering::Word => "word".to_owned(),
                Lettering::Tick => "tick".to_owned(),
                Lettering::Title => "title".to_owned(),
                Lettering::Name(colour) => format!("letter {}", colour.class()),
            };
            html! { text class=(class) x=(px(at[0])) y=(px(at[1])) text-anchor=(anchor) { (visible(text)) } }
        }
        _ => Markup::default(),
    }
}

fn way(motion: &PictureMotion) -> String {
    let one = |p: &[f64; 3]| format!("{} {} {:.3}", px(p[0]), px(p[1]), p[2]);
    motion.way.iter().filter(|p| p.iter().all(|v| v.is_finite())).map(one).collect::<Vec<_>>().join(" ")
}

/// Moving parts; hidden until the script shows them.
fn mover(motion: &PictureMotion) -> Markup {
    html! {
        g.p-mover visibility="hidden" {
            circle class=(Ink::Glass(Colour::Steel).class()) cx="0" cy="0" r=(px(motion.radius.abs())) {}
            circle class=(Ink::Area(Colour::Ink).class()) cx="0" cy="0" r="3" {}
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
