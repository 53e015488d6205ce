// Measures a person's thresholds at the participant's window: the person feels what is delivered and answers by key.
#include "core/pilot/PilotThresholds.h"
#include "tests/gui/pilot/BenchBehind.h"
#include "tests/gui/pilot/SeatedPeople.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

constexpr double kFelt_ma = 3, kStrong_ma = 6, kTooStrong_ma = 9;

class DetectionByKey : public Seated, public testing::WithParamInterface<DetectionMethod> {
protected:
    DetectionByKey() {
        QObject::connect(&desk, &gui::ParticipantDesk::screenChanged, &window, [this](const PilotScreen& screen) {
            if (screen.state == ScreenState::Interval && screen.interval > 0) ++marked[screen.interval];
        });
        QObject::connect(&desk, &gui::ParticipantDesk::asked, &window, [this](const PilotPrompt& prompt, quint64 id) {
            if (prompt.name == kHoldPrompt) desk.answerAsOperator(id, {.keys = {"KL"}});
        });
    }
    /// The key that this person presses for the question on the screen.
    [[nodiscard]] Qt::Key answerTo(const FeltPresentation& felt) {
        const auto& targets = window.field().targets();
        const auto first = targets.empty() ? QString() : targets.front()->objectName();
        if (first == "nothing")
            return felt.level < kFelt_ma        ? Qt::Key_1
                   : felt.level < kStrong_ma    ? Qt::Key_2
                   : felt.level < kTooStrong_ma ? Qt::Key_3
                                                : Qt::Key_4;
        if (first == "yes" || first == "go-on") return Qt::Key_1;
        if (first != "first") return Qt::Key_H;  // the answer to "hold"
        ++asked;
        const bool second = felt.level < kFelt_ma ? ++guesses % 2 == 0 : felt.inInterval == 2;
        return second ? Qt::Key_2 : Qt::Key_1;
    }
    /// Answers until the session's thread has finished `work`.
    [[nodiscard]] Result<void> answering(const std::function<Result<void>()>& work) {
        auto running = std::async(std::launch::async, work);
        const bool done = comesTrue(
            [&] {
                if (running.wait_for(std::chrono::seconds(0)) == std::future_status::ready) return true;
                if (!window.asking()) return false;
                const auto pressed = answerTo(people.felt());
                if (pressed == Qt::Key_H)
                    QTest::keyPress(window.windowHandle(), pressed);
                else
                    key(pressed);
                return false;
            },
            60'000);
        EXPECT_IN_TIME(done) << "still asks: " << window.title().toStdString();
        if (!done) desk.cancel();
        return running.get();
    }

    Feeling people{desk};
    BenchBehind behind;
    PilotStage stage{behind.bench(), people, behind.record(), behind.settings()};
    std::map<int, int> marked;
    int asked = 0, guesses = 0;
};

TEST_P(DetectionByKey, FindsWhatThePersonFeels) {
    RecordProperty("hazard", "H9");
    PilotThresholds thresholds(stage);
    const auto limits = answering([&] { return thresholds.ascendingLimits(); });
    ASSERT_IN_TIME(limits);
    EXPECT_DOUBLE_EQ(thresholds.limits().felt, kFelt_ma);
    ASSERT_IN_TIME(comesTrue([this] { return window.title().contains("let go"); }));
    QTest::keyRelease(window.windowHandle(), Qt::Key_H);
    EXPECT_EQ(stage.record().count(row::kParticipantStop), 0U) << "levels rise no more: nothing is held";

    const auto found = answering([&] { return thresholds.detection(GetParam()); });
    ASSERT_IN_TIME(found);
    EXPECT_GT(thresholds.estimate(), kFelt_ma - 1);
    EXPECT_LT(thresholds.estimate(), kFelt_ma + 0.5);
    EXPECT_GE(asked, GetParam() == DetectionMethod::Quest ? 24 : 10);
    EXPECT_EQ(marked[1], asked) << "each trial shows its first interval, and its second";
    EXPECT_EQ(marked[2], asked);

    const auto range = answering([&] { return thresholds.range(); });
    ASSERT_IN_TIME(range);
    ASSERT_TRUE(thresholds.found());
    EXPECT_TRUE(thresholds.found()->usable) << thresholds.found()->reason;
}

INSTANTIATE_TEST_SUITE_P(Both, DetectionByKey, testing::Values(DetectionMethod::Quest, DetectionMethod::Staircase),
                         [](const auto& method) {
                             return method.param == DetectionMethod::Quest ? std::string("Quest") : "Staircase";
                         });

}  // namespace
}  // namespace tacto::test
