//! A question about a machine as options put it.

use super::{MachineAnswer, MachineFile, MachineSheet, drawn, pose};
use crate::base::{Code, Finding, Result};
use crate::job::machine::{Loaded, machine_toml};
use crate::machine::layouts::{Attitude, Sizes};
use crate::machine::{CoordinateCode, Machine};
use crate::verbs::layouts::{attitudes, layout_machine, machine_drawing_at, with_usual_bodies};
use crate::verbs::poses::{AxisValues, PoseTexts, PoseWords};

/// A question about a machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineWants {
    /// Positions of its axes as words.
    pub at: Option<String>,
    /// Whether its bodies are wanted with their faces.
    pub bodies: bool,
    /// Whether a drawing is wanted.
    pub svg: bool,
    /// "vertical", "horizontal"; vertical where nothing is said.
    pub spindle: Option<String>,
    /// Of a layout: strokes of X, Y, Z [mm].
    pub stroke: Option<[f64; 3]>,
    /// Length of the tool from the gauge point [mm].
    pub length: f64,
}

impl MachineWants {
    /// The machine of a layout.
    ///
    /// # Errors
    /// Those of reading the code; `KC0103` for strokes that are not above zero.
    pub fn layout(&self, code: &str) -> Result<Machine> {
        let code = CoordinateCode::parse_any(code)?;
        let mut sizes = Sizes::default();
        if let Some(stroke) = self.stroke {
            if let Some(bad) = stroke.into_iter().find(|s| !(*s > 0.0 && *s <= crate::base::MAX_LENGTH)) {
                let finding = Finding::error(
                    Code::JOB_VALUE,
                    "a stroke must be above zero, and no longer than a machine",
                );
                return Err(finding.value_mm(bad).key("stroke").into());
            }
            sizes.stroke = stroke;
        }
        layout_machine(&code, self.attitude()?, &sizes)
    }

    fn attitude(&self) -> Result<Attitude> {
        let all = attitudes(self.spindle.as_deref().unwrap_or("vertical"))?;
        match all[..] {
            [one] => Ok(one),
            _ => Err(Finding::error(Code::JOB_SHAPE, "a machine has one attitude of its spindle")
                .help("write vertical or horizontal")
                .key("spindle")
                .into()),
        }
    }

    /// The positions of the axes.
    fn words(&self) -> Result<PoseWords> {
        let Some(words) = &self.at else { return Ok(PoseWords::default()) };
        PoseTexts::one("--at", words)
    }

    /// The machine drawn at the positions; empty where no drawing is wanted.
    ///
    /// # Errors
    /// Those of the positions.
    pub fn drawing(&self, machine: &Machine) -> Result<String> {
        if !self.svg {
            return Ok(String::new());
        }
        let values = AxisValues(self.words()?.words).joints(machine)?;
        Ok(machine_drawing_at(machine, self.attitude()?, &values))
    }

    /// The machine as a machine file; that of a layout has the usual bodies.
    ///
    /// # Errors
    /// Those of the positions of the drawing.
    pub fn file(&self, machine: &Machine, of_layout: bool) -> Result<MachineFile> {
        let toml = match of_layout {
            true => machine_toml(&with_usual_bodies(machine, self.attitude()?)),
            false => machine_toml(machine),
        };
        Ok(MachineFile { toml, svg: self.drawing(machine)? })
    }

    /// The answer about a machine.
    ///
    /// # Errors
    /// Those of the positions.
    pub fn answer(&self, loaded: Loaded) -> Result<MachineAnswer> {
        let (machine, attitude) = (&loaded.machine, self.attitude()?);
        let posed = match &self.at {
            Some(_) => Some(pose(machine, attitude, &self.words()?, self.length)?),
            None => None,
        };
        Ok(MachineAnswer {
            sheet: MachineSheet::of(machine),
            pose: posed,
            drawn: self.bodies.then(|| drawn(machine, attitude)),
            svg: self.drawing(machine)?,
            import: loaded.import,
        })
    }
}
