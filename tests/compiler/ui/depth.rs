//! Formulas beyond reason, refused before they exhaust the compiler.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

macro_rules! degenerate {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

degenerate! { Signs SignsState:
    hamiltonian = - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - - x
}

degenerate! { FunctionsOfFunctions FunctionsOfFunctionsState:
    hamiltonian = x.sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin().sin()
}

degenerate! { PowersOfPowers PowersOfPowersState: hamiltonian = x.powi(4096).powi(2) }
degenerate! { SquaresOfNames SquaresOfNamesState:
    hamiltonian = {
        let a = x * x;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        let a = a * a;
        a
    }
}

fn main() {}
