// Which answer the chip gives to which request, as far as telegrams and pins show it.
#include <fmt/format.h>

#include <algorithm>

#include "kinds/dsdpv1/claims/found.hpp"

namespace dsdpv1::calibrate {
namespace {

using bus::Telegram;
using bus::TelegramKind;

/// A valid request to one station, and its valid answer.
struct Asked {
  const Telegram& request;
  const Telegram& answer;
  const Scene& scene;
  const Exchange& exchange;

  bool to(std::uint8_t sap) const { return request.dsap == sap; }
  bool reads_exchange() const { return to(bus::sap::kReadInputs) || to(bus::sap::kReadOutputs); }
  bool is_srd() const { return request.function() == bus::fc::kSrdLow || request.function() == bus::fc::kSrdHigh; }
  bool acknowledged() const { return answer.kind == TelegramKind::kSc; }
  bool is_status(std::uint8_t fc) const { return answer.kind == TelegramKind::kSd1 && answer.fc == fc; }
  bool refused() const { return is_status(bus::fc::kRs); }
  bool no_resource() const { return is_status(bus::fc::kRr); }
  bool has_data() const { return answer.kind == TelegramKind::kSd2 || answer.kind == TelegramKind::kSd3; }
  bool data_from(std::uint8_t sap) const { return has_data() && answer.ssap == sap; }
  /// The state counts when the request is decided, between its end and the answer, except for a repetition (S26).
  bool outside_exchange() const {
    const Tick from = exchange.request->end() - scene.time.margin();
    return !exchange.repeats && scene.record[wire::kPbf].high(from, exchange.answer->start);
  }
};

/// When the rule applies, and whether it is kept.
struct Rule {
  Claim claim;
  bool (*applies)(const Asked&);
  bool (*holds)(const Asked&);
};

constexpr std::size_t kShortestDiagnosis = 6;
constexpr std::uint8_t kResponseFunctions = 0x0F;

std::vector<Wire> line() { return {wire::kPbrxd, wire::kPbtxd}; }

namespace sap = bus::sap;
namespace fc = bus::fc;

const std::vector<Rule> kRules = {
    {{"S5", "SAP 55 answers SC, beyond 4 bytes RR, or RS", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kSetSlaveAddress); },
     [](const Asked& a) {
       constexpr std::size_t kMost = 4;
       return a.refused() || (a.request.data.size() > kMost ? a.no_resource() : a.acknowledged());
     }},
    {{"S13",
      "outside of data exchange the default SAP and SAPs 56 and 57 are refused",
      {wire::kPbrxd, wire::kPbtxd, wire::kPbf}},
     [](const Asked& a) {
       return a.is_srd() && a.scene.record.sees(wire::kPbf) && (!a.request.dsap || a.reads_exchange()) &&
              a.outside_exchange();
     },
     [](const Asked& a) { return a.refused(); }},
    {{"S13", "SAPs 59 and 60 answer requests with data RR", line()},
     [](const Asked& a) {
       return a.is_srd() && !a.request.data.empty() && (a.to(sap::kGetCfg) || a.to(sap::kSlaveDiag));
     },
     [](const Asked& a) { return a.no_resource(); }},
    {{"S13", "SAPs 56 and 57 answer requests with data RR, or RS", line()},
     [](const Asked& a) { return a.is_srd() && !a.request.data.empty() && a.reads_exchange(); },
     [](const Asked& a) { return a.refused() || a.no_resource(); }},
    {{"S13", "Slave_Diag is answered with data, Get_Cfg with data or, without modules, SC", line()},
     [](const Asked& a) {
       return a.is_srd() && a.request.data.empty() && (a.to(sap::kSlaveDiag) || a.to(sap::kGetCfg));
     },
     [](const Asked& a) { return a.has_data() || (a.to(sap::kGetCfg) && a.acknowledged()); }},
    {{"S14", "Set_Prm is answered SC, or RS", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kSetPrm); },
     [](const Asked& a) { return a.acknowledged() || a.refused(); }},
    {{"S14", "Check_Cfg is answered SC, RS or, beyond 200 bytes, RR", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kChkCfg); },
     [](const Asked& a) {
       constexpr std::size_t kMost = 200;
       return a.refused() || (a.request.data.size() > kMost ? a.no_resource() : a.acknowledged());
     }},
    {{"S19", "a data exchange is answered with data, SC, SD1 with FC 0A, RS or RR", line()},
     [](const Asked& a) { return a.is_srd() && !a.request.dsap; },
     [](const Asked& a) {
       return a.has_data() || a.acknowledged() || a.refused() || a.no_resource() || a.is_status(fc::kDh);
     }},
    {{"S20", "answers with data have FC 08, a data exchange also 0A", line()},
     [](const Asked& a) { return a.has_data(); },
     [](const Asked& a) { return a.answer.fc == fc::kDl || (a.answer.fc == fc::kDh && !a.request.dsap); }},
    {{"S20", "answers with data are SD2", line()},
     [](const Asked& a) { return a.has_data(); },
     [](const Asked& a) { return a.answer.kind == TelegramKind::kSd2; }},
    {{"S20", "station type bits are 0", line()},
     [](const Asked& a) { return !a.acknowledged(); },
     [](const Asked& a) { return (a.answer.fc & ~kResponseFunctions) == 0; }},
    {{"S20", "an FDL status request is answered SD1 with FC 00", line()},
     [](const Asked& a) { return a.request.function() == fc::kFdlStatus; },
     [](const Asked& a) { return a.is_status(fc::kOk); }},
    {{"S20", "a SAP that does not exist is refused RS", line()},
     [](const Asked& a) {
       constexpr std::uint8_t kFirst = 47;
       return a.is_srd() && a.request.dsap &&
              (*a.request.dsap < kFirst || *a.request.dsap > sap::kChkCfg ||
               (*a.request.dsap > sap::kMs1 && *a.request.dsap < sap::kSetSlaveAddress));
     },
     [](const Asked& a) { return a.refused(); }},
    {{"S21", "an answer goes to the SAP that asked, from the one that was asked", line()},
     [](const Asked& a) { return a.has_data(); },
     [](const Asked& a) {
       return a.answer.dsap == a.request.ssap && a.answer.ssap == (a.request.ssap ? a.request.dsap : std::nullopt);
     }},
    {{"S21", "an answer goes to the master that asked, from the station that was asked", line()},
     [](const Asked& a) { return !a.acknowledged(); },
     [](const Asked& a) { return a.answer.da == a.request.sa && a.answer.sa == a.request.da; }},
    {{"S29", "requests other than SRD and FDL status are refused RS", line()},
     [](const Asked& a) { return !a.is_srd() && a.request.function() != fc::kFdlStatus; },
     [](const Asked& a) { return a.refused(); }},
    {{"S29", "SRD to SAP 58 is refused RS", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kGlobalControl); },
     [](const Asked& a) { return a.refused(); }},
    {{"V1", "SAP 50 is refused RS", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kMs1Alarm); },
     [](const Asked& a) { return a.refused(); }},
    {{"V1", "SAP 51 answers a request E5, RR or RS, and a poll E5, RS or the answer", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kMs1); },
     [](const Asked& a) {
       return a.acknowledged() || a.refused() || (a.request.data.empty() ? a.data_from(sap::kMs1) : a.no_resource());
     }},
    {{"V2", "an Initiate is answered with 56, SAP 48 or 47 and its Send_Timeout, or RS", line()},
     [](const Asked& a) { return a.is_srd() && a.to(sap::kMs2Rm) && !a.request.data.empty(); },
     [](const Asked& a) {
       constexpr std::uint8_t kAnswer = 0x56;
       constexpr std::size_t kTimeout = 4, kLength = 4;
       if (a.refused()) return true;
       const bus::Bytes &asked = a.request.data, &got = a.answer.data;
       return got.size() == kLength && got[0] == kAnswer && (got[1] == 0x30 || got[1] == 0x2F) &&
              asked.size() > kTimeout + 1 && got[2] == asked[kTimeout] && got[3] == asked[kTimeout + 1];
     }},
    {{"V8", "SAP 51 serves SSAP 51 only, SAPs 49, 48 and 47 SSAP 50 only", line()},
     [](const Asked& a) {
       constexpr std::uint8_t kSecond = 47;
       const bool c2 = a.request.dsap && *a.request.dsap >= kSecond && *a.request.dsap <= sap::kMs2Rm;
       return a.is_srd() &&
              ((a.to(sap::kMs1) && a.request.ssap != sap::kMs1) || (c2 && a.request.ssap != sap::kMs2Master));
     },
     [](const Asked& a) { return a.refused(); }},
    {{"facts", "Slave_Diag: status bits that the chip never sets are 0, status 2 bit 2 is 1", line()},
     [](const Asked& a) { return a.to(sap::kSlaveDiag) && a.has_data(); },
     [](const Asked& a) {
       // APC3 A.4; status 3 has Ext_Diag_Overflow alone, and D14 takes no diagnosis that is too long
       constexpr std::uint8_t kNever1 = 0xA1, kNever2 = 0xC0, kAlways2 = 0x04;
       const bus::Bytes& data = a.answer.data;
       return data.size() >= kShortestDiagnosis && (data[0] & kNever1) == 0 && (data[1] & kNever2) == 0 &&
              (data[1] & kAlways2) != 0 && data[2] == 0;
     }},
};

const Claim kRepeated = {
    "S26", "a request that is repeated gets the same answer", {wire::kPbrxd, wire::kPbtxd, wire::kBr}};
const Claim kSdn = {"S20", "SDN is not answered", line()};
const Claim kNobody = {"S32", "a request of master 127 is not answered", line()};
const Claim kGlobal = {"S20", "Global_Control is not answered", line()};

std::string words_of(const Telegram& answer, const bus::Bytes& bytes) {
  constexpr std::size_t kMost = 12;
  std::string text = "the answer is";
  for (std::size_t i = 0; i < std::min(bytes.size(), kMost); ++i) text += fmt::format(" {:02X}", bytes[i]);
  return text + (bytes.size() > kMost ? " ..." : "") + (answer.kind == TelegramKind::kSc ? " (SC)" : "");
}

void judge_rules(const Scene& scene, const Exchange& exchange, Found& found) {
  const Asked asked{exchange.request->telegram, exchange.answer->telegram, scene, exchange};
  for (const Rule& rule : kRules) {
    if (!rule.applies(asked)) continue;
    if (rule.holds(asked))
      found.judge.holds(rule.claim);
    else
      found.judge.fails(rule.claim, exchange.answer->start,
                        words_of(exchange.answer->telegram, exchange.answer->bytes));
  }
}

/// Whether the chip's memory of the last answer lasted between the two.
bool remembered(const Scene& scene, const Exchange& first, const Exchange& second) {
  const Tick from = first.request->start, to = second.request->end();
  const auto between = [&](const LineTelegram& telegram) {
    return !telegram.right && telegram.start > from && telegram.start < to;
  };
  if (std::any_of(scene.received.begin(), scene.received.end(), between)) return false;
  return scene.record.sees(wire::kBr) && scene.record[wire::kBr].high(from, to) && !scene.in_reset(from, to);
}

void judge_repetition(const Scene& scene, const Exchange& before, const Exchange& exchange, Found& found) {
  const bool again =
      (exchange.request->telegram.fc & bus::fc::kFcv) != 0 && before.request->bytes == exchange.request->bytes;
  if (!again || !remembered(scene, before, exchange)) return;
  if (before.answer->bytes == exchange.answer->bytes)
    found.judge.holds(kRepeated);
  else
    found.judge.fails(kRepeated, exchange.answer->start, words_of(exchange.answer->telegram, exchange.answer->bytes));
}

void judge_silent(const Exchange& exchange, Found& found) {
  const Telegram& request = exchange.request->telegram;
  const bool sdn = request.function() == bus::fc::kSdnLow || request.function() == bus::fc::kSdnHigh;
  const bool silent = exchange.answer == nullptr;
  const Tick at = exchange.request->end();
  if (sdn) found.judge.judge(kSdn, silent, at, "it is answered");
  if (sdn && request.dsap == bus::sap::kGlobalControl) found.judge.judge(kGlobal, silent, at, "it is answered");
  if (request.sa == bus::kBroadcast) found.judge.judge(kNobody, silent, at, "it is answered");
}

}  // namespace

void measure_telegrams(const Scene& scene, Found& found) {
  const Exchange* before = nullptr;
  for (const Exchange& exchange : scene.exchanges) {
    if (!exchange.request->right || !exchange.request->telegram.is_request()) {
      before = nullptr;
      continue;
    }
    judge_silent(exchange, found);
    if (exchange.answer == nullptr || !exchange.answer->right) {
      if (exchange.request->telegram.wants_answer()) before = nullptr;
      continue;
    }
    if (exchange.same || !exchange.repeats) judge_rules(scene, exchange, found);  // else it may be another's answer
    if (before != nullptr) judge_repetition(scene, *before, exchange, found);
    before = &exchange;
  }
}

ClaimList telegram_claims() {
  ClaimList claims;
  for (const Rule& rule : kRules) claims.push_back(&rule.claim);
  for (const Claim* claim : {&kRepeated, &kSdn, &kNobody, &kGlobal}) claims.push_back(claim);
  return claims;
}

}  // namespace dsdpv1::calibrate
