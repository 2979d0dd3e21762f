//! The page of a comparison.

use super::{HoleComparison, compare};
use crate::page::verb_page::VerbPage;

/// Drawings of paths are small multiples here, and words of a table need room.
const STYLE: &str = ".pictures:not(:has(.chart)){grid-template-columns:repeat(auto-fit,minmax(min(100%,330px),1fr))}\
.plan>.wide{display:none!important}.plan>.narrow{display:block!important}.pictures:not(.one) .plan{grid-row:auto}.plan .legend,.plan .axes{display:none}.table thead th{white-space:normal}\
.table th,.table td{vertical-align:top}.table td:not(.number){min-width:6em}\
.table .wrong,.table tr:has(td.number) th{white-space:nowrap}";

/// The comparison of one or more holes as one HTML file without any reference to a network.
pub(super) fn compare_html(holes: &[&HoleComparison]) -> String {
    let title = match holes {
        [one] => one.title.clone(),
        _ => format!("{} holes", holes.len()),
    };
    VerbPage {
        maker: "kinecut hole --compare",
        title: &format!("Strategies compared: {title}"),
        style: STYLE,
        caution: "A comparison on a model does not replace the trial cut.",
        sections: &holes.iter().flat_map(|hole| compare::sections(hole)).collect::<Vec<_>>(),
        ..VerbPage::default()
    }
    .html()
}
