//! Functions of several variables that hold data, in formulas.

use dvi_core::field::{Expansion, ScalarField};
use dvi_core::prelude::*;
use dvi_core::Scalar;

/// a sin(kx) e^(−y²) + x²y
struct Hill {
    a: f64,
    k: f64,
}

impl ScalarField<2> for Hill {
    fn expansion<T: Scalar>(&self, [x, y]: [T; 2]) -> Expansion<2, T> {
        let (a, k, two) = (T::lift(self.a), T::lift(self.k), T::lift(2.0));
        let (s, c) = ((k * x).sin(), (k * x).cos());
        let e = (-y * y).exp();
        let mixed = -two * a * k * c * e * y + two * x;
        Expansion {
            value: a * s * e + x * x * y,
            gradient: [a * k * c * e + two * x * y, -two * a * s * e * y + x * x],
            hessian: [
                [-a * k * k * s * e + two * y, mixed],
                [mixed, two * a * s * e * (two * y * y - T::lift(1.0))],
            ],
        }
    }
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = psi(x, y) * d(x),
    hamiltonian = psi(x - y, 2.0 * y).powi(2) / 2.0 + y,
)]
struct Drift<P> {
    psi: P,
}

#[test]
fn it_runs() {
    let system = Drift { psi: Hill { a: 0.3, k: 1.7 } };
    println!("{}", Drift::<Hill>::REPORT);
    let mut run = Integrator::new(&system, OneStep::midpoint(), 0.01, DriftState { x: 1.0, y: 0.2 }).unwrap();
    run.take_steps(10).unwrap();
    println!("{:?}", run.state());
}
