// `herr check` on a session of a few kilobytes, in a folder of its own, with scripts in place of another
// build.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {

namespace fs = std::filesystem;

class ProgramCheck : public ::testing::Test {
 protected:
  const fs::path& root() const { return folder_.path(); }

  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.json");
    write_small_session(root() / "session", 0.5);
  }

  // Another build of herr: this one behind a script that changes what it says.
  void write_other(const std::string& body) {
    write_text(root() / "other", "#!/bin/sh\n" + body + "\n");
    fs::permissions(root() / "other", fs::perms::owner_all);
  }
  std::string sed(const std::string& command) const {
    return test::program_path() + " \"$@\" | sed '" + command + "'";
  }

  Outcome check(const std::string& arguments) {
    return run_program(root(), with_more("check session --profile small.json --preset direct --polar 32x16 "
                                         "--threads 1 --isa sse4 --frames 6 ",
                                         arguments));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace herr
