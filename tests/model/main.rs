//! The model reader, from outside: good files, hostile ones, and tobj as the oracle.

#![allow(
    clippy::print_stdout,
    clippy::too_many_lines,
    clippy::float_cmp,
    clippy::range_plus_one,
    clippy::match_wild_err_arm,
    clippy::format_push_string,
    clippy::format_collect,
    clippy::single_char_pattern,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::expect_used,
    clippy::panic,
    reason = "tests"
)]

mod confined;
mod fuzz;
mod good;
mod hostile;
mod materials;
mod oracle;
#[path = "../fuzz/parsers.rs"]
#[allow(dead_code, unreachable_pub, reason = "other tests and targets ask for the rest")]
mod parsers;
mod pictures;
mod polygons;
mod scratch;
