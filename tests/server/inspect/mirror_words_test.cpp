// What `herr inspect` says of the real room in mirrors and glass.
#include "server/inspect/mirror_words.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

// One mirror, virtual or real, and a camera that sees 96 degrees across and down.
InspectReport inspected(bool session, bool catcher, bool feed) {
  Scene scene;
  scene.meshes.emplace_back();
  Material mirror;
  mirror.mirror = 1;
  scene.materials.push_back(mirror);
  scene.instances.emplace_back();
  scene.instances[0].catcher = catcher;
  InspectReport report;
  report.settings.camera = feed;
  report.scene = facts_of(scene);
  report.plan = plan_frame(scene, report.settings, session);
  if (!session) return report;
  report.session.emplace();
  report.session->header.emplace();
  report.session->header->cameras = {{pinhole_camera(417, 417, 96), Pose{}, 30}};
  return report;
}

TEST(MirrorWords, NameTheCamerasViewAndWhatCannotBe) {
  const std::vector<std::string> words = mirror_words(inspected(true, false, true));
  ASSERT_EQ(words.size(), 3u);
  // From pixel centre to pixel centre: 2 atan(tan(48 degrees) * 416 / 417) = 95.86 degrees.
  EXPECT_NE(words[0].find("inside the camera's view (96 x 96 degrees), beyond it the environment"),
            std::string::npos)
      << words[0];
  EXPECT_NE(words[1].find("stated colour"), std::string::npos);
  EXPECT_EQ(words[2].rfind("cannot show", 0), 0u);
}

TEST(MirrorWords, SayWhyNoFeedIsShown) {
  EXPECT_NE(mirror_words(inspected(true, false, false)).at(0).find("no camera feed is shown"),
            std::string::npos);
  EXPECT_NE(mirror_words(inspected(false, false, true)).at(0).find("unless a session brings a feed"),
            std::string::npos);
  EXPECT_NE(mirror_words(inspected(true, true, true)).at(0).find("virtual things alone"), std::string::npos);
}

TEST(MirrorWords, AreNoneWithoutMirrorsOrGlass) {
  InspectReport report = inspected(true, false, true);
  Scene plain;
  report.plan = plan_frame(plain, report.settings, true);
  EXPECT_TRUE(mirror_words(report).empty());
}

}  // namespace
}  // namespace herr
