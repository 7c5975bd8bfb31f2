// SPDX-License-Identifier: BSD-3-Clause
// A headless Chromium, driven over its debugging pipe (fd 3 and 4, messages ended by a zero byte).
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export class Browser {
  constructor(flags = []) {
    this.profile = mkdtempSync(join(tmpdir(), "sslam_browser_"));
    const always = ["--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--disable-dev-shm-usage", "--no-first-run",
      "--disable-extensions", "--disable-background-networking", `--user-data-dir=${this.profile}`];
    const program = process.env.CHROMIUM ?? "chromium";
    this.process = spawn(program, [...always, ...flags, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.next = 1;
    this.waiting = new Map();
    this.listeners = [];
    this.exited = new Promise((resolve) => {
      this.process.on("exit", resolve);
      this.process.on("error", resolve);
    }).then(() => {
      for (const { reject } of this.waiting.values()) reject(new Error("the browser is gone"));
      this.waiting.clear();
    });
    let left = "";
    this.process.stdio[4].setEncoding("utf8").on("data", (text) => {
      const messages = (left + text).split("\0");
      left = messages.pop();
      for (const message of messages) this.receive(JSON.parse(message));
    });
    this.process.stdio[3].on("error", () => {});
  }

  receive(message) {
    const waiter = this.waiting.get(message.id);
    if (!waiter) {
      for (const listen of this.listeners) listen(message);
      return;
    }
    this.waiting.delete(message.id);
    if (message.error) waiter.reject(new Error(message.error.message));
    else waiter.resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }

  async open(url, size = { width: 1400, height: 900 }, dark = false) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    page.folder = url;
    await page.send("Page.enable");
    await page.send("Runtime.enable");
    await page.send("Log.enable");
    await page.send("Network.enable");
    await page.send("Emulation.setDeviceMetricsOverride", { ...size, deviceScaleFactor: 1, mobile: size.width < 600 });
    await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    const loaded = new Promise((resolve) => { page.onLoad = resolve; });
    await page.send("Page.navigate", { url });
    await loaded;
    return page;
  }

  async close() {
    await this.send("Browser.close").catch(() => {});
    await this.exited;
    rmSync(this.profile, { recursive: true, force: true });
  }
}

class Page {
  constructor(browser, session, target) {
    this.browser = browser;
    this.session = session;
    this.target = target;
    this.complaints = [];  // console errors, exceptions, requests for anything but the page itself and what lies beside it
    this.folder = "file:";
    browser.listeners.push((message) => {
      if (message.sessionId === session) this.hear(message.method, message.params);
    });
  }

  hear(method, params) {
    if (method === "Page.loadEventFired") this.onLoad?.();
    if (method === "Runtime.exceptionThrown") this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning"].includes(params.type)) this.complaints.push(params.args.map((a) => a.value).join(" "));
    if (method === "Log.entryAdded" && params.entry.level === "error") this.complaints.push(params.entry.text);
    if (method === "Network.requestWillBeSent" && !/^(file|data|blob):/.test(params.request.url) && !params.request.url.startsWith(this.folder)) this.complaints.push(`asks for ${params.request.url}`);
  }

  send(method, params) { return this.browser.send(method, params, this.session); }

  async run(expression) {
    const answer = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (answer.exceptionDetails) throw new Error(answer.exceptionDetails.exception?.description ?? answer.exceptionDetails.text);
    return answer.result.value;
  }

  // Until the expression is true, or the page complains; the test's own time limit ends what never is.
  async until(expression) {
    while (this.complaints.length === 0 && !(await this.run(`Boolean(${expression})`))) await new Promise((resolve) => setTimeout(resolve, 50));
  }

  async press(key, modifiers = 0) {
    const text = key.length === 1 ? key : undefined;
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", key, text, modifiers });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", key, modifiers });
  }

  async drag(from, to) {
    const mouse = (type, [x, y], buttons) => this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons, clickCount: 1, pointerType: "mouse" });
    await mouse("mousePressed", from, 1);
    for (let i = 1; i <= 4; ++i) await mouse("mouseMoved", [0, 1].map((k) => from[k] + (to[k] - from[k]) * i / 4), 1);
    await mouse("mouseReleased", to, 0);
  }

  click(at) { return this.drag(at, at); }

  // The middle of an element, for the mouse.
  middleOf(selector) {
    return this.run(`(() => { const b = document.querySelector("${selector}").getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
  }

  async screenshot(path, clip = undefined) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", clip: clip && { ...clip, scale: 1 }, captureBeyondViewport: Boolean(clip) });
    if (path) writeFileSync(path, Buffer.from(data, "base64"));
    return data;
  }

  close() { return this.browser.send("Target.closeTarget", { targetId: this.target }); }
}

// With WebGL in software, as on a machine without a graphics card; and with none.
export const kSoftwareGl = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
export const kNoGl = ["--disable-3d-apis"];
