//! The verb `face`: one face, or a list of them, planned.

use std::path::Path;

use kinecut::base::Error;
use kinecut::verbs::face::{FaceSheet, SheetWants};
use kinecut::verbs::hole::read_holes;
use kinecut::{job, verbs};
use serde::{Serialize, Serializer};

use crate::args::{Args, Face};
use crate::hole::{Item, each, print};
use crate::{FINE, code_of, colour, files, progress, put, render};

/// A sheet as JSON.
struct Sheet(FaceSheet);

impl Serialize for Sheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.json().serialize(serializer)
    }
}

/// Runs the verb; the exit code tells the worst item.
pub(crate) fn face(args: &Args, face: &Face) -> Result<u8, Error> {
    let texts = read_holes(&face.file, &files::text(&face.file)?)?;
    // Drawings are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&face.file));
    let wants = SheetWants {
        compare: face.compare || face.out.is_some(),
        paper: face.paper || face.out.is_some(),
        events: face.events,
    };
    let bar = progress::Bar::new();
    let items = each(&texts, |table| verbs::face::plan_face_sheet(table, wants, &loader, &bar).map(Sheet));
    drop(bar);
    let code = print(args, &texts, &items, |s| {
        let mut shown = verbs::face::face_text(&s.0, face.paper);
        if face.program {
            shown.push('\n');
            shown.push_str(&s.0.program);
        }
        shown
    });
    let sheets: Vec<&FaceSheet> =
        items.iter().filter_map(|i| if let Item::Fine(s) = i { Some(&s.0) } else { None }).collect();
    let findings = || sheets.iter().flat_map(|s| &s.findings);
    if !args.json {
        for finding in findings() {
            put(render::finding(finding, colour(args)));
            put("\n");
        }
    }
    if let (Some(out), false) = (&face.out, sheets.is_empty()) {
        let mut outputs = job::Outputs::default();
        outputs.add("face.html", verbs::face::faces_html(&sheets));
        files::write(outputs, out)?;
        if !args.json {
            put(format!("\nWritten to {}: face.html\n", out.display()));
        }
    }
    Ok(if code == FINE { code_of(args, findings()) } else { code })
}
