// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on: asks the server for what is new, and lets the page show it, until the report takes its place.

const kPause = 300;       // ms between questions
const kLongPause = 2000;  // where there was no answer

// A user who looks at the newest frame goes along.
function takeNews({ data, view }) {
  const newest = shown.row >= run.frames.count - 1;
  Object.assign(run, makeRun(data));
  window.views?.add(view);
  showFigures();
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
  for (;;) {
    const news = await askForNews();
    byId("silence").hidden = news !== undefined;
    if (news?.over) return location.reload();
    if (news) takeNews(news);
    await new Promise((resolve) => setTimeout(resolve, news === undefined ? kLongPause : kPause));
  }
}
