// decode: telegrams byte by byte, from whatever holds them. What it is, is known by how it begins.
#include <fmt/format.h>

#include <iostream>
#include <string>

#include "apps/command_line.hpp"
#include "apps/commands/capture_file.hpp"
#include "apps/commands/telegram_files.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "bus/baud.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram_printer.hpp"
#include "io/input/input_error.hpp"
#include "tb/bench/run_log.hpp"

namespace dsdpv1::app {
namespace {

namespace capture = bus::capture;

/// The telegrams of a capture, as those of a text are printed.
class CapturePrinter {
 public:
  /// `packets`: the telegrams are packets of a file, and numbered as such.
  CapturePrinter(bool packets, const DecodeArguments& arguments)
      : packets_(packets), quiet_(arguments.quiet), files_(arguments.table, arguments.json) {}

  void take(const capture::CapturedTelegram& telegram) {
    ++count_;
    const bus::Decoded decoded = bus::decode(telegram.bytes);
    const std::string why = telegram.bytes.empty() ? "no character" : what_is_wrong(telegram, decoded);
    files_.take(telegram, decoded, why);
    if (!why.empty()) right_ = false;
    if (!quiet_) print(telegram, decoded, why);
  }

  int finish() {
    files_.finish();
    if (count_ == 0 && !quiet_) std::cout << "no telegram\n";
    return right_ && count_ > 0 ? kPassed : kFailed;
  }

 private:
  void print(const capture::CapturedTelegram& telegram, const bus::Decoded& decoded, const std::string& why) {
    const std::string at = tb::nanoseconds(telegram.start) + " ns";
    const std::string where = packets_ ? fmt::format("packet {}, {}", count_, at) : at;
    if (telegram.bytes.empty())
      printer_.garbage(where, {});
    else if (why.empty())
      printer_.right(where, decoded);
    else
      printer_.wrong(where, why, decoded, telegram.bytes);
    for (const std::string& remark : telegram.remarks) std::cout << "        " << bus::printable(remark) << "\n";
  }

  /// Empty for a right telegram.
  static std::string what_is_wrong(const capture::CapturedTelegram& telegram, const bus::Decoded& decoded) {
    std::string why;
    if (decoded.error != bus::DecodeError::kNone)
      why = bus::describe(decoded.error);
    else if (decoded.bytes.size() < telegram.bytes.size())
      why = "more bytes than one telegram has";
    const std::string damage = capture::damage_words(telegram.damage & capture::damage::kCharacter);
    return damage.empty() ? why : why.empty() ? damage : damage + ", " + why;
  }

  bus::TelegramPrinter printer_{std::cout};
  bool packets_, quiet_, right_ = true;
  TelegramFiles files_;
  std::uint64_t count_ = 0;
};

capture::LogicSettings logic_settings(const DecodeArguments& arguments) {
  capture::LogicSettings settings;
  settings.signal = arguments.signal;
  settings.inverted = arguments.inverted;
  if (!arguments.baud.empty()) settings.baud = baud_index("decode: --baud", arguments.baud);
  return settings;
}

void say_source(const capture::LogicSource& source) {
  std::cout << fmt::format("signal {} at {}\n", bus::printable(source.signal), bus::baud(source.baud).name);
}

int decode_text(std::istream& in, const std::string& name) {
  std::string error;
  const int status = bus::decode_text(in, name, std::cout, error);
  if (!error.empty()) throw tb::InputError(error);
  return status;
}

int decode_capture(CaptureFile& file, const DecodeArguments& arguments) {
  leave_nothing_on_signals();
  check_outputs("dsdpv1-sim decode", {{"the capture", file.path()}},
                {{"--table", arguments.table}, {"--json", arguments.json}});
  CapturePrinter printer(file.packets(), arguments);
  const auto source = file.read(logic_settings(arguments),
                                [&printer](const capture::CapturedTelegram& telegram) { printer.take(telegram); });
  if (source && !arguments.quiet) say_source(*source);
  return printer.finish();
}

}  // namespace

int decode(const DecodeArguments& arguments) {
  CaptureFile file(arguments.file);
  const bool wants_files = !arguments.table.empty() || !arguments.json.empty() || arguments.quiet;
  if (file.form() == CaptureForm::kText && wants_files)
    throw tb::InputError(file.name(), 0,
                         "is text, allowed with --table, --json and --quiet are captures and recordings of the line");
  if (file.form() == CaptureForm::kText) return decode_text(file.stream(), file.name());
  return decode_capture(file, arguments);
}

}  // namespace dsdpv1::app
