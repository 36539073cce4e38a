//! The largest error over a domain: points that are drawn, and from the worst of them a search. A largest error of drawn points alone is
//! as large as chance has it.
//!
//! The search draws around a start, moves to what errs more, and draws ever nearer (Solis and Wets 1981, "Minimization by Random
//! Search Techniques"). It needs no slope, which errors that come of rounding or of the edges of texels do not have.

use crate::error::Errors;

/// Around a start it is drawn this often in a round, for each dimension.
const TRIES: usize = 8;

/// Rounds of a start.
const ROUNDS: usize = 14;

/// Each round draws from a box so much smaller than the one before.
const NARROWER: f64 = 0.65;

/// So many of the worst that were found are searched around once more, from a box so much smaller than the first.
const ONCE_MORE: (usize, f64) = (3, 0.1);

/// A place in the unit cube, and the error there.
pub(crate) type Place<const N: usize> = ([f64; N], f64);

/// How much is searched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search {
    /// Places that are searched around, no two of them near each other.
    pub(crate) starts: usize,
    /// Rounds around each.
    pub(crate) rounds: usize,
}

/// Where an error costs next to nothing.
pub(crate) const CHEAP: Search = Search { starts: 20, rounds: ROUNDS };

/// The k-th of places that fill the unit cube evenly, however many of them are taken. Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences".
pub(crate) fn place<const N: usize>(k: usize) -> [f64; N] {
    // g^(N + 1) = g + 1.
    let g = (0..32).fold(1.5_f64, |g, _| (1.0 + g).powf(1.0 / (N as f64 + 1.0)));
    std::array::from_fn(|i| (0.5 + k as f64 * g.powi(-1 - i as i32)).fract())
}

/// The corners of the unit cube, the middles of its edges and faces, and its own: what is drawn comes near them and does not meet
/// them, and errors are often largest there.
pub(crate) fn corners<const N: usize>() -> impl Iterator<Item = [f64; N]> {
    (0..3_usize.pow(N as u32)).map(|k| std::array::from_fn(|i| 0.5 * (k / 3_usize.pow(i as u32) % 3) as f64))
}

impl Search {
    /// Errors at some places, and the largest that a search from there finds; `at` describes a place.
    pub(crate) fn errors<const N: usize>(
        self,
        places: impl IntoIterator<Item = [f64; N]>,
        error: impl Fn([f64; N]) -> f64,
        at: impl Fn([f64; N]) -> String,
    ) -> Errors {
        let drawn: Vec<Place<N>> = places.into_iter().map(|place| (place, error(place))).collect();
        self.errors_of(drawn, error, at)
    }

    /// The same, of errors that are known at the drawn places.
    pub(crate) fn errors_of<const N: usize>(
        self,
        drawn: Vec<Place<N>>,
        error: impl Fn([f64; N]) -> f64,
        at: impl Fn([f64; N]) -> String,
    ) -> Errors {
        let mut errors = Errors::default();
        drawn.iter().for_each(|&(place, found)| errors.add(found, || at(place)));
        self.worst(drawn, error).into_iter().for_each(|(place, found)| errors.search(found, || at(place)));
        errors
    }

    /// From the worst of some drawn places, and of the [`corners`], the worst near each, the largest first. Errors are not negative;
    /// what is no number counts as infinite.
    pub(crate) fn worst<const N: usize>(
        self,
        drawn: impl IntoIterator<Item = Place<N>>,
        error: impl Fn([f64; N]) -> f64,
    ) -> Vec<Place<N>> {
        let mut drawn: Vec<Place<N>> = drawn.into_iter().collect();
        // As far as the drawn places are apart.
        let apart = (drawn.len().max(1) as f64).powf(-1.0 / N as f64);
        drawn.extend(corners().map(|place| (place, number(error(place)))));
        let mut found = self.from(drawn, apart, &error);
        let ((again, smaller), mut random) = (ONCE_MORE, Random(2));
        for place in found.iter_mut().take(again) {
            *place = self.around(*place, smaller * apart, &error, &mut random);
        }
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found
    }

    /// The worst near each of the worst of some places, no two of them near each other, the largest first; it is drawn so far around them
    /// at first.
    pub(crate) fn from<const N: usize>(
        self,
        mut places: Vec<Place<N>>,
        reach: f64,
        error: impl Fn([f64; N]) -> f64,
    ) -> Vec<Place<N>> {
        places.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut starts: Vec<Place<N>> = Vec::new();
        for place in places {
            if starts.len() == self.starts {
                break;
            }
            let is_near = |other: &Place<N>| (0..N).all(|i| (other.0[i] - place.0[i]).abs() < 1.5 * reach);
            if !starts.iter().any(is_near) {
                starts.push(place);
            }
        }
        let mut random = Random(1);
        let mut found: Vec<Place<N>> =
            starts.into_iter().map(|start| self.around(start, reach, &error, &mut random)).collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found
    }

    fn around<const N: usize>(
        self,
        mut best: Place<N>,
        mut reach: f64,
        error: &impl Fn([f64; N]) -> f64,
        random: &mut Random,
    ) -> Place<N> {
        for _ in 0..self.rounds {
            for _ in 0..TRIES * N {
                let place: [f64; N] = std::array::from_fn(|i| (best.0[i] + reach * random.next()).clamp(0.0, 1.0));
                let found = number(error(place));
                if found > best.1 {
                    best = (place, found);
                }
            }
            reach *= NARROWER;
        }
        best
    }
}

/// What is no number counts as infinite.
fn number(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Numbers in -1..1 that come out the same on every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each eighth of the cube has its share of the places, and of a part of them.
    #[test]
    fn places_are_even() {
        for count in [64, 1000] {
            let mut shares = [0_usize; 8];
            for [x, y, z] in (0..count).map(place) {
                shares[4 * usize::from(x < 0.5) + 2 * usize::from(y < 0.5) + usize::from(z < 0.5)] += 1;
            }
            assert!(shares.iter().all(|&share| share.abs_diff(count / 8) <= count / 12), "{shares:?}");
        }
        assert_eq!((corners::<2>().count(), corners::<3>().last()), (9, Some([1.0; 3])));
    }

    /// A peak between the drawn places is found, and one on the edge of the domain, too.
    #[test]
    fn peaks_between_drawn_places_are_found() {
        let peak = |[x, y]: [f64; 2]| 1.0 / (1.0 + 900.0 * ((x - 0.537).powi(2) + (y - 0.211).powi(2)));
        let edge = |[x, y]: [f64; 2]| x + 2.0 * y;
        for (error, most) in [(&peak as &dyn Fn([f64; 2]) -> f64, 1.0), (&edge, 3.0)] {
            let drawn = (0..100).map(|k| [f64::from(k % 10) / 10.0, f64::from(k / 10) / 10.0]);
            let found = CHEAP.worst(drawn.map(|place| (place, error(place))), error);
            assert!(found[0].1 > 0.999 * most, "{found:?}");
            assert!(found.windows(2).all(|pair| pair[0].1 >= pair[1].1));
        }
        // A peak so narrow that no drawn place is near it, in a corner.
        let corner = |[x, y, z]: [f64; 3]| x + 9.0 * f64::from(u8::from(x > 0.999 && y < 1e-3 && z > 0.999));
        let drawn = (0..1000).map(place).map(|place| (place, corner(place)));
        assert!(CHEAP.worst(drawn, corner)[0].1 > 9.9);
        assert_eq!(CHEAP.worst([([0.5], 1.0)], |_| f64::NAN)[0].1, f64::INFINITY);
    }
}
