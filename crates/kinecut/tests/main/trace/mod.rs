//! Following a program on its machine: paths, derivatives, times.

mod axis_path;
mod linear;
mod rotary;
