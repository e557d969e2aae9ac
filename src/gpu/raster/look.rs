//! The stages of an eye, recorded one after the other.

use super::{GROUND, GpuImage, GpuRaster, SHADE};
use crate::gpu::{Binding, Error};
use crate::raster::{Drawn, Look};
use crate::tables::{GROUP, Lens};

impl Look for GpuRaster<'_> {
    fn marks(&self) -> bool {
        !self.kernels.variant.wide
    }

    fn mark(&mut self, _lens: &Lens, image: &mut GpuImage) -> Result<(), Error> {
        if !self.marks() {
            return Ok(());
        }
        self.record(|this, encoder| {
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &bound.about),
                    Binding::texels("corners", &bound.corners),
                    Binding::texels("faces", &bound.faces),
                    Binding::texels("veil", &this.veil).optional(),
                    Binding::new("image", &image.words),
                ];
                this.kernels.mark[usize::from(this.veiled)].dispatch(
                    this.gpu,
                    encoder,
                    &bindings,
                    bound.part.faces,
                )?;
            }
            Ok(())
        })
    }

    fn sift(&mut self, lens: &Lens, image: &GpuImage) -> Result<(), Error> {
        self.record(|this, encoder| {
            this.tally.clear(encoder);
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("image", &image.words),
                Binding::new("runs", &this.runs),
                Binding::new("tally", &this.tally),
            ];
            this.kernels.sift.dispatch(this.gpu, encoder, &bindings, lens.pixels().div_ceil(GROUP))?;
            this.call(encoder)
        })
    }

    fn shade(&mut self, _lens: &Lens, image: &GpuImage, shadows: &GpuImage) -> Result<(), Error> {
        self.record(|this, encoder| {
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("canvas", &this.canvas),
                    Binding::texels("lenses", &this.lenses),
                    Binding::new("part", &bound.about),
                    Binding::texels("vertices", &bound.vertices),
                    Binding::texels("faces", &bound.faces),
                    Binding::texels("paints", &this.paints),
                    Binding::texels("lamps", &this.lamps),
                    Binding::texels("texels", &this.texels).optional(),
                    Binding::new("shadows", &shadows.words),
                    Binding::new("image", &image.words),
                    Binding::new("runs", &this.runs),
                    Binding::new("tally", &this.tally),
                    Binding::new("sums", &this.sums),
                ];
                this.shader.dispatch_called(this.gpu, encoder, &bindings, &this.calls, SHADE)?;
            }
            Ok(())
        })
    }

    fn ground(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("canvas", &this.canvas),
                Binding::new("runs", &this.runs),
                Binding::new("tally", &this.tally),
                Binding::new("sums", &this.sums),
            ];
            this.ground.dispatch_called(this.gpu, encoder, &bindings, &this.calls, GROUND)
        })?;
        let encoder = self.recorded();
        self.gpu.finish(encoder)
    }

    fn crowd(&mut self, _lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            for bound in &this.parts {
                let bindings = [
                    Binding::new("lens", &this.lens),
                    Binding::new("part", &bound.about),
                    Binding::texels("corners", &bound.corners),
                    Binding::texels("faces", &bound.faces),
                    Binding::new("counts", &this.counts),
                ];
                this.kernels.crowd.dispatch(this.gpu, encoder, &bindings, bound.part.faces)?;
            }
            Ok(())
        })
    }

    fn heat(&mut self, lens: &Lens) -> Result<(), Error> {
        self.record(|this, encoder| {
            let bindings = [
                Binding::new("lens", &this.lens),
                Binding::new("counts", &this.counts),
                Binding::new("sums", &this.sums),
            ];
            this.kernels.heat.dispatch(this.gpu, encoder, &bindings, lens.pixels())?;
            Ok(())
        })?;
        let encoder = self.recorded();
        self.gpu.finish(encoder)
    }

    fn end(&mut self, lens: &Lens, image: &GpuImage) -> Result<Drawn, Error> {
        let pixels = lens.pixels() as usize;
        let mut sums = self.gpu.read(&self.sums)?;
        sums.truncate(pixels);
        let wanted = self.samples as f32;
        if let Some(short) = sums.iter().find(|sum| sum[3] != wanted) {
            return Err(Error::Incomplete(format!("a pixel has {} of {wanted} samples", short[3])));
        }
        self.begin();
        let mut ids = self.seen(image)?.1;
        ids.truncate(pixels);
        Ok((sums, ids))
    }
}
