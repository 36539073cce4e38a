//! The environment as rays see it: between texels as asked for, turned, and drawn where its light is. Directions are looked
//! up and drawn in blocks, by the widest instructions of the machine; the numbers are the same on all.

mod drawn;
mod texels;

use halfvector_ibl::environment::rotate_about_y;
use halfvector_ibl::{Cube, Equirect, LoadedEnvironment, Source};
use pulp::{Arch, Simd, WithSimd};

use crate::directions::{BLOCK, Directions, block};
use crate::elementary::whole;
use drawn::{Drawn, choice};
use texels::{Spot, Texels};

/// What an equirectangular map is between its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EnvironmentFilter {
    /// Bilinear; rows centred at v = (j + 1/2) / height, going on beyond the poles down the other side.
    #[default]
    Bilinear,
    /// Constant within each texel.
    Box,
    /// Bilinear with rows at v = j / (height - 1), the first and the last at the poles: as Mitsuba 3 reads its maps.
    VertexRows,
}

/// Light from all around.
pub(crate) struct Environment {
    /// The map; of a cube the map that directions are drawn by.
    texels: Texels,
    cube: Option<Cube>,
    /// None where the light is the same from everywhere.
    drawn: Option<Drawn>,
    /// (cos, sin) of the rotation.
    turned: [f64; 2],
    arch: Arch,
}

/// Lookups along each side of a texel of the map that directions are drawn by.
const LOOKUPS: usize = 3;

impl Environment {
    pub(crate) fn new(loaded: &LoadedEnvironment, filter: EnvironmentFilter, rotation_degrees: f32) -> Environment {
        let (sin, cos) = f64::from(rotation_degrees).to_radians().sin_cos();
        let (map, cube) = match &loaded.source {
            Source::Equirect(map) => (map.clone(), None),
            Source::Levels(levels) => {
                let cube = levels.levels[0].clone();
                (mean(4 * cube.size, 2 * cube.size, |dir| cube.sample(dir)), Some(cube))
            }
        };
        let filter = if cube.is_some() { EnvironmentFilter::Box } else { filter };
        let mut texels = Texels::new(&map, filter);
        let lights = cube.as_ref().map_or(&map.pixels, |cube| &cube.texels);
        let is_even = lights.iter().all(|texel| *texel == lights[0]);
        let drawn = (!is_even).then(|| {
            // The mean of the light within each texel: what directions are drawn by is never 0 where there is light.
            let (drawn, densities) = Drawn::new(&match filter {
                EnvironmentFilter::Box => map,
                _ => mean(map.width, map.height, |dir| {
                    let [r, g, b, _] = texels.read(texels.spot(dir));
                    [r, g, b].map(|x| x as f32)
                }),
            });
            texels.set_densities(&densities);
            drawn
        });
        Environment { texels, cube, drawn, turned: [cos, sin], arch: Arch::new() }
    }

    /// Whether directions are drawn: not where the light is the same from everywhere.
    pub(crate) fn draws(&self) -> bool {
        self.drawn.is_some()
    }

    /// Draws a unit direction in world space where there is light for each two numbers of 0..1, with its density [1/sr]. None
    /// where it does not [draw](Self::draws).
    pub(crate) fn draw(&self, u: &[Vec<f64>; 2], dirs: &mut Directions, densities: &mut Vec<f64>) {
        dirs.clear();
        densities.clear();
        if let Some(drawn) = &self.drawn {
            self.arch.dispatch(Draw { environment: self, drawn, u, dirs, densities });
        }
    }

    /// Radiance from each unit direction in world space and, as a fourth number, the density at which [`Self::draw`] draws it.
    pub(crate) fn look_up(&self, dirs: &Directions, lights: &mut Vec<[f64; 4]>) {
        lights.clear();
        self.arch.dispatch(LookUp { environment: self, dirs, lights });
        if let Some(cube) = &self.cube {
            for (number, light) in lights.iter_mut().enumerate() {
                let [r, g, b] = cube.sample(rotate_about_y(dirs.at(number), self.turned)).map(f64::from);
                *light = [r, g, b, light[3]];
            }
        }
    }
}

/// The mean of some light within each texel of a map.
fn mean(width: usize, height: usize, light: impl Fn([f64; 3]) -> [f32; 3] + Sync) -> Equirect {
    Equirect::from_fn(width * LOOKUPS, height * LOOKUPS, light).area_resampled(width, height)
}

/// The work of [`Environment::draw`].
struct Draw<'a> {
    environment: &'a Environment,
    drawn: &'a Drawn,
    u: &'a [Vec<f64>; 2],
    dirs: &'a mut Directions,
    densities: &'a mut Vec<f64>,
}

impl WithSimd for Draw<'_> {
    type Output = ();

    /// Loops that compute and loops that fetch, in turns.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Draw { environment, drawn, u: [us, vs], dirs, densities } = self;
        let [cos, sin] = environment.turned;
        let mut first = 0;
        while first < us.len() {
            let (u, v) = (block(us, first), block(vs, first));
            let (mut slot, mut share, mut rest, mut texel) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
            let (mut column, mut row, mut upper, mut step) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
            let (mut found, mut made) = ([0.0; BLOCK], [[0.0; BLOCK]; 3]);
            for i in 0..BLOCK {
                (slot[i], rest[i]) = drawn.slot(u[i]);
            }
            for i in 0..BLOCK {
                (share[i], texel[i]) = drawn.share(whole(slot[i]));
            }
            for i in 0..BLOCK {
                (texel[i], rest[i]) = choice(slot[i], rest[i], share[i], texel[i]);
                (column[i], row[i]) = drawn.place(texel[i]);
            }
            for i in 0..BLOCK {
                (upper[i], step[i]) = drawn.row(whole(row[i]));
                found[i] = environment.texels.density(environment.texels.index(column[i], row[i]));
            }
            for i in 0..BLOCK {
                let dir = drawn.direction(column[i] + rest[i], upper[i] + step[i] * v[i]);
                [made[0][i], made[1][i], made[2][i]] = rotate_about_y(dir, [cos, -sin]);
            }
            let count = BLOCK.min(us.len() - first);
            dirs.extend(&made, count);
            densities.extend_from_slice(&found[..count]);
            first += BLOCK;
        }
    }
}

/// The work of [`Environment::look_up`].
struct LookUp<'a> {
    environment: &'a Environment,
    dirs: &'a Directions,
    lights: &'a mut Vec<[f64; 4]>,
}

impl WithSimd for LookUp<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let LookUp { environment, dirs, lights } = self;
        let mut first = 0;
        while first < dirs.len() {
            let [x, y, z] = dirs.block(first);
            let (mut index, mut cell, mut s, mut t) = ([0; BLOCK], [0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
            for i in 0..BLOCK {
                let dir = rotate_about_y([x[i], y[i], z[i]], environment.turned);
                Spot { index: index[i], cell: cell[i], s: s[i], t: t[i] } = environment.texels.spot(dir);
            }
            let count = BLOCK.min(dirs.len() - first);
            let spot = |i: usize| Spot { index: index[i], cell: cell[i], s: s[i], t: t[i] };
            lights.extend((0..count).map(|i| environment.texels.read(spot(i))));
            first += BLOCK;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn map() -> LoadedEnvironment {
        let mut pixels: Vec<[f32; 3]> = (0..16 * 8).map(|i| [(i % 5) as f32, (i % 3) as f32 * 0.5, 0.1]).collect();
        pixels[37] = [400.0, 300.0, 200.0];
        pixels[3] = [0.0; 3];
        Equirect { width: 16, height: 8, pixels }.into()
    }

    fn looked_up(environment: &Environment, dirs: &[[f64; 3]]) -> Vec<[f64; 4]> {
        let (mut all, mut lights) = (Directions::default(), Vec::new());
        dirs.iter().for_each(|dir| all.push(*dir));
        environment.look_up(&all, &mut lights);
        lights
    }

    /// Drawing by importance gives the same mean as drawing evenly, for every filter and rotation.
    #[test]
    fn the_mean_is_that_of_the_map() {
        for filter in [EnvironmentFilter::Bilinear, EnvironmentFilter::Box, EnvironmentFilter::VertexRows] {
            let environment = Environment::new(&map(), filter, 33.0);
            let n = 40_000;
            let mut random = Random::new(1, 0, 0);
            let u = [0, 1].map(|_| (0..n).map(|_| random.number()).collect::<Vec<f64>>());
            let (mut dirs, mut densities) = (Directions::default(), Vec::new());
            environment.draw(&u, &mut dirs, &mut densities);
            let dirs: Vec<[f64; 3]> = (0..n).map(|i| dirs.at(i)).collect();
            let mut drawn = 0.0;
            for (light, density) in looked_up(&environment, &dirs).iter().zip(&densities) {
                assert!((light[3] / density - 1.0).abs() < 1e-9);
                drawn += light[0] / density / n as f64;
            }
            let even: Vec<[f64; 3]> = (0..n)
                .map(|_| {
                    let [u, v] = random.pair();
                    let (z, phi) = (1.0 - 2.0 * u, 2.0 * std::f64::consts::PI * v);
                    let s = (1.0 - z * z).sqrt();
                    [s * phi.cos(), z, s * phi.sin()]
                })
                .collect();
            let (mut mean, mut square, mut density) = (0.0, 0.0, 0.0);
            for light in looked_up(&environment, &even) {
                let [x, of_dir] = [light[0], light[3]].map(|x| x * 4.0 * std::f64::consts::PI);
                mean += x / n as f64;
                square += x * x / n as f64;
                density += of_dir / n as f64;
            }
            let error = ((square - mean * mean) / n as f64).sqrt();
            assert!((drawn - mean).abs() < 4.0 * error, "{filter:?}: {drawn} {mean} {error}");
            assert!((density - 1.0).abs() < 0.2, "{filter:?}: {density}");
        }
    }

    #[test]
    fn rows_stand_where_the_filter_says() {
        let rows = Equirect { width: 1, height: 3, pixels: vec![[0.0; 3], [1.0; 3], [4.0; 3]] };
        let at = |filter, v: f64| {
            let (sin, cos) = (std::f64::consts::PI * v).sin_cos();
            looked_up(&Environment::new(&rows.clone().into(), filter, 0.0), &[[sin, cos, 0.0]])[0][0]
        };
        assert!((at(EnvironmentFilter::VertexRows, 0.25) - 0.5).abs() < 1e-12);
        assert!((at(EnvironmentFilter::VertexRows, 1.0) - 4.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Bilinear, 0.5) - 1.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Bilinear, 1.0) - 4.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Box, 0.9) - 4.0).abs() < 1e-12);
    }

    /// What is between texels is the same as the map's own lookup, seam and poles included.
    #[test]
    fn as_the_map_looks_up() {
        let loaded = map();
        let Source::Equirect(equirect) = &loaded.source else { unreachable!("a map") };
        let environment = Environment::new(&loaded, EnvironmentFilter::Bilinear, 0.0);
        let mut random = Random::new(2, 0, 0);
        let mut dirs: Vec<[f64; 3]> = (0..500).map(|_| [0; 3].map(|_| random.number() - 0.5)).collect();
        dirs.extend([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, 0.0, -1e-9], [-1.0, 1e3, 1e-9]]);
        for (dir, light) in dirs.iter().zip(looked_up(&environment, &dirs)) {
            let there = equirect.sample(*dir);
            assert!((0..3).all(|i| (light[i] - f64::from(there[i])).abs() < 1e-4), "{dir:?}: {light:?} {there:?}");
        }
    }
}
