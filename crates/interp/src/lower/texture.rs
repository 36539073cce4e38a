//! Reads of textures.

use naga::{Expression, Handle, ImageClass, ImageDimension, ImageQuery, SampleLevel, ScalarKind, TypeInner};

use super::{Frame, Lower, Regs, Result, Value};
use crate::ir::{Class, Dimension, Inst, NONE, Node, Op, Origin, Query, Reg, TextureRead};

impl<'m> Lower<'m> {
    /// The global that a texture or sampler expression names.
    fn handle(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Handle<naga::GlobalVariable>> {
        match self.value(frame, handle)? {
            Value::Handle(global) => Ok(global),
            _ => self.refuse("a texture that is not a global variable"),
        }
    }

    fn image(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<(u32, Dimension)> {
        let global = self.handle(frame, handle)?;
        let TypeInner::Image { dim, class, .. } = self.module.types[self.module.global_variables[global].ty].inner
        else {
            return self.refuse("a texture of an unknown type");
        };
        match class {
            ImageClass::Sampled { kind: ScalarKind::Float, multi: false } => {}
            ImageClass::Sampled { multi: true, .. } | ImageClass::Depth { multi: true } => {
                return self.refuse("a multisampled texture");
            }
            ImageClass::Sampled { .. } => return self.refuse("a texture of integers"),
            ImageClass::Depth { .. } => return self.refuse("a depth texture"),
            ImageClass::Storage { .. } => return self.refuse("a storage texture"),
            ImageClass::External => return self.refuse("an external texture"),
        }
        let dimension = match dim {
            ImageDimension::D1 => Dimension::One,
            ImageDimension::D2 => Dimension::Two,
            ImageDimension::D3 => Dimension::Three,
            ImageDimension::Cube => Dimension::Cube,
        };
        Ok((self.resource(global, |ir| &mut ir.textures)?, dimension))
    }

    pub(super) fn texture(&mut self, frame: &mut Frame<'m>, handle: Handle<Expression>) -> Result<Regs> {
        let three = |regs: &[Reg]| {
            let mut all = [NONE; 3];
            all[..regs.len()].copy_from_slice(regs);
            all
        };
        let mut read = TextureRead {
            texture: 0,
            sampler: 0,
            dimension: Dimension::Two,
            query: Query::Fetch,
            coordinate: [NONE; 3],
            layer: NONE,
            level: NONE,
            ddx: [NONE; 3],
            ddy: [NONE; 3],
            offset: [0; 3],
            clamp_to_edge: false,
            results: [NONE; 4],
        };
        let mut class = Class::Float;
        let mut results = 4;
        match &frame.function.expressions[handle] {
            Expression::ImageSample {
                image,
                sampler,
                gather,
                coordinate,
                array_index,
                offset,
                level,
                depth_ref,
                clamp_to_edge,
            } => {
                if depth_ref.is_some() {
                    return self.refuse("a comparison with a depth texture");
                }
                (read.texture, read.dimension) = self.image(frame, *image)?;
                let global = self.handle(frame, *sampler)?;
                read.sampler = self.resource(global, |ir| &mut ir.samplers)?;
                let regs = self.regs(frame, *coordinate)?;
                read.coordinate = three(&regs);
                if let Some(layer) = array_index {
                    read.layer = self.regs(frame, *layer)?[0];
                }
                if let Some(offset) = offset {
                    let regs = self.regs(frame, *offset)?;
                    for (to, reg) in read.offset.iter_mut().zip(regs.iter()) {
                        let Origin::Constant(word) = self.ir.registers[*reg as usize].origin else {
                            return self.refuse("a texture offset that is not constant");
                        };
                        *to = (word as u32).cast_signed();
                    }
                }
                read.clamp_to_edge = *clamp_to_edge;
                read.query = match level {
                    SampleLevel::Auto => Query::Auto,
                    SampleLevel::Zero => {
                        read.level = self.number(Class::Float, 0.0);
                        Query::Level
                    }
                    SampleLevel::Exact(level) => {
                        read.level = self.regs(frame, *level)?[0];
                        Query::Level
                    }
                    SampleLevel::Bias(bias) => {
                        read.level = self.regs(frame, *bias)?[0];
                        Query::Auto
                    }
                    SampleLevel::Gradient { x, y } => {
                        let (x, y) = (self.regs(frame, *x)?, self.regs(frame, *y)?);
                        (read.ddx, read.ddy) = (three(&x), three(&y));
                        Query::Gradient
                    }
                };
                if let Some(component) = gather {
                    read.query = Query::Gather(*component as u8);
                }
            }
            Expression::ImageLoad { image, coordinate, array_index, level, .. } => {
                (read.texture, read.dimension) = self.image(frame, *image)?;
                let regs = self.regs(frame, *coordinate)?;
                read.coordinate = three(&regs);
                if let Some(layer) = array_index {
                    read.layer = self.regs(frame, *layer)?[0];
                }
                if let Some(level) = level {
                    read.level = self.regs(frame, *level)?[0];
                }
            }
            Expression::ImageQuery { image, query } => {
                (read.texture, read.dimension) = self.image(frame, *image)?;
                class = Class::Bits;
                (read.query, results) = match query {
                    ImageQuery::Size { level } => {
                        if let Some(level) = level {
                            read.level = self.regs(frame, *level)?[0];
                        }
                        (Query::Size, if read.dimension == Dimension::Cube { 2 } else { read.dimension.components() })
                    }
                    ImageQuery::NumLevels => (Query::Levels, 1),
                    ImageQuery::NumLayers => (Query::Layers, 1),
                    ImageQuery::NumSamples => return self.refuse("a multisampled texture"),
                };
            }
            _ => return self.refuse("something that is no read of a texture"),
        }
        // A derivative is taken of the coordinates, so it knows how its lanes are arranged: an instruction of its own.
        // WGSL leaves open whose difference chooses the level; devices choose one level for each block of two by two.
        if read.query == Query::Auto {
            for i in 0..read.dimension.components() {
                let along = |vertical| Op::Derivative { vertical, coarse: true };
                read.ddx[i] = self.emit(along(false), Class::Float, [read.coordinate[i], NONE, NONE])?;
                read.ddy[i] = self.emit(along(true), Class::Float, [read.coordinate[i], NONE, NONE])?;
            }
        }
        for result in &mut read.results[..results] {
            *result = self.register(class, Origin::Temporary);
        }
        let regs = read.results[..results].into();
        self.ir.texture_reads.push(read);
        let op = Op::Texture((self.ir.texture_reads.len() - 1) as u32);
        self.push(Node::Inst(Inst { op, dst: NONE, a: NONE, b: NONE, c: NONE }))?;
        Ok(regs)
    }
}
