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

/// Most poses of a request, and longest line of one [bytes].
const MOST_POSES: usize = 1000;
const LONGEST: usize = 2000;

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
        return Err(Refusal::request(format!("`at` has from 1 to {MOST_POSES} poses")));
    }
    if at.iter().chain(&lock).any(|line| line.len() > LONGEST || line.contains(['\n', '\r'])) {
        let refused = Refusal::request(format!("a pose is one line of at most {LONGEST} bytes"));
        return Err(refused.help("write an entry of `at` for each pose, as in X10 Y-3.5 A30"));
    }
    machine.is_short()?;
    if lock.is_some() && chain == Chain::Forward {
        return Err(Refusal::request("there is no key `lock`"));
    }
    let texts = about.others(&app)?;
    let word = if chain == Chain::Forward { "fk" } else { "ik" };
    let lane = lane(Form::Json, &[word, machine.machine.as_deref().unwrap_or("")]);
    work(app, (who, Work::Verb, lane), move |app, watch| {
        let loaded = machine.load(app, &texts)?.machine;
        let held = lock.map(|words| PoseTexts::one("--lock", &words)).transpose()?;
        let wants = InverseWants { locked: held.map(|w| AxisValues(w.words)).unwrap_or_default(), length };
        match chain {
            Chain::Forward => each(&at, watch, |words| forward(&loaded, words, length)),
            Chain::Inverse => each(&at, watch, |words| inverse(&loaded, words, &wants)),
        }
    })
    .await
}

/// The answers to all poses, each in its place.
fn each<A: Answer>(poses: &[String], watch: &Watch, ask: impl Fn(&PoseWords) -> Found<A>) -> Made {
    let mut answers = Answers::new(poses.len() > 1, Severity::Doubt);
    let mut text = String::new();
    for pose in poses {
        watch.still_wanted()?;
        let one = PoseTexts::one("--at", pose).and_then(|words| ask(&words));
        text += &answers.json(one.as_ref());
    }
    text += answers.json_end();
    Ok(verb_answer(text, answers.exit_code()))
}
