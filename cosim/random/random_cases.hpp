#pragma once
// What rtl-random needs of a kind of chip, ChipKind::random(): the user at its host port, and what may occur there.
#include <memory>
#include <string>
#include <vector>

#include "cosim/random/play_listener.hpp"
#include "cosim/random/situations.hpp"
#include "cosim/random/stimulus.hpp"

namespace dsdpv1::cosim {

/// One `key=value` of an action in a stimulus file: decimal, or hexadecimal.
struct Field {
  const char* key = nullptr;
  Tick Action::*member = nullptr;
  Tick least = 0, most = 0;
  bool hex = false;
};

/// An input gets a level, in ticks from the begin of an action. With `until_low` it does not: this edge and those
/// behind it wait until these outputs are 0.
struct PinEdge {
  Tick at = 0;
  PinNumber pin = 0;
  Level level = 0;
  tb::PinMask until_low = 0;
};

/// What an action of the user does at the pins. With `reply_bits` it ends once the output `reply` has been high for a
/// character, or when it has not been low for so many bits behind the last edge.
struct UserPlan {
  std::vector<PinEdge> edges = {};  ///< in order of time
  Tick poll_every = 0;              ///< how often `until_low` is looked at
  Tick reply_bits = 0;
  PinNumber reply = kNoPin;
  Tick bit = 0;
};

/// A verb of stimulus files.
struct VerbRow {
  Verb verb;
  const char* word;
  std::vector<Field> fields;
  UserPlan (*plan)(const Action& action);  ///< null: it is no action of the user
  bool faults = false;                     ///< `bytes` may have faults of a wire
};

/// A host port.
struct HostPort {
  const char* word;              ///< of --mode
  unsigned share;                ///< of the cycles of a campaign, in percent
  std::vector<std::string> set;  ///< texts of --set that choose it
};

/// What command lines and files say of a kind.
struct Vocabulary {
  std::vector<HostPort> ports = {};            ///< the usual one first
  std::vector<VerbRow> verbs = {};             ///< Verb::kPin, and the kind's own
  std::vector<const char*> access_parts = {};  ///< PinDevice::works_on(), at which actions can be aimed
  std::vector<std::string> quick = {};         ///< texts of --set: times so short that every state is reached soon
  std::string faults = {}, stimuli = {};       ///< its list of faults, its directed stimuli: places in the source tree
};

class RandomCases {
 public:
  virtual ~RandomCases() = default;
  virtual const Vocabulary& words() const = 0;
  /// Texts of --set: what now and then is other in the case of this seed than Vocabulary::quick.
  virtual std::vector<std::string> case_settings(std::uint64_t seed) const = 0;
  /// One case from power-on, the same for the same seed. Meant for a chip with times about as short as the quick ones:
  /// what has to be waited for is waited for with the times of `chip`. Runs for a few hundred thousand cycles, some for
  /// two millions (slow rates).
  virtual Stimulus make_case(std::uint64_t seed, const tb::OwnSettings& chip) const = 0;
  /// All that may occur, in the order of a table. Some of it the rulings allow and no random case does.
  virtual std::vector<Situation> known_situations(const tb::OwnSettings& chip) const = 0;
  /// Counts what occurs in one run. Both outlive the result.
  virtual std::unique_ptr<PlayListener> watch(const tb::OwnSettings& chip, Situations& counted) const = 0;
};

}  // namespace dsdpv1::cosim
