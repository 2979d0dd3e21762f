//! The verb `surface`.

use std::collections::BTreeMap;
use std::sync::Arc;

use kinecut::base::FileKind;
use kinecut::geom::read_stl;
use kinecut::verbs::surface::{
    KnownSurfaces, OnMachineWants, SurfaceWants, axis_errors, load_surface, mesh_sheet,
};
use serde::Deserialize;

use super::{Answered, Form, MachineNamed, answered, lane, short};
use crate::app::App;
use crate::kind::Kind;
use crate::lanes::Work;
use crate::refusal::Refusal;
use crate::rest::Rest;
use crate::texts::About;
use crate::work::{Who, work};

/// A question about a surface.
#[derive(Deserialize)]
pub(super) struct SurfaceAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    machine: MachineNamed,
    #[serde(flatten)]
    flags: SurfaceFlags,
    #[serde(flatten)]
    rest: Rest,
}

/// Flags of `kinecut surface`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
struct SurfaceFlags {
    /// A surface of the catalogue; without it and without a file: the catalogue.
    surface: Option<String>,
    set: BTreeMap<String, String>,
    at: BTreeMap<String, String>,
    reversed: bool,
    sketch: bool,
    length: Option<f64>,
    verify: Option<String>,
    tolerance: Option<f64>,
    errors: Option<[f64; 2]>,
    error_of: BTreeMap<char, [f64; 2]>,
    alternatives: bool,
    crease: Option<f64>,
}

impl SurfaceFlags {
    fn wants(&self) -> SurfaceWants {
        let pairs = |map: &BTreeMap<String, String>| map.clone().into_iter().collect();
        SurfaceWants {
            set: pairs(&self.set),
            at: pairs(&self.at),
            reversed: self.reversed,
            sketch: self.sketch,
        }
    }

    fn on_machine(&self) -> OnMachineWants {
        let usual = OnMachineWants::default();
        OnMachineWants {
            length: self.length.unwrap_or(usual.length),
            alternatives: self.alternatives,
            only: self.verify.clone(),
            tolerance: self.tolerance.map_or(usual.tolerance, |um| um / 1e3),
            errors: self.errors.map_or(usual.errors, axis_errors),
            own_errors: self.error_of.iter().map(|(&axis, &e)| (axis, axis_errors(e))).collect(),
        }
    }
}

pub(super) async fn surface(app: Arc<App>, asked: SurfaceAsked, form: Form) -> Answered {
    let SurfaceAsked { who, about, machine, flags, rest } = asked;
    rest.is_empty()?;
    machine.is_short()?;
    short("surface", flags.surface.as_ref())?;
    let SurfaceFlags { verify, tolerance, errors, error_of, alternatives, .. } = &flags;
    let of_machine =
        verify.is_some() || tolerance.is_some() || errors.is_some() || !error_of.is_empty() || *alternatives;
    if machine.machine.is_none() && of_machine {
        let what = "`verify`, `tolerance`, `errors`, `error-of`, `alternatives` need a machine";
        return Err(Refusal::request(what).help("name one: `machine`"));
    }
    let others = about.edited(&app)?;
    let texts = about.texts_or_none(&app)?;
    if texts.is_some() && flags.surface.is_some() {
        return Err(Refusal::request("name one surface: `surface` or a file"));
    }
    let name = texts.as_ref().map(|t| t.name.clone()).or_else(|| flags.surface.clone()).unwrap_or_default();
    let lane = lane(form, &["surface", &name, machine.machine.as_deref().unwrap_or("")]);
    work(app, (who, Work::Verb, lane), move |app, watch| {
        let surface = match (&texts, &flags.surface) {
            (None, None) => return answered(form, Ok(KnownSurfaces::all())),
            (Some(texts), _) if texts.kind == Kind::Mesh => {
                let mesh = read_stl(&app.folder.read(&texts.name, FileKind::Mesh)?)?;
                return answered(form, mesh_sheet(&texts.name, &mesh, flags.crease));
            }
            (Some(texts), _) => load_surface(&texts.name, Some(&texts.text(app)?)),
            (None, Some(name)) => load_surface(name, None),
        };
        let texts = texts.as_ref().unwrap_or(&others);
        let asked = machine.machine.as_ref().map(|_| machine.load(app, texts)).transpose()?;
        let wants = flags.on_machine();
        let asked = asked.as_ref().map(|loaded| (&loaded.machine, &wants));
        answered(form, surface.and_then(|surface| flags.wants().answer(surface, asked, watch)))
    })
    .await
}
