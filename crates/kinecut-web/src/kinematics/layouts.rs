//! The verb `layouts`.

use std::sync::Arc;

use kinecut::verbs::layouts::{LISTED, LayoutWants, layout_sheet};
use serde::Deserialize;

use super::{Answered, Form, answered, lane, short};
use crate::app::App;
use crate::lanes::Work;
use crate::refusal::Refusal;
use crate::rest::Rest;
use crate::work::{Who, work};

/// Most layouts in an answer.
const MOST_LAYOUTS: usize = 240;

/// A question about layouts.
#[derive(Deserialize)]
pub(super) struct LayoutsAsked {
    #[serde(flatten)]
    who: Who,
    /// A code, a chain, letters of axes, or "regular".
    of: String,
    #[serde(flatten)]
    wants: LayoutWants,
    #[serde(flatten)]
    rest: Rest,
}

pub(super) async fn layouts(app: Arc<App>, asked: LayoutsAsked, form: Form) -> Answered {
    let LayoutsAsked { who, of, wants, rest } = asked;
    rest.is_empty()?;
    short("of", Some(&of))?;
    if wants.show.unwrap_or(LISTED) > MOST_LAYOUTS {
        return Err(Refusal::request(format!("at most {MOST_LAYOUTS} layouts are listed")));
    }
    work(app, (who, Work::Verb, lane(form, &["layouts"])), move |_, watch| {
        answered(form, wants.query(&of).and_then(|query| layout_sheet(&of, &query, watch)))
    })
    .await
}
