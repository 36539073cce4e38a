//! Tests of the crate as a whole, one file for each room of it; they share a small node library.

mod library;
