//! Kinematics of machines against matrices written here, against differences, against the formulas of LinuxCNC's modules,
//! and against itself: positions go to a pose and come back.

#![allow(clippy::unwrap_used, reason = "a test panics when it fails")]

#[path = "kinematics/errors.rs"]
mod errors;
#[path = "kinematics/linuxcnc.rs"]
mod linuxcnc;
#[path = "kinematics/machines.rs"]
mod machines;
#[path = "kinematics/matrices.rs"]
mod matrices;
#[path = "kinematics/paths.rs"]
mod paths;
#[path = "kinematics/round_trip.rs"]
mod round_trip;
