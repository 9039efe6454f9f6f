// Keys of a slave: the chip, its initialisation and its user CPU.
#include "tb/scenario/describe.hpp"

namespace tb::scenario {
namespace {

const std::vector<WordFor<Judgement>>& judgement_words() {
  static const std::vector<WordFor<Judgement>> words = {
      {Judgement::kAccept, "accept", "found right"},
      {Judgement::kRefuse, "refuse", "found wrong"},
      {Judgement::kNever, "never", "no verdict; the script may send one with `verdict`"}};
  return words;
}

const ObjectOf<InitData>& init_keys() {
  static const ObjectOf<InitData> keys = [] {
    using I = InitData;
    ObjectOf<I> o("init",
                  "What the user CPU tells the chip at the initialisation (table 2, B020..). With a GSD, what is left "
                  "out comes from there.");
    o.integer("ident", &I::ident, {0, 0xFFFF}, "", "Ident number (B022, B023).");
    o.integer("max_inputs", &I::max_inputs, {0, 255}, "bytes",
              "Most input bytes, slave to master (B027); above 244 the chip refuses.");
    o.integer("max_outputs", &I::max_outputs, {0, 255}, "bytes",
              "Most output bytes, master to slave (B028); above 244 the chip refuses.");
    o.integer("max_diag", &I::max_diag, {0, 255}, "bytes",
              "User diagnosis without the standard 6 bytes (B029); above 238 the chip refuses.");
    o.integer("max_prm", &I::max_prm, {0, 255}, "bytes",
              "User parameters without the standard 7 bytes (B02A); above 237 the chip refuses.");
    o.integer("max_cfg", &I::max_cfg, {0, 255}, "bytes",
              "Most configuration bytes (B02C); above 200 the chip refuses.");
    o.bytes("cfg", &I::cfg, {1, 200}, "Initial configuration (B02F..); left out: that of the modules.");
    o.integer("prm_mode", &I::prm_mode, {0, 255}, "",
              "Who judges parameters (B02B, table 13): 0 length at most max_prm, 1 length equal, 2 the user.");
    o.integer("cfg_mode", &I::cfg_mode, {0, 255}, "",
              "Who judges the configuration (B02D, table 14): 0 length, 1 equal to cfg, 2 the user.");
    o.boolean("set_slave_address", &I::set_slave_address, "Whether a master may change the address (B024.0).");
    o.boolean("freeze", &I::freeze, "Whether Freeze is supported (B024.1).");
    o.boolean("sync", &I::sync, "Whether Sync is supported (B024.2).");
    o.boolean("fail_safe", &I::fail_safe, "Whether fail-safe is supported (B024.3).");
    o.boolean("dpv1", &I::dpv1, "Whether DPV1 is switched on (B005 = 0x1D).");
    return o;
  }();
  return keys;
}

const ObjectOf<AccessTimes>& access_keys() {
  static const ObjectOf<AccessTimes> keys = [] {
    using A = AccessTimes;
    const Range any = {-100 * bus::kTicksPerUs, 100 * bus::kTicksPerUs}, positive = {0, 100 * bus::kTicksPerUs};
    ObjectOf<A> o(
        "access",
        "When the user CPU moves its bus pins. The chip's limits are in table 15; times beyond them are reported as "
        "violations. The defaults are those of an STM32F103 at 72 MHz.");
    o.time("address_setup", &A::address_setup, any, "A valid before RD or WR falls (Tc >= 0ns); negative: after it.");
    o.time("cs_lead", &A::cs_lead, positive, "CSR falls before RD or WR.");
    o.time("rd_low", &A::rd_low, {1, 100 * bus::kTicksPerUs}, "RD low.");
    o.time("rd_sample", &A::rd_sample, positive, "From the fall of RD until D is sampled (Tw >= 31.25ns).");
    o.time("wr_low", &A::wr_low, {1, 100 * bus::kTicksPerUs}, "WR low (Ts >= 12.5ns).");
    o.time("data_setup", &A::data_setup, any, "D valid before WR rises (Td >= 12.5ns); negative: after it.");
    o.time("data_hold", &A::data_hold, positive, "D driven after WR rose (Td >= 12.5ns).");
    o.time("address_hold", &A::address_hold, positive, "A valid after RD or WR rose (Td >= 12.5ns of writes).");
    o.time("cs_trail", &A::cs_trail, positive, "CSR rises after RD or WR.");
    o.time("recovery", &A::recovery, positive, "From the last edge of one access to the first of the next.");
    return o;
  }();
  return keys;
}

const ObjectOf<Fsmc>& fsmc_keys() {
  static const ObjectOf<Fsmc> keys = [] {
    using user_cpu::FsmcMode;
    ObjectOf<Fsmc> o(
        "fsmc",
        "Bus timing as the FSMC of an STM32F103 makes it from its registers (bank 1, SRAM, 8 bits). Left "
        "out: what the firmware of an ARM board writes there; a native CPU has addset 1, datast 5, busturn 0, "
        "mode 1, hclk 72.");
    o.integer("addset", &Fsmc::addset, {0, 15}, "HCLK", "ADDSET: WR (and in mode A RD) falls one HCLK more after CSR.");
    o.integer("datast", &Fsmc::datast, {0, 255}, "HCLK",
              "DATAST: WR is low so long; D is sampled one HCLK more after the address phase. 0 is reserved in the "
              "manual: no low time of WR, against Ts.");
    o.integer("busturn", &Fsmc::busturn, {0, 15}, "HCLK", "BUSTURN: CSR stays high so much longer between accesses.");
    o.integer("hclk", &Fsmc::hclk_mhz, {1, 72}, "MHz",
              "Frequency of HCLK; left out: on an ARM board what RCC says, else 72.");
    o.word("mode", &Fsmc::mode,
           std::vector<WordFor<FsmcMode>>{{FsmcMode::k1, "1", "RD falls with CSR"},
                                          {FsmcMode::kA, "A", "RD falls addset + 1 HCLK after CSR"}},
           "Access mode.");
    return o;
  }();
  return keys;
}

const ObjectOf<CpuTimes>& timing_keys() {
  static const ObjectOf<CpuTimes> keys = [] {
    using T = CpuTimes;
    const Range range = {0, bus::kTicksPerMs}, slow = {0, bus::kTicksPerSecond};
    ObjectOf<T> o("timing", "How fast the user CPU is. The defaults are those of a Cortex-M3 at 72 MHz.");
    o.time("overhead", &T::overhead, range, "Instructions between two accesses.");
    o.time("pin_sample", &T::pin_sample, range, "Reading one handshake pin.");
    o.time("pin_write", &T::pin_write, range, "Setting one handshake pin.");
    o.time("r_req_to_sample", &T::r_req_to_sample, range, "From the rise of R_REQ to the first look at L_REQ (H2).");
    o.time("r_req_to_r_sta", &T::r_req_to_r_sta, range, "Least time from the rise of R_REQ to that of R_STA (H2).");
    o.time("interrupt_latency", &T::interrupt_latency, slow,
           "From the fall of INTR0 to the first instruction of its handler.");
    o.time("poll_interval", &T::poll_interval, slow, "Pause between two polls of the DPRAM while the driver waits.");
    return o;
  }();
  return keys;
}

const ObjectOf<UserCpu>& user_cpu_keys() {
  static const ObjectOf<UserCpu> keys = [] {
    using U = UserCpu;
    ObjectOf<U> o(
        "user_cpu",
        "The user CPU: it runs the shipped C driver, or firmware of your own. What says how it behaves reaches "
        "firmware only through the mailbox of tb/user_cpu/arm/mailbox.h.");
    o.word("kind", &U::kind,
           std::vector<WordFor<CpuKind>>{
               {CpuKind::kNative, "native", "a program of the bench on a CPU whose times are `timing`"},
               {CpuKind::kArm, "arm", "the firmware `elf` on a board with an STM32F103 (docs/arm_board.md)"}},
           "Who runs it.");
    o.file(
        "elf", &U::elf,
        "Firmware of the ARM board, relative to the scenario's folder; on the command line relative to where you are.");
    o.word("without_mailbox", &U::without_mailbox,
           std::vector<WordFor<WithoutMailbox>>{
               {WithoutMailbox::kRefuse, "refuse", "the first of them is reported in one line, and nothing is run"},
               {WithoutMailbox::kLeaveOut, "leave_out",
                "actions are not carried out, expectations not judged, and each is listed at the end"}},
           "For firmware without a mailbox: what becomes of actions for the user CPU, of expectations of outputs or of "
           "errors of the driver, and of "
           "settings for its program that stand beside `elf` (docs/arm_board.md).");
    o.names("switches", &U::switches, {0, 112},
            "Switches that hold input pins of the ARM board, like [PA0=low, PB5=high]: PA0 to PG15 but for those that "
            "the board wires to the "
            "chip. Pins without one have their pull-up or pull-down only.");
    o.number("cpi", &U::cpi, {1, 10}, "HCLK", "Cycles per instruction of the ARM board, an estimate.");
    o.word("behaviour", &U::behaviour,
           std::vector<WordFor<Behaviour>>{
               {Behaviour::kLoopBack, "loop_back", "inputs are the last outputs, cut or filled with 0"},
               {Behaviour::kCount, "count", "every input byte is the number of the cycle"},
               {Behaviour::kConstant, "constant", "inputs are `constant` until the script changes them"},
               {Behaviour::kIdle, "idle", "initialises and judges, exchanges nothing"}},
           "What it does with the cyclic data.");
    o.bytes("constant", &U::constant, {0, 244}, "Inputs of the behaviour constant, filled up with 0.");
    o.boolean(
        "overwrite_inputs", &U::overwrite_inputs,
        "Whether inputs that the chip has not taken yet are overwritten; false: they stay, the new ones are dropped.");
    o.time("start_delay", &U::start_delay, kAnyTime, "From the release of RESET until it looks for the chip.");
    o.time("cycle", &U::cycle, {bus::kTicksPerUs, 10 * bus::kTicksPerSecond},
           "From the start of one exchange of cyclic data to the next.");
    o.time("judge_delay", &U::judge_delay, {0, 10 * bus::kTicksPerSecond},
           "How long it thinks before it writes a verdict.");
    o.boolean("judge_in_handler", &U::judge_in_handler,
              "Whether the INTR0 handler judges; false: it notes INTR0 and the main loop judges.");
    o.time("retry_delay", &U::retry_delay, {bus::kTicksPerUs, 10 * bus::kTicksPerSecond},
           "Pause before a failed initialisation is tried again.");
    o.word("judge_prm", &U::judge_prm, judgement_words(), "Its verdict on parameters in judging mode 2.");
    o.word("judge_cfg", &U::judge_cfg, judgement_words(), "Its verdict on the configuration in judging mode 2.");
    o.object("timing", &U::timing, timing_keys(), "How fast it is.");
    o.object("access", &U::access, access_keys(),
             "When it moves the pins of its bus; on an ARM board in place of the FSMC.");
    o.object("fsmc", &U::fsmc, fsmc_keys(), "When it moves them, as registers of an FSMC.");
    o.at_most_one.push_back({"access", "fsmc"});
    o.object("dpv1", &U::dpv1, dpv1_keys(), "Its answers to acyclic requests.");
    return o;
  }();
  return keys;
}

}  // namespace

const ObjectOf<Slave>& slave_keys() {
  static const ObjectOf<Slave> keys = [] {
    ObjectOf<Slave> o("slave", "A DSDPV1 with its user CPU.");
    o.name_of("name", &Slave::name, "Name of the slave in the log, the script and the expectations.").required = true;
    o.integer("address", &Slave::address, {0, 255}, "",
              "Station address that the user CPU sets (B021); above 126 the chip refuses.")
        .required = true;
    o.file("gsd", &Slave::gsd, "GSD file that the initialisation follows, relative to the scenario's folder.");
    o.names("modules", &Slave::modules, {0, 64}, "Names of the GSD's modules that are plugged in.");
    o.object("init", &Slave::init, init_keys(), "Initialisation data other than those of the GSD.");
    o.object("user_cpu", &Slave::user_cpu, user_cpu_keys(), "What the user CPU does, and how fast.");
    o.time("release_reset", &Slave::release_reset, kAnyTime, "When RESET rises.");
    return o;
  }();
  return keys;
}

}  // namespace tb::scenario
