// Telegrams as runs in the TLM module: two chips on the same line. Every pin change of one is observed, none of the
// other. Their reports of the bus must be the same, whatever interrupts the telegrams.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include <algorithm>
#include <memory>
#include <random>

#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::TlmModule;
using dsdpv1::systemc::TlmOptions;
using dsdpv1::systemc::to_time;

namespace {

constexpr Tick kBit = 1000, kCharacter = 11 * kBit, kPause = 40 * kBit;  // 12 Mbit/s, longer than T_SYN
constexpr std::uint8_t kAddress = 9;
const std::vector<std::uint8_t> kFdlStatus = {0x10, kAddress, 2, 0x49, 0x54, 0x16};
const std::vector<std::uint8_t> kToAnother = {0x10, 7, 2, 0x49, 0x52, 0x16};
const std::vector<std::uint8_t> kNoTelegram = {0x10, kAddress, 0x00, 0xFF, 0x16};

/// A chip and its reports.
struct Station : sc_core::sc_module, tlm::tlm_analysis_if<BusCharacter> {
  TlmModule chip;
  tlm_utils::simple_initiator_socket<Station> cpu{"cpu"};
  std::vector<BusCharacter> sent;
  std::vector<sc_core::sc_time> sent_at;
  std::vector<profibus::Event> events;
  Changes changes;

  Station(const sc_core::sc_module_name& name, bool hears_pins) : sc_module(name), chip("chip", options()) {
    cpu.bind(chip.host_socket);
    chip.bus_out.bind(*this);
    chip.on_event = [this](const profibus::Event& event) { events.push_back(event); };
    if (hears_pins)
      chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
  }
  static TlmOptions options() {
    TlmOptions options;
    options.report_violations = false;
    options.chip.baud_control_ms = 1;
    return options;
  }
  void write(const BusCharacter& character) override {
    sent.push_back(character);
    sent_at.push_back(sc_core::sc_time_stamp());
  }
  /// The user's part without the pins: table 2's initialisation data and their flag.
  void initialise() {
    chip.sync();
    std::vector<std::uint8_t> init = {16, kAddress, 0x0C, 0x0D, 0, 0, 0, 4, 4, 0, 0, 0, 2, 0, 2, 0x13, 0x23};
    std::uint16_t crc = 0xFFFF, cell = dsdpv1::regs::kInit;
    for (const std::uint8_t byte : init) {
      chip.poke(cell++, byte);
      crc = static_cast<std::uint16_t>(crc ^ byte);
      for (int i = 0; i < 8; ++i) crc = static_cast<std::uint16_t>((crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1);
    }
    chip.poke(dsdpv1::regs::kInitCrc, static_cast<std::uint8_t>(crc >> 8));
    chip.poke(dsdpv1::regs::kInitCrc + 1, static_cast<std::uint8_t>(crc & 0xFF));
    chip.poke(dsdpv1::regs::kUserCommand1, dsdpv1::regs::kUserCommand1Init);
  }
  std::ptrdiff_t baud_lost() const {
    return std::count_if(
        events.begin(), events.end(), [](const auto& e) { return e.reason == profibus::Reason::kBaudLost; });
  }
};

struct Line : sc_core::sc_module {
  Station told{"told", true}, untold{"untold", false};
  sc_core::sc_signal<bool> reset, r_req, r_sta, raw{"raw", true}, raw_of_told{"raw_of_told", true};
  int cuts = 0, resets = 0, collisions = 0, stops = 0, searches = 0;

  explicit Line(const sc_core::sc_module_name& name) : sc_module(name) {
    for (Station* each : {&told, &untold}) each->chip.RESET(reset), each->chip.R_REQ(r_req), each->chip.R_STA(r_sta);
    told.chip.PBRXD(raw_of_told), untold.chip.PBRXD(raw);
    thread([this] { run(); });
  }

  void run() {
    power_on();
    for (int i = 0; i < 600; ++i) {
      const auto& telegram = choose(3) == 0 ? kToAnother : choose(4) == 0 ? kNoTelegram : kFdlStatus;
      const Tick start = dsdpv1::systemc::current_tick() + choose(3) * 250;
      const Tick end = start + static_cast<Tick>(telegram.size()) * kCharacter;
      switch (choose(10)) {
        case 0: send_one_by_one(telegram); break;
        case 1: send(start, telegram), break_in(start, end); break;
        case 2: send(start, telegram), collide(start, end); break;
        case 3: send_broken(start, telegram); break;
        case 4: send(start, telegram), reset_during_answer(end); break;
        case 5: stop_sending(telegram); break;
        case 6: search_in_telegram(); break;
        default: send(start, telegram); break;
      }
      wait_until(std::max(end, dsdpv1::systemc::current_tick()) + 20 * kCharacter + kPause + choose(250));
    }
  }

 private:
  void power_on() {
    wait_until(dsdpv1::systemc::current_tick() + 100);
    reset.write(true);
    wait_until(dsdpv1::systemc::current_tick() + 100 * kUs);
    for (Station* each : {&told, &untold}) each->initialise();
    wait_until(dsdpv1::systemc::current_tick() + 20 * kUs);
  }
  Tick choose(int below) { return static_cast<Tick>(random_() % static_cast<unsigned>(below)); }
  void put(const BusCharacter& character) {
    for (Station* each : {&told, &untold}) each->chip.bus_in->write(character);
  }
  void send(Tick start, const std::vector<std::uint8_t>& telegram) {
    for (const std::uint8_t byte : telegram) {
      put({to_time(start), to_time(kBit), byte, true, true});
      start += kCharacter;
    }
  }
  void send_one_by_one(const std::vector<std::uint8_t>& telegram) {
    Tick at = dsdpv1::systemc::current_tick();
    for (const std::uint8_t byte : telegram) {
      put({to_time(at), to_time(kBit), byte, true, true});
      wait_until(at += kCharacter);
    }
  }
  void send_broken(Tick start, const std::vector<std::uint8_t>& telegram) {
    const Tick broken = choose(static_cast<int>(telegram.size()));
    for (std::size_t i = 0; i < telegram.size(); ++i) {
      const bool right = static_cast<Tick>(i) != broken;
      put({to_time(start), to_time(kBit), telegram[i], right, right || choose(2) == 0});
      start += kCharacter;
    }
  }
  void break_in(Tick start, Tick end) {
    ++cuts;
    wait_until(start + choose(static_cast<int>(end - start)));
    raw.write(false), raw_of_told.write(false);
    wait_until(dsdpv1::systemc::current_tick() + 1 + choose(3 * kBit));
    raw.write(true), raw_of_told.write(true);
  }
  /// The sender stops anywhere, and the line idles: one chip has heard a run that is left, the other the changes.
  void stop_sending(const std::vector<std::uint8_t>& telegram) {
    const Tick start = dsdpv1::systemc::current_tick(), end = start + static_cast<Tick>(telegram.size()) * kCharacter;
    const profibus::CharacterRun run{start, kBit / profibus::kTicksPerCycle, telegram.data(),
                                     static_cast<int>(telegram.size())};
    if (!untold.chip.hear_run(run)) return;
    ++stops;
    const Tick stop = start + 1 + choose(static_cast<int>(end - start) - 1);
    for (Tick bit = start; bit < stop; bit += kBit) {
      wait_until(bit);
      const auto index = static_cast<std::size_t>((bit - start) / kCharacter);
      raw_of_told.write((profibus::frame_of(telegram[index]) >> ((bit - start) % kCharacter / kBit) & 1U) != 0);
    }
    wait_until(stop);
    raw_of_told.write(true);
    untold.chip.leave_run();
  }
  void collide(Tick start, Tick end) {
    ++collisions;
    if (choose(2) == 0) wait_until(start + choose(static_cast<int>(end - start) / 2));
    const Tick last = end - kCharacter + 1, now = dsdpv1::systemc::current_tick();
    put({to_time(std::max(now, last + choose(10 * kBit))), to_time(kBit), 0xA5, true, true});
  }
  /// The baud rate is given up during a telegram for another station (S22); another telegram finds it again.
  void search_in_telegram() {
    const Tick length = static_cast<Tick>(kToAnother.size()) * kCharacter;
    wait_until(dsdpv1::systemc::current_tick() + choose(static_cast<int>(length)));
    for (const auto before = untold.baud_lost(); untold.baud_lost() == before;) {
      const Tick start = dsdpv1::systemc::current_tick(), end = start + length;
      send(start, kToAnother);
      wait_until(end - 1);
      searches += untold.baud_lost() != before ? 1 : 0;
      wait_until(end + kPause);
    }
  }
  void reset_during_answer(Tick end) {
    ++resets;
    wait_until(end + choose(20 * kCharacter));
    reset.write(false);
    wait_until(dsdpv1::systemc::current_tick() + 10 * kUs);
    power_on();
  }

  std::mt19937 random_{20261123};
};

std::unique_ptr<Line> line;

bool same(const profibus::Event& a, const profibus::Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

}  // namespace

void simulate() {
  set_resolution();
  collect_reports();
  line = std::make_unique<Line>("line");
  sc_core::sc_start(180, sc_core::SC_MS);
}

namespace {

TEST(Runs, WhatBreaksInHasHappened) {
  EXPECT_GT(line->cuts, 10);
  EXPECT_GT(line->resets, 10);
  EXPECT_GT(line->collisions, 10);
  EXPECT_GT(line->stops, 10);
  EXPECT_GT(line->searches, 10);
}

TEST(Runs, TheCharactersOfTheChipAreTheSame) {
  ASSERT_GT(line->told.sent.size(), 500U);
  ASSERT_EQ(line->told.sent.size(), line->untold.sent.size());
  EXPECT_EQ(line->told.sent_at, line->untold.sent_at);
  for (std::size_t i = 0; i < line->told.sent.size(); ++i) {
    const BusCharacter &a = line->told.sent[i], &b = line->untold.sent[i];
    ASSERT_TRUE(a.start == b.start && a.bit == b.bit && a.data == b.data && a.parity_ok == b.parity_ok &&
                a.stop_ok == b.stop_ok)
        << i << ": " << a << " and " << b;
  }
}

TEST(Runs, TheEventsOfTheChipAreTheSame) {
  ASSERT_GT(line->told.events.size(), 100U);
  ASSERT_EQ(line->told.events.size(), line->untold.events.size());
  for (std::size_t i = 0; i < line->told.events.size(); ++i)
    ASSERT_TRUE(same(line->told.events[i], line->untold.events[i]))
        << dsdpv1::describe(line->told.events[i]) << " at " << line->told.events[i].at << " and "
        << dsdpv1::describe(line->untold.events[i]) << " at " << line->untold.events[i].at;
}

}  // namespace
}  // namespace dsdpv1
