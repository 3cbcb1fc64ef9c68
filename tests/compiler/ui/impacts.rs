//! Mistakes in impacts.

use dvi_core::UnilateralLagrangian;
use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one with impacts.
fn used<S: UnilateralLagrangian>(system: &S) {
    system.gap(&[1.0, 2.0], 0.0, &mut [0.0]);
    let _ = system.multipliers();
}

macro_rules! on_a_line {
    ($name:ident: $($arguments:tt)*) => {
        #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, $($arguments)*)]
        struct $name;
    };
}

on_a_line! { NotAGapS: impact = dot(x) }
const _: fn() = || used(&NotAGapS);

on_a_line! { NotAGapT: impact = x_dot + x }
on_a_line! { NotAGapU: impact = 1.0 - t }
on_a_line! { NotAGapV: impact = [] }
on_a_line! { ConditionsS: impact = x > 0.0 }

on_a_line! { ConditionsU: impact = [x != 0.0, x == 1.0] }
on_a_line! { ConditionsV: constraint = x >= 0.0 }

#[lagrangian(coordinates(x[3]), lagrangian = sum(0..3, |i| dot(x[i]).powi(2) / 2.0), impact(i) = x[i])]
struct FamiliesS;

#[lagrangian(coordinates(x[3]), lagrangian = sum(0..3, |i| dot(x[i]).powi(2) / 2.0), impact(i in 0..3) = x[0])]
struct FamiliesT;

#[lagrangian(coordinates(x[3]), lagrangian = sum(0..3, |i| dot(x[i]).powi(2) / 2.0), impact = |i| x[i])]
struct FamiliesU;

#[lagrangian(coordinates(x[3]), lagrangian = sum(0..3, |i| dot(x[i]).powi(2) / 2.0), impact(i in 0..3) = [x[i], 1.0 - x[i]])]
struct FamiliesV;

#[lagrangian(coordinates(x, y), lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0, impact = [x - y, y - x])]
struct TwiceS;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = x,
    nonholonomic = dot(x) - dot(y),
)]
struct TwiceU;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    constraint = x - y,
    impact = x,
)]
struct TwiceV;

on_a_line! { OfTheMethod: impact = x, restitution = 0.5 }

on_a_line! { OtherWordsS: wall = x }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x + y * y, impact = x)]
struct OtherWordsU;

mod methods {
    use super::*;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, impact = x)]
    struct Walled;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0)]
    struct Free;

    fn through_the_wall() {
        let start = WalledState { x: 1.0, dot_x: -1.0 };
        let _ = Integrator::new(&Walled, Variational::trapezoid(), 0.1, start);
    }

    fn by_another_method() {
        let start = WalledState { x: 1.0, dot_x: -1.0 };
        let _ = Integrator::new(&Walled, Gauss::<2>::new(), 0.1, start);
    }

    fn without_a_wall() {
        let start = FreeState { x: 1.0, dot_x: -1.0 };
        let _ = Integrator::new(&Free, Impacts::new(Variational::trapezoid()), 0.1, start);
    }

    fn by_a_method_that_cannot_stop() {
        let start = WalledState { x: 1.0, dot_x: -1.0 };
        let _ = Integrator::new(&Walled, Impacts::new(Newmark::new(0.25)), 0.1, start);
    }
}

fn main() {}
