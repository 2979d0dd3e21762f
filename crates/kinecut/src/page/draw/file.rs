//! Pictures as SVG files of their own, in their own colours.

use maud::{Markup, PreEscaped, html};

use super::{Ink, palette, rules};
use crate::page::chart::{CHARACTER, px};
use crate::page::picture::{Picture, drawn, mark};
use crate::page::visible;

/// Room around and between pictures, height of the title and of a line of the legend [px].
const ROOM: f64 = 14.0;
const TITLE: f64 = 30.0;
const LINE: f64 = 18.0;
/// Room of a mark of the legend, and behind its word [px].
const MARK: f64 = 36.0;
const BEHIND: f64 = 14.0;
/// Letters that a page gives its pictures.
const LETTERS: &str = "\
text{font-family:\"Segoe UI\",Roboto,\"Noto Sans\",system-ui,sans-serif;font-size:11px;fill:var(--quiet)}text.word{fill:var(--ink)}\
.paper{fill:var(--panel)}";

/// A drawing of a size [px] as a file.
pub(crate) fn file(size: [f64; 2], summary: &str, body: &Markup) -> String {
    let [width, height] = size.map(px);
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img" aria-label=(visible(summary)) {
            style { (PreEscaped(palette::of_file())) (PreEscaped(LETTERS)) (PreEscaped(rules())) }
            g.picture {
                rect.paper x="0" y="0" width=(width) height=(height) {}
                (body)
            }
        }
    }
    .into_string()
}

/// Pictures beside each other under a title, with one legend, as a file.
pub(crate) fn sheet(title: &str, pictures: &[Picture]) -> String {
    let width = pictures.iter().map(|p| p.size[0] + ROOM).sum::<f64>() + ROOM;
    let mut words: Vec<(Ink, &str)> = Vec::new();
    for (ink, word) in pictures.iter().flat_map(|p| &p.legend) {
        if !words.iter().any(|w| w.1 == word) {
            words.push((*ink, word));
        }
    }
    let (mut x, mut y) = (ROOM, ROOM + TITLE);
    let mut legend = Vec::new();
    for (ink, word) in words {
        let wide = MARK + CHARACTER * word.chars().count() as f64 + BEHIND;
        if x + wide > width - ROOM && x > ROOM {
            (x, y) = (ROOM, y + LINE);
        }
        legend.push((ink, word, [x, y]));
        x += wide;
    }
    let top = y + LINE;
    let height = top + pictures.iter().map(|p| p.size[1]).fold(0.0, f64::max) + ROOM;
    let left = |i: usize| ROOM + pictures[..i].iter().map(|p| p.size[0] + ROOM).sum::<f64>();
    let body = html! {
        text.title x=(px(ROOM)) y=(px(ROOM + 12.0)) { (visible(title)) }
        @for (ink, word, at) in legend {
            g transform=(format!("translate({} {})", px(at[0]), px(at[1] - 9.0))) { (mark(ink)) }
            text.word x=(px(at[0] + MARK)) y=(px(at[1])) { (visible(word)) }
        }
        @for (i, picture) in pictures.iter().enumerate() {
            g transform=(format!("translate({} {})", px(left(i)), px(top))) { @for shape in &picture.shapes { (drawn(shape)) } }
        }
    };
    file([width, height], title, &body)
}
