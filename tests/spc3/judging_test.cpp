// The user's answers to Set_Prm, Check_Cfg and Set_Slave_Address, and the buffers between (docs/spc3.md, "Prm, Cfg,
// SSA"; A4, A14, A20 to A26, A37, A53, A57).
#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {
namespace {

using spc3::Reason;

constexpr unsigned kNotReady = 0x02, kCfgFault = 0x04, kPrmFault = 0x40;

TEST(Judging, ParametersNotOkAreAFault) {
  Bench bench;
  bench.to_wait_prm();
  bench.set_prm({0});
  EXPECT_EQ(bench.load(regs::kPrmNotOk), regs::kVerdictFinished);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_FALSE(bench.raised(regs::kEventNewPrm));
  EXPECT_EQ(bench.diag()[0], kPrmFault | kNotReady);
}

TEST(Judging, ConfigurationNotOkIsAFault) {
  Bench bench;
  bench.to_wait_cfg();
  bench.check_cfg();
  EXPECT_EQ(bench.load(regs::kCfgNotOk), regs::kVerdictFinished);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  EXPECT_EQ(bench.diag()[0], kCfgFault | kNotReady);
  bench.set_prm();
  bench.check_cfg();
  EXPECT_EQ(bench.diag()[0], kCfgFault | kNotReady);
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.diag()[0], kNotReady) << "with the next Cfg ok, also without inputs";
}

TEST(Judging, ANewerTelegramIsAConflict) {
  Bench bench;
  bench.to_wait_prm();
  bench.set_prm({0, 1});
  const std::uint8_t first = bench.load(regs::kOrgPrmPointer);
  bench.set_prm({0, 2, 2});
  EXPECT_EQ(bench.load(regs::kOrgPrmPointer), first) << "it waits in Aux";
  EXPECT_EQ(bench.load(regs::kOrgPrmLength), 9);
  bench.set_prm({0, 3, 3, 3});
  for (const Address answer : {regs::kPrmNotOk, regs::kPrmOk}) {
    const bool again = answer == regs::kPrmOk;
    EXPECT_EQ(bench.load(answer), again ? regs::kVerdictFinished : regs::kVerdictConflict)
        << "the verdict on the old one counts for nothing";
    EXPECT_EQ(bench.load(regs::kOrgPrmLength), 11) << "the third has replaced the second";
    EXPECT_EQ(bench.raised(regs::kEventNewPrm), !again);
  }
  EXPECT_EQ(bench.buffer(regs::kOrgPrmPointer, 11).back(), 3);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);

  bench.check_cfg({0x10});
  bench.check_cfg({0x10, 0x20});
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictConflict);
  EXPECT_EQ(bench.load(regs::kOrgCfgLength), 2);
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
}

TEST(Judging, AnAnswerToNothingIsNotAllowed) {
  Bench bench;
  bench.power_on();
  bench.initialise();
  for (const Address answer : {regs::kPrmOk, regs::kPrmNotOk, regs::kCfgOk, regs::kCfgNotOk})
    EXPECT_EQ(bench.load(answer), regs::kVerdictNotAllowed) << "OFFLINE (A7)";
  bench.start();
  bench.find_baud();
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictNotAllowed);
  bench.store(regs::kIrr + 1, 0x0C);  // both events by hand (A10)
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictNotAllowed);
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictNotAllowed);
  EXPECT_EQ(bench.irr() & 0x0C00, 0) << "A14";
  EXPECT_EQ(bench.count(Reason::kNotAllowed), 7);
}

TEST(Judging, LeaveMasterDropsWhatIsPendingAndKeepsTheEvent) {
  Bench bench;
  bench.to_wait_prm();
  bench.set_prm({0});
  bench.set_prm({0, 1});
  bench.set_prm({}, 0x40);
  EXPECT_TRUE(bench.raised(regs::kEventNewPrm));
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictNotAllowed);
  EXPECT_FALSE(bench.raised(regs::kEventNewPrm));
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
}

TEST(Judging, SevenBytesAreTheChipsOwnMatter) {
  Bench bench;
  bench.to_wait_prm();
  bench.set_prm({0});
  bench.set_prm();
  EXPECT_EQ(bench.load(regs::kOrgPrmLength), 8) << "no buffer";
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictNotAllowed) << "the pending one is dropped (A20)";
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
}

TEST(Judging, SevenBytesMayGoToTheUser) {
  spc3::Config config;
  config.prm7 = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_wait_prm();
  bench.set_prm();
  EXPECT_TRUE(bench.raised(regs::kEventNewPrm));
  EXPECT_EQ(bench.load(regs::kOrgPrmLength), 7);
}

TEST(Judging, NewParametersDropAnAcceptedConfiguration) {
  Bench bench;
  bench.to_wait_cfg();
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.check_cfg();
  bench.set_prm();
  EXPECT_TRUE(bench.raised(regs::kEventNewCfg));
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictNotAllowed) << "A53";
  bench.give_inputs({1, 2, 3});
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "a new Check_Cfg is needed";
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  bench.exchange({1, 2});
  bench.set_prm();
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.set_prm();
  bench.give_inputs({1, 2, 3});
  EXPECT_EQ(bench.count(profibus::Reason::kVerdictUnexpected), 0) << "nothing is held back any more";
}

TEST(Judging, ANewConfigurationDropsTheAcceptedOne) {
  Bench bench;
  bench.to_wait_cfg();
  bench.check_cfg();
  bench.load(regs::kCfgOk);
  bench.check_cfg();
  bench.give_inputs({1, 2, 3});
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "it is pending (A24)";
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
}

TEST(Judging, TooLongForTheAuxIsRr) {
  Bench bench;
  bench.to_wait_cfg();
  bench.store(regs::kOrgAuxLength, 8);
  EXPECT_EQ(kind_of(bench.check_cfg(Bytes(9, 0))), "RR");
  EXPECT_EQ(kind_of(bench.set_prm({0, 0})), "RR");
  EXPECT_EQ(kind_of(bench.check_cfg(Bytes(8, 0))), "SC");
  EXPECT_EQ(kind_of(bench.set_prm({0})), "SC");
  bench.store(regs::kOrgAuxLength, 6);
  EXPECT_EQ(kind_of(bench.set_prm()), "RR") << "before it is judged";
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  EXPECT_EQ(bench.count(Reason::kNoRoom), 3);
}

TEST(Judging, APointerOfZeroIsRr) {
  Bench bench;
  bench.to_wait_prm();
  for (const Address pointer : {regs::kOrgAuxPointer, regs::kOrgPrmPointer}) {
    const std::uint8_t segment = bench.load(pointer);
    bench.store(pointer, 0);
    EXPECT_EQ(kind_of(bench.set_prm({0})), "RR");
    bench.store(pointer, segment);
  }
  bench.store(regs::kOrgReadCfgPointer, 0);
  EXPECT_EQ(kind_of(bench.ask(59)), "RR");
  bench.store(regs::kOrgReadCfgLength, 0);
  EXPECT_EQ(kind_of(bench.ask(59)), "SC") << "nothing is needed";
  EXPECT_EQ(bench.count(Reason::kNoPointer), 3);
}

TEST(Judging, AnAuxThatHoldsAWaitingOneTakesNoOtherKind) {
  Bench bench;
  bench.to_wait_cfg({}, {0});
  bench.set_prm({0});
  bench.set_prm({0, 1});
  EXPECT_EQ(kind_of(bench.check_cfg()), "RR") << "A57";
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictConflict);
  EXPECT_EQ(kind_of(bench.check_cfg()), "SC");
}

TEST(Judging, EachKindHasTheAuxThatItSelects) {
  Bench bench;
  Organisation given;
  given.aux_select = 0x02;  // Check_Cfg: Aux 2
  bench.to_wait_cfg(given, {0});
  bench.set_prm({0});
  bench.set_prm({0, 1});
  EXPECT_EQ(kind_of(bench.check_cfg()), "SC");
  EXPECT_EQ(bench.load(regs::kOrgCfgPointer), kAux + 8);
  EXPECT_EQ(bench.load(regs::kOrgAuxPointer + 1), kCfg);
}

TEST(Judging, SpecPrmBufTakesLongParametersDirectly) {
  Bench bench;
  Organisation given;
  given.modes |= regs::kMode0SpecPrmBuf;
  bench.to_wait_prm(given);
  bench.store(regs::kOrgAuxLength, 7);
  bench.store(regs::kOrgSpecPrmLength, 20);
  EXPECT_EQ(kind_of(bench.set_prm(Bytes(13, 0x5A))), "SC");
  EXPECT_EQ(bench.load(regs::kOrgPrmPointer), kPrm) << "nothing is exchanged (A37)";
  EXPECT_EQ(bench.load(regs::kOrgPrmLength), 20);
  EXPECT_EQ(bench.buffer(regs::kOrgPrmPointer, 20).back(), 0x5A);
  EXPECT_EQ(kind_of(bench.set_prm({0})), "RR") << "while one is pending";
  EXPECT_EQ(bench.load(regs::kPrmOk), regs::kVerdictFinished);
  EXPECT_EQ(kind_of(bench.set_prm(Bytes(14, 0))), "RR") << "longer than 3DH";
  EXPECT_EQ(kind_of(bench.set_prm()), "SC");
}

TEST(Judging, EnChangeCfgExchangesTheTwoBuffers) {
  Bench bench;
  bench.to_wait_cfg();
  EXPECT_EQ(bench.ask(59).answer().data, (Bytes{0x12, 0x21}));
  bench.check_cfg({0x31, 0x32, 0x33});
  const std::uint8_t cfg = bench.load(regs::kOrgCfgPointer);
  bench.store(regs::kOrgReadCfgLength, bench.load(regs::kOrgCfgLength));
  bench.set_mode1(regs::kMode1EnChangeCfg);
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
  EXPECT_EQ(bench.load(regs::kOrgReadCfgPointer), cfg) << "A26";
  EXPECT_EQ(bench.load(regs::kOrgCfgPointer), kReadCfg);
  EXPECT_EQ(bench.ask(59).answer().data, (Bytes{0x31, 0x32, 0x33}));
  bench.store(regs::kMode1R, regs::kMode1EnChangeCfg);
  bench.check_cfg({0x31, 0x32, 0x33});
  const std::uint8_t now = bench.load(regs::kOrgCfgPointer);
  bench.load(regs::kCfgOk);
  EXPECT_EQ(bench.load(regs::kOrgCfgPointer), now);
}

TEST(Judging, AConfigurationInDataExchangeGoesToTheUser) {
  Bench bench;
  bench.to_data_ex();
  EXPECT_EQ(kind_of(bench.check_cfg({0x99})), "SC");
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(kind_of(bench.exchange({1, 2})), "DL");
  EXPECT_EQ(bench.load(regs::kCfgOk), regs::kVerdictFinished);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kDataExch);
  EXPECT_EQ(bench.count(profibus::Reason::kCfgAccepted), 2) << "without new inputs";
  bench.check_cfg({0x99});
  bench.load(regs::kCfgNotOk);
  bench.run_cycles(2);
  EXPECT_EQ(bench.state(), DpState::kWaitPrm) << "A25";
}

TEST(Judging, Vpc3RefusesReservedBitsOfParameters) {
  for (const Variant variant : {Variant::kVpc3, Variant::kSpc3}) {
    Bench bench(variant);
    bench.to_wait_prm();
    const bool looks = variant == Variant::kVpc3;
    for (const auto& [user, status] : {std::pair(Bytes{0x08}, 0x80), {Bytes{0}, 0x81}}) {
      bench.set_prm(user, static_cast<std::uint8_t>(status));
      EXPECT_EQ(bench.state(), looks ? DpState::kWaitPrm : DpState::kWaitCfg);
      bench.set_prm({}, 0x40);
    }
    EXPECT_EQ(bench.count(Reason::kPrmReserved), looks ? 2 : 0);
    if (!looks) continue;
    bench.store(regs::kMode2, regs::kMode2NoPrmCheck);
    bench.set_prm({0x08});
    EXPECT_EQ(bench.state(), DpState::kWaitCfg);
  }
}

TEST(Judging, DisStopIsReportedAndCheckCfgWaitsForParameters) {
  Bench bench;
  bench.to_wait_prm();
  EXPECT_EQ(kind_of(bench.check_cfg()), "RS") << "A52";
  bench.set_prm({0xFA});
  EXPECT_EQ(bench.count(Reason::kDisStop), 1) << "A21";
  EXPECT_EQ(bench.state(), DpState::kWaitCfg) << "other bits of byte 7 are not checked";
}

// --- Set_Slave_Address -----------------------------------------------------------------------------------------------

TEST(Judging, AnAddressIsTakenInsideAndGoesToTheUser) {
  Bench bench;
  bench.to_wait_prm();
  EXPECT_EQ(kind_of(bench.ask(55, {77, 0x0C, 0xC9, 0, 0xAA})), "SC");
  EXPECT_TRUE(bench.raised(regs::kEventNewSsa));
  EXPECT_EQ(bench.load(regs::kOrgSsaLength), 5);
  EXPECT_EQ(bench.buffer(regs::kOrgSsaPointer, 5), (Bytes{77, 0x0C, 0xC9, 0, 0xAA}));
  EXPECT_EQ(bench.load(regs::kOrgAddress), 5) << "the cell stays (A23)";
  EXPECT_EQ(kind_of(bench.ask(60)), "silent");
  bench.address = 77;
  EXPECT_EQ(kind_of(bench.ask(60)), "DL");
  EXPECT_EQ(kind_of(bench.ask(55, {78, 0x0C, 0xC9, 1})), "RR") << "until SSA_Buffer_Free";
  EXPECT_EQ(bench.load(regs::kSsaFree), 0);
  EXPECT_EQ(kind_of(bench.ask(55, {78, 0x0C, 0xC9, 1})), "SC");
  bench.address = 78;
  bench.load(regs::kSsaFree);
  EXPECT_EQ(kind_of(bench.ask(55, {79, 0x0C, 0xC9, 0})), "RS") << "locked";
}

TEST(Judging, AWrongAddressIsIgnored) {
  Bench bench;
  bench.to_wait_prm();
  for (const Bytes& wrong : {Bytes{77, 0x0C, 0xC8, 0}, Bytes{126, 0x0C, 0xC9, 0}, Bytes{77, 0x0C, 0xC9}})
    EXPECT_EQ(kind_of(bench.ask(55, wrong)), "SC");
  EXPECT_FALSE(bench.raised(regs::kEventNewSsa));
  EXPECT_EQ(kind_of(bench.ask(60)), "DL") << "still at its address";
}

TEST(Judging, AddressesWithoutBufferOrLockedAreRs) {
  Organisation without, locked;
  without.ssa = false;
  locked.no_add_change = true;
  for (const Organisation& given : {without, locked}) {
    Bench bench;
    bench.to_wait_prm(given);
    EXPECT_EQ(kind_of(bench.ask(55, {77, 0x0C, 0xC9, 0})), "RS");
  }
  Bench bench;
  bench.to_wait_cfg();
  EXPECT_EQ(kind_of(bench.ask(55, {77, 0x0C, 0xC9, 0})), "RS") << "WAIT_PRM only";
}

TEST(Judging, AddressCellsMayBeWrittenByTheChip) {
  spc3::Config config;
  config.ssa_cells = 1;
  Bench bench(Variant::kSpc3, config);
  bench.to_wait_prm();
  bench.ask(55, {77, 0x0C, 0xC9, 1});
  EXPECT_EQ(bench.load(regs::kOrgAddress), 77);
  EXPECT_EQ(bench.load(regs::kOrgNoAddressChange), 0xFF);
}

TEST(Judging, AddressCellsMayBeLive) {
  spc3::Config config;
  config.address_cells = 1;
  Bench bench(Variant::kApc3, config);
  bench.to_wait_prm();
  bench.store(regs::kOrgAddress, 9);
  bench.address = 9;
  EXPECT_EQ(kind_of(bench.ask(60)), "DL");
  bench.store(regs::kOrgNoAddressChange, 0xFF);
  EXPECT_EQ(kind_of(bench.ask(55, {77, 0x0C, 0xC9, 0})), "RS");
}

TEST(Judging, TheIdentIsLive) {
  Bench bench;
  bench.to_wait_prm();
  bench.store(regs::kOrgIdentLow, 0xCA);
  EXPECT_EQ(bench.count(Reason::kOrganisationOnline), 1) << "A5";
  bench.set_prm();
  EXPECT_EQ(bench.state(), DpState::kWaitPrm);
  bench.organisation.ident = 0x0CCA;
  bench.set_prm();
  EXPECT_EQ(bench.state(), DpState::kWaitCfg);
}

}  // namespace
}  // namespace dsdpv1::spc3_test
