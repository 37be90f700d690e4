#!/usr/bin/env bash
# npm parse-magica-voxel 2.1.2 numbers colours in two ways and nests voxels in two ways.
#
# Input: valid MagicaVoxel files (version 150): one voxel of colour index 1 without a palette chunk; the same with
#        one; two models, as PACK says, of one voxel each.
# Guess: RGBA[c] is the colour of a voxel of index c in both files, alpha in 0 ... 255; XYZI is one list of voxels per
#        model.
# Seen: without a palette chunk RGBA is the format's default palette, in which index 0 is unused, with alpha 1: the
#       colour is RGBA[c]; with one it is the chunk as stored, alpha 255: the colour is RGBA[c - 1]. Of two models XYZI
#       is [voxel, [voxel]]: the first model's voxel is no list.
# What follows: whoever draws with RGBA[c] shifts every colour of a file with a palette by one; `herr` reads the
#       chunk as the format says.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund parse-magica-voxel@2.1.2

cat > read.js <<'JS'
const assert = require("assert");
const parser = require("parse-magica-voxel");
const parse = parser.default || parser;

const int32 = (value) => { const bytes = Buffer.alloc(4); bytes.writeInt32LE(value); return bytes; };
const chunk = (id, content, children = Buffer.alloc(0)) =>
  Buffer.concat([Buffer.from(id), int32(content.length), int32(children.length), content, children]);
const file = (...chunks) =>
  Buffer.concat([Buffer.from("VOX "), int32(150), chunk("MAIN", Buffer.alloc(0), Buffer.concat(chunks))]);
const size = chunk("SIZE", Buffer.concat([int32(1), int32(1), int32(1)]));
const voxel = (colour) => chunk("XYZI", Buffer.concat([int32(1), Buffer.from([0, 0, 0, colour])]));
// As stored: colour 1 is red, all others are blue.
const palette = Buffer.alloc(1024);
for (let i = 0; i < 256; ++i) palette.set(i === 0 ? [255, 0, 0, 255] : [0, 0, 255, 255], 4 * i);

const plain = parse(file(size, voxel(1)));
const coloured = parse(file(size, voxel(1), chunk("RGBA", palette)));
const two = parse(file(chunk("PACK", int32(2)), size, voxel(1), size, voxel(7)));
console.log("no palette:  RGBA[1] =", plain.RGBA[1]);
console.log("red palette: RGBA[1] =", coloured.RGBA[1], "RGBA[0] =", coloured.RGBA[0]);
console.log("two models:  XYZI =", JSON.stringify(two.XYZI));

const now = "parse-magica-voxel behaves otherwise now";
assert.deepStrictEqual({...plain.RGBA[1]}, {r: 255, g: 255, b: 255, a: 1}, now);  // the default palette's colour 1
assert.deepStrictEqual({...coloured.RGBA[0]}, {r: 255, g: 0, b: 0, a: 255}, now);
assert.deepStrictEqual({...coloured.RGBA[1]}, {r: 0, g: 0, b: 255, a: 255}, now);
assert(!Array.isArray(two.XYZI[0]) && Array.isArray(two.XYZI[1]), now);
JS
node read.js
