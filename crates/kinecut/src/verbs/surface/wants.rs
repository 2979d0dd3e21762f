//! A question about a surface as options put it.

use super::on_machine::{OnMachineWants, on_machine};
use super::place::{SurfacePlace, SurfaceSketch, place_of};
use super::{SurfaceAnswer, set_parameter, surface_sheet};
use crate::base::{Progress, Result};
use crate::machine::Machine;
use crate::machine::generation::AxisErrors;
use crate::machine::surface::GeneratedSurface;

/// A question about a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceWants {
    /// Parameters with their values as text.
    pub set: Vec<(String, String)>,
    /// Variables with their values as text: a place. Without any there is none, but that of the sketches.
    pub at: Vec<(String, String)>,
    /// Whether the material is on the other side.
    pub reversed: bool,
    /// Whether the points of the sketches are wanted.
    pub sketch: bool,
}

impl SurfaceWants {
    /// The answer about a surface, and of a machine where one is asked.
    ///
    /// # Errors
    /// Those of [`set_parameter`], [`surface_sheet`], [`place_of`] and [`on_machine`].
    pub fn answer(
        &self,
        mut surface: GeneratedSurface,
        machine: Option<(&Machine, &OnMachineWants)>,
        progress: &dyn Progress,
    ) -> Result<SurfaceAnswer> {
        for (parameter, value) in &self.set {
            surface = set_parameter(surface, parameter, value)?;
        }
        if self.reversed {
            surface = surface.reversed();
        }
        let sheet = surface_sheet(&surface)?;
        let at = place_of(&surface, &self.at)?;
        let place = (self.sketch || !self.at.is_empty()).then(|| SurfacePlace::of(&sheet, at)).transpose()?;
        let sketch = self.sketch.then(|| SurfaceSketch::of(&sheet, at)).transpose()?;
        let ask = |(machine, wants): (&Machine, &OnMachineWants)| {
            on_machine(&sheet.surface, &sheet.found, machine, wants, progress)
        };
        let on_machine = machine.map(ask).transpose()?;
        Ok(SurfaceAnswer { sheet, place, sketch, on_machine })
    }
}

/// Errors of an axis in micrometres and seconds of arc.
pub fn axis_errors([shift, turn]: [f64; 2]) -> AxisErrors {
    AxisErrors { shift: shift / 1e3, turn: (turn / 3600.0).to_radians() }
}
