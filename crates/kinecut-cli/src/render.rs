//! Findings as a person reads them on a terminal: the source line with the place marked, value, bound and help.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use kinecut::base::{Finding, Severity};
use kinecut::page::terminal;

use crate::show::Shown;

/// The finding as text. Control characters of outside texts are escaped.
pub(crate) fn finding(f: &Finding, colour: bool) -> Shown {
    let level = match f.severity {
        Severity::Error => Level::ERROR,
        Severity::Doubt => Level::WARNING.with_name(Severity::Doubt.word()),
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let clean = |text: &str| escape(text);
    let mut bare = f.clone();
    bare.place = None;
    bare.help = String::new();
    let title = clean(&bare.to_string());
    let title = level.primary_title(title).id(f.code.as_str());
    let help = clean(&f.help);
    let mut group = match &f.place {
        Some(place) if place.line > 0 => {
            let line = clean(&place.text);
            // Byte offset of the column in the cleaned line; the mark ends with the line at the latest.
            let start: usize =
                place.text.chars().take(place.column as usize - 1).map(|c| escape_char(c).len()).sum();
            let length = (place.end.saturating_sub(place.start) as usize).max(1);
            let end = (start + length).min(line.len()).max(start);
            let end = (start..=end).rev().find(|&i| line.is_char_boundary(i)).unwrap_or(start);
            let annotation = AnnotationKind::Primary.span(start.min(line.len())..end.min(line.len()));
            let snippet = Snippet::source(line)
                .line_start(place.line as usize)
                .path(clean(&place.file))
                .annotation(annotation);
            Group::with_title(title).element(snippet)
        }
        Some(place) => Group::with_title(title).element(annotate_snippets::Origin::path(clean(&place.file))),
        None => Group::with_title(title),
    };
    if !help.is_empty() {
        group = group.element(Level::HELP.message(help));
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    Shown::coloured(renderer.render(&[group]).to_string())
}

fn escape_char(c: char) -> String {
    escape(c.encode_utf8(&mut [0; 4]))
}

/// A tab is a blank, so that marks stand under what they mean.
fn escape(text: &str) -> String {
    terminal(&text.replace('\t', " ")).into_owned()
}
