//! Several devices of one kind side by side. What is drawn for the first time waits for a compiler, which on a software device is
//! one thread: first pictures are drawn by all of them at once. What is timed is drawn later, by one at a time.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use halfvector_ibl::BakedEnvironment;
use halfvector_render::{Cache, RenderOptions, Renderer};
use halfvector_scene::{Picture, Scene};

/// Most devices that are opened.
const MOST: usize = 4;

/// Why nothing is measured on a device.
pub(super) const NO_DEVICE: &str = "none was found";

/// A device, and what it has compiled.
pub(super) struct Station {
    renderer: Renderer,
    cache: Mutex<Cache>,
}

impl Station {
    /// A picture, and the device's own time for it [s]; or why the device refuses.
    pub(super) fn draw(
        &self,
        scene: &Scene,
        environment: Option<&Arc<BakedEnvironment>>,
        options: &RenderOptions,
    ) -> Result<(Picture, Option<f64>), String> {
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        self.renderer.render_timed(&mut cache, scene, environment, options).map_err(|error| error.to_string())
    }

    /// The device's name.
    pub(super) fn name(&self) -> &str {
        self.renderer.adapter()
    }
}

/// A station for each core, at most [`MOST`]; they have no device where the machine has none.
///
/// Two devices of one machine need not be as fast as each other: what is weighed against each other is drawn by the same one.
pub(super) fn stations() -> Vec<Option<Station>> {
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    (0..cores.min(MOST)).map(|_| station()).collect()
}

/// One station.
pub(super) fn station() -> Option<Station> {
    Renderer::new().ok().map(|renderer| Station { renderer, cache: Mutex::default() })
}

/// Work on each item, by as many threads as there are stations, each with its own. In the order of the items: the number of the
/// station that did it, and what it gave.
pub(super) fn shared<T: Sync, R: Send>(
    stations: &[Option<Station>],
    items: &[T],
    work: impl Fn(Option<&Station>, &T) -> R + Sync,
) -> Vec<(usize, R)> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, usize, R)>> = Mutex::default();
    std::thread::scope(|scope| {
        for (number, station) in stations.iter().enumerate() {
            let (next, done, work) = (&next, &done, &work);
            scope.spawn(move || {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(at) else { break };
                    let result = work(station.as_ref(), item);
                    done.lock().unwrap_or_else(PoisonError::into_inner).push((at, number, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|(at, ..)| *at);
    done.into_iter().map(|(_, number, result)| (number, result)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_worked_on_once_and_in_order() {
        let items: Vec<usize> = (0..100).collect();
        let found = shared(&[None, None, None], &items, |station, item| (station.is_none(), 2 * item));
        assert!(found.iter().enumerate().all(|(at, (_, result))| *result == (true, 2 * at)), "{found:?}");
    }
}
