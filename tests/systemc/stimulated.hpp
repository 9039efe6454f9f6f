#pragma once
// One stimulus for all modules in one simulation: the pin module (CLK unbound, bound, with another phase, in step) and
// the TLM module.
#include <tlm_utils/simple_initiator_socket.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/systemc/bench.hpp"

namespace dsdpv1::stimulated {

using dsdpv1::systemc::to_time;

constexpr Tick kResetAt = 12'007, kRequestAt = 480 * 3000, kOwnAt = kRequestAt + 12'031, kEnd = 170 * kUs;
constexpr Tick kFirstAccess = kOwnAt + 1201, kTelegramAt = 150 * kUs + 5, kBit = 1000;
constexpr Tick kPhase = 100;

struct Transaction {
  bool write;
  std::uint16_t address;
  std::uint8_t value;
};
inline const std::vector<Transaction> kTransactions = {{true, 0x021, 0x5A}, {false, 0x021, 0}, {false, 0x000, 0},
                                                       {false, 0x001, 0},   {false, 0x004, 0}, {true, 0x7FF, 0xC3},
                                                       {false, 0x7FF, 0}};
inline const std::vector<std::uint8_t> kTelegram = {0x10, 0x09, 0x02, 0x49, 0x54, 0x16};

inline HostAccess access_of(const Transaction& t) {
  return t.write ? HostAccess::write(t.address, t.value, AccessTiming{}) : HostAccess::read(t.address, AccessTiming{});
}

inline Tick add_accesses(Changes& stimulus) {
  Tick start = kFirstAccess;
  for (const Transaction& t : kTransactions) {
    const HostAccess access = access_of(t);
    for (const auto& edge : access)
      if (edge.pin != Pin::kDOut) stimulus.push_back({start + edge.at, edge.pin, edge.level});
    start += access.duration();
  }
  return start;
}

inline void add_telegram(Changes& stimulus) {
  Tick start = kTelegramAt;
  bool level = true;
  for (const std::uint8_t byte : kTelegram) {
    const std::uint16_t frame = dsdpv1::systemc::frame_of(byte, true, true);
    for (int bit = 0; bit < 11; ++bit, start += kBit) {
      const bool next = (frame >> bit & 1) != 0;
      if (next != level) stimulus.push_back({start, Pin::kPbrxd, next});
      level = next;
    }
  }
}

/// All inputs of the chip, in order of time.
inline const Changes& stimulus() {
  static const Changes all = [] {
    Changes s = {{kResetAt, Pin::kReset, 1}, {kRequestAt, Pin::kRReq, 1}, {kOwnAt, Pin::kRSta, 1}};
    const Tick end = add_accesses(s);
    s.push_back({end, Pin::kRSta, 0});
    s.push_back({end + 200, Pin::kRReq, 0});
    add_telegram(s);
    return s;
  }();
  return all;
}

/// A pin module with the stimulus, `shift` ticks later.
struct StimulatedPins : PinBench {
  StimulatedPins(const char* name, const dsdpv1::systemc::PinOptions& options, Tick shift) : PinBench(name, options) {
    thread([this, shift] {
      drive(Pin::kDIn, dsdpv1::kLevelZ);
      play(stimulus(), shift);
    });
    record(l_req, Pin::kLReq);
    record(l_sta, Pin::kLSta);
    method_on(d.value_changed_event(),
              [this] { data_bus.emplace_back(sc_core::sc_time_stamp(), d.read().to_string()); });
  }

  void record(sc_core::sc_signal<bool>& signal, Pin pin) {
    method_on(
        signal.value_changed_event(),
        [this, &signal, pin] {
          signals.push_back({dsdpv1::systemc::current_tick(), pin, static_cast<Level>(signal.read())});
          off_time += sc_core::sc_time_stamp() != to_time(dsdpv1::systemc::current_tick());
        });
  }

  Changes signals;
  int off_time = 0;
  std::vector<std::pair<sc_core::sc_time, std::string>> data_bus;
};

/// The TLM module with the same stimulus as transactions and characters.
struct StimulatedTlm : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip{"chip"};
  tlm_utils::simple_initiator_socket<StimulatedTlm> socket{"socket"};
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  Changes changes;
  std::vector<int> read;

  explicit StimulatedTlm(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.bind(chip.host_socket);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    chip.on_pin = [this](Tick at, Pin pin, Level level) { changes.push_back({at, pin, level}); };
    thread([this] { drive_pins(); });
    thread([this] { access(); });
    thread([this] { send(); });
  }

  void drive_pins() {
    for (const Change& c : stimulus()) {
      wait_until(c.at);
      if (c.pin == Pin::kReset) reset.write(c.level != 0);
      if (c.pin == Pin::kRReq) r_req.write(c.level != 0);
      if (c.pin == Pin::kRSta) r_sta.write(c.level != 0);
    }
  }

  void access() {
    sc_core::sc_time delay = to_time(kFirstAccess);  // as for a loosely-timed initiator that runs ahead
    for (const Transaction& t : kTransactions) {
      tlm::tlm_generic_payload payload;
      std::uint8_t byte = t.value;
      payload.set_command(t.write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND);
      payload.set_address(t.address);
      payload.set_data_ptr(&byte);
      payload.set_data_length(1);
      payload.set_streaming_width(1);
      socket->b_transport(payload, delay);
      if (!t.write) read.push_back(payload.is_response_ok() ? byte : -1);
    }
  }

  void send() {
    wait_until(kTelegramAt - kUs);
    for (std::size_t i = 0; i < kTelegram.size(); ++i) {
      chip.bus_in->write(
          {to_time(kTelegramAt + static_cast<Tick>(i) * 11 * kBit), to_time(kBit), kTelegram[i], true, true});
    }
  }
};

struct World {
  StimulatedPins unbound{"unbound", {}, 0};
  StimulatedPins step{"step", step_options(), 0};
  StimulatedPins shifted{"shifted", phase_options(), kPhase};
  StimulatedPins bound{"bound", {}, 0};
  StimulatedTlm tlm{"tlm"};
  sc_core::sc_signal<bool> clk{"clk"};

  World() {
    bound.chip.CLK(clk);
    thread([this] {
      for (Tick edge = 0; edge < kEnd; edge += 250) {
        wait_until(edge);
        clk.write(true);
        wait_until(edge + 125);
        clk.write(false);
      }
    });
  }

  static dsdpv1::systemc::PinOptions step_options() {
    dsdpv1::systemc::PinOptions options;
    options.chip.engine = Engine::kStep;
    return options;
  }
  static dsdpv1::systemc::PinOptions phase_options() {
    dsdpv1::systemc::PinOptions options;
    options.phase = kPhase;
    return options;
  }
};

}  // namespace dsdpv1::stimulated
