// The light of a look where a model brings none, or where the user names a picture of it. Before: load_scene
// without default light. After: look_picture.
#pragma once

#include "scenes/model/scene.h"
#include "server/look/look_options.h"

namespace herr {

// The studio: a sun at the upper left behind the camera; around, a room with a bright ceiling, a soft box
// where the sun stands and a strip of light at the right, for mirrors; its mean as ambient light. A white
// surface that faces the sun has radiance 1. It turns with the camera, as if the model turned.
inline constexpr double kStudioAmbient = 0.3;
inline constexpr float kStudioBackdrop =
    0.1f;  // radiance behind the model, sRGB 89: white and black stand out

// Whether a scene has no light of its own: nothing to light it, and, but for a model that is no part of a
// document, nothing around it or in it that shines.
bool needs_studio(const Scene& scene, bool bare_model);
// Lights the scene for a camera at an azimuth; again for the next one. Sizes stay: a renderer may read it.
void light_studio(double azimuth_deg, Scene& scene);

// Puts the picture of options.environment around the scene, its mean as the ambient light; the studio's sun,
// if it shines (`studio`), keeps its share of the light. Throws InputError.
void add_environment(const LookOptions& options, bool studio, Scene& scene);

}  // namespace herr
