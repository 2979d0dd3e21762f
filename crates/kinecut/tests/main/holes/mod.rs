//! Milled holes: golden curves, every strategy on every control.

mod golden;
mod strategies;
