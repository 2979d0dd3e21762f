//! The best placement of one straight pass, with a certificate.
//!
//! Variables are the part's angle and the offset of the centre line; the objective is
//! [`bad_length`](crate::facing::bad_length). Branch and bound: outlines of straight edges over intervals of angles,
//! exact in the offset (`lines`, `sweep`, `straight`); with circular edges over boxes of both (`line_box`, `arc_box`,
//! `boxes`). Every bound is derived at the head of its file and tested against random placements.
//!
//! Source: Kryzhanivskyi and Kryzhanivska 2011 pose the problem and descend from chosen starts; bounds and search are
//! not theirs. Certificates are in double precision, sound to some 1e-9 of the perimeter.

mod allowed;
mod arc_box;
mod bound;
mod boxes;
mod domain;
mod interval;
mod irreducible;
mod least;
mod line_box;
mod lines;
mod map;
mod objective;
mod options;
mod place;
mod polish;
mod prove;
mod result;
mod search;
mod sensitivity;
mod straight;
mod sweep;
mod width;

pub use allowed::AllowedPlacements;
pub use bound::box_bound;
pub use least::least_burr;
pub use map::{ObjectiveMap, map_size, objective_map, objective_map_watched};
pub use options::Options;
pub use result::{Irreducible, LocalMinimum, Optimum, PlacementSensitivity};
