//! Image-based lighting: environment files, cubes, prefiltered radiance, irradiance, DFG table.
