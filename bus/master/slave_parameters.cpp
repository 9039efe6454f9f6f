#include "bus/master/slave_parameters.hpp"

#include <algorithm>

namespace dsdpv1::bus {

namespace {

void add_bits(std::uint8_t& byte, unsigned bits) { byte = static_cast<std::uint8_t>(byte | bits); }

void set_bit(Bytes& user_prm, unsigned mask, bool on) {
  if (!on) return;
  if (user_prm.empty()) user_prm.push_back(0);
  add_bits(user_prm[0], mask);
}

Bytes completed_user_prm(const SlaveParameters& slave) {
  Bytes user = slave.user_prm;
  if (slave.dpv1 && user.size() < 3) user.resize(3);
  set_bit(user, 0x04, slave.wd_base_1ms);
  set_bit(user, 0x40, slave.fail_safe);
  set_bit(user, 0x80, slave.dpv1);
  if (!slave.dpv1) return user;
  add_bits(user[1], slave.alarms.enabled);
  add_bits(user[2], static_cast<unsigned>(slave.alarms.mode));
  return user;
}

}  // namespace

Bytes set_prm_data(const SlaveParameters& slave, std::uint8_t min_tsdr) {
  const bool watchdog = slave.wd_fact_1 != 0 && slave.wd_fact_2 != 0;
  const unsigned status =
      (slave.lock ? 0x80U : 0U) | (slave.sync ? 0x20U : 0U) | (slave.freeze ? 0x10U : 0U) | (watchdog ? 0x08U : 0U);
  Bytes data = {static_cast<std::uint8_t>(status),
                slave.wd_fact_1,
                slave.wd_fact_2,
                min_tsdr,
                static_cast<std::uint8_t>(slave.ident >> 8),
                static_cast<std::uint8_t>(slave.ident & 0xFF),
                slave.group_ident};
  const Bytes user = completed_user_prm(slave);
  data.insert(data.end(), user.begin(), user.end());
  return data;
}

int BusParameters::slot(int baud_index) const { return slot_bits.value_or(baud(baud_index).slot_bits); }

int BusParameters::retries(int baud_index) const { return max_retries.value_or(std::max(1, 4 - baud_index)); }

int BusParameters::safety(int baud_index) const {
  const Baud& rate = baud(baud_index);
  return 2 + 2 * set_bits.value_or(rate.set_bits) + quiet_bits.value_or(rate.quiet_bits);
}

int BusParameters::id1(int baud_index) const { return std::max(kSynBits + safety(baud_index), kMinTsdrBits); }

int BusParameters::id2(int baud_index) const {
  return std::max(kSynBits + safety(baud_index), baud(baud_index).max_tsdr_bits);
}

}  // namespace dsdpv1::bus
