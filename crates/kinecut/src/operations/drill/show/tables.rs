//! Facts and tables of a drilled hole.

use std::f64::consts::TAU;

use super::DrilledHole;
use super::contact::contacts;
use super::point::degrees;
use crate::drilling::{DrillSpec, GIVEN, Mouth, PRINTED_LENGTHS, PaperResult, Side, Zone, ZoneStage};
use crate::page::{Cell, Column, Fact, Row, Table, duration, fixed};

/// Lengths that differ by less are the same to the digits shown [mm].
const SAME: f64 = 5e-4;

/// A time [s] with the digits of the paper.
pub(super) fn seconds(t: f64) -> String {
    if t < 100.0 { format!("{} s", fixed(t, 3)) } else { duration(t) }
}

/// Revolutions in a minute from rad/s.
pub(super) fn rpm(spindle: f64) -> f64 {
    spindle / TAU * 60.0
}

/// Which point touches first, in words.
pub(super) fn first_contact(hole: &DrilledHole) -> String {
    let [first, _] = contacts(&hole.spec.entry, &hole.plan.entry);
    format!("{}, r {} mm", first.place(hole.plan.edge.outer_radius()), fixed(first.radius, 3))
}

/// The facts above everything.
pub(super) fn facts(hole: &DrilledHole) -> Vec<Fact> {
    let (spec, plan) = (hole.spec, hole.plan);
    let point = spec.point.name();
    let saved = plan.constant_time - plan.time;
    let share = if plan.constant_time > 0.0 { saved / plan.constant_time } else { 0.0 };
    let mut facts = vec![
        Fact::new("Tool", format!("\u{2300}{} mm", trimmed(spec.diameter))).note(point),
        Fact::new("Method", spec.method.word()),
        Fact::new("Speed", format!("{} rev/min", fixed(rpm(plan.spindle), 1))).note(format!(
            "{} m/min at the largest diameter that cuts",
            fixed(plan.spindle * plan.edge.outer_radius() * 0.06, 1)
        )),
        Fact::new("Working stroke L_rx", format!("{} mm", fixed(plan.lengths.stroke, 3))),
        Fact::new("Time at feed", seconds(plan.time)).note(format!(
            "{} at one safe feed: {} % saved",
            seconds(plan.constant_time),
            fixed(100.0 * share, 1)
        )),
        Fact::new("Touches first", first_contact(hole)),
    ];
    let balance = plan.balance;
    if balance.eccentricity > 0.0 {
        let note = if balance.eccentricity < 1.0 {
            format!("two opposite lips differ by up to {} mm in radius", fixed(balance.difference, 3))
        } else {
            "the corner touches before the tip: one lip has all the load".to_owned()
        };
        facts.push(Fact::new("Lip imbalance", imbalance(balance.eccentricity)).note(note));
    }
    if let [Some(entry), exit] = plan.coordinates.best_zeros {
        let exit = exit.map_or(String::new(), |z| format!(", W_k at {} mm", fixed(z, 3)));
        facts.push(
            Fact::new("Best zeros", format!("W_h at {} mm{exit}", fixed(entry, 3)))
                .note("then the entry starts at the approach and the exit at 0"),
        );
    }
    facts
}

/// The eccentricity of the engaged edge; infinite for a flat point on an inclined face.
pub(super) fn imbalance(eccentricity: f64) -> String {
    if eccentricity.is_finite() { fixed(eccentricity, 3) } else { "one-sided".to_owned() }
}

/// A number without needless zeros, three decimals at most.
pub(super) fn trimmed(v: f64) -> String {
    let text = fixed(v, 3);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Source of a zone's feed.
pub(super) fn source<'a>(hole: &DrilledHole<'a>, stage: ZoneStage) -> &'a str {
    let [entry, steady, exit] = hole.plan.feed_sources;
    match stage {
        ZoneStage::Entry => entry,
        ZoneStage::Exit => exit,
        ZoneStage::Mixed if hole.plan.feeds.exit < hole.plan.feeds.entry => exit,
        ZoneStage::Mixed => entry,
        ZoneStage::Partial if hole.plan.feeds.entry < hole.plan.feeds.steady => entry,
        ZoneStage::Partial | ZoneStage::Steady | ZoneStage::Air => steady,
    }
}

/// The zones with Z in both frames.
pub(super) fn zones(hole: &DrilledHole) -> Table {
    let plan = hole.plan;
    let through = plan.exit.is_some();
    let exit = if through { "Z from [mm, W_k]; Z to [mm, W_k]; " } else { "" };
    let columns = format!(
        "Zone; Z from [mm, W_h]; Z to [mm, W_h]; {exit}Length [mm]; Feed [mm/rev]; Feed [mm/min]; Revolutions []; \
         Time [s]; Source of the feed"
    );
    let row = |z: &Zone| {
        let mut cells: Vec<Cell> =
            vec![z.stage.word().into(), fixed(z.from, 3).into(), fixed(z.to, 3).into()];
        if through {
            cells.extend([z.from, z.to].map(|v| Cell::new(fixed(v + hole.spec.length, 3))));
        }
        cells.extend([
            fixed(z.length(), 3).into(),
            trimmed(z.feed).into(),
            fixed(z.feed * rpm(plan.spindle), 1).into(),
            fixed(z.revolutions(), 2).into(),
            fixed(z.time(plan.spindle), 3).into(),
            source(hole, z.stage).into(),
        ]);
        Row::new(cells)
    };
    let mut table = Table::new("Zones of one feed", &columns).rows(plan.zones.iter().map(row));
    let all = &plan.zones;
    let total = |f: &dyn Fn(&Zone) -> f64, decimals| Cell::new(fixed(all.iter().map(f).sum(), decimals));
    let mut cells = vec![Cell::new("all")];
    cells.extend((0..if through { 4 } else { 2 }).map(|_| Cell::default()));
    cells.push(total(&|z| z.length(), 3));
    cells.extend([Cell::default(), Cell::default()]);
    cells.push(total(&|z| z.revolutions(), 2));
    cells.push(total(&|z| z.time(plan.spindle), 3));
    table.rows.push(Row::new(cells));
    table.notes.push(
        "Z of the lowest cutting point of the tool; W_h and W_k are the frames of entry and exit.".to_owned(),
    );
    if plan.feed_sources.iter().all(|s| *s == GIVEN) {
        table.columns.pop();
        table.notes.push("All feeds as given.".to_owned());
    }
    table
}

/// Name, meaning, value and the paper's value of each length and coordinate.
pub(super) fn lengths(hole: &DrilledHole) -> Vec<(&'static str, &'static str, f64, Option<f64>)> {
    let (l, z) = (&hole.plan.lengths, &hole.plan.coordinates);
    let p = hole.paper;
    let pl = p.map(|p| &p.lengths);
    let pz = p.map(|p| &p.coordinates);
    let mut rows = vec![
        ("L_vr1", "length of the point", l.point, pl.map(|p| p.point)),
        ("L_vr2", "what the entry surface adds", l.entry_surface, pl.map(|p| p.entry_surface)),
        ("L_nvr", "first contact from W_h", l.to_entry, pl.map(|p| p.to_entry)),
        ("L_vr", "entry with approach", l.entry, pl.map(|p| p.entry)),
        ("L_ust", "steady cutting", l.steady, pl.map(|p| p.steady)),
    ];
    if let (Some(extra), Some(to), Some(exit)) = (l.exit_surface, l.to_exit, l.exit) {
        rows.extend([
            ("L_vyh1", "length of the point", l.point, pl.map(|p| p.point)),
            ("L_vyh2", "what the exit surface adds", extra, pl.and_then(|p| p.exit_surface)),
            ("L_kvyh", "break-through from W_k", to, pl.and_then(|p| p.to_exit)),
            ("L_vyh", "exit with overrun", exit, pl.and_then(|p| p.exit)),
        ]);
    }
    rows.push(("L_rx", "working stroke", l.stroke, pl.map(|p| p.stroke)));
    rows.push(("Z_nvr1", "start at feed, W_h", z.entry[0], pz.map(|p| p.entry[0])));
    rows.push(("Z_nvr2", "fully in, W_h", z.entry[1], pz.map(|p| p.entry[1])));
    if let (Some(h), Some(k)) = (z.exit, z.exit_own) {
        let (ph, pk) = (pz.and_then(|p| p.exit), pz.and_then(|p| p.exit_own));
        rows.extend([
            ("Z_nvyh1", "break-through, W_h", h[0], ph.map(|p| p[0])),
            ("Z_nvyh2", "end, W_h", h[1], ph.map(|p| p[1])),
            ("Z_kvyh1", "break-through, W_k", k[0], pk.map(|p| p[0])),
            ("Z_kvyh2", "end, W_k", k[1], pk.map(|p| p[1])),
        ]);
    } else {
        rows.push(("Z_end", "end, W_h", z.end, None));
    }
    rows
}

/// Lengths and coordinates by the paper's names, with what its formulas give where they differ.
pub(super) fn lengths_table(hole: &DrilledHole) -> Table {
    let mut table =
        Table::new("Lengths and coordinates by the paper\u{2019}s names", "Name; What; Value [mm]");
    if hole.paper.is_some() {
        table.caption += ", its formulas beside";
        table.columns.push(Column::number("Difference", "mm"));
    }
    for (name, what, value, paper) in lengths(hole) {
        let text = fixed(value, 3);
        let mut cells = vec![Cell::new(name), Cell::new(what)];
        match paper {
            Some(p) if !((p - value).abs() < SAME) => {
                cells.push(Cell::corrected(text, fixed(p, 3)));
                cells.push(Cell::new(fixed(p - value, 3)));
            }
            Some(_) => cells.extend([Cell::new(text), Cell::new(fixed(0.0, 3))]),
            None => cells.push(Cell::new(text)),
        }
        table.rows.push(Row::new(cells));
    }
    if let Some(printed) = hole.paper.and_then(|p| p.point_as_printed) {
        table.notes.push(format!(
            "As printed, with a cosine in place of the cotangent, the paper\u{2019}s L_vr1 is {} mm.",
            fixed(printed, 3)
        ));
    }
    table
}

/// Times of entry, steady cutting and exit: printed by the paper\u{2019}s program, by its formulas, exact.
pub(super) fn times_table(hole: &DrilledHole, paper: &PaperResult) -> Table {
    let plan = hole.plan;
    let mut table = Table::new(
        "Times: what the paper\u{2019}s program prints, its formulas with right arithmetic, exact",
        "Zone; Printed [s]; Its formulas [s]; Exact [s]",
    );
    let of = |stage: ZoneStage| plan.time_of(stage);
    let exact = [of(ZoneStage::Entry), of(ZoneStage::Steady), of(ZoneStage::Exit)];
    for (i, name) in ["entry", "steady", "exit"].into_iter().enumerate() {
        let cells = [paper.printed.times[i], paper.times[i], exact[i]].map(|t| Cell::new(fixed(t, 3)));
        table.rows.push(Row::new(std::iter::once(Cell::new(name)).chain(cells).collect()));
    }
    let sums = [paper.printed.times[3], paper.times.iter().sum(), plan.time];
    let cells = sums.map(|t| Cell::new(fixed(t, 3)));
    table.rows.push(Row::new(std::iter::once(Cell::new("all")).chain(cells).collect()));
    table.notes.push(
        "The printed times take each length as a difference of absolute values of Z, so an entry that starts above zero \
         comes out too short."
            .to_owned(),
    );
    let list: Vec<String> = PRINTED_LENGTHS
        .iter()
        .zip(paper.printed.lengths)
        .map(|(name, v)| format!("{name} {}", fixed(v, 3)))
        .collect();
    table.notes.push(format!("Its window would show {}.", list.join(", ")));
    table
}

/// A surface in words.
pub(super) fn surface_words(surface: &crate::drilling::BoundarySurface, side: Side) -> String {
    use crate::drilling::BoundarySurface;
    match *surface {
        BoundarySurface::Plane { slope: 0.0, .. } => "a square plane".to_owned(),
        BoundarySurface::Plane { slope, .. } => format!("a plane inclined by {}", degrees(slope.atan())),
        BoundarySurface::Ridge { radius, offset, .. } | BoundarySurface::Valley { radius, offset, .. } => {
            let ridge = matches!(surface, BoundarySurface::Ridge { .. });
            let kind = if ridge == (side == Side::Entry) { "outside" } else { "inside" };
            let offset =
                if offset == 0.0 { String::new() } else { format!(", {} mm off its axis", trimmed(offset)) };
            format!("the {kind} of a cylinder of R {}{offset}", trimmed(radius))
        }
    }
}

/// Other features on the way, a sentence each.
pub(super) fn on_the_way(spec: &DrillSpec) -> Vec<String> {
    let bores = spec.bores.iter().map(|b| {
        format!(
            "Crosses a bore of \u{2300}{} mm, its axis at Z {}.",
            trimmed(2.0 * b.radius),
            fixed(b.height, 3)
        )
    });
    let hole = spec.pre_hole.iter().map(|h| {
        let kind = match h.bottom {
            Some(b) => format!("a blind one to Z {}", fixed(b.height, 3)),
            None => "a through one".to_owned(),
        };
        let place = if h.is_concentric() { "" } else { ", off the axis" };
        format!("A hole of \u{2300}{} mm is there, {kind}{place}.", trimmed(h.diameter))
    });
    let mouth = spec.mouth.iter().map(|m| {
        let rim = trimmed(2.0 * m.edge.outer_radius());
        let depth = fixed(m.height + m.edge.extent()[0], 3);
        if is_floor(spec, m) {
            return format!("A hole of \u{2300}{rim} mm is there, to Z {depth}: it goes on from that floor.");
        }
        format!("A recess of \u{2300}{rim} mm is at its mouth, to Z {depth}.")
    });
    let ceiling = spec.ceiling.iter().filter(|_| spec.end.exit().is_some()).map(|c| {
        let rim = trimmed(2.0 * c.edge.outer_radius());
        let height = fixed(c.height - c.edge.extent()[0], 3);
        format!("A hole of \u{2300}{rim} mm from the other side ends at Z {height}: it comes out into that.")
    });
    mouth.chain(bores).chain(hole).chain(ceiling).collect()
}

/// Whether a recess is the floor of a hole: its rim lies below the face.
pub(super) fn is_floor(spec: &DrillSpec, mouth: &Mouth) -> bool {
    /// Difference of heights that is rounding [mm].
    const ROUNDING: f64 = 1e-6;
    let rim = mouth.edge.height(mouth.edge.outer_radius()).map_or(mouth.height, |h| mouth.height + h);
    rim < spec.entry.height(0.0) - ROUNDING
}
