//! Surfaces that a machine makes with a tool.

mod feasible;
mod golden;
mod made;
mod touch;
