// JUnit's XML: read back by an XML parser, and validated by a schema.
#include "tb/report/junit.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <pugixml.hpp>

namespace dsdpv1 {
namespace {

pugi::xml_document read(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

bool is_valid(const std::string& text) {
  const std::string file = testing::TempDir() + "junit_" + std::to_string(getpid()) + ".xml";
  std::ofstream(file, std::ios::binary) << text;
  const int status = std::system((XMLLINT " --noout --schema " JUNIT_XSD " " + file + " 2>/dev/null").c_str());
  EXPECT_EQ(std::remove(file.c_str()), 0);
  return status == 0;
}

const std::vector<tb::JunitCase> kCases = {{"a.yaml", "skip pins", 1.25, std::nullopt, ""},
                                           {"b.yaml", "skip pins", 0.5, "TIMING_TS: 3 violations\nline 2", "log\n"},
                                           {"a.yaml", "skip tlm", 2, "killed by signal 11", ""}};

TEST(Junit, IsValidWithAndWithoutCases) {
  EXPECT_TRUE(is_valid(tb::junit("regress", {})));
  EXPECT_TRUE(is_valid(tb::junit("regress", kCases)));
}

TEST(Junit, TheSchemaFindsWhatIsWrong) {
  std::string text = tb::junit("regress", kCases);
  text.replace(text.find("tests=\"3\""), 9, "tests=\"x\"");
  EXPECT_FALSE(is_valid(text));
}

TEST(Junit, CountsCasesAndFailuresOfEachSuiteAndOfAll) {
  const pugi::xml_document document = read(tb::junit("regress", kCases));
  const pugi::xml_node all = document.child("testsuites");
  EXPECT_EQ(all.attribute("tests").as_int(), 3);
  EXPECT_EQ(all.attribute("failures").as_int(), 2);
  EXPECT_STREQ(all.attribute("time").value(), "3.750");
  const pugi::xml_node first = all.child("testsuite"), second = first.next_sibling();
  EXPECT_STREQ(first.attribute("name").value(), "a.yaml");
  EXPECT_EQ(first.attribute("tests").as_int(), 2);
  EXPECT_EQ(first.attribute("failures").as_int(), 1);
  EXPECT_STREQ(second.attribute("name").value(), "b.yaml");
  EXPECT_EQ(second.attribute("tests").as_int(), 1);
  EXPECT_FALSE(second.next_sibling());
}

TEST(Junit, TheFirstLineOfAFailureIsItsMessage) {
  const pugi::xml_document document = read(tb::junit("regress", kCases));
  const pugi::xml_node failed = document.child("testsuites").find_child_by_attribute("name", "b.yaml").first_child();
  EXPECT_STREQ(failed.child("failure").attribute("message").value(), "TIMING_TS: 3 violations");
  EXPECT_STREQ(failed.child_value("failure"), "TIMING_TS: 3 violations\nline 2");
  EXPECT_STREQ(failed.child_value("system-out"), "log\n");
}

TEST(Junit, WhatXmlCannotHoldIsShownAsEscapes) {
  const std::string bad = "\x1B[31m \xFF \xEF\xBF\xBF \xEF\xBF\xBE ]]> <&\"'\n\t\xC3\xA4";
  const std::string text = tb::junit(bad, {{bad, bad, 0, bad, bad}});
  EXPECT_TRUE(is_valid(text)) << text;
  const pugi::xml_document document = read(text);
  const pugi::xml_node only = document.child("testsuites").child("testsuite").child("testcase");
  EXPECT_STREQ(only.child_value("system-out"), "\\x1B[31m \\xFF \\uFFFF \\uFFFE ]]> <&\"'\n\t\xC3\xA4");
  EXPECT_STREQ(only.attribute("name").value(), "\\x1B[31m \\xFF \\uFFFF \\uFFFE ]]> <&\"'\\n\\t\xC3\xA4");
}

TEST(Junit, ATimeThatCannotBeIsNone) {
  EXPECT_TRUE(is_valid(tb::junit("regress", {{"a", "b", -1, std::nullopt, ""}})));
}

}  // namespace
}  // namespace dsdpv1
