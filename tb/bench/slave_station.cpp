#include "tb/bench/slave_station.hpp"

#include <utility>

namespace dsdpv1::tb {

SlaveStation::SlaveStation(std::size_t number, const scenario::Slave& slave, user_cpu::StationConfig station,
                           std::unique_ptr<ChipView> chip, MakeUser make_user, Execution& execution,
                           const Observers& observers)
    : number_(number),
      slave_(slave),
      station_(std::move(station)),
      chip_(std::move(chip)),
      make_user_(std::move(make_user)),
      execution_(execution),
      observers_(observers) {}

void SlaveStation::hold_in_reset(Tick now) {
  if (user_) {
    before_reset_ += user_->counters();
    board_before_reset_ = user_->board();
  }
  user_.reset();
  announce();
  outputs_seen_ = 0;
  chip_->set_reset(now, false);  // first: what the user's side cuts off is then no violation
  chip_->reset_host(now);
}

void SlaveStation::release_reset(Tick now) {
  chip_->set_reset(now, true);
  user_ = make_user_(station_, now);
  announce();
  tells_ = user_->tells();
  user_->set_others(this);
  user_->on_error = [this](const user_cpu::ProgramError& error) {
    observers_.tell(&Observer::error, number_, error);
    observers_.changed();
  };
  user_->on_text = [this](Tick at, const std::string& line) { observers_.tell(&Observer::text, number_, at, line); };
  user_->on_plan = [this] { announce(); };
  user_->on_killed = [this] { observers_.tell(&Observer::killed); };
  user_->on_failure = [this](Tick at, const std::string& why, const std::string& registers) {
    observers_.tell(&Observer::user_failed, number_, at, why, registers);
  };
}

void SlaveStation::command(Tick now, const user_cpu::Command& command) {
  if (!user_) return;  // held in reset: no program
  user_->command(now, command);
  announce();
}

void SlaveStation::reinitialise(Tick now, std::optional<int> address, const std::optional<bus::Bytes>& cfg) {
  if (address) station_.address = static_cast<std::uint8_t>(*address);
  if (cfg) station_.cfg = *cfg;
  command(now, user_cpu::command::Reinitialise{station_});
}

void SlaveStation::interrupt_changed(Tick at, bool level) {
  if (!user_) return;
  user_->interrupt_changed(at, level);
  announce();
}

/// Outputs that the user CPU has fetched are reported before its next action.
bool SlaveStation::go_on(Tick tick) {
  return user_->outputs_received() == outputs_seen_ && execution_.go_on(*this, tick);
}

void SlaveStation::run(Tick now) {
  user_->run(now);
  const std::uint64_t received = user_->outputs_received();
  if (received == outputs_seen_) return;
  outputs_seen_ = received;
  const bool changed = outputs_ != user_->outputs();
  outputs_ = user_->outputs();
  observers_.tell(&Observer::outputs, number_, observers_.now(), outputs_, changed);  // the turn may have been extended
  observers_.changed();
}

SlaveResult SlaveStation::result() const {
  SlaveResult result;
  result.user = before_reset_;
  if (user_) result.user += user_->counters();
  result.board = user_ ? user_->board() : board_before_reset_;
  result.name = name();
  result.status = chip_->status();
  result.tsdr = tsdr_;
  if (tells_) result.outputs = outputs_;
  return result;
}

}  // namespace dsdpv1::tb
