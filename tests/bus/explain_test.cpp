#include "bus/telegram/explain.hpp"

#include "bus/telegram/explain_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dsdpv1::bus {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint8_t kRequestFc = 0x7D, kAnswerFc = 0x08;

std::uint8_t master_sap(std::uint8_t slave_sap) { return slave_sap <= sap::kMs2Rm ? sap::kMs2Master : sap::kMaster; }

Telegram request(std::uint8_t slave_sap, const Bytes& data, std::uint8_t fc = kRequestFc) {
  return make_telegram(3, 1, fc, data, slave_sap, master_sap(slave_sap));
}

Telegram answer(std::uint8_t slave_sap, const Bytes& data, std::uint8_t fc = kAnswerFc) {
  return make_telegram(1, 3, fc, data, master_sap(slave_sap), slave_sap);
}

std::vector<ExplainedByte> bytes_of(const Telegram& telegram) {
  TelegramDecoder decoder;
  for (const std::uint8_t byte : encode(telegram))
    if (const auto decoded = decoder.feed(byte)) return explain_bytes(*decoded);
  return {};
}

/// The texts of the data bytes of an SD2 telegram with two SAP bytes.
std::vector<std::string> data_texts(const Telegram& telegram) {
  std::vector<std::string> texts;
  const std::vector<ExplainedByte> bytes = bytes_of(telegram);
  for (std::size_t i = 9; i + 2 < bytes.size(); ++i) texts.push_back(bytes[i].meaning);
  return texts;
}

TEST(ExplainBytes, NoByteIsNoLine) { EXPECT_TRUE(explain_bytes(decode({})).empty()); }

TEST(ExplainLine, FunctionCodes) {
  EXPECT_EQ(explain_fc(0x49), "request FDL status FCB=0 FCV=0");
  EXPECT_EQ(explain_fc(0x6D), "request SRD high FCB=1 FCV=0");
  EXPECT_EQ(explain_fc(0x5C), "request SRD low FCB=0 FCV=1");
  EXPECT_EQ(explain_fc(0x46), "request SDN high FCB=0 FCV=0");
  EXPECT_EQ(explain_fc(0x00), "response OK, passive station");
  EXPECT_EQ(explain_fc(0x30), "response OK, active station, in the ring");
  EXPECT_EQ(explain_fc(0x03), "response RS (SAP not enabled), passive station");
  EXPECT_EQ(explain_fc(0x0A), "response DH (data high), passive station");
  EXPECT_THAT(explain_fc(0x40), HasSubstr("reserved"));
  EXPECT_THAT(explain_fc(0x04), HasSubstr("reserved"));
}

TEST(ExplainLine, TokenAndShortAcknowledge) {
  EXPECT_EQ(explain_line(make_sc()), "SC (short acknowledge)");
  EXPECT_EQ(explain_line(make_token(2, 1)), "1 -> 2  token");
}

TEST(ExplainLine, FdlStatus) {
  EXPECT_EQ(explain_line(make_telegram(3, 1, 0x49)), "1 -> 3  request FDL status FCB=0 FCV=0");
  EXPECT_EQ(explain_line(make_telegram(1, 3, 0x00)), "3 -> 1  response OK, passive station");
}

TEST(ExplainLine, DataExchange) {
  EXPECT_THAT(explain_line(make_telegram(3, 1, 0x7D, {0xAB, 0xCD})), HasSubstr("Data_Exchange: output AB CD"));
  EXPECT_THAT(explain_line(make_telegram(3, 1, 0x7D)), HasSubstr("Data_Exchange: no output"));
  EXPECT_THAT(explain_line(make_telegram(1, 3, 0x0A, {0x12})), HasSubstr("Data_Exchange: input 12"));
}

TEST(ExplainLine, EveryServiceHasItsName) {
  const std::pair<int, const char*> services[] = {{55, "Set_Slave_Address"}, {56, "Read_Inputs"}, {57, "Read_Outputs"},
                                                  {58, "Global_Control"},    {59, "Get_Cfg"},     {60, "Slave_Diag"},
                                                  {61, "Set_Prm"},           {62, "Chk_Cfg"},     {51, "MSAC1"},
                                                  {49, "MSAC2 Initiate"},    {48, "MSAC2"},       {63, "SAP 63"},
                                                  {53, "Ext_User_Prm"}};
  for (const auto& [sap, name] : services)
    EXPECT_THAT(explain_line(request(static_cast<std::uint8_t>(sap), {})), HasSubstr(name)) << sap;
}

TEST(ExplainLine, ReadInputsAndOutputs) {
  EXPECT_THAT(explain_line(answer(56, {1, 2})), HasSubstr("Read_Inputs: input 01 02"));
  EXPECT_THAT(explain_line(answer(57, {3})), HasSubstr("Read_Outputs: output 03"));
}

TEST(ExplainSetPrm, AllFields) {
  const Telegram prm = request(61, {0xB8, 2, 50, 11, 0x0B, 0x9A, 0x05, 0xC4, 0x01, 0x02, 0x99});
  EXPECT_THAT(explain_line(prm),
              HasSubstr("ident 0x0B9A, locked for this master, WD 100 ms, min_TSDR: 11 bit times, user bytes 4"));
  const auto texts = data_texts(prm);
  ASSERT_EQ(texts.size(), 11U);
  EXPECT_EQ(texts[0], "Station_status: WD_On, Freeze_Req, Sync_Req, Lock_Req (locked for this master)");
  EXPECT_EQ(texts[1], "WD_Fact_1: 2");
  EXPECT_EQ(texts[2], "WD_Fact_2: 50");
  EXPECT_EQ(texts[4], "Ident_Number high: 0x0B");
  EXPECT_EQ(texts[6], "Group_Ident: group 1, 3");
  EXPECT_EQ(texts[7], "DPV1_Status_1: WD_Base_1ms, Fail_Safe, DPV1_Enable");
  EXPECT_EQ(texts[8], "DPV1_Status_2: Check_Cfg_Mode");
  EXPECT_EQ(texts[9], "DPV1_Status_3: Alarm_Mode 2 (4 alarms in all at a time)");
  EXPECT_EQ(texts[10], "User_Prm_Data 0");
}

TEST(ExplainSetPrm, LockAndUnlock) {
  EXPECT_THAT(explain_line(request(61, {0x00, 0, 0, 0, 0, 0, 0})),
              AllOf(HasSubstr("only min_TSDR changes"), HasSubstr("WD off")));
  EXPECT_THAT(explain_line(request(61, {0x40, 0, 0, 0, 0, 0, 0})), HasSubstr("released"));
  EXPECT_THAT(explain_line(request(61, {0xC0, 0, 0, 0, 0, 0, 0})), HasSubstr("released"));
  EXPECT_THAT(explain_line(request(61, {0x88, 1, 1, 0, 0, 0, 0})), HasSubstr("WD 10 ms, min_TSDR: 0 = unchanged"));
}

TEST(ExplainSetPrm, WithoutDpv1TheUserBytesFollowAtOnce) {
  const auto texts = data_texts(request(61, {0x80, 0, 0, 0, 0, 0, 0, 0x00, 0x01}));
  EXPECT_EQ(texts[7], "Spec_User_Prm_Byte: none");
  EXPECT_EQ(texts[8], "User_Prm_Data 0");
}

/// The texts after the seven standard bytes.
std::vector<std::string> user_texts(const Bytes& user) {
  Bytes data = {0x80, 0, 0, 11, 0x0C, 0xC9, 0};
  data.insert(data.end(), user.begin(), user.end());
  std::vector<std::string> texts = data_texts(request(61, data));
  texts.erase(texts.begin(), texts.begin() + 7);
  return texts;
}

TEST(ExplainSetPrm, TheThreeDpv1Bytes) {
  using testing::ElementsAre;
  EXPECT_THAT(user_texts({0xA0, 0xFD, 0x90}),
              ElementsAre("DPV1_Status_1: Publisher_Enable, DPV1_Enable",
                          "DPV1_Status_2: Check_Cfg_Mode, Enable_Update_Alarm, Enable_Status_Alarm, "
                          "Enable_Manufacturer_Specific_Alarm, Enable_Diagnostic_Alarm, Enable_Process_Alarm, "
                          "Enable_Pull_Plug_Alarm",
                          "DPV1_Status_3: Alarm_Mode 0 (one alarm of each type at a time), IsoM_Req, PrmCmd"));
  EXPECT_THAT(user_texts({0x80, 0x02, 0x67}),
              ElementsAre("DPV1_Status_1: DPV1_Enable", "DPV1_Status_2: bit 1",
                          "DPV1_Status_3: Alarm_Mode 7 (32 alarms in all at a time), bit 5, bit 6"));
}

TEST(ExplainSetPrm, StructuredParametersBlockByBlock) {
  using testing::ElementsAre;
  EXPECT_THAT(
      user_texts({0x80, 0, 0x08, 6, 0x81, 2, 0, 0xAA, 0xBB, 5, 0x40, 3, 1, 0x11}),
      ElementsAre("DPV1_Status_1: DPV1_Enable", "DPV1_Status_2: none",
                  "DPV1_Status_3: Alarm_Mode 0 (one alarm of each type at a time), Prm_Structure",
                  "Structure_Length: 6", "Structure_Type: 129 (User_Prm_Data)", "Slot_Number: 2", "Specifier: 0x00",
                  "  data 0: 0xAA", "  data 1: 0xBB", "Structure_Length: 5",
                  "Structure_Type: 64 (manufacturer specific)", "Slot_Number: 3", "Specifier: 0x01", "  data 0: 0x11"));
}

TEST(ExplainSetPrm, BlocksOfTheStandardHaveTheirFields) {
  const auto texts = [](const Bytes& block) {
    Bytes user = {0x80, 0, 0x08};
    user.insert(user.end(), block.begin(), block.end());
    auto all = user_texts(user);
    all.erase(all.begin(), all.begin() + 4);
    return all;
  };
  EXPECT_EQ(texts({8, 2, 0, 8, 1, 0, 0, 5})[0], "Structure_Type: 2 (PrmCmd)");
  EXPECT_EQ(texts({8, 2, 0, 8, 1, 0, 0, 5})[6], "  Output_Hold_Time low: 0x05");
  EXPECT_EQ(texts({14, 5, 1, 0, 8, 0, 0, 1, 0, 2, 0, 150, 0xAB, 0xCD})[10], "  F_WD_Time low: 0x96");
  EXPECT_EQ(texts({14, 5, 1, 0, 8, 0, 0, 1, 0, 2, 0, 150, 0xAB, 0xCD})[12], "  data 9: 0xCD");
  const auto links = texts({13, 3, 0, 0, 1, 3, 4, 0, 2, 7, 4, 2, 2});
  EXPECT_EQ(links[3], "  Version: 0x01");
  EXPECT_EQ(links[4], "  Publisher_Addr 1: 0x03");
  EXPECT_EQ(links[11], "  Sample_Length 2: 0x02");
  EXPECT_EQ(texts(Bytes{28, 4, 0, 0}).size(), 3U);
  EXPECT_EQ(texts({4, 6, 0, 0})[0], "Structure_Type: 6 (reserved)");
}

TEST(ExplainSetPrm, BlocksThatDoNotFit) {
  const auto texts = user_texts({0x80, 0, 0x08, 9, 0x81, 0});
  EXPECT_EQ(texts[3], "Structure_Length: 9 (does not fit the telegram)");
  EXPECT_EQ(texts[5], "Slot_Number: 0");
  const auto none = user_texts({0x80, 0, 0x08, 3, 0x81, 0});
  EXPECT_EQ(none[3], "Structure_Length: 3 (at least 4 are right)");
  EXPECT_EQ(none[5], "no block: byte 1");
  EXPECT_EQ(user_texts({0x80, 0, 0x00, 6, 0x81, 2})[3], "User_Prm_Data 0") << "no Prm_Structure, no blocks";
}

TEST(ExplainSetPrm, TooShort) { EXPECT_THAT(explain_line(request(61, {0x80, 0})), HasSubstr("2 bytes, at least 7")); }

TEST(ExplainCfg, GeneralFormat) {
  const Telegram cfg = request(62, {0x13, 0x23, 0xF0, 0x61});
  EXPECT_THAT(explain_line(cfg), HasSubstr("4 modules, output 10 bytes, input 6 bytes"));
  const auto texts = data_texts(cfg);
  EXPECT_EQ(texts[0], "module 1: input 4 bytes, consistency over a byte");
  EXPECT_EQ(texts[1], "module 2: output 4 bytes, consistency over a byte");
  EXPECT_EQ(texts[2], "module 3: input and output 1 word, consistency over the whole module");
  EXPECT_EQ(texts[3], "module 4: output 2 words, consistency over a word");
}

TEST(ExplainCfg, SpecialFormatOfTheManual) {  // the example of table A.5 in the APC3 manual
  const Telegram cfg = request(62, {0xC3, 0xCF, 0xC7, 0x01, 0x02, 0x03});
  EXPECT_THAT(explain_line(cfg), HasSubstr("1 module, output 32 bytes, input 16 bytes"));
  const auto texts = data_texts(cfg);
  EXPECT_EQ(texts[0], "module 1: special format, output and input, 3 bytes of manufacturer data");
  EXPECT_EQ(texts[1], "  length of output: 16 words, consistency over the whole module");
  EXPECT_EQ(texts[2], "  length of input: 8 words, consistency over the whole module");
  EXPECT_EQ(texts[5], "  manufacturer data 2");
}

TEST(ExplainCfg, EmptySlotsAndIncompleteOnes) {
  EXPECT_EQ(data_texts(request(62, {0x00}))[0], "module 1: special format, empty slot, no manufacturer data");
  EXPECT_EQ(data_texts(request(62, {0x4F, 0x00}))[0],
            "module 1: special format, input, no manufacturer data, their comparison is switched off");
  EXPECT_THAT(explain_line(request(62, {0x10, 0x81})), HasSubstr("the last one incomplete"));
  EXPECT_THAT(explain_line(request(62, {0x02, 0x11})), HasSubstr("the last one incomplete"));
}

TEST(ExplainCfg, GetCfgIsReadTheSameWay) {
  EXPECT_THAT(explain_line(answer(59, {0x13})), HasSubstr("Get_Cfg: 1 module, output 0 bytes, input 4 bytes"));
}

TEST(ExplainDiag, StandardBytes) {
  const Telegram diag = answer(60, {0x42, 0x05, 0x00, 0xFF, 0x0B, 0x9A});
  EXPECT_THAT(explain_line(diag),
              HasSubstr("[Station_Not_Ready, Prm_Fault] [Prm_Req], Master_Add: none, ident 0x0B9A"));
  const auto texts = data_texts(diag);
  ASSERT_EQ(texts.size(), 6U);
  EXPECT_EQ(texts[1], "Station_status_2: Prm_Req, DP slave");
}

TEST(ExplainDiag, EveryBitHasItsName) {
  const auto texts = data_texts(answer(60, {0xFF, 0xFF, 0x80, 1, 0, 0}));
  EXPECT_EQ(texts[0],
            "Station_status_1: Station_Non_Existent, Station_Not_Ready, Cfg_Fault, Ext_Diag, Not_Supported, "
            "Invalid_Slave_Response, Prm_Fault, Master_Lock");
  EXPECT_EQ(texts[1],
            "Station_status_2: Prm_Req, Stat_Diag, DP slave, WD_On, Freeze_Mode, Sync_Mode, bit 6, Deactivated");
  EXPECT_EQ(texts[2], "Station_status_3: Ext_Diag_Overflow");
  EXPECT_EQ(texts[3], "Master_Add: 1");
}

TEST(ExplainDiag, ExtendedBlocks) {
  const auto texts =
      data_texts(answer(60, {0x08, 0x0C, 0, 1, 0, 0, 0x03, 0xAA, 0xBB, 0x42, 0x05, 0x83, 0x44, 0xA6, 0xC1}));
  ASSERT_EQ(texts.size(), 15U);
  EXPECT_EQ(texts[6], "device related diagnosis, block of 3 bytes");
  EXPECT_EQ(texts[8], "device related byte 2: 0xBB");
  EXPECT_EQ(texts[9], "identifier related diagnosis, block of 2 bytes");
  EXPECT_EQ(texts[10], "diagnosis of module 0, 2");
  EXPECT_EQ(texts[11], "channel related diagnosis, module 3");
  EXPECT_EQ(texts[12], "input channel 4");
  EXPECT_EQ(texts[13], "word, line break");
  EXPECT_EQ(texts[14], "revision number 1");
}

TEST(ExplainDiag, BlocksThatDoNotFit) {
  EXPECT_THAT(data_texts(answer(60, {0, 0, 0, 0, 0, 0, 0x05, 0x01}))[6], HasSubstr("does not fit"));
  EXPECT_THAT(data_texts(answer(60, {0, 0, 0, 0, 0, 0, 0x00}))[6], HasSubstr("does not fit"));
  EXPECT_EQ(data_texts(answer(60, {0, 0, 0, 0, 0, 0, 0x81, 0x00})).size(), 8U);
  EXPECT_THAT(explain_line(answer(60, {0x02})), HasSubstr("1 bytes, at least 6"));
}

/// The texts of a device related block, read with this knowledge of DPV1.
std::vector<std::string> device_texts(const Bytes& block, std::optional<bool> dpv1) {
  Bytes data = {0x08, 0x0C, 0, 1, 0, 0};
  data.insert(data.end(), block.begin(), block.end());
  const Telegram telegram = answer(60, data);
  std::vector<std::string> texts;
  for (const ExplainedByte& byte : explain_bytes({DecodeError::kNone, true, telegram, encode(telegram)}, dpv1))
    texts.push_back(byte.meaning);
  return {texts.begin() + 15, texts.end() - 2};
}

TEST(ExplainDiag, DeviceRelatedBlocksOfDpv1AreStatusOrAlarm) {
  using testing::ElementsAre;
  EXPECT_THAT(device_texts({0x06, 0x81, 2, 0x01, 0xAA, 0xBB}, true),
              ElementsAre("device related diagnosis, block of 6 bytes", "Status_Type: status message", "Slot_Number: 2",
                          "Status_Specifier: appears", "Diagnosis_User_Data 0", "Diagnosis_User_Data 1"));
  EXPECT_THAT(
      device_texts({0x05, 0x01, 4, 0x2E, 7}, true),
      ElementsAre("device related diagnosis, block of 5 bytes", "Alarm_Type: diagnosis alarm", "Slot_Number: 4",
                  "Alarm_Specifier: disappears, slot all right, Add_Ack, sequence number 5", "Diagnosis_User_Data 0"));
  EXPECT_EQ(device_texts({0x06, 0x82, 0, 0, 0xE4, 0x00}, true)[4],
            "module status: 1 valid data, 2 invalid data (error), 3 wrong module, 4 no module");
  EXPECT_EQ(device_texts({0x06, 0x82, 0, 0, 0xE4, 0x02}, true)[5],
            "module status: 5 wrong module, 6 valid data, 7 valid data, 8 valid data");
}

TEST(ExplainDiag, EveryTypeOfStatusAndAlarmHasItsName) {
  const std::pair<int, const char*> types[] = {{0x02, "Alarm_Type: process alarm"},
                                               {0x03, "Alarm_Type: pull alarm"},
                                               {0x04, "Alarm_Type: plug alarm"},
                                               {0x05, "Alarm_Type: status alarm"},
                                               {0x06, "Alarm_Type: update alarm"},
                                               {0x07, "Alarm_Type: reserved alarm"},
                                               {0x20, "Alarm_Type: manufacturer specific alarm"},
                                               {0x7F, "Alarm_Type: reserved alarm"},
                                               {0x83, "Status_Type: DXB_Link_Status"},
                                               {0x9E, "Status_Type: PrmCmdAck"},
                                               {0x9F, "Status_Type: Red_State"},
                                               {0xA0, "Status_Type: manufacturer specific"},
                                               {0x84, "Status_Type: reserved"}};
  for (const auto& [type, words] : types)
    EXPECT_EQ(device_texts({0x04, static_cast<std::uint8_t>(type), 1, 0}, true)[1], words);
}

TEST(ExplainDiag, WithoutDpv1TheDeviceRelatedBytesAreTheManufacturers) {
  EXPECT_EQ(device_texts({0x04, 0x81, 1, 0}, false)[1], "device related byte 1: 0x81");
  EXPECT_EQ(device_texts({0x04, 0x81, 1, 0}, std::nullopt)[1],
            "device related byte 1: 0x81, in DPV1 Status_Type: status message");
  EXPECT_EQ(device_texts({0x03, 0x81, 1}, true)[1], "device related byte 1: 0x81") << "too short for DPV1";
}

TEST(ExplainDiag, ChannelErrors) {
  const auto error = [](std::uint8_t byte) { return data_texts(answer(60, {0, 0, 0, 0, 0, 0, 0x80, 0xC0, byte}))[8]; };
  EXPECT_EQ(error(0x21), "bit, short circuit");
  EXPECT_EQ(error(0x09), "unspecified, error");
  EXPECT_EQ(error(0x0A), "unspecified, reserved error 10");
  EXPECT_EQ(error(0x90), "byte, manufacturer's error 16");
}

TEST(ExplainGlobalControl, CommandsAndGroups) {
  EXPECT_THAT(explain_line(request(58, {0x28, 0x03}, 0x46)), HasSubstr("Freeze, Sync, Group_Select: group 1, 2"));
  EXPECT_THAT(explain_line(request(58, {0x02, 0x00}, 0x46)), HasSubstr("Clear_Data, Group_Select: all groups"));
  EXPECT_THAT(explain_line(request(58, {0x00, 0x00}, 0x46)), HasSubstr("operate"));
  EXPECT_THAT(explain_line(request(58, {0x14}, 0x46)), HasSubstr("1 bytes instead of 2"));
}

TEST(ExplainSetSlaveAddress, Fields) {
  const Telegram ssa = request(55, {9, 0x0B, 0x9A, 0xFF, 0x01});
  EXPECT_THAT(explain_line(ssa), HasSubstr("new address 9, ident 0x0B9A, no later change"));
  EXPECT_EQ(data_texts(ssa)[4], "Rem_Slave_Data 0");
  EXPECT_THAT(explain_line(request(55, {9})), HasSubstr("at least 4"));
}

TEST(ExplainDpv1, ReadWriteAndErrors) {
  EXPECT_THAT(explain_line(request(51, {0x5E, 1, 2, 240})), HasSubstr("MSAC1: DS_Read slot 1 index 2 length 240"));
  EXPECT_THAT(explain_line(answer(51, {0x5F, 1, 2, 4})), HasSubstr("DS_Write slot 1 index 2 length 4"));
  EXPECT_THAT(explain_line(answer(51, {0xDE, 0x80, 0xB0, 0x00})), HasSubstr("DS_Read refused, access: invalid index"));
  EXPECT_THAT(explain_line(answer(51, {0xDF, 0x80, 0xA9, 0x00})), HasSubstr("application: feature not supported"));
  EXPECT_THAT(explain_line(answer(51, {0xDF, 0x80, 0xC2, 0x00})), HasSubstr("resource: resource busy"));
  EXPECT_THAT(explain_line(request(51, {})), HasSubstr("MSAC1: poll"));
  EXPECT_THAT(explain_line(request(51, {0x5E, 1})), HasSubstr("at least 4"));
}

TEST(ExplainDpv1, ClassTwo) {
  const Telegram initiate = request(49, {0x57, 0, 0, 0, 0x00, 0x64, 1, 0, 0, 0, 0, 0});
  EXPECT_THAT(explain_line(initiate), HasSubstr("Initiate, Send_Timeout 1000 ms"));
  EXPECT_EQ(data_texts(initiate)[4], "Send_Timeout high (unit 10 ms): 0x00");
  EXPECT_EQ(data_texts(answer(49, {0x56, 0x30, 0, 100}))[1], "SAP of the channel: 0x30");
  EXPECT_EQ(data_texts(answer(48, {0x57, 0xF0, 1, 0}))[1], "Max_Len_Data_Unit: 0xF0");
  EXPECT_THAT(explain_line(request(48, {0x48})), HasSubstr("MSAC2: Idle"));
  EXPECT_THAT(explain_line(request(48, {0x51, 0, 1, 2, 9, 9})), HasSubstr("DS_Transport slot 0 index 1 length 2"));
  EXPECT_EQ(data_texts(request(48, {0x58, 1, 0x12, 0}))[2],
            "Instance and Reason_Code: 0x12, MSAC_C2: ABT_FE (invalid request PDU)");
  EXPECT_THAT(explain_line(request(48, {0x33})), HasSubstr("unknown function"));
}

TEST(ExplainDpv1, InitiateWithBothFormsOfAddAddr) {
  const Bytes fixed = {0x57, 0, 0, 0, 0x01, 0x00, 1, 0, 0, 0, 0, 0};
  const auto with = [&fixed](const Bytes& address) {
    Bytes data = fixed;
    data.insert(data.end(), address.begin(), address.end());
    return request(49, data);
  };
  EXPECT_THAT(explain_line(with({3, 4})),
              HasSubstr("Initiate, Send_Timeout 2560 ms, DS_Read and DS_Write, Add_Addr API 3 to API 4"));
  const Telegram extended = with({1, 2, 0, 1, 0xA0, 0xA1, 0xB0});
  EXPECT_THAT(explain_line(extended), HasSubstr("Add_Addr type 1 A0 A1 to type 0 B0"));
  EXPECT_EQ(data_texts(extended)[13], "S_Len: 2");
  EXPECT_EQ(data_texts(extended)[17], "S_Addr 1");
  EXPECT_EQ(data_texts(extended)[18], "D_Addr 0");
  EXPECT_THAT(explain_line(with({0, 0, 0, 0})), HasSubstr("type 0 none to type 0 none"));
  EXPECT_THAT(explain_line(with({1, 2, 0})), HasSubstr("Add_Addr of 3 bytes, neither 2 nor what its lengths say"));
  EXPECT_THAT(explain_line(with({1, 2, 0, 9, 5})), HasSubstr("neither 2"));
  EXPECT_THAT(explain_line(request(49, {0x57, 0, 0})), HasSubstr("3 bytes, at least 12"));
}

TEST(ExplainDpv1, AnswersToInitiate) {
  EXPECT_THAT(explain_line(answer(49, {0x56, 0x2F, 0x00, 0x64})),
              HasSubstr("Immediate answer, channel 0x2F, Send_Timeout 1000 ms"));
  EXPECT_THAT(explain_line(answer(49, {0x56, 0x2F})), HasSubstr("at least 4"));
  EXPECT_THAT(explain_line(answer(48, {0x57, 0xF0, 1, 0, 0, 0, 0, 0, 4, 3})),
              HasSubstr("Initiate accepted, at most 240 bytes, Add_Addr API 4 to API 3"));
  EXPECT_THAT(explain_line(answer(48, {0xD7, 0x80, 0xB8, 0})),
              HasSubstr("Initiate refused, access: invalid parameter"));
}

TEST(ExplainDpv1, EveryErrorCodeOfTable29) {
  const std::vector<std::pair<int, std::string>> codes = {{0xA0, "application: read error"},
                                                          {0xA1, "application: write error"},
                                                          {0xA2, "application: module failure"},
                                                          {0xA3, "application: reserved 3"},
                                                          {0xA8, "application: version conflict"},
                                                          {0xA9, "application: feature not supported"},
                                                          {0xAF, "application: user specific 15"},
                                                          {0xB0, "access: invalid index"},
                                                          {0xB1, "access: write length error"},
                                                          {0xB2, "access: invalid slot"},
                                                          {0xB3, "access: type conflict"},
                                                          {0xB4, "access: invalid area"},
                                                          {0xB5, "access: state conflict"},
                                                          {0xB6, "access: access denied"},
                                                          {0xB7, "access: invalid range"},
                                                          {0xB8, "access: invalid parameter"},
                                                          {0xB9, "access: invalid type"},
                                                          {0xBA, "access: user specific 10"},
                                                          {0xC0, "resource: read constrain conflict"},
                                                          {0xC1, "resource: write constrain conflict"},
                                                          {0xC2, "resource: resource busy"},
                                                          {0xC3, "resource: resource unavailable"},
                                                          {0xC4, "resource: reserved 4"},
                                                          {0xC8, "resource: user specific 8"},
                                                          {0x12, "reserved 0x12"},
                                                          {0xD0, "user specific 0xD0"}};
  for (const auto& [code, words] : codes) {
    EXPECT_THAT(explain_line(answer(48, {0xD1, 0x80, static_cast<std::uint8_t>(code), 0})),
                HasSubstr("DS_Transport refused, " + words));
  }
  const Telegram odd = answer(48, {0xDE, 0x81, 0xB0, 0x07});
  EXPECT_THAT(explain_line(odd), HasSubstr("invalid index, Error_Code_2 0x07 (Error_Decode 0x81, 0x80 is right)"));
  EXPECT_EQ(data_texts(answer(48, {0xDE, 0x80, 0xB0, 0}))[1], "Error_Decode: 0x80 (DPV1)");
  EXPECT_THAT(explain_line(answer(48, {0xDE, 0x80})), HasSubstr("DS_Read, 2 bytes, at least 4"));
}

TEST(ExplainDpv1, ErrorsOfOtherProtocols) {
  EXPECT_THAT(explain_line(answer(51, {0xDE, 0xFE, 0xB0, 0x07})),
              HasSubstr("refused, error of PROFIBUS FMS 0xB0 0x07"));
  EXPECT_THAT(explain_line(answer(51, {0xDF, 0xFF, 0x01, 0x02})), HasSubstr("refused, error of HART 0x01 0x02"));
  const auto texts = data_texts(answer(48, {0xDE, 0xFF, 0xB0, 0x07}));
  EXPECT_EQ(texts[1], "Error_Decode: 0xFF (HART)");
  EXPECT_EQ(texts[2], "Error_Code_1: 0xB0") << "table 29 is DPV1's";
}

TEST(ExplainDpv1, AlarmAckAtBothSaps) {
  for (const std::uint8_t at : {std::uint8_t{50}, std::uint8_t{51}}) {
    EXPECT_THAT(explain_line(request(at, {0x5C, 4, 2, 0x19})),
                HasSubstr("Alarm_Ack slot 4, Alarm_Type: process alarm, Alarm_Specifier: appears, sequence number 3"));
    EXPECT_THAT(explain_line(answer(at, {0xDC, 0x80, 0xB5, 0})),
                HasSubstr("Alarm_Ack refused, access: state conflict"));
  }
  EXPECT_THAT(explain_line(request(51, {0x5C, 4})), HasSubstr("Alarm_Ack, 2 bytes, at least 4"));
}

TEST(ExplainDpv1, ClassTwoIsBetweenTheMastersSap50AndTheSlavesBelow49) {
  const Bytes s7 = {0x5E, 0x07, 0x00, 0x00, 0x00, 0x08};
  const Telegram other = make_telegram(3, 1, kRequestFc, s7, std::uint8_t{18}, std::uint8_t{19});
  EXPECT_THAT(explain_line(other), AllOf(HasSubstr("SAP 18"), Not(HasSubstr("DS_Read"))));
  EXPECT_EQ(data_texts(other)[0], "data 0");
  const Telegram back = make_telegram(1, 3, kAnswerFc, s7, std::uint8_t{19}, std::uint8_t{18});
  EXPECT_THAT(explain_line(back), AllOf(HasSubstr("SAP 18"), Not(HasSubstr("DS_Read"))));
}

constexpr std::uint8_t kRm = 49, kChannel = 30, kOwn = 19;  // SAPs of slave and master

TEST(ExplainDpv1, AChannelOfClassTwoIsOpenFromTheAnswerToItsInitiateToItsAbort) {
  ExplainMemory memory;
  const auto service = [&](const Telegram& telegram) { return explain_service(telegram, memory.take(telegram)); };
  const auto ask = [&](std::uint8_t sap, const Bytes& pdu, std::uint8_t from = kOwn, std::uint8_t master = 1) {
    return service(make_telegram(3, master, kRequestFc, pdu, sap, from));
  };
  const auto tell = [&](std::uint8_t sap, const Bytes& pdu) {
    return service(make_telegram(1, 3, kAnswerFc, pdu, kOwn, sap));
  };
  EXPECT_EQ(ask(kChannel, {0x5E, 1, 2, 3}), "SAP 30");  // before it
  EXPECT_EQ(ask(kRm, {0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0}), "MSAC2 Initiate");
  EXPECT_EQ(ask(kChannel, {}), "SAP 30");
  EXPECT_EQ(tell(kRm, {0x56, kChannel, 0, 100}), "MSAC2 Initiate");
  const Telegram read = make_telegram(3, 1, kRequestFc, {0x5E, 1, 2, 240}, kChannel, kOwn);
  EXPECT_THAT(explain_line(read, memory.take(read)), HasSubstr("MSAC2: DS_Read slot 1 index 2 length 240"));
  EXPECT_EQ(explain_bytes(decode(encode(read)), memory.take(read)).at(7).meaning, "DSAP: 30 (MSAC2)");
  EXPECT_EQ(tell(kChannel, {0x5E, 1, 2, 1, 9}), "MSAC2");
  EXPECT_EQ(ask(kChannel, {0x5E, 1, 2, 3}, 20), "SAP 30");       // another SAP of the master
  EXPECT_EQ(ask(kChannel, {0x5E, 1, 2, 3}, kOwn, 2), "SAP 30");  // another master
  EXPECT_EQ(ask(31, {0x5E, 1, 2, 3}), "SAP 31");
  EXPECT_EQ(ask(kChannel, {0x58, 1, 0x13}), "MSAC2");
  EXPECT_EQ(ask(kChannel, {0x5E, 1, 2, 3}), "SAP 30");
  tell(kRm, {0x56, kChannel, 0, 100});
  EXPECT_EQ(tell(kChannel, {0x58, 0, 0x13}), "MSAC2");  // the slave ends it
  EXPECT_EQ(tell(kChannel, {0x48}), "SAP 30");
  tell(kRm, {0x56, kChannel, 0, 100});
  memory.take(make_telegram(2, 3, kAnswerFc, {0x56, kChannel, 0, 100}, std::uint8_t{7}, kRm));
  EXPECT_EQ(ask(kChannel, {0x48}), "SAP 30");  // it is another master's now
  EXPECT_EQ(ask(kChannel, {0x48}, 7, 2), "MSAC2");
}

TEST(ExplainBytes, AnAddressExtensionMayBeARegion) {
  const Telegram region = make_telegram(3, 1, kRequestFc, {1, 2}, std::uint8_t{0xC5}, std::uint8_t{0x41});
  const auto explained = bytes_of(region);
  EXPECT_EQ(explained[7].meaning, "DSAP: region/segment address 5, another extension follows");
  EXPECT_EQ(explained[8].meaning, "SSAP: region/segment address 1");
  EXPECT_THAT(explain_line(region), HasSubstr("region/segment 5: data 01 02"));
}

TEST(ExplainDpv1, AbortsInWords) {
  const std::vector<std::pair<int, std::string>> reasons = {{0x11, "MSAC_C2: ABT_SE (sequence error)"},
                                                            {0x12, "MSAC_C2: ABT_FE (invalid request PDU)"},
                                                            {0x13, "MSAC_C2: ABT_TO (timeout of the connection)"},
                                                            {0x14, "MSAC_C2: ABT_RE (invalid response PDU)"},
                                                            {0x15, "MSAC_C2: ABT_IV"},
                                                            {0x16, "MSAC_C2: ABT_STO"},
                                                            {0x17, "MSAC_C2: ABT_IA"},
                                                            {0x18, "MSAC_C2: ABT_OC"},
                                                            {0x19, "MSAC_C2: reserved reason 9"},
                                                            {0x1F, "MSAC_C2: ABT_RES (resource error)"},
                                                            {0x03, "FDL: RS"},
                                                            {0x0F, "FDL: NA (no answer)"},
                                                            {0x25, "user: reason 5"},
                                                            {0x31, "reserved instance, reason 1"}};
  for (const auto& [code, words] : reasons)
    EXPECT_THAT(explain_line(answer(48, {0x58, 0, static_cast<std::uint8_t>(code), 3})), HasSubstr("Abort, " + words));
  EXPECT_THAT(explain_line(request(48, {0x58, 1, 0x13, 3})), HasSubstr("local subnet, detail 3"));
  EXPECT_THAT(explain_line(request(48, {0x58, 2, 0x13, 3})), HasSubstr("remote subnet"));
  EXPECT_THAT(explain_line(request(48, {0x58, 9, 0x13, 3})), HasSubstr("subnet 9 (reserved)"));
  EXPECT_THAT(explain_line(request(48, {0x58})), HasSubstr("Abort, 1 bytes, at least 3"));
  EXPECT_THAT(explain_line(answer(48, {0x58, 0, 0x12})), HasSubstr("ABT_FE (invalid request PDU), no subnet"));
  EXPECT_THAT(explain_line(answer(48, {0x58, 0, 0x12})), Not(HasSubstr("detail")));
}

TEST(ExplainBytes, EveryByteOfEveryDelimiterIsExplained) {
  const std::vector<Telegram> telegrams = {make_sc(), make_token(1, 2), make_telegram(3, 1, 0x49), request(60, {}),
                                           prefer_sd3(make_telegram(3, 1, 0x7D, Bytes(8, 1)))};
  for (const Telegram& telegram : telegrams) {
    const Bytes bytes = encode(telegram);
    const auto explained = bytes_of(telegram);
    ASSERT_EQ(explained.size(), bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      EXPECT_EQ(explained[i].offset, i);
      EXPECT_EQ(explained[i].byte, bytes[i]);
      EXPECT_FALSE(explained[i].meaning.empty());
    }
  }
}

TEST(ExplainBytes, AWrongFcsShowsTheRightOne) {
  TelegramDecoder decoder;
  std::optional<Decoded> decoded;
  for (const std::uint8_t byte : Bytes{0x10, 0x03, 0x01, 0x49, 0x4E, 0x16}) decoded = decoder.feed(byte);
  const auto explained = explain_bytes(*decoded);
  EXPECT_EQ(explained[4].meaning, "FCS: wrong, 4D is right");
  EXPECT_EQ(explained[5].meaning, "ED");
}

TEST(ExplainBytes, SapsOfTheMasterHaveNoServiceName) {
  const auto explained = bytes_of(request(60, {}));
  EXPECT_EQ(explained[7].meaning, "DSAP: 60 (Slave_Diag)");
  EXPECT_EQ(explained[8].meaning, "SSAP: 62");
}

}  // namespace
}  // namespace dsdpv1::bus
