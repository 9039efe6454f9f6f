#pragma once
// The telegrams of a run as a pcapng file (docs/captures.md).
#include <cstdint>
#include <string>

#include "bus/capture/collector.hpp"
#include "bus/capture/pcapng_writer.hpp"
#include "io/output/output_file.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb {

struct CaptureRequest {
  std::string path;  ///< empty: none
  std::uint16_t link = 257;
  std::string application;
};

class CaptureRecorder : public Observer {
 public:
  /// `baud`: rate of the line at the start. Telegrams that begin before `from` are skipped. Throws InputError if the
  /// file cannot be created.
  CaptureRecorder(const CaptureRequest& request, int baud, Tick from);

  void telegram(const HeardTelegram& telegram) override;
  void flag(const bus::Flag& flag) override { collector_.flagged(flag); }
  void skipped(const bus::ReceivedCharacter& character) override { collector_.skipped(character, baud_); }
  void save() { file_.flush(); }
  /// For a run in real time: the file gets all telegrams that are certainly complete at `now`.
  void follow(Tick now);
  void mute() { file_.mute(); }
  bool failed() const { return file_.failed(); }
  void check() const { file_.check(); }
  /// Writes the last telegram and gives the file its name.
  void finish();

 private:
  OutputFile file_;
  bus::capture::PcapngWriter writer_;
  bus::capture::Collector collector_;
  int baud_;
  bool anything_ = true;  ///< written since the last flush
};

}  // namespace dsdpv1::tb
