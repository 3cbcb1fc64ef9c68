//! What a run carries from step to step: copied when a step is taken back, and written down when a run is to
//! go on another day.
//!
//! Each type that carries something lists it once, by [`lasting!`]; copying, saving and loading follow from
//! the list.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

#[cfg(feature = "alloc")]
use crate::Real;
#[cfg(feature = "alloc")]
use crate::error::CheckpointError;

/// Where something is kept that is as large as the memory of a run, and that most runs do not have.
#[cfg(feature = "alloc")]
pub(crate) type Aside<R> = alloc::boxed::Box<R>;
#[cfg(not(feature = "alloc"))]
pub(crate) type Aside<R> = R;

/// What is made in a frame of its own on the stack, which it may fill.
#[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
#[inline(never)]
pub(crate) fn aside<R>(make: impl FnOnce() -> R) -> Aside<R> {
    make().into()
}

/// What a run of a method carries from step to step besides the coordinates. Of work space, which each step
/// writes before it reads it, these functions take no notice.
pub trait Memory<T> {
    /// Takes over from `from` all that the next step can depend on, without allocation. Both belong to one
    /// method on one system.
    fn restore(&mut self, from: &Self);

    /// Appends all that the next step can depend on.
    #[cfg(feature = "alloc")]
    fn save(&self, record: &mut Record<T>);

    /// Takes over what [`save`](Self::save) has appended.
    ///
    /// # Errors
    /// [`CheckpointError`] if the record does not have what belongs here.
    #[cfg(feature = "alloc")]
    fn load(&mut self, record: &mut Record<T>) -> Result<(), CheckpointError>;
}

#[cfg(feature = "alloc")]
impl<T, R: Memory<T>> Memory<T> for Aside<R> {
    fn restore(&mut self, from: &Self) {
        (**self).restore(from);
    }
    fn save(&self, record: &mut Record<T>) {
        (**self).save(record);
    }
    fn load(&mut self, record: &mut Record<T>) -> Result<(), CheckpointError> {
        (**self).load(record)
    }
}

/// Numbers and counts, in the order in which a run lists what it carries, and how far they have been read.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Record<T> {
    numbers: Vec<T>,
    counts: Vec<u64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    read: [usize; 2],
}

#[cfg(feature = "alloc")]
impl<T: Copy> Record<T> {
    pub(crate) fn new() -> Self {
        Self { numbers: Vec::new(), counts: Vec::new(), read: [0; 2] }
    }

    /// Appends numbers.
    pub fn numbers(&mut self, numbers: &[T]) {
        self.numbers.extend_from_slice(numbers);
    }

    /// Appends a count.
    pub fn count(&mut self, count: u64) {
        self.counts.push(count);
    }

    /// Reads the next numbers, as many as there are places.
    ///
    /// # Errors
    /// [`CheckpointError`] if there are fewer.
    pub fn read(&mut self, places: &mut [T]) -> Result<(), CheckpointError> {
        let next = self.read[0]..self.read[0] + places.len();
        places.copy_from_slice(self.numbers.get(next).ok_or(CheckpointError::Short)?);
        self.read[0] += places.len();
        Ok(())
    }

    /// Reads the next count.
    ///
    /// # Errors
    /// [`CheckpointError`] if there is none.
    pub fn read_count(&mut self) -> Result<u64, CheckpointError> {
        let count = *self.counts.get(self.read[1]).ok_or(CheckpointError::Short)?;
        self.read[1] += 1;
        Ok(count)
    }

    /// Whether it is as long as another one.
    ///
    /// # Errors
    /// [`CheckpointError::Short`] or [`CheckpointError::Long`].
    pub(crate) fn fits(&self, expected: &Self) -> Result<(), CheckpointError> {
        let missing = [expected.numbers.len(), expected.counts.len()];
        match [self.numbers.len().checked_sub(missing[0]), self.counts.len().checked_sub(missing[1])] {
            [Some(0), Some(0)] => Ok(()),
            [Some(numbers), Some(counts)] => Err(CheckpointError::Long { more: numbers + counts }),
            [None, _] | [_, None] => Err(CheckpointError::Short),
        }
    }

    /// All numbers, and all counts.
    pub(crate) fn parts(&self) -> (&[T], &[u64]) {
        (&self.numbers, &self.counts)
    }

    /// Whether all numbers are finite, as those of a run are.
    pub(crate) fn is_finite(&self) -> bool
    where
        T: Real,
    {
        self.numbers.iter().all(|number| number.is_finite())
    }
}

/// `lasting!([generics] Struct, T; kind field, …)`: [`Memory`] of a struct, from the list of what it carries;
/// without the struct, the functions alone. The kinds are
///
/// - `numbers`, a vector; `number`, a `T`; `count`, an integer; `flag`, a `bool`; `bits`, an `f64`; `size`,
///   a `T` that is no part of the motion and may be no number
/// - `packs`, vectors of packs
/// - `part`, something that has a list of its own; `parts`, an array or `Option` of such, `vectors`, an
///   array of vectors
///
/// After `; name` stands a function that says whether what has been loaded can be gone on with: a file may
/// be damaged.
macro_rules! lasting {
    ([$($generics:tt)*] $Struct:ty, $T:ty; $($list:tt)*) => {
        impl<$($generics)*> $crate::memory::Memory<$T> for $Struct {
            $crate::memory::lasting!($T; $($list)*);
        }
    };
    ($T:ty; $($kind:ident $field:tt),* $(,)? $(; $sound:ident)?) => {
        #[inline]
        fn restore(&mut self, #[allow(unused_variables)] from: &Self) {
            $($crate::memory::lasting!(@restore $T, $kind self.$field, from.$field);)*
        }
        #[cfg(feature = "alloc")]
        fn save(&self, #[allow(unused_variables)] record: &mut $crate::memory::Record<$T>) {
            $($crate::memory::lasting!(@save $kind self.$field, record);)*
        }
        #[cfg(feature = "alloc")]
        fn load(
            &mut self,
            #[allow(unused_variables)] record: &mut $crate::memory::Record<$T>,
        ) -> Result<(), $crate::error::CheckpointError> {
            $($crate::memory::lasting!(@load $T, $kind self.$field, record);)*
            $(
                if !self.$sound() {
                    return Err($crate::error::CheckpointError::Damaged);
                }
            )?
            Ok(())
        }
    };
    (@restore $T:ty, numbers $to:expr, $from:expr) => { $to.copy_from_slice(&$from) };
    (@restore $T:ty, packs $to:expr, $from:expr) => {
        $crate::memory::lasting!(@restore $T, vectors $to, $from)
    };
    (@restore $T:ty, part $to:expr, $from:expr) => {
        $crate::memory::Memory::<$T>::restore(&mut $to, &$from)
    };
    (@restore $T:ty, parts $to:expr, $from:expr) => {
        for (to, from) in $to.iter_mut().zip($from.iter()) {
            $crate::memory::Memory::<$T>::restore(to, from);
        }
    };
    (@restore $T:ty, vectors $to:expr, $from:expr) => {
        for (to, from) in $to.iter_mut().zip($from.iter()) {
            to.copy_from_slice(from);
        }
    };
    (@restore $T:ty, $kind:ident $to:expr, $from:expr) => { $to = $from };

    (@save numbers $from:expr, $record:ident) => { $record.numbers(&$from) };
    (@save number $from:expr, $record:ident) => { $record.numbers(&[$from]) };
    (@save count $from:expr, $record:ident) => { $record.count($from as u64) };
    (@save flag $from:expr, $record:ident) => { $record.count(u64::from($from)) };
    (@save bits $from:expr, $record:ident) => { $record.count($from.to_bits()) };
    (@save size $from:expr, $record:ident) => { $record.count($crate::scalar::norm::reported($from).to_bits()) };
    (@save part $from:expr, $record:ident) => { $from.save($record) };
    (@save parts $from:expr, $record:ident) => { $from.iter().for_each(|part| part.save($record)) };
    (@save packs $from:expr, $record:ident) => {
        for pack in $from.iter().flat_map(|packs| packs.iter()) {
            $record.numbers(&pack.0);
        }
    };
    (@save vectors $from:expr, $record:ident) => { $from.iter().for_each(|vector| $record.numbers(vector)) };

    (@load $T:ty, numbers $to:expr, $record:ident) => { $record.read(&mut $to)? };
    (@load $T:ty, number $to:expr, $record:ident) => { $record.read(core::slice::from_mut(&mut $to))? };
    (@load $T:ty, count $to:expr, $record:ident) => {
        $to = $record.read_count()?.try_into().map_err(|_| $crate::error::CheckpointError::Damaged)?
    };
    (@load $T:ty, flag $to:expr, $record:ident) => {
        $to = match $record.read_count()? {
            0 => false,
            1 => true,
            _ => return Err($crate::error::CheckpointError::Damaged),
        }
    };
    (@load $T:ty, size $to:expr, $record:ident) => {
        $to = <$T>::lift(f64::from_bits($record.read_count()?))
    };
    (@load $T:ty, bits $to:expr, $record:ident) => { $to = f64::from_bits($record.read_count()?) };
    (@load $T:ty, part $to:expr, $record:ident) => { $to.load($record)? };
    (@load $T:ty, parts $to:expr, $record:ident) => { for part in $to.iter_mut() { part.load($record)?; } };
    (@load $T:ty, packs $to:expr, $record:ident) => {
        for pack in $to.iter_mut().flat_map(|packs| packs.iter_mut()) {
            $record.read(&mut pack.0)?;
        }
    };
    (@load $T:ty, vectors $to:expr, $record:ident) => {
        for vector in $to.iter_mut() { $record.read(vector)?; }
    };
}
pub(crate) use lasting;

impl<T> Memory<T> for () {
    lasting!(T;);
}
