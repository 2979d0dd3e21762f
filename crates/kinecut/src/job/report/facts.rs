//! The row of numbers below the verdict: what the job says, completed by what the model knows.

use super::{Report, bands, extremes};
use crate::page::{Fact, duration, inches, micrometres};

/// The facts to show; one that the job gives itself (by its label) is not made again.
pub(super) fn shown(report: &Report) -> Vec<Fact> {
    let given = &report.verdict.facts;
    let has = |word: &str| given.iter().any(|f| f.label.to_lowercase().contains(word));
    let mut facts = Vec::new();
    if let Some(time) = report.time.filter(|_| !has("time")) {
        facts.push(Fact::new("Time at programmed feeds", duration(time)));
    }
    if let Some(fact) = deviation(report).filter(|_| !has("deviation")) {
        facts.push(fact);
    }
    if !report.tools.is_empty() && !has("tool") {
        let numbers: Vec<String> = report.tools.iter().map(|t| format!("T{}", t.number)).collect();
        // More numbers than this do not fit into the box and say nothing at a glance.
        let note = if numbers.len() <= 6 { numbers.join(", ") } else { String::new() };
        facts.push(Fact::new("Tools", numbers.len().to_string()).note(note));
    }
    facts.extend(given.iter().cloned());
    if report.inches {
        facts.iter_mut().for_each(|fact| inches::fact(fact, &inches::words));
    }
    facts
}

fn deviation(report: &Report) -> Option<Fact> {
    let part = report.part.as_ref()?;
    let (lo, hi) = extremes(part)?;
    let largest = if -lo > hi { lo } else { hi };
    let tolerance = f64::from(part.tolerance);
    let outside: f64 =
        bands(part).iter().filter(|b| is_outside(b.from, b.to, tolerance)).map(|b| b.share).sum();
    let share = match outside {
        s if s > 0.0 => format!("{} of the area is outside", crate::page::area_share(s)),
        _ => "all of it inside".to_owned(),
    };
    let limit = micrometres(tolerance);
    let note = format!("{}; allowed ±{}, {share}", side(largest), limit.trim_start_matches('+'));
    Some(Fact::new("Largest deviation", micrometres(largest)).note(note))
}

/// Whether a band lies outside the tolerance.
pub(super) fn is_outside(from: f64, to: f64, tolerance: f64) -> bool {
    // Borders are multiples of the tolerance: half of it is far from rounding and between no two of them.
    from > tolerance * 0.75 || to < -tolerance * 0.75
}

/// Word for the sign of a deviation [mm].
pub(super) fn side(deviation: f64) -> &'static str {
    match deviation {
        d if d < 0.0 => "too deep",
        d if d > 0.0 => "stock left",
        _ => "exact",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::report::{PartView, ReportVerdict, ToolView};

    #[test]
    fn what_the_job_says_is_not_said_twice() {
        let mut report = Report::new("t", ReportVerdict::new(crate::job::Judgement::Safe, ""));
        report.time = Some(75.0);
        report.tools = vec![ToolView::new(3, "mill", 16.0, 30.0), ToolView::new(7, "mill", 10.0, 30.0)];
        report.part = Some(PartView {
            vertices: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [9., 9., 0.]],
            triangles: vec![[0, 1, 2]],
            deviation: vec![0.03, 0.0, 0.0, -0.01],
            tolerance: 0.02,
            relative: false,
        });
        let values: Vec<_> = shown(&report).into_iter().map(|f| (f.value, f.note)).collect();
        assert_eq!(values[0].0, "1 min 15 s");
        assert_eq!(
            values[1],
            ("+30.0 µm".into(), "stock left; allowed ±20.0 µm, 33.3 % of the area is outside".into())
        );
        assert_eq!(values[2], ("2".into(), "T3, T7".into()));
        report.verdict.facts = vec![Fact::new("Time with stops", "2 min 00 s")];
        let labels: Vec<_> = shown(&report).into_iter().map(|f| f.label).collect();
        assert_eq!(labels, ["Largest deviation", "Tools", "Time with stops"]);
    }
}
