// The light of a look where a model brings none, or where the user names a picture of it. Before: load_scene
// without default light. After: look_picture.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "server/look/look_options.h"

namespace herr {

// A model without light of its own stands in a studio: ambient and environment kStudioAmbient, and a sun at
// the upper left behind the camera, such that a white surface that faces it has radiance 1.
inline constexpr double kStudioAmbient = 0.3;

// Puts the environment of options.environment, if any, around the scene, its mean as the ambient light.
// Throws InputError.
void add_environment(const LookOptions& options, Scene& scene);
// Whether light has to be made.
bool needs_studio(const Scene& scene);
// The studio's lights for a camera at an azimuth: they turn with it, as if the model turned.
std::vector<AreaLight> studio_lights(double azimuth_deg);

}  // namespace herr
