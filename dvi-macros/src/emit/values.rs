//! The values of instructions to tokens.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens as _, format_ident, quote, quote_spanned};
use syn::Ident;

use super::{Element, Emitter, Function, local, name, own_function, scalar_field, slice};
use crate::instructions::{Instruction, Register, Signed};
use crate::internal::internal;
use crate::model::ScalarField;
use crate::symbolic::{Coordinate, Id, Node, Parameter, Partial, Relation, Weight};

impl Function<'_> {
    pub(super) fn instruction(&self, register: Register) -> TokenStream {
        let krate = self.emitter.krate();
        let scalar = match self.element {
            Element::Number => quote!(<__T as #krate::Scalar>),
            Element::Pack => quote!(<<__T as #krate::Scalar>::Pack as #krate::Scalar>),
        };
        match self.routine.code.get(register) {
            Instruction::Leaf(id) => self.leaf(*id),
            Instruction::Literal(bits) => {
                let value = literal(f64::from_bits(*bits));
                quote!(#scalar::lift(#value))
            }
            Instruction::Multiply(a, b) => {
                let (a, b) = (self.register(*a), self.register(*b));
                quote!(#a * #b)
            }
            Instruction::Divide(a, b) => {
                let (a, b) = (self.register(*a), self.register(*b));
                quote!(#a / #b)
            }
            Instruction::Sum(terms) => self.sum(terms),
            Instruction::Unary(function, of) => {
                let (function, of) = (format_ident!("{}", function.name()), self.signed(*of));
                quote!(#scalar::#function(#of))
            }
            Instruction::Binary(function, a, b) => {
                let (function, a, b) =
                    (format_ident!("{}", function.name()), self.signed(*a), self.signed(*b));
                quote!(#scalar::#function(#a, #b))
            }
            Instruction::Call(function, order, of) => {
                let (name, of) = (own_function(*function as usize, *order as usize), self.signed(*of));
                quote!(Self::#name(#of))
            }
            Instruction::Expansion(field, at) => {
                let name = scalar_field(*field as usize);
                let at = at.iter().map(|argument| self.signed(*argument));
                if !self.is_guarded {
                    return quote!(self.#name([#(#at),*]));
                }
                let ScalarField { text, tokens, arity, span, .. } =
                    &self.emitter.model.scalar_fields[*field as usize];
                // With the span of the one above, so that a type that is no such function is one error.
                let domain = quote_spanned!(*span=> #krate::ScalarField::<#arity>::domain(&#tokens));
                let arguments = (1..=*arity)
                    .map(|number| quote!(#krate::__private::Argument { function: #text, number: #number }));
                quote! {{
                    let __at = [#(#at),*];
                    match #krate::__private::outside(&[#(#arguments),*], #domain, __at) {
                        ::core::option::Option::None => self.#name(__at),
                        __found => {
                            __outside = __outside.or(__found);
                            #krate::__private::constant()
                        }
                    }
                }}
            }
            Instruction::Part(expansion, partial) => {
                let expansion = self.register(*expansion);
                match partial {
                    Partial::Value => quote!(#expansion.value),
                    Partial::First(axis) => quote!(#expansion.gradient[#axis]),
                    Partial::Second(first, second) => quote!(#expansion.hessian[#first][#second]),
                }
            }
            Instruction::Choose(left, relation, right, then, otherwise) => {
                let relation = match relation {
                    Relation::Less => quote!(Less),
                    Relation::LessOrEqual => quote!(LessOrEqual),
                    Relation::Greater | Relation::HasMore => quote!(Greater),
                    Relation::GreaterOrEqual => quote!(GreaterOrEqual),
                };
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|part| self.signed(*part));
                quote!(#scalar::choose(#left, #krate::__private::Comparison::#relation, #right, #then, #otherwise))
            }
            Instruction::Reduce(..) => {
                let name = name(register);
                quote!(#name)
            }
        }
    }

    /// A positive term first: a − b rather than −b + a.
    pub(super) fn sum(&self, terms: &[Signed]) -> TokenStream {
        let mut order: Vec<&Signed> = terms.iter().collect();
        order.sort_by_key(|term| term.negative);
        let mut tokens = self.signed(*order[0]);
        for term in &order[1..] {
            let value = self.register(term.register);
            tokens = if term.negative { quote!(#tokens - #value) } else { quote!(#tokens + #value) };
        }
        tokens
    }

    fn leaf(&self, id: Id) -> TokenStream {
        let krate = self.emitter.krate();
        match self.emitter.graph.node(id) {
            Node::Coordinate(coordinate) => self.gather("q", coordinate),
            Node::Velocity(coordinate) => self.gather("v", coordinate),
            Node::Parameter(parameter) => self.parameter(parameter),
            Node::Count(index) => {
                let index = self.emitter.signed_index(index);
                quote!(<__T as #krate::Scalar>::lift(#index as ::core::primitive::f64))
            }
            Node::Weight(weight) => match weight {
                Weight::Qq => quote!(__w.qq),
                Weight::Qv => quote!(__w.qv),
                Weight::Vq => quote!(__w.vq),
                Weight::Vv => quote!(__w.vv),
                Weight::A => quote!(__a),
                Weight::B => quote!(__b),
                Weight::Q => quote!(__weights[0usize]),
                Weight::V => quote!(__weights[1usize]),
            },
            Node::Time => quote!(__t),
            other => internal(format!("{other:?} is not a leaf")),
        }
    }

    fn gather(&self, array: &str, coordinate: &Coordinate) -> TokenStream {
        let array = slice(array, coordinate.block);
        let index = self.index(&coordinate.index);
        match self.element {
            Element::Number => quote!(#array[#index]),
            Element::Pack => {
                let krate = self.emitter.krate();
                quote!(#krate::__private::load(#array, #index))
            }
        }
    }

    fn parameter(&self, parameter: &Parameter) -> TokenStream {
        let krate = self.emitter.krate();
        let indices = parameter.indices.iter().map(|index| self.index(index));
        let place = if self.is_part {
            parameter_slice(parameter.field).into_token_stream()
        } else {
            self.emitter.model.parameters[parameter.field as usize].tokens.clone()
        };
        if let Element::Pack = self.element {
            return quote!(#krate::__private::parameters::<__T, _>(&#place[..], #(#indices)*));
        }
        self.emitter.parameter_at(parameter.field, &quote!(#place #([#indices])*))
    }
}

/// The slice of a field of parameters.
pub(super) fn parameter_slice(field: u32) -> Ident {
    local(format_args!("p{field}"))
}

impl Emitter<'_> {
    /// The parameter at a place, as a number.
    pub(crate) fn parameter_at(&self, field: u32, place: &TokenStream) -> TokenStream {
        let krate = self.krate();
        match &self.model.parameters[field as usize].generic {
            Some(generic) => quote!(<#generic as #krate::Parameter<__T>>::value(#place)),
            None => quote!(<__T as #krate::Scalar>::lift(#krate::__private::Number::number(#place))),
        }
    }
}

fn literal(value: f64) -> TokenStream {
    if value.is_finite() {
        let literal = Literal::f64_suffixed(value);
        quote!(#literal)
    } else if value.is_nan() {
        quote!(::core::primitive::f64::NAN)
    } else {
        quote!(::core::primitive::f64::INFINITY)
    }
}
