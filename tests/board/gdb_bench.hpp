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

/// The run has a separate thread and ends at the latest with this object.
class GdbBench {
 public:
  explicit GdbBench(std::uint64_t instructions = kForEver);
  ~GdbBench();
  GdbBench(const GdbBench&) = delete;
  GdbBench& operator=(const GdbBench&) = delete;

  FakeTarget target;  ///< set it up before start(), check it after end()
  /// Returns when the server is listening.
  void start();
  int port() const { return port_; }
  /// As SIGINT: ends a run, halted or not.
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

/// Talks to the server; if it does not answer within 300 s the test fails and the text is empty.
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
  /// True if the server has closed the connection.
  bool closed();
  void hang_up() { socket_.reset(); }

 private:
  tb::Descriptor socket_;
};

}  // namespace dsdpv1::arm::test
