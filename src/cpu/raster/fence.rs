//! a float -> the same float: Rust fuses and rearranges nothing, so here there is nothing to fence
