#include "tb/bench/capture_recorder.hpp"

namespace dsdpv1::tb {

CaptureRecorder::CaptureRecorder(const CaptureRequest& request, int baud, Tick from)
    : file_(request.path),
      writer_({request.link, request.application, baud}, [this](std::string_view bytes) { file_.write(bytes); }),
      collector_([this, from](const bus::capture::CapturedTelegram& telegram) {
        if (telegram.start >= from) writer_.telegram(telegram);
      }),
      baud_(baud) {}

void CaptureRecorder::telegram(const HeardTelegram& telegram) {
  baud_ = telegram.telegram.baud;
  collector_.telegram(telegram.telegram);
}

void CaptureRecorder::finish() {
  collector_.finish();
  file_.commit();
}

}  // namespace dsdpv1::tb
