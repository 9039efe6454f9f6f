#include "kinds/xgate/frame_reader.hpp"

#include "kinds/xgate/frame_words.hpp"

namespace dsdpv1::xgate {

void FrameReader::frame(const HostFrame& frame) {
  const bool named = frame.bytes[0] == kFrameStart && frame.bytes.size() > 1;
  tell({frame.start, frame.end, frame.answer,
        named ? words_of(frame.frame, config().mailboxes, frame.asked) : std::string("no frame"), frame.bytes,
        frame.wrong});
}

}  // namespace dsdpv1::xgate
