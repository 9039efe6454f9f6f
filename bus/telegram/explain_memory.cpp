#include "bus/telegram/explain_memory.hpp"

#include <tuple>

#include "bus/telegram/dpv1_words.hpp"

namespace dsdpv1::bus {

bool ExplainMemory::Channel::operator<(const Channel& other) const {
  return std::tie(slave, slave_sap, master, master_sap) <
         std::tie(other.slave, other.slave_sap, other.master, other.master_sap);
}

ExplainContext ExplainMemory::take(const Telegram& telegram) {
  if (const std::optional<bool> dpv1 = dpv1_enabled(telegram)) dpv1_.at(telegram.da) = dpv1;
  ExplainContext context(dpv1_.at(telegram.sa));
  if (!telegram.dsap || !telegram.ssap) return context;
  const std::uint8_t dsap = *telegram.dsap, ssap = *telegram.ssap;
  const Channel channel = telegram.is_request() ? Channel{telegram.da, dsap, telegram.sa, ssap}
                                                : Channel{telegram.sa, ssap, telegram.da, dsap};
  context.msac2 = take_channel(channel, telegram);
  return context;
}

/// True if it is an open one, up to the telegram with its end.
bool ExplainMemory::take_channel(const Channel& channel, const Telegram& telegram) {
  const Bytes& pdu = telegram.data;
  const bool immediate = !telegram.is_request() && pdu.size() > 1 && pdu[0] == function_num::kImmediate;
  if (channel.slave_sap == sap::kMs2Rm && immediate) open(channel, pdu[1]);
  const auto found = channels_.find(channel);
  if (found == channels_.end()) return false;
  if (!pdu.empty() && pdu[0] == function_num::kAbort) channels_.erase(found);
  return true;
}

/// The resource manager gives it to this master's SAP; an earlier connection there has ended.
void ExplainMemory::open(Channel channel, std::uint8_t slave_sap) {
  channel.slave_sap = slave_sap;
  const auto begin = channels_.lower_bound({channel.slave, slave_sap, 0, 0});
  auto end = begin;
  while (end != channels_.end() && end->slave == channel.slave && end->slave_sap == slave_sap) ++end;
  channels_.erase(begin, end);
  channels_.insert(channel);
}

}  // namespace dsdpv1::bus
