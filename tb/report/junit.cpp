#include "tb/report/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "bus/printable.hpp"

namespace dsdpv1::tb {
namespace {

using Cases = std::vector<const JunitCase*>;

struct Suite {
  std::string name;
  Cases cases;
};

std::vector<Suite> suites_of(const std::vector<JunitCase>& cases) {
  std::vector<Suite> suites;
  for (const JunitCase& each : cases) {
    const auto same = [&each](const Suite& suite) { return suite.name == each.suite; };
    const auto found = std::find_if(suites.begin(), suites.end(), same);
    if (found != suites.end())
      found->cases.push_back(&each);
    else
      suites.push_back({each.suite, {&each}});
  }
  return suites;
}

/// The two characters that are right UTF-8, steer nothing, and have no place in XML.
std::string without_noncharacters(std::string text) {
  for (const auto& [character, escape] : {std::pair{"\xEF\xBF\xBE", "\\uFFFE"}, std::pair{"\xEF\xBF\xBF", "\\uFFFF"}})
    for (std::size_t at = 0; (at = text.find(character, at)) != std::string::npos;) text.replace(at, 3, escape);
  return text;
}

void set(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_attribute(name) = without_noncharacters(bus::printable(text)).c_str();
}

void set_text(pugi::xml_node node, const std::string& text) {
  node.text() = without_noncharacters(bus::printable_lines(text)).c_str();
}

std::string seconds_text(double seconds) { return fmt::format("{:.3f}", std::max(0.0, seconds)); }

/// How many, how many failed, how long: of a suite, and of all.
void set_counts(pugi::xml_node node, const Cases& cases) {
  double seconds = 0;
  for (const JunitCase* each : cases) seconds += each->seconds;
  const auto failed = [](const JunitCase* each) { return each->failure.has_value(); };
  set(node, "tests", fmt::format("{}", cases.size()));
  set(node, "failures", fmt::format("{}", std::count_if(cases.begin(), cases.end(), failed)));
  set(node, "errors", "0");
  set(node, "time", seconds_text(seconds));
}

void add_case(pugi::xml_node suite, const JunitCase& each) {
  pugi::xml_node node = suite.append_child("testcase");
  set(node, "classname", each.suite);
  set(node, "name", each.name);
  set(node, "time", seconds_text(each.seconds));
  if (each.failure) {
    pugi::xml_node failure = node.append_child("failure");
    set(failure, "message", each.failure->substr(0, each.failure->find('\n')));
    set(failure, "type", "failure");
    set_text(failure, *each.failure);
  }
  if (each.skipped) set(node.append_child("skipped"), "message", *each.skipped);
  if (!each.output.empty()) set_text(node.append_child("system-out"), each.output);
}

void add_suite(pugi::xml_node root, const Suite& suite) {
  pugi::xml_node node = root.append_child("testsuite");
  set(node, "name", suite.name);
  set_counts(node, suite.cases);
  const auto skipped = [](const JunitCase* each) { return each->skipped.has_value(); };
  set(node, "skipped", fmt::format("{}", std::count_if(suite.cases.begin(), suite.cases.end(), skipped)));
  for (const JunitCase* each : suite.cases) add_case(node, *each);
}

}  // namespace

std::string junit(const std::string& name, const std::vector<JunitCase>& cases) {
  Cases all;
  for (const JunitCase& each : cases) all.push_back(&each);
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  set(root, "name", name);
  set_counts(root, all);
  for (const Suite& suite : suites_of(cases)) add_suite(root, suite);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
  return text.str();
}

}  // namespace dsdpv1::tb
