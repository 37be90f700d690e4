// `herr replay` on a session of a quarter of a second, in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {

class ReplayProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.25);
  }
  const std::filesystem::path& root() const { return folder_.path(); }

  // `before`: as run_program() has it.
  Outcome herr(const std::string& arguments, const std::string& before = "") const {
    return run_program(root(), arguments, before);
  }
  Outcome replay(const std::string& flags, const std::string& before = "") const {
    return replay_of("walk", with_more("--threads 2 ", flags), before);
  }
  // Direct light alone, on a small display.
  Outcome replay_of(const std::string& sessions, const std::string& flags,
                    const std::string& before = "") const {
    return herr(
        with_more("replay " + sessions + " --profile small.profile.json --preset direct --polar 128x64 ",
                  flags),
        before);
  }

  nlohmann::json summary(const std::string& out, const std::string& session = "walk") const {
    return nlohmann::json::parse(content_of(root() / out / session / "summary.json"));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace herr
