//! Fedotenok's four methods of making a line: copying, tracing, touching, rolling; and contact equations of the last two.
//!
//! In a chain a variable of the tool is a line that is copied, a variable of the machine a line that is traced. Touching
//! and rolling make an envelope: a point q of the tool, moving with V against the work, is a point of the surface where
//! the normal n of the tool has `n(q) . V(q) = 0`.

mod contact;
mod envelope;
mod line;
mod notation;
mod table;

pub use contact::ContactEquations;
pub use envelope::{EnvelopeMethod, Makes, envelopes, envelopes_of};
pub use line::{LineMethod, SplitMethods};
pub use notation::{Group, notation};
pub use table::{KnownProcess, MethodsRow, methods_table};

/// A method of making a line (Fedotenok).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GeneratingMethod {
    /// The edge of the tool is the line; no motion.
    Copying,
    /// A point runs along the line; one motion, simple or linked.
    Tracing,
    /// The line is the envelope of the circles of a turning tool; two motions, the turning of the tool and that of its
    /// axis along the equidistant.
    Touching,
    /// The line is the envelope of the places of an edge that rolls off; one linked motion.
    Rolling,
}

impl GeneratingMethod {
    /// The four methods.
    pub const ALL: [GeneratingMethod; 4] = [
        GeneratingMethod::Copying,
        GeneratingMethod::Tracing,
        GeneratingMethod::Touching,
        GeneratingMethod::Rolling,
    ];

    /// The name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            GeneratingMethod::Copying => "copying",
            GeneratingMethod::Tracing => "tracing",
            GeneratingMethod::Touching => "touching",
            GeneratingMethod::Rolling => "rolling",
        }
    }

    /// Number of motions that make the line.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::GeneratingMethod;
    /// assert_eq!(GeneratingMethod::ALL.map(GeneratingMethod::motions), [0, 1, 2, 1]);
    /// ```
    pub fn motions(self) -> usize {
        match self {
            GeneratingMethod::Copying => 0,
            GeneratingMethod::Tracing | GeneratingMethod::Rolling => 1,
            GeneratingMethod::Touching => 2,
        }
    }
}
