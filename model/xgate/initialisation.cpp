#include "model/xgate/initialisation.hpp"

#include <algorithm>

#include "model/profibus/cfg_identifier.hpp"

namespace dsdpv1::xgate {
namespace {

constexpr int kShortForm = 4, kCfgAt = 19, kDpv1At = 7, kLastAddress = 126, kDpv1Prm = 3, kMostAlarms = 7;

bool right_size(const Frame& frame) {
  const int size = frame.size();
  if (size < kShortForm) return false;
  const int cfg = frame.at(3);
  return size == kCfgAt + cfg || (size == kShortForm && cfg == 0);
}

Error read_cfg(const Frame& frame, const Config& config, Initialisation& read) {
  const int size = frame.at(3), input = frame.at(4), output = frame.at(5);
  read.any_cfg = size == 0;
  if (read.any_cfg) return error::kNone;  // input and output are ignored (4.2.1)
  if (input > profibus::kMaxIo || output > profibus::kMaxIo) return error::kIoLength;
  if (size > static_cast<int>(config.most_cfg)) return error::kIoLength;
  read.cfg.assign(frame.data.bytes.data() + kCfgAt, size);
  const profibus::CfgLengths lengths = profibus::cfg_lengths(read.cfg.bytes.data(), size);
  if (!lengths.complete()) return error::kConfiguration;
  return lengths.input() == input && lengths.output() == output ? error::kNone : error::kIoLength;
}

Error read_prm(const Frame& frame, Initialisation& read) {
  read.any_prm = false;
  read.prm_size = frame.at(6);
  const bool right = read.prm_size == 0 || (read.prm_size > kDpv1Prm && read.prm_size <= profibus::kMaxUserPrm);
  return right ? error::kNone : error::kParameter;
}

Error read_dpv1(const Frame& frame, Initialisation& read) {
  std::copy_n(frame.data.bytes.data() + kDpv1At, kDpv1Bytes, read.dpv1.data());
  const bool right = read.c1_size() <= profibus::kMaxAcyclic && read.c2_size() <= profibus::kMaxAcyclic &&
                     read.dpv1[kDpv1Bytes - 1] <= kMostAlarms;
  return right ? error::kNone : error::kParameter;
}

}  // namespace

bool Initialisation::alarm_enabled(unsigned type) const {
  constexpr int kBits[] = {0, 5, 6, 7, 7, 3, 2};  // table 4.2, by type 1 to 6
  constexpr unsigned kManufacturer = 4;
  const unsigned bit = type < std::size(kBits) ? static_cast<unsigned>(kBits[type]) : kManufacturer;
  return (alarms() >> bit & 1U) != 0;
}

bool Initialisation::prm_fits(int size) const {
  return any_prm || size == prm_size || (prm_size == 0 && size == kDpv1Prm);
}

profibus::SlaveConfig Initialisation::slave() const {
  profibus::SlaveConfig slave;
  slave.address = address;
  slave.ident = ident;
  slave.fail_safe_supported = fail_safe();
  slave.sync_supported = slave.freeze_supported = true;
  slave.dpv1 = dpv1_on();
  slave.max_input = slave.max_output = profibus::kMaxIo;
  slave.max_diag = profibus::kMaxDiag;
  slave.max_prm = profibus::kMaxUserPrm;
  slave.max_cfg = profibus::kMaxCfg;
  slave.prm_mode = slave.cfg_mode = profibus::Judging::kUser;
  slave.cfg = cfg;
  return slave;
}

Error read_initialisation(const Frame& frame, const Config& config, Initialisation& read) {
  if (!right_size(frame)) return error::kTooFew;
  if (frame.at(0) > kLastAddress) return error::kAddress;
  read.address = frame.at(0);
  read.ident = static_cast<std::uint16_t>(frame.at(1) | frame.at(2) << 8);
  if (frame.size() == kShortForm) return error::kNone;
  if (const Error wrong = read_cfg(frame, config, read)) return wrong;
  if (const Error wrong = read_prm(frame, read)) return wrong;
  return read_dpv1(frame, read);
}

}  // namespace dsdpv1::xgate
