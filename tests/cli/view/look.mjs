// SPDX-License-Identifier: BSD-3-Clause
// Opens the pages of a map and of a run that goes on, and watches that run to its end.
// Usage: look.mjs SSLAM [FOLDER for screenshots]
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { Browser, kNoGl, kSoftwareGl } from "../report/browser.mjs";

const [, , sslam, pictures] = process.argv;
const scratch = mkdtempSync(join(tmpdir(), "sslam_view_"));
const room = join(scratch, "room");
const kFrames = 60;

function call(...args) {
  const done = spawnSync(sslam, args, { encoding: "utf8" });
  assert.equal(done.status, 0, `sslam ${args.join(" ")}\n${done.stdout}${done.stderr}`);
}

function picture(name) { return pictures && join(pictures, `${name}.png`); }

// A program that is asked in lines, and answers in lines.
class Spoken {
  constructor(program, ...args) {
    this.process = spawn(program, args, { stdio: ["pipe", "pipe", "inherit"] });
    this.lines = createInterface({ input: this.process.stdout })[Symbol.asyncIterator]();
    this.exited = new Promise((resolve) => this.process.on("exit", resolve));
  }
  async hear() { return (await this.lines.next()).value; }
  ask(line) {
    this.process.stdin.write(`${line}\n`);
    return this.hear();
  }
}

function follow(out) {
  const helper = join(dirname(fileURLToPath(import.meta.url)), "served.py");
  return new Spoken("python3", helper, sslam, "run", room, "--normals", "none", "--out", out);
}

const shortly = () => new Promise((resolve) => setTimeout(resolve, 20));

// Lets the run track on, a frame for each answer that the page gets, until the page shows more than `count` frames.
async function trackUntil(run, page, count) {
  let answers = 0;
  page.browser.listeners.push(({ method, params }) => {
    if (method === "Network.responseReceived" && params.response.url.includes("/news?")) ++answers;
  });
  while (await page.run("run.frames.count") <= count) {
    await run.ask("step");
    for (const before = answers; answers === before && page.complaints.length === 0;) await shortly();
    assert.deepEqual(page.complaints, []);
  }
}

async function watch(page, run, three) {
  assert.equal(await page.run("byId('kind').textContent"), "run in progress");
  const seen = [];
  for (const more of [0, 2, 10]) {
    await trackUntil(run, page, (seen.at(-1) ?? 0) + more);
    seen.push(await page.run("run.frames.count"));
  }
  assert.ok(seen[0] < seen[1] && seen[1] < seen[2] && seen[2] <= kFrames, String(seen));
  // Everything has grown along.
  assert.equal(await page.run("shown.row"), seen[2] - 1);
  assert.match(await page.run("byId('headline').textContent"), new RegExp(`${seen[2]} of ${kFrames} frames so far`));
  assert.equal(await page.run("Number(byId('slider').max)"), seen[2] - 1);
  await page.until("views.view.row === shown.row && views.image.complete && views.image.naturalWidth > 0");
  assert.ok(await page.run("run.points.length > 300 && run.trajectoryThere && run.keyframes.length >= 7"));
  assert.ok(await page.run("document.querySelectorAll('#charts .chart').length >= 3"));
  assert.match(await page.run("document.querySelector('.chart .value').textContent"), /^\d+$/);
  assert.ok(await page.run("views.view.points.length > 50 && views.texts.length >= 3"));
  if (pictures) {  // that show more of a map
    await trackUntil(run, page, kFrames - 15);
    await page.until("views.view.row === shown.row && views.image.complete");
  }
  await page.screenshot(picture(three ? "live" : "flat"));
}

// Who looks back stays there, and who has hidden a layer or moved the view finds them so.
async function lookBack(page, run) {
  await page.run("shown.set(3)");
  await page.run("document.querySelector('[data-layer=points]').click()");
  await page.run("byId('canvas').focus()");
  await page.press("ArrowLeft");
  await page.drag([400, 500], [440, 510]);
  await page.run("document.querySelector('#story button').focus()");
  const look = "view3d.viewpoint.camera.position.toArray()";
  const before = await page.run(look), count = await page.run("run.frames.count");
  await trackUntil(run, page, count);
  assert.equal(await page.run("shown.row"), 3);
  assert.deepEqual(await page.run(look), before);
  assert.equal(await page.run("document.activeElement.textContent"), "Show");
  assert.equal(await page.run("view3d.layers.points.visible"), false);
}

async function watchToTheEnd(browser, out) {
  const run = follow(out);
  const page = await browser.open(await run.hear());
  await page.until("document.documentElement.dataset.ready");
  const three = await page.run("view3d instanceof Scene3D");
  await watch(page, run, three);
  if (three) await lookBack(page, run);
  assert.equal(await run.ask("finish"), "over");
  // The page loads anew: in between there is none to ask.
  const report = `Boolean(document.documentElement.dataset.ready) && run.kind === "run" && run.frames.count === ${kFrames}`;
  while (page.complaints.length === 0 && !(await page.run(report).catch(() => false))) await shortly();
  assert.equal(await page.run("byId('kind').textContent"), "run report");
  assert.ok(await page.run("Boolean(run.errors) && views.texts.length === run.frames.count"));
  assert.deepEqual(page.complaints, []);
  await page.screenshot(picture("over"));
  run.process.stdin.end();
  await run.exited;
  await page.close();
}

async function lookAtMap(browser, map) {
  const view = new Spoken(sslam, "view", map);
  const page = await browser.open(/http:\S+/.exec(await view.hear())[0]);
  await page.until("document.documentElement.dataset.ready");
  assert.equal(await page.run("byId('kind').textContent"), "map");
  assert.ok(await page.run("run.points.length > 300 && run.lines.axes.length > 3 && run.keyframes.length >= 7"));
  assert.equal(await page.run("document.querySelector('.timeline').offsetParent"), null);
  assert.equal(await page.run("document.documentElement.scrollWidth <= innerWidth"), true);
  assert.deepEqual(page.complaints, []);
  await page.screenshot(picture("map"));
  view.process.kill("SIGINT");
  assert.equal(await view.exited, 0);
  await page.close();
}

// When the program has gone in the middle, the page says so.
async function lookAtSilence(browser, out) {
  const run = follow(out);
  const page = await browser.open(await run.hear());
  await trackUntil(run, page, 0);
  run.process.stdin.end();
  await run.exited;
  while (await page.run("byId('silence').hidden")) await shortly();
  assert.ok(await page.run("run.frames.count > 0"));
  await page.close();
}

async function using(flags, use) {
  const browser = new Browser(flags);
  try {
    await use(browser);
  } finally {
    await browser.close();
  }
}

try {
  call("synth", room, "--quiet", "--frames", String(kFrames), "--seed", "3", "--size", "320x240");
  await using(kSoftwareGl, async (browser) => {
    await watchToTheEnd(browser, join(scratch, "run"));
    await lookAtMap(browser, join(scratch, "run/map.sslam"));
    await lookAtSilence(browser, join(scratch, "silent"));
  });
  await using(kNoGl, (browser) => watchToTheEnd(browser, join(scratch, "flat")));
  console.log("1 passed, 0 failed");
} finally {
  rmSync(scratch, { recursive: true, force: true });
}
