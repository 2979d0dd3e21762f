//! The verb `surface`: how a surface is generated.

use kinecut::base::Error;
use kinecut::job::surface::{load_surface, set_parameter, surface_sheet};
use kinecut::machine::surface::catalogue;

use crate::args::{Args, Surface};
use crate::hole::text;
use crate::{FINE, print_json, put};

/// Runs the verb.
pub(crate) fn surface(args: &Args, wanted: &Surface) -> Result<u8, Error> {
    let Some(name) = &wanted.surface else {
        list(args);
        return Ok(FINE);
    };
    let is_file = name == "-" || name.contains(['.', '/', '\\']);
    let text = if is_file { Some(text(name)?) } else { None };
    let mut surface = load_surface(name, text.as_deref())?;
    for (parameter, value) in &wanted.set {
        surface = set_parameter(surface, parameter, value)?;
    }
    if wanted.reversed {
        surface = surface.reversed();
    }
    let sheet = surface_sheet(&surface)?;
    if args.json {
        print_json(&sheet);
    } else {
        put(&sheet.text());
    }
    Ok(FINE)
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
        rows.for_each(|s| put(&format!("{:<24} {:<7} {}\n", s.name, s.code().to_string(), s.title)));
    }
}
