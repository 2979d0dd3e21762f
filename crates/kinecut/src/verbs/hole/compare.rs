//! The sections of a comparison of strategies: table, graphs, paths in plan view, lead-ins, the paper's claims.

use super::HoleComparison;
use crate::holes::compare::{Claim, ComparedStrategy, Comparison, FREE, Figures, Holds};
use crate::job::report::PathRole;
use crate::machine::Interpolator;
use crate::page::{
    Block, Cell, Chart, Circle, Column, Fact, Plan, PlanLine, Row, Section, Table, fixed, length, trimmed,
};

/// Strategies that share a chart: more curves than this cannot be told apart, and the loops are many times longer.
const GROUPS: [(&str, &[&str]); 3] = [
    ("spirals", &["involute", "lens-1", "lens-2", "constant-engagement", FREE, "archimedean"]),
    ("arcs and rings", &["arcs-2", "arcs-4", "rings", "rings-tangent"]),
    ("loops", &["trochoidal"]),
];

/// A number with the digits that matter; a dash for `None`.
pub(super) fn number(v: Option<f64>) -> String {
    let Some(v) = v.filter(|v| v.is_finite()) else { return "\u{2013}".to_owned() };
    match v.abs() {
        0.0 => "0".to_owned(),
        a if a >= 1e5 => format!("{v:.2e}"),
        a if a >= 1000.0 => trimmed(v, 0),
        a if a >= 100.0 => trimmed(v, 1),
        a if a >= 1.0 => trimmed(v, 2),
        a if a >= 1e-4 => trimmed(v, 4),
        _ => format!("{v:.1e}"),
    }
}

/// A step; an impulse where a lower derivative steps already.
pub(super) fn step(v: Option<f64>) -> String {
    v.map_or_else(|| "impulse".to_owned(), |v| number(Some(v)))
}

/// All sections of one hole.
pub(super) fn sections(hole: &HoleComparison) -> Vec<Section> {
    let c = &hole.comparison;
    let mut sections = vec![overview(hole), smoothness(c), load(c), runs(c), motion(c), plans(c)];
    sections.extend(leads(c));
    sections.push(claims(&c.claims));
    sections
}

/// Those that say something without pictures.
pub(super) fn words(hole: &HoleComparison) -> Vec<Section> {
    let c = &hole.comparison;
    let mut sections = vec![overview(hole), smoothness(c), runs(c)];
    sections.extend(leads(c));
    sections.push(claims(&c.claims));
    sections
}

fn measured(c: &Comparison) -> impl Iterator<Item = (&'static str, &Figures)> {
    c.rows.iter().filter_map(|r| Some((r.strategy, r.figures.as_ref()?)))
}

fn overview(hole: &HoleComparison) -> Section {
    let c = &hole.comparison;
    let t = &c.terms;
    let mut section = Section::new(hole.title.clone());
    let start = if t.entry > 0.0 {
        Fact::new("Starts on a circle of", format!("\u{2300}{} mm", number(Some(2.0 * t.entry))))
            .note("run in full")
    } else {
        Fact::new("Starts", "in the centre")
    };
    section.blocks.push(Block::Facts(vec![
        Fact::new("Bore", format!("\u{2300}{} mm", number(Some(hole.diameter)))),
        Fact::new("Cutter", format!("\u{2300}{} mm", number(Some(2.0 * t.cutter)))),
        Fact::new("Path at the wall", format!("R {} mm", number(Some(t.wall))))
            .note(format!("allowance {} mm", number(Some(t.allowance)))),
        Fact::new("Largest step", format!("{} mm", number(Some(t.step))))
            .note(format!("engagement limit {:.0}\u{b0}, where one is kept", t.engagement.to_degrees())),
        start,
        Fact::new("Feed", format!("{} m/min", number(Some(t.limits.feed * 0.06)))).note(format!(
            "{} m/s\u{b2}, {} m/s\u{b3}",
            number(Some(t.limits.acceleration / 1000.0)),
            number(Some(t.limits.jerk / 1000.0))
        )),
    ]));
    let mut table = Table::new(
        "All strategies on this hole",
        "Strategy; Length [mm]; Turns []; Step [mm]; Blocks []; Engaged at most [\u{b0}]; \
             on average [\u{b0}]",
    );
    let feeds: Vec<f64> =
        measured(c).next().map_or(Vec::new(), |(_, f)| f.runs.iter().map(|t| t.feed).collect());
    for feed in &feeds {
        table.columns.push(Column::number(format!("Time at {} m/min", number(Some(feed * 0.06))), "s"));
    }
    let best: Vec<f64> = (0..feeds.len())
        .map(|i| {
            measured(c)
                .filter_map(|(_, f)| Some(f.runs.get(i)?.time))
                .fold(f64::INFINITY, |a, b| if b < a { b } else { a })
        })
        .collect();
    for row in &c.rows {
        table.rows.push(match &row.figures {
            Some(f) => figures_row(row, f, &best),
            None => Row::new(vec![Cell::new(row.strategy), Cell::new("not here")]),
        });
    }
    let refused = c.rows.iter().filter(|row| row.figures.is_none());
    table.notes = refused.map(why).collect();
    table.notes.extend([
        format!(
            "Length, time: circle at the entry, path and circle at the wall together, from rest to rest. Each time is that of \
             the run within the limits of each axis that a control of the kind {} makes; the table of runs has the joints.",
            interpolator(t.interpolator)
        ),
        format!(
            "Engaged: the largest and the mean of {} places along the path.",
            measured(c).map(|(_, f)| f.load.samples.len()).max().unwrap_or(0)
        ),
        format!("Blocks: as posted for {}, in brackets the control\u{2019}s own involutes.", t.control.title()),
        format!("{FREE}: the engagement alone limits the step; for the others the step asked for does."),
        "A helix at the wall and a ramping spiral also go down and are not compared in a plane.".to_owned(),
    ]);
    section.with(table)
}

fn figures_row(row: &ComparedStrategy, f: &Figures, best: &[f64]) -> Row {
    let blocks =
        if f.involutes > 0 { format!("{} ({})", f.blocks, f.involutes) } else { f.blocks.to_string() };
    let mut cells = vec![
        Cell::new(row.strategy),
        Cell::new(fixed(f.length, 2)),
        Cell::new(number(Some(f.turns))),
        Cell::new(number(Some(f.step))),
        Cell::new(blocks),
        Cell::new(fixed(f.load.most.to_degrees(), 1)),
        Cell::new(fixed(f.load.mean.to_degrees(), 1)),
    ];
    cells.extend(f.runs.iter().zip(best).map(|(t, best)| {
        let text = fixed(t.time, 2);
        if t.time <= *best { Cell::right(text) } else { Cell::new(text) }
    }));
    Row::new(cells)
}

/// Why a strategy cannot be taken here.
fn why(row: &ComparedStrategy) -> String {
    let why = row.error.as_ref().map_or("not possible", |e| e.message.as_str());
    format!("{}: not here: {why}.", row.strategy)
}

fn smoothness(c: &Comparison) -> Section {
    let mut table = Table::new(
        "Joints at the feed: what steps",
        "Strategy; At the wall; velocity [mm/s]; acceleration [mm/s\u{b2}]; \
             jerk [mm/s\u{b3}]; At the entry; Worst joint; velocity [mm/s]; \
             acceleration [mm/s\u{b2}]; jerk [mm/s\u{b3}]; Joints []",
    );
    let mut peaks = Table::new(
        "Peaks of the axes at constant feed, and around the joint with the wall",
        "Strategy; Velocity X, Y [mm/s]; Acceleration X, Y [mm/s\u{b2}]; \
             Jerk X, Y [mm/s\u{b3}]; One step out: acceleration [mm/s\u{b2}]; jerk [mm/s\u{b3}]; \
             Sampled at the wall: acceleration [mm/s\u{b2}]; jerk [mm/s\u{b3}]",
    );
    for (name, f) in measured(c) {
        let three = |j: Option<&crate::holes::compare::JointStep>| match j {
            Some(j) => [number(Some(j.steps.velocity)), step(j.steps.acceleration), step(j.steps.jerk)],
            None => [(); 3].map(|()| "\u{2013}".to_owned()),
        };
        let [v, a, j] = three(Some(&f.closing));
        let [wv, wa, wj] = three(f.worst.as_ref());
        let worst = f
            .worst
            .map_or("\u{2013}".to_owned(), |j| format!("{} at R {}", j.contact, number(Some(j.radius))));
        let entry = f.start.map_or("from rest".to_owned(), |j| j.contact.to_owned());
        let cells = [
            name.to_owned(),
            f.closing.contact.to_owned(),
            v,
            a,
            j,
            entry,
            worst,
            wv,
            wa,
            wj,
            f.joints.len().to_string(),
        ];
        table.rows.push(Row::new(cells.map(Cell::new).to_vec()));
        let pair = |p: [f64; 2]| format!("{}, {}", number(Some(p[0])), number(Some(p[1])));
        let [out_a, out_j] = f.at_step.map_or([None, None], |v| v.map(Some));
        let cells = [
            name.to_owned(),
            pair(f.peaks.velocity),
            pair(f.peaks.acceleration),
            pair(f.peaks.jerk),
            number(out_a),
            number(out_j),
            number(Some(f.closing_sampled.acceleration)),
            number(Some(f.closing_sampled.jerk)),
        ];
        peaks.rows.push(Row::new(cells.map(Cell::new).to_vec()));
    }
    table.notes = vec![
        "Contact from exact derivatives to the seventh: G1 a common tangent, G2 a common curvature, G3 and above no step of \
         jerk. An impulse: a lower derivative steps already. The worst joint is the one of lowest contact."
            .to_owned(),
    ];
    peaks.notes = vec![
        format!(
            "Within {} mm of the centre the feed is lowered, for all by the same law: to what a circle about the centre may have \
             there. Steps and impulses of joints are not in the peaks of the axes.",
            number(Some(c.capped_radius))
        ),
        "Sampled: second and third differences of positions each millisecond, for the worst phase of the clock; what a control \
         sees of a step."
            .to_owned(),
    ];
    Section::new("Smoothness").with(table).with(peaks)
}

/// A chart for each group of strategies that has one.
fn charts(
    c: &Comparison,
    title: &str,
    y: (&str, &str),
    of: impl Fn(&Figures) -> Vec<[f64; 2]>,
) -> Vec<(&'static str, Chart)> {
    GROUPS
        .iter()
        .filter_map(|(group, names)| {
            let mut chart = Chart::new(&format!("{title}, {group}"), ("path", "mm"), y);
            for (name, figures) in measured(c).filter(|(name, _)| names.contains(name)) {
                chart = chart.series(name, of(figures));
            }
            (!chart.series.is_empty()).then_some((*group, chart))
        })
        .collect()
}

fn heading(group: &str) -> Block {
    let mut letters = group.chars();
    Block::Heading(letters.next().map(|c| c.to_uppercase().chain(letters).collect()).unwrap_or_default())
}

fn load(c: &Comparison) -> Section {
    let mut section = Section::new("Load along the path");
    section.blocks.push(Block::Text(
        "Measured against all former positions of the cutter; the radial depth is that of a parallel wall that would engage \
         the cutter as much. The path ends with the circle at the wall."
            .to_owned(),
    ));
    let angles = charts(c, "Engagement", ("angle", "\u{b0}"), |f| {
        f.load.samples.iter().map(|s| [s.s, s.angle.to_degrees()]).collect()
    });
    let depths = charts(c, "Radial depth", ("depth", "mm"), |f| {
        f.load.samples.iter().map(|s| [s.s, s.depth]).collect()
    });
    for ((group, angle), (_, depth)) in angles.into_iter().zip(depths) {
        section.blocks.push(heading(group));
        section.blocks.push(angle.level(c.terms.engagement.to_degrees(), "limit, where kept").into());
        section.blocks.push(depth.level(c.terms.step, "step").into());
    }
    section
}

/// Name of an interpolator as in a machine file.
fn interpolator(of: Interpolator) -> &'static str {
    match of {
        Interpolator::JerkLimited => "jerk-limited",
        Interpolator::Trapezoid => "trapezoid",
        Interpolator::ExactStop => "exact-stop",
        Interpolator::JunctionDeviation => "junction-deviation",
        Interpolator::LinuxCnc => "linuxcnc",
    }
}

/// The runs of each strategy, at each feed.
fn runs(c: &Comparison) -> Section {
    let t = &c.terms;
    let mut table = Table::new(
        "Runs of all strategies",
        "Strategy; Feed [m/min]; Time [s]; without limit of jerk [s]; Stops []; Joints smoothed []; \
             off the path by [um]; Axes off the command by [um]; at R [mm]; on the circle at the wall by [um]",
    );
    for (name, f) in measured(c) {
        for run in &f.runs {
            // A control with a planner of its own does not tell.
            let count = |n: Option<usize>| n.map_or("not known".to_owned(), |n| n.to_string());
            let smoothed = match (run.smoothed, run.farthest) {
                (None, _) | (_, None) => "not known".to_owned(),
                (Some(0), _) => "\u{2013}".to_owned(),
                (_, Some(farthest)) => fixed(farthest * 1e3, 2),
            };
            let cells = [
                name.to_owned(),
                number(Some(run.feed * 0.06)),
                fixed(run.time, 3),
                fixed(run.without_jerk, 3),
                count(run.stops),
                count(run.smoothed),
                smoothed,
                fixed(run.servo.most * 1e3, 2),
                fixed(run.servo.radius, 1),
                fixed(run.servo.at_wall * 1e3, 3),
            ];
            table.rows.push(Row::new(cells.map(Cell::new).to_vec()));
        }
    }
    table.notes = vec![
        "Time: found; without limit of jerk: no run is faster. The control stops at a joint or smooths it within its tolerance, \
         whichever is faster; so it leaves the programmed path by as much as it says."
            .to_owned(),
        format!(
            "Axes off the command: what position loops of {} Hz bandwidth make of the motion, by a model: each axis of second \
             order, damping 0.71, nothing fed forward, the machine stiff. All of the run, start and stop too; at the wall on \
             the first three quarters of the circle.",
            number(Some(t.servo.bandwidth))
        ),
    ];
    Section::new("Runs on the machine").with(table)
}

fn motion(c: &Comparison) -> Section {
    let mut section = Section::new("Speed, acceleration and jerk along the path");
    section.blocks.push(Block::Text(format!(
        "The run at {} m/min. Acceleration and jerk of both axes together, along the path and across it, joints included.",
        number(Some(c.terms.limits.feed * 0.06))
    )));
    let run = |pick: fn(&crate::holes::compare::ProfilePlace) -> Option<f64>| {
        move |f: &Figures| f.profile.iter().filter_map(|p| Some([p.s, pick(p)?])).collect::<Vec<_>>()
    };
    let has_jerk = measured(c).any(|(_, f)| f.profile.iter().any(|p| p.jerk.is_some()));
    if !has_jerk {
        section.blocks.push(Block::Text(
            "This control has no limit of jerk: its acceleration steps, and there is no jerk to be shown."
                .to_owned(),
        ));
    }
    let speeds = charts(c, "Speed", ("speed", "mm/s"), run(|p| Some(p.speed)));
    let accelerations =
        charts(c, "Acceleration", ("acceleration", "mm/s\u{b2}"), run(|p| Some(p.acceleration)));
    let jerks = charts(c, "Jerk", ("jerk", "m/s\u{b3}"), run(|p| Some(p.jerk? / 1000.0)));
    for (((group, speed), (_, acceleration)), (_, jerk)) in speeds.into_iter().zip(accelerations).zip(jerks) {
        section.blocks.push(heading(group));
        section.blocks.extend([Block::from(speed), acceleration.into()]);
        section.blocks.extend(has_jerk.then(|| jerk.into()));
    }
    section
}

fn plans(c: &Comparison) -> Section {
    let mut section = Section::new("The paths");
    for (name, f) in measured(c) {
        let mut plan = Plan::new(format!("{name}, {}", length(f.length)));
        plan.lines = vec![PlanLine::new(PathRole::Rough.ink(), PathRole::Rough.word(), f.drawing.clone())];
        plan.circles = vec![Circle { radius: c.terms.wall + c.terms.cutter, ..Circle::default() }];
        section.blocks.push(plan.into());
    }
    section
}

fn leads(c: &Comparison) -> Option<Section> {
    if c.lead_ins.is_empty() {
        return None;
    }
    let mut chart = Chart::new("Engagement before the wall", ("way to the wall", "mm"), ("angle", "\u{b0}"));
    let mut table = Table::new(
        format!(
            "Lead-ins of {} turns into an allowance of {} mm",
            c.terms.lead_turns,
            number(Some(c.terms.allowance))
        ),
        "Contact; First touch before the wall [rad]; Way in the stock [mm]; \
             of it below a tenth of the allowance [mm]; Engaged at the wall [\u{b0}]; \
             Fastest growth [\u{b0}/mm]",
    );
    for lead in &c.lead_ins {
        let points = lead.samples.iter().map(|s| [s.s - lead.way, s.angle.to_degrees()]).collect();
        chart = chart.series(format!("G{}", lead.contact), points);
        let cells = [
            format!("G{}", lead.contact),
            fixed(lead.touch, 4),
            fixed(lead.way, 2),
            fixed(lead.thin_way, 2),
            fixed(lead.engaged.to_degrees(), 2),
            fixed(lead.growth.to_degrees(), 3),
        ];
        table.rows.push(Row::new(cells.map(Cell::new).to_vec()));
    }
    table.notes = vec![
        "A higher contact touches earlier and longer with thin chips, which rub. G2 is the default for finishing, G4 for high \
         feeds."
            .to_owned(),
    ];
    Some(Section::new("Finishing: growth of the engagement over the lead-in").with(table).with(chart))
}

fn claims(claims: &[Claim]) -> Section {
    let mut section = Section::new("The paper's claims, on this hole");
    let mut table = Table::new("Sorokin, But, Kombarov 2013", "Claim; Holds; Found");
    for claim in claims {
        let holds = match claim.holds {
            Holds::Yes => Cell::right("holds"),
            Holds::Partly => Cell::new("in part"),
            Holds::No => Cell::wrong("does not hold"),
        };
        table.rows.push(Row::new(vec![Cell::new(claim.claim), holds, Cell::new(claim.found.clone())]));
    }
    section.blocks.push(table.into());
    section
}
