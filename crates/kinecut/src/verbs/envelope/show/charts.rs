//! Charts over the move: the volume that enters, the area that enters, the number of grazing curves.

use super::tables::rate_unit;
use crate::page::{Chart, Label};
use crate::verbs::envelope::EnvelopeSheet;

/// The charts of a sheet.
pub(crate) fn charts(sheet: &EnvelopeSheet) -> Vec<Chart> {
    let (by, unit) = rate_unit(sheet);
    let t = ("t", "");
    let over = |of: &dyn Fn(&crate::verbs::envelope::EnteringAt) -> f64| {
        sheet.entering.iter().map(|e| [e.t, of(e)]).collect::<Vec<_>>()
    };
    let mut rate = Chart::new("Volume that the tool enters", t, ("volume", unit))
        .series("all around", over(&|e| e.rate / by));
    let mut area =
        Chart::new("Surface that enters", t, ("area", "mm\u{b2}")).series("area", over(&|e| e.area));
    // A number of curves holds until the next moment.
    let mut steps = Vec::new();
    for pair in sheet.entering.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        steps.push([a.t, a.curves as f64]);
        if a.curves != b.curves {
            let middle = 0.5 * (a.t + b.t);
            steps.extend([[middle, a.curves as f64], [middle, b.curves as f64]]);
        }
    }
    steps.extend(sheet.entering.last().map(|e| [e.t, e.curves as f64]));
    let mut curves = Chart::new("Grazing curves", t, ("curves", "")).series("number", steps);
    for chart in [&mut rate, &mut area, &mut curves] {
        chart.marks = sheet
            .envelope
            .events
            .iter()
            .map(|e| Label {
                at: 0.5 * (e.between[0] + e.between[1]),
                text: format!("{}\u{2192}{}", e.before, e.after),
            })
            .collect();
    }
    vec![rate, area, curves]
}
