// Set_Slave_Address (6.2.1, table 18, rulings S5, S25).
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/user_side.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kMaxAddress = 125;  // EN 50170: 126 is the delivery address, 127 broadcast
constexpr int kLength = 4;        // without Rem_Slave_Data

}  // namespace

Reply DpSlave::set_slave_address(Cycle now, const Request& request) {
  if (state_ != DpState::kWaitPrm) return refuse_state(now, request, sap::kSetSlaveAddress);
  if (!config_.address_change || address_locked_) {
    log_.at_cycle(now, Reason::kAddressDisabled, config_.address_change, address_locked_);
    return Reply::status(fc::kRs);
  }
  const std::uint8_t* data = request.data;
  const unsigned ident = request.size >= kLength ? static_cast<unsigned>(data[1]) << 8 | data[2] : 0;
  const bool right = request.size >= kLength && data[0] <= kMaxAddress && ident == config_.ident;
  if (store_.address(now, request, right) == Take::kNoRoom) return Reply::status(fc::kRr);
  if (!right) {
    log_.at_cycle(now, Reason::kAddressRefused, static_cast<unsigned>(request.size), request.size > 0 ? data[0] : 0U,
                  ident);
    return Reply::sc();
  }
  log_.at_cycle(now, Reason::kAddressChanged, address_, data[0], data[3]);
  address_ = data[0];
  address_locked_ = data[3] != 0;
  return Reply::sc();
}

// --- the user's side -------------------------------------------------------------------------------------------------

Take UserSide::address(Cycle now, const Request& request, bool right) {
  if (request.size > kLength) {
    log_.at_cycle(now, Reason::kAddressTooLong, static_cast<unsigned>(request.size));
    return Take::kNoRoom;
  }
  if (right) mail_.address = {{now}, request.data[0], request.data[3] != 0};
  return Take::kAccepted;
}

}  // namespace dsdpv1::profibus
