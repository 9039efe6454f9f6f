// Which act of the user an event of the chip is about: by it a violation names its line of source.
#include "kinds/dsdpv1/keys/user_act.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinds/dsdpv1/kind.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::tb {
namespace {

constexpr bus::Tick kAt = 100'000;

std::optional<user_cpu::Act> act_of(profibus::Reason reason, std::uint16_t a = 0, std::uint16_t b = 0) {
  profibus::Event event;
  event.at = kAt;
  event.reason = reason;
  event.a = a;
  event.b = b;
  return user_act_of(event);
}

std::optional<std::uint16_t> cell_of(profibus::Reason reason, std::uint16_t b = 0) {
  const auto act = act_of(reason, 0, b);
  return act ? act->cell : std::nullopt;
}

TEST(UserAct, RefusedBlockIsTheWriteOfItsFlag) {
  for (const auto reason : {dpram::Reason::kInitLimit, profibus::Reason::kDiagType, profibus::Reason::kCfgUserRefused})
    EXPECT_EQ(cell_of(reason), 0x010) << profibus::code(reason);
  for (const auto reason : {dpram::Reason::kC2Crc, profibus::Reason::kAcyclicAnswerDiffers})
    EXPECT_EQ(cell_of(reason), 0x011) << profibus::code(reason);
}

TEST(UserAct, BlockBeforeTheInitialisationIsTheWriteOfTheFlagThatTheEventNames) {
  EXPECT_EQ(cell_of(dpram::Reason::kBeforeInit, 0x010), 0x010);
  EXPECT_EQ(cell_of(dpram::Reason::kBeforeInit, 0x011), 0x011);
}

TEST(UserAct, ViolationAndRefusedTelegramAreWhatWasDoneLast) {
  for (const auto reason : {dsdpv1::Reason::kWriteSetup, dsdpv1::Reason::kTelegramCrc, dsdpv1::Reason::kUartParity}) {
    const auto act = act_of(reason);
    ASSERT_TRUE(act) << profibus::code(reason);
    EXPECT_EQ(act->at, kAt);
    EXPECT_FALSE(act->cell || act->since);
  }
}

TEST(UserAct, TimerThatEndsIsAnOmissionSinceTheLastTelegram) {
  const auto act = act_of(dsdpv1::Reason::kSpiUTimer, 100);
  ASSERT_TRUE(act);
  EXPECT_EQ(act->since, kAt - 100 * profibus::kTicksPerCycle);
}

TEST(UserAct, CrcOrIdentWithExchangedBytesIsToldFromAnotherWrongOne) {
  const auto text_of = [](profibus::Reason reason, std::uint16_t a, std::uint16_t b) {
    profibus::Event event;
    event.reason = reason;
    event.a = a;
    event.b = b;
    return kind_of(Part::kRsu).describe(event);
  };
  for (const auto reason : {dpram::Reason::kInputCrc, dsdpv1::Reason::kTelegramCrc}) {
    EXPECT_THAT(text_of(reason, 0x12AB, 0xAB12), testing::EndsWith("AB12 computed: its bytes are exchanged"));
    EXPECT_THAT(text_of(reason, 0x12AB, 0xAB13), testing::EndsWith("AB13 computed"));
  }
  EXPECT_EQ(text_of(profibus::Reason::kPrmIdent, 0x0CC9, 0xC90C),
            "Prm_Fault: ident 0CC9, this slave is C90C: its bytes are exchanged");
  EXPECT_EQ(text_of(profibus::Reason::kPrmIdent, 0x0CC9, 0xC90D), "Prm_Fault: ident 0CC9, this slave is C90D");
  EXPECT_THAT(text_of(dpram::Reason::kInitLimit, 0x12AB, 0xAB12), testing::Not(testing::HasSubstr("exchanged")));
}

TEST(UserAct, MastersAndStrapsAreNotTheUser) {
  for (const auto reason : {profibus::Reason::kPrmUserLength, profibus::Reason::kCfgLength, profibus::Reason::kFcs,
                            dsdpv1::Reason::kStrapChanged, dpram::Reason::kInitialised})
    EXPECT_FALSE(act_of(reason)) << profibus::code(reason);
}

}  // namespace
}  // namespace dsdpv1::tb
