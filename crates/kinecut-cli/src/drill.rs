//! The verb `drill`: one drilling, or a list of them, planned.

use std::path::Path;

use kinecut::base::Error;
use kinecut::verbs::drill::DrillSheet;
use kinecut::verbs::hole::read_holes;
use kinecut::{job, verbs};
use serde::{Serialize, Serializer};

use crate::args::{Args, Drill};
use crate::hole::{Item, each, print};
use crate::{FINDINGS, FINE, WRONG_INPUT, code_of, files, put};

/// A sheet with whether the paper's numbers are wanted.
struct Sheet {
    sheet: DrillSheet,
    paper: bool,
}

impl Serialize for Sheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.sheet.json(self.paper).serialize(serializer)
    }
}

/// Runs the verb; the exit code tells the worst item.
pub(crate) fn drill(args: &Args, drill: &Drill) -> Result<u8, Error> {
    let texts = read_holes(&drill.file, &files::text(&drill.file)?)?;
    // Meshes are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&drill.file));
    let items = each(&texts, |table| {
        verbs::drill::plan_drill_sheet(table, &loader).map(|sheet| Sheet { sheet, paper: drill.paper })
    });
    let code = print(args, &texts, &items, |s| {
        let mut shown = verbs::drill::sheet_text(&s.sheet, s.paper);
        if drill.program {
            shown.push('\n');
            shown.push_str(&s.sheet.program);
        }
        shown
    });
    let sheets: Vec<&DrillSheet> =
        items.iter().filter_map(|i| if let Item::Fine(s) = i { Some(&s.sheet) } else { None }).collect();
    if let (Some(out), false) = (&drill.out, sheets.is_empty()) {
        let owned: Vec<DrillSheet> = sheets.iter().map(|s| (*s).clone()).collect();
        let mut outputs = job::Outputs::default();
        outputs.add("drill.html", verbs::drill::sheets_html(&owned, drill.paper));
        files::write(outputs, out)?;
        if !args.json {
            put(format!("\nWritten to {}: drill.html\n", out.display()));
        }
    }
    let holes: usize = sheets.iter().map(|s| s.holes.len()).sum();
    let refused: usize = sheets.iter().map(|s| s.errors().count()).sum();
    let found = sheets.iter().flat_map(|s| &s.holes).flatten().flat_map(|h| &h.plan.findings);
    Ok(match code {
        FINE if holes > 0 && refused == holes => WRONG_INPUT,
        FINE if refused > 0 => FINDINGS,
        FINE => code_of(args, found),
        code => code,
    })
}
