#include "lab/accept/requests.hpp"

#include <fmt/format.h>

#include "bus/telegram/telegram.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::accept {

void Requests::act(const std::string& keys) {
  script_ +=
      fmt::format("  - {{when: {{slave: {}, data_exchanges: 1, after: {}}}, {}}}\n", kDevice, time_text(now_), keys);
}

void Requests::telegram(std::uint8_t sap, std::uint8_t ssap, const bus::Bytes& data) {
  send(in_cycle_ ? slave_.master : slave_.probe, sap, ssap, data);
}

void Requests::send(std::uint8_t sender, std::uint8_t sap, std::uint8_t ssap, const bus::Bytes& data) {
  constexpr auto kFirst = static_cast<std::uint8_t>(bus::fc::kRequest | bus::fc::kFcb | bus::fc::kSrdHigh);
  constexpr auto kAll = static_cast<std::size_t>(-1);
  const bus::Telegram request = bus::make_telegram(slave_.parameters.address, sender, kFirst, data, sap, ssap);
  act(fmt::format("do: telegram, master: {}, bytes: \"{}\"", in_cycle_ ? kMaster : kProbe,
                  bytes_text(bus::encode(request), kAll)));
}

void Requests::unlock(std::uint8_t holder) {
  constexpr std::uint8_t kUnlock = 0x40;
  bus::Bytes data = bus::set_prm_data(slave_.parameters, 0);
  data[0] = kUnlock;
  send(holder, bus::sap::kSetPrm, bus::sap::kMaster, data);
}

/// kProbe releases the slave in the name of the master, which has fallen silent: sooner than its watchdog would.
void Requests::stop_cycle() {
  act(std::string("do: stop_master, master: ") + kMaster);
  wait(bus::kTicksPerMs);
  act(std::string("do: start_master, master: ") + kProbe);
  in_cycle_ = false;
  wait(4 * bus::kTicksPerMs);
  unlock(slave_.master);
  wait(served());
}

void Requests::start_cycle() {
  wait(served());
  unlock(slave_.probe);
  wait(bus::kTicksPerMs);
  act(std::string("do: stop_master, master: ") + kProbe);
  act(std::string("do: start_master, master: ") + kMaster);
  in_cycle_ = true;
  wait(returned());
}

bus::Tick Requests::chance(bus::Tick most) {
  return static_cast<bus::Tick>(random_()) * most / static_cast<bus::Tick>(std::minstd_rand::max());
}

}  // namespace dsdpv1::tb::accept
