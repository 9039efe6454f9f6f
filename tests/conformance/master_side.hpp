#pragma once
// The master's side of the conformance tests in short calls: single requests that start a separate frame count series
// (so that none is a repetition), the kinds of answers, and the chip's reports meanwhile.
#include <gtest/gtest.h>

#include <optional>

#include "tests/conformance/slave_bench.hpp"

namespace dsdpv1::conformance {

using bus::Exchange;
using profibus::Reason;

constexpr int kNoSap = -1;
constexpr std::uint8_t kSrdFirst = 0x6D;   ///< SRD high, FCB = 1, FCV = 0: the start of a series, always executed
constexpr std::uint8_t kSdnHigh = 0x46;    ///< SDN high
constexpr std::uint8_t kFdlStatus = 0x49;  ///< request FDL status with reply

/// Search windows so short that slow rates are found soon: for tests of other things.
inline dsdpv1::Config quick_search() {
  dsdpv1::Config config;
  config.search_window_ms = 1;
  config.search_window_bits = 400;
  return config;
}

inline std::optional<std::uint8_t> optional_sap(int sap) {
  if (sap == kNoSap) return std::nullopt;
  return static_cast<std::uint8_t>(sap);
}

/// One request, function code as given, to the bench's present address.
inline Exchange send_fc(SlaveBench& bench, std::uint8_t fc, int dsap, int ssap, const Bytes& data,
                        std::uint8_t master = 2) {
  bench.fcb = true;  // the chip's frame count memory no longer fits the bench's series
  bench.fcb_valid = false;
  const auto telegram = bus::make_telegram(bench.address, master, fc, data, optional_sap(dsap), optional_sap(ssap));
  Exchange exchange = bench.requester.send(bench.timeline, telegram);
  bench.chip.compare(bench.now());
  return exchange;
}

/// A DP service (SRD from SSAP 62), or a data exchange with kNoSap.
inline Exchange ask(SlaveBench& bench, int dsap, const Bytes& data = {}, std::uint8_t master = 2) {
  return send_fc(bench, kSrdFirst, dsap, dsap == kNoSap ? kNoSap : 62, data, master);
}

/// SDN, unanswered: runs until the chip has decided and its DPRAM accesses are through.
inline void tell(SlaveBench& bench, std::uint8_t da, int dsap, const Bytes& data, std::uint8_t master = 2) {
  bench.requester.send(bench.timeline, bus::make_telegram(da, master, kSdnHigh, data, optional_sap(dsap), 62),
                       {.wants_answer = false});
  bench.run_for(bench.requester.bit() * 20);
}

inline bool is_refusal(const Exchange& exchange, std::uint8_t fc) {
  return exchange.answered() && exchange.answer().kind == bus::TelegramKind::kSd1 && exchange.answer().fc == fc;
}
inline bool is_rs(const Exchange& exchange) { return is_refusal(exchange, bus::fc::kRs); }
inline bool is_rr(const Exchange& exchange) { return is_refusal(exchange, bus::fc::kRr); }
/// SD2 with the function code of data, low priority or high.
inline bool is_data(const Exchange& exchange, std::uint8_t fc = bus::fc::kDl) {
  return exchange.answered() && exchange.answer().kind == bus::TelegramKind::kSd2 && exchange.answer().fc == fc;
}
inline bool is_sc(const Exchange& exchange) { return exchange.short_acknowledge(); }

/// "SC", "RS", "RR", "DL", "DH", "silent" or the bytes: for messages of failed tests.
inline std::string kind_of(const Exchange& exchange) {
  if (exchange.silent()) return "silent";
  if (is_sc(exchange)) return "SC";
  if (is_rs(exchange)) return "RS";
  if (is_rr(exchange)) return "RR";
  if (is_data(exchange)) return "DL";
  if (is_data(exchange, bus::fc::kDh)) return "DH";
  return testing::PrintToString(exchange.raw);
}

/// Slave_Diag's answer without side effects on a frame count series; empty without a right answer.
inline Bytes diag(SlaveBench& bench, std::uint8_t master = 2) {
  const Exchange exchange = ask(bench, bus::sap::kSlaveDiag, {}, master);
  return exchange.answered() ? exchange.answer().data : Bytes{};
}

/// B008/B009: how often the slave left DATA_EXCH.
inline int offline_count(const SlaveBench& bench) { return bench.chip.peek(0x008) << 8 | bench.chip.peek(0x009); }

/// The output area of the DPRAM.
inline Bytes output_area(SlaveBench& bench) { return bench.peek(0x31A, bench.peek(0x319)); }

/// Sends at a time such that the chip decides the telegram at this cycle (S10: 1 bit time after its last stop bit),
/// and runs two bit times beyond its end or that of the answer.
inline Exchange send_decided_at(SlaveBench& bench, profibus::Cycle decision, int baud, const bus::Telegram& telegram,
                                bool wants_answer = false) {
  constexpr profibus::Cycle kSynchroniser = 3;  // P9: a change at the tick of edge k is seen by k+1 and used at k+3
  const Tick bit = bus::baud(baud).bit;
  const Bytes bytes = bus::encode(telegram);
  const Tick bits = static_cast<Tick>(bytes.size() - 1) * bus::kCharacterBits + 12;
  bench.requester.set_baud(baud);
  Exchange exchange = bench.requester.send(
      bench.timeline, bytes,
      {.at = (decision - 1 - kSynchroniser) * kCycleTicks - bits * bit, .wants_answer = wants_answer});
  bench.run_for(bit * 2);
  return exchange;
}

/// Lets the chip's accesses carry everything to the DPRAM.
inline void settle(SlaveBench& bench) { bench.run_cycles(2000); }

}  // namespace dsdpv1::conformance
