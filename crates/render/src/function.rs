//! Runs one function of the WGSL library on the device, many times, in f32, f64 or f16: what a GPU makes of the formula.
//!
//! Texture-free functions of numbers only; no nodes.

use halfvector_shaders::function::{F16_PRELUDE, F64_PRELUDE, library_files, with_dependencies};
use naga::{Handle, Module, ScalarKind, Type, TypeInner};
use wgpu::util::DeviceExt;

use crate::device::Gpu;
use crate::error::RenderError;
use crate::renderer::Renderer;

/// A number that a GPU computes with.
pub trait Number: bytemuck::Pod {
    /// What stands in front of library code to make it compute with this. Constants that it defines take the place of the
    /// library's: floors that this type cannot hold.
    const PRELUDE: &'static str;
    /// What a device has to have.
    const FEATURE: wgpu::Features;
    /// Rounded.
    fn from_f32(x: f32) -> Self;
    /// Exact.
    fn to_f64(self) -> f64;
}

impl Number for f32 {
    const PRELUDE: &'static str = "";
    const FEATURE: wgpu::Features = wgpu::Features::empty();
    fn from_f32(x: f32) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Number for f64 {
    const PRELUDE: &'static str = F64_PRELUDE;
    const FEATURE: wgpu::Features = wgpu::Features::SHADER_F64;
    fn from_f32(x: f32) -> Self {
        f64::from(x)
    }
    fn to_f64(self) -> f64 {
        self
    }
}

impl Number for half::f16 {
    const PRELUDE: &'static str = F16_PRELUDE;
    const FEATURE: wgpu::Features = wgpu::Features::SHADER_F16;
    fn from_f32(x: f32) -> Self {
        half::f16::from_f32(x)
    }
    fn to_f64(self) -> f64 {
        self.to_f64()
    }
}

/// What a function returned.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Row after row.
    pub values: Vec<f64>,
    /// Numbers that a call takes.
    pub arguments: usize,
    /// Numbers that a call returns.
    pub results: usize,
}

/// All of the library's functions as one module: their signatures.
///
/// # Errors
/// naga's words, when the library is no valid WGSL: a mistake of the library.
pub fn library() -> Result<Module, String> {
    let source: String = library_files().map(|f| f.source).collect();
    naga::front::wgsl::parse_str(&source).map_err(|error| error.emit_to_string(&source))
}

/// The expression that builds a value of a type from numbers `next()`, or `None` for one that is not made of numbers.
fn build(module: &Module, ty: Handle<Type>, next: &mut impl FnMut() -> String) -> Option<String> {
    let ty = &module.types[ty];
    Some(match &ty.inner {
        TypeInner::Scalar(s) if s.kind == ScalarKind::Float => next(),
        TypeInner::Scalar(s) if s.kind == ScalarKind::Bool => format!("{} != 0.0", next()),
        TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => {
            let parts: Vec<_> = (0..*size as u8).map(|_| next()).collect();
            format!("vec{}f({})", *size as u8, parts.join(", "))
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(count), .. } => {
            let parts: Option<Vec<_>> = (0..count.get()).map(|_| build(module, *base, next)).collect();
            format!("array({})", parts?.join(", "))
        }
        TypeInner::Struct { members, .. } => {
            let parts: Option<Vec<_>> = members.iter().map(|m| build(module, m.ty, next)).collect();
            format!("{}({})", ty.name.as_ref()?, parts?.join(", "))
        }
        _ => return None,
    })
}

/// The numbers that a value is made of, as expressions.
fn take_apart(module: &Module, ty: Handle<Type>, value: &str, parts: &mut Vec<String>) {
    match &module.types[ty].inner {
        TypeInner::Vector { size, .. } => {
            parts.extend("xyzw".chars().take(*size as usize).map(|c| format!("{value}.{c}")));
        }
        TypeInner::Struct { members, .. } => {
            for member in members {
                let name = member.name.as_deref().expect("a named member");
                take_apart(module, member.ty, &format!("{value}.{name}"), parts);
            }
        }
        _ => parts.push(value.to_string()),
    }
}

/// A shader that calls a function, and how many numbers go in and come out.
struct Call {
    source: String,
    arguments: usize,
    results: usize,
}

/// Why not, in words that finish "the function cannot be called: ".
fn call_of(module: &Module, function: &str, prelude: &str) -> Result<Call, String> {
    let known = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(function));
    let (_, f) = known.ok_or("the library has no function of this name")?;
    let mut arguments = 0;
    let mut next = || {
        arguments += 1;
        format!("arguments[argument + {}u]", arguments - 1)
    };
    let built: Option<Vec<_>> = f.arguments.iter().map(|a| build(module, a.ty, &mut next)).collect();
    let built = built.ok_or("it takes more than numbers")?;
    let mut parts = Vec::new();
    take_apart(module, f.result.as_ref().ok_or("it returns nothing")?.ty, "r", &mut parts);
    let stores: Vec<_> =
        parts.iter().enumerate().map(|(i, part)| format!("results[result + {i}u] = {part};")).collect();
    let harness = include_str!("function/call.wgsl")
        .replace("ARGUMENTS", &format!("{arguments}u"))
        .replace("RESULTS", &format!("{}u", parts.len()))
        .replace("CALL", &format!("{function}({})", built.join(", ")))
        .replace("STORE", &stores.join("\n    "));
    let source = format!("{prelude}{}{harness}", with_dependencies(function, prelude));
    Ok(Call { source, arguments, results: parts.len() })
}

impl Renderer {
    /// Whether the device computes with these numbers.
    pub fn computes_in<N: Number>(&self) -> bool {
        self.gpu.device.features().contains(N::FEATURE)
    }

    /// Calls a function of the library once for each row of `arguments` (row after row, without gaps) and returns the
    /// numbers of its results, row after row. A buffer of f16 needs an even number of them in all.
    ///
    /// # Errors
    /// When [`library`] has no such function, it takes or returns more than numbers, the arguments are no whole rows, the
    /// device does not compute in `N`, or fails.
    pub fn call<N: Number>(&self, library: &Module, function: &str, arguments: &[f32]) -> Result<Results, RenderError> {
        let refused = |why: String| RenderError::Function { name: function.to_owned(), why };
        let call = call_of(library, function, N::PRELUDE).map_err(refused)?;
        if !self.computes_in::<N>() {
            return Err(refused(format!("{} has no numbers of {} bits", self.adapter(), 8 * size_of::<N>())));
        }
        let rows = arguments.len() / call.arguments.max(1);
        if rows * call.arguments != arguments.len() {
            return Err(refused(format!(
                "it takes {} numbers, and {} are no whole rows",
                call.arguments,
                arguments.len()
            )));
        }
        // SPIR-V's extended instructions for GLSL have these for 16 and 32 bits alone, and drivers do not check.
        let missing =
            ["pow(", "exp(", "exp2(", "log(", "log2(", "sin(", "cos(", "tan(", "asin(", "acos(", "atan(", "atan2("];
        let uses = |name: &&&str| {
            let code = call.source.as_bytes();
            let starts = |at: usize| at == 0 || !(code[at - 1].is_ascii_alphanumeric() || code[at - 1] == b'_');
            call.source.match_indices(**name).any(|(at, _)| starts(at))
        };
        if N::FEATURE == wgpu::Features::SHADER_F64
            && let Some(name) = missing.iter().find(uses)
        {
            return Err(refused(format!("GPUs have no {}) in 64 bits", name)));
        }
        let input: Vec<N> = arguments.iter().map(|x| N::from_f32(*x)).collect();
        let bytes = (rows * call.results * size_of::<N>()) as u64;
        let output = self.compute(&call.source, bytemuck::cast_slice(&input), bytes, rows)?;
        let values = bytemuck::pod_collect_to_vec::<u8, N>(&output).into_iter().map(N::to_f64).collect();
        Ok(Results { values, arguments: call.arguments, results: call.results })
    }

    /// Runs the entry point `call` of a shader, in groups of 64, with `input` at binding 0, `rows` times, and returns the
    /// bytes at binding 1.
    ///
    /// # Errors
    /// When the device refuses the shader, or fails.
    pub fn compute(&self, source: &str, input: &[u8], output_bytes: u64, rows: usize) -> Result<Vec<u8>, RenderError> {
        self.gpu.guarded("calling a function", || dispatch(&self.gpu, source, input, output_bytes, rows))
    }
}

fn dispatch(gpu: &Gpu, source: &str, input: &[u8], bytes: u64, rows: usize) -> Result<Vec<u8>, RenderError> {
    let device = &gpu.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("call"),
        compilation_options: Default::default(),
        cache: None,
    });
    let arguments = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: input,
        usage: wgpu::BufferUsages::STORAGE,
    });
    let results = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: arguments.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: results.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(rows.div_ceil(64) as u32, 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    gpu.read_buffer(&results, "calling a function")
}
