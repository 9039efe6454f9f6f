// Hosts outside of the simulation at chips of a SystemC platform: through a TCP port and a pseudo-terminal, in real
// time. The hosts are threads of this program that know the port only.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "tb/systemc/host/host_bridge.hpp"
#include "tests/systemc/own_process.hpp"
#include "tests/systemc/segment_platform.hpp"

namespace dsdpv1 {
namespace {

namespace serve = tb::serve;
using systemc_bench::HostBridge;
using namespace std::chrono_literals;

const std::string kAsk{'\x10', '\x09', '\x02', '\x49', '\x54', '\x16'};     // FDL status of station 9
const std::string kAnswer{'\x10', '\x02', '\x09', '\x00', '\x0B', '\x16'};  // a slave

/// A chip with its user CPU, on a segment with a host.
struct Island {
  systemc_bench::SegmentModule line;
  HostBridge host;
  segment_platform::Device device;

  Island(const std::string& name, std::unique_ptr<serve::HostConnection> port)
      : line((name + "_line").c_str()),
        host((name + "_host").c_str(), std::move(port), line, 0),
        device(name.c_str(), 0, {1, sc_core::SC_US}) {
    line.attach(device.chip);
    host.say = [](const std::string&) {};
  }
  int tcp_port() const {
    const std::string name = host.pacing().port;
    return std::stoi(name.substr(name.rfind(':') + 1));
  }
};

std::unique_ptr<serve::HostConnection> any_tcp() { return serve::open_tcp("127.0.0.1", 0, 10s); }

int connected(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof to) != 0) throw std::runtime_error("not connected");
  return fd;
}

/// Asks until there is an answer, as a master does while the chip searches the baud rate; then hangs up.
std::string asked(int fd) {
  std::string got;
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (got.size() < kAnswer.size() && std::chrono::steady_clock::now() < end) {
    if (::write(fd, kAsk.data(), kAsk.size()) < 0) break;
    for (pollfd wanted{fd, POLLIN, 0}; got.size() < kAnswer.size() && ::poll(&wanted, 1, 20) > 0;) {
      char some[64];
      const ssize_t count = ::read(fd, some, sizeof some);
      if (count <= 0) break;
      got.append(some, static_cast<std::size_t>(count));
    }
  }
  ::close(fd);
  return got.substr(0, kAnswer.size());
}

/// Runs until the hosts have finished, 10 s at most.
template <class... Hosts>
void run_until(std::future<Hosts>&... hosts) {
  for (int i = 0; i < 1000 && !((hosts.wait_for(0s) == std::future_status::ready) && ...); ++i)
    sc_core::sc_start(10, sc_core::SC_MS);
}

TEST(HostBridge, TwoHostsReachTwoChipsWithAnyQuantum) {
  for (const double quantum_us : {0., 100.}) {
    const std::string said = in_a_process_of_its_own([=] {
      tlm::tlm_global_quantum::instance().set({quantum_us, sc_core::SC_US});
      Island a("a", any_tcp()), b("b", serve::open_pty("", 12'000'000));
      const int port = a.tcp_port();
      const std::string terminal = b.host.pacing().port;
      auto at_a = std::async(std::launch::async, [=] { return asked(connected(port)); });
      auto at_b = std::async(std::launch::async, [=] {
        return asked(::open(terminal.substr(terminal.find('/')).c_str(), O_RDWR | O_NOCTTY));
      });
      run_until(at_a, at_b);
      return at_a.get() + at_b.get();
    });
    EXPECT_EQ(said, kAnswer + kAnswer) << quantum_us << " us";
  }
}

TEST(HostBridge, SimulationTimeIsRealTimeAndAStopPauses) {
  const std::string said = in_a_process_of_its_own([] {
    Island a("a", any_tcp());
    int slices = 0;
    a.host.stopped = [&slices] { return ++slices > 60; };  // 1 ms each while the line is not in use
    const auto begin = std::chrono::steady_clock::now();
    sc_core::sc_start(1, sc_core::SC_SEC);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double simulated = sc_core::sc_time_stamp().to_seconds();
    return std::to_string(simulated <= wall && simulated > 0.005 && simulated < 0.2) + " " + std::to_string(slices);
  });
  EXPECT_EQ(said, "1 61");
}

TEST(HostBridge, APlatformThatIsTooSlowIsReported) {
  const std::string said = in_a_process_of_its_own([] {
    Island a("a", any_tcp());
    std::string late;
    a.host.late = [&late](const std::string& text) { late = text; };
    thread([] {
      sc_core::wait(2, sc_core::SC_MS);
      std::this_thread::sleep_for(150ms);
    });
    sc_core::sc_start(10, sc_core::SC_MS);
    return late + (a.host.pacing().pace.losses == 1 ? "" : " not counted");
  });
  EXPECT_EQ(said.find("this computer is too slow: 1"), 0U) << said;
  EXPECT_NE(said.find("ms behind real time"), std::string::npos);
  EXPECT_EQ(said.find("not counted"), std::string::npos);
}

TEST(HostBridge, AHostThatDiesWithinATelegramLeavesNothingBehind) {
  const std::string said = in_a_process_of_its_own([] {
    Island a("a", any_tcp());
    const int port = a.tcp_port();
    auto first = std::async(std::launch::async, [=] { return asked(connected(port)); });
    run_until(first);
    auto dying = std::async(std::launch::async, [=] {
      const int fd = connected(port);
      const bool written = ::write(fd, kAsk.data(), 3) == 3;
      std::this_thread::sleep_for(5ms);
      ::close(fd);
      return written;
    });
    run_until(dying);
    auto next = std::async(std::launch::async, [=] { return asked(connected(port)); });
    run_until(next);
    return first.get() + next.get();
  });
  EXPECT_EQ(said, kAnswer + kAnswer);
}

TEST(HostBridge, AnExceptionOfAListenerLeavesTheSimulation) {
  const std::string said = in_a_process_of_its_own([] {
    Island a("a", any_tcp());
    const int port = a.tcp_port();
    a.host.say = [](const std::string& text) { throw std::runtime_error("thrown: " + text); };
    auto coming = std::async(std::launch::async, [=] { return connected(port); });
    try {
      run_until(coming);
      sc_core::sc_start(10, sc_core::SC_MS);
    } catch (const sc_core::sc_report& report) {
      return std::string(report.get_msg());
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  });
  EXPECT_NE(said.find("thrown: TCP port"), std::string::npos) << said;
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
