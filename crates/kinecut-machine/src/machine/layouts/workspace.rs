//! Measures of the workspace of a layout, in the spirit of Bohez (2002); the definitions are our own.

use std::f64::consts::{PI, TAU};

use serde::{Serialize, Serializer};

use super::Sizes;
use super::strokes::needed_strokes;
use crate::machine::{CoordinateCode, Elementary};

/// Halvings of the search for the largest cube: its side to one part in sixty thousand.
const HALVINGS: u32 = 16;

/// From this cosine on two directions are one [of 2.6 degrees]: squareness errors are smaller, inclined axes farther.
const ALONG: f64 = 0.999;

/// Measures of the workspace.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Workspace {
    /// Product of the strokes there are [mm^3]; as JSON in litres.
    #[serde(rename = "litres", serialize_with = "litres")]
    pub volume: f64,
    /// Space that both the work and the tool pass, over the space that one of them passes: of a box of the size of the part
    /// (half of the strokes where none is given), moved by the work side, and one moved by the tool side.
    pub utilisation: f64,
    /// Volume of the workspace over that of the box about all that passes on both sides: a block of the size of the part on
    /// the work side, turned with its table, and a head of the tool's length on the tool side, each with its strokes, the
    /// tool above the part.
    pub space_efficiency: f64,
    /// Side of the largest cube that can be worked in all directions of the worked tilt within the strokes [mm]; `None`
    /// for a code without three translations.
    pub largest_cube: Option<f64>,
    /// Volume of that cube over the volume of the workspace.
    pub orientation_space: Option<f64>,
    /// Product over the rotary axes of their range as a share of what could be of use: a whole turn about the spindle, half
    /// a turn about any other direction; `None` without rotary axes.
    pub orientation_angle: Option<f64>,
}

impl Workspace {
    /// Product of the strokes in litres.
    pub fn litres(&self) -> f64 {
        self.volume * 1e-6
    }
}

fn litres<S: Serializer>(volume: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(volume * 1e-6)
}

/// Measures of a code with these sizes.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{CoordinateCode, layouts::{Sizes, workspace}};
/// let sizes = Sizes { stroke: [500.0, 400.0, 300.0], ..Sizes::default() };
/// let three = workspace(&CoordinateCode::parse("2103").unwrap(), &sizes);
/// assert!((three.largest_cube.unwrap() - 300.0).abs() < 0.01); // the shortest stroke
/// ```
pub fn workspace(code: &CoordinateCode, sizes: &Sizes) -> Workspace {
    let part = sizes.part.unwrap_or_else(|| sizes.stroke.map(|s| 0.5 * s));
    let work = &code.word().0[..code.bed()];
    let (mut both, mut by_work, mut by_tool) = (1.0, 1.0, 1.0);
    for (k, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
        let moved = part[k] + sizes.stroke[k];
        let carries_work = work.iter().any(|m| m.letter() == Some(letter));
        let carries_tool = !carries_work && code.axes().any(|l| l == letter);
        by_work *= if carries_work { moved } else { part[k] };
        by_tool *= if carries_tool { moved } else { part[k] };
        both *= part[k];
    }
    let volume: f64 = sizes.stroke.iter().product();
    let largest_cube = largest_cube(code, sizes);
    Workspace {
        volume,
        utilisation: both / (by_work + by_tool - both),
        largest_cube,
        orientation_space: largest_cube.map(|side| side.powi(3) / volume),
        space_efficiency: volume / envelope(code, sizes, part),
        orientation_angle: orientation_angle(code, sizes),
    }
}

/// Volume of the box about what both sides pass [mm^3].
fn envelope(code: &CoordinateCode, sizes: &Sizes, part: [f64; 3]) -> f64 {
    let work = &code.word().0[..code.bed()];
    let spindle = sizes.spindle();
    // A table that turns needs the circle about its part.
    let mut block = part;
    for turn in work.iter().filter(|m| m.is_rotation()) {
        let axis = sizes.direction(*turn).to_array();
        if let Some(k) = (0..3).find(|&k| axis[k].abs() > ALONG) {
            let round = block[(k + 1) % 3].hypot(block[(k + 2) % 3]);
            (block[(k + 1) % 3], block[(k + 2) % 3]) = (round, round);
        } else {
            block = [block.iter().map(|c| c * c).sum::<f64>().sqrt(); 3];
        }
    }
    let axis = spindle.to_array();
    let sides = (0..3).map(|k| {
        let letter = ['X', 'Y', 'Z'][k];
        let carries_work = work.iter().any(|m| m.letter() == Some(letter));
        let carries_tool = !carries_work && code.axes().any(|l| l == letter);
        let [on_work, on_tool] = [carries_work, carries_tool].map(|c| if c { sizes.stroke[k] } else { 0.0 });
        let [below, above] = [block[k] + on_work, sizes.tool_length + on_tool];
        // Along the spindle the tool is behind the part, across it they pass the same places.
        let along = axis[k] * axis[k];
        along * (below + above) + (1.0 - along) * f64::max(below, above)
    });
    sides.product()
}

/// See [`Workspace::orientation_angle`].
fn orientation_angle(code: &CoordinateCode, sizes: &Sizes) -> Option<f64> {
    let spindle = sizes.spindle();
    let share = |motion: &Elementary| {
        let [low, high] = sizes.range(*motion);
        let about_spindle = sizes.direction(*motion).dot(spindle).abs() > ALONG;
        ((high - low) / if about_spindle { TAU } else { PI }).min(1.0)
    };
    let rotary = code.word().0.iter().filter(|m| m.is_rotation());
    rotary.map(share).reduce(|a, b| a * b)
}

/// Strokes grow with the cube, so that halving finds the largest.
fn largest_cube(code: &CoordinateCode, sizes: &Sizes) -> Option<f64> {
    let mut with_cube = sizes.clone();
    let mut fits = |side: f64| {
        with_cube.part = Some([side; 3]);
        let needed = needed_strokes(code, &with_cube)?;
        Some(needed.iter().zip(sizes.stroke).all(|(need, have)| *need <= have))
    };
    let (mut low, mut high) = (0.0, sizes.stroke.iter().copied().fold(0.0, f64::max));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if fits(middle)? { low = middle } else { high = middle }
    }
    Some(low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_needs_room_for_its_swing() {
        let sizes = Sizes { stroke: [1000.0; 3], tool_length: 200.0, ..Sizes::default() };
        let of = |code: &str| workspace(&CoordinateCode::parse(code).unwrap(), &sizes);
        // Two tool lengths less in X: 600 mm.
        assert!((of("21035").largest_cube.unwrap() - 600.0).abs() < 0.1);
        // Longer tools never give more.
        let long = Sizes { tool_length: 300.0, ..sizes.clone() };
        let less = workspace(&CoordinateCode::parse("21035").unwrap(), &long);
        assert!((less.largest_cube.unwrap() - 400.0).abs() < 0.1);
        // A round table turns the cube: its diagonal.
        let table = of("62103").largest_cube.unwrap();
        assert!((table - 1000.0 / 2f64.sqrt()).abs() < 4.0, "{table}");
        assert_eq!(of("6031").largest_cube, None);
    }

    #[test]
    fn axes_shared_between_work_and_tool_use_the_space_best() {
        let sizes = Sizes { stroke: [400.0; 3], ..Sizes::default() };
        let of = |code: &str| workspace(&CoordinateCode::parse(code).unwrap(), &sizes).utilisation;
        // 200^3 / (600^3) with all on one side; 1 / (9 + 3 - 1) with two and one.
        assert!((of("0123") - 1.0 / 27.0).abs() < 1e-12 && (of("3210") - 1.0 / 27.0).abs() < 1e-12);
        assert!((of("2103") - 1.0 / 11.0).abs() < 1e-12);
    }

    #[test]
    fn axes_on_the_work_side_need_more_room_and_ranges_multiply() {
        let sizes = Sizes { stroke: [400.0; 3], tool_length: 100.0, ..Sizes::default() };
        let of = |code: &str| workspace(&CoordinateCode::parse(code).unwrap(), &sizes);
        // Part 200: all on the tool side 500 x 500 x (200 + 500), all on the work side 600 x 600 x (600 + 100).
        assert!((of("0123").space_efficiency - 64.0 / (25.0 * 7.0)).abs() < 1e-12);
        assert!((of("3210").space_efficiency - 64.0 / (36.0 * 7.0)).abs() < 1e-12);
        // A round table: the diagonal of the part.
        let wide = 200.0 * 2f64.sqrt();
        let round = 0.064e9 / ((wide + 400.0) * (wide + 400.0) * 700.0);
        assert!((of("62103").space_efficiency - round).abs() < 1e-12);
        assert_eq!(of("2103").orientation_angle, None);
        assert_eq!(of("641203").orientation_angle, Some(1.0));
        let less = Sizes {
            rotary: [Some([-PI / 3.0, PI / 6.0]), None, Some([-PI / 2.0, PI / 2.0]), None, None, None],
            ..sizes.clone()
        };
        let found = workspace(&CoordinateCode::parse("641203").unwrap(), &less).orientation_angle.unwrap();
        assert!((found - 0.25).abs() < 1e-12, "{found}");
    }
}
