#!/usr/bin/env bash
# npm parse-exr 1.0.2 returns OpenEXR pictures bottom row first, and tells nothing of where their pixels lie.
#
# Input: a valid uncompressed scan-line OpenEXR picture of half floats, written here byte by byte: three rows, red, green,
#        blue from the top, in the upper right corner of a display window of 4 x 4 pixels.
# Guess: `data` begins with the first row, as parse-hdr, pngjs and OpenEXR itself have it.
# Seen: `data` begins with the last row (as textures of WebGL want it); `width` and `height` are those of the data window;
#       both windows are found in `header` alone; alpha is filled with 1.
# What follows: turn the rows over before such pixels are compared with a frame of this program or with a PNG of it.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund parse-exr@1.0.2

cat > read.mjs <<'JS'
import assert from "node:assert";
import parseExr from "parse-exr";

const int = (...values) => Buffer.from(Int32Array.from(values).buffer);
const float = (...values) => Buffer.from(Float32Array.from(values).buffer);
const text = (name) => Buffer.from(name + "\0");
const attribute = (name, type, value) => Buffer.concat([text(name), text(type), int(value.length), value]);
const channel = (name) => Buffer.concat([text(name), int(1, 0, 1, 1)]);  // half, every pixel
const width = 2, height = 3, left = 2, top = 0;
const head = Buffer.concat([
  int(20000630, 2),
  attribute("channels", "chlist", Buffer.concat([channel("B"), channel("G"), channel("R"), Buffer.from([0])])),
  attribute("compression", "compression", Buffer.from([0])),
  attribute("dataWindow", "box2i", int(left, top, left + width - 1, top + height - 1)),
  attribute("displayWindow", "box2i", int(0, 0, 3, 3)),
  attribute("lineOrder", "lineOrder", Buffer.from([0])),
  attribute("pixelAspectRatio", "float", float(1)),
  attribute("screenWindowCenter", "v2f", float(0, 0)),
  attribute("screenWindowWidth", "float", float(1)),
  Buffer.from([0]),
]);
const one = 0x3c00;  // 1.0 as a half
const rows = [[0, 0, one], [0, one, 0], [one, 0, 0]].map((bgr, y) => {
  const pixels = Buffer.from(Uint16Array.from(bgr.flatMap((value) => [value, value])).buffer);
  return Buffer.concat([int(top + y, pixels.length), pixels]);
});
const table = Buffer.alloc(8 * height);
let at = head.length + table.length;
rows.forEach((row, y) => { table.writeBigUInt64LE(BigInt(at), 8 * y); at += row.length; });
const file = Buffer.concat([head, table, ...rows]);

const picture = parseExr(Uint8Array.from(file).buffer, 1015);
const row = (y) => Array.from(picture.data.slice(4 * width * y, 4 * width * y + 4)).join(" ");
console.log("size", picture.width, "x", picture.height, "of a display window of 4 x 4");
console.log("first pixels of the rows of `data`:", [0, 1, 2].map(row).join(" | "));
assert.deepStrictEqual([picture.width, picture.height], [2, 3], "the size is another now");
assert.deepStrictEqual([0, 1, 2].map(row), ["0 0 1 1", "0 1 0 1", "1 0 0 1"], "rows have another order now");
assert.ok(picture.header.dataWindow.xMin === 2 && picture.header.displayWindow.xMax === 3);
JS
node read.mjs
