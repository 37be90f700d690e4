#include "server/http/request_head.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "server/text/base64.h"

namespace herr {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lower_text(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

RequestHead refusal(int status, const char* reason, bool head_only = false) {
  RequestHead head;
  head.status = status;
  head.reason = reason;
  head.head_only = head_only;
  return head;
}

// "name", "name:8080", "[::1]:8080" without the port; empty when it is not of that form.
std::string host_name_of(std::string_view host) {
  std::size_t end = host.size();
  const std::size_t colon = host.rfind(':');
  const std::size_t bracket = host.rfind(']');
  if (colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket)) {
    const std::string_view port = host.substr(colon + 1);
    if (port.empty() || port.size() > 5 || !std::all_of(port.begin(), port.end(), is_digit)) return {};
    end = colon;
  }
  return lower_text(host.substr(0, end));
}

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return !name.empty() && std::find(names.begin(), names.end(), name) != names.end();
}

// "http://localhost:8080" -> "localhost"; anything else (also "null") -> empty.
std::string origin_name(std::string_view origin) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) return host_name_of(origin.substr(scheme.size()));
  }
  return {};
}

bool is_target(std::string_view target) {
  return target.starts_with('/') && target.size() <= kMostTargetBytes &&
         std::all_of(target.begin(), target.end(), [](char c) { return c > ' ' && c < '\x7F'; });
}

// What the headers say that matters here.
struct Headers {
  std::size_t count = 0, hosts = 0, authorizations = 0;
  std::string_view host, origin, authorization;
  bool has_origin = false, has_body = false, broken = false;
};

Headers read_headers(std::string_view lines) {
  Headers headers;
  while (!lines.empty()) {
    const std::size_t end = lines.find(kLineEnd);
    const std::string_view line = lines.substr(0, end);
    lines.remove_prefix(end + kLineEnd.size());
    if (line.empty()) break;
    ++headers.count;
    const std::size_t colon = line.find(':');
    // No name, a blank in or after the name, or a folded line: the classic ways to be read in two ways.
    const std::string_view name_text = line.substr(0, colon);
    if (colon == std::string_view::npos || name_text.empty() ||
        name_text.find_first_of(" \t") != std::string_view::npos) {
      headers.broken = true;
      continue;
    }
    const std::string name = lower_text(name_text);
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (name == "host") {
      ++headers.hosts;
      headers.host = value;
    } else if (name == "authorization") {
      ++headers.authorizations;
      headers.authorization = value;
    } else if (name == "origin") {
      headers.has_origin = true;
      headers.origin = value;
    } else if (name == "transfer-encoding" || (name == "content-length" && value != "0")) {
      headers.has_body = true;
    }
  }
  return headers;
}

// The value of an Authorization header shows the token.
bool shows_token(std::string_view authorization, std::string_view token) {
  const std::size_t blank = authorization.find(' ');
  if (blank == std::string_view::npos) return false;
  const std::string scheme = lower_text(authorization.substr(0, blank));
  const std::string_view credentials = trimmed(authorization.substr(blank));
  if (scheme == "bearer") return is_same_secret(credentials, token);
  if (scheme != "basic") return false;
  const std::optional<std::vector<std::byte>> bytes = bytes_from_base64(credentials);
  if (!bytes) return false;
  const std::string_view pair(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::size_t colon = pair.find(':');
  return colon != std::string_view::npos && is_same_secret(pair.substr(colon + 1), token);
}

}  // namespace

bool is_same_secret(std::string_view given, std::string_view secret) {
  unsigned difference = given.size() == secret.size() && !secret.empty() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i] ^ expected));
  }
  return difference == 0;
}

std::optional<std::size_t> head_length(std::string_view bytes) {
  const std::size_t end = bytes.find("\r\n\r\n");
  if (end == std::string_view::npos) return std::nullopt;
  return end + 4;
}

RequestHead judge_head(std::string_view head, const std::vector<std::string>& host_names,
                       std::string_view token) {
  if (head.find('\0') != std::string_view::npos) return refusal(400, "syntax");
  const std::size_t line_end = head.find(kLineEnd);
  if (line_end == std::string_view::npos) return refusal(400, "syntax");
  const std::string_view line = head.substr(0, line_end);
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || last == first) return refusal(400, "syntax");
  const std::string_view method = line.substr(0, first), version = line.substr(last + 1);
  const bool head_only = method == "HEAD";
  const bool http11 = version == "HTTP/1.1";
  if (!http11 && version != "HTTP/1.0") {
    return version.starts_with("HTTP/") ? refusal(505, "version") : refusal(400, "syntax");
  }

  // From here on the request is HTTP and is told what exactly is wrong with it.
  const Headers headers = read_headers(head.substr(line_end + kLineEnd.size()));
  if (headers.count > kMostHeaders) return refusal(431, "headers", head_only);
  if (headers.broken || headers.hosts > 1 || headers.authorizations > 1 || (http11 && headers.hosts == 0)) {
    return refusal(400, "syntax", head_only);
  }
  // HTTP/1.0 may leave the host out; no browser does.
  if (headers.hosts == 1 && !is_among(host_name_of(headers.host), host_names)) {
    return refusal(421, "host", head_only);
  }
  if (headers.has_origin && !is_among(origin_name(headers.origin), host_names)) {
    return refusal(403, "origin", head_only);
  }
  if (!token.empty() && !shows_token(headers.authorization, token)) {
    return refusal(401, "token", head_only);
  }
  if (!head_only && method != "GET") return refusal(405, "method");
  if (headers.has_body) return refusal(413, "body", head_only);
  RequestHead result;
  result.head_only = head_only;
  result.target = std::string(line.substr(first + 1, last - first - 1));
  if (result.target.size() > kMostTargetBytes) return refusal(414, "target", head_only);
  if (!is_target(result.target)) return refusal(400, "syntax", head_only);
  return result;
}

}  // namespace herr
