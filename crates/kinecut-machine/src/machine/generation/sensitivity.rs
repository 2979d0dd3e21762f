//! Effect of errors of the axes on a surface: the error budget over all places of contact.
//!
//! Each axis has an error of position (along its motion), and the errors of its guide: shifts in three directions and
//! turns about three axes, about the reference point of the axis. At each place they weigh by the gains of
//! [`error_gain`]; what counts is the greatest over the surface.

use glam::DVec3;
use serde::{Serialize, Serializer};

use super::error_gain;
use crate::machine::Machine;

/// Sizes of the errors of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisErrors {
    /// Of position of a translation, and of each of the three shifts of the guide [mm].
    pub shift: f64,
    /// Of position of a rotation, and of each of the three turns of the guide [rad].
    pub turn: f64,
}

/// Ten micrometres and ten seconds of arc.
impl Default for AxisErrors {
    fn default() -> AxisErrors {
        AxisErrors { shift: 0.01, turn: (10.0f64 / 3600.0).to_radians() }
    }
}

/// Effect of the errors of one axis on the surface, along its normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AxisEffect {
    /// Address of the axis.
    #[serde(rename = "axis")]
    pub letter: char,
    /// By its error of position, where that is greatest [mm].
    #[serde(rename = "position_um", serialize_with = "in_micro")]
    pub position: f64,
    /// By its six errors, as independent ones: root of the sum of squares, where that is greatest [mm].
    #[serde(rename = "guide_um", serialize_with = "in_micro")]
    pub guide: f64,
}

/// Micrometres of a length [mm], rounded to picometres: finer is below what any of this means.
pub fn micro(mm: f64) -> f64 {
    /// Micrometres in a millimetre.
    const MICRO: f64 = 1e3;
    /// Picometres in a micrometre.
    const FINEST: f64 = 1e6;
    // Adding zero makes -0 to 0.
    (mm * MICRO * FINEST).round() / FINEST + 0.0
}

fn in_micro<S: Serializer>(mm: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(micro(*mm))
}

/// An error budget over a surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceBudget {
    /// Each axis, in the order of the code.
    pub axes: Vec<AxisEffect>,
    /// All errors of all axes as independent ones: root of the sum of squares, where that is greatest [mm].
    #[serde(rename = "independent_um", serialize_with = "in_micro")]
    pub independent: f64,
    /// All errors of all axes at their bounds with the worst signs, where that is greatest [mm].
    #[serde(rename = "worst_um", serialize_with = "in_micro")]
    pub worst: f64,
    /// The place of `worst` [mm].
    #[serde(serialize_with = "place")]
    pub at: DVec3,
}

fn place<S: Serializer>(at: &DVec3, serializer: S) -> Result<S::Ok, S::Error> {
    at.to_array().serialize(serializer)
}

/// The error budget of a machine over places of a surface: positions of the joints [mm or rad], the point in the work [mm],
/// its unit normal. Of each axis come the sizes of its errors; missing ones count as none. None without places.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::machine::generation::{sensitivity, AxisErrors};
/// use kinecut::machine::{CoordinateCode, Machine};
/// // A lathe turns a radius of 30 mm: an error of X stands fully in it, one of Z or of the angle of C not at all.
/// let lathe = Machine::of_code(CoordinateCode::parse("6031").unwrap());
/// let place = ([0.0, 200.0, 30.0].as_slice(), DVec3::new(30.0, 0.0, 200.0), DVec3::X);
/// let budget = sensitivity(&lathe, &[place], &[AxisErrors::default(); 3]).unwrap();
/// let positions: Vec<f64> = budget.axes.iter().map(|a| (a.position * 1e3).round()).collect();
/// assert_eq!(positions, [0.0, 0.0, 10.0]);
/// ```
pub fn sensitivity(
    machine: &Machine,
    places: &[(&[f64], DVec3, DVec3)],
    sizes: &[AxisErrors],
) -> Option<SurfaceBudget> {
    let mut total: Option<SurfaceBudget> = None;
    for &(q, point, normal) in places {
        let gain = error_gain(machine, q, point, normal);
        let (mut squares, mut sum) = (0.0, 0.0);
        let axes: Vec<AxisEffect> = machine
            .joints
            .iter()
            .enumerate()
            .map(|(i, joint)| {
                let size = sizes.get(i).copied().unwrap_or(AxisErrors { shift: 0.0, turn: 0.0 });
                let [a, b, c, d, e, f] = gain.gains.get(i).copied().unwrap_or_default();
                let (shift, turn) = (DVec3::new(a, b, c) * size.shift, DVec3::new(d, e, f) * size.turn);
                let own = if joint.motion.is_rotation() { turn } else { shift };
                let square = shift.length_squared() + turn.length_squared();
                squares += square;
                sum += shift.abs().element_sum() + turn.abs().element_sum();
                let position = own.dot(joint.direction).abs();
                AxisEffect { letter: joint.letter, position, guide: square.sqrt() }
            })
            .collect();
        let independent = squares.sqrt();
        match &mut total {
            None => total = Some(SurfaceBudget { axes, independent, worst: sum, at: point }),
            Some(all) => {
                for (most, here) in all.axes.iter_mut().zip(&axes) {
                    most.position = most.position.max(here.position);
                    most.guide = most.guide.max(here.guide);
                }
                all.independent = all.independent.max(independent);
                if sum > all.worst {
                    (all.worst, all.at) = (sum, point);
                }
            }
        }
    }
    total
}
