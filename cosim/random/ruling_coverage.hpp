#pragma once
// Which rulings of the documents runs have exercised: those that say why an event happened, or decide a situation that
// occurred.
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cosim/random/situations.hpp"
#include "lab/coverage/reached.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

/// Events and situations of one run, before the first difference.
struct Seen {
  std::map<std::string, std::uint64_t> codes;  ///< of docs/reasons.md, with their counts
  Situations situations = {};                  ///< without events
  std::string mode = {};                       ///< HostPort::word that the situations are of; empty: the first one
};

class RulingCoverage {
 public:
  struct Ruling {
    std::string name, title;
    std::string document;  ///< path
    int line = 0;
    std::map<std::string, std::uint64_t> items = {};  ///< events and situations that it decides, also those with 0
    std::set<std::size_t> runs = {};                  ///< in which one of them occurred
    std::string pins = {};                            ///< outputs that it decides, in words

    std::uint64_t count() const;
  };

  /// The rulings of these documents, for a chip of this kind, at all of its ports. Throws tb::InputError for one that
  /// cannot be read.
  RulingCoverage(const tb::ChipKind& kind, const std::vector<std::string>& documents);

  /// `run`: its number.
  void add(std::size_t run, const Seen& seen);

  /// In the order of the documents.
  const std::vector<Ruling>& rulings() const { return rulings_; }
  /// A document is a file, a ruling a line of it, what it decides is a point there.
  tb::coverage::Files files() const;

 private:
  void read(const std::string& document);
  void add_known();
  void count(const std::string& names, const std::string& item, std::uint64_t times, const std::size_t* run);
  std::string rulings_of(const Situation& situation, const std::string& mode) const;

  const tb::ChipKind& kind_;
  std::vector<Ruling> rulings_;
  std::map<std::string, std::size_t> places_;                            ///< by name
  std::map<std::string, std::shared_ptr<const tb::OwnSettings>> ports_;  ///< by HostPort::word
  std::map<std::string, std::string> sources_;                           ///< of events, by code
};

/// "96 of 102 rulings with events or situations were exercised; 45 of 147 have none".
std::string summary(const RulingCoverage& coverage);
/// A line per ruling: ruling, place, count, runs, items seen, items, output pins, title, items not seen, separated by
/// tabs.
std::string tsv(const RulingCoverage& coverage);
/// A heading and the table, as a part of a page; `runs`: names of the runs.
std::string html(const RulingCoverage& coverage, const std::vector<std::string>& runs);

}  // namespace dsdpv1::cosim
