//! Texts that nobody would write, made of programs that somebody would: reading ends, and nothing panics.

mod seeds;
mod target;

use kinecut_nc::nc::Control;
use proptest::prelude::*;

/// A change of a text.
#[derive(Clone, Debug)]
enum Change {
    Word(usize, usize),
    Cut(usize, usize),
    Twice(usize, usize),
    Line(usize, usize),
    Byte(usize, u8),
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        4 => (any::<usize>(), 0..seeds::WORDS.len()).prop_map(|(at, word)| Change::Word(at, word)),
        2 => (any::<usize>(), 1usize..30).prop_map(|(at, length)| Change::Cut(at, length)),
        1 => (any::<usize>(), 1usize..200).prop_map(|(at, length)| Change::Twice(at, length)),
        2 => (any::<usize>(), any::<usize>()).prop_map(|(from, to)| Change::Line(from, to)),
        1 => (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Change::Byte(at, byte)),
    ]
}

fn changed(text: &str, changes: &[Change]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for change in changes {
        let length = bytes.len().max(1);
        let part = |at: usize, n: usize| (at % length).min(bytes.len())..(at % length + n).min(bytes.len());
        match *change {
            Change::Word(at, word) => {
                let at = part(at, 0);
                bytes.splice(at, seeds::WORDS[word].bytes());
            }
            Change::Cut(at, n) => {
                let part = part(at, n);
                bytes.drain(part);
            }
            Change::Twice(at, n) => {
                let part = part(at, n);
                let piece = bytes[part.clone()].to_vec();
                bytes.splice(part.start..part.start, piece);
            }
            Change::Line(from, to) => {
                let mut lines: Vec<&[u8]> = bytes.split_inclusive(|b| *b == b'\n').collect();
                if !lines.is_empty() {
                    let line = lines.remove(from % lines.len());
                    lines.insert(to % (lines.len() + 1), line);
                    bytes = lines.concat();
                }
            }
            Change::Byte(at, byte) => {
                let at = part(at, 1);
                bytes.splice(at, [byte]);
            }
        }
    }
    bytes
}

#[test]
fn the_programs_themselves_are_read_or_refused() {
    for (control, texts) in seeds::FAMILIES {
        texts.iter().for_each(|text| target::program(control, text.as_bytes()));
    }
}

fn family() -> impl Strategy<Value = (Control, &'static str)> {
    (0..seeds::FAMILIES.len(), any::<usize>()).prop_map(|(family, which)| {
        let (control, texts) = seeds::FAMILIES[family];
        (control, texts[which % texts.len()])
    })
}

proptest! {
    #![proptest_config(kinecut_cases::property(4000))]
    #[test]
    fn every_text_has_an_answer((control, text) in family(), changes in prop::collection::vec(change(), 0..8)) {
        target::program(control, &changed(text, &changes));
    }
}
