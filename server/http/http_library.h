// cpp-httplib behind one door: it binds the socket, takes a target apart and puts an answer together. It
// never reads from a socket: what it is given is one checked line in memory, so that none of its limits that
// are missing (line length, number of headers, bodies, ranges, compression) can be reached.
// Before: request_head has accepted a request. After: http_server sends the bytes.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "server/http/http_message.h"

namespace herr {

// The address cannot be bound. error_number() is the errno, 0 when the host's name has no address.
class BindError : public std::runtime_error {
 public:
  BindError(const std::string& host, int port, int error_number);
  int error_number() const { return error_number_; }

 private:
  int error_number_;
};

class HttpLibrary {
 public:
  explicit HttpLibrary(HttpHandler handler);
  ~HttpLibrary();
  HttpLibrary(const HttpLibrary&) = delete;
  HttpLibrary& operator=(const HttpLibrary&) = delete;

  struct Listener {
    int fd = -1;  // listening, non-blocking, closed on exec; the caller closes it
    int port = 0;
  };
  // Port 0 takes a free one. No SO_REUSEPORT: a second server on a port fails. Throws BindError.
  Listener bind(const std::string& host, int port);

  struct Answer {
    int status = 0;
    std::string bytes;  // head and body as they go over the wire, with Connection: close
  };
  // The handler's answer to a target that judge_head() accepted. Thread-safe.
  Answer answer(const std::string& target, bool head_only) const;
  // An answer that no handler was asked for.
  Answer refuse(int status, bool head_only) const;

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace herr
