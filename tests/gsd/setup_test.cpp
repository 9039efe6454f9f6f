// From a file and a choice of modules to Set_Prm and Chk_Cfg.
#include <gmock/gmock.h>

#include "bus/gsd/setup.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using bus::set_up;
using gsd_test::file_with;
using gsd_test::lines;
using gsd_test::parse;
using gsd_test::sample;

std::string only_error(const bus::GsdSetup& setup) {
  return setup.diagnostics.size() == 1 ? to_string(setup.diagnostics.front())
                                       : std::to_string(setup.diagnostics.size()) + " diagnostics";
}

TEST(GsdSetup, LaysParametersOverConstantsMostSignificantByteFirst) {
  const auto setup = set_up(sample("rev2_parameters"), {});
  ASSERT_TRUE(setup.ok());
  EXPECT_EQ(setup.user_prm, (Bytes{0xD1, 0x00, 0xFF, 0x12, 0x34, 0xFF, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0x80, 0x00, 0x00,
                                   0x00, 0x00, 0x07}));
  EXPECT_EQ(setup.chk_cfg, (Bytes{0xD7}));
  EXPECT_EQ(setup.lengths.input, 16);
}

TEST(GsdSetup, TakesOverridesByNameNumberAndText) {
  const auto setup = set_up(sample("rev2_parameters"), {{},
                                                        {{std::nullopt, "Enable", "off"},
                                                         {std::nullopt, "2", "0x02"},
                                                         {std::nullopt, "Edge", "rising"},
                                                         {std::nullopt, "Offset", "-3"}}});
  ASSERT_TRUE(setup.ok());
  EXPECT_EQ(Bytes(setup.user_prm.begin(), setup.user_prm.begin() + 7),
            (Bytes{0xA0, 0x00, 0x01, 0x12, 0x34, 0xFF, 0xFD}));
}

TEST(GsdSetup, RefusesOverridesOutsideTheAllowedValues) {
  const auto setup = set_up(sample("rev2_parameters"), {{}, {{std::nullopt, "Mode", "3"}}});
  EXPECT_EQ(only_error(setup), "rev2_parameters.gsd:26: \"3\" is no value for \"Mode\", 0, 2, 4 to 6 is allowed");
}

TEST(GsdSetup, RefusesOverridesOfUnknownParameters) {
  const bus::Gsd gsd = sample("rev2_modular");
  EXPECT_EQ(only_error(set_up(gsd, {{"2 AI"}, {{0, "Gain", "1"}}})),
            "rev2_modular.gsd: module 1 \"2 AI\" has no parameter \"Gain\", it has \"Mains\", \"Range\"");
  EXPECT_EQ(only_error(set_up(gsd, {{"8 DO"}, {{1, "Mains", "1"}}})),
            "rev2_modular.gsd: module 2 has no parameter \"Mains\", it has none");
}

TEST(GsdSetup, AppendsTheModulesParametersInTheOrderOfTheChoice) {
  const auto setup = set_up(sample("rev2_modular"), {{"2 AI", "8 DO", "8 DI"}, {{0, "Mains", "60 Hz"}}});
  ASSERT_TRUE(setup.ok());
  EXPECT_EQ(setup.user_prm, (Bytes{0xA0, 0x01, 0x25, 0x08, 0x03, 0x11}));
  EXPECT_EQ(setup.chk_cfg, (Bytes{0x51, 0x20, 0x10}));
  EXPECT_EQ(setup.lengths.input, 5);
  EXPECT_EQ(setup.lengths.output, 1);
}

TEST(GsdSetup, PutsSafetyParametersBehindTheOthers) {
  const auto setup = set_up(sample("rev4_profisafe"), {});
  ASSERT_TRUE(setup.ok());
  EXPECT_EQ(setup.user_prm, (Bytes{0xC0, 0x60, 0x00, 0x03, 0x0E, 0x05, 0x00, 0x01, 0x08, 0x40, 0x00, 0x00, 0x00, 0xC8,
                                   0x00, 0x96, 0x12, 0x34}));
}

TEST(GsdSetup, OldFixedStationNeedsNoChoice) {
  const auto setup = set_up(sample("rev0_fixed_station"), {});
  ASSERT_TRUE(setup.ok());
  EXPECT_EQ(setup.user_prm, (Bytes{0, 1, 2, 3, 4}));
  EXPECT_EQ(setup.chk_cfg, (Bytes{0x20, 0x10}));
}

TEST(GsdSetup, TakesThePresetsOfTheSlots) {
  const auto setup = set_up(sample("rev3_slots"), {});
  ASSERT_TRUE(setup.ok());
  EXPECT_THAT(setup.modules, testing::ElementsAre(0, 1));
}

TEST(GsdSetup, RefusesAModuleThatItsSlotDoesNotTake) {
  EXPECT_EQ(only_error(set_up(sample("rev3_slots"), {{"1", "1"}, {}})),
            "rev3_slots.gsd: module \"Head\" does not fit slot 1, line 42 says which modules are allowed");
}

TEST(GsdSetup, FindsModulesWhateverTheirCaseAndSpaces) {
  EXPECT_TRUE(set_up(sample("rev2_modular"), {{" 8 di "}, {}}).ok());
  EXPECT_TRUE(set_up(sample("rev3_slots"), {{"HEAD", "0x02"}, {}}).ok());
}

TEST(GsdSetup, NamesTheModulesWhenOneIsUnknown) {
  EXPECT_EQ(only_error(set_up(sample("rev3_slots"), {{"Cooler"}, {}})),
            "rev3_slots.gsd: module \"Cooler\" is unknown, \"Head\", \"Thermocouple\", \"Heater\" are allowed");
}

TEST(GsdSetup, AsksForTheNumberWhenANameIsTakenTwice) {
  const bus::Gsd gsd = sample("rev2_modular");
  EXPECT_EQ(only_error(set_up(gsd, {{"Counter"}, {}})),
            "rev2_modular.gsd: \"Counter\" is the name of 2 modules, choose by position in the file");
  EXPECT_EQ(set_up(gsd, {{"5"}, {}}).chk_cfg, (Bytes{0xC0, 0x01, 0x01}));
}

TEST(GsdSetup, KeepsTheFilesLimits) {
  const bus::Gsd gsd = sample("rev2_modular");
  EXPECT_EQ(only_error(set_up(gsd, {{"8 DI", "8 DI", "8 DI", "8 DI", "8 DI"}, {}})),
            "rev2_modular.gsd: 5 modules are chosen, 1 to 4 are allowed");
  EXPECT_EQ(only_error(set_up(gsd, {{"2 AI", "2 AI", "2 AI"}, {}})),
            "rev2_modular.gsd: inputs are 12 bytes, Max_Input_Len = 8 is the most");
  EXPECT_EQ(only_error(set_up(gsd, {{"4", "8 DO"}, {}})),
            "rev2_modular.gsd: inputs and outputs are 13 bytes, Max_Data_Len = 12 is the most");
}

TEST(GsdSetup, KeepsTheProtocolsLimits) {
  const auto file =
      parse(file_with("Modular_Station = 1\nMax_Module = 9\nMax_Input_Len = 244\nMax_Output_Len = 244\n"
                      "Module = \"big\" 0x40, 0x7F\nExt_Module_Prm_Data_Len = 120\nEndModule\n"));
  ASSERT_TRUE(file.gsd.has_value());
  const auto setup = set_up(*file.gsd, {{"big", "big"}, {}});
  EXPECT_THAT(setup.diagnostics, testing::SizeIs(2));
  EXPECT_EQ(to_string(setup.diagnostics[0]), "test.gsd: inputs are 256 bytes, 0 to 244 are allowed");
  EXPECT_EQ(to_string(setup.diagnostics[1]), "test.gsd: the user parameters have 240 bytes, 0 to 237 are allowed");
}

TEST(GsdSetup, FixedStationTakesOneModuleOnly) {
  const auto file = parse(file_with("Module = \"a\" 0x10\nEndModule\nModule = \"b\" 0x20\nEndModule\n"));
  ASSERT_TRUE(file.gsd.has_value());
  EXPECT_EQ(only_error(set_up(*file.gsd, {})), "test.gsd: no module is chosen, at least one is needed");
  EXPECT_EQ(only_error(set_up(*file.gsd, {{"a", "b"}, {}})), "test.gsd: 2 modules are chosen, 1 to 1 are allowed");
  EXPECT_TRUE(set_up(*file.gsd, {{"b"}, {}}).ok());
}

TEST(GsdSetup, RefusesAChosenModuleWithACutOffIdentifier) {
  const auto file = parse(file_with("Module = \"a\" 0xC2, 0x00\nEndModule\n"));
  EXPECT_THAT(lines(file), testing::ElementsAre("test.gsd:8: warning: identifier 0xC2 wants 4 more bytes, 1 follow"));
  EXPECT_EQ(only_error(set_up(file.gsd.value(), {})), "test.gsd: identifier 0xC2 wants 4 more bytes, 1 follow");
}

constexpr const char* kPresetStation = R"(Modular_Station = 1
Max_Module = 5
Max_Input_Len = 8
Max_Output_Len = 8
FixPresetModules = 1
ExtUserPrmData = 7 "[SlotNumber]"
Unsigned8 1 1-4
EndExtUserPrmData
ExtUserPrmData = 8 "Filter"
Unsigned8 0 0-9
EndExtUserPrmData
Module = "head" 0x04, 0x00, 0x00, 0xAD, 0xC4
Preset = 1
Ext_Module_Prm_Data_Len = 1
Ext_User_Prm_Data_Ref(0) = 8
EndModule
Module = "in" 0x10
Ext_Module_Prm_Data_Len = 2
Ext_User_Prm_Data_Const(0) = 0xAA, 0
Ext_User_Prm_Data_Ref(1) = 7
EndModule
Module = "power" 0x01, 0x55
Preset = 1
EndModule
)";

TEST(GsdSetup, PutsFixedPresetsInFrontOnceEach) {
  const auto file = parse(file_with(kPresetStation));
  ASSERT_TRUE(file.gsd.has_value());
  const Bytes presets{0x04, 0x00, 0x00, 0xAD, 0xC4, 0x01, 0x55};
  EXPECT_EQ(set_up(*file.gsd, {}).chk_cfg, presets);
  const Bytes station{0x04, 0x00, 0x00, 0xAD, 0xC4, 0x01, 0x55, 0x10};
  EXPECT_EQ(set_up(*file.gsd, {{"in"}, {}}).chk_cfg, station);
  EXPECT_EQ(set_up(*file.gsd, {{"in", "power"}, {}}).chk_cfg, station);
  EXPECT_EQ(set_up(*file.gsd, {{"power", "in", "power"}, {}}).chk_cfg,
            (Bytes{0x04, 0x00, 0x00, 0xAD, 0xC4, 0x01, 0x55, 0x10, 0x01, 0x55}));
}

TEST(GsdSetup, OverridesFollowTheirModulesBehindThePresets) {
  const auto file = parse(file_with(kPresetStation));
  ASSERT_TRUE(file.gsd.has_value());
  EXPECT_EQ(set_up(*file.gsd, {{"in", "head"}, {{1, "Filter", "5"}}}).user_prm, (Bytes{5, 0xAA, 3}));
  EXPECT_EQ(only_error(set_up(*file.gsd, {{"in"}, {{0, "Filter", "5"}}})),
            "test.gsd: module 3 \"in\" has no parameter \"Filter\", it has \"[SlotNumber]\"");
}

TEST(GsdSetup, EachModuleGetsItsSlotNumber) {
  const auto file = parse(file_with(kPresetStation));
  ASSERT_TRUE(file.gsd.has_value());
  EXPECT_EQ(set_up(*file.gsd, {{"in", "in"}, {}}).user_prm, (Bytes{0, 0xAA, 3, 0xAA, 4}));
  EXPECT_EQ(set_up(*file.gsd, {{"in"}, {{0, "7", "2"}}}).user_prm, (Bytes{0, 0xAA, 2})) << "a user may choose";
  EXPECT_EQ(only_error(set_up(*file.gsd, {{"in", "in", "in"}, {}})),
            "test.gsd:13: module 5 \"in\" is in slot 5, \"[SlotNumber]\" allows 1 to 4");
}

TEST(GsdSetup, SlotNumbersBeginWhereTheFileSays) {
  const std::string module =
      "Modular_Station = 1\nMax_Module = 2\nMax_Input_Len = 2\nMax_Output_Len = 0\n"
      "ExtUserPrmData = 1 \"[Slot_Number]  \"\nUnsigned8 9 0-9\nEndExtUserPrmData\n"
      "Module = \"in\" 0x10\n1\nExt_Module_Prm_Data_Len = 1\nExt_User_Prm_Data_Ref(0) = 1\nEndModule\n";
  const auto prm = [](const std::string& text) {
    return set_up(parse(file_with(text)).gsd.value(), {{"in", "in"}, {}}).user_prm;
  };
  EXPECT_EQ(prm(module), (Bytes{1, 2}));
  EXPECT_EQ(prm(module + "Modul_Offset = 4\n"), (Bytes{4, 5}));
  EXPECT_EQ(prm(module + "Modul_Offset = 4\nSlotDefinition\nSlot(7) = \"a\" 1 1\nSlot(3) = \"b\" 1 1\n"
                         "EndSlotDefinition\n"),
            (Bytes{7, 3}));
}

TEST(GsdFile, OtherKindsOfFilesAreNamedInOneLine) {
  EXPECT_THAT(lines(parse("<?xml version=\"1.0\"?>\n<ISO15745Profile>\n</ISO15745Profile>\n", "device.xml")),
              testing::ElementsAre("device.xml:1: is XML, as the GSDML of a PROFINET device, a GSD file is needed: it "
                                   "begins with #Profibus_DP"));
  EXPECT_THAT(
      lines(parse("@TYPE 80\n[Station]\nName=ET\n", "SI8008AE.200")),
      testing::ElementsAre("SI8008AE.200:1: is a type file of COM PROFIBUS, a GSD file is needed: it begins with "
                           "#Profibus_DP"));
}

TEST(GsdSetPrm, EnablesDpv1WhereTheFileHasIt) {
  const bus::Gsd gsd = sample("rev3_slots");
  ASSERT_TRUE(gsd.dpv1);
  EXPECT_TRUE(bus::enables_dpv1(gsd, {0x80}));
  EXPECT_FALSE(bus::enables_dpv1(gsd, {0x7F}));
  EXPECT_FALSE(bus::enables_dpv1(gsd, {}));
  EXPECT_FALSE(bus::enables_dpv1(sample("rev0_fixed_station"), {0x80}))
      << "without DPV1_Slave the byte is the vendor's";
}

TEST(GsdSetPrm, HasIdentAndWatchdogInItsSevenBytes) {
  EXPECT_EQ(bus::set_prm_bytes(0x0CC9, {}, {0x80}), (Bytes{0x88, 10, 10, 11, 0x0C, 0xC9, 0x00, 0x80}));
  bus::SetPrmHead head;
  head.wd_fact_1 = 0;
  head.sync = head.freeze = true;
  head.group = 3;
  EXPECT_EQ(bus::set_prm_bytes(0x1234, head, {}), (Bytes{0xB0, 0, 10, 11, 0x12, 0x34, 0x03}));
}

}  // namespace
}  // namespace dsdpv1
