#include "tb/bench/program_options.hpp"

namespace dsdpv1::tb {
namespace {

user_cpu::AcyclicObject object_of(const scenario::Dpv1Object& object) {
  const auto bit = [](bool wanted, unsigned value) { return wanted ? value : 0U; };
  const unsigned services = bit(object.read, user_cpu::kMayRead) | bit(object.write, user_cpu::kMayWrite) |
                            bit(object.transport, user_cpu::kMayTransport);
  return {static_cast<std::uint8_t>(object.slot),       static_cast<std::uint8_t>(object.index),
          static_cast<std::uint8_t>(services),          object.classes,
          static_cast<std::uint8_t>(object.min_length), object.data};
}

user_cpu::AcyclicOptions acyclic_options(const scenario::Dpv1User& user) {
  user_cpu::AcyclicOptions options;
  for (const scenario::Dpv1Object& object : user.objects) options.objects.push_back(object_of(object));
  if (user.im0) options.im0 = *user.im0;
  options.answering = user.answering;
  options.delay = user.delay;
  options.error_code_1 = static_cast<std::uint8_t>(user.error_code_1);
  options.error_code_2 = static_cast<std::uint8_t>(user.error_code_2);
  return options;
}

}  // namespace

user_cpu::ProgramOptions program_options(const scenario::UserCpu& user, const user_cpu::StationConfig& station) {
  user_cpu::ProgramOptions options;
  options.station = station;
  options.start_delay = user.start_delay;
  options.period = user.cycle;
  options.inputs = user.behaviour;
  options.constant = user.constant;
  options.overwrite_inputs = user.overwrite_inputs;
  options.prm = user.judge_prm;
  options.cfg = user.judge_cfg;
  options.judge_delay = user.judge_delay;
  options.judge_in_handler = user.judge_in_handler;
  options.retry_delay = user.retry_delay;
  options.acyclic = acyclic_options(user.dpv1);
  return options;
}

std::uint8_t diagnosis_code(user_cpu::DiagnosisKind kind) {
  using user_cpu::DiagnosisKind;
  switch (kind) {
    case DiagnosisKind::kExtended: return 0x00;
    case DiagnosisKind::kExternal: return 0x81;
    case DiagnosisKind::kExternalGone: return 0x01;
    case DiagnosisKind::kStatic: return 0x82;
    case DiagnosisKind::kStaticGone: return 0x02;
  }
  return 0;
}

}  // namespace dsdpv1::tb
