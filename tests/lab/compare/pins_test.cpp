// compare --pins: the pins of each chip, one after the other stuck, missing and excused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/program.hpp"
#include "tests/lab/compare/waves.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::Called;
using testing::HasSubstr;

/// Table 1 and R2 of docs/chip_rsu.md, written down once more.
struct OnePin {
  std::string name;
  int width;
  bool output;
};
const std::vector<OnePin> kPlain = {{"RESET", 1, false}, {"R_REQ", 1, false}, {"R_STA", 1, false}, {"CSR", 1, false},
                                    {"RD", 1, false},    {"WR", 1, false},    {"A", 11, false},    {"D", 8, true},
                                    {"PBRXD", 1, false}, {"L_REQ", 1, true},  {"L_STA", 1, true},  {"INTR0", 1, true},
                                    {"PBTXD", 1, true},  {"PBRTS", 1, true},  {"PBF", 1, true},    {"BR", 1, true},
                                    {"READY", 1, true}};
const std::vector<OnePin> kSerial = {{"XSS", 1, false},  {"SCK", 1, false}, {"MOSI", 1, false}, {"RXD", 1, false},
                                     {"MODE", 2, false}, {"ADR", 2, false}, {"UBR", 3, false},  {"UIV", 3, false},
                                     {"MISO", 1, true},  {"TXD", 1, true}};

std::vector<OnePin> all_pins() {
  std::vector<OnePin> pins = kPlain;
  pins.insert(pins.end(), kSerial.begin(), kSerial.end());
  return pins;
}

std::string small(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(c));
  return text;
}

class PinWave {
 public:
  void add(const std::string& name, int width, const std::string& value) {
    const std::string code = "c" + std::to_string(count_++);
    declarations_ += (count_ == 1 ? "wire " : "\nwire ") + std::to_string(width) + " " + code + " " + name +
                     (width > 1 ? " [" + std::to_string(width - 1) + ":0]" : "");
    first_ += "b" + value + " " + code + "\n";
    last_ = code;
  }
  /// The last one, at a time of ns.
  void change(int at, const std::string& value) {
    then_ += "#" + std::to_string(at) + "\nb" + value + " " + last_ + "\n";
  }
  std::string text() const { return compare_test::vcd(declarations_, "#0\n" + first_ + then_ + "#1000\n"); }

 private:
  std::string declarations_, first_, then_, last_;
  int count_ = 0;
};

struct Faults {
  std::string missing, stuck;  ///< a pin, or its enable ("MISO_OE")
};

/// A wave in which each pin changes once.
std::string of_model(const std::vector<OnePin>& pins, const std::string& missing = "") {
  PinWave wave;
  int at = 0;
  for (const OnePin& pin : pins) {
    at += 10;
    if (pin.name == missing) continue;
    wave.add(pin.name, pin.width, "0");
    wave.change(at, "1");
  }
  return wave.text();
}

/// With the names of rtl_ref/.
std::string of_rtl(const std::vector<OnePin>& pins, const Faults& faults = {}) {
  PinWave wave;
  int at = 0;
  for (const OnePin& pin : pins) {
    at += 10;
    if (pin.name != faults.missing) wave.add(small(pin.name) + (pin.output ? "_o" : "_i"), pin.width, "0");
    if (pin.name != faults.missing && pin.name != faults.stuck) wave.change(at, "1");
    if (pin.name != "D" && pin.name != "MISO") continue;
    if (pin.name + "_OE" != faults.missing) wave.add(small(pin.name) + "_oe_o", 1, "1");
    if (pin.name == "D") wave.add("d_i", 8, "z");
  }
  return wave.text();
}

class ComparePins : public testing::Test {
 protected:
  Called compare(const std::string& a, const std::string& b, const std::string& options = "") const {
    waves_.write("a.vcd", a);
    waves_.write("b.vcd", b);
    return call("compare a.vcd b.vcd --pins rtl_ref " + options, waves_.folder());
  }
  compare_test::Waves waves_;
};

TEST_F(ComparePins, AStuckPinOfAnyKindIsFoundByItsName) {
  for (const auto& pins : {kPlain, all_pins()}) {
    const Called equal = compare(of_model(pins), of_rtl(pins));
    EXPECT_EQ(equal.status, 0) << equal.out << equal.err;
    for (const OnePin& pin : pins) {
      EXPECT_THAT(equal.out, HasSubstr("t." + pin.name + " "));
      const Called called = compare(of_model(pins), of_rtl(pins, {"", pin.name}));
      EXPECT_EQ(called.status, 1) << pin.name << called.err;
      EXPECT_THAT(called.out, HasSubstr("t." + pin.name + ": A ")) << pin.name;
    }
  }
}

TEST_F(ComparePins, AnOutputWithoutItsCounterpartIsRefusedUnlessExcused) {
  const std::vector<OnePin> pins = all_pins();
  for (const OnePin& pin : pins) {
    if (!pin.output) continue;
    const std::string in_b = compare(of_model(pins), of_rtl(pins, {pin.name, ""})).err;
    EXPECT_THAT(in_b, HasSubstr("b.vcd: has no signal " + small(pin.name) + "_o for the chip's output " + pin.name));
    const Called in_a = compare(of_model(pins, pin.name), of_rtl(pins));
    EXPECT_EQ(in_a.status, 2) << in_a.out;
    EXPECT_THAT(in_a.err, HasSubstr("a.vcd: has no signal " + pin.name + " for the chip's output " + pin.name +
                                    ", expected one for each output, or --without " + pin.name));
    EXPECT_EQ(compare(of_model(pins), of_rtl(pins, {pin.name, ""}), "--without " + pin.name).status, 0) << pin.name;
  }
  EXPECT_THAT(compare(of_model(pins), of_rtl(pins, {"MISO_OE", ""})).err, HasSubstr("has no signal miso_oe_o for"));
}

TEST_F(ComparePins, AnInputThatIsMissingIsListedAndADifferenceIfStrict) {
  const std::vector<OnePin> pins = all_pins();
  const Called called = compare(of_model(pins), of_rtl(pins, {"MOSI", ""}));
  EXPECT_EQ(called.status, 0) << called.err;
  EXPECT_THAT(called.out, HasSubstr("pins left out     MOSI\n"));
  const Called strict = compare(of_model(pins), of_rtl(pins, {"MOSI", ""}), "--strict");
  EXPECT_EQ(strict.status, 1);
  EXPECT_THAT(strict.out, HasSubstr("no counterpart    MOSI\n"));
  EXPECT_EQ(compare(of_model(pins), of_rtl(pins), "--strict").status, 0);
}

TEST_F(ComparePins, TheChipIsTheOneOfTheNamesOrThatOfTheOption) {
  EXPECT_THAT(compare(of_model(kPlain), of_rtl(all_pins())).err, HasSubstr("a.vcd: has no signal MISO"))
      << "a model's wave without the serial ports";
  EXPECT_EQ(compare(of_model(kPlain), of_rtl(all_pins()), "--chip dsdpv1").status, 0);
  EXPECT_EQ(compare(of_model(kPlain), of_rtl(kPlain), "--chip dsdpv1_r").status, 0);
  EXPECT_THAT(compare(of_model(kPlain), of_rtl(kPlain), "--chip dsdpv1_rsu").err, HasSubstr("output MISO"));
  EXPECT_THAT(compare(of_model(kPlain), of_rtl(kPlain), "--chip none").err,
              HasSubstr("--chip is none, expected dsdpv1"));
  EXPECT_THAT(compare(of_model(kPlain), of_rtl(kPlain), "--without BRR").err,
              HasSubstr("--without is BRR, which the dsdpv1 lacks (did you mean BR?)"));
}

TEST_F(ComparePins, ASignalOfTheUsersTakesThePlaceOfAPin) {
  const std::vector<OnePin> pins = all_pins();
  EXPECT_EQ(compare(of_model(pins), of_rtl(pins, {"D_OE", ""}), "--signal D=d_o").status, 0);
  EXPECT_EQ(compare(of_model(pins), of_rtl(pins, {"MISO_OE", "MISO"}), "--signal MISO=miso_o").status, 1);
}

}  // namespace
}  // namespace dsdpv1
