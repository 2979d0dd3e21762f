//! Kinematics of machines against matrices written here, against differences, against the formulas of LinuxCNC's modules,
//! and against itself: positions go to a pose and come back.

mod errors;
mod linuxcnc;
mod machines;
mod matrices;
mod paths;
mod round_trip;
