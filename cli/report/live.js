// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on: asks the server for what is new, and lets the page show it, until the report takes its place.

const kPause = 300;       // ms between questions, at least
const kPauseShare = 4;    // times what a question takes, so that long runs and slow lines have their rest
const kLongPause = 2000;  // where there was no answer

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

// What is under a pressed pointer stays as it is: else clicks would be lost.
let pressed = false;
function listenToPointer() {
  for (const [type, down] of [["pointerdown", true], ["pointerup", false], ["pointercancel", false], ["blur", false]])
    window.addEventListener(type, () => { pressed = down; }, true);
}

// A user who looks at the newest frame goes along.
function takeNews({ data, view }) {
  const newest = shown.row >= run.frames.count - 1;
  Object.assign(run, makeRun(data));
  window.views?.add(view);
  const buttons = () => [...byId("story").querySelectorAll("button")];
  const focused = buttons().indexOf(document.activeElement);
  showFigures();
  buttons()[focused]?.focus({ preventScroll: true });
  hideMissing();
  view3d.renew();
  byId("slider").max = Math.max(run.frames.count - 1, 0);
  shown.set(newest ? run.frames.count - 1 : shown.row);
  redrawAll();
}

// Null: nothing new. Undefined: no answer.
async function askForNews() {
  try {
    const answer = await fetch(`news?version=${run.version}`, { cache: "no-store" });
    if (answer.status === 204) return null;
    return answer.ok ? await answer.json() : undefined;
  } catch {
    return undefined;
  }
}

async function followRun() {
  listenToPointer();
  for (;;) {
    const asked = performance.now();
    const news = await askForNews();
    byId("silence").hidden = news !== undefined;
    if (news?.over) return location.reload();
    while (news && pressed) await pause(50);
    if (news) takeNews(news);
    await pause(news === undefined ? kLongPause : Math.max(kPause, kPauseShare * (performance.now() - asked)));
  }
}
