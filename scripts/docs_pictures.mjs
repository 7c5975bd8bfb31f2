// SPDX-License-Identifier: BSD-3-Clause
// Photographs the report of a run: once as a whole, and frame by frame as it is played.
// Usage: docs_pictures.mjs RUN FOLDER    writes report.png, step000.png, step001.png, ...
import { join } from "node:path";
import { Browser, kSoftwareGl } from "../tests/cli/report/browser.mjs";

const [, , run, folder] = process.argv;
const kSteps = 60;
const browser = new Browser(kSoftwareGl);
const page = await browser.open(`file://${join(run, "report.html")}`, { width: 1400, height: 900 });
await page.until("document.documentElement.dataset.ready");
await page.until("!run.surfaces || view3d.surfaces.material.map");
// The speed of the machine that takes the pictures says nothing.
await page.run("[...document.querySelectorAll('.tile')].find((tile) => tile.textContent.includes('frames/s'))?.remove()");
const frames = await page.run("run.frames.count");
const show = async (row) => {
  await page.run(`byId('slider').value = ${row}; byId('slider').dispatchEvent(new Event('input'))`);
  await page.until(`shown.row === ${row} && (views.view.row !== ${row} || views.image.complete)`);
};
await show(Math.round(0.8 * frames));
await page.screenshot(join(folder, "report.png"));
for (let k = 0; k < kSteps; ++k) {
  await show(Math.round((frames - 1) * k / (kSteps - 1)));
  await page.screenshot(join(folder, `step${String(k).padStart(3, "0")}.png`));
}
await browser.close();
