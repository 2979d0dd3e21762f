//! Contacts of a moving tool, its shank and its holder with bodies that stand: clamps, a vise, whatever holds the part.
//!
//! A tool is a union of convex parts about its axis, a body one of convex pieces. Contacts are sought over the motion, not at
//! samples of it: nothing thinner is missed, whatever its size. A part that comes no nearer than a hundredth of a millimetre is never
//! reported.
//!
//! ```
//! # use kinecut_stock as kinecut;
//! use glam::DVec3;
//! use kinecut::base::Silent;
//! use kinecut::contact::{Body, Meeting, MovingTool, ToolPart, Watched, meetings};
//! use kinecut::geom::{Aabb, Line, Profile, Rigid, Solid};
//! use kinecut::sweep::ToolMotion;
//! // A cutter of 10 mm runs along X, 2 mm above the tip's height of a clamp that begins at X 40.
//! let clamp = Aabb { min: DVec3::new(40.0, -20.0, -10.0), max: DVec3::new(60.0, 20.0, 2.0) };
//! let clamp = Body::new("clamp", &Solid::Box(clamp), Rigid::IDENTITY, 0.0).unwrap();
//! let cutter = Profile::cylinder(10.0, 30.0).unwrap();
//! let tool = MovingTool::new([(ToolPart::Cutter, &cutter, 0.0)]);
//! let line = Line { start: DVec3::ZERO, end: DVec3::new(100.0, 0.0, 0.0) };
//! let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
//! let watched = [Watched { motion, tool: 0 }];
//! let found = meetings(&[tool], &[clamp], &watched, DVec3::Z, &Silent).unwrap();
//! // From X 35 to X 65: at 0.35 and 0.65 of the move. 2 mm higher it clears.
//! let [Meeting { part: ToolPart::Cutter, contact: Some(contact), .. }] = &found[..] else { panic!() };
//! assert!((contact.from - 0.35).abs() < 2e-4 && (contact.to - 0.65).abs() < 2e-4);
//! assert!((contact.clears_by.unwrap() - 2.0).abs() < 0.02);
//! ```

mod access;
mod body;
mod clearance;
mod gap;
mod links;
mod meeting;
mod motion;
mod nearest_of;
mod pair;
mod piece;
mod round;
mod search;
mod tool;
mod tree;

pub use access::Access;
pub use body::Body;
pub use links::{LinkBody, MachineMeeting, MachineMove, MachineParts, Met, Party, ToolInSpindle};
pub use meeting::{Contact, Meeting, Watched, meetings};
pub use tool::{MovingTool, ToolPart};
