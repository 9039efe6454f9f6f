// A shipped scenario through the C API gives the same as `dsdpv1-sim run`.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "lab/traces/golden.hpp"
#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

const std::string kScenario = DSDPV1_SOURCE_DIR "/scenarios/power_on_12m.yaml";

Owned<dpsim_run> make_run(const std::string& path, const char* setting = nullptr) {
  auto options = sized<dpsim_run_options>();
  options.path = path.c_str();
  options.settings = &setting;
  options.setting_count = setting == nullptr ? 0 : 1;
  dpsim_run* run = nullptr;
  ok(dpsim_run_create(&options, &run));
  return Owned<dpsim_run>(run);
}

/// All changes of each signal, in the order of the golden's.
using Columns = std::vector<std::vector<std::pair<uint64_t, int>>>;

Columns columns_of(const tb::traces::Trace& trace) {
  Columns columns;
  for (tb::traces::Cursor cursor : trace.cursors()) {
    auto& column = columns.emplace_back();
    for (; cursor.at() != bus::kNever; cursor.step())
      column.emplace_back(static_cast<uint64_t>(cursor.at()), cursor.level());
  }
  return columns;
}

Columns columns_of(const std::vector<dpsim_change>& changes, size_t slaves) {
  const size_t pins = dpsim_pin_count(nullptr);
  Columns columns(slaves * pins + 1);
  for (const dpsim_change& each : changes)
    columns[each.station == DPSIM_LINE ? slaves * pins : each.station * pins + each.pin].emplace_back(each.tick,
                                                                                                      each.level);
  return columns;
}

TEST(CapiRun, PinsAndLineChangeAsInTheGoldenTrace) {
  const auto run = make_run(kScenario);
  ok(dpsim_run_keep(run.get(), DPSIM_KEEP_CHANGES | DPSIM_KEEP_TELEGRAMS));
  ok(dpsim_run_execute(run.get(), nullptr, nullptr));
  auto summary = sized<dpsim_run_summary>();
  ok(dpsim_run_get_summary(run.get(), &summary));
  EXPECT_EQ(summary.passed, 1);
  EXPECT_EQ(summary.expectations, summary.expectations_met);

  const auto changes = drain(dpsim_run_read_changes, run.get());
  EXPECT_TRUE(std::is_sorted(changes.begin(), changes.end(),
                             [](const dpsim_change& a, const dpsim_change& b) { return a.tick < b.tick; }));
  const tb::traces::Golden golden = tb::traces::read_golden(DSDPV1_SOURCE_DIR "/traces", "power_on_12m");
  const Columns expected = columns_of(*golden.trace), seen = columns_of(changes, 1);
  ASSERT_EQ(seen.size(), expected.size());
  for (size_t i = 0; i < seen.size(); ++i)
    EXPECT_TRUE(seen[i] == expected[i]) << golden.trace->signals()[i].name << ": " << seen[i].size()
                                        << " changes, golden " << expected[i].size();

  const dpsim_heard* heard = nullptr;
  size_t count = 0;
  ok(dpsim_run_telegrams(run.get(), &heard, &count));
  EXPECT_EQ(count, summary.telegrams + summary.wrong_telegrams);
  const char* words = nullptr;
  ok(dpsim_telegram_explain(heard[0].bytes, heard[0].count, DPSIM_EXPLAIN_LINE, -1, &words));
  EXPECT_NE(std::string(words).find("token"), std::string::npos) << words;
}

TEST(CapiRun, WithoutAnybodyWatchingTheResultIsTheSame) {
  const auto quiet = make_run(kScenario), watched = make_run(kScenario);
  ok(dpsim_run_keep(watched.get(), DPSIM_KEEP_CHANGES));
  std::vector<nlohmann::json> results;
  for (const auto& run : {quiet.get(), watched.get()}) {
    const char* json = nullptr;
    ok(dpsim_run_execute(run, nullptr, nullptr));
    ok(dpsim_run_result(run, &json));
    results.push_back(nlohmann::json::parse(json));
    for (const char* of_the_machine : {"wall_s", "real_time_factor"}) results.back().erase(of_the_machine);
  }
  EXPECT_EQ(results[0], results[1]);
  const char* report = nullptr;
  ok(dpsim_run_report(quiet.get(), &report));
  EXPECT_NE(std::string(report).find("PASSED"), std::string::npos);
}

TEST(CapiRun, EndsWhenItsPollSaysSo) {
  const auto run = make_run(kScenario);
  ok(dpsim_run_execute(
      run.get(), [](void*, uint64_t now) { return now < kMs ? 1 : 0; }, nullptr));
  auto summary = sized<dpsim_run_summary>();
  ok(dpsim_run_get_summary(run.get(), &summary));
  EXPECT_EQ(summary.interrupted, 1);
  EXPECT_EQ(summary.passed, 0);
  EXPECT_NEAR(static_cast<double>(summary.simulated), static_cast<double>(kMs), 100.0 * kUs);
  EXPECT_EQ(dpsim_run_execute(run.get(), nullptr, nullptr), DPSIM_ERR_STATE);
  EXPECT_STREQ(dpsim_error_message(), "dpsim_run_execute: the run has begun, this is allowed before");
}

struct ToldOfRun {
  size_t telegrams = 0, events = 0;
  uint16_t station = 99;
};

TEST(CapiRun, TelegramsAndEventsAreToldAsTheyCome) {
  const auto run = make_run(kScenario);
  ToldOfRun told;
  ok(dpsim_run_on_telegram(
      run.get(), [](void* user, const dpsim_heard*) { ++static_cast<ToldOfRun*>(user)->telegrams; }, &told));
  ok(dpsim_run_on_event(
      run.get(),
      [](void* user, const dpsim_chip_event* event) {
        ++static_cast<ToldOfRun*>(user)->events;
        static_cast<ToldOfRun*>(user)->station = event->station;
      },
      &told));
  ok(dpsim_run_execute(
      run.get(), [](void*, uint64_t now) { return now < 3 * kMs ? 1 : 0; }, nullptr));
  auto summary = sized<dpsim_run_summary>();
  ok(dpsim_run_get_summary(run.get(), &summary));
  EXPECT_EQ(told.telegrams, summary.telegrams + summary.wrong_telegrams);
  EXPECT_GT(told.events, 5U);
  EXPECT_EQ(told.station, 0);
}

TEST(CapiRun, ChangesThatAreToldAreThoseThatAreKept) {
  const auto told_by = make_run(kScenario), kept_by = make_run(kScenario);
  std::vector<dpsim_change> told;
  ok(dpsim_run_on_change(
      told_by.get(),
      [](void* user, const dpsim_change* change) { static_cast<std::vector<dpsim_change>*>(user)->push_back(*change); },
      &told));
  ok(dpsim_run_keep(kept_by.get(), DPSIM_KEEP_CHANGES));
  for (dpsim_run* run : {told_by.get(), kept_by.get()})
    ok(dpsim_run_execute(
        run, [](void*, uint64_t now) { return now < 2 * kMs ? 1 : 0; }, nullptr));
  const auto kept = drain(dpsim_run_read_changes, kept_by.get());
  EXPECT_GT(told.size(), 5000U);
  EXPECT_EQ(columns_of(told, 1), columns_of(kept, 1));
}

TEST(CapiRun, SaysWhatTheScenarioIs) {
  const auto run = make_run(DSDPV1_SOURCE_DIR "/scenarios/two_slaves.yaml");
  auto info = sized<dpsim_run_info>();
  ok(dpsim_run_get_info(run.get(), &info));
  EXPECT_EQ(info.slaves, 2U);
  EXPECT_STREQ(info.kind, "dsdpv1");
  const char* name = nullptr;
  ok(dpsim_run_slave(run.get(), 1, &name));
  EXPECT_NE(*name, '\0');
  EXPECT_EQ(dpsim_run_slave(run.get(), 2, &name), DPSIM_ERR_NOT_FOUND);
  EXPECT_EQ(dpsim_run_result(run.get(), &name), DPSIM_ERR_STATE);
}

}  // namespace
}  // namespace dsdpv1::capi_test
