// SPDX-License-Identifier: BSD-3-Clause
// Foxglove's own client at a run: subscribes to every channel, reads messages by the schemas that came with them until the
// server says goodbye, and prints them as JSON.
// Usage: client.mjs PACKAGES ADDRESS SUBPROTOCOL    (PACKAGES: folder with node_modules)
// Prints "ready" when it has subscribed and the first message has come.
import { createRequire } from "node:module";
import { resolve } from "node:path";

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
  messages.push({ topic: channel.topic, time: timestamp, message: shown(channel, channel.reader.readMessage(bytes)),
                  raw: channel.topic === "/image/compressed" ? "" : Buffer.from(bytes).toString("hex") });
  if (!ready && channel.topic === "/camera_info") console.log("ready");
  ready ||= channel.topic === "/camera_info";
});
client.on("close", (event) => {
  const types = Object.fromEntries([...channels.values()].map((c) => [c.topic, [c.schemaName, c.encoding, c.schemaEncoding]]));
  const text = (_, value) => {
    if (typeof value === "bigint") return String(value);
    return ArrayBuffer.isView(value) ? Array.from(value) : value;
  };
  console.log(JSON.stringify({ protocol: socket.protocol, info, types, messages, code: event.code }, text));
});

function fail(why) {
  console.error(`client: ${why}`);
  process.exit(1);
}

// An image by its size, a cloud by its points.
function shown(channel, message) {
  if (channel.schemaName.endsWith("/CompressedImage")) return { ...message, data: sizeOfJpeg(message.data) };
  if (channel.schemaName.endsWith("/PointCloud2")) return { ...message, data: message.data.length };
  return message;
}

function sizeOfJpeg(data) {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  for (let at = 2; at + 9 < view.byteLength; at += 2 + view.getUint16(at + 2)) {
    const marker = view.getUint16(at);
    if (marker >= 0xffc0 && marker <= 0xffc2) return [view.getUint16(at + 7), view.getUint16(at + 5)];
  }
  return null;
}
