//! A move of a machine's axes from position to position, inside of their travel.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use super::JointsTable;
use super::given_move::{GivenMove, JOINTS, MoveSource, TIP_AND_JOINTS, path_words};
use crate::base::bounded::{MAX_LENGTH, measured};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::Curve;
use crate::job::machine::{LoadOptions, load};
use crate::machine::{JointValues, Kinematics, Machine};
use crate::sweep::ToolMotion;
use crate::verbs::poses::AxisValues;

/// Moments at which linear axes are compared with their travel while the tip keeps to a curve.
const STATIONS: u32 = 128;
/// Rounding at the end of a travel [mm].
const EDGE: f64 = 1e-9;

pub(crate) fn of_joints(table: &JointsTable, loader: &dyn Loader) -> Result<GivenMove> {
    let options = LoadOptions::default();
    let machine =
        load(&table.machine, &table.machine, &options, loader).map_err(|e| e.under("machine"))?.machine;
    let long = measured("length", table.length.unwrap_or(0.0), MAX_LENGTH, "mm")?;
    let from = positions("from", &table.from, &machine, &JointValues::zero(machine.joints.len()))?;
    let to = positions("to", &table.to, &machine, &from)?;
    let words = |q| AxisValues::of(&machine, q).words();
    let name = if machine.name.is_empty() { table.machine.clone() } else { machine.name.clone() };
    let source = MoveSource::Joints { from: words(&from), machine: name, to: words(&to) };
    let Some(tip) = &table.tip else {
        let motion = ToolMotion::on_machine(&machine, long, &from, &to)?;
        let way = "the axes of the machine move";
        return Ok(GivenMove { motion, way, mode: JOINTS, source, tool: None });
    };
    let tip = tip.curve().map_err(|e| e.under("tip"))?;
    let way = path_words(&tip);
    if let Some(joint) =
        machine.joints.iter().enumerate().find(|(i, j)| !j.motion.is_rotation() && from[*i] != to[*i])
    {
        let what = format!("axis {} is given, but the tip tells where it goes", joint.1.letter);
        return Err(Finding::error(Code::JOB_SHAPE, what)
            .key("to")
            .help("with tip give positions of rotary axes only")
            .into());
    }
    let chain = machine.kinematics(long);
    within_travel(&machine, &chain, &tip, &from, &to)?;
    let motion = ToolMotion::tip_and_joints(tip, chain, &from, &to)?;
    Ok(GivenMove { motion, way, mode: TIP_AND_JOINTS, source, tool: None })
}

/// Positions by letter over those that are known.
fn positions(
    key: &str,
    given: &BTreeMap<String, f64>,
    machine: &Machine,
    known: &JointValues,
) -> Result<JointValues> {
    let mut named = Vec::new();
    for (name, &value) in given {
        let mut letters = name.chars();
        let (Some(letter), None) = (letters.next(), letters.next()) else {
            return Err(Finding::error(Code::MACHINE_AXIS, format!("`{name}` is no letter of an axis"))
                .key(format!("{key}.{name}"))
                .help("give positions as { X = 10, A = -30 }")
                .into());
        };
        named.push((letter, value));
    }
    let values = AxisValues(named.clone()).joints(machine).map_err(|e| e.under(key))?;
    let mut all = *known;
    for (letter, _) in named {
        if let Some((i, _)) = machine.joint(letter) {
            all[i] = values[i];
        }
    }
    Ok(all)
}

/// Refuses a move under control of the tip in which an axis leaves its travel.
fn within_travel(machine: &Machine, chain: &Kinematics, tip: &Curve, from: &[f64], to: &[f64]) -> Result<()> {
    let linear: Vec<usize> =
        (0..machine.joints.len()).filter(|&i| !machine.joints[i].motion.is_rotation()).collect();
    for k in 0..=STATIONS {
        let t = f64::from(k) / f64::from(STATIONS);
        let mut q: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + (b - a) * t).collect();
        if let [x, y, z] = linear[..] {
            // The tip is an affine function of three linear axes.
            let mut at = |v: DVec3| {
                (q[x], q[y], q[z]) = (v.x, v.y, v.z);
                chain.forward(&q).translation
            };
            let zero = at(DVec3::ZERO);
            let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|e| at(e) - zero);
            let wanted = tip.at(t * tip.length()).p - zero;
            let solved = DMat3::from_cols(columns[0], columns[1], columns[2]).inverse() * wanted;
            (q[x], q[y], q[z]) = (solved.x, solved.y, solved.z);
        }
        for (i, joint) in machine.joints.iter().enumerate() {
            let known = joint.motion.is_rotation() || linear.len() == 3;
            let Some([least, most]) = joint.travel.filter(|_| known) else { continue };
            if q[i] >= least - EDGE && q[i] <= most + EDGE {
                continue;
            }
            let bound = if q[i] > most { most } else { least };
            let what = format!("axis {} would leave its travel", joint.letter);
            let finding = Finding::error(Code::MOVE_NOT_POSSIBLE, what);
            let finding = if joint.motion.is_rotation() {
                finding.value(q[i].to_degrees(), "degrees").bound(bound.to_degrees(), "degrees")
            } else {
                finding.value_mm(q[i]).bound_mm(bound)
            };
            return Err(finding.help("keep the move inside the travel of the machine").into());
        }
    }
    Ok(())
}
