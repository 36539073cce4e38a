//! The environment as rays see it: between texels as asked for, turned, and drawn where its light is.

use halfvector_ibl::environment::rotate_about_y;
use halfvector_ibl::{
    Cube, EnvironmentSampler, Equirect, LoadedEnvironment, Source, equirect_from_direction, equirect_texel_solid_angle,
};

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
    map: Map,
    filter: EnvironmentFilter,
    /// None where the light is the same from everywhere.
    drawn: Option<Drawn>,
    /// (cos, sin) of the rotation.
    turned: [f64; 2],
}

/// How directions are drawn.
struct Drawn {
    sampler: EnvironmentSampler,
    /// Density of the texels of the map that they are drawn by [1/sr].
    densities: Vec<f64>,
    width: usize,
    height: usize,
}

enum Map {
    Equirect(Equirect),
    Cube(Cube),
}

/// Lookups along each side of a texel of the map that directions are drawn by.
const LOOKUPS: usize = 3;

impl Environment {
    pub(crate) fn new(loaded: &LoadedEnvironment, filter: EnvironmentFilter, rotation_degrees: f32) -> Environment {
        let (sin, cos) = f64::from(rotation_degrees).to_radians().sin_cos();
        let map = match &loaded.source {
            Source::Equirect(map) => Map::Equirect(map.clone()),
            Source::Levels(levels) => Map::Cube(levels.levels[0].clone()),
        };
        let mut environment = Environment { map, filter, drawn: None, turned: [cos, sin] };
        let (texels, width, height) = match &environment.map {
            Map::Equirect(map) => (&map.pixels, map.width, map.height),
            Map::Cube(cube) => (&cube.texels, 4 * cube.size, 2 * cube.size),
        };
        if texels.iter().any(|texel| *texel != texels[0]) {
            environment.drawn = Some(Drawn::new(environment.importance(width, height)));
        }
        environment
    }

    /// The mean of the light within each texel: what directions are drawn by is never 0 where there is light.
    fn importance(&self, width: usize, height: usize) -> Equirect {
        if let (Map::Equirect(map), EnvironmentFilter::Box) = (&self.map, self.filter) {
            return map.clone();
        }
        let fine = |dir: [f64; 3]| self.unturned(dir).map(|x| x as f32);
        Equirect::from_fn(width * LOOKUPS, height * LOOKUPS, fine).area_resampled(width, height)
    }

    /// Radiance from a unit direction in world space.
    pub(crate) fn radiance(&self, dir: [f64; 3]) -> [f64; 3] {
        self.unturned(rotate_about_y(dir, self.turned))
    }

    /// A unit direction in world space where there is light, and its density [1/sr]. None where it is not worth it: the light
    /// is the same from everywhere.
    pub(crate) fn sample(&self, u: [f64; 2]) -> Option<([f64; 3], f64)> {
        let sample = self.drawn.as_ref()?.sampler.sample(u);
        let [cos, sin] = self.turned;
        Some((rotate_about_y(sample.dir, [cos, -sin]), sample.pdf_solid_angle))
    }

    /// Radiance from a unit direction in world space, and the density at which [`Self::sample`] draws it: 0 where it draws
    /// none.
    pub(crate) fn light(&self, dir: [f64; 3]) -> ([f64; 3], f64) {
        let dir = rotate_about_y(dir, self.turned);
        let Some(drawn) = &self.drawn else { return (self.unturned(dir), 0.0) };
        let place = equirect_from_direction(dir);
        let radiance = match &self.map {
            Map::Equirect(map) => self.between(map, place),
            Map::Cube(cube) => cube.sample(dir).map(f64::from),
        };
        (radiance, drawn.densities[texel_at(place, drawn.width, drawn.height)])
    }

    /// Radiance from a direction in the map's own frame.
    fn unturned(&self, dir: [f64; 3]) -> [f64; 3] {
        match &self.map {
            Map::Equirect(map) => self.between(map, equirect_from_direction(dir)),
            Map::Cube(cube) => cube.sample(dir).map(f64::from),
        }
    }

    /// Radiance at a place (u, v) of a map, between its texels.
    fn between(&self, map: &Equirect, (u, v): (f64, f64)) -> [f64; 3] {
        let texel = |column: usize, row: usize| map.pixels[row * map.width + column];
        if self.filter == EnvironmentFilter::Box {
            return map.pixels[texel_at((u, v), map.width, map.height)].map(f64::from);
        }
        let x = u * map.width as f64 - 0.5;
        let y = match self.filter {
            EnvironmentFilter::VertexRows => v * (map.height - 1) as f64,
            _ => v * map.height as f64 - 0.5,
        };
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = (x - column, y - row);
        let at = |dx: isize, dy: isize| {
            let (column, row) = (column as isize + dx, row as isize + dy);
            let (width, height) = (map.width as isize, map.height as isize);
            // Over a pole and down the other side; rows at the poles are never passed.
            let (column, row) = match row {
                row if row < 0 => (column + width / 2, -1 - row),
                row if row >= height => (column + width / 2, 2 * height - 1 - row),
                row => (column, row),
            };
            texel(column.rem_euclid(width) as usize, row.clamp(0, height - 1) as usize)
        };
        let [a, b, c, d] = if self.filter == EnvironmentFilter::VertexRows && row as usize + 1 >= map.height {
            [at(0, 0), at(1, 0), at(0, 0), at(1, 0)]
        } else {
            [at(0, 0), at(1, 0), at(0, 1), at(1, 1)]
        };
        std::array::from_fn(|i| {
            let [a, b, c, d] = [a[i], b[i], c[i], d[i]].map(f64::from);
            let above = a + (b - a) * s;
            above + (c + (d - c) * s - above) * t
        })
    }
}

impl Drawn {
    fn new(map: Equirect) -> Drawn {
        let (width, height) = (map.width, map.height);
        let grey = |texel: &[f32; 3]| texel.iter().map(|x| f64::from(*x)).sum::<f64>();
        let total: f64 = map
            .pixels
            .chunks(width)
            .enumerate()
            .map(|(row, line)| equirect_texel_solid_angle(width, height, row) * line.iter().map(grey).sum::<f64>())
            .sum();
        // A map that differs from texel to texel is not black all over.
        let densities = map.pixels.iter().map(|texel| grey(texel) / total).collect();
        Drawn { sampler: EnvironmentSampler::new(map), densities, width, height }
    }
}

/// The number of the texel that a place (u, v) lies in.
fn texel_at((u, v): (f64, f64), width: usize, height: usize) -> usize {
    let place = |x: f64, count: usize| ((x * count as f64) as usize).min(count - 1);
    place(v, height) * width + place(u, width)
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

    /// Drawing by importance gives the same mean as drawing evenly, for every filter and rotation.
    #[test]
    fn the_mean_is_that_of_the_map() {
        for filter in [EnvironmentFilter::Bilinear, EnvironmentFilter::Box, EnvironmentFilter::VertexRows] {
            let environment = Environment::new(&map(), filter, 33.0);
            let n = 40_000;
            let (mut drawn, mut even, mut even2) = (0.0, 0.0, 0.0);
            for i in 0..n {
                let mut random = Random::new(1, i, 0);
                if let Some((dir, density)) = environment.sample(random.pair()) {
                    let (radiance, same) = environment.light(dir);
                    assert!((same / density - 1.0).abs() < 1e-9 && radiance == environment.radiance(dir));
                    drawn += environment.radiance(dir)[0] / density / f64::from(n as u32);
                }
                let [u, v] = random.pair();
                let (z, phi) = (1.0 - 2.0 * u, 2.0 * std::f64::consts::PI * v);
                let s = (1.0 - z * z).sqrt();
                let x = environment.radiance([s * phi.cos(), z, s * phi.sin()])[0] * 4.0 * std::f64::consts::PI;
                even += x / n as f64;
                even2 += x * x / n as f64;
            }
            let error = ((even2 - even * even) / n as f64).sqrt();
            assert!((drawn - even).abs() < 4.0 * error, "{filter:?}: {drawn} {even} {error}");
        }
    }

    #[test]
    fn rows_stand_where_the_filter_says() {
        let rows = Equirect { width: 1, height: 3, pixels: vec![[0.0; 3], [1.0; 3], [4.0; 3]] };
        let at = |filter, v: f64| {
            let (sin, cos) = (std::f64::consts::PI * v).sin_cos();
            Environment::new(&rows.clone().into(), filter, 0.0).radiance([sin, cos, 0.0])[0]
        };
        assert!((at(EnvironmentFilter::VertexRows, 0.25) - 0.5).abs() < 1e-12);
        assert!((at(EnvironmentFilter::VertexRows, 1.0) - 4.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Bilinear, 0.5) - 1.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Bilinear, 1.0) - 4.0).abs() < 1e-12);
        assert!((at(EnvironmentFilter::Box, 0.9) - 4.0).abs() < 1e-12);
    }
}
