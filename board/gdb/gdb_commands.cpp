#include "board/gdb/gdb_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "board/gdb/gdb_description.hpp"

namespace dsdpv1::arm {
namespace {

constexpr const char* kOk = "OK";
constexpr const char* kMalformed = "E01";
constexpr const char* kCannotAccess = "E0e";  // EFAULT
constexpr const char* kUnknown = "";
constexpr const char* kNoProcess = "W00";

std::array<std::uint8_t, 4> little_endian(std::uint32_t value) {
  return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8U),
          static_cast<std::uint8_t>(value >> 16U), static_cast<std::uint8_t>(value >> 24U)};
}

std::string register_text(std::uint32_t value) {
  const auto bytes = little_endian(value);
  return to_hex(bytes.data(), bytes.size());
}

std::optional<std::uint32_t> register_value(std::string_view digits) {
  const auto bytes = from_hex(digits);
  if (!bytes || bytes->size() != 4) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>((*bytes)[i]);
  return value;
}

/// A part of a longer text, as qXfer wants it: `m` when more follows, `l` when it is the last.
std::string part_of(const std::string& text, GdbFields::Range range) {
  const std::size_t start = std::min<std::size_t>(range.address, text.size());
  const std::size_t size = std::min<std::size_t>(range.size, text.size() - start);
  return (start + size < text.size() ? "m" : "l") + text.substr(start, size);
}

GdbCommands::Result refused(const std::string& why) { return {"E." + why, Resumption::kNone, false, "load: " + why}; }

}  // namespace

GdbCommands::Result GdbCommands::execute(std::string_view packet) {
  GdbFields fields(packet.substr(std::min<std::size_t>(1, packet.size())));
  Result result;
  switch (packet.empty() ? '\0' : packet.front()) {
    case '?': result.reply = killed_ ? kNoProcess : stop_reply_; break;
    case '!':
      extended_ = true;
      result.reply = kOk;
      break;
    case 'g': result.reply = read_registers(); break;
    case 'G': result.reply = write_registers(fields.rest()); break;
    case 'p': result.reply = read_register(fields); break;
    case 'P': result.reply = write_register(fields); break;
    case 'm': result.reply = read_memory(fields); break;
    case 'M': result.reply = write_memory(fields, false); break;
    case 'X': result.reply = write_memory(fields, true); break;
    case 'Z': result.reply = change_stop(fields, true); break;
    case 'z': result.reply = change_stop(fields, false); break;
    case 'H':
    case 'T': result.reply = kOk; break;  // there is one thread
    case 'q': return query(packet);
    case 'Q': result.reply = set(packet, result); break;
    case 'v': return verbose(fields);
    case 'b': return back(packet);
    case 'c': return resume_at(fields, Resumption::kContinue);
    case 's': return resume_at(fields, Resumption::kStep);
    case 'D': return {kOk, Resumption::kDetach};
    case 'k': return kill(false);
    default: result.reply = kUnknown;
  }
  return result;
}

void GdbCommands::set_stops(Stops stops) {
  breakpoints_ = std::move(stops.breakpoints);
  watchpoints_ = std::move(stops.watchpoints);
  if (!watchpoints_.empty()) target_.report_data_accesses(true);
}

GdbCommands::Result GdbCommands::back(std::string_view packet) const {
  if (reverses_ && packet == "bs") return {std::nullopt, Resumption::kStepBack};
  if (reverses_ && packet == "bc") return {std::nullopt, Resumption::kContinueBack};
  return {kUnknown};
}

void GdbCommands::forget_stops() {
  breakpoints_.clear();
  if (!watchpoints_.empty()) target_.report_data_accesses(false);
  watchpoints_.clear();
  flash_.forget();
  extended_ = killed_ = false;
}

GdbCommands::Result GdbCommands::query(std::string_view packet) {
  GdbFields fields(packet);
  if (fields.skip("qSupported")) {
    return {
        fmt::format("PacketSize={:x};QStartNoAckMode+;vContSupported+;qXfer:features:read+;qXfer:memory-map:read+{}",
                    kGdbPacketSize, reverses_ ? ";ReverseStep+;ReverseContinue+" : "")};
  }
  if (fields.skip("qXfer:")) return {transfer(fields)};
  if (fields.skip("qRcmd,")) {
    const auto command = from_hex(fields.rest());
    return command ? monitor(*command) : Result{kMalformed};
  }
  if (packet == "qAttached") return {"1"};  // gdb detaches when the user leaves it
  if (packet == "qC") return {"QC1"};
  if (packet == "qfThreadInfo") return {"m1"};
  if (packet == "qsThreadInfo") return {"l"};
  return {kUnknown};
}

std::string GdbCommands::set(std::string_view packet, Result& result) {
  result.stop_acknowledging = packet == "QStartNoAckMode";
  return result.stop_acknowledging ? kOk : kUnknown;
}

std::string GdbCommands::transfer(GdbFields fields) {
  const bool features = fields.skip("features:read:target.xml:");
  if (!features && !fields.skip("memory-map:read::")) return kUnknown;
  const auto range = fields.range();
  if (!range) return kMalformed;
  return part_of(features ? target_description() : memory_map_description(target_.memory_map()), *range);
}

/// The commands of OpenOCD that programming environments send, and `time`. gdb only talks to a halted processor, so
/// each leaves it halted.
GdbCommands::Result GdbCommands::monitor(std::string_view command) {
  const auto words = [](const std::string& text) { return to_hex(text + "\n"); };
  if (command == "time") {
    const bus::Tick now = target_.now();
    return {words(fmt::format("simulated time {}.{:09} s", now / bus::kTicksPerSecond,
                              now % bus::kTicksPerSecond / bus::kTicksPerNs))};
  }
  if (command == "reset" || command == "reset halt" || command == "reset init" || command == "reset run") {
    if (!target_.reset()) return {words("the processor cannot be reset")};
    return {words("reset, halted before the first instruction of the reset handler"), Resumption::kReset};
  }
  if (command == "halt") return {words(fmt::format("halted at 0x{:08x}", target_.read_register(Register::kPc)))};
  if (GdbFields fields(command); fields.skip("sleep ") || fields.skip("delay "))
    return {words("no wait: simulated time stands still while the processor is halted")};
  return {words(
      fmt::format("monitor {}: expected time, reset, reset halt, reset init, reset run, halt, sleep MS", command))};
}

std::string GdbCommands::read_register(GdbFields fields) const {
  const auto number = fields.number();
  if (!number || *number >= kRegisterCount) return kMalformed;
  return register_text(target_.read_register(static_cast<Register>(*number)));
}

std::string GdbCommands::write_register(GdbFields fields) {
  const auto number = fields.number();
  if (!number || *number >= kRegisterCount || !fields.skip("=")) return kMalformed;
  const auto value = register_value(fields.rest());
  if (!value) return kMalformed;
  write(static_cast<Register>(*number), *value);
  return kOk;
}

void GdbCommands::write(Register which, std::uint32_t value) {
  target_.write_register(which, which == Register::kPc ? value & ~1U : value);
}

std::string GdbCommands::read_registers() const {
  std::string text;
  for (unsigned i = 0; i < kRegisterCount; ++i) text += register_text(target_.read_register(static_cast<Register>(i)));
  return text;
}

std::string GdbCommands::write_registers(std::string_view digits) {
  std::vector<std::uint32_t> values;
  for (; !digits.empty(); digits.remove_prefix(std::min<std::size_t>(8, digits.size()))) {
    const auto value = register_value(digits.substr(0, 8));
    if (!value || values.size() == kRegisterCount) return kMalformed;
    values.push_back(*value);
  }
  // Only what is changed: sp is msp or psp, the one that is unchanged must not overwrite the other.
  for (unsigned i = 0; i < values.size(); ++i) {
    const auto which = static_cast<Register>(i);
    if (target_.read_register(which) != values[i]) write(which, values[i]);
  }
  return kOk;
}

std::string GdbCommands::read_memory(GdbFields fields) const {
  const auto range = fields.range();
  if (!range) return kMalformed;
  std::vector<std::uint8_t> bytes(std::min<std::size_t>(range->size, kGdbPacketSize / 2));
  const std::size_t count = target_.read_memory(range->address, bytes.data(), bytes.size());
  return count == 0 && !bytes.empty() ? kCannotAccess : to_hex(bytes.data(), count);
}

std::string GdbCommands::write_memory(GdbFields fields, bool binary) {
  const auto range = fields.range();
  if (!range || !fields.skip(":")) return kMalformed;
  const auto bytes = binary ? gdb_unescape(fields.rest()) : from_hex(fields.rest());
  if (!bytes || bytes->size() != range->size) return kMalformed;
  if (bytes->empty()) return kOk;  // how gdb asks whether X is known
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes->data());
  return target_.write_memory(range->address, data, bytes->size()) ? kOk : kCannotAccess;
}

std::string GdbCommands::change_stop(GdbFields fields, bool insert) {
  const auto type = fields.number();
  if (!type || !fields.skip(",")) return kMalformed;
  const auto range = fields.range();
  if (!range) return kMalformed;
  if (*type > 4) return kUnknown;
  if (*type >= 2) return change_watchpoint({static_cast<Watchpoint::Kind>(*type), range->address, range->size}, insert);
  // Software and hardware breakpoints are the same: no instruction is replaced.
  if (insert)
    breakpoints_.add(range->address);
  else
    breakpoints_.remove(range->address);
  return kOk;
}

std::string GdbCommands::change_watchpoint(const Watchpoint& point, bool insert) {
  if (point.size == 0) return kMalformed;
  if (insert && !target_.report_data_accesses(true)) return kUnknown;
  if (insert)
    watchpoints_.add(point);
  else
    watchpoints_.remove(point);
  if (watchpoints_.empty()) target_.report_data_accesses(false);
  return kOk;
}

GdbCommands::Result GdbCommands::verbose(GdbFields fields) {
  if (fields.skip("Cont?")) return {"vCont;c;C;s;S;r"};
  if (fields.skip("Cont;")) return resume(fields);
  if (fields.skip("Kill;")) return kill(true);
  if (fields.skip("Run;")) return run_again();
  if (fields.skip("Flash")) return flash(fields);
  return {kUnknown};
}

GdbCommands::Result GdbCommands::kill(bool replies) {
  const auto reply = replies ? std::optional<std::string>(kOk) : std::nullopt;
  if (!extended_) return {reply, Resumption::kKill};
  killed_ = true;
  return {reply};
}

/// Of any program and with any arguments: a board has one.
GdbCommands::Result GdbCommands::run_again() {
  if (!target_.reset()) return {kMalformed};
  killed_ = false;
  return {std::nullopt, Resumption::kReset};
}

GdbCommands::Result GdbCommands::flash(GdbFields fields) {
  FlashLoader::Refusal refusal;
  if (fields.skip("Erase:")) {
    const auto range = fields.range();
    if (!range) return {kMalformed};
    refusal = flash_.erase(range->address, range->size);
  } else if (fields.skip("Write:")) {
    const auto address = fields.number();
    if (!address || !fields.skip(":")) return {kMalformed};
    refusal = flash_.write(*address, gdb_unescape(fields.rest()));
  } else {
    return fields.rest() == "Done" ? loaded() : Result{kUnknown};
  }
  return refusal ? refused(*refusal) : Result{kOk};
}

GdbCommands::Result GdbCommands::loaded() {
  const auto difference = flash_.difference();
  if (!difference) return {kOk};
  if (program_now_ && flash_.holds(program_now_())) return {std::nullopt, Resumption::kBeginAgain};
  return refused(*difference + "; start the run again with this program (--set user_cpu.elf=FILE)");
}

GdbCommands::Result GdbCommands::resume(GdbFields fields) {
  // The first action that is for the thread counts, and there is one thread only. Signals mean nothing to a Cortex-M3.
  step_range_ = {};
  if (fields.skip("c") || fields.skip("C")) return {std::nullopt, Resumption::kContinue};
  if (fields.skip("s") || fields.skip("S")) return {std::nullopt, Resumption::kStep};
  if (!fields.skip("r")) return {kMalformed};
  const auto range = fields.range();
  if (!range) return {kMalformed};
  step_range_ = {range->address, range->size};
  return {std::nullopt, Resumption::kStep};
}

GdbCommands::Result GdbCommands::resume_at(GdbFields fields, Resumption resumption) {
  step_range_ = {};
  if (const auto pc = fields.number())
    write(Register::kPc, *pc);
  else if (!fields.rest().empty())
    return {kMalformed};
  return {std::nullopt, resumption};
}

}  // namespace dsdpv1::arm
