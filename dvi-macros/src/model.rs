//! Tree to model: coordinates with their sizes, parameters with their shapes, functions.
//!
//! The symbolic core knows blocks, parameters, sizes and functions by number; the tables here say what
//! they are.

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::ext::IdentExt as _;
use syn::{Generics, Ident, ItemStruct, Path, Type};

use crate::errors::Errors;
use crate::symbolic::{Atom, Index};
use crate::syntax::{Attribute, Declaration, Factor, Function, Kind, Named, ScalarFieldPath};
use crate::words::{self, reserved};

mod grids;
mod parameters;
mod shape;
mod sizes;
mod vectors;
mod written_out;

pub(crate) use grids::Grid;
pub(crate) use parameters::ParameterName;
use parameters::fields;
pub(crate) use shape::Shape;
use shape::mentions_generic;
pub(crate) use vectors::{Axis, COMPONENTS, SPINOR, are_components};

/// A block of coordinates: one, or an array.
#[derive(Debug)]
pub(crate) struct Block {
    pub(crate) name: Ident,
    /// The size of an array, with its text; of a rotation or a unit vector without an index, the number of
    /// its entries.
    pub(crate) array: Option<(Index, String)>,
    /// The two sizes, if it takes two indices.
    pub(crate) grid: Option<Grid>,
    /// Which component the coordinates are, if they are those of vectors.
    pub(crate) axis: Option<Axis>,
    pub(crate) factor: Factor,
}

impl Block {
    /// The field of a state that holds the velocities.
    pub(crate) fn velocity_name(&self) -> Ident {
        velocity_name(&self.name, self.factor)
    }
}

/// A size that is not a literal.
#[derive(Debug)]
pub(crate) struct SizeName {
    pub(crate) text: String,
    /// Its value as an expression of type `usize` in a method of the struct.
    pub(crate) tokens: TokenStream,
    /// Whether the compiler knows it: a const generic.
    pub(crate) constant: bool,
}

/// A function of several variables that a formula calls: a field of the struct, or a path.
#[derive(Debug)]
pub(crate) struct ScalarField {
    pub(crate) text: String,
    /// The place in a method of the struct.
    pub(crate) tokens: TokenStream,
    /// The number of its arguments.
    pub(crate) arity: usize,
    /// Where it is called first.
    pub(crate) span: Span,
    /// Its type, if that is a generic one of the struct or mentions one.
    pub(crate) generic: Option<Type>,
}

/// The blocks of the physical time and of the energy that is its conjugate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extended {
    pub(crate) time: usize,
    pub(crate) energy: usize,
}

#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) kind: Kind,
    pub(crate) item: ItemStruct,
    pub(crate) blocks: Vec<Block>,
    pub(crate) sizes: Vec<SizeName>,
    pub(crate) parameters: Vec<ParameterName>,
    pub(crate) functions: Vec<Function>,
    /// Those that are declared by a path, whether they are called or not.
    declared_scalar_fields: Vec<ScalarFieldPath>,
    /// Those that are called.
    pub(crate) scalar_fields: Vec<ScalarField>,
    /// The coordinates that a time transformation adds, if there is one.
    pub(crate) extended: Option<Extended>,
    /// The names of the momenta, and of the events.
    pub(crate) momenta: Vec<String>,
    pub(crate) events: Vec<String>,
    /// What the state derives beside what every state does.
    pub(crate) derives: Vec<Path>,
    pub(crate) crate_path: Path,
    /// Whether coordinates or their sizes are unknown, so that names and ranges cannot be checked.
    pub(crate) lost_coordinates: bool,
    /// Whether functions are unknown.
    pub(crate) lost_functions: bool,
    /// Whether names that the formulas share are unknown.
    pub(crate) lost_names: bool,
}

impl Model {
    pub(crate) fn new(attribute: &mut Attribute, item: ItemStruct, errors: &mut Errors) -> Self {
        let crate_path = attribute.crate_path.take().unwrap_or_else(|| syn::parse_quote!(::dvi_core));
        let parameters = fields(&item, errors);
        let mut model = Self {
            kind: attribute.kind,
            item,
            blocks: Vec::new(),
            sizes: Vec::new(),
            parameters,
            functions: std::mem::take(&mut attribute.functions),
            declared_scalar_fields: std::mem::take(&mut attribute.scalar_fields),
            scalar_fields: Vec::new(),
            extended: None,
            momenta: names(&attribute.momenta),
            events: names(&attribute.events),
            derives: std::mem::take(&mut attribute.derives),
            crate_path,
            lost_coordinates: attribute.lost_coordinates,
            lost_functions: attribute.lost_functions,
            lost_names: attribute.lost_names,
        };
        for declaration in &attribute.coordinates {
            model.declare(declaration, errors);
        }
        if let Some(transform) = &attribute.time_transform {
            model.extend(&transform.word, errors);
        }
        let fields = model.declared_scalar_fields.iter().map(|field| &field.name);
        let functions: Vec<&Ident> =
            model.functions.iter().map(|function| &function.name).chain(fields).collect();
        for &name in &functions {
            if reserved().any(|reserved| name == reserved) {
                errors.push(
                    name,
                    format!(
                        "`{name}` has a meaning of its own in formulas; give this function another name"
                    ),
                );
            }
        }
        unique(functions.iter().copied(), "function", errors);
        // A field of numbers cannot be called: no formula means it by mistake.
        let is_callable = |shape: &Shape| matches!(shape, Shape::Unknown | Shape::Other);
        for name in functions {
            let mut same = model.parameters.iter().filter(|parameter| *name == parameter.text);
            if same.any(|parameter| is_callable(&parameter.shape)) {
                let message = "is a field of the struct too; give one of them another name";
                errors.push(name, format!("`{name}` {message}"));
            }
        }
        for ScalarFieldPath { name, .. } in &model.declared_scalar_fields {
            if words::is_method(&name.to_string()) {
                let message = "is a function of the language; give this one another name";
                errors.push(name, format!("`{name}` {message}"));
            }
        }
        unique(attribute.momenta.iter().map(|momentum| &momentum.name), "momentum", errors);
        unique(attribute.events.iter().map(|event| &event.name), "event", errors);
        model
    }

    /// Adds the coordinates of a time transformation.
    fn extend(&mut self, word: &Ident, errors: &mut Errors) {
        let first = self.blocks.len();
        for name in [words::TIME, words::ENERGY] {
            let taken = self.blocks.iter().map(|block| &block.name).find(|known| **known == name);
            let taken = taken.map(|taken| (taken, format!("`{taken}`")));
            let field = self.parameters.iter().any(|parameter| parameter.text == name);
            if let Some((at, what)) = taken.or_else(|| field.then(|| (word, format!("the field `{name}`"))))
            {
                let message = format!(
                    "a time transformation adds the coordinates `t` and `energy`: give {what} another name"
                );
                errors.push(at, message);
                return;
            }
            self.blocks.push(Block {
                name: Ident::new(name, word.span()),
                array: None,
                grid: None,
                axis: None,
                factor: Factor::Line,
            });
        }
        self.extended = Some(Extended { time: first, energy: first + 1 });
    }

    /// The number of blocks that the user has declared.
    pub(crate) fn declared_blocks(&self) -> usize {
        self.extended.map_or(self.blocks.len(), |extended| extended.time)
    }

    fn declare(&mut self, declaration: &Declaration, errors: &mut Errors) {
        let &Declaration { ref name, ref size, ref components, factor } = declaration;
        if self.blocks.iter().any(|block| block.name == *name) {
            errors.push(name, format!("coordinate `{name}` is declared twice"));
            self.lost_coordinates = true;
            return;
        }
        if let Some((velocity, of)) = self.clash_of_velocities(name, factor) {
            let message = format!(
                "coordinate `{velocity}` has the name of the velocity of `{of}` in a state; rename one of them"
            );
            errors.push(velocity, message);
            self.lost_coordinates = true;
            return;
        }
        if self.parameters.iter().any(|parameter| *name == parameter.text) {
            errors.push(
                name,
                format!("coordinate `{name}` has the name of a field of the struct; rename one of them"),
            );
        }
        let row_length = grids::row_length(components.as_ref());
        let axes = components.as_ref().filter(|_| row_length.is_none()).and_then(|components| {
            let count = errors.taken(vectors::components(name, components));
            self.lost_coordinates |= count.is_none();
            // What is said of its uses is that of vectors.
            count.or(Some(3))
        });
        // An array of rotations is one of vectors with nine components; unit vectors of degenerate systems
        // have those of spinors.
        let is_spinor = factor == Factor::Sphere && self.kind == Kind::Degenerate;
        let axes = if is_spinor { Some(SPINOR) } else { axes.or(size.as_ref().and(factor.coordinates())) };
        let count = axes.unwrap_or(1);
        let grid =
            size.as_ref().zip(row_length).map(|(rows, length)| self.grid(name, [rows, length], errors));
        let array = match &grid {
            Some(grid) => Some(grid.entries()),
            None => size.as_ref().map(|size| self.read_size(name, size, count as i64, errors)),
        };
        let alone = || factor.coordinates().map(|count| (Index::literal(count as i64), count.to_string()));
        let array = if is_spinor { array } else { array.or_else(alone) };
        let axis = |number| axes.map(|of| Axis { number, of });
        let block = |number| Block {
            name: name.clone(),
            array: array.clone(),
            grid: grid.clone(),
            axis: axis(number),
            factor,
        };
        self.blocks.extend((0..count).map(block));
    }

    /// Whether states carry velocities beside the coordinates.
    pub(crate) fn has_velocities(&self) -> bool {
        self.kind == Kind::Regular
    }

    /// A coordinate called as the velocity of another one, and that one; one of them is `name`.
    fn clash_of_velocities<'a>(&'a self, name: &'a Ident, factor: Factor) -> Option<(&'a Ident, &'a Ident)> {
        if !self.has_velocities() {
            return None;
        }
        let velocity = velocity_name(name, factor);
        let clash = |block: &'a Block| {
            let is_velocity = (block.name == velocity).then_some((&block.name, name));
            is_velocity.or_else(|| (*name == block.velocity_name()).then_some((name, &block.name)))
        };
        self.blocks.iter().find_map(clash)
    }

    /// The name of the struct and its generics.
    pub(crate) fn named(&self) -> (&Ident, &Generics) {
        (&self.item.ident, &self.item.generics)
    }

    /// Whether a coordinate is a rotation or a unit vector.
    pub(crate) fn is_on_manifold(&self) -> bool {
        self.blocks.iter().any(|block| block.factor != Factor::Line)
    }

    /// The parameter that a path such as `Self::G` stands for.
    pub(crate) fn path_parameter(&mut self, path: &Path) -> u32 {
        let text = path.to_token_stream().to_string().replace(' ', "");
        let known = self.parameters.iter().position(|parameter| parameter.text == text);
        let position = known.unwrap_or_else(|| {
            self.parameters.push(ParameterName::of_unknown_type(text, quote!(#path)));
            self.parameters.len() - 1
        });
        position as u32
    }

    /// Whether a function of several variables of this name is declared by its path.
    pub(crate) fn is_declared_scalar_field(&self, name: &str) -> bool {
        self.declared_scalar_fields.iter().any(|field| field.name == name)
    }

    /// The function of several variables of this name, called with so many arguments; `None` if there is
    /// none, and another number of arguments if it was called with that before.
    pub(crate) fn scalar_field(&mut self, name: &Ident, arity: usize) -> Option<Result<u32, usize>> {
        if let Some(known) = self.scalar_fields.iter().position(|field| *name == field.text) {
            let before = self.scalar_fields[known].arity;
            return Some(if before == arity { Ok(known as u32) } else { Err(before) });
        }
        let declared = self.declared_scalar_fields.iter().find(|field| field.name == *name);
        let (tokens, generic) = match declared {
            Some(ScalarFieldPath { path, .. }) => (quote!(#path), None),
            None => {
                let parameter = self.parameters.iter().find(|parameter| *name == parameter.text)?;
                let fields = self.item.fields.iter();
                let mut types =
                    fields.filter(|field| field.ident.as_ref() == Some(name)).map(|field| &field.ty);
                let ty = types.next().filter(|ty| mentions_generic(ty, &self.item.generics)).cloned();
                (parameter.tokens.clone(), ty)
            }
        };
        let field = ScalarField { text: name.to_string(), tokens, arity, span: name.span(), generic };
        self.scalar_fields.push(field);
        Some(Ok(self.scalar_fields.len() as u32 - 1))
    }

    pub(crate) fn block_size(&self, block: usize) -> Index {
        self.blocks[block].array.as_ref().map_or_else(|| Index::literal(1), |(size, _)| size.clone())
    }

    /// The number of the first coordinate of a block.
    pub(crate) fn offset(&self, block: usize) -> Index {
        (0..block).fold(Index::default(), |sum, before| sum.plus(&self.block_size(before), 1))
    }

    /// The number of coordinates as an index expression.
    pub(crate) fn dimension(&self) -> Index {
        self.offset(self.blocks.len())
    }

    /// Whether a function of the user's was declared with three derivatives, as a gauge needs them.
    pub(crate) fn has_third_derivative(&self, function: u32) -> bool {
        self.functions[function as usize].derivatives.len() > 3
    }

    /// Whether something is called so, or has a part that is.
    pub(crate) fn is_taken(&self, name: &str) -> bool {
        let parts =
            |text: &str| text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|part| part == name);
        self.blocks.iter().any(|block| block.name == name)
            || self.parameters.iter().any(|parameter| parts(&parameter.text))
            || self.sizes.iter().any(|size| parts(&size.text))
            || self.functions.iter().any(|function| function.name == name)
            || self.declared_scalar_fields.iter().any(|field| field.name == name)
    }

    /// Whether the compiler knows a size.
    pub(crate) fn is_constant(&self, size: &Index) -> bool {
        let is_constant =
            |atom: &Atom| matches!(atom, Atom::Size(size) if self.sizes[size.0 as usize].constant);
        size.terms.iter().all(|(atom, _)| is_constant(atom))
    }
}

/// The field of a state that holds the velocity of a coordinate.
fn velocity_name(coordinate: &Ident, factor: Factor) -> Ident {
    match factor {
        Factor::Line | Factor::Sphere => format_ident!("dot_{}", coordinate),
        Factor::Rotation => format_ident!("omega_{}", coordinate),
    }
}

fn names(of: &[Named]) -> Vec<String> {
    of.iter().map(|named| named.name.unraw().to_string()).collect()
}

fn unique<'a>(names: impl Iterator<Item = &'a Ident>, what: &str, errors: &mut Errors) {
    let mut known: Vec<&Ident> = Vec::new();
    for name in names {
        if known.contains(&name) {
            errors.push(name, format!("{what} `{name}` is declared twice"));
        }
        known.push(name);
    }
}
