//! The judge of short steps.

use super::{Course, Judge, LARGE, MOST_IN_VAIN, Verdict};
use crate::Real;

/// The judge that gives up where an iterate is to be put to the test, or its sizes are to be taken again:
/// what it takes to do that costs a short step a tenth of its instructions. A
/// [`Convergence`](super::Convergence) judges the step again then.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quick<T>(Course<T>);

impl<T: Real> Judge<T> for Quick<T> {
    const NAMES: bool = false;

    #[inline]
    fn of(course: Course<T>) -> Self {
        Self(course)
    }

    #[inline]
    fn judge(&mut self, correction: T) -> Verdict {
        let course = &mut self.0;
        let shrunk = course.take(correction) - correction;
        if correction <= course.tolerance {
            return Verdict::Accept;
        }
        // The first correction comes after none and does not shrink, which takes 27 instructions less from a
        // loop of many iterations than to ask; of Newton's method the compiler takes the first apart.
        let is_first = course.iterations == 1;
        let is_alone = is_first && !course.is_fixed_point;
        if !is_alone && correction * correction < course.tolerance * shrunk {
            return Verdict::Accept;
        }
        if is_alone || !course.is_shrinking(shrunk) {
            // What is not a number is not small.
            let is_small = correction <= T::lift(LARGE);
            if !is_small {
                return Verdict::GiveUp;
            }
            if !is_first {
                if course.is_noise() {
                    return Verdict::Accept;
                }
                // Newton's method does not creep, but by rounding errors.
                course.in_vain += usize::from(shrunk <= T::lift(0.0) || !course.is_fixed_point);
                if course.in_vain > MOST_IN_VAIN {
                    return Verdict::GiveUp;
                }
            }
        }
        course.go_on()
    }

    #[inline]
    fn course(&mut self) -> &mut Course<T> {
        &mut self.0
    }
}
