//! The verb `envelope`: what a tool sweeps in a move.

use std::path::Path;

use kinecut::base::{Code, Error, Finding, Silent};
use kinecut::job::{Items, Outputs};
use kinecut::verbs;
use kinecut::verbs::envelope::{ENVELOPE_LIST, EnvelopeSheet, EnvelopeTable, envelope_sheets};
use serde::{Serialize, Serializer};

use crate::args::{Args, Envelope};
use crate::hole::{Item, each, print_items};
use crate::{FINE, code_of, colour, files, put, render};

/// The sheets of an item: one, but for a line of a program that makes several moves.
struct Sheets(Vec<EnvelopeSheet>);

impl Serialize for Sheets {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [one] => one.json().serialize(serializer),
            all => {
                let moves: Vec<_> = all.iter().map(EnvelopeSheet::json).collect();
                serde_json::json!({ "moves": moves }).serialize(serializer)
            }
        }
    }
}

/// Runs the verb; the exit code tells the worst item.
pub(crate) fn envelope(args: &Args, wanted: &Envelope) -> Result<u8, Error> {
    let texts = Items::<EnvelopeTable>::read(&wanted.file, &files::text(&wanted.file)?, ENVELOPE_LIST)?;
    // Drawings, machines and jobs are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&wanted.file));
    let items = each(&texts, |table| envelope_sheets(table, &loader, &Silent).map(Sheets));
    let sheets: Vec<&EnvelopeSheet> =
        items.iter().flat_map(|i| if let Item::Fine(s) = i { &s.0[..] } else { &[] }).collect();
    // Files first: what cannot be written is an error before anything is shown.
    if let Some(file) = &wanted.svg {
        match sheets[..] {
            [] => {}
            [one] => files::write_one(file, &verbs::envelope::envelope_svg(one)?)?,
            _ => {
                return Err(Finding::error(Code::JOB_SHAPE, "an SVG file is of one tool and move")
                    .value(sheets.len() as f64, "")
                    .bound(1.0, "")
                    .cure("use --out: the page has them all")
                    .into());
            }
        }
    }
    let mut written = Vec::new();
    if let (Some(out), false) = (&wanted.out, sheets.is_empty()) {
        let outputs = outputs(&sheets)?;
        written = outputs.files().map(|(name, _)| name.to_owned()).collect();
        files::write(outputs, out)?;
    }
    let shown = |s: &Sheets| s.0.iter().map(verbs::envelope::envelope_text).collect::<Vec<_>>().join("\n");
    let code = print_items(args, texts.list.is_some(), &items, shown);
    let findings = || sheets.iter().flat_map(|s| &s.findings);
    if !args.json {
        for finding in findings() {
            put(render::finding(finding, colour(args)));
            put("\n");
        }
        if let (Some(out), false) = (&wanted.out, written.is_empty()) {
            put(format!("\nWritten to {}: {}\n", out.display(), written.join(", ")));
        }
    }
    Ok(if code == FINE { code_of(args, findings()) } else { code })
}

/// The page, and of each envelope its mesh in both forms; numbered when there are several.
fn outputs(sheets: &[&EnvelopeSheet]) -> Result<Outputs, Error> {
    let mut outputs = Outputs::default();
    outputs.add("envelope.html", verbs::envelope::envelope_html(sheets)?);
    for (i, sheet) in sheets.iter().enumerate() {
        let name = if sheets.len() > 1 { format!("envelope-{}", i + 1) } else { "envelope".to_owned() };
        outputs.add(format!("{name}.stl"), kinecut::geom::write_stl(&sheet.envelope.mesh));
        outputs.add(format!("{name}.glb"), kinecut::geom::write_glb(&sheet.envelope.mesh, None)?);
    }
    Ok(outputs)
}
