//! Drilling: where a drill point enters and leaves the surfaces on its way, its Z coordinates, feeds and times.
//!
//! A tool of revolution with the edge z(r) passes a boundary of the part of height S(x, y) while its reference point
//! runs from the greatest to the least S - z over the edge's annulus: a [`Transient`]. What a hole passes is a list of
//! [`Passage`]s; [`zones`] turns them into stretches of one feed. Source: Belyakov and Seleznev 2023, with the
//! corrections that `docs/drilling.md` lists.
//!
//! The tool axis is vertical, +Z towards the spindle, feed along -Z. Every Z is that of the tool's lowest cutting
//! point. mm, rad, s; feeds in mm per revolution.

mod advice;
mod ceiling;
mod cross_bore;
mod domain;
mod lengths;
mod lips;
mod mesh;
mod method;
mod mouth;
mod paper;
mod plan;
mod pre_hole;
mod region;
mod rim;
mod spec;
mod surface;
mod transient;
mod way;
mod zone;

pub use advice::{Advice, GIVEN, OUR_DEFAULT, advice};
pub use ceiling::Ceiling;
pub use cross_bore::CrossBore;
pub use lengths::{Coordinates, Lengths};
pub use lips::{LipBalance, lip_balance};
pub use mesh::{MeshHole, PartMesh};
pub use method::DrillMethod;
pub use mouth::Mouth;
pub use paper::{PRINTED_LENGTHS, PaperCase, PaperResult, Printed, paper};
pub use plan::{DrillPlan, plan_drill};
pub use pre_hole::{Bottom, PreHole};
pub use spec::{DrillSpec, End, FeedChoice, SpindleSpeed};
pub use surface::{BoundarySurface, PartFace, Side};
pub use transient::{Cover, Transient, transient};
pub use way::DrillWay;
pub use zone::{Feeds, Passage, Travel, Zone, ZoneStage, zones};
