#!/usr/bin/env bash
# npm obj2gltf 3.2.0 makes polished surfaces matt, and files that the glTF validator refuses.
#
# Input: a valid OBJ with materials of specular exponents Ns 10, 250 and 900, and one that glows (Ke 2 1 0).
# Guess: roughness falls as GGX and Phong lobes of equal width have it, sqrt(2 / (Ns + 2)): 0.41, 0.089, 0.047; a
#        glow above 1 becomes KHR_materials_emissive_strength, or is limited to 1 with a word.
# Seen: roughness 1 - Ns / 1000: 0.99, 0.75, 0.1, so that Ns 250, a lacquer with a highlight of a few degrees, looks
#       like chalk; emissiveFactor [2, 1, 0], which the validator calls an error (VALUE_NOT_IN_RANGE).
# What follows: set the roughness of models converted by it by hand, and look for factors above 1.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund obj2gltf@3.2.0 gltf-validator@2.0.0-dev.3.10

cat > in.obj <<'OBJ'
mtllib in.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
usemtl dull
f 1 2 3
usemtl lacquer
f 1 2 4
usemtl polish
f 2 3 4
usemtl glow
f 1 3 4
OBJ
cat > in.mtl <<'MTL'
newmtl dull
Kd 0.5 0.5 0.5
Ks 0.5 0.5 0.5
Ns 10
newmtl lacquer
Kd 0.5 0.5 0.5
Ks 0.5 0.5 0.5
Ns 250
newmtl polish
Kd 0.5 0.5 0.5
Ks 0.5 0.5 0.5
Ns 900
newmtl glow
Kd 0.5 0.5 0.5
Ke 2 1 0
MTL
node_modules/.bin/obj2gltf -i in.obj -o out.gltf > /dev/null

cat > read.js <<'JS'
const assert = require("assert");
const fs = require("fs");
const materials = Object.fromEntries(
  JSON.parse(fs.readFileSync("out.gltf")).materials.map((material) => [material.name, material]));
for (const [name, exponent] of [["dull", 10], ["lacquer", 250], ["polish", 900]]) {
  const roughness = materials[name].pbrMetallicRoughness.roughnessFactor;
  console.log(`Ns ${exponent}: roughness ${roughness}, of equal width ${Math.sqrt(2 / (exponent + 2)).toFixed(3)}`);
  assert(Math.abs(roughness - (1 - exponent / 1000)) < 1e-9, "obj2gltf behaves otherwise now");
}
assert.deepStrictEqual(materials.glow.emissiveFactor, [2, 1, 0], "obj2gltf behaves otherwise now");
require("gltf-validator").validateBytes(new Uint8Array(fs.readFileSync("out.gltf"))).then((report) => {
  const errors = report.issues.messages.filter((message) => message.severity === 0);
  console.log("validator:", errors.map((error) => `${error.code} ${error.pointer}`).join(", "));
  assert(errors.some((e) => e.code === "VALUE_NOT_IN_RANGE" && e.pointer.includes("emissiveFactor")));
});
JS
node read.js
