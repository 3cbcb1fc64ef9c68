//! What can be measured on a run: preserved two-forms, Lyapunov exponents, work, orders of convergence.
//!
//! Energy and momenta are methods of [`Run`](crate::run::Run). The tangent maps here are those of methods
//! whose discrete Lagrangian can be differentiated twice,
//! [`VariationalMethod`](crate::methods::VariationalMethod). The tangent map of any other method is its run
//! on numbers that carry a derivative: runs are generic over [`Real`](crate::Real), which the dual numbers
//! of the crate num-dual are. That is exact where a step is explicit, and where Newton's method solves it
//! with an exact matrix, which it does in dual numbers by default unless a frequency is read from the
//! motion. An iteration decides by the values alone, because dual numbers are compared by their values; so
//! it goes on after these have converged, by Newton's method for two iterations and by a fixed point for 64,
//! which leave r⁶⁴ of the error of a derivative at a rate of convergence r. Where a frequency that is read
//! from the motion has a kink, which [`Curvature`](crate::discrete::Curvature) has on straight paths, the
//! derivatives are those of no tangent map.

mod convergence;
mod lyapunov;
mod tangent;
mod work;

pub use convergence::convergence_order;
pub use lyapunov::LyapunovExponent;
pub use tangent::TangentMap;
pub use work::Work;
