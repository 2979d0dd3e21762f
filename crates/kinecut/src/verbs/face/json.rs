//! The sheet of `kinecut face` as JSON, in the units of the shop: mm, degrees, s, mm/min.

use serde::ser::Error as _;
use serde::{Serialize, Serializer};

use super::{FaceSheet, PaperBaseline};
use crate::base::Finding;
use crate::facing::{Descent, DescentStatistics, Placement};
use crate::operations::face::{Event, FaceJson, PlacementJson, deg};

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

/// What the paper's program does with the same face.
#[derive(Serialize)]
struct PaperJson {
    descent_from_as_drawn: Option<DescentJson>,
    descents: Vec<DescentJson>,
    statistics: Option<DescentStatistics>,
    survey: Vec<SurveyJson>,
}

#[derive(Serialize)]
struct DescentJson {
    end: PlacementJson,
    evaluations: u32,
    start: PlacementJson,
    value: f64,
}

#[derive(Serialize)]
struct SurveyJson {
    bad: f64,
    covered: bool,
    largest_exit_angle: f64,
    placement: PlacementJson,
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
        let placement = |p: Placement| self.face.placement_json(p);
        let descent = |d: &Descent| DescentJson {
            end: placement(d.placement),
            evaluations: d.evaluations,
            start: placement(d.start),
            value: d.value,
        };
        let survey = paper.survey.iter().map(|p| SurveyJson {
            bad: p.bad,
            covered: p.covered,
            largest_exit_angle: deg(p.largest_exit_angle),
            placement: placement(Placement { angle: p.angle, offset: p.offset }),
        });
        PaperJson {
            descent_from_as_drawn: paper.from_drawn.as_ref().map(descent),
            descents: paper.descents.iter().map(descent).collect(),
            statistics: paper.statistics,
            survey: survey.collect(),
        }
    }
}
