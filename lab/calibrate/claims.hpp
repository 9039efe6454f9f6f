#pragma once
// The rulings and parameters that captures of a chip's pins can show: ChipKind::claims().
#include <optional>
#include <string>
#include <vector>

#include "lab/calibrate/estimate.hpp"
#include "lab/calibrate/judge.hpp"

namespace dsdpv1::calibrate {

struct Ruling {
  const char* id;      ///< "S3"; "facts"
  const char* hidden;  ///< why there is no claim; nullptr: there are some
};

/// Its place in Claims::parameters().
enum class Parameter : std::uint8_t {};

/// A parameter that the documents mark (p).
struct ParameterRow {
  const char* key;       ///< in a scenario's `chip`, an integer; its unit, default and range are there
  const char* ruling;    ///< that marks it: "H1"
  const char* measured;  ///< the pins and events measured
  std::vector<Wire> needs;
};

struct Fit {
  Estimate estimate;      ///< in the parameter's unit
  bool at_least = false;  ///< only its lower end is known
  bool at_most = false;   ///< only its upper end is known
  std::string not_shown;  ///< why there is none
};

/// The reason why a parameter is not shown.
inline constexpr const char* kTooCoarse = "the samples are too far apart";

/// The results of one capture.
struct Found {
  explicit Found(std::size_t parameters) : fits(parameters) {}

  Judge judge;
  std::vector<Fit> fits;  ///< of Claims::parameters()
  Estimate clock;         ///< cycles of the chip in a nominal cycle of the capture
  Estimate master_clock;  ///< the same for the sender of the requests
  std::size_t requests = 0, answers = 0, accesses = 0, user_accesses = 0;

  Fit& fit(Parameter parameter) { return fits.at(static_cast<std::size_t>(parameter)); }
  const Fit& fit(Parameter parameter) const { return fits.at(static_cast<std::size_t>(parameter)); }
};

/// Known properties of the capture and its chip.
struct Circumstances {
  TimeBase time;
  double clock_ppm = 0;        ///< largest difference of chip and analyser
  std::optional<int> station;  ///< the chip's address; absent: the one that is answered
};

class Claims {
 public:
  virtual ~Claims() = default;
  virtual const WireTable& wires() const = 0;
  /// All rulings of the documents, in their order.
  virtual const std::vector<Ruling>& rulings() const = 0;
  /// All claims, in no order.
  virtual const std::vector<const Claim*>& claims() const = 0;
  virtual const std::vector<ParameterRow>& parameters() const = 0;
  virtual Found measure(const Record& record, const Circumstances& circumstances) const = 0;
};

}  // namespace dsdpv1::calibrate
