// The same services over the three ports: application and chip get the same as over the parallel one.
#include "tests/driver/acyclic_fixture.hpp"

namespace dsdpv1 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A device on one port; the log has the results of the services and the data that arrived.
class Story : public AcyclicTest {
 public:
  explicit Story(FakePort port) : port_(port) {}
  FakePort port_kind() const override { return port_; }
  void TestBody() override {}
  void begin() {
    AcyclicTest::SetUp();
    config.max_input = config.max_output = 244;
    config.max_prm = 237;
    config.max_cfg = 200;
    config.max_diag = 238;
    table.objects = objects.data();
    table.count = objects.size();
    EXPECT_EQ(dsdpv1_acyclic_open(&acyclic, &device, &table), DSDPV1_OK);
  }
  void end() { AcyclicTest::TearDown(); }

  template <class T>
  Story& say(const std::string& what, const T& value) {
    log.push_back(what + " " + testing::PrintToString(value));
    return *this;
  }
  void swap(const Bytes& inputs, dsdpv1_input_policy policy = DSDPV1_INPUT_NEWEST) {
    say("exchange", exchange(inputs, policy)).say("written", result.inputs_written).say("new", result.outputs_new);
    say("missed", result.intr0_missed).say("chip's inputs", chip.inputs).say("outputs", received());
  }
  void serve() {
    say("service", dsdpv1_service(&device)).say("pending", dsdpv1_intr0_pending(&device));
    say("prm", prm_seen).say("cfg", cfg_seen).say("lengths", cfg_lengths).say("verdicts", chip.verdicts);
  }
  void look() {
    say("poll", poll()).say("received", int{done.received}).say("answered", int{done.answered});
    say("refused", int{done.refused}).say("dropped", int{done.dropped}).say("open", int{done.open});
    say("repeated", int{done.repeated}).say("C1", chip.answers[0]).say("C2", chip.answers[1]);
  }

  using AcyclicTest::acyclic;
  using AcyclicTest::answer;
  using AcyclicTest::chip;
  using AcyclicTest::config;
  using AcyclicTest::device;
  using AcyclicTest::done;
  using AcyclicTest::exchange;
  using AcyclicTest::initialise;
  using AcyclicTest::outcome;
  using AcyclicTest::poll;
  using AcyclicTest::prm_verdict;
  using AcyclicTest::result;
  using AcyclicTest::rsu;
  using AcyclicTest::seen;
  using AcyclicTest::while_judging;
  using AcyclicTest::with_data;
  std::vector<std::string> log;

 private:
  FakePort port_;
};

std::vector<std::string> told(FakePort port, void (*tell)(Story&)) {
  Story story(port);
  story.begin();
  tell(story);
  story.end();
  return story.log;
}

struct Tale {
  const char* name;
  void (*tell)(Story&);
};

void bring_up(Story& s) {
  s.chip.at(0x004) = 0;
  s.chip.not_ready_accesses = 5;
  s.say("ready", dsdpv1_wait_ready(&s.device)).say("init", dsdpv1_initialise(&s.device, &s.config));
  s.say("area", s.chip.bytes(0x020, 17)).say("taken", s.chip.initialisations).say("B005", int{s.chip.at(0x005)});
  const Bytes cfg(200, 0x10);
  s.config.cfg = cfg.data();
  s.config.cfg_length = 200;
  s.say("again", dsdpv1_initialise(&s.device, &s.config)).say("area", s.chip.bytes(0x020, 215));
  s.chip.refuses_silently = true;
  s.say("refused", dsdpv1_initialise(&s.device, &s.config));
}

void cyclic_data(Story& s) {
  s.initialise();
  s.swap({1, 2});
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{244}}) {
    s.chip.put_outputs(Bytes(length, 0x5A));
    s.swap(Bytes(length, 0xA5));
    s.swap(Bytes(length, 0xA6));
  }
  s.chip.put_outputs({7, 8});
  s.say("outputs alone", dsdpv1_exchange(&s.device, DSDPV1_INPUT_NEWEST, nullptr, 0, &s.result));
  s.say("new", s.result.outputs_new).say("B00E", int{s.chip.at(0x00E)});
  s.swap({3});
}

void inputs_that_wait(Story& s) {
  s.initialise();
  s.chip.takes_commands = false;
  s.swap({1}, DSDPV1_INPUT_WHEN_CONSUMED);
  s.swap({2}, DSDPV1_INPUT_WHEN_CONSUMED);
  s.say("B131", int{s.chip.at(0x131)});
  s.swap({3}, DSDPV1_INPUT_NEWEST);
  s.say("B131", int{s.chip.at(0x131)});
}

void without_a_buffer(Story& s) {
  s.initialise();
  s.chip.put_outputs({1});
  s.result.outputs = nullptr;
  s.swap({1});
  s.say("B00E", int{s.chip.at(0x00E)});
}

void small_buffer(Story& s) {
  s.initialise();
  s.chip.put_outputs({1, 2, 3});
  s.result.capacity = 2;
  s.say("exchange", s.exchange({1})).say("new", s.result.outputs_new).say("inputs", s.chip.inputs);
}

void judging(Story& s) {
  s.initialise(2, 2);
  s.swap({9});
  s.chip.put_prm({0x80, 1, 2});
  s.serve();
  s.chip.put_prm(Bytes(237, 1));
  s.chip.put_cfg(8, 4, Bytes(200, 2));
  s.chip.put_outputs({1, 2, 3});
  s.serve();
  s.swap({4});
  s.say("flags", int{s.chip.at(0x00E)});
}

void judging_later(Story& s) {
  s.initialise(2, 2);
  s.prm_verdict = DSDPV1_LATER;
  s.chip.put_prm({1});
  s.serve();
  s.say("cfg", dsdpv1_send_verdict(&s.device, DSDPV1_VERDICT_CFG, 0));
  s.say("prm", dsdpv1_send_verdict(&s.device, DSDPV1_VERDICT_PRM, DSDPV1_VERDICT_PRM)).say("said", s.chip.verdicts);
  s.chip.put_prm({2});
  s.serve();
  s.chip.put_prm({3});
  s.say("stale", dsdpv1_send_verdict(&s.device, DSDPV1_VERDICT_PRM, 0));
}

void newer_block_while_judging(Story& s) {
  s.initialise(2, 0);
  s.chip.put_prm({1});
  bool once = true;
  s.while_judging = [&] {
    if (std::exchange(once, false)) s.chip.put_prm({2});
  };
  s.serve();
}

void blocks_seen_in_an_exchange(Story& s) {
  s.initialise(2, 2);
  s.chip.put_prm({1});
  s.chip.put_cfg(1, 1, {0x10, 0x20});
  s.chip.put_outputs({6});
  s.chip.put_request(1, {0x5E, 1, 1, 4});
  s.swap({5});
  s.serve();
  s.look();
  s.swap({6});
}

void diagnosis(Story& s) {
  s.initialise();
  const Bytes data(238, 0x33);
  for (const int length : {0, 1, 238}) {
    const auto n = static_cast<std::uint8_t>(length);
    s.say("diagnosis", dsdpv1_set_diagnosis(&s.device, DSDPV1_DIAG_EXTERNAL, data.data(), n));
    s.say("block", s.chip.diagnosis);
  }
  s.chip.takes_commands = false;
  s.device.tuning.init_polls = 3;
  s.say("kept", dsdpv1_set_diagnosis(&s.device, DSDPV1_DIAG_STATIC, nullptr, 0));
}

void acyclic_requests(Story& s) {
  s.config.dpv1 = true;
  s.initialise();
  s.look();
  for (const int cls : {1, 2}) {
    s.chip.put_request(cls, {0x5E, 1, 1, 4});
    s.look();
    s.chip.put_request(cls, {0x5F, 1, 1, 4, 9, 8, 7, 6});
    s.look();
    s.chip.put_request(cls, {0x5E, 1, 5, 240});
    s.look();
    s.chip.put_request(cls, Story::with_data({0x5F, 1, 5, 240}, Bytes(240, 0x77)));
    s.look();
    s.chip.put_request(cls, {0x5E, 9, 9, 4});
    s.look();
  }
  s.chip.put_request(1, {0x5E, 1, 1, 4});
  s.chip.put_request(2, {0x5E, 1, 2, 4});
  s.look();
  s.say("B00F", int{s.chip.at(0x00F)});
}

void late_answers(Story& s) {
  s.config.dpv1 = true;
  s.initialise();
  s.outcome = DSDPV1_DEFERRED;
  s.chip.put_request(2, {0x5E, 2, 1, 4});
  s.look();
  const std::uint16_t ticket = s.seen.ticket;
  s.say("late", s.answer(ticket, {1, 2, 3, 4})).say("C2", s.chip.answers[1]);
  s.say("twice", s.answer(ticket, {1}));
  s.chip.put_request(2, {0x5E, 2, 1, 4});
  s.look();
  const std::uint16_t stale = s.seen.ticket;
  s.chip.put_request(2, {0x5E, 2, 2, 4});
  s.say("stale", s.answer(stale, {5}));
  s.say("refused", (s.look(), dsdpv1_acyclic_refuse(&s.acyclic, s.seen.ticket, 0xB8, 1))).say("C2", s.chip.answers[1]);
}

void status_and_errors(Story& s) {
  s.initialise();
  s.chip.at(0x008) = 0x12;
  s.chip.at(0x009) = 0x34;
  s.chip.at(0x00B) = 0x04;
  s.chip.at(0x012) = 0x3C;
  s.chip.at(0x002) = 7;
  dsdpv1_status status{};
  s.say("status", dsdpv1_get_status(&s.device, &status)).say("count", status.offline_count);
  s.say("crc", int{status.crc_errors}).say("state", int{status.state}).say("baud", status.baud);
  s.say("version", Bytes(status.version, status.version + 4));
  s.say("keep", dsdpv1_keep_input_errors(&s.device, true)).say("B011", int{s.chip.at(0x011)});
  s.say("clear", dsdpv1_clear_input_error(&s.device)).say("B00B", int{s.chip.at(0x00B)});
}

void refused_initialisation(Story& s) {
  s.initialise(2, 2);
  s.chip.put_prm({1});
  s.chip.put_outputs({2});
  s.chip.refuses_silently = true;
  s.say("refused", dsdpv1_initialise(&s.device, &s.config));
  s.chip.refuses_silently = false;
  s.serve();
  s.swap({3});
}

class Ports : public testing::TestWithParam<std::tuple<FakePort, Tale>> {};

TEST_P(Ports, GiveWhatTheParallelOneGives) {
  const auto& [port, tale] = GetParam();
  EXPECT_EQ(told(port, tale.tell), told(FakePort::kParallel, tale.tell));
}

constexpr Tale kTales[] = {{"BringUp", bring_up},
                           {"CyclicData", cyclic_data},
                           {"InputsThatWait", inputs_that_wait},
                           {"WithoutABuffer", without_a_buffer},
                           {"SmallBuffer", small_buffer},
                           {"Judging", judging},
                           {"JudgingLater", judging_later},
                           {"NewerBlockWhileJudging", newer_block_while_judging},
                           {"BlocksSeenInAnExchange", blocks_seen_in_an_exchange},
                           {"Diagnosis", diagnosis},
                           {"AcyclicRequests", acyclic_requests},
                           {"LateAnswers", late_answers},
                           {"StatusAndErrors", status_and_errors},
                           {"RefusedInitialisation", refused_initialisation}};

const char* name_of(FakePort port) { return port == FakePort::kSpi ? "Spi" : "Uart"; }

INSTANTIATE_TEST_SUITE_P(All, Ports,
                         testing::Combine(testing::Values(FakePort::kSpi, FakePort::kUart), testing::ValuesIn(kTales)),
                         [](const auto& tale) {
                           return name_of(std::get<0>(tale.param)) + std::string(std::get<1>(tale.param).name);
                         });

}  // namespace
}  // namespace dsdpv1
