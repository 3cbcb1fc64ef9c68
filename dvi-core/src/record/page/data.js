// The columns in the order of time, what is drawn of them, and how numbers are written.

/** So many points are drawn over time, and in a plane. */
const MOST_OVER_TIME = 4000, MOST_IN_PLANE = 60000;

/** The record of this page. Numbers that are none are NaN here. */
function readRecord() {
    const { columns, bodies } = JSON.parse(document.getElementById("record").textContent);
    for (const column of columns) column.values = Float64Array.from(column.values, value => value ?? NaN);
    const time = columns.find(column => column.quantity === "time");
    if (time) sort(columns, time.values);
    const named = new Map(columns.map(column => [column.name, column]));
    for (const body of bodies) body.position = body.position.map(name => named.get(name));
    return { columns, bodies, time, rows: columns.length ? columns[0].values.length : 0 };
}

/** A run may go back in time, and states may come in any order. */
function sort(columns, times) {
    if (times.every((time, row) => row ? time >= times[row - 1] : isFinite(time))) return;
    const order = [...times.keys()].filter(row => isFinite(times[row])).sort((a, b) => times[a] - times[b]);
    for (const column of columns) column.values = Float64Array.from(order, row => column.values[row]);
}

const label = ({ name, unit }) => unit ? `${name} (${unit})` : name;
const counted = count => count.toLocaleString("en");

/** The last of ascending numbers that is not above `bound`. */
function lastUpTo(numbers, bound) {
    let [low, high] = [0, numbers.length];
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (numbers[middle] <= bound) low = middle; else high = middle;
    }
    return low;
}

/** The smallest and the largest number of arrays, over all rows; [0, 1] if there is none. */
function extent(...arrays) {
    let [low, high] = [Infinity, -Infinity];
    for (const array of arrays) {
        for (const value of array) {
            if (value < low) low = value;
            if (value > high) high = value;
        }
    }
    return low <= high ? [low, high] : [0, 1];
}

/** Rows from `from` to `to`: all, or the lowest, highest and a gap of each array in each of many parts. */
function thinned(arrays, from, to) {
    const count = to - from;
    if (count <= MOST_OVER_TIME) return Array.from({ length: count }, (_, k) => from + k);
    const parts = Math.max(1, Math.floor(MOST_OVER_TIME / (2 * arrays.length + 1)));
    const rows = [];
    for (let part = 0; part < parts; part++) {
        const [begin, end] = [part, part + 1].map(k => from + Math.floor(count * k / parts));
        const kept = new Set([begin]);
        for (const array of arrays) {
            let low, high, gap;
            for (let row = begin; row < end; row++) {
                const value = array[row];
                if (value !== value) gap ??= row;
                else {
                    if (low === undefined || value < array[low]) low = row;
                    if (high === undefined || value > array[high]) high = row;
                }
            }
            for (const row of [low, high, gap]) if (row !== undefined) kept.add(row);
        }
        if (part === parts - 1) kept.add(to - 1);
        rows.push(...[...kept].sort((a, b) => a - b));
    }
    return rows;
}

const raised = exponent =>
    [...String(exponent)].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]).join("");
const signed = text => text.replace("-", "−");

/** A number with six digits. */
function written(value) {
    if (!isFinite(value)) return "–";
    const [digits, exponent] = value.toExponential(5).split("e");
    const isShort = value === 0 || exponent >= -4 && exponent < 6;
    if (isShort) return signed(String(Number(value.toPrecision(6))));
    return signed(`${Number(digits)}·10${raised(Number(exponent))}`);
}

/** The numbers at the ticks of an axis, with the digits in which they differ. */
function ticks(values, step) {
    const largest = Math.max(...values.map(Math.abs));
    const power = Math.floor(Math.log10(largest || 1));
    const exponent = power < -3 || power >= 6 ? power : 0;
    const isWhole = digits => Math.abs(step / 10 ** (exponent - digits) % 1 - 0.5) > 0.499999;
    const digits = [...Array(13).keys()].find(isWhole) ?? 13;
    return values.map(value => {
        const text = (value / 10 ** exponent).toFixed(digits);
        if (Number(text) === 0) return "0";
        return signed(exponent ? `${text}·10${raised(exponent)}` : text);
    });
}

/** A step of 1, 2 or 5 times a power of ten, of which some `count` go into a length. */
function niceStep(length, count) {
    const power = 10 ** Math.floor(Math.log10(length / count));
    return power * [1, 2, 5, 10].find(factor => factor * power * count >= length * (1 - 1e-9));
}

const colours = 8;
const themed = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const colour = index => themed(`--c${index % colours}`);
const FONT = "12px system-ui, sans-serif";
