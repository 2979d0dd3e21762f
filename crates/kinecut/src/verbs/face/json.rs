//! The sheet of `kinecut face` as JSON, in the units of the shop: mm, degrees, s, mm/min.

use serde::ser::Error as _;
use serde::{Serialize, Serializer};

use super::{FaceSheet, PaperBaseline};
use crate::base::Finding;
use crate::facing::{DescentStatistics, SimplexDescent, SurveyPoint};
use crate::operations::face::{Event, FaceJson};

/// The certified `optimum`; the `ways` with their bad lengths, times and paths, `chosen` among them; the `stretches` of the
/// chosen way edge by edge with their exit angles; `events`, the crossings of the real teeth, and `paper` where they were
/// wanted.
#[derive(Serialize)]
struct SheetJson<'a> {
    control: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    events: Vec<Event>,
    findings: &'a [Finding],
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<PaperJson>,
    program: &'a str,
    title: &'a str,
    #[serde(flatten)]
    plan: FaceJson,
}

/// Result of the paper's program for the same face.
#[derive(Serialize)]
struct PaperJson {
    descent_from_as_drawn: Option<SimplexDescent>,
    descents: Vec<SimplexDescent>,
    statistics: Option<DescentStatistics>,
    survey: Vec<SurveyPoint>,
}

impl Serialize for FaceSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let sheet = SheetJson {
            control: self.control,
            events: self.events.iter().map(|c| self.face.event_json(c)).collect(),
            findings: &self.findings,
            paper: self.paper.as_ref().map(|paper| self.paper_json(paper)),
            program: &self.program,
            title: &self.title,
            plan: self.face.plan_json(),
        };
        // As a value all fields stand in the order of their names.
        serde_json::to_value(sheet).map_err(S::Error::custom)?.serialize(serializer)
    }
}

impl FaceSheet {
    fn paper_json(&self, paper: &PaperBaseline) -> PaperJson {
        let face = &self.face;
        let descent = |d: &SimplexDescent| SimplexDescent {
            start: face.seen(d.start),
            placement: face.seen(d.placement),
            ..*d
        };
        let survey = paper.survey.iter().map(|p| SurveyPoint { placement: face.seen(p.placement), ..*p });
        PaperJson {
            descent_from_as_drawn: paper.from_drawn.as_ref().map(descent),
            descents: paper.descents.iter().map(descent).collect(),
            statistics: paper.statistics,
            survey: survey.collect(),
        }
    }
}
