#include "lab/accept/requests.hpp"

#include <fmt/format.h>

#include "bus/telegram/telegram.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::accept {

void Requests::act(const std::string& keys) {
  script_ +=
      fmt::format("  - {{when: {{slave: {}, data_exchanges: 1, after: {}}}, {}}}\n", kDevice, time_text(now_), keys);
}

/// kProbe must not keep the slave: its watchdog frees it soon.
bus::SlaveParameters Requests::parameters() const {
  bus::SlaveParameters parameters = slave_.parameters;
  if (in_cycle_) return parameters;
  parameters.wd_fact_1 = 2;  // x 10 ms
  parameters.wd_fact_2 = 1;
  parameters.wd_base_1ms = false;
  return parameters;
}

void Requests::telegram(std::uint8_t sap, std::uint8_t ssap, const bus::Bytes& data) {
  constexpr auto kFirst = static_cast<std::uint8_t>(bus::fc::kRequest | bus::fc::kFcb | bus::fc::kSrdHigh);
  constexpr auto kAll = static_cast<std::size_t>(-1);
  const std::uint8_t sender = in_cycle_ ? slave_.master : slave_.probe;
  const bus::Telegram request = bus::make_telegram(slave_.parameters.address, sender, kFirst, data, sap, ssap);
  act(fmt::format("do: telegram, master: {}, bytes: \"{}\"", in_cycle_ ? kMaster : kProbe,
                  bytes_text(bus::encode(request), kAll)));
}

/// The watchdog frees the slave.
void Requests::stop_cycle() {
  act(std::string("do: stop_master, master: ") + kMaster);
  wait(110 * bus::kTicksPerMs);
  act(std::string("do: start_master, master: ") + kProbe);
  in_cycle_ = false;
  wait(10 * bus::kTicksPerMs);
}

void Requests::start_cycle() {
  wait(10 * bus::kTicksPerMs);
  act(std::string("do: stop_master, master: ") + kProbe);
  act(std::string("do: start_master, master: ") + kMaster);
  in_cycle_ = true;
  wait(80 * bus::kTicksPerMs);
}

bus::Tick Requests::chance(bus::Tick most) {
  return static_cast<bus::Tick>(random_()) * most / static_cast<bus::Tick>(std::minstd_rand::max());
}

}  // namespace dsdpv1::tb::accept
