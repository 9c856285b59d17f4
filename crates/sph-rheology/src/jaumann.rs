//! Jaumann rate: a deviatoric stress follows the motion.

use sph_core::Symmetric;

use crate::Gradient;

/// 𝒢 = E/(2(1 + ν)), Pa. Source: Ghaïtanellis 2017, Eq. 1.21.
pub fn shear_modulus(young_modulus: f64, poisson_ratio: f64) -> f64 {
    young_modulus / (2.0 * (1.0 + poisson_ratio))
}

/// |τ| = √(½ τ:τ), Pa. Source: Ghaïtanellis 2017, Eq. 4.6–4.7.
pub fn magnitude(stress: &Symmetric) -> f64 {
    (0.5 * stress.contract(stress)).sqrt()
}

/// The stress after `dt` of dτ/dt = 2𝒢D′ + ωτ − τω with a constant gradient G of the velocity.
///
/// Symbols: D′ deviator of ½(G + Gᵀ), ω = ½(G − Gᵀ), G_ij = ∂u_i/∂x_j. Half of the strain comes
/// before the turn by exp(ωΔt) and half after it: second order in Δt, and in rigid rotation exact
/// (|τ| is kept). The explicit Euler step of the source lets |τ| grow in rotation.
///
/// Source: Ghaïtanellis 2017, Eq. 4.71 and 4.91; the sign of Eq. 4.72 is against its Eq. 4.69 and
/// turns the stress the wrong way.
pub fn advanced(stress: &Symmetric, gradient: &Gradient, shear_modulus: f64, dt: f64) -> Symmetric {
    let half = Symmetric::part_of(*gradient).deviator() * (shear_modulus * dt);
    turned(&(*stress + half), gradient, dt) + half
}

/// Q τ Qᵀ with Q = exp(ωΔt).
fn turned(stress: &Symmetric, gradient: &Gradient, dt: f64) -> Symmetric {
    let spin = |i: usize, j: usize| 0.5 * (gradient[i][j] - gradient[j][i]);
    let turn = [spin(2, 1), spin(0, 2), spin(1, 0)].map(|x| x * dt);
    let angle = (turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]).sqrt();
    if angle == 0.0 {
        return *stress;
    }
    let q = rotation(turn.map(|x| x / angle), angle);
    let transposed = std::array::from_fn(|i| std::array::from_fn(|j| q[j][i]));
    Symmetric::part_of(product(&product(&q, &stress.rows()), &transposed)).deviator()
}

/// The rows of a rotation by an angle, rad, about a unit vector (Rodrigues).
fn rotation([x, y, z]: [f64; 3], angle: f64) -> [[f64; 3]; 3] {
    let (sine, cosine) = angle.sin_cos();
    let rest = 1.0 - cosine;
    let along = |x: f64| x * x + (1.0 - x * x) * cosine;
    [
        [along(x), x * y * rest - z * sine, x * z * rest + y * sine],
        [x * y * rest + z * sine, along(y), y * z * rest - x * sine],
        [x * z * rest - y * sine, y * z * rest + x * sine, along(z)],
    ]
}

fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let of = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    std::array::from_fn(|i| std::array::from_fn(|j| of(i, j)))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Rotation3, Vector3};

    use super::*;

    fn rows(matrix: Matrix3<f64>) -> Gradient {
        matrix.transpose().into()
    }

    fn some_stress() -> Symmetric {
        Symmetric([0.3, 0.5, -0.8, 1.0, -0.4, 0.2])
    }

    /// The products are summed in the order of nalgebra, whose matrices flows are made of.
    #[test]
    fn a_turned_stress_has_the_bits_of_products_of_matrices() {
        for k in 1..200 {
            let at = |j: u32| f64::from((k * 7 + j * 13) % 29) - 14.0;
            let gradient = Matrix3::from_fn(|i, j| at(3 * i as u32 + j as u32));
            let stress = Symmetric([at(9), at(10), at(11), at(12), at(13), at(14)]);
            let spin = (gradient - gradient.transpose()) * 0.5;
            let turn = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]) * 0.03;
            let q = Rotation3::new(turn).into_inner();
            let exact = Symmetric::part_of(q * stress.matrix() * q.transpose()).deviator();
            assert_eq!(turned(&stress, &rows(gradient), 0.03), exact);
        }
    }

    /// A rotation about (1, 2, 2)/3 in small and in large steps.
    #[test]
    fn rigid_rotation_turns_the_stress_and_keeps_its_size() {
        let axis = Vector3::new(1.0, 2.0, 2.0) / 3.0;
        let gradient = rows(axis.cross_matrix());
        let first = some_stress();
        let q = Rotation3::new(axis * 0.5).into_inner();
        let exact = q * first.matrix() * q.transpose();
        for steps in [1, 50, 50_000] {
            let mut stress = first;
            for _ in 0..steps {
                stress = advanced(&stress, &gradient, 1e6, 0.5 / f64::from(steps));
            }
            let error = (stress.matrix() - exact).norm() / first.matrix().norm();
            let size = (magnitude(&stress) / magnitude(&first) - 1.0).abs();
            assert!(error < 1e-10 && size < 1e-10, "{steps}: {error:e} {size:e}");
        }
    }

    /// The Jaumann rate in simple shear: τ_xy = 𝒢 sin s, τ_xx = −τ_yy = 𝒢 (1 − cos s).
    #[test]
    fn simple_shear_is_second_order() {
        let gradient = [[0.0, 2.0, 0.0], [0.0; 3], [0.0; 3]];
        let shear = 1.2_f64;
        let error = |steps: u32| {
            let mut stress = Symmetric::ZERO;
            for _ in 0..steps {
                stress = advanced(&stress, &gradient, 5.0, 0.5 * shear / f64::from(steps));
            }
            let (xx, xy) = (5.0 * (1.0 - shear.cos()), 5.0 * shear.sin());
            let exact = Symmetric([xx, -xx, 0.0, xy, 0.0, 0.0]);
            magnitude(&(stress - exact)) / 5.0
        };
        let (coarse, fine) = (error(20), error(40));
        assert!((coarse / fine).log2() > 1.95, "{coarse:e} {fine:e}");
        assert!(error(2000) < 1e-7);
    }

    #[test]
    fn strain_without_rotation_adds_up() {
        let gradient = [[-0.3, 0.2, 0.0], [0.2, 0.5, 0.0], [0.0; 3]];
        let rate = Symmetric::part_of(gradient).deviator();
        let stress = advanced(&some_stress(), &gradient, 40.0, 0.25);
        let exact = some_stress() + rate * (2.0 * 40.0 * 0.25);
        assert!(magnitude(&(stress - exact)) < 1e-14);
        let error = (stress.0[2] - (-0.8 - 20.0 * 0.2 / 3.0)).abs();
        assert!(error < 1e-14, "out of the plane");
    }
}
