//! The passes of one evaluation: moments up the tree, from cube to cube, local expansions down, neighbours one by one
//! (Greengard & Rokhlin 1987; with interpolation of the kernel, Fong & Darve 2009).

use alloc::vec::Vec;

use super::Operations;
use super::expansion::Expansion;
use super::lists::{Lists, on, pairs};
use super::locals::{Actions, Locals};
use super::moments::{Moments, Sources};
use super::neighbours::{Nearby, Neighbours};
use super::packs::{LANES, Pack};
use super::quantity::Quantity;
use super::transfer::offsets;
use super::tree::{NotFinite, Tree};
use crate::PairSum;
use crate::threads::share;

/// The numbers of one evaluation, kept from one to the next.
#[derive(Clone, Debug)]
pub(super) struct Work<const D: usize> {
    tree: Tree<D>,
    lists: Lists,
    /// Places and weights in the order of the tree, with room behind them for the lanes of the last bodies.
    places: [Vec<f64>; D],
    weights: Vec<f64>,
    sums: [Vec<f64>; D],
    /// For each level with cubes that act on others as wholes: which matrices they have.
    transfers: Vec<Option<usize>>,
    /// Of each cube, by the functions of the basis: see [`Moments`] and [`Locals`].
    moments: Vec<f64>,
    locals: Vec<f64>,
    sent: Vec<f64>,
    received: Vec<f64>,
    /// What bodies do to those of later cubes: see [`Neighbours`].
    reactions: Vec<Pack>,
}

impl<const D: usize> Work<D> {
    pub(super) fn new() -> Self {
        Self {
            tree: Tree::new(),
            lists: Lists::default(),
            places: core::array::from_fn(|_| Vec::new()),
            weights: Vec::new(),
            sums: core::array::from_fn(|_| Vec::new()),
            transfers: Vec::new(),
            moments: Vec::new(),
            locals: Vec::new(),
            sent: Vec::new(),
            received: Vec::new(),
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
        self.sort(expansion, system, places)?;
        let expansion = &*expansion;
        self.collect(expansion);
        self.act(quantity);
        self.distribute::<Q>(expansion);
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            each(body as usize, core::array::from_fn(|axis| self.sums[axis][place]));
        }
        Ok(())
    }

    /// What an evaluation takes for bodies at these places.
    pub(super) fn operations<S: PairSum<f64, D>>(
        &mut self,
        expansion: &mut Expansion<D>,
        system: &S,
        places: [&[f64]; D],
    ) -> Result<Operations, NotFinite> {
        self.sort(expansion, system, places)?;
        let cube = |number: u32| &self.tree.cubes[number as usize];
        let near = self.lists.near.iter().map(|pair| pairs(cube(pair.target), cube(pair.source)) as u64);
        // A body is beside itself in the list of its own cube.
        let pairs = near.sum::<u64>() - self.tree.order.len() as u64;
        let levels = self.transfers.iter().zip(self.lists.far.chunks(offsets::<D>()));
        let products = levels.map(|(transfer, lists)| {
            let rank = expansion.transfer(*transfer).map_or(0, |transfer| transfer.rank as u64);
            rank * rank * lists.iter().map(|list| list.len() as u64).sum::<u64>()
        });
        Ok(Operations { pairs, products: products.sum() })
    }

    /// Bodies in their order, the lists, and the matrices for them.
    fn sort<S: PairSum<f64, D>>(
        &mut self,
        expansion: &mut Expansion<D>,
        system: &S,
        places: [&[f64]; D],
    ) -> Result<(), NotFinite> {
        self.tree.sort(places)?;
        let room = places[0].len() + LANES;
        let Self { places: sorted, weights, sums, .. } = self;
        sorted.iter_mut().chain(sums).chain([weights]).for_each(|numbers| numbers.resize(room, 0.0));
        for (place, &(_, body)) in self.tree.order.iter().enumerate() {
            for axis in 0..D {
                self.places[axis][place] = places[axis][body as usize];
                self.sums[axis][place] = 0.0;
            }
            self.weights[place] = system.weight(body as usize);
        }
        self.lists.fill(&self.tree, expansion.basis.len());
        let levels = self.tree.levels.len();
        expansion.keep(self.tree.edge(levels as u32)..self.tree.edge(0));
        self.transfers.clear();
        for level in 0..levels {
            let lists = &self.lists.far[level * offsets::<D>()..][..offsets::<D>()];
            let has_any = lists.iter().any(|list| !list.is_empty());
            let edge = self.tree.edge(level as u32);
            let transfer = if has_any { expansion.position(edge, |r2| system.kernel(r2)) } else { None };
            if has_any && transfer.is_none() {
                self.lists.approach::<D>(level);
            }
            self.transfers.push(transfer);
        }
        self.lists.oppose(&self.tree);
        let entries = if self.has_far() { self.tree.cubes.len() * expansion.basis.len() } else { 0 };
        for coefficients in [&mut self.moments, &mut self.locals, &mut self.sent, &mut self.received] {
            coefficients.resize(entries, 0.0);
        }
        Ok(())
    }

    fn has_far(&self) -> bool {
        self.transfers.iter().any(Option::is_some)
    }

    /// The moments of all cubes, level by level from below.
    fn collect(&mut self, expansion: &Expansion<D>) {
        if !self.has_far() {
            return;
        }
        let Self { tree, places, weights, moments, sent, received, transfers, .. } = self;
        let size = expansion.basis.len();
        for (level, cubes) in tree.levels.iter().enumerate().rev() {
            let (own, below) = moments.split_at_mut(cubes.end * size);
            let entries = cubes.start * size..cubes.end * size;
            let transfer = expansion.transfer(transfers[level]);
            let from = Sources { expansion, tree, places, weights, transfer, below, first_below: cubes.end };
            let whole = Moments {
                from,
                cubes: cubes.clone(),
                moments: &mut own[entries.clone()],
                sent: &mut sent[entries.clone()],
                room: &mut received[entries],
            };
            share(whole, &Moments::collect);
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
        let has_far = self.has_far();
        let Self { tree, lists, places, sums, locals, sent, received, transfers, reactions, .. } = self;
        let size = if has_far { expansion.basis.len() } else { 0 };
        let levels = tree.levels.iter().zip(lists.far.chunks(offsets::<D>())).zip(transfers);
        for ((cubes, far), transfer) in levels {
            let (above, own) = locals.split_at_mut(cubes.start * size);
            let transfer = expansion.transfer(*transfer);
            let by =
                Actions { expansion, tree, places, has_far, far, lists, reactions, transfer, sent, above };
            let bodies = tree.cubes[cubes.start].first..tree.cubes[cubes.end - 1].past;
            let whole = Locals {
                by,
                cubes: cubes.clone(),
                locals: &mut own[..cubes.len() * size],
                received: &mut received[cubes.start * size..cubes.end * size],
                sums: sums.each_mut().map(|sums| &mut sums[bodies.clone()]),
            };
            share(whole, &Locals::distribute::<Q>);
        }
    }
}
