//! `CYCLE800`: its arguments, and the tilted plane that they ask for.
//!
//! ```text
//! CYCLE800(_FR, _TC, _ST, _MODE, _X0, _Y0, _Z0, _A, _B, _C, _X1, _Y1, _Z1, _DIR, _FR_I, _DMODE)
//! ```
//!
//! `_FR` how the tool withdraws first (0: not at all), `_TC` name of the machine's swivel data ("": the only ones, "0":
//! none, which ends swivelling), `_ST` units 0 a new plane, 1 one within the plane in force; `_MODE` in its top two bits
//! the kind of angles (0: one axis after the other) and below, from the lowest, two bits each for the axes of the first,
//! second and third rotation: 57 is X, Y, Z. `_X0` to `_Z0` the point about which it turns, `_X1` to `_Z1` a shift in the
//! plane, `_A` to `_C` the angles in the order of the rotations, about axes that turn along. `_DIR` turns the rotary axes
//! to the solution that is larger (1) or smaller (-1) in the first of them, 0 leaves them where they are. No argument at
//! all ends swivelling.
//!
//! Written with mode 57, `_FR` 0, `_TC` "", `_DIR` by the branch of the frame; a frame that leaves the choice to the
//! control is written as -1, which is what the control's own mask proposes. Read with any order of three different axes;
//! solid, projected and direct angles are refused by name. Withdrawing is by the machine's data: it is noted, not followed.
//!
//! Source: published post-processors for the modes and their orders, programs of others; that `_A` to `_C` are in the order
//! of the rotations and the hundred-thousands of `_ST` (2: swivel) are from memory of the programming guide.

use crate::nc::tilt::{Order, XYZ};
use crate::program::RotarySolution;

/// Name of the call.
pub(in crate::nc) const NAME: &str = "CYCLE800";

/// Place of the name of the swivel data.
pub(in crate::nc) const TC: usize = 1;
const FR: usize = 0;
const ST: usize = 2;
const MODE: usize = 3;
const POINT: usize = 4;
const ANGLES: usize = 7;
const SHIFT: usize = 10;
const DIR: usize = 13;
const FR_I: usize = 14;
const DMODE: usize = 15;

/// Content of a call; mm in the program's unit, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::nc) struct Swivel {
    /// Whether the plane lies within the one in force.
    pub(in crate::nc) add: bool,
    pub(in crate::nc) order: Order,
    /// Point about which it turns.
    pub(in crate::nc) point: [f64; 3],
    pub(in crate::nc) angles: [f64; 3],
    /// Shift in the plane.
    pub(in crate::nc) shift: [f64; 3],
    /// The solution to which the rotary axes turn; none: they stand still.
    pub(in crate::nc) turn: Option<RotarySolution>,
    /// Whether the tool withdraws first.
    pub(in crate::nc) withdraws: bool,
}

/// The number of the mode of an order of axes.
pub(in crate::nc) fn mode(order: Order) -> u32 {
    order.iter().rev().fold(0, |bits, axis| bits << 2 | (*axis as u32 + 1))
}

/// The words of a call up to `_MODE`, and its `_DIR`.
pub(in crate::nc) fn written(branch: Option<RotarySolution>) -> (String, i32) {
    let direction = match branch {
        None => 0,
        Some(RotarySolution::Positive) => 1,
        Some(RotarySolution::Negative | RotarySolution::Free) => -1,
    };
    (format!("{NAME}(0,\"\",0,{}", mode(XYZ)), direction)
}

/// Reads the arguments; `name`: the name of the swivel data. `Ok(None)`: swivelling ends.
///
/// # Errors
/// Place of the argument that is not understood, and why.
pub(in crate::nc) fn read(
    arguments: &[Option<f64>],
    name: Option<&str>,
) -> Result<Option<Swivel>, (usize, &'static str)> {
    if name.is_none() && arguments.iter().all(Option::is_none) || name == Some("0") {
        return Ok(None);
    }
    let of = |place: usize| arguments.get(place).copied().flatten().unwrap_or(0.0);
    let whole = |place: usize| {
        let value = of(place);
        (value.fract() == 0.0 && value.abs() < f64::from(i32::MAX))
            .then_some(value as i32)
            .ok_or((place, "it is a whole number"))
    };
    if let Some(extra) = (DMODE + 1..arguments.len()).find(|i| arguments[*i].is_some()) {
        return Err((extra, "an argument after _DMODE is not read"));
    }
    let status = whole(ST)?;
    if !matches!(status, 0 | 1 | 200_000 | 200_001) {
        return Err((ST, "_ST is read as 0 or 1 (with 200000), not with other digits"));
    }
    let bits = whole(MODE)?;
    match bits >> 6 {
        0 => {}
        1 => return Err((MODE, "solid angles are not read")),
        2 => return Err((MODE, "projected angles are not read")),
        3 => {
            return Err((
                MODE,
                "rotary axes given directly are not read: their place is data of the machine",
            ));
        }
        _ => return Err((MODE, "this mode is not known")),
    }
    let order = [0, 2, 4].map(|shift| (bits >> shift & 3) as usize);
    let mut sorted = order;
    sorted.sort_unstable();
    if sorted != [1, 2, 3] {
        return Err((MODE, "the mode names the same axis twice, or none"));
    }
    let turn = match whole(DIR)? {
        0 => None,
        1 => Some(RotarySolution::Positive),
        -1 => Some(RotarySolution::Negative),
        _ => return Err((DIR, "_DIR is -1, 0 or 1")),
    };
    if of(FR_I) != 0.0 {
        return Err((FR_I, "a distance of withdrawing is not read"));
    }
    if !matches!(whole(DMODE)?, 0 | 1) {
        return Err((DMODE, "_DMODE is read as 0 or 1, the plane G17"));
    }
    let three = |from: usize| [of(from), of(from + 1), of(from + 2)];
    Ok(Some(Swivel {
        add: status % 10 == 1,
        order: order.map(|axis| axis - 1),
        point: three(POINT),
        angles: three(ANGLES),
        shift: three(SHIFT),
        turn,
        withdraws: whole(FR)? != 0,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_those_of_the_control() {
        let modes = [[0, 1, 2], [2, 1, 0], [1, 0, 2], [2, 0, 1], [0, 2, 1], [1, 2, 0]].map(mode);
        assert_eq!(modes, [57, 27, 54, 39, 45, 30]);
    }

    #[test]
    fn a_call_is_read_by_its_places() {
        let mut call =
            [2.0, 0.0, 200_001.0, 54.0, 35.0, -24.0, 3.0, 7.0, 8.0, 9.0, 1.0, 2.0, 4.0, 1.0].map(Some);
        call[1] = None;
        let swivel = read(&call, Some("TISCH")).unwrap().unwrap();
        let wanted = Swivel {
            add: true,
            order: [1, 0, 2],
            point: [35.0, -24.0, 3.0],
            angles: [7.0, 8.0, 9.0],
            shift: [1.0, 2.0, 4.0],
            turn: Some(RotarySolution::Positive),
            withdraws: true,
        };
        assert_eq!(swivel, wanted);
        assert_eq!(read(&call, Some("0")), Ok(None));
        assert_eq!(read(&[None], None), Ok(None));
        for (place, value) in [(2, 10.0), (3, 192.0), (3, 64.0), (3, 128.0), (3, 21.0), (3, 57.5), (13, 2.0)]
        {
            let mut bad = call;
            bad[place] = Some(value);
            assert_eq!(read(&bad, Some("")).unwrap_err().0, place);
        }
    }
}
