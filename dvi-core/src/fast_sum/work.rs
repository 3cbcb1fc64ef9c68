//! The passes of one evaluation: moments up the tree, from cube to cube, local expansions down, neighbours
//! one by one (Greengard & Rokhlin 1987; with interpolation of the kernel, Fong & Darve 2009).

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::expansion::{Expansion, Stage};
use super::lists::{Lists, pairs};
use super::locals::Actions;
use super::matrix::padded;
use super::moments::Sources;
use super::neighbours::Nearby;
use super::packs::{LANES, NOTHING, Pack};
use super::quantity::Quantity;
use super::shares::{Piece, share};
use super::spot_check;
use super::transfer::{Transfer, offsets};
use super::tree::{NotFinite, Tree};

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
#[derive(Clone, Copy, Debug, Default)]
struct Level {
    /// The first of them.
    first: usize,
    /// The matrices between those that act on others as wholes, if there are such.
    transfer: Option<usize>,
    /// The functions of their expansions, if these or larger cubes act on others as wholes.
    subspace: Option<usize>,
    /// Their first coefficient, and the first of the next level.
    start: usize,
    past: usize,
}

impl Level {
    /// Expansions of the cubes, in rows one after the other, if there are any.
    fn stage<'w, const D: usize>(&self, expansion: &'w Expansion<D>, rows: &'w [f64]) -> Option<Stage<'w>> {
        expansion.subspace(self.subspace).map(|subspace| Stage { subspace, first: self.first, rows })
    }
}

/// The bodies in the order of the tree, and which act on which.
#[derive(Clone, Debug)]
pub(super) struct Sorted<const D: usize> {
    pub(super) tree: Tree<D>,
    pub(super) lists: Lists,
    /// With room behind them for the lanes of the last bodies.
    pub(super) places: [Vec<f64>; D],
    pub(super) weights: Vec<f64>,
}

/// The numbers of one evaluation, kept from one to the next.
#[derive(Clone, Debug)]
pub(super) struct Work<const D: usize> {
    tolerance: f64,
    bodies: Sorted<D>,
    sums: [Vec<f64>; D],
    levels: Vec<Level>,
    /// Of each cube, by the functions of its level: see [`Sources`] and [`Actions`].
    moments: Vec<f64>,
    locals: Vec<f64>,
    /// For cubes of one level, by the functions of the basis.
    room: Vec<f64>,
    /// What bodies do to those of later cubes: see [`Nearby`].
    reactions: Vec<Pack>,
}

impl<const D: usize> Work<D> {
    /// For forces with relative errors of about `tolerance`.
    pub(super) fn new(tolerance: f64) -> Self {
        let none = || core::array::from_fn(|_| Vec::new());
        Self {
            tolerance,
            bodies: Sorted {
                tree: Tree::new(),
                lists: Lists::default(),
                places: none(),
                weights: Vec::new(),
            },
            sums: none(),
            levels: Vec::new(),
            moments: Vec::new(),
            locals: Vec::new(),
            room: Vec::new(),
            reactions: Vec::new(),
        }
    }

    /// Sums the quantity Q, of which `factor` is what depends on the squared distance, for bodies with these
    /// weights and at these places, with the `kernel` K. Returns each body with its sums.
    pub(super) fn evaluate<Q: Quantity<D>>(
        &mut self,
        expansion: &mut Expansion<D>,
        weight: &dyn Fn(usize) -> f64,
        kernel: &dyn Fn(Pack) -> Pack,
        factor: &(impl Fn(Pack) -> Pack + Sync),
        places: [&[f64]; D],
    ) -> Result<impl Iterator<Item = (usize, [f64; D])>, NotFinite> {
        self.sort(expansion, weight, places)?;
        self.plan(expansion, kernel);
        self.pass::<Q>(expansion, factor);
        let has_expansions = self.levels.iter().any(|level| level.transfer.is_some());
        let part = ALLOWED * self.tolerance;
        if has_expansions && !spot_check::holds::<Q, D>(&self.bodies, factor, &self.sums, part) {
            self.plan_without_expansions();
            self.pass::<Q>(expansion, factor);
        }
        let sums = |place: usize| core::array::from_fn(|axis| self.sums[axis][place]);
        let order = self.bodies.tree.order.iter().enumerate();
        Ok(order.map(move |(place, &(_, body))| (body as usize, sums(place))))
    }

    /// The relative error of the sums of the last evaluation, of some bodies.
    pub(super) fn error<Q: Quantity<D>>(&self, factor: &impl Fn(Pack) -> Pack, bodies: usize) -> f64 {
        spot_check::error::<Q, D>(&self.bodies, factor, &self.sums, bodies)
    }

    /// What the last evaluation has taken.
    pub(super) fn operations(&self, expansion: &Expansion<D>) -> Operations {
        let Sorted { tree, lists, .. } = &self.bodies;
        let cube = |number: u32| &tree.cubes[number as usize];
        let near = lists.near.iter().map(|pair| pairs(cube(pair.target), cube(pair.source)) as u64);
        // A body is beside itself in the list of its own cube.
        let pairs = near.sum::<u64>() - tree.order.len() as u64;
        let levels = self.levels.iter().zip(lists.far.chunks(offsets::<D>()));
        let products = levels.map(|(level, lists)| {
            let rank = expansion.transfer(level.transfer).map_or(0, Transfer::rank) as u64;
            rank * rank * lists.iter().map(|list| list.len() as u64).sum::<u64>()
        });
        Operations { pairs, products: products.sum() }
    }

    /// Bodies in their order.
    fn sort(
        &mut self,
        expansion: &Expansion<D>,
        weight: &dyn Fn(usize) -> f64,
        places: [&[f64]; D],
    ) -> Result<(), NotFinite> {
        let few = if D > 2 { FEW_IN_SPACE * expansion.basis.len() } else { FEW };
        let Sorted { tree, places: sorted, weights, .. } = &mut self.bodies;
        tree.sort(places, few)?;
        let room = places[0].len() + LANES;
        let all = sorted.iter_mut().chain(&mut self.sums).chain([&mut *weights]);
        all.for_each(|numbers| numbers.resize(room, 0.0));
        for (place, &(_, body)) in tree.order.iter().enumerate() {
            for axis in 0..D {
                sorted[axis][place] = places[axis][body as usize];
            }
            weights[place] = weight(body as usize);
        }
        Ok(())
    }

    /// Which cubes act as wholes, and the matrices for them.
    fn plan(&mut self, expansion: &mut Expansion<D>, kernel: &dyn Fn(Pack) -> Pack) {
        let Sorted { tree, lists, .. } = &mut self.bodies;
        lists.fill(tree, expansion.basis.len());
        let levels = tree.levels.len();
        expansion.keep(tree.edge(levels as u32)..tree.edge(0));
        self.levels.clear();
        let (mut subspace, mut past) = (None, 0);
        for level in 0..levels {
            let far = &lists.far[level * offsets::<D>()..][..offsets::<D>()];
            let has_any = far.iter().any(|list| !list.is_empty());
            let edge = tree.edge(level as u32);
            let transfer = if has_any { expansion.position(edge, kernel) } else { None };
            if has_any && transfer.is_none() {
                lists.approach::<D>(level);
            }
            if subspace.is_some() || transfer.is_some() {
                subspace = Some(expansion.subspace_position(subspace, edge, transfer));
            }
            let start = past;
            past += tree.levels[level].len() * expansion.subspace(subspace).map_or(0, |found| found.stride);
            let first = tree.levels[level].start;
            self.levels.push(Level { first, transfer, subspace, start, past });
        }
        lists.oppose(tree);
        [&mut self.moments, &mut self.locals].iter_mut().for_each(|numbers| numbers.resize(past, 0.0));
        let widest = tree.levels.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
        let size = if subspace.is_some() { padded(expansion.basis.len()) } else { 0 };
        self.room.resize(widest * size, 0.0);
    }

    /// All bodies act one by one.
    fn plan_without_expansions(&mut self) {
        let Sorted { tree, lists, .. } = &mut self.bodies;
        (0..tree.levels.len()).for_each(|level| lists.approach::<D>(level));
        lists.oppose(tree);
        self.levels.iter_mut().for_each(|level| *level = Level { first: level.first, ..Level::default() });
    }

    /// All passes, as they are planned.
    fn pass<Q: Quantity<D>>(&mut self, expansion: &Expansion<D>, factor: &(impl Fn(Pack) -> Pack + Sync)) {
        self.sums.iter_mut().for_each(|sums| sums.fill(0.0));
        self.collect(expansion);
        self.act::<Q>(factor);
        self.distribute::<Q>(expansion);
    }

    /// The moments of all cubes, level by level from below.
    fn collect(&mut self, expansion: &Expansion<D>) {
        let Self { bodies, levels, moments, room, sums, .. } = self;
        for (number, level) in levels.iter().enumerate().rev() {
            let Some(subspace) = expansion.subspace(level.subspace) else { return };
            let (own, below) = moments[level.start..].split_at_mut(level.past - level.start);
            let below = levels.get(number + 1).and_then(|next| next.stage(expansion, below));
            let sources = Sources { expansion, bodies, subspace, below };
            let begin = |cube: usize| [cube * subspace.stride, cube * padded(expansion.basis.len())];
            let whole = Piece::new(&bodies.tree, number, sums, own, room);
            share(whole, &bodies.tree, &begin, &|piece| sources.collect(piece));
        }
    }

    /// What bodies nearby do, but for the reactions.
    fn act<Q: Quantity<D>>(&mut self, factor: &(impl Fn(Pack) -> Pack + Sync)) {
        let Self { bodies, sums, reactions, .. } = self;
        let Sorted { tree, lists, .. } = &*bodies;
        let begin = |cube: usize| [D * lists.packs_before(cube), 0];
        reactions.resize(begin(tree.cubes.len())[0], NOTHING);
        let nearby = Nearby::<Q, _, D> { bodies, factor, quantity: PhantomData };
        for (number, cubes) in tree.levels.iter().enumerate() {
            let rows = &mut reactions[begin(cubes.start)[0]..begin(cubes.end)[0]];
            share(Piece::new(tree, number, sums, rows, &mut []), tree, &begin, &|piece| nearby.act(piece));
        }
    }

    /// What far cubes do, level by level from above, and the reactions on their bodies.
    fn distribute<Q: Quantity<D>>(&mut self, expansion: &Expansion<D>) {
        let Self { bodies, levels, sums, moments, locals, room, reactions, .. } = self;
        for (number, level) in levels.iter().enumerate() {
            let (before, own) = locals.split_at_mut(level.start);
            let above = number.checked_sub(1).map(|above| &levels[above]);
            let actions = Actions {
                expansion,
                bodies,
                far: &bodies.lists.far[number * offsets::<D>()..][..offsets::<D>()],
                transfer: expansion.transfer(level.transfer),
                reactions,
                moments: level.stage(expansion, &moments[level.start..level.past]),
                above: above.and_then(|above| above.stage(expansion, &before[above.start..])),
            };
            let stride = actions.moments.map_or(0, |moments| moments.subspace.stride);
            let size = actions.moments.map_or(0, |_| padded(expansion.basis.len()));
            let own = &mut own[..level.past - level.start];
            let whole = Piece::new(&bodies.tree, number, sums, own, room);
            let begin = |cube: usize| [cube * stride, cube * size];
            share(whole, &bodies.tree, &begin, &|piece| actions.distribute::<Q>(piece));
        }
    }
}
