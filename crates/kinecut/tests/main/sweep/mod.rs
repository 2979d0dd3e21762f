//! What a moving tool sweeps: motions, grazing curves, envelopes, exact sweeps.

mod chain;
mod entering;
mod envelope;
mod exact;
mod golden;
mod grazing;
mod motion;
mod trimmed;
