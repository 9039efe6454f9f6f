#include "model/dpram/init_data.hpp"

#include "model/dpram/reasons.hpp"
#include "model/profibus/cfg_identifier.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::dpram {
namespace {

using profibus::Cycle;
using profibus::EventLog;

constexpr std::uint8_t kMaxMode = 2;

struct Limit {
  regs::Address address;
  int maximum;
};
constexpr Limit kLimits[] = {
    {regs::kInitMaxInput, regs::kInitMaxInputLimit},
    {regs::kInitMaxOutput, regs::kInitMaxOutputLimit},
    {regs::kInitMaxDiag, regs::kInitMaxDiagLimit},
    {regs::kInitMaxPrm, regs::kInitMaxPrmLimit},
    {regs::kPrmMode, kMaxMode},
    {regs::kInitMaxCfg, regs::kInitMaxCfgLimit},
    {regs::kCfgMode, kMaxMode},
};

class InitBlock {
 public:
  InitBlock(const std::uint8_t* block, int size, Cycle now, EventLog& log)
      : block_(block), size_(size), now_(now), log_(log) {}

  bool check() const {
    const int fixed = regs::kInitCfg - regs::kInit;
    if (size_ < fixed) return refuse(Reason::kInitLength, at(regs::kInitLength), static_cast<unsigned>(fixed - 1));
    if (at(regs::kInitAddress) > regs::kInitAddressLimit) return refuse(Reason::kInitAddress, at(regs::kInitAddress));
    for (const Limit& limit : kLimits)
      if (at(limit.address) > limit.maximum) return refuse_limit(limit.address, limit.maximum);
    if (at(regs::kInitCfgLength) > at(regs::kInitMaxCfg))
      return refuse_limit(regs::kInitCfgLength, at(regs::kInitMaxCfg));
    const int needed = fixed + at(regs::kInitCfgLength);
    if (size_ < needed) return refuse(Reason::kInitLength, at(regs::kInitLength), static_cast<unsigned>(needed - 1));
    return check_cfg();
  }

  profibus::SlaveConfig config() const {
    profibus::SlaveConfig config;
    const unsigned command = at(regs::kInitCommand);
    config.address = at(regs::kInitAddress);
    config.ident = static_cast<std::uint16_t>(at(regs::kInitIdentHigh) << 8 | at(regs::kInitIdentLow));
    config.address_change = (command & regs::kInitCommandAddressChange) != 0;
    config.freeze_supported = (command & regs::kInitCommandFreeze) != 0;
    config.sync_supported = (command & regs::kInitCommandSync) != 0;
    config.fail_safe_supported = (command & regs::kInitCommandFailSafe) != 0;
    config.max_input = at(regs::kInitMaxInput);
    config.max_output = at(regs::kInitMaxOutput);
    config.max_diag = at(regs::kInitMaxDiag);
    config.max_prm = at(regs::kInitMaxPrm);
    config.max_cfg = at(regs::kInitMaxCfg);
    config.prm_mode = static_cast<profibus::Judging>(at(regs::kPrmMode));
    config.cfg_mode = static_cast<profibus::Judging>(at(regs::kCfgMode));
    config.cfg.assign(cfg(), at(regs::kInitCfgLength));
    return config;
  }

 private:
  std::uint8_t at(regs::Address address) const { return block_[address - regs::kInit]; }
  const std::uint8_t* cfg() const { return block_ + (regs::kInitCfg - regs::kInit); }

  bool refuse(profibus::Reason reason, unsigned a, unsigned b = 0, unsigned c = 0) const {
    log_.at_cycle(now_, reason, a, b, c);
    return false;
  }
  bool refuse_limit(regs::Address address, int maximum) const {
    return refuse(Reason::kInitLimit, address, at(address), static_cast<unsigned>(maximum));
  }
  bool check_cfg() const {
    const profibus::CfgLengths lengths = profibus::cfg_lengths(cfg(), at(regs::kInitCfgLength));
    if (lengths.complete() && lengths.input() <= at(regs::kInitMaxInput) &&
        lengths.output() <= at(regs::kInitMaxOutput))
      return true;
    return refuse(Reason::kInitCfg, static_cast<unsigned>(lengths.input()), static_cast<unsigned>(lengths.output()),
                  lengths.complete());
  }

  const std::uint8_t* block_;
  int size_;
  Cycle now_;
  EventLog& log_;
};

}  // namespace

bool parse_init(const std::uint8_t* block, int size, Cycle now, EventLog& log, profibus::SlaveConfig& config) {
  const InitBlock init(block, size, now, log);
  if (!init.check()) return false;
  config = init.config();
  return true;
}

}  // namespace dsdpv1::dpram
