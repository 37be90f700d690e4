#!/usr/bin/env python3
"""`herr study --stability` holds on other people's recordings and models: a walk recorded in an office, shown over
the feed of another camera in a scanned room, or before a model that stands where the walker looks. Skipped (77) where they are absent.

test_real_scenes.py HERR office|MODEL"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TRIAL = "sessions/jov2023_vive_pro_eye/office_fixed_6_S004_T002"
SKIPPED = 77
# Where the walker's gaze dwells, metres.
PLACES = {
    "DamagedHelmet": {"translation": [0.05, 1.0, 1.1], "scale": 0.3},
    "CesiumMan": {"translation": [0.05, 0.0, 1.1], "scale": 0.7},
    "ClearCoatTest": {"translation": [0.05, 1.0, 1.1], "scale": 0.08},
    "TransmissionTest": {"translation": [0.05, 0.9, 1.1], "scale": 0.5},
}


def data_folder():
    folder = pathlib.Path(os.environ.get("HERR_TEST_DATA", ROOT.parent / "shared/data"))
    if not (folder / "sessions").is_dir():
        print("the real recordings are not here")
        sys.exit(SKIPPED)
    return folder.resolve()


def run(program, *arguments, allowed=(0,)):
    done = subprocess.run([program, *map(str, arguments)], text=True, capture_output=True, check=False)
    if done.returncode not in allowed:
        sys.exit(f"{program} {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def office(data, folder):
    run(sys.executable, ROOT / "tests/recordings/make_office_scene.py", data / "models", folder / "office")
    return folder / "office/office.scene.json"


def model(data, folder, name):
    source = data / "models/khronos_sample_assets" / name / "glTF-Binary" / f"{name}.glb"
    (folder / source.name).write_bytes(source.read_bytes())
    scene = {
        "format_version": 1, "name": name,
        "gltf": [{"file": source.name, "name": "model", "rotation_xyzw": [0, 1, 0, 0], **PLACES[name]}],
        "shapes": [
            {"name": "floor", "box": {"centre": [0, -0.05, 1], "half_extents": [3, 0.05, 3]},
             "material": {"base_colour": [0.6, 0.58, 0.5]}},
            {"name": "wall", "box": {"centre": [0, 1, 2.2], "half_extents": [3, 1.5, 0.05]},
             "material": {"base_colour": [0.6, 0.2, 0.15]}}],
        "lights": [{"name": "lamp", "centre": [0.3, 2.2, 0.6], "size": [0.6, 0.1, 0.6],
                    "intensity_w_sr": [12, 11.6, 11]}],
        "ambient": [0.1, 0.1, 0.1], "environment": [0.3, 0.32, 0.35]}
    file = folder / "model.scene.json"
    file.write_text(json.dumps(scene), encoding="utf-8")
    return file


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("herr")
    parser.add_argument("scene", choices=["office", *PLACES])
    options = parser.parse_args()
    data = data_folder()
    with tempfile.TemporaryDirectory(prefix="herr-real-") as path:
        folder = pathlib.Path(path)
        run(options.herr, "convert", data / f"{TRIAL}_head.csv", folder / "walk", "--gaze", data / f"{TRIAL}_gaze.csv",
            "--preset", "jov2023", "--camera", data / "frames/rtabmap_samples", "--camera-hz", "15", "--camera-loop",
            "--camera-hfov", "66")
        scene = office(data, folder) if options.scene == "office" else model(data, folder, options.scene)
        done = run(options.herr, "study", "--stability", folder / "walk", "--scene", scene, "--out", folder / "out",
                   allowed=(0, 1))
    print(done.stdout)
    # What most relations are about is there.
    if "of one colour" in done.stdout or "shows one colour" in done.stdout:
        sys.exit("the frame shows nothing")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
