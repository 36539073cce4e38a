//! Runs one function of the WGSL library on a GPU, many times, in f32, f64 or f16.

use std::collections::BTreeSet;

use halfvector_shaders::slicer::{Item, slice};
use halfvector_shaders::{FILES, File};
use naga::{Handle, Module, ScalarKind, Type, TypeInner};
use wgpu::util::DeviceExt;

use crate::support::required;

/// An opened GPU.
pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// For people.
    pub(crate) name: String,
    /// Whether it computes in f64.
    pub(crate) has_f64: bool,
    /// Whether it computes in f16.
    pub(crate) has_f16: bool,
}

/// A number that a GPU computes with.
pub(crate) trait Number: bytemuck::Pod {
    /// What stands in front of library code to make it compute with this. Constants that it defines take the place of the
    /// library's: floors that this type cannot hold.
    const PRELUDE: &'static str;
    fn from_f32(x: f32) -> Self;
    fn to_f64(self) -> f64;
}

impl Number for f32 {
    const PRELUDE: &'static str = "";
    fn from_f32(x: f32) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Number for f64 {
    const PRELUDE: &'static str = include_str!("f64.wgsl");
    fn from_f32(x: f32) -> Self {
        f64::from(x)
    }
    fn to_f64(self) -> f64 {
        self
    }
}

impl Number for half::f16 {
    const PRELUDE: &'static str = include_str!("f16.wgsl");
    fn from_f32(x: f32) -> Self {
        half::f16::from_f32(x)
    }
    fn to_f64(self) -> f64 {
        self.to_f64()
    }
}

/// The files of library functions: those that hold neither nodes nor entry points.
pub(crate) fn library_files() -> impl Iterator<Item = &'static File> {
    FILES.iter().filter(|f| !f.path.starts_with("nodes/") && !f.path.starts_with("entry/"))
}

/// All of the library's functions as one module.
pub(crate) fn library() -> Module {
    let source: String = library_files().map(|f| f.source).collect();
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)))
}

/// The function and all that it refers to, directly or not, as text, but for what the prelude defines.
pub(crate) fn sliced(function: &str, prelude: &str) -> String {
    let items: Vec<(&File, Item)> = library_files()
        .flat_map(|f| slice(f.source).unwrap_or_else(|e| panic!("{}: {e}", f.path)).into_iter().map(move |i| (f, i)))
        .collect();
    let mut reached = BTreeSet::new();
    let mut open = vec![function.to_string()];
    while let Some(name) = open.pop() {
        if let Some((_, item)) = items.iter().find(|(_, i)| i.name == name)
            && reached.insert(name)
        {
            open.extend(item.dependencies.iter().cloned());
        }
    }
    let own = |name: &str| prelude.contains(&format!("const {name}:"));
    let kept = items.iter().filter(|(_, i)| reached.contains(&i.name) && !own(&i.name));
    kept.map(|(file, item)| format!("{}\n", &file.source[item.code_start..item.end])).collect()
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

fn call_of(module: &Module, function: &str, prelude: &str) -> Call {
    let (_, f) = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(function))
        .unwrap_or_else(|| panic!("the WGSL library has no function `{function}`"));
    let mut arguments = 0;
    let mut next = || {
        arguments += 1;
        format!("arguments[argument + {}u]", arguments - 1)
    };
    let built: Option<Vec<_>> = f.arguments.iter().map(|a| build(module, a.ty, &mut next)).collect();
    let built = built.unwrap_or_else(|| panic!("`{function}` takes more than numbers: list it in WGSL_ONLY"));
    let mut parts = Vec::new();
    take_apart(module, f.result.as_ref().expect("a function returns a value").ty, "r", &mut parts);
    let stores: Vec<_> =
        parts.iter().enumerate().map(|(i, part)| format!("results[result + {i}u] = {part};")).collect();
    let harness = include_str!("call.wgsl")
        .replace("ARGUMENTS", &format!("{arguments}u"))
        .replace("RESULTS", &format!("{}u", parts.len()))
        .replace("CALL", &format!("{function}({})", built.join(", ")))
        .replace("STORE", &stores.join("\n    "));
    Call { source: format!("{prelude}{}{harness}", sliced(function, prelude)), arguments, results: parts.len() }
}

impl Gpu {
    /// Opens a GPU. Where there is none it prints so and returns `None`, or fails where one is required.
    pub(crate) fn open() -> Option<Gpu> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
        let adapter = match pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())) {
            Ok(adapter) => adapter,
            Err(error) => {
                assert!(!required("HALFVECTOR_REQUIRE_GPU"), "a GPU is required: {error}");
                println!("skipped: no GPU ({error})");
                return None;
            }
        };
        let info = adapter.get_info();
        let has_f64 = adapter.features().contains(wgpu::Features::SHADER_F64);
        let has_f16 = adapter.features().contains(wgpu::Features::SHADER_F16);
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & (wgpu::Features::SHADER_F64 | wgpu::Features::SHADER_F16),
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("the GPU opens");
        Some(Gpu { device, queue, name: format!("{} ({})", info.name, info.backend), has_f64, has_f16 })
    }

    /// Calls a function of the library once for each row of `arguments` (row after row, without gaps) and returns the
    /// numbers of its results, row after row, with how many numbers a row of each has.
    pub(crate) fn call<N: Number>(&self, module: &Module, function: &str, arguments: &[f32]) -> Results {
        let call = call_of(module, function, N::PRELUDE);
        let rows = arguments.len() / call.arguments;
        assert_eq!(rows * call.arguments, arguments.len(), "`{function}` takes {} numbers", call.arguments);
        let input: Vec<N> = arguments.iter().map(|x| N::from_f32(*x)).collect();
        let bytes = (rows * call.results * size_of::<N>()) as u64;
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let output = self.run(&call.source, bytemuck::cast_slice(&input), bytes, rows);
        if let Some(error) = pollster::block_on(scope.pop()) {
            panic!("`{function}`: {error}\n{}", call.source);
        }
        let values = bytemuck::pod_collect_to_vec::<u8, N>(&output).into_iter().map(N::to_f64).collect();
        Results { values, arguments: call.arguments, results: call.results }
    }

    /// Runs the entry point `call` of a shader with `input` at binding 0, `rows` times, and returns the bytes at binding 1.
    pub(crate) fn run(&self, source: &str, input: &[u8], output_bytes: u64, rows: usize) -> Vec<u8> {
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("call"),
            compilation_options: Default::default(),
            cache: None,
        });
        let arguments = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: input,
            usage: wgpu::BufferUsages::STORAGE,
        });
        let buffer = |usage| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: output_bytes,
                usage,
                mapped_at_creation: false,
            })
        };
        let results = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readable = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: arguments.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: results.as_entire_binding() },
            ],
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(rows.div_ceil(64) as u32, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&results, 0, &readable, 0, output_bytes);
        self.queue.submit([encoder.finish()]);
        readable.map_async(wgpu::MapMode::Read, .., |result| result.expect("the results can be read"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the GPU finishes");
        readable.get_mapped_range(..).expect("the results are mapped").to_vec()
    }
}

/// What a function returned.
pub(crate) struct Results {
    /// Row after row.
    pub(crate) values: Vec<f64>,
    /// Numbers that a call takes.
    pub(crate) arguments: usize,
    /// Numbers that a call returns.
    pub(crate) results: usize,
}
