//! Milled holes: golden curves, figures of the paper, every strategy on every control.

mod figures;
mod golden;
mod passes;
mod strategies;
