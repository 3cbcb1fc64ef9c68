//! The widest SIMD instructions that the processor has, chosen when a program runs.

/// Something to do. A closure would do, if stable Rust could say that it is always to be inlined: what is not inlined is
/// compiled for the instructions that all processors have.
pub trait Task {
    /// What comes of it.
    type Output;
    /// Does it. Implementations are `#[inline(always)]`.
    fn run(self) -> Self::Output;
}

/// Runs `task`, compiled for the widest instructions that this processor has, as far as it is inlined.
///
/// The results are the same on every processor: operations on packs are those on their lanes.
#[cfg(feature = "simd")]
#[inline(always)]
pub(crate) fn widest<K: Task>(task: K) -> K::Output {
    struct Dispatched<K>(K);

    impl<K: Task> pulp::WithSimd for Dispatched<K> {
        type Output = K::Output;
        #[inline(always)]
        fn with_simd<S: pulp::Simd>(self, _simd: S) -> K::Output {
            self.0.run()
        }
    }

    pulp::Arch::new().dispatch(Dispatched(task))
}

/// Runs `task`.
#[cfg(not(feature = "simd"))]
#[inline(always)]
pub(crate) fn widest<K: Task>(task: K) -> K::Output {
    task.run()
}
