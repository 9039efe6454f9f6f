// The modules belong to the kernel's thread. Another thread asks by a queue, whose requests a process carries out.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "model/systemc/host_registers.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/foreign_cpu.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

namespace {

/// Requests of other threads. `post` may be called by any thread, all else belongs to the kernel's.
class Requests : public sc_core::sc_prim_channel {
 public:
  explicit Requests(const char* name) : sc_prim_channel(name) { async_attach_suspending(); }

  void post(std::function<void()> request) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.push_back(std::move(request));
    }
    async_request_update();
  }
  /// For a thread of the simulation: carries requests out and waits for more. The first ones may have come before the
  /// simulation: their event passes before any thread waits.
  [[noreturn]] void serve() {
    for (;;) {
      for (const std::function<void()>& request : take()) request();
      sc_core::wait(arrived_);
    }
  }

 private:
  void update() override { arrived_.notify(sc_core::SC_ZERO_TIME); }
  std::deque<std::function<void()>> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(waiting_, {});
  }

  std::mutex mutex_;
  std::deque<std::function<void()>> waiting_;
  sc_core::sc_event arrived_{"arrived"};
};

/// Will have what `request` returns in the simulation.
template <class Request>
auto begin(Requests& requests, Request request) {
  const auto task = std::make_shared<std::packaged_task<decltype(request())()>>(request);
  auto answer = task->get_future();
  requests.post([task] { (*task)(); });
  return answer;
}

template <class Request>
auto ask(Requests& requests, Request request) {
  return begin(requests, request).get();
}

TEST(AnotherThread, AsksAndIsAnsweredByTheKernelsThread) {
  const std::string answers = in_a_process_of_its_own([] {
    set_resolution();
    systemc::TlmModule chip("chip");
    systemc::HostRegisters registers("registers", {ForeignBus<>::kRegisters});
    ForeignBus<> bus("bus");
    ForeignCpu<> cpu("cpu", [](ForeignCpu<>&) {});
    cpu.socket.bind(bus.socket), bus.chip.bind(chip.host_socket), bus.registers.bind(registers.socket);
    registers.connect(chip);
    Requests requests("requests");
    thread([&] { requests.serve(); });
    const std::thread::id kernel = std::this_thread::get_id();
    bool at_the_kernel = true;
    std::string told;
    std::promise<void> asked;
    std::thread other([&] {
      const auto read = [&](std::uint16_t cell) {
        return ask(requests, [&, cell] {
          at_the_kernel = at_the_kernel && std::this_thread::get_id() == kernel;
          cpu.pass(100 * kUs);
          return cpu.read(cell);
        });
      };
      auto reset = begin(requests, [&] {
        cpu.write(ForeignBus<>::kRegisters + systemc::HostRegisters::kReset, 1);
        return 0;
      });
      asked.set_value();
      reset.get();
      read(0);  // a hundred microseconds pass
      ask(requests, [&] {
        cpu.write(ForeignBus<>::kRegisters, 3);
        return 0;
      });
      for (std::uint16_t cell = 0; cell < 4; ++cell) told += std::to_string(read(cell)) + " ";
      ask(requests, [] {
        sc_core::sc_stop();
        return 0;
      });
    });
    sc_core::sc_report_handler::set_actions("/dsdpv1/violation", sc_core::SC_DO_NOTHING);
    asked.get_future().wait();  // a request that comes before the simulation starts is carried out, too
    sc_core::sc_start();
    other.join();
    return told + (at_the_kernel ? "by the kernel" : "by another");
  });
  EXPECT_EQ(answers, "1 13 7 1 by the kernel");
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
