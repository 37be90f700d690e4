// Whole sessions: what opening says about folders and cameras, frames of the camera feed, scene events.
#include "sessions/session.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::kCameraHeader;
using test::RecordedFolder;

constexpr TimeNs kMs = 1'000'000;

TEST(OpeningASession, SaysWhatIsWrongWithTheFolder) {
  const RecordedFolder folder;
  EXPECT_INPUT_ERROR(Session::open(folder / "absent"), "there is no such session folder");
  folder.write("file", "x");
  EXPECT_INPUT_ERROR(Session::open(folder / "file"), "is not a folder");
  EXPECT_INPUT_ERROR(Session::open(folder / "file"), "a recording is made a session by 'herr convert ");
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "holds no session.json");
  folder.write("session.json", test::header_json());
  EXPECT_INPUT_ERROR(Session::open(folder.path()),
                     "pose/data.csv: does not exist, and a session needs the poses of the head");
  std::filesystem::create_directories(folder / "pose/data.csv");
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "is a folder, not a file");
  std::filesystem::remove(folder / "pose/data.csv");
  ASSERT_EQ(::mkfifo((folder / "pose/data.csv").c_str(), 0600), 0);
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "is not a regular file");
}

TEST(OpeningASession, AFolderOfSessionsNamesThem) {
  const RecordedFolder folder;
  folder.write("walk/session.json", test::header_json());
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "name the session in it: walk");
  folder.write("desk/session.json", test::header_json());
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "name one of the sessions in it: desk, walk");
  for (const char* name : {"a", "b", "c", "d"}) folder.write(std::string(name) + "/session.json", "{}");
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "a, b, c, d, desk and 1 more");
}

// Rows of the same orientation, as the file has it.
std::string poses_that_look(const std::string& quaternion, int rows) {
  std::string text = test::kPoseHeader;
  for (int i = 0; i < rows; ++i) text += std::to_string(i * 10 * kMs) + ",0,1.6,0," + quaternion + "\n";
  return text;
}

TEST(OpeningASession, AHeadThatIsUpsideDownIsAWarning) {
  const RecordedFolder folder;
  folder.write("session.json", test::header_json());
  // Half a turn about z, as where w is written first: up points down.
  folder.write("pose/data.csv", poses_that_look("0,0,1,0", 30));
  const auto warnings = [&] { return Session::open(folder.path()).findings().warnings; };
  const auto tells = [](const std::vector<std::string>& lines) {
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find("the head is upside down in 100 % of the rows") != std::string::npos;
    });
  };
  EXPECT_EQ(tells(warnings()), 1);
  folder.write("pose/data.csv", poses_that_look("0,0,0,1", 30));
  EXPECT_EQ(tells(warnings()), 0);
  folder.write("pose/data.csv", poses_that_look("0,0,1,0", 10));
  EXPECT_EQ(tells(warnings()), 0) << "ten rows say too little";
}

TEST(OpeningASession, GazeThatTheHeaderSaysWasNotRecordedIsNoWarning) {
  const RecordedFolder folder;
  write_good_session(folder);
  std::filesystem::remove_all(folder / "gaze");
  const auto told = [&] {
    const std::vector<std::string> lines = Session::open(folder.path()).findings().warnings;
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find("gaze/data.csv") != std::string::npos;
    });
  };
  EXPECT_EQ(told(), 1);
  folder.write("session.json", test::header_json("\"conversion\": {\"still\": [\"gaze\"]}"));
  EXPECT_EQ(told(), 0);
}

TEST(OpeningASession, NarrowsTheSpanAsTheHeaderSays) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("session.json", test::header_json("\"start_ns\": 15000000, \"end_ns\": 70000000"));
  Session session = Session::open(folder.path());
  EXPECT_EQ(session.start_ns(), 15 * kMs);
  EXPECT_EQ(session.end_ns(), 70 * kMs);
  EXPECT_THROW(session.sample(14 * kMs), std::logic_error);
  EXPECT_EQ(session.sample(15 * kMs).head.stamp_ns, 10 * kMs);
  folder.write("session.json", test::header_json("\"start_ns\": 90000001"));
  EXPECT_INPUT_ERROR(Session::open(folder.path()), "leaves nothing to replay");
}

// Frames at 5, 25 and 45 ms; the head moves 1 m/s along x.
void write_camera(const RecordedFolder& folder, int count = 1) {
  write_good_session(folder);
  folder.write("session.json", test::header_json(test::cameras_json(count, 6, 4)));
  for (int i = 0; i < count; ++i) {
    const std::string camera = "cam" + std::to_string(i);
    folder.write(camera + "/data.csv", kCameraHeader + "5000000,a.png\n25000000,b.jpg\n45000000,c.exr\n");
    folder.write_image(camera + "/data/a.png", 6, 4, 0.25);
    folder.write_image(camera + "/data/b.jpg", 6, 4);
    folder.write_image(camera + "/data/c.exr", 6, 4);
  }
}

TEST(CameraFeed, ShowsTheNewestFrameDecodedOnceWithItsExposurePose) {
  const RecordedFolder folder;
  write_camera(folder);
  Session session = Session::open(folder.path());
  EXPECT_EQ(session.findings().camera_rows[0], 3);
  EXPECT_FALSE(session.sample(4 * kMs).cameras[0]) << "no frame yet";
  const FrameSample first = session.sample(10 * kMs);
  ASSERT_TRUE(first.cameras[0] && first.cameras[1]);
  EXPECT_EQ(first.cameras[0]->stamp_ns, 5 * kMs);
  EXPECT_EQ(first.cameras[0]->age_ns, 5 * kMs);
  EXPECT_EQ(first.cameras[0]->model, &session.header().cameras[0].model);
  EXPECT_EQ(first.cameras[0]->image, first.cameras[1]->image) << "one camera serves both eyes";
  // Half-way between the poses of 0 and 10 ms, x = 0 and 0.01, and the camera 0.1 m to the right of the head.
  EXPECT_NEAR(first.cameras[0]->world_from_camera.position.x, 0.105, 1e-16);
  const FrameSample second = session.sample(24 * kMs);
  EXPECT_EQ(second.cameras[0]->image, first.cameras[0]->image) << "the same frame is not decoded again";
  EXPECT_EQ(second.cameras[0]->age_ns, 19 * kMs);
  EXPECT_EQ(session.sample(80 * kMs).cameras[0]->stamp_ns, 45 * kMs) << "a frame in between is passed over";
}

TEST(CameraFeed, OfTwoCamerasGoesToEachEye) {
  const RecordedFolder folder;
  write_camera(folder, 2);
  folder.write("cam1/data.csv", kCameraHeader + "7000000,a.png\n");
  Session session = Session::open(folder.path());
  const FrameSample frame = session.sample(20 * kMs);
  EXPECT_EQ(frame.cameras[0]->stamp_ns, 5 * kMs);
  EXPECT_EQ(frame.cameras[1]->stamp_ns, 7 * kMs);
  // 0.007 m of head motion at 7 ms, the second camera 0.2 m to the right.
  EXPECT_NEAR(frame.cameras[1]->world_from_camera.position.x, 0.207, 1e-16);
}

TEST(CameraFeed, IsRefusedForNamesThatLeaveItsFolder) {
  const RecordedFolder folder;
  write_camera(folder);
  folder.write_image("secret.png", 6, 4);
  std::filesystem::create_symlink(folder / "secret.png", folder / "cam0/data/link.png");
  std::filesystem::create_symlink("loop.png", folder / "cam0/data/loop.png");
  const struct {
    std::string name, part;
  } cases[] = {
      {"../../secret.png", "leads out of the folder"},
      {"x/../../../secret.png", "leads out of the folder"},
      {(folder / "secret.png").string(), "is an absolute path"},
      {"link.png", "is a link that leads out of the folder"},
      {"loop.png", "cannot be reached: Too many levels of symbolic links"},
      {"./a.png", "has an empty part"},
      {std::string("a.png\0.jpg", 10), "holds a control character"},
      {"..\\a.png", "holds a backslash"},
      {"absent.png", "cannot be reached: No such file"},
      {"", "the filename is empty"},
  };
  for (const auto& [name, part] : cases) {
    folder.write("cam0/data.csv", kCameraHeader + "5000000," + name + "\n");
    EXPECT_INPUT_ERROR(Session::open(folder.path()), part) << name;
    EXPECT_INPUT_ERROR(Session::open(folder.path()), "data.csv:2: ") << name;
  }
}

TEST(CameraFeed, IsRefusedForImagesOfAnotherSize) {
  const RecordedFolder folder;
  write_camera(folder);
  folder.write_image("cam0/data/b.jpg", 4, 6);
  EXPECT_INPUT_ERROR(Session::open(folder.path()),
                     "data.csv:3: image 'b.jpg' has 4 x 6 pixels where the intrinsics");
}

TEST(CameraFeed, KeepsTheFrameBeforeABadOneWhenToldToKeepGoing) {
  const RecordedFolder folder;
  write_camera(folder);
  std::filesystem::remove(folder / "cam0/data/b.jpg");
  SessionOptions options;
  options.keep_going = true;
  Session session = Session::open(folder.path(), options);
  EXPECT_EQ(session.findings().skipped_images, 1);
  EXPECT_EQ(session.findings().camera_rows[0], 2);
  EXPECT_EQ(session.sample(30 * kMs).cameras[0]->stamp_ns, 5 * kMs);
  // Damaged behind a good header: only decoding finds out.
  std::filesystem::resize_file(folder / "cam0/data/c.exr",
                               std::filesystem::file_size(folder / "cam0/data/c.exr") - 9);
  EXPECT_EQ(session.sample(50 * kMs).cameras[0]->stamp_ns, 5 * kMs);
  EXPECT_EQ(session.findings().skipped_images, 2);
}

TEST(CameraFeed, ThatDoesNotDecodeIsAnErrorWhenItIsNeeded) {
  const RecordedFolder folder;
  write_camera(folder);
  std::filesystem::resize_file(folder / "cam0/data/c.exr",
                               std::filesystem::file_size(folder / "cam0/data/c.exr") - 9);
  Session session = Session::open(folder.path());
  EXPECT_NO_THROW(session.sample(44 * kMs));
  EXPECT_INPUT_ERROR(session.sample(46 * kMs), "c.exr: does not decode");
}

TEST(CameraFeed, WithoutIntrinsicsIsNotUsedAndSaysSo) {
  const RecordedFolder folder;
  write_camera(folder);
  folder.write("session.json", test::header_json());
  const Session session = Session::open(folder.path());
  ASSERT_EQ(session.findings().warnings.size(), 1u);
  EXPECT_PRED2(test::holds, session.findings().warnings[0], "cam0: is not used");
}

TEST(SceneEvents, ComeInOrderOnceTheirTimeHasCome) {
  const RecordedFolder folder;
  write_good_session(folder);
  folder.write("events.jsonl",
               "{\"t_ns\": 0, \"op\": \"a\"}\n{\"t_ns\": 20000000}\r\n{\"t_ns\": 20000000, \"x\": [1]}\n");
  Session session = Session::open(folder.path());
  EXPECT_EQ(session.findings().event_rows, 3);
  const std::vector<SceneEvent> first = session.events_until(19'999'999);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].json, "{\"t_ns\": 0, \"op\": \"a\"}");
  EXPECT_EQ(first[0].line, 1);
  const std::vector<SceneEvent> second = session.events_until(20 * kMs);
  ASSERT_EQ(second.size(), 2u) << "two events may share a stamp";
  EXPECT_EQ(second[0].json, "{\"t_ns\": 20000000}");
  EXPECT_EQ(second[1].line, 3);
  EXPECT_TRUE(session.events_until(90 * kMs).empty());
}

TEST(SceneEvents, AreRefusedWithTheirLine) {
  const struct {
    std::string row, part;
  } cases[] = {
      {"{\"t_ns\": 1", "events.jsonl:2: is not JSON"},
      {"[1]", "events.jsonl:2: is not an object"},
      {"{\"op\": \"a\"}", "events.jsonl:2: field t_ns is missing"},
      {"{\"t_ns\": 1.5}", "events.jsonl:2: field t_ns is 1.5"},
      {"{\"t_ns\": 4}", "events.jsonl:2: t_ns 4 goes backwards by 1 ns"},
      {"", "events.jsonl:2: is empty"},
      {"{\"t_ns\": 6, \"a\": 1, \"a\": 2}", "events.jsonl:2: key 'a' stands twice"},
      {"\"" + std::string(2 << 20, 'x') + "\"", "events.jsonl:2: the line is longer than 1 MiB"},
  };
  for (const auto& [row, part] : cases) {
    const RecordedFolder folder;
    write_good_session(folder);
    folder.write("events.jsonl", "{\"t_ns\": 5}\n" + row + "\n");
    EXPECT_INPUT_ERROR(Session::open(folder.path()), part) << row.substr(0, 40);
  }
}

std::int64_t resident_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      std::int64_t kb = 0;
      status >> kb;
      return kb;
    }
  return -1;
}

TEST(LongSessions, TakeNoMoreMemoryThanShortOnes) {
  const RecordedFolder folder;
  write_good_session(folder);
  {
    std::ofstream rows(folder / "pose/data.csv");
    rows << test::kPoseHeader;
    for (int i = 0; i < 300'000; ++i) rows << i * 11'111'111LL << ",0,1.6,0,0,0,0,1\n";  // 55 minutes, 9 MB
  }
  (void)Session::open(folder.path());  // library tables and buffers exist from now on
  const std::int64_t before_kb = resident_kb();
  Session session = Session::open(folder.path());
  for (TimeNs t = 0; t < session.end_ns(); t += 100 * kMs) session.sample(t);
  EXPECT_EQ(session.findings().pose_rows, 300'000);
  // 300,000 poses of 64 bytes would be 19 MB; buffers of two open streams are 0.2 MB.
  EXPECT_LT(resident_kb() - before_kb, 4'000);
}

}  // namespace
}  // namespace herr
