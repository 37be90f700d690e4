// A file that grows by whole rows: gone on with after a cut, and left whole by a disk that fills up.
#include "sessions/files/append_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>
#include <string>

#include "sessions/files/line_reader.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(AppendFileTest, GoesOnAfterTheBytesThatAreKept) {
  const RecordedFolder folder;
  folder.write("rows", "one\ntwo\nthr");
  {
    AppendFile file(folder / "rows", 8);
    EXPECT_EQ(content(folder / "rows"), "one\ntwo\n");
    file.append("three\n");
    file.sync();
  }
  EXPECT_EQ(content(folder / "rows"), "one\ntwo\nthree\n");
  AppendFile made(folder / "new", 0);
  made.append("first\n");
  made.finish();
  EXPECT_EQ(content(folder / "new"), "first\n");
}

TEST(AppendFileTest, ARowThatTheDiskTookAPartOfIsTakenBack) {
  const RecordedFolder folder;
  AppendFile file(folder / "rows");
  file.append("first\n");
  file.flush();
  // A limit of 16 bytes ends within the third row: the write takes 10 bytes, the next one none.
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{}, tight{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  tight = before;
  tight.rlim_cur = 16;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  file.append("second\nthird\n");
  EXPECT_THROW(file.flush(), WriteError);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(content(folder / "rows"), "first\nsecond\n");
}

TEST(LineReaderTest, KnowsWhereTheNextLineBegins) {
  const RecordedFolder folder;
  const std::string text = "\xef\xbb\xbfone\r\n\ntwo\nrest";
  folder.write("lines", text);
  LineReader lines(folder / "lines", 100);
  TextLine line;
  EXPECT_EQ(lines.offset(), 3);
  for (const std::string rest : {"\ntwo\nrest", "two\nrest", "rest", ""}) {
    ASSERT_TRUE(lines.next(line));
    EXPECT_EQ(text.substr(static_cast<std::size_t>(lines.offset())), rest);
  }
  EXPECT_FALSE(lines.next(line));
}

}  // namespace
}  // namespace herr::test
