// The user's last access or telegram in words, from the pins alone.
#include <gtest/gtest.h>

#include "kinds/dsdpv1/port/last_access.hpp"
#include "kinds/dsdpv1/rtl/access_watch.hpp"
#include "model/dsdpv1/serial_host.hpp"

namespace dsdpv1 {
namespace {

const std::vector<std::uint8_t> kRead = {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF};

/// Up to an edge, all if there are fewer.
template <class Edges>
void play(tb::LastAccess& access, Tick begin, const Edges& edges, std::size_t count = 1'000'000) {
  for (std::size_t i = 0; i < std::min(count, edges.size()); ++i)
    if (edges[i].pin != Pin::kMiso) access.pin(begin + edges[i].at, number(edges[i].pin), edges[i].level ? 1 : 0);
}

TEST(LastTelegram, OfSpiIsItsFrameSoFar) {
  tb::LastAccess access;
  EXPECT_EQ(access.words(), "none");
  const SpiFrame frame(kRead, SpiTiming());
  play(access, 250'000, frame);
  EXPECT_EQ(access.words(), "SPI frame of 6 bytes from cycle 1000 (20.833 us): 01 00 14 01 18 CF");
  play(access, 500'000, frame, 2 + 4 * 12);
  EXPECT_EQ(access.words(), "SPI frame of 1 byte from cycle 2000 (41.667 us): 01") << "four bits of the next";
  play(access, 750'000, SpiFrame(std::vector<std::uint8_t>(300, 0xA5), SpiTiming()));
  EXPECT_EQ(access.words(),
            "SPI frame of 300 bytes from cycle 3000 (62.500 us): A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 A5 ...");
}

TEST(LastTelegram, OfTheUartIsThatAfterTheLastSilence) {
  tb::LastAccess access;
  access.pin(0, number(Pin::kUbr), 7);
  const UartTelegram telegram(kRead, UartTiming());
  play(access, 250'000, telegram);
  EXPECT_EQ(access.words(), "UART telegram of 6 bytes from cycle 1000 (20.833 us): 01 00 14 01 18 CF");
  play(access, 250'000 + telegram.duration() + 3 * 11 * 6500, telegram);
  EXPECT_EQ(access.words(),
            "UART telegram of 12 bytes from cycle 1000 (20.833 us): 01 00 14 01 18 CF 01 00 14 01 18 CF");
  play(access, 2'500'000, telegram);
  EXPECT_EQ(access.words(), "UART telegram of 6 bytes from cycle 10000 (208.333 us): 01 00 14 01 18 CF");
}

TEST(LastTelegram, TheFirstOfARunIsNoted) {
  cosim::AccessWatch watch(Part::kRsu);
  const SpiFrame frame(kRead, SpiTiming());
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame[i].pin != Pin::kMiso) watch.change(250'000 + frame[i].at, number(frame[i].pin), frame[i].level ? 1 : 0);
  EXPECT_EQ(watch.last_of_user(), "SPI frame of 6 bytes from cycle 1000 (20.833 us): 01 00 14 01 18 CF");
}

TEST(LastTelegram, AnAccessAfterItIsTheLast) {
  tb::LastAccess access;
  play(access, 250'000, SpiFrame(kRead, SpiTiming()));
  access.pin(500'000, number(Pin::kA), 0x410);
  access.pin(500'000, number(Pin::kCsr), 0);
  access.pin(500'000, number(Pin::kRd), 0);
  EXPECT_EQ(access.words(), "read B410 at cycle 2000 (41.667 us)");
}

}  // namespace
}  // namespace dsdpv1
