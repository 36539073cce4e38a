//! Work on other threads: one thread does one kind of job, the newest first. What is stale is dropped or told to stop.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use eframe::egui;

/// A thread that does one kind of job. Dropping it lets the thread end after its job.
#[derive(Debug)]
pub(crate) struct Worker<J, R> {
    shared: Arc<Shared<J>>,
    results: Receiver<R>,
}

#[derive(Debug)]
struct Shared<J> {
    slot: Mutex<Slot<J>>,
    wake: Condvar,
    /// Number of the newest job.
    newest: AtomicU64,
}

#[derive(Debug)]
struct Slot<J> {
    waiting: Option<(u64, J)>,
    busy: bool,
    closed: bool,
}

/// Tells a job whether a newer one has come.
#[derive(Clone, Debug)]
pub(crate) struct Stale {
    number: u64,
    newest: Arc<dyn Newest>,
}

/// Where a job leaves what it has to show; the window is drawn anew for it.
#[derive(Debug)]
pub(crate) struct Outbox<R> {
    sender: Sender<R>,
    context: egui::Context,
}

impl<R> Outbox<R> {
    /// Shows something. Nobody may be there any more to see it.
    pub(crate) fn send(&self, result: R) {
        let _ = self.sender.send(result);
        self.context.request_repaint();
    }
}

trait Newest: Send + Sync + std::fmt::Debug {
    fn newest(&self) -> u64;
}

impl<J: Send + std::fmt::Debug> Newest for Shared<J> {
    fn newest(&self) -> u64 {
        self.newest.load(Ordering::Relaxed)
    }
}

impl Stale {
    /// Whether the result will not be wanted any more.
    pub(crate) fn is_stale(&self) -> bool {
        self.newest.newest() != self.number
    }
}

impl<J: Send + std::fmt::Debug + 'static, R: Send + 'static> Worker<J, R> {
    /// Starts a thread. `work` returns `None` when it stopped early. The window is drawn anew for each result.
    pub(crate) fn start(
        name: &str,
        context: &egui::Context,
        mut work: impl FnMut(J, &Stale) -> Option<R> + Send + 'static,
    ) -> std::io::Result<Worker<J, R>> {
        Worker::start_telling(name, context, move |job, stale, outbox| {
            if let Some(result) = work(job, stale) {
                outbox.send(result);
            }
        })
    }

    /// The same for work that has something to show more than once.
    pub(crate) fn start_telling(
        name: &str,
        context: &egui::Context,
        mut work: impl FnMut(J, &Stale, &Outbox<R>) + Send + 'static,
    ) -> std::io::Result<Worker<J, R>> {
        let slot = Mutex::new(Slot { waiting: None, busy: false, closed: false });
        let shared = Arc::new(Shared { slot, wake: Condvar::new(), newest: AtomicU64::new(0) });
        let (sender, results) = channel();
        let theirs = shared.clone();
        let outbox = Outbox { sender, context: context.clone() };
        std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            while let Some((number, job)) = theirs.next() {
                let stale = Stale { number, newest: theirs.clone() };
                // First the results, then idle: who finds the thread idle finds the results.
                work(job, &stale, &outbox);
                theirs.lock().busy = false;
                outbox.context.request_repaint();
            }
        })?;
        Ok(Worker { shared, results })
    }

    /// Gives the thread a job. One that waits is forgotten, one that runs becomes stale.
    pub(crate) fn submit(&self, job: J) {
        let number = self.shared.newest.fetch_add(1, Ordering::Relaxed) + 1;
        self.shared.lock().waiting = Some((number, job));
        self.shared.wake.notify_one();
    }

    /// Forgets what waits and tells what runs that it is stale.
    pub(crate) fn cancel(&self) {
        self.shared.newest.fetch_add(1, Ordering::Relaxed);
        self.shared.lock().waiting = None;
    }

    /// The next result that is ready.
    pub(crate) fn poll(&self) -> Option<R> {
        self.results.try_recv().ok()
    }

    /// Whether a job waits or runs.
    pub(crate) fn is_busy(&self) -> bool {
        let slot = self.shared.lock();
        slot.busy || slot.waiting.is_some()
    }
}

impl<J> Shared<J> {
    fn lock(&self) -> std::sync::MutexGuard<'_, Slot<J>> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a job; `None` when nobody will give one any more.
    fn next(&self) -> Option<(u64, J)> {
        let mut slot = self.lock();
        loop {
            if slot.closed {
                return None;
            }
            if let Some(job) = slot.waiting.take() {
                slot.busy = true;
                return Some(job);
            }
            slot = self.wake.wait(slot).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<J, R> Drop for Worker<J, R> {
    fn drop(&mut self) {
        self.shared.newest.fetch_add(1, Ordering::Relaxed);
        self.shared.lock().closed = true;
        self.shared.wake.notify_one();
    }
}
