//! The page of the verb, and the picture as a file of its own.

use maud::{Markup, PreEscaped, html};

use super::style::{file_style, page_style};
use super::tables::{degenerate, entering, facts, loops, motion_lines, spans};
use super::{plane, tool};
use crate::page::chart::px;
use crate::page::picture::{Ink, Picture, drawn};
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Section, visible};
use crate::verbs::grazing::GrazingSheet;

/// What a page of this verb does not replace.
pub(crate) const CAUTION: &str =
    "The grazing curve is that of one moment; what a move sweeps is the envelope of them all.";

/// The page of one sheet, or of several.
pub fn grazing_html(sheets: &[&GrazingSheet]) -> String {
    let title = match sheets {
        [one] if !one.title.is_empty() => one.title.clone(),
        [_] => "Grazing curve".to_owned(),
        _ => format!("{} grazing curves", sheets.len()),
    };
    let sections: Vec<Section> = sheets.iter().enumerate().map(|(i, s)| section(s, Some(i))).collect();
    VerbPage {
        maker: "kinecut grazing",
        title: &title,
        style: &page_style(),
        moves: false,
        caution: CAUTION,
        sections: &sections,
        figures: &[],
    }
    .html()
}

/// The sheet in words and numbers; with its pictures and findings on a page, where it has a number.
pub(crate) fn section(sheet: &GrazingSheet, on_page: Option<usize>) -> Section {
    let title = if sheet.title.is_empty() { "Grazing curve" } else { &sheet.title };
    let mut section = Section::new(title).with(Block::Facts(facts(sheet)));
    let mut lines: Vec<String> = motion_lines(sheet);
    lines.extend(sheet.notes.iter().cloned());
    lines.extend(degenerate(sheet));
    if on_page.is_some() {
        lines.extend(sheet.findings.iter().map(|f| format!("{}: {f}", f.code)));
    }
    section.blocks.push(Block::List(lines.iter().map(|l| sentence(l)).collect()));
    if let Some(number) = on_page {
        section.blocks.extend(pictures(sheet, &format!("grazing-{}", number + 1)).map(Block::from));
    }
    if !sheet.loops.is_empty() {
        section.blocks.push(loops(sheet).into());
        section.blocks.push(spans(sheet).into());
    }
    section.with(entering(sheet))
}

/// The tool and the parameter plane.
pub(crate) fn pictures(sheet: &GrazingSheet, id: &str) -> [Picture; 2] {
    [
        tool::figure(sheet, &format!("{id}-tool"), "The tool with its curve"),
        plane::figure(sheet, &format!("{id}-plane"), "The parameter plane"),
    ]
}

/// With a capital and a full stop.
pub(crate) fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    let first: String = chars.next().into_iter().flat_map(char::to_uppercase).collect();
    let rest = chars.as_str();
    format!("{first}{rest}{}", if rest.ends_with('.') { "" } else { "." })
}

/// Room around and between pictures, height of the title and of a line of the legend [px].
const ROOM: f64 = 14.0;
const TITLE: f64 = 30.0;
const LINE: f64 = 18.0;
/// Width of a sample and mean width of a letter [px].
const SAMPLE: f64 = 30.0;
const LETTER: f64 = 6.2;

/// Both pictures beside each other as an SVG file.
pub fn grazing_svg(sheet: &GrazingSheet) -> String {
    let title = if sheet.title.is_empty() { "Grazing curve" } else { &sheet.title };
    picture_file(title, &pictures(sheet, "grazing"), "")
}

/// Pictures beside each other with one legend as an SVG file; `style` are rules beside those of grazing curves.
pub(crate) fn picture_file(title: &str, pictures: &[Picture], style: &str) -> String {
    let width = pictures.iter().map(|p| p.size[0] + ROOM).sum::<f64>() + ROOM;
    let mut words: Vec<(Ink, String)> = Vec::new();
    for (ink, word) in pictures.iter().flat_map(|p| &p.legend) {
        if !words.iter().any(|w| w.1 == *word) {
            words.push((*ink, word.clone()));
        }
    }
    let mut places = Vec::new();
    let (mut x, mut y) = (ROOM, ROOM + TITLE);
    for (ink, word) in &words {
        let wide = SAMPLE + 6.0 + LETTER * word.chars().count() as f64 + 14.0;
        if x + wide > width - ROOM && x > ROOM {
            x = ROOM;
            y += LINE;
        }
        places.push((*ink, word, [x, y]));
        x += wide;
    }
    let top = y + LINE;
    let height = top + pictures.iter().map(|p| p.size[1]).fold(0.0, f64::max) + ROOM;
    let mut left = ROOM;
    let groups: Vec<(f64, &Picture)> = pictures
        .iter()
        .map(|p| {
            let at = left;
            left += p.size[0] + ROOM;
            (at, p)
        })
        .collect();
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {} {}", px(width), px(height))) width=(px(width)) height=(px(height)) role="img" aria-label=(visible(title)) {
            style { (PreEscaped(file_style())) (PreEscaped(style)) }
            g.gz {
                rect.paper x="0" y="0" width=(px(width)) height=(px(height)) {}
                text.title x=(px(ROOM)) y=(px(ROOM + 12.0)) { (visible(title)) }
                @for (ink, word, at) in &places { (sample(*ink, *at)) text.word x=(px(at[0] + SAMPLE + 6.0)) y=(px(at[1])) { (visible(word)) } }
                @for (at, picture) in &groups {
                    g transform=(format!("translate({} {})", px(*at), px(top))) { @for shape in &picture.shapes { (drawn(shape)) } }
                }
            }
        }
    }
    .into_string()
}

fn sample(ink: Ink, at: [f64; 2]) -> Markup {
    let (x, y) = (at[0], at[1] - 4.0);
    let class = ink.class();
    html! {
        @match ink {
            Ink::Fold => circle class=(class) cx=(px(x + 0.5 * SAMPLE)) cy=(px(y)) r="3.6" {},
            Ink::Enters(_) | Ink::Leaves(_) | Ink::Swept(..) => path class=(class) d=(format!("M{} {}h16v9h-16Z", px(x + 7.0), px(y - 4.5))) {},
            _ => path class=(class) d=(format!("M{} {}h{}", px(x), px(y), px(SAMPLE))) {},
        }
    }
}
