//! Following a program on its machine: paths, derivatives, times.

mod linear;
mod rotary;
mod times;
