#include "apps/commands/capture_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "apps/commands/wave_line.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "bus/capture/sigrok_reader.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1::app {
namespace {

namespace capture = bus::capture;

constexpr std::size_t kLongestArchive = 64U << 20U;

std::ifstream open_file(const std::string& path) {
  const bool folder = std::filesystem::is_directory(path);
  std::ifstream file(path, std::ios::binary);
  if (folder || !file)
    throw tb::InputError(path, 0,
                         tb::what_is_wrong(folder ? EISDIR : errno) +
                             ", allowed is a file of telegrams: hexadecimal text, a log, a capture, a recording");
  return file;
}

CaptureForm form_of(std::string_view beginning) {
  if (capture::begins_as_pcapng(beginning)) return CaptureForm::kPcapng;
  if (capture::begins_as_pcap(beginning)) return CaptureForm::kPcap;
  if (capture::begins_as_zip(beginning)) return CaptureForm::kSigrok;
  if (capture::begins_as_csv(beginning)) return CaptureForm::kCsv;
  return begins_as_wave(beginning) ? CaptureForm::kWave : CaptureForm::kText;
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

}  // namespace

CaptureFile::CaptureFile(const std::string& path)
    : standard_input_(path.empty() || path == "-"),
      path_(path),
      name_(standard_input_ ? "standard input" : path),
      file_(standard_input_ ? std::ifstream() : open_file(path)),
      input_(standard_input_ ? std::cin : file_),
      form_(form_of(input_.beginning())) {}

std::optional<capture::LogicSource> CaptureFile::read(const capture::LogicSettings& settings,
                                                      const capture::TakeTelegram& take) {
  try {
    switch (form_) {
      case CaptureForm::kPcapng: capture::read_pcapng(stream(), take); break;
      case CaptureForm::kPcap: capture::read_pcap(stream(), take); break;
      case CaptureForm::kSigrok: return capture::read_sigrok(read_archive(stream()), settings, take);
      case CaptureForm::kCsv: return capture::read_csv(stream(), settings, take);
      case CaptureForm::kWave: return read_wave_line(path_, settings, take);
      case CaptureForm::kText: break;
    }
  } catch (const capture::CaptureError& error) {
    throw tb::InputError(name_, 0, error.what());
  }
  return std::nullopt;
}

Sampling CaptureFile::read_levels(capture::LevelTaker& taker) {
  try {
    switch (form_) {
      case CaptureForm::kSigrok: return {capture::read_sigrok_levels(read_archive(stream()), taker)};
      case CaptureForm::kCsv: return {capture::read_csv_levels(stream(), taker), static_cast<double>(bus::kTicksPerNs)};
      case CaptureForm::kWave: return {{}, read_wave_levels(path_, taker)};
      default: break;
    }
  } catch (const capture::CaptureError& error) {
    throw tb::InputError(name_, 0, error.what());
  }
  throw tb::InputError(name_, 0,
                       "has no levels of pins, allowed are VCD, FST, a session of sigrok, CSV of a logic analyser");
}

}  // namespace dsdpv1::app
