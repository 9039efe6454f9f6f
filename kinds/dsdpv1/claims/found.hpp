#pragma once
// The measurements: parameters, claims of rulings, clocks.
#include <vector>

#include "kinds/dsdpv1/claims/scene.hpp"
#include "lab/calibrate/claims.hpp"

namespace dsdpv1::calibrate {

/// The parameters marked (p) in docs/chip.md, in the order of the rows.
namespace parameter {

constexpr Parameter kRtsLead{0}, kRtsTrail{1}, kIntrLow{2}, kIntrGap{3}, kAccessInterval{4}, kReadyCycles{5},
    kSearchWindowMs{6}, kSearchWindowBits{7}, kBaudControlMs{8};

}  // namespace parameter

using ClaimList = std::vector<const Claim*>;

// Each measures its part of the scene; the table of rulings has its claims.

/// P1: the clocks, from the bits of telegrams; sets the time scale of the scene.
void measure_clock(Scene& scene, double limit_ppm, Found& found);
ClaimList clock_claims();
/// H1, H3, H6, H8: L_REQ and L_STA. Refines the time scale of the scene.
void measure_access(Scene& scene, Found& found);
ClaimList access_claims();
/// D1: when B004 is written; after measure_access, no claims.
void measure_ready(const Scene& scene, Found& found);
/// P7, D7, D15: INTR0 and READY.
void measure_interrupt(const Scene& scene, Found& found);
ClaimList interrupt_claims();
/// P2, S2, S3: PBTXD and PBRTS.
void measure_answers(const Scene& scene, Found& found);
ClaimList answer_claims();
/// S3, S11: when answers begin.
void measure_tsdr(const Scene& scene, Found& found);
ClaimList tsdr_claims();
/// S1, S9: the search, BR and PBF.
void measure_search(const Scene& scene, Found& found);
ClaimList search_claims();
/// S1, S22: the watchdog and the end of BAUD_CONTROL.
void measure_watchdog(const Scene& scene, Found& found);
ClaimList watchdog_claims();
/// The content of telegrams.
void measure_telegrams(const Scene& scene, Found& found);
ClaimList telegram_claims();
/// The user's accesses.
void measure_user(const Scene& scene, Found& found);
ClaimList user_claims();
/// P9, P10: RESET and levels.
void measure_reset(const Scene& scene, Found& found);
ClaimList reset_claims();

}  // namespace dsdpv1::calibrate
