//! The report in some twenty lines for a terminal. No colours: the front end knows whether they are wanted.

use std::fmt::Write as _;

use super::Report;
use crate::base::Finding;
use crate::page::{duration, length, terminal};

/// Most findings listed; the rest is counted.
const FINDINGS: usize = 20;
/// Width of the labels.
const LABELS: usize = 24;

/// Verdict, facts, tools, largest deviation, findings and the three lists as plain text; control characters in text
/// from outside are spelled out.
pub fn text(report: &Report) -> String {
    let mut out = String::new();
    put(&mut out, report);
    out
}

fn put(out: &mut String, report: &Report) {
    let verdict = &report.verdict;
    line(out, &terminal(&verdict.sentence));
    out.push('\n');
    let mut fact = |label: &str, value: &str| {
        let pad = LABELS.saturating_sub(label.chars().count());
        line(out, &format!("  {}{} {}", terminal(label), " ".repeat(pad), terminal(value)));
    };
    if !report.title.is_empty() {
        fact("Part", &report.title);
    }
    if let Some(program) = &report.program {
        fact("Program", &format!("{} for {}, {} lines", program.file, program.control, program.lines.len()));
    }
    for f in super::facts::shown(report).iter().filter(|f| f.label != "Tools") {
        fact(
            &f.label,
            &if f.note.is_empty() { f.value.clone() } else { format!("{} ({})", f.value, f.note) },
        );
    }
    for (i, t) in report.tools.iter().enumerate() {
        let used = format!("T{} {}, {}, {} at feed", t.number, t.name, duration(t.time), length(t.length));
        fact(if i == 0 { "Tools" } else { "" }, &used);
    }
    findings(out, &report.findings);
    if !verdict.proven.is_empty() {
        out.push('\n');
        line(out, "Proven");
        for item in &verdict.proven {
            line(out, &format!("  - {}", terminal(item)));
        }
    }
    if !verdict.not_checked.is_empty() {
        out.push('\n');
        line(out, "Not checked");
        for group in &verdict.not_checked {
            line(out, &format!("  {} ({})", group.heading.title(), group.count));
            for item in &group.items {
                line(out, &format!("  - {}", terminal(&item.to_string())));
            }
        }
    }
    if !verdict.sha256.is_empty() {
        out.push('\n');
        line(out, &format!("Program SHA-256 {}", terminal(&verdict.sha256)));
    }
    out.push('\n');
    line(out, super::page::DRY_RUN);
}

fn findings(out: &mut String, findings: &[Finding]) {
    if findings.is_empty() {
        return;
    }
    out.push('\n');
    line(out, &super::findings::count(findings));
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by_key(|f| std::cmp::Reverse(f.severity));
    for f in sorted.iter().take(FINDINGS) {
        let word = f.severity.word();
        line(out, &format!("  {word} {} {}", f.code, terminal(&f.to_string())));
    }
    if sorted.len() > FINDINGS {
        line(out, &format!("  and {} more", sorted.len() - FINDINGS));
    }
}

fn line(out: &mut String, text: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(out, "{}", text.trim_end());
}
