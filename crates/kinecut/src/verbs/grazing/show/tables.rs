//! The numbers of a grazing curve as tables and words.

use super::kind_words;
use crate::page::{Cell, Fact, Row, Table, area_share, fixed};
use crate::sweep::Motion;
use crate::tool::ElementRole;
use crate::verbs::grazing::{GrazingSheet, MotionSource};

/// Seconds of a minute.
pub(crate) const MINUTE: f64 = 60.0;

/// A role in a word.
pub(crate) fn role_name(role: ElementRole) -> &'static str {
    match role {
        ElementRole::Cutting => "cutting",
        ElementRole::Shank => "shank",
        ElementRole::Holder => "holder",
    }
}

/// Three numbers as a vector.
pub(crate) fn vector(v: [f64; 3], decimals: usize) -> String {
    let words = v.map(|c| fixed(c, decimals));
    format!("({}, {}, {})", words[0], words[1], words[2])
}

/// The motion in numbers: velocity of the origin, turning, and of a screw its axis.
pub(crate) fn motion_lines(sheet: &GrazingSheet) -> Vec<String> {
    let (v, w) = (sheet.twist.shift * MINUTE, (sheet.twist.turn * MINUTE).to_array().map(f64::to_degrees));
    let mut lines =
        vec![format!("velocity {} mm/min, turning {} deg/min", vector(v.to_array(), 3), vector(w, 3))];
    match &sheet.source {
        MotionSource::Twist => {}
        MotionSource::Pose(_) => lines.push("from a pose and its rate".to_owned()),
        MotionSource::Moment { program, line, block, part, pose } => {
            lines.push(format!("{program}, line {line}, {} of its way: {block}", area_share(*part)));
            let (tip, axis) = (pose.translation.to_array(), pose.rotation.z_axis.to_array());
            lines.push(format!(
                "tip at {}, axis {}, X of the tool along the feed",
                vector(tip, 3),
                vector(axis, 4)
            ));
        }
    }
    lines
}

/// Degenerate parts, in sentences.
pub(crate) fn degenerate(sheet: &GrazingSheet) -> Vec<String> {
    let g = &sheet.grazing;
    let mut lines = Vec::new();
    for &piece in &g.whole {
        lines.push(format!("{} grazes as a whole: no velocity across its surface", sheet.piece_words(piece)));
    }
    for &(piece, u) in &g.circles {
        let p = sheet.chain.pieces()[piece].point(u);
        lines.push(format!(
            "a circle of radius {} mm at z {} mm grazes as a whole, on {}",
            fixed(p.x, 4),
            fixed(p.y, 4),
            sheet.piece_words(piece)
        ));
    }
    for &piece in &g.touching {
        lines.push(format!("{} only touches: both branches are one", sheet.piece_words(piece)));
    }
    if g.motion == Motion::Across {
        lines.push("the points on the axis graze: the curve passes through tip and top".to_owned());
    }
    lines
}

/// The curves.
pub(crate) fn loops(sheet: &GrazingSheet) -> Table {
    let mut table = Table::new("Curves", "curve []; closed; winding []; length [mm]; spans []");
    for (i, l) in sheet.loops.iter().enumerate() {
        table.rows.push(Row::new(vec![
            format!("{}", i + 1).into(),
            if l.closed { "yes" } else { "no" }.into(),
            l.winding.to_string().into(),
            fixed(l.length, 6).into(),
            l.spans.len().to_string().into(),
        ]));
    }
    let windings: u32 = sheet.loops.iter().map(|l| u32::from(l.winding)).sum();
    let last = match sheet.twist.shift.z != 0.0 && !sheet.loops.is_empty() {
        true if windings % 2 == 1 => {
            format!("Sum of windings {windings}: odd, as it parts the tip from the top.")
        }
        true => format!("Sum of windings {windings}: even, which cannot be: please report it."),
        false => String::new(),
    };
    table.notes = if last.is_empty() { Vec::new() } else { vec![last] };
    table
}

/// The spans.
pub(crate) fn spans(sheet: &GrazingSheet) -> Table {
    let mut table = Table::new(
        "Spans: pieces of the chain with two segments each",
        "curve []; piece; role; segments; from []; to []; length + [mm]; length \u{2212} [mm]",
    );
    for (i, l) in sheet.loops.iter().enumerate() {
        for s in &sheet.spans[l.spans.clone()] {
            let end = |u: f64, fold: bool| {
                format!("{}{}", sheet.shown_parameter(s.span.piece, u), if fold { " fold" } else { "" })
            };
            table.rows.push(Row::new(vec![
                format!("{}", i + 1).into(),
                sheet.piece_words(s.span.piece).into(),
                role_name(sheet.chain.pieces()[s.span.piece].role).into(),
                kind_words(s.span.kind).into(),
                end(s.span.from, s.span.folds[0]).into(),
                end(s.span.to, s.span.folds[1]).into(),
                fixed(s.lengths[0], 6).into(),
                fixed(s.lengths[1], 6).into(),
            ]));
        }
    }
    table.notes.push(
        "From and to: on lines the way from the element's start, on arcs and edges the angle of the normal, which is -90\u{b0} down the axis and 90\u{b0} up."
            .to_owned(),
    );
    table
}

/// Table of the areas that enter, for each piece.
pub(crate) fn entering(sheet: &GrazingSheet) -> Table {
    let mut table = Table::new(
        "Entering and leaving",
        "piece; role; area [mm\u{b2}]; enters [mm\u{b2}]; leaves [mm\u{b2}]; \
             share that enters []; volume entered [mm\u{b3}/min]; volume left [mm\u{b3}/min]",
    );
    for (i, e) in sheet.entering.iter().enumerate() {
        let fan = sheet.chain.pieces()[i].is_fan();
        let whole = sheet.grazing.whole.contains(&i);
        let number =
            |v: f64, decimals: usize| -> Cell { if fan { "".into() } else { fixed(v, decimals).into() } };
        let share = if whole { "grazes".to_owned() } else { area_share(e.share) };
        table.rows.push(Row::new(vec![
            sheet.piece_words(i).into(),
            role_name(sheet.chain.pieces()[i].role).into(),
            number(e.area, 3),
            number(e.entering, 3),
            number(e.area - e.entering, 3),
            share.into(),
            number(e.gained * MINUTE, 2),
            number(e.lost * MINUTE, 2),
        ]));
    }
    let [area, enters] = sheet.areas();
    let [gained, lost] = sheet.rates();
    table.rows.push(Row::new(vec![
        "in all".into(),
        "".into(),
        fixed(area, 3).into(),
        fixed(enters, 3).into(),
        fixed(area - enters, 3).into(),
        area_share(if area > 0.0 { enters / area } else { 0.0 }).into(),
        fixed(gained * MINUTE, 2).into(),
        fixed(lost * MINUTE, 2).into(),
    ]));
    table.notes.push("Of an edge or tip, which has no area, the share of its normals.".to_owned());
    table
}

/// The main numbers.
pub(crate) fn facts(sheet: &GrazingSheet) -> Vec<Fact> {
    let fact = |label: &str, value: String, note: &str| Fact {
        label: label.to_owned(),
        value,
        note: note.to_owned(),
    };
    let [area, entering] = sheet.areas();
    let [gained, _] = sheet.rates();
    let length: f64 = sheet.loops.iter().map(|l| l.length).sum();
    let folds = sheet.grazing.spans.iter().map(|s| s.folds.iter().filter(|f| **f).count()).sum::<usize>();
    let open = sheet.loops.iter().filter(|l| !l.closed).count();
    let share = if area > 0.0 { entering / area } else { 0.0 };
    vec![
        fact("Motion", sheet.motion_words().to_owned(), ""),
        fact(
            "Curves",
            sheet.loops.len().to_string(),
            if open == 0 { "all closed" } else { "some end at a piece that grazes as a whole" },
        ),
        fact("Length", format!("{} mm", fixed(length, 4)), ""),
        fact("Folds", folds.to_string(), ""),
        fact("Enters", area_share(share), "of the tool's surface"),
        fact("Volume entered", format!("{} mm\u{b3}/min", fixed(gained * MINUTE, 1)), "as much is left"),
    ]
}
