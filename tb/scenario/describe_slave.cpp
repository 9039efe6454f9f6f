// Keys of a slave: its initialisation and its user CPU. Those of its chip come from the kind of chip.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

const std::vector<WordFor<Judgement>>& judgement_words() {
  static const std::vector<WordFor<Judgement>> words = {
      {Judgement::kAccept, "accept", "found right"},
      {Judgement::kRefuse, "refuse", "found wrong"},
      {Judgement::kNever, "never", "no verdict; the script may send one with `verdict`"}};
  return words;
}

ObjectOf<InitData> describe_init(const ChipKind& kind) {
  using I = InitData;
  ObjectOf<I> o("init",
                "The user CPU's initialisation data for the chip (table 2). With a GSD, missing keys come from there.");
  o.integer("ident", &I::ident, {0, 0xFFFF}, "", "Ident number.");
  o.integer("max_inputs", &I::max_inputs, {0, 255}, "bytes",
            "Most input bytes, slave to master; above 244 the chip refuses.");
  o.integer("max_outputs", &I::max_outputs, {0, 255}, "bytes",
            "Most output bytes, master to slave; above 244 the chip refuses.");
  o.integer("max_diag", &I::max_diag, {0, 255}, "bytes",
            "User diagnosis without the standard 6 bytes; above 238 the chip refuses.");
  o.integer("max_prm", &I::max_prm, {0, 255}, "bytes",
            "User parameters without the standard 7 bytes; above 237 the chip refuses.");
  const int most_cfg = kind.most_cfg();
  o.integer("max_cfg", &I::max_cfg, {0, 255}, "bytes",
            ("Most configuration bytes; above " + std::to_string(most_cfg) + " the chip refuses.").c_str());
  o.bytes("cfg", &I::cfg, {1, most_cfg}, "Initial configuration (default: that of the modules).");
  o.integer("prm_mode", &I::prm_mode, {0, 255}, "",
            "Judging mode of parameters (table 13): 0 length at most max_prm, 1 length equal, 2 the user.");
  o.integer("cfg_mode", &I::cfg_mode, {0, 255}, "",
            "Judging mode of the configuration (table 14): 0 length, 1 equal to cfg, 2 the user.");
  o.boolean("set_slave_address", &I::set_slave_address, "true: a master may change the address.");
  o.boolean("freeze", &I::freeze, "true: Freeze is supported.");
  o.boolean("sync", &I::sync, "true: Sync is supported.");
  o.boolean("fail_safe", &I::fail_safe, "true: fail-safe is supported.");
  o.boolean("dpv1", &I::dpv1,
            "true: DPV1 is switched on (default: DPV1_Slave of the GSD file, if its Set_Prm has DPV1_Enable).");
  for (keys::Field& field : o.fields)
    if (const std::string place = kind.place_of(field.name); !place.empty())
      field.doc += std::string(" ") + kind.title() + ": " + place + ".";
  return o;
}

/// Reads the chip's keys into separate settings.
void add_own_keys(ObjectOf<UserCpu>& o, const ChipKind& kind) {
  const keys::Object& own = kind.user_keys();
  for (keys::Field field : own.fields) {
    field.read = [&kind, read = field.read](void* owner, const YAML::Node& node, const keys::Source& source) {
      auto& user = *static_cast<UserCpu*>(owner);
      if (!user.own) user.own = kind.make_user_settings();
      read(dynamic_cast<void*>(user.own.get()), node, source);
    };
    o.fields.push_back(std::move(field));
  }
  o.at_most_one.insert(o.at_most_one.end(), own.at_most_one.begin(), own.at_most_one.end());
}

ObjectOf<UserCpu> describe_user_cpu(const ChipKind& kind) {
  using U = UserCpu;
  ObjectOf<U> o("user_cpu",
                "The user CPU: its program, its processor, and its bus to the chip. Keys for the program's behaviour "
                "reach your firmware only through a mailbox (docs/arm_board.md).");
  o.word("behaviour", &U::behaviour,
         std::vector<WordFor<Behaviour>>{
             {Behaviour::kLoopBack, "loop_back", "inputs are the last outputs, cut or filled with 0"},
             {Behaviour::kCount, "count", "every input byte is the number of the cycle"},
             {Behaviour::kConstant, "constant", "inputs are `constant` until the script changes them"},
             {Behaviour::kIdle, "idle", "initialises and judges, exchanges nothing"}},
         "Its use of the cyclic data.");
  o.bytes("constant", &U::constant, {0, 244}, "Inputs of the behaviour constant, filled up with 0.");
  o.boolean("overwrite_inputs", &U::overwrite_inputs,
            "true: overwrites inputs that the chip has not taken yet; false: they stay, the new ones are dropped.");
  o.time("start_delay", &U::start_delay, kAnyTime, "From the release of RESET until it first polls the chip.");
  o.time("cycle", &U::cycle, {bus::kTicksPerUs, 10 * bus::kTicksPerSecond},
         "From the start of one exchange of cyclic data to the next.");
  o.time("judge_delay", &U::judge_delay, {0, 10 * bus::kTicksPerSecond}, "Time before it writes a verdict.");
  o.boolean(
      "judge_in_handler", &U::judge_in_handler,
      "true: the handler of the chip's interrupt judges; false: it notes the interrupt and the main loop judges.");
  o.time("retry_delay", &U::retry_delay, {bus::kTicksPerUs, 10 * bus::kTicksPerSecond},
         "Pause before a failed initialisation is tried again.");
  o.word("judge_prm", &U::judge_prm, judgement_words(), "Its verdict on parameters in judging mode 2.");
  o.word("judge_cfg", &U::judge_cfg, judgement_words(), "Its verdict on the configuration in judging mode 2.");
  o.object("dpv1", &U::dpv1, dpv1_keys(), "Its answers to acyclic requests.");
  add_own_keys(o, kind);
  return o;
}

ObjectOf<Slave> describe_slave(const ChipKind& kind) {
  ObjectOf<Slave> o("slave", "A chip with its user CPU.");
  o.name_of("name", &Slave::name, "Name of the slave in the log, the script and the expectations.").required = true;
  o.integer("address", &Slave::address, {0, 255}, "",
            "Station address that the user CPU sets; above 126 the chip refuses.")
      .required = true;
  o.fields.push_back(chip_field<Slave>(
      kind,
      "This slave's chip, in place of the scenario's: its kind (default: the scenario's), and parameters other than "
      "the kind's defaults. Actions for one kind, and limits of `checks`, stay those of the scenario's."));
  o.file("gsd", &Slave::gsd, "GSD file that the initialisation follows, relative to the scenario's folder.");
  o.names("modules", &Slave::modules, {0, 64}, "Names of the GSD's modules that are plugged in.");
  o.object("init", &Slave::init, per_kind<InitData>(kind, describe_init),
           "Initialisation data other than those of the GSD.");
  o.object("user_cpu", &Slave::user_cpu, per_kind<UserCpu>(kind, describe_user_cpu),
           "The user CPU's behaviour and speed.");
  o.time("release_reset", &Slave::release_reset, kAnyTime, "Time at which RESET rises.");
  return o;
}

}  // namespace

const ObjectOf<Slave>& slave_keys(const ChipKind& kind) { return per_kind<Slave>(kind, describe_slave); }

}  // namespace dsdpv1::tb::scenario
