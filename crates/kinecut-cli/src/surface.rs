//! The verb `surface`: how a surface is generated.

use std::path::Path;

use kinecut::base::{DiskLoader, Error, Loader as _};
use kinecut::geom::read_stl;
use kinecut::job::surface::{load_surface, mesh_sheet, set_parameter, surface_sheet};
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
    if name.to_ascii_lowercase().ends_with(".stl") {
        let path = Path::new(name);
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let file = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let mesh = read_stl(&DiskLoader::new(folder).read(&file)?)?;
        let sheet = mesh_sheet(name, &mesh, wanted.crease)?;
        if args.json {
            print_json(&sheet);
        } else {
            put(&sheet.text());
        }
        return Ok(FINE);
    }
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
