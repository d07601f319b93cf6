// Runs `verp ... --live 0 --live-wait`, watches it with Foxglove's own client library, and compares each message with the
// trace's (of several robots: with their traces merged). Every message but JSON is decoded as ROS 2 decodes it, on both
// sides. Usage: node compare.cjs FOLDER-OF-node_modules VERP-PROGRAM [WORDS OF `verp walk`...]
const { spawn, execFileSync } = require("node:child_process");
const { createRequire } = require("node:module");
const fs = require("node:fs");
const os = require("node:os");
const path = require("node:path");
const assert = require("node:assert");

const [modules, verp, ...words] = process.argv.slice(2);
const need = createRequire(path.join(path.resolve(modules), "package.json"));
const { FoxgloveClient } = need("@foxglove/ws-protocol");
const { WebSocket } = need("ws");
const { McapIndexedReader } = need("@mcap/core");
const { parse } = need("@foxglove/rosmsg");
const { MessageReader } = need("@foxglove/rosmsg2-serialization");

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "verp-live-"));
process.on("exit", () => fs.rmSync(folder, { recursive: true }));

function decoder(encoding, schemaEncoding, schema) {
  if (encoding === "json") return (data) => JSON.parse(new TextDecoder().decode(data));
  assert.equal(encoding, "cdr");
  assert.equal(schemaEncoding, "ros2msg");
  const reader = new MessageReader(parse(schema, { ros2: true }));
  return (data) => reader.readMessage(data);
}

const text = (value) =>
  JSON.stringify(value, (_, v) =>
    typeof v === "bigint" ? `${v}` : ArrayBuffer.isView(v) ? Array.from(v) : v);

function watch(port) {
  const topics = new Map(), subscriptions = new Map(), statuses = [];
  const client = new FoxgloveClient({
    ws: new WebSocket(`ws://127.0.0.1:${port}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]),
  });
  client.on("status", (status) => statuses.push(status));
  client.on("error", (error) => { throw error; });
  client.on("advertise", (channels) => {
    for (const channel of channels) {
      const decode = decoder(channel.encoding, channel.schemaEncoding, channel.schema);
      topics.set(channel.topic, { channel, messages: [] });
      subscriptions.set(client.subscribe(channel.id), { topic: channel.topic, decode });
    }
  });
  client.on("message", ({ subscriptionId, timestamp, data }) => {
    const { topic, decode } = subscriptions.get(subscriptionId);
    topics.get(topic).messages.push({ timestamp, raw: Buffer.from(data.buffer, data.byteOffset, data.byteLength)
      .toString("hex"), value: text(decode(data)) });
  });
  return new Promise((resolve) => client.on("close", () => resolve({ topics, statuses })));
}

async function compare(file, topics) {
  const handle = await fs.promises.open(file);
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) =>
      (await handle.read(Buffer.alloc(Number(length)), 0, Number(length), Number(offset))).buffer,
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const expected = new Map(), decoders = new Map();
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    if (channel.messageEncoding === "verp") continue; // for `verp replay`: not streamed
    const schema = reader.schemasById.get(channel.schemaId);
    if (!decoders.has(channel.id)) {
      decoders.set(channel.id,
        decoder(channel.messageEncoding, schema.encoding, new TextDecoder().decode(schema.data)));
    }
    if (!expected.has(channel.topic)) expected.set(channel.topic, { channel, schema, messages: [] });
    expected.get(channel.topic).messages.push({
      timestamp: message.logTime,
      raw: Buffer.from(message.data).toString("hex"),
      value: text(decoders.get(channel.id)(message.data)),
    });
  }
  let count = 0;
  for (const [topic, { channel, schema, messages }] of expected) {
    const live = topics.get(topic);
    assert(live, `${topic} was not streamed`);
    assert.equal(live.channel.schemaName, schema.name, topic);
    assert.equal(live.channel.schema, new TextDecoder().decode(schema.data), topic);
    assert.equal(live.channel.encoding, channel.messageEncoding, topic);
    assert.equal(live.messages.length, messages.length, topic);
    const of_all = topic === "/tf"; // several robots' at one time are in no order
    const sorted = (list) => (of_all ? list.map(text).sort() : list.map(text));
    assert.deepEqual(sorted(live.messages), sorted(messages), topic);
    count += messages.length;
    console.log(`${topic}: ${messages.length} messages of ${schema.name}, all equal`);
  }
  for (const topic of topics.keys()) assert(expected.has(topic), `${topic} is in no trace`);
  return count;
}

if (!words.includes("--for")) words.push("--for", "3");
const run = spawn(verp, ["walk", "--json", "--record", "run.mcap", "--live", "0", "--live-wait", ...words],
  { cwd: folder });
let told = "", out = "", watched;
run.stdout.on("data", (data) => { out += data; });
run.stderr.on("data", (data) => {
  told += data;
  const port = told.match(/ws:\/\/127\.0\.0\.1:(\d+)/);
  if (port && !watched) watched = watch(port[1]);
});
run.on("close", async (status) => {
  assert.equal(status, 0, told);
  const { topics, statuses } = await watched;
  assert.deepEqual(statuses, []);
  const result = JSON.parse(out);
  const traces = ["run.mcap", ...(result.others ?? []).map((robot) => robot.trace)];
  let file = "run.mcap";
  if (traces.length > 1) {
    file = "all.mcap";
    const names = traces.map((trace, i) => `${i === 0 ? "r1" : result.others[i - 1].name}=${trace}`);
    execFileSync(verp, ["trace", "merge", ...names, "-o", file], { cwd: folder });
  }
  const count = await compare(path.join(folder, file), topics);
  assert.equal(result.live.dropped, 0);
  assert.equal(result.live.sent, count);
  console.log(`${count} messages, digest ${result.digest}`);
});
