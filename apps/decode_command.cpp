// decode: telegrams byte by byte, from whatever holds them. What it is, is known by how it begins.
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "apps/command_line.hpp"
#include "apps/rewound_input.hpp"
#include "apps/wave_line.hpp"
#include "bus/baud.hpp"
#include "bus/capture/csv_reader.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "bus/capture/sigrok_reader.hpp"
#include "bus/printable.hpp"
#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram_printer.hpp"
#include "tb/bench/run_log.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/read_file.hpp"

namespace app {
namespace {

namespace capture = bus::capture;

constexpr std::size_t kLongestArchive = 64U << 20U;

/// The telegrams of a capture, as those of a text are printed.
class CapturePrinter {
 public:
  /// `packets`: the telegrams are packets of a file, and numbered as such.
  explicit CapturePrinter(bool packets) : packets_(packets) {}

  void take(const capture::CapturedTelegram& telegram) {
    ++count_;
    const std::string at = tb::nanoseconds(telegram.start) + " ns";
    const std::string where = packets_ ? fmt::format("packet {}, {}", count_, at) : at;
    const bus::Decoded decoded = decode(telegram.bytes);
    const std::string why = what_is_wrong(telegram, decoded);
    if (telegram.bytes.empty())
      printer_.garbage(where, {});
    else if (why.empty())
      printer_.right(where, decoded);
    else
      printer_.wrong(where, why, decoded, telegram.bytes);
    for (const std::string& remark : telegram.remarks) std::cout << "        " << bus::printable(remark) << "\n";
  }

  int finish() const {
    if (count_ == 0) std::cout << "no telegram\n";
    return printer_.all_right() ? kPassed : kFailed;
  }

 private:
  static bus::Decoded decode(const bus::Bytes& bytes) {
    bus::TelegramDecoder decoder;
    for (const std::uint8_t byte : bytes)
      if (auto decoded = decoder.feed(byte)) return *decoded;
    return decoder.finish().value_or(bus::Decoded{});
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
  bool packets_;
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

std::string read_archive(std::istream& in) {
  std::string bytes;
  std::array<char, 16'384> piece{};
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    bytes.append(piece.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLongestArchive)
      throw capture::CaptureError(
          fmt::format("is larger than {} MB, allowed is a session of sigrok", kLongestArchive >> 20U));
  }
  return bytes;
}

int decode_text(std::istream& in, const std::string& name) {
  std::string error;
  const int status = bus::decode_text(in, name, std::cout, error);
  if (!error.empty()) throw tb::InputError(error);
  return status;
}

enum class Form : std::uint8_t { kText, kPcapng, kPcap, kSigrok, kCsv, kWave };

Form form_of(std::string_view beginning) {
  if (capture::begins_as_pcapng(beginning)) return Form::kPcapng;
  if (capture::begins_as_pcap(beginning)) return Form::kPcap;
  if (capture::begins_as_zip(beginning)) return Form::kSigrok;
  if (capture::begins_as_csv(beginning)) return Form::kCsv;
  return begins_as_wave(beginning) ? Form::kWave : Form::kText;
}

/// The signal of a recording; nothing for packets.
std::optional<capture::LogicSource> read(Form form, std::istream& in, const DecodeArguments& arguments,
                                         const capture::TakeTelegram& take) {
  const capture::LogicSettings settings = logic_settings(arguments);
  switch (form) {
    case Form::kPcapng: capture::read_pcapng(in, take); return std::nullopt;
    case Form::kPcap: capture::read_pcap(in, take); return std::nullopt;
    case Form::kSigrok: return capture::read_sigrok(read_archive(in), settings, take);
    case Form::kCsv: return capture::read_csv(in, settings, take);
    case Form::kWave: return read_wave_line(arguments.file, settings, take);
    case Form::kText: break;
  }
  return std::nullopt;
}

int decode_stream(std::istream& in, Form form, const std::string& name, const DecodeArguments& arguments) {
  if (form == Form::kText) return decode_text(in, name);
  CapturePrinter printer(form == Form::kPcapng || form == Form::kPcap);
  try {
    const auto source =
        read(form, in, arguments, [&printer](const capture::CapturedTelegram& telegram) { printer.take(telegram); });
    if (source) say_source(*source);
  } catch (const capture::CaptureError& error) {
    throw tb::InputError(name, 0, error.what());
  }
  return printer.finish();
}

}  // namespace

int decode(const DecodeArguments& arguments) {
  const bool standard_input = arguments.file.empty() || arguments.file == "-";
  std::ifstream file;
  if (!standard_input) {
    const bool folder = std::filesystem::is_directory(arguments.file);
    file.open(arguments.file, std::ios::binary);
    if (folder || !file)
      throw tb::InputError(arguments.file, 0,
                           tb::what_is_wrong(folder ? EISDIR : errno) +
                               ", allowed is a file of telegrams: hexadecimal text, a log, a capture, a recording");
  }
  RewoundInput input(standard_input ? std::cin : file);
  return decode_stream(input.stream(), form_of(input.beginning()), standard_input ? "standard input" : arguments.file,
                       arguments);
}

}  // namespace app
