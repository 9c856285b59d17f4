//! γ, the share of a kernel inside a closed mesh of triangles, with `sph-boundary` and `sph-kernels` alone.

use sph_boundary::{BoundaryError, ElementTree, Mesh, PeriodicBox, Renormalisation3d, Surface};

/// A box of 1 m, its triangles anticlockwise seen from the inside, where the fluid is.
fn tank() -> Surface {
    let corner = |k: usize| [k & 1, (k >> 1) & 1, (k >> 2) & 1].map(|bit| bit as f64);
    let quads = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    let halves = quads
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    Surface {
        name: "tank".into(),
        points: (0..8).map(corner).collect(),
        triangles: halves.collect(),
    }
}

/// γ at each of some points, for the Wendland C2 kernel of smoothing length 0.1 m.
pub fn gammas(points: &[[f64; 3]]) -> Result<Vec<f64>, BoundaryError> {
    let mesh = Mesh::<3>::build(&[tank()], &[0], 0.1, &PeriodicBox::none())?;
    let kernel = sph_kernels::wendland_c2();
    let gamma = Renormalisation3d::new(kernel.shape(), 0.1)?;
    let tree = ElementTree::build(&mesh, gamma.kernel_radius());
    let at = |x: &[f64; 3]| gamma.at(*x, &mesh, &tree).gamma();
    Ok(points.iter().map(at).collect())
}

fn main() -> Result<(), BoundaryError> {
    let points = [
        [0.5, 0.5, 0.5],
        [0.5, 0.5, 0.0],
        [0.5, 0.0, 0.0],
        [0.0, 0.0, 0.0],
    ];
    for (x, gamma) in points.iter().zip(gammas(&points)?) {
        println!("γ = {gamma:.9} at {x:?} m");
    }
    Ok(())
}
