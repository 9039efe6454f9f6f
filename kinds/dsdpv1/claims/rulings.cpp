#include "kinds/dsdpv1/claims/rulings.hpp"

#include <map>
#include <string>

#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

const char* const kNoPin = "no pin shows it";
const char* const kInside = "it needs the chip's state beside the pins";
const char* const kUsers = "it is about what the user does: docs/checks.md";
const char* const kWithD2 = "it is judged with D2";
const char* const kWithS1 = "it is judged with S1";
const char* const kWithS11 = "it is judged with S11";
const char* const kModels = "it is about the model";

const std::vector<Ruling>& all_rulings() {
  static const std::vector<Ruling> all = {
      {"P1", nullptr},  {"P2", nullptr},  {"P3", nullptr},   {"P4", kNoPin},   {"P5", nullptr},  {"P6", nullptr},
      {"P7", nullptr},  {"P8", kUsers},   {"P9", nullptr},   {"P10", nullptr}, {"P11", kUsers},  {"P12", kUsers},
      {"P13", kNoPin},  {"H1", nullptr},  {"H2", nullptr},   {"H3", nullptr},  {"H4", kInside},  {"H5", nullptr},
      {"H6", nullptr},  {"H7", kInside},  {"H8", nullptr},   {"D1", nullptr},  {"D2", nullptr},  {"D3", kWithD2},
      {"D4", kInside},  {"D5", kInside},  {"D6", kInside},   {"D7", nullptr},  {"D8", kInside},  {"D9", kInside},
      {"D10", kInside}, {"D11", kInside}, {"D12", kInside},  {"D13", kInside}, {"D14", kInside}, {"D15", kInside},
      {"D16", kInside}, {"D17", kInside}, {"D18", kNoPin},   {"S1", nullptr},  {"S2", nullptr},  {"S3", nullptr},
      {"S4", kInside},  {"S5", nullptr},  {"S6", kInside},   {"S7", kInside},  {"S8", kModels},  {"S9", nullptr},
      {"S10", nullptr}, {"S11", nullptr}, {"S12", kInside},  {"S13", nullptr}, {"S14", nullptr}, {"S15", kInside},
      {"S16", kInside}, {"S17", kInside}, {"S18", kInside},  {"S19", nullptr}, {"S20", nullptr}, {"S21", nullptr},
      {"S22", kWithS1}, {"S23", kInside}, {"S24", kInside},  {"S25", kInside}, {"S26", nullptr}, {"S27", kInside},
      {"S28", kInside}, {"S29", nullptr}, {"S30", kWithS11}, {"S31", kInside}, {"S32", nullptr}, {"S33", kInside},
      {"V1", nullptr},  {"V2", nullptr},  {"V3", kInside},   {"V4", kInside},  {"V5", kInside},  {"V6", kInside},
      {"V7", kInside},  {"V8", nullptr},  {"V9", kInside},   {"V10", kInside}, {"V11", kInside}, {"V12", kInside},
      {"V13", kInside}, {"V14", kInside}, {"V15", kInside},  {"U1", kUsers},   {"U2", kUsers},   {"U3", kUsers},
      {"U4", kUsers},   {"U5", kUsers},   {"U6", kUsers},    {"U7", kUsers},   {"U8", kUsers},   {"U9", kUsers},
      {"U10", kUsers},  {"U11", kUsers},  {"facts", nullptr}};
  return all;
}

const char* ruling_of(const std::string& key) {
  static const std::map<std::string, const char*> rulings = {
#define DSDPV1_PARAMETER(name, initial, least, most, unit, ruling, text) {#name, ruling},
#define DSDPV1_RSU_LIST(name, initial, least, most, unit, ruling, text) {#name, ruling},
#include "model/dsdpv1/parameters.inc"
  };
  return rulings.at(key);
}

/// In the order of parameter::
std::vector<ParameterRow> parameter_rows() {
  const auto row = [](const char* key, const char* measured, std::vector<Wire> needs) {
    return ParameterRow{key, ruling_of(key), measured, std::move(needs)};
  };
  constexpr const char* kSearch = "begin of the search to the telegram that ends it";
  return {
      row("rts_lead", "PBRTS rises to the answer's first start bit", {wire::kPbrts, wire::kPbtxd}),
      row("rts_trail", "end of the last stop bit to the fall of PBRTS", {wire::kPbrts, wire::kPbtxd}),
      row("intr_low", "INTR0 low", {wire::kIntr0}),
      row("intr_gap", "INTR0 high before a pulse that waited", {wire::kIntr0}),
      row("access_interval", "rises of L_REQ, the user's pins low", {wire::kLReq}),
      row("ready_cycles", "release of RESET (R) to the access that writes B004", {wire::kLReq}),
      row("search_window_ms", kSearch, {wire::kPbrxd, wire::kBr}),
      row("search_window_bits", kSearch, {wire::kPbrxd, wire::kBr}),
      row("baud_control_ms", "last telegram to the fall of BR", {wire::kPbrxd, wire::kPbtxd, wire::kBr}),
  };
}

template <class... Lists>
std::vector<const Claim*> joined(const Lists&... lists) {
  std::vector<const Claim*> all;
  (all.insert(all.end(), lists.begin(), lists.end()), ...);
  return all;
}

class Dsdpv1Claims : public Claims {
 public:
  const WireTable& wires() const override { return calibrate::wires(); }
  const std::vector<Ruling>& rulings() const override { return all_rulings(); }
  const std::vector<const Claim*>& claims() const override {
    static const std::vector<const Claim*> all =
        joined(clock_claims(), access_claims(), interrupt_claims(), tsdr_claims(), answer_claims(), search_claims(),
               watchdog_claims(), telegram_claims(), user_claims(), reset_claims());
    return all;
  }
  const std::vector<ParameterRow>& parameters() const override {
    static const std::vector<ParameterRow> all = parameter_rows();
    return all;
  }
  Found measure(const Record& record, const Circumstances& circumstances) const override;
};

Found Dsdpv1Claims::measure(const Record& record, const Circumstances& circumstances) const {
  Scene scene(record, circumstances.time, circumstances.station);
  Found found(parameters().size());
  measure_clock(scene, circumstances.clock_ppm, found);
  find_resets(scene);
  measure_access(scene, found);
  measure_ready(scene, found);
  measure_interrupt(scene, found);
  measure_answers(scene, found);
  measure_tsdr(scene, found);
  measure_search(scene, found);
  measure_watchdog(scene, found);
  measure_telegrams(scene, found);
  measure_user(scene, found);
  measure_reset(scene, found);
  found.requests = scene.exchanges.size();
  found.answers = scene.sent.size();
  found.accesses = scene.accesses.size();
  found.user_accesses = scene.user.size();
  return found;
}

}  // namespace

const Claims& dsdpv1_claims() {
  static const Dsdpv1Claims claims;
  return claims;
}

}  // namespace dsdpv1::calibrate
