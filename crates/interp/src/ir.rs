//! The program between naga's module and the flat code: instructions on scalar registers without limit, in a tree of
//! structured control flow. Vectors, matrices, structs and arrays are gone: each of their scalars has its register, so
//! that taking them apart and together costs nothing when the program runs.

use crate::error::Place;
use crate::kernel::{BitsOp, CompareOp, Convert, FloatOp};

/// A register: an index into [`Ir::registers`].
pub(crate) type Reg = u32;

/// No operand.
pub(crate) const NONE: Reg = Reg::MAX;

/// Which of the machine's files a register lives in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Class {
    /// f32 of the shader, in the scalar of the run.
    Float,
    /// f64 of the shader.
    Double,
    /// i32, u32 and bool.
    Bits,
}

/// What a register holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Origin {
    /// A value, written once.
    Temporary,
    /// A number: bits of an f64 for floats, the word otherwise.
    Constant(u64),
    /// A variable of this scope.
    Variable(u32),
    /// A column of the inputs.
    Input,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Register {
    pub(crate) class: Class,
    pub(crate) origin: Origin,
}

/// What an instruction does with `a`, `b` and `c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    Float(FloatOp),
    /// Compares floats of the class of `a`.
    Compare(CompareOp),
    Bits(BitsOp),
    /// `b` where the mask `a` is set, else `c`.
    Select,
    /// Copies `a`; into a variable, only in active lanes.
    Move,
    /// `narrow` where the operand is an f32 of the shader.
    Convert(Convert),
    /// Exponent of frexp, a word.
    Exponent,
    /// `a` times two to the power of the word `b`.
    Scale,
    /// The register of a table that the index `a` names.
    Gather(u32),
    /// Writes `b` into the register of a table that the index `a` names, in active lanes.
    Scatter(u32),
    /// Reads a buffer at the byte offset `a` (or at a fixed one).
    Load(u32),
    /// Writes `b` into a buffer at the byte offset `a` (or at a fixed one), in active lanes.
    Store(u32),
    /// Elements of the runtime-sized array at the end of a buffer.
    Length(u32),
    /// Difference to the neighbour to the right (x) or below (y).
    Derivative {
        vertical: bool,
        /// The same for the whole block of two by two: of its first row, or of its first column.
        coarse: bool,
    },
    /// Samples, loads or measures a texture.
    Texture(u32),
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Inst {
    pub(crate) op: Op,
    pub(crate) dst: Reg,
    pub(crate) a: Reg,
    pub(crate) b: Reg,
    pub(crate) c: Reg,
}

/// A window of a list of registers, picked from by index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Table {
    pub(crate) pool: u32,
    pub(crate) start: u32,
    pub(crate) len: u32,
}

/// One scalar of a buffer that is read or written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BufferAccess {
    /// Index into [`Ir::buffers`].
    pub(crate) buffer: u32,
    /// Bytes that are added to the address.
    pub(crate) offset: u32,
    /// For [`Op::Length`]: bytes of an element.
    pub(crate) stride: u32,
}

/// A global that the caller brings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Resource {
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) binding: u32,
}

/// What a texture instruction asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    /// Filtered, at the level of the derivatives times 2^bias (`level` holds the bias, or NONE).
    Auto,
    /// Filtered, at `level`.
    Level,
    /// Filtered, at the level of the given derivatives.
    Gradient,
    /// One component (by number) of the four texels that a linear filter would read.
    Gather(u8),
    /// One texel; coordinates are words.
    Fetch,
    /// Width, height, depth of `level`.
    Size,
    /// Levels.
    Levels,
    /// Layers.
    Layers,
}

/// The shape of a texture's coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dimension {
    One,
    Two,
    Three,
    Cube,
}

impl Dimension {
    /// Components of a coordinate.
    pub(crate) fn components(self) -> usize {
        match self {
            Dimension::One => 1,
            Dimension::Two => 2,
            Dimension::Three | Dimension::Cube => 3,
        }
    }
}

/// Everything about one texture instruction. Unused registers are NONE.
#[derive(Clone, Debug)]
pub(crate) struct TextureRead {
    /// Index into [`Ir::textures`].
    pub(crate) texture: u32,
    /// Index into [`Ir::samplers`].
    pub(crate) sampler: u32,
    pub(crate) dimension: Dimension,
    pub(crate) query: Query,
    pub(crate) coordinate: [Reg; 3],
    pub(crate) layer: Reg,
    pub(crate) level: Reg,
    pub(crate) ddx: [Reg; 3],
    pub(crate) ddy: [Reg; 3],
    /// In texels, fixed when the shader was written.
    pub(crate) offset: [i32; 3],
    /// textureSampleBaseClampToEdge.
    pub(crate) clamp_to_edge: bool,
    pub(crate) results: [Reg; 4],
}

impl TextureRead {
    pub(crate) fn sources(&self) -> impl Iterator<Item = Reg> {
        let all = self.coordinate.into_iter().chain([self.layer, self.level]).chain(self.ddx).chain(self.ddy);
        all.filter(|r| *r != NONE)
    }

    pub(crate) fn destinations(&self) -> impl Iterator<Item = Reg> {
        self.results.into_iter().filter(|r| *r != NONE)
    }
}

/// Structured control flow. `divergent` is set by the analysis: the lanes may go apart here.
#[derive(Clone, Debug)]
pub(crate) enum Node {
    Inst(Inst),
    If {
        condition: Reg,
        accept: Vec<Node>,
        reject: Vec<Node>,
        divergent: bool,
    },
    Loop {
        body: Vec<Node>,
        continuing: Vec<Node>,
        break_if: Reg,
        site: u32,
        divergent: bool,
    },
    /// A switch, its cases lowered to conditions: where `Break` goes.
    Switch {
        body: Vec<Node>,
        divergent: bool,
    },
    /// The body of a function: where `Return` goes.
    Scope {
        id: u32,
        body: Vec<Node>,
        divergent: bool,
    },
    Break,
    Continue,
    Return,
    Kill,
}

/// A whole program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ir {
    pub(crate) registers: Vec<Register>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) pools: Vec<Vec<Reg>>,
    pub(crate) tables: Vec<Table>,
    pub(crate) accesses: Vec<BufferAccess>,
    pub(crate) texture_reads: Vec<TextureRead>,
    pub(crate) buffers: Vec<Resource>,
    pub(crate) textures: Vec<Resource>,
    pub(crate) samplers: Vec<Resource>,
    /// Where the loops stand.
    pub(crate) sites: Vec<Place>,
    pub(crate) inputs: Vec<Reg>,
    pub(crate) outputs: Vec<Reg>,
}

impl Ir {
    pub(crate) fn table(&self, table: u32) -> &[Reg] {
        let Table { pool, start, len } = self.tables[table as usize];
        &self.pools[pool as usize][start as usize..][..len as usize]
    }

    /// Calls `f` with every register that an instruction reads. A partial write also keeps what was there before, but
    /// that needs no mention: whoever reads it later does.
    pub(crate) fn sources(&self, inst: &Inst, mut f: impl FnMut(Reg)) {
        for r in [inst.a, inst.b, inst.c] {
            if r != NONE {
                f(r);
            }
        }
        match inst.op {
            Op::Gather(table) => self.table(table).iter().for_each(|r| f(*r)),
            Op::Texture(read) => self.texture_reads[read as usize].sources().for_each(f),
            _ => {}
        }
    }

    /// Calls `f` with every register that an instruction writes.
    pub(crate) fn destinations(&self, inst: &Inst, mut f: impl FnMut(Reg)) {
        if inst.dst != NONE {
            f(inst.dst);
        }
        match inst.op {
            Op::Scatter(table) => self.table(table).iter().for_each(|r| f(*r)),
            Op::Texture(read) => self.texture_reads[read as usize].destinations().for_each(f),
            _ => {}
        }
    }
}
