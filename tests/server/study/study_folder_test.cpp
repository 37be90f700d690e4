// What the folder of a study takes, refuses and leaves alone.
#include "server/study/study_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "server/process/exit_code.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

using Names = std::vector<std::string>;

class StudyFolderTest : public ::testing::Test {
 protected:
  void put(const std::string& name) const { write_text(root_.path() / name, "earlier"); }
  void prepare(bool overwrite, bool resume) const {
    const FolderLock lock = StudyFolder(root_.path()).prepare(overwrite, resume);
  }
  TemporaryFolder root_;
};

TEST_F(StudyFolderTest, IsMadeWithItsFolderOfReferences) {
  const StudyFolder folder(root_.path() / "a" / "study");
  const FolderLock lock = folder.prepare(false, false);
  EXPECT_TRUE(std::filesystem::is_directory(folder.references()));
  EXPECT_THROW(folder.prepare(false, true), TemporaryError);  // another one writes into it
}

TEST_F(StudyFolderTest, RefusesAnEarlierStudyUnlessToldWhatToDoWithIt) {
  for (const char* name : {"study.csv", "study.json", "study.html", "study.state.json"}) put(name);
  put("references/0123.reference");
  put("notes.txt");
  EXPECT_THROW(prepare(false, false), UsageError);
  prepare(false, true);
  EXPECT_EQ(root_.names(),
            (Names{"notes.txt", "references", "study.csv", "study.html", "study.json", "study.state.json"}));
  prepare(true, false);
  EXPECT_EQ(root_.names(), (Names{"notes.txt", "references"}));
  EXPECT_TRUE(std::filesystem::exists(root_.path() / "references/0123.reference"));
}

TEST_F(StudyFolderTest, RefusesAFolderOfOtherThingsAndLeavesThemAlone) {
  put("0123.reference");  // a folder of references that studies share
  for (const bool overwrite : {false, true}) {
    for (const bool resume : {false, true}) EXPECT_THROW(prepare(overwrite, resume), UsageError);
  }
  EXPECT_EQ(root_.names(), Names{"0123.reference"});
}

TEST_F(StudyFolderTest, TakesWhatAStudyLeftThatWasStoppedBeforeItsFirstLine) {
  put("references/0123.reference");
  prepare(false, false);
  EXPECT_TRUE(std::filesystem::exists(root_.path() / "references/0123.reference"));
}

TEST_F(StudyFolderTest, RemovesWhatAKilledStudyWasWriting) {
  put("study.csv");
  put("study.state.json.tmp.4711");
  put("references/0123.reference.tmp.4711");
  put("references/0456.reference");
  put("references/other.tmp.4711");
  prepare(false, true);
  EXPECT_EQ(root_.names(), (Names{"references", "study.csv"}));
  EXPECT_FALSE(std::filesystem::exists(root_.path() / "references/0123.reference.tmp.4711"));
  EXPECT_TRUE(std::filesystem::exists(root_.path() / "references/0456.reference"));
  EXPECT_TRUE(std::filesystem::exists(root_.path() / "references/other.tmp.4711"));
}

}  // namespace
}  // namespace herr
