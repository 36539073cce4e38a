//! A compiled function: what goes in, what comes out, what it reads.

use naga::valid::ModuleInfo;
use naga::{Binding, Module, Scalar, ShaderStage, Type, TypeInner};

use crate::allocate::{FileSize, allocate};
use crate::code::Code;
use crate::error::{Place, RunError, Unsupported};
use crate::ir::{BufferAccess, Class, Ir, NONE, Op, Resource, TextureRead};
use crate::lower::Lower;
use crate::machine::Machine;
use crate::real::Float;
use crate::resource::{Column, Derivatives, Limits, Outputs, Resources};
use crate::watch::{self, Watch};
use crate::{emit, shape, simplify, uniform};

/// What of a module is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry<'a> {
    /// A function of this name.
    Function(&'a str),
    /// An entry point of this name, of any stage but those of meshes and rays.
    EntryPoint(&'a str),
}

/// One scalar of the arguments or of the result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The argument's name and the way to the scalar: `frame.normal.x`, `m.1.z`, `a[3]`. The result has no name of its own.
    pub name: String,
    /// What it is.
    pub scalar: Scalar,
    /// Of entry points: which location or built-in value it is part of.
    pub binding: Option<Binding>,
}

/// A function or entry point that is ready to run.
#[derive(Debug)]
pub struct Program {
    inputs: Vec<Slot>,
    outputs: Vec<Slot>,
    pub(crate) code: Vec<Code>,
    pub(crate) files: [FileSize; 3],
    pub(crate) input_places: Vec<u32>,
    pub(crate) output_places: Vec<u32>,
    pub(crate) tables: Vec<Vec<u32>>,
    pub(crate) accesses: Vec<BufferAccess>,
    pub(crate) texture_reads: Vec<TextureRead>,
    pub(crate) buffers: Vec<Resource>,
    pub(crate) textures: Vec<Resource>,
    pub(crate) samplers: Vec<Resource>,
    pub(crate) sites: Vec<Place>,
    pub(crate) slots: u32,
    derives: bool,
}

impl Program {
    /// Compiles one function of a validated module. `info` is what naga's validator said of it.
    ///
    /// # Errors
    /// What the interpreter does not do, by name and place, before anything runs.
    pub fn compile(module: &Module, info: &ModuleInfo, entry: Entry<'_>) -> Result<Program, Unsupported> {
        Program::made(module, info, entry, false).map(|(program, _)| program)
    }

    /// The same with further outputs behind the result's: the numbers by which the program decides and those at whose 0 it may
    /// have poles, in the order in which it computes them, at most 4096. Each is what it was when it was computed last, and
    /// NaN in invocations that did not.
    ///
    /// # Errors
    /// The same.
    pub fn compile_watched(
        module: &Module,
        info: &ModuleInfo,
        entry: Entry<'_>,
    ) -> Result<(Program, Vec<Watch>), Unsupported> {
        Program::made(module, info, entry, true)
    }

    fn made(
        module: &Module,
        info: &ModuleInfo,
        entry: Entry<'_>,
        is_watched: bool,
    ) -> Result<(Program, Vec<Watch>), Unsupported> {
        let (function, function_info, name) = match entry {
            Entry::Function(name) => {
                let found = module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(name));
                let (handle, function) =
                    found.ok_or_else(|| Unsupported::Missing { kind: "function", name: name.to_string() })?;
                (function, &info[handle], name)
            }
            Entry::EntryPoint(name) => {
                let found = module.entry_points.iter().position(|e| e.name == name);
                let index =
                    found.ok_or_else(|| Unsupported::Missing { kind: "entry point", name: name.to_string() })?;
                let entry = &module.entry_points[index];
                if !matches!(entry.stage, ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute) {
                    let place = Place { function: name.to_string(), span: None };
                    return Err(Unsupported::feature("a stage of ray tracing or of mesh shaders".into(), place));
                }
                (&entry.function, info.get_entry_point(index), name)
            }
        };
        let mut lower = Lower::new(module, info);
        lower.program(function, function_info, name)?;
        let mut ir = lower.ir;
        let mut inputs = Vec::new();
        for argument in &function.arguments {
            let name = argument.name.clone().unwrap_or_default();
            slots(module, &module.types[argument.ty], name, argument.binding.as_ref(), &mut inputs);
        }
        let mut outputs = Vec::new();
        if let Some(result) = &function.result {
            slots(module, &module.types[result.ty], String::new(), result.binding.as_ref(), &mut outputs);
        }
        simplify::simplify(&mut ir);
        let result = ir.outputs.len();
        let watches = if is_watched { watch::watch(&mut ir) } else { Vec::new() };
        for (number, reg) in ir.outputs[result..].iter().enumerate() {
            let scalar = if ir.registers[*reg as usize].class == Class::Double { Scalar::F64 } else { Scalar::F32 };
            outputs.push(Slot { name: format!("watch[{number}]"), scalar, binding: None });
        }
        let varying = uniform::varying_registers(&mut ir);
        let mut flat = emit::flatten(&ir, &varying);
        let allocation = allocate(&ir, &mut flat, &varying);
        let place = |reg: u32| if reg == NONE { NONE } else { allocation.places[reg as usize] };
        let mut texture_reads = ir.texture_reads.clone();
        for read in &mut texture_reads {
            let registers = read.coordinate.iter_mut().chain([&mut read.layer, &mut read.level]);
            for reg in registers.chain(&mut read.ddx).chain(&mut read.ddy).chain(&mut read.results) {
                *reg = place(*reg);
            }
        }
        // A table stands in the program as its registers' places; one that nothing reads any more may hold none.
        let tables = (0..ir.tables.len() as u32).map(|t| ir.table(t).iter().map(|r| place(*r)).collect()).collect();
        let derives = flat.code.iter().any(|c| matches!(c, Code::Step(s) if matches!(s.op, Op::Derivative { .. })));
        let Ir { accesses, buffers, textures, samplers, sites, .. } = ir;
        let program = Program {
            inputs,
            outputs,
            input_places: ir.inputs.iter().map(|r| place(*r)).collect(),
            output_places: ir.outputs.iter().map(|r| place(*r)).collect(),
            code: flat.code,
            files: allocation.files,
            tables,
            accesses,
            texture_reads,
            buffers,
            textures,
            samplers,
            sites,
            slots: flat.slots,
            derives,
        };
        Ok((program, watches))
    }

    /// The scalars of the arguments, in order: one input column each.
    pub fn inputs(&self) -> &[Slot] {
        &self.inputs
    }

    /// The scalars of the result, in order: one output column each.
    pub fn outputs(&self) -> &[Slot] {
        &self.outputs
    }

    /// Whether it takes derivatives, itself or for the level of a texture.
    pub fn uses_derivatives(&self) -> bool {
        self.derives
    }

    /// Whether it may discard invocations.
    pub fn discards(&self) -> bool {
        self.code.iter().any(|code| matches!(code, Code::Kill))
    }

    /// Steps of the program: each is one instruction for a whole batch.
    pub fn steps(&self) -> usize {
        self.code.len()
    }

    /// A machine for this program: keep one per thread, its registers are allocated once.
    ///
    /// # Errors
    /// [`RunError::Memory`] where the registers of one batch are over the limit.
    pub fn machine<F: Float>(&self, limits: Limits) -> Result<Machine<'_, F>, RunError> {
        Machine::new(self, limits)
    }

    /// Runs the program for `lanes` invocations. Each input column has that many numbers, or one for all.
    ///
    /// # Errors
    /// Columns or resources that do not fit, and programs that pass the limits.
    pub fn run<F: Float>(
        &self,
        inputs: &[Column<'_, F>],
        lanes: usize,
        outputs: &mut Outputs<F>,
        resources: &Resources<'_>,
        derivatives: Derivatives<'_, F>,
        limits: Limits,
    ) -> Result<(), RunError> {
        self.machine(limits)?.run(inputs, lanes, outputs, resources, derivatives)
    }
}

/// Names the scalars of a value.
fn slots(module: &Module, ty: &Type, name: String, binding: Option<&Binding>, out: &mut Vec<Slot>) {
    let mut leaf = |name: String, scalar: Scalar| out.push(Slot { name, scalar, binding: binding.cloned() });
    let dotted = |part: &str| if name.is_empty() { part.to_string() } else { format!("{name}.{part}") };
    match &ty.inner {
        TypeInner::Vector { size, scalar } => {
            for part in ["x", "y", "z", "w"].iter().take(*size as usize) {
                leaf(dotted(part), *scalar);
            }
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            for column in 0..*columns as usize {
                for part in ["x", "y", "z", "w"].iter().take(*rows as usize) {
                    leaf(dotted(&format!("{column}.{part}")), *scalar);
                }
            }
        }
        TypeInner::Struct { members, .. } => {
            for member in members {
                let part = member.name.as_deref().unwrap_or("_");
                let binding = member.binding.as_ref().or(binding);
                slots(module, &module.types[member.ty], dotted(part), binding, out);
            }
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(n), .. } => {
            for i in 0..n.get() {
                slots(module, &module.types[*base], format!("{name}[{i}]"), binding, out);
            }
        }
        inner => {
            // Everything else has been refused.
            let mut scalars = Vec::new();
            if shape::scalars(module, inner, &mut scalars).is_ok() {
                scalars.into_iter().for_each(|scalar| leaf(name.clone(), scalar));
            }
        }
    }
}
