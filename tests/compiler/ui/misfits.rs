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

const VORTEX: VortexState = VortexState { x: 1.0, y: 0.0 };
const BEAD: BeadState = BeadState { x: 1.0, dot_x: 0.0 };
const ROD: RodState = RodState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn owned() -> Outcome {
    let mut run = Integrator::new(Vortex, Variational::trapezoid(), 0.1, VORTEX)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn not_separable() -> Outcome {
    let mut run = Integrator::new(&Bead, Newmark::new(0.25), 0.1, BEAD)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn out_of_class() -> Outcome {
    let mut run = Integrator::new(&Vortex, OneStep::midpoint(), 0.1, VORTEX)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn without_constraints() -> Outcome {
    let mut run = Integrator::new(&Bead, Constrained::new(Variational::midpoint()), 0.1, BEAD)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn two_points() -> Outcome {
    let mut run = Integrator::from_two_points(&Bead, Sigma::midpoint(), 0.1, BEAD, BEAD)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn composed_of_one_length() -> Outcome {
    let mut run = Integrator::new(&Vortex, Composition::yoshida(Sigma::midpoint()), 0.1, VORTEX)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn resumed(checkpoint: &Checkpoint) -> Outcome {
    let control = ErrorControl::new(1e-9, 0.1);
    let mut run = ControlledIntegrator::resume(&Bead, Newmark::new(0.25), control, checkpoint)?;
    run.advance_to(10.0)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

fn two_points_of_another_method() -> Outcome {
    let mut run = Integrator::from_two_points(&Bead, Newmark::new(0.25), 0.1, BEAD, BEAD)?;
    run.take_steps(100)?;
    println!("{:?} {}", run.state(), run.energy());
    Ok(())
}

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
) -> Result<ControlledIntegrator<&Rod, OneStep, ErrorControl<'_>>, StartError> {
    ControlledIntegrator::new(rod, OneStep::midpoint(), ErrorControl::new(1e-9, 0.1), ROD)
}

fn main() {}
