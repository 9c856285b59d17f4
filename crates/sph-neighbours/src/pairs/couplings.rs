//! Couplings of pairs, kept in lanes for many sums over particles that stay where they are.

use sph_core::{StepError, Vect, fields};
use sph_kernels::lanes::{Body, Lane, Width, dispatch_at};

use crate::lanes::separation::places;
use crate::{CHUNK, Domain, World, each_block, minus, vector};

/// The numbers of C = α 1 + β r rᵀ that are not zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinds {
    /// α.
    pub even: bool,
    /// β.
    pub along: bool,
}

impl Kinds {
    /// Number of values kept per pair.
    pub(crate) fn count(self) -> usize {
        usize::from(self.even) + usize::from(self.along)
    }
}

/// C_ab of the pairs of all particles, for sums Σ_b C_ab (u_a − u_b): for each cluster the neighbours with which any of
/// its members is coupled, and one number per lane, number and neighbour.
///
/// A quarter to a half of the memory of a matrix of blocks, which they replace where only products are needed.
#[derive(Clone, Debug, Default)]
pub struct Couplings {
    pub(crate) blocks: Vec<BlockCouplings>,
    pub(crate) kinds: Kinds,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct BlockCouplings {
    pub groups: Vec<Group>,
    pub columns: Vec<u32>,
    pub numbers: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    pub width: Width,
    pub from: u32,
    pub count: u32,
    /// The end of its columns.
    pub to: u32,
    pub wraps: bool,
}

impl Couplings {
    /// Bytes held for them.
    pub fn bytes(&self) -> usize {
        let of = |kept: &BlockCouplings| {
            size_of_val(&kept.groups[..])
                + size_of_val(&kept.columns[..])
                + size_of_val(&kept.numbers[..])
        };
        self.blocks.iter().map(of).sum()
    }

    fn groups(&self, block: usize) -> impl Iterator<Item = (&Group, &[u32], &[f64])> {
        let kept = &self.blocks[block];
        let (mut start, mut rest) = (0, &kept.numbers[..]);
        kept.groups.iter().map(move |group| {
            let columns = &kept.columns[start..group.to as usize];
            start = group.to as usize;
            let own = columns.len() * self.kinds.count() * group.width.lanes();
            let (numbers, behind) = rest.split_at(own);
            rest = behind;
            (group, columns, numbers)
        })
    }

    /// The couplings among particles at the places of a world, which must be those where they were found.
    ///
    /// # Errors
    /// If the world has no positions.
    pub fn at<'a, const D: usize>(
        &'a self,
        world: &'a World<D>,
    ) -> Result<CouplingsAt<'a, D>, StepError> {
        Ok(CouplingsAt {
            couplings: self,
            positions: world.free.get(fields::POSITION)?,
            domain: &world.domain,
        })
    }
}

/// [`Couplings`] with the places of the particles.
#[derive(Clone, Copy)]
pub struct CouplingsAt<'a, const D: usize> {
    couplings: &'a Couplings,
    positions: &'a [Vect<D>],
    domain: &'a Domain<D>,
}

impl<const D: usize> CouplingsAt<'_, D> {
    /// Number of blocks of [`CHUNK`] particles.
    pub fn blocks(&self) -> usize {
        self.couplings.blocks.len()
    }

    /// Leaves `of`(a, Σ_b C_ab (u_a − u_b)) in `out`.
    pub fn sums(
        &self,
        u: &[Vect<D>],
        out: &mut [Vect<D>],
        of: impl Fn(usize, Vect<D>) -> Vect<D> + Sync,
    ) {
        let kinds = self.couplings.kinds;
        each_block(out, CHUNK, &|block, out| {
            for (group, columns, numbers) in self.couplings.groups(block) {
                let from = group.from as usize;
                let own = from..from + group.count as usize;
                let first = from - block * CHUNK;
                let places = &mut out[first..first + own.len()];
                let product = Product {
                    x: &self.positions[own.clone()],
                    own: &u[own.clone()],
                    positions: self.positions,
                    u,
                    columns,
                    numbers,
                    domain: group.wraps.then_some(self.domain),
                    out: &mut *places,
                };
                let width = group.width;
                match (kinds.even, kinds.along) {
                    (true, true) => dispatch_at(width, ProductBody::<D, true, true>(product)),
                    (true, false) => dispatch_at(width, ProductBody::<D, true, false>(product)),
                    (false, true) => dispatch_at(width, ProductBody::<D, false, true>(product)),
                    (false, false) => product.out.fill(Vect::zeros()),
                }
                own.zip(places).for_each(|(i, sum)| *sum = of(i, *sum));
            }
        });
    }

    /// Calls `visit` with α, β and r_a − r_b of all pairs of a block that are coupled: the particle a and then its neighbours b,
    /// in the order of their indices, `begin` before the first one of each particle with the most that may follow, and `end` after
    /// the last.
    pub fn each<V: Visitor<D>>(&self, block: usize, visitor: &mut V) {
        let kinds = self.couplings.kinds;
        for (group, columns, numbers) in self.couplings.groups(block) {
            let lanes = group.width.lanes();
            for lane in 0..group.count as usize {
                let a = group.from as usize + lane;
                visitor.begin(a, columns.len());
                let stride = kinds.count() * lanes;
                for (&b, numbers) in columns.iter().zip(numbers.chunks_exact(stride)) {
                    let even = if kinds.even { numbers[lane] } else { 0.0 };
                    let along = match kinds.along {
                        true => numbers[stride - lanes + lane],
                        false => 0.0,
                    };
                    // Not "≠": NaN has to be kept.
                    if even == 0.0 && along == 0.0 {
                        continue;
                    }
                    let apart = self.positions[a] - self.positions[b as usize];
                    let apart = match group.wraps {
                        true => self.domain.nearest_image(apart),
                        false => apart,
                    };
                    visitor.pair(b, [even, along], &apart);
                }
                visitor.end(a);
            }
        }
    }
}

/// A visitor of couplings, one by one.
pub trait Visitor<const D: usize> {
    /// A particle, and how many couplings it has at most.
    fn begin(&mut self, particle: usize, most: usize);
    /// A neighbour with α, β and the separation, m.
    fn pair(&mut self, neighbour: u32, coupling: [f64; 2], separation: &Vect<D>);
    /// The last neighbour was seen.
    fn end(&mut self, particle: usize);
}

struct Product<'a, const D: usize> {
    x: &'a [Vect<D>],
    own: &'a [Vect<D>],
    positions: &'a [Vect<D>],
    u: &'a [Vect<D>],
    columns: &'a [u32],
    numbers: &'a [f64],
    domain: Option<&'a Domain<D>>,
    out: &'a mut [Vect<D>],
}

/// [`Product`] of α, of β, or of both.
struct ProductBody<'a, const D: usize, const EVEN: bool, const ALONG: bool>(Product<'a, D>);

impl<const D: usize, const EVEN: bool, const ALONG: bool> Body for ProductBody<'_, D, EVEN, ALONG> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let ProductBody(product) = self;
        let x = places::<D, L>(product.x);
        let own = places::<D, L>(product.own);
        let mut sum = [L::splat(0.0); D];
        let each = (usize::from(EVEN) + usize::from(ALONG)) * L::N;
        let numbers = product.numbers.chunks_exact(each);
        for (&j, numbers) in product.columns.iter().zip(numbers) {
            let j = j as usize;
            let relative = minus(&own, &product.u[j]);
            if EVEN {
                let even = L::load(numbers);
                for k in 0..D {
                    sum[k] += relative[k] * even;
                }
            }
            if ALONG {
                let mut apart = minus(&x, &product.positions[j]);
                if let Some(domain) = product.domain {
                    apart = domain.nearest_images(apart);
                }
                let mut along = relative[0] * apart[0];
                for k in 1..D {
                    along += relative[k] * apart[k];
                }
                along = along * L::load(&numbers[each - L::N..]);
                for k in 0..D {
                    sum[k] += apart[k] * along;
                }
            }
        }
        // A copy: single lanes are read from memory, and the sums themselves are to stay in registers.
        let all = sum;
        for (lane, out) in product.out.iter_mut().enumerate() {
            *out = vector(&all, lane);
        }
    }
}
