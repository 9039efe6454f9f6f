#pragma once
// A run of the fake target under a gdb server, and a gdb that is a raw socket.
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "board/gdb/gdb_server.hpp"
#include "fake_target.hpp"
#include "io/input/descriptor.hpp"

namespace dsdpv1::arm::test {

constexpr std::uint64_t kForEver = 1ULL << 60;  // instructions; stop() ends such a run

/// The run has a thread of its own and ends at the latest with this object.
class GdbBench {
 public:
  explicit GdbBench(std::uint64_t instructions = kForEver);
  ~GdbBench();
  GdbBench(const GdbBench&) = delete;
  GdbBench& operator=(const GdbBench&) = delete;

  FakeTarget target;  ///< to be set up before start(), to be looked at after end()
  /// Returns when the server listens.
  void start();
  int port() const { return port_; }
  /// As SIGINT does: ends a run that is halted, and one that is not.
  void stop() { stopped_ = true; }
  /// Waits until the run has ended and the server is gone.
  void end();
  /// Lines for the user up to now.
  std::vector<std::string> said() const;

 private:
  void run(GdbServer& server);

  std::uint64_t instructions_;
  std::atomic<bool> stopped_{false};
  mutable std::mutex mutex_;
  std::vector<std::string> said_;
  int port_ = 0;
  std::unique_ptr<GdbServer> server_;
  std::thread thread_;
};

/// Speaks to the server; whatever does not come within 300 s is a failure of the test and gives an empty text.
class RawGdb {
 public:
  explicit RawGdb(int port);
  void write(const std::string& bytes);
  /// The next `count` bytes, acknowledgements too.
  std::string read(std::size_t count);
  /// Sends a packet; returns the reply to it. Both are acknowledged.
  std::string ask(const std::string& packet);
  void send(const std::string& packet);
  /// The payload of the next packet, which is acknowledged.
  std::string reply();
  /// Whether the server has closed the connection.
  bool closed();
  void hang_up() { socket_.reset(); }

 private:
  tb::Descriptor socket_;
};

}  // namespace dsdpv1::arm::test
