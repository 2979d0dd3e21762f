//! What a machine answers to a surface, as a person reads it.

use std::fmt::Write as _;

use super::on_machine_rows::{BudgetRow, CoverageRow, NearestRow, OnMachine, ResidualRow};

/// How nearness of machines is measured, in a sentence.
pub(crate) const NEARNESS: &str = "nearest by changes of the code (an axis or the bed more, less, another, or exchanged with its neighbour), \
     then by the number of axes and the mass that they move";

/// What the figures do not hold, in sentences.
pub(crate) const NOT_VERIFIED: [&str; 4] = [
    "the axes follow their laws exactly, and the tool has no errors of its own: the budget says what errors of the axes do",
    "errors of the spindle and of the tool, deflection, heat and wear are not in it",
    "the tool's body beside its edge, its holder and the way in and out are not compared with the part",
    "touching and rolling: the motion counts as continuous; the marks of single teeth and strokes are not in it",
];

impl ResidualRow {
    /// As a sentence.
    pub fn sentence(&self) -> String {
        let shown = |um: f64| (um * 1e3).round() / 1e3 + 0.0;
        format!(
            "off the surface by {} .. {} um, rms {} um",
            shown(self.least_um),
            shown(self.greatest_um),
            shown(self.rms_um)
        )
    }
}

impl CoverageRow {
    /// As a sentence.
    pub fn sentence(&self, tolerance_um: f64) -> String {
        // Rounded down: what is not whole must not read as 100 %.
        let percent = (self.share * 1e4).floor() / 1e2;
        let mut text = format!("covers {percent} % within {tolerance_um} um");
        if let (Some(area), Some([x, y, z])) = (self.gap_mm2, self.gap_at) {
            let _ = write!(text, "; largest gap {area:.1} mm2 at ({x:.2}, {y:.2}, {z:.2})");
        }
        text
    }
}

impl BudgetRow {
    /// As a sentence.
    pub fn sentence(&self) -> String {
        let axes: Vec<String> =
            self.axes.iter().map(|a| format!("{} {:.1}", a.axis, a.position_um)).collect();
        format!(
            "errors of the axes move it by {:.1} um (independent), {:.1} um (worst); by their positions alone, um: {}",
            self.independent_um,
            self.worst_um,
            axes.join(", ")
        )
    }
}

impl NearestRow {
    /// As sentences, one machine each.
    pub fn sentences(&self) -> Vec<String> {
        if self.machines.is_empty() {
            return vec![format!(
                "none of {} layouts of two to five axes can ({} classes)",
                self.layouts, self.classes
            )];
        }
        let one = |a: &super::AlternativeRow| {
            let changes = if a.distance == 1 { "change" } else { "changes" };
            format!("{} could, {} {changes}: {}", a.code, a.distance, a.changes.join(", "))
        };
        self.machines.iter().map(one).collect()
    }
}

fn part(code: &str) -> &str {
    if code.is_empty() { "-" } else { code }
}

impl OnMachine {
    /// As a person reads it.
    pub(crate) fn text(&self) -> String {
        let mut out = format!("\non machine {} {}", self.code, self.machine).trim_end().to_owned();
        out.push('\n');
        let line = |out: &mut String, text: &str| {
            let _ = writeln!(out, "            {text}");
        };
        for s in &self.splits {
            let can = if s.possible { "yes" } else { "no" };
            let _ = writeln!(
                out,
                "\n{:>9} | {:<6} {can}: {}",
                part(&s.machine_code),
                part(&s.tool_code),
                s.process
            );
            s.laws.iter().for_each(|law| line(&mut out, law));
            self.proof(&mut out, s.residual.as_ref(), s.coverage.as_ref(), s.budget.as_ref());
            if let Some(obstacle) = &s.obstacle {
                line(&mut out, &obstacle.to_string());
            }
            if let Some(nearest) = &s.nearest {
                nearest.sentences().iter().for_each(|text| line(&mut out, text));
            }
        }
        for e in &self.envelopes {
            let can = if e.possible { "yes" } else { "no" };
            let _ = writeln!(out, "\n{:>9} | {:<6} {can}: {}", e.method, "", e.process);
            line(&mut out, &format!("the tool is {}", e.tool));
            e.laws.iter().for_each(|law| line(&mut out, law));
            self.proof(&mut out, e.residual.as_ref(), e.coverage.as_ref(), e.budget.as_ref());
            if let Some(why) = &e.unverified {
                line(&mut out, &format!("not verified: {why}"));
            }
            if let Some(obstacle) = &e.obstacle {
                line(&mut out, &obstacle.to_string());
            }
        }
        let nearest = self.splits.iter().filter_map(|s| s.nearest.as_ref()).next();
        if let Some(nearest) = nearest {
            let _ = writeln!(
                out,
                "\nof {} layouts of two to five axes in {} classes that position alike: {NEARNESS}",
                nearest.layouts, nearest.classes
            );
        }
        if self.is_possible() {
            let _ = writeln!(
                out,
                "\nerrors of the axes for the budgets: {}; each in three directions and about three axes",
                self.errors
            );
            out.push_str("what these figures do not hold:\n");
            for what in NOT_VERIFIED {
                let _ = writeln!(out, "  {what}");
            }
        }
        out
    }

    fn proof(
        &self,
        out: &mut String,
        residual: Option<&ResidualRow>,
        coverage: Option<&CoverageRow>,
        budget: Option<&BudgetRow>,
    ) {
        let lines = [
            residual.map(ResidualRow::sentence),
            coverage.map(|c| c.sentence(self.tolerance_um)),
            budget.map(BudgetRow::sentence),
        ];
        for text in lines.into_iter().flatten() {
            let _ = writeln!(out, "            {text}");
        }
    }
}
