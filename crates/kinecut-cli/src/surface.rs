//! The verb `surface`: how a surface is generated.

use std::path::Path;

use kinecut::base::{Error, FileKind, Silent};
use kinecut::geom::read_stl;
use kinecut::machine::generation::AxisErrors;
use kinecut::verbs::surface::{
    KnownSurfaces, OnMachineWants, SurfaceAnswer, load_surface, mesh_sheet, on_machine, set_parameter,
    surface_sheet,
};

use crate::answers::{To, answer};
use crate::args::{Args, Surface};
use crate::files;

/// Runs the verb.
pub(crate) fn surface(args: &Args, wanted: &Surface) -> Result<u8, Error> {
    let Some(name) = &wanted.surface else {
        return answer(args, To::default(), KnownSurfaces::all());
    };
    if name.to_ascii_lowercase().ends_with(".stl") {
        let mesh = read_stl(&files::bytes(Path::new(name), FileKind::Mesh)?)?;
        return answer(args, To::default(), mesh_sheet(name, &mesh, wanted.crease)?);
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
    let to = To { out: wanted.out.as_deref(), svg: wanted.svg.as_deref(), ..To::default() };
    answer(args, to, SurfaceAnswer { sheet, on_machine: made })
}
