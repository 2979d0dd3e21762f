//! The control of a text, from what it says.

use super::Control;

/// The control that a text shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Detected {
    /// A control that kinecut reads, and why.
    Control(Control, String),
    /// A control that it does not read: its name, and why.
    Other(&'static str, String),
    /// Nothing, or two controls alike.
    Nothing,
}

/// A sign of a control.
struct Sign {
    of: Of,
    /// Weight: 4 where no other control has it, 2 where few have, 1 where it is usual.
    weight: u32,
    /// Capitals without blanks that a line has, or begins with where they begin with `^`.
    text: &'static str,
}

#[derive(Clone, Copy, PartialEq)]
enum Of {
    Own(Control),
    Other(&'static str),
}

const fn own(control: Control, weight: u32, text: &'static str) -> Sign {
    Sign { of: Of::Own(control), weight, text }
}

const fn other(name: &'static str, text: &'static str) -> Sign {
    Sign { of: Of::Other(name), weight: 4, text }
}

const SIGNS: &[Sign] = &[
    own(Control::Heidenhain, 4, "BEGINPGM"),
    own(Control::Heidenhain, 2, "TOOLCALL"),
    own(Control::Heidenhain, 2, "CYCLDEF"),
    own(Control::Sinumerik840d, 4, "^%_N_"),
    own(Control::Sinumerik840d, 4, "^;$PATH"),
    own(Control::Sinumerik840d, 4, "G710"),
    own(Control::Sinumerik840d, 4, "TRAORI"),
    own(Control::Sinumerik840d, 2, "CYCLE8"),
    own(Control::Sinumerik840d, 2, "MCALL"),
    own(Control::Sinumerik840d, 2, "MSG(\""),
    own(Control::Sinumerik840d, 2, "DEFREAL"),
    own(Control::Sinumerik840d, 2, "GOTOF"),
    own(Control::LinuxCnc, 4, "#<"),
    own(Control::LinuxCnc, 4, "^O<"),
    own(Control::LinuxCnc, 2, "(DEBUG,"),
    own(Control::LinuxCnc, 2, "(PRINT,"),
    own(Control::LinuxCnc, 2, "G64P"),
    own(Control::LinuxCnc, 4, "G33.1"),
    own(Control::Fanuc, 4, "G05.1Q"),
    own(Control::Fanuc, 4, "G5.1Q"),
    own(Control::Fanuc, 4, "#3000="),
    own(Control::Fanuc, 4, "G43.4"),
    own(Control::Fanuc, 4, "G68.2"),
    own(Control::Fanuc, 2, "G65P"),
    own(Control::Fanuc, 2, "]GOTO"),
    own(Control::Fanuc, 2, "]DO1"),
    own(Control::Fanuc, 2, "]THEN"),
    own(Control::Fanuc, 1, "G91G28"),
    own(Control::Haas, 4, "G154"),
    own(Control::Haas, 4, "G187"),
    own(Control::Haas, 4, "G150"),
    own(Control::Haas, 4, "M97P"),
    own(Control::Haas, 4, "HAAS"),
    own(Control::Grbl, 4, "^$H"),
    own(Control::Grbl, 4, "^$X"),
    other("Okuma", ".MIN%"),
    other("Okuma", "NCYL"),
    other("Okuma", "VC1="),
    other("Okuma", "G15H"),
    other("Mazak (Mazatrol)", "MAZATROL"),
    other("Fagor", ",MX--,"),
    other("Fagor", "$IF"),
    other("Fagor", "#TCAM"),
    other("a 3-D printer (Marlin, Klipper)", "M104S"),
    other("a 3-D printer (Marlin, Klipper)", "M109S"),
];

/// A control, the weight of what speaks for it, and that with its lines.
type Candidate = (Of, u32, Vec<(String, usize)>);

/// Most lines that are looked at.
const LINES: usize = 20_000;

/// The control that a text was written for, where it says so.
///
/// Each sign counts once: words that one control alone has, and words that are usual on it.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::nc::{Control, Detected, detect};
/// let Detected::Control(control, why) = detect("%\nO1234\nG65 P7700 X0 Y0\nM30\n%\n") else { panic!() };
/// assert_eq!((control, why.as_str()), (Control::Fanuc, "O1234 (line 2), G65P (line 3)"));
/// assert!(matches!(detect("$PART.MIN%\nG15 H1\n"), Detected::Other("Okuma", _)));
/// assert_eq!(detect("G0 X1\nG1 Z-1 F100\n"), Detected::Nothing);
/// ```
pub fn detect(text: &str) -> Detected {
    let mut found: Vec<(&Sign, usize)> = Vec::new();
    let mut program: Option<(String, usize)> = None;
    let mut o_words = None;
    for (i, line) in text.lines().take(LINES).enumerate() {
        let code: String =
            line.chars().filter(|c| !c.is_ascii_whitespace()).map(|c| c.to_ascii_uppercase()).collect();
        for sign in SIGNS {
            let here = match sign.text.strip_prefix('^') {
                Some(begin) => code.starts_with(begin),
                None => code.contains(sign.text),
            };
            if here && !found.iter().any(|(known, _)| std::ptr::eq(*known, sign)) {
                found.push((sign, i + 1));
            }
        }
        if let Some(rest) = code.strip_prefix('O') {
            let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
            let behind = &rest[digits..];
            let word = ["SUB", "CALL", "IF", "WHILE", "REPEAT", "DO"].iter().any(|w| behind.starts_with(w));
            if digits > 0 && word && o_words.is_none() {
                o_words = Some((format!("O{}", rest.chars().take(digits + 4).collect::<String>()), i + 1));
            } else if digits == 4 && (behind.is_empty() || behind.starts_with('(')) && program.is_none() {
                program = Some((code[..5].to_owned(), i + 1));
            }
        }
    }
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut add =
        |of: Of, weight: u32, text: String, line: usize| match candidates.iter_mut().find(|c| c.0 == of) {
            Some(candidate) => {
                candidate.1 += weight;
                candidate.2.push((text, line));
            }
            None => candidates.push((of, weight, vec![(text, line)])),
        };
    for (sign, line) in found {
        add(sign.of, sign.weight, sign.text.trim_start_matches('^').to_owned(), line);
    }
    if let Some((text, line)) = program {
        // A Haas reads the same; it says so by other words.
        add(Of::Own(Control::Fanuc), 1, text, line);
    }
    if let Some((text, line)) = o_words {
        add(Of::Own(Control::LinuxCnc), 4, text, line);
    }
    candidates.sort_by_key(|c| std::cmp::Reverse(c.1));
    // What FANUC and Haas share speaks for a Haas that has shown itself.
    let best = candidates.first().map_or(0, |c| c.1);
    let haas = candidates.iter().position(|c| c.0 == Of::Own(Control::Haas));
    let chosen = match haas {
        Some(i) if candidates[0].0 == Of::Own(Control::Fanuc) || candidates[i].1 == best => i,
        _ if candidates.len() > 1 && candidates[1].1 == best => return Detected::Nothing,
        _ => 0,
    };
    let Some((of, _, mut reasons)) = candidates.into_iter().nth(chosen) else { return Detected::Nothing };
    reasons.sort_by_key(|r| r.1);
    let why: Vec<String> =
        reasons.iter().take(3).map(|(text, line)| format!("{text} (line {line})")).collect();
    match of {
        Of::Own(control) => Detected::Control(control, why.join(", ")),
        Of::Other(name) => Detected::Other(name, why.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_control_shows_itself() {
        let of = |text: &str| match detect(text) {
            Detected::Control(control, _) => control.name(),
            Detected::Other(name, _) => name,
            Detected::Nothing => "nothing",
        };
        assert_eq!(of("0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n"), "heidenhain");
        assert_eq!(of("G710 G17\nCYCLE81(1,2,3)\n"), "sinumerik-840d");
        assert_eq!(of("o100 sub\no100 endsub\n"), "linuxcnc");
        assert_eq!(of("O0001 (A)\nG91 G28 Z0\n"), "fanuc");
        assert_eq!(of("O0001 (A)\nG91 G28 Z0\nG187 P1\n"), "haas");
        assert_eq!(of("$H\nG0 X1\n"), "grbl");
        assert_eq!(of("G28\nM104 S200\nG1 E5\n"), "a 3-D printer (Marlin, Klipper)");
        assert_eq!(of("#<a>=1\nG710\n"), "nothing");
    }
}
