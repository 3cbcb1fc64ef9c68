//! A method or a step control that does not fit its system is one error, where the run begins: what is done
//! with the run is none, unless the type of the run is written out.

use dvi_core::prelude::*;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) - y * d(x), hamiltonian = x * x + y * y)]
pub struct Vortex;

#[lagrangian(coordinates(x), lagrangian = (1.0 + x * x) * dot(x) * dot(x) / 2.0 - x * x)]
pub struct Bead;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x) * dot(x) + dot(y) * dot(y)) / 2.0 - y,
    constraint = x * x + y * y - 1.0,
)]
pub struct Rod;

#[degenerate_lagrangian(coordinates(s: S2), one_form = area(s), hamiltonian = s[2])]
pub struct Spin;

#[lagrangian(coordinates(s: S2), lagrangian = dot(s).norm_squared() / 2.0 - s[2])]
pub struct Pendulum;

const VORTEX: VortexState = VortexState { x: 1.0, y: 0.0 };
const BEAD: BeadState = BeadState { x: 1.0, dot_x: 0.0 };
const SPIN: SpinState = SpinState { s: [0.0, 0.0, 1.0] };
const ROD: RodState = RodState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn another_kind() -> Outcome {
    let mut run = Integrator::new(&Bead, Sigma::midpoint(), 0.1, BEAD)?;
    run.take_steps(100)?;
    for state in run.by_ref().take(3) {
        println!("{:?}", state?);
    }
    for state in run.states_at([20.0, 21.0])? {
        println!("{:?}", state?);
    }
    println!("{:?} {} {}", run.state(), run.energy(), run.statistics().steps);
    let boxed: Box<dyn Run<System = Bead, Scalar = f64>> = Box::new(run);
    println!("{}", boxed.energy());
    Ok(())
}

/// A run that is used, without errors beside the one where it begins.
macro_rules! run {
    ($name:ident: $begun:expr) => {
        fn $name() -> Outcome {
            let mut run = $begun?;
            run.take_steps(100)?;
            println!("{:?} {}", run.state(), run.energy());
            Ok(())
        }
    };
}

run! { owned: Integrator::new(Vortex, Variational::trapezoid(), 0.1, VORTEX) }
run! { not_separable: Integrator::new(&Bead, Newmark::new(0.25), 0.1, BEAD) }
run! { constrained_and_separable: Integrator::new(&Rod, Newmark::new(0.25), 0.1, ROD) }
run! { out_of_class: Integrator::new(&Vortex, OneStep::midpoint(), 0.1, VORTEX) }
run! { composed: {
    let method = Composition::suzuki(Variational::midpoint());
    Integrator::new(&Vortex, EnergyLimit { method, limit: 1e-3 }, 0.1, VORTEX)
} }

run! { without_constraints: Integrator::new(&Bead, Constrained::new(Midpoint), 0.1, BEAD) }

fn controlled() -> Outcome {
    let control = ErrorControl::new(1e-9, 0.1);
    let mut run = Integrator::controlled(&Rod, Gauss::<4>::new(), control, ROD)?;
    run.advance_to(10.0)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn a_control_of_another_kind() -> Outcome {
    let control = EnergyMomentum::new(0.1);
    let mut run = Integrator::controlled(&Vortex, Gauss::<2>::new(), control, VORTEX)?;
    run.take_steps(100)?;
    println!("{:?} {} {}", run.state(), run.energy(), run.control_memory().defect());
    Ok(())
}

run! { two_points: Integrator::from_two_points(&Bead, Sigma::midpoint(), 0.1, BEAD, BEAD) }
run! { composed_of_one_length:
    Integrator::new(&Vortex, Composition::suzuki(Sigma::midpoint()), 0.1, VORTEX)
}

fn resumed(checkpoint: &Checkpoint) -> Outcome {
    let control = ErrorControl::new(1e-9, 0.1);
    let mut run = Integrator::resume_controlled(&Bead, Newmark::new(0.25), control, checkpoint)?;
    run.advance_to(10.0)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

run! { a_spin_is_degenerate: Integrator::new(&Spin, Geodesic::midpoint(), 0.1, SPIN) }
run! { two_points_of_another_method:
    Integrator::from_two_points(&Vortex, Newmark::new(0.25), 0.1, VORTEX, VORTEX)
}

run! { neither_method_nor_control:
    Integrator::controlled(&Vortex, Sigma::midpoint(), Reversible::power(0.02, 1.5), VORTEX)
}

run! { limited_under_a_control: {
    let method = EnergyLimit { method: Newmark::new(0.25), limit: 1e-3 };
    Integrator::controlled(&Vortex, method, Reversible::power(0.02, 1.5), VORTEX)
} }

run! { no_impacts: Integrator::new(&Vortex, Impacts::reflecting(Sigma::midpoint()), 0.1, VORTEX) }

/// A run whose type is written out: one error where it begins, and one for each function that is called.
struct Written<'a> {
    run: Integrator<&'a Bead, Sigma>,
}

impl Written<'_> {
    fn go_on(&mut self) -> Outcome {
        self.run.take_steps(100)?;
        Ok(())
    }
}

fn written(bead: &Bead) -> Result<Written<'_>, StartError> {
    Ok(Written { run: Integrator::new(bead, Sigma::midpoint(), 0.1, BEAD)? })
}

fn written_under_a_control(
    rod: &Rod,
) -> Result<Integrator<&Rod, OneStep, f64, ErrorControl<'_>>, StartError> {
    Integrator::controlled(rod, OneStep::midpoint(), ErrorControl::new(1e-9, 0.1), ROD)
}

fn in_a_local() -> Outcome {
    let run: Integrator<_, Sigma> = Integrator::new(&Bead, Sigma::midpoint(), 0.1, BEAD)?;
    println!("{:?}", run.state());
    Ok(())
}

fn as_an_argument(run: &mut Integrator<&Bead, Sigma>) -> Outcome {
    run.take_steps(100)?;
    Ok(())
}

fn main() {}
