// Copies of a session with other stamps, and what is asked of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "server/study/relations/place/shifted_session.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "sessions/format/session_header.h"
#include "sessions/session.h"
#include "tests/server/small_session.h"
#include "tests/server/study/relations/light/lit_case.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

class StampsRelationsTest : public testing::Test {
 protected:
  void SetUp() override {
    write_small_session(folder_ / "session", 0.5);
    // Columns in any order; further ones are ignored.
    write_text(folder_ / "session/gaze/data.csv",
               "extra,lx,ly,lz,l_valid,timestamp_ns,rx,ry,rz,r_valid\n"
               "7,0,0,-1,1,1000000001,0,0,-1,1\n"
               "7,0.1,0,-0.995,1,1300000001,0.1,0,-0.995,1\n");
    write_text(folder_ / "session/events.jsonl",
               "{\"t_ns\": 1200000000, \"op\": \"remove\", \"name\": \"triangle\"}\n");
  }
  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

std::string text_of(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST_F(StampsRelationsTest, ACopyHasEveryStampMovedAndNoFeedAndGoesWithItsObject) {
  const StampSpan span = stamps_of(folder_ / "session");
  EXPECT_EQ(span.first_ns, 1'000'000'000);
  const TimeNs shift_ns = kLastStampNs - span.last_ns;
  std::filesystem::path copy;
  {
    const ShiftedSession shifted(folder_ / "session", shift_ns);
    copy = shifted.folder();
    const std::string gaze = text_of(copy / "gaze/data.csv");
    EXPECT_NE(gaze.find("\n7,0,0,-1,1," + std::to_string(1'000'000'001 + shift_ns) + ",0,0,-1,1\n"),
              std::string::npos)
        << gaze;
    EXPECT_NE(text_of(copy / "events.jsonl").find(std::to_string(1'200'000'000 + shift_ns)),
              std::string::npos);
    const Session session = Session::open(copy);
    EXPECT_EQ(session.start_ns(), 1'000'000'000 + shift_ns);
    EXPECT_EQ(session.end_ns(), span.last_ns + shift_ns);
    EXPECT_TRUE(session.header().cameras.empty());
  }
  EXPECT_FALSE(std::filesystem::exists(copy));
}

TEST_F(StampsRelationsTest, HoldOnASmallSession) {
  RelationCase subject = test::case_of(test::lit_scene());
  subject.session = folder_ / "session";
  subject.sample.t_ns = subject.sample.start_ns = 1'000'000'000;
  subject.sample.t_ns += 100'000'000;
  RelationLog log;
  measure_stamps(subject, log);
  EXPECT_EQ(log.results().size(), 6u);
  for (const RelationResult& result : log.results()) {
    EXPECT_TRUE(result.asked() && result.holds())
        << result.relation.name << ": " << result.error << " " << result.where;
  }
}

}  // namespace
}  // namespace herr
