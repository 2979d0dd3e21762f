//! Raw stock in comments and in blocks of their own.

use super::{comments_of, number};
use crate::nc::Control;

/// A block that a program describes, in coordinates of the program [mm].
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedStock {
    /// Least corner.
    pub min: [f64; 3],
    /// Greatest corner.
    pub max: [f64; 3],
    /// Line that describes it.
    pub line: u32,
    /// What is assumed with it, in words.
    pub assumed: Option<&'static str>,
}

/// The first block that a text describes.
pub(super) fn stock(text: &str, unit: f64, control: Control) -> Option<CarriedStock> {
    let found = match control {
        Control::Heidenhain => blank_form(text, unit),
        Control::Sinumerik840d => workpiece(text, unit),
        _ => material_size(text, unit),
    };
    found.filter(|s| (0..3).all(|i| s.min[i] < s.max[i] && (s.max[i] - s.min[i]) < 1e5))
}

/// `(Material Size)` and `(X= 300.0, Y= 200.0, Z= 18.0)` of Vectric.
fn material_size(text: &str, unit: f64) -> Option<CarriedStock> {
    let mut lines = text
        .lines()
        .enumerate()
        .skip_while(|(_, line)| !comments_of(line).any(|c| c.to_ascii_uppercase().contains("MATERIAL SIZE")));
    let (line, size) = lines.by_ref().take(3).find_map(|(index, line)| {
        comments_of(line).find_map(|comment| Some((index, sizes(&comment.to_ascii_uppercase())?)))
    })?;
    let says = |words: &str| text.lines().take(60).any(|l| l.to_ascii_uppercase().contains(words));
    let table = says("TABLE SURFACE") || says("MATERIAL BASE");
    let centre = says("CENTER") && says("XY ORIGIN");
    let size = size.map(|v| v * unit);
    let low = if centre { [-0.5 * size[0], -0.5 * size[1]] } else { [0.0; 2] };
    let bottom = if table { 0.0 } else { -size[2] };
    let assumed = match (centre, table, says("ORIGIN")) {
        (_, _, true) => None,
        _ => Some("its zero is taken to be the lower left corner of its upper side"),
    };
    let min = [low[0], low[1], bottom];
    Some(CarriedStock { min, max: [0, 1, 2].map(|i| min[i] + size[i]), line: line as u32 + 1, assumed })
}

/// `X= .., Y= .., Z= ..`.
fn sizes(comment: &str) -> Option<[f64; 3]> {
    let mut size = [0.0; 3];
    for (value, axis) in size.iter_mut().zip(["X", "Y", "Z"]) {
        let rest = comment[comment.find(axis)? + 1..].trim_start().strip_prefix('=')?;
        *value = number(rest.trim_start())?.0;
    }
    Some(size)
}

/// `WORKPIECE(,"",,"BOX",bits,Z0,Z1,ZB,X0,Y0,X1,Y1)` of SINUMERIK: bits 4, 5 and 6 say that X1, Y1 and Z1 are absolute.
fn workpiece(text: &str, unit: f64) -> Option<CarriedStock> {
    text.lines().enumerate().find_map(|(index, line)| {
        let upper = line.to_ascii_uppercase();
        let inner = upper.split_once("WORKPIECE(")?.1.split_once(')')?.0;
        let arguments: Vec<&str> = inner.split(',').map(str::trim).collect();
        if arguments.get(3).map(|a| a.trim_matches('"')) != Some("BOX") {
            return None;
        }
        let value = |i: usize| arguments.get(i).and_then(|a| number(a)).map(|(v, _)| v);
        let bits = value(4)? as u32;
        let (z0, z1, x0, y0) = (value(5)?, value(6)?, value(8)?, value(9)?);
        let end =
            |i: usize, bit: u32, from: f64| value(i).map(|v| if bits & 1 << bit == 0 { from + v } else { v });
        let z1 = if bits & 1 << 6 == 0 { z0 + z1 } else { z1 };
        let (x1, y1) = (end(10, 4, x0)?, end(11, 5, y0)?);
        let pairs = [(x0, x1), (y0, y1), (z0, z1)].map(|(a, b)| (a.min(b) * unit, a.max(b) * unit));
        Some(CarriedStock {
            min: pairs.map(|p| p.0),
            max: pairs.map(|p| p.1),
            line: index as u32 + 1,
            assumed: None,
        })
    })
}

/// `BLK FORM 0.1 Z X.. Y.. Z..` and `BLK FORM 0.2 X.. Y.. Z..` of HEIDENHAIN.
fn blank_form(text: &str, unit: f64) -> Option<CarriedStock> {
    let corner = |which: &str| {
        text.lines().enumerate().find_map(|(index, line)| {
            let (_, rest) = line.split_once(which)?;
            let mut at = [None; 3];
            for word in rest.split_whitespace() {
                let axis = ["X", "Y", "Z"].iter().position(|a| word.starts_with(a) && word.len() > 1);
                let Some(axis) = axis else { continue };
                at[axis] = Some(number(&word[1..].replace(',', "."))?.0 * unit);
            }
            Some((index as u32 + 1, [at[0]?, at[1]?, at[2]?]))
        })
    };
    let ((line, min), (_, max)) = (corner("BLK FORM 0.1")?, corner("BLK FORM 0.2")?);
    Some(CarriedStock { min, max, line, assumed: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_of_controls_and_systems_are_read() {
        let vectric = "( Material Size)\n( X= 300.000, Y= 200.000, Z= 18.000)\nG20";
        let found = stock(vectric, 1.0, Control::Grbl).unwrap();
        assert_eq!((found.min, found.max, found.line), ([0.0, 0.0, -18.0], [300.0, 200.0, 0.0], 2));
        assert!(found.assumed.is_some());
        let origin = format!("(XY Origin : Center)\n(Z Origin : Table Surface)\n{vectric}");
        let found = stock(&origin, 25.4, Control::LinuxCnc).unwrap();
        assert!((found.min[0] + 3810.0).abs() < 1e-9 && found.min[2] == 0.0 && found.assumed.is_none());
        let box_of = "N10 WORKPIECE(,\"\",,\"BOX\",112,0,50,-80,0,0,100.2,100.4)";
        let found = stock(box_of, 1.0, Control::Sinumerik840d).unwrap();
        assert_eq!((found.min, found.max), ([0.0; 3], [100.2, 100.4, 50.0]));
        let increments = "WORKPIECE(,,,\"BOX\",0,2,-20,-80,10,10,100,60)";
        let found = stock(increments, 1.0, Control::Sinumerik840d).unwrap();
        assert_eq!((found.min, found.max), ([10.0, 10.0, -18.0], [110.0, 70.0, 2.0]));
        let form = "1 BLK FORM 0.1 Z X-10 Y+0 Z-20,5\n2 BLK FORM 0.2 X+100 Y+80 Z+0\n";
        let found = stock(form, 1.0, Control::Heidenhain).unwrap();
        assert_eq!((found.min, found.max, found.line), ([-10.0, 0.0, -20.5], [100.0, 80.0, 0.0], 1));
    }

    #[test]
    fn half_a_block_is_none() {
        assert!(stock("1 BLK FORM 0.1 Z X-10 Y+0 Z-20", 1.0, Control::Heidenhain).is_none());
        assert!(stock("(Material Size)\n(X= 3, Y= 2)", 1.0, Control::Grbl).is_none());
        assert!(stock("(Material Size)\n(X= 3, Y= 2, Z= 0)", 1.0, Control::Grbl).is_none());
        assert!(stock("WORKPIECE(,,,\"CYLINDER\",0,0,1)", 1.0, Control::Sinumerik840d).is_none());
    }
}
