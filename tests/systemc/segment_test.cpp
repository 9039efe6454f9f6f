// Chips of two families and a master on a segment at the level of characters: the same as by pins, with collisions.
#include <gtest/gtest.h>

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

TEST(Segment, MasterAndChipsOfTwoFamiliesExchangeDataUntilTheyAreDisturbed) {
  const std::string undisturbed = by_pins().all.substr(0, by_pins().all.find("line:"));
  EXPECT_NE(undisturbed.find("slave 9 is DATA_EXCH"), std::string::npos);
  EXPECT_NE(undisturbed.find("slave 11 is DATA_EXCH"), std::string::npos);
  EXPECT_GT(count(by_pins().all, " collided"), 100U) << "the disturbing station and the two chips with one address";
}

TEST(Segment, EachBitIsThatOfTheSameChipsByTheirPins) {
  EXPECT_EQ(first_difference(run({}).all, by_pins().all), "");
  const Told observed = run(with([](Choice& c) { c.observed = true; }));
  const Told both = run(with([](Choice& c) { c.observed = c.pins = true; }));
  EXPECT_EQ(first_difference(observed.all, both.all), "") << "all pins";
}

TEST(Segment, TheQuantumChangesNothing) {
  for (const double quantum_us : {1., 10., 100.}) {
    Choice choice;
    choice.quantum_us = quantum_us;
    EXPECT_EQ(first_difference(run(choice).all, by_pins().all), "") << quantum_us << " us";
  }
}

TEST(Segment, AtAPicosecondEverythingIsAtTheSameTick) {
  EXPECT_EQ(first_difference(run(with([](Choice& c) { c.femtoseconds = 1000; })).all, by_pins().all), "");
}

TEST(Segment, AChipIsAStationOnce) {
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

TEST(Segment, TelegramsAsAWholeSaveMostOfTheKernelsWork) {
  const Told characters = run(with([](Choice& c) { c.disturbs = false; }));
  const Told pins = run(with([](Choice& c) { c.disturbs = false, c.pins = true; }));
  EXPECT_LT(characters.deltas * 4, pins.deltas * 3) << "the handshake's outputs remain";
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
