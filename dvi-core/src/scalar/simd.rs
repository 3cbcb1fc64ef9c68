//! The widest SIMD instructions that the processor has, chosen when a program runs.

/// Runs `body`, compiled for the widest instructions that this processor has, as far as it is inlined.
///
/// The results are the same on every processor: operations on packs are those on their lanes. Where there
/// are debug assertions, nothing is forced inline, and all instructions are those of every processor: there
/// code is compiled once, and not for each of them.
#[cfg(all(feature = "simd", not(debug_assertions)))]
fn widest<R>(body: impl FnOnce() -> R) -> R {
    struct Dispatched<F>(F);

    impl<R, F: FnOnce() -> R> pulp::WithSimd for Dispatched<F> {
        type Output = R;
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn with_simd<S: pulp::Simd>(self, _simd: S) -> R {
            (self.0)()
        }
    }

    pulp::Arch::new().dispatch(Dispatched(body))
}

/// Runs `body`.
#[cfg(not(all(feature = "simd", not(debug_assertions))))]
fn widest<R>(body: impl FnOnce() -> R) -> R {
    body()
}

/// Runs `body`, if it is `worth_it` compiled for the widest instructions that the processor has: for loops
/// over [lanes](crate::scalar::Lanes). The results are the same on every processor.
///
/// The closure is to be `#[inline(always)]` where it is written, and so is what it calls: what is not inlined
/// is compiled for the instructions that all processors have. Without the feature `simd`, and where
/// `dvi-core` has debug assertions, all of it is.
///
/// ```
/// use dvi_core::scalar::{Lanes, widest_if};
///
/// let numbers: Vec<Lanes<8>> = (0..100).map(|i| Lanes([f64::from(i); 8])).collect();
/// let mut squares = numbers.clone();
/// widest_if(numbers.len() > 16, #[inline(always)] || {
///     squares.iter_mut().for_each(|x| *x = *x * *x);
/// });
/// assert_eq!(squares[99].0, [9801.0; 8]);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn widest_if<R>(worth_it: bool, body: impl FnOnce() -> R) -> R {
    if worth_it { widest(body) } else { body() }
}

/// The value of an expression, by [`widest_if`].
macro_rules! wide_if {
    ($worth_it:expr, $body:expr) => {
        $crate::scalar::simd::widest_if(
            $worth_it,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || $body,
        )
    };
}

pub(crate) use wide_if;

/// Runs `body` apart from its caller, if it is `worth_it`: compiled for the instructions of every processor,
/// as far as it does not choose others itself.
///
/// Elementary functions take one number at a time, and a call of one takes longer between the widest
/// instructions. So the formulas of a system stand apart from a step that uses these.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn apart_if<R>(worth_it: bool, body: impl FnOnce() -> R) -> R {
    #[inline(never)]
    fn apart<R>(body: impl FnOnce() -> R) -> R {
        body()
    }

    if worth_it { apart(body) } else { body() }
}
