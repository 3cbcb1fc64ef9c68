//! What is written on paper, and in other languages.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

/// That a regular system with a mistake in it is taken for one that can be stepped.
fn moved<S: RegularLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Variational::midpoint(), 0.1, state);
}

macro_rules! hamiltonian {
    ($name:ident: $($formula:tt)*) => {
        mod $name {
            use super::*;
            #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = $($formula)*)]
            pub struct System;
            const _: fn() = || stepped(System, SystemState { x: 1.0, y: 0.0 });
        }
    };
}

// Functions by the names of others, and of functions.
hamiltonian! { cotangent: x.cot() + y }
hamiltonian! { secant: sec(x) + y }
hamiltonian! { square_of_a_sine: x.sin2() + y }
hamiltonian! { square_of_a_square: x.pow2() + y }
hamiltonian! { complement_of_the_error_function: erfc(x) + y }
hamiltonian! { capital_letter: Sin(x) + y }
hamiltonian! { brackets_of_mathematica: Sqrt[x] + y }
hamiltonian! { doubles_of_fortran: dsqrt(x) + y }
hamiltonian! { function_of_a_module: np.sin(x) + y }
hamiltonian! { function_of_a_path: Math::atan2(y, x) }
hamiltonian! { too_few_arguments: atan2(x) + y }
hamiltonian! { distance: norm(x, y) }
hamiltonian! { size_of_a_list: norm([x, y, x]) }
hamiltonian! { copy: x.clone() + y }
hamiltonian! { special_function: bessel_j0(x) + y }

// Functions that jump.
hamiltonian! { step: heaviside(x) + y }
hamiltonian! { floor: x.floor() + y }
hamiltonian! { remainder: mod(x, 2.0) + y }

// Powers.
hamiltonian! { power_of_a_function: sin^2(x) + y }
hamiltonian! { power_of_a_value: sin(x)^2 + y }
hamiltonian! { power_of_a_product: 2x^2 + y }
hamiltonian! { exponential: e^x + y }
hamiltonian! { powers_in_a_function: sqrt(x^2 + y^2) }

// Names.
hamiltonian! { euler: e * x + y }
hamiltonian! { circle: π * x + y }
hamiltonian! { circle_in_latin_letters: pi * x + y }
hamiltonian! { time: time * x + y }
hamiltonian! { exponent_of_ten: 1.5d3 * x + y }
hamiltonian! { entry_of_a_coordinate: x(1) * y }
hamiltonian! { factor_of_brackets: 2(x + y) }

// Absolute values and choices.
hamiltonian! { absolute_value: |x| + y }
hamiltonian! { absolute_value_at_the_end: y + |x| }
hamiltonian! { absolute_value_inside: (1.0 + |x|).sqrt() * y }
hamiltonian! { choice_of_python: x if x > 0.0 else y }
hamiltonian! { choice_of_c: x > 0.0 ? x : y }
hamiltonian! { choice_of_numpy: where(x > 0.0, x, y) }
hamiltonian! { choice_of_fortran: if x > 0.0 then x else y }

macro_rules! lagrangian {
    ($name:ident: $($arguments:tt)*) => {
        mod $name {
            use super::*;
            #[lagrangian($($arguments)*)]
            pub struct System;
        }
    };
}

// Velocities.
lagrangian! { dotted: coordinates(x, θ), lagrangian = ẋ * ẋ + dot(θ).powi(2) }
lagrangian! { dotted_in_greek: coordinates(x, θ), lagrangian = dot(x).powi(2) + θ̇ * θ̇ }
lagrangian! { velocity_by_its_letter: coordinates(x), lagrangian = v_x * v_x }
lagrangian! { derivative_by_time: coordinates(x), lagrangian = diff(x, t).powi(2) }
lagrangian! { field_of_a_coordinate: coordinates(x), lagrangian = x.dot.powi(2) }
lagrangian! { product_of_velocities: coordinates(x), lagrangian = dot(x, x) }

// Arguments.
lagrangian! { momentum_without_a_name: coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2),
    momenta(x * dot(y) - y * dot(x)) }
lagrangian! { type_of_an_array: coordinates(x: [f64; 3]), lagrangian = dot(x[0]).powi(2) }
lagrangian! { letter_of_the_lagrangian: coordinates(x), L = dot(x).powi(2) }
lagrangian! { short_word_for_coordinates: coords(x), lagrangian = dot(x).powi(2) }
lagrangian! { parameters: coordinates(x), lagrangian = dot(x).powi(2), parameters(g) }

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), H = x * y)]
pub struct LetterOfTheHamiltonian;

#[degenerate_lagrangian(coordinates(x, y), one_form = (0.0, x), hamiltonian = x * y)]
pub struct ComponentsInParentheses;

#[degenerate_lagrangian(coordinates(x, y), one_form = d(x) ^ d(y), hamiltonian = x * y)]
pub struct TwoForm;

/// Functions of several variables.
macro_rules! psi {
    ($name:ident: $($formula:tt)*) => {
        mod $name {
            use super::*;
            #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = $($formula)*)]
            pub struct System<Psi> {
                pub psi: Psi,
            }
        }
    };
}
psi! { list_of_arguments: psi([x, y]) }
psi! { value: psi.value(x, y) }
psi! { arguments_in_brackets: psi[x, y] }

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2))]
#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
pub struct TwoSystems;
const _: fn() = || moved(TwoSystems, TwoSystemsState { x: 1.0, dot_x: 0.0 });

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = { let g = x; g[0] * y })]
pub struct NumberWithAnIndex {
    pub g: [f64; 2],
}

fn main() {}
