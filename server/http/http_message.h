// What a client asks and what it is told, free of sockets and libraries.
// Before: http_server has read and checked a request. After: a handler answers it.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace herr {

struct HttpRequest {
  bool head = false;                              // HEAD: the answer's body is left out; otherwise GET
  std::string path;                               // percent-decoded, without the query
  std::multimap<std::string, std::string> query;  // decoded; equal names as often as they were sent
};

struct HttpResponse {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;  // besides those that every answer has
};

// Called on several threads at once. An exception becomes a 500 without its text.
using HttpHandler = std::function<HttpResponse(const HttpRequest&)>;

}  // namespace herr
