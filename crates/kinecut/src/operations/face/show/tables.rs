//! Words and tables about a face, on the page and in the terminal.

use std::f64::consts::TAU;

use super::MilledFace;
use super::edges::BadEdge;
use crate::facing::{
    DescentStatistics, Placement, Sweep, ToothedLengths, ToothedPass, bad_length, either_bad_length,
    toothed_lengths,
};
use crate::page::{self, Cell, Fact, Row, Table, area_share, duration, fixed, length};

/// A turn [rad] in degrees, 0 included and 360 excluded.
pub(super) fn turn(angle: f64) -> f64 {
    let degrees = angle.to_degrees().rem_euclid(360.0);
    // An angle that three decimals show as 360 is 0.
    if degrees >= 359.9995 { 0.0 } else { degrees }
}

/// A number with three decimals at most, without zeros at its end.
pub(super) fn trimmed(v: f64) -> String {
    page::trimmed(v, 3)
}

/// The outline: size, edges, what they count.
pub(super) fn outline_words(face: &MilledFace<'_>) -> String {
    let outline = &face.plan.case.outline;
    let edges = outline.edges();
    let arcs = edges.iter().filter(|e| e.turn.is_some()).count();
    let outer = outline.loops().iter().filter(|l| l.outer).count();
    let [min, max] = outline.bounds();
    let many = |n: usize, one: &str, more: &str| format!("{n} {}", if n == 1 { one } else { more });
    format!(
        "{} x {} mm, perimeter {} mm; {} ({} circular) in {}, {} of them outer",
        trimmed(max.x - min.x),
        trimmed(max.y - min.y),
        trimmed(outline.perimeter()),
        many(edges.len(), "edge", "edges"),
        arcs,
        many(outline.loops().len(), "loop", "loops"),
        outer
    )
}

/// Weights of edges other than 1, by label.
pub(super) fn weight_words(face: &MilledFace<'_>) -> Option<String> {
    let case = &face.plan.case;
    let mut groups: Vec<(String, f64, f64)> = Vec::new();
    for (i, (edge, &weight)) in case.outline.edges().iter().zip(&case.weights).enumerate() {
        if weight == 1.0 {
            continue;
        }
        let name = case.outline.label(i).unwrap_or("edges without a label");
        match groups.iter_mut().find(|g| g.0 == name && g.1 == weight) {
            Some(group) => group.2 += edge.length(),
            None => groups.push((name.to_owned(), weight, edge.length())),
        }
    }
    if groups.is_empty() {
        return None;
    }
    let list: Vec<String> =
        groups.iter().map(|(n, w, l)| format!("{n} \u{d7} {} ({} mm)", trimmed(*w), trimmed(*l))).collect();
    Some(format!("{}; other edges \u{d7} 1", list.join(", ")))
}

/// The cutter and its feeds.
pub(super) fn cutter_words(face: &MilledFace<'_>) -> String {
    let spindle = face.feed / face.feed_per_revolution * 60.0;
    let word = if face.plan.left_hand { "M4, counter-clockwise" } else { "M3, clockwise" };
    let radii = face.teeth.iter().map(|t| t.radius);
    let out = radii.clone().fold(f64::NEG_INFINITY, f64::max) - radii.fold(f64::INFINITY, f64::min);
    let run_out =
        if out > 0.0 { format!(", radii of its teeth {} mm apart", trimmed(out)) } else { String::new() };
    let depths: Vec<String> = face.depths.iter().map(|d| trimmed(*d)).collect();
    let depth = match &depths[..] {
        [] => String::new(),
        [one] => format!("; {one} mm deep"),
        many => format!("; {} levels, the last {} mm deep", many.len(), many[many.len() - 1]),
    };
    format!(
        "D {} mm, {} {}{run_out}; {} rev/min ({word}), {} mm/tooth, {} mm/rev, {} mm/min{depth}",
        trimmed(2.0 * face.plan.case.radius),
        face.teeth.len(),
        if face.teeth.len() == 1 { "tooth" } else { "teeth" },
        fixed(spindle, 0),
        trimmed(face.feed_per_tooth()),
        trimmed(face.feed_per_revolution),
        fixed(face.feed * 60.0, 1)
    )
}

/// Which exits are bad, with the guard.
pub(super) fn rule_words(face: &MilledFace<'_>) -> String {
    let guard = if face.guard > 0.0 {
        format!(
            "; optimised with a guard: angles within {} degrees of a bad one count too",
            trimmed(face.guard.to_degrees())
        )
    } else {
        "; optimised without guard".to_owned()
    };
    format!("{}{guard}", face.rule)
}

/// Instructions for setting up a placement: the part turned, or the path. The placement is the plan's.
pub(super) fn set_up_words(face: &MilledFace<'_>, placement: Placement) -> [String; 2] {
    let seen = face.seen(placement);
    let extent = face.plan.case.outline.extent(placement.feed_in_part());
    let ends = extent.map(|x| face.seen_point(placement.in_part(glam::DVec2::new(x, placement.offset))));
    let point = |p: glam::DVec2| format!("X {} Y {}", fixed(p.x, 3), fixed(p.y, 3));
    [
        format!(
            "turn the part by {} degrees counter-clockwise about the work zero, cutter centre line at Y {}, feed towards X+",
            fixed(turn(seen.angle), 3),
            fixed(seen.offset, 3)
        ),
        format!(
            "or leave the part and feed in the direction {} degrees from X, the centre over {} and {}",
            fixed(turn(-seen.angle), 3),
            point(ends[0]),
            point(ends[1])
        ),
    ]
}

/// The placement of the chosen way: of one straight pass as it is set up, of another way what is turned.
pub(super) fn placement_words(face: &MilledFace<'_>) -> Vec<String> {
    let way = face.chosen();
    let mut words = match (way.placement(), way.angle) {
        (Some(p), _) => set_up_words(face, p).to_vec(),
        (None, Some(angle)) => {
            let seen = if face.plan.left_hand { -angle } else { angle };
            vec![format!(
                "{}: with the part turned by {} degrees the rows run along X",
                way.name,
                fixed(turn(seen), 3)
            )]
        }
        (None, None) => return vec![format!("{}: round the outline, the part as drawn", way.name)],
    };
    words.push(if face.part_turned != 0.0 {
        format!(
            "the program expects the part turned on the table by {} degrees",
            fixed(turn(face.part_turned), 3)
        )
    } else if face.coordinates_turned != 0.0 {
        format!(
            "the program leaves the part and turns its coordinates by {} degrees",
            fixed(turn(face.coordinates_turned), 3)
        )
    } else {
        "the program leaves the part as it is clamped and turns the path".to_owned()
    });
    words
}

/// Bound that the search proves for one straight pass.
pub(super) fn certificate_words(face: &MilledFace<'_>) -> String {
    match &face.plan.optimum {
        Ok(o) => format!(
            "no allowed placement of one straight pass leaves less than {} mm; found {} mm, gap {} mm, {} nodes{}",
            fixed(o.lower_bound, 4),
            fixed(o.value, 4),
            gap(o.gap()),
            o.nodes,
            if o.complete { "" } else { ", the search was stopped before the gap was as small as asked" }
        ),
        Err(finding) => format!("no straight pass: {finding}"),
    }
}

/// A gap with two digits that say something.
fn gap(mm: f64) -> String {
    if mm.abs() < 1e-9 { "0".to_owned() } else { format!("{mm:.1e}") }
}

/// Effect of errors of set-up.
pub(super) fn sensitivity_words(face: &MilledFace<'_>) -> Option<String> {
    let optimum = face.plan.optimum.as_ref().ok()?;
    let [angle, offset] = face.options.set_up_error;
    let s = &optimum.sensitivity;
    let mut text = format!(
        "within \u{b1}{} degrees and \u{b1}{} mm the bad length rises to {} mm at most (found by sampling)",
        trimmed(angle.to_degrees()),
        trimmed(offset),
        fixed(s.worst, 3)
    );
    if !s.feed_parallel.is_empty() {
        let list: Vec<String> = s.feed_parallel.iter().map(|&e| face.seen_edge(e).to_string()).collect();
        text += &format!("; parallel to the feed: edge {}", list.join(", "));
    }
    Some(text)
}

/// Lengths that the real teeth leave: front, back, and the loss if the back of the cutter rubs.
pub(super) struct Toothed {
    /// The front of the cutter.
    pub(super) front: ToothedLengths,
    /// Its back.
    pub(super) back: ToothedLengths,
    /// In the limit of many teeth: front or back [mm].
    pub(super) either: f64,
    /// In the limit: the front [mm].
    pub(super) limit: f64,
}

/// The real teeth under the chosen way, if that is one straight pass.
pub(super) fn toothed(face: &MilledFace<'_>) -> Option<Toothed> {
    let placement = face.chosen().placement()?;
    let case = &face.plan.case;
    let pass = ToothedPass {
        teeth: face.teeth.to_vec(),
        feed_per_radian: face.feed_per_revolution / TAU,
        placement,
        along: 0.0,
    };
    let pass = pass.checked().ok()?;
    Some(Toothed {
        front: toothed_lengths(case, &pass, Sweep::Front).ok()?,
        back: toothed_lengths(case, &pass, Sweep::Back).ok()?,
        either: either_bad_length(case, placement),
        limit: bad_length(case, placement),
    })
}

/// The same as sentences.
pub(super) fn toothed_words(t: &Toothed) -> [String; 2] {
    [
        format!(
            "the real teeth leave a bad exit on {} mm ({} mm in the limit of many teeth); exits count {} mm in all, entries {} mm",
            fixed(t.front.bad, 3),
            fixed(t.limit, 3),
            fixed(t.front.exits, 1),
            fixed(t.front.entries, 1)
        ),
        format!(
            "if the back of the cutter rubs, without tilt of the spindle, {} mm are bad in front or behind ({} mm behind alone)",
            fixed(t.either, 3),
            fixed(t.back.bad, 3)
        ),
    ]
}

/// As drawn and chosen next to one another: name, bad length, with the guard.
pub(super) fn before_after(face: &MilledFace<'_>) -> Vec<(String, f64, f64)> {
    let plan = face.plan;
    let mut rows = Vec::new();
    if let Some(p) = plan.as_drawn {
        let values = (bad_length(&plan.case, p), bad_length(&plan.guarded, p));
        rows.push(("as drawn, cutter over the middle".to_owned(), values.0, values.1));
    }
    let chosen = face.chosen();
    rows.push((format!("chosen: {}", chosen.name), chosen.bad, chosen.guarded));
    rows
}

/// Lengths that no straight pass avoids, loop by loop: loop, length [mm], share of its weighted length.
pub(super) fn irreducible(face: &MilledFace<'_>) -> Vec<(String, f64, f64)> {
    let Ok(optimum) = &face.plan.optimum else { return Vec::new() };
    let outline = &face.plan.case.outline;
    let name = |i: usize| {
        let Some(l) = outline.loops().get(i) else { return format!("loop {i}") };
        let kind = match (&outline.edges()[l.edges.clone()], l.outer) {
            ([one], false) => match one.turn {
                Some(t) => {
                    let at = face.seen_point(t.centre);
                    format!("bore D {} at {}, {}", trimmed(2.0 * t.radius), trimmed(at.x), trimmed(at.y))
                }
                None => "hole".to_owned(),
            },
            (_, true) => "outer edge".to_owned(),
            (_, false) => "hole".to_owned(),
        };
        match outline.label(l.edges.start) {
            Some(label) => format!("loop {i}, {kind} ({label})"),
            None => format!("loop {i}, {kind}"),
        }
    };
    optimum.irreducible.iter().map(|x| (name(x.outline_loop), x.length, x.share)).collect()
}

/// The descents of the paper's method.
pub(super) fn descents_words(face: &MilledFace<'_>) -> Option<String> {
    let all = face.descents;
    let optimum = face.plan.optimum.as_ref().ok()?.value;
    let s = DescentStatistics::of(all, optimum)?;
    let over = |v: f64| {
        if optimum > 0.0 {
            format!(" ({} % over)", fixed(100.0 * (v / optimum - 1.0), 1))
        } else {
            String::new()
        }
    };
    let drawn = face.from_drawn.map_or(String::new(), |d| {
        if !d.is_allowed(&face.plan.guarded) {
            return "; from the part as drawn no allowed placement is found".to_owned();
        }
        format!("; from the part as drawn {} mm{}", fixed(d.value, 3), over(d.value))
    });
    Some(format!(
        "Nelder-Mead from {} random starts: best {} mm{}, median {} mm{}, worst {} mm{}; {} within 1 % of the optimum; {} evaluations a start{drawn}",
        all.len(),
        fixed(s.best, 3),
        over(s.best),
        fixed(s.median, 3),
        over(s.median),
        fixed(s.worst, 3),
        over(s.worst),
        area_share(s.within_one_percent),
        fixed(s.evaluations, 0)
    ))
}

/// The facts of a face.
pub(super) fn facts(face: &MilledFace<'_>) -> Vec<Fact> {
    let way = face.chosen();
    let mut facts = Vec::new();
    let mut bad = Fact::new("Bad length", format!("{} mm", fixed(way.bad, 3)));
    if let Some((_, before, _)) = before_after(face).first().filter(|_| face.plan.as_drawn.is_some()) {
        let less = match *before > 0.0 {
            true => format!(": {} % less", fixed(100.0 * (before - way.bad) / before, 1)),
            false => String::new(),
        };
        bad = bad.note(format!("{} mm as drawn with the cutter over the middle{less}", fixed(*before, 3)));
    }
    facts.push(bad);
    if let Some(p) = way.placement().map(|p| face.seen(p)) {
        facts.push(
            Fact::new("Placement", format!("{}\u{b0}, Y {}", fixed(turn(p.angle), 3), fixed(p.offset, 3)))
                .note("part turned counter-clockwise; line of the cutter\u{2019}s centre"),
        );
    } else {
        facts.push(Fact::new("Passes", way.name.clone()));
    }
    if let Ok(o) = &face.plan.optimum {
        facts.push(
            Fact::new("Proven: no straight pass below", format!("{} mm", fixed(o.lower_bound, 4)))
                .note(format!("gap {} mm, {} nodes", gap(o.gap()), o.nodes)),
        );
        let irreducible = o.irreducible_length();
        if irreducible > 0.0 {
            facts.push(
                Fact::new("Unavoidable in a straight pass", format!("{} mm", fixed(irreducible, 3)))
                    .note("chamfer before milling, or use other passes"),
            );
        }
    }
    facts.push(Fact::new("Time", duration(way.time)).note(format!("{} at feed", length(way.feed_length))));
    if face.guard > 0.0 {
        facts.push(
            Fact::new("With guard", format!("{} mm", fixed(way.guarded, 3)))
                .note(format!("angles within {}\u{b0} count as bad", trimmed(face.guard.to_degrees()))),
        );
    }
    facts
}

/// All ways with their price.
pub(super) fn ways_table(face: &MilledFace<'_>) -> Table {
    let row = |(i, w): (usize, &crate::facing::MillingWay)| {
        let mark = match (i == face.plan.chosen, w.unbeaten) {
            (true, true) => "chosen,\u{a0}unbeaten",
            (true, false) => "chosen,\u{a0}beaten",
            (false, true) => "unbeaten",
            (false, false) => "",
        };
        let reach = match w.unreached {
            Some([x, y]) => {
                let p = face.seen_point(glam::DVec2::new(x, y));
                Cell::wrong(format!("not {}, {}", fixed(p.x, 1), fixed(p.y, 1)))
            }
            None => Cell::new("all"),
        };
        let name = Cell::new(w.name.clone());
        Row::new(vec![
            (i + 1).to_string().into(),
            name,
            fixed(w.bad, 3).into(),
            fixed(w.guarded, 3).into(),
            fixed(w.time, 1).into(),
            fixed(w.feed_length, 1).into(),
            fixed(w.burr.lowered, 1).into(),
            reach,
            mark.into(),
        ])
    };
    let columns = "No. []; Way; Bad length [mm]; With guard [mm]; Time [s]; At feed [mm]; Lowered onto [mm]; Reaches; Rank";
    let note = match face.plan.ways.len() {
        1 => "Other ways and their price: --compare, --out. Time without tool change.",
        _ => "Unbeaten: no other way is both faster and leaves less. Time without tool change.",
    };
    let rows = face.plan.ways.iter().enumerate().map(row);
    Table::new("Ways to mill the face, by time", columns).rows(rows).note(note)
}

/// Table of other local minima of one straight pass; `None` if there are none.
pub(super) fn alternatives_table(face: &MilledFace<'_>) -> Option<Table> {
    let optimum = face.plan.optimum.as_ref().ok()?;
    let mut table = Table::new(
        "Placements of one straight pass: the optimum and other local minima",
        "Placement; Bad length [mm]; Turn [deg]; Centre line Y [mm]",
    );
    let mut put = |name: &str, value: f64, placement: Placement| {
        let seen = face.seen(placement);
        let cells = [fixed(value, 3), fixed(turn(seen.angle), 3), fixed(seen.offset, 3)].map(Cell::new);
        table.rows.push(Row::new(std::iter::once(Cell::new(name)).chain(cells).collect()));
    };
    put("certified optimum", optimum.value, optimum.placement);
    for other in &optimum.alternatives {
        put("local minimum", other.value, other.placement);
    }
    if let Some(p) = face.plan.as_drawn {
        put("as drawn, cutter over the middle", bad_length(&face.plan.guarded, p), p);
    }
    if face.guard > 0.0 {
        table.notes.push("Bad lengths with the guard, as they were optimised.".to_owned());
    }
    Some(table)
}

/// Table of the lengths that no straight pass avoids; `None` if there are none.
pub(super) fn irreducible_table(face: &MilledFace<'_>) -> Option<Table> {
    let all = irreducible(face);
    if all.iter().all(|(_, l, _)| *l <= 0.0) {
        return None;
    }
    let rows = all
        .iter()
        .filter(|(_, l, _)| *l > 0.0)
        .map(|(n, l, s)| Row::new(vec![n.clone().into(), fixed(*l, 3).into(), area_share(*s).into()]));
    let table = Table::new(
        "Bad length that no allowed straight pass avoids",
        "Loop; Bad at least [mm]; Of its length []",
    );
    Some(
        table.rows(rows).note(
            "Certified for each loop alone. A chamfer before milling, or passes along the edge, avoid it.",
        ),
    )
}

/// The bad stretches; `most` rows, the rest in a note.
pub(super) fn edges_table(all: &[BadEdge], most: usize) -> Table {
    let point = |p: glam::DVec2| format!("{}, {}", fixed(p.x, 3), fixed(p.y, 3));
    let range = |[a, b]: [f64; 2], decimals: usize| {
        let (a, b) = (fixed(a, decimals), fixed(b, decimals));
        if a == b { a } else { format!("{a} \u{2026} {b}") }
    };
    let row = |e: &BadEdge| {
        Row::new(vec![
            e.edge.to_string().into(),
            e.label.clone().unwrap_or_default().into(),
            point(e.ends[0]).into(),
            point(e.ends[1]).into(),
            fixed(e.length, 3).into(),
            fixed(e.counted, 3).into(),
            range(e.exit_angles.map(f64::to_degrees), 1).into(),
            range(e.chip, 3).into(),
        ])
    };
    let columns =
        "Edge []; Label; From X, Y; To X, Y; Length [mm]; Counts [mm]; Exit angle [deg]; Chip at exit [mm]";
    let mut table = Table::new("Edges that keep a bad burr, those that count most first", columns)
        .rows(all.iter().take(most).map(row))
        .note("Edges are numbered from 0 as in the outline as given, loop after loop.");
    if all.len() > most {
        let rest: f64 = all[most..].iter().map(|e| e.length).sum();
        table.notes.push(format!(
            "{} shorter ones are left out, {} mm in all.",
            all.len() - most,
            fixed(rest, 3)
        ));
    }
    table
}
