//! One error for a method that does not suit a system.
//!
//! rustc reports it where the run begins. If it knew the type of the run nevertheless, it would report of all
//! that is done with the run that there is no such function. So a run takes its method from the trait of the
//! kind of systems that the method asks for, as `Suited<M>`: this is `M` if the system has the trait, and
//! unknown if it has not.
//!
//! Of what is unknown rustc asks nothing. So a second question, whether the method inside fits into
//! [`Constrained`](crate::methods::Constrained) or a step control goes with the system, is asked of a type
//! that is known where the first has its answer: there is one error at a time.
//!
//! Where the type of a run is written out, in a field or as an argument, rustc knows it: each function that
//! is called is one more error. An alias for the type could leave it unknown there too; but of an alias
//! `Integrator::new` does not find its method, and a field of that type is an error wherever it is used.

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
