//! The page of the verb, and the picture as a file of its own.

use super::charts::charts;
use super::figure::figure;
use super::tables::{cusps, entering, events, facts, move_lines, second_order, title, volume_note};
use crate::base::Result;
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Section, draw, fixed};
use crate::verbs::envelope::EnvelopeSheet;
use crate::verbs::grazing::show::sentence;

/// What a page of this verb does not replace.
const CAUTION: &str = "An envelope bounds what the surface of revolution sweeps: it knows nothing of teeth, and is not trimmed \
where it lies inside of what other moments sweep.";

/// The page of one sheet, or of several.
///
/// # Errors
/// Those of [`crate::sweep::ProfileChain::envelope`], for the drawn mesh.
pub fn envelope_html(sheets: &[&EnvelopeSheet]) -> Result<String> {
    let heading = match sheets {
        [one] => title(one).to_owned(),
        _ => format!("{} envelopes", sheets.len()),
    };
    let sections = sheets.iter().enumerate().map(|(i, s)| section(s, i)).collect::<Result<Vec<_>>>()?;
    let page = VerbPage {
        maker: "kinecut envelope",
        title: &heading,
        style: "",
        moves: false,
        caution: CAUTION,
        sections: &sections,
        figures: &[],
    };
    Ok(page.html())
}

fn section(sheet: &EnvelopeSheet, number: usize) -> Result<Section> {
    let mut section = Section::new(title(sheet)).with(Block::Facts(facts(sheet)));
    let mut lines = move_lines(sheet);
    lines.push(format!("the volume is {}", volume_note(sheet)));
    lines.push(format!(
        "straight ways between the moments leave the tool's by {} mm at most",
        fixed(sheet.envelope.pose_error, 6)
    ));
    lines.extend(second_order(sheet));
    lines.extend(sheet.notes.iter().cloned());
    lines.extend(sheet.findings.iter().map(|f| format!("{}: {f}", f.code)));
    section.blocks.push(Block::List(lines.iter().map(|l| sentence(l)).collect()));
    section.blocks.push(figure(sheet, &format!("envelope-{}", number + 1))?.into());
    for chart in charts(sheet) {
        section.blocks.push(chart.into());
    }
    for table in [events(sheet), cusps(sheet), Some(entering(sheet))].into_iter().flatten() {
        section.blocks.push(table.into());
    }
    Ok(section)
}

/// The picture as an SVG file.
///
/// # Errors
/// Those of [`crate::sweep::ProfileChain::envelope`], for the drawn mesh.
pub fn envelope_svg(sheet: &EnvelopeSheet) -> Result<String> {
    Ok(draw::sheet(title(sheet), &[figure(sheet, "envelope")?], 1))
}
