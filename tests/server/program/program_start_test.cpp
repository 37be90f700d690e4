// What the program loads at its start, where it finds its picture module, and what it says when it does not.
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/output/float_exr.h"
#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "tests/missing_tool.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleName = "herr_pictures.so";

fs::path build_folder() {
  return fs::path(test::program_path()).parent_path().parent_path();
}

fs::path module_file() {
  return build_folder() / "lib" / "herr" / kModuleName;
}

class Start : public ::testing::Test {
 protected:
  const fs::path& root() const { return folder_.path(); }
  void make_session() const {
    write_small_scene(root() / "scene");
    write_small_session(root() / "session", 0.3);
  }
  void make_exr_session() const {
    make_session();
    give_exr_pictures();
  }
  // In place of PNG: they are decoded by the module.
  void give_exr_pictures() const {
    FloatPlanes grey{64, 48, {}, {}};
    for (const char* name : {"R", "G", "B"})
      grey.channels.emplace_back(name, std::vector<float>(std::size_t{64} * 48, 0.25f));
    std::vector<std::uint8_t> exr;
    encode_float_exr(grey, exr);
    const fs::path camera = root() / "session/cam0";
    for (const std::string& name : files_below(camera / "data"))
      write_whole_file(camera / "data" / fs::path(name).replace_extension(".exr"), exr);
    std::string rows = content_of(camera / "data.csv");
    for (std::size_t at = 0; (at = rows.find(".png", at)) != std::string::npos;) rows.replace(at, 4, ".exr");
    write_whole_file(camera / "data.csv", rows);
  }
  // The program, copied to `to` below the root.
  fs::path copy_program(const std::string& to) const {
    fs::create_directories(root() / to);
    fs::copy_file(test::program_path(), root() / to / "herr");
    return root() / to / "herr";
  }
  Outcome decode_with(const fs::path& program) const {
    return run_line(root(), "'" + program.string() + "' inspect session --decode");
  }
  void expect_refused(const fs::path& program, const std::string& part) const {
    const Outcome got = decode_with(program);
    EXPECT_EQ(got.exit_code, kExitInternal) << got.err;
    EXPECT_EQ(lines_in(got.err), 1) << got.err;
    EXPECT_EQ(got.err.find("herr: "), 0u) << got.err;
    for (const std::string& each : {std::string(kModuleName), part, std::string("; install ")})
      EXPECT_NE(got.err.find(each), std::string::npos) << got.err << " lacks " << each;
    EXPECT_EQ(run_line(root(), "'" + program.string() + "' --version").exit_code, 0);
    EXPECT_EQ(run_line(root(), "'" + program.string() + "' inspect session").exit_code, 0);
  }
  // What the dynamic linker says that it loads for `herr ARGUMENTS`.
  std::string loads_of(const std::string& arguments, int exit_code) const {
    const Outcome got = run_program(root(), arguments, "LD_DEBUG=files LD_DEBUG_OUTPUT=loads");
    EXPECT_EQ(got.exit_code, exit_code) << got.err;
    std::string loads;
    for (const std::string& name : files_below(root())) {
      if (!name.starts_with("loads.")) continue;
      loads += content_of(root() / name);
      fs::remove(root() / name);
    }
    EXPECT_NE(loads.find("libstdc++"), std::string::npos) << "nothing was written down";
    return loads;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Start, NeedsNoPictureLibraryForWhatDecodesNothing) {
  make_session();
  struct {
    const char* arguments;
    int exit_code;
  } const kCommands[] = {{"--version", 0},       {"--help", 0},
                         {"replay --help", 0},   {"replay --sceen x", kExitUsage},
                         {"inspect session", 0}, {"inspect nowhere", kExitBadInput}};
  for (const auto& [arguments, exit_code] : kCommands) {
    const std::string loads = loads_of(arguments, exit_code);
    EXPECT_EQ(loads.find("libOpenImageIO"), std::string::npos) << arguments;
    EXPECT_EQ(loads.find(kModuleName), std::string::npos) << arguments;
  }
  // PNG by libpng.
  EXPECT_EQ(loads_of("inspect session --decode", 0).find("libOpenImageIO"), std::string::npos);
  give_exr_pictures();
  EXPECT_NE(loads_of("inspect session --decode", 0).find("libOpenImageIO"), std::string::npos);
}

TEST_F(Start, ReadsHeadersOfTexturesAloneToDescribeAScene) {
  if (!fs::exists(test::source_dir() + "/scenes/samples/generated/room.glb"))
    HERR_MISSING_TOOL("the sample scenes are not generated");
  const std::string sample = "'" + test::source_dir() + "/sessions/samples/desk-walk'";
  EXPECT_EQ(loads_of("inspect " + sample, 0).find("libOpenImageIO"), std::string::npos);
  const Outcome described = run_program(root(), "inspect " + sample + " --json");
  const Outcome decoded = run_program(root(), "inspect " + sample + " --json --decode");
  EXPECT_EQ(decoded.exit_code, 0) << decoded.err;
  const auto facts = [](const Outcome& outcome) { return nlohmann::json::parse(outcome.out).at("scene"); };
  EXPECT_EQ(facts(described), facts(decoded));
}

TEST_F(Start, FindsTheModuleBesideItself) {
  make_exr_session();
  const fs::path program = copy_program("elsewhere");
  fs::copy_file(module_file(), root() / "elsewhere" / kModuleName);
  const Outcome got = decode_with(program);
  EXPECT_EQ(got.exit_code, 0) << got.err;
}

TEST_F(Start, FindsTheModuleWhereItIsInstalledAndThroughALink) {
  make_exr_session();
  const std::string installing =
      "cmake --install '" + build_folder().string() + "' --prefix '" + root().string() + "/opt' --strip";
  const Outcome installed = run_line(root(), installing);
  ASSERT_EQ(installed.exit_code, 0) << installed.out << installed.err;
  const Outcome got = decode_with(root() / "opt/bin/herr");
  EXPECT_EQ(got.exit_code, 0) << got.err;
  fs::create_symlink(root() / "opt/bin/herr", root() / "linked");
  EXPECT_EQ(decode_with(root() / "linked").exit_code, 0);
}

TEST_F(Start, SaysInOneLineThatTheModuleIsMissing) {
  make_exr_session();
  expect_refused(copy_program("alone"), "is not there");
}

TEST_F(Start, RefusesWhatIsNoModuleOfThisProgram) {
  make_exr_session();
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const auto with = [&](const std::string& folder, const fs::path& module) {
    const fs::path program = copy_program(folder);
    fs::copy_file(module, root() / folder / kModuleName);
    return program;
  };
  expect_refused(with("interface", here / "other_interface_module.so"), "belongs to another version of herr");
  expect_refused(with("program", here / "other_program_module.so"), "belongs to herr 0.0.1");
  expect_refused(with("text", root() / "session/session.json"), "cannot be loaded");
}

// A chunk of a PNG with the checksum that belongs to it.
std::string chunk(const std::string& type_and_data) {
  const auto word = [](std::uint64_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
  };
  const auto* data = reinterpret_cast<const Bytef*>(type_and_data.data());
  return word(type_and_data.size() - 4) + type_and_data +
         word(::crc32(0, data, static_cast<uInt>(type_and_data.size())));
}

// Sound in every chunk, so that only the library can find the fault.
TEST_F(Start, NamesThePictureThatCannotBeDecoded) {
  make_session();
  const std::string header("IHDR\0\0\0\x40\0\0\0\x30\x08\x02\0\0\0", 17);
  const std::string png =
      "\x89PNG\r\n\x1a\n" + chunk(header) + chunk("IDATno stream of zlib") + chunk("IEND");
  std::string picture;
  for (const std::string& name : files_below(root() / "session"))
    if (name.ends_with("000001.png")) picture = name;
  ASSERT_NE(picture, "");
  write_whole_file(root() / "session" / picture, png);
  EXPECT_EQ(run_program(root(), "inspect session").exit_code, 0) << "its header is good";
  const Outcome inspected = run_program(root(), "inspect session --decode");
  EXPECT_EQ(inspected.exit_code, kExitBadInput);
  const Outcome replayed = run_program(
      root(), "replay session --profile xr1-half --polar 64x32 --format none --contact-sheet none --out out");
  EXPECT_EQ(replayed.exit_code, kExitBadInput);
  const std::string& line = replayed.err;
  EXPECT_EQ(line.find("herr: "), 0u) << line;
  EXPECT_EQ(lines_in(line), 1) << line;
  EXPECT_NE(line.find("000001.png"), std::string::npos) << line;
  EXPECT_NE(line.find("does not decode"), std::string::npos) << line;
}

}  // namespace
}  // namespace herr
