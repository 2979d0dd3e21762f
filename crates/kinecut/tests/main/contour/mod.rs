//! Half sections of tools: made by dimensions, drawn, read, refused.

mod checks;
mod drawings;
mod files;
mod golden;
mod tools;
