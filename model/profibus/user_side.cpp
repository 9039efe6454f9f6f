#include "model/profibus/user_side.hpp"

#include "model/profibus/station.hpp"

namespace dsdpv1::profibus {

const SlaveConfig& UserSide::config() const { return station_.slave().config(); }

void UserSide::reset() {
  forget();
  station_.reset();
}

void UserSide::forget() {
  outputs_.reset(0);
  inputs_.reset(0);
  diagnosis_.reset();
  mail_ = UserMail();
  msac_.alarms.reset();
  msac_.c1.reset();
  msac_.c2.reset();
  data_exchanges_ = outputs_replaced_ = 0;
}

void UserSide::initialise(Cycle now, const SlaveConfig& config) {
  const bool left_exchange = station_.slave().state() == DpState::kDataExch;
  station_.stop(now);
  const std::uint16_t exchanges_left = mail_.state.exchanges_left;
  const std::uint64_t data_exchanges = data_exchanges_, outputs_replaced = outputs_replaced_;
  forget();
  mail_.state.exchanges_left = exchanges_left;
  data_exchanges_ = data_exchanges;
  outputs_replaced_ = outputs_replaced;
  const CfgLengths lengths = cfg_lengths(config.cfg.bytes.data(), config.cfg.size);
  inputs_.reset(lengths.input());
  outputs_.reset(lengths.output());
  if (left_exchange) hand_outputs(now);  // S18
  station_.start(now, config);
}

void UserSide::entered(Cycle now, DpState from, DpState to) {
  mail_.state.state = to;
  mail_.state.due.set(now);
  if (from != DpState::kDataExch) return;
  ++mail_.state.exchanges_left;  // S18
  inputs_.release();
  outputs_.release();
  clear_outputs(now);
  msac_.c1.close(now);
  msac_.alarms.close(now);
}

void UserSide::c2_answer(Cycle now, const std::uint8_t* pdu, int size) {
  msac_.c2.answer(now, pdu, size);
  station_.plan_timers();
}

}  // namespace dsdpv1::profibus
