#include "server/http/http_library.h"

#include <fcntl.h>
#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace herr {
namespace {

// The flags of pkg-config choose the layout of the library's classes: with others,
// calls would corrupt memory.
static_assert(sizeof(httplib::Client) == 2 * sizeof(void*), "cpp-httplib is compiled with unfitting flags");
static_assert(
    std::string_view(CPPHTTPLIB_VERSION) == "0.11.4",
    "another cpp-httplib: run the tests of http_server_test.cpp, read its change log, then change this");

constexpr int kBacklog = 128;
constexpr const char* kDefaultPolicy = "default-src 'none'; frame-ancestors 'none'";

// A request that is all there and an answer that stays in memory.
class MemoryStream final : public httplib::Stream {
 public:
  explicit MemoryStream(std::string_view request) : request_(request) {}

  bool is_readable() const override { return !request_.empty(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* bytes, size_t size) override {
    const std::size_t count = std::min(size, request_.size());
    std::memcpy(bytes, request_.data(), count);
    request_.remove_prefix(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, size_t size) override {
    answer.append(bytes, size);
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return -1; }

  std::string answer;

 private:
  std::string_view request_;
};

void add_headers(const HttpResponse& response, httplib::Response& out) {
  for (const auto& [name, value] : response.headers) out.set_header(name, value);
  if (!out.has_header("Content-Security-Policy")) {
    out.set_header("Content-Security-Policy", kDefaultPolicy);
  }
  out.set_header("X-Content-Type-Options", "nosniff");
  out.set_header("Referrer-Policy", "no-referrer");
  out.set_header("Cache-Control", "no-store");
}

// The library's own list of parameters leaves out pairs that it has had.
std::multimap<std::string, std::string> query_of(std::string_view target) {
  std::multimap<std::string, std::string> query;
  const std::size_t mark = target.find('?');
  std::string_view rest = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  rest = rest.substr(0, rest.find('#'));
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    if (pair.empty()) continue;
    const std::string_view name = pair.substr(0, pair.find('='));
    const std::string_view value = name.size() == pair.size() ? "" : pair.substr(name.size() + 1);
    const auto decoded = [](std::string_view text) {
      return httplib::detail::decode_url(std::string(text), true);
    };
    query.emplace(decoded(name), decoded(value));
  }
  return query;
}

// Not SO_REUSEPORT, the default: two servers on one port would share its clients.
void set_socket_options(socket_t socket) {
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
}

std::string bind_problem(const std::string& host, int port, int error_number) {
  const std::string address = host + ":" + std::to_string(port);
  if (error_number == 0) return "cannot listen on " + address + ": the host has no address";
  return "cannot listen on " + address + ": " + std::strerror(error_number);
}

// The library's own list lacks 421 and 431.
const char* status_text(int status) {
  switch (status) {
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 421:
      return "Misdirected Request";
    case 431:
      return "Request Header Fields Too Large";
    case 503:
      return "Service Unavailable";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Internal Server Error";
  }
}

HttpResponse refusal_of(int status) {
  HttpResponse response;
  response.status = status;
  response.body = std::to_string(status) + " " + status_text(status) + "\n";
  if (status == 421)
    response.body +=
        "The server does not go by the name in the Host header: start it with --allowed-host NAME\n";
  if (status == 401) {
    response.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"herr\"");
    // For browsers, which ask for a password and know no bearers: any name, the token as the password.
    response.headers.emplace_back("WWW-Authenticate", "Basic realm=\"herr\", charset=\"UTF-8\"");
  }
  if (status == 405) response.headers.emplace_back("Allow", "GET, HEAD");
  if (status == 503) response.headers.emplace_back("Retry-After", "1");
  return response;
}

}  // namespace

BindError::BindError(const std::string& host, int port, int error_number)
    : std::runtime_error(bind_problem(host, port, error_number)), error_number_(error_number) {}

// Only binds and answers; its own accept loop never runs.
class HttpLibrary::Server final : public httplib::Server {
 public:
  explicit Server(HttpHandler handler) : handler_(std::move(handler)) {
    httplib::Server::set_socket_options(herr::set_socket_options);
    // The one route: no pattern ever meets the text of a client.
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& out) {
      route(request, out);
      return HandlerResponse::Handled;
    });
  }

  Listener take_listener(const std::string& host, int port) {
    errno = 0;
    Listener listener;
    listener.port = port;
    if (port == 0) {
      listener.port = bind_to_any_port(host);
    } else if (!bind_to_port(host, port)) {
      listener.port = -1;
    }
    if (listener.port < 0) throw BindError(host, port, errno);
    listener.fd = svr_sock_;
    ::fcntl(listener.fd, F_SETFD, FD_CLOEXEC);
    ::fcntl(listener.fd, F_SETFL, ::fcntl(listener.fd, F_GETFL) | O_NONBLOCK);
    // Its own queue of five is full after five clients.
    if (::listen(listener.fd, kBacklog) != 0) throw BindError(host, port, errno);
    return listener;
  }

  std::string process(const std::string& request) {
    MemoryStream stream(request);
    bool closed = false;
    process_request(stream, true, closed, nullptr);
    return std::move(stream.answer);
  }

 private:
  void route(const httplib::Request& request, httplib::Response& out) const {
    HttpRequest asked;
    asked.head = request.method == "HEAD";
    asked.path = request.path;
    asked.query = query_of(request.target);
    HttpResponse response;
    try {
      response = handler_(asked);
    } catch (const std::exception&) {
      // The text may name files; it is not for strangers.
      response = refusal_of(500);
    }
    out.status = response.status;
    add_headers(response, out);
    out.set_content(std::move(response.body), response.content_type);
  }

  const HttpHandler handler_;
};

HttpLibrary::HttpLibrary(HttpHandler handler) : server_(std::make_unique<Server>(std::move(handler))) {}

HttpLibrary::~HttpLibrary() = default;

HttpLibrary::Listener HttpLibrary::bind(const std::string& host, int port) {
  return server_->take_listener(host, port);
}

HttpLibrary::Answer HttpLibrary::answer(const std::string& target, bool head_only) const {
  Answer result;
  result.bytes =
      server_->process((head_only ? "HEAD " : "GET ") + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  // "HTTP/1.1 200 OK": the status is where it always is.
  if (result.bytes.size() > 12) result.status = std::atoi(result.bytes.substr(9, 3).c_str());
  return result;
}

HttpLibrary::Answer HttpLibrary::refuse(int status, bool head_only) const {
  const HttpResponse response = refusal_of(status);
  httplib::Response out;
  add_headers(response, out);
  Answer result;
  result.status = status;
  result.bytes = "HTTP/1.1 " + std::to_string(status) + " " + status_text(status) + "\r\n";
  for (const auto& [name, value] : out.headers) result.bytes += name + ": " + value + "\r\n";
  result.bytes += "Connection: close\r\nContent-Type: " + response.content_type +
                  "\r\nContent-Length: " + std::to_string(response.body.size()) + "\r\n\r\n";
  if (!head_only) result.bytes += response.body;
  return result;
}

}  // namespace herr
