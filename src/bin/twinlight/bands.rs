//! a picture that is too large for one film -> bands of it, on their way to the file one after the other
//!
//! Memory is that of a few bands, whatever the picture's size. A band that was drawn is kept until the picture is whole,
//! as the ray tracer keeps its runs of pixels.

use std::ops::ControlFlow;

use twinlight::film::{Film, Format};
use twinlight::render::{Error, Renderer};

use crate::call::{Call, Ready};
use crate::claim::Claim;
use crate::eye::Eye;
use crate::job::Failure;
use crate::plan::Picture;
use crate::progress::Progress;
use crate::told::Sum;
use crate::writer::{Body, Made, Writer};

/// Bytes of a film that is made at once, unless less may be taken.
const AT_ONCE: u64 = 256 << 20;
/// Bytes of a band's film.
const BAND: u64 = 32 << 20;
/// What a band takes with all that it is made of, and with the one that is written at the time, in films.
const AROUND: u64 = 8;

impl Call<'_> {
    /// Rows of the bands that a picture is made in; nothing if it is made at once.
    pub(crate) fn band(&self, picture: &Picture, ready: &Ready) -> Option<u32> {
        let arguments = self.arguments;
        let file = picture.file.as_ref()?;
        let [width, height] = ready.work.size();
        let most = arguments.job.input.reach().most();
        let whole = picture.frames.len() > 1
            || arguments.time.is_some()
            || arguments.noise.is_some()
            || !arguments.passes.is_empty()
            || arguments.sample_range.is_some()
            || matches!(Format::of(file), Ok(Format::Exr) | Err(_))
            || Film::bytes(width, height) <= AT_ONCE.min(most / 2);
        let rows = BAND.min(most / AROUND) / Film::bytes(width, 1).max(1);
        (!whole).then_some(rows.clamp(1, u64::from(height)) as u32)
    }

    /// Whether a picture that is made at once fits into the memory that may be taken.
    pub(crate) fn fits(&self, picture: &Picture, ready: &Ready) -> Result<(), Failure> {
        let size = ready.work.size();
        let linear = picture.file.as_ref().is_some_and(|file| matches!(Format::of(file), Ok(Format::Exr)));
        // The film and its way back from the device; an .exr's channels and bytes; and each pass.
        let films = 2 + 2 * u64::from(linear) + self.arguments.passes.len() as u64;
        let (needed, most) = (films * Film::bytes(size[0], size[1]), self.arguments.job.input.reach().most());
        if needed > most {
            let [needed, most] = [needed.div_ceil(1 << 20), most >> 20];
            return Err(Error::Film { size, needed, most }.into());
        }
        Ok(())
    }

    /// Makes a picture band by band.
    #[expect(clippy::too_many_arguments, reason = "they are one picture's, and used here alone")]
    pub(crate) fn in_bands(
        &self,
        picture: &Picture,
        rows: u32,
        mut ready: Ready,
        stamp: &str,
        mut claim: Option<Claim>,
        renderer: &mut Renderer,
        progress: &mut Progress,
        writer: &Writer,
    ) -> Result<(), Failure> {
        let size = ready.work.size();
        let file = picture.file.clone().unwrap_or_default();
        let transfer = ready.scene.film.transfer;
        let stamp_of = |class: &str| format!("{} {class}", stamp.split(' ').next().unwrap_or_default());
        let mut eye = Eye::new(self.stop, progress, 0, 1);
        if let Some(claim) = &claim {
            eye.ledger = ready.ledger(claim, stamp);
        }
        let (mut broken, mut samples, mut last) = (0, 0.0, None);
        let made = renderer.make_bands(&mut ready.work, rows, &mut eye, &mut |band, class| {
            let stamp = stamp_of(class);
            broken = if band.top == 0 { 0 } else { broken } + band.film.broken();
            samples = band.film.mean_samples();
            let end = band.top + band.film.height() == size[1];
            let body =
                Body::Band { band: Box::new(band), transfer, file: file.clone(), stamp: stamp.clone(), size };
            if end {
                // It is told of when all is known.
                last = Some((body, stamp));
                return ControlFlow::Continue(());
            }
            let taken = writer.take(Made { body, told: None, claim: None });
            if taken { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        if made.is_err() {
            eye.flush();
        }
        let made = match made {
            // The writer will tell why it takes no more.
            Err(Error::Stopped) if self.stop.why().is_none() => return Ok(()),
            made => made.map_err(|error| self.stopped(error))?,
        };
        if let Some((body, stamp)) = last {
            let sum = Sum::of_bands(made, samples, broken);
            let told = Some(self.told(picture, &ready, &stamp, &sum, progress));
            writer.take(Made { body, told, claim: claim.take() });
        }
        Ok(())
    }
}
