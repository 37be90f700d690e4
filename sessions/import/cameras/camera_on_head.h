// Where a camera sits on the head, from where a calibration puts it on the recorded body.
// Before: aria_calibration, yaml_calibration. After: session.json's head_from_camera.
#pragma once

#include "sessions/format/pose.h"
#include "sessions/import/map/column_map.h"

namespace herr {

// `body_from_camera`: of a camera that looks along +z with y down, in the axes of the recorded body, of which
// `head` says where the head is. In our axes, as session.json has it.
Pose camera_on_head(const Pose& body_from_camera, const HeadColumns& head);

}  // namespace herr
