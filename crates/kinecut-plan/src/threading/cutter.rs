//! The thread mill as the planner needs it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::tool::{ThreadMill, Tool};

/// Profile of a thread mill's teeth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MillProfile {
    /// That of the thread: the radius of the path is corrected for what the flanks overcut.
    #[default]
    Standard,
    /// Corrected by the maker for this thread: the path is not corrected.
    Corrected,
}

/// A thread mill [mm, rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreadCutter {
    /// The teeth and the neck.
    pub mill: ThreadMill,
    /// Their profile.
    pub profile: MillProfile,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
    /// Diameter of the shank above neck or teeth.
    pub shank_diameter: f64,
    /// Height of the holder's face above the tip.
    pub stickout: f64,
}

impl ThreadCutter {
    /// Of a tool with the teeth of a thread mill.
    pub fn of(tool: &Tool, mill: ThreadMill, profile: MillProfile) -> ThreadCutter {
        ThreadCutter {
            mill,
            profile,
            flute_length: tool.flute_length,
            shank_diameter: tool.shank_diameter,
            stickout: tool.stickout,
        }
    }

    /// Parts above the teeth that go into the hole, or beside the boss: a name, the diameter, the height above the tip.
    pub(super) fn above(&self) -> Vec<(&'static str, f64, f64)> {
        match self.mill.neck {
            Some(neck) => {
                vec![("neck", neck.diameter, self.flute_length), ("shank", self.shank_diameter, neck.top)]
            }
            None => vec![("shank", self.shank_diameter, self.flute_length)],
        }
    }
}
