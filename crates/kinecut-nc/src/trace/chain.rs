//! The rotary axes of a machine while a program is followed.
//!
//! Positions of the tip are given in the table frame, which goes with the work: the machine frame of the linear axes as
//! the work lies with all rotary axes at zero.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, Machine};
use crate::program::RotarySolution;

/// Addresses of the axes in the order of a program's axis positions.
pub(super) const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];

/// A machine with a tool of a length, ready for evaluation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    kinematics: Kinematics,
    /// Place of each axis letter in the code.
    places: [Option<usize>; 6],
    /// Limits of the rotary axes A, B, C [rad].
    travel: [Option<[f64; 2]>; 3],
    joints: usize,
}

impl Chain {
    /// The machine with a tool of this gauge length [mm].
    ///
    /// # Errors
    /// `KC0703` when one of its axes has another letter than X Y Z A B C, or its spindle is not along Z at home.
    pub(super) fn new(machine: &Machine, length: f64) -> Result<Chain> {
        let places = LETTERS.map(|letter| machine.joint(letter).map(|(place, _)| place));
        if let Some(other) = machine.joints.iter().find(|joint| !LETTERS.contains(&joint.letter)) {
            return Err(Finding::error(
                Code::MACHINE_AXIS,
                format!("axis {} cannot be followed: a program moves X Y Z A B C", other.letter),
            )
            .help("give the axis one of these letters")
            .into());
        }
        let chain = Chain {
            kinematics: machine.kinematics(length),
            places,
            travel: ['A', 'B', 'C'].map(|letter| machine.travel(letter)),
            joints: machine.joints.len(),
        };
        let home = chain.axis([0.0; 3]);
        if (home - DVec3::Z).length() > SQUARE {
            return Err(Finding::error(
                Code::MACHINE_AXIS,
                "programs are followed on machines whose spindle stands along Z while all axes are at zero",
            )
            .value(home.angle_between(DVec3::Z).to_degrees(), "degrees")
            .bound(0.0, "degrees")
            .help("let the rotary axes count from where the spindle stands along Z")
            .into());
        }
        Ok(chain)
    }

    /// The chain of joints with the tool.
    pub(super) fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// True if the machine has this rotary axis (A, B, C).
    pub(super) fn has(&self, rotary: usize) -> bool {
        self.places[3 + rotary].is_some()
    }

    /// The axis of a joint of the code, counted X Y Z A B C.
    pub(super) fn axis_at(&self, place: usize) -> Option<usize> {
        self.places.iter().position(|p| *p == Some(place))
    }

    /// All joints, in the order of the code.
    pub(super) fn joints(&self, linear: DVec3, rotary: [f64; 3]) -> JointValues {
        let mut q = JointValues::zero(self.joints);
        let positions = [linear.x, linear.y, linear.z, rotary[0], rotary[1], rotary[2]];
        for (place, position) in self.places.iter().zip(positions) {
            if let Some(place) = *place {
                q[place] = position;
            }
        }
        q
    }

    /// The tip frame in the table frame.
    pub(super) fn pose(&self, linear: DVec3, rotary: [f64; 3]) -> Rigid {
        self.kinematics.forward(&self.joints(linear, rotary))
    }

    /// The tool axis from tip to holder [table frame].
    pub(super) fn axis(&self, rotary: [f64; 3]) -> DVec3 {
        self.pose(DVec3::ZERO, rotary).rotation.z_axis
    }

    /// Maps axis positions of X, Y, Z into the tip [table frame]: matrix and translation.
    pub(super) fn of_linear(&self, rotary: [f64; 3]) -> (DMat3, DVec3) {
        let zero = self.pose(DVec3::ZERO, rotary).translation;
        let column = |unit: DVec3| self.pose(unit, rotary).translation - zero;
        (DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z)), zero)
    }

    /// Maps the tip [table frame] into axis positions of X, Y, Z; `None` where the linear axes are not independent.
    pub(super) fn to_linear(&self, rotary: [f64; 3]) -> Option<(DMat3, DVec3)> {
        let (matrix, zero) = self.of_linear(rotary);
        Chain::independent(matrix).map(|back| (back, -(back * zero)))
    }

    /// The inverse of a matrix of the directions of linear axes; `None` where they are not independent.
    pub(super) fn independent(directions: DMat3) -> Option<DMat3> {
        /// Volume of the box of three unit directions below which they count as flat.
        const FLAT: f64 = 1e-9;
        (directions.determinant().abs() > FLAT).then(|| directions.inverse())
    }

    /// Positions of the rotary axes in which the tool is along `axis` [table frame]: of all solutions inside the travel
    /// the one nearest to `near`, or the nearest on the asked branch.
    ///
    /// # Errors
    /// Those of [`Kinematics::inverse`]; `KC0507` when all solutions lie outside of the travel.
    pub(super) fn rotary_for(&self, axis: DVec3, near: [f64; 3], branch: RotarySolution) -> Result<[f64; 3]> {
        let given = self.joints(DVec3::ZERO, near);
        let solutions = self.kinematics.inverse(DVec3::ZERO, axis, &given)?;
        let mut best: Option<(f64, [f64; 3])> = None;
        let mut nearest_outside: Option<(f64, usize, f64)> = None;
        for solution in solutions.iter() {
            let mut angles = near;
            let mut cost = 0.0;
            let mut inside = true;
            for i in 0..3 {
                let Some(place) = self.places[3 + i] else { continue };
                let angle = solution.values[place];
                // The same direction, turned by whole turns to the position of the axis.
                let turns = ((near[i] - angle) / TAU).round();
                let candidates = [turns, turns - 1.0, turns + 1.0].map(|n| angle + TAU * n);
                let allowed = |q: f64| {
                    self.travel[i].is_none_or(|[min, max]| q >= min - AT_LIMIT && q <= max + AT_LIMIT)
                };
                match candidates.into_iter().find(|&q| allowed(q)) {
                    Some(q) => {
                        angles[i] = q;
                        cost += (q - near[i]).abs();
                    }
                    None => {
                        inside = false;
                        let beyond = self.travel[i].map_or(0.0, |[min, max]| (min - angle).max(angle - max));
                        if nearest_outside.is_none_or(|(least, ..)| beyond < least) {
                            nearest_outside = Some((beyond, i, angle));
                        }
                    }
                }
            }
            let on_branch = match branch {
                RotarySolution::Free => true,
                RotarySolution::Positive => self.master(&angles) >= 0.0,
                RotarySolution::Negative => self.master(&angles) <= 0.0,
            };
            if inside && on_branch && best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, angles));
            }
        }
        best.map(|(_, angles)| angles).ok_or_else(|| {
            let finding = match nearest_outside {
                Some((_, i, angle)) => {
                    let [min, max] = self.travel[i].unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                    let bound = if angle < min { min } else { max };
                    let finding = Finding::error(
                        Code::TRAVEL_EXCEEDED,
                        format!("{} leaves its travel to reach the direction of the tool", LETTERS[3 + i]),
                    );
                    finding.value(angle.to_degrees(), "degrees").bound(bound.to_degrees(), "degrees")
                }
                None => Finding::error(
                    Code::TRAVEL_EXCEEDED,
                    "the asked branch of the rotary axes has no solution for this direction",
                ),
            };
            finding.help("turn the part, or use another machine").into()
        })
    }

    /// Position of the rotary axis whose sign tells the two solutions apart: the one next to the tool in the chain.
    fn master(&self, angles: &[f64; 3]) -> f64 {
        let last = (0..3).filter(|&i| self.has(i)).max_by_key(|&i| self.places[3 + i]);
        last.map_or(0.0, |i| angles[i])
    }
}

/// Positions of the rotary axes A, B, C [rad] in which the tool is along `axis` [table frame], from their positions
/// `near`.
///
/// # Errors
/// Those of [`Kinematics::inverse`]; `KC0507` when all solutions lie outside of the travel; `KC0703` for axes with other
/// letters.
pub fn rotary_positions(
    machine: &Machine,
    axis: DVec3,
    near: [f64; 3],
    branch: RotarySolution,
) -> Result<[f64; 3]> {
    Chain::new(machine, 0.0)?.rotary_for(axis, near, branch)
}

/// Maps the tip [table frame] into the point whose coordinates, counted as with all rotary axes at zero, are the
/// positions of the linear axes: the coordinates for a control without tilted planes while its rotary axes are at
/// `rotary` [rad]. `length` is that of the tool [mm]; `None` where it is not known, which only machines that turn the
/// work can do without.
///
/// # Errors
/// `KC0703` when the linear axes do not stay square to one another, or the length is needed.
pub fn axis_frame(machine: &Machine, length: Option<f64>, rotary: [f64; 3]) -> Result<Rigid> {
    let with = |length: f64| -> Result<Rigid> {
        let chain = Chain::new(machine, length)?;
        let (back, zero) = chain.of_linear([0.0; 3]);
        let (to, shift) = chain.to_linear(rotary).ok_or_else(not_square)?;
        let rotation = back * to;
        let skew = rotation.transpose() * rotation - DMat3::IDENTITY;
        if skew.to_cols_array().iter().any(|e| e.abs() > SQUARE) {
            return Err(not_square().into());
        }
        Ok(Rigid { rotation, translation: back * shift + zero })
    };
    let frame = with(length.unwrap_or(0.0))?;
    let needed = (with(1.0)?.translation - with(0.0)?.translation).length() > SQUARE;
    if length.is_none() && needed {
        return Err(Finding::error(
            Code::MACHINE_AXIS,
            "the machine turns the tool, and where its tip goes depends on its length, which is not given",
        )
        .help("give the tool its `gauge_length`")
        .key("tool")
        .into());
    }
    Ok(frame)
}

/// Positions of the linear axes with the tip at a point [table frame, mm] and the rotary axes at `rotary` [rad], given
/// as the tip that a tool of this length has at these positions with all rotary axes at zero: the numbers of a program
/// that counts axis positions from its work offset.
///
/// # Errors
/// `KC0703` when the linear axes are not independent there.
pub fn axis_positions(machine: &Machine, length: f64, rotary: [f64; 3], tip: DVec3) -> Result<DVec3> {
    let chain = Chain::new(machine, length)?;
    let (back, zero) = chain.of_linear([0.0; 3]);
    let (to, shift) = chain.to_linear(rotary).ok_or_else(not_square)?;
    Ok(back * (to * tip + shift) + zero)
}

/// Largest deviation of a matrix from a rotation that rounding explains.
const SQUARE: f64 = 1e-9;

fn not_square() -> Finding {
    Finding::error(
        Code::MACHINE_AXIS,
        "the linear axes of the machine do not stay square while its rotary axes turn",
    )
    .help("let the control tilt the plane (post.orientation = \"angles\")")
}

/// Excess of a rotary axis over its limit that is rounding [rad].
const AT_LIMIT: f64 = 1e-9;
