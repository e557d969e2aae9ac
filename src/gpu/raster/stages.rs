//! The rasterizer's stages, recorded one after the other.

use super::{COVER, CUT, CUT_TORN, GpuImage, GpuRaster, SORT};
use std::ops::Range;

use crate::gpu::kernel::fold;
use crate::gpu::{Binding, Error};
use crate::raster::Raster;
use crate::tables::{Lens, MOST_ENTRIES, Part};

/// Times that a lens asks `call`: after split, cut and scan.
const CALLS: u32 = 3;

impl Raster for GpuRaster<'_> {
    type Image = GpuImage;
    type Error = Error;

    fn image(&mut self, pixels: usize, ids: bool) -> Result<GpuImage, Error> {
        let words = self.gpu.zeroed("image", if ids { 2 * pixels } else { pixels })?;
        Ok(GpuImage { words, eye: ids })
    }

    fn clear(&mut self, image: &mut GpuImage) -> Result<(), Error> {
        self.record(|_, encoder| {
            image.words.clear(encoder);
            Ok(())
        })
    }

    fn project(&mut self, lens: &Lens) -> Result<(), Error> {
        self.veiled = false;
        self.gpu.write(&self.lens, &[*lens]);
        self.record(|this, encoder| {
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &bound.about),
                    Binding::texels("vertices", &bound.vertices),
                    Binding::texels("corners", &bound.corners),
                ];
                this.kernels.project.dispatch(this.gpu, encoder, &bindings, bound.part.vertices)?;
            }
            Ok(())
        })
    }

    fn faces(&self) -> u32 {
        self.portions.faces()
    }

    fn portions(&self, lens: &Lens) -> Vec<Range<u32>> {
        self.portions.of(lens)
    }

    fn far(&mut self, lens: &Lens, image: &GpuImage) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("image", &image.words),
                Binding::new("cells", &this.cells),
            ];
            this.kernels.far[usize::from(image.eye)].dispatch(this.gpu, encoder, &bindings, lens.cells()[0])?;
            Ok(())
        })
    }

    fn veil(&mut self, lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("cells", &this.cells),
                Binding::texels("veil", &this.veil),
            ];
            this.kernels.veil.dispatch(this.gpu, encoder, &bindings, lens.cells()[0])?;
            Ok(())
        })?;
        self.veiled = true;
        Ok(())
    }

    fn split(&mut self, _lens: &Lens, image: &mut GpuImage, lace: bool, faces: Range<u32>) -> Result<(), Error> {
        self.in_lace = lace;
        let last = faces.end == self.faces();
        self.record(|this, encoder| {
            if faces.start == 0 {
                this.tally.clear(encoder);
            }
            let words = Binding::new("image", &image.words);
            let wide = image.eye && this.kernels.variant.wide;
            for bound in &this.parts {
                let Part { first, faces: count, .. } = bound.part;
                let [begin, end] = [faces.start, faces.end].map(|at| at.clamp(first, first + count) - first);
                if begin == end && count > 0 {
                    continue;
                }
                let some = this.gpu.uniform("part", &Part { begin, faces: end, ..bound.part })?;
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &some),
                    Binding::texels("corners", &bound.corners),
                    Binding::texels("faces", &bound.faces),
                    Binding::texels("veil", &this.veil).optional(),
                    if wide { words.of_bytes(8) } else { words },
                    Binding::new("late", &this.late),
                    Binding::new("tally", &this.tally),
                ];
                let split = this.split_of(lace, image.eye);
                split.dispatch(this.gpu, encoder, &bindings, end - begin)?;
            }
            if last { this.call(encoder) } else { Ok(()) }
        })
    }

    fn cut(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &bound.about),
                    Binding::texels("vertices", &bound.vertices),
                    Binding::texels("faces", &bound.faces),
                    Binding::new("late", &this.late),
                    Binding::new("pieces", &this.pieces),
                    Binding::new("tally", &this.tally),
                ];
                for (cut, row) in this.kernels.cut.iter().zip([CUT, CUT_TORN]) {
                    cut.dispatch_called(this.gpu, encoder, &bindings, &this.calls, row)?;
                }
            }
            this.call(encoder)
        })
    }

    fn count(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            this.counts.clear(encoder);
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("pieces", &this.pieces),
                Binding::new("counts", &this.counts),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.count.dispatch_called(this.gpu, encoder, &bindings, &this.calls, SORT)
        })
    }

    fn scan(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("counts", &this.counts),
                Binding::new("starts", &this.starts),
                Binding::new("busy", &this.busy),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.scan.dispatch(this.gpu, encoder, &bindings, 1)?;
            this.call(encoder)
        })
    }

    fn fill(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("pieces", &this.pieces),
                Binding::new("starts", &this.starts),
                Binding::new("counts", &this.counts),
                Binding::new("entries", &this.entries),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.fill.dispatch_called(this.gpu, encoder, &bindings, &this.calls, SORT)
        })
    }

    fn cover(&mut self, lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        // Rows that all begin with the first of four pixels are read and written four at once.
        let fours = (lens.width | lens.first).is_multiple_of(4);
        self.record(|this, encoder| {
            let words = Binding::new("image", &image.words);
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("pieces", &this.pieces),
                Binding::new("starts", &this.starts),
                Binding::new("entries", &this.entries),
                Binding::new("busy", &this.busy),
                if fours { words.of_bytes(16) } else { words },
                Binding::new("tally", &this.tally),
            ];
            let cover = &this.kernels.cover[usize::from(fours)][usize::from(image.eye)];
            cover.dispatch_called(this.gpu, encoder, &bindings, &this.calls, COVER)
        })
    }

    fn laced(&self) -> bool {
        self.laces.is_some()
    }

    fn lace(&mut self, _lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        self.record(|this, encoder| {
            let Some(laces) = &this.laces else { return Ok(()) };
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &bound.about),
                    Binding::texels("vertices", &bound.vertices),
                    Binding::texels("faces", &bound.faces),
                    Binding::texels("paints", &this.paints),
                    Binding::texels("texels", &this.texels),
                    Binding::new("pieces", &this.pieces),
                    Binding::new("starts", &this.starts),
                    Binding::new("entries", &this.entries),
                    Binding::new("busy", &this.busy),
                    Binding::new("image", &image.words),
                    Binding::new("tally", &this.tally),
                ];
                let lace = &laces.lace[usize::from(image.eye)];
                lace.dispatch_called(this.gpu, encoder, &bindings, &this.calls, COVER)?;
            }
            Ok(())
        })
    }

    fn settle(&mut self, lens: &Lens, image: &mut GpuImage) -> Result<bool, Error> {
        let mut told = self.told()?;
        let wanted = told;
        let times = if self.in_lace { self.parts.len() as u32 } else { 1 };
        let groups: u32 = times * fold(told.busy).iter().product::<u32>();
        for round in 1.. {
            let ran = CALLS + round * groups;
            if told.groups != ran {
                return Err(Error::Incomplete(format!("{} of {ran} workgroups ran", told.groups)));
            }
            if !self.grow(&wanted)? {
                return Ok(false);
            }
            if round * MOST_ENTRIES >= wanted.longest {
                break;
            }
            self.gpu.write(&self.lens, &[Lens { round, ..*lens }]);
            if self.in_lace {
                self.lace(lens, image)?;
            } else {
                self.cover(lens, image)?;
            }
            told = self.told()?;
        }
        self.gpu.write(&self.lens, &[*lens]);
        Ok(true)
    }
}
