//! Tools in comments.

use super::{code_of, comments_of, number};

/// A tool that a comment describes; lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedTool {
    /// Number on the control.
    pub number: u32,
    /// Kind, as a job file names it.
    pub kind: &'static str,
    /// Diameter.
    pub diameter: f64,
    /// Corner radius, where it is said and not nought.
    pub corner_radius: Option<f64>,
    /// Full angle of the point, where it is said.
    pub point_angle: Option<f64>,
    /// Length from the gauge point of the spindle, where a tool table says it.
    pub length: Option<f64>,
    /// Line of the comment, or of the tool table.
    pub line: u32,
}

/// Words by which a kind is known, what says more of it before what says less; the first that is found counts.
const KINDS: [(&str, &str); 15] = [
    ("SPOT", "drill"),
    ("CENTER DRILL", "drill"),
    ("CENTRE DRILL", "drill"),
    ("DRILL", "drill"),
    ("REAM", "drill"),
    ("CHAMFER", "tapered"),
    ("ENGRAV", "tapered"),
    ("V-BIT", "tapered"),
    ("BULL", "bull-nose"),
    ("BALL", "ball-nose"),
    ("FACE MILL", "face-mill"),
    ("FACEMILL", "face-mill"),
    ("END MILL", "end-mill"),
    ("ENDMILL", "end-mill"),
    ("FACE", "face-mill"),
];
/// Words of which another one may end: `TAPDRILL`, `MMENDMILL`.
const ENDINGS: [&str; 2] = ["DRILL", "ENDMILL"];
/// Words behind which no other letters may follow: a `FACET` is no face.
const WHOLE: [&str; 1] = ["FACE"];
/// Largest diameter that is believed [mm].
const LARGEST: f64 = 500.0;

/// The tools of a text, by number; the first comment about a tool counts. `unit`: millimetres in a unit of the program.
pub(super) fn tools(text: &str, unit: f64) -> Vec<CarriedTool> {
    let mut found: Vec<CarriedTool> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        // Tools are told where they are called, or in the head.
        let called = called(code_of(line));
        for comment in comments_of(line) {
            let Some(tool) = tool_in(&comment.to_ascii_uppercase(), called, unit, index as u32 + 1) else {
                continue;
            };
            if found.iter().all(|t| t.number != tool.number) {
                found.push(tool);
            }
        }
    }
    found.sort_by_key(|t| t.number);
    found
}

/// The tool number that the words of a line call.
fn called(code: &str) -> Option<u32> {
    let bytes = code.as_bytes();
    code.match_indices(['T', 't']).find_map(|(at, _)| {
        let digits = code[at + 1..].bytes().take_while(u8::is_ascii_digit).count();
        let starts = at == 0 || !bytes[at - 1].is_ascii_alphabetic();
        (starts && (1..=6).contains(&digits)).then(|| code[at + 1..at + 1 + digits].parse().ok()).flatten()
    })
}

/// The kind and the corner radius that make one tool of a diameter [mm].
pub(super) fn solid(kind: &'static str, corner: Option<f64>, diameter: f64) -> (&'static str, Option<f64>) {
    let milling = matches!(kind, "end-mill" | "ball-nose" | "bull-nose");
    match corner.filter(|_| milling) {
        Some(r) if (2.0 * r - diameter).abs() < 1e-3 * diameter => ("ball-nose", None),
        Some(r) if 2.0 * r < diameter && kind != "ball-nose" => ("bull-nose", Some(r)),
        _ if kind == "bull-nose" => ("end-mill", None),
        _ => (kind, None),
    }
}

/// The kind that a comment in capitals names.
pub(in crate::job) fn kind_in(comment: &str) -> Option<&'static str> {
    KINDS.iter().find(|(word, _)| has_word(comment, word)).map(|(_, kind)| *kind)
}

/// Whether a text has a word, or one that begins with it.
fn has_word(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| {
        let begins = !text[..at].ends_with(char::is_alphabetic);
        let ends = !text[at + word.len()..].starts_with(char::is_alphabetic);
        match (begins, ends) {
            (true, true) => true,
            (true, false) => !WHOLE.contains(&word),
            (false, ends) => ends && ENDINGS.contains(&word),
        }
    })
}

/// The tool of a comment in capitals.
pub(super) fn tool_in(comment: &str, called: Option<u32>, unit: f64, line: u32) -> Option<CarriedTool> {
    let (number, rest) = match named(comment) {
        Some((number, rest)) => (number, rest),
        None => (called?, comment),
    };
    let kind = kind_in(rest);
    let by_letter = behind(rest, "D=").and_then(super::number);
    let by_word = behind(rest, "DIA").and_then(|t| {
        let t = t.strip_prefix("METER").or_else(|| t.strip_prefix('.')).unwrap_or(t);
        super::number(t.trim_start_matches([' ', ':', '=', '-', '|']))
    });
    let (diameter, unit_said) = match by_letter.or(by_word) {
        Some((value, behind)) => (value, unit_of(behind)),
        None => size(rest)?,
    };
    // A number alone could be anything.
    let kind = kind.or(by_letter.is_some().then_some("end-mill"))?;
    let diameter = diameter * unit_said.unwrap_or(unit);
    if !(diameter > 0.0 && diameter <= LARGEST) {
        return None;
    }
    let corner = behind(rest, "CR=").and_then(super::number).map(|(v, _)| v * unit).filter(|r| *r > 0.0);
    let (kind, corner_radius) = solid(kind, corner, diameter);
    let angle = behind(rest, "TAPER=").and_then(super::number).map(|(v, _)| v);
    let point_angle = angle.filter(|a| (1.0..180.0).contains(a)).or(rest.contains("SPOT").then_some(90.0));
    Some(CarriedTool { number, kind, diameter, corner_radius, point_angle, length: None, line })
}

/// The tool number that a comment begins with, and what is behind it.
fn named(comment: &str) -> Option<(u32, &str)> {
    let rest = comment.strip_prefix("TOOL").or_else(|| comment.strip_prefix('T'))?;
    let rest = rest.trim_start_matches([' ', '-', '#', ':', '=', '.']);
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    if !(1..=6).contains(&digits) {
        return None;
    }
    let behind = &rest[digits..];
    // `T6.5` is no number of a tool, and `T1X` none either.
    let ends = behind.is_empty() || behind.starts_with([' ', '|', '=', ':', '-', ',']);
    ends.then(|| Some((rest[..digits].parse().ok()?, behind))).flatten()
}

/// What is behind a word, blanks passed.
fn behind<'t>(text: &'t str, word: &str) -> Option<&'t str> {
    text.find(word).map(|at| text[at + word.len()..].trim_start())
}

/// Millimetres in the unit that follows a number, if one does.
fn unit_of(behind: &str) -> Option<f64> {
    let behind = behind.trim_start();
    if behind.starts_with("MM") {
        Some(1.0)
    } else if behind.starts_with("IN") || behind.starts_with('"') {
        Some(25.4)
    } else {
        None
    }
}

/// The first number of a text that stands alone, with the unit behind it.
fn size(text: &str) -> Option<(f64, Option<f64>)> {
    let bytes = text.as_bytes();
    (0..bytes.len()).find_map(|at| {
        let starts = bytes[at].is_ascii_digit() || bytes[at] == b'.';
        let alone = at == 0 || matches!(bytes[at - 1], b' ' | b'|' | b'=' | b'-' | b':' | b'D');
        let (value, behind) = (starts && alone).then(|| number(&text[at..])).flatten()?;
        // Not `4FL`, `H1`, `2 FLUTE`.
        let other = behind.trim_start();
        (!other.starts_with("FL") || other.starts_with("FLAT")).then_some((value, unit_of(behind)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(comment: &str, unit: f64) -> Option<(u32, &'static str, f64)> {
        tools(comment, unit).first().map(|t| (t.number, t.kind, (t.diameter * 1e6).round() / 1e6))
    }

    #[test]
    fn comments_of_many_systems_are_read() {
        let inch = 25.4;
        for (text, unit, wanted) in [
            ("(T1 D=14.288 CR=0. - ZMIN=-6.35 - FLAT END MILL)", 1.0, (1, "end-mill", 14.288)),
            ("(T3 D=0.125 CR=0.0625 - ZMIN=-0.54 - BALL END MILL)", inch, (3, "ball-nose", 3.175)),
            ("(T4  D=10. CR=1. - bull nose end mill)", 1.0, (4, "bull-nose", 10.0)),
            ("(T2 D=5. CR=0. TAPER=118DEG - ZMIN=-12. - DRILL)", 1.0, (2, "drill", 5.0)),
            ("( T1 | 1/2 FLAT ENDMILL | H1 | D1 | TOOL DIA. - .5 )", inch, (1, "end-mill", 12.7)),
            ("(T239 |   6. FLAT ENDMILL   | H239 )", 1.0, (239, "end-mill", 6.0)),
            ("(TOOL 4 = 3/8IN ENDMILL)", 1.0, (4, "end-mill", 9.525)),
            ("(T2 .375 DRILL)", inch, (2, "drill", 9.525)),
            ("N20 L6 T27 ( 8.5mm DRILL )", inch, (27, "drill", 8.5)),
            (";T7 = 90 DEG CHAMFER MILL DIA 10.0", 1.0, (7, "tapered", 10.0)),
        ] {
            assert_eq!(one(text, unit), Some(wanted), "{text}");
        }
        let drill = &tools("(T2 D=5. CR=0. TAPER=118DEG - DRILL)", 1.0)[0];
        assert_eq!((drill.point_angle, drill.corner_radius), (Some(118.0), None));
        assert_eq!(tools("(T4 D=10. CR=1. - BULL NOSE END MILL)", 1.0)[0].corner_radius, Some(1.0));
    }

    #[test]
    fn a_kind_is_known_by_whole_words() {
        for (text, kind) in [
            ("FINISH SURFACE ENDMILL", Some("end-mill")),
            ("END MILL FOR FACE", Some("end-mill")),
            ("FACE MILL 50", Some("face-mill")),
            ("50MM FACE", Some("face-mill")),
            ("FACEMILL, NO END MILL", Some("face-mill")),
            ("BALL END MILL", Some("ball-nose")),
            ("REAMER 8H7", Some("drill")),
            ("#7 TAPDRILL", Some("drill")),
            ("6MMENDMILL", Some("end-mill")),
            ("ENDMILLS", Some("end-mill")),
            ("SURFACE", None),
            ("STREAM PROBE", None),
            ("FACET CUTTER", None),
        ] {
            assert_eq!(kind_in(text), kind, "{text}");
        }
    }

    #[test]
    fn other_comments_are_no_tools() {
        for text in [
            "N15 T1 M06 (TOOL NUMBER+TOOL CHANGE CODE)",
            "( T0 : 3.175 )",
            "( LOAD T3 - S580 )",
            "(#13=M THREAD DIA.)",
            "N250 L6 T9 ( DRILL )",
            "(THE DRILL IS 5 MM)",
            "(T1 2 FLUTE ENDMILL)",
            "(T1 D=0. CR=0. - FLAT END MILL)",
            "T1 M6 (",
        ] {
            assert_eq!(one(text, 1.0), None, "{text}");
        }
        // The first comment about a tool counts.
        assert_eq!(tools("(T1 D=6.)\n(T1 D=8.)\nT1", 1.0).len(), 1);
    }
}
