//! The GPU that all painters of the window share, or why there is none. The window's own device is another one, so that
//! neither waits for the other and a lost one takes nothing with it.

use std::sync::{Arc, Mutex, PoisonError, TryLockError};

use halfvector_render::Renderer;

/// A GPU that is opened when it is first asked for.
#[derive(Clone, Debug)]
pub(crate) struct Gpu(Arc<Mutex<State>>);

#[derive(Debug)]
enum State {
    Closed,
    Open(Arc<Renderer>),
    /// Why it is not used.
    Gone(String),
}

impl Gpu {
    /// One that is opened when it is needed; or, when it is not allowed, none.
    pub(crate) fn new(allowed: bool) -> Gpu {
        let state = if allowed { State::Closed } else { State::Gone("drawing on the CPU was asked for".to_owned()) };
        Gpu(Arc::new(Mutex::new(state)))
    }

    /// The device, opened now if it was not; none when there is none or it gave up.
    pub(crate) fn renderer(&self) -> Option<Arc<Renderer>> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if matches!(*state, State::Closed) {
            *state = match Renderer::new() {
                Ok(renderer) => State::Open(Arc::new(renderer)),
                Err(error) => State::Gone(error.to_string()),
            };
        }
        match &*state {
            State::Open(renderer) => Some(renderer.clone()),
            State::Closed | State::Gone(_) => None,
        }
    }

    /// The device gave up: from now on nobody gets it. What was known of it before stays.
    pub(crate) fn lose(&self, why: String) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !matches!(*state, State::Gone(_)) {
            *state = State::Gone(why);
        }
    }

    /// Gives the device back because a person wants so. What is being drawn on it is drawn by the CPU. Never waits: while the
    /// device is being opened nothing happens.
    pub(crate) fn leave(&self, why: String) {
        let mut state = match self.0.try_lock() {
            Ok(state) => state,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return,
        };
        if let State::Open(renderer) = std::mem::replace(&mut *state, State::Gone(why)) {
            renderer.close();
        }
    }

    /// Lets the next one who asks open it anew.
    pub(crate) fn retry(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = State::Closed;
    }

    /// Why it is not used. Never waits: while the device is being opened there is no trouble yet.
    pub(crate) fn trouble(&self) -> Option<String> {
        let state = match self.0.try_lock() {
            Ok(state) => state,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return None,
        };
        match &*state {
            State::Gone(why) => Some(why.clone()),
            State::Closed | State::Open(_) => None,
        }
    }
}
