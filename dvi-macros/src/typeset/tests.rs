//! What is read in the LaTeX of random formulas is what was written.

use super::Typesetter;
use crate::oracle_tests::random::Random;

/// A formula in three variables.
enum Tree {
    Variable(usize),
    Number(u64),
    Negative(Box<Tree>),
    Binary(char, [Box<Tree>; 2]),
    Power(Box<Tree>, u64),
    Sine(Box<Tree>),
}

const NAMES: [&str; 3] = ["a", "b", "c"];

/// The integers modulo this prime, in which nothing is rounded.
const PRIME: u64 = 1_000_003;

/// A number there; zero stands for a division by zero, too.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Number(u64);

impl Number {
    fn plus(self, other: Self) -> Self {
        Self((self.0 + other.0) % PRIME)
    }

    fn negated(self) -> Self {
        Self((PRIME - self.0) % PRIME)
    }

    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0 % PRIME)
    }

    fn power(self, exponent: u64) -> Self {
        (0..exponent).fold(Self(1), |power, _| power.times(self))
    }

    fn over(self, other: Self) -> Self {
        let (mut inverse, mut square, mut rest) = (Self(1), other, PRIME - 2);
        while rest > 0 {
            if rest % 2 == 1 {
                inverse = inverse.times(square);
            }
            (square, rest) = (square.times(square), rest / 2);
        }
        self.times(inverse)
    }

    /// A function that is none of the others, in place of the sine.
    fn sine(self) -> Self {
        self.times(self).plus(Self(5)).power(3).plus(self)
    }
}

impl Tree {
    fn random(random: &mut Random, depth: u32) -> Self {
        let part = |random: &mut Random| Box::new(Self::random(random, depth - 1));
        match random.below(if depth == 0 { 2 } else { 9 }) {
            0 => Self::Variable(random.below(3)),
            1 => Self::Number(random.below(5) as u64 + 1),
            2 => Self::Negative(part(random)),
            3 => Self::Power(part(random), random.below(3) as u64 + 1),
            4 => Self::Sine(part(random)),
            _ => Self::Binary(*random.pick(&['+', '-', '*', '/']), [part(random), part(random)]),
        }
    }

    /// As the attribute reads it, with all parentheses, of which the tree of the syntax takes no notice.
    fn written(&self) -> String {
        match self {
            Self::Variable(number) => NAMES[*number].to_owned(),
            Self::Number(number) => format!("{number}.0"),
            Self::Negative(of) => format!("(-{})", of.written()),
            Self::Binary(sign, [left, right]) => format!("({} {sign} {})", left.written(), right.written()),
            Self::Power(of, exponent) => format!("({}).powi({exponent})", of.written()),
            Self::Sine(of) => format!("({}).sin()", of.written()),
        }
    }

    fn value(&self, at: [Number; 3]) -> Number {
        match self {
            Self::Variable(number) => at[*number],
            Self::Number(number) => Number(*number),
            Self::Negative(of) => of.value(at).negated(),
            Self::Power(of, exponent) => of.value(at).power(*exponent),
            Self::Sine(of) => of.value(at).sine(),
            Self::Binary(sign, [left, right]) => {
                let (left, right) = (left.value(at), right.value(at));
                match sign {
                    '+' => left.plus(right),
                    '-' => left.plus(right.negated()),
                    '*' => left.times(right),
                    _ => left.over(right),
                }
            }
        }
    }
}

/// Reads LaTeX as one does on paper.
struct Reader<'a> {
    rest: &'a str,
    at: [Number; 3],
}

impl Reader<'_> {
    fn takes(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(word);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Number {
        let mut sum = if self.takes("-") { self.product().negated() } else { self.product() };
        loop {
            if self.takes("+") {
                sum = sum.plus(self.product());
            } else if self.takes("-") {
                sum = sum.plus(self.product().negated());
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> Number {
        let mut product = self.factor();
        while self.takes(r"\,") || self.takes(r"\cdot") {
            product = product.times(self.factor());
        }
        product
    }

    fn factor(&mut self) -> Number {
        if self.takes(r"\sin") {
            // Without parentheses it seems to be that of all that follows.
            let of = if self.takes(r"\left(") { self.closed(r"\right)") } else { self.product() };
            return of.sine();
        }
        let base = if self.takes(r"\left(") {
            self.closed(r"\right)")
        } else if self.takes(r"\frac{") {
            let above = self.closed("}");
            assert!(self.takes("{"), "{}", self.rest);
            above.over(self.closed("}"))
        } else if self.takes("{") {
            self.closed("}")
        } else if let Some(number) = NAMES.iter().position(|name| self.takes(name)) {
            self.at[number]
        } else {
            let end = self.rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(self.rest.len());
            let (digits, rest) = self.rest.split_at(end);
            self.rest = rest;
            Number(digits.parse().expect("a number"))
        };
        if self.takes("^{") { base.power(self.closed("}").0) } else { base }
    }

    fn closed(&mut self, end: &str) -> Number {
        let value = self.sum();
        assert!(self.takes(end), "{end} is missing in {}", self.rest);
        value
    }
}

#[test]
fn what_is_read_is_what_was_written() {
    let at = [123_457, 765_433, 31_337].map(Number);
    let mut random = Random::new(2002);
    for _ in 0..10_000 {
        let tree = Tree::random(&mut random, 5);
        let written = tree.written();
        let formula = syn::parse_str(&written).expect("a formula");
        let mut typesetter = Typesetter::default();
        let whole = typesetter.expr(&formula).text;
        let terms = typesetter.terms(&formula).join(" ");
        for tex in [whole, terms] {
            let mut reader = Reader { rest: &tex, at };
            assert_eq!(reader.sum(), tree.value(at), "{written} is read {tex}");
            assert_eq!(reader.rest.trim(), "", "{tex}");
        }
    }
}
