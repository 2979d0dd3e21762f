//! The verbs `fk` and `ik`.

use std::sync::Arc;

use kinecut::base::{Result as Found, Severity};
use kinecut::verbs::fk::forward;
use kinecut::verbs::ik::{InverseWants, inverse};
use kinecut::verbs::poses::{AxisValues, PoseTexts, PoseWords};
use kinecut::verbs::{Answer, Answers};
use serde::Deserialize;

use super::{Answered, Form, MachineNamed, lane};
use crate::app::App;
use crate::lanes::Work;
use crate::refusal::Refusal;
use crate::rest::Rest;
use crate::texts::About;
use crate::watch::Watch;
use crate::work::{Made, Who, verb_answer, work};

/// Most poses of a request.
const MOST_POSES: usize = 1000;

/// Way along the chain of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chain {
    /// From positions of the axes to the tip.
    Forward,
    /// From the tip to positions of the axes.
    Inverse,
}

/// A question about the chain of a machine.
#[derive(Deserialize)]
pub(super) struct PosesAsked {
    #[serde(flatten)]
    who: Who,
    #[serde(flatten)]
    about: About,
    #[serde(flatten)]
    machine: MachineNamed,
    /// A line of words for each pose.
    at: Vec<String>,
    #[serde(default)]
    length: f64,
    /// Axes that are held.
    lock: Option<String>,
    #[serde(flatten)]
    rest: Rest,
}

pub(super) async fn poses(app: Arc<App>, asked: PosesAsked, chain: Chain) -> Answered {
    let PosesAsked { who, about, machine, at, length, lock, rest } = asked;
    rest.is_empty()?;
    if at.is_empty() || at.len() > MOST_POSES {
        return Err(Refusal::request(format!("from 1 to {MOST_POSES} poses")));
    }
    if lock.is_some() && chain == Chain::Forward {
        return Err(Refusal::request("there is no key `lock`"));
    }
    let texts = about.others(&app)?;
    let word = if chain == Chain::Forward { "fk" } else { "ik" };
    let lane = lane(Form::Json, &[word, machine.machine.as_deref().unwrap_or("")]);
    work(app, (who, Work::Verb, lane), move |app, watch| {
        let loaded = machine.load(app, &texts)?.machine;
        let questions = PoseTexts::read("--at", &at.join("\n"))?;
        let held = lock.map(|words| PoseTexts::read("--lock", &words)).transpose()?;
        let held = held.and_then(|texts| texts.items.into_iter().next()).transpose()?;
        let wants = InverseWants { locked: held.map(|w| AxisValues(w.words)).unwrap_or_default(), length };
        match chain {
            Chain::Forward => each(&questions, watch, |words| forward(&loaded, words, length)),
            Chain::Inverse => each(&questions, watch, |words| inverse(&loaded, words, &wants)),
        }
    })
    .await
}

/// The answers to all poses of a text.
fn each<A: Answer>(questions: &PoseTexts, watch: &Watch, ask: impl Fn(&PoseWords) -> Found<A>) -> Made {
    let mut answers = Answers::new(questions.list, Severity::Doubt);
    let mut text = String::new();
    for (i, words) in questions.items.iter().enumerate() {
        watch.still_wanted()?;
        let one = words.clone().and_then(|words| ask(&words)).map_err(|e| questions.locate(i, e));
        text += &answers.json(one.as_ref());
    }
    text += answers.json_end();
    Ok(verb_answer(text, answers.exit_code()))
}
