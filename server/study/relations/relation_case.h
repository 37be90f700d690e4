// One frame that relations are asked of, as a value: a scene as it stood at a moment, the eye, the display
// and the settings. A relation copies it, changes the copy, and compares pictures. Before: an instant of a
// session. After: groups of relations.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "server/study/error/linear_picture.h"
#include "sessions/streams/session_options.h"

namespace herr {

struct RelationCase {
  Scene scene;  // nothing in it moves by itself any more: instances and lights are where they were
  SceneState state;
  FrameSample sample;
  DisplayProfile profile;         // a quarter of the pixels per axis or fewer: many pictures are made
  RenderSettings settings;        // of the run, with polar buffers as much smaller
  bool camera = false;            // the session's feed is shown; then `sample` holds its image
  std::filesystem::path session;  // where it was read from
  SessionOptions reading;         // and how
};

FramePlan plan_of(const RelationCase& subject);

// Of the case as it is now; it must outlive the renderer. Its probes have gathered light until they rest.
std::unique_ptr<Renderer> renderer_of(const RelationCase& subject);

// One frame by a new renderer: one picture for each viewport, values as they are (white = 1, not limited).
std::vector<LinearPicture> picture_of(const RelationCase& subject);
// By a renderer of `subject`: its next frame. With a seed: by the random numbers of that one, probes as they
// are.
std::vector<LinearPicture> next_picture(Renderer& renderer, const RelationCase& subject);
std::vector<LinearPicture> picture_of_seed(Renderer& renderer, const RelationCase& subject,
                                           std::uint32_t seed);

// Cases that several groups ask. All without a camera feed.
RelationCase hard_light(
    RelationCase subject);  // one sample in the middle of each light; no probes, no occlusion
RelationCase soft_light(RelationCase subject, int samples);  // the same with `samples` of them, none adaptive
RelationCase all_light(
    RelationCase subject);  // soft light of 4, probes of the scene's grid, one occlusion ray

}  // namespace herr
