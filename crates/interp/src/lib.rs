//! Runs a validated naga module on the CPU: any function or vertex, fragment or compute entry point, for many
//! invocations at once.
//!
//! A function is compiled once, with all of its calls put in place and all of its values taken apart into scalars, to a
//! flat program of instructions on batches of [`LANES`] invocations. What is the same in all lanes is computed once;
//! where lanes take different ways a mask says which are active.
//!
//! The same program runs in f32, as a device computes, and in f64, where the shader's f32 have (nearly) exact
//! arithmetic. Integers, bools and bit operations are exact in both; bitcasts and packing round to f32 first. Shaders
//! with f64 of their own keep it in both.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use halfvector_interp::{Column, Derivatives, Entry, Limits, OutputColumn, Outputs, Program, Resources};
//! let module = naga::front::wgsl::parse_str("fn twice(x: f32) -> f32 { return 2.0 * x; }")?;
//! let info = naga::valid::Validator::new(Default::default(), Default::default()).validate(&module)?;
//! let program = Program::compile(&module, &info, Entry::Function("twice"))?;
//! let mut outputs = Outputs::default();
//! let inputs = [Column::Float(&[1.0_f32, 2.5])];
//! program.run(&inputs, 2, &mut outputs, &Resources::default(), Derivatives::Zero, Limits::default())?;
//! assert_eq!(outputs.columns, [OutputColumn::Float(vec![2.0, 5.0])]);
//! # Ok(())
//! # }
//! ```
//!
//! It does not do: atomics, barriers and workgroup memory, writes to textures, integer, depth, storage,
//! multisampled and external textures, the types f16, i64 and u64, ray queries, subgroup operations, override constants
//! whose value is not set. Programs that use them are refused by name when they are compiled.

mod allocate;
mod code;
pub mod elementary;
mod emit;
mod error;
mod half;
mod ir;
mod kernel;
mod lower;
mod machine;
mod program;
mod real;
mod resource;
mod shape;
mod simplify;
mod texture;
mod uniform;
mod watch;

pub use error::{Place, RunError, Unsupported};
pub use half::Half;
pub use kernel::LANES;
pub use machine::Machine;
pub use program::{Entry, Program, Slot};
pub use real::Float;
pub use resource::{Column, Derivatives, Limits, OutputColumn, Outputs, Resources};
pub use texture::{Address, Filter, Level, LevelRule, Sampler, Shape, Texture, TextureError};
pub use watch::Watch;
