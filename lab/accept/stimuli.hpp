#pragma once
// The stimuli of accept, a list: what is done to the slave, which ruling it is about, and what must then be met in the
// run. A certification catalogue adds to this list.
#include <cstdint>
#include <string>
#include <vector>

#include "lab/accept/requests.hpp"

namespace dsdpv1::tb::accept {

/// Something that a stimulus leads to, by the names of facts.hpp; any of them counts.
struct Met {
  const char* words;
  std::vector<const char*> facts;
  enum class Need : std::uint8_t {
    kAlways,   ///< `least` times, else the slave has failed
    kNever,    ///< else the slave has failed
    kCounted,  ///< by chance: 0 times means that this run says nothing about it
  } need = Need::kCounted;
  std::uint64_t least = 1;
  /// Ports of the user at which it can be.
  enum class Ports : std::uint8_t { kAll, kOwned, kParallel } ports = Ports::kAll;
};

struct Stimulus {
  const char* name;
  const char* about;  ///< what a slave owes then, with the ruling of docs/chip.md or the clause
  std::vector<Met> met;
  void (*apply)(Requests& requests) = nullptr;            ///< null: nothing but the start
  std::string (*left_out)(const Slave& slave) = nullptr;  ///< why it is not applied to this slave, empty: it is
};

/// In the order in which they are applied; the slave is in data exchange before and after each.
const std::vector<Stimulus>& stimuli();

}  // namespace dsdpv1::tb::accept
