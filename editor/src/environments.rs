//! Environments, loaded and baked on a thread of their own. The old one stays until the new one is done.

use std::sync::Arc;

use eframe::egui;
use halfvector_graph::method::Methods;
use halfvector_ibl::{BakedEnvironment, LoadedEnvironment, bake_while};
use halfvector_scene::{EnvironmentSource, bake_options};

use crate::work::Worker;

/// An environment that can be drawn with.
#[derive(Debug)]
pub(crate) struct Light {
    /// Which one.
    pub(crate) source: EnvironmentSource,
    /// As it is in its file, for the reference.
    pub(crate) loaded: LoadedEnvironment,
    /// For shaders.
    pub(crate) baked: Arc<BakedEnvironment>,
}

/// What a bake depends on.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    source: EnvironmentSource,
    /// The methods that bakes follow.
    methods: [&'static str; 3],
}

#[derive(Debug)]
struct Job {
    key: Key,
    methods: Methods,
}

#[derive(Debug)]
enum Told {
    Progress(f32),
    Done(Key, Result<Arc<Light>, String>),
}

/// Most environments that are kept.
const KEPT: usize = 6;

/// The environments of the window.
pub(crate) struct Environments {
    worker: Option<Worker<Job, Told>>,
    /// The one used last at the end.
    ready: Vec<(Key, Arc<Light>)>,
    /// What is being baked, and how far it is.
    baking: Option<(Key, f32)>,
    /// What failed last.
    failed: Option<(Key, String)>,
}

impl Environments {
    /// Starts the thread.
    pub(crate) fn new(context: &egui::Context) -> Environments {
        let worker = Worker::start_telling("environments", context, |job: Job, stale, outbox| {
            let mut told = 0.0;
            let light = light_while(&job.key.source, &job.methods, |done| {
                if done - told > 0.02 {
                    told = done;
                    outbox.send(Told::Progress(done));
                }
                !stale.is_stale()
            });
            if let Some(light) = light.transpose() {
                outbox.send(Told::Done(job.key, light));
            }
        });
        Environments { worker: worker.ok(), ready: Vec::new(), baking: None, failed: None }
    }

    /// Whether nothing is being baked.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// How far the bake is that is being made, 0 to 1.
    pub(crate) fn progress(&self) -> Option<f32> {
        self.baking.as_ref().map(|(_, done)| *done)
    }

    /// Takes what is done. The error is of an environment that could not be loaded.
    pub(crate) fn poll(&mut self) -> Option<(EnvironmentSource, String)> {
        let mut error = None;
        while let Some(told) = self.worker.as_ref().and_then(Worker::poll) {
            match told {
                Told::Progress(done) => {
                    if let Some(baking) = &mut self.baking {
                        baking.1 = done;
                    }
                }
                Told::Done(key, result) => {
                    if self.baking.as_ref().is_some_and(|(baking, _)| *baking == key) {
                        self.baking = None;
                    }
                    match result {
                        Ok(light) => self.ready.push((key, light)),
                        Err(why) => {
                            error = Some((key.source.clone(), why.clone()));
                            self.failed = Some((key, why));
                        }
                    }
                }
            }
        }
        if self.ready.len() > KEPT {
            self.ready.remove(0);
        }
        error
    }

    /// The light of an environment for methods: `Ok(None)` when there is none, `Err` while it is being made or when it
    /// cannot be.
    pub(crate) fn get(&mut self, source: &EnvironmentSource, methods: &Methods) -> Result<Option<Arc<Light>>, ()> {
        if *source == EnvironmentSource::None {
            return Ok(None);
        }
        let key = Key {
            source: source.clone(),
            methods: ["level_map", "prefilter", "env_decode"].map(|term| methods.get(term).name),
        };
        if let Some(place) = self.ready.iter().position(|(known, _)| *known == key) {
            let used = self.ready.remove(place);
            let light = used.1.clone();
            self.ready.push(used);
            return Ok(Some(light));
        }
        let is_known = |known: &Key| *known == key;
        let is_asked = self.baking.as_ref().is_some_and(|(baking, _)| is_known(baking));
        let has_failed = self.failed.as_ref().is_some_and(|(failed, _)| is_known(failed));
        // One after the other: the other side's may be under way.
        if !is_asked
            && !has_failed
            && self.baking.is_none()
            && let Some(worker) = &self.worker
        {
            worker.submit(Job { key: key.clone(), methods: methods.clone() });
            self.baking = Some((key, 0.0));
        }
        Err(())
    }

    /// Gives up what is being baked. What was done of it is lost.
    pub(crate) fn cancel(&mut self) {
        self.worker.iter().for_each(Worker::cancel);
        self.baking = None;
    }

    /// Forgets that an environment could not be loaded: it may be tried again.
    pub(crate) fn forgive(&mut self) {
        self.failed = None;
    }
}

/// Loads and bakes an environment.
pub(crate) fn light(source: &EnvironmentSource, methods: &Methods) -> Result<Arc<Light>, String> {
    light_while(source, methods, |_| true)?.ok_or_else(|| "the bake ended early".to_owned())
}

/// The same, while `go_on`, which learns the share that is done, says so; none when it did not.
fn light_while(
    source: &EnvironmentSource,
    methods: &Methods,
    mut go_on: impl FnMut(f32) -> bool,
) -> Result<Option<Arc<Light>>, String> {
    let loaded = source.load().map_err(|error| error.to_string())?.ok_or("there is no environment")?;
    let options = bake_options(source, methods, &loaded);
    let baked = bake_while(&loaded, &options, &mut go_on);
    Ok(baked.map(|baked| Arc::new(Light { source: source.clone(), loaded, baked: Arc::new(baked) })))
}
