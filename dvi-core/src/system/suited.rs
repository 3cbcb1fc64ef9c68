//! One error for a method that does not suit a system.
//!
//! rustc reports it where the run begins. If it knew the type of the run nevertheless, it would report of all
//! that is done with the run that there is no such function. So a run takes its method from the trait of the
//! kind of systems that the method asks for, as `Suited<M>`: this is `M` if the system has the trait, and
//! unknown if it has not.

/// A type that is `M`, by another name.
pub trait Same<M> {
    /// `M`.
    type As;
    /// The value as it is.
    fn same(value: M) -> Self::As;
}

impl<M> Same<M> for M {
    type As = M;
    #[inline]
    fn same(value: M) -> M {
        value
    }
}
