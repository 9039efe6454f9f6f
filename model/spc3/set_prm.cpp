// Set_Prm (M 5.2.2; A20, A21, A37).
#include "model/spc3/ram_store.hpp"
#include "model/spc3/reasons.hpp"

namespace dsdpv1::spc3 {
namespace {

constexpr int kStandardSize = 7;

}  // namespace

bool RamStore::is_spec_prm(const Request& request) const {
  return modes_.has0(regs::kMode0SpecPrmBuf) && (request.size > kStandardSize || config_.prm7 != 0);
}

bool RamStore::has_room(Cycle now, const Request& request) {
  return blocks_.has_room(now, Block::kPrm, request.size, is_spec_prm(request));
}

profibus::Take RamStore::parameters(Cycle now, const Request& request) {
  if (!reserved_right(now, request)) return profibus::Take::kRefused;
  blocks_.drop(Block::kCfg);  // A53
  cfg_held_ = false;
  if (request.size == kStandardSize && config_.prm7 == 0) {
    blocks_.drop(Block::kPrm);
    return profibus::Take::kAccepted;
  }
  blocks_.receive(now, Block::kPrm, request, is_spec_prm(request));
  effect(now);
  return config_.prm_taken == 0 ? profibus::Take::kAccepted : profibus::Take::kAwaited;  // A49
}

// A21: the VPC3 alone looks at them, unless its mode register 2 says not to.
bool RamStore::reserved_right(Cycle now, const Request& request) {
  constexpr unsigned kDisStop = 0x02, kSpecReserved = 0x38, kStatusReserved = 0x07;
  const unsigned spec = request.size > kStandardSize ? request.data[kStandardSize] : 0U, status = request.data[0];
  if ((spec & kDisStop) != 0) log_.at_cycle(now, Reason::kDisStop, request.sa);
  const bool looks = variant_.has_more_modes && config_.prm_reserved == 0 && !modes_.has2(regs::kMode2NoPrmCheck);
  if (!looks || ((spec & kSpecReserved) == 0 && (status & kStatusReserved) == 0)) return true;
  log_.at_cycle(now, Reason::kPrmReserved, status, spec);
  return false;
}

// --- the user's verdict ----------------------------------------------------------------------------------------------

std::uint8_t RamStore::prm_verdict(Cycle now, bool good) {
  const std::uint8_t answer = take_back(now, Block::kPrm, regs::kEventNewPrm);
  if (answer != regs::kVerdictFinished) return answer;
  if (config_.prm_taken != 0)
    station_.prm_verdict(now, good);
  else if (good)
    begin_exchange(now);
  else
    station_.refuse_parameters(now);
  return answer;
}

// The answer to a verdict, without its effect (A14).
std::uint8_t RamStore::take_back(Cycle now, Block block, std::uint16_t event) {
  const auto number = static_cast<unsigned>(block);
  if (!blocks_.with_user(block)) {
    interrupt_.clear(event);
    log_.at_cycle(now, Reason::kNotAllowed, number, static_cast<unsigned>(station_.slave().state()));
    return regs::kVerdictNotAllowed;
  }
  if (blocks_.next(block)) {
    interrupt_.raise(event);
    log_.at_cycle(now, Reason::kConflict, number);
    return regs::kVerdictConflict;
  }
  interrupt_.clear(event);
  return regs::kVerdictFinished;
}

}  // namespace dsdpv1::spc3
