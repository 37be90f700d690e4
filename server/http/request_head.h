// The bytes of a request's head, judged before any library sees them: whole, of bounded size, GET or HEAD, no
// body, and addressed to this machine by name (a page elsewhere that points its own name here is refused).
// Before: bytes from a socket. After: http_server answers an error itself or hands the target on.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace herr {

inline constexpr std::size_t kMostHeadBytes = 16 * 1024;
inline constexpr std::size_t kMostHeaders = 100;
inline constexpr std::size_t kMostTargetBytes = 2048;

// Number of bytes up to and with the empty line that ends the head; none while it has not arrived.
std::optional<std::size_t> head_length(std::string_view bytes);

struct RequestHead {
  int status = 0;          // 0: a sound request; otherwise the HTTP status to refuse it with
  std::string reason;      // of a refusal, one word for counters: "method", "host", "body", ...
  bool head_only = false;  // the method is HEAD
  std::string target;      // path and query as sent: printable ASCII that starts with '/'
};

// `head` ends with the empty line. `host_names` are the names in lower case under which the server may be
// addressed, without ports, IPv6 in brackets. `token`: what a client must show, as "Authorization: Bearer"
// or, for browsers, as the password of "Basic"; empty: nothing.
RequestHead judge_head(std::string_view head, const std::vector<std::string>& host_names,
                       std::string_view token = {});

// Takes the same time wherever `given` differs from `secret`.
bool is_same_secret(std::string_view given, std::string_view secret);

}  // namespace herr
