#include "server/results/checkpoint.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

RunState some_state() {
  RunState state;
  state.next_frame = 1500;
  state.renderer.anchor = glm::dvec3{-32, 0, 1'000'000'000};
  state.camera_stamps_ns = {TimeNs{1'000'000'001}, std::nullopt};
  state.renderer.details = {std::byte{2}, std::byte{0}};
  state.renderer.probes = {std::byte{0}, std::byte{255}, std::byte{17}, std::byte{3}};
  state.sanitised_camera_values = 7;
  state.skipped_images = 2;
  state.warnings = {"a \"quoted\" name", "b"};
  return state;
}

Fingerprint some_fingerprint() {
  return {{{"--light-samples", "64"}, {"--isa", "avx2"}}, {{"session.json", "300 bytes, crc32 1"}}};
}

TEST(Checkpoint, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.json";
  const RunState state = some_state();
  write_whole_file(file, checkpoint_text(some_fingerprint(), state));
  const Checkpoint read = read_checkpoint(file);
  EXPECT_EQ(difference(read.fingerprint, some_fingerprint()), "");
  EXPECT_EQ(read.state.next_frame, state.next_frame);
  EXPECT_EQ(read.state.renderer.anchor, state.renderer.anchor);
  EXPECT_EQ(read.state.renderer.probes, state.renderer.probes);
  EXPECT_EQ(read.state.renderer.details, state.renderer.details);
  EXPECT_EQ(read.state.camera_stamps_ns, state.camera_stamps_ns);
  EXPECT_EQ(read.state.sanitised_camera_values, 7);
  EXPECT_EQ(read.state.skipped_images, 2);
  EXPECT_EQ(read.state.warnings, state.warnings);
}

// The one line that reading `text` ends with; empty when it was read.
std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  write_whole_file(folder.path() / "checkpoint.json", text);
  try {
    read_checkpoint(folder.path() / "checkpoint.json");
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Checkpoint, CutAtAnyByteIsCalledDamagedInOneLine) {
  const std::string text = checkpoint_text(some_fingerprint(), some_state());
  ASSERT_EQ(complaint(text), "");
  // The last two bytes are the closing brace and the line break.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    const std::string line = complaint(text.substr(0, length));
    EXPECT_NE(line.find("checkpoint.json: is damaged"), std::string::npos) << length << ": " << line;
    EXPECT_NE(line.find("; give --overwrite"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(Checkpoint, AWrongValueIsNamed) {
  const std::string text = checkpoint_text(some_fingerprint(), some_state());
  const auto with = [&text](const std::string& part, const std::string& other) {
    std::string changed = text;
    changed.replace(changed.find(part), part.size(), other);
    return complaint(changed);
  };
  EXPECT_NE(with("\"format_version\": 1", "\"format_version\": 2").find("later version"), std::string::npos);
  EXPECT_NE(with("1500", "-1").find("next_frame is -1"), std::string::npos);
  EXPECT_NE(with("-32", "-3200000000").find("anchor_m"), std::string::npos);
  EXPECT_NE(with("\"64\"", "64").find("settings has a value that is no text"), std::string::npos);
  EXPECT_NE(with("skipped_images", "skiped_images").find("skiped_images"), std::string::npos);
}

TEST(Fingerprint, TellsTheFirstDifference) {
  const Fingerprint now = some_fingerprint();
  Fingerprint earlier = now;
  EXPECT_EQ(difference(earlier, now), "");
  earlier.settings[0].second = "1";
  EXPECT_EQ(difference(earlier, now), "--light-samples was 1, is 64");
  earlier = now;
  earlier.inputs[0].second = "300 bytes, crc32 2";
  EXPECT_EQ(difference(earlier, now), "session.json has changed");
  earlier.inputs.clear();
  EXPECT_EQ(difference(earlier, now), "session.json was not among the inputs");
  EXPECT_EQ(difference(now, earlier), "session.json is no longer among the inputs");
}

}  // namespace
}  // namespace herr
