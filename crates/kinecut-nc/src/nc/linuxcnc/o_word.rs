//! O words of LinuxCNC: subprograms, branches and loops.
//!
//! `o` with a number, a name in `<>`, a parameter or an expression, then a word. A file is looked through once for its o
//! words, which are paired: what a branch skips is not read again.

use std::collections::HashMap;

use crate::nc::scan::lines_with;

/// The word behind the label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::nc) enum OWord {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// A label alone: the beginning of a program that `M98` calls.
    Program,
}

/// Words in the order in which they are looked for: none begins with one before it.
const WORDS: [(&str, OWord); 15] = [
    ("ENDSUB", OWord::EndSub),
    ("ENDIF", OWord::EndIf),
    ("ENDWHILE", OWord::EndWhile),
    ("ENDREPEAT", OWord::EndRepeat),
    ("ELSEIF", OWord::ElseIf),
    ("ELSE", OWord::Else),
    ("SUB", OWord::Sub),
    ("CALL", OWord::Call),
    ("RETURN", OWord::Return),
    ("REPEAT", OWord::Repeat),
    ("WHILE", OWord::While),
    ("BREAK", OWord::Break),
    ("CONTINUE", OWord::Continue),
    ("IF", OWord::If),
    ("DO", OWord::Do),
];

/// A line with an o word, by the number of its place in the list of all.
#[derive(Clone, Debug)]
pub(in crate::nc) struct OLine {
    /// First byte of the line, and of the one behind it.
    pub(in crate::nc) start: usize,
    pub(in crate::nc) after: usize,
    pub(in crate::nc) word: OWord,
    /// The line that opens what this one goes on with or ends.
    pub(in crate::nc) begin: Option<usize>,
    /// The next line of the same branch or loop: `elseif`, `else`, or its end.
    pub(in crate::nc) next: Option<usize>,
    /// The last line of the same branch or loop; of a line that opens one.
    pub(in crate::nc) end: Option<usize>,
    /// The last `break` of a loop, of the line that opens it.
    last_break: Option<usize>,
    /// A subprogram that begins within this one.
    pub(in crate::nc) inner: Option<usize>,
}

impl OLine {
    fn new(start: usize, after: usize, word: OWord) -> OLine {
        OLine { start, after, word, begin: None, next: None, end: None, last_break: None, inner: None }
    }
}

/// The o words of a file.
#[derive(Debug, Default)]
pub(in crate::nc) struct OLines {
    lines: Vec<OLine>,
    subs: HashMap<String, usize>,
    programs: HashMap<String, usize>,
}

/// First byte of the label of an o word in a line: behind blanks, `/` and a block number.
#[inline]
pub(in crate::nc) fn label_at(line: &[u8]) -> Option<usize> {
    let mut at = 0;
    let mut numbered = false;
    loop {
        match line.get(at)? {
            b' ' | b'\t' | b'/' => at += 1,
            b'o' | b'O' => return Some(at),
            b'n' | b'N' if !numbered => {
                numbered = true;
                at += 1;
                at += line[at..].iter().take_while(|b| matches!(b, b'0'..=b'9' | b' ' | b'.')).count();
            }
            _ => return None,
        }
    }
}

/// The label behind the `o` as it is compared, and the byte behind it; nothing of a label that is computed.
fn label(line: &[u8], from: usize) -> Option<(String, usize)> {
    let mut at = from;
    while matches!(line.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    if line.get(at) == Some(&b'<') {
        let close = line[at..].iter().position(|b| *b == b'>')? + at;
        let name = line[at + 1..close].iter().filter(|b| !b.is_ascii_whitespace());
        let name: Vec<u8> = name.map(u8::to_ascii_lowercase).collect();
        return Some((String::from_utf8_lossy(&name).into_owned(), close + 1));
    }
    let mut digits = String::new();
    while let Some(byte) = line.get(at).filter(|b| matches!(b, b'0'..=b'9' | b' ' | b'\t')) {
        if byte.is_ascii_digit() {
            digits.push(*byte as char);
        }
        at += 1;
    }
    (!digits.is_empty()).then(|| (number_label(&digits), at))
}

/// A number as a label: without the noughts before it.
fn number_label(digits: &str) -> String {
    let short = digits.trim_start_matches('0');
    if short.is_empty() { "0".to_owned() } else { short.to_owned() }
}

/// The word from a byte on, and the byte behind it.
fn word(line: &[u8], from: usize) -> (OWord, usize) {
    let first = line.get(from..).and_then(|rest| rest.iter().find(|b| !matches!(b, b' ' | b'\t')));
    let first = first.map_or(0, u8::to_ascii_uppercase);
    for (letters, word) in WORDS.iter().filter(|(letters, _)| letters.as_bytes()[0] == first) {
        let mut at = from;
        let here = letters.bytes().all(|letter| {
            while matches!(line.get(at), Some(b' ' | b'\t')) {
                at += 1;
            }
            let same = line.get(at).is_some_and(|b| b.to_ascii_uppercase() == letter);
            at += 1;
            same
        });
        if here {
            return (*word, at);
        }
    }
    (OWord::Program, from)
}

/// The word of a line with the `o` at a byte, and the byte behind it; the label ends at another.
pub(in crate::nc) fn parsed(line: &[u8], label_end: usize) -> (OWord, usize) {
    word(line, label_end)
}

impl OLines {
    /// Looks through a text.
    pub(in crate::nc) fn of(text: &str) -> OLines {
        let mut all = OLines::default();
        // What is open of each label: the line that opened it, and the last that went on with it.
        let mut open: HashMap<String, Vec<[usize; 2]>> = HashMap::new();
        for (start, after) in lines_with(text, b'O') {
            let bytes = &text.as_bytes()[start..after];
            if let Some(at) = label_at(bytes)
                && let Some((label, end)) = label(bytes, at + 1)
            {
                let (word, _) = word(bytes, end);
                all.add(OLine::new(start, after, word), label, &mut open);
            }
        }
        all.nest();
        all
    }

    /// Finds the subprograms that begin within another one.
    fn nest(&mut self) {
        let mut next = None;
        for index in (0..self.lines.len()).rev().filter(|_| !self.subs.is_empty()) {
            if self.lines[index].word == OWord::Sub {
                let end = self.lines[index].end;
                self.lines[index].inner = next.filter(|next| end.is_some_and(|end| *next < end));
                next = Some(index);
            }
        }
    }

    fn add(&mut self, line: OLine, label: String, open: &mut HashMap<String, Vec<[usize; 2]>>) {
        let this = self.lines.len();
        let word = line.word;
        self.lines.push(line);
        match word {
            OWord::Call | OWord::Return => return,
            OWord::Program => {
                self.programs.entry(label).or_insert(this);
                return;
            }
            OWord::Sub => {
                self.subs.entry(label.clone()).or_insert(this);
            }
            _ => {}
        }
        let open = open.entry(label).or_default();
        let Some(&mut [begin, ref mut last]) = open.last_mut() else {
            if word.opens() {
                open.push([this, this]);
            }
            return;
        };
        let opened = self.lines[begin].word;
        if !word.goes_on(opened) {
            if word.opens() {
                open.push([this, this]);
            }
            return;
        }
        self.lines[this].begin = Some(begin);
        if word == OWord::Break {
            self.lines[begin].last_break = Some(this);
        }
        if matches!(word, OWord::Break | OWord::Continue) {
            return;
        }
        self.lines[*last].next = Some(this);
        *last = this;
        if word.ends(opened) {
            self.lines[begin].end = Some(this);
            open.pop();
        }
    }

    /// Labels of calls.
    pub(in crate::nc) fn calls(&self, text: &str) -> Vec<String> {
        let calls = self.lines.iter().filter(|line| line.word == OWord::Call);
        let name = |line: &OLine| {
            let bytes = &text.as_bytes()[line.start..line.after];
            label(bytes, label_at(bytes)? + 1).map(|(label, _)| label)
        };
        calls.filter_map(name).collect()
    }

    /// The o word of the line that begins at a byte.
    pub(in crate::nc) fn at(&self, start: usize) -> Option<usize> {
        self.lines.binary_search_by_key(&start, |line| line.start).ok()
    }

    pub(in crate::nc) fn line(&self, index: usize) -> &OLine {
        &self.lines[index]
    }

    /// Whether a loop has a `break` behind a line of it.
    pub(in crate::nc) fn breaks_behind(&self, own: usize) -> bool {
        let begin = self.lines[own].begin.unwrap_or(own);
        self.lines[begin].last_break.is_some_and(|last| last > own)
    }

    /// The subprogram of a label.
    pub(in crate::nc) fn sub(&self, label: &str) -> Option<usize> {
        self.subs.get(label).copied()
    }

    /// The program that `M98` calls by a number.
    pub(in crate::nc) fn program(&self, number: u32) -> Option<usize> {
        let label = number.to_string();
        self.programs.get(&label).or_else(|| self.subs.get(&label)).copied()
    }
}

impl OWord {
    fn opens(self) -> bool {
        matches!(self, OWord::Sub | OWord::If | OWord::While | OWord::Do | OWord::Repeat)
    }

    fn goes_on(self, opened: OWord) -> bool {
        match self {
            OWord::ElseIf | OWord::Else => opened == OWord::If,
            OWord::Break | OWord::Continue => matches!(opened, OWord::While | OWord::Do | OWord::Repeat),
            _ => self.ends(opened),
        }
    }

    fn ends(self, opened: OWord) -> bool {
        matches!(
            (opened, self),
            (OWord::Sub, OWord::EndSub)
                | (OWord::If, OWord::EndIf)
                | (OWord::While, OWord::EndWhile)
                | (OWord::Do, OWord::While)
                | (OWord::Repeat, OWord::EndRepeat)
        )
    }

    /// The word that ends what this one opens.
    pub(in crate::nc) fn end_word(self) -> &'static str {
        match self {
            OWord::Sub => "endsub",
            OWord::If => "endif",
            OWord::While => "endwhile",
            OWord::Do => "while",
            OWord::Repeat => "endrepeat",
            _ => "",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_and_loops_are_paired() {
        let text = "o<fill> sub\n o1 while [#1]\n  o2 if [1]\n  o1 break\n  o2 elseif [2]\n  O2 else\n  o2 endif\nN5 o1 endwhile\no<FI ll>endsub\no3 do\no3 while [0]\no100\n";
        let lines = OLines::of(text);
        let words: Vec<OWord> = lines.lines.iter().map(|l| l.word).collect();
        assert_eq!(
            words,
            [
                OWord::Sub,
                OWord::While,
                OWord::If,
                OWord::Break,
                OWord::ElseIf,
                OWord::Else,
                OWord::EndIf,
                OWord::EndWhile,
                OWord::EndSub,
                OWord::Do,
                OWord::While,
                OWord::Program,
            ]
        );
        let next: Vec<Option<usize>> = lines.lines.iter().map(|l| l.next).collect();
        assert_eq!(next[..6], [Some(8), Some(7), Some(4), None, Some(5), Some(6)]);
        assert_eq!(
            (lines.lines[3].begin, lines.lines[2].end, lines.lines[9].end),
            (Some(1), Some(6), Some(10))
        );
        assert_eq!((lines.sub("fill"), lines.program(100), lines.program(7)), (Some(0), Some(11), None));
    }
}
