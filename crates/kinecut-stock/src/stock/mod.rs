//! The stock: a tri-dexel body that tools cut, and its surface.
//!
//! Three grids of parallel lines run along X, Y and Z through the points of one lattice; each line holds the
//! sorted intervals in which it is inside the material. End points are fixed point, so that the result does
//! not depend on the order of work or the number of threads, and carry the normal of the surface and the
//! identity of the move that cut them.
//!
//! [`point_engagement`] measures in the stock how much of a drill's point is in material on its way.

pub mod certify;
pub mod cut;
mod dexel;
mod end_map;
mod engagement;
mod grown;
mod lattice;
pub mod near;
mod raw;
mod raw_mesh;
mod sieve;
mod skimmed;
pub mod surface;
mod tile;
mod tri_dexel;
mod trimmed;
mod volume;
mod wall_ends;

pub use dexel::{CutId, EndPoint, FIXED_STEP, Interval, PackedNormal, fixed, unfixed};
pub use end_map::EndMap;
pub use engagement::{Engaged, PointEngagement, PointStage, point_engagement};
pub use lattice::{Axis, DexelGrid, Lattice};
pub use tri_dexel::TriDexel;
pub use trimmed::{TrimmedEnvelope, trimmed_envelope};
pub use volume::Volume;
pub use wall_ends::{WallEnd, wall_ends};
