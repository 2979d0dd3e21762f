//! Zeros of the work offsets, as far as the program has set them.

use glam::DVec3;

use crate::program::WorkOffset;

/// The zero of a work offset; mm.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Zero {
    /// Machine coordinates of the zero that the setup has, where the program has told them.
    pub(super) first: [Option<f64>; 3],
    /// The zero that the program has set since, from that one.
    pub(super) shift: DVec3,
}

/// Zeros of work offsets; `None` is what is added to all of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Zeros {
    known: Vec<(Option<WorkOffset>, Zero)>,
}

impl Zeros {
    /// The zero of a work offset, if the program has set it.
    pub(super) fn of(&self, offset: Option<WorkOffset>) -> Option<&Zero> {
        self.known.iter().find(|(o, _)| *o == offset).map(|(_, zero)| zero)
    }

    /// The zero of a work offset.
    pub(super) fn of_mut(&mut self, offset: Option<WorkOffset>) -> &mut Zero {
        let index = match self.known.iter().position(|(o, _)| *o == offset) {
            Some(index) => index,
            None => {
                self.known.push((offset, Zero::default()));
                self.known.len() - 1
            }
        };
        &mut self.known[index].1
    }

    /// Shift of a work offset from the zero that the setup has [mm].
    pub(super) fn shift(&self, offset: WorkOffset) -> DVec3 {
        [Some(offset), None].into_iter().filter_map(|o| self.of(o)).map(|zero| zero.shift).sum()
    }

    /// Machine coordinates of the zero that the setup has [mm].
    pub(super) fn first(&self, offset: WorkOffset) -> [Option<f64>; 3] {
        let all = self.of(None).map_or([Some(0.0); 3], |zero| zero.first);
        let own = self.of(Some(offset)).map_or([None; 3], |zero| zero.first);
        [0, 1, 2].map(|i| Some(own[i]? + all[i].unwrap_or(0.0)))
    }
}

/// A place known in part, as a vector that is not a number where it is not known.
pub(super) fn vector(place: [Option<f64>; 3]) -> DVec3 {
    DVec3::from_array(place.map(|v| v.unwrap_or(f64::NAN)))
}
