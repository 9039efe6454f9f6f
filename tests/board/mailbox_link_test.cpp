// The mailbox with any content that firmware may leave: the bench uses only valid values.
#include "kinds/dsdpv1/board/mailbox_link.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace dsdpv1 {
namespace {

class MailboxLinkTest : public testing::Test {
 protected:
  bool look() {
    return link.look(
        7, [this](const user_cpu::ProgramError& error) { errors.push_back(error); });
  }
  /// As in the example firmware.
  void report_error(std::uint8_t error, std::uint8_t during) {
    auto& entry = box.report.errors[box.report.error_count % DSDPV1_MAILBOX_ERRORS];
    entry.error = error;
    entry.during = during;
    ++box.report.error_count;
  }

  dsdpv1_mailbox box{};
  arm::MailboxLink link{reinterpret_cast<std::uint8_t*>(&box), {}};
  std::vector<user_cpu::ProgramError> errors;
};

TEST_F(MailboxLinkTest, EveryByteAsAnErrorIsOneOfTheDriversOrIsNamed) {
  std::map<unsigned, std::string> failures;
#define X(name, value, text) failures[value] = #name;
  DSDPV1_ERROR_TABLE(X)
#undef X
  failures.erase(DSDPV1_OK);
  for (unsigned value = 0; value < 256; ++value) {
    dsdpv1_mailbox memory{};
    arm::MailboxLink each(reinterpret_cast<std::uint8_t*>(&memory), {});
    memory.report.errors[0].error = static_cast<std::uint8_t>(value);
    memory.report.error_count = 1;
    std::string seen;
    each.look(7, [&](const user_cpu::ProgramError& error) { seen = error.code; });
    const bool known = failures.count(value) != 0;
    EXPECT_EQ(seen, known ? failures[value] : "") << value;
    EXPECT_EQ(
        each.wrong(),
        known ? "" : "report.errors[0].error is " + std::to_string(value) + ", expected the failures of dsdpv1_error");
  }
}

TEST_F(MailboxLinkTest, CallThatTheDriverDoesNotHaveIsNamed) {
  report_error(DSDPV1_ERR_C2_CRC, DSDPV1_DURING_ACYCLIC_POLL);
  look();
  EXPECT_EQ(link.wrong(), "");
  report_error(DSDPV1_ERR_C2_CRC, 8);
  look();
  EXPECT_EQ(link.wrong(), "report.errors[1].during is 8, expected 0 to 7");
  EXPECT_EQ(errors.size(), 1U);
}

TEST_F(MailboxLinkTest, LengthOfOutputsBeyondTheirPlaceIsNamedAndNothingIsFetched) {
  box.report.outputs[243] = 9;
  box.report.output_length = 244;
  box.report.outputs_received = 1;
  look();
  EXPECT_EQ(link.outputs().size(), 244U);
  box.report.output_length = 245;
  box.report.outputs_received = 2;
  look();
  EXPECT_EQ(link.wrong(), "report.output_length is 245, expected 0 to 244");
  EXPECT_EQ(link.outputs().size(), 244U);
}

TEST_F(MailboxLinkTest, DoneOfACommandThatWasNeverPostedIsNamed) {
  link.post(user_cpu::command::Stop{});
  EXPECT_TRUE(look());
  EXPECT_EQ(box.posted, 1U);
  box.done = 0xFFFFFFFF;
  EXPECT_TRUE(link.has_news());
  EXPECT_FALSE(look());
  EXPECT_EQ(link.wrong(), "done is 4294967295, expected `posted` and the number before it");
}

TEST_F(MailboxLinkTest, SpoiltTelegramsAreHandedOver) {
  user_cpu::command::OfChip order;
  order.order = user_cpu::kWrongParity;
  order.times = 3;
  link.post(order);
  look();
  EXPECT_EQ(box.command.kind, DSDPV1_CMD_SPOIL);
  EXPECT_EQ(box.command.value, DSDPV1_SPOIL_PARITY);
  EXPECT_EQ(box.command.times, 3U);
}

TEST_F(MailboxLinkTest, AnyCountOfErrorsCostsNoMoreThanThereIsRoomFor) {
  for (auto& entry : box.report.errors) entry.error = DSDPV1_ERR_C2_CRC;
  box.report.error_count = 0xFFFFFFFF;
  look();
  EXPECT_EQ(errors.size(), std::size_t{DSDPV1_MAILBOX_ERRORS});
  EXPECT_FALSE(link.has_news());
}

TEST_F(MailboxLinkTest, FirmwareThatBeganAgainCountsItsErrorsAgain) {
  for (int i = 0; i < 5; ++i) report_error(DSDPV1_ERR_C2_CRC, DSDPV1_DURING_SERVICE);
  look();
  box.report = {};
  report_error(DSDPV1_ERR_ANSWER_STALE, DSDPV1_DURING_ACYCLIC_POLL);
  look();
  EXPECT_EQ(link.wrong(), "");
  ASSERT_EQ(errors.size(), 6U);
  EXPECT_EQ(errors.back().code, "DSDPV1_ERR_ANSWER_STALE");
  EXPECT_NE(errors.back().text.find("acyclic_poll"), std::string::npos) << errors.back().text;
}

}  // namespace
}  // namespace dsdpv1
