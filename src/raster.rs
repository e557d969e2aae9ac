//! What a drawn frame is: the stages, and their order.
//!
//! ```text
//! each light:  project -> split -> cut -> count -> scan -> fill -> cover                  -> shadows
//! each sample: project -> split -> cut -> count -> scan -> fill -> cover -> mark
//!              -> sift -> shade, ground                                                    -> Film
//! ```
//!
//! Where small faces cover the film several times, split takes them in portions, and far -> veil say between these what
//! hides the next one: a face that lies behind it is left out before it is drawn pixel by pixel. None that shows is, so
//! that portions do not show either.
//!
//! Cut-out faces go the same way once more, each lens's after all others, with lace in the place of cover: it asks
//! their pictures whether they are there. Instead of sift, shade and ground, crowd -> heat show how much each tile has
//! to do (`--show tiles`). On a GPU, call says between stages how large the next dispatches are.
//!
//! The shadow pass is the first stages of the color pass, seen from the light. What is nearest is decided in integers
//! and by a maximum, since an image holds what depth and id lack of the largest number. So neither the order of the
//! work nor its division can show in the picture: small faces are drawn by one invocation each, and never enter a list;
//! all others become pieces, which are sorted into tiles that a workgroup owns.

mod frame;
mod portions;

pub use frame::{bands, draw, frame, look, marked, part};
pub use portions::Portions;

use std::ops::Range;

use crate::tables::Lens;

/// A film's sums (red, green, blue and the number of samples) and its ids, pixel by pixel.
pub type Drawn = (Vec<[f32; 4]>, Vec<u32>);

/// Depths and ids of an image, row by row from the top left.
pub type Seen = (Vec<u32>, Vec<u32>);

/// A method for each stage but call: `wgsl/raster/NAME.wgsl` and `cpu/raster/NAME.rs` do the same.
pub trait Raster {
    /// Depths and ids, where this backend keeps them.
    type Image;
    /// What can go wrong.
    type Error;

    /// Room for so many pixels, with ids if they are asked for.
    ///
    /// # Errors
    /// If there is none.
    fn image(&mut self, pixels: usize, ids: bool) -> Result<Self::Image, Self::Error>;

    /// anything -> an image on which nothing is drawn
    ///
    /// # Errors
    /// If it cannot be done.
    fn clear(&mut self, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// vertices -> corners in fixed point, or the planes that they lie beyond
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn project(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// How many faces there are.
    fn faces(&self) -> u32;

    /// All of them, as they are drawn one after the other: what is drawn of some may hide the next.
    fn portions(&self, lens: &Lens) -> Vec<Range<u32>>;

    /// image -> of each cell of 8 x 8 pixels the farthest
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn far(&mut self, lens: &Lens, image: &Self::Image) -> Result<(), Self::Error>;

    /// the farthest of each cell -> what hides a face that begins in it: the farthest of 1, of 2 x 2 and of 3 x 3 cells
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn veil(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// faces -> small ones drawn onto the image, and the numbers of all others
    ///
    /// `lace`: of cut-out faces, none of which is drawn at once; else of all others.
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn split(
        &mut self,
        lens: &Lens,
        image: &mut Self::Image,
        lace: bool,
        faces: Range<u32>,
    ) -> Result<(), Self::Error>;

    /// faces that are large or cross a plane -> pieces of them, bin by bin
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn cut(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// pieces -> how many of them each list has
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn count(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// how many pieces each list has -> where it begins, and the tiles that have any
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn scan(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// pieces -> the lists of each tile, in any order
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn fill(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// the lists of each tile -> the nearest of its pixels, and the least id of those
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn cover(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// Whether any face is cut out.
    fn laced(&self) -> bool;

    /// the lists of each tile -> the nearest of its pixels where a cut-out face is there, and the least id of those
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn lace(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// Waits for the stages; false if not all faces found room. They are to be done again, with more room or with what is
    /// left: what is drawn twice stays what it is.
    ///
    /// # Errors
    /// If the work was not done, or not to its end, or there is no room.
    fn settle(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<bool, Self::Error>;
}

/// What an eye needs beside: the methods of the stages that follow.
pub trait Look: Raster {
    /// Whether [`mark`](Self::mark) has anything to do: not where depths and ids are written as one.
    fn marks(&self) -> bool {
        true
    }

    /// small faces and the final depths -> the least id where the depth is theirs
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn mark(&mut self, lens: &Lens, image: &mut Self::Image) -> Result<(), Self::Error>;

    /// ids -> the runs of pixels that show a face, and those that show none
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn sift(&mut self, lens: &Lens, image: &Self::Image) -> Result<(), Self::Error>;

    /// runs that show a face -> each pixel's color, once
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn shade(&mut self, lens: &Lens, image: &Self::Image, shadows: &Self::Image) -> Result<(), Self::Error>;

    /// runs that show no face -> the background, once
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn ground(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// small faces -> how many of them each tile has, beside those of its lists
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn crowd(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// how many faces each tile has -> the color of its pixels, added to the film's sums
    ///
    /// # Errors
    /// If the stage cannot be done.
    fn heat(&mut self, lens: &Lens) -> Result<(), Self::Error>;

    /// The sums of what a lens sees, and the ids of its image, in host memory; the sums begin anew.
    ///
    /// # Errors
    /// If they cannot be read back, or are not whole.
    fn end(&mut self, lens: &Lens, image: &Self::Image) -> Result<Drawn, Self::Error>;
}
