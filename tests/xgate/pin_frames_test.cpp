// Frames of host and module as the pins show them, without a module.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "kinds/xgate/frame_words.hpp"
#include "kinds/xgate/pin_frames.hpp"
#include "kinds/xgate/pins.hpp"

namespace dsdpv1::xgate {
namespace {

using testing::ElementsAre;

bus::Bytes frame(std::uint8_t command, const bus::Bytes& data, std::uint8_t special = 0x11) {
  Frame whole;
  whole.command = command;
  whole.special = special;
  if (!data.empty()) whole.data.assign(data.data(), static_cast<int>(data.size()));
  Wire wire;
  compose(whole, wire);
  return {wire.bytes.data(), wire.bytes.data() + wire.size};
}

class Seen : public PinFrames {
 public:
  using Tick = bus::Tick;

  explicit Seen(const Config& config) : PinFrames(config, 0) {
    pin(0, kit::kReset, 0);
    pin(10, kit::kReset, 1);
    now = bus::kTicksPerMs * 20;
  }
  void send(bool answer, const bus::Bytes& bytes, std::uint32_t rate = 115'200) {
    const UartTelegram telegram(bytes, uart_timing(rate));
    for (std::size_t edge = 0; edge < telegram.size(); ++edge)
      pin(now + telegram[edge].at, answer ? kHostTxd : kHostRxd, telegram[edge].level ? 1 : 0);
    wait(telegram.duration() + bus::kTicksPerUs);
  }
  void wait(Tick time) {
    now += time;
    run(now);
  }
  std::vector<std::string> words;
  Tick now = 0;

 private:
  void frame(const HostFrame& frame) override {
    const std::string text =
        frame.bytes[0] == kFrameStart ? words_of(frame.frame, config().mailboxes, frame.asked) : "";
    words.push_back((frame.answer ? "< " : "> ") + text + (frame.wrong.empty() ? "" : " (" + frame.wrong + ")"));
  }
};

TEST(XgatePinFrames, CommandsAndAnswers) {
  Seen seen{Config()};
  seen.send(false, frame(0x20, {1, 2, 3}));
  seen.send(true, frame(0x21, {4, 5, 6}, 0x51));
  seen.send(false, frame(0x21, {}, 0x51));
  seen.send(true, frame(0x21, {4, 5, 6}));
  seen.send(false, frame(0x30, {2, 4, 0, 0x51, 1, 2, 0, 0x52, 1, 4, 0, 0xDE, 0x80, 0xB0, 0, 0xEE}));
  seen.send(true, frame(0x30, {4, 2, 0}, 0x91));
  EXPECT_THAT(
      seen.words,
      ElementsAre("> 20 exchange, 3 bytes", "< 21 outputs, new user parameters, 3 bytes, alarm acknowledged",
                  "> 21 exchange, user parameters known, 0 bytes, acknowledgement known", "< 21 outputs, 3 bytes",
                  "> 30 answers: id 2, transport slot 1 index 2 length 0: id 1, DE refused B0 00",
                  "< 30 error 4/2: parameter of the command"));
}

TEST(XgatePinFrames, WhatIsWrongWithThem) {
  Seen seen{Config()};
  bus::Bytes damaged = frame(0x20, {1});
  damaged.back() ^= 1;
  seen.send(false, damaged);
  seen.send(false, frame(0x12, {0}));
  seen.send(true, frame(0x20, {2, 4, 0}, 0x91));
  seen.send(true, frame(0x20, {1}));
  seen.send(false, {0x7E, 0x20, 3});
  seen.wait(bus::kTicksPerMs * 3);
  seen.send(true, damaged);
  seen.send(false, {1, 2});
  seen.send(false, frame(0x24, {}));
  EXPECT_THAT(seen.words, ElementsAre("> 20 exchange, 1 bytes (wrong XOR)",
                                      "> 12 set mode, 1 bytes (not heard: the last command has no answer yet)",
                                      "< 20 error 2/4: XOR", "< 20 outputs, 1 bytes (nobody has asked)",
                                      "> 20 exchange, 0 bytes (cut after 3 bytes)", "< 20 outputs, 1 bytes (wrong XOR)",
                                      ">  (no frame)", "> 24 read lengths, 0 bytes"));
}

TEST(XgatePinFrames, PrintedErrorsAnd131Outputs) {
  Config config;
  config.errors = ErrorForm::kPrinted;
  Seen seen{config};
  Wire wire;
  compose_error(0x20, kOneSegment, {3, 1}, ErrorForm::kPrinted, wire);
  seen.send(false, frame(0x20, {}));
  seen.send(true, {wire.bytes.data(), wire.bytes.data() + wire.size});
  seen.send(false, frame(0x20, {}));
  seen.send(true, frame(0x20, bus::Bytes(131, 7)));
  EXPECT_THAT(seen.words, ElementsAre("> 20 exchange, 0 bytes", "< 20 error 3/1: parameters differ",
                                      "> 20 exchange, 0 bytes", "< 20 outputs, 131 bytes"));
}

TEST(XgatePinFrames, FollowResetAndRate) {
  Seen seen{Config()};
  seen.send(false, frame(0x03, {0x00, 0x4B, 0x00}));
  seen.send(true, frame(0x03, {}));
  seen.wait(2 * bus::kTicksPerMs);
  seen.send(false, frame(0x24, {}), 19'200);
  seen.pin(seen.now, kit::kReset, 0);
  seen.wait(bus::kTicksPerMs);
  seen.pin(seen.now, kit::kReset, 1);
  seen.send(false, frame(0x24, {}));
  seen.wait(12 * bus::kTicksPerMs);
  seen.send(false, frame(0x24, {}));
  EXPECT_THAT(seen.words, ElementsAre("> 03 set rate, 3 bytes", "< 03 set rate, 0 bytes", "> 24 read lengths, 0 bytes",
                                      "> 24 read lengths, 0 bytes (not heard: the firmware has not started)",
                                      "> 24 read lengths, 0 bytes"));
}

}  // namespace
}  // namespace dsdpv1::xgate
