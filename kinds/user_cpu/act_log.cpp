#include "kinds/user_cpu/act_log.hpp"

namespace dsdpv1::user_cpu {

void ActLog::take_samples(Tick now, std::uint32_t pc, std::uint32_t lr) {
  const Tick kept = static_cast<Tick>(samples_.size()) * kSamplePeriod;
  if (now - sample_at_ > kept) sample_at_ += (now - kept - sample_at_) / kSamplePeriod * kSamplePeriod;
  for (; sample_at_ <= now; sample_at_ += kSamplePeriod)
    samples_.at(samples_taken_++ % samples_.size()) = {sample_at_, pc, lr};
}

template <class Is>
const ActLog::Entry* ActLog::last(Tick until, const Is& is) const {
  const std::size_t kept = std::min(count_, entries_.size());
  for (std::size_t i = 0; i < kept; ++i) {
    const Entry& entry = entries_.at((count_ - 1 - i) % entries_.size());
    if (entry.at <= until && is(entry)) return &entry;
  }
  return nullptr;
}

std::optional<std::uint32_t> ActLog::instruction(const Act& act) const {
  const Entry* found = nullptr;
  if (const auto cell = act.cell) {
    found = last(act.at, [cell](const Entry& each) { return *cell - each.cell < each.written; });
    if (found == nullptr) found = last(act.at, [](const Entry& each) { return each.releases; });
  }
  if (found == nullptr) found = last(act.at, [](const Entry&) { return true; });
  return found != nullptr ? std::optional(found->pc) : std::nullopt;
}

}  // namespace dsdpv1::user_cpu
