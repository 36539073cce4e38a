//! Runs flat code: registers, the mask of active lanes, control flow, batches.

mod file;
mod step;
mod texture;

use file::File;
use naga::ScalarKind;

use crate::code::{Code, SAME, Step};
use crate::error::RunError;
use crate::ir::{Class, NONE, Op, Resource};
use crate::kernel::{Block, LANES, Source};
use crate::program::{Program, Slot};
use crate::real::Float;
use crate::resource::{Column, Derivatives, Limits, Memory, OutputColumn, Outputs, Resources};
use crate::shape;
use crate::texture::{Sampler, Texture};

/// Registers of one batch, for one program. Running it allocates nothing but the outputs' columns.
#[derive(Debug)]
pub struct Machine<'p, F> {
    program: &'p Program,
    limits: Limits,
    arch: pulp::Arch,
    floats: File<F>,
    doubles: File<f64>,
    words: File<u32>,
    mask: Mask,
    slots: Vec<Block<u32>>,
    killed: Block<u32>,
    steps: u64,
}

/// Which lanes are active, and what is known of all of them.
#[derive(Debug)]
struct Mask {
    lanes: Box<Block<u32>>,
    all: bool,
    any: bool,
}

impl Mask {
    fn count(&mut self) {
        let (mut and, mut or) = (u32::MAX, 0);
        for lane in self.lanes.iter() {
            and &= lane;
            or |= lane;
        }
        (self.all, self.any) = (and != 0, or != 0);
    }

    fn fill(&mut self, value: u32) {
        self.lanes.fill(value);
        (self.all, self.any) = (value != 0, value != 0);
    }
}

/// What a run reads, found in the order of the program's lists.
struct Bound<'a> {
    buffers: Vec<Memory<'a>>,
    textures: Vec<&'a Texture>,
    samplers: Vec<Sampler>,
    quads: bool,
    writers: Writers,
}

/// Which lanes of a batch are invocations: others repeat the last one or help with derivatives, and write no buffers.
#[derive(Clone, Copy, Debug)]
struct Writers {
    count: usize,
    spread: usize,
}

fn missing(resource: &Resource, reason: &'static str) -> RunError {
    let Resource { name, group, binding } = resource.clone();
    RunError::Resource { name, group, binding, reason }
}

impl<'p, F: Float> Machine<'p, F> {
    pub(crate) fn new(program: &'p Program, limits: Limits) -> Result<Self, RunError> {
        let [floats, doubles, words] = &program.files;
        let lanes = LANES as u64;
        let bytes = |blocks: u32, size: usize| u64::from(blocks) * lanes * size as u64;
        let needed = bytes(floats.blocks, size_of::<F>())
            + bytes(doubles.blocks, 8)
            + bytes(words.blocks + program.slots, 4)
            + program.files.iter().map(|f| f.same.len() as u64 * 8).sum::<u64>();
        if needed > limits.bytes {
            return Err(RunError::Memory { needed, limit: limits.bytes });
        }
        Ok(Machine {
            program,
            limits,
            arch: pulp::Arch::new(),
            floats: File::new(floats, |bits| F::from_f64(f64::from_bits(bits))),
            doubles: File::new(doubles, f64::from_bits),
            words: File::new(words, |bits| bits as u32),
            mask: Mask { lanes: Box::new([u32::MAX; LANES]), all: true, any: true },
            slots: vec![[0; LANES]; program.slots as usize],
            killed: [0; LANES],
            steps: 0,
        })
    }

    /// Runs the program for `lanes` invocations; see [`Program::run`].
    ///
    /// # Errors
    /// The same.
    pub fn run(
        &mut self,
        inputs: &[Column<'_, F>],
        lanes: usize,
        outputs: &mut Outputs<F>,
        resources: &Resources<'_>,
        derivatives: Derivatives<'_, F>,
    ) -> Result<(), RunError> {
        let program = self.program;
        check_columns(program.inputs(), inputs, lanes)?;
        let given = match derivatives {
            Derivatives::Given { ddx, ddy } => {
                check_columns(program.inputs(), ddx, lanes)?;
                check_columns(program.inputs(), ddy, lanes)?;
                program.uses_derivatives().then_some((ddx, ddy))
            }
            Derivatives::Zero | Derivatives::Quads => None,
        };
        let mut bound = self.bind(resources, !matches!(derivatives, Derivatives::Zero))?;
        prepare(program.outputs(), outputs, lanes);
        let spread = if given.is_some() { 4 } else { 1 };
        let per_batch = LANES / spread;
        let mut first = 0;
        while first < lanes {
            for (i, column) in inputs.iter().enumerate() {
                self.fill(i, *column, first, spread);
                if let Some((ddx, ddy)) = given {
                    self.shift(i, ddx[i], first, |lane| lane % 2 == 1);
                    self.shift(i, ddy[i], first, |lane| lane % 4 >= 2);
                }
            }
            let count = per_batch.min(lanes - first);
            bound.writers = Writers { count, spread };
            self.batch(&bound)?;
            self.drain(outputs, count, spread);
            first += count;
        }
        Ok(())
    }

    fn bind<'a>(&self, resources: &Resources<'a>, quads: bool) -> Result<Bound<'a>, RunError> {
        let at = |r: &Resource| (r.group, r.binding);
        let program = self.program;
        let buffers = program
            .buffers
            .iter()
            .map(|r| resources.find_buffer(at(r)).ok_or_else(|| missing(r, "is not given: add a buffer")));
        let textures = program
            .textures
            .iter()
            .map(|r| resources.find_texture(at(r)).ok_or_else(|| missing(r, "is not given: add a texture")));
        let samplers = program
            .samplers
            .iter()
            .map(|r| resources.find_sampler(at(r)).ok_or_else(|| missing(r, "is not given: add a sampler")));
        let bound = Bound {
            buffers: buffers.collect::<Result<_, _>>()?,
            textures: textures.collect::<Result<Vec<_>, _>>()?,
            samplers: samplers.collect::<Result<_, _>>()?,
            quads,
            writers: Writers { count: 0, spread: 1 },
        };
        for code in &program.code {
            if let Code::Step(Step { op: Op::Store(access), .. }) = code {
                let buffer = program.accesses[*access as usize].buffer as usize;
                if let Memory::Bytes(_) = bound.buffers[buffer] {
                    return Err(missing(&program.buffers[buffer], "is written: add it as storage, not as a buffer"));
                }
            }
        }
        for read in &program.texture_reads {
            if !bound.textures[read.texture as usize].fits(read.dimension) {
                let resource = &program.textures[read.texture as usize];
                return Err(missing(resource, "has other dimensions than the shader declares"));
            }
        }
        Ok(bound)
    }

    /// Copies one input's numbers of a batch into its register; lanes beyond the last invocation repeat that.
    fn fill(&mut self, index: usize, column: Column<'_, F>, first: usize, spread: usize) {
        let place = self.program.input_places[index];
        if place == NONE {
            return;
        }
        let bool = self.program.inputs()[index].scalar.kind == ScalarKind::Bool;
        match column {
            Column::Float(all) => spread_out(self.floats.block_mut(place), all, first, spread, |x| x),
            Column::Double(all) => spread_out(self.doubles.block_mut(place), all, first, spread, |x| x),
            Column::Word(all) if bool => {
                spread_out(self.words.block_mut(place), all, first, spread, |x| if x == 0 { 0 } else { u32::MAX });
            }
            Column::Word(all) => spread_out(self.words.block_mut(place), all, first, spread, |x| x),
        }
    }

    /// Moves an input of some lanes by its change to the next pixel.
    fn shift(&mut self, index: usize, column: Column<'_, F>, first: usize, moves: fn(usize) -> bool) {
        let place = self.program.input_places[index];
        if place == NONE {
            return;
        }
        let row = |lane: usize, len: usize| (first + lane / 4).min(len - 1);
        match column {
            Column::Float(all) => {
                let block = self.floats.block_mut(place);
                for lane in (0..LANES).filter(|l| moves(*l)) {
                    block[lane] = block[lane] + all[row(lane, all.len())];
                }
            }
            Column::Double(all) => {
                let block = self.doubles.block_mut(place);
                for lane in (0..LANES).filter(|l| moves(*l)) {
                    block[lane] += all[row(lane, all.len())];
                }
            }
            Column::Word(_) => {}
        }
    }

    fn drain(&self, outputs: &mut Outputs<F>, count: usize, spread: usize) {
        outputs.killed.extend((0..count).map(|i| self.killed[i * spread] != 0));
        for (index, column) in outputs.columns.iter_mut().enumerate() {
            let place = self.program.output_places[index];
            let bool = self.program.outputs()[index].scalar.kind == ScalarKind::Bool;
            match column {
                OutputColumn::Float(all) => take(all, self.floats.source(place), count, spread, |x| x),
                OutputColumn::Double(all) => take(all, self.doubles.source(place), count, spread, |x| x),
                OutputColumn::Word(all) if bool => take(all, self.words.source(place), count, spread, |x| x & 1),
                OutputColumn::Word(all) => take(all, self.words.source(place), count, spread, |x| x),
            }
        }
    }

    /// Runs one batch whose inputs stand in their registers.
    fn batch(&mut self, bound: &Bound<'_>) -> Result<(), RunError> {
        self.mask.fill(u32::MAX);
        self.killed.fill(0);
        self.steps = 0;
        let code: &'p [Code] = &self.program.code;
        let mut at = 0_usize;
        while let Some(step) = code.get(at) {
            at += 1;
            match *step {
                Code::Step(step) => self.step(&step, bound),
                Code::Jump { to } => at = to as usize,
                Code::JumpIf { condition, wanted, to } => {
                    if (self.words.same[(condition & !SAME) as usize] != 0) == wanted {
                        at = to as usize;
                    }
                }
                Code::Split { condition, slot, to } => {
                    let condition = self.words.block(condition);
                    let kept = &mut self.slots[slot as usize];
                    for i in 0..LANES {
                        let active = self.mask.lanes[i];
                        kept[i] = active & !condition[i];
                        self.mask.lanes[i] = active & condition[i];
                    }
                    self.mask.count();
                    if !self.mask.any {
                        at = to as usize;
                    }
                }
                Code::Other { slot, to } => {
                    std::mem::swap(&mut *self.mask.lanes, &mut self.slots[slot as usize]);
                    self.mask.count();
                    if !self.mask.any {
                        at = to as usize;
                    }
                }
                Code::Join { slot } => self.join(slot),
                Code::Rejoin { slot, to } => {
                    self.join(slot);
                    self.slots[slot as usize].fill(0);
                    if !self.mask.any {
                        at = to as usize;
                    }
                }
                Code::Clear { slot } => self.slots[slot as usize].fill(0),
                Code::Leave { slot } => {
                    add(&mut self.slots[slot as usize], &self.mask.lanes);
                    self.mask.fill(0);
                }
                Code::LeaveIf { condition, slot } => {
                    let condition = self.words.block(condition);
                    let left = &mut self.slots[slot as usize];
                    for i in 0..LANES {
                        left[i] |= self.mask.lanes[i] & condition[i];
                        self.mask.lanes[i] &= !condition[i];
                    }
                    self.mask.count();
                }
                Code::JumpIfNone { to } => {
                    if !self.mask.any {
                        at = to as usize;
                    }
                }
                Code::Again { to, site } => {
                    if self.mask.any {
                        self.steps += at as u64 - u64::from(to);
                        if self.steps > self.limits.steps {
                            let place = self.program.sites[site as usize].clone();
                            return Err(RunError::Steps { limit: self.limits.steps, place });
                        }
                        at = to as usize;
                    }
                }
                Code::Kill => {
                    add(&mut self.killed, &self.mask.lanes);
                    self.mask.fill(0);
                }
            }
        }
        Ok(())
    }

    fn join(&mut self, slot: u32) {
        add(&mut self.mask.lanes, &self.slots[slot as usize]);
        self.mask.count();
    }
}

/// The union of two masks.
fn add(to: &mut Block<u32>, from: &Block<u32>) {
    for (to, from) in to.iter_mut().zip(from) {
        *to |= from;
    }
}

fn spread_out<T: Copy>(block: &mut Block<T>, all: &[T], first: usize, spread: usize, f: impl Fn(T) -> T) {
    match all {
        [one] => block.fill(f(*one)),
        // A whole batch in order: one copy.
        _ if spread == 1 && first + LANES <= all.len() => {
            for (to, from) in block.iter_mut().zip(&all[first..]) {
                *to = f(*from);
            }
        }
        _ => {
            let last = all.len() - 1;
            for (lane, to) in block.iter_mut().enumerate() {
                *to = f(all[(first + lane / spread).min(last)]);
            }
        }
    }
}

fn take<T: Copy>(all: &mut Vec<T>, source: Source<'_, T>, count: usize, spread: usize, f: impl Fn(T) -> T) {
    match source {
        Source::Each(block) => all.extend(block.iter().step_by(spread).take(count).map(|x| f(*x))),
        Source::Same(x) => all.extend(std::iter::repeat_n(f(x), count)),
    }
}

fn check_columns<F>(slots: &[Slot], columns: &[Column<'_, F>], lanes: usize) -> Result<(), RunError> {
    for (index, slot) in slots.iter().enumerate() {
        let fail = |reason| Err(RunError::Input { index, name: slot.name.clone(), reason });
        let (class, len) = match columns.get(index) {
            None => return fail("has no column"),
            Some(Column::Float(all)) => (Class::Float, all.len()),
            Some(Column::Double(all)) => (Class::Double, all.len()),
            Some(Column::Word(all)) => (Class::Bits, all.len()),
        };
        if shape::class_of(slot.scalar) != Ok(class) {
            return fail("has a column of another type");
        }
        if len != 1 && len < lanes || len == 0 {
            return fail("has fewer numbers than there are invocations");
        }
    }
    Ok(())
}

/// Empties the columns of the last run, or makes those that fit.
fn prepare<F: Float>(slots: &[Slot], outputs: &mut Outputs<F>, lanes: usize) {
    outputs.killed.clear();
    outputs.columns.truncate(slots.len());
    for (index, slot) in slots.iter().enumerate() {
        let class = shape::class_of(slot.scalar).unwrap_or(Class::Bits);
        match (outputs.columns.get_mut(index), class) {
            (Some(OutputColumn::Float(all)), Class::Float) => all.clear(),
            (Some(OutputColumn::Double(all)), Class::Double) => all.clear(),
            (Some(OutputColumn::Word(all)), Class::Bits) => all.clear(),
            (old, _) => {
                let new = match class {
                    Class::Float => OutputColumn::Float(Vec::with_capacity(lanes)),
                    Class::Double => OutputColumn::Double(Vec::with_capacity(lanes)),
                    Class::Bits => OutputColumn::Word(Vec::with_capacity(lanes)),
                };
                match old {
                    Some(old) => *old = new,
                    None => outputs.columns.push(new),
                }
            }
        }
    }
}
