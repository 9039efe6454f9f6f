// Matching signals of two waves, and the options for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "tests/lab/compare/waves.hpp"

namespace dsdpv1 {
namespace {

using compare_test::first;
using compare_test::Waves;
using tb::compare::Options;
using testing::ElementsAre;
using testing::HasSubstr;

/// "top(dut(a b) c)" as scopes and wires, each with its own value, 0 at time 0.
std::string tree(const std::string& text) {
  std::string declared, changes = "$enddefinitions $end\n#0\n", word;
  char code = '!';
  const auto end_word = [&](char next) {
    if (!word.empty() && next == '(') declared += "$scope module " + word + " $end\n";
    if (!word.empty() && next != '(') {
      declared += "$var wire 1 " + std::string(1, code) + " " + word + " $end\n";
      changes += "0" + std::string(1, code++) + "\n";
    }
    if (next == ')') declared += "$upscope $end\n";
    word.clear();
  };
  for (const char c : text)
    if (c == '(' || c == ')' || c == ' ')
      end_word(c);
    else
      word += c;
  return declared + changes + "#10\n";
}

class Matching : public testing::Test {
 protected:
  std::vector<std::string> pairs(const std::string& a, const std::string& b) const {
    std::vector<std::string> names;
    for (const auto& signal : waves_.compare(tree(a), tree(b), options_).signals) names.push_back(signal.name);
    return names;
  }
  std::string refusal(const std::string& a, const std::string& b) const {
    try {
      pairs(a, b);
      return "none";
    } catch (const tb::InputError& error) {
      return error.what();
    }
  }
  Waves waves_;
  Options options_;
};

TEST_F(Matching, TheSameNameOrTheSameLastPartThatIsTheOnlyOne) {
  EXPECT_THAT(pairs("top(dut(a b) c )", "top(dut(a b) c )"), ElementsAre("top.c", "top.dut.a", "top.dut.b"));
  EXPECT_THAT(pairs("chip(IRQ CLK )", "tb(dut(irq )u(clk )v(clk ))"), ElementsAre("chip.IRQ"));
  EXPECT_THAT(pairs("top(a )", "top(a u(a ))"), ElementsAre("top.a"));
}

TEST_F(Matching, ScopesAreLeftOutOfTheNames) {
  options_.scope_a = "demo";
  options_.scope_b = "tb.dut";
  EXPECT_THAT(pairs("demo(a u(b ))io(a )", "tb(a dut(a u(b )))"), ElementsAre("a", "u.b"));
  options_.scope_b = "tb.dux";
  EXPECT_THAT(refusal("demo(a )", "tb(dut(a ))"), HasSubstr("b.vcd: has no signals in tb.dux (did you mean tb.dut?)"));
}

TEST_F(Matching, NoPairIsAnError) {
  EXPECT_THAT(refusal("t(a b )", "t(c )"), HasSubstr("no signal has its counterpart in"));
  EXPECT_THAT(refusal("t(a b )", "t(c )"), HasSubstr("(here t.a, t.b; there t.c)"));
}

TEST_F(Matching, NamedSignalsMustBeThereAndBeOne) {
  options_.pairs = {tb::compare::parse_pair("a=u.b")};
  EXPECT_THAT(pairs("t(a )", "t(u(b )v(b ))"), ElementsAre("t.a"));
  options_.pairs = {tb::compare::parse_pair("a=b")};
  EXPECT_THAT(refusal("t(a )", "t(u(b )v(b ))"), HasSubstr("b is more than one signal, expected t.u.b, t.v.b"));
  options_.pairs = {tb::compare::parse_pair("a=irq_out")};
  EXPECT_THAT(refusal("t(a )", "t(irq_oot )"),
              HasSubstr("b.vcd: has no signal irq_out (did you mean irq_oot?), expected"));
}

TEST_F(Matching, SignalsOfOtherFormAreNoPair) {
  const std::string narrow = compare_test::vcd("wire 1 ! a\nwire 1 # b", "#0\n0!\n0#\n#9\n");
  const std::string wide = compare_test::vcd("wire 4 ! a\nwire 1 # b", "#0\nb0 !\n0#\n#9\n");
  EXPECT_THAT(waves_.compare(narrow, wide).only_a, ElementsAre("t.a"));
  options_.pairs = {tb::compare::parse_pair("a=a")};
  EXPECT_THROW(waves_.compare(narrow, wide, options_), tb::InputError);
}

TEST_F(Matching, TheOtherLevelAndABusWithItsDriver) {
  const std::string a =
      compare_test::vcd("wire 2 ! D [1:0]\nwire 1 # IRQ", "#0\nbz !\n1#\n#10\nb10 !\n#20\nb1 !\n0#\n#30\n");
  const std::string b = compare_test::vcd("wire 2 i d_i [1:0]\nwire 2 o d_o [1:0]\nwire 1 e oe\nwire 1 q irq",
                                          "#0\nbz i\nb11 o\n0e\n0q\n#10\n1e\nb10 o\n#20\n0e\nb1 i\n1q\n#30\n");
  tb::compare::NamedPair bus;
  bus.a = "D";
  bus.b = "d_o";
  bus.driven = "oe";
  bus.released = "d_i";
  options_.pairs = {bus, tb::compare::parse_pair("IRQ=!irq")};
  EXPECT_EQ(first(waves_.compare(a, b, options_)), "equal");
  options_.pairs[0].driven_low = true;
  EXPECT_EQ(first(waves_.compare(a, b, options_)), "t.D@0: z 3");
}

TEST_F(Matching, ASideOfABusIsReleasedWhereItsDriverSaysSo) {
  const std::string a = compare_test::vcd("wire 2 ! D_OUT [1:0]", "#0\nbz !\n#10\nb10 !\n#20\nbz !\n#30\n");
  const std::string b =
      compare_test::vcd("wire 2 o d_o [1:0]\nwire 1 e oe", "#0\nb11 o\n0e\n#10\n1e\nb10 o\n#20\n0e\n#30\n");
  tb::compare::NamedPair driven;
  driven.a = "D_OUT";
  driven.b = "d_o";
  driven.driven = "oe";
  options_.pairs = {driven};
  EXPECT_EQ(first(waves_.compare(a, b, options_)), "equal");
  options_.pairs[0].driven_low = true;
  EXPECT_EQ(first(waves_.compare(a, b, options_)), "t.D_OUT@0: z 3");
}

TEST(CompareOptions, WhatPeopleWrite) {
  EXPECT_EQ(tb::compare::parse_duration("10ns"), 10'000'000);
  EXPECT_EQ(tb::compare::parse_duration("-1.5us"), -1'500'000'000);
  EXPECT_EQ(tb::compare::parse_duration("3cycles"), 62'500'000);
  EXPECT_EQ(tb::compare::parse_duration("1fs"), 1);
  for (const char* wrong : {"", "10", "ns", "inf ns", "nans", "10 ns", "1e99s", "10nss"})
    EXPECT_FALSE(tb::compare::parse_duration(wrong)) << wrong;
  for (const char* wrong : {"", "a", "=1", "a=", "a=1@", "!=1"})
    EXPECT_THROW(tb::compare::parse_mask(wrong), tb::InputError) << wrong;
  EXPECT_EQ(tb::compare::parse_mask("u.a!=x@u.b").signal, "u.a");
  EXPECT_EQ(tb::compare::parse_mask("u.a!=x@u.b").target, "u.b");
  for (const char* wrong : {"", "a", "=b", "a=", "a=!"})
    EXPECT_THROW(tb::compare::parse_pair(wrong), tb::InputError) << wrong;
}

}  // namespace
}  // namespace dsdpv1
