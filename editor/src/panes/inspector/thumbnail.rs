//! Small pictures of image files, read on a thread of their own and kept.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use eframe::egui::{self, Color32, ColorImage, TextureHandle, TextureOptions};
use halfvector_maps::{Image, Limits, Texels, decode};

use crate::work::Worker;

/// Longer side of a thumbnail, in texels.
const SIDE: u32 = 96;
/// Largest file that is read for one.
const MAX_BYTES: u64 = 256 << 20;
/// Most that are kept.
const MAX_KEPT: usize = 64;

/// A file that is read, or why it was not.
struct Made {
    path: PathBuf,
    result: Result<(ColorImage, String), String>,
}

/// What is known of a file.
pub(crate) enum Thumbnail {
    /// It is being read.
    Waiting,
    /// It cannot be read: why.
    Failed(String),
    /// The picture, and what it is: size, channels, depth.
    Ready(TextureHandle, String),
}

/// All thumbnails.
pub(crate) struct Thumbnails {
    worker: Option<Worker<Vec<PathBuf>, Vec<Made>>>,
    known: HashMap<PathBuf, Thumbnail>,
    /// The state of the files that they are of.
    pictures: u64,
}

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Thumbnails").field("known", &self.known.len()).finish_non_exhaustive()
    }
}

impl Thumbnails {
    /// Starts the thread.
    pub(crate) fn start(context: &egui::Context) -> Thumbnails {
        let worker = Worker::start("thumbnails", context, |paths: Vec<PathBuf>, _| {
            let made = paths.into_iter().map(|path| Made { result: read(&path), path });
            Some(made.collect::<Vec<_>>())
        });
        Thumbnails { worker: worker.ok(), known: HashMap::new(), pictures: 0 }
    }

    /// Whether nothing is being read.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// Takes what was read. With another number files have changed, and all are read again.
    pub(crate) fn hear(&mut self, context: &egui::Context, pictures: u64) {
        while let Some(made) = self.worker.as_ref().and_then(Worker::poll) {
            for Made { path, result } in made {
                let thumbnail = match result {
                    Ok((image, what)) => {
                        Thumbnail::Ready(context.load_texture("thumbnail", image, TextureOptions::LINEAR), what)
                    }
                    Err(why) => Thumbnail::Failed(why),
                };
                self.known.insert(path, thumbnail);
            }
        }
        if std::mem::replace(&mut self.pictures, pictures) != pictures {
            self.known.clear();
        }
    }

    /// The thumbnail of a file; it is asked for when it is new.
    pub(crate) fn get(&mut self, path: &Path) -> &Thumbnail {
        if !self.known.contains_key(path) {
            if self.known.len() >= MAX_KEPT {
                self.known.clear();
            }
            self.known.insert(path.to_owned(), Thumbnail::Waiting);
            // A job that waits is replaced by the next: all that wait are asked for together.
            let waiting = self.known.iter().filter(|(_, known)| matches!(known, Thumbnail::Waiting));
            let paths = waiting.map(|(path, _)| path.clone()).collect();
            if let Some(worker) = &self.worker {
                worker.submit(paths);
            }
        }
        self.known.get(path).unwrap_or(&Thumbnail::Waiting)
    }

    /// Forgets a file, so that it is read again.
    pub(crate) fn forget(&mut self, path: &Path) {
        self.known.remove(path);
    }
}

fn read(path: &Path) -> Result<(ColorImage, String), String> {
    let failed = |error: std::io::Error| format!("{} could not be read: {error}", path.display());
    if std::fs::metadata(path).map_err(failed)?.len() > MAX_BYTES {
        return Err(format!("{} is too large for a thumbnail", path.display()));
    }
    let bytes = std::fs::read(path).map_err(failed)?;
    let decoded = decode(&bytes, Limits::default()).map_err(|error| format!("{}: {error}", path.display()))?;
    let image = decoded.image();
    Ok((small(image), describe(image)))
}

fn describe(image: &Image) -> String {
    let depth = match image.texels() {
        Texels::U8(_) => "8 bit",
        Texels::U16(_) => "16 bit",
        _ => "float",
    };
    let channels = match image.channels().count() {
        1 => "grey",
        2 => "grey and alpha",
        3 => "RGB",
        _ => "RGBA",
    };
    format!("{} × {}, {channels}, {depth}", image.width(), image.height())
}

/// The picture at thumbnail size: each texel the mean of a few of the image's.
fn small(image: &Image) -> ColorImage {
    let (width, height) = (image.width().max(1), image.height().max(1));
    let scale = (f64::from(SIDE) / f64::from(width.max(height))).min(1.0);
    let size = [width, height].map(|side| ((f64::from(side) * scale).round() as u32).max(1));
    let is_float = !matches!(image.texels(), Texels::U8(_) | Texels::U16(_));
    let has_color = image.channels().count() >= 3;
    let mut pixels = Vec::with_capacity((size[0] * size[1]) as usize);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let mut sum = [0.0_f32; 3];
            for (dx, dy) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
                let at = |place: u32, offset: f64, of: u32, size: u32| {
                    (((f64::from(place) + offset) * f64::from(of) / f64::from(size)) as u32).min(of - 1)
                };
                let texel = image.texel(at(x, dx, width, size[0]), at(y, dy, height, size[1]));
                for (sum, channel) in sum.iter_mut().zip(texel) {
                    *sum += 0.25 * channel;
                }
            }
            let [r, g, b] = if has_color { sum } else { [sum[0]; 3] };
            let code = |x: f32| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
            pixels.push(if is_float {
                // Radiance has no codes of its own.
                super::color::shown([r, g, b])
            } else {
                Color32::from_rgb(code(r), code(g), code(b))
            });
        }
    }
    ColorImage::new(size.map(|side| side as usize), pixels)
}
