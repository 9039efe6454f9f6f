#include "io/waves/vcd_declarations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace dsdpv1::tb {
namespace {

/// "1ns", "100 ps": the exponent of its seconds.
std::optional<int> exponent_of(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  const std::array<std::pair<const char*, int>, 6> units = {
      {{"fs", -15}, {"ps", -12}, {"ns", -9}, {"us", -6}, {"ms", -3}, {"s", 0}}};
  for (const auto& [unit, exponent] : units) {
    if (text == std::string("1") + unit) return exponent;
    if (text == std::string("10") + unit) return exponent + 1;
    if (text == std::string("100") + unit) return exponent + 2;
  }
  return std::nullopt;
}

WaveKind kind_of(const std::string& type) {
  if (type == "string") return WaveKind::kText;
  if (type == "event") return WaveKind::kEvent;
  return type.rfind("real", 0) == 0 || type == "shortreal" ? WaveKind::kReal : WaveKind::kBits;
}

}  // namespace

std::string VcdDeclarations::word() {
  std::string text(text_.token());
  if (text.empty()) text_.fail("ends within its declarations, expected a complete VCD with $enddefinitions");
  return text;
}

std::string VcdDeclarations::rest() {
  std::string text;
  for (std::string next = word(); next != "$end"; next = word()) {
    text += (text.empty() ? "" : " ") + next;
    if (text.size() > kMostWaveWidth) text_.fail("has no $end within reach, expected the text of a VCD");
  }
  return text;
}

void VcdDeclarations::skip() {
  while (word() != "$end") {
  }
}

void VcdDeclarations::read() {
  for (std::string command = word(); command != "$enddefinitions"; command = word()) {
    if (command == "$timescale") {
      timescale();
    } else if (command == "$scope") {
      scope();
    } else if (command == "$upscope") {
      if (!scopes_.close()) text_.fail("$upscope without a $scope, expected one for each");
      skip();
    } else if (command == "$var") {
      variable();
    } else if (command.front() == '$') {
      skip();
    } else {
      text_.fail("\"" + command.substr(0, 40) + "\" stands where a declaration of a VCD should, expected $...");
    }
  }
  skip();
}

void VcdDeclarations::timescale() {
  const std::string text = rest();
  const std::optional<int> exponent = exponent_of(text);
  if (!exponent) text_.fail("$timescale is " + text + ", expected 1, 10 or 100 fs, ps, ns, us, ms or s");
  to_.exponent = *exponent;
}

void VcdDeclarations::scope() {
  word();  // module, task, function, begin, fork
  const std::string name = rest();
  keep(name.size() + to_.scopes[scopes_.current()].size());
  scopes_.open(name);
}

void VcdDeclarations::keep(std::size_t bytes) {
  names_ += bytes;
  if (names_ > kMostWaveNames || to_.variables.size() >= kMostWaveVariables)
    text_.fail(fmt::format("declares more than is read, expected at most {} variables and {} MB of names",
                           kMostWaveVariables, kMostWaveNames >> 20U));
}

void VcdDeclarations::variable() {
  const std::string type = word(), size = word(), code = word(), name = rest();
  if (type == "port") text_.fail("is an extended VCD ($dumpports), expected that of $dumpvars");
  std::uint32_t width = 0;
  const auto [end, error] = std::from_chars(size.data(), size.data() + size.size(), width);
  if (error != std::errc() || *end != '\0' || width > kMostWaveWidth)
    text_.fail(fmt::format("$var has the size {}, expected 0 to {} bits", size.substr(0, 40), kMostWaveWidth));
  const WaveKind kind = kind_of(type);
  const std::uint32_t place = signal(code, {kind, kind == WaveKind::kBits ? std::max(width, 1U) : 0U});
  keep(name.size());
  WaveName parsed = parse_wave_name(name, width);
  to_.variables.push_back({scopes_.current(), std::move(parsed.name), parsed.range, place});
}

std::uint32_t VcdDeclarations::signal(const std::string& code, const WaveSignal& declared) {
  std::uint32_t place = codes_.find(code);
  if (place == VcdCodes::kNone) {
    place = static_cast<std::uint32_t>(to_.signals.size());
    keep(code.size());
    codes_.add(code, place);
    to_.signals.push_back(declared);
  }
  WaveSignal& known = to_.signals[place];
  if (known.kind != declared.kind) text_.fail("$var " + code + " has two types, expected one");
  known.width = std::max(known.width, declared.width);
  return place;
}

}  // namespace dsdpv1::tb
