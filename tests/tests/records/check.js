// Put at the head of a page of a record: uses it as a reader would, and writes down what it has found.
"use strict";
const found = [];
const check = (what, holds) => found.push(`${holds ? "ok" : "FAILED"} ${what}`);
addEventListener("error", event => check(`no error: ${event.message}`, false));
console.error = console.warn = (...words) => check(`no complaint: ${words.join(" ")}`, false);
// A browser without a window draws no frames while time is simulated.
window.requestAnimationFrame = act => setTimeout(() => act(performance.now()), 16);

const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));
const canvas = id => document.querySelector(`#${id} canvas`);
const picture = id => canvas(id).toDataURL();
/** How many pixels something is drawn on. */
const drawn = id => {
    const { width, height } = canvas(id);
    const { data } = canvas(id).getContext("2d").getImageData(0, 0, width, height);
    let count = 0;
    for (let k = 3; k < data.length; k += 4) count += data[k] > 0;
    return count;
};
const choose = (id, value, kind) => {
    const element = document.getElementById(id);
    element.value = value;
    element.dispatchEvent(new Event(kind));
};
const changes = async (what, id, act) => {
    const before = picture(id);
    await act();
    await pause(100);
    check(what, picture(id) !== before);
};
const text = selector => document.querySelector(selector).textContent;
const mouse = (kind, target, x, y) => {
    const { left, top } = target.getBoundingClientRect();
    const place = { clientX: left + x, clientY: top + y, movementX: 1, button: 0, buttons: 1, bubbles: true };
    target.dispatchEvent(new MouseEvent(kind, place));
};

async function checkTime() {
    await changes("another column can be chosen", "over-time", () => {
        document.querySelector(".choice button[aria-pressed=false]").click();
    });
    await changes("and left out", "over-time", () => document.querySelector(".choice button").click());
    await changes("the change since the start is another", "over-time", () => {
        document.getElementById("change").click();
    });
    const over = document.querySelector("#over-time .u-over");
    await changes("dragging zooms in", "over-time", () => {
        mouse("mousemove", over, 20, 50);
        mouse("mousedown", over, 20, 50);
        mouse("mousemove", over, 100, 50);
        mouse("mouseup", over, 100, 50);
    });
    check("and says how to go back", text("#over-time .note").includes("double click"));
    await changes("a double click shows all", "over-time", () => {
        mouse("dblclick", document.querySelector("#over-time .u-over"), 50, 50);
    });
    const clock = text("#clock");
    choose("slider", 7, "input");
    check("the slider changes the time", text("#clock") !== clock);
    const place = document.querySelector("#over-time .now").style.left;
    choose("slider", 3, "input");
    check("and moves the mark over time", document.querySelector("#over-time .now").style.left !== place);
    document.getElementById("play").click();
    await pause(1000);
    document.getElementById("play").click();
    const row = document.getElementById("slider").value;
    check("the record is played", Number(row) > 3);
    await pause(300);
    check("and stops", document.getElementById("slider").value === row);
}

async function checkMotion() {
    check("the bodies are drawn", drawn("motion") > 300);
    await changes("the slider moves the bodies", "motion", () => choose("slider", 5, "input"));
    const last = document.getElementById("slider").max;
    choose("slider", last, "input");
    await changes("trails can be longer", "motion", () => choose("trail", "1", "change"));
    if (document.querySelector("#motion.space")) {
        await changes("dragging turns the space", "motion", () => {
            const drag = { buttons: 1, movementX: 30, movementY: 5 };
            canvas("motion").dispatchEvent(new PointerEvent("pointermove", drag));
        });
        await changes("keys turn the space", "motion", () => {
            const key = new KeyboardEvent("keydown", { key: "ArrowUp", cancelable: true });
            canvas("motion").dispatchEvent(key);
        });
    }
}

async function checkAll() {
    const isShown = id => !document.getElementById(id).hidden;
    const shown = ["over-time", "motion", "plane"].filter(isShown);
    check(`shown are ${shown.join(", ")}`, true);
    for (const id of shown) check(`${id} is drawn`, drawn(id) > 300);
    if (isShown("over-time")) await checkTime();
    if (isShown("motion")) await checkMotion();
    if (isShown("plane")) {
        const names = [...document.getElementById("across").options].map(option => option.value);
        const other = name => names.find(one => one !== name);
        await changes("another column can go across", "plane", () => {
            choose("across", other(document.getElementById("across").value), "change");
        });
        await changes("another column can go up", "plane", () => {
            choose("up", other(document.getElementById("up").value), "change");
        });
    }
    check("nothing is wider than the window", document.documentElement.scrollWidth <= innerWidth);
    check("nothing was loaded", performance.getEntriesByType("resource").length === 0);
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const [red] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
    check("the background is that of the theme", dark ? red < 60 : red > 200);
    check(`the window is ${innerWidth} wide, and ${dark ? "dark" : "light"}`, true);
}

addEventListener("load", async () => {
    await pause(300);
    await checkAll().catch(error => check(`no error: ${error.stack}`, false));
    parent.postMessage(found.join("\n"), "*");
});
