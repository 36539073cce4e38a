//! Image-based lighting: any environment in, light that a shader can look up out.
//!
//! * [`load()`] reads Radiance `.hdr`, OpenEXR, HDRE, KTX2 and ordinary images, maps of all directions or cubes, into a
//!   [`LoadedEnvironment`], repaired and counted; [`builtin`] makes three environments of our own; [`save`] writes levels.
//! * [`bake()`] turns one into a [`BakedEnvironment`]: a cube of radiance prefiltered for a rising roughness per level,
//!   diffuse irradiance as a cube and as spherical harmonics. No random numbers: the same input gives the same bytes.
//! * [`dfg_table`] is the split sum's other factor.
//! * [`environment`] reads all of it, [`occlusion`] says what the surface hides of it; their functions are twins of
//!   `shaders/ibl/environment.wgsl` and `shaders/ibl/occlusion.wgsl`.
//!
//! Radiance is linear Rec. 709. Right-handed, +Y up. Equirectangular maps: v = acos(y) / pi, u = atan2(z, x) / (2 pi) + 1/2.
//! Cubes: faces +X -X +Y -Y +Z -Z by the GPU's face rules. The crate knows no path, no GPU and no node graph.

mod bake;
pub mod builtin;
mod cube;
mod dfg;
pub mod environment;
mod equirect;
mod harmonics;
mod kernel;
mod ktx2;
mod load;
mod lobe;
pub mod occlusion;
mod quadrature;
mod repair;
mod resample;
mod sampling;
pub mod save;
pub mod sh;

pub use bake::{
    BakeOptions, BakedEnvironment, FilterJob, Filtered, LevelMap, MAX_SIZE, Prefilter, Quality, bake, bake_filtered_by,
    bake_while, bake_with_progress,
};
pub use builtin::{sky, studio, white};
pub use cube::{Cube, direction_from_face, face_from_direction, texel_solid_angle};
pub use dfg::{DFG_SIZE, DfgTable, Visibility, dfg, dfg_table, dfg_table_of_shaders, dfg_table_with};
pub use equirect::{Equirect, direction_from_equirect, equirect_from_direction};
pub use load::{
    Format, Layout, Limits, LoadError, LoadedEnvironment, Source, StoredLevels, StoredLobe, load, load_faces,
    load_within,
};
pub use quadrature::Quadrature;
pub use repair::{MAX_RADIANCE, Repairs, repair};
pub use resample::{cube_from_equirect, equirect_from_cube};
pub use sampling::{EnvironmentSample, EnvironmentSampler, alias_table, equirect_texel_solid_angle};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
