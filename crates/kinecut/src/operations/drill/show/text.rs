//! A drilled hole as text for a terminal of a hundred columns: what the paper's window shows, and the warnings.

use std::fmt::Write as _;

use super::page::finding;
use super::tables::{
    first_contact, imbalance, lengths, on_the_way, rpm, seconds, source, surface_words, trimmed,
};
use super::{DrilledHole, RefusedHole};
use crate::drilling::{PRINTED_LENGTHS, Side};
use crate::page::{fixed, terminal};

/// Columns of a sentence.
const WIDTH: usize = 96;

/// One hole.
pub fn drill_text(hole: &DrilledHole) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail, here and below.
    let _ = put(&mut out, hole);
    out
}

/// A hole that could not be planned.
pub fn refused_text(hole: &RefusedHole) -> String {
    let mut out = format!("{}\n", terminal(&hole.title));
    wrap(&mut out, &terminal(&finding(&hole.finding)));
    out
}

fn put(out: &mut String, hole: &DrilledHole) -> std::fmt::Result {
    let (spec, plan) = (hole.spec, hole.plan);
    writeln!(out, "{}", terminal(hole.title))?;
    writeln!(
        out,
        "{}: {} D{}, {} rev/min ({} m/min)",
        spec.method.word(),
        spec.point.name(),
        trimmed(spec.diameter),
        fixed(rpm(plan.spindle), 1),
        fixed(plan.spindle * plan.edge.outer_radius() * 0.06, 1)
    )?;
    writeln!(out, "entry: {}", surface_words(&spec.entry, Side::Entry))?;
    match spec.end.exit() {
        Some(exit) => {
            writeln!(out, "exit:  {}, L {} mm", surface_words(exit, Side::Exit), trimmed(spec.length))?
        }
        None => writeln!(out, "exit:  none")?,
    }
    on_the_way(spec).iter().for_each(|line| wrap(out, line));
    writeln!(out)?;
    let paper = hole.paper.is_some();
    writeln!(out, "{:<9}{:>12}{}  [mm]", "", "value", if paper { "       paper" } else { "" })?;
    for (name, what, value, by_paper) in lengths(hole) {
        write!(out, "{name:<9}{:>12}", fixed(value, 3))?;
        match by_paper {
            Some(p) => write!(out, "{:>12}", fixed(p, 3))?,
            None if paper => write!(out, "{:>12}", "")?,
            None => {}
        }
        writeln!(out, "  {what}")?;
    }
    writeln!(out)?;
    writeln!(
        out,
        "{:<8}{:>11}{:>11}{:>10}{:>9}{:>9}{:>8}{:>10}  feed from",
        "zone", "Z from", "Z to", "length", "mm/rev", "mm/min", "rev", "s"
    )?;
    for z in &plan.zones {
        writeln!(
            out,
            "{:<8}{:>11}{:>11}{:>10}{:>9}{:>9}{:>8}{:>10}  {}",
            z.stage.word(),
            fixed(z.from, 3),
            fixed(z.to, 3),
            fixed(z.length(), 3),
            trimmed(z.feed),
            fixed(z.feed * rpm(plan.spindle), 1),
            fixed(z.revolutions(), 2),
            fixed(z.time(plan.spindle), 3),
            source(hole, z.stage)
        )?;
    }
    writeln!(
        out,
        "\ntime at feed {}, at one safe feed {}; touches first: {}",
        seconds(plan.time),
        seconds(plan.constant_time),
        first_contact(hole)
    )?;
    if plan.balance.eccentricity > 0.0 {
        writeln!(
            out,
            "lip imbalance {}, radius of opposite lips differs by {} mm",
            imbalance(plan.balance.eccentricity),
            fixed(plan.balance.difference, 3)
        )?;
    }
    if let [Some(entry), exit] = plan.coordinates.best_zeros {
        let exit = exit.map_or(String::new(), |z| format!(", W_k at {}", fixed(z, 3)));
        writeln!(out, "best zeros: W_h at {}{exit}", fixed(entry, 3))?;
    }
    if let Some(p) = hole.paper {
        let printed = PRINTED_LENGTHS.iter().zip(p.printed.lengths);
        let list: Vec<String> = printed.map(|(n, v)| format!("{n} {}", fixed(v, 3))).collect();
        let t = p.printed.times.map(|t| fixed(t, 3));
        wrap(
            out,
            &format!(
                "the paper's window: {}; T {} + {} + {} = {} s",
                list.join(", "),
                t[0],
                t[1],
                t[2],
                t[3]
            ),
        );
    }
    for f in &plan.findings {
        wrap(out, &terminal(&finding(f)));
    }
    Ok(())
}

/// Many holes, a line each.
pub fn drill_list(holes: &[DrilledHole], refused: &[RefusedHole]) -> String {
    let mut out = format!(
        "{:<28}{:>11}{:>11}{:>11}{:>11}{:>10}  findings\n",
        "hole", "start", "fully in", "through", "end", "s"
    );
    for h in holes {
        let z = &h.plan.coordinates;
        let codes: Vec<String> = h.plan.findings.iter().map(|f| f.code.to_string()).collect();
        let title: String = terminal(h.title).chars().take(27).collect();
        let line = format!(
            "{title:<28}{:>11}{:>11}{:>11}{:>11}{:>10}  {}",
            fixed(z.entry[0], 3),
            fixed(z.entry[1], 3),
            fixed(z.exit.map_or(f64::NAN, |e| e[0]), 3),
            fixed(z.end, 3),
            fixed(h.plan.time, 3),
            codes.join(" ")
        );
        out.push_str(line.trim_end());
        out.push('\n');
    }
    for r in refused {
        out.push_str(&refused_text(r));
    }
    out
}

fn wrap(out: &mut String, text: &str) {
    let mut at = 0;
    for word in text.split_whitespace() {
        let n = word.chars().count();
        if at > 0 && at + 1 + n > WIDTH {
            out.push_str("\n  ");
            at = 2;
        } else if at > 0 {
            out.push(' ');
            at += 1;
        }
        out.push_str(word);
        at += n;
    }
    out.push('\n');
}
