// Chips of two families and a master on a segment at the level of characters: the same as by pins, with collisions.
#include <gtest/gtest.h>

#include "tb/systemc/character_station.hpp"
#include "tests/systemc/own_process.hpp"
#include "tests/systemc/segment_platform.hpp"

namespace dsdpv1 {
namespace {

using segment_platform::Choice;
using segment_platform::kEnd;

struct Told {
  std::string all;
  std::uint64_t deltas = 0;
};

Told run(const Choice& choice) {
  const std::string text = in_a_process_of_its_own([=] {
    collect_reports();
    sc_core::sc_set_time_resolution(choice.femtoseconds, sc_core::SC_FS);
    tlm::tlm_global_quantum::instance().set({choice.quantum_us, sc_core::SC_US});
    segment_platform::Platform platform(choice);
    sc_core::sc_start(systemc::to_time(kEnd));
    return std::to_string(sc_core::sc_delta_count()) + "\n" + platform.told();
  });
  Told told;
  std::istringstream(text) >> told.deltas;
  told.all = text.substr(text.find('\n') + 1);
  return told;
}

Choice with(void (*change)(Choice&)) {
  Choice choice;
  change(choice);
  return choice;
}

const Told& by_pins() {
  static const Told once = run(with([](Choice& c) { c.pins = true; }));
  return once;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(SegmentModule, MasterAndChipsOfTwoFamiliesExchangeDataUntilTheyAreDisturbed) {
  const std::string undisturbed = by_pins().all.substr(0, by_pins().all.find("line:"));
  EXPECT_NE(undisturbed.find("slave 9 is DATA_EXCH"), std::string::npos);
  EXPECT_NE(undisturbed.find("slave 11 is DATA_EXCH"), std::string::npos);
  EXPECT_GT(count(by_pins().all, " collided"), 100U) << "the disturbing station and the two chips with one address";
}

TEST(SegmentModule, EachBitIsThatOfTheSameChipsByTheirPins) {
  EXPECT_EQ(first_difference(run({}).all, by_pins().all), "");
  const Told observed = run(with([](Choice& c) { c.observed = true; }));
  const Told both = run(with([](Choice& c) { c.observed = c.pins = true; }));
  EXPECT_EQ(first_difference(observed.all, both.all), "") << "all pins";
}

TEST(SegmentModule, TheQuantumChangesNothing) {
  for (const double quantum_us : {1., 10., 100.}) {
    Choice choice;
    choice.quantum_us = quantum_us;
    EXPECT_EQ(first_difference(run(choice).all, by_pins().all), "") << quantum_us << " us";
  }
}

TEST(SegmentModule, AtAPicosecondEverythingIsAtTheSameTick) {
  EXPECT_EQ(first_difference(run(with([](Choice& c) { c.femtoseconds = 1000; })).all, by_pins().all), "");
}

/// A bus model that knows characters only.
struct ForeignStation : tlm::tlm_analysis_if<systemc_bench::HeardCharacter> {
  systemc_bench::CharacterStation station;
  tlm::tlm_analysis_port<systemc::BusCharacter> out;
  std::string got;

  ForeignStation(const char* name, systemc_bench::SegmentModule& line) : station(name, line) { out.bind(station.in); }
  void send(Tick at, const bus::Bytes& bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      out.write({systemc::to_time(at + static_cast<Tick>(i) * 11 * bus::baud(0).bit),
                 systemc::to_time(bus::baud(0).bit), bytes[i], true, true});
  }
  void write(const systemc_bench::HeardCharacter& heard) override {
    got += std::to_string(heard.data) + (heard.collided ? "! " : " ");
  }
};

TEST(SegmentModule, StationsOfAPlatformAreHeardAndCollideByCharacters) {
  const std::string said = in_a_process_of_its_own([] {
    systemc_bench::SegmentModule line("line");
    segment_platform::Device device("device", 17, {1, sc_core::SC_US});
    line.attach(device.chip);
    ForeignStation a("a", line), b("b", line);
    line.heard.bind(a);
    const auto ask = [&](ForeignStation& from, Tick at) {
      from.send(at, bus::encode(bus::make_telegram(platform::kSlave, 2, bus::fc::kRequest | bus::fc::kFdlStatus)));
    };
    thread([&] {
      for (const Tick at : {400, 600}) ask(a, at * kUs);
      wait_until(700 * kUs);
      a.got.clear();
      ask(a, 800 * kUs);
      wait_until(900 * kUs);
      a.got += "| ";
      ask(a, 1000 * kUs);
      ask(b, 1000 * kUs + 5 * bus::baud(0).bit);
    });
    sc_core::sc_start(1100, sc_core::SC_US);
    return a.got;
  });
  EXPECT_EQ(said.substr(0, said.find('|')), "16 9 2 73 84 22 16 2 9 0 11 22 ") << "request and answer";
  const std::string both = said.substr(said.find('|'));
  EXPECT_NE(both.find('!'), std::string::npos);
  EXPECT_EQ(both.find("16 2 9"), std::string::npos) << "no answer: " << both;
}

TEST(SegmentModule, AChipIsAStationOnce) {
  const std::string said = in_a_process_of_its_own([] {
    collect_reports();
    segment_platform::Platform platform({});
    try {
      platform.line.attach(platform.vpc3.chip);
    } catch (const sc_core::sc_report&) {
    }
    return reports().empty() ? std::string() : reports().back().first + ": " + reports().back().second;
  });
  EXPECT_EQ(said, "/dsdpv1/segment: vpc3 is already a station of a segment");
}

TEST(SegmentModule, TelegramsAsAWholeSaveMostOfTheKernelsWork) {
  const Told characters = run(with([](Choice& c) { c.disturbs = false; }));
  const Told pins = run(with([](Choice& c) { c.disturbs = false, c.pins = true; }));
  EXPECT_LT(characters.deltas * 4, pins.deltas * 3) << "the handshake's outputs remain";
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
