//! The verb `surface`: how a surface is generated.

use std::path::{Path, PathBuf};

use kinecut::base::{Error, FileKind, Silent};
use kinecut::geom::read_stl;
use kinecut::verbs::surface::{
    KnownSurfaces, OnMachineWants, SurfaceWants, axis_errors, load_surface, mesh_sheet,
};

use crate::answers::{To, answer};
use crate::numbers::{errors_of, named, pair};
use crate::printing::Printing;
use crate::{files, machine};

#[derive(Debug, clap::Args)]
pub(crate) struct Surface {
    /// A surface of the catalogue, a file with its generating lines (TOML or JSON; `-` reads standard input), or an STL
    /// mesh whose faces are recognised; without it: the catalogue
    surface: Option<String>,
    /// A parameter: R=40, alpha=20*pi/180; may be given again
    #[arg(long, value_name = "NAME=VALUE", value_parser = named)]
    set: Vec<(String, String)>,
    /// A place by a variable of the surface: phi=1; may be given again, variables that are not named are in the middle of
    /// their domains. Its point, matrices and lines in numbers; sketches are drawn there
    #[arg(long, value_name = "NAME=VALUE", value_parser = named)]
    at: Vec<(String, String)>,
    /// With --json: the points of the sketches, for a program that draws them itself
    #[arg(long)]
    sketch: bool,
    /// The material on the other side: of a shaft the bore
    #[arg(long)]
    reversed: bool,
    /// Ask this machine for every redistribution: laws of its axes, or why not
    #[arg(long, value_name = "MACHINE")]
    machine: Option<String>,
    /// With --machine: length of the tool from the gauge point, mm
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, requires = "machine")]
    length: f64,
    /// With --machine: only this redistribution (code of the machine's part such as 61, `-` for none, or both parts such as
    /// 615|3), or `touching` or `rolling`; without it all are verified
    #[arg(long, value_name = "SPLIT", requires = "machine", allow_hyphen_values = true)]
    verify: Option<String>,
    /// With --machine: most error of a surface that counts as reached, micrometres
    #[arg(
        long,
        value_name = "UM",
        default_value_t = 10.0,
        allow_negative_numbers = true,
        requires = "machine"
    )]
    tolerance: f64,
    /// With --machine: errors of every axis for the budget, micrometres and seconds of arc
    #[arg(long, value_name = "UM,ARCSEC", default_value = "10,10", value_parser = pair, requires = "machine")]
    errors: [f64; 2],
    /// With --machine: errors of one axis: X=5,3; may be given again
    #[arg(long, value_name = "AXIS=UM,ARCSEC", value_parser = errors_of, requires = "machine")]
    error_of: Vec<(char, [f64; 2])>,
    /// With --machine: the nearest machines that could where this one cannot, among all layouts of two to five axes
    #[arg(long, requires = "machine")]
    alternatives: bool,
    /// Sketch the redistributions into this SVG file: surface, tool, motions with arrows
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Folder for surface.html, made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
    /// Of a mesh: the angle from which on an edge divides two faces, degrees; default 40
    #[arg(long, value_name = "DEG")]
    crease: Option<f64>,
}

impl Surface {
    /// A surface, the faces of a mesh, or the catalogue.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let Some(name) = &self.surface else { return answer(args, To::default(), KnownSurfaces::all()) };
        if name.to_ascii_lowercase().ends_with(".stl") {
            let mesh = read_stl(&files::bytes(Path::new(name), FileKind::Mesh)?)?;
            return answer(args, To::default(), mesh_sheet(name, &mesh, self.crease)?);
        }
        let is_file = name == "-" || name.contains(['.', '/', '\\']);
        let text = if is_file { Some(files::text(name)?) } else { None };
        let surface = load_surface(name, text.as_deref())?;
        let asked = self.machine.as_deref().map(machine::of_name).transpose()?;
        let on_machine = self.on_machine();
        let wants = SurfaceWants {
            set: self.set.clone(),
            at: self.at.clone(),
            reversed: self.reversed,
            sketch: self.sketch,
        };
        let found = wants.answer(surface, asked.as_ref().map(|m| (m, &on_machine)), &Silent)?;
        let to = To { out: self.out.as_deref(), svg: self.svg.as_deref(), ..To::default() };
        answer(args, to, found)
    }

    /// The question to a machine.
    fn on_machine(&self) -> OnMachineWants {
        OnMachineWants {
            length: self.length,
            alternatives: self.alternatives,
            only: self.verify.clone(),
            tolerance: self.tolerance / 1e3,
            errors: axis_errors(self.errors),
            own_errors: self.error_of.iter().map(|&(axis, e)| (axis, axis_errors(e))).collect(),
        }
    }
}
