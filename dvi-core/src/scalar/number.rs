//! The numbers that parameters of a formula are.

/// A parameter of a formula: a number, or a reference to one.
///
/// Implemented for the numbers of Rust. A struct may be generic over the type of a field that a formula uses:
/// `struct System<P: Number> { stiffness: P }`.
#[diagnostic::on_unimplemented(
    message = "a parameter of a formula must be a number, `{Self}` is not",
    label = "not a number"
)]
pub trait Number: Copy {
    /// Its value.
    fn number(self) -> f64;
}

macro_rules! number {
    ($($type:ty),*) => {$(
        impl Number for $type {
            #[inline(always)]
            fn number(self) -> f64 {
                self as f64
            }
        }
    )*};
}

number!(f64, f32, i8, i16, i32, i64, isize, u8, u16, u32, u64, usize);

#[diagnostic::do_not_recommend]
impl<N: Number> Number for &N {
    #[inline(always)]
    fn number(self) -> f64 {
        (*self).number()
    }
}
