//! The page of a comparison: the report's look without a program, so without a script.

use maud::{DOCTYPE, Markup, PreEscaped, html as markup};

use super::{blocks, compare, page, visible};
use crate::job::hole::HoleComparison;

/// Drawings of paths are small multiples here, and words of a table need room.
const STYLE: &str = ".pictures:has(.chart){grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr))}\
.pictures:not(:has(.chart)){grid-template-columns:repeat(auto-fit,minmax(min(100%,250px),1fr))}\
.pictures:not(.one) .plan{grid-row:auto}.plan .legend,.plan .axes{display:none}.table thead th{white-space:normal}\
.table th,.table td{vertical-align:top}.table td:not(.number){min-width:6em}\
.table .wrong,.table tr:has(td.number) th{white-space:nowrap}";

/// The comparison of one or more holes as one HTML file without any reference to a network.
pub fn compare_html(holes: &[HoleComparison]) -> String {
    let style = format!("{}{STYLE}", page::STYLE);
    let title = match holes {
        [one] => one.title.clone(),
        _ => format!("{} holes", holes.len()),
    };
    let sections: Vec<_> = holes.iter().flat_map(compare::sections).collect();
    let page: Markup = markup! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(page::policy_of(&[], &style));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content=(format!("kinecut {}", crate::VERSION));
                meta name="referrer" content="no-referrer";
                title { "Strategies compared: " (visible(&title)) }
                style { (PreEscaped(&style)) }
            }
            body {
                header.top {
                    div {
                        p.maker { "kinecut hole --compare" }
                        h1 { "Strategies compared: " (visible(&title)) }
                    }
                    nav aria-label="Contents" {
                        @for (i, s) in sections.iter().enumerate() {
                            a href=(format!("#section-{}", i + 1)) { (visible(&s.title)) }
                        }
                    }
                }
                main {
                    @for (i, s) in sections.iter().enumerate() {
                        (blocks::section(s, &format!("section-{}", i + 1)))
                    }
                }
                footer { p { "kinecut " (crate::VERSION) ". A comparison on a model does not replace the trial cut." } }
            }
        }
    };
    page.into_string()
}
