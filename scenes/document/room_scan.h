// Room scans of a headset as catchers: the labelled planes and boxes that Meta Quest stores of a room.
// Before: scene_document names the file. After: Scene::meshes and Scene::instances, each a catcher.
// A scan's plane spans x and z of its own frame, its front along -y; a box spans all three axes. What only
// hangs on a wall (pictures, windows, doors), a plane that is the top of a box with the same label, and the
// scanned mesh itself are left out.
#pragma once

#include <filesystem>
#include <glm/mat4x3.hpp>

#include "scenes/model/scene.h"

namespace herr {

inline constexpr std::size_t kMostScanParts = 4096;

// Appends the parts of a scan with `material`, placed by `world_from_scan`; instances are called by the
// material and their label, "room/TABLE". Throws InputError that names the file and field.
void append_room_scan(const std::filesystem::path& file, const glm::dmat4x3& world_from_scan,
                      const Material& material, Scene& scene);

}  // namespace herr
