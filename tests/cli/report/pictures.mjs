// SPDX-License-Identifier: BSD-3-Clause
// Takes the pictures of the documentation from a rendered room: its report, the run while it goes on, a frame of its
// overlay video. scripts/make_pictures calls it.
// Usage: pictures.mjs SSLAM FOLDER
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { Browser, kSoftwareGl } from "./browser.mjs";

const [, , sslam, folder] = process.argv;
const scratch = mkdtempSync(join(tmpdir(), "sslam_pictures_"));
const room = join(scratch, "demo/room"), kShown = 150;

function call(...args) {
  const done = spawnSync(sslam, args, { encoding: "utf8" });
  assert.equal(done.status, 0, `sslam ${args.join(" ")}\n${done.stdout}${done.stderr}`);
}

async function take(page, name) {
  await page.run("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))");
  const { data } = await page.send("Page.captureScreenshot", { format: "jpeg", quality: 85 });
  writeFileSync(join(folder, name), Buffer.from(data, "base64"));
  console.log(`${name}: ${Math.round(data.length * 0.75 / 1000)} kB`);
}

// The n-th picture of a Motion JPEG video, as it lies in the file.
function frameOf(video, n) {
  const bytes = readFileSync(video);
  let at = bytes.indexOf("movi");
  for (let i = 0; i <= n; ++i) at = bytes.indexOf("00dc", at + 4);
  return bytes.subarray(at + 8, at + 8 + bytes.readUInt32LE(at + 4));
}

async function takeReport(browser) {
  const page = await browser.open(`file://${join(scratch, "demo/run/report.html")}#frame=${kShown}`, { width: 1300, height: 860 });
  await page.until("document.documentElement.dataset.ready && views.image.complete && view3d.pictureQuads?.length > 0 && view3d.layers.pictures.children.every((mesh) => mesh.visible)");
  await take(page, "report.jpg");
  assert.deepEqual(page.complaints, []);
}

async function takeLive(browser) {
  const run = spawn(sslam, ["run", room, "--view", "--out", join(scratch, "live"), "--json-progress"], { stdio: ["ignore", "ignore", "pipe"] });
  let address;
  for await (const line of createInterface({ input: run.stderr })) {
    address = /http:\/\/127\.0\.0\.1:[^\s"\\]+/.exec(line)?.[0];
    if (address) break;
  }
  run.stderr.resume();
  const page = await browser.open(address, { width: 1400, height: 960 });
  await page.until(`document.documentElement.dataset.ready && run.frames.count > ${kShown} && run.kind === 'live' && views.image.complete`);
  await take(page, "live.jpg");
  const gone = new Promise((resolve) => run.on("exit", resolve));
  run.kill("SIGINT");
  await gone;
}

const browser = new Browser(kSoftwareGl);
try {
  call("demo", join(scratch, "demo"));
  const video = join(scratch, "look.avi");
  call("run", room, "--quiet", "--no-report", "--out", join(scratch, "video"), "--video", video);
  writeFileSync(join(folder, "overlay.jpg"), frameOf(video, kShown));
  await takeReport(browser);
  await takeLive(browser);
} finally {
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
