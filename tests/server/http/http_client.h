// A client for tests of the HTTP server: plain sockets, so that it can be as rude as clients are.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>

namespace herr {

class RawClient {
 public:
  explicit RawClient(int port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    const timeval longest{10, 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
  }
  ~RawClient() { ::close(fd_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool connected() const { return connected_; }
  // False when the server has closed.
  bool send(std::string_view text) {
    return ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  // Of the next bytes at most twelve, once there are any.
  std::string receive_some() {
    char buffer[12];
    const ssize_t count = receive_into(buffer, sizeof buffer);
    return {buffer, count > 0 ? static_cast<std::size_t>(count) : 0};
  }
  // Everything until the server closes.
  std::string receive() {
    std::string text;
    char buffer[4096];
    for (;;) {
      const ssize_t count = receive_into(buffer, sizeof buffer);
      if (count <= 0) return text;
      text.append(buffer, static_cast<std::size_t>(count));
    }
  }

 private:
  // A child process that ends interrupts a recv that has a time limit, even where nobody handles SIGCHLD.
  ssize_t receive_into(char* buffer, std::size_t size) const {
    for (;;) {
      const ssize_t count = ::recv(fd_, buffer, size, 0);
      if (count >= 0 || errno != EINTR) return count;
    }
  }

  int fd_;
  bool connected_ = false;
};

struct Reply {
  int status = 0;
  std::string head, body;

  // Of the first header of that name (as the server writes it); empty when there is none.
  std::string header(const std::string& name) const {
    const std::size_t start = head.find("\r\n" + name + ": ");
    if (start == std::string::npos) return {};
    const std::size_t value = start + name.size() + 4;
    return head.substr(value, head.find("\r\n", value) - value);
  }
};

inline Reply ask(int port, const std::string& request) {
  RawClient client(port);
  EXPECT_TRUE(client.connected());
  client.send(request);
  const std::string all = client.receive();
  Reply reply;
  const std::size_t end = all.find("\r\n\r\n");
  if (all.size() < 12 || end == std::string::npos) return reply;
  reply.status = std::atoi(all.substr(9, 3).c_str());
  reply.head = all.substr(0, end + 2);
  reply.body = all.substr(end + 4);
  return reply;
}

inline std::string request_text(const std::string& target, const std::string& method = "GET",
                                const std::string& headers = "Host: 127.0.0.1\r\n") {
  return method + " " + target + " HTTP/1.1\r\n" + headers + "\r\n";
}

inline Reply get(int port, const std::string& target) {
  return ask(port, request_text(target));
}

}  // namespace herr
