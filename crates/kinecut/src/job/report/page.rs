//! The page: verdict first, then facts, part and program, sections, tools, findings, what was checked.
//!
//! The file fetches nothing. Its content security policy says so to the browser and lets run only the one script and
//! the one style sheet whose hashes it carries; geometry is in elements that are data, not scripts.

use maud::{DOCTYPE, Markup, PreEscaped, html as markup};

use super::encode::{self, Scene};
use super::{Report, ReportVerdict, facts, findings, workspace};
use crate::job::Judgement;
use crate::page::inches;
use crate::page::shown::prose;
use crate::page::{
    Cell, Row, Table, blocks, duration, fixed, inline_json, length, policy_of, style, visible,
};

const SCRIPT: &str =
    concat!(include_str!("../../page/assets/picture.js"), include_str!("../../page/assets/report.js"));

/// Reminder of the check that no proof replaces.
pub(super) const DRY_RUN: &str = "A proof on a model does not replace the dry run: run the program above the part first, \
    with the hand on the feed override.";

/// The report as one HTML file without any reference to a network.
///
/// The same report gives the same bytes. All text from outside is escaped; control characters and marks of text
/// direction are made visible.
pub fn html(report: &Report) -> String {
    let (scene, plan) = rayon::join(|| encode::scene(report), || workspace::plan(report));
    let page = markup! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy());
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content=(format!("kinecut {}", visible(&report.version)));
                meta name="referrer" content="no-referrer";
                title { (report.verdict.outcome) ": " (visible(&report.title)) }
                style { (PreEscaped(style())) }
            }
            body {
                (head(report))
                main {
                    (banner(report))
                    (blocks::facts(&facts::shown(report)))
                    @if report.inches {
                        p.quiet { "Lengths are in inches; in the view of the part, in drawings, charts and plans they are in millimetres." }
                    }
                    (workspace::section(report, &scene, &plan))
                    @for (i, s) in report.sections.iter().enumerate() {
                        (blocks::section(s, &format!("section-{}", i + 1)))
                    }
                    (tools(report))
                    section #findings {
                        h2 { "Findings" span.count { (findings::count(&report.findings)) } }
                        (findings::list(report))
                    }
                    (checked(&report.verdict))
                    p.dry-run { (DRY_RUN) }
                }
                (foot(report))
                @if let Some(program) = &report.program { (workspace::program_text(program)) }
                (data(&scene, report))
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

fn policy() -> String {
    policy_of(&[SCRIPT], style())
}

fn head(report: &Report) -> Markup {
    markup! {
        header.top {
            div {
                p.maker { "kinecut report" @if !report.job_file.is_empty() { " · " code { (visible(&report.job_file)) } } }
                h1 { (visible(&report.title)) }
            }
            nav aria-label="Contents" {
                @if report.program.is_some() || report.part.is_some() || !report.path.is_empty() {
                    a href="#work" { "Part and program" }
                }
                @for (i, s) in report.sections.iter().enumerate() {
                    a href=(format!("#section-{}", i + 1)) { (visible(&s.title)) }
                }
                a href="#findings" { "Findings" }
                a href="#checked" { "Checked" }
                button #kc-theme.script type="button" title="Light or dark" aria-label="Light or dark" { "◐" }
            }
        }
    }
}

fn banner(report: &Report) -> Markup {
    let verdict = &report.verdict;
    let open = verdict.not_checked.len();
    let (outcome, class) = (verdict.outcome, outcome_class(verdict.outcome));
    markup! {
        section class={ "verdict " (class) } role="status" aria-label="Outcome" {
            svg.sign viewBox="0 0 48 48" width="60" height="60" aria-hidden="true" {
                @match outcome {
                    Judgement::Safe => {
                        circle cx="24" cy="24" r="23" {}
                        path d="M13 25l8 8 15-17" {}
                    }
                    Judgement::NotProven => {
                        path.plate d="M24 .8 47.2 24 24 47.2.8 24Z" {}
                        path d="M18 18.5c.4-8 12.6-7.6 12 .4-.3 4.6-6 4.7-6 10M24 35.3v.2" {}
                    }
                    Judgement::NotSafe => {
                        path.plate d="M14.5 1h19L47 14.5v19L33.5 47h-19L1 33.5v-19Z" {}
                        path d="M16 16l16 16M32 16l-16 16" {}
                    }
                }
            }
            div {
                p.word { (outcome) }
                p.headline { (prose(&verdict.headline)) }
                @if !verdict.scope.is_empty() {
                    p.scope { b { "Scope" } " " (prose(&format!("{}.", verdict.scope.join(". ")))) }
                }
            }
            p.counts {
                a href="#findings" { (findings::count(&report.findings)) }
                @if open > 0 {
                    br; a href="#checked" { (open) @if open == 1 { " group" } @else { " groups" } " not checked" }
                }
            }
        }
    }
}

/// The class that gives an outcome its colours.
fn outcome_class(outcome: Judgement) -> &'static str {
    match outcome {
        Judgement::Safe => "safe",
        Judgement::NotProven => "doubt",
        Judgement::NotSafe => "unsafe",
    }
}

fn tools(report: &Report) -> Markup {
    let tools = &report.tools;
    if tools.is_empty() {
        return Markup::default();
    }
    let mm = |v: f64| Cell::new(fixed(v, 3));
    let mut table = Table::new(
        "Tools in order of use",
        "T []; Name; Diameter [mm]; Corner radius [mm]; Cutting length [mm]; Stickout [mm]; \
             Teeth []; Time at feed []; Path at feed []; Remark",
    );
    for t in tools {
        let teeth = if t.teeth == 0 { "–".to_owned() } else { t.teeth.to_string() };
        table.rows.push(Row::new(vec![
            t.number.to_string().into(),
            t.name.clone().into(),
            mm(t.diameter),
            mm(t.corner),
            mm(t.flute_length),
            mm(t.stickout.unwrap_or(f64::NAN)),
            teeth.into(),
            duration(t.time).into(),
            length(t.length).into(),
            t.note.clone().into(),
        ]));
    }
    if report.inches {
        inches::table(&mut table, &inches::words);
    }
    markup! { section #tools { h2 { "Tools" } (blocks::table(&table)) } }
}

fn checked(verdict: &ReportVerdict) -> Markup {
    let lists = [
        ("Proven", "proven", &verdict.proven, "Nothing was proven."),
        ("Found", "found", &verdict.found, "Nothing was found."),
    ];
    markup! {
        section #checked {
            h2 { "Checks" }
            div.lists {
                @for (title, class, list, empty) in lists {
                    div class=(class) {
                        h3 { (title) }
                        @if list.is_empty() { p.quiet { (empty) } } @else {
                            ul { @for item in list { li { span { (prose(item)) } } } }
                        }
                    }
                }
                div.open {
                    h3 { "Not checked" }
                    @for group in &verdict.not_checked {
                        h4 { (group.heading.title()) " " span.quiet { (group.count) } }
                        ul { @for item in &group.items { li { span { (prose(&item.to_string())) } } } }
                    }
                }
            }
        }
    }
}

fn foot(report: &Report) -> Markup {
    markup! {
        footer {
            p { "kinecut " (visible(&report.version)) @if !report.job_file.is_empty() { " · job " code { (visible(&report.job_file)) } } }
            @if !report.verdict.sha256.is_empty() {
                p { "This verdict is about the program with SHA-256 " code.hash { (visible(&report.verdict.sha256)) }
                    ". After one changed character it is void." }
            }
        }
    }
}

/// The elements the script reads.
fn data(scene: &Scene, report: &Report) -> Markup {
    let lines: Vec<(u32, &str)> = report
        .findings
        .iter()
        .filter_map(|f| Some((findings::line_of(report, f)?, findings::look(f.severity).0)))
        .collect();
    // Numbers and fixed words always serialise.
    let lines = serde_json::to_string(&lines).unwrap_or_default();
    markup! {
        script #kc-head type="application/json" { (PreEscaped(inline_json(&scene.head))) }
        script #kc-marks type="application/json" { (PreEscaped(inline_json(&lines))) }
        @for (id, stream) in &scene.streams {
            script id=(id) type="text/plain" data-packed { (PreEscaped(stream)) }
        }
    }
}
