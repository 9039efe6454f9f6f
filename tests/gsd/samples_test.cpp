// Habits of real files, revisions 0 to 5, imitated in tests/gsd/samples.
#include <gmock/gmock.h>

#include "bus/gsd/cfg.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using gsd_test::content;
using gsd_test::lines;
using gsd_test::parse;
using gsd_test::sample;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> remarks(const std::string& name) {
  return lines(parse(content(std::filesystem::path(GSD_SAMPLES) / (name + ".gsd")), name));
}

bus::GsdBaud rate(const bus::Gsd& gsd, int index) { return gsd.bauds.at(static_cast<std::size_t>(index)); }

TEST(GsdSamples, Revision0HasItsUserParametersInOneList) {
  const bus::Gsd gsd = sample("rev0_fixed_station");
  EXPECT_EQ(gsd.revision, 0);
  EXPECT_EQ(gsd.ident, 0x0A17);
  EXPECT_TRUE(gsd.sync);
  EXPECT_FALSE(gsd.freeze);
  EXPECT_EQ(gsd.min_slave_interval, 20);
  EXPECT_EQ(gsd.prm.length, 5);
  EXPECT_THAT(remarks("rev0_fixed_station"),
              ElementsAre("rev0_fixed_station: warning: GSD_Revision is missing",
                          "rev0_fixed_station:1: warning: the header #Profibus_DP is missing"));
}

TEST(GsdSamples, SpellingOfKeywordsAndNumbersIsFree) {
  const bus::Gsd gsd = sample("rev1_loose_spelling");
  EXPECT_EQ(gsd.vendor, "Loose & Sons");
  EXPECT_EQ(gsd.model, "LS;2");
  EXPECT_EQ(gsd.device_revision, "1.3");
  EXPECT_EQ(gsd.ident, 0x00B4);
  EXPECT_EQ(rate(gsd, 9).max_tsdr, 60);
  EXPECT_EQ(rate(gsd, 3).max_tsdr, 150);
  EXPECT_EQ(gsd.prm.constants.at(0).bytes, (Bytes{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(gsd.modules.at(0).cfg, (Bytes{0x11, 0x20}));
  EXPECT_THAT(remarks("rev1_loose_spelling"),
              ElementsAre("rev1_loose_spelling:5: warning: Revision is not in quotes",
                          "rev1_loose_spelling:16: warning: the list of User_Prm_Data ends with a comma"));
}

TEST(GsdSamples, Latin1BecomesUtf8AndDiagnosisTextsAreKept) {
  const bus::Gsd gsd = sample("rev1_diagnosis_latin1");
  EXPECT_EQ(gsd.vendor,
            "W\xC3\xA4getechnik S\xC3\xBC"
            "d");
  ASSERT_EQ(gsd.keywords.size(), 7U);
  EXPECT_EQ(gsd.keywords[0].keyword, "Unit_Diag_Bit(0)");
  EXPECT_EQ(gsd.keywords[0].value,
            "\"\xC3\x9C"
            "berlast; bitte pr\xC3\xBC"
            "fen\"");
  EXPECT_THAT(remarks("rev1_diagnosis_latin1"), IsEmpty());
}

TEST(GsdSamples, Revision2KnowsEveryDataType) {
  const bus::Gsd gsd = sample("rev2_parameters");
  ASSERT_EQ(gsd.parameters.size(), 8U);
  EXPECT_EQ(gsd.parameters.at(2).type, bus::GsdType::kBitArea);
  EXPECT_EQ(gsd.parameters.at(2).allowed.size(), 3U);
  EXPECT_EQ(gsd.parameters.at(3).allowed.at(0).low, -1);
  EXPECT_EQ(gsd.parameters.at(7).allowed.at(0).high, -1);
  EXPECT_FALSE(gsd.parameters.at(6).changeable);
  EXPECT_FALSE(gsd.parameters.at(6).visible);
  EXPECT_EQ(gsd.prm_texts.at(2).at(-1), "falling");
  EXPECT_THAT(remarks("rev2_parameters"), IsEmpty());
}

TEST(GsdSamples, ModulesHaveParametersAndInfoTexts) {
  const bus::Gsd gsd = sample("rev2_modular");
  ASSERT_EQ(gsd.modules.size(), 5U);
  EXPECT_EQ(gsd.modules[2].info_text, "two analog inputs");
  EXPECT_EQ(gsd.modules[2].prm.length, 3);
  EXPECT_EQ(gsd.modules[2].prm.refs.size(), 2U);
  EXPECT_THAT(remarks("rev2_modular"), IsEmpty());
}

TEST(GsdSamples, Revision3HasReferenceNumbersAndSlots) {
  const bus::Gsd gsd = sample("rev3_slots");
  EXPECT_EQ(gsd.slave_family, "3@TdF@Temperature");
  EXPECT_EQ(gsd.modules.at(2).reference, 3);
  ASSERT_EQ(gsd.slots.size(), 3U);
  EXPECT_EQ(gsd.slots[1].preset, 2);
  EXPECT_EQ(gsd.slots[2].allowed.at(0).high, 5);
  EXPECT_TRUE(gsd.dpv1 && gsd.c1_read_write && gsd.wd_base_1ms);
  EXPECT_THAT(remarks("rev3_slots"), IsEmpty());
}

TEST(GsdSamples, Revision4KeepsSafetyParametersApart) {
  const bus::Gsd gsd = sample("rev4_profisafe");
  EXPECT_EQ(gsd.modules.at(0).prm.length, 1);
  EXPECT_EQ(gsd.modules.at(0).f_prm.length, 14);
  EXPECT_EQ(gsd.modules.at(0).keywords.size(), 2U);
  EXPECT_THAT(remarks("rev4_profisafe"), IsEmpty());
}

TEST(GsdSamples, Revision5BlocksAreKept) {
  const bus::Gsd gsd = sample("rev5_everything");
  EXPECT_EQ(gsd.info_text, "one text in two pieces");
  EXPECT_EQ(bus::cfg_lengths(gsd.modules.at(0).cfg).input, 128);
  EXPECT_EQ(gsd.modules.at(0).reference, 8);
  EXPECT_THAT(remarks("rev5_everything"), IsEmpty());
}

TEST(GsdSamples, Utf8WithByteOrderMark) {
  const bus::Gsd gsd = sample("utf8_bom");
  EXPECT_EQ(gsd.ident, 0x0CC9);
  EXPECT_EQ(gsd.vendor,
            "\xC3\x9Cn\xC3\xAF"
            "code \xE8\xAE\xBE\xE5\xA4\x87");
  EXPECT_THAT(remarks("utf8_bom"), IsEmpty());
}

TEST(GsdSamples, LinesMayEndWithCarriageReturnAlone) {
  EXPECT_EQ(sample("mac_line_ends").ident, 1);
  EXPECT_THAT(remarks("mac_line_ends"), IsEmpty());
}

TEST(GsdSamples, SlipsAreReadAsWhatTheyMean) {
  const bus::Gsd gsd = sample("slips_and_vendor_keywords");
  EXPECT_EQ(gsd.ident, 0x0778);
  EXPECT_EQ(gsd.model, "Slipper");
  EXPECT_EQ(gsd.min_slave_interval, 10);
  EXPECT_TRUE(gsd.freeze && gsd.wd_base_1ms);
  EXPECT_EQ(gsd.modules.at(0).cfg, (Bytes{0x10, 0x11}));
  ASSERT_EQ(gsd.keywords.size(), 1U);
  EXPECT_EQ(gsd.keywords[0].keyword, "Vendor_Special");
  EXPECT_THAT(remarks("slips_and_vendor_keywords"), testing::SizeIs(14));
}

TEST(GsdSamples, KeywordsOfPeripheryDevicesAreKnown) {
  const bus::Gsd gsd = sample("pa_redundant");
  EXPECT_TRUE(gsd.pa.supported);
  EXPECT_EQ(gsd.pa.max_tsdr, 100);
  ASSERT_EQ(gsd.modules.size(), 1U);
  EXPECT_EQ(gsd.modules[0].cfg, (Bytes{0x94})) << "Data_Area_Beg .. End belongs to its module";
  EXPECT_EQ(gsd.keywords.at(0).keyword, "Unit_Diag_!Bit(3)");
  EXPECT_EQ(gsd.keywords.at(1).keyword, "Unit_Diag_Bit(4)");
  EXPECT_THAT(
      remarks("pa_redundant"),
      ElementsAre("pa_redundant: warning: 31.25 kbit/s (PROFIBUS PA) is the only rate, a DP line needs a coupler "
                  "for it",
                  "pa_redundant:8: warning: 24V Pins is read as 24V_Pins"));
}

TEST(GsdSamples, ValuesWrappedWithoutBackslashAreJoined) {
  const bus::Gsd gsd = sample("wrapped_without_backslash");
  ASSERT_EQ(gsd.prm.constants.size(), 4U);
  EXPECT_EQ(gsd.prm.constants[0].bytes, (Bytes{1, 2, 3, 4}));
  EXPECT_EQ(gsd.modules.at(0).cfg, (Bytes{0x10, 0x11}));
  EXPECT_EQ(gsd.modules.at(0).reference, 5);
  EXPECT_EQ(gsd.modules.at(1).cfg, (Bytes{0x20}));
  EXPECT_EQ(gsd.modules.at(1).reference, 6);
}

TEST(GsdSamples, FilePrintedInAManualIsReadWithWarnings) {
  const bus::Gsd gsd = sample("manual_habits");
  EXPECT_EQ(gsd.ident, 0x0CC9);
  EXPECT_EQ(rate(gsd, 0).max_tsdr, 800);
  EXPECT_EQ(rate(gsd, 7).max_tsdr, 250);
  EXPECT_EQ(gsd.prm.constants.at(0).bytes, (Bytes{0x80, 0, 0, 0, 0, 0}));
  EXPECT_EQ(gsd.modules.at(0).reference, 20);
  EXPECT_TRUE(gsd.modules.at(0).preset);
  EXPECT_THAT(remarks("manual_habits"),
              testing::Contains("manual_habits:1: warning: the header #Profibus_DP is missing"));
}

TEST(GsdSamples, MasterFilesNeedNoModules) {
  EXPECT_TRUE(sample("master_class1").is_master);
  EXPECT_THAT(remarks("master_class1"), IsEmpty());
}

}  // namespace
}  // namespace dsdpv1
