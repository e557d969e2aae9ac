//! a film's width and height -> whether there is room for it

use super::{Error, Reach, Scene};
use crate::film::Film;

/// The fewest rows that a film has room for.
const LEAST_ROWS: u32 = 64;

/// Whether a film's pixels can be counted, and some rows of it fit into the memory that may be taken.
pub(super) fn fits(size: [u32; 2], reach: &Reach) -> Result<(), Error> {
    const MIB: u64 = 1 << 20;
    if u64::from(size[0]) * u64::from(size[1]) >= 1 << 30 {
        return Err(Error::Pixels(size));
    }
    // What does not fit at once is made in bands.
    let needed = Film::bytes(size[0], size[1].min(LEAST_ROWS));
    let most = reach.most();
    if needed > most {
        return Err(Error::Memory { size, needed: needed.div_ceil(MIB), most: most / MIB });
    }
    Ok(())
}

impl Scene {
    /// Another size of film, where it fits into memory.
    ///
    /// # Errors
    /// [`Error::Memory`] if it does not.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), Error> {
        self.resize_within(size, &Reach::default())
    }

    /// Another size of film, where it fits into what may be taken.
    ///
    /// # Errors
    /// [`Error::Memory`] if it does not, and [`Error::Pixels`].
    pub fn resize_within(&mut self, size: [u32; 2], reach: &Reach) -> Result<(), Error> {
        fits(size, reach)?;
        self.film.size = size;
        Ok(())
    }
}
