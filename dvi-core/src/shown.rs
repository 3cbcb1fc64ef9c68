//! `Debug` of types with parts that cannot be shown, or that say little.

/// `shown!([generics] Type<arguments>, |value| name: part, …)`: these parts, and that there are others.
macro_rules! shown {
    ([$($generics:tt)*] $Type:ident<$($argument:tt),+>, |$this:ident| $($name:ident: $part:expr),+) => {
        impl<$($generics)*> core::fmt::Debug for $Type<$($argument),+> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let $this = self;
                let mut shown = f.debug_struct(stringify!($Type));
                $(shown.field(stringify!($name), &$part);)+
                shown.finish_non_exhaustive()
            }
        }
    };
}
pub(crate) use shown;
