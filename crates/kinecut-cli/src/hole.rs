//! The verb `hole`: one hole, or a list of them, planned or compared.

use kinecut::base::{Error, Finding};
use kinecut::job::Items;
use kinecut::verbs::hole::{HoleTable, compare_hole, plan_hole, read_holes};
use kinecut::{job, verbs};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::args::{Args, Hole};
use crate::{FINDINGS, FINE, WRONG_INPUT, code_of, colour, files, print_json, put, render};

/// A result or its error, in the place of its item.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum Item<T> {
    Fine(T),
    Wrong { error: Box<Finding> },
}

/// Runs the verb; the exit code tells the worst item.
pub(crate) fn hole(args: &Args, hole: &Hole) -> Result<u8, Error> {
    let texts = read_holes(&hole.file, &files::text(&hole.file)?)?;
    if hole.compare {
        let items = each(&texts, compare_hole);
        if let Some(out) = &hole.out {
            let done: Vec<_> = items
                .iter()
                .filter_map(|i| if let Item::Fine(c) = i { Some(c.clone()) } else { None })
                .collect();
            if !done.is_empty() {
                let mut outputs = job::Outputs::default();
                outputs.add("compare.html", verbs::hole::compare_html(&done));
                files::write(outputs, out)?;
            }
        }
        let code = print(args, &texts, &items, verbs::hole::compare_text);
        if let (Some(out), false) = (&hole.out, args.json || code == WRONG_INPUT) {
            put(format!("\nWritten to {}: compare.html\n", out.display()));
        }
        return Ok(code);
    }
    let items = each(&texts, plan_hole);
    let code = print(args, &texts, &items, verbs::hole::hole_text);
    let found = || items.iter().flat_map(|i| if let Item::Fine(p) = i { &p.findings[..] } else { &[] });
    if !args.json {
        for finding in found() {
            put(render::finding(finding, colour(args)));
            put("\n");
        }
    }
    Ok(if code == FINE { code_of(args, found()) } else { code })
}

/// Runs each item; its error carries its place.
pub(crate) fn each<T: Clone + DeserializeOwned, U>(
    texts: &Items<T>,
    run: impl Fn(&T) -> Result<U, Error>,
) -> Vec<Item<U>> {
    texts
        .items
        .iter()
        .enumerate()
        .map(|(i, item)| match item.clone().and_then(|table| run(&table)) {
            Ok(done) => Item::Fine(done),
            Err(e) => Item::Wrong { error: texts.locate(i, e).0 },
        })
        .collect()
}

/// Prints all items; wrong input when none is fine, a finding when some are not.
pub(crate) fn print<T: Serialize>(
    args: &Args,
    texts: &Items<HoleTable>,
    items: &[Item<T>],
    text: impl Fn(&T) -> String,
) -> u8 {
    print_items(args, texts.list.is_some(), items, text)
}

/// As [`print`]; one item that is no list is printed without brackets.
pub(crate) fn print_items<T: Serialize>(
    args: &Args,
    list: bool,
    items: &[Item<T>],
    text: impl Fn(&T) -> String,
) -> u8 {
    let wrong = items.iter().filter(|i| matches!(i, Item::Wrong { .. })).count();
    match (args.json, items) {
        (true, [Item::Wrong { error }]) if !list => print_json(error),
        (true, [one]) if !list => print_json(one),
        (true, _) => print_json(&items),
        (false, _) => {
            for (i, item) in items.iter().enumerate() {
                match item {
                    Item::Fine(done) => put(format!("{}{}", if i > 0 { "\n" } else { "" }, text(done))),
                    Item::Wrong { error } => crate::complain(render::finding(error, colour(args))),
                }
            }
        }
    }
    match wrong {
        0 => FINE,
        n if n == items.len() => WRONG_INPUT,
        _ => FINDINGS,
    }
}
