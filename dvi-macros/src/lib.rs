//! The attribute macros of `dvi-core`: a small compiler from Lagrangians to integrators.
//!
//! A formula goes one way: `syntax` reads the attribute, `model` resolves its names, `lower` turns
//! expressions into a graph, `symbolic` simplifies and differentiates, `structure` sees what a system
//! allows, `program` says what each generated function computes, `select` and `schedule` choose shared
//! products and loops, which make a `routine`, `validate` holds every routine against the formulas as
//! written, and `emit` and `implement` write Rust. `expand` tells that story on one screen for each
//! attribute. Mistakes of the user are found by the stages up to `structure`; a mistake of the compiler is
//! found by `validate`, or ends the expansion as an `internal` error.

mod emit;
mod errors;
mod expand;
#[cfg(test)]
mod fuzz_tests;
mod implement;
mod instructions;
mod internal;
mod lower;
mod model;
mod operations;
#[cfg(test)]
mod oracle_tests;
mod program;
mod routine;
mod schedule;
mod select;
mod structure;
mod symbolic;
mod syntax;
#[cfg(test)]
mod tests;
mod validate;

use proc_macro::TokenStream;

/// Declares a degenerate system, L(q, v, t) = α(q, t)·v − H(q, t), on the struct of its parameters.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A pendulum in phase space.
/// #[degenerate_lagrangian(
///     coordinates(angle, p),
///     one_form    = p * d(angle),
///     hamiltonian = p * p / 2.0 - g * angle.cos(),
/// )]
/// struct Pendulum {
///     g: f64,
/// }
///
/// let start: PendulumState = PendulumState { angle: 1.0, p: 0.0 };
/// let mut run = Integrator::new(&Pendulum { g: 9.81 }, Sigma::midpoint(), 0.01, start)?;
/// run.take_steps(1000)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// For a struct `System` the attribute implements `dvi_core::System`, `dvi_core::Lagrangian` and
/// `dvi_core::DegenerateLagrangian`, defines `SystemState` with the coordinates as fields, and continues the documentation of the
/// struct with its formulas.
///
/// # Arguments
///
/// | argument | meaning |
/// |---|---|
/// | `coordinates(x, y[N])` | single coordinates and arrays; a size is a literal, a const generic, a `usize` field, `field.len()`, or sums and multiples of these |
/// | `one_form = …` | α, linear in `d(x)`; or its components `[a, b]`, with `\|i\| …` for an array |
/// | `hamiltonian = …` | H |
/// | `lagrangian = …` | instead of these two: L, affine in the velocities `dot(x)` |
/// | `gauge = F` | F(q, t), whose dF/dt is added to L: α becomes α + ∂F/∂q and H becomes H − ∂F/∂t, with the same motion |
/// | `gauge = auto` | an F is sought that leaves α no component along one half of the coordinates |
/// | `force(x) = …`, `force = […]` | forces, see below |
/// | `time_transform = ρ` | steps of equal length in τ with dt = ρ(q, t) dτ, see below |
/// | `momenta(name = …)` | conserved quantities to watch |
/// | `functions(f = [f, df, d2f])` | functions of one number, each with its first two derivatives, and a third one where it stands in a gauge, as paths to `fn(T) -> T` generic over `dvi_core::Scalar` |
/// | `functions(psi = path)` | a value of a type that implements `dvi_core::ScalarField`, see below |
/// | `derive(Trait, …)` | what the state derives beside `Clone`, `Debug`, `PartialEq` and, without `Vec`s, `Copy`: `serde::Serialize` for instance, which does not know arrays of const-generic size |
/// | `crate = ::path` | where `dvi_core` is, if it was renamed |
///
/// # Formulas
///
/// Formulas are Rust expressions over
///
/// - the coordinates, and the fields of the struct by name; `name.field` and `self.name.field` are fields of a field;
/// - `PI`, and other constants by their paths (`std::f64::consts::E`);
/// - the time `t`; a coordinate or field of that name takes precedence.
///
/// They are made of operators, methods of `f64`, `erf` and `sinc`, `let` blocks, `if … else`, and `as f64`.
///
/// | sum | over |
/// |---|---|
/// | `sum(0..n, \|j\| …)` | an index; the range may depend on outer indices |
/// | `sum_pairs(0..n, \|j, k\| …)` | pairs with j < k |
/// | `sum_ordered_pairs(0..n, \|j, k\| …)` | pairs with j ≠ k |
/// | `product(0..n, \|j\| …)` | the same as `sum`, with products |
///
/// Indices are sums, differences and literal multiples of bound indices, sizes and integers; `%` is the Euclidean remainder, for
/// periodic neighbours. The sign of the zero of a sum without terms is not defined.
///
/// Numbers are real: `1/2*x` is 0.5·x, as on paper. In front of an `as` Rust would divide integers without the remainder, so
/// `(k / 2) as f64` is refused; `(k as f64) / 2.0` is the quotient. A constant of the user's and a field of a field, whose types
/// are not known, are taken for integers there.
///
/// # Functions of several variables, from data
///
/// A field of the struct whose type implements `dvi_core::ScalarField<D>` is a function of D numbers: `psi(r, z)` in a formula is
/// its value, and derivatives follow by the chain rule from the gradient and the Hessian that the type gives. Terms that need
/// several of these numbers at the same arguments share one evaluation. The type may be a generic of the struct or a reference.
/// Instead of a field it can be a value elsewhere, with its path in `functions(psi = path)`.
///
/// Such a function may be known in a box only, as a table is. A run that leaves it ends with `StepFailure::Outside`, which says
/// which argument of which function went where. The self-check puts another smooth function in the place of the user's: it
/// checks what the compiler makes of the call, not whether gradient and Hessian are those of the value. A gauge needs third
/// derivatives and cannot contain such a function.
///
/// # Gauges
///
/// One-step schemes need an α without a component along one half of the coordinates, and α + dF may be of that kind where α is
/// not. With a gauge, components of α + dF are added up and multiplied out, unless that is too long, so that what cancels is
/// seen.
///
/// `gauge = auto` looks for an F for each half of the coordinates that is made of whole blocks, and takes the one with the
/// shortest α, without the time in F if there is a choice. It integrates the components along that half term by term: powers,
/// and the exponential, logarithm, sine, cosine, their hyperbolic relatives and `erf` of what is linear in a coordinate;
/// products f(w)·w' by substitution; polynomials times exponentials, sines and cosines by parts; and both branches of an `if`
/// whose condition does not depend on the coordinate. Many other functions have an antiderivative that it does not know. The report
/// prints what it has found, and the self-check holds the generated functions against it as if it had been written. A search
/// that ends without an answer is an error with the reason.
///
/// Coordinates and the time stand in no denominator of F that has none in α. Parameters do if nothing else is found, as in
/// `x * (k * y).cos() / k`, and the report says so: F is no number where such a parameter is 0. The integral of 1/x is `x.ln()`
/// if α takes the logarithm or the root of x, else `0.5 * x.powi(2).ln()`.
///
/// # Forces
///
/// `force(x) = …` and `force = […]` declare forces as in [`macro@lagrangian`], for Ω q' = ∇H − F + ∂α/∂t. With α = p·dq that is
/// p' = −∂H/∂q + F_q and q' = ∂H/∂p − F_p. No velocities stand in them: in a degenerate system these are functions of the
/// coordinates. A gauge leaves forces as they are; `time_transform` does not go with them.
///
/// # Time transformations
///
/// With `time_transform = ρ` a run takes steps of equal length in a time τ in which the physical time passes at the rate
/// dt/dτ = ρ(q, t). The system has two coordinates more, `t` and `energy`, and L becomes α·q' − energy·t' − ρ (H − energy).
/// The formulas are written as without it; `t` in them is the coordinate. `system.with_energy(state)` sets `energy` to the value of
/// H, with which a run has to begin. `dvi_core::TimeTransformed` says more.
///
/// # Sizes
///
/// A state and its run live on the stack if all sizes are literals; or if arrays have one const generic as their size, beside at
/// most 16 coordinates of literal number, as in `coordinates(x[N], y[N], w)`. Other sizes are known at run time only, and arrays
/// of such a size are `Vec`s: `field.len()`, a `usize` field, and expressions such as `N + 1`, from which stable Rust makes no
/// array.
///
/// # Parameters
///
/// The struct may be generic over the type of its parameters, `struct System<P = f64> { mu: P, charges: Vec<P> }`. It is then a
/// system wherever that type is a number or, for derivatives with respect to a parameter, a `dvi_core::Varied` dual number. A
/// field of a field has to be a number.
///
/// # Where derivatives have limits
///
/// At the zeros of a root the rules of differentiation give 0/0. Where a limit exists, it is the derivative in these cases:
///
/// - Powers of a sum of squares that is written out with positive literal coefficients or runs over a whole array of
///   coordinates, and of `x.hypot(y)`. First derivatives have it for powers of the distance above 1, second ones above 2, and
///   those of sums over an array from 3 on. So the derivatives of `x.powf(1.5)` at 0 and of `(x*x + y*y).powf(1.5)` at the
///   origin are 0.
/// - Even roots of even powers, third and higher powers of `cbrt`, and the first derivatives of `cos` and `cosh` of a distance.
/// - Products of such powers with coordinates and smooth functions, and sums of these, where a limit is found.
/// - The derivative of `x.abs()` at 0 is taken to be 0, and its square to be 1. The same is true of the root of an even power,
///   which is a product of such sizes.
/// - A function of a sum without terms is a constant where that sum stands directly under a root.
///
/// Elsewhere a derivative that does not exist is not a number: that of `x.hypot(y)` at the origin, for instance, and that of
/// other functions that have no derivative at 0. Sizes are taken to be at least 1 in all this.
///
/// Derivatives are as exact as the arithmetic of their terms. Where a part of one is beyond the range of the numbers, a
/// derivative can be no number or lose its digits although the formula has a value: `x.exp().atan()` at x = 800, or
/// `(x*a).hypot(y*a)/a` with a = 1e-170. The reciprocal of a sum with exponentials, as in Fermi's function `1/(1 + x.exp())`, is
/// taken to be constant where it is 0.
///
/// # Errors
///
/// Each mistake is one error on the token at fault. Ω with a row that is empty for certain is a mistake; another that is singular
/// is an error where a run begins.
#[proc_macro_attribute]
pub fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::degenerate_lagrangian(attribute.into(), item.into()).into()
}

/// Declares a regular system, L(q, v, t) with a regular mass matrix ∂²L/∂v∂v, on the struct of its parameters.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A planet around a fixed sun.
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
///     momenta(angular = x * dot(y) - y * dot(x)),
/// )]
/// struct Kepler {
///     mu: f64,
/// }
///
/// let start: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.2 };
/// let mut run = Integrator::new(&Kepler { mu: 1.0 }, Variational::trapezoid(), 0.01, start)?;
/// run.take_steps(1000)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// For a struct `System` the attribute implements `dvi_core::System`, `dvi_core::Lagrangian` and
/// `dvi_core::NondegenerateLagrangian`; `dvi_core::RegularLagrangian` where all coordinates are numbers without constraints or impacts, else
/// `dvi_core::ManifoldSystem` and `dvi_core::ManifoldLagrangian`, or `dvi_core::ConstrainedSystem` and `dvi_core::HolonomicLagrangian`, `dvi_core::NonholonomicLagrangian` or
/// `dvi_core::UnilateralLagrangian`. It defines `SystemState`
/// with the coordinates `x` and then the velocities `dot_x` as fields, and continues the documentation of the struct with its
/// formulas.
///
/// | argument | meaning |
/// |---|---|
/// | `coordinates(x, y[N], R: SO3, s: S2)` | single coordinates and arrays, as in [`macro@degenerate_lagrangian`]; rotations and unit vectors, as below |
/// | `lagrangian = …` | L, with the velocities `dot(x)` |
/// | `force(x) = …`, `force = […]` | forces, as below |
/// | `constraint = g`, `constraint(i in 0..n) = g(i)` | holonomic constraints, as below |
/// | `nonholonomic = a`, `nonholonomic(i in 0..n) = a(i)` | constraints of the velocities, as below |
/// | `impact = g`, `impact(i in 0..n) = g(i)` | surfaces that the motion bounces off, as below |
/// | `momenta(name = …)` | conserved quantities to watch; velocities may stand in them |
/// | `functions(f = [f, df, d2f], psi = path)` | functions of your own, as in [`macro@degenerate_lagrangian`] |
/// | `derive(Trait, …)` | what the state derives beside the usual traits |
/// | `crate = ::path` | where `dvi_core` is, if it was renamed |
///
/// Formulas, sizes and parameters are those of [`macro@degenerate_lagrangian`], without restriction on the velocities.
///
/// # Forces
///
/// `force(x) = …` declares a force on the coordinate x: friction, a drive, whatever no Lagrangian has. On an array it is
/// `force(x) = |i| …`, the force on entry i. `force = [F_x, |i| F_y]` lists the forces on all coordinates, in the order of
/// declaration. Positions, velocities `dot(x)` and the time may stand in them.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A driven oscillator with friction.
/// #[lagrangian(
///     coordinates(x),
///     lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0,
///     force(x) = -gamma * dot(x) + amplitude * t.cos(),
/// )]
/// struct Driven {
///     gamma: f64,
///     amplitude: f64,
/// }
///
/// let system = Driven { gamma: 0.2, amplitude: 1.0 };
/// let start: DrivenState = DrivenState { x: 0.0, dot_x: 0.0 };
/// let mut run = Integrator::new(&system, Variational::midpoint(), 0.01, start)?;
/// run.take_steps(20_000)?;
/// // After long it moves as amplitude/gamma · sin t.
/// assert!((run.state().x - 5.0 * run.time().sin()).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The equations of motion are those of Lagrange and d'Alembert, d/dt ∂L/∂v = ∂L/∂q + F, and so are the discrete equations of
/// every method: `dvi_core::Lagrangian::applied_force` says more.
///
/// # Constraints
///
/// `constraint = g` declares the holonomic constraint g(q, t) = 0: a rod, a track, a surface. Positions and the time may stand in
/// it, velocities may not. `constraint = [g1, g2]` declares several, and `constraint(i in 0..n) = g` one for each value of an
/// index, whose range is written as that of a sum. Such arguments may follow each other: each adds its constraints to those before.
/// A family whose range is empty in a run has no constraints there.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::{HolonomicLagrangian, ConstrainedSystem, Space};
///
/// /// A chain of rods that hangs from the origin.
/// #[lagrangian(
///     coordinates(x[N], y[N]),
///     lagrangian = sum(0..N, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - g * y[i]),
///     constraint = x[0].powi(2) + y[0].powi(2) - rod * rod,
///     constraint(i in 1..N) = (x[i] - x[i - 1]).powi(2) + (y[i] - y[i - 1]).powi(2) - rod * rod,
/// )]
/// struct Chain<const N: usize> {
///     g: f64,
///     rod: f64,
/// }
///
/// let chain = Chain::<2> { g: 9.81, rod: 1.0 };
/// assert_eq!(chain.multipliers().dimension(), 2);
/// // The first rod hangs down, and the second one is too long.
/// let mut constraints = [0.0; 2];
/// chain.constraint(&[0.0, 2.0, -1.0, -1.0], 0.0, &mut constraints);
/// assert_eq!(constraints, [0.0, 3.0]);
/// ```
///
/// The equations of motion are d/dt ∂L/∂v = ∂L/∂q + F + Gᵀλ with G = ∂g/∂q and a multiplier λ for each constraint, numbered as
/// they are declared. The multipliers are on the stack where the number of constraints is a literal, or a multiple of one const
/// generic and at most 16 more; that of `constraint(i in 0..N - 1)` is known at run time only. The mass matrix is to be regular as
/// without constraints. Methods that keep no constraints do not take such
/// a system: `dvi_core::HolonomicLagrangian` says more.
///
/// `nonholonomic = a` declares the constraint a(q, v, t) = A(q, t) v + b(q, t) = 0 of the velocities, which no function of the
/// positions gives: a blade does not slip to the side, a wheel rolls. Its formula is affine in the velocities `dot(x)`, and at least
/// one of them stands in it. Lists and families are written as those of `constraint`. A system has constraints of one kind, of the
/// positions or of the velocities.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::NonholonomicLagrangian;
///
/// /// A blade on ice, which moves along its edge.
/// #[lagrangian(
///     coordinates(x, y, theta),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2) + inertia * dot(theta).powi(2)) / 2.0,
///     nonholonomic = dot(x) * theta.sin() - dot(y) * theta.cos(),
/// )]
/// struct KnifeEdge {
///     inertia: f64,
/// }
///
/// // The edge lies along x: the blade moves along it, not across.
/// let (blade, mut slip) = (KnifeEdge { inertia: 0.1 }, [0.0]);
/// blade.velocity_constraint(&[0.0; 3], &[1.0, 0.0, 2.0], 0.0, &mut slip);
/// assert_eq!(slip, [0.0]);
/// blade.velocity_constraint(&[0.0; 3], &[1.0, 0.5, 2.0], 0.0, &mut slip);
/// assert_eq!(slip, [-0.5]);
/// ```
///
/// By the principle of Lagrange and d'Alembert the equations of motion are d/dt ∂L/∂v = ∂L/∂q + F + Aᵀλ:
/// `dvi_core::NonholonomicLagrangian` says more.
///
/// # Impacts
///
/// `impact = g` declares a surface g(q, t) = 0 that the motion does not pass: it stays where the gap g(q, t) is not negative, and bounces off
/// where the gap closes. A floor is `impact = y`, the wall of a billiard `impact = 1.0 - x * x - y * y`. Positions and the time may
/// stand in it, velocities may not. Lists and families are written as those of `constraint`: `impact(i in 1..n) = x[i] - x[i - 1] - d` for
/// balls of diameter d on a line. There may be more surfaces than coordinates. A system has either constraints or impacts.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A ball between the floor and a table that moves above it.
/// #[lagrangian(
///     coordinates(y),
///     lagrangian = m * dot(y).powi(2) / 2.0 - m * y,
///     impact = [y, height + 0.1 * t.sin() - y],
/// )]
/// struct Ball {
///     m: f64,
///     height: f64,
/// }
///
/// let (ball, mut gaps) = (Ball { m: 1.0, height: 2.0 }, [0.0; 2]);
/// ball.gap(&[0.5], 0.0, &mut gaps);
/// assert_eq!(gaps, [0.5, 1.5]);
/// let method = Impacts::reflecting(Variational::trapezoid());
/// let mut run = Integrator::new(&ball, method, 0.01, BallState { y: 1.0, dot_y: -0.5 })?;
/// run.take_steps(2000)?;
/// // It never reaches the table: it falls for one unit of time, and then hits the floor every three.
/// assert_eq!(run.memory().total(), 7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Such systems are stepped by `Impacts` around a variational method. Methods that know no impacts do not take them:
/// `dvi_core::UnilateralLagrangian` says more.
///
/// # Rotations and unit vectors
///
/// `R: SO3` declares a rotation matrix, which takes vectors of a body to those of space. Formulas have its entries `R[i][j]` and the
/// angular velocity in the body `omega(R)[k]`, with the literals 0, 1 and 2 as indices. `omega(R)` is ω with Ṙ = R ω̂, ω̂ x = ω × x. In the state
/// the rotation is `R`, nine entries row by row, and its velocity `omega_R`, three. `s: S2` declares a unit vector, with entries `s[i]` and
/// velocities `dot(s[i])` as of an array of three.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::rotations;
///
/// /// A satellite with a mass on a rod, which turns about its centre, and is drawn to the third axis of the satellite.
/// #[lagrangian(
///     coordinates(R: SO3, s: S2),
///     lagrangian = (2.0 * omega(R)[0].powi(2) + 3.0 * omega(R)[1].powi(2) + 4.0 * omega(R)[2].powi(2)) / 2.0
///         + sum(0..3, |i| dot(s[i]).powi(2)) / 2.0
///         + pull * (s[0] * R[0][2] + s[1] * R[1][2] + s[2] * R[2][2]),
/// )]
/// struct Satellite {
///     pull: f64,
/// }
///
/// let start: SatelliteState = SatelliteState {
///     R: rotations::exp([0.1, 0.0, 0.0]),
///     s: [0.6, 0.0, 0.8],
///     omega_R: [0.0, 0.1, 1.0],
///     dot_s: [0.0, 0.5, 0.0],
/// };
/// let mut run = Integrator::new(&Satellite { pull: 0.5 }, Geodesic::trapezoid(), 0.05, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-3);
/// assert!(rotations::defect(&run.state().R) < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Such systems are stepped by `Geodesic`, and other methods do not take them: `dvi_core::ManifoldLagrangian` says more. They have neither
/// forces nor constraints nor impacts, and neither sections nor step controls know them.
///
/// # Errors
///
/// Each mistake is one error on the token at fault. A mass matrix with an empty row is a mistake; another that is singular is an
/// error where a run begins.
#[proc_macro_attribute]
pub fn lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::lagrangian(attribute.into(), item.into()).into()
}
