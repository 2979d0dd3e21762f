//! Contacts of moving bodies, against distances by another library over dense time.
//!
//! The judge knows a tool as a ball and cylinders, bodies as a cuboid, a cylinder and a mesh, and goes through a move in steps that
//! are no longer than the distance at that moment: it passes over no contact.

mod access;
mod judge;
mod machines;
mod tools;
