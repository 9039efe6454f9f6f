#pragma once
// What the measurements find: parameters, claims of rulings, clocks.
#include <array>
#include <string>

#include "lab/calibrate/estimate.hpp"
#include "lab/calibrate/judge.hpp"
#include "lab/calibrate/scene.hpp"

namespace dsdpv1::calibrate {

/// The chip's parameters: those that docs/chip.md marks (p) and a scenario's `chip` sets.
enum class Parameter : std::uint8_t {
  kAccessInterval,
  kReadyCycles,
  kRtsLead,
  kRtsTrail,
  kIntrLow,
  kIntrGap,
  kSearchWindowMs,
  kSearchWindowBits,
  kBaudControlMs,
};
constexpr std::size_t kParameterCount = 9;

struct Fit {
  Estimate estimate;      ///< in the parameter's unit
  bool at_least = false;  ///< only its lower end is known
  bool at_most = false;   ///< only its upper end is known
  std::string not_shown;  ///< why there is none
};

struct Found {
  Judge judge;
  std::array<Fit, kParameterCount> fits;
  Estimate clock;         ///< cycles of the chip in a nominal cycle of the capture
  Estimate master_clock;  ///< likewise of who sends the requests

  Fit& fit(Parameter parameter) { return fits.at(static_cast<std::size_t>(parameter)); }
  const Fit& fit(Parameter parameter) const { return fits.at(static_cast<std::size_t>(parameter)); }
};

using Claims = std::vector<const Claim*>;

// Each measures its part of the scene; its claims stand in the table of rulings.

/// Why a parameter is not shown.
inline constexpr const char* kTooCoarse = "the samples are too far apart";

/// P1: the clocks, from the bits of telegrams; sets the scale of the scene's time.
void measure_clock(Scene& scene, double limit_ppm, Found& found);
Claims clock_claims();
/// H1, H3, H6, H8: L_REQ and L_STA. Makes the scale of the scene's time finer.
void measure_access(Scene& scene, Found& found);
Claims access_claims();
/// D1: when B004 is written; after measure_access, no claims.
void measure_ready(const Scene& scene, Found& found);
/// P7, D7, D15: INTR0 and READY.
void measure_interrupt(const Scene& scene, Found& found);
Claims interrupt_claims();
/// P2, S2, S3: PBTXD and PBRTS.
void measure_answers(const Scene& scene, Found& found);
Claims answer_claims();
/// S3, S11: when answers begin.
void measure_tsdr(const Scene& scene, Found& found);
Claims tsdr_claims();
/// S1, S9: the search, BR and PBF.
void measure_search(const Scene& scene, Found& found);
Claims search_claims();
/// S1, S22: the watchdog and the end of BAUD_CONTROL.
void measure_watchdog(const Scene& scene, Found& found);
Claims watchdog_claims();
/// What telegrams say.
void measure_telegrams(const Scene& scene, Found& found);
Claims telegram_claims();
/// The user's accesses.
void measure_user(const Scene& scene, Found& found);
Claims user_claims();
/// P9, P10: RESET and levels.
void measure_reset(const Scene& scene, Found& found);
Claims reset_claims();

}  // namespace dsdpv1::calibrate
