//! Reach of a machine: its travel, the range of tilt, singular directions, its share of the sphere of directions, given
//! directions.

use glam::DVec3;
use serde::Serialize;

use super::ik::held;
use crate::base::Result;
use crate::machine::Machine;
use crate::page::{Block, Fact, Section};
use crate::verbs::Answer;
use crate::verbs::poses::{AxisValues, number, triple};

/// Directions on the sphere that the share is counted over.
const DIRECTIONS: usize = 2000;

/// Travel of an axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisReach {
    /// Letter.
    pub axis: char,
    /// Whether it turns: degrees, otherwise mm.
    pub rotary: bool,
    /// Least and greatest position [mm or deg]; none if unknown.
    pub travel: Option<[f64; 2]>,
}

/// Reach of a direction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DirectionAnswer {
    /// The direction of the tool.
    pub direction: [f64; 3],
    /// Whether it is reached within travel.
    pub reached: bool,
    /// Angle by which it lies outside of the range of tilt, whatever the travel [deg].
    pub outside_deg: f64,
    /// The axis that lacks travel, in the solution that lacks least.
    pub lacking: Option<char>,
    /// Travel that is lacking [deg].
    pub lacking_deg: f64,
}

/// The directions that a machine reaches.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReachSheet {
    /// Name of the machine.
    pub name: String,
    /// Its code.
    pub code: String,
    /// Travel of the axes.
    pub axes: Vec<AxisReach>,
    /// Independent motions of tip and direction, 5 at most.
    pub mobility: usize,
    /// Least and greatest angle between the tool and the first rotary axis [deg], whatever the travel.
    pub tilt_deg: Option<[f64; 2]>,
    /// Directions at which the first rotary axis is not determined.
    pub singular: Vec<[f64; 3]>,
    /// Share of all directions that is reached within travel.
    pub cover_sphere: Option<f64>,
    /// Share of the directions on the side of the tool at home.
    pub cover_half: Option<f64>,
    /// The directions that were asked for.
    pub directions: Vec<DirectionAnswer>,
}

impl Answer for ReachSheet {
    fn sections(&self) -> Vec<Section> {
        let axis = |a: &AxisReach| {
            let unit = if a.rotary { "deg" } else { "mm" };
            let [min, max] = a.travel?.map(number);
            Some(format!("{min} .. {max} {unit}"))
        };
        let axis = |a: &AxisReach| Fact::new(a.axis, axis(a).unwrap_or_else(|| "no limits given".to_owned()));
        let mut facts: Vec<Fact> = self.axes.iter().map(axis).collect();
        facts.push(Fact::new("Independent motions", self.mobility.to_string()).note("of tip and direction"));
        if let Some([least, most]) = self.tilt_deg.map(|t| t.map(number)) {
            let angle =
                Fact::new("Angle between tool and first rotary axis", format!("{least} .. {most} deg"));
            facts.push(angle.note("whatever the travel"));
        }
        facts.extend(self.singular.iter().map(|s| Fact::new("Singular direction", triple(*s))));
        if let (Some(sphere), Some(half)) = (self.cover_sphere, self.cover_half) {
            let [sphere, half] = [sphere, half].map(|share| number((share * 1e4).round() / 100.0));
            let shares = format!("{sphere} % of all, {half} % of the tool's side");
            facts.push(Fact::new("Directions reached within travel", shares));
        }
        for d in &self.directions {
            let answer = match (d.reached, d.lacking) {
                (true, _) => "reached".to_owned(),
                (_, Some(axis)) if d.outside_deg == 0.0 => {
                    format!("not reached, axis {axis} lacks {} deg of travel", number(d.lacking_deg))
                }
                _ => format!("not reached, it lies {} deg outside", number(d.outside_deg)),
            };
            facts.push(Fact::new(format!("Direction {}", triple(d.direction)), answer));
        }
        vec![Section::new(format!("{} {}", self.code, self.name).trim_end()).with(Block::Facts(facts))]
    }

    fn is_no(&self) -> bool {
        self.directions.iter().any(|d| !d.reached)
    }
}

/// Reach of a machine, with some axes held, and of given directions.
///
/// # Errors
/// `KC1113` for more than two rotary axes that are not held; `KC1114` for a direction without length; `KC0703` for a held
/// axis that the machine does not have.
pub fn reach(machine: &Machine, locked: &AxisValues, directions: &[[f64; 3]]) -> Result<ReachSheet> {
    let (given, flags) = held(machine, locked)?;
    let chain = machine.kinematics(0.0);
    let travels = machine.travels();
    let rotaries =
        machine.joints.iter().zip(&flags).filter(|(j, held)| j.motion.is_rotation() && !**held).count();
    let cover = match rotaries {
        2 => Some(chain.orientation_cover(&travels, &given, &flags, DIRECTIONS)?),
        _ => None,
    };
    let singular = chain.singular_directions(&given, &flags)?.into_iter().map(|d| d.to_array()).collect();
    let mut answers = Vec::with_capacity(directions.len());
    for &direction in directions {
        let reach = chain.direction_reach(DVec3::from_array(direction), &travels, &given, &flags)?;
        answers.push(DirectionAnswer {
            direction,
            reached: reach.reached(),
            outside_deg: reach.outside.to_degrees(),
            lacking: reach.lacking.and_then(|(i, _)| machine.joints.get(i)).map(|j| j.letter),
            lacking_deg: reach.lacking.map_or(0.0, |(_, by)| by.to_degrees()),
        });
    }
    let axes = machine.joints.iter().map(|j| {
        let rotary = j.motion.is_rotation();
        let unit = |v: f64| if rotary { v.to_degrees() } else { v };
        AxisReach { axis: j.letter, rotary, travel: j.travel.map(|t| t.map(unit)) }
    });
    Ok(ReachSheet {
        name: machine.name.clone(),
        code: machine.code.to_string(),
        axes: axes.collect(),
        mobility: chain.mobility(),
        tilt_deg: chain.tilt_range(&flags).map(|t| t.map(f64::to_degrees)),
        singular,
        cover_sphere: cover.map(|c| c.sphere),
        cover_half: cover.map(|c| c.half_sphere),
        directions: answers,
    })
}
