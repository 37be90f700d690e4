#include "server/http/http_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/http/connection.h"
#include "server/http/request_head.h"
#include "server/http/work_lane.h"

namespace herr {
namespace {

using Clock = Connection::Clock;
using State = Connection::State;
using std::chrono::milliseconds;

constexpr int kSlowLaneNiceness = 10;      // a tenth of a render thread's share: late, but never never
constexpr milliseconds kStopTime{1000};    // for answers under way when the server stops
constexpr milliseconds kAcceptPause{100};  // when the process has no file descriptor left
constexpr milliseconds kLongestPoll{1000};

std::vector<std::string> allowed_names(const HttpServer::Config& config) {
  std::vector<std::string> names = host_names_for(config.host);
  names.insert(names.end(), config.allowed_hosts.begin(), config.allowed_hosts.end());
  return names;
}

// The rest is for the files of the session and of the scene, which are opened while clients are there.
std::size_t most_connections(std::size_t wanted) {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur == RLIM_INFINITY) return wanted;
  return std::min<std::size_t>(wanted, std::max<std::size_t>(files.rlim_cur / 2, 1));
}

}  // namespace

std::vector<std::string> host_names_for(const std::string& host) {
  std::vector<std::string> names{"127.0.0.1", "localhost", "[::1]"};
  const bool ipv6 = host.find(':') != std::string::npos;
  const std::string name = ipv6 ? "[" + host + "]" : host;
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

class HttpServer::Loop {
 public:
  Loop(Config config, HttpHandler handler);
  ~Loop();

  int port() const { return listener_.port; }
  HttpCounters counters() const;
  void stop();

 private:
  struct Made {
    std::uint64_t id;
    HttpLibrary::Answer answer;
  };

  void run();
  bool all_done(Clock::time_point now) const;
  void wait_for_events();
  void handle(std::uint64_t id, Connection& connection);
  void handle_head(std::uint64_t id, Connection& connection);
  void refuse(Connection& connection, int status, const std::string& reason, bool head_only);
  void answer(Connection& connection, HttpLibrary::Answer made);
  void bound_untaken();
  void accept_clients();
  bool make_room();
  void take_made_answers();
  void end_late_ones();
  void wake() const;

  const Config config_;
  const std::vector<std::string> host_names_;
  const std::size_t most_connections_;
  HttpLibrary library_;
  HttpLibrary::Listener listener_;
  int wake_fd_ = -1;
  std::atomic<bool> stopping_{false};
  Clock::time_point stop_deadline_{};
  Clock::time_point accept_again_{};
  std::map<std::uint64_t, Connection> connections_;  // by age: the first is the oldest
  std::uint64_t next_id_ = 0;
  std::mutex made_mutex_;
  std::vector<Made> made_;
  mutable std::mutex counters_mutex_;
  HttpCounters counters_;
  // The lanes end before what their jobs use; the polling thread before the lanes.
  std::unique_ptr<WorkLane> quick_lane_, slow_lane_;
  std::thread thread_;
};

HttpServer::Loop::Loop(Config config, HttpHandler handler)
    : config_(std::move(config)),
      host_names_(allowed_names(config_)),
      most_connections_(most_connections(config_.limits.connections)),
      library_(std::move(handler)) {
  wake_fd_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (wake_fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  try {
    listener_ = library_.bind(config_.host, config_.port);
  } catch (...) {
    ::close(wake_fd_);
    throw;
  }
  quick_lane_ = std::make_unique<WorkLane>(config_.limits.waiting, 0);
  slow_lane_ = std::make_unique<WorkLane>(config_.limits.waiting, kSlowLaneNiceness);
  thread_ = std::thread([this] { run(); });
}

HttpServer::Loop::~Loop() {
  stop();
  quick_lane_.reset();
  slow_lane_.reset();
  ::close(wake_fd_);
}

void HttpServer::Loop::stop() {
  stopping_ = true;
  wake();
  if (thread_.joinable()) thread_.join();
}

void HttpServer::Loop::wake() const {
  const std::uint64_t one = 1;
  // A counter that is full wakes as well.
  [[maybe_unused]] const ssize_t written = ::write(wake_fd_, &one, sizeof one);
}

HttpCounters HttpServer::Loop::counters() const {
  const std::lock_guard lock(counters_mutex_);
  return counters_;
}

void HttpServer::Loop::run() {
  for (;;) {
    const Clock::time_point now = Clock::now();
    if (stopping_ && listener_.fd >= 0) {
      ::close(std::exchange(listener_.fd, -1));
      stop_deadline_ = now + kStopTime;
    }
    if (listener_.fd < 0 && all_done(now)) break;
    wait_for_events();
    take_made_answers();
    end_late_ones();
    std::erase_if(connections_, [](const auto& entry) { return entry.second.state() == State::closed; });
  }
  connections_.clear();
}

// While stopping: only answers that are under way are worth waiting for.
bool HttpServer::Loop::all_done(Clock::time_point now) const {
  return now >= stop_deadline_ ||
         std::none_of(connections_.begin(), connections_.end(), [](const auto& entry) {
           return entry.second.state() == State::waiting || entry.second.state() == State::writing;
         });
}

void HttpServer::Loop::wait_for_events() {
  const Clock::time_point now = Clock::now();
  Clock::time_point until = now + kLongestPoll;
  if (listener_.fd < 0) until = std::min(until, stop_deadline_);
  std::vector<pollfd> polled{{wake_fd_, POLLIN, 0}};
  const bool accepts = listener_.fd >= 0 && now >= accept_again_;
  if (accepts) polled.push_back({listener_.fd, POLLIN, 0});
  if (listener_.fd >= 0 && !accepts) until = std::min(until, accept_again_);
  std::vector<std::uint64_t> ids;
  for (const auto& [id, connection] : connections_) {
    until = std::min(until, connection.deadline());
    // Not asked about while it waits: a client that hangs up would end every poll at once.
    if (connection.poll_events() == 0) continue;
    polled.push_back({connection.fd(), connection.poll_events(), 0});
    ids.push_back(id);
  }
  const auto wait = std::chrono::ceil<milliseconds>(std::max(until - now, Clock::duration::zero()));
  if (::poll(polled.data(), polled.size(), static_cast<int>(wait.count())) <= 0) return;

  if (polled.front().revents != 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t drained = ::read(wake_fd_, &count, sizeof count);
  }
  const std::size_t first = polled.size() - ids.size();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (polled[first + i].revents != 0) handle(ids[i], connections_.at(ids[i]));
  }
  if (accepts && polled[1].revents != 0) accept_clients();
}

void HttpServer::Loop::handle(std::uint64_t id, Connection& connection) {
  switch (connection.state()) {
    case State::reading:
      handle_head(id, connection);
      return;
    case State::writing:
      connection.send(config_.limits.linger_time);
      return;
    case State::lingering:
      connection.discard();
      return;
    case State::waiting:
    case State::closed:
      return;
  }
}

void HttpServer::Loop::handle_head(std::uint64_t id, Connection& connection) {
  connection.receive(kMostHeadBytes);
  const std::optional<std::size_t> length = head_length(connection.received());
  if (!length) {
    const bool full = connection.received().size() >= kMostHeadBytes;
    if (full && connection.state() == State::reading) refuse(connection, 431, "size", false);
    return;
  }
  // A client that has shut its sending side down may still read.
  const RequestHead head =
      judge_head(std::string_view(connection.received()).substr(0, *length), host_names_, config_.token);
  if (head.status != 0) {
    refuse(connection, head.status, head.reason, head.head_only);
    return;
  }
  const bool slow = !config_.slow_prefix.empty() && head.target.starts_with(config_.slow_prefix);
  WorkLane& lane = slow ? *slow_lane_ : *quick_lane_;
  connection.wait_for_answer(Clock::now() + config_.limits.answer_time);
  const bool taken = lane.try_put([this, id, target = head.target, head_only = head.head_only] {
    HttpLibrary::Answer made = library_.answer(target, head_only);
    {
      const std::lock_guard lock(made_mutex_);
      made_.push_back({id, std::move(made)});
    }
    wake();
  });
  if (!taken) refuse(connection, 503, "busy", head.head_only);
}

void HttpServer::Loop::refuse(Connection& connection, int status, const std::string& reason, bool head_only) {
  {
    const std::lock_guard lock(counters_mutex_);
    ++counters_.rejected[reason];
  }
  answer(connection, library_.refuse(status, head_only));
}

void HttpServer::Loop::answer(Connection& connection, HttpLibrary::Answer made) {
  {
    const std::lock_guard lock(counters_mutex_);
    ++counters_.requests[made.status];
  }
  connection.start_answer(std::move(made.bytes), Clock::now() + config_.limits.send_time);
  connection.send(config_.limits.linger_time);
  if (connection.state() == State::writing) bound_untaken();
}

void HttpServer::Loop::bound_untaken() {
  std::size_t held = 0;
  // From the youngest on: whatever does not fit beside the younger ones has had the longest time.
  for (auto entry = connections_.rbegin(); entry != connections_.rend(); ++entry) {
    Connection& connection = entry->second;
    if (connection.state() != State::writing) continue;
    const std::size_t bytes = connection.answer_bytes();
    // One answer may be larger than that by itself.
    if (held == 0 || held + bytes <= config_.limits.untaken_bytes) {
      held += bytes;
      continue;
    }
    connection.close();
    const std::lock_guard lock(counters_mutex_);
    ++counters_.rejected["unread"];
  }
}

void HttpServer::Loop::take_made_answers() {
  std::vector<Made> made;
  {
    const std::lock_guard lock(made_mutex_);
    made.swap(made_);
  }
  for (Made& one : made) {
    const auto found = connections_.find(one.id);
    if (found == connections_.end()) continue;  // it took too long, and the client was let go
    if (found->second.state() == State::waiting) answer(found->second, std::move(one.answer));
  }
}

void HttpServer::Loop::end_late_ones() {
  const Clock::time_point now = Clock::now();
  for (auto& [id, connection] : connections_) {
    if (now < connection.deadline()) continue;
    const bool silent = connection.received().empty();
    switch (connection.state()) {
      case State::reading:
        // Whoever has said nothing (a probe, a browser's spare connection) is told nothing.
        if (silent) {
          connection.close();
        } else {
          refuse(connection, 408, "time", false);
        }
        break;
      case State::waiting:
        refuse(connection, 503, "late", false);
        break;
      default:
        connection.close();
    }
  }
}

// At the limit the longest incomplete request goes; false when every connection is being answered.
bool HttpServer::Loop::make_room() {
  for (const State expendable : {State::lingering, State::reading}) {
    const auto oldest = std::find_if(connections_.begin(), connections_.end(),
                                     [&](const auto& entry) { return entry.second.state() == expendable; });
    if (oldest == connections_.end()) continue;
    if (expendable == State::reading) {
      const std::lock_guard lock(counters_mutex_);
      ++counters_.rejected["crowd"];
    }
    connections_.erase(oldest);
    return true;
  }
  return false;
}

void HttpServer::Loop::accept_clients() {
  bool dropped = false;
  for (;;) {
    if (connections_.size() >= most_connections_) {
      if (dropped) return;  // those that are there have their turn before the next poll accepts another
      if (!make_room()) break;
      dropped = true;
    }
    const int fd = ::accept4(listener_.fd, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd >= 0) {
      const int on = 1;
      ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      const std::uint64_t id = next_id_++;
      Connection& connection =
          connections_.emplace(id, Connection(fd, Clock::now() + config_.limits.request_time)).first->second;
      // Most requests are there already.
      handle_head(id, connection);
      continue;
    }
    if (errno == EINTR || errno == ECONNABORTED) continue;
    // None left to accept, or none may be: too few descriptors or too little memory pass.
    if (errno != EAGAIN && errno != EWOULDBLOCK) accept_again_ = Clock::now() + kAcceptPause;
    return;
  }
  accept_again_ = Clock::now() + kAcceptPause;
}

HttpServer::HttpServer(Config config, HttpHandler handler)
    : loop_(std::make_unique<Loop>(std::move(config), std::move(handler))) {}

HttpServer::~HttpServer() = default;

int HttpServer::port() const {
  return loop_->port();
}

HttpCounters HttpServer::counters() const {
  return loop_->counters();
}

void HttpServer::stop() {
  loop_->stop();
}

}  // namespace herr
