// A small HTTP/1.1 server for status pages: GET and HEAD, one request for each connection, no bodies.
// One thread polls all sockets, in both directions, so that a slow client costs a few kilobytes and nothing
// else; answers are made on lanes (work_lane.h) and only for requests that are whole and sound.
// Before: a HttpHandler. After: bytes on sockets, counters.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/http/http_library.h"
#include "server/http/http_message.h"

namespace herr {

struct HttpLimits {
  std::chrono::milliseconds request_time{1000};  // from accept to the end of the head, however it drips
  std::chrono::milliseconds answer_time{30000};  // to make the answer
  std::chrono::milliseconds send_time{30000};    // to send it
  std::chrono::milliseconds linger_time{500};    // for the client to close after the answer
  // At once; one more drops the longest incomplete request. Many, so that an honest client that is slow to
  // ask is not dropped for a few dozen that never ask. At most half of the files that the process may open.
  std::size_t connections = 256;
  std::size_t waiting = 256;  // requests that wait for a lane; one more gets 503
  // Of answers that clients have not taken whole. One answer more drops the client that has been taking the
  // longest, so that clients that ask for pictures and do not read them cost no more memory than this.
  std::size_t untaken_bytes = std::size_t{64} << 20;
};

struct HttpCounters {
  std::map<int, std::int64_t> requests;          // by status of the answer
  std::map<std::string, std::int64_t> rejected;  // by reason, handlers never asked
};

// Every function is thread-safe.
class HttpServer {
 public:
  struct Config {
    std::string host = "127.0.0.1";
    int port = 0;             // 0: a free one
    std::string slow_prefix;  // paths that begin with this go to a lane of low priority; empty: none
    std::vector<std::string> allowed_hosts;  // further names that a client may address, lower case, no port
    std::string token;                       // what clients must show; empty: nothing
    HttpLimits limits;
  };
  // Binds and answers from now on. Throws BindError.
  HttpServer(Config config, HttpHandler handler);
  ~HttpServer();  // stop()
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  HttpCounters counters() const;
  // Takes no new connection, ends answers that are under way (at most a second), closes the rest.
  void stop();

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

// The names under which a server on `host` may be addressed: loopback's own, and `host`.
std::vector<std::string> host_names_for(const std::string& host);

}  // namespace herr
