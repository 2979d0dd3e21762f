//! The verb `machine`.

use std::sync::Arc;

use kinecut::base::{Code, Finding, Result as Found};
use kinecut::job::machine::Loaded;
use kinecut::verbs::machine::{KnownMachines, MachineWants};
use serde::Deserialize;

use super::{Answered, Form, MachineNamed, answered, lane, short};
use crate::app::App;
use crate::lanes::Work;
use crate::refusal::Refusal;
use crate::rest::Rest;
use crate::texts::{About, Texts};
use crate::work::{Who, work};

/// A question about a machine.
#[derive(Deserialize)]
pub(super) struct MachineAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    machine: MachineNamed,
    #[serde(flatten)]
    flags: MachineFlags,
    #[serde(flatten)]
    rest: Rest,
}

/// Flags of `kinecut machine`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
struct MachineFlags {
    layout: Option<String>,
    at: Option<String>,
    bodies: bool,
    stroke: Option<[f64; 3]>,
    spindle: Option<String>,
    length: f64,
}

impl MachineAsked {
    /// The question without those who ask: nothing where it is about no machine.
    fn question(self, app: &App) -> Result<(Who, MachineQuestion), Refusal> {
        let MachineAsked { who, about, machine, flags, rest } = self;
        rest.is_empty()?;
        if machine.machine.is_some() && flags.layout.is_some() {
            return Err(Refusal::request("name one machine: `machine` or `layout`"));
        }
        machine.is_short()?;
        short("layout", flags.layout.as_ref())?;
        let MachineFlags { at, bodies, stroke, spindle, .. } = &flags;
        let of_one = at.is_some() || *bodies || stroke.is_some() || spindle.is_some();
        if machine.machine.is_none() && flags.layout.is_none() && of_one {
            let refused = Refusal::request("`at`, `bodies`, `stroke`, `spindle` need a machine");
            return Err(refused.help("name one: `machine` or `layout`"));
        }
        let texts = about.others(app)?;
        Ok((who, MachineQuestion { machine, flags, texts }))
    }
}

/// A question about a machine.
struct MachineQuestion {
    machine: MachineNamed,
    flags: MachineFlags,
    texts: Texts,
}

impl MachineQuestion {
    fn wants(&self, form: Form) -> MachineWants {
        let flags = self.flags.clone();
        MachineWants {
            at: flags.at,
            bodies: flags.bodies,
            svg: form == Form::Drawing,
            spindle: flags.spindle,
            stroke: flags.stroke,
            length: flags.length,
        }
    }

    fn lane(&self, form: Form) -> String {
        let name = self.machine.machine.as_ref().or(self.flags.layout.as_ref());
        let [bodies, at] = [(self.flags.bodies, "bodies"), (self.flags.at.is_some(), "at")]
            .map(|(is, word)| if is { word } else { "" });
        lane(form, &["machine", name.map_or("", String::as_str), bodies, at])
    }

    /// The machine; none where all that are known are asked for.
    fn load(&self, app: &App, wants: &MachineWants) -> Found<Option<Loaded>> {
        match (&self.machine.machine, &self.flags.layout) {
            (None, None) => Ok(None),
            (Some(_), _) => self.machine.load(app, &self.texts).map(Some),
            (None, Some(code)) => Ok(Some(Loaded { machine: wants.layout(code)?, import: None })),
        }
    }
}

pub(super) async fn machine(app: Arc<App>, asked: MachineAsked, form: Form) -> Answered {
    let (who, question) = asked.question(&app)?;
    work(app, (who, Work::Verb, question.lane(form)), move |app, _| {
        let wants = question.wants(form);
        match question.load(app, &wants)? {
            None => answered(form, Ok(KnownMachines::all())),
            Some(loaded) => answered(form, wants.answer(loaded)),
        }
    })
    .await
}

/// `kinecut machine --toml`: the text of a machine file.
pub(super) async fn machine_file(app: Arc<App>, asked: MachineAsked) -> Answered {
    let (who, question) = asked.question(&app)?;
    work(app, (who, Work::Verb, format!("file {}", question.lane(Form::Json))), move |app, _| {
        let wants = question.wants(Form::Json);
        let none = || Finding::error(Code::JOB_SHAPE, "there is no machine to be written");
        let loaded = question.load(app, &wants)?.ok_or_else(none)?;
        answered(Form::Json, wants.file(&loaded.machine, question.flags.layout.is_some()))
    })
    .await
}
