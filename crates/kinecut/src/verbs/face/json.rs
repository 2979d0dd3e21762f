//! The sheet of `kinecut face` as JSON, in the units of the shop: mm, degrees, s, mm/min.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{FaceSheet, PaperBaseline};
use crate::facing::{Descent, Placement};
use crate::operations::face::{FaceJson, deg};

/// The sheet as JSON: mm, degrees, s, mm/min.
///
/// `placement`, `value`, `lower_bound` of the certified `optimum`; the `ways` with their bad lengths, times and paths,
/// `chosen` among them; the `stretches` of the chosen way edge by edge with their exit angles; `events`, the crossings of
/// the real teeth, and `paper` where they were wanted.
impl Serialize for FaceSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let shown = FaceJson { face: &self.face };
        let mut sheet = shown.plan();
        sheet["title"] = json!(self.title);
        sheet["control"] = json!(self.control);
        sheet["findings"] = json!(self.findings);
        sheet["program"] = json!(self.program);
        if !self.events.is_empty() {
            sheet["events"] = self.events.iter().map(|c| shown.event(c)).collect();
        }
        if let Some(paper) = &self.paper {
            sheet["paper"] = baseline_json(&shown, paper);
        }
        sheet.serialize(serializer)
    }
}

/// What the paper's program does with the same face.
fn baseline_json(shown: &FaceJson<'_>, paper: &PaperBaseline) -> Value {
    let survey = paper.survey.iter().map(|p| {
        json!({
            "placement": shown.placement(Placement { angle: p.angle, offset: p.offset }),
            "covered": p.covered,
            "largest_exit_angle": deg(p.largest_exit_angle),
            "bad": p.bad,
        })
    });
    let descent = |d: &Descent| {
        json!({
            "start": shown.placement(d.start),
            "end": shown.placement(d.placement),
            "value": d.value,
            "evaluations": d.evaluations,
        })
    };
    let statistics = paper.statistics.map(|s| {
        json!({
            "best": s.best,
            "median": s.median,
            "worst": s.worst,
            "within_one_percent": s.within_one_percent,
            "evaluations": s.evaluations,
        })
    });
    json!({
        "survey": survey.collect::<Vec<_>>(),
        "descent_from_as_drawn": paper.from_drawn.as_ref().map(descent),
        "descents": paper.descents.iter().map(descent).collect::<Vec<_>>(),
        "statistics": statistics,
    })
}
