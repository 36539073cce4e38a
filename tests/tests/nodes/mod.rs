//! The nodes of the library as functions: finite everywhere, right at special values, true to the sources that their help names, and
//! without aliasing. And the examples: every node stands in one.

mod aliasing;
mod blend;
mod examples;
mod finite;
mod light;
mod metals;
mod run;
mod surface;
mod values;
