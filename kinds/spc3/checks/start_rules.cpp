#include "kinds/spc3/checks/start_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "kinds/spc3/checks/buffers.hpp"

namespace dsdpv1::spc3_checks {
namespace {

using checks::Recorder;

/// In words; empty: none.
using Fault = std::string;

Fault mode_fault(const SeenChip& chip) {
  const std::optional<std::uint16_t> mode = chip.mode0();
  if (!mode) return "06H and 07H are not both written";
  const bool right = (*mode & regs::kMode0DpMode) != 0 && (*mode & regs::kMode0WdTest) == 0;
  return right ? "" : fmt::format("mode register 0 is {:04X}", *mode);
}

Fault station_fault(const SeenChip& chip) {
  const unsigned address = chip.cell(regs::kOrgAddress);
  if (address > regs::kOrgAddressLimit) return fmt::format("16H: address {}", address);
  const bool has_ident = (chip.cell(regs::kOrgIdentLow) | chip.cell(regs::kOrgIdentHigh)) != 0;
  return has_ident ? "" : "3AH, 3BH: ident 0000";
}

// --- buffers ---------------------------------------------------------------------------------------------------------

struct Placed {
  Span span;
  Buffer buffer;
};

Fault place_fault(const SeenChip& chip, const Placed& each) {
  const auto told = [&each](const char* format, int limit) {
    return fmt::format(fmt::runtime(format), each.buffer.pointer, each.buffer.length, each.span.begin, limit);
  };
  if (each.span.begin < regs::kBuffers) return told("{:02X}H: {} bytes from {:03X}, before {:03X}", regs::kBuffers);
  return each.span.end > chip.ram_end() ? told("{:02X}H: {} bytes from {:03X}, the RAM ends at {:03X}", chip.ram_end())
                                        : "";
}

Fault pointer_fault(const SeenChip& chip) {
  std::vector<Placed> placed;
  for (const Buffer& each : buffers_of(chip)) {
    placed.push_back({chip.buffer(each.pointer, each.length), each});
    const Fault fault = place_fault(chip, placed.back());
    if (!fault.empty()) return fault;
  }
  std::sort(
      placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.span.begin < b.span.begin; });
  const auto overlap = std::adjacent_find(placed.begin(), placed.end(),
                                          [](const Placed& a, const Placed& b) { return a.span.end > b.span.begin; });
  if (overlap == placed.end()) return "";
  const Placed &first = *overlap, &second = *(overlap + 1);
  return fmt::format("{:02X}H: {} bytes from {:03X}, {:02X}H begins at {:03X}", first.buffer.pointer,
                     first.buffer.length, first.span.begin, second.buffer.pointer, second.span.begin);
}

Fault length_fault(const SeenChip& chip, Address cell, int least) {
  const int length = chip.cell(cell);
  return length >= least && length <= kMaxBlock
             ? ""
             : fmt::format("{:02X}H is {}, {} to {}", cell, length, least, kMaxBlock);
}

Fault length_fault(const SeenChip& chip) {
  constexpr int kDiagHead = 6;
  std::vector<Fault> faults = {length_fault(chip, regs::kOrgDoutLength, 0), length_fault(chip, regs::kOrgDinLength, 0),
                               length_fault(chip, regs::kOrgDiagLength, kDiagHead),
                               length_fault(chip, regs::kOrgDiagLength + 1, kDiagHead)};
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    if (kBlocks.at(i).pointer != regs::kOrgSsaPointer || chip.cell(regs::kOrgSsaPointer) != 0)
      faults.push_back(length_fault(chip, length_cell(chip, i), kBlocks.at(i).least));
  const auto found = std::find_if(faults.begin(), faults.end(), [](const Fault& each) { return !each.empty(); });
  return found == faults.end() ? "" : *found;
}

// --- preset ----------------------------------------------------------------------------------------------------------

Fault preset_fault(const SeenChip& chip) {
  constexpr Address kReserved[] = {0x22, 0x23, 0x35, 0x36, 0x37, 0x38};
  if (chip.cell(chip.buffer(regs::kOrgSapPointer, 1).begin) != 0xFF) return "17H does not point to FF";
  for (const Address cell : kReserved)
    if (!chip.is_known(cell) || chip.cell(cell) != 0) return fmt::format("{:02X}H is not set to 00", cell);
  return chip.has_res_user_wd() ? "" : "Res_User_Wd is not set";
}

Fault outputs_fault(const SeenChip& chip) {
  const auto pointer = static_cast<Address>(regs::kOrgDoutPointer + chip.dout_user() - 1);
  const Span outputs = chip.buffer(pointer, chip.cell(regs::kOrgDoutLength));
  for (int address = outputs.begin; address < outputs.end; ++address)
    if (!chip.is_known(address) || chip.cell(address) != 0)
      return fmt::format("{:03X}H, of buffer {} ({:02X}H), is not cleared", address, chip.dout_user(), pointer);
  return "";
}

}  // namespace

void judge_start(Recorder& recorder, Tick at, const SeenChip& chip) {
  const auto judge = [&](Check check, const Fault& fault) {
    recorder.kept(check, at, fault.empty(), [&fault] { return fault; });
  };
  judge(Check::kStartMode, mode_fault(chip));
  judge(Check::kStartStation, station_fault(chip));
  judge(Check::kStartPointer, pointer_fault(chip));
  judge(Check::kStartLength, length_fault(chip));
  judge(Check::kStartPreset, preset_fault(chip));
  judge(Check::kStartOutputs, outputs_fault(chip));
}

}  // namespace dsdpv1::spc3_checks
