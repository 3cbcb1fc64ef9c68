//! How a run has its system: as its own, borrowed or shared.

use super::System;

/// A system as a run takes it: the system itself, which the run then owns, `&S`, which it borrows, and with
/// `alloc` `Box<S>`, `Rc<S>` and `Arc<S>`.
///
/// A run on a system of its own borrows nothing, so that a struct can hold it and a thread can take it;
/// steps are the same, bit for bit, and take as many instructions. The attributes implement this trait with
/// [`System`]; a system written by hand returns itself.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// use std::sync::Arc;
///
/// /// The energy after 100 steps, of a run that owns, borrows or shares its system.
/// fn energy(system: impl Held<System = Pendulum>) -> Result<f64, Box<dyn std::error::Error>> {
///     let start = PendulumState { angle: 1.0, dot_angle: 0.0 };
///     let mut run = Integrator::new(system, Variational::trapezoid(), 0.1, start)?;
///     run.take_steps(100)?;
///     Ok(run.energy())
/// }
/// assert_eq!(energy(Pendulum)?, energy(&Pendulum)?);
/// assert_eq!(energy(Pendulum)?, energy(Arc::new(Pendulum))?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a system",
    label = "it has neither `#[lagrangian]` nor `#[degenerate_lagrangian]`",
    note = "a run takes a system, `&system`, and a `Box`, `Rc` or `Arc` of one"
)]
pub trait Held {
    /// The system.
    type System: System;
    /// The system, to look at.
    fn held(&self) -> &Self::System;
}

/// What leads to a system.
macro_rules! held {
    ($($(#[$when:meta])? $pointer:ty),* $(,)?) => {$(
        $(#[$when])?
        impl<S: System> Held for $pointer {
            type System = S;
            #[inline]
            fn held(&self) -> &S {
                self
            }
        }
    )*};
}
held!(
    &S,
    #[cfg(feature = "alloc")]
    alloc::boxed::Box<S>,
    #[cfg(feature = "alloc")]
    alloc::rc::Rc<S>,
    #[cfg(feature = "alloc")]
    alloc::sync::Arc<S>,
);
