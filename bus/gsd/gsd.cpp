#include "bus/gsd/gsd.hpp"

#include <istream>
#include <iterator>

#include <fmt/format.h>

#include "bus/gsd/parser.hpp"

namespace dsdpv1::bus {
namespace {

struct TypeFacts {
  std::string_view name;
  int size;
  std::int64_t low, high;
};

const TypeFacts& facts(GsdType type) {
  static constexpr TypeFacts kFacts[] = {
      {"Bit", 1, 0, 1},
      {"BitArea", 1, 0, 0xFF},
      {"Unsigned8", 1, 0, 0xFF},
      {"Unsigned16", 2, 0, 0xFFFF},
      {"Unsigned32", 4, 0, 0xFFFFFFFF},
      {"Signed8", 1, -0x80, 0x7F},
      {"Signed16", 2, -0x8000, 0x7FFF},
      {"Signed32", 4, -0x80000000LL, 0x7FFFFFFF},
  };
  return kFacts[static_cast<std::size_t>(type)];
}

constexpr std::array<std::string_view, kBaudCount> kBaudNames = {"12M",   "6M",    "3M",    "1.5M", "500",
                                                                 "187.5", "93.75", "45.45", "19.2", "9.6"};

/// The name of another kind of file, empty for a GSD file as far as it can be seen.
std::string other_kind(const std::string& text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '<') return "XML, as the GSDML of a PROFINET device";
  constexpr std::string_view kType = ".200";
  const bool type_file = file.size() > kType.size() && file.substr(file.size() - kType.size()) == kType;
  const bool headed = gsd::lower(text).find("#profibus_dp") != std::string::npos;
  return type_file && !headed ? "a type file of COM PROFIBUS" : "";
}

GsdResult failure(gsd::Diagnostics& diagnostics) { return {std::nullopt, diagnostics.take()}; }

}  // namespace

std::string to_string(const GsdDiagnostic& diagnostic) {
  const char* level = diagnostic.level == GsdDiagnostic::Level::kWarning ? "warning: " : "";
  if (diagnostic.line == 0) return fmt::format("{}: {}{}", diagnostic.file, level, diagnostic.text);
  return fmt::format("{}:{}: {}{}", diagnostic.file, diagnostic.line, level, diagnostic.text);
}

int size_of(GsdType type) { return facts(type).size; }
std::string_view name(GsdType type) { return facts(type).name; }

GsdRange range_of(GsdType type, int bits) {
  if (type == GsdType::kBitArea) return {0, (std::int64_t{1} << bits) - 1};
  return {facts(type).low, facts(type).high};
}

std::string_view gsd_baud_name(int index) { return kBaudNames.at(static_cast<std::size_t>(index)); }

GsdResult parse_gsd(std::istream& in, const std::string& file) {
  gsd::Diagnostics diagnostics(file);
  const std::string text = gsd::decode({std::istreambuf_iterator<char>(in), {}}, diagnostics);
  if (diagnostics.failed()) return failure(diagnostics);
  if (const std::string kind = other_kind(text, file); !kind.empty()) {
    diagnostics.error(1, fmt::format("is {}, a GSD file is needed: it begins with #Profibus_DP", kind));
    return failure(diagnostics);
  }
  const auto lines = gsd::logical_lines(text, diagnostics);
  if (lines.empty() && !diagnostics.failed())
    diagnostics.error(1, "the file is empty, a GSD file with #Profibus_DP and Ident_Number is needed");
  if (lines.empty()) return failure(diagnostics);
  gsd::Parser parser(diagnostics);
  for (const auto& line : lines) parser.read(line);
  parser.finish();
  parser.gsd.file = file;
  gsd::complete(parser.gsd, parser.settings, diagnostics);
  if (diagnostics.failed()) return failure(diagnostics);
  return {std::move(parser.gsd), diagnostics.take()};
}

}  // namespace dsdpv1::bus
