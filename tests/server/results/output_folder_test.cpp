#include "server/results/output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

TEST(OutputFolder, NamesFilesByFrame) {
  const OutputFolder folder("out", "/data/desk-walk/");
  EXPECT_EQ(folder.path(), fs::path("out/desk-walk"));
  EXPECT_EQ(folder.picture(60, ".exr"), fs::path("out/desk-walk/frames/frame_000060.exr"));
  EXPECT_EQ(folder.picture(1234567, ".left_focus.png"),
            fs::path("out/desk-walk/frames/frame_1234567.left_focus.png"));
  EXPECT_EQ(folder.contact_sheet(60), fs::path("out/desk-walk/contact_sheet_000060.png"));
}

TEST(OutputFolder, AFolderWithContentNeedsOverwrite) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path() / "out", root.path() / "walk");
  EXPECT_NO_THROW(folder.check(EarlierResults::refuse));
  fs::create_directories(root.path() / "out" / "walk");
  EXPECT_NO_THROW(folder.check(EarlierResults::refuse));
  touch(root.path() / "out" / "walk" / "notes.txt");
  try {
    folder.check(EarlierResults::refuse);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("--overwrite"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(folder.check(EarlierResults::replace));
}

// A summary without frames is of a session that was refused before its first one; anybody else's is not.
TEST(OutputFolder, OneWithTheSummaryOfARefusedSessionAloneIsFree) {
  const TemporaryFolder root;
  const fs::path out = root.path() / "out" / "walk";
  const OutputFolder folder(root.path() / "out", root.path() / "walk");
  EXPECT_TRUE(folder.is_free());
  fs::create_directories(out);
  EXPECT_TRUE(folder.is_free());
  std::ofstream(out / "summary.json") << R"({"state": "failed", "error": "x"})";
  EXPECT_TRUE(folder.is_free());
  EXPECT_NO_THROW(folder.check(EarlierResults::refuse));
  EXPECT_NO_THROW(folder.check(EarlierResults::resume));
  std::ofstream(out / "summary.json") << R"({"state": "failed", "frames": {"rendered": 3}})";
  EXPECT_FALSE(folder.is_free());
  std::ofstream(out / "summary.json") << "x";
  EXPECT_FALSE(folder.is_free());
  std::ofstream(out / "summary.json") << R"({"state": "failed", "error": "x"})";
  touch(out / "notes.txt");
  EXPECT_FALSE(folder.is_free());
  EXPECT_THROW(folder.check(EarlierResults::refuse), UsageError);
}

TEST(OutputFolder, AResumedReplayNeedsACheckpointWhereThereAreResults) {
  const TemporaryFolder root;
  const fs::path out = root.path() / "out" / "walk";
  const OutputFolder folder(root.path() / "out", root.path() / "walk");
  EXPECT_NO_THROW(folder.check(EarlierResults::resume));
  touch(out / "notes.txt");
  touch(out / "checkpoint.json.tmp.999999999");  // killed while it wrote its first file
  EXPECT_NO_THROW(folder.check(EarlierResults::resume));
  touch(out / "frames.csv");
  EXPECT_THROW(folder.check(EarlierResults::resume), UsageError);
  touch(out / "checkpoint.json");
  EXPECT_NO_THROW(folder.check(EarlierResults::resume));
}

TEST(OutputFolder, ResumingRemovesTemporaryFilesAndKeepsResults) {
  const TemporaryFolder root;
  const fs::path out = root.path() / "out" / "walk";
  for (const char* name : {"frames.csv", "checkpoint.json", "frames/frame_000000.exr",
                           "frames/frame_000001.exr.tmp.999999999", "thesis.doc.tmp.999999999"}) {
    touch(out / name);
  }
  OutputFolder(root.path() / "out", root.path() / "walk").prepare(PictureFormat::exr, EarlierResults::resume);
  EXPECT_FALSE(fs::exists(out / "frames/frame_000001.exr.tmp.999999999"));
  for (const char* name :
       {"frames.csv", "checkpoint.json", "frames/frame_000000.exr", "thesis.doc.tmp.999999999"}) {
    EXPECT_TRUE(fs::exists(out / name)) << name;
  }
}

TEST(OutputFolder, OneProcessAtATimeWrites) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path() / "out", root.path() / "walk");
  const FolderLock lock = folder.prepare(PictureFormats(), EarlierResults::replace);
  touch(folder.frames_csv());
  EXPECT_THROW((void)folder.prepare(PictureFormats(), EarlierResults::replace), TemporaryError);
  EXPECT_TRUE(fs::exists(folder.frames_csv()));
}

TEST(OutputFolder, AFileInThePlaceOfTheFolderAndAFolderInsideTheSessionAreRefused) {
  const TemporaryFolder root;
  touch(root.path() / "out" / "walk");
  EXPECT_THROW(OutputFolder(root.path() / "out", root.path() / "walk").check(EarlierResults::replace),
               UsageError);
  fs::create_directories(root.path() / "sessions" / "walk");
  EXPECT_THROW(OutputFolder(root.path() / "sessions" / "walk" / "out", root.path() / "sessions" / "walk")
                   .check(EarlierResults::replace),
               UsageError);
  // DIR/<session name> is the session itself when --out is the folder that holds the session.
  EXPECT_THROW(OutputFolder(root.path() / "sessions", root.path() / "sessions" / "walk")
                   .check(EarlierResults::replace),
               UsageError);
}

TEST(OutputFolder, OverwritingRemovesEarlierResultsAndNothingElse) {
  const TemporaryFolder root;
  const fs::path out = root.path() / "out" / "walk";
  for (const char* name :
       {"frames.csv", "summary.json", "checkpoint.json", "contact_sheet_000001.png", "notes.txt", "photo.png",
        "frames/frame_000000.exr", "frames/frame_000000.left_focus.png", "frames/my_frame.png",
        "summary.json.tmp.999999999"}) {
    touch(out / name);
  }
  OutputFolder(root.path() / "out", root.path() / "walk").prepare(PictureFormats(), EarlierResults::replace);
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
  EXPECT_TRUE(fs::exists(out / "photo.png"));
  EXPECT_TRUE(fs::exists(out / "frames/my_frame.png"));
  for (const char* name :
       {"frames.csv", "summary.json", "checkpoint.json", "contact_sheet_000001.png",
        "frames/frame_000000.exr", "frames/frame_000000.left_focus.png", "summary.json.tmp.999999999"}) {
    EXPECT_FALSE(fs::exists(out / name)) << name;
  }
}

TEST(OutputFolder, TemporaryFilesOfRunningProcessesAreLeftAlone) {
  EXPECT_FALSE(is_replay_result("frames.csv.tmp.1"));  // process 1 always runs
  EXPECT_TRUE(is_replay_result("frames.csv.tmp.999999999"));
  EXPECT_FALSE(is_replay_result("thesis.doc.tmp.999999999"));
}

TEST(OutputFolder, ATemporaryFileWithOurOwnNumberIsLeftFromAnEarlierRun) {
  // Process numbers repeat: in a container every run has the same one.
  const TemporaryFolder root;
  const std::string own = "frames.csv.tmp." + std::to_string(::getpid());
  touch(root.path() / "out" / "walk" / own);
  const OutputFolder folder(root.path() / "out", root.path() / "walk");
  folder.prepare(PictureFormats(), EarlierResults::replace);
  EXPECT_FALSE(fs::exists(folder.path() / own));
  EXPECT_NO_THROW(AtomicFile(folder.frames_csv()).write("x"));
}

TEST(OutputFolder, AFolderThatCannotBeMadeIsAUsageError) {
  const TemporaryFolder root;
  touch(root.path() / "file");
  EXPECT_THROW(OutputFolder(root.path() / "file" / "deep", "walk")
                   .prepare(PictureFormat::png, EarlierResults::replace),
               UsageError);
}

}  // namespace
}  // namespace herr
