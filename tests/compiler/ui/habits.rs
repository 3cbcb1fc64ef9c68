//! Formulas as they are written elsewhere: on paper, in Python, in C. The message says what to write here.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

/// That a regular system with a mistake in it is taken for one that can be stepped.
fn moved<S: RegularLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Variational::midpoint(), 0.1, state);
}

macro_rules! degenerate {
    ($name:ident $state:ident: $($arguments:tt)*) => {
        #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), $($arguments)*)]
        pub struct $name;
        const _: fn() = || stepped($name, $state { x: 1.0, y: 0.0 });
    };
}

degenerate! { PowerWithStars PowerWithStarsState: hamiltonian = x**2 + y }
degenerate! { ProductWithoutASign ProductWithoutASignState: hamiltonian = 2x + y }
degenerate! { Logarithm LogarithmState: hamiltonian = x.log() + y }
degenerate! { ArcSine ArcSineState: hamiltonian = x.arcsin() + y }
degenerate! { IntegersThatAreDivided IntegersThatAreDividedState: hamiltonian = (3 / 2) as f64 * x + y }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * dy, hamiltonian = x + y)]
pub struct DifferentialAsAName;
const _: fn() = || stepped(DifferentialAsAName, DifferentialAsANameState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = (0..4).map(|i| x[i]).sum())]
pub struct IteratorSystem;
const _: fn() = || stepped(IteratorSystem, IteratorSystemState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = sum_pairs(0..4, |j, k| g[k - j] * x[j]))]
pub struct IndexOutOfRangeOfAPair { pub g: [f64; 3] }
const _: fn() =
    || stepped(IndexOutOfRangeOfAPair { g: [1.0; 3] }, IndexOutOfRangeOfAPairState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(coordinates(x[4], y[4]), one_form = sum(0..4, |j| x[j] * d(y[j])), hamiltonian = sum_pairs(0..4, |j, k| g[k - j - 2] * x[j]))]
pub struct IndexBelowZeroOfAPair { pub g: [f64; 3] }
const _: fn() =
    || stepped(IndexBelowZeroOfAPair { g: [1.0; 3] }, IndexBelowZeroOfAPairState { x: [1.0; 4], y: [0.0; 4] });

#[lagrangian(coordinates(x), lagrangian = xdot * xdot / 2.0 - x * x)]
pub struct VelocityAsOneWord;
const _: fn() = || moved(VelocityAsOneWord, VelocityAsOneWordState { x: 1.0, dot_x: 0.0 });

#[lagrangian(coordinates(x), lagrangian = dx * dx / 2.0 - x * x)]
pub struct VelocityWithD;
const _: fn() = || moved(VelocityWithD, VelocityWithDState { x: 1.0, dot_x: 0.0 });

degenerate! { QuotientUnderAName QuotientUnderANameState: hamiltonian = { let a = 3; (a / 2) as f64 * y } }
degenerate! { CastOfABlock CastOfABlockState: hamiltonian = ({ let a = 7; a / 2 }) as f64 * y }
degenerate! { MutableName MutableNameState: hamiltonian = { let mut s = y; s } }
degenerate! { ConstantOfOneName ConstantOfOneNameState: hamiltonian = E * x + y }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.log(2.0) + y)]
pub struct LogarithmToABase;
const _: fn() = || stepped(LogarithmToABase, LogarithmToABaseState { x: 1.0, y: 0.0 });

degenerate! { PowerWithAnArgument PowerWithAnArgumentState: hamiltonian = (x + y).pow(3) }
degenerate! { BoundsByOneName BoundsByOneNameState: hamiltonian = x.clamp(-1.0, 1.0) + y }
degenerate! { FunctionByAnotherNameAsInC FunctionByAnotherNameAsInCState: hamiltonian = pow(x, 2) + y }

#[lagrangian(coordinates(x), lagrangian = x.dot().powi(2) / 2.0 - x * x)]
pub struct VelocityAsAMethod;
const _: fn() = || moved(VelocityAsAMethod, VelocityAsAMethodState { x: 1.0, dot_x: 0.0 });

degenerate! { PowerOfTen PowerOfTenState: hamiltonian = (x + y).exp10() + y }
degenerate! { PowerOfTenAsInC PowerOfTenAsInCState: hamiltonian = exp10(x) + y }
degenerate! { FunctionWithADigit FunctionWithADigitState: hamiltonian = x.sqrt2() + y }
degenerate! { SquareByName SquareByNameState: hamiltonian = x.sin2() + y }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * *k + y)]
pub struct StarOfAReference<'a> { pub k: &'a f64 }
const _: fn() = || stepped(StarOfAReference { k: &1.0 }, StarOfAReferenceState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * k.len() + y)]
pub struct SizeAsANumber { pub k: Vec<f64> }
const _: fn() = || stepped(SizeAsANumber { k: vec![] }, SizeAsANumberState { x: 1.0, y: 0.0 });

fn main() {}
