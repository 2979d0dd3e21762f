//! Findings on the page: worst first, each with its place in the program and in space.

use maud::{Markup, html};

use super::Report;
use crate::base::{Finding, Quantity, Severity};
use crate::page::shown::prose;
use crate::page::visible;

/// Most findings shown; more than this nobody reads, and the page stays light.
const SHOWN: usize = 500;

/// "2 errors, 1 warning"; "no findings".
pub(super) fn count(findings: &[Finding]) -> String {
    let of = |severity| findings.iter().filter(|f| f.severity == severity).count();
    let words: Vec<String> = Severity::WORST_FIRST
        .into_iter()
        .map(|severity| (of(severity), severity))
        .filter(|(n, _)| *n > 0)
        .map(|(n, severity)| {
            // "3 not proven", "3 errors".
            let plural = if n == 1 || severity == Severity::Doubt { "" } else { "s" };
            format!("{n} {}{plural}", severity.word())
        })
        .collect();
    if words.is_empty() { "no findings".to_owned() } else { words.join(", ") }
}

/// The severity as class, sign and word.
pub(super) fn look(severity: Severity) -> (&'static str, &'static str, &'static str) {
    match severity {
        Severity::Error => ("error", "✕", "Error"),
        Severity::Doubt => ("doubt", "?", "Not proven"),
        Severity::Warning => ("warning", "!", "Warning"),
        Severity::Note => ("note", "i", "Note"),
    }
}

/// The line of the program, from 0, in which a finding lies.
pub(super) fn line_of(report: &Report, finding: &Finding) -> Option<u32> {
    let program = report.program.as_ref()?;
    let place = finding.place.as_ref()?;
    let own = program.programs().into_iter().find(|(file, ..)| same_file(&place.file, file))?;
    let line = own.1 + (place.line as usize).checked_sub(1)?;
    (line < own.2).then_some(line as u32)
}

/// A program is posted into a folder: its findings may carry the path, its title the name, or the other way round.
fn same_file(a: &str, b: &str) -> bool {
    let name = |s: &str| s.rsplit(['/', '\\']).next().unwrap_or("").to_owned();
    a == b || name(a) == name(b)
}

/// The list of findings.
pub(super) fn list(report: &Report) -> Markup {
    let mut sorted: Vec<&Finding> = report.findings.iter().collect();
    sorted.sort_by_key(|f| std::cmp::Reverse(f.severity));
    html! {
        @if sorted.is_empty() {
            p.quiet { "Nothing was found by what was checked; see the lists below for what was not." }
        } @else {
            ul.findings {
                @for f in sorted.iter().take(SHOWN) { (item(report, f)) }
            }
            @if sorted.len() > SHOWN {
                p.quiet { "and " (sorted.len() - SHOWN) " more; " code { "verdict.json" } " lists all." }
            }
        }
    }
}

fn item(report: &Report, finding: &Finding) -> Markup {
    let (class, sign, word) = look(finding.severity);
    let line = line_of(report, finding);
    let called = line.zip(report.program.as_ref()).map(|(line, program)| program.line_name(line));
    let point = finding.point.filter(|p| p.iter().all(|v| v.is_finite()));
    let shown = |q: &Option<Quantity>| {
        q.as_ref().filter(|q| q.value.is_finite()).map(|q| visible(&q.to_string()).into_owned())
    };
    let (value, bound) = (shown(&finding.value), shown(&finding.bound));
    let point_data = point.map(|p| format!("{} {} {}", p[0], p[1], p[2]));
    html! {
        li class=(class) {
            span.badge { span.sign aria-hidden="true" { (sign) } " " (word) }
            " " code.code { (finding.code) }
            " " span.message { (prose(&finding.message)) }
            @if value.is_some() || bound.is_some() {
                span.numbers {
                    @if let Some(v) = value { " " b { (v) } }
                    @if let Some(b) = bound { " (bound " (b) ")" }
                }
            }
            @if !finding.help.is_empty() { span.cure { (prose(&finding.help)) } }
            span.place {
                @if let Some(line) = line {
                    button.jump.script type="button" data-line=(line) data-point=[point_data.as_deref()] {
                        (visible(called.as_deref().unwrap_or_default()))
                    }
                    span.unscripted { (visible(called.as_deref().unwrap_or_default())) }
                } @else if let Some(place) = &finding.place {
                    span { (visible(&place.file)) @if place.line > 0 { ":" (place.line) } }
                }
                @if let Some(key) = &finding.key { " " code { (visible(key)) } }
                @if let Some(p) = point {
                    @if line.is_none() {
                        button.jump.script type="button" data-point=[point_data.as_deref()] { "show" }
                    }
                    span.coordinates { " X " (crate::page::fixed(p[0], 3)) " Y " (crate::page::fixed(p[1], 3)) " Z " (crate::page::fixed(p[2], 3)) }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Code, Location};
    use crate::job::Judgement;
    use crate::job::report::{ProgramPart, ProgramView, ReportVerdict};

    #[test]
    fn counts_read_as_english() {
        let e = Finding::error(Code::RAPID_IN_STOCK, "a");
        let n = Finding::note(Code::STOCK_LEFT, "b");
        assert_eq!(count(&[e.clone(), n.clone(), e]), "2 errors, 1 note");
        assert_eq!(count(&[]), "no findings");
    }

    #[test]
    fn a_finding_is_linked_only_into_the_program_shown() {
        let mut report = Report::new("t", ReportVerdict::new(Judgement::NotSafe, ""));
        report.program = Some(ProgramView {
            file: "out/BORE.MPF".into(),
            lines: vec!["a".into(), "b".into()],
            ..Default::default()
        });
        let at = |file: &str, line| {
            let place = Location { line, ..Location::whole_file(file) };
            line_of(&report, &Finding::error(Code::NC_WORD, "x").at(place))
        };
        assert_eq!(at("BORE.MPF", 2), Some(1));
        assert_eq!(at("BORE.MPF", 3), None);
        assert_eq!(at("BORE.MPF", 0), None);
        assert_eq!(at("job.toml", 1), None);
    }

    #[test]
    fn findings_of_several_programs_lead_to_their_own_lines() {
        let mut report = Report::new("t", ReportVerdict::new(Judgement::NotSafe, ""));
        let part = |file: &str, first| ProgramPart { file: file.into(), first };
        report.program = Some(ProgramView {
            file: "A.nc, B.nc".into(),
            lines: vec!["a".into(), "b".into(), "c".into()],
            parts: vec![part("A.nc", 0), part("B.nc", 1)],
            ..Default::default()
        });
        let at = |file: &str, line| {
            let place = Location { line, ..Location::whole_file(file) };
            line_of(&report, &Finding::error(Code::NC_WORD, "x").at(place))
        };
        assert_eq!(
            [at("A.nc", 1), at("A.nc", 2), at("B.nc", 2), at("B.nc", 3)],
            [Some(0), None, Some(2), None]
        );
        let program = report.program.as_ref().unwrap();
        assert_eq!([program.line_name(0), program.line_name(2)], ["A.nc line 1", "B.nc line 2"]);
    }
}
