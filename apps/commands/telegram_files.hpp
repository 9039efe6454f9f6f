#pragma once
// decode --table and --json: the telegrams of a capture for programs.
#include <cstdint>
#include <optional>
#include <string>

#include "bus/capture/captured_telegram.hpp"
#include "bus/telegram/telegram.hpp"
#include "io/output/output_file.hpp"

namespace dsdpv1::app {

/// A line for each telegram; nothing is kept.
class TelegramFiles {
 public:
  /// Paths, empty: not wanted. Throws tb::InputError.
  TelegramFiles(const std::string& table, const std::string& json);

  /// `why`: what is wrong with it, empty for a right one.
  void take(const bus::capture::CapturedTelegram& telegram, const bus::Decoded& decoded, const std::string& why);
  /// Throws tb::InputError where something could not be written.
  void finish();

 private:
  std::optional<tb::OutputFile> table_, json_;
  std::uint64_t count_ = 0;
};

}  // namespace dsdpv1::app
