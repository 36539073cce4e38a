//! Draws a scene with wgpu: device, pipelines, targets, readback.
