#include "tb/bench/capture_recorder.hpp"

#include <utility>

#include "bus/baud.hpp"

namespace dsdpv1::tb {

CaptureRecorder::CaptureRecorder(const CaptureRequest& request, int baud, Tick from)
    : file_(request.path),
      writer_({request.link, request.application, baud},
              [this](std::string_view bytes) {
                file_.write(bytes);
                anything_ = true;
              }),
      collector_([this, from](const bus::capture::CapturedTelegram& telegram) {
        if (telegram.start >= from) writer_.telegram(telegram);
      }),
      baud_(baud) {}

void CaptureRecorder::telegram(const HeardTelegram& telegram) {
  baud_ = telegram.telegram.baud;
  collector_.telegram(telegram.telegram);
}

/// After the slot time, which is longer than T_SYN, no answer can be missing any more, nor more bytes belong to it.
void CaptureRecorder::follow(Tick now) {
  const bus::Baud& rate = bus::baud(baud_);
  collector_.finish_before(now - rate.slot_bits * rate.bit);
  if (std::exchange(anything_, false)) file_.flush();
}

void CaptureRecorder::finish() {
  collector_.finish();
  file_.commit();
}

}  // namespace dsdpv1::tb
