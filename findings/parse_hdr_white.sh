#!/usr/bin/env bash
# npm parse-hdr 1.0.0 reads Radiance pictures 0.4 % too bright and misreads their exposure.
#
# Input: valid Radiance files of two pixels with mantissas 128 and exponent 129, that is 128/256 * 2 = 1.0, or 1.0039
#        for readers that add half a step (Radiance itself: 128.5/256 * 2).
# Guess: 1.0 or 1.00390625, and `exposure` is the product of the EXPOSURE lines, as the format says.
# Seen: mantissas are divided by 255 (1.00392157: black stays black, and 255 becomes 2 instead of 1.9921875);
#       EXPOSURE=2 without a decimal point is passed over, of several lines the last one wins instead of their
#       product, 2.5e-1 is read as 2.5; pixels are not divided by it.
# What follows: compare environments read by such viewers with `herr look --environment` at 0.4 %, and write one
#       EXPOSURE line with a decimal point and no exponent.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund parse-hdr@1.0.0

cat > read.js <<'JS'
const assert = require("assert");
const parse = require("parse-hdr");
const picture = (head) => Buffer.concat([
  Buffer.from(`#?RADIANCE\n${head}FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n`),
  Buffer.from([128, 255, 0, 129, 128, 255, 0, 129])]);
const seen = {};
for (const head of ["", "EXPOSURE=2\n", "EXPOSURE=2.0\n", "EXPOSURE=2.0\nEXPOSURE=3.0\n", "EXPOSURE=2.5e-1\n"]) {
  const {data, exposure} = parse(picture(head));
  seen[head.trim().replace("\n", ", ")] = exposure;
  console.log(JSON.stringify(head), "pixel", data[0], data[1], data[2], "exposure", exposure);
  assert.strictEqual(data[0], Math.fround(128 / 255 * 2));
  assert.strictEqual(data[1], 2);
  assert.strictEqual(data[2], 0);
}
assert.deepStrictEqual(seen, {"": 1, "EXPOSURE=2": 1, "EXPOSURE=2.0": 2, "EXPOSURE=2.0, EXPOSURE=3.0": 3,
                              "EXPOSURE=2.5e-1": 2.5}, "parse-hdr behaves otherwise now");
JS
node read.js
