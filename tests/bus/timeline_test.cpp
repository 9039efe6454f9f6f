#include "bus/timeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace dsdpv1::bus {
namespace {

// --- the queue -------------------------------------------------------------------------------------------------------

TEST(PlanQueue, PlansNothingAtFirst) {
  PlanQueue queue;
  EXPECT_EQ(queue.earliest(), kNever);
  EXPECT_EQ(queue.first_due(0, 1'000'000), PlanQueue::kNone);
  EXPECT_EQ(queue.add(), 0U);
  EXPECT_EQ(queue.earliest(), kNever);
  EXPECT_EQ(queue.earliest_other(0), kNever);
}

TEST(PlanQueue, KeepsItsPlansWhenPlacesAreAdded) {
  PlanQueue queue;
  for (std::size_t place = 0; place < 70; ++place) {
    ASSERT_EQ(queue.add(), place);
    queue.set(place, 1000 - static_cast<Tick>(place));
    EXPECT_EQ(queue.earliest(), 1000 - static_cast<Tick>(place));
  }
  for (std::size_t place = 0; place < 70; ++place) EXPECT_EQ(queue.at(place), 1000 - static_cast<Tick>(place));
}

/// The same as the queue, by querying all.
struct Asked {
  std::vector<Tick> plans;
  Tick earliest_except(std::size_t left_out) const {
    Tick earliest = kNever;
    for (std::size_t i = 0; i < plans.size(); ++i)
      if (i != left_out) earliest = std::min(earliest, plans[i]);
    return earliest;
  }
  std::size_t first_due(std::size_t from, Tick now) const {
    for (std::size_t i = from; i < plans.size(); ++i)
      if (plans[i] <= now) return i;
    return PlanQueue::kNone;
  }
};

TEST(PlanQueue, SaysWhatAskingEverybodySays) {
  std::mt19937 random(7);
  const auto draw = [&random](Tick most) { return std::uniform_int_distribution<Tick>(0, most)(random); };
  for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 33U, 64U, 65U, 100U, 513U}) {
    PlanQueue queue;
    Asked asked{std::vector<Tick>(size, kNever)};
    for (std::size_t i = 0; i < size; ++i) queue.add();
    for (int i = 0; i < 3000; ++i) {
      const auto place = static_cast<std::size_t>(draw(static_cast<Tick>(size) - 1));
      asked.plans[place] = draw(4) == 0 ? kNever : draw(30);
      queue.set(place, asked.plans[place]);
      ASSERT_EQ(queue.earliest(), asked.earliest_except(size));
      const auto from = static_cast<std::size_t>(draw(static_cast<Tick>(size)));
      const Tick now = draw(30);
      ASSERT_EQ(queue.earliest_other(place), asked.earliest_except(place));
      ASSERT_EQ(queue.first_due(from, now), asked.first_due(from, now)) << size << " places from " << from;
    }
  }
}

// --- the timeline ----------------------------------------------------------------------------------------------------

/// Acts when due, records its letter and executes its task.
class Actor : public Agent {
 public:
  Actor(std::string& trace, char letter) : trace_(trace), letter_(letter) {}
  Tick next() const override { return at_; }
  void run(Tick now) override {
    trace_ += letter_;
    last = now;
    at_ = kNever;
    if (act) act(now);
  }
  void plan(Tick at) {
    at_ = at;
    announce();
  }
  void plan_in_silence(Tick at) { at_ = at; }

  std::function<void(Tick)> act;
  Tick last = -1;

 private:
  std::string& trace_;
  char letter_;
  Tick at_ = kNever;
};

struct TimelineTest : testing::Test {
  TimelineTest() {
    for (Actor* each : {&a, &b, &c}) timeline.add(*each);
  }
  std::string trace;
  Actor a{trace, 'a'}, b{trace, 'b'}, c{trace, 'c'};
  Timeline timeline;
};

TEST_F(TimelineTest, ActsInOrderOfTime) {
  a.plan(30);
  b.plan(10);
  c.plan(20);
  EXPECT_EQ(timeline.next(), 10);
  timeline.run_until(25);
  EXPECT_EQ(trace, "bc");
  EXPECT_EQ(timeline.now(), 25);
  EXPECT_TRUE(timeline.step(100));
  EXPECT_FALSE(timeline.step(100));
  EXPECT_EQ(trace, "bca");
  EXPECT_EQ(timeline.now(), 30);
}

TEST_F(TimelineTest, EqualTicksActInTheOrderOfAdding) {
  for (Actor* each : {&c, &a, &b}) each->plan(10);
  EXPECT_TRUE(timeline.step(10));
  EXPECT_EQ(trace, "abc");
}

TEST_F(TimelineTest, NothingAfterTheLimitActs) {
  a.plan(11);
  EXPECT_FALSE(timeline.step(10));
  EXPECT_EQ(timeline.now(), 0);
  EXPECT_EQ(trace, "");
}

TEST_F(TimelineTest, APlanMayMoveEarlierLaterAndAway) {
  a.plan(50);
  b.plan(60);
  c.plan(70);
  EXPECT_EQ(timeline.next(), 50);
  a.plan(65);
  b.plan(80);
  c.plan(kNever);
  EXPECT_EQ(timeline.next(), 65);
  b.plan(5);
  timeline.run_until(100);
  EXPECT_EQ(trace, "ba");
  EXPECT_EQ(b.last, 5);
  EXPECT_EQ(a.last, 65);
}

TEST_F(TimelineTest, WhoBecomesDueThroughAnEarlierOneActsInTheSameStep) {
  a.plan(10);
  a.act = [this](Tick now) { c.plan(now); };
  c.act = [this](Tick now) { b.plan(now); };
  EXPECT_TRUE(timeline.step(10));
  EXPECT_EQ(trace, "ac");
  EXPECT_TRUE(timeline.step(10));  // b has had its turn, so its action is one of the next step at the same tick
  EXPECT_EQ(trace, "acb");
  EXPECT_EQ(b.last, 10);
}

TEST_F(TimelineTest, WhoPlansAgainAtTheSameTickHasHadHisTurn) {
  int left = 2;
  b.plan(10);
  c.plan(10);
  b.act = [&](Tick now) {
    if (left-- > 0) b.plan(now);
  };
  EXPECT_TRUE(timeline.step(10));
  EXPECT_EQ(trace, "bc");
  timeline.run_until(10);
  EXPECT_EQ(trace, "bcbb");
}

TEST_F(TimelineTest, AnEarlierOneMayCallALaterOneOff) {
  a.plan(10);
  b.plan(10);
  a.act = [this](Tick) { b.plan(20); };
  EXPECT_TRUE(timeline.step(10));
  EXPECT_EQ(trace, "a");
  timeline.run_until(20);
  EXPECT_EQ(trace, "ab");
}

TEST_F(TimelineTest, WhatLiesInThePastIsDueNow) {
  timeline.run_until(100);
  a.plan(40);
  EXPECT_EQ(timeline.next(), 40);
  timeline.run_until(100);
  EXPECT_EQ(a.last, 100);
}

TEST_F(TimelineTest, HowLongItIsQuietIsKnownInTheMiddleOfATurn) {
  a.plan(10);
  b.plan(30);
  a.act = [&](Tick) {
    EXPECT_EQ(timeline.quiet_until(a), 26) << "behind the end of the run is nobody";
    c.plan(20);
    EXPECT_EQ(timeline.quiet_until(a), 20);
    a.plan(12);
    EXPECT_EQ(timeline.quiet_until(a), 20) << "its own plans do not count";
    a.act = nullptr;
  };
  timeline.run_until(25);
  EXPECT_EQ(trace, "aac");
  EXPECT_EQ(a.last, 12);
}

TEST_F(TimelineTest, ATurnGoesOnAsLongAsItIsQuiet) {
  a.plan(10);
  b.plan(30);
  a.act = [&](Tick) {
    EXPECT_TRUE(timeline.go_on(a, 29));
    EXPECT_EQ(timeline.now(), 29);
    EXPECT_FALSE(timeline.go_on(a, 30)) << "b has a turn then";
    EXPECT_EQ(timeline.now(), 29);
    c.plan(29);
    EXPECT_FALSE(timeline.go_on(a, 29)) << "c has one now";
  };
  EXPECT_TRUE(timeline.step(40));
  EXPECT_EQ(trace, "ac") << "who comes behind a acts in the same step, at the tick to which that went on";
  EXPECT_EQ(c.last, 29);
  a.act = nullptr;
  timeline.run_until(40);
  EXPECT_EQ(trace, "acb");
}

TEST_F(TimelineTest, NobodyGoesOnPastSomebodyWhoHasNotAnnouncedHisPlan) {
  timeline.check_announcements();
  a.plan(10);
  b.plan(30);
  a.act = [&](Tick) {
    b.plan_in_silence(11);
    timeline.go_on(a, 20);
  };
  EXPECT_THROW(timeline.step(40), std::logic_error);
}

TEST_F(TimelineTest, AFailureIsTheCallersAndTheOthersGoOn) {
  a.plan(10);
  b.plan(10);
  a.act = [](Tick) { throw std::runtime_error("broken"); };
  EXPECT_THROW(timeline.step(10), std::runtime_error);
  EXPECT_TRUE(timeline.step(10));
  EXPECT_EQ(trace, "ab");
}

TEST_F(TimelineTest, AgentsMayEndBeforeTheirTimeline) {
  auto guest = std::make_unique<Actor>(trace, 'g');
  timeline.add(*guest);
  guest->plan(5);
  a.plan(6);
  EXPECT_EQ(timeline.next(), 5);
  guest->plan(4);
  guest.reset();
  EXPECT_EQ(timeline.next(), 6);
  timeline.run_until(10);
  EXPECT_EQ(trace, "a");
}

TEST(Timeline, MayEndBeforeItsAgents) {
  std::string trace;
  Actor actor(trace, 'a');
  {
    Timeline first;
    first.add(actor);
  }
  actor.plan(3);
  Timeline second;
  second.add(actor);
  second.run_until(3);
  EXPECT_EQ(trace, "a");
}

TEST_F(TimelineTest, HasAnAgentOnce) { EXPECT_THROW(timeline.add(a), std::logic_error); }

// --- a plan that was not announced -----------------------------------------------------------------------------------

std::string failure_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(TimelineTest, FindsAPlanThatWasNotAnnounced) {
  timeline.check_announcements();
  a.plan(10);
  timeline.run_until(10);
  b.plan_in_silence(20);
  const std::string failure = failure_of([this] { timeline.step(100); });
  EXPECT_NE(failure.find("at tick 10 agent 1 "), std::string::npos) << failure;
  EXPECT_NE(failure.find("Actor"), std::string::npos) << failure;
  EXPECT_NE(failure.find("plans tick 20"), std::string::npos) << failure;
}

TEST_F(TimelineTest, FindsAPlanThatWasSilentlyPutOffInTheSameStep) {
  timeline.check_announcements();
  a.plan(10);
  b.plan(10);
  a.act = [this](Tick) { b.plan_in_silence(20); };
  EXPECT_NE(failure_of([this] { timeline.step(10); }).find("has announced 10"), std::string::npos);
  EXPECT_EQ(trace, "a");
}

TEST_F(TimelineTest, WhatAnAgentPlansInItsOwnTurnNeedsNoAnnouncement) {
  timeline.check_announcements();
  a.plan(10);
  a.act = [this](Tick now) {
    if (now < 30) a.plan_in_silence(now + 10);
  };
  timeline.run_until(100);
  EXPECT_EQ(trace, "aaa");
}

}  // namespace
}  // namespace dsdpv1::bus
