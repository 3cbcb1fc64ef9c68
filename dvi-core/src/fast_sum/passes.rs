//! The passes of one evaluation: moments up the tree, from cube to cube, local expansions down, neighbours one by one
//! (Greengard & Rokhlin 1987; with interpolation of the kernel, Fong & Darve 2009).

use alloc::vec::Vec;

use super::basis::Chebyshev;
use super::expansion::{Expansion, Row};
use super::lists::Lists;
use super::packs::{LANES, Pack, add_before, add_product, load, load_before, multiply};
use super::quantity::Quantity;
use super::transfer::{Transfer, offsets};
use super::tree::{NotFinite, Tree};
use crate::PairSum;
use crate::scalar::simd::widest_if;

/// The numbers of one evaluation, kept from one to the next.
#[derive(Clone, Debug)]
pub(super) struct Work<const D: usize> {
    tree: Tree<D>,
    lists: Lists,
    /// Places and weights in the order of the tree, with room behind them for the lanes of the last bodies.
    places: [Vec<f64>; D],
    weights: Vec<f64>,
    sums: [Vec<f64>; D],
    /// For each level with cubes that act on others: which matrices they have.
    transfers: Vec<Option<usize>>,
    /// Of each cube, by the functions of the basis: Σ w B over its bodies, and the potential of far cubes in it.
    moments: Vec<f64>,
    locals: Vec<f64>,
    /// The same, compressed.
    sent: Vec<f64>,
    received: Vec<f64>,
    packs: [Vec<Pack>; 2],
}

impl<const D: usize> Work<D> {
    pub(super) fn new(bodies: usize) -> Self {
        let padded = || alloc::vec![0.0; bodies + LANES];
        Self {
            tree: Tree::new(bodies),
            lists: Lists::default(),
            places: core::array::from_fn(|_| padded()),
            weights: padded(),
            sums: core::array::from_fn(|_| padded()),
            transfers: Vec::new(),
            moments: Vec::new(),
            locals: Vec::new(),
            sent: Vec::new(),
            received: Vec::new(),
            packs: [Vec::new(), Vec::new()],
        }
    }

    /// Calls `each` with each body and the sums of `quantity` for it, for bodies at these places.
    pub(super) fn evaluate<S, Q>(
        &mut self,
        expansion: &mut Expansion<D>,
        system: &S,
        quantity: &Q,
        places: [&[f64]; D],
        mut each: impl FnMut(usize, [f64; D]),
    ) -> Result<(), NotFinite>
    where
        S: PairSum<f64, D>,
        Q: Quantity<D>,
    {
        self.tree.sort(places)?;
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            for axis in 0..D {
                self.places[axis][place] = places[axis][body as usize];
                self.sums[axis][place] = 0.0;
            }
            self.weights[place] = system.weight(body as usize);
        }
        let size = expansion.basis.len();
        self.lists.fill(&self.tree, size);
        if self.lists.far.iter().any(|list| !list.is_empty()) {
            self.begin(expansion, |r2| system.kernel(r2));
            self.collect(expansion);
            self.exchange(expansion);
            self.distribute::<Q>(expansion);
        }
        self.neighbours(quantity);
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            each(body as usize, core::array::from_fn(|axis| self.sums[axis][place]));
        }
        Ok(())
    }

    fn begin(&mut self, expansion: &mut Expansion<D>, kernel: impl Fn(f64) -> f64) {
        let size = expansion.basis.len();
        for coefficients in [&mut self.moments, &mut self.locals, &mut self.sent, &mut self.received] {
            coefficients.clear();
            coefficients.resize(self.tree.cubes.len() * size, 0.0);
        }
        self.packs.iter_mut().for_each(|packs| packs.resize(size, Pack::all(0.0)));
        self.transfers.clear();
        for (level, lists) in self.lists.far.chunks(offsets::<D>()).enumerate() {
            let has_any = lists.iter().any(|list| !list.is_empty());
            self.transfers.push(has_any.then(|| expansion.position(self.tree.edge(level as u32), &kernel)));
        }
    }

    /// The moments of all cubes, from the smallest up.
    fn collect(&mut self, expansion: &Expansion<D>) {
        let Self { tree, places, weights, moments, sent, transfers, packs: [packs, _], .. } = self;
        let size = expansion.basis.len();
        widest_if(
            true,
            #[inline(always)]
            || {
                let mut at = [Chebyshev::none(); D];
                for (number, cube) in tree.cubes.iter().enumerate().rev() {
                    let (before, after) = moments.split_at_mut((number + 1) * size);
                    let moments = &mut before[number * size..];
                    if !cube.is_divided() {
                        packs.fill(Pack::all(0.0));
                        for first in cube.bodies().step_by(LANES) {
                            set_polynomials::<D, false>(
                                &mut at,
                                expansion,
                                places,
                                tree.frame(cube),
                                first,
                                cube.past,
                            );
                            add_moments(packs, &expansion.rows, &at, load_before(cube.past, weights, first));
                        }
                        for (moment, pack) in moments.iter_mut().zip(packs.iter()) {
                            *moment = pack.0.iter().sum();
                        }
                    }
                    for part in cube.parts() {
                        let [to_whole, _] = expansion.refinement(tree.cubes[part].side());
                        let start = (part - number - 1) * size;
                        add_product(moments, to_whole, &after[start..start + size]);
                    }
                    if let Some(position) = transfers[cube.level as usize] {
                        let Transfer { rank, compression: [compress, _], .. } = expansion.transfer(position);
                        add_product(&mut sent[number * size..number * size + rank], compress, moments);
                    }
                }
            },
        );
    }

    /// What cubes do to others as wholes.
    fn exchange(&mut self, expansion: &Expansion<D>) {
        let Self { lists, sent, received, transfers, packs: [given, taken], .. } = self;
        let size = expansion.basis.len();
        for (number, list) in lists.far.iter().enumerate() {
            let Some(position) = transfers[number / offsets::<D>()] else { continue };
            let transfer = expansion.transfer(position);
            let matrix = &transfer.matrices[number % offsets::<D>()];
            let (given, taken) = (&mut given[..transfer.rank], &mut taken[..transfer.rank]);
            widest_if(
                true,
                #[inline(always)]
                || {
                    for some in list.chunks(LANES) {
                        for (lane, pair) in some.iter().enumerate() {
                            let from = &sent[pair.source as usize * size..];
                            for (pack, coefficient) in given.iter_mut().zip(from) {
                                pack.0[lane] = *coefficient;
                            }
                        }
                        multiply(matrix, given, taken);
                        for (lane, pair) in some.iter().enumerate() {
                            let to = &mut received[pair.target as usize * size..];
                            for (coefficient, pack) in to.iter_mut().zip(taken.iter()) {
                                *coefficient += pack.0[lane];
                            }
                        }
                    }
                },
            );
        }
    }

    /// The local expansions of cubes go to their parts, and from the smallest to the bodies.
    fn distribute<Q: Quantity<D>>(&mut self, expansion: &Expansion<D>) {
        let Self { tree, places, locals, received, transfers, sums, .. } = self;
        let size = expansion.basis.len();
        widest_if(
            true,
            #[inline(always)]
            || {
                let mut at = [Chebyshev::none(); D];
                for (number, cube) in tree.cubes.iter().enumerate() {
                    let (before, after) = locals.split_at_mut((number + 1) * size);
                    let local = &mut before[number * size..];
                    if let Some(position) = transfers[cube.level as usize] {
                        let Transfer { rank, compression: [_, expand], .. } = expansion.transfer(position);
                        add_product(local, expand, &received[number * size..number * size + rank]);
                    }
                    for part in cube.parts() {
                        let [_, to_part] = expansion.refinement(tree.cubes[part].side());
                        let start = (part - number - 1) * size;
                        add_product(&mut after[start..start + size], to_part, local);
                    }
                    if cube.is_divided() {
                        continue;
                    }
                    let (_, half) = tree.frame(cube);
                    for first in cube.bodies().step_by(LANES) {
                        set_polynomials::<D, true>(
                            &mut at,
                            expansion,
                            places,
                            tree.frame(cube),
                            first,
                            cube.past,
                        );
                        let found = evaluated::<D, Q>(local, &expansion.rows, &at, 1.0 / half);
                        add_before(cube.past, sums, first, found.as_ref());
                    }
                }
            },
        );
    }

    /// What bodies do to others one by one.
    fn neighbours<Q: Quantity<D>>(&mut self, quantity: &Q) {
        let Self { tree, lists, places, weights, sums, .. } = self;
        widest_if(
            true,
            #[inline(always)]
            || {
                for &(target, source) in &lists.near {
                    let [target, source] = [target, source].map(|cube| &tree.cubes[cube as usize]);
                    for first in target.bodies().step_by(LANES) {
                        let mut found = Q::none();
                        let at: [Pack; D] = core::array::from_fn(|axis| load(&places[axis], first));
                        // The bodies in these lanes act on all others of them only.
                        let [own, past] =
                            [first, first + LANES].map(|end| end.clamp(source.first, source.past));
                        for others in [source.first..own, past..source.past] {
                            for body in others {
                                let place: [f64; D] = core::array::from_fn(|axis| places[axis][body]);
                                add_pairs(quantity, &mut found, &at, place, Pack::all(weights[body]), None);
                            }
                        }
                        for body in own..past {
                            let place: [f64; D] = core::array::from_fn(|axis| places[axis][body]);
                            let mut weight = Pack::all(weights[body]);
                            weight.0[body - first] = 0.0;
                            add_pairs(quantity, &mut found, &at, place, weight, Some(body - first));
                        }
                        add_before(target.past, sums, first, found.as_ref());
                    }
                }
            },
        );
    }
}

/// Adds what a body at `place` does to bodies in lanes, of which one may be itself: there a number stands in the place of the distance.
#[inline(always)]
fn add_pairs<const D: usize, Q: Quantity<D>>(
    quantity: &Q,
    found: &mut Q::Sums,
    at: &[Pack; D],
    place: [f64; D],
    weight: Pack,
    itself: Option<usize>,
) {
    let mut difference = *at;
    let mut r2 = Pack::all(0.0);
    for axis in 0..D {
        difference[axis] = at[axis] - Pack::all(place[axis]);
        r2 += difference[axis] * difference[axis];
    }
    if let Some(lane) = itself {
        r2.0[lane] = 1.0;
    }
    quantity.add_pair(found, weight, difference, r2);
}

/// Sets the polynomials at some bodies of a cube; for those from `past` on, to the ones in its middle.
#[inline(always)]
fn set_polynomials<const D: usize, const SLOPES: bool>(
    at: &mut [Chebyshev<Pack>; D],
    expansion: &Expansion<D>,
    places: &[Vec<f64>; D],
    (middle, half): ([f64; D], f64),
    first: usize,
    past: usize,
) {
    for axis in 0..D {
        let mut u = load(&places[axis], first);
        for lane in 0..LANES {
            u.0[lane] = if first + lane < past { (u.0[lane] - middle[axis]) / half } else { 0.0 };
        }
        at[axis].set::<SLOPES>(u, expansion.basis.order);
    }
}

/// Adds the moments of some bodies.
#[inline(always)]
fn add_moments<const D: usize>(
    moments: &mut [Pack],
    rows: &[Row<D>],
    at: &[Chebyshev<Pack>; D],
    weights: Pack,
) {
    for Row { degrees, first, len } in rows {
        let mut product = weights;
        for axis in 0..D - 1 {
            product = product * at[axis].value[degrees[axis]];
        }
        for (moment, value) in moments[*first..first + len].iter_mut().zip(&at[D - 1].value) {
            *moment += product * *value;
        }
    }
}

/// What a local expansion is at some bodies.
#[inline(always)]
fn evaluated<const D: usize, Q: Quantity<D>>(
    local: &[f64],
    rows: &[Row<D>],
    at: &[Chebyshev<Pack>; D],
    scale: f64,
) -> Q::Sums {
    let last = &at[D - 1];
    let mut found = Q::none();
    for Row { degrees, first, len } in rows {
        let mut row = [Pack::all(0.0); 2];
        for (degree, &coefficient) in local[*first..first + len].iter().enumerate() {
            row[0] += Pack::all(coefficient) * last.value[degree];
            row[1] += Pack::all(coefficient) * last.slope[degree];
        }
        Q::add_row(&mut found, at, degrees, row, scale);
    }
    found
}
