//! The parts of the window. Each reads the session and returns what a person does there as actions.

pub(crate) mod accuracy;
pub(crate) mod canvas;
pub(crate) mod code;
pub(crate) mod cost;
pub(crate) mod functions;
pub(crate) mod inspector;
pub(crate) mod library;
pub(crate) mod problems;
pub(crate) mod viewport;
