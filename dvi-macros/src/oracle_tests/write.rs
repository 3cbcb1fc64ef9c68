//! Systems to text: the attribute and the struct as a user writes them.

mod spelling;

use super::formula::{Atom, Condition, Formula, Index, Loops, Relation};
use super::functions::{OWN, SCALAR_FIELDS};
use super::system::{Constraint, Container, Dynamics, Field, Gauge, SizeKind, System};
use spelling::{Spelling, is_in_brackets};

mod grids;
mod share;

pub(super) use grids::ONE;
use share::Definitions;

const INDICES: [&str; 10] = ["i", "j", "k", "l", "o", "i5", "i6", "i7", "i8", "i9"];

/// How tightly a written formula binds.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    /// At the beginning of a statement it would be one of its own.
    Block,
    Sum,
    Product,
    Sign,
    Postfix,
}

/// Writes the formulas of one system.
pub(super) struct Writer<'a> {
    pub(super) system: &'a System,
    /// `d` or `dot`.
    pub(super) velocity: &'static str,
    definitions: &'a Definitions,
    pub(super) spelling: Spelling,
}

impl System {
    /// The arguments of the attribute.
    pub(super) fn attribute(&self) -> String {
        let blocks = self.coordinates().into_iter();
        let blocks = blocks.map(|first| format!("{}{}", self.blocks[first].name, self.kind_text(first)));
        let mut text = format!("coordinates({})", blocks.collect::<Vec<_>>().join(", "));
        let definitions = Definitions::default();
        let writer = |velocity| Writer::new(self, velocity, &definitions);
        let (d, dot) = (writer("d"), writer("dot"));
        text += &match &self.dynamics {
            Dynamics::OneForm(one_form, hamiltonian) => {
                format!(", one_form = {}, hamiltonian = {}", d.text(one_form), d.text(hamiltonian))
            }
            Dynamics::Components(components, hamiltonian) => {
                let components = components.iter().zip(self.coordinates());
                let components = components.map(|(component, block)| {
                    format!("{}{}", self.indexed(block, component), d.text(component))
                });
                let components = components.collect::<Vec<_>>().join(", ");
                format!(", one_form = [{components}], hamiltonian = {}", d.text(hamiltonian))
            }
            Dynamics::Affine(lagrangian) | Dynamics::Regular(lagrangian) => {
                format!(", lagrangian = {}", dot.text(lagrangian))
            }
        };
        text += &match &self.gauge {
            Gauge::None => String::new(),
            Gauge::Formula(gauge) => format!(", gauge = {}", d.text(gauge)),
            Gauge::Auto => ", gauge = auto".to_string(),
        };
        text.extend(self.time_transform.iter().map(|rate| format!(", time_transform = {}", d.text(rate))));
        text.extend(self.dissipation.iter().map(|of| format!(", dissipation = {}", dot.text(of))));
        let entries = self
            .forces
            .iter()
            .map(|(block, force)| format!("{}{}", self.indexed(*block, force), dot.text(force)));
        let all = self.forces.iter().map(|(block, _)| *block).eq(self.coordinates());
        if all {
            text += &format!(", force = [{}]", entries.collect::<Vec<_>>().join(", "));
        } else {
            for ((block, _), entry) in self.forces.iter().zip(entries) {
                text += &format!(", force({}) = {entry}", self.blocks[*block].name);
            }
        }
        text += &self.constraint_arguments(&dot);
        let momenta = self.momenta.iter().enumerate();
        let momenta: Vec<String> = momenta.map(|(n, value)| format!("p{n} = {}", dot.text(value))).collect();
        // The same functions once more, whose zeros are events.
        if !momenta.is_empty() {
            text += &format!(", momenta({0}), events({0})", momenta.join(", "));
        }
        let used = OWN.iter().enumerate().filter(|(number, _)| self.calls(*number)).map(|(_, row)| row);
        let used = used.map(|(name, paths)| format!("{name} = [{}]", paths.join(", ")));
        let fields = SCALAR_FIELDS.iter().enumerate().filter(|(number, _)| self.evaluates(*number));
        let fields = fields.filter_map(|(_, field)| Some(format!("{} = {}", field.name, field.path?)));
        let own: Vec<String> = used.chain(fields).collect();
        let functions = (!own.is_empty()).then(|| format!("functions({})", own.join(", ")));
        [Some(text), functions, definitions.argument()].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// What stands in front of a component along a coordinate: the index of its entry, if it has one.
    fn indexed(&self, first: usize, component: &Formula) -> &'static str {
        let is_whole = self.axes(first) == 1 && component.is_vector();
        if self.blocks[first].size.is_some() && !is_whole { self.bars(first) } else { "" }
    }

    /// Constraints that follow each other without an index are a list.
    fn constraint_arguments(&self, writer: &Writer<'_>) -> String {
        let (mut text, word) = (String::new(), self.constrained.words().word);
        for run in self.constraints.chunk_by(|one, next| one.ranges.is_empty() && next.ranges.is_empty()) {
            text += &match run {
                [Constraint { ranges, formula }] if !ranges.is_empty() => {
                    let indices = INDICES.iter().zip(ranges);
                    let indices = indices
                        .map(|(index, (lower, upper))| format!("{index} in {}", writer.range(lower, upper)));
                    let indices = indices.collect::<Vec<_>>().join(", ");
                    format!(", {word}({indices}) = {}", writer.text(formula))
                }
                [single] => format!(", {word} = {}", writer.text(&single.formula)),
                several => {
                    let formulas = several.iter().map(|one| writer.text(&one.formula));
                    format!(", {word} = [{}]", formulas.collect::<Vec<_>>().join(", "))
                }
            };
        }
        text
    }

    /// The struct.
    pub(super) fn item(&self) -> String {
        let borrows = self.fields.iter().any(|field| field.container == Container::Slice);
        let lifetime = borrows.then(|| "'a".to_string());
        let constants = self.sizes.iter().filter_map(|size| match size.kind {
            SizeKind::Constant(name) => Some(format!("const {name}: usize")),
            _ => None,
        });
        let generics: Vec<String> = lifetime.into_iter().chain(constants).collect();
        let generics =
            if generics.is_empty() { String::new() } else { format!("<{}>", generics.join(", ")) };
        let counts = self.sizes.iter().filter_map(|size| match size.kind {
            SizeKind::Field(name) => Some(format!("{name}: usize")),
            _ => None,
        });
        let fields = self.fields.iter().map(|field| format!("{}: {}", field.name, self.type_text(field)));
        let data = SCALAR_FIELDS.iter().enumerate();
        let data = data.filter(|(number, field)| field.path.is_none() && self.evaluates(*number));
        let data = data.map(|(_, field)| format!("{}: Data", field.name));
        let one = self.has_grids().then(|| format!("{ONE}: usize"));
        let fields: Vec<String> = fields.chain(counts).chain(data).chain(one).collect();
        format!("struct System{generics} {{ {} }}", fields.join(", "))
    }

    fn type_text(&self, field: &Field) -> String {
        let size = |n: usize| self.size_text(field.shape[n]);
        match field.container {
            Container::Scalar => "f64".into(),
            Container::Integer => "i32".into(),
            Container::Array => format!("[f64; {}]", size(0)),
            Container::Vector => "Vec<f64>".into(),
            Container::Slice => "&'a [f64]".into(),
            Container::Matrix => format!("[[f64; {}]; {}]", size(1), size(0)),
            Container::VectorOfVectors => "Vec<Vec<f64>>".into(),
            Container::VectorOfArrays => format!("Vec<[f64; {}]>", size(1)),
        }
    }

    /// The name of a size in systems by hand, whatever it is written as.
    pub(super) fn size_name(&self, size: usize) -> &'static str {
        ["N", "M"][size]
    }

    pub(super) fn size_text(&self, size: usize) -> String {
        match self.sizes[size].kind {
            SizeKind::Literal => self.sizes[size].value.to_string(),
            SizeKind::Constant(name) | SizeKind::Field(name) => name.into(),
            SizeKind::Length(field) => format!("{field}.len()"),
            SizeKind::Product(a, b) => format!("({} * {})", self.size_text(a), self.size_text(b)),
        }
    }
}

impl<'a> Writer<'a> {
    fn new(system: &'a System, velocity: &'static str, definitions: &'a Definitions) -> Self {
        Self { system, velocity, definitions, spelling: Spelling::new(system.fields.len() as u32) }
    }

    pub(super) fn text(&self, formula: &Formula) -> String {
        self.bound(formula, Binding::Block)
    }

    /// In parentheses where it binds less tightly than asked.
    fn bound(&self, formula: &Formula, wanted: Binding) -> String {
        let (text, binding) = self.formula(formula);
        if binding < wanted { format!("({text})") } else { text }
    }

    fn formula(&self, formula: &Formula) -> (String, Binding) {
        match self.by_definition(formula) {
            Some(text) => (text, Binding::Postfix),
            None => self.written_here(formula),
        }
    }

    fn written_here(&self, formula: &Formula) -> (String, Binding) {
        use Binding::{Block, Postfix, Product, Sign, Sum};
        let postfix = |text: String| (text, Postfix);
        let method = |of: &Formula, name: &str, arguments: String| {
            (format!("{}.{name}({arguments})", self.bound(of, Postfix)), Postfix)
        };
        if let Some(text) = self.with_function(formula) {
            return (text, Block);
        }
        match formula {
            Formula::Number(text) => postfix((*text).into()),
            Formula::Pi => postfix("PI".into()),
            Formula::Time => postfix("t".into()),
            Formula::Name(name) | Formula::VectorName(name) => postfix(format!("a{name}")),
            Formula::Vector(block, index) => postfix(self.whole(*block, index.as_ref())),
            Formula::VectorVelocity(block, index) => {
                postfix(format!("{}({})", self.word(*block), self.whole(*block, index.as_ref())))
            }
            Formula::Column(block, index, number) => {
                postfix(format!("{}.column({number})", self.whole(*block, index.as_ref())))
            }
            Formula::List(components) => {
                let components: Vec<String> =
                    components.iter().map(|component| self.text(component)).collect();
                postfix(format!("[{}]", components.join(", ")))
            }
            Formula::Cross(a, b) => method(a, "cross", self.text(b)),
            Formula::Dot(a, b) if self.spelling.is_other() => {
                let (a, b, width) = (self.text(a), self.text(b), self.system.width);
                let sum = format!("sum(0..{width}, |axis| left[axis] * right[axis])");
                (format!("{{ let left = {a}; let right = {b}; {sum} }}"), Block)
            }
            Formula::Dot(a, b) => method(a, "dot", self.text(b)),
            Formula::Norm(of) => method(of, "norm", String::new()),
            Formula::NormSquared(of) if self.spelling.is_other() => {
                let (of, width) = (self.text(of), self.system.width);
                (format!("{{ let all = {of}; sum(0..{width}, |axis| all[axis].powi(2)) }}"), Block)
            }
            Formula::NormSquared(of) => method(of, "norm_squared", String::new()),
            Formula::Component(of, number) => postfix(format!("{}[{number}]", self.bound(of, Postfix))),
            Formula::Coordinate(block, index) => postfix(self.place(*block, index.as_ref())),
            Formula::Velocity(block, index) => postfix(self.rate(*block, index.as_ref())),
            Formula::Parameter(field, indices) | Formula::VectorParameter(field, indices) => {
                let indices: String =
                    indices.iter().map(|index| format!("[{}]", self.index(index))).collect();
                let of_self = if self.spelling.is_other() { "self." } else { "" };
                postfix(format!("{of_self}{}{indices}", self.system.fields[*field].name))
            }
            Formula::Count(index) => postfix(format!("(({}) as f64)", self.index(index))),
            Formula::Negative(of) => (format!("-{}", self.bound(of, Sign)), Sign),
            Formula::Add(a, b) => (format!("{} + {}", self.bound(a, Sum), self.bound(b, Product)), Sum),
            Formula::Subtract(a, b) => (format!("{} - {}", self.bound(a, Sum), self.bound(b, Product)), Sum),
            Formula::Multiply(a, b) => {
                (format!("{} * {}", self.bound(a, Product), self.bound(b, Sign)), Product)
            }
            Formula::Divide(a, b) => {
                (format!("{} / {}", self.bound(a, Product), self.bound(b, Sign)), Product)
            }
            Formula::Power(of, exponent) => method(of, "powi", exponent.to_string()),
            Formula::Unary(function, of) if self.spelling.is_other() => {
                postfix(format!("f64::{}({})", function.name, self.text(of)))
            }
            Formula::Unary(function, of) => method(of, function.name, String::new()),
            Formula::Binary(function, a, b) => method(a, &function.name(), self.text(b)),
            Formula::MultiplyAdd(a, b, c) => {
                method(a, "mul_add", format!("{}, {}", self.text(b), self.text(c)))
            }
            Formula::Own(function, of) => postfix(format!("{}({})", OWN[*function].0, self.text(of))),
            Formula::ScalarField(field, at) => {
                let at: Vec<String> = at.iter().map(|argument| self.text(argument)).collect();
                postfix(format!("{}({})", SCALAR_FIELDS[*field].name, at.join(", ")))
            }
            Formula::If(condition, then, otherwise) => {
                let (then, otherwise) = (self.text(then), self.text(otherwise));
                (format!("if {} {{ {then} }} else {{ {otherwise} }}", self.condition(condition)), Block)
            }
            Formula::Let(name, value, body) => {
                let (value, body) = (self.text(value), self.text(body));
                let bound = match self.spelling.is_other() {
                    true => format!("let (a{name}, _b) = ({value}, 0.5);"),
                    false => format!("let a{name} = {value};"),
                };
                (format!("{{ {bound} {body} }}"), Block)
            }
            Formula::Sum(loops, level, lower, upper, body) => {
                let name = match loops {
                    Loops::Single => "sum",
                    Loops::Product => "product",
                    Loops::Pairs => "sum_pairs",
                    Loops::OrderedPairs => "sum_ordered_pairs",
                };
                let indices = INDICES[*level..level + loops.indices()].join(", ");
                let (range, body) = (self.range(lower, upper), self.text(body));
                let are_read = indices.split(", ").all(|index| is_in_brackets(&body, index));
                if are_read && self.spelling.is_other() {
                    let sum = format!("{name}({range}, |{indices}| term({indices}))");
                    return (format!("{{ let term = |{indices}| {body}; {sum} }}"), Block);
                }
                postfix(format!("{name}({range}, |{indices}| {body})"))
            }
        }
    }

    /// Sometimes, a formula by a function of its own.
    fn with_function(&self, formula: &Formula) -> Option<String> {
        match formula {
            Formula::Add(a, b) if self.spelling.is_rare() => Some(format!(
                "{{ let plus = |left, right| left + right; plus({}, {}) }}",
                self.text(a),
                self.text(b)
            )),
            Formula::Multiply(a, b) if self.spelling.is_rare() => {
                let [a, b] = [a, b].map(|factor| self.text(factor));
                Some(format!(
                    "{{ let times = |left| {{ let by = |right| left * right; by({b}) }}; times({a}) }}"
                ))
            }
            Formula::Vector(block, Some(index)) if self.spelling.is_rare() => {
                let (name, index) = (self.system.blocks[*block].name, self.index(index));
                Some(format!("{{ let entry = |place| {name}[place]; entry({index}) }}"))
            }
            Formula::Coordinate(block, Some(index))
                if self.system.axes(*block) == 1
                    && !self.system.is_rotation(*block)
                    && self.spelling.is_rare() =>
            {
                let (name, index) = (self.system.blocks[*block].name, self.index(index));
                let place = self.system.bracketed(*block, "place", "0");
                Some(format!("{{ let entry = |place| {name}{place}; entry({index}) }}"))
            }
            _ => None,
        }
    }

    fn range(&self, lower: &Index, upper: &Index) -> String {
        let lower = self.index(lower);
        if self.spelling.is_other() {
            let last = Index { constant: upper.constant - 1, ..upper.clone() };
            format!("{lower}..={}", self.index(&last))
        } else {
            format!("{lower}..{}", self.index(upper))
        }
    }

    fn condition(&self, condition: &Condition) -> String {
        match condition {
            Condition::Compare(left, relation, right) => {
                let relation = match relation {
                    Relation::Less => "<",
                    Relation::LessOrEqual => "<=",
                    Relation::Greater => ">",
                    Relation::GreaterOrEqual => ">=",
                };
                format!("{} {relation} {}", self.bound(left, Binding::Sum), self.bound(right, Binding::Sum))
            }
            Condition::And(a, b) => format!("({}) && ({})", self.condition(a), self.condition(b)),
            Condition::Or(a, b) => format!("({}) || ({})", self.condition(a), self.condition(b)),
            Condition::Not(of) => format!("!({})", self.condition(of)),
        }
    }

    fn index(&self, index: &Index) -> String {
        let mut text = String::new();
        for (atom, coefficient) in &index.terms {
            let atom = match atom {
                Atom::Bound(level) => INDICES[*level].to_string(),
                Atom::Size(size) => self.system.size_text(*size),
                Atom::Times(size, level) => {
                    format!("{} * {}", self.system.size_text(*size), INDICES[*level])
                }
                Atom::Remainder(value, modulus) => {
                    format!("(({}) % {})", self.index(value), self.index(modulus))
                }
            };
            let sign = if *coefficient < 0 { "-" } else { "+" };
            let times = match coefficient.abs() {
                1 => String::new(),
                factor => format!("{factor} * "),
            };
            let sign = if text.is_empty() && sign == "+" { String::new() } else { format!(" {sign} ") };
            text += &format!("{sign}{times}{atom}");
        }
        match index.constant {
            0 if !text.is_empty() => text,
            constant if text.is_empty() => constant.to_string(),
            constant if constant < 0 => format!("{text} - {}", -constant),
            constant => format!("{text} + {constant}"),
        }
    }
}
