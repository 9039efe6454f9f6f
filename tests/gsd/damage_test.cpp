// No input may crash the reader or its users: every sample truncated at many places and with changed bytes.
#include <gtest/gtest.h>

#include <random>

#include "bus/gsd/report.hpp"
#include "files.hpp"

namespace dsdpv1 {
namespace {

using gsd_test::content;
using gsd_test::files_of;
using gsd_test::parse;

class DamagedGsd : public testing::TestWithParam<std::filesystem::path> {};

/// Reads it and, if that works, uses all functions on it.
void use(const std::string& text) {
  const bus::GsdResult result = parse(text);
  EXPECT_LE(result.diagnostics.size(), 201U);
  if (!result.gsd) {
    EXPECT_FALSE(result.diagnostics.empty());
    return;
  }
  const bus::GsdSetup presets = bus::set_up(*result.gsd, {});
  bus::GsdChoice first;
  if (!result.gsd->modules.empty()) first.modules = {result.gsd->modules.front().name};
  const bus::GsdSetup chosen = bus::set_up(*result.gsd, first);
  std::ostringstream out;
  bus::print_gsd_report(*result.gsd, presets, result.diagnostics, out, bus::GsdFormat::kText);
  bus::print_gsd_report(*result.gsd, chosen, result.diagnostics, out, bus::GsdFormat::kJson);
  EXPECT_FALSE(out.str().empty());
}

TEST_P(DamagedGsd, CutOffAnywhere) {
  const std::string whole = content(GetParam());
  const std::size_t step = std::max<std::size_t>(1, whole.size() / 300);
  for (std::size_t size = 0; size < whole.size(); size += step) use(whole.substr(0, size));
}

TEST_P(DamagedGsd, WithFlippedBits) {
  const std::string whole = content(GetParam());
  if (whole.empty()) return;
  std::mt19937 random(4711);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips) {
      char& byte = damaged[random() % damaged.size()];
      byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << (random() % 8)));
    }
    use(damaged);
  }
}

TEST_P(DamagedGsd, WithCharactersOfTheGrammarExchanged) {
  const std::string whole = content(GetParam());
  if (whole.empty()) return;
  constexpr std::string_view kGrammar = "\"\\;=(),-0x9\n#/";
  std::mt19937 random(1814);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = kGrammar[random() % kGrammar.size()];
    use(damaged);
  }
}

TEST_P(DamagedGsd, WithLinesMissing) {
  const std::string whole = content(GetParam());
  std::vector<std::string> rows;
  std::istringstream in(whole);
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  for (std::size_t missing = 0; missing < rows.size(); ++missing) {
    std::string damaged;
    for (std::size_t i = 0; i < rows.size(); ++i) damaged += i == missing ? "" : rows[i] + "\n";
    use(damaged);
  }
}

std::vector<std::filesystem::path> all_files() {
  auto paths = files_of(GSD_SAMPLES);
  const auto bad = files_of(GSD_BAD);
  paths.insert(paths.end(), bad.begin(), bad.end());
  paths.emplace_back(GSD_CHIP);
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedGsd, testing::ValuesIn(all_files()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

}  // namespace
}  // namespace dsdpv1
