//! a float -> the same float, from which no compiler may conclude anything

// Rust neither fuses nor rearranges floats, so the twins have nothing to hold.
