//! Errors of one kind as one finding.

use crate::base::Finding;

/// Most lines that a finding lists, and most findings of their own.
const LINES: usize = 8;
const KINDS: usize = 40;

/// Errors of a program, those with the same message as one with its lines.
pub(crate) fn grouped(errors: Vec<Finding>) -> Vec<Finding> {
    let mut groups: Vec<(Finding, Vec<u32>)> = Vec::new();
    let mut more = 0usize;
    for error in errors {
        let line = error.place.as_ref().map_or(0, |p| p.line);
        let same = |(first, _): &&mut (Finding, Vec<u32>)| {
            first.code == error.code && first.message == error.message
        };
        let room = groups.len() < KINDS;
        match groups.iter_mut().find(same) {
            // A block of a loop is wrong in each turn.
            Some((_, lines)) if lines.contains(&line) => {}
            Some((_, lines)) => lines.push(line),
            None if room => groups.push((error, vec![line])),
            None => more += 1,
        }
    }
    let mut found: Vec<Finding> = groups
        .into_iter()
        .map(|(first, lines)| {
            if lines.len() == 1 {
                return first;
            }
            let shown: Vec<String> = lines.iter().take(LINES).map(u32::to_string).collect();
            let rest = lines.len().saturating_sub(LINES);
            let rest = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            let message =
                format!("{} ({} times: lines {}{rest})", first.message, lines.len(), shown.join(", "));
            Finding { message, ..first }
        })
        .collect();
    if let Some(last) = found.last_mut().filter(|_| more > 0) {
        let all = if last.help.is_empty() { String::new() } else { format!("{}; ", last.help) };
        last.help = format!("{all}{more} errors of further kinds are not listed");
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Code, Location};

    #[test]
    fn what_is_the_same_is_one_finding() {
        let at = |message: &str, line: u32| {
            let place = Location { line, ..Location::whole_file("a.nc") };
            Finding::error(Code::NC_WORD, message).at(place)
        };
        let all = grouped(vec![at("a", 2), at("b", 3), at("a", 4), at("a", 4), at("a", 9)]);
        let said: Vec<&str> = all.iter().map(|f| f.message.as_str()).collect();
        assert_eq!(said, ["a (3 times: lines 2, 4, 9)", "b"]);
        let many = grouped((0..100).map(|i| at(&i.to_string(), i)).collect());
        assert!(many.len() == KINDS && many[KINDS - 1].help.starts_with("60 errors"));
    }
}
