//! Generated code among unfriendly names, lints and places. It is a test that this file compiles.
#![deny(warnings, missing_docs, unsafe_code, missing_debug_implementations)]
#![deny(clippy::all, clippy::pedantic, clippy::nursery)]
#![deny(
    unused_qualifications,
    single_use_lifetimes,
    unused_lifetimes,
    explicit_outlives_requirements,
    trivial_casts
)]
#![allow(unreachable_pub)]
// What is written by hand here.
#![allow(
    clippy::imprecise_flops,
    clippy::missing_const_for_fn,
    clippy::redundant_pub_crate,
    clippy::suboptimal_flops
)]

mod constraints;
mod regular;
mod shadowed;
mod spellings;

use dvi_core::Lagrangian;
use dvi_core::methods::Sigma;
use dvi_core::run::Integrator;

/// Parameters with the names of types, variants, crates, and of what generated code might use.
mod fields {
    use dvi_core::degenerate_lagrangian;

    /// A system.
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = (x * d(y) - y * d(x)) * self_ / 2.0,
        hamiltonian = T * x * x + core * y * y + Ok * x * y + h * x + q * y + v * x + matrix * y
            + r1.sin() * i0 * x + vector * l_q * y + w * x + a * b * y + __q * x + len * index * y
            + flat * x + at * y + rest * x + dimension * y + r#type * x + f64 * y + self.std * x,
        momenta(Some = T * x * y, fill = x, r#match = r#type * y),
    )]
    #[derive(Clone, Debug, Default)]
    #[allow(non_snake_case)]
    pub struct Fields {
        pub(super) self_: f64,
        pub(super) T: f64,
        pub(super) core: f64,
        pub(super) std: f64,
        pub(super) Ok: f64,
        pub(super) q: f64,
        pub(super) v: f64,
        pub(super) h: f64,
        pub(super) w: f64,
        pub(super) a: f64,
        pub(super) b: f64,
        pub(super) r1: f64,
        pub(super) i0: f64,
        pub(super) l_q: f64,
        pub(super) matrix: f64,
        pub(super) vector: f64,
        pub(super) len: f64,
        pub(super) index: f64,
        pub(super) flat: f64,
        pub(super) at: f64,
        pub(super) rest: f64,
        pub(super) dimension: f64,
        pub(super) f64: f64,
        pub(super) __q: f64,
        pub(super) r#type: f64,
    }
}

/// Coordinates with such names; `t` hides the time, `PI` the constant.
mod coordinates {
    use dvi_core::degenerate_lagrangian;
    #[allow(unused_imports)]
    use std::f64::consts::{E, PI};

    /// A system.
    #[degenerate_lagrangian(
        coordinates(q, p[2], t, h, v, r#type, PI, E, x0[2], None),
        one_form = p[0] * d(q) + p[1] * d(h) + v * d(t) + r#type * d(PI) + x0[0] * d(x0[1])
            + E * d(None),
        hamiltonian = q * q + p[0] * p[0] + t * t + h * h + p[1] * p[1] + v * v + r#type * PI
            + x0[0] * x0[1] + E * None,
    )]
    #[derive(Clone, Debug)]
    pub struct Coordinates;
}

/// Generics, lifetimes, bounds.
mod generics {
    use dvi_core::degenerate_lagrangian;

    /// A system that borrows.
    #[degenerate_lagrangian(
        coordinates(x[n], y[n]),
        one_form = sum(0..n, |j| T[j] * x[j] * d(y[j])),
        hamiltonian = sum(0..n, |j| x[j] * x[j] + y[j] * y[j] + s * y[j]) / 2.0,
    )]
    #[derive(Clone, Debug)]
    #[allow(non_upper_case_globals, non_snake_case)]
    pub struct Borrowing<'a, 'T: 'a, const n: usize, const FLAG: bool = false>
    where
        'a: 'a,
    {
        pub(super) T: &'a [f64; n],
        pub(super) s: &'T f64,
    }

    /// A system with a type that is no parameter of a formula.
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = (x * x + y * y) * omega / 2.0,
    )]
    #[derive(Clone, Debug)]
    pub struct Tagged<T, S: Clone = (), const N: usize = 3>
    where
        T: core::fmt::Debug,
    {
        pub(super) omega: f64,
        pub(super) tag: T,
        pub(super) also: [S; N],
    }
}

/// Under another name of the library.
mod renamed {
    extern crate dvi_core as renamed;
    /// What a crate offers of its dependencies.
    pub mod reexported {
        pub use dvi_core as dvi;
    }
    #[allow(dead_code)]
    mod dvi_core {}

    /// A system.
    #[renamed::degenerate_lagrangian(
        crate = renamed,
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = x * y,
    )]
    #[derive(Debug)]
    pub struct Local;

    /// A system.
    #[reexported::dvi::degenerate_lagrangian(
        coordinates(x[values.len()], y[values.len()]),
        one_form = sum(0..values.len(), |j| x[j] * d(y[j])),
        hamiltonian = sum(0..values.len(), |j| values[j] * x[j] * y[(j + 1) % values.len()]),
        crate = self::reexported::dvi,
    )]
    #[derive(Debug)]
    pub struct Reexported {
        pub(super) values: Vec<f64>,
    }
}

/// Visibilities, two systems in a module, systems in functions and macros.
mod places {
    use dvi_core::degenerate_lagrangian;

    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y)]
    #[derive(Debug)]
    struct Private {}

    /// A system.
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = Self::G * x * self::G + Private::H * y)]
    #[derive(Debug)]
    pub(crate) struct Crate;

    const G: f64 = 2.0;

    impl Crate {
        const G: f64 = 3.0;
    }

    impl Private {
        const H: f32 = 4.0;
    }

    macro_rules! oscillator {
        ($name:ident, $omega:ident, $factor:expr, $q:ident) => {
            /// A system from a macro.
            #[degenerate_lagrangian(
                                                    coordinates($q, p),
                                                    one_form = p * d($q),
                                                    hamiltonian = $omega * $factor * (p * p + $q * $q),
                                                )]
            #[derive(Debug)]
            pub(super) struct $name {
                pub(super) $omega: f64,
            }
        };
    }

    oscillator!(Slow, omega, 0.5 + 0.25, position);
    oscillator!(Fast, rate, 2.0, p_of_q);

    pub(super) fn in_a_function<const N: usize>() -> f64 {
        /// A system.
        #[degenerate_lagrangian(
            coordinates(x[N], y[N]),
            one_form = sum(0..N, |j| x[j] * d(y[j])),
            hamiltonian = sum(0..N, |j| x[j] * y[j]) + a,
        )]
        #[derive(Debug)]
        struct Inside<const N: usize> {
            a: f64,
        }
        super::value(&Inside::<N> { a: 1.0 }, 2 * N)
    }

    #[test]
    fn private_systems_run() {
        assert!(super::value(&Private {}, 2).is_finite());
        let state = PrivateState { x: 1.0, y: 1.0 };
        assert!(super::Integrator::new(&Private {}, super::Sigma::midpoint(), 0.1, state).is_ok());
    }
}

/// Functions of the user's own, by path.
mod functions {
    use dvi_core::{Scalar, degenerate_lagrangian};

    pub(crate) mod special {
        use super::Scalar;

        pub(crate) fn square<T: Scalar>(x: T) -> T {
            x * x
        }
        pub(crate) fn twice<T: Scalar>(x: T) -> T {
            x + x
        }
        pub(crate) fn two<T: Scalar>(_: T) -> T {
            T::lift(2.0)
        }
    }

    /// A system.
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = f(x) * d(y),
        hamiltonian = f(x) + r#fn(y),
        functions(
            f = [special::square, special::twice::<_>, self::special::two],
            r#fn = [special::square, special::twice, crate::functions::special::two],
        ),
    )]
    #[derive(Debug)]
    pub struct Functions;
}

/// L at a point where all coordinates are one half.
fn value<S: Lagrangian>(system: &S, dimension: usize) -> f64 {
    assert!(system.check().is_ok());
    let (q, v) = (vec![0.5; dimension], vec![0.25; dimension]);
    let (mut l_q, mut l_v) = (q.clone(), v.clone());
    system.gradient(&q, &v, 0.0, &mut l_q, &mut l_v);
    system.lagrangian(&q, &v, 0.0)
}

#[test]
fn systems_with_unfriendly_names_run() {
    let fields = fields::Fields { self_: 1.0, ..fields::Fields::default() };
    assert!(value(&fields, 2).is_finite());
    let start = fields::FieldsState { x: 1.0, y: 0.0 };
    assert!(Integrator::new(&fields, Sigma::midpoint(), 0.1, start).is_ok());
    assert!(value(&coordinates::Coordinates, 12).is_finite());
    assert!(value(&generics::Borrowing::<2> { T: &[1.0; 2], s: &1.0 }, 4).is_finite());
    let tagged = generics::Tagged { omega: 1.0, tag: "tag", also: [(); 3] };
    assert!(tagged.tag.len() == tagged.also.len() && value(&tagged, 2).is_finite());
    assert!(value(&renamed::Local, 2).is_finite());
    assert!(value(&renamed::Reexported { values: vec![1.0; 3] }, 6).is_finite());
    assert!(value(&places::Crate, 2).is_finite());
    assert!(value(&places::Slow { omega: 1.0 }, 2).is_finite());
    assert!(value(&places::Fast { rate: 1.0 }, 2).is_finite());
    assert!(places::in_a_function::<3>().is_finite());
    assert!(value(&functions::Functions, 2).is_finite());
}

#[test]
fn a_coordinate_hides_the_time() {
    let system = coordinates::Coordinates;
    let (q, v) = ([0.5; 12], [0.0; 12]);
    let [now, later] = [0.0_f64, 1.0].map(|t| system.lagrangian(&q, &v, t));
    assert_eq!(now.to_bits(), later.to_bits());
}
