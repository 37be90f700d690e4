#!/usr/bin/env bash
# assimp 5.2.5 (Debian 12) squares the alpha of a glTF material with every export.
#
# Input: a valid glTF 2.0 file whose material has baseColorFactor alpha 0.5 and emissive strength 7, one triangle.
# `assimp export in.gltf out.gltf -fgltf2`, then its result once more.
# Guess: both files say alpha 0.5 and emissive strength 7.
# Seen: alpha 0.25, then 0.0625 (opacity is written into the base colour's alpha, which holds it already); the
#       emissive strength is gone without a word; a third material that nothing uses comes with each file.
# What follows: compare materials after a conversion by assimp; `herr look` draws what the file says.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -q assimp-utils=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1 libdraco7=1.5.5+dfsg-2 \
  libminizip1=1.1-8+deb12u1 > /dev/null
for package in ./*.deb; do dpkg -x "$package" .; done
export LD_LIBRARY_PATH="$folder/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)"

cat > in.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "extensionsUsed": ["KHR_materials_emissive_strength"],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"name": "glow", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 0.5]},
   "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.3,
   "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 7}}}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
   "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36,
   "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
GLTF
usr/bin/assimp export in.gltf once.gltf -fgltf2 > /dev/null
usr/bin/assimp export once.gltf twice.gltf -fgltf2 > /dev/null

python3 - <<'CHECK'
import json
seen = {}
for name in ("in", "once", "twice"):
    glow = next(m for m in json.load(open(name + ".gltf"))["materials"] if m["name"] == "glow")
    seen[name] = (glow["pbrMetallicRoughness"]["baseColorFactor"][3],
                  "KHR_materials_emissive_strength" in glow.get("extensions", {}))
    print("%-5s alpha %s, emissive strength %s" % (name, seen[name][0], "kept" if seen[name][1] else "absent"))
assert seen == {"in": (0.5, True), "once": (0.25, False), "twice": (0.0625, False)}, "assimp behaves otherwise now"
CHECK
