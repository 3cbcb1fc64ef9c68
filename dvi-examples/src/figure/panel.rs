//! One pair of axes with what is drawn on it.

use super::axis::{Axis, Scale};
use super::mark::{Frame, Mark};
use super::palette::{Colour, GRID, PAPER, SLATE};
use super::svg::{Anchor, Stroke, Svg, dashed, number, solid};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Corner {
    TopLeft,
    #[default]
    TopRight,
    BottomRight,
    /// To the right of the panel, from the top, for legends that would cover data.
    Beside,
}

pub type Points = Vec<[f64; 2]>;

/// The name of a line, how it is drawn, and its points.
pub type Line<N> = (N, Stroke, Points);

/// The label of an axis, and its range.
pub type Ranged<'a> = (&'a str, [f64; 2]);

/// One pair of axes with what is drawn on it, in the order in which it was added.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    title: String,
    x: Axis,
    y: Axis,
    /// Each with its line in the legend, if it has one.
    marks: Vec<(Mark, Option<String>)>,
    corner: Corner,
    /// The place in data coordinates, the text, and how it hangs there.
    notes: Vec<([f64; 2], String, Anchor, Colour)>,
    captions: Vec<(Corner, String)>,
    pub(super) weight: f64,
    equal: bool,
}

const LEFT: f64 = 70.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 56.0;
/// How far the middle of a line of text is above its foot.
const RISE: f64 = 4.5;
/// The width of a letter of a name on the y axis, generously.
const NAME: f64 = 8.0;
/// The width of a letter of a legend, on average.
const LETTER: f64 = 7.4;
/// The least width of a legend beside its panel.
const BESIDE: f64 = 150.0;

impl Panel {
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, weight: 1.0, ..Self::default() }
    }

    pub fn linear(title: impl Into<String>, x: Ranged<'_>, y: Ranged<'_>) -> Self {
        Self::new(title, Axis::linear(x.0).within(x.1), Axis::linear(y.0).within(y.1))
    }

    pub fn semilog(title: impl Into<String>, x: Ranged<'_>, y: Ranged<'_>) -> Self {
        Self::new(title, Axis::linear(x.0).within(x.1), Axis::logarithmic(y.0).within(y.1))
    }

    pub fn loglog(title: impl Into<String>, x: Ranged<'_>, y: Ranged<'_>) -> Self {
        Self::new(title, Axis::logarithmic(x.0).within(x.1), Axis::logarithmic(y.0).within(y.1))
    }

    /// A plane with the coordinates `x` and `y`.
    pub fn plane(title: impl Into<String>, x: &str, y: &str) -> Self {
        Self::new(title, Axis::linear(x), Axis::linear(y)).equal()
    }

    /// A part of a plane.
    pub fn window(title: impl Into<String>, x: Ranged<'_>, y: Ranged<'_>) -> Self {
        Self::linear(title, x, y).equal()
    }

    /// A line through the points; of long series, what the pixels can show.
    pub fn line(self, points: Points, stroke: Stroke) -> Self {
        self.with(Mark::Line(points, stroke))
    }

    pub fn lines<N: Into<String>>(self, lines: impl IntoIterator<Item = Line<N>>) -> Self {
        self.each(lines, |panel, (name, stroke, points)| panel.line(points, stroke).labelled(name))
    }

    /// What `add` adds for each of some things.
    pub fn each<I: IntoIterator>(self, things: I, add: impl FnMut(Self, I::Item) -> Self) -> Self {
        things.into_iter().fold(self, add)
    }

    /// Lines through few points, which are marked, with their names in the legend.
    pub fn marked<N: Into<String>>(self, lines: impl IntoIterator<Item = Line<N>>) -> Self {
        self.each(lines, |panel, (name, stroke, points)| {
            panel.line(points.clone(), stroke).labelled(name).dots(points, 2.6, stroke.colour())
        })
    }

    /// The range of a quantity in each interval of time, and its mean, with their names in the legend:
    /// by [x, lowest, mean, highest].
    pub fn ranges<const N: usize>(self, all: [(&str, Colour, Vec<[f64; 4]>); N]) -> Self {
        self.each(all, |panel, (name, colour, rows)| {
            let mean = rows.iter().map(|row| [row[0], row[2]]).collect();
            let band = rows.iter().map(|row| [row[0], row[1], row[3]]).collect();
            panel.band(band, colour).line(mean, solid(colour)).labelled(name)
        })
    }

    /// A straight line that others are to be seen beside, with its name in the legend.
    pub fn guide(self, ends: [[f64; 2]; 2], name: impl Into<String>) -> Self {
        self.line(ends.into(), dashed(SLATE).width(1.2)).labelled(name)
    }

    /// A line below everything that was added before.
    pub fn below(mut self, points: Points, stroke: Stroke) -> Self {
        self.marks.insert(0, (Mark::Line(points, stroke), None));
        self
    }

    /// The area between two curves, as [x, low, high].
    pub fn band(self, edges: Vec<[f64; 3]>, colour: Colour) -> Self {
        self.with(Mark::Band(edges, colour))
    }

    pub fn dots(self, points: Points, radius: f64, colour: Colour) -> Self {
        self.with(Mark::Dots(points, vec![solid(colour).width(2.0 * radius).opacity(0.8)]))
    }

    /// Large dots with a white rim, for few points.
    pub fn discs(self, points: Points, colour: Colour) -> Self {
        self.with(Mark::Dots(points, vec![solid(PAPER).width(12.0), solid(colour).width(9.0)]))
    }

    /// The same, hollow.
    pub fn rings(self, points: Points, colour: Colour) -> Self {
        let strokes = [solid(PAPER).width(12.0), solid(colour).width(9.0), solid(PAPER).width(5.0)];
        self.with(Mark::Dots(points, strokes.into()))
    }

    /// Gives what was added last a line in the legend.
    pub fn labelled(mut self, text: impl Into<String>) -> Self {
        if let Some((_, name)) = self.marks.last_mut() {
            *name = Some(text.into());
        }
        self
    }

    /// Writes on the panel, at a point in data coordinates.
    pub fn note(mut self, at: [f64; 2], anchor: Anchor, colour: Colour, text: impl Into<String>) -> Self {
        self.notes.push((at, text.into(), anchor, colour));
        self
    }

    pub fn caption(mut self, corner: Corner, text: impl Into<String>) -> Self {
        self.captions.push((corner, text.into()));
        self
    }

    pub fn legend_at(self, corner: Corner) -> Self {
        Self { corner, ..self }
    }

    /// Leaves the legend to a neighbour that shows the same.
    pub fn without_legend(mut self) -> Self {
        self.marks.iter_mut().for_each(|(_, name)| *name = None);
        self
    }

    /// The width of the panel relative to the others of its row.
    pub fn weight(self, weight: f64) -> Self {
        Self { weight, ..self }
    }

    /// One unit is as long on the x axis as on the y axis.
    pub fn equal(self) -> Self {
        Self { equal: true, ..self }
    }

    fn with(mut self, mark: Mark) -> Self {
        self.marks.push((mark, None));
        self
    }

    fn frame(&self, [left, top, width, height]: [f64; 4]) -> Frame {
        let points: Points = self.marks.iter().flat_map(|(mark, _)| mark.corners()).collect();
        let span = |axis: &Axis, i: usize| {
            let values = points.iter().map(|point| [point[i]; 2]).filter(|value| axis.shows(value[0]));
            values.reduce(|[low, high], [v, _]| [low.min(v), high.max(v)])
        };
        let (mut x, mut y) = (self.x.fit(span(&self.x, 0)), self.y.fit(span(&self.y, 1)));
        if self.equal {
            let unit = ((x[1] - x[0]) / width).max((y[1] - y[0]) / height);
            x = centred(x, unit * width);
            y = centred(y, unit * height);
        }
        Frame {
            x: Scale { range: x, pixels: [left, left + width], logarithmic: self.x.logarithmic },
            y: Scale { range: y, pixels: [top + height, top], logarithmic: self.y.logarithmic },
        }
    }

    pub(super) fn draw(&self, svg: &mut Svg, [left, top, width, height]: [f64; 4]) {
        let beside = if self.corner == Corner::Beside { self.legend_width() } else { RIGHT };
        let before = LEFT.max(self.y.longest_name() as f64 * NAME + 12.0);
        let inner = [left + before, top + TOP, width - before - beside, height - TOP - BOTTOM];
        let frame = self.frame(inner);
        self.draw_axes(svg, &frame);
        svg.open(inner);
        for (mark, _) in &self.marks {
            mark.draw(svg, &frame);
        }
        svg.close();
        self.draw_legend(svg, inner);
        for (corner, text) in &self.captions {
            let ([x, y], anchor) = hold(*corner, inner, 10.0, 0.0);
            svg.text(anchor.rimmed(), [x, y + RISE], text);
        }
        for &(at, ref text, anchor, Colour(colour)) in &self.notes {
            let at = [frame.x.place(at[0]), frame.y.place(at[1])];
            svg.text_with(anchor.rimmed(), at, text, &format!(" style=\"fill:{colour}\""));
        }
    }

    fn legend(&self) -> impl Iterator<Item = (&Mark, &String)> {
        self.marks.iter().filter_map(|(mark, name)| Some((mark, name.as_ref()?)))
    }

    /// What the longest text of the legend needs, with its sample.
    fn legend_width(&self) -> f64 {
        let letters = |text: &str| text.chars().filter(|&letter| letter != '*').count() as f64;
        let longest = self.legend().map(|(_, text)| letters(text)).fold(0.0, f64::max);
        BESIDE.max(44.0 + LETTER * longest + 6.0)
    }

    fn draw_axes(&self, svg: &mut Svg, frame: &Frame) {
        let [left, top, width, height] = frame.rectangle();
        let (bottom, right) = (top + height, left + width);
        let [l, t, b, r] = [left, top, bottom, right].map(number);
        let (x, y) = (self.x.ticks(&frame.x, width / 95.0), self.y.ticks(&frame.y, height / 65.0));
        // Lines from side to side where there is a label, and short ones where there is none.
        let (mut grid, mut short) = (String::new(), String::new());
        for (value, text) in y.marks {
            let y = frame.y.place(value);
            svg.text("end", [left - 8.0, y + RISE], &text);
            let y = number(y);
            if text.is_empty() { short += &format!("M{l} {y}h4") } else { grid += &format!("M{l} {y}H{r}") }
        }
        for (value, text) in x.marks {
            let x = frame.x.place(value);
            svg.text("middle", [x, bottom + 20.0], &text);
            let x = number(x);
            if text.is_empty() { short += &format!("M{x} {b}v-4") } else { grid += &format!("M{x} {t}V{b}") }
        }
        svg.stroke(&grid, solid(GRID).width(1.0));
        svg.stroke(&(short + &format!("M{l} {t}V{b}H{r}")), solid(SLATE).width(1.0));
        svg.text("end grey", [right, bottom + 38.0], &x.factor);
        svg.text("middle grey", [left - 8.0, top - 10.0], &y.factor);
        svg.text("middle strong", [left + width / 2.0, top - 12.0], &self.title);
        svg.text("middle", [left + width / 2.0, bottom + 44.0], &self.x.label);
        let aside = [left - LEFT + 16.0, top + height / 2.0];
        let [x, y] = aside.map(number);
        svg.text_with("middle", aside, &self.y.label, &format!(" transform=\"rotate(-90 {x} {y})\""));
    }

    fn draw_legend(&self, svg: &mut Svg, inner: [f64; 4]) {
        const LINE: f64 = 21.0;
        const SAMPLE: f64 = 44.0;
        let below = LINE * self.legend().count().saturating_sub(1) as f64;
        let ([x, first], anchor) = hold(self.corner, inner, SAMPLE, below);
        let sample = if anchor == Anchor::Start { x - 20.0 } else { x + 20.0 };
        for (i, (mark, text)) in self.legend().enumerate() {
            let y = first + LINE * i as f64;
            svg.text(anchor.rimmed(), [x, y + RISE], text);
            mark.draw_sample(svg, [sample, y]);
        }
    }
}

/// Where text of `below` more height begins in a corner, `indent` away from the side.
fn hold(
    corner: Corner,
    [left, top, width, height]: [f64; 4],
    indent: f64,
    below: f64,
) -> ([f64; 2], Anchor) {
    let (first, last) = (top + 16.0, top + height - 14.0 - below);
    match corner {
        Corner::TopLeft => ([left + indent, first], Anchor::Start),
        Corner::TopRight => ([left + width - indent, first], Anchor::End),
        Corner::BottomRight => ([left + width - indent, last], Anchor::End),
        Corner::Beside => ([left + width + indent, first], Anchor::Start),
    }
}

fn centred([low, high]: [f64; 2], width: f64) -> [f64; 2] {
    let middle = 0.5 * (low + high);
    [middle - 0.5 * width, middle + 0.5 * width]
}
