// I&M0: call 08 00 FD E8 to slot 0, index 255, then read 4 + 64 bytes.
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using testing::ElementsAre;

class Im0 : public AcyclicTestOfEachClass {
 protected:
  void SetUp() override {
    AcyclicTest::SetUp();
    im0.header[9] = 0x99;
    im0.manufacturer_id = 0x0102;
    im0.order_id = "ORDER 0815";
    im0.serial_number = "0123456789ABCDEF";
    im0.hardware_revision = 0x0304;
    im0.software_type = 'V';
    im0.software_revision[0] = 1;
    im0.software_revision[2] = 3;
    im0.revision_counter = 0x0506;
    im0.profile_id = 0xF600;
    im0.profile_specific_type = 0x0004;
    im0.version_major = 1;
    im0.version_minor = 1;
    im0.supported = 0x0000;
    table.im0 = &im0;
  }
  Bytes call(const Bytes& header = {0x08, 0x00, 0xFD, 0xE8}) {
    return ask(cls(), with_data({0x5F, 0, 255, static_cast<std::uint8_t>(header.size())}, header));
  }
  Bytes read(std::uint8_t length = 68) { return ask(cls(), {0x5E, 0, 255, length}); }

  dsdpv1_im0 im0{};
};
INSTANTIATE_TEST_SUITE_P(Class, Im0, testing::Values(1, 2));

TEST_P(Im0, IsReadAfterItsCall) {
  open();
  EXPECT_THAT(call(), ElementsAre(0x5F, 0, 255, 4));
  Bytes expected = {0x5E, 0, 255, 68, 0x08, 0x00, 0xFD, 0xE8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x99, 0x01, 0x02};
  const std::string texts = "ORDER 0815          0123456789ABCDEF";
  expected.insert(expected.end(), texts.begin(), texts.end());
  const Bytes tail = {0x03, 0x04, 'V', 1, 0, 3, 0x05, 0x06, 0xF6, 0x00, 0x00, 0x04, 1, 1, 0, 0};
  expected.insert(expected.end(), tail.begin(), tail.end());
  EXPECT_EQ(expected.size(), 4U + 68U);
  EXPECT_EQ(read(), expected);
}

TEST_P(Im0, LargerReadGetsThe68Bytes) {
  open();
  static_cast<void>(call());
  const Bytes answer = read(240);
  EXPECT_EQ(answer.size(), 4U + 68U);
  EXPECT_EQ(answer[3], 68);
}

TEST_P(Im0, ShorterReadIsCut) {
  open();
  static_cast<void>(call());
  EXPECT_THAT(read(4), ElementsAre(0x5E, 0, 255, 4, 0x08, 0x00, 0xFD, 0xE8));
}

TEST_P(Im0, ReadWithoutACallIsAStateConflict) {
  open();
  EXPECT_THAT(read(), ElementsAre(0xDE, 0x80, 0xB5, 0));
}

TEST_P(Im0, EachReadNeedsItsCall) {
  open();
  static_cast<void>(call());
  EXPECT_EQ(read().size(), 72U);
  EXPECT_THAT(read(), ElementsAre(0xDE, 0x80, 0xB5, 0));
}

TEST_P(Im0, CallOfOneClassIsNotTheOthers) {
  open();
  static_cast<void>(call());
  EXPECT_THAT(ask(3 - cls(), {0x5E, 0, 255, 68}), ElementsAre(0xDE, 0x80, 0xB5, 0));
  EXPECT_EQ(read().size(), 72U);
}

TEST_P(Im0, WrongCalls) {
  open();
  EXPECT_THAT(call({0x08, 0x00, 0xFD}), ElementsAre(0xDF, 0x80, 0xB1, 0)) << "shorter than a header";
  EXPECT_THAT(call({}), ElementsAre(0xDF, 0x80, 0xB1, 0));
  EXPECT_THAT(call({0x09, 0x00, 0xFD, 0xE8}), ElementsAre(0xDF, 0x80, 0xA9, 0)) << "not CALL";
  EXPECT_THAT(call({0x08, 0x01, 0xFD, 0xE8}), ElementsAre(0xDF, 0x80, 0xB8, 0)) << "reserved byte";
  for (const std::uint8_t low : Bytes{0xE7, 0xE9, 0xEA})
    EXPECT_THAT(call({0x08, 0x00, 0xFD, low}), ElementsAre(0xDF, 0x80, 0xB0, 0)) << "I&M1, I&M2: not there";
  EXPECT_THAT(call({0x08, 0x00, 0xFD, 0xE8, 0x55}), ElementsAre(0xDF, 0x80, 0xB6, 0)) << "I&M0 is read-only";
}

TEST_P(Im0, WrongCallTakesBackTheRightOne) {
  open();
  static_cast<void>(call());
  static_cast<void>(call({0x08, 0x00, 0xFD, 0xE9}));
  EXPECT_THAT(read(), ElementsAre(0xDE, 0x80, 0xB5, 0));
}

TEST_P(Im0, InitialisationTakesBackTheCall) {
  open();
  static_cast<void>(call());
  initialise();
  EXPECT_THAT(read(), ElementsAre(0xDE, 0x80, 0xB5, 0));
}

TEST_P(Im0, TransportIsNotSupported) {
  open();
  EXPECT_THAT(ask(cls(), {0x51, 0, 255, 4, 0x08, 0x00, 0xFD, 0xE8}), ElementsAre(0xD1, 0x80, 0xA9, 0));
}

TEST_P(Im0, OtherIndexesOfSlot0AreUnknownIndexes) {
  open();
  EXPECT_THAT(ask(cls(), {0x5E, 0, 1, 4}), ElementsAre(0xDE, 0x80, 0xB0, 0));
  EXPECT_THAT(ask(cls(), {0x5E, 1, 255, 4}), ElementsAre(0xDE, 0x80, 0xB0, 0));
}

TEST_P(Im0, AloneNeedsNoTable) {
  objects.clear();
  open();
  static_cast<void>(call());
  EXPECT_EQ(read().size(), 72U);
}

TEST_P(Im0, WithoutItTheApplicationMayUseThePlace) {
  table.im0 = nullptr;
  objects.push_back(data_object({0, 255}, DSDPV1_MAY_READ, DSDPV1_CLASS_BOTH, {0, 4}, parameter.data()));
  open();
  EXPECT_THAT(read(1), ElementsAre(0x5E, 0, 255, 1, 0x11));
}

TEST_P(Im0, TextsAndPlaceAreChecked) {
  im0.order_id = "123456789012345678901";
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_IM0);
  im0.order_id = "12345678901234567890";
  im0.serial_number = "01234567890123456";
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_IM0);
  im0.serial_number = nullptr;
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_IM0);
  im0.serial_number = "";
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_OK);
  const dsdpv1_object object = data_object({0, 255}, DSDPV1_MAY_READ, DSDPV1_CLASS_BOTH, {0, 4}, parameter.data());
  table.objects = &object;
  table.count = 1;
  EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_ERR_TABLE);
}

}  // namespace
}  // namespace dsdpv1
