#include "capi/slave.hpp"

#include <algorithm>

#include "capi/sized.hpp"

namespace dsdpv1::capi {

bus::SlaveParameters parameters_of(const dpsim_slave& slave) {
  const dpsim_slave own = options_of(&slave, "slave");
  need_range("user_prm_size", own.user_prm_size, 0, DPSIM_MAX_USER_PRM);
  need_range("cfg_size", own.cfg_size, 1, DPSIM_MAX_CFG);
  bus::SlaveParameters parameters;
  parameters.name = "slave " + std::to_string(own.address);
  parameters.address = own.address;
  parameters.ident = own.ident;
  parameters.user_prm.assign(own.user_prm, own.user_prm + own.user_prm_size);
  parameters.cfg.assign(own.cfg, own.cfg + own.cfg_size);
  parameters.input_length = own.input_length;
  parameters.output_length = own.output_length;
  parameters.wd_fact_1 = own.wd_fact_1;
  parameters.wd_fact_2 = own.wd_fact_2;
  parameters.wd_base_1ms = (own.flags & DPSIM_PRM_WD_1MS) != 0;
  parameters.group_ident = own.group_ident;
  if (own.min_tsdr != 0) parameters.min_tsdr = own.min_tsdr;
  parameters.sync = (own.flags & DPSIM_PRM_SYNC) != 0;
  parameters.freeze = (own.flags & DPSIM_PRM_FREEZE) != 0;
  parameters.lock = (own.flags & DPSIM_PRM_NO_LOCK) == 0;
  parameters.fail_safe = (own.flags & DPSIM_PRM_FAIL_SAFE) != 0;
  parameters.dpv1 = (own.flags & DPSIM_PRM_DPV1) != 0;
  if (own.c1_response_timeout != 0) parameters.c1_response_timeout = own.c1_response_timeout;
  parameters.min_slave_interval_us = own.min_slave_interval_us;
  return parameters;
}

dpsim_slave slave_of(const bus::SlaveParameters& parameters) {
  dpsim_slave slave{};
  slave.ident = parameters.ident;
  slave.address = parameters.address;
  slave.flags = parameters.dpv1 ? DPSIM_PRM_DPV1 : 0;
  slave.input_length = static_cast<std::uint16_t>(parameters.input_length);
  slave.output_length = static_cast<std::uint16_t>(parameters.output_length);
  slave.user_prm_size = static_cast<std::uint16_t>(parameters.user_prm.size());
  slave.cfg_size = static_cast<std::uint16_t>(parameters.cfg.size());
  slave.c1_response_timeout = parameters.c1_response_timeout;
  slave.min_slave_interval_us = static_cast<std::int32_t>(parameters.min_slave_interval_us);
  std::copy(parameters.user_prm.begin(), parameters.user_prm.end(), slave.user_prm);
  std::copy(parameters.cfg.begin(), parameters.cfg.end(), slave.cfg);
  return slave;
}

}  // namespace dsdpv1::capi
