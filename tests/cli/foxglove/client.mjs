// SPDX-License-Identifier: BSD-3-Clause
// Foxglove's own client at a run: subscribes to every channel, reads messages by the schemas that came with them until the
// server says goodbye, and prints them as JSON.
// Usage: client.mjs PACKAGES ADDRESS SUBPROTOCOL    (PACKAGES: folder with node_modules)
// Prints "ready" when it has subscribed and the first message has come.
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { shown, text } from "./shown.mjs";

const [, , packages, address, subprotocol] = process.argv;
const require = createRequire(resolve(packages, "package.json"));
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { WebSocket } = require("ws");

const socket = new WebSocket(address, [subprotocol]);
const client = new FoxgloveClient({ ws: socket });
const channels = new Map(), messages = [];
let info = null, ready = false;

client.on("serverInfo", (event) => { info = event; });
client.on("status", (event) => fail(event.message));
client.on("error", (error) => fail(error.message));
client.on("advertise", (advertised) => {
  for (const channel of advertised) {
    const definition = parse(channel.schema, { ros2: true });
    channels.set(client.subscribe(channel.id), { ...channel, reader: new MessageReader(definition) });
  }
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const channel = channels.get(subscriptionId);
  const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  messages.push({ topic: channel.topic, time: timestamp, message: shown(channel.schemaName, channel.reader.readMessage(bytes)),
                  raw: channel.topic === "/image/compressed" ? "" : Buffer.from(bytes).toString("hex") });
  if (!ready && channel.topic === "/camera_info") console.log("ready");
  ready ||= channel.topic === "/camera_info";
});
client.on("close", (event) => {
  const types = Object.fromEntries([...channels.values()].map((c) => [c.topic, [c.schemaName, c.encoding, c.schemaEncoding]]));
  console.log(JSON.stringify({ protocol: socket.protocol, info, types, messages, code: event.code }, text));
});

function fail(why) {
  console.error(`client: ${why}`);
  process.exit(1);
}
