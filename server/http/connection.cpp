#include "server/http/connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace herr {
namespace {

bool may_try_again(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

Connection::Connection(int fd, Clock::time_point deadline) : fd_(fd), deadline_(deadline) {}

Connection::~Connection() {
  if (fd_ >= 0) ::close(fd_);
}

Connection::Connection(Connection&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      state_(other.state_),
      deadline_(other.deadline_),
      received_(std::move(other.received_)),
      answer_(std::move(other.answer_)),
      sent_(other.sent_) {}

short Connection::poll_events() const {
  switch (state_) {
    case State::reading:
    case State::lingering:
      return POLLIN;
    case State::writing:
      return POLLOUT;
    case State::waiting:
    case State::closed:
      return 0;
  }
  return 0;
}

void Connection::receive(std::size_t most_bytes) {
  std::array<char, 4096> buffer;
  while (received_.size() < most_bytes) {
    const std::size_t wanted = std::min(buffer.size(), most_bytes - received_.size());
    const ssize_t count = ::recv(fd_, buffer.data(), wanted, 0);
    if (count > 0) {
      received_.append(buffer.data(), static_cast<std::size_t>(count));
      continue;
    }
    if (count == 0 || !may_try_again(errno)) close();
    return;
  }
}

void Connection::wait_for_answer(Clock::time_point deadline) {
  state_ = State::waiting;
  deadline_ = deadline;
}

void Connection::start_answer(std::string bytes, Clock::time_point deadline) {
  answer_ = std::move(bytes);
  sent_ = 0;
  state_ = State::writing;
  deadline_ = deadline;
}

void Connection::send(Clock::duration linger_time) {
  while (sent_ < answer_.size()) {
    const ssize_t count = ::send(fd_, answer_.data() + sent_, answer_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0) {
      if (!may_try_again(errno)) close();
      return;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  ::shutdown(fd_, SHUT_WR);
  std::string().swap(answer_);
  sent_ = 0;
  state_ = State::lingering;
  deadline_ = Clock::now() + linger_time;
}

void Connection::discard() {
  // A few kilobytes at a time: whoever floods waits for the poll like everybody else.
  std::array<char, 4096> buffer;
  for (int i = 0; i < 4; ++i) {
    const ssize_t count = ::recv(fd_, buffer.data(), buffer.size(), 0);
    if (count > 0) continue;
    if (count == 0 || !may_try_again(errno)) close();
    return;
  }
}

}  // namespace herr
