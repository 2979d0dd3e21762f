//! The sheet of `kinecut face` as JSON, in the units of the shop: mm, degrees, s, mm/min.

use serde::ser::Error as _;
use serde::{Serialize, Serializer};

use super::map::MapJson;
use super::{FaceSheet, PaperBaseline, SimplexWalk};
use crate::base::Finding;
use crate::facing::{DescentStatistics, SimplexCorner, SimplexDescent, SimplexStep, SurveyPoint};
use crate::operations::face::{Event, FaceJson};

/// The certified `optimum`; the `ways` with their bad lengths, times and paths, `chosen` among them; the `stretches` of the
/// chosen way edge by edge with their exit angles; `events`, the crossings of the real teeth, `paper`, `map` and `walk` where
/// they were wanted.
#[derive(Serialize)]
struct SheetJson<'a> {
    control: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    events: Vec<Event>,
    findings: &'a [Finding],
    #[serde(skip_serializing_if = "Option::is_none")]
    map: Option<MapJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<PaperJson>,
    program: &'a str,
    title: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    walk: Option<WalkJson>,
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

/// The way of the paper's method from the chosen placement.
#[derive(Serialize)]
struct WalkJson {
    #[serde(flatten)]
    descent: SimplexDescent,
    steps: Vec<SimplexStep>,
}

impl Serialize for FaceSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let sheet = SheetJson {
            control: self.control,
            events: self.events.iter().map(|c| self.face.event_json(c)).collect(),
            findings: &self.findings,
            map: self.map.as_ref().map(|map| MapJson::of(&self.face, map)),
            paper: self.paper.as_ref().map(|paper| self.paper_json(paper)),
            program: &self.program,
            title: &self.title,
            walk: self.walk.as_ref().map(|walk| self.walk_json(walk)),
            plan: self.face.plan_json(),
        };
        // As a value all fields stand in the order of their names.
        serde_json::to_value(sheet).map_err(S::Error::custom)?.serialize(serializer)
    }
}

impl FaceSheet {
    fn descent_json(&self, d: &SimplexDescent) -> SimplexDescent {
        SimplexDescent { start: self.face.seen(d.start), placement: self.face.seen(d.placement), ..*d }
    }

    fn walk_json(&self, walk: &SimplexWalk) -> WalkJson {
        let corner = |c: SimplexCorner| SimplexCorner { placement: self.face.seen(c.placement), ..c };
        let step = |s: &SimplexStep| SimplexStep { corners: s.corners.map(corner), ..*s };
        WalkJson { descent: self.descent_json(&walk.descent), steps: walk.steps.iter().map(step).collect() }
    }

    fn paper_json(&self, paper: &PaperBaseline) -> PaperJson {
        let face = &self.face;
        let descent = |d: &SimplexDescent| self.descent_json(d);
        let survey = paper.survey.iter().map(|p| SurveyPoint { placement: face.seen(p.placement), ..*p });
        PaperJson {
            descent_from_as_drawn: paper.from_drawn.as_ref().map(descent),
            descents: paper.descents.iter().map(descent).collect(),
            statistics: paper.statistics,
            survey: survey.collect(),
        }
    }
}
