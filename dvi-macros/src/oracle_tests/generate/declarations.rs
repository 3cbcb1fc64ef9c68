//! Random declarations: sizes, coordinates, and the fields of the struct.

use crate::oracle_tests::formula::Formula;
use crate::oracle_tests::random::Random;
use crate::oracle_tests::rotations::{COMPONENTS, ENTRIES};
use crate::oracle_tests::spinors::SPINOR;
use crate::oracle_tests::system::{Block, Container, Dynamics, Field, Size, SizeKind, System};
use crate::syntax::Factor;

/// How sizes are written.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    Literal,
    Constant,
    RunTime,
    Mixed,
}

/// A system without formulas.
pub(super) fn declarations(random: &mut Random, regular: bool) -> System {
    let known = *random.pick(&[Known::Literal, Known::Constant, Known::RunTime, Known::Mixed]);
    let mut sizes = sizes(random, known);
    let width = if random.chance(35) { 2 + random.below(2) } else { 0 };
    if width > 0 {
        sizes.push(Size { kind: SizeKind::Literal, value: width as i64 });
    }
    let fields = fields(random, &sizes, width);
    let of = sizes.len() - 1;
    let blocks = match width {
        0 => blocks(random, regular, &sizes),
        3 if regular && random.chance(60) => {
            sizes.push(Size { kind: SizeKind::Literal, value: ENTRIES as i64 });
            on_manifolds(random, [of, of + 1])
        }
        width => vectors(random, regular, width, of),
    };
    System { fields, width, ..System::of(sizes, blocks, Dynamics::Regular(Formula::Time)) }
}

/// Two sizes that are different from each other, and that of the field `g`.
fn sizes(random: &mut Random, known: Known) -> Vec<Size> {
    let (first, second) = *random.pick(&[(3, 2), (2, 3), (3, 4), (2, 4), (4, 2)]);
    let kind = |random: &mut Random, constant, field| match known {
        Known::Literal => SizeKind::Literal,
        Known::Constant => SizeKind::Constant(constant),
        Known::RunTime => SizeKind::Field(field),
        Known::Mixed => {
            random.pick(&[SizeKind::Literal, SizeKind::Constant(constant), SizeKind::Field(field)]).clone()
        }
    };
    let mut sizes = vec![
        Size { kind: kind(random, "N", "n"), value: first },
        Size { kind: kind(random, "M", "m"), value: second },
    ];
    if matches!(known, Known::RunTime | Known::Mixed) {
        sizes.push(Size { kind: SizeKind::Length("g"), value: 2 + random.below(2) as i64 });
    }
    if random.chance(20) {
        let (a, b) = *random.pick(&[(0, 1), (1, 0), (1, 1)]);
        sizes.push(Size { kind: SizeKind::Product(a, b), value: sizes[a].value * sizes[b].value });
    }
    sizes
}

fn fields(random: &mut Random, sizes: &[Size], width: usize) -> Vec<Field> {
    let on_stack = |size: &usize| matches!(sizes[*size].kind, SizeKind::Literal | SizeKind::Constant(_));
    let entries = |random: &mut Random, container: Container, shape: &[usize]| {
        let count: i64 = shape.iter().map(|size| sizes[*size].value).product();
        let value = |_| match container {
            Container::Integer => 1.0 + random.below(3) as f64,
            _ => random.between(0.4, 1.6) * if random.chance(25) { -1.0 } else { 1.0 },
        };
        (0..count).map(value).collect()
    };
    let mut fields = Vec::new();
    let mut declare = |random: &mut Random, name, container, shape: Vec<usize>| {
        let values = entries(random, container, &shape);
        fields.push(Field { name, container, shape, values });
    };
    declare(random, "s", Container::Scalar, vec![]);
    if random.chance(20) {
        declare(random, "e", Container::Integer, vec![]);
    }
    for (size, name) in [(0, "a"), (1, "b")] {
        let container = if on_stack(&size) {
            *random.pick(&[Container::Array, Container::Array, Container::Vector])
        } else {
            *random.pick(&[Container::Vector, Container::Slice])
        };
        declare(random, name, container, vec![size]);
    }
    if random.chance(40) {
        let container =
            if on_stack(&0) && on_stack(&1) { Container::Matrix } else { Container::VectorOfVectors };
        declare(random, "c", container, vec![0, 1]);
    }
    if let Some(size) = sizes.iter().position(|size| size.kind == SizeKind::Length("g")) {
        let container = *random.pick(&[Container::Vector, Container::Slice]);
        declare(random, "g", container, vec![size]);
    }
    if width > 0 {
        let (size, of) = (random.below(2), sizes.len() - 1);
        let container = match on_stack(&size) && random.chance(60) {
            true => Container::Matrix,
            false => Container::VectorOfArrays,
        };
        declare(random, "h", container, vec![size, of]);
        declare(random, "f", Container::Array, vec![of]);
    }
    fields
}

/// Coordinates with vectors among them; `of` is the size with their number of components.
fn vectors(random: &mut Random, regular: bool, width: usize, of: usize) -> Vec<Block> {
    assert_ne!(width, SPINOR, "a block of so many components is a spinor");
    let array = |name, size| {
        let component = move |axis| Block { axis: Some([axis, width]), ..Block::line(name, Some(size)) };
        (0..width).map(component)
    };
    let whole = |name| Block::line(name, Some(of));
    let singles = ["u", "w"].map(|name| Block::line(name, None));
    let spinors = |name, size| {
        let spinor = move |axis| Block { name, size, axis: Some([axis, SPINOR]), factor: Factor::Sphere };
        (0..SPINOR).map(spinor)
    };
    if !regular && width == SPINOR - 1 && random.chance(50) {
        return match random.below(3) {
            0 => singles.into_iter().chain(spinors("z", Some(0))).collect(),
            1 => singles.into_iter().chain(spinors("r", None)).chain(spinors("z", Some(1))).collect(),
            _ => [whole("q"), whole("p")].into_iter().chain(spinors("z", Some(1))).collect(),
        };
    }
    match (regular, random.below(4)) {
        (true, 0) => array("r", 0).collect(),
        (true, 1) => array("r", 0).chain([whole("q"), Block::line("u", None)]).collect(),
        (true, 2) => vec![Block::line("u", None), whole("q")],
        (true, _) => [Block::line("x", Some(0))].into_iter().chain(array("r", 1)).collect(),
        (false, 0) => array("r", 0).chain(array("z", 0)).collect(),
        (false, 1) => vec![whole("q"), whole("p")],
        (false, 2) => singles.into_iter().chain(array("r", 1)).chain(array("z", 1)).collect(),
        (false, _) if width == 2 => array("r", 0).chain([whole("q"), whole("p")]).collect(),
        (false, _) => {
            [whole("q"), whole("p")].into_iter().chain(array("r", 1)).chain(array("z", 1)).collect()
        }
    }
}

/// Rotations and unit vectors, with others beside them; the sizes are those of one unit vector and of one
/// rotation.
fn on_manifolds(random: &mut Random, [of_vector, of_rotation]: [usize; 2]) -> Vec<Block> {
    let array = |name, size, factor, of| {
        (0..of).map(move |axis| Block { name, size: Some(size), axis: Some([axis, of]), factor })
    };
    let single = |name, size, factor| Block { factor, ..Block::line(name, size) };
    let rotation = || single("R", Some(of_rotation), Factor::Rotation);
    let vector = || single("z", Some(of_vector), Factor::Sphere);
    let rotations = |size| array("R", size, Factor::Rotation, ENTRIES);
    let vectors = |size| array("z", size, Factor::Sphere, COMPONENTS);
    let number = || single("u", None, Factor::Line);
    match random.below(6) {
        0 => vec![rotation(), vector()],
        1 => [number(), vector()].into_iter().chain(rotations(1)).collect(),
        2 => [rotation()].into_iter().chain(vectors(0)).chain([number()]).collect(),
        3 => rotations(0).chain(vectors(1)).collect(),
        4 => vectors(0).collect(),
        _ => array("r", 0, Factor::Line, COMPONENTS).chain(rotations(1)).chain([vector()]).collect(),
    }
}

fn blocks(random: &mut Random, regular: bool, sizes: &[Size]) -> Vec<Block> {
    let block = Block::line;
    let square = sizes.iter().position(|size| matches!(size.kind, SizeKind::Product(..)));
    if square.is_some() && random.chance(60) {
        return vec![block("x", square), block("y", square)];
    }
    let pair = vec![block("x", Some(0)), block("y", Some(0))];
    let singles = vec![block("u", None), block("w", None)];
    match random.below(5) {
        0 => pair,
        1 => singles.into_iter().chain([block("x", Some(1)), block("y", Some(1))]).collect(),
        2 if regular => vec![block("x", Some(0)), block("y", Some(1)), block("u", None)],
        2 => pair.into_iter().chain([block("z", Some(1)), block("w", Some(1))]).collect(),
        3 if regular => vec![block("u", None), block("x", Some(0))],
        3 => singles,
        _ => vec![block("x", Some(1)), block("y", Some(1)), block("u", None), block("w", None)],
    }
}
