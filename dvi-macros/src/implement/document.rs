//! The report of a system, and the documentation made from it.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt as _;

use crate::emit::Emitter;
use crate::errors::text;
use crate::model::{Axis, Model};
use crate::operations::Operations;
use crate::print::{print_coordinate, print_expr, print_index, print_loops, print_velocity};
use crate::program::Programs;
use crate::statement::{Output, Place, Row, Statement};
use crate::symbolic::{Coordinate, Count, Expr, Index, Rows, Variable};
use crate::syntax::{Attribute, Constrained, Factor, closure, value};
use crate::typeset::{Equation, Typesetter, block, declared};
use crate::validate::Checked;

/// What a system says about itself.
pub(super) struct Account<'a> {
    pub(super) emitter: &'a Emitter<'a>,
    pub(super) programs: &'a Programs,
    opening: &'static str,
    /// Declared formulas, then derived ones, as (name, text).
    formulas: Vec<(String, String)>,
    /// The declared ones as they were written.
    equations: Vec<Equation>,
    sentences: Vec<String>,
}

impl<'a> Account<'a> {
    pub(super) fn new(
        (emitter, attribute, programs): (&'a Emitter<'a>, &'a Attribute, &'a Programs),
        opening: &'static str,
        functions: impl IntoIterator<Item = (&'static str, Expr)>,
        sentences: Vec<String>,
    ) -> Self {
        let functions =
            functions.into_iter().map(|(name, value)| (name.to_string(), quantity(emitter, value)));
        let formulas = functions.chain(attribute.shared.iter().filter_map(definition)).collect();
        let equations = declared(attribute, &mut Typesetter::new(attribute, emitter.model.vectors()));
        Self { emitter, programs, opening, formulas, equations, sentences }
    }

    /// Adds what is said of the system as a whole.
    pub(super) fn sentence(&mut self, sentence: String) {
        self.sentences.push(sentence);
    }

    /// Adds what was checked, the declared momenta and events, the forces with what they mean for the
    /// methods, and where the formulas are not smooth.
    pub(super) fn observed(&mut self, checked: &Checked, momenta: &[Expr], events: &[Expr]) {
        self.sentence(checked.sentence());
        let (emitter, Model { momenta: names, events: others, .. }) = (self.emitter, self.emitter.model);
        let named = names.iter().chain(others).zip(momenta.iter().chain(events));
        self.formulas.extend(named.map(|(name, value)| (name.clone(), quantity(emitter, *value))));
        if let Some(forces) = &self.programs.forces {
            self.derived(&forces.statements, |_, entry| {
                format!("force({})", print_coordinate(entry, emitter.model))
            });
            self.sentence(
                "Forces act: no method preserves a form, and energy and momenta change as the forces make them."
                    .to_string(),
            );
        }
        let values = self.programs.seams.iter().flat_map(|seam| &seam.statements);
        let values = values.map(|statement| format!("{} = 0", quantity(emitter, statement.value)));
        let places = values.collect::<Vec<_>>().join(", ");
        if !places.is_empty() {
            self.sentence(format!("Not smooth where {places}: there steps of `ErrorControl` end."));
        }
    }

    /// Adds derivatives, named by what they are entries of and where.
    pub(super) fn derived(
        &mut self,
        statements: &[Statement],
        name: impl Fn(Output, &Coordinate) -> String,
    ) {
        let emitter = self.emitter;
        let entries = statements.iter().filter_map(|statement| {
            let (output, coordinate) = statement.place.entry()?;
            Some((name(output, coordinate), in_loops(emitter, statement)))
        });
        self.formulas.extend(entries);
    }

    /// Adds the constraints with their derivatives, and how many there are.
    pub(super) fn constraints(&mut self) {
        let emitter = self.emitter;
        let Some(constraints) = &self.programs.constraints else { return };
        let number = |row: &Row| {
            let before = &constraints.lengths[..row.constraint as usize];
            together(emitter, before.iter().chain([&row.member]))
        };
        let (model, words) = (emitter.model, constraints.of.words());
        let (letter, nouns) = (words.letter, words.nouns);
        for statement in &constraints.value.statements {
            let Place::Constraint(row) = &statement.place else { continue };
            let name = format!("{} {letter}[{}]", nouns[0], number(row));
            self.formulas.push((name, in_loops(emitter, statement)));
        }
        for (variable, statement) in &constraints.derivatives {
            let Place::ConstraintDerivative(row, column) = &statement.place else { continue };
            let by = match variable {
                Variable::Position => print_coordinate(column, model),
                Variable::Velocity => print_velocity(column, model),
            };
            self.formulas.push((format!("∂{letter}[{}]/∂{by}", number(row)), in_loops(emitter, statement)));
        }
        let literals = constraints.lengths.iter().map(Count::as_literal);
        let literal = literals.sum::<Option<i64>>();
        let noun = if literal == Some(1) { nouns[0] } else { nouns[1] };
        // A range that ends before it begins has no members, which the sum of the lengths does not show.
        let may_end_early = constraints.lengths.iter().any(|length| !length.is_natural());
        let condition =
            if may_end_early && constraints.lengths.len() > 1 { ", where no range is empty" } else { "" };
        let count = literal
            .map_or_else(|| together(emitter, constraints.lengths.iter()), |literal| literal.to_string());
        let adjective = match constraints.of {
            Constrained::Positions | Constrained::Velocities => format!("{} ", words.adjective),
            Constrained::Gaps => String::new(),
        };
        let (function, relation) = (words.function, words.relation);
        self.sentence(format!("{count} {adjective}{noun} {function} {relation}{condition}."));
    }

    pub(super) fn report(&self) -> TokenStream {
        let Self { emitter, programs, formulas, sentences, .. } = self;
        let krate = emitter.krate();
        let Model { momenta, events, .. } = emitter.model;
        let system = emitter.model.item.ident.to_string();
        let blocks = emitter.model.blocks.iter().map(|block| {
            let (name, size) =
                (block.name.unraw().to_string(), block.array.as_ref().map_or("", |(_, text)| text.as_str()));
            let factor = match block.factor {
                Factor::Line => quote!(Line),
                Factor::Rotation => quote!(Rotation),
                Factor::Sphere => quote!(Sphere),
            };
            let axis = match block.axis {
                Some(Axis { number, of }) => {
                    let [number, of] = [number, of].map(|count| count as u8);
                    quote!(::core::option::Option::Some(#krate::__private::Axis { number: #number, of: #of }))
                }
                None => quote!(::core::option::Option::None),
            };
            quote! {
                #krate::__private::CoordinateBlock {
                    name: #name, size: #size, axis: #axis, factor: #krate::__private::Factor::#factor
                }
            }
        });
        let lines = formulas
            .iter()
            .map(|(name, text)| quote!(#krate::__private::Formula { name: #name, text: #text }));
        let residual = operation_list(emitter, &programs.gradient.operations());
        let jacobian = operation_list(emitter, &programs.linearize.operations());
        let sparsity = sparsity(emitter, programs);
        quote! {
            #krate::Report::new(
                #system, &[#(#blocks),*], &[#(#momenta),*], &[#(#events),*], &[#(#lines),*], &[#(#sentences),*],
                #residual, #jacobian, #sparsity,
            )
        }
    }

    /// The text that the struct's own documentation is continued with.
    pub(super) fn documentation(&self) -> String {
        let mut text = format!("\n# Dynamics\n\n{}\n\n{}", self.opening, block(&self.equations));
        for sentence in &self.sentences {
            text += &format!("- {sentence}\n");
        }
        text + &format!("- `{}::REPORT` has all formulas.\n", self.emitter.model.item.ident)
    }
}

/// ` + force(x)` behind the derivative by x of a function that stands beside the force on x, or with another
/// sign; nothing where no force acts.
pub(super) fn beside_force(
    emitter: &Emitter<'_>,
    programs: &Programs,
    sign: char,
    entry: &Coordinate,
) -> String {
    let acts =
        |statement: &Statement| statement.place.entry().is_some_and(|(_, on)| on.block == entry.block);
    match programs.forces.iter().any(|forces| forces.statements.iter().any(acts)) {
        true => format!(" {sign} force({})", print_coordinate(entry, emitter.model)),
        false => String::new(),
    }
}

fn quantity(emitter: &Emitter<'_>, expr: Expr) -> String {
    print_expr(emitter.graph, expr, 0, emitter.model)
}

/// The sum of these, with the passes of loops in loops in it.
fn together<'a>(emitter: &Emitter<'_>, counts: impl Iterator<Item = &'a Count> + Clone) -> String {
    let rest = counts.clone().fold(Index::default(), |sum, count| sum.plus(&count.rest, 1));
    let print = |index: &Index| print_index(index, emitter.model);
    let one = |Rows { first, step, count }: &Rows| {
        let [first, count] = [first, count].map(print);
        match step {
            0 => format!("({count}) * ({first})"),
            step => format!(
                "sum(0..{count}, |k| {first} {} {} * k)",
                if *step < 0 { '-' } else { '+' },
                step.abs()
            ),
        }
    };
    let mut parts: Vec<String> = counts.filter_map(|count| count.rows.as_ref()).map(one).collect();
    if parts.is_empty() || rest != Index::default() {
        parts.push(print(&rest));
    }
    parts.join(" + ")
}

/// What formulas share, as (name, text).
fn definition(local: &syn::Local) -> Option<(String, String)> {
    let (name, value) = (text(&local.pat), value(local)?);
    Some(match closure(value) {
        Some(function) => (format!("{name}({})", text(&function.inputs)), text(&function.body)),
        None => (name, text(value)),
    })
}

/// The value of a statement, with the loops that it stands in.
fn in_loops(emitter: &Emitter<'_>, statement: &Statement) -> String {
    let text = print_expr(emitter.graph, statement.value, statement.loops.len(), emitter.model);
    if statement.loops.is_empty() {
        return text;
    }
    format!("{text}  for {}", print_loops(&statement.loops, emitter.model))
}

fn operation_list(emitter: &Emitter<'_>, operations: &[Operations]) -> TokenStream {
    let krate = emitter.krate();
    let entries = operations.iter().map(|count| {
        let loops = print_loops(&count.loops, emitter.model);
        let Operations { additions, multiplications, divisions, calls, .. } = count;
        quote! {
            #krate::__private::OperationCount {
                loops: #loops, additions: #additions, multiplications: #multiplications,
                divisions: #divisions, calls: #calls,
            }
        }
    });
    quote!(&[#(#entries),*])
}

/// The places of the Newton matrix, each once.
fn sparsity(emitter: &Emitter<'_>, programs: &Programs) -> TokenStream {
    let krate = emitter.krate();
    let mut places: Vec<[String; 3]> = Vec::new();
    for entry in &programs.entries {
        let loops = print_loops(&entry.loops, emitter.model);
        let [row, column] = [entry.row, entry.column]
            .map(|id| print_coordinate(emitter.graph.variable(id).1, emitter.model));
        let mirrored = entry.mirrored.then(|| [column.clone(), row.clone(), loops.clone()]);
        for place in [[row, column, loops]].into_iter().chain(mirrored) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
    }
    let entries = places
        .iter()
        .map(|[row, column, loops]| quote!(#krate::__private::Entry { row: #row, column: #column, loops: #loops }));
    quote!(&[#(#entries),*])
}
