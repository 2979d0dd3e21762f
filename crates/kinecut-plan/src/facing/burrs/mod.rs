//! Burrs that face milling leaves: stretches of edges by the exit angle of their teeth, with the height that a table of measured
//! burrs gives there, and the pieces of the outline along which they are taken off.
//!
//! The exit angle of each place of an edge is that of [`path_burr`](super::passes::path_burr): first contact decides, since the
//! pass that first covers a place takes all material beside it, and a later pass at the same height meets none. Entries leave no
//! burr. Break points are exact: on a line `y = c + R sin(psi + nu)`, on an arc the roots of `A sin(phi) + B cos(phi) = C`.

mod choice;
mod part;
mod piece;
mod table;

pub use choice::BurrChoice;
pub use part::{BurrPart, BurrState, MilledEdges, burr_parts};
pub use piece::{BurrPiece, BurrPieces, PieceLengths, burr_pieces};
pub use table::BurrTable;
