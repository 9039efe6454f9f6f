// The user CPU's verdicts in a capture.
#include "lab/replay/user_verdicts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/replay/services.hpp"
#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using tb::replay::UserVerdict;
using tb::replay::VerdictReader;
using testing::ElementsAre;
using testing::IsEmpty;

namespace sap = bus::sap;

constexpr std::uint8_t kReady = 0x00, kNotReady = 0x02, kCfgFault = 0x04, kNotSupported = 0x10, kPrmFault = 0x40;
constexpr std::uint8_t kWaits = 0x04, kWantsPrm = 0x05;  // second byte of Slave_Diag

class UserVerdicts : public testing::Test {
 protected:
  void prm(const Bytes& data = {0x80, 0, 0, 11, 0x12, 0x34, 0}) { ask(to_slave(sap::kSetPrm, data), bus::make_sc()); }
  void cfg(bool accepted = true) {
    const Telegram rs = bus::make_telegram(kMaster, kSlave, bus::fc::kRs);
    ask(to_slave(sap::kChkCfg, {0x11}), accepted ? bus::make_sc() : rs);
  }
  void diag(std::uint8_t first, std::uint8_t second = kWaits, std::uint8_t master = kMaster) {
    ask(to_slave(sap::kSlaveDiag), from_slave(sap::kSlaveDiag, diagnosis(first, second, {}, master)));
  }
  void exchange() { ask(outputs({1}), inputs({1})); }

  VerdictReader read(bool cfg_early = false) {
    const auto recording = capture_.finish();
    VerdictReader reader(0, cfg_early);
    tb::replay::for_each_request(recording, [&](const Telegram& request, const tb::replay::RecordedTelegram* answer) {
      reader.take(request, answer);
    });
    return reader;
  }
  /// "P+" accepted parameters, "C-" a refused configuration, with the number of answers before.
  std::vector<std::string> words(const VerdictReader& reader) const {
    std::vector<std::string> result;
    for (const UserVerdict& each : reader.verdicts()) {
      const auto answers = std::count_if(ends_.begin(), ends_.end(), [&](bus::Tick end) { return end <= each.at; });
      result.push_back(std::string(each.cfg ? "C" : "P") + (each.refuse ? "-" : "+") + std::to_string(answers));
    }
    return result;
  }

 private:
  void ask(const Telegram& request, const Telegram& answer) {
    capture_.add(request);
    capture_.add(answer);
    ends_.push_back(capture_.now());
  }

  Capture capture_;
  std::vector<bus::Tick> ends_;
};

TEST_F(UserVerdicts, AreGivenWhenTheAnswerBeforeTheFirstThatShowsThemHasEnded) {
  prm();
  cfg();  // taken: the parameters were right
  diag(kNotReady);
  diag(kNotReady);
  diag(kReady);
  const VerdictReader reader = read();
  EXPECT_THAT(words(reader), ElementsAre("P+1", "C+4"));
  EXPECT_FALSE(reader.judges_prm(0x1234));
  EXPECT_TRUE(reader.judges_cfg({}));  // it waited
}

TEST_F(UserVerdicts, RefusedParametersAreTheUsersIfTheChipWouldTakeThem) {
  prm();
  cfg(false);
  diag(kNotReady | kPrmFault, kWantsPrm, 0xFF);
  const VerdictReader reader = read();
  EXPECT_THAT(words(reader), ElementsAre("P-2"));
  EXPECT_TRUE(reader.judges_prm(0x1234));
  EXPECT_FALSE(reader.judges_prm(0x1235));  // the chip compares it
}

TEST_F(UserVerdicts, TheChipJudgesSomeParametersItself) {
  diag(kNotReady, kWantsPrm, 0xFF);
  prm({0x88, 0, 1, 11, 0x12, 0x34, 0});  // a watchdog of 0
  diag(kNotReady | kPrmFault, kWantsPrm, 0xFF);
  prm({0x80, 0, 0, 11, 0x12});
  diag(kNotReady | kPrmFault, kWantsPrm, 0xFF);
  prm({0xA0, 0, 0, 11, 0x12, 0x34, 0});  // Sync
  diag(kNotReady | kPrmFault | kNotSupported, kWantsPrm, 0xFF);
  prm({0x40, 0, 0, 11, 0x12, 0x34, 0});  // Unlock
  diag(kNotReady, kWantsPrm, 0xFF);
  const VerdictReader reader = read();
  EXPECT_THAT(reader.verdicts(), IsEmpty());
  EXPECT_FALSE(reader.judges_prm(0x1234));
}

TEST_F(UserVerdicts, ParametersWaitWhileAConfigurationIsRefused) {
  diag(kNotReady, kWantsPrm, 0xFF);
  prm();
  cfg(false);
  diag(kNotReady, kWaits, 0xFF);
  diag(kNotReady, kWaits, kMaster);  // the slave has its master: accepted
  cfg();
  exchange();
  const VerdictReader reader = read();
  EXPECT_THAT(words(reader), ElementsAre("P+4", "C+6"));
  EXPECT_TRUE(reader.judges_prm(0x1234));
  EXPECT_FALSE(reader.judges_cfg({}));
}

TEST_F(UserVerdicts, ABlockThatIsReplacedHasNone) {
  prm();
  prm();
  cfg();
  prm();
  diag(kNotReady, kWantsPrm);  // it wants others
  EXPECT_THAT(words(read()), ElementsAre("P+2"));
}

TEST_F(UserVerdicts, ARefusedConfigurationIsTheUsersUnlessItIsNotTheSlavesOwn) {
  prm();
  cfg();
  diag(kNotReady | kCfgFault, kWantsPrm, 0xFF);
  const VerdictReader reader = read();
  EXPECT_THAT(words(reader), ElementsAre("P+1", "C-2"));
  EXPECT_TRUE(reader.judges_cfg(Bytes{0x11}));
  EXPECT_FALSE(reader.judges_cfg(Bytes{0x22}));
}

TEST_F(UserVerdicts, InDataExchangeTheChipJudgesTheConfiguration) {
  prm();
  cfg();
  exchange();
  cfg();
  exchange();
  EXPECT_THAT(words(read()), ElementsAre("P+1", "C+2"));
}

TEST_F(UserVerdicts, AChipMayTakeAConfigurationBeforeTheVerdictOnParameters) {
  prm();
  cfg();
  diag(kNotReady);
  diag(kReady);
  EXPECT_THAT(words(read(true)), ElementsAre("P+3", "C+3"));
}

}  // namespace
}  // namespace dsdpv1::replay_test
