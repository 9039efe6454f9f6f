#pragma once
// A run of accept as a scenario: the slave with the firmware, its masters, and the stimuli one after the other.
#include <cstdint>
#include <string>
#include <vector>

#include "lab/accept/stimuli.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::accept {

/// What is to be accepted, and how.
struct Order {
  std::string program;  ///< path: an ELF file for the ARM board, or a program for this computer; empty: the native CPU
  std::string gsd;      ///< path
  std::vector<std::string> modules;
  int address = 5;
  std::string chip = "dsdpv1", mode;  ///< `mode` empty: the part has no choice
  std::string baud = "12M";
  std::uint32_t seed = 1;
  bus::Tick within = 10 * bus::kTicksPerMs;  ///< the slave serves what comes within this time
  Object object;
  std::vector<std::string> only;            ///< names of stimuli; empty: all
  std::vector<scenario::Setting> settings;  ///< keys of the scenario
};

/// Section::left_out of a stimulus that Order::only does not name.
constexpr const char* kNotAskedFor = "not asked for";

/// The time of a stimulus, from the first data exchange on; that of the first one is before it.
struct Section {
  const Stimulus* stimulus = nullptr;
  bus::Tick from = 0, to = 0;
  std::string left_out;  ///< why; empty: it is applied
  int line = 0;          ///< of its first action in Plan::text
};

struct Plan {
  std::string text;  ///< of the scenario, as a file
  scenario::Scenario scenario;
  std::vector<Section> sections;
  std::uint8_t address = 0;
  std::string mode;   ///< Order::mode
  bus::Tick end = 0;  ///< of the last section, from the first data exchange on
};

/// The longest time to the first data exchange.
constexpr bus::Tick kLongestStart = 2 * bus::kTicksPerSecond;

/// `file`: the name that errors give to the scenario. Throws InputError for an order that cannot be carried out.
Plan make_plan(const Order& order, const std::string& file);

}  // namespace dsdpv1::tb::accept
