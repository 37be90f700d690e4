// What `herr serve` says to query parameters that a path does not have.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/server/serve/served_board.h"

namespace herr {
namespace {

TEST_F(Serve, QueryParametersThatAPathDoesNotHaveAreRefused) {
  publish(4);
  publish_pictures(4);
  const std::string of_frames = "; the query parameters of this path: since, missed\n";
  const std::string picture = "/v1/frames/latest/left_context.png";
  const std::string twice = "the query parameter \"missed\" is there twice" + of_frames;
  for (const auto& [target, line] : std::map<std::string, std::string>{
           {"/v1/frames?miss=1", "no query parameter \"miss\"" + of_frames},
           {"/v1/frames?since=1&late=1", "no query parameter \"late\"" + of_frames},
           {"/v1/frames?=1", "no query parameter \"\"" + of_frames},
           {"/v1/frames?missed=1&missed=0", twice},
           {"/v1/frames?missed=1&missed=1", twice},
           {"/v1/frames?missed=1&since=2&miss%65d=1", twice},
           {"/v1/frames?%3Cb%3E%0A", "no query parameter \"?b??\"" + of_frames},
           {picture + "?ful=1", "no query parameter \"ful\"; the query parameters of this path: full\n"},
           {"/v1/status?x", "no query parameter \"x\"; this path has no query parameters\n"},
           {"/livez?verbose", "no query parameter \"verbose\"; this path has no query parameters\n"}}) {
    const Reply reply = get(target);
    EXPECT_EQ(reply.status, 400) << target;
    EXPECT_EQ(reply.body, line) << target;
  }
  for (const char* path : {"/", "/readyz", "/metrics", "/v1/latency", "/v1/plan", "/page/page.css"}) {
    EXPECT_EQ(get(std::string(path) + "?a=1").status, 400) << path;
    EXPECT_EQ(get(std::string(path) + "?").status, 200) << path << ": no parameter at all";
  }
  EXPECT_EQ(get("/v1/frame?missed=1").status, 404) << "the path is what is wrong";
  EXPECT_EQ(get_json("/v1/frames?&missed=1&&since=2&")["frames"].size(), 1u);
  EXPECT_EQ(get(picture + "?full=0").status, 200);
}

}  // namespace
}  // namespace herr
