#include "tests/mailbox/kind.hpp"

#include <iterator>
#include <memory>
#include <vector>

#include "tests/mailbox/reasons.hpp"
#include "tests/mailbox/spi_port.hpp"

namespace dsdpv1::mailbox {
namespace {

// --- the firmware ----------------------------------------------------------------------------------------------------

using Bytes = std::vector<std::uint8_t>;

/// It starts the chip once and then, in each period, reads the outputs and writes the inputs.
class Firmware {
 public:
  explicit Firmware(kit::Cpu& cpu)
      : cpu_(cpu), half_(static_cast<const UserSettings&>(cpu.settings()).sck_period / 2) {}

  void run() {
    cpu_.wait(10 * bus::kTicksPerUs);
    Tick turn = cpu_.now();
    const std::uint16_t ident = cpu_.station().ident;
    frame({command::kStart, cpu_.station().address, static_cast<std::uint8_t>(ident >> 8),
           static_cast<std::uint8_t>(ident & 0xFF), 0});
    for (;;) {
      turn = std::max(turn + cpu_.period(), cpu_.now() + 2 * half_);
      cpu_.wait_until(turn);
      exchange();
    }
  }

 private:
  void exchange() {
    Bytes read(kDataFrame, 0);
    read[0] = command::kReadOutputs;
    const bool announced = cpu_.level(kInt) == 0;
    read = frame(read);
    if (announced) cpu_.received({read.begin() + 1, read.end()});
    cpu_.wait(2 * half_);
    Bytes write = cpu_.inputs(kDataBytes);
    write.insert(write.begin(), command::kWriteInputs);
    frame(write);
    cpu_.written();
  }
  /// Returns what MISO has shown.
  Bytes frame(Bytes bytes) {
    cpu_.set(kMosi, static_cast<Level>(bytes[0] >> 7));
    cpu_.set(kXss, 0);
    cpu_.wait(half_);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte(bytes[i], i + 1 < bytes.size() ? bytes[i + 1] : 0);
    cpu_.set(kXss, 1);
    return bytes;
  }
  /// With each fall MOSI has the next bit.
  std::uint8_t byte(unsigned sent, unsigned next) {
    unsigned seen = 0;
    const unsigned both = sent << 8 | next;
    for (int bit = 7; bit >= 0; --bit) {
      seen = seen << 1 | (cpu_.level(kMiso) > 0 ? 1U : 0U);
      cpu_.set(kSck, 1);
      cpu_.wait(half_);
      cpu_.set(kSck, 0);
      cpu_.set(kMosi, static_cast<Level>(both >> (bit + 7) & 1));
      cpu_.wait(half_);
    }
    return static_cast<std::uint8_t>(seen);
  }

  kit::Cpu& cpu_;
  const Tick half_;
};

// --- the parts -------------------------------------------------------------------------------------------------------

// Fixed properties of this chip appear as their value, the others as their place in the start frame.
profibus::Words words() {
  profibus::Words words;
  words.ident = "bytes 2 and 3 of the start frame";
  words.max_io = "8 and 8 bytes, which are fixed,";
  words.max_prm = "0, fixed";
  words.initial_cfg = "17 27, fixed";
  words.input_length = "8, fixed,";
  words.new_block = "INT";
  return words;
}

kit::Parts make_parts() {
  kit::Parts parts{"mailbox", "8-byte mailbox"};
  parts.pins = {{"XSS", kit::kInput, 1},
                {"SCK", kit::kInput, 0},
                {"MOSI", kit::kInput, 0},
                {"MISO", kit::kOutput, kReleased},
                {"INT", kit::kOutput, 1}};
  parts.interrupt = kInt;
  parts.capacities = kCapacities;
  parts.reasons = {kReasonRows, std::size(kReasonRows)};
  parts.words = words();
  parts.port = [](kit::Chip& chip) { return std::make_unique<SpiPort>(chip); };
  parts.program = [](kit::Cpu& cpu) { Firmware(cpu).run(); };
  return parts;
}

class Kind : public kit::Kind {
 public:
  Kind() : kit::Kind(make_parts()) {}

  const tb::keys::Object& user_keys() const override {
    static const tb::keys::ObjectOf<UserSettings> keys = [] {
      tb::keys::ObjectOf<UserSettings> o("user_cpu", "The SPI controller.");
      o.time("sck_period", &UserSettings::sck_period, {500, 1'000'000}, "A period of SCK, high and low alike.");
      return o;
    }();
    return keys;
  }
  std::unique_ptr<tb::OwnSettings> make_user_settings() const override { return std::make_unique<UserSettings>(); }
};

}  // namespace

const kit::Kind& kind() {
  static const Kind kind;
  return kind;
}

}  // namespace dsdpv1::mailbox
