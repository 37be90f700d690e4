#!/usr/bin/env python3
"""Puts together a mixed-reality scene of real models: a scanned room as catcher, the Stanford bunny and the
Utah teapot on its table, one area light below its ceiling.

    make_office_scene.py MODELS OUT

MODELS holds quest_rooms/office_small.glb, scans/stanford-bunny.obj and scans/teapot.obj. OUT gets
office.scene.json and the models it names, as glTF. Everything is read and written in metres, y up.
"""
import json
import math
import pathlib
import shutil
import struct
import sys

# From office_small.json: the table's top is a box of 1.60 x 0.75 m about (0.058, -0.655), 0.748 m above the
# floor; the room reaches from (-1.25, -1.03) to (1.20, 1.39), its ceiling is 2.76 m high.
TABLE_TOP_M = 0.7483

# The recording walks 0.9 m towards +z and looks down there; half a turn and a shift let it end in front of
# the table.
WORLD_FROM_SESSION = {"position": [0.15, 0.0, 0.9], "orientation_xyzw": [0.0, 1.0, 0.0, 0.0]}


def read_obj(path):
    """Vertices and triangles (indices from 0) of a Wavefront OBJ file; polygons become fans."""
    points, triangles = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words or words[0] not in ("v", "f"):
            continue
        if words[0] == "v":
            points.append(tuple(float(word) for word in words[1:4]))
            continue
        corners = [int(word.split("/")[0]) for word in words[1:]]
        corners = [c - 1 if c > 0 else len(points) + c for c in corners]
        triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return points, triangles


def smooth_normals(points, triangles):
    """Unit normals, the sum over the triangles of a vertex weighted by area."""
    sums = [[0.0, 0.0, 0.0] for _ in points]
    for a, b, c in triangles:
        u = [points[b][i] - points[a][i] for i in range(3)]
        v = [points[c][i] - points[a][i] for i in range(3)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for corner in (a, b, c):
            for i in range(3):
                sums[corner][i] += normal[i]
    lengths = [math.sqrt(sum(x * x for x in s)) for s in sums]
    return [tuple(x / n for x in s) if n > 0 else (0.0, 1.0, 0.0) for s, n in zip(sums, lengths)]


def write_glb(path, name, points, triangles):
    """One mesh of positions, normals and 32-bit indices as binary glTF."""
    blobs = [
        b"".join(struct.pack("<3f", *p) for p in points),
        b"".join(struct.pack("<3f", *n) for n in smooth_normals(points, triangles)),
        b"".join(struct.pack("<3I", *t) for t in triangles),
    ]
    offsets = [sum(len(b) for b in blobs[:i]) for i in range(3)]
    bounds = {"min": [min(p[i] for p in points) for i in range(3)],
              "max": [max(p[i] for p in points) for i in range(3)]}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": name, "mesh": 0}],
        "meshes": [{"name": name, "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", **bounds},
            {"bufferView": 1, "componentType": 5126, "count": len(points), "type": "VEC3"},
            {"bufferView": 2, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteOffset": o, "byteLength": len(b)} for o, b in zip(offsets, blobs)],
        "buffers": [{"byteLength": sum(len(b) for b in blobs)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(blobs)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body))
                     + struct.pack("<I4s", len(text), b"JSON") + text
                     + struct.pack("<I4s", len(body), b"BIN\0") + body)


def scene_document():
    return {
        "format_version": 1,
        "name": "office",
        "gltf": [
            {"file": "office_small.glb", "name": "room", "catcher": True,
             "material": {"base_colour": [0.6, 0.6, 0.6], "metallic": 0, "roughness": 0.8}},
            # The bunny's feet are 0.033 m above its origin; doubled it is 0.31 m high.
            {"file": "bunny.glb", "name": "bunny", "scale": 2.0,
             "translation": [0.30, TABLE_TOP_M - 2.0 * 0.0330, -0.50],
             "material": {"base_colour": [0.75, 0.55, 0.40], "metallic": 0, "roughness": 0.5}},
            # The teapot is 6.4 units long: 0.32 m here.
            {"file": "teapot.glb", "name": "teapot", "scale": 0.05,
             "translation": [-0.22, TABLE_TOP_M, -0.50],
             "material": {"base_colour": [0.9, 0.9, 0.95], "metallic": 1, "roughness": 0.08, "mirror": 0.6}},
        ],
        "lights": [{"name": "lamp", "centre": [0.0, 2.5, 0.2], "size": [0.5, 0.0, 0.5],
                    "intensity_w_sr": [9.0, 8.6, 8.0]}],
        "ambient": [0.15, 0.15, 0.16],
        "environment": [0.3, 0.32, 0.35],
        "world_from_session": WORLD_FROM_SESSION,
    }


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    models, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(models / "quest_rooms" / "office_small.glb", out / "office_small.glb")
    write_glb(out / "bunny.glb", "bunny", *read_obj(models / "scans" / "stanford-bunny.obj"))
    write_glb(out / "teapot.glb", "teapot", *read_obj(models / "scans" / "teapot.obj"))
    (out / "office.scene.json").write_text(json.dumps(scene_document(), indent=2) + "\n")
    print(out / "office.scene.json")


if __name__ == "__main__":
    main()
