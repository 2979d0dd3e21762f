//! Pictures as SVG files of their own, in their own colours.

use maud::{Markup, PreEscaped, html};

use super::{Ink, palette, rules, width as letters};
use crate::page::picture::{Picture, drawn, mark};
use crate::page::px;
use crate::page::visible;

/// Room around and between pictures, height of the title and of a line of words [px].
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

/// Pictures under a title, with one legend, as a file: `columns` beside each other, each with what it shows.
pub(crate) fn sheet(title: &str, pictures: &[Picture], columns: usize) -> String {
    let columns = columns.clamp(1, pictures.len().max(1));
    let wide = pictures.iter().map(|p| p.size[0]).fold(0.0, f64::max);
    let width = ROOM + columns as f64 * (wide + ROOM);
    let (legend, mut y) = legend(pictures, width);
    let mut groups = Vec::new();
    for row in pictures.chunks(columns) {
        let words = row.iter().map(|p| lines(title, p).len()).max().unwrap_or(0);
        let top = y + LINE * words as f64;
        for (i, picture) in row.iter().enumerate() {
            let x = ROOM + i as f64 * (wide + ROOM);
            groups.push((picture, [x + 0.5 * (wide - picture.size[0]), top], [x, y]));
        }
        y = top + row.iter().map(|p| p.size[1]).fold(0.0, f64::max) + ROOM;
    }
    let [width, height] = [width, y].map(px);
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img" aria-label=(visible(title)) {
            style { (PreEscaped(palette::of_file())) (PreEscaped(LETTERS)) (PreEscaped(rules())) }
            g.picture {
                rect.paper x="0" y="0" width=(width) height=(height) {}
                text.title x=(px(ROOM)) y=(px(ROOM + 12.0)) { (visible(title)) }
                @for (ink, word, at) in legend {
                    g transform=(format!("translate({} {})", px(at[0]), px(at[1] - 9.0))) { (mark(ink)) }
                    text.word x=(px(at[0] + MARK)) y=(px(at[1])) { (visible(word)) }
                }
                @for (picture, at, words) in groups {
                    @for (i, (text, class)) in lines(title, picture).into_iter().enumerate() {
                        text class=(class) x=(px(words[0])) y=(px(words[1] + LINE * i as f64 + 12.0)) { (visible(text)) }
                    }
                    g transform=(format!("translate({} {})", px(at[0]), px(at[1]))) { (content(picture)) }
                }
            }
        }
    }
    .into_string()
}

fn content(picture: &Picture) -> Markup {
    html! { @for shape in &picture.shapes { (drawn(shape)) } }
}

/// The words above a picture with their classes: its title where it is not the sheet's, and what else is said of it.
fn lines<'a>(title: &str, picture: &'a Picture) -> Vec<(&'a str, &'static str)> {
    let own = if picture.title == title { "" } else { picture.title.as_str() };
    [(own, "title"), (picture.about.as_str(), "tick")]
        .into_iter()
        .filter(|(text, _)| !text.is_empty())
        .collect()
}

/// A look with its word and its place [px].
type Entry<'a> = (Ink, &'a str, [f64; 2]);

/// Each look of the pictures once, with its word and its place, and where the pictures begin [px].
fn legend(pictures: &[Picture], width: f64) -> (Vec<Entry<'_>>, f64) {
    let (mut x, mut y) = (ROOM, ROOM + TITLE);
    let mut legend: Vec<Entry<'_>> = Vec::new();
    for (ink, word) in pictures.iter().flat_map(|p| &p.legend) {
        if legend.iter().any(|l| l.1 == word) {
            continue;
        }
        let wide = MARK + letters(word) + BEHIND;
        if x + wide > width - ROOM && x > ROOM {
            (x, y) = (ROOM, y + LINE);
        }
        legend.push((*ink, word, [x, y]));
        x += wide;
    }
    let top = if legend.is_empty() { ROOM + TITLE - 6.0 } else { y + LINE };
    (legend, top)
}
