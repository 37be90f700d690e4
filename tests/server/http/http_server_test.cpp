// The server on a real socket with clients that behave badly.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/http/http_server.h"
#include "tests/server/http/http_client.h"

namespace herr {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

HttpResponse echo(const HttpRequest& request) {
  if (request.path == "/throw") throw std::runtime_error("secret /etc/passwd");
  HttpResponse response;
  response.body = request.path;
  for (const auto& [key, value] : request.query) response.body += " " + key + "=" + value;
  if (request.path == "/large") response.body.assign(20'000'000, 'x');
  return response;
}

// The soft limit of open files, for the life of this object.
class FileLimit {
 public:
  explicit FileLimit(rlim_t most) {
    EXPECT_EQ(::getrlimit(RLIMIT_NOFILE, &before_), 0);
    const rlimit lowered{most, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &lowered), 0);
  }
  ~FileLimit() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

class Http : public ::testing::Test {
 protected:
  std::unique_ptr<HttpServer> serve(HttpHandler handler = echo) {
    HttpServer::Config config;
    config.slow_prefix = "/slow/";
    config.limits = limits;
    return std::make_unique<HttpServer>(config, std::move(handler));
  }
  HttpLimits limits;
};

TEST_F(Http, AnswersWithLengthTypeAndSafetyHeadersAndCloses) {
  const auto server = serve();
  const Reply reply = get(server->port(), "/a%20b?x=1&y=%3C");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "/a b x=1 y=<");
  EXPECT_EQ(reply.header("Content-Length"), "12");
  EXPECT_EQ(reply.header("Content-Type"), "text/plain; charset=utf-8");
  EXPECT_EQ(reply.header("Connection"), "close");
  EXPECT_EQ(reply.header("Cache-Control"), "no-store");
  EXPECT_EQ(reply.header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(reply.header("Referrer-Policy"), "no-referrer");
  EXPECT_EQ(reply.header("Content-Security-Policy"), "default-src 'none'; frame-ancestors 'none'");
  EXPECT_EQ(reply.header("Server"), "");
}

TEST_F(Http, HeadHasTheHeadersOfGetAndNoBody) {
  const auto server = serve();
  const Reply reply = ask(server->port(), request_text("/abc", "HEAD"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.header("Content-Length"), "4");
  EXPECT_EQ(reply.body, "");
  const Reply refused = ask(server->port(), request_text("/", "HEAD", "Host: evil.example\r\n"));
  EXPECT_EQ(refused.status, 421);
  EXPECT_EQ(refused.body, "");
  const Reply told = ask(server->port(), request_text("/", "GET", "Host: evil.example\r\n"));
  EXPECT_EQ(told.status, 421);
  EXPECT_NE(told.body.find("start it with --allowed-host NAME"), std::string::npos) << told.body;
  EXPECT_EQ(told.body.find("evil.example"), std::string::npos) << "what was asked for is not echoed";
}

TEST_F(Http, RefusesWritingMethodsAndSaysWhichAreThere) {
  const auto server = serve();
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"}) {
    const Reply reply = ask(server->port(), request_text("/", method));
    EXPECT_EQ(reply.status, 405) << method;
    EXPECT_EQ(reply.header("Allow"), "GET, HEAD") << method;
  }
  EXPECT_EQ(server->counters().rejected.at("method"), 6);
  EXPECT_EQ(server->counters().requests.at(405), 6);
}

TEST_F(Http, AsksForTheTokenAndTakesFurtherNames) {
  HttpServer::Config config;
  config.allowed_hosts = {"frames.example"};
  config.token = "0123456789abcdef";
  const HttpServer server(config, echo);
  const Reply without = get(server.port(), "/x");
  EXPECT_EQ(without.status, 401);
  EXPECT_EQ(without.header("WWW-Authenticate"), "Bearer realm=\"herr\"");
  EXPECT_NE(without.head.find("WWW-Authenticate: Basic realm=\"herr\""), std::string::npos);
  EXPECT_EQ(without.body, "401 Unauthorized\n");
  const auto ask_as = [&](const std::string& host) {
    return ask(server.port(),
               request_text("/x", "GET", "Host: " + host + "\r\nAuthorization: Bearer 0123456789abcdef\r\n"))
        .status;
  };
  EXPECT_EQ(ask_as("localhost"), 200);
  EXPECT_EQ(ask_as("frames.example:443"), 200);
  EXPECT_EQ(ask_as("other.example"), 421);
  EXPECT_EQ(server.counters().rejected.at("token"), 1);
}

TEST_F(Http, AnExceptionIsA500WithoutItsText) {
  const auto server = serve();
  const Reply reply = get(server->port(), "/throw");
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ((reply.head + reply.body).find("secret"), std::string::npos);
  EXPECT_EQ((reply.head + reply.body).find("passwd"), std::string::npos);
}

TEST_F(Http, RangesAndCompressionAreNotForStatusPages) {
  const auto server = serve();
  const Reply reply =
      ask(server->port(),
          request_text("/abc", "GET",
                       "Host: localhost\r\nRange: bytes=0-0,1-1\r\nAccept-Encoding: br, gzip\r\n"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "/abc");
}

TEST_F(Http, OneRequestPerConnectionAndBodiesAreNeverRead) {
  const auto server = serve();
  const std::string twice = request_text("/one") + request_text("/two") + std::string(20000, 'b');
  const Reply reply = ask(server->port(), twice);
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "/one");
}

TEST_F(Http, AFloodOfHeaderBytesIsRefusedAtSixteenKilobytes) {
  const auto server = serve();
  const Reply line = ask(server->port(), "GET /" + std::string(30000, 'a'));
  EXPECT_EQ(line.status, 431);
  std::string headers = "GET / HTTP/1.1\r\nHost: localhost\r\n";
  for (int i = 0; i < 5000; ++i) headers += "X-" + std::to_string(i) + ": y\r\n";
  EXPECT_EQ(ask(server->port(), headers).status, 431);
  EXPECT_EQ(get(server->port(), "/after").body, "/after");
}

// A head that drips in time is answered; one that does not is told so after the limit,
// not after the last drop.
TEST_F(Http, ADrippingClientIsEndedAtTheDeadlineAndHoldsUpNobody) {
  limits.request_time = milliseconds(300);
  const auto server = serve();
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 40; ++i) idle.push_back(std::make_unique<RawClient>(server->port()));
  const auto start = steady_clock::now();  // the server counts from the connection on
  RawClient dripping(server->port());
  for (int i = 0; i < 10; ++i) {
    dripping.send(i == 0 ? "GET / HTTP/1.1\r\n" : "X: y\r\n");
    EXPECT_EQ(get(server->port(), "/livez").status, 200);
    std::this_thread::sleep_for(milliseconds(20));
  }
  const std::string told = dripping.receive();
  const auto waited = steady_clock::now() - start;
  EXPECT_EQ(told.substr(0, 12), "HTTP/1.1 408");
  // Not before the limit; and it does end (with all the time that a loaded machine may need).
  EXPECT_GE(waited, milliseconds(300));
  EXPECT_LT(waited, milliseconds(5000));
  EXPECT_EQ(server->counters().rejected.at("time"), 1);
}

TEST_F(Http, AtTheLimitTheOldestIncompleteRequestGoes) {
  limits.connections = 8;
  limits.request_time = milliseconds(20000);
  const auto server = serve();
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 30; ++i) {
    idle.push_back(std::make_unique<RawClient>(server->port()));
    idle.back()->send("GET /");
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(get(server->port(), "/livez").status, 200);
  // The very first was let go without an answer.
  EXPECT_EQ(idle.front()->receive(), "");
  EXPECT_GE(server->counters().rejected.at("crowd"), 22);
}

// An honest client may be slow to ask, on a loaded machine or a long line: a hundred that never ask must not
// have it dropped.
TEST_F(Http, AClientThatAsksLateIsAnsweredBesideAHundredThatNeverAsk) {
  limits.request_time = milliseconds(20000);
  const auto server = serve();
  RawClient late(server->port());
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 100; ++i) {
    idle.push_back(std::make_unique<RawClient>(server->port()));
    idle.back()->send("GET /");
  }
  EXPECT_EQ(get(server->port(), "/livez").status, 200);
  late.send(request_text("/late"));
  EXPECT_EQ(late.receive().substr(0, 12), "HTTP/1.1 200");
  EXPECT_EQ(server->counters().rejected.count("crowd"), 0u);
}

// Files of scenes and sessions are opened while clients are there: clients never hold them all.
TEST_F(Http, ClientsLeaveHalfOfTheFilesToTheProcess) {
  limits.request_time = milliseconds(20000);
  const auto server = [this] {
    const FileLimit files(64);
    return serve();
  }();
  std::vector<std::unique_ptr<RawClient>> idle;
  for (int i = 0; i < 50; ++i) idle.push_back(std::make_unique<RawClient>(server->port()));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(get(server->port(), "/livez").status, 200);
  EXPECT_GE(server->counters().rejected.at("crowd"), 50 + 1 - 32);  // one more for the first that asks
}

TEST_F(Http, AClientThatDoesNotReadCostsNobodyElseTime) {
  limits.send_time = milliseconds(400);
  const auto server = serve();
  RawClient deaf(server->port());
  deaf.send(request_text("/large"));  // 20 MB: more than the buffers of two sockets
  for (int i = 0; i < 10; ++i) EXPECT_EQ(get(server->port(), "/livez").status, 200);
  std::this_thread::sleep_for(milliseconds(900));
  // Cut off at the deadline: what is left is what the buffers held.
  EXPECT_LT(deaf.receive().size(), 20'000'000u);
}

// They ask for much and take nothing: the server keeps the bytes of the last ones alone.
TEST_F(Http, ClientsThatDoNotReadCostABoundedAmountOfMemory) {
  limits.untaken_bytes = 50'000'000;
  const auto server = serve();
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 10; ++i) {
    clients.push_back(std::make_unique<RawClient>(server->port()));
    clients.back()->send(request_text("/large"));
    // The answers in this order: each has begun to arrive.
    EXPECT_EQ(clients.back()->receive_some(), "HTTP/1.1 200");
  }
  EXPECT_EQ(get(server->port(), "/livez").status, 200);
  // Of ten times 20 MB the last two fit.
  EXPECT_EQ(server->counters().rejected.at("unread"), 8);
  EXPECT_LT(clients.front()->receive().size(), 20'000'000u);
  EXPECT_GT(clients.back()->receive().size(), 20'000'000u) << "the last had the shortest time";
}

TEST_F(Http, ALargeAnswerArrivesWhole) {
  const auto server = serve();
  EXPECT_EQ(get(server->port(), "/large").body.size(), 20'000'000u);
}

TEST_F(Http, SlowAnswersHaveALaneOfTheirOwn) {
  std::atomic<bool> go{false};
  const auto server = serve([&](const HttpRequest& request) {
    if (request.path.starts_with("/slow/")) {
      while (!go) std::this_thread::sleep_for(milliseconds(1));
    }
    return echo(request);
  });
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 4; ++i) {
    slow.push_back(std::make_unique<RawClient>(server->port()));
    slow.back()->send(request_text("/slow/" + std::to_string(i)));
  }
  EXPECT_EQ(get(server->port(), "/quick").body, "/quick");
  go = true;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(slow[static_cast<std::size_t>(i)]->receive().ends_with("/slow/" + std::to_string(i)));
  }
}

TEST_F(Http, AFullLaneSaysTryAgain) {
  limits.waiting = 2;
  std::atomic<bool> go{false};
  const auto server = serve([&](const HttpRequest& request) {
    while (!go) std::this_thread::sleep_for(milliseconds(1));
    return echo(request);
  });
  std::vector<std::unique_ptr<RawClient>> clients;
  // One is being answered, two wait; of ten at least seven are refused.
  for (int i = 0; i < 10; ++i) {
    clients.push_back(std::make_unique<RawClient>(server->port()));
    clients.back()->send(request_text("/"));
  }
  while (server->counters().rejected["busy"] < 7) std::this_thread::sleep_for(milliseconds(1));
  go = true;
  int refused = 0;
  for (auto& client : clients) {
    const std::string reply = client->receive();
    if (reply.starts_with("HTTP/1.1 503")) {
      ++refused;
      EXPECT_NE(reply.find("Retry-After: 1"), std::string::npos);
    }
  }
  EXPECT_GE(refused, 7);
}

TEST_F(Http, ASecondServerOnThePortFails) {
  const auto server = serve();
  HttpServer::Config config;
  config.port = server->port();
  try {
    HttpServer second(config, echo);
    FAIL() << "two servers share a port";
  } catch (const BindError& error) {
    EXPECT_EQ(error.error_number(), EADDRINUSE);
    EXPECT_NE(std::string(error.what()).find(std::to_string(config.port)), std::string::npos);
  }
  EXPECT_EQ(get(server->port(), "/still").body, "/still");
}

TEST_F(Http, StopEndsWithIdleAndDrippingClientsAndFreesThePort) {
  limits.request_time = milliseconds(60000);
  auto server = serve();
  const int port = server->port();
  RawClient idle(port), half(port);
  half.send("GET / HT");
  const auto start = steady_clock::now();
  server->stop();
  // No answer is under way, so there is nothing to wait for; a second is what stop() allows itself.
  EXPECT_LT(steady_clock::now() - start, milliseconds(1500));
  EXPECT_FALSE(RawClient(port).connected());
  server.reset();
  HttpServer::Config config;
  config.port = port;
  HttpServer again(config, echo);
  EXPECT_EQ(get(port, "/again").body, "/again");
}

TEST_F(Http, ManyClientsAtOnceAllGetTheirOwnAnswer) {
  const auto server = serve();
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) {
        const std::string target = "/" + std::to_string(t) + "/" + std::to_string(i);
        if (get(server->port(), target).body != target) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(server->counters().requests.at(200), 8 * 50);
}

}  // namespace
}  // namespace herr
