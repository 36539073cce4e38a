//! How long the device itself works on a pass: two timestamps, where it has a clock.

use crate::device::Gpu;
use crate::error::RenderError;

/// Two timestamps, and the time between them so far.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    /// Seconds.
    pub(crate) total: f64,
}

/// Bytes of two timestamps.
const BYTES: u64 = 2 * size_of::<u64>() as u64;

impl Stopwatch {
    /// None where the device has no clock.
    pub(crate) fn new(gpu: &Gpu) -> Option<Stopwatch> {
        if !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let buffer = |label, usage| {
            let descriptor =
                wgpu::BufferDescriptor { label: Some(label), size: BYTES, usage, mapped_at_creation: false };
            gpu.device.create_buffer(&descriptor)
        };
        Some(Stopwatch {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("stopwatch"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer("timestamps", wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            read: buffer("timestamps read", wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
            total: 0.0,
        })
    }

    /// For the pass that is timed.
    pub(crate) fn writes(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// After the pass, in the same encoder.
    pub(crate) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read, 0, BYTES);
    }

    /// When the encoder's work is done: adds its time.
    pub(crate) fn add(&mut self, gpu: &Gpu) -> Result<(), RenderError> {
        let ticks = gpu.read_mapped(&self.read, "reading its clock", |bytes| {
            let tick = |i: usize| u64::from_le_bytes(std::array::from_fn(|byte| bytes[8 * i + byte]));
            tick(1).saturating_sub(tick(0))
        })?;
        self.total += ticks as f64 * f64::from(gpu.queue.get_timestamp_period()) * 1e-9;
        Ok(())
    }
}
