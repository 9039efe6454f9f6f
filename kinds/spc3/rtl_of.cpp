#include "kinds/spc3/rtl_of.hpp"

#include "kinds/spc3/kind.hpp"
#include "kinds/spc3/settings.hpp"
#include "model/spc3/pins.hpp"

namespace dsdpv1::cosim {
namespace {

using spc3::Pin;

/// The RAM is not compared: RTL of the user's shows it at its pins only.
class AccessesAlone : public MemoryWatch {
 public:
  void change(Tick at, PinNumber pin, Level level) override { reader_->pin(at, pin, level); }
  std::optional<Tick> take_end() override { return std::nullopt; }
  bool worth_a_look(Tick /*end*/) override { return false; }
  void compared(Tick /*end*/) override {}
  std::string last_of_user() const override { return reader_->words(); }
  std::string last_of_chip() const override { return "not compared"; }

 private:
  std::unique_ptr<tb::AccessReader> reader_ = tb::kind_of(spc3::Variant::kApc3).make_access_reader();
};

class Spc3Rtl : public RtlOf {
 public:
  std::vector<RtlParameter> parameters(const tb::OwnSettings& chip) const override {
    const spc3::Config& config = static_cast<const tb::Spc3Settings&>(chip);
    const spc3::Config usual;
    std::vector<RtlParameter> rows;
#define SPC3_PARAMETER(name, ...) rows.push_back({#name, {config.name}, 32, config.name == usual.name});
#include "model/spc3/parameters.inc"
    return rows;
  }
  /// The strobes act at their own tick (A16, A42).
  RtlTiming timing(const tb::OwnSettings& /*chip*/) const override {
    RtlTiming timing;
    for (const Pin pin : {Pin::kReset, Pin::kXCs, Pin::kXRd, Pin::kXWr, Pin::kAle}) timing.at_once |= mask(pin);
    return timing;
  }
  std::unique_ptr<MemoryWatch> watch_memory() const override { return std::make_unique<AccessesAlone>(); }
};

}  // namespace

const RtlOf& spc3_rtl() {
  static const Spc3Rtl rtl;
  return rtl;
}

}  // namespace dsdpv1::cosim
