//! What the language does not say, by the words that it would be said with, and what to write instead.

/// Words, and what stands in their place.
#[rustfmt::skip]
const UNSAID: [(&[&str], &str); 4] = [
    (&["poisson", "poisson_structure", "bracket", "brackets", "casimir", "casimirs"],
     "a Poisson structure is not declared by its matrix: where its Casimirs are constant it has a one-form, `one_form = … * d(x)`, in an \
      even number of coordinates"),
    (&["noise", "noises", "diffusion", "wiener", "dw", "stochastic", "temperature"],
     "there is no noise in a formula: `Langevin` is a method with thermal noise, and a path that is given is a function of the time, \
      `path(t)` with a field `path` of the struct"),
    (&["equation", "equations", "ode", "rhs", "vector_field", "dot"],
     "the equations of motion are those of L: any q' = f(q, t) has `one_form = p * d(q)` and `hamiltonian = p * f` with a second \
      coordinate p for each"),
    (&["restitution"], "it is that of the method: `Impacts { restitution, ..Impacts::reflecting(scheme) }`"),
];

/// What to write instead of this argument, if it is known.
pub(super) fn instead_of(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    UNSAID.iter().find(|(words, _)| words.contains(&word.as_str())).map(|(_, instead)| *instead)
}
