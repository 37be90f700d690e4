// The page at / and what belongs to it, and the picture of the polar buffer.
#include <gtest/gtest.h>

#include "server/serve/page_files.h"
#include "server/serve/start_page.h"
#include "tests/server/serve/served_board.h"

namespace herr {
namespace {

TEST_F(Serve, ThePageEscapesWhatComesFromFilesAndLoadsNothingFromElsewhere) {
  publish(3);
  const Reply page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.header("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page.header("Content-Security-Policy"), kPagePolicy);
  EXPECT_NE(page.body.find("walk &lt;b&gt;&amp;&quot;x&quot;"), std::string::npos);
  EXPECT_EQ(page.body.find("<b>&\""), std::string::npos);
  EXPECT_NE(page.body.find("/v1/frames/latest/right_focus.png"), std::string::npos);
  EXPECT_EQ(page.body.find("http://"), std::string::npos);
  EXPECT_EQ(page.body.find("{{"), std::string::npos) << "a mark of the template was left";
  // The policy forbids scripts and styles that stand in the page itself.
  EXPECT_EQ(page.body.find("<style"), std::string::npos);
  EXPECT_EQ(page.body.find(" style="), std::string::npos);
  for (std::size_t at = page.body.find("<script"); at != std::string::npos;
       at = page.body.find("<script", at + 1))
    EXPECT_EQ(page.body.substr(at, 19), "<script src=\"/page/") << "all scripts are files of this server";
}

TEST_F(Serve, ThePageHasItsNumbersWithoutScripts) {
  publish(3);
  const std::string page = get("/").body;
  for (const char* part : {"<noscript><meta http-equiv=\"refresh\"", "first hits", "missed", "age of pose",
                           "mirror rays", "2 of 20 instances reflect"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(Serve, EveryPartOfThePageIsServedWithItsType) {
  publish(1);
  for (const auto& [name, type] :
       {std::pair{"page.css", "text/css; charset=utf-8"},
        std::pair{"page.js", "text/javascript; charset=utf-8"},
        std::pair{"chart.js", "text/javascript; charset=utf-8"}, std::pair{"icon.svg", "image/svg+xml"}}) {
    const Reply part = get(std::string("/page/") + name);
    EXPECT_EQ(part.status, 200) << name;
    EXPECT_EQ(part.header("Content-Type"), type);
    EXPECT_EQ(part.body, page_file(name));
    EXPECT_GT(part.body.size(), 100u) << name;
  }
  EXPECT_NE(get("/page/chart.js").body.find("Chart.js v"), std::string::npos);
  for (const char* path : {"/page", "/page/", "/page/page.html", "/page/../page.js", "/page/page.js/"})
    EXPECT_EQ(get(path).status, 404) << path;
}

TEST_F(Serve, AFrameSaysWhenItWasFinished) {
  publish(3);
  // The server started 20 s ago; frame 3 is finished now, frame 1 two tenths of a second before.
  const json frames = get_json("/v1/frames")["frames"];
  EXPECT_NEAR(frames[0]["finished_s"].get<double>(), 19.8, 1e-9);
  EXPECT_NEAR(frames[2]["finished_s"].get<double>(), 20.0, 1e-9);
}

TEST_F(Serve, ThePolarBufferIsCopiedOnlyWhenSomebodyAsks) {
  publish(1);
  publish_pictures(1, true);
  EXPECT_LT(board_.polar_asked_ns, 0);
  EXPECT_EQ(get("/").body.find("polar-left.png"), std::string::npos) << "not shown before it is there";
  const Reply early = get("/v1/frames/latest/polar-left.png");
  EXPECT_EQ(early.status, 503);
  EXPECT_EQ(early.header("Retry-After"), "1");
  EXPECT_EQ(early.body, "");
  EXPECT_EQ(board_.polar_asked_ns, now_ns_);

  auto pictures = std::make_shared<ServedPictures>(*board_.pictures.get());
  pictures->sequence = 2;
  pictures->has_polar = true;
  for (ViewportImage& polar : pictures->polar) polar.resize(20, 10);
  board_.pictures.set(pictures);
  EXPECT_NE(
      get("/").body.find("<img src=\"/v1/frames/latest/polar-left.png\" alt=\"polar-left\" width=\"20\" "
                         "height=\"10\">"),
      std::string::npos)
      << "of its own size";
  const Reply reply = get("/v1/frames/latest/polar-right.png");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.header("Content-Type"), "image/png");
  EXPECT_EQ(reply.header("X-Herr-Sequence"), "2");
  const std::int64_t encoded = endpoints_.pictures().encoded();
  EXPECT_EQ(get("/v1/frames/latest/polar-right.png").body, reply.body);
  EXPECT_EQ(endpoints_.pictures().encoded(), encoded) << "once for a frame";
}

TEST_F(Serve, WithoutFoveationThereIsNoPolarBuffer) {
  publish(1);
  publish_pictures(1, false);
  EXPECT_EQ(get("/v1/frames/latest/polar-left.png").status, 404);
}

}  // namespace
}  // namespace herr
