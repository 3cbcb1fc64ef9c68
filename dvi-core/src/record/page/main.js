// What is chosen on the page, and the present row, which all plots mark.

const PLAY = '<svg width="14" height="14"><path d="M3 1v12l10-6z"/></svg>';
const PAUSE = '<svg width="14" height="14"><path d="M2 1h4v12H2zM8 1h4v12H8z"/></svg>';
/** Seconds in which the whole record is played. */
const PLAYED_IN = 20;
const GROUPS = [["coordinate"], ["velocity"], ["energy", "momentum"], ["parameter"], ["other"]];

const record = readRecord();
const element = id => document.getElementById(id);
const made = (tag, properties) => Object.assign(document.createElement(tag), properties);
const sections = { overTime: element("over-time"), motion: element("motion"), plane: element("plane") };
const views = [];
const shown = record.columns.filter(({ quantity }) => quantity !== "time");
shown.forEach((column, index) => { column.index = index; });
/** It begins with the last, where all of the motion is behind. */
let row = Math.max(0, record.rows - 1);

function goTo(next) {
    row = Math.max(0, Math.min(record.rows - 1, next));
    element("slider").value = row;
    const { name, unit, values } = record.time;
    element("clock").textContent = `${name} = ${written(values[row])} ${unit}`;
    for (const view of views) view.move(row);
    readOut(row);
}

/** The buttons of the columns: colour, name, and the value of a row. */
const chosen = new Map();
function readOut(row) {
    for (const [column, output] of chosen) output.textContent = written(column.values[row]);
}

function chooseColumns(view) {
    const choice = sections.overTime.querySelector(".choice");
    const draw = () => {
        const columns = [...chosen.keys()].sort((a, b) => a.index - b.index);
        view.draw(columns, element("change").checked);
    };
    const toggle = (column, button) => {
        if (chosen.delete(column)) button.lastChild.remove();
        else chosen.set(column, button.appendChild(document.createElement("output")));
        button.setAttribute("aria-pressed", chosen.has(column));
        button.style.setProperty("--mark", chosen.has(column) ? `var(--c${column.index % colours})` : "");
    };
    const buttons = new Map();
    for (const group of GROUPS) {
        const columns = shown.filter(({ quantity }) => group.includes(quantity));
        if (columns.length && buttons.size) choice.append(document.createElement("hr"));
        for (const column of columns) {
            const button = made("button", { type: "button" });
            button.append(column.name);
            button.setAttribute("aria-pressed", false);
            button.addEventListener("click", () => { toggle(column, button); draw(); readOut(row); });
            choice.append(button);
            buttons.set(column, button);
        }
    }
    const coordinates = shown.filter(({ quantity }) => quantity === "coordinate");
    const first = (coordinates.length ? coordinates : shown).slice(0, 4);
    for (const column of first) toggle(column, buttons.get(column));
    element("change").addEventListener("change", draw);
    view.onHover = readOut;
    return draw;
}

function chooseAxes(view) {
    const [across, up] = [element("across"), element("up")];
    for (const select of [across, up]) {
        select.append(...record.columns.map(column => new Option(label(column), column.name)));
    }
    const body = record.bodies[0]?.position.map(({ name }) => name);
    const [first, second] = shown;
    const velocity = shown.find(({ name }) => name === `dot_${first?.name}`);
    const parameter = shown.find(({ quantity }) => quantity === "parameter");
    across.value = parameter?.name ?? (body && !velocity ? body[0] : (first ?? record.time).name);
    up.value = (parameter ? shown.find(({ quantity }) => quantity === "coordinate") : velocity)?.name
        ?? (body ? body[1] : (second ?? first ?? record.time).name);
    const named = name => record.columns.find(column => column.name === name);
    const draw = () => view.draw(named(across.value), named(up.value));
    for (const select of [across, up]) select.addEventListener("change", draw);
    return draw;
}

function playRecord() {
    const { values } = record.time, button = element("play");
    let before = null, time = 0;
    const frame = () => {
        if (before === null) return;
        const now = performance.now();
        time += (now - before) / 1000 / PLAYED_IN * (values[record.rows - 1] - values[0]);
        before = now;
        goTo(lastUpTo(values, time));
        if (row === record.rows - 1) stop(); else requestAnimationFrame(frame);
    };
    const show = (picture, text) => { button.innerHTML = picture; button.setAttribute("aria-label", text); };
    const stop = () => { before = null; show(PLAY, "Play"); };
    const play = () => {
        time = row === record.rows - 1 ? values[0] : values[row];
        before = performance.now();
        show(PAUSE, "Pause");
        requestAnimationFrame(frame);
    };
    button.addEventListener("click", () => before === null ? play() : stop());
    element("slider").addEventListener("input", event => { stop(); goTo(Number(event.target.value)); });
    stop();
}

function begin() {
    const rows = `${counted(record.rows)} ${record.rows === 1 ? "row" : "rows"}`;
    const draws = [];
    if (record.time && record.rows) {
        const { values, name, unit } = record.time;
        const [first, last] = [values[0], values[record.rows - 1]].map(written);
        element("extent").textContent = `${rows}, ${name} from ${first} to ${last} ${unit}`;
        element("player").hidden = sections.overTime.hidden = false;
        element("slider").max = record.rows - 1;
        const overTime = new OverTime(sections.overTime, record, goTo);
        views.push(overTime);
        draws.push(chooseColumns(overTime));
        if (record.bodies.length) {
            sections.motion.hidden = false;
            const motion = new Motion(sections.motion, record);
            views.push(motion);
            draws.push(() => motion.draw());
            element("trail").addEventListener("change", event => {
                motion.trail = Number(event.target.value);
                motion.draw();
            });
            if (record.bodies.length > 1 && record.bodies.length <= 12) {
                sections.motion.querySelector(".legend").append(...record.bodies.map(({ name }, index) => {
                    const entry = made("span", { textContent: name });
                    entry.style.setProperty("--mark", `var(--c${index % colours})`);
                    return entry;
                }));
            }
        }
        playRecord();
    } else element("extent").textContent = rows;
    if (record.rows && record.columns.length) {
        sections.plane.hidden = false;
        const plane = new Plane(sections.plane, record);
        views.push(plane);
        draws.push(chooseAxes(plane));
    }
    const drawAll = () => { for (const draw of draws) draw(); if (record.time && record.rows) goTo(row); };
    drawAll();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
    let width = innerWidth;
    addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawAll(); } });
}

begin();
