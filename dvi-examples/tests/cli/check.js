// Put at the head of the page of the gallery: uses it as a reader would, and writes down what it has found.
"use strict";
const found = [];
const check = (what, holds) => found.push(`${holds ? "ok" : "FAILED"} ${what}`);
addEventListener("error", event => check(`no error: ${event.message}`, false));
const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));
const isSeen = element => element.offsetHeight > 0;

async function checkAll() {
    const cards = [...document.querySelectorAll("article")];
    const seen = () => cards.filter(isSeen);
    check("each experiment is shown", cards.length >= 40 && seen().length === cards.length);
    await Promise.all([...document.images].map(image => image.decode()));
    check("and its figure", [...document.images].every(image => isSeen(image) && image.naturalWidth === 1200)
        && document.images.length === cards.length);
    for (const button of document.querySelectorAll("nav button:not([hidden])")) {
        button.click();
        const { source, verdict } = button.dataset;
        const claims = [...document.querySelectorAll("li")].filter(isSeen);
        check(`${source ?? verdict} shows some`, seen().length > 0 && seen().length < cards.length);
        check("and no other", source ? seen().every(card => card.dataset.source === source)
            : claims.length > 0 && claims.every(claim => claim.dataset.verdict === verdict));
        button.click();
    }
    check("then all are shown again", seen().length === cards.length);
    const frames = [...document.querySelectorAll("iframe")];
    for (const frame of frames) {
        const page = frame.contentDocument;
        const canvas = page.querySelector("#motion canvas"), slider = page.querySelector("#slider");
        const name = frame.closest("article").id;
        const move = row => {
            slider.value = row;
            slider.dispatchEvent(new frame.contentWindow.Event("input"));
            return canvas.toDataURL();
        };
        check(`the slider of ${name} moves`, move(10) !== move(slider.max / 2));
        const { top, bottom } = page.querySelector("#motion").getBoundingClientRect();
        check("and its frame is as high as the motion", top >= 0 && bottom <= frame.clientHeight && bottom > 200);
    }
    check(`${frames.length} motions`, true);
    check("nothing is wider than the window", document.documentElement.scrollWidth <= innerWidth);
    const loaded = performance.getEntriesByType("resource").filter(({ name }) => !name.startsWith("data:"));
    check(`nothing was loaded: ${loaded.map(({ name }) => name)}`, loaded.length === 0);
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
