//! A planned path: the rotary axes along it where the tool turns, and its moves.

use std::sync::Arc;

use super::PathOperation;
use super::moves::{write_turned, write_upright};
use super::turned::{TurnedPath, turned_path};
use crate::base::Result;
use crate::machine::Machine;
use crate::operations::kind::{self, Nothing};
use crate::operations::{Attempt, Pen, Setting};

/// A planned path.
#[derive(Clone, Debug)]
pub struct PlannedPath {
    /// The operation.
    pub of: Arc<PathOperation>,
    /// The path on the machine, where the tool leaves the Z of the work offset, and the machine.
    turned: Option<(TurnedPath, Machine)>,
}

/// Plans a path; what has to be said of the way comes with it.
pub(super) fn planned(of: &Arc<PathOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedPath>> {
    let machine = setting.machine.filter(|_| of.is_multi_axis());
    let turned = match machine {
        Some(machine) => Some((turned_path(of, setting, machine)?, machine.clone())),
        None => None,
    };
    let findings = turned.as_ref().map_or_else(Vec::new, |(path, _)| path.findings.clone());
    Ok(Attempt::SetupPlan(PlannedPath { of: Arc::clone(of), turned }, findings))
}

impl kind::Plan for PlannedPath {
    type Json = Nothing;

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        match &self.turned {
            Some((path, machine)) => write_turned(pen, &self.of, path, machine),
            None => {
                write_upright(pen, &self.of);
                Ok(())
            }
        }
    }

    fn leaves_axes_turned(&self) -> bool {
        self.turned.is_some()
    }

    fn wants_nothing(&self) -> bool {
        true
    }
}
