//! Texture instructions: one lane after the other, only those that are active.

use super::file::Place as _;
use super::{Bound, Machine};
use crate::ir::{NONE, Query, Reg, TextureRead};
use crate::kernel::{LANES, Source};
use crate::real::Float;
use crate::texture::Address;

impl<F: Float> Machine<'_, F> {
    pub(super) fn texture(&mut self, read: u32, bound: &Bound<'_>) {
        let program = self.program;
        let read = &program.texture_reads[read as usize];
        let measures = matches!(read.query, Query::Size | Query::Levels | Query::Layers);
        let same = read.results[0].same_in_all();
        let count = if same { 1 } else { LANES };
        let mut numbers = [[F::ZERO; LANES]; 4];
        let mut words = [[0_u32; LANES]; 4];
        for lane in (0..count).filter(|lane| same || self.mask.lanes[*lane] != 0) {
            if measures {
                let result = self.measure(read, bound, lane);
                (0..4).for_each(|i| words[i][lane] = result[i]);
            } else {
                let result = self.sample(read, bound, lane);
                (0..4).for_each(|i| numbers[i][lane] = result[i]);
            }
        }
        for (i, result) in read.results.iter().enumerate().filter(|(_, r)| **r != NONE) {
            match (measures, same) {
                (true, true) => self.words.same[result.index()] = words[i][0],
                (true, false) => *self.words.block_mut(*result) = words[i],
                (false, true) => self.floats.same[result.index()] = numbers[i][0],
                (false, false) => *self.floats.block_mut(*result) = numbers[i],
            }
        }
    }

    fn word(&self, reg: Reg, lane: usize) -> u32 {
        if reg == NONE { 0 } else { self.words.source(reg).lane(lane) }
    }

    fn vector(&self, regs: [Reg; 3], lane: usize) -> [F; 3] {
        regs.map(|reg| match self.floats.source(reg) {
            Source::Each(block) => block[lane],
            Source::Same(x) => x,
        })
    }

    fn measure(&self, read: &TextureRead, bound: &Bound<'_>, lane: usize) -> [u32; 4] {
        let texture = bound.textures[read.texture as usize];
        match read.query {
            Query::Levels => [texture.level_count(), 0, 0, 0],
            Query::Layers => [texture.array_layers(), 0, 0, 0],
            _ => {
                let [width, height, depth] = texture.size(self.word(read.level, lane));
                [width, height, depth, 0]
            }
        }
    }

    fn sample(&self, read: &TextureRead, bound: &Bound<'_>, lane: usize) -> [F; 4] {
        let texture = bound.textures[read.texture as usize];
        let layer = i64::from(self.word(read.layer, lane).cast_signed());
        if read.query == Query::Fetch {
            let mut at = [0; 3];
            for (to, reg) in at.iter_mut().zip(read.coordinate) {
                *to = i64::from(self.word(reg, lane).cast_signed());
            }
            let level = self.word(read.level, lane);
            return texture.fetch(at, layer, level).map(|x| F::from_f64(f64::from(x)));
        }
        let at = self.vector(read.coordinate, lane);
        let mut sampler = bound.samplers[read.sampler as usize];
        if read.clamp_to_edge {
            sampler.address = [Address::Clamp; 3];
        }
        let spot = texture.spot(at, layer);
        let level = if read.level == NONE { F::ZERO } else { self.floats.source(read.level).lane(lane) };
        match read.query {
            Query::Gather(component) => texture.gather(spot, component as usize, &sampler, read.offset),
            Query::Auto | Query::Gradient => {
                // Where there is one level and one filter the level does not matter.
                let own = if texture.level_count() == 1 && sampler.magnify == sampler.minify {
                    F::ZERO
                } else {
                    let [ddx, ddy] = [read.ddx, read.ddy].map(|regs| self.vector(regs, lane));
                    texture.level_of(at, ddx, ddy, sampler.level_rule)
                };
                texture.sample(spot, own + level, &sampler, read.offset)
            }
            _ => texture.sample(spot, level, &sampler, read.offset),
        }
    }
}
