//! The verb `layouts`: all layouts of a code or a set of axes.

use kinecut::base::Error;
use kinecut::verbs::layouts::{LayoutWants, layout_sheet};
use kinecut::{job, verbs};

use crate::args::{Args, Layouts};
use crate::{FINDINGS, code_of, colour, complain, files, print_json, put, render};

/// Drawings beside each other on a sheet.
const COLUMNS: usize = 4;

/// Runs the verb; a question that leaves nothing is a finding.
pub(crate) fn layouts(args: &Args, layouts: &Layouts) -> Result<u8, Error> {
    let sheet = layout_sheet(&LayoutWants {
        of: layouts.of.clone(),
        full_mobility: layouts.full,
        regular: layouts.regular,
        most_work_links: layouts.work_links,
        work_axes: layouts.work_axes.clone(),
        tool_axes: layouts.tool_axes.clone(),
        kinds: layouts.kind.clone(),
        tilt: layouts.tilt,
        stroke: layouts.stroke,
        part: layouts.part,
        tool_length: layouts.tool_length,
        stacking: layouts.stacking,
        spindle: layouts.spindle.clone(),
        quarter_turns_are_one: layouts.quarter_turns,
        weights: layouts.weight.clone(),
        show: layouts.show,
    })?;
    if let Some(file) = &layouts.svg {
        let title = format!("{}: {} of {} layouts", sheet.of, sheet.found.len(), sheet.left);
        files::write_one(
            file,
            &verbs::layouts::layouts_drawing(&title, &sheet.found, &sheet.sizes, COLUMNS),
        )?;
    }
    if let Some(out) = &layouts.out {
        let mut outputs = job::Outputs::default();
        outputs.add("layouts.html", verbs::layouts::layouts_html(&sheet));
        files::write(outputs, out)?;
    }
    if args.json {
        print_json(&sheet);
    } else {
        put(sheet.text());
        if let Some(out) = &layouts.out {
            put(format!("\nWritten to {}: layouts.html\n", out.display()));
        }
        sheet.findings.iter().for_each(|f| complain(render::finding(f, colour(args))));
    }
    // A search that finds nothing is an answer that says no.
    Ok(if sheet.found.is_empty() { FINDINGS } else { code_of(args, &sheet.findings) })
}
