//! The state with named coordinates, and the space that it lives in.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::Ident;
use syn::ext::IdentExt as _;

use crate::emit::{Emitter, local};
use crate::model::{Block, Grid, Model};
use crate::symbolic::{Atom, Count, Index};
use crate::syntax::Factor;

mod rows;
mod types;

pub(super) use types::on_stack;
use types::{field_type, fixed, is_name};

pub(crate) struct State {
    /// The struct and its implementations.
    pub(crate) item: TokenStream,
    /// The state as a type over `__T`, with the generics of the system in scope.
    pub(crate) type_in_trait: TokenStream,
    pub(crate) space: TokenStream,
    /// The space as a value in a method of the system.
    pub(crate) space_value: TokenStream,
}

/// With so many coordinates of known number beside arrays of a const generic `N`, each of which takes the
/// place of `N`, a space is still one of fixed size.
const MOST_SINGLES: usize = 16;

/// So many numbers, if they are known when the macro runs, are kept on the stack together with matrices of
/// them.
const FEW: usize = 12;

/// The space of as many numbers as these sizes are together, each of which is zero where it is negative: its
/// type and its value. Fixed if all sizes are literals, or one const generic beside a few literals; else
/// known at run time.
pub(super) fn space_of(emitter: &Emitter<'_>, sizes: &[Count]) -> (TokenStream, TokenStream) {
    let (model, krate) = (emitter.model, emitter.krate());
    let is_constant =
        |size: &Count| size.rows.is_none() && model.is_constant(&size.rest) && is_name(&size.rest);
    let mut names: Vec<&Count> = Vec::new();
    let (mut arrays, mut singles) = (0, 0);
    for size in sizes {
        match size.as_literal() {
            Some(literal) => singles += literal as usize,
            None => {
                arrays += 1;
                if !names.contains(&size) {
                    names.push(size);
                }
            }
        }
    }
    let fixed = |blocks: TokenStream, size: TokenStream, singles: usize| {
        let space = quote!(#krate::Fixed<#blocks, { #size }, #singles, #krate::__private::FewInPlace>);
        (space, quote!(#krate::Fixed::new()))
    };
    match names.as_slice() {
        [] if singles <= FEW => (quote!(#krate::Fixed<1usize, { #singles }>), quote!(#krate::Fixed::new())),
        [] => fixed(quote!(1usize), quote!(#singles), 0),
        [size] if is_constant(size) && singles <= MOST_SINGLES => {
            let blocks = arrays + singles;
            fixed(quote!(#blocks), emitter.length(size), singles)
        }
        _ => {
            let dimension = dimension(emitter, sizes);
            (quote!(#krate::RunTime), quote!(#krate::RunTime { dimension: #dimension }))
        }
    }
}

/// The sum of the sizes, those below zero taken for zero.
fn dimension(emitter: &Emitter<'_>, sizes: &[Count]) -> TokenStream {
    let is_plain = |size: &&Count| size.rows.is_none() && size.is_natural();
    let (plain, others): (Vec<&Count>, Vec<&Count>) = sizes.iter().partition(is_plain);
    let plain = plain.into_iter().fold(Index::default(), |sum, size| sum.plus(&size.rest, 1));
    let mut dimension = emitter.index(&plain);
    for size in others {
        let size = emitter.length(size);
        dimension = quote!(#dimension + #size);
    }
    dimension
}

pub(crate) fn state(emitter: &Emitter<'_>) -> State {
    let (model, krate) = (emitter.model, emitter.krate());
    let [name, of_f64] = names(&model.item.ident);
    let visibility = &model.item.vis;
    let constants = constants(emitter);
    let declarations = constants.iter().map(|name| quote!(const #name: ::core::primitive::usize));
    let declarations: Vec<TokenStream> = declarations.collect();
    let sizes: Vec<Count> = (0..model.blocks.len()).map(|block| model.block_size(block).into()).collect();
    let (space, space_value) = space_of(emitter, &sizes);
    let (fields, docs): (Vec<Ident>, Vec<String>) = fields(model).into_iter().unzip();
    let coordinates = model.coordinates();
    let halves =
        [false, true].into_iter().flat_map(|half| coordinates.iter().map(move |of| (of.start, half)));
    let types = halves.map(|(block, is_velocity)| field_type(emitter, block, is_velocity));
    let types: Vec<TokenStream> = types.take(fields.len()).collect();
    let contents = if model.has_velocities() { "coordinates and velocities" } else { "coordinates" };
    let system = &model.item.ident;
    let summary = format!("A state of [`{system}`]: its {contents} by name, in numbers of type `__T`.");
    let summary_of_f64 = format!("A state of [`{system}`]: its {contents} by name.");
    let written = of_f64.unraw().to_string();
    let labels: Vec<String> = fields.iter().map(|field| field.unraw().to_string()).collect();
    let is_on_stack = (0..model.blocks.len()).all(|block| on_stack(emitter, block));
    let copy = is_on_stack.then(|| quote!(::core::marker::Copy,));
    let derives = &model.derives;
    let Transfers { write, read, refill } = transfers(emitter, &fields);
    // What is read anew without allocation needs no other way.
    let refill = (!is_on_stack).then(|| {
        quote! {
            fn refill(
                &mut self,
                __len: &dyn ::core::ops::Fn(::core::primitive::usize) -> ::core::primitive::usize,
                __q: &[__T],
                __v: &[__T],
            ) {
                #refill
            }
        }
    });
    let values: Vec<Ident> = (0..fields.len()).map(value_name).collect();
    let allow = super::allow();
    // From and into the tuple of the fields, or the field itself if there is one only.
    let conversions = quote! {
        #[automatically_derived]
        #allow
        impl<#(#declarations,)* __T> ::core::convert::From<(#(#types,)*)> for #name<#(#constants,)* __T> {
            fn from((#(#values,)*): (#(#types,)*)) -> Self {
                Self { #(#fields: #values),* }
            }
        }
        #[automatically_derived]
        #allow
        impl<#(#declarations,)* __T> ::core::convert::From<#name<#(#constants,)* __T>> for (#(#types,)*) {
            fn from(__state: #name<#(#constants,)* __T>) -> Self {
                (#(__state.#fields,)*)
            }
        }
    };
    let conversions = (!fields.is_empty()).then_some(conversions);
    let item = quote! {
        #[doc = #summary]
        #allow
        #[derive(#copy ::core::clone::Clone, ::core::cmp::PartialEq, #(#derives),*)]
        #visibility struct #name<#(#declarations,)* __T> {
            #(#[doc = #docs] pub #fields: #types,)*
        }
        #[doc = #summary_of_f64]
        #allow
        #[allow(dead_code)]
        #visibility type #of_f64<#(#declarations),*> = #name<#(#constants,)* ::core::primitive::f64>;
        #[automatically_derived]
        #allow
        impl<#(#declarations,)* __T: ::core::fmt::Debug> ::core::fmt::Debug for #name<#(#constants,)* __T> {
            fn fmt(&self, __f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                __f.debug_struct(#written)#(.field(#labels, &self.#fields))*.finish()
            }
        }
        #[automatically_derived]
        #allow
        impl<#(#declarations,)* __T: #krate::Scalar> #krate::State<__T> for #name<#(#constants,)* __T> {
            fn write(
                &self,
                __len: &dyn ::core::ops::Fn(::core::primitive::usize) -> ::core::primitive::usize,
                __q: &mut [__T],
                __v: &mut [__T],
            ) -> ::core::result::Result<(), #krate::LengthError> {
                #write
                ::core::result::Result::Ok(())
            }
            fn read(
                __len: &dyn ::core::ops::Fn(::core::primitive::usize) -> ::core::primitive::usize,
                __q: &[__T],
                __v: &[__T],
            ) -> Self {
                #read
                Self { #(#fields: #values),* }
            }
            #refill
        }
        #conversions
    };
    State { item, type_in_trait: quote!(#name<#(#constants,)* __T>), space, space_value }
}

/// The names of states: in numbers of any type, and in `f64`, which a literal needs no annotation for.
pub(crate) fn names(system: &Ident) -> [Ident; 2] {
    [format_ident!("{system}StateOf"), format_ident!("{system}State")]
}

/// The fields with their documentation: all coordinates, then all velocities if there are any.
fn fields(model: &Model) -> Vec<(Ident, String)> {
    let described = |block: &Block, what: &str| match (&block.array, block.name.unraw(), block.axis) {
        (Some((_, size)), name, None) => match &block.grid {
            Some(Grid { texts: [n, m], .. }) => {
                format!("{what}s `{name}[0][0]` to `{name}[{n} - 1][{m} - 1]`.")
            }
            None => format!("{what}s `{name}[0]` to `{name}[{size} - 1]`."),
        },
        (Some((_, size)), name, Some(axis)) => {
            format!("{what}s `{name}[0]` to `{name}[{size} - 1]`, vectors with {} components.", axis.of)
        }
        (None, name, _) => format!("{what} `{name}`."),
    };
    // Of one, or of those of an array.
    let turning = |block: &Block, [one, all]: [&str; 2]| match (&block.array, block.axis) {
        (Some((_, size)), Some(_)) => format!("{all} `{0}[0]` to `{0}[{size} - 1]`", block.name.unraw()),
        _ => format!("The {one} `{}`", block.name.unraw()),
    };
    let coordinate = |block: &Block| match block.factor {
        Factor::Line => described(block, "Coordinate"),
        Factor::Rotation => {
            let matrices = turning(block, ["rotation matrix", "Rotation matrices"]);
            format!("{matrices}, row by row: from the body to space.")
        }
        Factor::Sphere => format!("{}.", turning(block, ["unit vector", "Unit vectors"])),
    };
    let velocity = |block: &Block| match block.factor {
        Factor::Line | Factor::Sphere => described(block, "Velocity of coordinate"),
        Factor::Rotation => {
            format!("{}, in the body.", turning(block, ["angular velocity of", "Angular velocities of"]))
        }
    };
    let declared: Vec<&Block> = model.coordinates().iter().map(|of| &model.blocks[of.start]).collect();
    let coordinates = declared.iter().map(|block| (block.name.clone(), coordinate(block)));
    let velocities = declared.iter().filter(|_| model.has_velocities());
    let velocities = velocities.map(|block| (block.velocity_name(), velocity(block)));
    coordinates.chain(velocities).collect()
}

/// The const generics of the struct that sizes of arrays name.
fn constants(emitter: &Emitter<'_>) -> Vec<Ident> {
    let model = emitter.model;
    let used = |name: &Ident| {
        (0..model.blocks.len()).flat_map(|block| fixed(emitter, block)).any(|size| {
            let is_name =
                |atom: &Atom| matches!(atom, Atom::Size(size) if *name == model.sizes[size.0 as usize].text);
            size.terms.iter().any(|(atom, _)| is_name(atom))
        })
    };
    model.item.generics.const_params().map(|constant| constant.ident.clone()).filter(used).collect()
}

/// A local name: that of the field may be the name of a constant, which is no place to bind to.
fn value_name(field: usize) -> Ident {
    local(format_args!("value{field}"))
}

/// The bodies of `write`, `read` and `refill`: the coordinates go to and come from `__q`, the velocities
/// `__v`.
#[derive(Default)]
struct Transfers {
    write: TokenStream,
    read: TokenStream,
    refill: TokenStream,
}

fn transfers(emitter: &Emitter<'_>, fields: &[Ident]) -> Transfers {
    let coordinates = emitter.model.coordinates();
    let count = coordinates.len().max(1);
    let Transfers { mut write, mut read, mut refill } = Transfers::default();
    for (half, (names, flat)) in fields.chunks(count).zip([quote!(__q), quote!(__v)]).enumerate() {
        write.extend(quote!(let mut __at = 0usize;));
        read.extend(quote!(let mut __at = 0usize;));
        refill.extend(quote!(let mut __at = 0usize;));
        for (number, (field, blocks)) in names.iter().zip(&coordinates).enumerate() {
            let (block, name) = (blocks.start, value_name(half * count + number));
            let one = match &emitter.model.blocks[block].grid {
                Some(_) => rows::transfer(emitter, block, field, &flat),
                None => transfer(emitter, block, half == 1, field, &flat),
            };
            let value = one.read;
            write.extend(one.write);
            read.extend(quote!(let #name = #value;));
            refill.extend(one.refill);
        }
    }
    Transfers { write, read, refill }
}

/// The statements that write a field at `__at`, the expression that reads it there, and the statements that
/// fill it again.
fn transfer(
    emitter: &Emitter<'_>,
    block: usize,
    is_velocity: bool,
    field: &Ident,
    flat: &TokenStream,
) -> Transfers {
    let (krate, text) = (emitter.krate(), field.unraw().to_string());
    let declared = &emitter.model.blocks[block];
    let is_single = declared.array.is_none();
    if is_single && !declared.is_spinor() {
        let read = quote!({ let __value = #flat[__at]; __at += 1usize; __value });
        let write = quote!(#flat[__at] = self.#field; __at += 1usize;);
        return Transfers { write, refill: quote!(self.#field = #read;), read };
    }
    // What the flat slice has of an entry, and back.
    let [there, back] = match declared.axis {
        Some(_) if declared.is_spinor() => ["lift", "lower"].map(|name| {
            let name = format_ident!("{name}");
            quote!(#krate::__private::#name)
        }),
        Some(_) => [quote!(|__entry| __entry), quote!(|__entry| __entry)],
        None => [quote!(|__entry| [__entry]), quote!(|[__entry]| __entry)],
    };
    // An angular velocity has the first three of nine places.
    let is_angular = is_velocity && declared.factor == Factor::Rotation;
    let (length, unused) = match declared.axis {
        _ if is_single => (quote!(1usize), None),
        Some(_) if is_angular => (quote!(__len(#block)), Some(quote!(__at += 6usize * __len(#block);))),
        None if is_angular => (quote!(3usize), Some(quote!(__at += 6usize;))),
        Some(_) | None => (quote!(__len(#block)), None),
    };
    let entries =
        if is_single { quote!(::core::slice::from_ref(&self.#field)) } else { quote!(&self.#field[..]) };
    let entry = quote!(#krate::__private::read(#length, &mut __at, #flat, #back));
    let on_stack = on_stack(emitter, block);
    let value = if is_single {
        quote!({ let [__value] = ::core::array::from_fn(#entry); __value })
    } else if on_stack {
        quote!(::core::array::from_fn(#entry))
    } else {
        quote!(::core::iter::Iterator::collect(::core::iter::Iterator::map(0..#length, #entry)))
    };
    let read = if is_angular { quote!({ let __value = #value; #unused __value }) } else { value };
    Transfers {
        write: quote!(
            #krate::__private::write(#text, #entries, #length, &mut __at, #flat, #there)?;
            #unused
        ),
        refill: if on_stack {
            quote!(self.#field = #read;)
        } else {
            quote!(#krate::RunTime::refill(&mut self.#field, #length, #entry); #unused)
        },
        read,
    }
}
