#include "model/profibus/user_side.hpp"

#include "model/profibus/station.hpp"

namespace dsdpv1::profibus {

const IoBlock& UserSide::outputs() const { return station_.slave_.outputs(); }
int UserSide::input_size() const { return station_.slave_.input_size(); }

void UserSide::initialise(Cycle now, const SlaveConfig& config) {
  station_.initialise(now, config);
  station_.plan_timers();
}

void UserSide::prm_verdict(Cycle now, bool good) {
  station_.slave_.prm_verdict(now, good);
  station_.plan_timers();
}

void UserSide::cfg_verdict(Cycle now, bool good) {
  station_.slave_.cfg_verdict(now, good);
  station_.plan_timers();
}

bool UserSide::new_inputs(Cycle now, const std::uint8_t* bytes, int size) {
  return station_.slave_.new_inputs(now, bytes, size);
}

bool UserSide::new_diagnosis(Cycle now, std::uint8_t type, const std::uint8_t* bytes, int size) {
  return station_.slave_.new_diagnosis(now, type, bytes, size);
}

void UserSide::c1_answer(Cycle now, const std::uint8_t* pdu, int size) { station_.slave_.c1_answer(now, pdu, size); }

void UserSide::c2_answer(Cycle now, const std::uint8_t* pdu, int size) {
  station_.slave_.c2_answer(now, pdu, size);
  station_.plan_timers();
}

}  // namespace dsdpv1::profibus
