//! Numbers and names as an option writes them.

use kinecut::job::Uncertainty;

/// Numbers with commas between.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|t| t.trim().parse::<f64>()).collect();
    numbers.ok()?.try_into().ok()
}

/// Three finite numbers.
pub(crate) fn triple(text: &str) -> Result<[f64; 3], String> {
    numbers(text)
        .filter(|n| n.iter().all(|v| v.is_finite()))
        .ok_or_else(|| "write three numbers with commas between, such as 0,-1,1".to_owned())
}

/// Distances by which a zero, a tool's length and the raw stock may be off.
pub(crate) fn uncertainty(text: &str) -> Result<Uncertainty, String> {
    let distances = |n: &[f64; 3]| n.iter().all(|v| v.is_finite() && *v >= 0.0);
    let [offset, length, stock] = numbers(text).filter(distances).ok_or_else(|| {
        "write by how much the zero, each tool's length and the raw stock may be off, none below zero, such as 0.05,0.02,0.5"
            .to_owned()
    })?;
    Ok(Uncertainty { offset, length, stock })
}

/// Six finite numbers.
pub(crate) fn corners(text: &str) -> Result<[f64; 6], String> {
    numbers(text).filter(|n| n.iter().all(|v| v.is_finite())).ok_or_else(|| {
        "write the least and the greatest corner as six numbers, such as -5,-5,-20,105,65,0".to_owned()
    })
}

/// Two points that are not one.
pub(crate) fn two_points(text: &str) -> Result<[f64; 6], String> {
    let apart = |n: &[f64; 6]| n.iter().all(|v| v.is_finite()) && n[..3] != n[3..];
    numbers(text).filter(apart).ok_or_else(|| {
        "write two different points as six numbers with commas between, such as 0,5,-1,0,25,-1".to_owned()
    })
}

/// Two numbers.
pub(crate) fn pair(text: &str) -> Result<[f64; 2], String> {
    numbers(text)
        .ok_or_else(|| "write micrometres and seconds of arc with a comma between, such as 5,3".to_owned())
}

/// An axis with its errors.
pub(crate) fn errors_of(text: &str) -> Result<(char, [f64; 2]), String> {
    let wrong = || "write an axis and its errors, such as X=5,3".to_owned();
    let (axis, errors) = text.split_once('=').ok_or_else(wrong)?;
    let mut letters = axis.trim().chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) => Ok((letter.to_ascii_uppercase(), pair(errors)?)),
        _ => Err(wrong()),
    }
}

/// A count and a length.
pub(crate) fn stacking(text: &str) -> Result<(usize, f64), String> {
    text.split_once(',')
        .and_then(|(n, mm)| Some((n.trim().parse().ok()?, mm.trim().parse().ok()?)))
        .ok_or_else(|| "write a count and a length, such as 2,1000".to_owned())
}

/// A name with a number.
pub(crate) fn weight(text: &str) -> Result<(String, f64), String> {
    text.split_once('=')
        .and_then(|(name, value)| Some((name.trim().to_owned(), value.trim().parse().ok()?)))
        .ok_or_else(|| "write a name and a number, such as moved-mass=2".to_owned())
}

/// A name with a text.
pub(crate) fn named(text: &str) -> Result<(String, String), String> {
    text.split_once('=')
        .map(|(name, value)| (name.trim().to_owned(), value.trim().to_owned()))
        .ok_or_else(|| "write a name and a value, such as R=40".to_owned())
}
