//! The verb `surface`: how a surface is generated.

use std::path::Path;

use kinecut::base::{Error, FileKind, Silent};
use kinecut::geom::read_stl;
use kinecut::machine::generation::AxisErrors;
use kinecut::machine::surface::catalogue;
use kinecut::verbs::surface::{
    OnMachine, OnMachineWants, SurfaceSheet, load_surface, mesh_sheet, on_machine, set_parameter,
    surface_sheet,
};
use kinecut::{job, verbs};
use serde::Serialize;

use crate::args::{Args, Surface};
use crate::{FINDINGS, FINE, files, print_json, put};

/// A surface, and what a machine says to it.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    sheet: SurfaceSheet,
    #[serde(skip_serializing_if = "Option::is_none")]
    on_machine: Option<OnMachine>,
}

/// Runs the verb.
pub(crate) fn surface(args: &Args, wanted: &Surface) -> Result<u8, Error> {
    let Some(name) = &wanted.surface else {
        list(args);
        return Ok(FINE);
    };
    if name.to_ascii_lowercase().ends_with(".stl") {
        let mesh = read_stl(&files::bytes(Path::new(name), FileKind::Mesh)?)?;
        let sheet = mesh_sheet(name, &mesh, wanted.crease)?;
        if args.json {
            print_json(&sheet);
        } else {
            put(sheet.text());
        }
        return Ok(FINE);
    }
    let is_file = name == "-" || name.contains(['.', '/', '\\']);
    let text = if is_file { Some(files::text(name)?) } else { None };
    let mut surface = load_surface(name, text.as_deref())?;
    for (parameter, value) in &wanted.set {
        surface = set_parameter(surface, parameter, value)?;
    }
    if wanted.reversed {
        surface = surface.reversed();
    }
    let sheet = surface_sheet(&surface)?;
    let made = match &wanted.machine {
        Some(name) => {
            let machine = crate::machine::of_name(name)?;
            let errors = |[shift, turn]: [f64; 2]| AxisErrors {
                shift: shift / 1e3,
                turn: (turn / 3600.0).to_radians(),
            };
            let wants = OnMachineWants {
                length: wanted.length,
                alternatives: wanted.alternatives,
                only: wanted.verify.clone(),
                tolerance: wanted.tolerance / 1e3,
                errors: errors(wanted.errors),
                own_errors: wanted.error_of.iter().map(|&(axis, e)| (axis, errors(e))).collect(),
            };
            Some(on_machine(&surface, &sheet.found, &machine, &wants, &Silent)?)
        }
        None => None,
    };
    if let Some(file) = &wanted.svg {
        files::write_one(file, &verbs::surface::surface_drawing(&sheet)?)?;
    }
    if let Some(out) = &wanted.out {
        let mut outputs = job::Outputs::default();
        outputs.add("surface.html", verbs::surface::surface_html(&sheet, made.as_ref())?);
        files::write(outputs, out)?;
    }
    let possible = made.as_ref().is_none_or(OnMachine::is_possible);
    if args.json {
        print_json(&Answer { sheet, on_machine: made });
    } else {
        put(sheet.text());
        if let Some(made) = &made {
            put(made.text());
        }
        if let Some(out) = &wanted.out {
            put(format!("\nWritten to {}: surface.html\n", out.display()));
        }
    }
    Ok(if possible { FINE } else { FINDINGS })
}

/// The catalogue.
fn list(args: &Args) {
    let rows = catalogue().iter();
    if args.json {
        let rows: Vec<_> = rows
            .map(|s| serde_json::json!({ "name": s.name, "title": s.title, "code": s.code().to_string() }))
            .collect();
        print_json(&rows);
    } else {
        rows.for_each(|s| put(format!("{:<24} {:<7} {}\n", s.name, s.code().to_string(), s.title)));
    }
}
