// `herr serve` under attack: each gets its right status, and the program lives on and ends with 0.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/server/program/serve_program.h"

namespace herr {
namespace {

struct Attack {
  std::string name, request;
  int status;
};

std::vector<Attack> attacks() {
  const std::string host = "Host: localhost\r\n";
  const std::string end = " HTTP/1.1\r\n" + host + "\r\n";
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += "a: b\r\n";
  return {
      {"another host", "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421},
      {"a host that begins like ours", "GET / HTTP/1.1\r\nHost: localhost.evil.example\r\n\r\n", 421},
      {"a page elsewhere", "GET / HTTP/1.1\r\n" + host + "Origin: http://evil.example\r\n\r\n", 403},
      {"two hosts", "GET / HTTP/1.1\r\n" + host + host + "\r\n", 400},
      {"CRLF in a header", "GET / HTTP/1.1\r\nHost: localhost%0d%0aX: y\r\n\r\n", 421},
      {"bare CR in a header", "GET / HTTP/1.1\r\n" + host + "X: a\rSet-Cookie\r\n\r\n", 200},
      {"CRLF in the target", "GET /%0d%0aSet-Cookie:%20a=b" + end, 404},
      {"a header of 1 MB", "GET / HTTP/1.1\r\n" + host + "X: " + std::string(1'000'000, 'x') + "\r\n\r\n",
       431},
      {"100,000 headers", "GET / HTTP/1.1\r\n" + host + many + "\r\n", 431},
      {"a body on GET", "GET / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\nhello", 413},
      {"a chunked body", "GET / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 413},
      {"path traversal", "GET /../../etc/passwd" + end, 404},
      {"encoded traversal", "GET /%2e%2e%2f%2e%2e%2fetc%2fpasswd" + end, 404},
      {"traversal among pictures", "GET /v1/frames/latest/..%2f..%2fetc%2fpasswd.png" + end, 404},
      {"traversal in the page", "GET /page/..%2f..%2fetc%2fpasswd" + end, 404},
      {"an unknown viewport", "GET /v1/frames/latest/third_eye.png" + end, 404},
      {"a viewport with a NUL", "GET /v1/frames/latest/left_focus.png%00.png" + end, 404},
      {"an encoded slash", "GET /v1%2fstatus%2f" + end, 404},
      {"half an escape", "GET /%" + end, 404},
      {"escapes of nothing", "GET /%zz%u0041" + end, 404},
      {"overlong UTF-8", "GET /%c0%ae%c0%ae/" + end, 404},
      {"an escape twice over", "GET /%252e%252e%252fpasswd" + end, 404},
      {"a negative sequence", "GET /v1/frames?since=-1" + end, 400},
      {"a sequence beyond 64 bits", "GET /v1/frames?since=18446744073709551616" + end, 400},
      {"an absolute target", "GET http://localhost/" + end, 400},
      {"a target of 8 KB", "GET /" + std::string(8192, 'a') + end, 414},
      {"OPTIONS", "OPTIONS /" + end, 405},
      {"POST", "POST / HTTP/1.1\r\n" + host + "Content-Length: 1\r\n\r\nx", 405},
      {"TRACE", "TRACE /" + end, 405},
      {"CONNECT", "CONNECT /" + end, 405},
      {"a verb in lower case", "get /" + end, 405},
      {"HTTP/0.9", "GET /\r\n\r\n", 400},
      {"HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 505},
      {"TLS", std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", 15), 400},
  };
}

TEST_F(ServeProgram, GivesEachAttackItsStatusAndLivesOn) {
  start({"--port", "0"});
  const int port = this->port();
  ASSERT_TRUE(port != 0 && wait_for_frames(port));
  for (const Attack& attack : attacks()) {
    const Reply reply = ask(port, attack.request);
    EXPECT_EQ(reply.status, attack.status) << attack.name;
    EXPECT_EQ(reply.header("Connection"), "close") << attack.name;
    EXPECT_EQ(reply.header("X-Content-Type-Options"), "nosniff") << attack.name;
    EXPECT_EQ(reply.header("Set-Cookie"), "") << attack.name;
    EXPECT_EQ(reply.header("Allow"), attack.status == 405 ? "GET, HEAD" : "") << attack.name;
    EXPECT_EQ(reply.body.find("root:"), std::string::npos) << attack.name;
  }
  // HEAD has the headers of GET and no body, on every kind of page.
  for (const char* path : {"/", "/livez", "/v1/status", "/metrics", "/page/chart.js", "/nowhere"}) {
    const Reply head = ask(port, request_text(path, "HEAD"));
    EXPECT_EQ(head.status, get(port, path).status) << path;
    EXPECT_EQ(head.body, "") << path;
    EXPECT_GT(std::atoi(head.header("Content-Length").c_str()), 0) << path;
  }
  // Somebody who says half a request is told so after a second.
  EXPECT_EQ(ask(port, "GET / HTTP/1.1\r\nHost: local").status, 408);
  const auto status = nlohmann::json::parse(get(port, "/v1/status").body);
  EXPECT_EQ(status["phase"], "running");
  EXPECT_EQ(end(SIGTERM), 0);
  EXPECT_EQ(content_of(root() / "stderr.txt"), "");
}

// A picture of some megabytes does not fit into the buffers of a socket: the answer is under
// way while nobody reads it.
TEST_F(ServeProgram, EndsWithZeroInTheMiddleOfAnAnswer) {
  start({"--port", "0", "--profile", "xr1"});
  const int port = this->port();
  ASSERT_TRUE(port != 0 && wait_for_frames(port));
  RawClient slow(port), half(port);
  ASSERT_TRUE(slow.send(request_text("/v1/frames/latest/left_context.png?full=1")));
  ASSERT_TRUE(half.send("GET / HTTP/1.1\r\n"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(end(SIGTERM), 0);
  // A second for answers under way; a frame is given up within a tile, the rest is slack for a busy machine.
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(8));
}

TEST_F(ServeProgram, AsksForTheTokenOfItsFile) {
  write_text(root() / "token", "0123456789abcdef0123456789abcdef\n");
  ::chmod((root() / "token").c_str(), 0644);
  start({"--port", "0", "--auth-token-file", "token"});
  EXPECT_EQ(wait(), 2);
  EXPECT_NE(content_of(root() / "stderr.txt").find("has mode 0644"), std::string::npos);
  EXPECT_EQ(content_of(root() / "stderr.txt").find("0123456789"), std::string::npos);

  ::chmod((root() / "token").c_str(), 0600);
  start({"--port", "0", "--auth-token-file", "token", "--allowed-host", "frames.example"});
  const int port = this->port();
  ASSERT_NE(port, 0) << content_of(root() / "stderr.txt");
  EXPECT_EQ(get(port, "/livez").status, 401);
  const std::string shown = "Authorization: Bearer 0123456789abcdef0123456789abcdef\r\n";
  EXPECT_EQ(ask(port, request_text("/livez", "GET", "Host: frames.example\r\n" + shown)).status, 200);
  EXPECT_EQ(ask(port, request_text("/livez", "GET", "Host: other.example\r\n" + shown)).status, 421);
  EXPECT_EQ(end(SIGTERM), 0);
}

}  // namespace
}  // namespace herr
