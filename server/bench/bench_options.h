// What `herr bench` is asked to measure.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/render_settings.h"

namespace herr {

struct BenchOptions {
  std::filesystem::path session;  // empty: the shipped sample session
  std::string scene;              // empty: the scene that the session names
  std::string profile;            // empty: the profile of the session
  RenderSettings render;
  int frames = 8;   // instants of the session, spread evenly over it
  int repeats = 5;  // each instant is measured this often
  bool json = false;
};

}  // namespace herr
