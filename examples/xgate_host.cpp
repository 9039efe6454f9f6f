// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// An XGate-DPS10 on a segment with a master. The program is the module's host: driver/xgate, which sends and receives
// the bytes of its UART. Each wait of the host runs segment, master and module.
#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <string>

#include "bus/master/master1.hpp"
#include "driver/xgate/xgate.h"
#include "model/xgate/module.hpp"

using namespace dsdpv1;
using profibus::Cycle;
using profibus::kTicksPerCycle;

namespace {

constexpr std::uint8_t kSlave = 6;
constexpr std::array<std::uint8_t, 2> kCfg = {0x13, 0x23};  // 4 bytes of inputs, 4 of outputs

void say(bus::Tick now, const std::string& what, const std::uint8_t* bytes = nullptr, std::size_t count = 0) {
  std::printf("%10.3f us  %s", static_cast<double>(now) / bus::kTicksPerUs, what.c_str());
  for (std::size_t i = 0; i < count; ++i) std::printf(" %02X", bytes[i]);
  std::printf("\n");
}

/// The module as a station of the segment, with its UART.
class Station : public bus::Agent, private bus::Listener {
 public:
  explicit Station(bus::Segment& segment) : segment_(segment), id_(segment.attach("module", this)) {
    module_.on_byte({[](void* self, Cycle /*begins*/, Cycle ends, std::uint8_t byte) {
                       static_cast<Station*>(self)->sent_.push_back({ends * kTicksPerCycle, byte});
                     },
                     this});
  }

  bus::Tick next() const override {
    const Cycle edge = module_.next();
    return edge == profibus::kNever ? bus::kNever : std::max(edge, last_ + 1) * kTicksPerCycle;
  }
  void run(bus::Tick now) override {
    last_ = now / kTicksPerCycle;
    module_.eval(last_);
    segment_.drive(id_, now, module_.rts(), module_.txd());
  }

  // Inputs of the module change from `now` on, up to which it has run.
  void release_reset(bus::Tick now) {
    module_.set_reset(now / kTicksPerCycle, false);
    announce();
  }
  void receive(bus::Tick now, std::uint8_t byte) {
    module_.receive(now / kTicksPerCycle, byte);
    announce();
  }
  /// A byte of the module whose stop bit has ended; -1: none.
  int take(bus::Tick now) {
    if (sent_.empty() || sent_.front().ends > now) return -1;
    const int byte = sent_.front().byte;
    sent_.pop_front();
    return byte;
  }
  /// Ticks of a byte, 10 bits.
  bus::Tick byte_time() const { return 10'000 * bus::kTicksPerMs / module_.rate(); }

 private:
  struct Sent {
    bus::Tick ends;
    std::uint8_t byte;
  };
  void line_changed(bus::Tick at, bool level) override {
    if (module_.set_rxd(at, level)) announce();
  }

  bus::Segment& segment_;
  bus::StationId id_;
  xgate::Module module_;
  Cycle last_ = 0;  // the last edge
  std::deque<Sent> sent_;
};

struct Bench {
  bus::Segment segment;
  bus::Timeline timeline;
  Station module{segment};
  bus::Master1 master{segment, bus::MasterConfig{}};

  Bench() {
    timeline.add(module);
    timeline.add(master);
    bus::SlaveParameters slave;
    slave.address = kSlave;
    slave.ident = 0x0F01;
    slave.cfg.assign(kCfg.begin(), kCfg.end());
    slave.input_length = slave.output_length = 4;
    master.add_slave(slave);
    master.set_outputs(kSlave, {1, 2, 3, 4});
    master.on_state = [](bus::Tick at, std::uint8_t, bus::SlaveState, bus::SlaveState to) {
      say(at, std::string("master: slave is ") + bus::name(to));
    };
    master.on_inputs = [this](bus::Tick at, std::uint8_t address) {
      const bus::Bytes& inputs = master.slave(address).inputs;
      say(at, "master: inputs", inputs.data(), inputs.size());
    };
  }
  void wait(bus::Tick ticks) { timeline.run_until(timeline.now() + ticks); }

  // --- the host's port (driver/xgate/xgate.h)
  static void send(void* self, const std::uint8_t* bytes, std::uint16_t length) {
    auto& bench = *static_cast<Bench*>(self);
    for (int i = 0; i < length; ++i) {
      bench.wait(bench.module.byte_time());
      bench.module.receive(bench.timeline.now(), bytes[i]);
    }
  }
  static int receive(void* self, std::uint16_t ms) {
    auto& bench = *static_cast<Bench*>(self);
    const bus::Tick end = bench.timeline.now() + ms * bus::kTicksPerMs;
    for (;;) {
      const int byte = bench.module.take(bench.timeline.now());
      if (byte >= 0 || bench.timeline.now() >= end) return byte;
      bench.wait(bus::kTicksPerUs);
    }
  }
};

}  // namespace

int main() {
  Bench bench;
  bench.module.release_reset(bench.timeline.now());
  bench.wait(11 * bus::kTicksPerMs);  // X18: 10 ms to the first frame

  xgate_module host;
  const xgate_port port = {&bench, Bench::send, Bench::receive};
  const xgate_application application = {};
  xgate_open(&host, &port, &application);
  xgate_config config = {};
  config.address = kSlave;
  config.ident = 0x0F01;
  config.inputs = config.outputs = 4;
  config.cfg_length = kCfg.size();
  for (std::size_t i = 0; i < kCfg.size(); ++i) config.cfg[i] = kCfg[i];
  const xgate_result initialised = xgate_initialise(&host, &config);
  say(bench.timeline.now(), initialised == XGATE_OK ? "host: initialised" : "host: command 04 failed");
  bench.master.start();

  std::uint8_t inputs[4] = {}, outputs[4] = {}, length = 0;
  for (int turn = 0; turn < 4; ++turn) {
    const xgate_result result = xgate_exchange(&host, inputs, sizeof inputs, outputs, sizeof outputs, &length);
    if (result == XGATE_OK)
      say(bench.timeline.now(), "host: outputs", outputs, length);
    else
      say(bench.timeline.now(),
          "host: error " + std::to_string(host.error_class) + "/" + std::to_string(host.error_code));
    for (std::size_t i = 0; i < sizeof inputs; ++i) inputs[i] = static_cast<std::uint8_t>(~outputs[i]);
  }
  return 0;
}
