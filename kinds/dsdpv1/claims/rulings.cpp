#include "kinds/dsdpv1/claims/rulings.hpp"

#include <cstdlib>
#include <map>
#include <string>

#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1::calibrate {
namespace {

const char* const kNoPin = "no pin shows it";
const char* const kInside = "it needs the chip's state beside the pins";
const char* const kUsers = "it is about what the user does: docs/checks.md";
const char* const kWithD2 = "it is judged with D2";
const char* const kWithS1 = "it is judged with S1";
const char* const kWithS11 = "it is judged with S11";
const char* const kModels = "it is about the model";

}  // namespace

const std::vector<Ruling>& rulings() {
  static const std::vector<Ruling> all = {
      {"P1", nullptr},  {"P2", nullptr},  {"P3", nullptr},   {"P4", kNoPin},    {"P5", nullptr},  {"P6", nullptr},
      {"P7", nullptr},  {"P8", kUsers},   {"P9", nullptr},   {"P10", nullptr},  {"P11", kUsers},  {"P12", kUsers},
      {"P13", kNoPin},  {"H1", nullptr},  {"H2", nullptr},   {"H3", nullptr},   {"H4", kInside},  {"H5", nullptr},
      {"H6", nullptr},  {"H7", kInside},  {"H8", nullptr},   {"D1", nullptr},   {"D2", nullptr},  {"D3", kWithD2},
      {"D4", kInside},  {"D5", kInside},  {"D6", kInside},   {"D7", nullptr},   {"D8", kInside},  {"D9", kInside},
      {"D10", kInside}, {"D11", kInside}, {"D12", kInside},  {"D13", kInside},  {"D14", kInside}, {"D15", kInside},
      {"D16", kInside}, {"D17", kInside}, {"D18", kNoPin},   {"S1", nullptr},   {"S2", nullptr},  {"S3", nullptr},
      {"S4", kInside},  {"S5", nullptr},  {"S6", kInside},   {"S7", kInside},   {"S8", kModels},  {"S9", nullptr},
      {"S10", nullptr}, {"S11", nullptr}, {"S12", kInside},  {"S13", nullptr},  {"S14", nullptr}, {"S15", kInside},
      {"S16", kInside}, {"S17", kInside}, {"S18", kInside},  {"S19", nullptr},  {"S20", nullptr}, {"S21", nullptr},
      {"S22", kWithS1}, {"S23", kInside}, {"S24", kInside},  {"S25", kInside},  {"S26", nullptr}, {"S27", kInside},
      {"S28", kInside}, {"S29", nullptr}, {"S30", kWithS11}, {"S31", kInside},  {"S32", nullptr}, {"S33", kInside},
      {"V1", nullptr},  {"V2", nullptr},  {"V3", kInside},   {"V4", kInside},   {"V5", kInside},  {"V6", kInside},
      {"V7", kInside},  {"V8", nullptr},  {"V9", kInside},   {"V10", kInside},  {"V11", kInside}, {"V12", kInside},
      {"V13", kInside}, {"V14", kInside}, {"V15", kInside},  {"facts", nullptr}};
  return all;
}

Claims all_claims() {
  Claims all;
  for (const Claims& claims : {clock_claims(), access_claims(), interrupt_claims(), tsdr_claims(), answer_claims(),
                               search_claims(), watchdog_claims(), telegram_claims(), user_claims(), reset_claims()})
    all.insert(all.end(), claims.begin(), claims.end());
  return all;
}

const std::vector<ParameterRow>& parameters() {
  using W = Wire;
  constexpr const char* kSearch = "begin of the search to the telegram that ends it";
  static const std::vector<ParameterRow> all = {
      {Parameter::kRtsLead, "rts_lead", "PBRTS rises to the answer's first start bit", {W::kPbrts, W::kPbtxd}},
      {Parameter::kRtsTrail, "rts_trail", "end of the last stop bit to the fall of PBRTS", {W::kPbrts, W::kPbtxd}},
      {Parameter::kIntrLow, "intr_low", "INTR0 low", {W::kIntr0}},
      {Parameter::kIntrGap, "intr_gap", "INTR0 high before a pulse that waited", {W::kIntr0}},
      {Parameter::kAccessInterval, "access_interval", "rises of L_REQ, the user's pins low", {W::kLReq}},
      {Parameter::kReadyCycles, "ready_cycles", "release of RESET (R) to the access that writes B004", {W::kLReq}},
      {Parameter::kSearchWindowMs, "search_window_ms", kSearch, {W::kPbrxd, W::kBr}},
      {Parameter::kSearchWindowBits, "search_window_bits", kSearch, {W::kPbrxd, W::kBr}},
      {Parameter::kBaudControlMs, "baud_control_ms", "last telegram to the fall of BR", {W::kPbrxd, W::kPbtxd, W::kBr}},
  };
  return all;
}

const char* ruling_of(const ParameterRow& row) {
  static const std::map<std::string, const char*> rulings = {
#define DSDPV1_PARAMETER(name, initial, least, most, unit, ruling, text) {#name, ruling},
#define DSDPV1_RSU_LIST(name, initial, least, most, unit, ruling, text) {#name, ruling},
#include "model/dsdpv1/parameters.inc"
  };
  return rulings.at(row.key);
}

const tb::keys::Field& field_of(const ParameterRow& row) { return *tb::dsdpv1_chip_keys().find(row.key); }

long long default_of(const ParameterRow& row) { return std::strtoll(field_of(row).default_text.c_str(), nullptr, 10); }

}  // namespace dsdpv1::calibrate
