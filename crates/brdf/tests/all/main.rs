//! Tests of the BRDF math against published truth, hard cases and its own documented domains, in one binary.

mod columns;
mod data;
mod domain;
mod hard_cases;
mod points;
mod precision;
mod sampling;
