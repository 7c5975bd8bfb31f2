// SPDX-License-Identifier: BSD-3-Clause
// Uses the page that compares two runs.
import assert from "node:assert/strict";

// Two fingers that part: the paths grow.
export async function pinchPaths(page) {
  await page.run("byId('canvas').scrollIntoView({ block: 'center' })");
  const [x, y] = await page.middleOf("#canvas");
  const touch = (type, ...offsets) => page.send("Input.dispatchTouchEvent", { type, touchPoints: offsets.map((offset, id) => ({ x: x + offset, y, id })) });
  await touch("touchStart", -20, 20);
  await touch("touchMove", -40, 40);
  await touch("touchEnd");
  assert.ok(await page.run("pathView.zoom > 1.5"));
}

export async function useComparison(page) {
  assert.equal(await page.run("document.querySelectorAll('#runs tr').length"), 3);
  assert.ok(await page.run("Array.from(document.querySelectorAll('#runs a'), (a) => a.getAttribute('href')).join() === 'demo/run/report.html,lost/report.html'"));
  assert.match(await page.run("byId('runs').innerText"), /ATE, m.*run\s.*lost\s/s);
  assert.ok(await page.run("document.querySelectorAll('#charts .chart').length >= 3 && document.querySelectorAll('#states canvas').length === 2"));
  assert.match(await page.run("byId('states-legend').innerText"), /lost/);
  const csv = (await page.run("pathsAsCsv()")).trim().split("\n").map((line) => line.split(","));
  assert.equal(csv[0].join(), "run,stamp,x,y,z,position_error,rotation_error_deg");
  assert.deepEqual([...new Set(csv.slice(1).map(([name]) => name))], ["run", "lost"]);
  assert.ok(csv.every((cells) => cells.length === 7) && csv.filter(([name, , x]) => name === "run" && Number.isFinite(Number(x)) && x !== "").length > 50);
  assert.deepEqual(await page.run("foldedRows(['a.x', 'a.y', 'b'], (name) => name !== 'b', (name) => (name === 'b' ? ['1', '2'] : ['3', kNone]))"),
    [["a.*", ["2 parameters", "–"]], ["b", ["1", "2"]]]);
  const picked = await page.run("byId('canvas').toDataURL()");
  await page.run("document.querySelector('.chart .plot').scrollIntoView({ block: 'center' })");
  const at = await page.middleOf(".chart .plot");
  await page.click([at[0] - 100, at[1]]);
  assert.ok(await page.run("moment.seconds < kEnd / 2 && moment.seconds > 0"));
  assert.notEqual(await page.run("byId('canvas').toDataURL()"), picked, "the dots have not moved");
  assert.match(await page.run("document.querySelector('.chart .value').textContent"), /^[0-9.e-]+ m$/);
  const before = await page.run("byId('canvas').toDataURL()");
  await page.run("byId('canvas').scrollIntoView({ block: 'center' })");
  const middle = await page.middleOf("#canvas");
  await page.drag(middle, [middle[0] + 80, middle[1] + 20]);
  const turned = await page.run("byId('canvas').toDataURL()");
  assert.notEqual(turned, before);
  await page.run("document.querySelector('#layers button').click()");
  assert.notEqual(await page.run("byId('canvas').toDataURL()"), turned);
  await page.press("t");
}
