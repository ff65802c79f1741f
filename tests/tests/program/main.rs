//! The program as its users call it: the command line, recordings, studies and cases.

mod aim;
mod animation;
mod cases;
mod cli;
mod common;
mod cost;
mod crossing;
mod determinism;
mod exported;
mod exposure;
mod haul;
mod hostile;
mod interrupts;
mod mill;
mod out_of_process;
mod replay;
mod rules;
mod search;
mod shared;
mod shared_runs;
mod studies;
mod threat;
