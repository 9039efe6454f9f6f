// The masters of a scenario on the caller's bus.
#include "capi/scenario.hpp"

#include <algorithm>
#include <memory>

#include "capi/master.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "io/input/units.hpp"
#include "tb/bench/scenario_masters.hpp"

using capi::need;
using tb::scenario::ActionKind;

namespace dsdpv1::capi {

std::vector<tb::scenario::Setting> settings_of(const char* const* settings, std::uint32_t count) {
  need_buffer(settings, count, "settings");
  std::vector<std::string> texts;
  for (std::uint32_t i = 0; i < count; ++i) {
    need(settings[i], "a setting");
    texts.emplace_back(settings[i]);
  }
  return tb::scenario::parse_settings(texts);
}

}  // namespace dsdpv1::capi

namespace {

bool is_acyclic(ActionKind service) {
  return service == ActionKind::kC1Read || service == ActionKind::kC1Write || service >= ActionKind::kC2Connect;
}

/// Error_Decode and the error codes, which a negative answer has instead of data.
std::uint32_t codes_of(const tb::Reply& reply) {
  if (reply.outcome != bus::AcyclicOutcome::kNegative || reply.data.size() != 3) return 0;
  return std::uint32_t{reply.data[0]} << 16U | std::uint32_t{reply.data[1]} << 8U | reply.data[2];
}

std::string words_of(ActionKind service, const tb::Reply& reply) {
  const std::string what = std::string(tb::service_word(service)) + ": ";
  if (is_acyclic(service) && reply.outcome != bus::AcyclicOutcome::kPositive)
    return what + bus::name(reply.outcome) +
           (reply.data.empty() ? "" : " " + tb::bytes_text(reply.data, reply.data.size()));
  return what + (!reply.answered      ? "no answer"
                 : reply.data.empty() ? "done"
                                      : tb::bytes_text(reply.data, reply.data.size()));
}

void tell_reply(const dpsim_master& master, ActionKind service, const tb::Reply& reply) {
  const bool acyclic = is_acyclic(service);
  dpsim_event event =
      master.event(acyclic ? DPSIM_EVENT_ACYCLIC_DONE : DPSIM_EVENT_REQUEST_DONE, master.bus.timeline.now());
  const std::string words = words_of(service, reply);
  event.outcome = acyclic          ? static_cast<std::int32_t>(reply.outcome)
                  : reply.answered ? DPSIM_OUTCOME_ANSWERED
                                   : DPSIM_OUTCOME_NO_ANSWER;
  event.codes = acyclic ? codes_of(reply) : 0;
  if (event.codes == 0) {
    event.data = reply.data.data();
    event.data_size = static_cast<std::uint32_t>(reply.data.size());
  }
  event.text = words.c_str();
  master.bus.tell(event);
}

/// Makes handles of all, then starts the script, which acts on their results.
std::vector<dpsim_master*> take(dpsim_bus& bus, tb::ScenarioMasters& own, bus::StationId first) {
  std::vector<dpsim_master*> handles;
  const auto add = [&](std::uint8_t address, auto& master) {
    const bus::StationId id = first + handles.size();
    master.on_answer = [&bus, &own](bus::Tick, const bus::FdlResult&) { own.changed(bus.timeline.now()); };
    handles.push_back(bus.masters.emplace_back(std::make_unique<dpsim_master>(bus, id, address, master)).get());
  };
  for (const tb::MasterStation& each : own.stations().masters)
    add(static_cast<std::uint8_t>(each.spec->address), *each.master);
  for (const auto& each : own.stations().masters2) add(each->address(), each->master());
  bus.timeline.add(own.script());
  own.on_reply = [handles, &own](const std::string& asker, ActionKind service, const tb::Reply& reply) {
    tell_reply(*handles[own.number_of(asker)], service, reply);
  };
  return handles;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): three results
dpsim_status dpsim_bus_add_scenario(dpsim_bus* bus, const dpsim_scenario_options* options, dpsim_master** masters,
                                    size_t capacity, size_t* count, const char** left_out) {
  return capi::guarded(
      __func__,
      [&] {
        need(bus, "bus");
        need(options, "options");
        need(count, "count");
        capi::need_buffer(masters, capacity, "masters");
        capi::need_outside(bus->clock);
        tb::scenario::Scenario scenario = capi::load_scenario(capi::options_of(options, "options"));
        const std::size_t needed = scenario.masters.size() + scenario.masters2.size();
        if (needed > capacity) {
          *count = needed;
          capi::fail(DPSIM_ERR_SPACE, "the scenario has " + std::to_string(needed) + " masters, capacity is " +
                                          std::to_string(capacity));
        }
        {  // find all faults before any station is on the bus, because none can leave it
          bus::Segment segment;
          const bus::Timeline timeline;
          const tb::ScenarioMasters trial(scenario, segment, timeline);
        }
        bus->end_chips();
        const bus::StationId first = bus->segment.stations();
        auto own = std::make_unique<tb::ScenarioMasters>(std::move(scenario), bus->segment, bus->timeline);
        const auto handles = take(*bus, *own, first);
        std::copy(handles.begin(), handles.end(), masters);
        *count = handles.size();
        if (left_out != nullptr) *left_out = own->left_out().c_str();
        bus->scenarios.push_back(std::move(own));
      });
}
