//! Surfaces as formulas, methods of making them, and surfaces found in meshes.

mod formula;
mod golden;
mod methods;
mod recognition;
