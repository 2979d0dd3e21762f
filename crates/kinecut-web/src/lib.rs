//! The kinecut workbench: a page in the browser over the library, served on loopback for one folder.
//!
//! The JSON of the verbs is the protocol: this crate has no model of its own. It holds texts that are being edited over the files
//! on disk ([`OverlayLoader`](kinecut::base::OverlayLoader)), runs the work on two pools of threads, lets the newest request of a
//! kind cancel the older one, and keeps nothing but the newest results.
//!
//! Loopback is no access control. Every request is checked before it is routed: `Host` is the server's own, `Origin` and
//! `Sec-Fetch-Site` are those of its own page, a secret of 256 bits comes with all that concerns the folder. Nothing outside of the
//! opened folder is read or written.
//!
//! ```
//! use kinecut_web::{Server, ServerWants};
//! let folder = std::env::temp_dir();
//! let server = Server::bind(&folder, &ServerWants::default()).unwrap();
//! assert!(server.address().starts_with("http://127.0.0.1:"));
//! ```

mod answer;
mod app;
pub mod browser;
mod connections;
mod events;
mod files;
mod folder;
mod gate;
mod given;
mod guess;
mod inspect;
mod kind;
mod kinematics;
mod lanes;
mod limits;
mod look;
mod operations;
mod page;
mod plan;
mod pools;
mod refusal;
mod rest;
mod results;
mod router;
mod server;
mod simulate;
mod texts;
mod token;
mod verb;
mod watch;
mod work;
mod write;

pub use limits::Limits;
pub use server::{Held, Look, Server, ServerWants, Stop};
pub use token::Token;
