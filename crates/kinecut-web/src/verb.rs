//! `POST /api/verb/NAME` and `POST /api/page/NAME`: the planners by themselves, as the command line has them.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::{Path, State};
use axum::http::{Response, StatusCode};
use kinecut::base::{Error, Finding, Loader, Result as Found, Severity};
use kinecut::job::TextItems;
use kinecut::verbs::drill::{DrillSheet, plan_drill_sheet};
use kinecut::verbs::envelope::{
    ENVELOPE_LIST, EnvelopeTable, Envelopes, MOST_INTERVALS, envelope_sheets, growths,
};
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::grazing::{GRAZING_LIST, Gallery, GrazingTable, gallery, grazing_sheet};
use kinecut::verbs::hole::{HoleSamples, compare_hole, plan_hole_sheet, read_holes};
use kinecut::verbs::{Answer, Answers};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::app::{App, Json};
use crate::lanes::Work;
use crate::refusal::{Refusal, bytes};
use crate::rest::Rest;
use crate::texts::{About, Texts};
use crate::watch::Watch;
use crate::work::{Made, Who, verb_answer, work};

/// A planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Name {
    Hole,
    Drill,
    Face,
    Grazing,
    Envelope,
}

/// What is asked of a planner: its text, and its flags on the command line.
#[derive(Deserialize)]
pub(crate) struct VerbAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    flags: Flags,
    #[serde(flatten)]
    rest: Rest,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
struct Flags {
    #[serde(default)]
    compare: bool,
    #[serde(default)]
    paper: bool,
    #[serde(default)]
    events: bool,
    /// Of a face: the bad length over all placements.
    #[serde(default)]
    map: bool,
    /// Of a face: the way of the paper's method from the chosen placement.
    #[serde(default)]
    walk: bool,
    /// Of a drilling: the load along the way of each hole.
    #[serde(default)]
    load: bool,
    /// Of a hole: the paths whose samples are wanted.
    #[serde(default)]
    samples: HoleSamples,
    /// Of grazing curves: the cases of the paper.
    #[serde(default)]
    gallery: bool,
    /// Intervals of a move.
    #[serde(default)]
    moments: Option<u32>,
}

/// Form of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// As `--json` prints it.
    Json,
    /// The page that `--out` writes.
    Page,
}

/// What the command line prints.
pub(crate) async fn verb(
    State(app): State<Arc<App>>,
    Path(name): Path<String>,
    Json(asked): Json<VerbAsked>,
) -> Result<Response<Body>, Refusal> {
    asked_of(app, &name, asked, Form::Json).await
}

/// The page that the command line writes.
pub(crate) async fn page(
    State(app): State<Arc<App>>,
    Path(name): Path<String>,
    Json(asked): Json<VerbAsked>,
) -> Result<Response<Body>, Refusal> {
    asked_of(app, &name, asked, Form::Page).await
}

async fn asked_of(
    app: Arc<App>,
    name: &str,
    asked: VerbAsked,
    form: Form,
) -> Result<Response<Body>, Refusal> {
    asked.rest.is_empty()?;
    let quoted = serde_json::Value::String(name.to_owned());
    let name = Name::deserialize(quoted)
        .map_err(|_| Refusal::not_found("no verb of the workbench has this name"))?;
    fits(name, asked.flags, form)?;
    let texts = asked.about.texts(&app)?;
    let (id, mut flags) = (texts.id(), asked.flags);
    // Its page has what the flags ask for.
    flags.compare |= form == Form::Page && name == Name::Face;
    flags.paper |= form == Form::Page && name == Name::Face;
    work(app, (asked.who, Work::Verb, id), move |app, watch| {
        let disk = app.folder.beside(&texts.name);
        let loader = texts.over(&disk, &texts.name);
        of_verb((name, flags), (app, &texts, &loader), form, watch)
    })
    .await
}

/// Refuses what would be passed over, and what no answer has.
fn fits(name: Name, flags: Flags, form: Form) -> Result<(), Refusal> {
    let only_json =
        name == Name::Grazing && flags.gallery || name == Name::Envelope && flags.moments.is_some();
    if only_json && form == Form::Page {
        return Err(Refusal::request("`gallery` and `moments` have no page of their own: ask the verb"));
    }
    match flags.moments {
        Some(moments) if !(1..=MOST_INTERVALS).contains(&moments) => {
            Err(Refusal::request(format!("`moments` is from 1 to {MOST_INTERVALS}")))
        }
        _ => Ok(()),
    }
}

fn of_verb(
    (name, flags): (Name, Flags),
    (app, texts, loader): (&App, &Texts, &dyn Loader),
    form: Form,
    watch: &Watch,
) -> Made {
    let text = texts.text(app)?;
    let holes = || read_holes(&texts.name, text.clone());
    match name {
        Name::Hole if flags.compare => answers(&holes()?, form, watch, compare_hole),
        Name::Hole => answers(&holes()?, form, watch, |table| plan_hole_sheet(table, flags.samples)),
        Name::Drill => answers(&holes()?, form, watch, |table| {
            let sheet = plan_drill_sheet(table, flags.paper, loader)?;
            Ok(DrillSheet { load: flags.load, ..sheet })
        }),
        Name::Face => {
            let Flags { compare, paper, events, map, walk, .. } = flags;
            let wants = SheetWants { compare, paper, events, map, walk };
            answers(&holes()?, form, watch, |table| plan_face_sheet(table, wants, loader, watch))
        }
        Name::Grazing if flags.gallery => {
            let cases = gallery().map(Gallery);
            let mut answers = Answers::new(false, Severity::Doubt);
            let text = answers.json(cases.as_ref());
            Ok(verb_answer(text, answers.exit_code()))
        }
        Name::Grazing => {
            let tools = TextItems::<GrazingTable>::read(&texts.name, text, GRAZING_LIST)?;
            answers(&tools, form, watch, |table| grazing_sheet(table, loader))
        }
        Name::Envelope => {
            let moves = TextItems::<EnvelopeTable>::read(&texts.name, text, ENVELOPE_LIST)?;
            if let (Some(moments), Form::Json) = (flags.moments, form) {
                // An answer is built whole, and the walls of one moment are some 30 kB.
                let all = moves.count() as u64 * u64::from(moments);
                if all > u64::from(MOST_INTERVALS) {
                    let what = "the moves of the text have too many moments for one answer";
                    let finding = Finding::error(kinecut::base::Code::JOB_VALUE, what).value(all as f64, "");
                    return Err(finding
                        .bound(f64::from(MOST_INTERVALS), "")
                        .help("ask for fewer moments, or about fewer moves")
                        .key("moments")
                        .into());
                }
                return answers(&moves, form, watch, |table| growths(table, moments, loader, watch));
            }
            answers(&moves, form, watch, |table| envelope_sheets(table, loader, watch).map(Envelopes))
        }
    }
}

/// Asks all questions of a text.
fn answers<T: DeserializeOwned + Clone, A: Answer>(
    questions: &TextItems<T>,
    form: Form,
    watch: &Watch,
    run: impl Fn(&T) -> Found<A>,
) -> Made {
    let ask = |index: usize| {
        watch.still_wanted()?;
        let item = questions.item(index).and_then(|table| run(&table));
        let mut answer = item.map_err(|e| questions.locate(index, e))?;
        answer.add_findings(questions.notes(index));
        Ok::<_, Error>(answer)
    };
    let asked = (0..questions.count()).map(ask);
    match form {
        Form::Json => {
            let mut answers = Answers::new(questions.list.is_some(), Severity::Doubt);
            let mut text = String::new();
            for one in asked {
                watch.still_wanted()?;
                text += &answers.json(one.as_ref());
            }
            text += answers.json_end();
            Ok(verb_answer(text, answers.exit_code()))
        }
        Form::Page => {
            let all = asked.collect::<Found<Vec<A>>>()?;
            let files = A::files(&all.iter().collect::<Vec<_>>())?;
            let page = files.files().find(|(name, _)| name.ends_with(".html"));
            let (_, page) = page
                .ok_or_else(|| Finding::error(kinecut::base::Code::JOB_SHAPE, "there is no page of this"))?;
            Ok(bytes(StatusCode::OK, "text/html; charset=utf-8", page.to_vec()))
        }
    }
}
