#pragma once
// rtl-random's interface to a kind of chip, ChipKind::random(): the user at its host port, and the situations that may
// occur.
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

/// Sets an input, in ticks from the begin of an action. With `until_low` it sets none: this edge and the following ones
/// wait until these outputs are 0.
struct PinEdge {
  Tick at = 0;
  PinNumber pin = 0;
  Level level = 0;
  tb::PinMask until_low = 0;
};

/// The edges of a user's action at the pins. With `reply_bits` the action ends once the output `reply` has been high
/// for a character, or if it has not been low for so many bits after the last edge.
struct UserPlan {
  std::vector<PinEdge> edges = {};  ///< in order of time
  Tick poll_every = 0;              ///< poll interval of `until_low`
  Tick reply_bits = 0;
  PinNumber reply = kNoPin;
  Tick bit = 0;
};

/// A verb of stimulus files.
struct VerbRow {
  Verb verb;
  const char* word;
  std::vector<Field> fields;
  UserPlan (*plan)(const Action& action);  ///< null: not an action of the user
  bool faults = false;                     ///< `bytes` may have wire faults
};

/// A host port.
struct HostPort {
  const char* word;              ///< for --mode
  unsigned share;                ///< of a campaign's cycles, in percent
  std::vector<std::string> set;  ///< texts of --set that select it
};

/// A kind's words on command lines and in files.
struct Vocabulary {
  std::vector<HostPort> ports = {};            ///< the usual one first
  std::vector<VerbRow> verbs = {};             ///< Verb::kPin, and the kind's own
  tb::PinMask selects = 0;                     ///< inputs of which one is low during an access of the user
  std::vector<const char*> access_parts = {};  ///< PinDevice::works_on(), at which actions can be aimed
  std::vector<std::string> quick = {};         ///< texts of --set: times so short that every state is reached quickly
  std::string faults = {}, stimuli = {};       ///< paths in the source tree: its list of faults, its directed stimuli
};

/// A second user, who reads what the chip has written whenever the stimulus leaves the host port at rest: so the cells
/// appear at pins. Its actions depend on the inputs and the model alone.
class ReadBack {
 public:
  virtual ~ReadBack() = default;
  /// An input of the chip has a new level; in order of time.
  virtual void input(Tick at, PinNumber pin, Level level) = 0;
  /// The part of an access that the chip works on now, PinDevice::works_on(), after each evaluation.
  virtual void works_on(const char* part) = 0;
  /// The actions that read what was written since the last call that gave some; empty: nothing was, or the port is not
  /// at rest.
  virtual Stimulus due(Tick now, const tb::PinDevice& model) = 0;
};

/// The seed modulo this chooses a case's first subject; 0: any.
constexpr std::uint64_t kLedCases = 8;

class RandomCases {
 public:
  virtual ~RandomCases() = default;
  virtual const Vocabulary& words() const = 0;
  /// Texts of --set: the occasional differences from Vocabulary::quick in the case of this seed, if it may begin with
  /// any subject.
  virtual std::vector<std::string> case_settings(std::uint64_t seed) const = 0;
  /// One case from power-on, the same for the same seed. With seed % kLedCases it begins with a subject that a short
  /// campaign might miss: one that takes long, or that depends on one bit or cycle. For a chip with times about as
  /// short as the quick ones: waits use the times of `chip`. Runs for a few hundred thousand cycles, some for two
  /// millions (slow rates).
  virtual Stimulus make_case(std::uint64_t seed, const tb::OwnSettings& chip) const = 0;
  /// For PlayOptions::reads_back.
  virtual std::unique_ptr<ReadBack> read_back(const tb::OwnSettings& chip) const = 0;
  /// All situations that may occur, in the order of a table. Some are possible by the rulings, but no random case
  /// reaches them.
  virtual std::vector<Situation> known_situations(const tb::OwnSettings& chip) const = 0;
  /// The rulings and clauses that decide what the chip does in a situation, or say that an event happens: "S13, S20".
  /// Empty: there are none that decide more than its pins.
  virtual std::string rulings_of(const Situation& situation, const tb::OwnSettings& chip) const = 0;
  /// Counts the situations of one run. Both arguments outlive the result.
  virtual std::unique_ptr<PlayListener> watch(const tb::OwnSettings& chip, Situations& counted) const = 0;
};

}  // namespace dsdpv1::cosim
