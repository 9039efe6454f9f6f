// Set_Slave_Address (6.2.1, table 18, rulings S5, S25).
#include "model/profibus/dp_slave.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr int kMaxAddress = 125;  // EN 50170: 126 is the delivery address, 127 broadcast

}  // namespace

Reply DpSlave::set_slave_address(Cycle now, const Request& request) {
  constexpr int kLength = 4;
  if (state_ != DpState::kWaitPrm) return refuse_state(now, request, sap::kSetSlaveAddress);
  if (!config_.address_change || address_locked_) {
    log_.at_cycle(now, Reason::kAddressDisabled, config_.address_change, address_locked_);
    return Reply::status(fc::kRs);
  }
  if (request.size > kLength) {
    log_.at_cycle(now, Reason::kAddressTooLong, static_cast<unsigned>(request.size));
    return Reply::status(fc::kRr);
  }
  const std::uint8_t* data = request.data;
  const unsigned ident = request.size == kLength ? static_cast<unsigned>(data[1]) << 8 | data[2] : 0;
  if (request.size < kLength || data[0] > kMaxAddress || ident != config_.ident) {
    log_.at_cycle(now, Reason::kAddressRefused, static_cast<unsigned>(request.size), request.size > 0 ? data[0] : 0U,
                  ident);
    return Reply::sc();
  }
  log_.at_cycle(now, Reason::kAddressChanged, address_, data[0], data[3]);
  address_ = data[0];
  address_locked_ = data[3] != 0;
  mail_.address = {{now}, address_, address_locked_};
  return Reply::sc();
}

}  // namespace dsdpv1::profibus
