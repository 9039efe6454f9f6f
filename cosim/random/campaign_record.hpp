#pragma once
// The record of a campaign at all host ports, which can be interrupted and resumed: the comparisons so far, in one file
// of a folder.
#include <cstdint>
#include <string>
#include <vector>

#include "cosim/random/campaign.hpp"
#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {

constexpr const char* kCampaignFile = "campaign.json";

/// The random cases at one host port so far.
struct PortRecord {
  const tb::ChipKind* kind;
  const HostPort* port;
  std::uint64_t cases = 0;  ///< with the numbers below this one
  MatchCounts counts = {};
  Coverage coverage = {};
  Situations situations = {};

  /// "dsdpv1 parallel", "dsdpv1_rsu spi".
  std::string name() const;
  /// RandomCases::known_situations.
  std::vector<Situation> known() const;
};

struct CampaignRecord {
  std::uint64_t seed = 1;
  std::vector<PortRecord> ports;

  std::uint64_t cycles() const;
  std::uint64_t cases() const;
  /// The port that is furthest below its share of `goal` cycles; null: all are complete.
  PortRecord* behind(std::uint64_t goal);
  /// Adds matching cases, up to before a case that differs.
  static void add(PortRecord& port, const CampaignResult& result);
};

/// A new record: each kind at each of its ports that has a share.
CampaignRecord new_record(std::uint64_t seed);
/// The record in the folder; a new one if there is none. Throws tb::InputError: not a record, or one of another seed or
/// version of the program's table.
CampaignRecord read_record(const std::string& folder, std::uint64_t seed);
/// Writes it completely or not at all.
void write_record(const std::string& folder, const CampaignRecord& record);

/// Every port's situations with their counts so far: lines of text, separated by tabs.
std::string table(const CampaignRecord& record);

}  // namespace dsdpv1::cosim
