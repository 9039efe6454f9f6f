// compare: compares two waves of any simulators.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/rtl_options.hpp"
#include "apps/options/words.hpp"
#include "cosim/wave_pins.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/waves/wave_writer.hpp"
#include "lab/compare/comparison.hpp"
#include "lab/compare/report.hpp"
#include "tb/report/progress.hpp"

namespace dsdpv1::app {
namespace {

using tb::compare::Femtoseconds;
using tb::compare::NamedPair;
using tb::compare::Nets;
using tb::compare::XRule;
using tb::compare::ZRule;

constexpr const char* kCompare = "dsdpv1-sim compare: ";
constexpr const char* kOwnRtl = "rtl_ref";  // instead of a map: the names of the reference RTL

std::optional<Femtoseconds> duration(const std::string& option, const std::string& text, bool negative = false) {
  if (text.empty()) return std::nullopt;
  const std::optional<Femtoseconds> value = tb::compare::parse_duration(text);
  if (value && (negative || *value >= 0)) return value;
  throw tb::InputError(kCompare + option + " is " + text + ", expected " + tb::compare::kDurationForm);
}

class Compare : public Command {
 public:
  Compare() : Command("compare", "Compare two waves, VCD or FST of any simulator") {}

  void options(CLI::App& app) override {
    app.add_option("A", a_, "The expected wave, such as the model's")->required();
    app.add_option("B", b_, "The wave to compare with it")->required();
    add_what_is_compared(app);
    add_how_it_is_compared(app);
    app.add_option("--wave", wave_, "Write a wave of both sides and their differences: FILE.vcd or FILE.fst");
    app.add_option("--json", json_, "The result for programs");
    app.add_option("--junit", junit_, "The result in JUnit's XML, a case for each signal");
    add_output_options(app, progress_, quiet_);
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim compare model.fst icarus.vcd --scope-a demo --scope-b bench.dut --pins rtl_ref\n"
        "  dsdpv1-sim compare golden.vcd tonight.vcd --tolerance 10ns --mask 'tb.reset=0' --wave both.fst\n"
        "  dsdpv1-sim compare a.fst b.vcd --clock tb.clk --from 100us --to 3ms --json result.json\n"
        "  dsdpv1-sim compare a.vcd b.vcd.gz --signal bus.line=!tb.line_n\n"
        "docs/compare.md explains them.\n"
        "\nExit codes: 0 equal, 1 different, 2 wrong input, 130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    take_words();
    check_files();
    tb::compare::Comparison comparison(
        a_, b_, given_, [this](const Nets& a) { return std::make_unique<cosim::PinSurroundings>(chip(a, nullptr)); });
    if (!wave_.empty()) comparison.write_wave(wave_);
    tb::ShareProgress progress(shows_progress(progress_));
    comparison.on_progress([&progress](double share) { progress.show(share); });
    const tb::compare::Result result = comparison.run();
    progress.clear();
    write_wanted(json_, tb::compare::json(result));
    write_wanted(junit_, tb::compare::junit(result));
    if (!quiet_) std::cout << tb::compare::text(result);
    return result.equal() ? kPassed : kFailed;
  }

 private:
  void add_what_is_compared(CLI::App& app) {
    app.add_option("--scope", scope_, "Compare only signals in this scope and below it (default: all)");
    app.add_option("--scope-a", given_.scope_a, "The same for A alone");
    app.add_option("--scope-b", given_.scope_b, "The same for B alone");
    app.add_option("--pins", pins_,
                   "Compare the chip's pins, named in B by this map (docs/cosim.md) or, with rtl_ref, as in the "
                   "reference RTL (default: all signals with equal names)");
    app.add_option("--chip", chip_, "The chip of --pins (default: the one that the waves' names fit best)")
        ->type_name("KIND");
    app.add_option("--without", without_, "With --pins: leave out this pin of the chip, which may then be missing")
        ->type_name("PIN")
        ->allow_extra_args(false);
    app.add_option("--signal", signals_, "A=B: this signal of A and that of B, A=!B when B has the other level")
        ->allow_extra_args(false);
    app.add_option("--from", from_, "Compare from this time on, such as 100us (default: the part that both have)");
    app.add_option("--to", to_, "... and up to this one, which both must reach");
    app.add_flag("--strict", given_.strict,
                 "Signals without a counterpart, and a B that ends before A, are differences");
  }

  void add_how_it_is_compared(CLI::App& app) {
    app.add_option("--shift", shift_, "Added to B's times: 20ns, -3cycles");
    app.add_option("--tolerance", tolerance_,
                   "Ignore differences up to this time (default: A's unit of time if that of B is another, else 0)");
    app.add_option("--clock", clock_,
                   "SIGNAL, SIGNAL:fall: compare what there is just before its rising (falling) edges");
    app.add_option("--x", x_,
                   "Match unknown bits: expected (A's with anything, B's only with X), any (either side's with "
                   "anything), equal (with X), never (nothing)")
        ->capture_default_str();
    app.add_option("--z", z_, "Match released bits: equal (with Z), expected and any like --x")->capture_default_str();
    app.add_option("--mask", masks_,
                   "SIGNAL=VALUE or SIGNAL!=VALUE: compare nothing while this is true; with @SIGNAL after it, ignore "
                   "only that signal")
        ->allow_extra_args(false);
  }

  /// The chip of --chip, or the one that the waves' names fit best. `b`: nullptr or B, whose names are those of the
  /// reference RTL.
  const tb::ChipKind& chip(const Nets& a, const Nets* b) const {
    if (!chip_.empty()) return *tb::find_chip_kind(chip_);
    const auto fit = [&](const tb::ChipKind* kind) {
      const tb::PinTable& pins = kind->pins();
      const cosim::PinMap usual = cosim::default_pin_map(pins);
      const auto found = std::count_if(
          pins.begin(), pins.end(),
          [&](const tb::PinInfo& pin) {
            return a.has_leaf(pin.name) || (b != nullptr && b->has_leaf(usual.pins.at(pin.name).name));
          });
      return 2 * found - static_cast<std::ptrdiff_t>(pins.size());  // those found, less those missing
    };
    const auto worse = [&](const tb::ChipKind* one, const tb::ChipKind* other) { return fit(one) < fit(other); };
    return **std::max_element(tb::chip_kinds().begin(), tb::chip_kinds().end(), worse);
  }

  /// Those of --pins.
  std::vector<NamedPair> pairs_of_pins(const Nets& a, const Nets& b) const {
    const tb::ChipKind& kind = chip(a, &b);
    const tb::PinTable& table = kind.pins();
    std::vector<NamedPair> pairs =
        cosim::pairs_of(pins_ == kOwnRtl ? cosim::default_pin_map(table) : load_map(pins_, kind), table);
    for (const std::string& pin : without_) leave_out(pin, kind, pairs);
    return pairs;
  }
  static void leave_out(const std::string& pin, const tb::ChipKind& kind, std::vector<NamedPair>& pairs) {
    const auto is = [&](const NamedPair& pair) { return pair.a == pin || pair.output == pin; };
    const auto end = std::remove_if(pairs.begin(), pairs.end(), is);
    std::vector<std::string> names;
    for (const NamedPair& pair : pairs) names.push_back(pair.a);
    if (end == pairs.end())
      throw tb::InputError(fmt::format("{}--without is {}, which the {} lacks{}, expected a pin of it", kCompare, pin,
                                       kind.name(), tb::did_you_mean(pin, names)));
    pairs.erase(end, pairs.end());
  }
  void check_chip() const {
    std::vector<std::string> names;
    for (const tb::ChipKind* kind : tb::chip_kinds()) names.emplace_back(kind->name());
    if (!chip_.empty()) check_word(std::string(kCompare) + "--chip", chip_, names);
    if (pins_.empty() && !without_.empty())
      throw tb::InputError(std::string(kCompare) + "--without is for --pins, expected both");
  }

  void take_words() {
    if (given_.scope_a.empty()) given_.scope_a = scope_;
    if (given_.scope_b.empty()) given_.scope_b = scope_;
    check_chip();
    if (!pins_.empty()) given_.pins = [this](const Nets& a, const Nets& b) { return pairs_of_pins(a, b); };
    for (const std::string& text : signals_) given_.pairs.push_back(tb::compare::parse_pair(text));
    given_.from = duration("--from", from_);
    given_.to = duration("--to", to_);
    given_.shift = duration("--shift", shift_, true).value_or(0);
    given_.tolerance = duration("--tolerance", tolerance_);
    if (!clock_.empty()) given_.clock = tb::compare::parse_clock(clock_);
    given_.x = value_of<XRule>(
        kCompare + std::string("--x"), x_,
        {{"expected", XRule::kExpected}, {"any", XRule::kAny}, {"equal", XRule::kEqual}, {"never", XRule::kNever}});
    given_.z = value_of<ZRule>(kCompare + std::string("--z"), z_,
                               {{"equal", ZRule::kEqual}, {"expected", ZRule::kExpected}, {"any", ZRule::kAny}});
    for (const std::string& mask : masks_) given_.masks.push_back(tb::compare::parse_mask(mask));
  }

  void check_files() const {
    if (!wave_.empty()) tb::check_wave_name(wave_);
    check_outputs("dsdpv1-sim compare", {{"A", a_}, {"B", b_}, {"--pins", pins_ == kOwnRtl ? "" : pins_}},
                  {{"--wave", wave_}, {"--json", json_}, {"--junit", junit_}});
  }

  std::string a_, b_;
  tb::compare::Options given_;  ///< the scopes by CLI11, all else by take_words
  std::string scope_;
  std::string pins_, chip_;  ///< a map of pins, or kOwnRtl; empty: the one that A shows
  std::vector<std::string> without_, signals_, masks_;
  std::string from_, to_, shift_, tolerance_, clock_, x_ = "expected", z_ = "equal";
  std::string wave_, json_, junit_;
  std::optional<bool> progress_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_compare() { return std::make_unique<Compare>(); }

}  // namespace dsdpv1::app
