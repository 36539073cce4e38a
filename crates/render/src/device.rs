//! The GPU: which one is taken, and how its errors come back as values. It draws nothing.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::error::RenderError;

/// What the device can do beyond WebGPU's core, as far as it is used here.
const WANTED: wgpu::Features = wgpu::Features::FLOAT32_BLENDABLE
    .union(wgpu::Features::FLOAT32_FILTERABLE)
    .union(wgpu::Features::TIMESTAMP_QUERY)
    .union(wgpu::Features::SHADER_F64)
    .union(wgpu::Features::SHADER_F16);

/// How long a callback may take that is due.
const CALL_BACK: Duration = Duration::from_secs(10);

/// An opened GPU.
#[derive(Debug)]
pub(crate) struct Gpu {
    /// Makes resources.
    pub(crate) device: wgpu::Device,
    /// Takes work.
    pub(crate) queue: wgpu::Queue,
    /// For people: the card, the driver and the interface.
    pub(crate) name: String,
    /// Whether it is the CPU that pretends to be a GPU.
    pub(crate) software: bool,
    adapter: wgpu::Adapter,
    /// Errors that came outside of any scope, and the loss of the device.
    faults: Arc<Mutex<Vec<String>>>,
}

impl Gpu {
    /// Opens the best GPU there is: a card before a software GPU, and Vulkan, Metal or Direct3D before OpenGL.
    /// The variables `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` narrow the choice.
    pub(crate) fn open() -> Result<Gpu, RenderError> {
        let (adapter, looked_for) = match best_adapter(wgpu::Backends::PRIMARY) {
            Some(adapter) => (Some(adapter), String::new()),
            None => (best_adapter(wgpu::Backends::GL), "no Vulkan, Metal, Direct3D 12 or OpenGL device".to_owned()),
        };
        let adapter = adapter.ok_or(RenderError::NoAdapter { why: looked_for })?;
        let info = adapter.get_info();
        let name = format!("{} ({})", info.name, info.backend);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("halfvector"),
            required_features: adapter.features() & WANTED,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| RenderError::Device { adapter: name.clone(), why: error.to_string() })?;
        let faults = Arc::new(Mutex::new(Vec::new()));
        let note = |faults: &Arc<Mutex<Vec<String>>>| {
            let faults = faults.clone();
            move |text: String| faults.lock().unwrap_or_else(PoisonError::into_inner).push(text)
        };
        let uncaptured = note(&faults);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| uncaptured(error.to_string())));
        let lost = note(&faults);
        device.set_device_lost_callback(move |reason, text| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                lost(format!("the device was lost: {text}"));
            }
        });
        Ok(Gpu { device, queue, name, software: info.device_type == wgpu::DeviceType::Cpu, adapter, faults })
    }

    /// Does some work and turns every error that wgpu meets in it into an error value. `doing` finishes the sentence
    /// "the GPU stopped while ...".
    pub(crate) fn guarded<T>(
        &self,
        doing: &str,
        work: impl FnOnce() -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = work();
        let validation = pollster::block_on(validation.pop());
        let internal = pollster::block_on(internal.pop());
        let memory = pollster::block_on(memory.pop());
        let (adapter, doing) = (self.name.clone(), doing.to_owned());
        if memory.is_some() {
            return Err(RenderError::OutOfMemory { adapter, doing });
        }
        let fault = self.faults.lock().unwrap_or_else(PoisonError::into_inner).first().cloned();
        if let Some(why) = fault.or(internal.map(|error| error.to_string())) {
            return Err(RenderError::Lost { adapter, doing, why });
        }
        if let Some(error) = validation {
            return Err(RenderError::Refused { adapter, doing, why: error.to_string() });
        }
        result
    }

    /// Gives the device back to the system. From now on work on it fails.
    pub(crate) fn close(&self) {
        let why = "the device was given back".to_owned();
        self.faults.lock().unwrap_or_else(PoisonError::into_inner).push(why);
        self.device.destroy();
    }

    /// Waits until all submitted work is done.
    pub(crate) fn wait(&self, doing: &str) -> Result<(), RenderError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map(|_| ()).map_err(|error| RenderError::Lost {
            adapter: self.name.clone(),
            doing: doing.to_owned(),
            why: error.to_string(),
        })
    }

    /// Waits for submitted work and reads a buffer that can be mapped.
    pub(crate) fn read_mapped<T>(
        &self,
        buffer: &wgpu::Buffer,
        doing: &str,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, RenderError> {
        let lost = |why: String| RenderError::Lost { adapter: self.name.clone(), doing: doing.to_owned(), why };
        let (sender, receiver) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver is gone only when the wait below failed, and then nobody asks.
            let _ = sender.send(result);
        });
        self.wait(doing)?;
        // All submitted work is done; but if another thread has waited, too, it may be that one that is just calling back.
        match receiver.recv_timeout(CALL_BACK) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(lost(error.to_string())),
            Err(_) => return Err(lost("the numbers did not come back".to_owned())),
        }
        let taken = take(&buffer.get_mapped_range(..).map_err(|error| lost(error.to_string()))?);
        buffer.unmap();
        Ok(taken)
    }

    /// Waits for submitted work and copies the numbers of a buffer that can be copied from.
    pub(crate) fn read_buffer<T: bytemuck::Pod>(
        &self,
        buffer: &wgpu::Buffer,
        doing: &str,
    ) -> Result<Vec<T>, RenderError> {
        let mapped = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: buffer.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &mapped, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        self.read_mapped(&mapped, doing, bytemuck::pod_collect_to_vec::<u8, T>)
    }

    /// The format that radiance is drawn to: 32-bit floats, or 16-bit ones where 32-bit ones cannot be blended and blending
    /// is wanted, or cannot be drawn to at all.
    pub(crate) fn radiance_format(&self, blending: bool) -> Result<wgpu::TextureFormat, RenderError> {
        let wanted = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let drawable = |format| self.adapter.get_texture_format_features(format).allowed_usages.contains(wanted);
        let blendable = self.device.features().contains(wgpu::Features::FLOAT32_BLENDABLE);
        if (!blending || blendable) && drawable(wgpu::TextureFormat::Rgba32Float) {
            Ok(wgpu::TextureFormat::Rgba32Float)
        } else if drawable(wgpu::TextureFormat::Rgba16Float) {
            Ok(wgpu::TextureFormat::Rgba16Float)
        } else {
            Err(RenderError::NoFloatTarget { adapter: self.name.clone() })
        }
    }

    /// Whether 32-bit float textures can be read between texels.
    pub(crate) fn filters_f32(&self) -> bool {
        self.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE)
    }
}

/// The best adapter of some backends, if any.
fn best_adapter(backends: wgpu::Backends) -> Option<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle().with_env();
    descriptor.backends &= backends;
    let backends = descriptor.backends;
    if backends.is_empty() {
        return None;
    }
    let instance = wgpu::Instance::new(descriptor);
    let named = std::env::var("WGPU_ADAPTER_NAME").ok().map(|name| name.to_lowercase());
    let adapters = pollster::block_on(instance.enumerate_adapters(backends));
    adapters
        .into_iter()
        .filter(|adapter| named.as_ref().is_none_or(|name| adapter.get_info().name.to_lowercase().contains(name)))
        .min_by_key(|adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        })
}
