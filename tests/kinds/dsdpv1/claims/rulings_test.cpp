// The table of rulings is all of docs/chip.md; that of parameters all of a scenario's `chip`.
#include "kinds/dsdpv1/claims/rulings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "kinds/dsdpv1/keys/settings.hpp"

namespace dsdpv1 {
namespace {

TEST(CalibrateRulings, AreThoseOfTheDocument) {
  std::ifstream page(DSDPV1_SOURCE_DIR "/docs/chip.md");
  std::vector<std::string> written;
  for (std::string line; std::getline(page, line);)
    if (line.rfind("- **", 0) == 0) written.push_back(line.substr(4, line.find("**", 4) - 4));
  ASSERT_GT(written.size(), 80U);
  std::vector<std::string> table;
  for (const calibrate::Ruling& ruling : calibrate::dsdpv1_claims().rulings()) table.emplace_back(ruling.id);
  ASSERT_EQ(table.back(), "facts");
  table.pop_back();
  EXPECT_EQ(table, written);
}

TEST(CalibrateRulings, HaveClaimsOrAReasonWhyNot) {
  std::set<std::string> claimed;
  for (const calibrate::Claim* claim : calibrate::dsdpv1_claims().claims()) claimed.insert(claim->ruling);
  for (const calibrate::Ruling& ruling : calibrate::dsdpv1_claims().rulings())
    EXPECT_EQ(claimed.erase(ruling.id) == 1, ruling.hidden == nullptr) << ruling.id;
  EXPECT_TRUE(claimed.empty()) << *claimed.begin() << " is no ruling";
}

TEST(CalibrateParameters, AreThoseOfAScenario) {
  std::set<std::string> keys;
  for (const tb::keys::Field& field : tb::dsdpv1_chip_keys().fields)
    if (field.type.kind == tb::keys::Kind::kInteger) keys.insert(field.name);
  std::set<std::string> rows;
  for (const calibrate::ParameterRow& row : calibrate::dsdpv1_claims().parameters()) rows.insert(row.key);
  EXPECT_EQ(rows, keys);
}

}  // namespace
}  // namespace dsdpv1
