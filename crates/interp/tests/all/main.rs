//! Tests of the interpreter that need neither a device nor another crate of ours.

mod builtins;
mod constants;
mod derivatives;
mod elementary;
mod flow;
mod hostile;
mod semantics;
mod storage;
mod support;
mod textures;
mod values;
mod watch;
