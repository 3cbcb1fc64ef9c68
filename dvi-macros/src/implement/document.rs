//! The report of a system, and the documentation made from it.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Emitter;
use crate::operations::Operations;
use crate::program::{Formulas, Place, Programs, Statement, variable};
use crate::structure::Structure;
use crate::symbolic::{Expr, print_binders, print_coordinate, print_expr};

fn quantity(emitter: &Emitter<'_>, expr: Expr) -> String {
    print_expr(emitter.graph, expr, emitter.model)
}

/// Declared formulas, then derived ones, as (name, text).
fn formulas(
    emitter: &Emitter<'_>,
    formulas: &Formulas,
    programs: &Programs,
    momenta: &[String],
) -> Vec<(String, String)> {
    let mut lines = vec![
        ("α".to_string(), quantity(emitter, formulas.one_form)),
        ("H".to_string(), quantity(emitter, formulas.hamiltonian)),
    ];
    lines.extend(
        momenta.iter().cloned().zip(formulas.momenta.iter().map(|momentum| quantity(emitter, *momentum))),
    );
    let mut derived = |symbol: &str, statements: &[Statement]| {
        for statement in statements {
            if let Place::Entry(_, coordinate) = &statement.place {
                let target = print_coordinate(coordinate, emitter.model);
                let mut text = quantity(emitter, statement.value);
                if !statement.loops.is_empty() {
                    text += &format!("  for {}", print_binders(&statement.loops, emitter.model));
                }
                lines.push((format!("{symbol}{target}"), text));
            }
        }
    };
    derived("α_", &programs.one_form);
    derived("∂H/∂", &programs.hamiltonian_gradient);
    lines
}

fn sentences(structure: &Structure) -> Vec<&'static str> {
    let mut sentences = Vec::new();
    sentences.push(match structure.linear {
        true => "α is affine in q with constant coefficients: Ω is constant.",
        false => "α is nonlinear: Ω depends on q or t.",
    });
    sentences.push(match (structure.linear, structure.matching) {
        (true, true) => {
            "σ = 0 and σ = 1 are explicit: one gradient of H a step, no iteration, no factorisation."
        }
        (true, false) => "σ = 0 and σ = 1 are explicit up to one factorisation for the whole run.",
        (false, true) => "σ = 0 is explicit: no iteration, no factorisation. σ = 1 is implicit.",
        (false, false) => "σ = 0 solves one linear system a step, without iteration. σ = 1 is implicit.",
    });
    sentences.push("0 < σ < 1 is implicit.");
    sentences.push(match structure.canonical {
        true => "Ω couples each coordinate to one partner: q' = X(q) takes one division per coordinate.",
        false => "Ω is dense: q' = X(q) takes one linear solve.",
    });
    sentences
}

fn operation_list(emitter: &Emitter<'_>, operations: &[Operations]) -> TokenStream {
    let krate = emitter.krate();
    let entries = operations.iter().map(|count| {
        let loops = print_binders(&count.loops, emitter.model);
        let Operations { additions, multiplications, divisions, calls, .. } = count;
        quote! {
            #krate::OperationCount {
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
        let (Some((_, row)), Some((_, column))) =
            (variable(emitter.graph, entry.row), variable(emitter.graph, entry.column))
        else {
            continue;
        };
        let loops = print_binders(&entry.loops, emitter.model);
        let [row, column] = [row, column].map(|coordinate| print_coordinate(&coordinate, emitter.model));
        for place in [[row.clone(), column.clone(), loops.clone()], [column, row, loops]] {
            if !places.contains(&place) {
                places.push(place);
            }
        }
    }
    let entries = places
        .iter()
        .map(|[row, column, loops]| quote!(#krate::Entry { row: #row, column: #column, loops: #loops }));
    quote!(&[#(#entries),*])
}

pub(crate) fn report(
    emitter: &Emitter<'_>,
    declared: &Formulas,
    programs: &Programs,
    structure: &Structure,
    momenta: &[String],
) -> TokenStream {
    let krate = emitter.krate();
    let system = emitter.model.item.ident.to_string();
    let blocks = emitter.model.blocks.iter().map(|block| {
        let (name, size) =
            (block.name.to_string(), block.array.as_ref().map_or("", |(_, text)| text.as_str()));
        quote!(#krate::CoordinateBlock { name: #name, size: #size })
    });
    let lines = formulas(emitter, declared, programs, momenta);
    let lines = lines.iter().map(|(name, text)| quote!(#krate::Formula { name: #name, text: #text }));
    let sentences = sentences(structure);
    let residual = operation_list(emitter, &emitter.operations(&programs.gradient));
    let jacobian = operation_list(emitter, &emitter.operations(&programs.linearize));
    let sparsity = sparsity(emitter, programs);
    quote! {
        #krate::Report::new(
            #system, &[#(#blocks),*], &[#(#momenta),*], &[#(#lines),*], &[#(#sentences),*],
            #residual, #jacobian, #sparsity,
        )
    }
}

/// The text that the struct's own documentation is continued with.
pub(crate) fn documentation(
    emitter: &Emitter<'_>,
    declared: &Formulas,
    programs: &Programs,
    structure: &Structure,
    momenta: &[String],
) -> String {
    let mut text = String::from("\n# Dynamics\n\nL(q, v, t) = α(q, t)·v − H(q, t) with\n\n```text\n");
    for (name, formula) in formulas(emitter, declared, programs, momenta) {
        text += &format!("{name} = {formula}\n");
    }
    text += "```\n\n";
    for sentence in sentences(structure) {
        text += &format!("- {sentence}\n");
    }
    text
}
