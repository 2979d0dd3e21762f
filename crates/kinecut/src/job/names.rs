//! Names and numbers of the programs of a job with several setups: each has its own, or the second would replace the first in
//! the control.

use crate::base::{Code, Finding, Result};
use crate::nc::PostSettings;

/// Longest name of a program that every control keeps: beyond it the end, which tells two apart, would be cut off.
const LONGEST: usize = 24;
/// Greatest number of a program.
const GREATEST: u32 = 9999;

/// The number that a name like `O1234` says.
pub(super) fn number_of(name: &str) -> Option<u32> {
    let digits = name.strip_prefix(['O', 'o'])?;
    let plain = (1..=4).contains(&digits.len()) && digits.chars().all(|c| c.is_ascii_digit());
    plain.then(|| digits.parse().ok()).flatten()
}

/// The settings with which the program of a setup is written, `index` counted from 0, of `count` in all.
///
/// # Errors
/// `KC0103` when numbers would go beyond what the control has.
pub(super) fn of_setup(post: &PostSettings, index: usize, count: usize) -> Result<PostSettings> {
    let mut own = post.clone();
    if count < 2 {
        return Ok(own);
    }
    own.program_number = counted(post.program_number, index)?;
    own.program_name = match number_of(&post.program_name) {
        Some(number) => format!("O{:04}", counted(number, index)?),
        None => {
            let end = format!("_{}", index + 1);
            let begin: String = post.program_name.chars().take(LONGEST - end.len().min(LONGEST)).collect();
            format!("{begin}{end}")
        }
    };
    Ok(own)
}

fn counted(first: u32, index: usize) -> Result<u32> {
    let number = u32::try_from(index).ok().and_then(|i| first.checked_add(i)).filter(|n| *n <= GREATEST);
    number.ok_or_else(|| {
        Finding::error(Code::JOB_VALUE, "the numbers of the programs of the setups go beyond the last one")
            .value(f64::from(first) + index as f64, "")
            .bound(f64::from(GREATEST), "")
            .help("begin with a lower number")
            .key("post.program_number")
            .into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nc::Control;

    fn named(name: &str, number: u32, count: usize) -> Vec<(String, u32)> {
        let mut post = PostSettings::new(Control::Fanuc);
        (post.program_name, post.program_number) = (name.to_owned(), number);
        let one = |i| of_setup(&post, i, count).map(|own| (own.program_name, own.program_number));
        (0..count).map(one).collect::<Result<_>>().unwrap_or_default()
    }

    #[test]
    fn programs_of_several_setups_have_names_and_numbers_of_their_own() {
        assert_eq!(named("PLATE", 1, 1), [("PLATE".to_owned(), 1)]);
        assert_eq!(named("PLATE", 1, 2), [("PLATE_1".to_owned(), 1), ("PLATE_2".to_owned(), 2)]);
        assert_eq!(named("O1234", 1234, 2), [("O1234".to_owned(), 1234), ("O1235".to_owned(), 1235)]);
        let long = named("A_VERY_LONG_NAME_OF_A_PROGRAM", 7, 12);
        assert!(long.iter().all(|(name, _)| name.len() <= LONGEST));
        assert!(
            long.iter().enumerate().all(|(i, (name, _))| long[..i].iter().all(|(other, _)| other != name))
        );
        assert!(named("PLATE", 9999, 2).is_empty(), "there is no O10000");
    }
}
