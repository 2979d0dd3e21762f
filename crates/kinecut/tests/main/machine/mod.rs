//! Machines: files, kinematics, layouts, bodies, what surfaces they make.

mod bodies;
mod file;
mod generation;
mod golden_kinematics;
mod golden_layouts;
mod kinematics;
mod linuxcnc_import;
mod spare_axis;
mod surface;
