#pragma once
// dsdpv1-sim calibrate: compares a capture of a real chip's pins with the rulings and their parameters.
#include <optional>
#include <string>
#include <vector>

#include "lab/calibrate/claims.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::calibrate {

enum class Verdict : std::uint8_t {
  kConfirmed,
  kContradicted,
  kNotShown,
  kNotContradicted,  ///< only a bound of the parameter is seen, and the default is on its right side
};
const char* word(Verdict verdict);

/// Interpretation of the capture's times.
struct Sampling {
  std::optional<double> rate = {};  ///< samples a second; absent: found from the times, else `unit`
  double unit = 0;                  ///< ticks to which times were rounded
  double jitter_ns = 5;             ///< of an edge, and skew between channels
  double clock_ppm = 1000;          ///< largest difference of chip and analyser
};

struct ParameterResult {
  const ParameterRow* row = nullptr;
  const tb::keys::Field* field = nullptr;  ///< the scenario's description of it
  long long usual = 0;                     ///< its default
  Verdict verdict = Verdict::kNotShown;
  Fit fit;
  std::optional<long long> value;  ///< when only one fits
  long long chosen = 0;            ///< for the `chip` block: `value`, the default if it fits, else the middle
  std::string words;               ///< "48", "4090 to 4138", or why it is not shown
};

struct ClaimResult {
  std::string ruling, says;
  Verdict verdict = Verdict::kNotShown;
  Tally tally;
  std::string words;  ///< why it is not shown
};

struct Result {
  explicit Result(Found all) : found(std::move(all)) {}

  std::string file;
  Tick end = 0;
  double sample_ns = 0, jitter_ns = 0;
  bool rate_found = false;  ///< found from the times
  const WireTable* table = nullptr;
  std::vector<std::string> wires;  ///< those in the capture
  Found found;
  std::vector<ParameterResult> parameters;
  std::vector<ClaimResult> claims;  ///< in the order of docs/chip.md

  /// True when nothing is contradicted.
  bool agrees() const;
};

/// `kind` must have claims.
Result calibrate(const std::string& file, const Record& record, const Sampling& sampling, std::optional<int> station,
                 const tb::ChipKind& kind);

// Its report.
std::string text(const Result& result, bool all);
std::string json(const Result& result);
/// A `chip` block for scenarios.
std::string chip_block(const Result& result);

}  // namespace dsdpv1::calibrate
