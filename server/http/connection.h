// One client: its socket, what it has sent so far, what it still has to get, and until when.
// Before: http_server accepts. After: it is closed, by whichever deadline or end comes first.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace herr {

class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  enum class State {
    reading,    // the head is not whole
    waiting,    // a lane makes the answer
    writing,    // the answer goes out
    lingering,  // all is sent; the client closes first, or the kernel would cut the answer off
    closed,
  };

  // Takes over the socket, which must be non-blocking.
  Connection(int fd, Clock::time_point deadline);
  ~Connection();
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&&) = delete;

  int fd() const { return fd_; }
  State state() const { return state_; }
  Clock::time_point deadline() const { return deadline_; }
  const std::string& received() const { return received_; }
  // Of the answer, which is held until the last of them is sent.
  std::size_t answer_bytes() const { return answer_.size(); }
  short poll_events() const;  // 0: nothing to wait for on the socket itself

  // Reads what is there, at most `most_bytes` in all. Closed when the client is gone.
  void receive(std::size_t most_bytes);
  void wait_for_answer(Clock::time_point deadline);
  void start_answer(std::string bytes, Clock::time_point deadline);
  // Sends what the socket takes; lingers once all is sent.
  void send(Clock::duration linger_time);
  // Throws away what a client says after its request; closed when it is gone.
  void discard();
  void close() { state_ = State::closed; }

 private:
  int fd_;
  State state_ = State::reading;
  Clock::time_point deadline_;
  std::string received_, answer_;
  std::size_t sent_ = 0;
};

}  // namespace herr
