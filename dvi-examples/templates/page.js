// One source and one verdict can be chosen; motions are as high as what they show.
"use strict";

const cards = [...document.querySelectorAll("article")];
const buttons = [...document.querySelectorAll("nav button")];
const chosen = { source: null, verdict: null };

const isOfSource = card => !chosen.source || card.dataset.source === chosen.source;
const claimsOf = card => [...card.querySelectorAll("li")];
const isOfVerdict = claim => !chosen.verdict || claim.dataset.verdict === chosen.verdict;

function show() {
    for (const card of cards) {
        const claims = claimsOf(card);
        for (const claim of claims) claim.hidden = !isOfVerdict(claim);
        card.hidden = !isOfSource(card) || Boolean(chosen.verdict) && !claims.some(isOfVerdict);
    }
    for (const button of buttons) {
        const [[kind, value]] = Object.entries(button.dataset);
        button.setAttribute("aria-pressed", chosen[kind] === value);
    }
    const shown = cards.filter(card => !card.hidden);
    const claims = shown.flatMap(claimsOf).filter(claim => !claim.hidden);
    const counted = (list, what) => `${list.length} ${what}${list.length === 1 ? "" : "s"}`;
    const text = `${counted(shown, "experiment")}, ${counted(claims, "claim")}`;
    document.getElementById("shown").textContent = text;
}

for (const button of buttons) {
    const [[kind, value]] = Object.entries(button.dataset);
    const count = kind === "source"
        ? cards.filter(card => card.dataset.source === value).length
        : cards.flatMap(claimsOf).filter(claim => claim.dataset.verdict === value).length;
    button.querySelector("b").textContent = count;
    button.hidden = count === 0;
    button.addEventListener("click", () => {
        chosen[kind] = chosen[kind] === value ? null : value;
        show();
    });
}
show();

for (const frame of document.querySelectorAll("iframe")) {
    const begin = () => {
        const body = frame.contentDocument?.querySelector("#motion")?.closest("body");
        if (!body) return;
        const fit = () => { frame.style.height = `${body.offsetHeight + 4}px`; };
        new ResizeObserver(fit).observe(body);
        fit();
    };
    // It may be there already.
    begin();
    frame.addEventListener("load", begin);
}
