// SPDX-License-Identifier: BSD-3-Clause
// A recording by Foxglove's own reader: every message, read by the schema in the file, as JSON.
// Usage: recording.mjs PACKAGES FILE.mcap    (PACKAGES: folder with node_modules)
import { open } from "node:fs/promises";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { shown, text } from "./shown.mjs";

const [, , packages, path] = process.argv;
const require = createRequire(resolve(packages, "package.json"));
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { McapIndexedReader } = require("@mcap/core");
const { decompress } = require("fzstd");

const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, size) => {
    const bytes = new Uint8Array(Number(size));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
const recording = await McapIndexedReader.Initialize({ readable, decompressHandlers: { zstd: (bytes) => decompress(bytes) } });
const readers = new Map(), messages = [];
for await (const { channelId, logTime, data } of recording.readMessages()) {
  const channel = recording.channelsById.get(channelId), schema = recording.schemasById.get(channel.schemaId);
  if (!readers.has(channelId)) readers.set(channelId, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
  messages.push({ topic: channel.topic, type: schema.name, time: logTime, message: shown(schema.name, readers.get(channelId).readMessage(data)) });
}
console.log(JSON.stringify({ chunks: recording.chunkIndexes.length, count: recording.statistics.messageCount, messages }, text));
