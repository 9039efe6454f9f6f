// Keys of the script: actions, and the conditions that they may wait for.
#include <algorithm>

#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

const ObjectOf<Faults>& fault_keys() {
  static const ObjectOf<Faults> keys = [] {
    const Range byte = {0, 254};
    ObjectOf<Faults> o("faults", "Faults in a telegram. Bytes count from 0.");
    o.integer("wrong_parity_at", &Faults::wrong_parity_at, byte, "", "This byte has the wrong parity bit.");
    o.integer("missing_stop_at", &Faults::missing_stop_at, byte, "", "This byte's stop bit is low.");
    o.integer("gap_before", &Faults::gap_before, byte, "", "Idle time before this byte.");
    o.number("gap_bits", &Faults::gap_bits, {0, 1000}, "bit times", "Length of that idle time.");
    o.integer("truncate_after", &Faults::truncate_after, {0, 255}, "bytes", "Only this many bytes are sent.");
    o.integer("glitch_at", &Faults::glitch_at, byte, "", "The line is inverted for a while in this byte.");
    o.number("glitch_start_bits", &Faults::glitch_start_bits, {0, 11}, "bit times",
             "Begin of the inversion within the byte.");
    o.number("glitch_bits", &Faults::glitch_bits, {0, 11}, "bit times", "Length of the inversion.");
    return o;
  }();
  return keys;
}

const std::vector<WordFor<AnswerFaultKind>>& answer_fault_words() {
  using Kind = AnswerFaultKind;
  static const std::vector<WordFor<Kind>> words = {
      {Kind::kSilent, "silent", "nothing"},         {Kind::kFcs, "fcs", "its FCS is wrong"},
      {Kind::kEd, "ed", "its last byte is not 16"}, {Kind::kParity, "parity", "its first character has wrong parity"},
      {Kind::kLate, "late", "later by `for`"},      {Kind::kSa, "sa", "from another address"},
      {Kind::kDa, "da", "to another address"},      {Kind::kSap, "sap", "from another SAP"},
      {Kind::kDoubled, "doubled", "twice"},         {Kind::kCut, "cut", "half of its bytes"}};
  return words;
}

/// Without the orders of the kind of chip.
const std::vector<WordFor<ActionKind>>& action_words() {
  static const std::vector<WordFor<ActionKind>> words = {{ActionKind::kSetInputs, "set_inputs", ""},
                                                         {ActionKind::kSetDiagnosis, "set_diagnosis", ""},
                                                         {ActionKind::kReinitialise, "reinitialise", ""},
                                                         {ActionKind::kResetChip, "reset_chip", ""},
                                                         {ActionKind::kWrongLength, "wrong_length", ""},
                                                         {ActionKind::kPauseUser, "pause_user", ""},
                                                         {ActionKind::kVerdict, "verdict", ""},
                                                         {ActionKind::kAnswerAcyclic, "answer_acyclic", ""},
                                                         {ActionKind::kUnplug, "unplug", ""},
                                                         {ActionKind::kPlug, "plug", ""},
                                                         {ActionKind::kSetOutputs, "set_outputs", ""},
                                                         {ActionKind::kReadInputs, "read_inputs", ""},
                                                         {ActionKind::kReadOutputs, "read_outputs", ""},
                                                         {ActionKind::kGetCfg, "get_cfg", ""},
                                                         {ActionKind::kSlaveDiag, "slave_diag", ""},
                                                         {ActionKind::kSetSlaveAddress, "set_slave_address", ""},
                                                         {ActionKind::kC1Read, "c1_read", ""},
                                                         {ActionKind::kC1Write, "c1_write", ""},
                                                         {ActionKind::kGlobalControl, "global_control", ""},
                                                         {ActionKind::kOperate, "operate", ""},
                                                         {ActionKind::kClear, "clear", ""},
                                                         {ActionKind::kStopMaster, "stop_master", ""},
                                                         {ActionKind::kStartMaster, "start_master", ""},
                                                         {ActionKind::kChangeBaud, "change_baud", ""},
                                                         {ActionKind::kTelegram, "telegram", ""},
                                                         {ActionKind::kC2Connect, "c2_connect", ""},
                                                         {ActionKind::kC2Read, "c2_read", ""},
                                                         {ActionKind::kC2Write, "c2_write", ""},
                                                         {ActionKind::kC2Transport, "c2_transport", ""},
                                                         {ActionKind::kC2Abort, "c2_abort", ""},
                                                         {ActionKind::kC2Behaviour, "c2_behaviour", ""},
                                                         {ActionKind::kC2Raw, "c2_raw", ""},
                                                         {ActionKind::kGlitch, "glitch", ""},
                                                         {ActionKind::kAnswerFault, "answer_fault", ""}};
  return words;
}

std::vector<Choice> user_choices() {
  return {
      {"set_inputs",
       "The user CPU hands these inputs to the chip (behaviour constant or idle).",
       {"slave", "bytes"},
       {}},
      {"set_diagnosis", "The user CPU hands a diagnosis to the chip.", {"slave", "type"}, {"bytes"}},
      {"reinitialise",
       "The user CPU initialises the chip again, with another address or configuration if given.",
       {"slave"},
       {"new_address", "cfg"}},
      {"reset_chip", "RESET goes low for a while; the user CPU starts again with it.", {"slave"}, {"for"}},
      {"wrong_length",
       "The next inputs are one byte longer than configured, shorter where that is impossible.",
       {"slave"},
       {}},
      {"pause_user", "The user CPU does nothing for a while, not even judge.", {"slave", "for"}, {}},
      {"verdict", "The user CPU sends a verdict, as it does in judging mode 2.", {"slave", "of"}, {"refuse"}},
      {"answer_acyclic", "From now on the user CPU answers acyclic requests like this.", {"slave", "answering"}, {}},
      {"unplug", "The slave is taken from the bus.", {"slave"}, {}},
      {"plug", "The slave is put back.", {"slave"}, {}},
  };
}

std::vector<Choice> master_choices() {
  const std::vector<std::string> reads = {"master", "slave", "address"};
  return {
      {"set_outputs", "The master sends these outputs from the next cycle on.", {"slave", "bytes"}, {"master"}},
      {"read_inputs", "The master reads the inputs (SAP 56).", {}, reads},
      {"read_outputs", "The master reads the outputs (SAP 57), in data exchange.", {}, reads},
      {"get_cfg", "The master reads the configuration (SAP 59).", {}, reads},
      {"slave_diag", "The master reads the diagnosis (SAP 60).", {}, reads},
      {"set_slave_address",
       "The master gives the slave another address (SAP 55).",
       {"new_address"},
       {"master", "slave", "address", "ident", "lock"}},
      {"c1_read",
       "The master reads an object acyclically (DS_Read, MSAC_C1).",
       {"slave", "slot", "index", "length"},
       {"master"}},
      {"c1_write",
       "The master writes an object acyclically (DS_Write, MSAC_C1).",
       {"slave", "slot", "index", "bytes"},
       {"master"}},
      {"global_control",
       "The master sends a Global_Control (SAP 58) to all, or to the groups.",
       {},
       {"master", "sync", "unsync", "freeze", "unfreeze", "clear", "group"}},
      {"operate", "The master goes to Operate.", {}, {"master"}},
      {"clear", "The master goes to Clear.", {}, {"master"}},
      {"stop_master", "The master falls silent.", {}, {"master"}},
      {"start_master", "The master enters the bus again, from the beginning.", {}, {"master"}},
      {"change_baud", "All masters continue with another baud rate.", {"baud"}, {}},
      {"telegram",
       "The master sends these bytes, right or broken, between two of its telegrams.",
       {"bytes"},
       {"master", "faults"}},
  };
}

std::vector<Choice> class2_choices() {
  return {
      {"c2_connect", "The class 2 master opens the connection (Initiate).", {"connection"}, {}},
      {"c2_read", "It reads an object (DS_Read, MSAC_C2).", {"connection", "slot", "index", "length"}, {}},
      {"c2_write", "It writes an object (DS_Write).", {"connection", "slot", "index", "bytes"}, {}},
      {"c2_transport",
       "It writes and reads an object in one (DS_Transport).",
       {"connection", "slot", "index", "bytes"},
       {}},
      {"c2_abort", "It ends the connection (Abort).", {"connection"}, {}},
      {"c2_behaviour", "Its behaviour on this connection from now on.", {"connection", "behaviour"}, {}},
      {"c2_raw",
       "It sends this PDU, right or wrong, to the connection's SAP or to another one.",
       {"connection", "bytes"},
       {"sap"}},
  };
}

/// The meaning and keys of each word of `do`, in the order of the words.
std::vector<Choice> action_choices(const ChipKind& kind) {
  std::vector<Choice> choices = user_choices();
  for (const std::vector<Choice>& more : {master_choices(), class2_choices()})
    choices.insert(choices.end(), more.begin(), more.end());
  choices.push_back({"glitch", "The line is forced to a level for a while.", {"for"}, {"level"}});
  choices.push_back({"answer_fault",
                     "The slave's next answers reach the line like this; its chip does not know of it.",
                     {"slave", "fault"},
                     {"times", "for"}});
  for (const Order& order : kind.orders()) choices.push_back(order.choice);
  return choices;
}

void describe_values(ObjectOf<Action>& o, const ChipKind& kind) {
  using A = Action;
  using user_cpu::DiagnosisKind;
  o.name_of("slave", &A::slave, "Name of the slave.");
  o.name_of("master", &A::master, "Name of the master (default: the first one).");
  o.name_of("connection", &A::connection, "Name of a connection of a class 2 master.");
  o.bytes("bytes", &A::bytes, {0, 256},
          "Data, or all bytes of a telegram; host_telegram up to 256, all others up to 255.");
  o.word("type", &A::diagnosis,
         std::vector<WordFor<DiagnosisKind>>{{DiagnosisKind::kExtended, "extended", "low priority"},
                                             {DiagnosisKind::kExternal, "external", "Ext_Diag"},
                                             {DiagnosisKind::kExternalGone, "external_gone", "no more Ext_Diag"},
                                             {DiagnosisKind::kStatic, "static", "Stat_Diag"},
                                             {DiagnosisKind::kStaticGone, "static_gone", "no more Stat_Diag"}},
         "Kind of the diagnosis.");
  o.integer("address", &A::address, kAddresses, "", "Station address, if it is not that of the slave in the scenario.");
  o.integer("new_address", &A::new_address, {0, 255}, "", "The new station address.");
  o.integer("ident", &A::ident, {0, 0xFFFF}, "", "Ident number in the telegram (default: the right one).");
  o.boolean("lock", &A::lock, "No_Add_Chg: no further change of the address.");
  o.bytes("cfg", &A::cfg, {1, kind.most_cfg()}, "The new configuration.");
  o.time("for", &A::duration, {1, 10 * bus::kTicksPerSecond},
         "Duration (default for reset_chip: 10us), or delay of an answer.");
  o.integer("times", &A::times, {1, 1000}, "", "Number of times.");
  o.word("of", &A::of,
         std::vector<WordFor<Verdict>>{{Verdict::kPrm, "prm", "parameters"}, {Verdict::kCfg, "cfg", "configuration"}},
         "Subject of the verdict.");
  o.boolean("refuse", &A::refuse, "The verdict is: wrong.");
  o.word("answering", &A::answering, answering_words(), "Answers to acyclic requests.");
  o.integer("slot", &A::slot, {0, 255}, "", "Slot number.");
  o.integer("index", &A::index, {0, 255}, "", "Index.");
  o.integer("length", &A::length, {0, 255}, "bytes", "Number of bytes asked for; above 240 the chip refuses.");
  o.integer("sap", &A::sap, {0, 63}, "", "DSAP (default: that of the connection, 49 while none is open).");
  o.word("behaviour", &A::behaviour,
         std::vector<WordFor<bus::Behaviour>>{
             {bus::Behaviour::kNormal, "normal", ""},
             {bus::Behaviour::kSilent, "silent", "sends nothing: the slave's F or I timer ends"},
             {bus::Behaviour::kPollOnly, "poll_only", "polls, sends no request and no Idle: the slave's I timer ends"}},
         "Behaviour of a class 2 master.");
  o.word("baud", &A::baud, baud_words(), "The new baud rate.");
  o.object("faults", &A::faults, fault_keys(), "Faults in the telegram.");
  o.word("fault", &A::answer_fault, answer_fault_words(),
         "The answer on the line. Answers without the part that is to be wrong (a short acknowledge has no FCS) do not "
         "count.");
  o.boolean("level", &A::level, "true: the line is forced high, false: low.");
}

void describe_global_control(ObjectOf<Action>& o) {
  o.boolean("sync", &Action::sync, "Sync.");
  o.boolean("unsync", &Action::unsync, "Unsync.");
  o.boolean("freeze", &Action::freeze, "Freeze.");
  o.boolean("unfreeze", &Action::unfreeze, "Unfreeze.");
  o.boolean("clear", &Action::clear, "Clear_Data.");
  o.integer("group", &Action::group, {0, 255}, "", "Group_Select, a bit for each group; 0 means all.");
}

/// The word is kept, because all orders of a kind of chip are one ActionKind.
void describe_action(ObjectOf<Action>& o, const ChipKind& kind) {
  std::vector<WordFor<ActionKind>> words = action_words();
  for (const Order& order : kind.orders()) words.push_back({ActionKind::kOfChip, order.choice.word.c_str(), ""});
  keys::Field& field = o.word("do", &Action::what, words, "The action.");
  field.read = [read = field.read](void* owner, const YAML::Node& node, const keys::Source& source) {
    read(owner, node, source);
    static_cast<Action*>(owner)->word = node.Scalar();
  };
}

void describe_blocks(ObjectOf<Action>& o, const ChipKind& kind) {
  if (kind.blocks().empty()) return;
  std::vector<WordFor<std::string>> words;
  for (const keys::Word& each : kind.blocks()) words.push_back({each.text, each.text.c_str(), each.doc.c_str()});
  o.word("area", &Action::block, words, "The block.");
}

void describe_listen(ObjectOf<Action>& o, const ChipKind& kind) {
  const auto takes = [](const Order& order) {
    const auto& keys = order.choice.optional;
    return std::find(keys.begin(), keys.end(), "listen") != keys.end();
  };
  if (!std::any_of(kind.orders().begin(), kind.orders().end(), takes)) return;
  o.integer(
      "listen", &Action::listen, {0, 512}, "bytes",
      "Number of bytes that the user CPU takes after the telegram. Over SPI it clocks this many (default: 8). Over the "
      "UART it listens until this many have come or no more comes (default: the latter); with 0 it continues at once.");
}

ObjectOf<Action> describe_actions(const ChipKind& kind) {
  ObjectOf<Action> o("action", "An action, at a time or when a condition has become true.");
  o.time("at", &Action::at, kAnyTime, "Time from the start of the run.");
  o.object("when", &Action::when, when_keys(), "Once, as soon as this is true.");
  describe_action(o, kind);
  describe_values(o, kind);
  describe_blocks(o, kind);
  describe_listen(o, kind);
  describe_global_control(o);
  o.selector = "do";
  o.choices = action_choices(kind);
  o.always = {"at", "when"};
  o.exactly_one = {{"at", "when"}};
  return o;
}

}  // namespace

std::string word_of(AnswerFaultKind kind) {
  for (const WordFor<AnswerFaultKind>& each : answer_fault_words())
    if (each.value == kind) return each.text;
  return "";
}

const ObjectOf<Action>& action_keys(const ChipKind& kind) { return per_kind<Action>(kind, describe_actions); }

}  // namespace dsdpv1::tb::scenario
