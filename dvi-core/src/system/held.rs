//! How a run has its system: as its own, borrowed or shared.

use super::System;

/// A system as a run takes it: the system itself, which the run then owns, `&S`, which it borrows, and with
/// `alloc` `Box<S>`, `Rc<S>` and `Arc<S>`.
///
/// A run on a system of its own borrows nothing, so that a struct can hold it and a thread can take it;
/// steps are the same, bit for bit, and take as many instructions. The attributes implement this trait with
/// [`System`]; a system written by hand returns itself.
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
