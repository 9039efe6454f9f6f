// A user's map of the pins of their RTL, and the code generated from it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cosim/pin_map.hpp"
#include "cosim/user_rtl.hpp"
#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"

namespace dsdpv1 {
namespace {

using testing::HasSubstr;

class PinMapFile : public testing::Test {
 public:
  ~PinMapFile() override { std::filesystem::remove(path_); }

 protected:
  cosim::PinMap load(const std::string& text) const {
    std::ofstream(path_) << text;
    return cosim::load_pin_map(path_, tb::pins_of(Part::kDsdpv1), {"search_window_ms", "rts_lead"});
  }
  /// The message after the file's name.
  std::string error_of(const std::string& text) const {
    try {
      load(text);
    } catch (const tb::InputError& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "none";
  }

 private:
  std::string path_ =
      testing::TempDir() + "pins_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
};

TEST_F(PinMapFile, WithoutKeysHasTheNamesOfTheReferenceRtl) {
  const cosim::PinMap map = load("{}\n");
  EXPECT_EQ(map.clock.name, "clk_i");
  EXPECT_EQ(map.pins.at("R_REQ").name, "r_req_i");
  EXPECT_EQ(map.pins.at("INTR0").name, "intr0_o");
  EXPECT_EQ(map.pins.at("D_OE").name, "d_oe_o");
  EXPECT_FALSE(map.pins.at("CSR").inverted);
}

TEST_F(PinMapFile, NamesPolaritiesAndTolerancesAreRead) {
  const cosim::PinMap map = load(
      "clock: clk48\npins:\n  CSR: {port: cs, inverted: true}\n  RD: rd_n\ntolerance: {PBTXD: 3}\n"
      "parameters: {WIDTH: 8}\nfiles: [a.sv]\ninclude: [lib]\nreference: true\nfile_list: chip.f\n"
      "tie: {scan: 0x1F, test: 3}\nfault: fault_i\ndefines: {FPGA: 1, SIM: }\nchip: {search_window_ms: SW, rts_lead: "
      "{port: lead}}\n");
  EXPECT_EQ(map.clock.name, "clk48");
  EXPECT_EQ(map.pins.at("CSR").name, "cs");
  EXPECT_TRUE(map.pins.at("CSR").inverted);
  EXPECT_EQ(map.pins.at("RD").name, "rd_n");
  EXPECT_EQ(map.tolerances.at(static_cast<std::size_t>(Pin::kPbtxd)), 3);
  EXPECT_EQ(map.tolerances.at(static_cast<std::size_t>(Pin::kIntr0)), 0);
  EXPECT_EQ(map.parameters.at("WIDTH").text, "8");
  ASSERT_EQ(map.files.size(), 1U);
  EXPECT_EQ(map.files.front().text, "a.sv");
  EXPECT_EQ(map.file_list.text, "chip.f");
  EXPECT_EQ(map.ties.at("scan").value, 0x1FU);
  EXPECT_EQ(map.ties.at("test").line, 11);
  EXPECT_EQ(map.fault.text, "fault_i");
  EXPECT_EQ(map.defines.at("FPGA").text, "1");
  EXPECT_EQ(map.defines.at("SIM").text, "");
  EXPECT_EQ(map.chip.at("search_window_ms").name, "SW");
  EXPECT_FALSE(map.chip.at("search_window_ms").port);
  EXPECT_TRUE(map.chip.at("rts_lead").port);
  EXPECT_TRUE(map.reference);
}

TEST_F(PinMapFile, WrongContentIsNamedWithItsLineAndWhatIsAllowed) {
  EXPECT_EQ(error_of("clock: c\npinns: {}\n"),
            ":2: unknown name pinns (did you mean pins?), expected clock, pins, tie, fault, tolerance, chip, "
            "parameters, defines, files, file_list, include, reference");
  EXPECT_THAT(error_of("pins:\n  L_RQE: x\n"), HasSubstr(":2: unknown name L_RQE (did you mean L_REQ?), expected A,"));
  EXPECT_EQ(error_of("pins:\n  RD: {port: r, inverted: maybe}\n"), ":2: inverted of RD is maybe, expected true, false");
  EXPECT_EQ(error_of("pins:\n  RD: {inverted: true}\n"),
            ":2: RD is no port, expected NAME and {port: NAME, inverted: true}");
  EXPECT_EQ(error_of("tolerance:\n  INTR0: 1001\n"), ":2: tolerance of INTR0 is 1001, expected 0 to 1000 cycles");
  EXPECT_THAT(error_of("tolerance: {RD: 1}\n"), HasSubstr(":1: unknown name RD"));
  EXPECT_THAT(error_of("- a\n"), HasSubstr(":1: is no map, expected clock, pins, tie, "));
  EXPECT_THAT(error_of("pins: {\n"), HasSubstr("expected YAML"));
  EXPECT_THAT(error_of("pins: 5\n"), HasSubstr(":1: pins is no map"));
  EXPECT_EQ(error_of("reference: yes\n"), ":1: reference is yes, expected true, false");
  EXPECT_THAT(error_of("parameters: {WIDTH: [8]}\n"), HasSubstr(":1: parameter WIDTH is no word"));
  EXPECT_THAT(error_of("files: a.sv\n"), HasSubstr(":1: files is no list"));
  EXPECT_EQ(error_of("pins:\n  RD: a\n  RD: b\n"), ":3: RD is there twice, expected it once");
  EXPECT_EQ(error_of("pins:\n  RD: a b\n"), ":2: RD is a b, expected a name: letters, digits, _ and $");
  EXPECT_EQ(error_of("tie:\n  scan: high\n"),
            ":2: tie of scan is high, expected a number like 1 or 0x1F of at most 64 bits");
  EXPECT_THAT(error_of("tie:\n  scan: 0x10000000000000000\n"), HasSubstr(":2: tie of scan is 0x1"));
  EXPECT_EQ(error_of("fault: {port: x}\n"), ":1: fault is no word, expected one name or number");
  EXPECT_THAT(error_of("tie: 5\n"), HasSubstr(":1: tie is no map"));
  EXPECT_EQ(error_of("chip:\n  rts_laed: LEAD\n"),
            ":2: unknown name rts_laed (did you mean rts_lead?), expected search_window_ms, rts_lead");
  EXPECT_EQ(error_of("chip:\n  rts_lead: {input: x}\n"),
            ":2: chip.rts_lead is no place in the RTL, expected PARAMETER and {port: INPUT}");
  EXPECT_EQ(error_of("parameters: {LEAD: 4}\nchip:\n  rts_lead: LEAD\n"),
            ":3: LEAD is also in parameters, expected it once");
  EXPECT_EQ(error_of("defines:\n  A-B: 1\n"), ":2: a macro is A-B, expected a name: letters, digits, _ and $");
}

TEST(PinMap, FileThatIsNotThereIsNamed) {
  EXPECT_THROW(cosim::load_pin_map("none.yaml", tb::pins_of(Part::kDsdpv1)), tb::InputError);
}

TEST(Adapter, InvertsWhereTheMapSaysSo) {
  cosim::PinMap map = cosim::default_pin_map(tb::pins_of(Part::kDsdpv1));
  map.pins["CSR"] = {"cs", true};
  map.pins["INTR0"] = {"irq", true};
  map.pins["D_OUT"] = {"q", true};
  const std::string text = cosim::adapter_source("chip", map, tb::pins_of(Part::kDsdpv1), false);
  EXPECT_THAT(text, HasSubstr("model.cs = !levels["));
  EXPECT_THAT(text, HasSubstr("(!model.irq);"));
  EXPECT_THAT(text, HasSubstr("model.d_oe_o ? (~model.q) & 255 : -1"));
  EXPECT_THAT(text, HasSubstr("model.rd_i = levels["));
  EXPECT_THAT(text, HasSubstr("(model.l_req_o);"));
}

TEST(Adapter, HasThePinsOfTheKind) {
  const tb::PinTable& pins = tb::pins_of(Part::kRsu);
  const std::string text = cosim::adapter_source("chip", cosim::default_pin_map(pins), pins, false);
  EXPECT_THAT(text, HasSubstr("model.uiv_i = (levels[25]) & 7;"));
  EXPECT_THAT(text, HasSubstr("model.miso_oe_o ? model.miso_o : -1"));
}

TEST(Adapter, HasATraceWhereItIsWantedOnly) {
  const cosim::PinMap map = cosim::default_pin_map(tb::pins_of(Part::kDsdpv1));
  EXPECT_THAT(cosim::adapter_source("chip", map, tb::pins_of(Part::kDsdpv1), false), testing::Not(HasSubstr("race")));
  EXPECT_THAT(cosim::adapter_source("chip", map, tb::pins_of(Part::kDsdpv1), true), HasSubstr("dsdpv1_rtl_trace("));
}

}  // namespace
}  // namespace dsdpv1
