// Bytes of a host at a socket of `serve`, in pieces and with pauses: assembled to telegrams, sent on the segment,
// received by a monitor, and sometimes answered by another station. No byte may be lost, added or changed.
#include "bus/monitor/monitor.hpp"
#include "bus/telegram/telegram.hpp"
#include "tb/serve/framing.hpp"
#include "tb/serve/host_line.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {
namespace {

using tb::serve::Intake;

class Host {
 public:
  explicit Host(int baud) : line_(segment_, baud) {
    other_.set_timing(bus::baud(baud).bit);
    monitor_.set_baud(baud);
    timeline_.add(monitor_);
    timeline_.add(line_);
  }

  void write(const bus::Bytes& bytes) {
    written_.insert(written_.end(), bytes.begin(), bytes.end());
    intake_.take(bytes, now_);
    take_out();
  }
  void wait(std::chrono::microseconds time) {
    now_ += time;
    take_out();
    timeline_.run_until(timeline_.now() + time.count() * bus::kTicksPerUs);
    line_.take_heard(timeline_.now(), time.count() % 2 == 0);
  }
  /// Another station sends, whatever is on the line.
  void disturb(const bus::Bytes& bytes) {
    other_.send(timeline_.now(), bytes);
    while (other_.busy()) {
      timeline_.run_until(other_.next());
      other_.run(timeline_.now());
    }
  }
  /// Hangs up: bytes not passed on yet are dropped.
  void hang_up() {
    written_.resize(written_.size() - intake_.size());
    intake_.clear();
    line_.forget();
  }
  void finish() {
    wait(std::chrono::duration_cast<std::chrono::microseconds>(Intake::kMostPatience));
    fuzz::promise(!intake_.holding(), "what was begun is given up in the end");
    fuzz::promise(handed_over_ == written_, "the bytes are handed over as they were written");
    fuzz::promise(line_.statistics().sent_bytes + line_.waiting_bytes() == handed_over_.size(),
                  "each byte is sent once");
  }

 private:
  void take_out() {
    while (std::optional<tb::serve::Taken> telegram = intake_.next(now_)) {
      bus::Bytes& bytes = telegram->bytes;
      fuzz::promise(!bytes.empty(), "no telegram is empty");
      handed_over_.insert(handed_over_.end(), bytes.begin(), bytes.end());
      line_.send(timeline_.now(), std::move(bytes));
    }
    fuzz::promise(!intake_.holding() || intake_.give_up_at() > now_, "what is held back is not due");
    fuzz::promise(intake_.size() < tb::serve::kLongestTelegram, "at most one telegram is held back");
  }

  bus::Timeline timeline_;
  bus::Segment segment_;
  bus::UartSender other_{segment_, segment_.attach("other", nullptr)};
  bus::Monitor monitor_{segment_};
  tb::serve::HostLine line_;
  Intake intake_;
  tb::serve::WallTime now_{std::chrono::seconds(1)};
  bus::Bytes written_, handed_over_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Host host(static_cast<int>(input.below(bus::kBaudCount)));
  while (!input.empty()) {
    switch (const std::uint8_t what = input.byte(); what % 8) {
      case 0: host.wait(std::chrono::microseconds(input.number(2))); break;
      case 1: host.disturb(input.bytes(1 + input.below(16))); break;
      case 2: host.hang_up(); break;
      case 3: host.write(bus::encode(bus::make_telegram(what / 8, input.byte() & 0x7F, input.byte()))); break;
      default: host.write(input.bytes(1 + what / 8)); break;
    }
  }
  host.finish();
  return 0;
}

}  // namespace dsdpv1
