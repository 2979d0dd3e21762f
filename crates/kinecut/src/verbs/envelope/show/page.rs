//! The page of the verb, and the picture as a file of its own.

use super::charts::charts;
use super::figure::figure;
use super::tables::{cusps, entering, events, facts, move_lines, second_order, title, trimmed_lines};
use crate::base::Result;
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Section, draw, fixed};
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::sentence;

/// Caution on a page of this verb.
const CAUTION: &str = "An envelope bounds what the surface of revolution sweeps: it knows nothing of teeth.";

/// The page of one sheet, or of several.
///
/// # Errors
/// Those of [`crate::sweep::ProfileChain::envelope`], for the drawn mesh.
pub fn envelope_html(sheets: &[&EnvelopeSheet]) -> Result<String> {
    let heading = match sheets {
        [one] => title(one).to_owned(),
        _ => format!("{} envelopes", sheets.len()),
    };
    let sections = sheets.iter().enumerate().map(|(i, s)| drawn(s, i)).collect::<Result<Vec<_>>>()?;
    let page = VerbPage {
        maker: "kinecut envelope",
        title: &heading,
        caution: CAUTION,
        sections: &sections,
        ..VerbPage::default()
    };
    Ok(page.html())
}

/// The section of a page: with the picture and the charts behind the sentences, and with the findings.
fn drawn(sheet: &EnvelopeSheet, number: usize) -> Result<Section> {
    let mut section = section(sheet);
    let pictures = charts(sheet).into_iter().map(Block::from);
    let figure = figure(sheet, &format!("envelope-{}", number + 1))?.into();
    let findings = sheet.findings.iter().map(|f| sentence(&format!("{}: {f}", f.code))).collect();
    let all = [Block::List(findings), figure].into_iter().chain(pictures);
    section.blocks.splice(2..2, all.filter(|block| *block != Block::List(Vec::new())));
    Ok(section)
}

/// The sheet in words and numbers.
pub(crate) fn section(sheet: &EnvelopeSheet) -> Section {
    let mut lines = move_lines(sheet);
    let b = sheet.trimmed.mesh.bounds();
    let side = |k: usize| format!("{} to {}", fixed(b.min[k], 3), fixed(b.max[k], 3));
    lines.push(format!("it lies in X {}, Y {}, Z {} mm", side(0), side(1), side(2)));
    lines.extend(trimmed_lines(sheet));
    lines.push(format!(
        "straight ways between the moments leave the tool's by {} mm at most",
        fixed(sheet.envelope.pose_error, 6)
    ));
    lines.extend(second_order(sheet));
    if sheet.envelope.events.is_empty() {
        lines.push("no curve is born, joins, parts or ends".to_owned());
    }
    lines.extend(sheet.notes.iter().cloned());
    let lines = lines.iter().map(|l| sentence(l)).collect();
    let section = Section::new(title(sheet)).with(Block::Facts(facts(sheet))).with(Block::List(lines));
    [events(sheet), cusps(sheet), Some(entering(sheet))].into_iter().flatten().fold(section, Section::with)
}

/// The picture as an SVG file.
///
/// # Errors
/// Those of [`crate::sweep::ProfileChain::envelope`], for the drawn mesh.
pub fn envelope_svg(sheet: &EnvelopeSheet) -> Result<String> {
    Ok(draw::sheet(title(sheet), &[figure(sheet, "envelope")?], 1))
}
