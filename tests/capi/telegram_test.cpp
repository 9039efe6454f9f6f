// Telegrams and GSD files through the C API are those of the bus.
#include <fstream>
#include <sstream>
#include <string>

#include "bus/gsd/report.hpp"
#include "bus/telegram/telegram.hpp"
#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

const uint8_t kSlaveDiag[] = {0x68, 0x05, 0x05, 0x68, 0x85, 0x82, 0x6D, 0x3C, 0x3E, 0xEE, 0x16};

TEST(CapiTelegram, WhatIsEncodedIsDecodedAgain) {
  auto sent = sized<dpsim_telegram>(), received = sized<dpsim_telegram>();
  sent.kind = DPSIM_SD2;
  sent.da = 5;
  sent.sa = 2;
  sent.fc = 0x6D;
  sent.dsap = 60;
  sent.ssap = 62;
  uint8_t bytes[DPSIM_MAX_TELEGRAM];
  size_t count = 0, used = 0;
  ok(dpsim_telegram_encode(&sent, bytes, sizeof bytes, &count));
  EXPECT_EQ(std::vector<uint8_t>(bytes, bytes + count),
            std::vector<uint8_t>(std::begin(kSlaveDiag), std::end(kSlaveDiag)));
  dpsim_decode_error error = DPSIM_DECODE_FCS;
  ok(dpsim_telegram_decode(bytes, count, &received, &error, &used));
  EXPECT_EQ(error, DPSIM_DECODE_OK);
  EXPECT_EQ(used, count);
  EXPECT_EQ(received.da, 5);
  EXPECT_EQ(received.dsap, 60);
  EXPECT_EQ(received.data_size, 0);
}

TEST(CapiTelegram, WhatIsWrongIsNamed) {
  uint8_t bytes[sizeof kSlaveDiag];
  std::copy(std::begin(kSlaveDiag), std::end(kSlaveDiag), bytes);
  bytes[9] ^= 1;
  auto telegram = sized<dpsim_telegram>();
  dpsim_decode_error error = DPSIM_DECODE_OK;
  ok(dpsim_telegram_decode(bytes, sizeof bytes, &telegram, &error, nullptr));
  EXPECT_EQ(error, DPSIM_DECODE_FCS);
  EXPECT_STREQ(dpsim_decode_error_text(error), "wrong FCS");
  EXPECT_EQ(telegram.sa, 2);  // readable all the same
  const char* text = nullptr;
  ok(dpsim_telegram_explain(bytes, sizeof bytes, DPSIM_EXPLAIN_LINE, -1, &text));
  EXPECT_STREQ(text, "wrong telegram: wrong FCS");
}

TEST(CapiTelegram, IsExplainedInALineOrByteByByte) {
  const char* text = nullptr;
  ok(dpsim_telegram_explain(kSlaveDiag, sizeof kSlaveDiag, DPSIM_EXPLAIN_SERVICE, -1, &text));
  EXPECT_STREQ(text, "Slave_Diag");
  ok(dpsim_telegram_explain(kSlaveDiag, sizeof kSlaveDiag, DPSIM_EXPLAIN_LINE, -1, &text));
  EXPECT_EQ(std::string(text).rfind("2 -> 5", 0), 0U) << text;
  ok(dpsim_telegram_explain(kSlaveDiag, sizeof kSlaveDiag, DPSIM_EXPLAIN_BYTES, 0, &text));
  const std::string lines = text;
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), static_cast<long>(sizeof kSlaveDiag));
}

TEST(CapiTelegram, NoByteIsATruncatedTelegram) {
  auto telegram = sized<dpsim_telegram>();
  dpsim_decode_error error = DPSIM_DECODE_OK;
  ok(dpsim_telegram_decode(nullptr, 0, &telegram, &error, nullptr));
  EXPECT_EQ(error, DPSIM_DECODE_TRUNCATED);
  const char* text = nullptr;
  ok(dpsim_telegram_explain(nullptr, 0, DPSIM_EXPLAIN_LINE, -1, &text));
  EXPECT_EQ(std::string(text).rfind("wrong telegram: ", 0), 0U) << text;
  ok(dpsim_telegram_explain(nullptr, 0, DPSIM_EXPLAIN_BYTES, -1, &text));
  EXPECT_STREQ(text, "");
}

TEST(CapiTelegram, FieldsOutOfRangeAreRefused) {
  auto telegram = sized<dpsim_telegram>();
  telegram.kind = DPSIM_SD1;
  telegram.dsap = telegram.ssap = DPSIM_NO_SAP;
  telegram.da = 128;
  uint8_t bytes[DPSIM_MAX_TELEGRAM];
  size_t count = 0;
  EXPECT_EQ(dpsim_telegram_encode(&telegram, bytes, sizeof bytes, &count), DPSIM_ERR_ARGUMENT);
  EXPECT_STREQ(dpsim_error_message(), "dpsim_telegram_encode: da is 128, expected 0 to 127");
  telegram.da = 5;
  telegram.data_size = 3;  // SD1 has none
  EXPECT_EQ(dpsim_telegram_encode(&telegram, bytes, sizeof bytes, &count), DPSIM_ERR_ARGUMENT);
}

const char* const kGsd = DSDPV1_SOURCE_DIR "/scenarios/dsdpv1.gsd";

Owned<dpsim_gsd> load() {
  dpsim_gsd* gsd = nullptr;
  ok(dpsim_gsd_load(kGsd, &gsd));
  return Owned<dpsim_gsd>(gsd);
}

TEST(CapiGsd, AChoiceOfModulesGivesWhatAMasterSends) {
  const auto gsd = load();
  auto slave = sized<dpsim_slave>();
  const char* modules[] = {"8 bytes in", "1 byte out"};
  ok(dpsim_gsd_slave(gsd.get(), modules, 2, DPSIM_PRM_SYNC, &slave));
  EXPECT_EQ(slave.input_length, 8);
  EXPECT_EQ(slave.output_length, 1);
  EXPECT_EQ(std::vector<uint8_t>(slave.cfg, slave.cfg + slave.cfg_size), (std::vector<uint8_t>{0x17, 0x20}));
  EXPECT_EQ(slave.flags, static_cast<uint32_t>(DPSIM_PRM_SYNC));
  EXPECT_EQ(slave.min_slave_interval_us, 600);
  auto info = sized<dpsim_gsd_info>();
  ok(dpsim_gsd_get_info(gsd.get(), &info));
  EXPECT_EQ(slave.ident, info.ident);
  EXPECT_EQ(info.bauds & 1U, 1U);
  const char* name = nullptr;
  ok(dpsim_gsd_module(gsd.get(), 0, &name));
  EXPECT_STREQ(name, "1 byte in");
  const char* wrong[] = {"9 bytes in"};
  EXPECT_EQ(dpsim_gsd_slave(gsd.get(), wrong, 1, 0, &slave), DPSIM_ERR_INPUT);
  EXPECT_NE(std::string(dpsim_error_message()).find("9 bytes in"), std::string::npos) << dpsim_error_message();
}

TEST(CapiGsd, TheReportIsThatOfTheProgram) {
  const auto gsd = load();
  const char* modules[] = {"8 bytes in"};
  for (const bool json : {false, true}) {
    std::ifstream in(kGsd);
    std::ostringstream out, err;
    bus::GsdCommand command;
    command.choice.modules = {modules[0]};
    command.format = json ? bus::GsdFormat::kJson : bus::GsdFormat::kText;
    ASSERT_EQ(bus::gsd_command(in, kGsd, command, out, err), 0);
    const char* text = nullptr;
    ok(dpsim_gsd_report(gsd.get(), modules, 1, json ? 1 : 0, &text));
    EXPECT_EQ(out.str(), text);
  }
}

}  // namespace
}  // namespace dsdpv1::capi_test
