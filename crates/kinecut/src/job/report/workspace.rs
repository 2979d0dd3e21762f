//! 3-D view, program and plan: the part of the page that shares one cursor. Without its script the page still shows the
//! program as text, the plan and the deviation as a table.

use maud::{Markup, html};

use super::encode::{Scene, packs_text};
use super::facts::is_outside;
use super::path::seen_from_above;
use super::{PartView, ProgramView, Report, bands};
use crate::page::{area_share, duration, fixed, inches, length, plan, trimmed, visible};

/// View and program side by side, the plan below the view.
pub(super) fn section(report: &Report, scene: &Scene, plan: &Markup) -> Markup {
    let has_view = report.part.is_some() || !report.path.is_empty();
    if !has_view && report.program.is_none() {
        return Markup::default();
    }
    html! {
        section #work aria-label="Part, path and program" {
            div class={ "work" @if !has_view || report.program.is_none() { " single" } } {
                @if has_view { (view(report, scene)) }
                (plan)
                @if let Some(p) = &report.program { (program(p, report.inches)) }
            }
        }
    }
}

/// The path from above; nothing without a path.
pub(super) fn plan(report: &Report) -> Markup {
    if report.path.is_empty() { Markup::default() } else { plan::figure(&seen_from_above(&report.path)) }
}

fn view(report: &Report, scene: &Scene) -> Markup {
    html! {
        div.view {
            div.bar.script role="toolbar" aria-label="View" {
                span.group role="group" aria-label="Direction of view" {
                    @for (view, word) in [("iso", "Iso"), ("top", "Top"), ("front", "Front"), ("right", "Right")] {
                        button type="button" data-view=(view) { (word) }
                    }
                }
                span.group role="group" aria-label="Shown" {
                    @if report.part.is_some() { (switch("part", "Part", true)) }
                    @if report.playback.is_some() { (switch("now", "Stock now", false)) }
                    @if !report.path.is_empty() {
                        (switch("path", "Path", true))
                        (switch("rapids", "Rapids", true))
                        (switch("past", "Only up to here", false))
                        (switch("tool", "Tool", true))
                        @if !report.fixtures.is_empty() { (switch("fixtures", "Fixtures", true)) }
                        @if report.machine.is_some() { (switch("machine", "Machine", false)) }
                    }
                }
                @if report.path.iter().any(|piece| !piece.engaged.is_empty()) {
                    label { "Path by "
                        select #kc-colour {
                            @for (value, word) in [("", "move"), ("arc", "arc of contact"), ("chip", "chip")] {
                                option value=(value) { (word) }
                            }
                        }
                    }
                }
                span.group {
                    label { "Cut "
                        select #kc-clip-axis {
                            option value="" { "off" }
                            @for a in ["X", "Y", "Z"] { option value=(a) { (a) } }
                        }
                    }
                    input #kc-clip type="range" min="0" max="1000" value="500" disabled aria-label="Place of the section plane";
                    output #kc-clip-at {}
                }
            }
            div.stage {
                canvas #kc-canvas.script tabindex="0" role="img" aria-label=(alternative(report)) {}
                img #kc-still alt="" hidden;
                p #kc-no-view.fallback {
                    span.unscripted { "The 3-D view needs JavaScript. " }
                    span.reason {}
                    @if report.program.as_ref().is_some_and(packs_text) {
                        "The plan and the tables show the same numbers."
                    } @else {
                        "The plan, the tables and the program text show the same numbers."
                    }
                }
                div #kc-readout.readout.script aria-live="off" {}
                div #kc-scale hidden { span { "0" } i aria-hidden="true" {} span {} }
                @if let Some(part) = &report.part { (legend(part, scene)) }
                @if let Some(played) = &report.playback {
                    p.moment.quiet.script { "Stock at this moment, of points " (trimmed(played.step, 2)) " mm apart" }
                }
            }
            @if let Some(step) = report.drawn_step {
                p.bar.quiet { "Part drawn from lines " (trimmed(step, 3)) " mm apart: what is thinner may not show. Numbers are of all lines." }
            }
            @if !report.path.is_empty() { (player()) }
        }
    }
}

fn switch(id: &str, word: &str, on: bool) -> Markup {
    html! { label.switch { input type="checkbox" data-show=(id) checked[on]; (word) } }
}

fn player() -> Markup {
    html! {
        div.player.script role="group" aria-label="Playback" {
            button #kc-back type="button" title="One block back (arrow left)" aria-label="One block back" { "◂" }
            button #kc-play type="button" title="Play (space)" aria-label="Play" { "▶" }
            button #kc-next type="button" title="One block on (arrow right)" aria-label="One block on" { "▸" }
            div.slide {
                input #kc-time type="range" min="0" max="10000" value="0" step="1" aria-label="Place in the program";
                canvas #kc-load role="img" hidden {}
            }
            label { span.quiet { "speed " }
                select #kc-speed {
                    option value="0" selected { "fit" }
                    @for n in [1, 10, 60, 600] { option value=(n) { (n) "×" } }
                }
            }
            label { span.quiet { "stop at " }
                select #kc-stops {
                    option value="" selected { "the end" }
                    @for (value, word) in [("findings", "findings"), ("tools", "tool changes"), ("lines", "every line")] {
                        option value=(value) { (word) }
                    }
                }
            }
            output #kc-clock {}
        }
    }
}

/// The picture in words.
fn alternative(report: &Report) -> String {
    let mut text = String::new();
    if let Some(part) = &report.part {
        text += &format!("The cut part, {} triangles. ", part.triangles.len());
    }
    if !report.path.is_empty() {
        text += &format!("The path of the tool in {} pieces. ", report.path.len());
    }
    text + "Drag turns, wheel zooms, a click on the path finds its line."
}

/// The bands of deviation: colours, limits in micrometres, shares of area.
fn legend(part: &PartView, scene: &Scene) -> Markup {
    let bands = bands(part);
    let tolerance = f64::from(part.tolerance);
    // Half the tolerance is the border with the most decimals.
    let half = tolerance * 500.0;
    let decimals = (0..2)
        .find(|&d| (half * 10f64.powi(d) % 1.0).min(1.0 - half * 10f64.powi(d) % 1.0) < 0.01)
        .unwrap_or(2);
    let um = |mm: f64| match part.relative {
        true => fixed(mm, 1),
        false => fixed(mm * 1000.0, decimals as usize),
    };
    let caption = if part.relative { "Deviation [tolerances]" } else { "Deviation [µm]" };
    html! {
        @if !bands.is_empty() {
            div.bands {
                table {
                    caption { (caption) }
                    thead.hidden { tr { th scope="col" { "band" } th scope="col" { "share of area" } } }
                    tbody {
                        @for (i, b) in bands.iter().enumerate().rev() {
                            tr class=[is_outside(b.from, b.to, tolerance).then_some("outside")] {
                                th scope="row" {
                                    i class=(format!("swatch b{i}")) aria-hidden="true" {}
                                    @if i + 1 == bands.len() { "over " (um(b.from)) }
                                    @else if i == 0 { "under " (um(b.to)) }
                                    @else { (um(b.from)) " to " (um(b.to)) }
                                    @if i + 1 == bands.len() { " " small { "stock left" } }
                                    @if i == 0 { " " small { "too deep" } }
                                }
                                td.number { (area_share(b.share)) }
                            }
                        }
                    }
                }
                p.quiet { i.swatch.none aria-hidden="true" {} "not compared" }
                @if let Some(cell) = scene.thinned {
                    p.quiet { "Shown with cells of " (fixed(cell, 3)) " mm; numbers are of the full mesh." }
                }
            }
        }
    }
}

fn program(program: &ProgramView, in_inches: bool) -> Markup {
    let total = |v: &[f32]| v.iter().map(|&x| f64::from(x)).filter(|x| x.is_finite()).sum::<f64>();
    let mut way = length(total(&program.length));
    if in_inches {
        inches::words(&mut way);
    }
    html! {
        div.program {
            header {
                h2 { (visible(&program.file)) }
                p.quiet {
                    @if !program.control.is_empty() { (visible(&program.control)) " · " }
                    (program.lines.len()) " lines"
                    @if !program.time.is_empty() { " · " (duration(total(&program.time))) }
                    @if !program.length.is_empty() { " · " (way) }
                }
            }
            @if program.parts.len() > 1 { div #kc-tabs.tabs.script role="tablist" aria-label="Programs" {} }
            div #kc-list.list.script tabindex="0" role="listbox" aria-label="Program" aria-describedby="kc-keys" {}
            p #kc-line.current.script aria-live="polite" { "Click a line, or step with the arrow keys." }
            p #kc-keys.hidden { "Arrow keys step through the lines, Home and End go to the ends, space plays." }
            p.unscripted.quiet.remark {
                @if packs_text(program) { span.packed { (PACKED) } } @else { a href="#program-text" { "The text stands at the end." } }
            }
        }
    }
}

/// Told where the list would be, on a page without script.
const PACKED: &str = "This program is long, and its text is packed: the page shows it with JavaScript only.";

/// The program as plain text at the end of the page: for paper, for pages without script, and the source of the list. A long
/// one is neither printed nor there as text.
pub(super) fn program_text(program: &ProgramView) -> Markup {
    let digits = program.lines.len().to_string().len();
    if packs_text(program) {
        let told = format!("The program text is not printed: it has {} lines.", program.lines.len());
        return html! {
            section #program-text {
                h2 { "Program text" span.count { (visible(&program.file)) } }
                p.unscripted.packed.quiet { (PACKED) }
                p.quiet.paper { (told) }
            }
        };
    }
    html! {
        section #program-text.printed {
            h2 { "Program text" span.count { (visible(&program.file)) } }
            @for (file, from, to) in program.programs() {
                @if !program.parts.is_empty() { h3 { (visible(file)) } }
                // The line end after <pre> is dropped by the parser: without it an empty first line would be lost.
                pre.kc-program data-prefix=(digits + 2) data-file=(visible(file)) {
                    "\n"
                    @for (i, line) in program.lines[from..to].iter().enumerate() {
                        @if i > 0 { "\n" }
                        (format!("{:>digits$}  ", i + 1)) (visible(line))
                    }
                }
            }
        }
    }
}
