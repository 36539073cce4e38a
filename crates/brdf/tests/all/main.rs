//! Tests of the BRDF math against published truth, hard cases and its own documented domains, in one binary.

mod any_number;
mod batch;
mod chi2;
mod columns;
mod data;
mod domain;
mod energy;
mod evaluate;
mod forms;
mod hard_cases;
mod lanes;
mod lobes;
mod lobes_layered;
mod points;
mod precision;
mod sampling;
mod thin_film;
