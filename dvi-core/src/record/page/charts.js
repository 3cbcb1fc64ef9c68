// The two plots: columns over time, and one column against another. Drawn by uPlot.

/** The width of the longest number at an axis. */
function fitted(plot, values, index, cycle) {
    const axis = plot.axes[index];
    if (cycle > 1) return axis._size;
    plot.ctx.font = axis.font[0];
    const widths = (values ?? []).map(text => plot.ctx.measureText(text).width / devicePixelRatio);
    return Math.ceil(axis.gap + 6 + Math.max(0, ...widths));
}

/** Across there is a height, up the width of the numbers. */
const axisOf = (text, size) => ({
    label: text, size, font: FONT, labelFont: FONT, labelSize: 20, gap: 4,
    space: size === fitted ? 38 : 72,
    stroke: themed("--muted"), grid: { stroke: themed("--grid"), width: 1 }, ticks: { show: false },
    values: (_, splits, __, ___, step) => ticks(splits, step),
});

/** A scale around data, a little wider than they are. */
const around = (_, low, high) => {
    if (low == null) return [0, 1];
    const room = (high - low || Math.abs(high) || 1) * (high > low ? 0.04 : 0.5);
    return [low - room, high + room];
};
const nulls = (array, rows) => rows.map(row => isFinite(array[row]) ? array[row] : null);

/** A mark above a plot, for the present row. */
function mark(plot, kind) {
    const element = document.createElement("div");
    element.className = `now ${kind}`;
    plot.over.append(element);
    return element;
}

/** Marks the present row again where a plot has been drawn. */
const marking = view => ({ ready: [() => view.move(view.row)], draw: [() => view.move(view.row)] });

/** Columns over time. Dragging across zooms in, a double click shows all, a click goes to a time. */
class OverTime {
    constructor(section, record, goTo) {
        Object.assign(this, { section, record, goTo, from: 0, to: record.rows, row: 0, zoomed: false });
        this.place = section.querySelector(".plot");
    }

    draw(chosen, isChange) {
        this.plot?.destroy();
        Object.assign(this, { chosen, isChange });
        const { time } = this.record;
        const first = ({ values }) => isChange ? values.find(value => value === value) ?? 0 : 0;
        const arrays = chosen.map(column => {
            const start = first(column);
            return isChange ? column.values.map(value => value - start) : column.values;
        });
        const rows = thinned(arrays, this.from, this.to);
        const units = new Set(chosen.map(({ unit }) => unit));
        const names = chosen.length <= 3 ? chosen.map(({ name }) => name).join(", ") : "";
        const text = units.size === 1 && [...units][0] ? `${names} (${[...units][0]})` : names;
        const across = axisOf(label(time), 26);
        const up = axisOf((isChange && names ? "change of " : "") + text, fitted);
        const width = this.place.clientWidth;
        this.plot = new uPlot({
            width, height: width < 500 ? 260 : 320, legend: { show: false },
            padding: [8, 22, 0, 0],
            cursor: { y: false, points: { size: 7 }, drag: { setScale: false, x: true, y: false } },
            scales: { x: { time: false, range: (_, low, high) => [low, high > low ? high : low + 1] },
                      y: { range: around } },
            axes: [across, up],
            series: [{}, ...chosen.map(({ index }) => ({
                stroke: colour(index), width: 1.6, pxAlign: 0, spanGaps: false,
                points: { show: rows.length < 40 },
            }))],
            hooks: {
                setSelect: [plot => this.zoom(plot)],
                ...marking(this),
                setCursor: [({ cursor: { left } }) => this.onHover?.(left >= 0 ? this.at(left) : this.row)],
            },
        }, [nulls(time.values, rows), ...arrays.map(array => nulls(array, rows))], this.place);
        this.now = mark(this.plot, "line");
        this.plot.over.addEventListener("dblclick", () => this.show(0, this.record.rows));
        this.plot.over.addEventListener("click", () => {
            if (!this.zoomed && this.plot.cursor.left >= 0) this.goTo(this.at(this.plot.cursor.left));
            this.zoomed = false;
        });
        const [drawn, all] = [rows.length, this.to - this.from];
        this.section.querySelector(".note").textContent = [
            drawn < all && `${counted(drawn)} of ${counted(all)} rows are drawn, the extremes among them.`,
            all < this.record.rows && "A double click shows all.",
        ].filter(Boolean).join(" ");
    }

    /** The row at a place of the plot. */
    at(left) {
        return lastUpTo(this.record.time.values, this.plot.posToVal(left, "x"));
    }

    zoom(plot) {
        if (plot.select.width < 5) return;
        const [left, right] = [plot.select.left, plot.select.left + plot.select.width];
        this.zoomed = true;
        const [from, to] = [this.at(left), Math.min(this.record.rows, this.at(right) + 2)];
        if (to - from > 2) this.show(from, to);
        else plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    }

    show(from, to) {
        Object.assign(this, { from, to });
        this.draw(this.chosen, this.isChange);
    }

    /** Marks a row. */
    move(row) {
        this.row = row;
        if (this.plot.status === 0) return;
        const left = this.plot.valToPos(this.record.time.values[row], "x");
        this.now.style.left = `${left}px`;
        this.now.hidden = !(left >= 0 && left <= this.plot.over.clientWidth);
    }
}

/** A path through points, or dots, in the pixels of a plot. */
function pathOf(isDots) {
    return (plot, index) => {
        const [xs, ys] = plot.data[index], path = new Path2D();
        let isDrawing = false;
        for (let k = 0; k < xs.length; k++) {
            if (xs[k] === null || ys[k] === null) {
                isDrawing = false;
                continue;
            }
            const [x, y] = [plot.valToPos(xs[k], "x", true), plot.valToPos(ys[k], "y", true)];
            if (isDots || !isDrawing) path.moveTo(x, y);
            path.lineTo(isDots ? x + 0.01 : x, y);
            isDrawing = true;
        }
        return { stroke: path, fill: null, clip: null, flags: 1 };
    };
}

/** One column against another: a line through all rows, or dots of some, or of what has no order. */
class Plane {
    constructor(section, record) {
        Object.assign(this, { section, record, row: 0 });
        this.place = section.querySelector(".plot");
    }

    draw(across, up) {
        this.plot?.destroy();
        Object.assign(this, { across, up });
        const { rows, time } = this.record;
        const every = Math.ceil(rows / MOST_IN_PLANE);
        const drawn = Array.from({ length: Math.ceil(rows / every) }, (_, k) => k * every);
        const isDots = every > 1 || !time;
        const width = this.place.clientWidth;
        this.plot = new uPlot({
            mode: 2, width, height: Math.min(width, 560), legend: { show: false },
            padding: [8, 22, 0, 0],
            cursor: { points: { show: false }, drag: { x: true, y: true, setScale: true, uni: 20 } },
            scales: { x: { time: false, range: around }, y: { range: around } },
            axes: [axisOf(label(across), 26), axisOf(label(up), fitted)],
            series: [null, {
                facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }],
                stroke: colour(up.index), width: isDots ? (rows > 2000 ? 3 : 5) : 1.3, cap: "round",
                paths: pathOf(isDots), points: { show: false },
            }],
            hooks: marking(this),
        }, [null, [nulls(across.values, drawn), nulls(up.values, drawn)]], this.place);
        this.now = time ? mark(this.plot, "dot") : null;
        this.plot.over.addEventListener("dblclick", () => this.draw(this.across, this.up));
        const note = every > 1 ? `${counted(drawn.length)} of ${counted(rows)} rows are drawn, as dots.` : "";
        this.section.querySelector(".note").textContent = note;
    }

    /** Marks a row. */
    move(row) {
        this.row = row;
        if (!this.now || this.plot.status === 0) return;
        const [x, y] = [this.across.values[row], this.up.values[row]];
        const [left, top] = [this.plot.valToPos(x, "x"), this.plot.valToPos(y, "y")];
        const background = colour(this.up.index);
        Object.assign(this.now.style, { left: `${left}px`, top: `${top}px`, background });
        const { clientWidth, clientHeight } = this.plot.over;
        this.now.hidden = !(left >= 0 && left <= clientWidth && top >= 0 && top <= clientHeight);
    }
}
