//! Following a program on its machine: paths, derivatives, times.

mod axis_path;
mod joint_way;
mod linear;
mod rotary;
