//! The report in sections without pictures, for a terminal.

use super::{Report, before_run};
use crate::base::Finding;
use crate::page::{Block, Fact, Section, duration, inches, length};

/// Most findings listed; the rest is counted.
const FINDINGS: usize = 20;

/// Verdict, facts, tools, largest deviation, findings and the two lists.
pub fn sections(report: &Report) -> Vec<Section> {
    let verdict = &report.verdict;
    let mut sections = vec![Section::new(verdict.sentence.as_str()).with(Block::Facts(facts(report)))];
    if !report.findings.is_empty() {
        sections.push(findings(&report.findings));
    }
    if !verdict.proven.is_empty() {
        sections.push(Section::new("Proven").with(Block::List(verdict.proven.clone())));
    }
    if !verdict.not_checked.is_empty() {
        let mut open = Section::new("Not checked");
        for group in &verdict.not_checked {
            open.blocks.push(Block::Text(format!("{} ({})", group.heading.title(), group.count)));
            open.blocks.push(Block::List(group.items.iter().map(ToString::to_string).collect()));
        }
        sections.push(open);
    }
    sections.extend(before_run::section(&verdict.to_ensure));
    if !verdict.sha256.is_empty() {
        let hash = Block::Text(format!("Program SHA-256 {}", verdict.sha256));
        sections.push(Section::default().with(hash));
    }
    sections.push(Section::default().with(Block::Text(super::page::DRY_RUN.to_owned())));
    sections
}

fn facts(report: &Report) -> Vec<Fact> {
    let mut facts = Vec::new();
    if !report.title.is_empty() {
        facts.push(Fact::new("Part", report.title.as_str()));
    }
    if let Some(program) = &report.program {
        let lines = format!("{} for {}, {} lines", program.file, program.control, program.lines.len());
        facts.push(Fact::new("Program", lines));
    }
    facts.extend(super::facts::shown(report).into_iter().filter(|f| f.label != "Tools"));
    for (i, t) in report.tools.iter().enumerate() {
        let used = format!("T{} {}, {}, {} at feed", t.number, t.name, duration(t.time), length(t.length));
        let mut fact = Fact::new(if i == 0 { "Tools" } else { "" }, used);
        if report.inches {
            inches::fact(&mut fact, &inches::words);
        }
        facts.push(fact);
    }
    facts
}

/// The worst first.
fn findings(findings: &[Finding]) -> Section {
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by_key(|f| std::cmp::Reverse(f.severity));
    let shown = sorted.iter().take(FINDINGS).map(|f| format!("{} {} {f}", f.severity.word(), f.code));
    let more = sorted.len().checked_sub(FINDINGS + 1).map(|more| format!("and {} more", more + 1));
    Section::new(super::findings::count(findings)).with(Block::List(shown.chain(more).collect()))
}
