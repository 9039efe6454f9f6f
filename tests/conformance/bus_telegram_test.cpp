// Telegrams that are not right, not for this station or not requests: ignored without harm and with a reason (S3, S8,
// S9, S10).
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>

#include "tests/conformance/master_side.hpp"

namespace dsdpv1::conformance {
namespace {

using bus::Character;
using Characters = std::vector<Character>;

constexpr int kBaud = 3;  // 1.5M: 32 cycles a bit, so that fractions of a bit can be tried
constexpr int kMinTsdr = 60;

class Telegrams : public testing::Test {
 protected:
  void SetUp() override {
    Prm prm;
    prm.min_tsdr = kMinTsdr;
    bench.to_data_exch({}, prm, kBaud);
    ASSERT_TRUE(data_exchange().answered());
    settle(bench);
  }

  /// A data exchange that would be executed if it were right: an SD2 with two bytes.
  Bytes request() { return bus::encode(bus::make_telegram(5, 2, kSrdFirst, {next_++, 0x55})); }
  Exchange data_exchange() { return ask(bench, kNoSap, {next_++, 0xAA}); }
  Exchange send(const Characters& characters, int idle_bits = 60) {
    return bench.requester.send(bench.timeline, characters, {.idle_bits = idle_bits});
  }

  /// Nothing is answered, executed or changed, one of the reasons is given, and the next right telegram works.
  void expect_ignored(const Characters& characters, const std::vector<Reason>& reasons, const std::string& what) {
    SCOPED_TRACE(what);
    const auto before = bench.chip.status();
    const Bytes outputs = output_area(bench);
    int given = 0;
    for (const Reason reason : reasons) given -= bench.count(reason);
    EXPECT_TRUE(send(characters).silent());
    settle(bench);
    for (const Reason reason : reasons) given += bench.count(reason);
    const auto after = bench.chip.status();
    EXPECT_EQ(after.telegrams_answered, before.telegrams_answered);
    EXPECT_EQ(after.data_exchanges, before.data_exchanges);
    EXPECT_EQ(after.dp_state, before.dp_state);
    EXPECT_EQ(after.baud_index, before.baud_index);
    EXPECT_EQ(output_area(bench), outputs);
    EXPECT_EQ(given, reasons.empty() ? 0 : 1) << "the reason, exactly once";
    const Exchange next = data_exchange();
    EXPECT_TRUE(next.answered()) << "the next right telegram";
    EXPECT_EQ(bench.chip.status().data_exchanges, before.data_exchanges + 1);
    settle(bench);
  }

  SlaveBench bench{quick_search()};
  std::uint8_t next_ = 0;
};

TEST_F(Telegrams, WithAParityErrorInAnyCharacterAreIgnored) {
  for (std::size_t i = 0; i < request().size(); ++i) {
    bus::WireFaults faults;
    faults.wrong_parity_at = i;
    expect_ignored(bus::characters(request(), faults), {Reason::kParity}, "character " + std::to_string(i));
  }
}

TEST_F(Telegrams, WithAMissingStopBitInAnyCharacterAreIgnored) {
  for (std::size_t i = 0; i < request().size(); ++i) {
    bus::WireFaults faults;
    faults.missing_stop_at = i;
    expect_ignored(bus::characters(request(), faults), {Reason::kFraming}, "character " + std::to_string(i));
  }
}

TEST_F(Telegrams, WithAWrongBitAreIgnoredWhereverItIs) {
  const std::size_t size = request().size();
  for (std::size_t i = 0; i < size; ++i) {
    for (int bit = 0; bit < 8; ++bit) {  // parity made right again, so that the byte itself is wrong
      Bytes bytes = request();
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
      if (i == 4) continue;  // DA: traffic of other stations, whose FCS does not matter
      expect_ignored(bus::characters(bytes), {}, "character " + std::to_string(i) + ", bit " + std::to_string(bit));
    }
  }
}

TEST_F(Telegrams, WithAWrongFcsAreIgnored) {
  for (int error = 1; error < 256; error += 51) {
    Bytes bytes = request();
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(bytes[bytes.size() - 2] + error);
    expect_ignored(bus::characters(bytes), {Reason::kFcs}, "FCS + " + std::to_string(error));
  }
}

TEST_F(Telegrams, WithAWrongEndDelimiterAreIgnored) {
  for (const int end : {0x00, 0x10, 0x17, 0x68, 0xE5, 0xFF}) {
    Bytes bytes = request();
    bytes.back() = static_cast<std::uint8_t>(end);
    expect_ignored(bus::characters(bytes), {Reason::kEndDelimiter}, "ED " + std::to_string(end));
  }
}

TEST_F(Telegrams, WithAWrongFcsOrEndDelimiterAreIgnoredAsSd1AndSd3) {
  const auto sd1 = bus::encode(bus::make_telegram(5, 2, kFdlStatus));
  const auto sd3 = bus::encode(bus::prefer_sd3(bus::make_telegram(5, 2, kSrdFirst, {1, 2, 3, 4, 5, 6, 7, 8})));
  for (Bytes bytes : {sd1, sd3}) {
    ++bytes[bytes.size() - 2];
    expect_ignored(bus::characters(bytes), {Reason::kFcs}, "FCS");
    --bytes[bytes.size() - 2];
    ++bytes.back();
    expect_ignored(bus::characters(bytes), {Reason::kEndDelimiter}, "ED");
  }
}

TEST_F(Telegrams, WithLengthsThatDifferAreIgnored) {
  for (const int error : {-1, 1, 0x80}) {
    for (const std::size_t at : {1U, 2U}) {
      Bytes bytes = request();
      bytes[at] = static_cast<std::uint8_t>(bytes[at] + error);
      expect_ignored(bus::characters(bytes), {Reason::kLength}, "byte " + std::to_string(at) + std::to_string(error));
    }
  }
}

TEST_F(Telegrams, WithALengthOutOfRangeAreIgnored) {
  for (const int length : {0, 1, 2, 3, 250, 251, 252, 253, 254, 255}) {
    Bytes bytes = request();
    bytes[1] = bytes[2] = static_cast<std::uint8_t>(length);
    expect_ignored(bus::characters(bytes), {Reason::kLength}, "LE " + std::to_string(length));
  }
}

TEST_F(Telegrams, WithARightFrameOfAForbiddenLengthAreIgnored) {
  Bytes bytes = {0x68, 3, 3, 0x68, 5, 2, kFdlStatus, 5 + 2 + kFdlStatus, 0x16};
  expect_ignored(bus::characters(bytes), {Reason::kLength}, "SD2 with LE 3");
  bytes = {0x68, 250, 250, 0x68, 5, 2, kSrdFirst};
  bytes.resize(4 + 250, 0x11);
  bytes.push_back(bus::frame_check_sequence(bytes.data() + 4, 250));
  bytes.push_back(0x16);
  expect_ignored(bus::characters(bytes), {Reason::kLength}, "SD2 with LE 250");
}

TEST_F(Telegrams, WithAnotherSecondStartDelimiterAreIgnored) {
  for (const int second : {0x00, 0x10, 0x60, 0xA2, 0xE5, 0xFF}) {
    Bytes bytes = request();
    bytes[3] = static_cast<std::uint8_t>(second);
    expect_ignored(bus::characters(bytes), {Reason::kRepeatedDelimiter}, std::to_string(second));
  }
}

TEST_F(Telegrams, WithAnUnknownStartDelimiterAreIgnored) {
  for (int first = 0; first < 256; ++first) {
    if (first == 0x10 || first == 0x68 || first == 0xA2 || first == 0xDC || first == 0xE5) continue;
    Bytes bytes = request();
    bytes[0] = static_cast<std::uint8_t>(first);
    expect_ignored(bus::characters(bytes), {Reason::kStartDelimiter}, std::to_string(first));
  }
}

// --- gaps and idle times

TEST_F(Telegrams, WithAGapOfMoreThanOneBitAreIgnored) {
  for (std::size_t i = 1; i < request().size(); ++i) {
    for (const int millibits : {1040, 2000, 10'000, 34'000}) {
      bus::WireFaults faults;
      faults.gap_before = i;
      faults.gap_millibits = millibits;
      expect_ignored(bus::characters(request(), faults), {Reason::kGap},
                     std::to_string(millibits) + " before " + std::to_string(i));
    }
  }
}

TEST_F(Telegrams, WithAGapOfOneBitAreStillRight) {
  for (std::size_t i = 1; i < request().size(); ++i) {
    for (const int millibits : {300, 900, 1000}) {
      bus::WireFaults faults;
      faults.gap_before = i;
      faults.gap_millibits = millibits;
      EXPECT_TRUE(send(bus::characters(request(), faults)).answered()) << millibits << " before " << i;
    }
  }
}

TEST(TelegramGaps, OfOneBitAreNoneAndOfOneCycleMoreAreOneAt12M) {
  SlaveBench bench;
  bench.to_data_exch();
  const Bytes request = bus::encode(bus::make_telegram(5, 2, kFdlStatus));
  for (const int millibits : {1000, 1250}) {
    bus::WireFaults faults;
    faults.gap_before = 3;
    faults.gap_millibits = millibits;
    const Exchange exchange = bench.requester.send(bench.timeline, bus::characters(request, faults), {.idle_bits = 60});
    EXPECT_EQ(exchange.answered(), millibits == 1000) << millibits;
  }
}

/// Offsets inside a cycle: the same request at every phase of CLK.
constexpr Tick kPhases[] = {0, 1, 124, 125, 249};

TEST_F(Telegrams, NeedThirtyThreeBitsOfIdleLessOneCycle) {
  const Tick bit = bench.requester.bit();
  for (const Tick phase : kPhases) {
    for (const bool enough : {true, false}) {
      const Tick first = (bench.now() + 200 * bit) / kCycleTicks * kCycleTicks;
      bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFdlStatus), {.at = first, .wants_answer = false});
      const Tick end = bench.requester.last_activity();
      // A change at the tick of an edge is seen by the next one: phases 0..249 are seen by the same edge.
      const Tick at = end + 33 * bit - (enough ? 1 : 2) * kCycleTicks + phase;
      const int before = bench.count(Reason::kNoSyn);
      const Exchange exchange = bench.requester.send(bench.timeline, request(), {.at = at});
      EXPECT_EQ(exchange.answered(), enough) << "phase " << phase;
      EXPECT_EQ(bench.count(Reason::kNoSyn) - before, enough ? 0 : 1);
    }
  }
}

TEST_F(Telegrams, WithThirtyTwoBitsOfIdleAreIgnored) {
  for (const int idle : {0, 1, 2, 11, 32}) {
    bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFdlStatus),
                         {.idle_bits = 60, .wants_answer = false});
    const auto before = bench.chip.status().data_exchanges;
    EXPECT_TRUE(send(bus::characters(request()), idle).silent()) << idle;
    EXPECT_EQ(bench.chip.status().data_exchanges, before);
  }
  EXPECT_GE(bench.count(Reason::kNoSyn), 3);  // those with more than a gap of 1 bit
}

TEST_F(Telegrams, NeedTheIdleTimeBehindTheOwnAnswerToo) {
  ASSERT_TRUE(data_exchange().answered());
  EXPECT_TRUE(send(bus::characters(request()), 32).silent());
  ASSERT_TRUE(data_exchange().answered());
  EXPECT_TRUE(send(bus::characters(request()), 33).answered());
}

TEST_F(Telegrams, NeedTheIdleTimeBehindTheOwnAnswerLessOneCycle) {
  for (const bool enough : {true, false}) {
    const Exchange answered = data_exchange();
    ASSERT_TRUE(answered.answered());
    bench.run_cycles(20);
    const Tick end = bench.changes(Pin::kPbrts).back().at - 4 * kCycleTicks;  // P2: PBRTS falls 4 cycles after the end
    const Tick at = end + 33 * bench.requester.bit() - (enough ? 1 : 2) * kCycleTicks;
    EXPECT_EQ(bench.requester.send(bench.timeline, request(), {.at = at}).answered(), enough);
  }
}

TEST_F(Telegrams, OfARepeatedRequestWithoutIdleRestartTheIdleTime) {
  const Tick bit = bench.requester.bit();
  bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kFdlStatus), {.idle_bits = 60, .wants_answer = false});
  bench.requester.send(bench.timeline, request(), {.idle_bits = 20, .wants_answer = false});
  const Tick end = bench.requester.last_activity();
  EXPECT_TRUE(bench.requester.send(bench.timeline, request(), {.at = end + 33 * bit}).answered());
}

// --- truncated, oversized

TEST_F(Telegrams, TruncatedAnywhereAreIgnored) {
  for (std::size_t i = 1; i < request().size(); ++i) {
    bus::WireFaults faults;
    faults.truncate_after = i;
    expect_ignored(bus::characters(request(), faults), {Reason::kGap}, "after " + std::to_string(i));
  }
}

TEST_F(Telegrams, TruncatedInsideACharacterAreIgnored) {
  for (std::size_t i = 0; i < request().size(); ++i) {
    for (int bits = 1; bits < bus::kCharacterBits - 1; ++bits) {
      bus::WireFaults faults;
      faults.truncate_after = i;
      faults.truncate_bits = bits;
      Bytes bytes = request();
      // Idle line after the last bit sent: the character may still be correct.
      const unsigned rest = static_cast<unsigned>(Character::of(bytes[i]).bits) >> bits;
      const bool same = i + 1 == bytes.size() && rest == (0x7FFU >> bits);
      if (same) continue;
      expect_ignored(bus::characters(bytes, faults), {}, std::to_string(i) + " and " + std::to_string(bits) + " bits");
    }
  }
}

TEST_F(Telegrams, FollowedByAnotherCharacterAreIgnored) {
  for (const int gap : {0, 500, 1000}) {
    for (const int more : {0x00, 0x16, 0xE5, 0x10}) {
      Bytes bytes = request();
      bytes.push_back(static_cast<std::uint8_t>(more));
      bus::WireFaults faults;
      faults.gap_before = bytes.size() - 1;
      faults.gap_millibits = gap;
      expect_ignored(bus::characters(bytes, faults), {Reason::kOversized},
                     std::to_string(more) + " after " + std::to_string(gap));
    }
  }
}

TEST_F(Telegrams, FollowedByACharacterBehindTheDecisionAreExecuted) {
  Bytes bytes = request();
  bytes.push_back(0x00);
  bus::WireFaults faults;
  faults.gap_before = bytes.size() - 1;
  faults.gap_millibits = 1100;  // 1 bit and three cycles
  const auto before = bench.chip.status().data_exchanges;
  EXPECT_TRUE(send(bus::characters(bytes, faults)).answered());
  EXPECT_EQ(bench.chip.status().data_exchanges, before + 1);
}

TEST_F(Telegrams, WithoutEndAreIgnored) {
  // One of them so long that a count of 16 bits comes round.
  for (const auto& [first, length] :
       {std::pair(0x68, 70'000), {0x10, 2'000}, {0xA2, 2'000}, {0xDC, 2'000}, {0xE5, 2'000}, {0x00, 2'000}}) {
    Bytes bytes = {static_cast<std::uint8_t>(first), 249, 249, 0x68, 5, 2, kSrdFirst};
    bytes.resize(static_cast<std::size_t>(length), 0x55);
    expect_ignored(bus::characters(bytes), {}, std::to_string(length) + " characters behind " + std::to_string(first));
  }
}

TEST_F(Telegrams, GluedTogetherAreIgnored) {
  Bytes both = request();
  const Bytes second = request();
  both.insert(both.end(), second.begin(), second.end());
  expect_ignored(bus::characters(both), {}, "two requests without idle time");
}

// --- bursts

TEST_F(Telegrams, OfGarbageDoNoHarm) {
  std::mt19937 random(5);
  for (int burst = 0; burst < 300; ++burst) {
    Characters characters;
    for (auto left = 1 + random() % 40; left > 0; --left) {
      Character character;
      character.bits = static_cast<std::uint16_t>(random());
      character.bit_count = static_cast<int>(1 + random() % 16);
      character.gap_millibits = random() % 4 == 0 ? static_cast<int>(random() % 40'000) : 0;
      characters.push_back(character);
    }
    expect_ignored(characters, {}, "burst " + std::to_string(burst));
  }
}

TEST_F(Telegrams, BehindALongBreakWorkAgain) {
  bench.segment.force(bench.now(), false);
  bench.run_for(bench.requester.bit() * 500);
  bench.segment.force(bench.now(), std::nullopt);
  const Tick up = bench.now();
  const Tick bit = bench.requester.bit();
  EXPECT_TRUE(bench.requester.send(bench.timeline, request(), {.at = up + 32 * bit}).silent());
  bench.run_for(60 * bit);
  EXPECT_TRUE(data_exchange().answered());
}

// --- not a request for this station

TEST_F(Telegrams, WithoutTheirSapBytesAreIgnored) {
  const auto sd2 = [](std::uint8_t da, std::uint8_t sa, const Bytes& data) {
    Bytes bytes = {
        0x68,     static_cast<std::uint8_t>(3 + data.size()), static_cast<std::uint8_t>(3 + data.size()), 0x68, da, sa,
        kSrdFirst};
    bytes.insert(bytes.end(), data.begin(), data.end());
    bytes.push_back(bus::frame_check_sequence(bytes.data() + 4, bytes.size() - 4));
    bytes.push_back(0x16);
    return bus::characters(bytes);
  };
  const auto sd1 = [](std::uint8_t da, std::uint8_t sa) {
    const auto sum = static_cast<std::uint8_t>(da + sa + kSrdFirst);
    return bus::characters({0x10, da, sa, kSrdFirst, sum, 0x16});
  };
  expect_ignored(sd1(0x85, 2), {Reason::kSapBytes}, "SD1, DA");
  expect_ignored(sd1(5, 0x82), {Reason::kSapBytes}, "SD1, SA");
  expect_ignored(sd1(0x85, 0x82), {Reason::kSapBytes}, "SD1, both");
  expect_ignored(sd2(0x85, 0x82, {60}), {Reason::kSapBytes}, "SD2, one of two");
}

TEST_F(Telegrams, ThatAreResponsesAreIgnored) {
  for (const int fc : {0x00, 0x08, 0x0A, 0x0D, 0x20, 0x30, 0x3C}) {
    const auto code = static_cast<std::uint8_t>(fc);
    expect_ignored(bus::characters(bus::encode(bus::make_telegram(5, 2, code, {1, 2}))), {Reason::kResponse}, "SD2");
    expect_ignored(bus::characters(bus::encode(bus::make_telegram(5, 2, code))), {Reason::kResponse}, "SD1");
  }
}

TEST_F(Telegrams, ThatAreResponsesAreReportedWithoutTSynToo) {
  const Tick bit = bench.requester.bit();
  for (const std::uint8_t da : {std::uint8_t{5}, bus::kBroadcast}) {
    const int before = bench.count(Reason::kResponse);
    bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kSrdFirst, {1}),
                         {.idle_bits = 40, .wants_answer = false});
    bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(da, 9, 0x08, {1, 2, 3})),
                         {.idle_bits = 11, .wants_answer = false});  // as a slave answers
    bench.run_for(bit * 4);
    EXPECT_EQ(bench.count(Reason::kResponse), before + 1) << int{da};
    EXPECT_EQ(bench.last(Reason::kResponse).b, 9);
    EXPECT_EQ(bench.count(Reason::kNoSyn), 0) << "one reason";
    EXPECT_TRUE(data_exchange().answered());
  }
}

// --- without T_SYN: one line for many (S8)

TEST_F(Telegrams, FaultyOnesWithoutTSynAreCountedAndToldWhenTheNextBeginsAfterTSyn) {
  const Tick bit = bench.requester.bit();
  Bytes wrong_fcs = request(), wrong_end = request(), wrong_length = request(), wrong_start = request(),
        wrong_second = request();
  ++wrong_fcs[wrong_fcs.size() - 2];
  ++wrong_end.back();
  ++wrong_length[1];
  wrong_start[0] = 0x55;
  wrong_second[3] = 0x69;
  const Bytes cut(wrong_fcs.begin(), wrong_fcs.begin() + 6);
  Bytes oversized = request();
  oversized.push_back(0x16);
  bus::WireFaults parity, framing;
  parity.wrong_parity_at = 0;
  framing.missing_stop_at = request().size() - 1;  // earlier, and what follows the break counts again
  const std::vector<Characters> faulty = {bus::characters(wrong_fcs),          bus::characters(wrong_end),
                                          bus::characters(wrong_length),       bus::characters(wrong_start),
                                          bus::characters(wrong_second),       bus::characters(cut),
                                          bus::characters(oversized),          bus::characters(request(), parity),
                                          bus::characters(request(), framing), bus::characters(Bytes{0xA2, 5})};
  for (const bool next_is_right : {true, false}) {
    bench.requester.send(bench.timeline, bus::make_telegram(9, 2, kSrdFirst, {1}),
                         {.idle_bits = 60, .wants_answer = false});
    const std::size_t events = bench.chip.events().size();
    for (const Characters& one : faulty)
      bench.requester.send(bench.timeline, one, {.idle_bits = 20, .wants_answer = false});
    EXPECT_EQ(bench.chip.events().size(), events) << "not a line each";
    bench.run_for(60 * bit);
    EXPECT_EQ(bench.chip.events().size(), events);
    const int fcs = bench.count(Reason::kFcs);
    const Exchange next =
        bench.requester.send(bench.timeline, next_is_right ? request() : wrong_fcs, {.idle_bits = 60});
    EXPECT_EQ(next.answered(), next_is_right);
    const int told = next_is_right ? 1 : 2;
    ASSERT_EQ(bench.count(Reason::kFaultyUnsynced), told);
    EXPECT_EQ(bench.last(Reason::kFaultyUnsynced).a, faulty.size());
    const Tick first_character = next.request_start + 10 * bit + bit / 2;
    EXPECT_NEAR(static_cast<double>(bench.last(Reason::kFaultyUnsynced).at), static_cast<double>(first_character),
                4 * kCycleTicks);
    EXPECT_EQ(bench.count(Reason::kFcs), fcs + (next_is_right ? 0 : 1)) << "with T_SYN: a line of its own";
    EXPECT_TRUE(data_exchange().answered());
    EXPECT_EQ(bench.count(Reason::kFaultyUnsynced), told) << "once";
  }
}

TEST_F(Telegrams, BegunAtOnceBehindTheOwnAnswerAreCountedToo) {
  const Tick bit = bench.requester.bit();
  for (const Tick behind : {kCycleTicks * 6, bit / 2, bit}) {  // not even a gap: no first character of a telegram
    ASSERT_TRUE(data_exchange().answered());
    const int before = bench.count(Reason::kFaultyUnsynced);
    const Tick end = bench.requester.last_activity();
    const Exchange lost = bench.requester.send(bench.timeline, request(), {.at = end + behind});
    EXPECT_TRUE(lost.silent());
    ASSERT_TRUE(data_exchange().answered());
    ASSERT_EQ(bench.count(Reason::kFaultyUnsynced), before + 1) << behind;
    EXPECT_EQ(bench.last(Reason::kFaultyUnsynced).a, 1);
  }
}

TEST_F(Telegrams, ToEverybodyThatWantAnAnswerAreIgnoredWithAReason) {
  const auto refusals = [this] {
    int count = 0;
    for (const auto& event : bench.chip.events()) count += severity(event.reason) == profibus::Severity::kRefusal;
    return count;
  };
  for (const int sap : {kNoSap, 60, 61, 62, 58}) {
    const int before = refusals();
    expect_ignored(bus::characters(
                       bus::encode(bus::make_telegram(127, 2, kSrdFirst, {0, 0}, optional_sap(sap), optional_sap(62)))),
                   {}, "SRD to 127, SAP " + std::to_string(sap));
    EXPECT_EQ(refusals(), before + 1) << "S8: every ignored telegram has its reason";
  }
}

TEST_F(Telegrams, OfOtherStationsAreNoBusinessOfTheChip) {
  const auto events = [this] { return bench.chip.events().size(); };
  const auto before = bench.chip.status();
  const std::size_t reported = events();
  for (const int da : {0, 4, 6, 69, 100, 126}) {
    const auto other = static_cast<std::uint8_t>(da);
    send(bus::characters(bus::encode(bus::make_telegram(other, 2, kSrdFirst, {1, 2}))));
    send(bus::characters(bus::encode(bus::make_telegram(other, 2, kSrdFirst, {}, 60, 62))));
    send(bus::characters(bus::encode(bus::make_telegram(other, 2, kFdlStatus))));
    send(bus::characters(bus::encode(bus::make_token(other, 2))));
    send(bus::characters(bus::encode(bus::make_telegram(other, 5, kSrdFirst, {9, 9}))));
  }
  send(bus::characters(bus::encode(bus::make_token(5, 2))));
  send(bus::characters(bus::encode(bus::make_token(127, 5))));
  send(bus::characters(bus::encode(bus::make_sc())));
  settle(bench);
  EXPECT_EQ(events(), reported);
  EXPECT_EQ(bench.chip.status().telegrams_answered, before.telegrams_answered);
  EXPECT_EQ(bench.chip.status().data_exchanges, before.data_exchanges);
  EXPECT_TRUE(data_exchange().answered());
}

TEST_F(Telegrams, AnswersOfOtherStationsBetweenRequestsDoNoHarm) {
  const Tick bit = bench.requester.bit();
  for (int i = 0; i < 5; ++i) {
    send(bus::characters(bus::encode(bus::make_telegram(9, 2, kSrdFirst, {1}))), 40);
    const Tick at = bench.requester.last_activity() + 11 * bit;  // the other slave answers after its TSDR
    bench.requester.send(bench.timeline, bus::encode(bus::make_telegram(2, 9, 0x08, {1, 2, 3})),
                         {.at = std::max(at, bench.now()), .wants_answer = false});
    EXPECT_TRUE(data_exchange().answered());
  }
}

// --- right ones in every form

TEST(TelegramForms, Sd3RequestsAreServedAndAnsweredWithSd2) {
  Init init;
  init.cfg = {0x17, 0x27};
  SlaveBench bench(quick_search());
  bench.to_wait_prm(init);
  const auto sd3 = [&](int dsap, const Bytes& data) {
    return bench.requester.send(bench.timeline,
                                bus::prefer_sd3(bus::make_telegram(5, 2, kSrdFirst, data, optional_sap(dsap),
                                                                   dsap < 0 ? std::nullopt : optional_sap(62))));
  };
  Init six;
  six.cfg = {0x11, 0x11, 0x11, 0x21, 0x21, 0x21};
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  ASSERT_TRUE(is_sc(sd3(62, six.cfg)));  // 8 bytes with the SAPs
  EXPECT_EQ(bench.dp_state(), DpState::kDataExch);
  ASSERT_TRUE(is_sc(bench.set_prm({})));
  ASSERT_TRUE(is_sc(ask(bench, 62, init.cfg)));
  bench.give_inputs({1, 2, 3, 4, 5, 6, 7, 8});
  const Exchange exchange = sd3(kNoSap, {8, 7, 6, 5, 4, 3, 2, 1});
  ASSERT_TRUE(is_data(exchange)) << kind_of(exchange);
  EXPECT_EQ(exchange.answer().data, (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), (Bytes{8, 7, 6, 5, 4, 3, 2, 1}));
}

TEST(TelegramForms, TheLongestTelegramIsRead) {
  Init init;
  init.cfg = {0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x7F, 0x79};
  SlaveBench bench(quick_search());
  bench.to_data_exch(init);
  Bytes outputs;
  for (int i = 0; i < 244; ++i) outputs.push_back(static_cast<std::uint8_t>(i * 7));
  EXPECT_TRUE(bench.data_exchange(outputs).answered());
  bench.chip_accesses();
  EXPECT_EQ(bench.fetch_outputs(), outputs);
  // 246 bytes with both SAPs: LE 249.
  EXPECT_TRUE(is_rs(ask(bench, 40, outputs)));
}

}  // namespace
}  // namespace dsdpv1::conformance
