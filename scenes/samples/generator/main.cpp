// herr-make-scenes DIRECTORY: writes the meshes of the sample scenes and prints what they hold.
// Exit codes: 0 done, 2 usage, 70 a mesh broke its rules or could not be written.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "scenes/samples/generator/objects/objects.h"
#include "scenes/samples/generator/shapes/mesh_check.h"

namespace {

namespace samples = herr::samples;

// The paper's scene holds 290k triangles in nine objects (section 4.1).
constexpr double kGeneralTriangles = 290'000.0, kTolerance = 0.01;
constexpr std::size_t kRoomTrianglesAtMost = 5'000;

// Checks and writes one mesh file; returns how many triangles it has.
std::size_t make(const std::filesystem::path& folder, const char* file, const samples::GlbObject& object) {
  for (const samples::GlbPart& part : object.parts) {
    samples::check_mesh(object.name + ", " + part.material.name, part.mesh);
  }
  samples::write_glb(folder / file, object);
  const std::size_t triangles = samples::triangle_count(object);
  std::printf("%8zu  %s\n", triangles, file);
  return triangles;
}

// The same for one of the nine objects, which must have their outside outwards.
std::size_t make_solid(const std::filesystem::path& folder, const char* file,
                       const samples::GlbObject& object) {
  double volume_m3 = 0.0;
  for (const samples::GlbPart& part : object.parts) volume_m3 += samples::enclosed_volume_m3(part.mesh);
  if (!(volume_m3 > 0.0)) throw std::runtime_error("generated object '" + object.name + "' is inside out");
  return make(folder, file, object);
}

void make_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::size_t total = 0;
  total += make_solid(folder, "teapot.glb", samples::teapot());
  total += make_solid(folder, "vase.glb", samples::vase());
  total += make_solid(folder, "statue.glb", samples::statue());
  total += make_solid(folder, "plant.glb", samples::plant());
  total += make_solid(folder, "hare.glb", samples::hare());
  total += make_solid(folder, "knot.glb", samples::knot());
  total += make_solid(folder, "shell.glb", samples::shell());
  total += make_solid(folder, "chair.glb", samples::chair());
  total += make_solid(folder, "armillary_sphere.glb", samples::armillary_sphere());
  std::printf("%8zu  triangles in the nine objects of general.scene.json\n", total);
  if (std::abs(static_cast<double>(total) / kGeneralTriangles - 1.0) > kTolerance) {
    throw std::runtime_error("the general scene must have 290000 triangles within 1 %");
  }
  make(folder, "quality_boards.glb", samples::quality_boards());
  if (make(folder, "room.glb", samples::room()) > kRoomTrianglesAtMost) {
    throw std::runtime_error("the room must have at most 5000 triangles");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: herr-make-scenes DIRECTORY\n");
    return 2;
  }
  try {
    make_all(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "herr-make-scenes: %s\n", error.what());
    return 70;
  }
  return 0;
}
