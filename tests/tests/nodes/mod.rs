//! The nodes of the library as functions: finite everywhere, right at special values, true to the sources that their help names, and
//! without aliasing. And the examples: every node stands in one.

mod aliasing;
mod blend;
mod blur;
mod examples;
mod finite;
mod gabor;
mod light;
mod metals;
mod noise_4d;
mod run;
mod surface;
mod values;
mod voronoi;
