//! Pictures by the reference, path by path: each round shows what is known so far, with its noise. A newer job ends it.

use halfvector_ibl::LoadedEnvironment;
use halfvector_reference::{Reference, RenderOptions};
use halfvector_scene::Picture;

use super::{Drawn, Fault, Noise, Painting, Request, coded, easel::Easel};
use crate::work::{Outbox, Stale};

/// Most pixels of a picture in a row: more would take too long to be looked at.
const MAX_WIDTH: u32 = 480;
/// When a picture is done: paths for each pixel.
const ENOUGH: u64 = 1024;
/// Paths for each pixel in one round.
const ROUND: u64 = 16;

/// Renders all requests, in turns, until they are done or nobody wants them.
pub(super) fn render(easels: &mut [Easel; 2], requests: &[Request], stale: &Stale, outbox: &Outbox<Drawn>) {
    let fail = |request: &Request, fault: Fault| outbox.send(Drawn::failed(request, "the reference", fault));
    for request in requests {
        let Some(easel) = easels.get_mut(request.side) else { continue };
        if let Err(fault) = easel.set(&request.shot) {
            fail(request, fault);
            return;
        }
    }
    let mut references = Vec::new();
    for request in requests {
        let Some(easel) = easels.get(request.side) else { continue };
        let [width, height] = request.shot.size;
        let scale = (f64::from(MAX_WIDTH) / f64::from(width.max(1))).min(1.0);
        let size = [width, height].map(|length| ((f64::from(length) * scale) as u32).max(1));
        // What a shader without shadows draws: the comparison is of shading.
        let options = RenderOptions { width: size[0], height: size[1], shadows: false, ..RenderOptions::default() };
        let loaded: Option<&LoadedEnvironment> = request.shot.light.as_ref().map(|light| &light.loaded);
        match Reference::new(easel.scene(), loaded, options) {
            Ok(reference) => references.push((request, reference, easel.bounds())),
            Err(error) => fail(request, Fault::Material(error.to_string())),
        }
    }
    let start = std::time::Instant::now();
    let (mut samples, mut round) = (0, 1);
    while samples < ENOUGH && !references.is_empty() {
        for (request, reference, bounds) in &mut references {
            // The first round is always finished, so that there is something to see while the view turns.
            if samples > 0 && stale.is_stale() {
                return;
            }
            if let Err(error) = reference.add_samples(round, &|_| {}) {
                fail(request, Fault::Material(error.to_string()));
                return;
            }
            let found = reference.picture();
            let picture = Picture {
                width: found.width,
                height: found.height,
                pixels: found.pixels.iter().map(|pixel| pixel.map(|x| x as f32)).collect(),
            };
            outbox.send(Drawn {
                side: request.side,
                key: request.key,
                by: "reference".to_owned(),
                took: start.elapsed(),
                is_final: samples + round >= ENOUGH,
                result: Ok(Painting {
                    image: coded(&picture, request.shot.stage.display()),
                    picture: picture.into(),
                    bounds: *bounds,
                    compiled: 0,
                    noise: Some(Noise {
                        samples: found.samples,
                        share: found.noise(),
                        of_pixels: found.standard_error.map(Into::into),
                        faults: reference.faults().into(),
                    }),
                }),
            });
        }
        samples += round;
        round = (round * 2).min(ROUND);
    }
}
