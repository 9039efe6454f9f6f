// The timing diagrams of the DSDPV1: the edges between which they measure (P5, P9, P11, table 15, figure 5).
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "kinds/dsdpv1/pins/diagrams.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/report/html/diagram_watch.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;

const tb::TimingDiagram& diagram(std::string_view id) {
  const auto& all = tb::dsdpv1_timing_diagrams();
  return *std::find_if(all.begin(), all.end(), [id](const tb::TimingDiagram& each) { return each.id == id; });
}

/// One diagram over pins that the test moves. Ticks of 1/12 ns; a cycle of CLK is 250.
class Watched {
 public:
  explicit Watched(const char* id)
      : diagram_(diagram(id)), watch_(diagram_, std::vector<tb::html::SpanLimits>(diagram_.spans.size()), memory_) {
    for (const Pin high : {Pin::kCsr, Pin::kRd, Pin::kWr, Pin::kIntr0}) memory_.begin(number(high), 1);
    memory_.begin(number(Pin::kDOut), dsdpv1::kLevelZ);
  }
  void set(Tick at, Pin pin, tb::Level level) {
    memory_.add(at, number(pin), level);
    watch_.pin(at, number(pin), level);
  }
  void sampled(Tick at) { watch_.read(at); }
  std::uint64_t instances() {
    watch_.finish();
    return watch_.instances();
  }
  /// The span of the last kept instance, from start to end.
  tb::html::MeasuredSpan span(std::string_view name) {
    watch_.finish();
    if (!watch_.worst()) return {};
    for (std::size_t i = 0; i < diagram_.spans.size(); ++i)
      if (diagram_.spans[i].name == name) return watch_.worst()->instance.spans[i];
    return {};
  }
  std::optional<Tick> measured(std::string_view name) {
    const tb::html::MeasuredSpan found = span(name);
    return found.seen() ? std::optional<Tick>(found.measured()) : std::nullopt;
  }

 private:
  static tb::PinNumber number(Pin pin) { return static_cast<tb::PinNumber>(pin); }

  const tb::TimingDiagram& diagram_;
  tb::html::PinMemory memory_{32};
  tb::html::DiagramWatch watch_;
};

/// CSR falls 100 ticks after RD, which rises at 11500; the chip samples A at 10500 and drives 0x42 from 10625 on.
void read_with_late_csr(Watched& watched) {
  watched.set(9'000, Pin::kA, 0x123);
  watched.set(10'200, Pin::kRd, 0);
  watched.set(10'300, Pin::kCsr, 0);
  watched.set(10'300, Pin::kDOut, dsdpv1::kLevelX);
  watched.set(10'625, Pin::kDOut, 0x42);
  watched.sampled(11'200);
}

TEST(Dsdpv1Diagrams, ReadBeginsWhereBothRdAndCsrAreLow) {
  Watched watched("read");
  read_with_late_csr(watched);
  watched.set(11'500, Pin::kRd, 1);
  watched.set(11'500, Pin::kDOut, dsdpv1::kLevelZ);
  EXPECT_EQ(watched.span("Tw").from, 10'300);
  EXPECT_EQ(watched.span("Tw").to, 11'200);
  EXPECT_EQ(watched.measured("Tc"), 1'300);
  EXPECT_EQ(watched.measured("RD to the chip's data"), 325);
}

TEST(Dsdpv1Diagrams, ReadEndsWithCsrToo) {
  Watched watched("read");
  read_with_late_csr(watched);
  watched.set(11'400, Pin::kCsr, 1);
  watched.set(11'500, Pin::kRd, 1);
  EXPECT_EQ(watched.instances(), 1U);
  EXPECT_EQ(watched.measured("Tw"), 900);
}

TEST(Dsdpv1Diagrams, ReadThatBringsNothingHasNoDataOfTheChip) {
  Watched watched("read");
  watched.set(5'000, Pin::kDOut, 0x11);
  watched.set(5'500, Pin::kDOut, dsdpv1::kLevelZ);
  watched.set(10'200, Pin::kCsr, 0);
  watched.set(10'300, Pin::kRd, 0);
  watched.set(10'300, Pin::kDOut, dsdpv1::kLevelX);
  watched.set(11'500, Pin::kRd, 1);
  EXPECT_FALSE(watched.span("RD to the chip's data").seen());
}

TEST(Dsdpv1Diagrams, TcCountsFromTheLastChangeOfABeforeTheChipSamplesIt) {
  Watched after("read");
  read_with_late_csr(after);
  after.set(10'500, Pin::kA, 0x7FF);  // P5: sampled at that edge
  after.set(11'500, Pin::kRd, 1);
  EXPECT_EQ(after.measured("Tc"), 1'300);
  Watched before("read");
  read_with_late_csr(before);
  before.set(10'499, Pin::kA, 0x7FF);
  before.set(11'500, Pin::kRd, 1);
  EXPECT_EQ(before.measured("Tc"), -199) << "P11";
}

TEST(Dsdpv1Diagrams, StrobesWithoutCsrAreOfOthers) {
  Watched read("read"), write("write");
  for (Watched* watched : {&read, &write}) {
    for (const Pin strobe : {Pin::kRd, Pin::kWr}) {
      watched->set(10'000, strobe, 0);
      watched->set(10'500, strobe, 1);
    }
    EXPECT_EQ(watched->instances(), 0U);
  }
}

TEST(Dsdpv1Diagrams, WriteMayEndTogetherWithCsr) {
  Watched write("write");
  write.set(10'000, Pin::kCsr, 0);
  write.set(10'100, Pin::kWr, 0);
  write.set(10'500, Pin::kCsr, 1);
  write.set(10'500, Pin::kWr, 1);
  EXPECT_EQ(write.instances(), 1U);
  EXPECT_EQ(write.measured("Ts"), 400);
}

TEST(Dsdpv1Diagrams, OwnershipIsMeasuredToAndFromAccessesOfThisChip) {
  Watched take("take");
  take.set(10'000, Pin::kRReq, 1);
  take.set(12'000, Pin::kRSta, 1);
  take.set(13'000, Pin::kRd, 0);  // of another chip on the same bus
  take.set(13'500, Pin::kRd, 1);
  take.set(14'000, Pin::kCsr, 0);
  take.set(14'100, Pin::kRd, 0);
  EXPECT_EQ(take.measured("ownership to first access"), 2'100);
  Watched back("give_back");
  back.set(10'000, Pin::kRReq, 1);
  back.set(10'000, Pin::kRSta, 1);
  back.set(14'000, Pin::kCsr, 0);
  back.set(14'100, Pin::kWr, 0);
  back.set(14'500, Pin::kWr, 1);
  back.set(14'600, Pin::kCsr, 1);
  back.set(15'000, Pin::kWr, 0);  // of another chip
  back.set(15'500, Pin::kWr, 1);
  back.set(16'000, Pin::kRReq, 0);
  back.set(16'000, Pin::kRSta, 0);
  EXPECT_EQ(back.instances(), 1U);
  EXPECT_EQ(back.measured("last access to release"), 1'500);
}

TEST(Dsdpv1Diagrams, ReleaseIsCompleteWithTheLaterFall) {
  for (const bool sta_first : {true, false}) {
    Watched back("give_back");
    back.set(10'000, Pin::kRReq, 1);
    back.set(10'000, Pin::kRSta, 1);
    back.set(16'000, sta_first ? Pin::kRSta : Pin::kRReq, 0);
    back.set(17'000, sta_first ? Pin::kRReq : Pin::kRSta, 0);
    back.set(17'500, Pin::kLReq, 1);
    EXPECT_EQ(back.measured("both low to the chip's request"), 500) << "H1";
  }
  Watched together("give_back");
  together.set(10'000, Pin::kRReq, 1);
  together.set(10'000, Pin::kRSta, 1);
  together.set(16'000, Pin::kRReq, 0);
  together.set(16'000, Pin::kRSta, 0);
  together.set(16'500, Pin::kLReq, 1);
  EXPECT_EQ(together.instances(), 1U);
  EXPECT_EQ(together.measured("both low to the chip's request"), 500);
}

TEST(Dsdpv1Diagrams, Intr0IsServedByAReadOfB00eInThisChip) {
  Watched watched("intr0");
  watched.set(10'000, Pin::kIntr0, 0);
  watched.set(26'000, Pin::kIntr0, 1);
  watched.set(30'000, Pin::kRReq, 1);
  watched.set(31'000, Pin::kA, 0x00E);
  watched.set(31'500, Pin::kRd, 0);
  watched.set(32'000, Pin::kRd, 1);
  watched.set(33'000, Pin::kRd, 0);
  watched.set(33'100, Pin::kCsr, 0);
  EXPECT_EQ(watched.measured("INTR0 to the read of B00E"), 23'100);
  EXPECT_EQ(watched.measured("Tb, INTR0 low"), 16'000);
}

}  // namespace
}  // namespace dsdpv1
