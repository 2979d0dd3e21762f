//! The machines of the golden file.

use glam::{DMat3, DVec3};
use kinecut::geom::Rigid;
use kinecut::machine::kinematics::Travels;
use kinecut::machine::{CoordinateCode, Joint, Kinematics};
use serde_json::Value;

use crate::common::golden::vector;

pub(crate) fn tip(row: &Value) -> DVec3 {
    vector(&row["tip"])
}

pub(crate) fn axis(row: &Value) -> DVec3 {
    vector(&row["axis"])
}

/// A machine of the file.
pub(crate) struct Golden {
    pub(crate) name: String,
    pub(crate) joints: Vec<Joint>,
    /// Tip frame at home.
    pub(crate) tool: Rigid,
}

impl Golden {
    pub(crate) fn read(value: &Value) -> Golden {
        let code = CoordinateCode::parse(value["code"].as_str().unwrap()).unwrap();
        let listed = value["joints"].as_array().unwrap();
        assert_eq!(code.word().0.len(), listed.len());
        let joints = code.word().0.iter().zip(listed).map(|(&motion, joint)| {
            assert_eq!(motion.is_rotation(), joint["kind"] == "R");
            let unit = if motion.is_rotation() { std::f64::consts::PI / 180.0 } else { 1.0 };
            Joint {
                // The file has 12 digits of the direction.
                direction: vector(&joint["dir"]).normalize_or_zero(),
                point: if motion.is_rotation() { vector(&joint["pt"]) } else { DVec3::ZERO },
                sense: joint["sign"].as_f64().unwrap(),
                travel: Some(["lo", "hi"].map(|end| joint[end].as_f64().unwrap() * unit)),
                ..Joint::standard(motion)
            }
        });
        assert_eq!(value["W0"], "identity");
        let z = vector(&value["axis0"]);
        let x = if z.x.abs() < 0.5 { DVec3::X } else { DVec3::Y };
        let y = z.cross(x).normalize_or_zero();
        let rotation = DMat3::from_cols(y.cross(z), y, z);
        Golden {
            name: value["name"].as_str().unwrap().to_owned(),
            joints: joints.collect(),
            tool: Rigid { rotation, translation: vector(&value["tip0"]) },
        }
    }

    pub(crate) fn named(file: &Value, name: &str) -> Golden {
        let machines = file["machines"].as_array().unwrap();
        Golden::read(machines.iter().find(|m| m["name"] == name).unwrap())
    }

    pub(crate) fn chain(&self) -> Kinematics {
        Kinematics::new(&self.joints, Rigid::IDENTITY, self.tool)
    }

    pub(crate) fn travels(&self) -> Travels {
        let mut travels = Travels::default();
        for (slot, joint) in travels.0.iter_mut().zip(&self.joints) {
            *slot = joint.travel;
        }
        travels
    }

    /// Positions in radians from those in degrees.
    pub(crate) fn inside(&self, degrees: &[f64]) -> Vec<f64> {
        let joints = self.joints.iter().zip(degrees);
        joints.map(|(joint, &q)| if joint.motion.is_rotation() { q.to_radians() } else { q }).collect()
    }
}
