//! two whole numbers -> how often the one holds the other

/// `n / d`, rounded down: the twin of a kernel that mends an estimate. `d` is below 2^31 and the answer below 2^22.
#[must_use]
pub fn whole(n: u32, d: u32) -> u32 {
    n / d
}
