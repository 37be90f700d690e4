#!/usr/bin/env bash
# npm iwer 2.5.0 (the Immersive Web Emulation Runtime, which records and replays WebXR sessions) stores head poses in
# steps that a display of 60 pixels per degree shows as jumps of several pixels.
#
# Input: a head that turns by 0.01 degrees a frame about the vertical axis, handed to ActionRecorder frame by frame; then
#        a pose turned by 33 degrees; both played back by ActionPlayer.
# Guess: poses are kept as 32-bit floats, as WebXR delivers them, and stamps are those of the frame.
# Seen: components of position and quaternion are rounded to 0.001: near the rest pose the recorded head moves in steps of
#       0.115 degrees (7 pixels at 60 per degree), and the first six frames of this turn stand still; stamps are the
#       page's clock when recordFrame() ran, rounded to 0.1 ms, not the frame's predictedDisplayTime; quaternions come
#       back as rounded, not of unit length, and are played so.
# What follows: head angles of such a recording are good to a tenth of a degree, motion-to-photon cannot be told from
#       its stamps; normalise quaternions on import, and do not take head speed from neighbouring rows.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund iwer@2.5.0 gl-matrix@3.4.3

cat > record.mjs <<'JS'
import assert from "node:assert";
import { mat4, quat } from "gl-matrix";
import { ActionRecorder } from "iwer/lib/action/ActionRecorder.js";
import { ActionPlayer } from "iwer/lib/action/ActionPlayer.js";
import { XRReferenceSpace, XRReferenceSpaceType } from "iwer/lib/spaces/XRReferenceSpace.js";
import { P_SPACE } from "iwer/lib/private.js";

const degrees = (radians) => (radians * 180) / Math.PI;
const turned = (deg) => quat.setAxisAngle(quat.create(), [0, 1, 0], (deg * Math.PI) / 180);
const frame = (deg) => ({
  predictedDisplayTime: 123456.789,
  getViewerPose: () => ({ transform: { matrix: mat4.fromRotationTranslation(mat4.create(), turned(deg), [0, 1.6, 0]) } }),
});

const recorder = new ActionRecorder({ inputSources: [] }, null);
for (let i = 0; i < 40; ++i) recorder.recordFrame(frame(i * 0.01));
recorder.recordFrame(frame(33));
const { frames } = recorder.getRecording();
const yaws = frames.slice(0, 40).map((row) => degrees(2 * Math.atan2(row[5], row[7])));
const steps = [...new Set(yaws.map((yaw) => yaw.toFixed(3)))];
const still = yaws.slice(0, 6).filter((yaw) => yaw === 0).length;
console.log("recorded yaws of a turn from 0 to 0.39 degrees:", steps.join(" "), "degrees;", still, "of 6 frames at 0");
console.log("stamp of a frame predicted for 123456.789 ms:", frames[0][0], "ms");

const norm = Math.hypot(...frames[40].slice(4, 8));
console.log("length of the quaternion of 33 degrees:", norm.toFixed(6));
const player = new ActionPlayer(new XRReferenceSpace(XRReferenceSpaceType.Local, null), recorder.getRecording(), 0.063);
player.stepFrames(20);
const played = player.viewerSpace[P_SPACE].offsetMatrix;
const playedYaw = degrees(Math.atan2(played[8], played[10]));
console.log("frame 20, turned by 0.2 degrees, is played at", playedYaw.toFixed(3), "degrees");

assert.deepStrictEqual(steps, ["0.000", "0.115", "0.229", "0.344"], "poses have other steps now");
assert.strictEqual(still, 6);
assert.ok(frames[0][0] < 100000, "stamps are those of the frame now");
assert.ok(Math.abs(norm - 1.000168) < 1e-6, "quaternions have another length now");
assert.ok(Math.abs(playedYaw - 0.229) < 1e-3, "the player plays another pose now");
JS
node record.mjs
