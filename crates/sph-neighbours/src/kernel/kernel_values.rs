//! Kernel values around a place, and buffers of sums of them.

use sph_core::Vect;
use sph_kernels::Sampler;

use crate::Domain;
use crate::lists::buffer::grow;

#[derive(Default)]
pub(crate) struct Values {
    pub distance2: Vec<f64>,
    pub value: Vec<f64>,
}

impl Values {
    pub fn reserve(&mut self, n: usize) {
        grow(&mut self.distance2, n);
        grow(&mut self.value, n);
    }

    pub fn fill<const D: usize>(
        &mut self,
        x: &Vect<D>,
        sources: &[Vect<D>],
        candidates: &[u32],
        domain: Option<&Domain<D>>,
        kernel: &dyn Sampler,
    ) -> &[f64] {
        let n = candidates.len();
        self.reserve(n);
        let distance2 = &mut self.distance2[..n];
        match domain {
            None => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = (x - sources[j as usize]).norm_squared();
                }
            }
            Some(domain) => {
                for (r2, &j) in distance2.iter_mut().zip(candidates) {
                    *r2 = domain.nearest_image(x - sources[j as usize]).norm_squared();
                }
            }
        }
        kernel.value(distance2, &mut self.value[..n]);
        &self.value[..n]
    }
}

/// Buffers of a thread that sums the kernel over particles.
#[derive(Default)]
pub(crate) struct SumScratch {
    pub lanes: Values,
    pub row: Values,
    /// Candidates that some member has within its support.
    pub inside: Vec<bool>,
}
