//! The verb `grazing`: where the surface of a tool slides along what it sweeps, at one moment; and the paper's cases.

use std::path::Path;

use kinecut::base::{Code, Error, Finding};
use kinecut::job::{Items, Outputs};
use kinecut::verbs;
use kinecut::verbs::grazing::{GRAZING_LIST, GrazingSheet, GrazingTable, gallery, grazing_sheet};
use serde::{Serialize, Serializer};

use crate::args::{Args, Grazing};
use crate::hole::{Item, each, print_items};
use crate::{FINE, code_of, colour, files, print_json, put, render};

/// A sheet as JSON.
struct Sheet(Box<GrazingSheet>);

impl Serialize for Sheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.json().serialize(serializer)
    }
}

/// Runs the verb; the exit code tells the worst item.
pub(crate) fn grazing(args: &Args, wanted: &Grazing) -> Result<u8, Error> {
    if wanted.gallery {
        return cases(args, wanted.out.as_deref());
    }
    let texts = Items::<GrazingTable>::read(&wanted.file, &files::text(&wanted.file)?, GRAZING_LIST)?;
    // Drawings and jobs are named as seen from the file.
    let (loader, _) = files::beside(Path::new(&wanted.file));
    let items = each(&texts, |table| grazing_sheet(table, &loader).map(|done| Sheet(Box::new(done))));
    let sheets: Vec<&GrazingSheet> =
        items.iter().filter_map(|i| if let Item::Fine(s) = i { Some(&*s.0) } else { None }).collect();
    if let Some(file) = &wanted.svg {
        match sheets[..] {
            [] => {}
            [one] => files::write_one(file, &verbs::grazing::grazing_svg(one))?,
            _ => {
                return Err(Finding::error(Code::JOB_SHAPE, "an SVG file is of one tool and motion")
                    .value(sheets.len() as f64, "")
                    .bound(1.0, "")
                    .cure("use --out: the page has them all")
                    .into());
            }
        }
    }
    let code = print_items(args, texts.list.is_some(), &items, |s| verbs::grazing::grazing_text(&s.0));
    let findings = || sheets.iter().flat_map(|s| &s.findings);
    if !args.json {
        for finding in findings() {
            put(render::finding(finding, colour(args)));
            put("\n");
        }
    }
    if let (Some(out), false) = (&wanted.out, sheets.is_empty()) {
        let mut outputs = Outputs::default();
        outputs.add("grazing.html", verbs::grazing::grazing_html(&sheets));
        files::write(outputs, out)?;
        if !args.json {
            put(format!("\nWritten to {}: grazing.html\n", out.display()));
        }
    }
    Ok(if code == FINE { code_of(args, findings()) } else { code })
}

/// The paper's cases.
fn cases(args: &Args, out: Option<&Path>) -> Result<u8, Error> {
    let groups = gallery()?;
    if args.json {
        print_json(&verbs::grazing::gallery_json(&groups));
    } else {
        put(verbs::grazing::gallery_text(&groups));
    }
    if let Some(out) = out {
        let mut outputs = Outputs::default();
        outputs.add("gallery.html", verbs::grazing::gallery_html(&groups));
        let mut written = format!("Written to {}: gallery.html, and of each case\n", out.display());
        for (name, svg) in verbs::grazing::gallery_svgs(&groups) {
            written.push_str(&format!("  {name}\n"));
            outputs.add(&name, svg);
        }
        files::write(outputs, out)?;
        if !args.json {
            put(&written);
        }
    }
    Ok(FINE)
}
