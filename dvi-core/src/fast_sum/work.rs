//! The passes of one evaluation: moments up the tree, from cube to cube, local expansions down, neighbours
//! one by one (Greengard & Rokhlin 1987; with interpolation of the kernel, Fong & Darve 2009).

use alloc::vec::Vec;

use super::expansion::Expansion;
use super::lists::{Lists, on, pairs};
use super::locals::{Actions, Locals};
use super::matrix::padded;
use super::moments::{Moments, Sources};
use super::neighbours::{Nearby, Neighbours};
use super::packs::{LANES, Pack};
use super::quantity::{Gradient, Quantity};
use super::shares::share;
use super::spot_check;
use super::transfer::{Transfer, offsets};
use super::tree::{NotFinite, Tree};
use crate::PairSum;

/// What an evaluation of the forces takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Operations {
    /// Ordered pairs of bodies that are summed one by one. A sum over all pairs has n(n − 1).
    pub pairs: u64,
    /// Multiplications in the matrices between groups of bodies.
    pub products: u64,
}

/// A cube with no more bodies is not divided: near bodies then take about as long as far cubes.
const FEW: usize = 64;
/// In space the matrices are larger. The same, for each function of the basis.
const FEW_IN_SPACE: usize = 2;

/// How far sums may be from those over all pairs, in units of the tolerance, as a part of the sum of the
/// absolute values of terms.
const ALLOWED: f64 = 10.0;

/// Where to find what belongs to the cubes of one level.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// The matrices between those that act on others as wholes, if there are such.
    transfer: Option<usize>,
    /// The functions of their expansions, if these or larger cubes act on others as wholes.
    subspace: Option<usize>,
    /// Their first coefficient, and the first of the next level.
    start: usize,
    past: usize,
}

/// The numbers of one evaluation, kept from one to the next.
#[derive(Clone, Debug)]
pub(super) struct Work<const D: usize> {
    tolerance: f64,
    tree: Tree<D>,
    lists: Lists,
    /// Places and weights in the order of the tree, with room behind them for the lanes of the last bodies.
    places: [Vec<f64>; D],
    weights: Vec<f64>,
    sums: [Vec<f64>; D],
    levels: Vec<Level>,
    /// Of each cube, by the functions of its level: see [`Moments`] and [`Locals`].
    moments: Vec<f64>,
    locals: Vec<f64>,
    /// For cubes of one level, by the functions of the basis.
    room: Vec<f64>,
    /// What bodies do to those of later cubes: see [`Neighbours`].
    reactions: Vec<Pack>,
}

impl<const D: usize> Work<D> {
    /// For forces with relative errors of about `tolerance`.
    pub(super) fn new(tolerance: f64) -> Self {
        Self {
            tolerance,
            tree: Tree::new(),
            lists: Lists::default(),
            places: core::array::from_fn(|_| Vec::new()),
            weights: Vec::new(),
            sums: core::array::from_fn(|_| Vec::new()),
            levels: Vec::new(),
            moments: Vec::new(),
            locals: Vec::new(),
            room: Vec::new(),
            reactions: Vec::new(),
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
        self.sum_up(expansion, system, quantity, places)?;
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            each(body as usize, core::array::from_fn(|axis| self.sums[axis][place]));
        }
        Ok(())
    }

    /// What an evaluation of the forces takes for bodies at these places.
    pub(super) fn operations<S>(
        &mut self,
        expansion: &mut Expansion<D>,
        system: &S,
        places: [&[f64]; D],
    ) -> Result<Operations, NotFinite>
    where
        S: PairSum<f64, D> + PairSum<Pack, D> + Sync,
    {
        self.sum_up(expansion, system, &Gradient(system), places)?;
        let cube = |number: u32| &self.tree.cubes[number as usize];
        let near = self.lists.near.iter().map(|pair| pairs(cube(pair.target), cube(pair.source)) as u64);
        // A body is beside itself in the list of its own cube.
        let pairs = near.sum::<u64>() - self.tree.order.len() as u64;
        let levels = self.levels.iter().zip(self.lists.far.chunks(offsets::<D>()));
        let products = levels.map(|(level, lists)| {
            let rank = expansion.transfer(level.transfer).map_or(0, Transfer::rank) as u64;
            rank * rank * lists.iter().map(|list| list.len() as u64).sum::<u64>()
        });
        Ok(Operations { pairs, products: products.sum() })
    }

    /// Sets the sums, in the order of the tree.
    fn sum_up<S: PairSum<f64, D>, Q: Quantity<D>>(
        &mut self,
        expansion: &mut Expansion<D>,
        system: &S,
        quantity: &Q,
        places: [&[f64]; D],
    ) -> Result<(), NotFinite> {
        self.sort(expansion, system, places)?;
        if self.plan(expansion, system).is_none() {
            self.plan_without_expansions();
        }
        self.pass(expansion, quantity);
        let sorted = (&self.places, &*self.weights);
        let has_expansions = self.levels.iter().any(|level| level.transfer.is_some());
        let part = ALLOWED * self.tolerance;
        if has_expansions && !spot_check::holds(quantity, sorted, &self.sums, self.tree.order.len(), part) {
            self.plan_without_expansions();
            self.pass(expansion, quantity);
        }
        Ok(())
    }

    /// Bodies in their order.
    fn sort<S: PairSum<f64, D>>(
        &mut self,
        expansion: &Expansion<D>,
        system: &S,
        places: [&[f64]; D],
    ) -> Result<(), NotFinite> {
        let few = if D > 2 { FEW_IN_SPACE * expansion.basis.len() } else { FEW };
        self.tree.sort(places, few)?;
        let room = places[0].len() + LANES;
        let Self { places: sorted, weights, sums, .. } = self;
        sorted.iter_mut().chain(sums).chain([weights]).for_each(|numbers| numbers.resize(room, 0.0));
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            for axis in 0..D {
                self.places[axis][place] = places[axis][body as usize];
            }
            self.weights[place] = system.weight(body as usize);
        }
        Ok(())
    }

    /// Which cubes act as wholes, and the matrices for them; none if there are no functions for their
    /// expansions.
    fn plan<S: PairSum<f64, D>>(&mut self, expansion: &mut Expansion<D>, system: &S) -> Option<()> {
        self.lists.fill(&self.tree, expansion.basis.len());
        let levels = self.tree.levels.len();
        expansion.keep(self.tree.edge(levels as u32)..self.tree.edge(0));
        self.levels.clear();
        let (mut subspace, mut past) = (None, 0);
        for level in 0..levels {
            let lists = &self.lists.far[level * offsets::<D>()..][..offsets::<D>()];
            let has_any = lists.iter().any(|list| !list.is_empty());
            let edge = self.tree.edge(level as u32);
            let transfer = if has_any { expansion.position(edge, |r2| system.kernel(r2)) } else { None };
            if has_any && transfer.is_none() {
                self.lists.approach::<D>(level);
            }
            if subspace.is_some() || transfer.is_some() {
                subspace = Some(expansion.subspace_position(subspace, edge, transfer)?);
            }
            let start = past;
            past +=
                self.tree.levels[level].len() * expansion.subspace(subspace).map_or(0, |found| found.stride);
            self.levels.push(Level { transfer, subspace, start, past });
        }
        self.lists.oppose(&self.tree);
        [&mut self.moments, &mut self.locals].iter_mut().for_each(|numbers| numbers.resize(past, 0.0));
        let widest = self.tree.levels.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
        let size = if subspace.is_some() { padded(expansion.basis.len()) } else { 0 };
        self.room.resize(widest * size, 0.0);
        Some(())
    }

    /// All bodies act one by one.
    fn plan_without_expansions(&mut self) {
        let levels = self.tree.levels.len();
        (0..levels).for_each(|level| self.lists.approach::<D>(level));
        self.lists.oppose(&self.tree);
        self.levels.clear();
        self.levels.resize(levels, Level { transfer: None, subspace: None, start: 0, past: 0 });
    }

    /// All passes, as they are planned.
    fn pass<Q: Quantity<D>>(&mut self, expansion: &Expansion<D>, quantity: &Q) {
        self.sums.iter_mut().for_each(|sums| sums.fill(0.0));
        self.collect(expansion);
        self.act(quantity);
        self.distribute::<Q>(expansion);
    }

    /// The moments of all cubes, level by level from below.
    fn collect(&mut self, expansion: &Expansion<D>) {
        let Self { tree, levels, places, weights, moments, room, .. } = self;
        for (level, cubes) in tree.levels.iter().enumerate().rev() {
            let Level { subspace, start, past, .. } = levels[level];
            let Some(subspace) = expansion.subspace(subspace) else { return };
            let (own, below) = moments[start..].split_at_mut(past - start);
            let from = Sources {
                expansion,
                tree,
                places,
                weights,
                subspace,
                subspace_below: levels.get(level + 1).and_then(|level| expansion.subspace(level.subspace)),
                below,
                first_below: cubes.end,
            };
            share(Moments { from, cubes: cubes.clone(), moments: own, room }, &Moments::collect);
        }
    }

    /// What bodies nearby do, but for the reactions.
    fn act<Q: Quantity<D>>(&mut self, quantity: &Q) {
        let Self { tree, lists, places, weights, sums, reactions, .. } = self;
        reactions.resize(D * lists.packs.last().copied().unwrap_or(0), Pack::all(0.0));
        let by = Nearby { quantity, tree, lists, places, weights };
        for cubes in &tree.levels {
            let near = on(&lists.near, cubes);
            let bodies = tree.cubes[cubes.start].first..tree.cubes[cubes.end - 1].past;
            let sums = sums.each_mut().map(|sums| &mut sums[bodies.clone()]);
            let packs = D * lists.packs[near.start]..D * lists.packs[near.end];
            share(Neighbours::new(by, cubes.clone(), sums, &mut reactions[packs]), &Neighbours::act);
        }
    }

    /// What far cubes do, level by level from above, and the reactions on their bodies.
    fn distribute<Q: Quantity<D>>(&mut self, expansion: &Expansion<D>) {
        let Self { tree, lists, levels, places, sums, moments, locals, room, reactions, .. } = self;
        let (mut subspace_above, mut start_above, mut first_above) = (None, 0, 0);
        for ((cubes, far), level) in tree.levels.iter().zip(lists.far.chunks(offsets::<D>())).zip(levels) {
            let Level { transfer, subspace, start, past } = *level;
            let (above, own) = locals.split_at_mut(start);
            let subspace = expansion.subspace(subspace);
            let by = Actions {
                expansion,
                tree,
                places,
                far,
                lists,
                reactions,
                transfer: expansion.transfer(transfer),
                subspace,
                moments: &moments[start..past],
                first: cubes.start,
                subspace_above,
                above: &above[start_above..],
                first_above,
            };
            let bodies = tree.cubes[cubes.start].first..tree.cubes[cubes.end - 1].past;
            let whole = Locals {
                by,
                cubes: cubes.clone(),
                locals: &mut own[..past - start],
                room,
                sums: sums.each_mut().map(|sums| &mut sums[bodies.clone()]),
            };
            share(whole, &Locals::distribute::<Q>);
            (subspace_above, start_above, first_above) = (subspace, start, cubes.start);
        }
    }
}
