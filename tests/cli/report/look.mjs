// SPDX-License-Identifier: BSD-3-Clause
// Opens the reports of a tracked run, of one that gets lost, of one that tracks nothing and of a damaged one, and the
// comparison of two, and uses them.
// Usage: look.mjs SSLAM [FOLDER for screenshots]
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, truncateSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, kNoGl, kSoftwareGl } from "./browser.mjs";
import { pinchPaths, useComparison } from "./use_comparison.mjs";

const [, , sslam, pictures] = process.argv;
const scratch = mkdtempSync(join(tmpdir(), "sslam_report_"));
const room = join(scratch, "demo/room");

function call(code, ...args) {
  const done = spawnSync(sslam, args, { encoding: "utf8" });
  assert.equal(done.status, code, `sslam ${args.join(" ")}\n${done.stdout}${done.stderr}`);
}

function picture(name) { return pictures && join(pictures, `${name}.png`); }

async function look(browser, run, options, use) {
  const page = await browser.open(`file://${run.endsWith(".html") ? run : join(run, "report.html")}`, options.size, options.dark);
  await page.until("document.documentElement.dataset.ready");
  await use(page);
  assert.deepEqual(page.complaints, [], `complaints of ${run}`);
  assert.equal(await page.run("document.documentElement.scrollWidth <= innerWidth"), true, "wider than the window");
  await page.close();
}

async function useTracked(page) {
  const three = await page.run("typeof THREE !== 'undefined'");
  assert.equal(await page.run("run.frames.count"), 60);
  assert.ok(await page.run("run.points.length > 300 && Boolean(run.errors)"));
  // Slider and keys go to a frame, and everything goes along.
  await page.run("byId('slider').value = 40; byId('slider').dispatchEvent(new Event('input'))");
  assert.equal(await page.run("shown.row"), 40);
  await page.until("views.view.row === 40 && views.image.complete && views.image.naturalWidth > 0");
  await page.press("ArrowRight");
  await page.press("ArrowLeft", 8);
  assert.equal(await page.run("shown.row"), 31);
  assert.match(await page.run("byId('frame-name').textContent"), /^31 · 000031\.jpg$/);
  assert.match(await page.run("document.querySelector('.chart .value').textContent"), /^[0-9.e-]+ m$/);
  assert.ok(await page.run("views.view.points.length > 100 && views.view.lines.length > 10 && views.view.axes.length === 3"));
  await page.run("document.querySelector('.chart .plot').scrollIntoView({ block: 'center' })");
  const chart = await page.middleOf(".chart .plot");
  await page.drag(chart, [chart[0] + 2, chart[1]]);
  assert.ok(await page.run("Math.abs(shown.row - 30) < 6"));
  await page.run("scrollTo(0, 0)");
  if (!three) return;
  // The mouse orbits, layers come and go, the camera is followed.
  const look = "view3d.viewpoint.camera.position.toArray()";
  const before = await page.run(look);
  const middle = await page.middleOf("#canvas");
  await page.drag(middle, [middle[0] + 120, middle[1] + 30]);
  assert.notDeepEqual(await page.run(look), before);
  const whole = await page.screenshot(picture("orbited"));
  const layers = await page.run("[...document.querySelectorAll('#layers [data-layer]:not([hidden])')].map((b) => b.dataset.layer)");
  for (const name of layers) {
    await page.run(`document.querySelector("[data-layer=${name}]").click()`);
    assert.equal(await page.run(`view3d.layers.${name}.visible`), false);
  }
  assert.notEqual(await page.screenshot(picture("no_layers")), whole);
  for (const at of layers.keys()) await page.press(String(at + 1));
  assert.ok(await page.run("Object.values(view3d.layers).every((layer) => layer.visible)"));
  await page.press("f");
  assert.equal(await page.run("view3d.viewpoint.follows"), true);
  const followed = await page.run(look);
  await page.press("End");
  assert.notDeepEqual(await page.run(look), followed);
  await page.screenshot(picture("followed"));
  await page.press("t");
  assert.equal(await page.run("document.documentElement.dataset.theme"), "dark");
  await page.screenshot(picture("dark"));
}

// Where on the canvas something of a kind lies, by the page's own picking.
function placeOf(page, kind) {
  return page.run(`(() => {
    const box = byId('canvas').getBoundingClientRect();
    for (let y = 4; y < Math.min(box.height, innerHeight - box.y - 90); y += 3)
      for (let x = 420; x < box.width; x += 3) if (picker.at(x, y)?.kind === '${kind}') return [box.x + x, box.y + y];
    return null;
  })()`);
}

// The dense model stands in place of the rectangles, with its texture, and hides what is behind it.
async function useSurfaces(page) {
  assert.equal(await page.run("document.querySelector('[data-layer=surfaces]').hidden || !document.querySelector('[data-layer=planes]').hidden"), false);
  await page.until("view3d.surfaces.material.map && view3d.surfaces.material.map.image.naturalWidth > 100");
  const hidden = `Array.from({ length: run.points.length / 3 }, (_, i) => picker.projection()(...run.points.subarray(3 * i, 3 * i + 3)))
    .filter(({ x, y, w }) => w > 0 && picker.at(x, y)?.kind === "surface").length`;
  assert.ok(await page.run(`${hidden} > 0`));
  await page.click(await placeOf(page, "surface"));
  assert.match(await page.run("byId('picked').innerText"), /^Surface \d+.*m² were seen, at right angles to.*Fly there/s);
  await page.press("Escape");
  assert.equal(await page.run("byId('picked').hidden"), true);
  const shown = await page.screenshot(picture("surfaces"));
  await page.run("document.querySelector('[data-layer=surfaces]').click()");
  assert.equal(await page.run(hidden), 0);
  assert.notEqual(await page.screenshot(), shown);
  await page.run("document.querySelector('[data-layer=surfaces]').click()");
}

// Colours, picking, measuring, saving, and the frame of the address.
async function useMap(page) {
  // The page has opened in the middle of the frames with a pose, and shows what it has seen in its colours.
  assert.ok(await page.run("run.hasPose(shown.row) && shown.row > 20 && shown.row < 50"));
  assert.ok(await page.run("run.coloured && new Set(run.point_colours).size > 50"));
  const grey = "Array.from(run.point_colours).filter((value, i, all) => value === 128 && all[i - i % 3] === 128).length / run.point_colours.length";
  assert.ok(await page.run(`${grey} < 0.1`));
  if (!(await page.run("typeof THREE !== 'undefined'"))) return;
  await page.until("[...view3d.layers.pictures.children].filter((mesh) => mesh.visible).length > 3 && view3d.eyePicture.visible");
  const seen = await page.run("Array.from(view3d.layers.points.geometry.attributes.color.array.slice(0, 30)).join()");
  await page.run("(() => { const select = document.querySelectorAll('#tools select')[0]; select.value = 'axes'; select.dispatchEvent(new Event('change')); })()");
  assert.notEqual(await page.run("Array.from(view3d.layers.points.geometry.attributes.color.array.slice(0, 30)).join()"), seen);
  await page.run("(() => { const size = byId('point-size'); size.value = 6; size.dispatchEvent(new Event('input')); })()");
  assert.equal(await page.run("view3d.materials.points.size"), 6);
  const state = await page.run("Array.from(view3d.layers.path.geometry.attributes.instanceColorStart.data.array).join()");
  assert.match(await page.run("document.querySelector('.legend').innerText"), /Manhattan rotation.*squares of 1 m/s);
  await page.run("view3d.setPathColours('error')");
  assert.match(await page.run("document.querySelector('.legend').innerText"), /error: 0.* m or more/s);
  assert.notEqual(await page.run("Array.from(view3d.layers.path.geometry.attributes.instanceColorStart.data.array).join()"), state);
  // A click tells what lies there.
  for (const [kind, words] of [["point", /^Point \d+.*seen by \d+ keyframes/s], ["line", /^Line \d+.*long, along/s], ["keyframe", /^Keyframe \d+.*sees \d+ points/s]]) {
    const at = await placeOf(page, kind);
    assert.ok(at, `no ${kind} in view`);
    await page.click(at);
    assert.match(await page.run("byId('picked').innerText"), words);
  }
  assert.ok(await page.run("run.pointWitnesses.counts.every((count, i) => count >= run.pointWitnesses.keyframesOf(i).length)"));
  await page.screenshot(picture("picked"));
  await useSurfaces(page);
  // Twice the same place is no distance; two places are.
  await page.run("byId('measure').click()");
  const point = await placeOf(page, "point"), line = await placeOf(page, "line");
  for (const at of [point, point]) await page.click(at);
  assert.match(await page.run("byId('picked').innerText"), /\n0 m/);
  for (const at of [point, line]) await page.click(at);
  assert.match(await page.run("byId('picked').innerText"), /\n[0-9.]+ m/);
  assert.doesNotMatch(await page.run("byId('picked').innerText"), /\n0 m/);
  await page.run("byId('measure').click()");
  assert.equal(await page.run("byId('picked').hidden"), true);
}

// What the page hands out, without the browser's dialogue.
async function useFiles(page) {
  const csv = (await page.run("framesAsCsv()")).trim().split("\n");
  assert.equal(csv.length, 61);
  assert.match(csv[0], /^index,stamp,image,state.*,qw,position_error_m,rotation_error_deg$/);
  assert.ok(csv.every((line) => line.split(",").length === csv[0].split(",").length));
  const svg = await page.run(`new Promise((resolve) => {
    const offer = offerFile;
    offerFile = async (name, blob) => { offerFile = offer; resolve(name + " " + await blob.text()); };
    document.querySelector(".chart .save").click();
  })`);
  assert.match(svg, /^position_error\.svg <svg .*>Position error, m<\/text>.*>after alignment<\/text>.*<path d="M.*<text .*<\/svg>\n$/s);
  await page.run("shown.set(17); linkToFrame()");
  assert.match(await page.run("location.hash"), /^#frame=17$/);
  assert.equal(await page.run("shown.set(3), firstRow()"), 17);
}

// Whether the time bar stands below the stage, and so covers nothing of it.
const kBarIsFree = "document.querySelector('.stage-row').getBoundingClientRect().bottom <= document.querySelector('.timeline').getBoundingClientRect().top";

// Images without anything in them, for which the camera is lost.
async function blindFrames(page) {
  const jpeg = await page.run(`(() => {
    const canvas = element("canvas", { width: run.settings.image_size[0], height: run.settings.image_size[1] });
    canvas.getContext("2d").fillRect(0, 0, canvas.width, canvas.height);
    return canvas.toDataURL("image/jpeg").split(",")[1];
  })()`);
  for (let i = 40; i < 48; ++i) writeFileSync(join(room, `rgb/0000${i}.jpg`), Buffer.from(jpeg, "base64"));
}

// A run of which half is gone, with figures of other kinds than expected.
function damage(run) {
  rmSync(join(run, "map.sslam"));
  for (const name of ["frames.csv", "views.bin"]) truncateSync(join(run, name), Math.floor(statSync(join(run, name)).size / 2));
  writeFileSync(join(run, "metrics.json"), '{"tracked": "all", "states": 5, "trajectory": 7, "times": [], "settings": {"dataset": {}, "pinhole": "?"}}');
  call(0, "report", run);
}

async function main() {
  call(0, "demo", join(scratch, "demo"), "--frames", "60");
  const run = join(scratch, "demo/run"), lost = join(scratch, "lost"), none = join(scratch, "none");
  call(1, "run", room, "--quiet", "--normals", "none", "--out", none, "--end", "2");
  assert.ok(!/https?:\/\/(?!www\.w3\.org|threejs\.org|github\.com)[a-z]/.test(readFileSync(join(run, "report.html"), "latin1").split('<script id="data"')[0]));

  const browser = new Browser(kSoftwareGl);
  try {
    await look(browser, run, {}, async (page) => {
      assert.equal(await page.run(kBarIsFree), true);
      await useMap(page);
      await useFiles(page);
    });
    await look(browser, run, { size: { width: 1280, height: 600 } }, async (page) => { assert.equal(await page.run(kBarIsFree), true); });
    await look(browser, run, {}, async (page) => {
      await useTracked(page);
      await blindFrames(page);
    });
    call(0, "run", room, "--quiet", "--normals", "none", "--out", lost);
    await look(browser, run, { size: { width: 390, height: 844 } }, async (page) => {
      await page.screenshot(picture("phone"));
      // The time bar stands between its neighbours and covers neither.
      assert.ok(await page.run("(() => { const box = (s) => document.querySelector(s).getBoundingClientRect(); return box('.stage-row').bottom <= box('.timeline').top && box('.timeline').bottom <= byId('story').parentElement.getBoundingClientRect().top; })()"));
    });
    await look(browser, lost, {}, async (page) => {
      assert.match(await page.run("byId('story').textContent"), /Lost for \d+ frames? \(frames 40 to .*too few matches/);
      await page.run("shown.set(42)");
      assert.match(await page.run("byId('frame-state').textContent"), /^lost: too few matches/);
      assert.equal(await page.run("typeof THREE !== 'undefined' && view3d.eye.visible"), false);
      assert.equal(await page.run("run.surfaces === null && !document.querySelector('[data-layer=planes]').hidden"), await page.run("typeof THREE !== 'undefined'"));
      await page.screenshot(picture("lost"));
    });
    const features = join(scratch, "features");
    call(0, "run", room, "--quiet", "--preset", "features", "--out", features);
    await look(browser, features, {}, async (page) => {
      assert.match(await page.run("byId('headline').textContent"), /no Manhattan frame: points and lines gave/);
      assert.match(await page.run("byId('story').textContent"), /The preset features uses no Manhattan frame/);
      assert.equal(await page.run("byId('charts').textContent.includes('axes')"), false);
    });
    const page = join(scratch, "compare.html");
    call(0, "report", run, lost, "-o", page);
    await look(browser, page, {}, async (open) => {
      await useComparison(open);
      await open.screenshot(picture("comparison"));
    });
    await look(browser, page, { size: { width: 390, height: 844 }, dark: true }, async (phone) => {
      await phone.screenshot(picture("comparison_phone"));
      await pinchPaths(phone);
    });
    damage(lost);
    await look(browser, lost, {}, async (page) => {
      assert.match(await page.run("byId('story').textContent"), /map\.sslam: is missing.*views\.bin: is cut off/);
      await page.press("End");
      await page.screenshot(picture("damaged"));
    });
    await look(browser, none, {}, async (page) => {
      assert.match(await page.run("byId('story').textContent"), /^No frame was tracked: /);
      assert.equal(await page.run("document.querySelector('.stage').hidden"), true);
      await page.until("views.image.naturalWidth > 0");
      await page.press("End");
      await page.screenshot(picture("none"));
    });
  } finally {
    await browser.close();
  }
  const plain = new Browser(kNoGl);
  try {
    await look(plain, run, {}, async (page) => {
      assert.match(await page.run("byId('notice').textContent"), /the map is seen from above/);
      await page.press("End");
      await page.until("view3d.above");
      const shown = await page.run("byId('canvas').toDataURL()");
      assert.ok(await page.run("new Set(new Uint32Array(view3d.above.getContext('2d').getImageData(0, 0, view3d.above.width, view3d.above.height).data.buffer)).size > 100"));
      await page.screenshot(picture("no_webgl"));
      await page.run("document.querySelector('[data-layer=surfaces]').click()");
      assert.notEqual(await page.run("byId('canvas').toDataURL()"), shown);
    });
  } finally {
    await plain.close();
  }
  console.log("1 passed, 0 failed");
}

try {
  await main();
} finally {
  rmSync(scratch, { recursive: true, force: true });
}
