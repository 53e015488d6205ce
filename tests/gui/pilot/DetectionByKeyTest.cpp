// A person's thresholds at the participant's window: what is delivered is felt, every answer is a key.
#include <nlohmann/json.hpp>

#include "core/pilot/PilotThresholds.h"
#include "core/session/SessionWriter.h"
#include "tests/bench/PersonFixture.h"
#include "tests/gui/pilot/SeatedPeople.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

constexpr double kFelt_ma = 3, kStrong_ma = 6, kTooStrong_ma = 9;

/// A simulated bench with a session's record on it, where time passes at once; no test of its own.
class BenchBehind final : public PersonFixture {
public:
    explicit BenchBehind(PilotParticipant& people) {
        writer_ = SessionWriter::create(dir_.path() / "session.tacto", {}, fileClock_).value();
        session_ = writer_.get();
        openPerson();
        record_ = std::make_unique<PilotRecord>(*writer_, *clock_, std::vector<SessionRow>());
        PilotSettings settings;
        settings.code = "P-7K3M";
        stage = std::make_unique<PilotStage>(*bench_, people, *record_, settings);
    }
    ~BenchBehind() override {
        stage.reset();
        record_.reset();
        bench_.reset();
    }
    void TestBody() override {}
    std::unique_ptr<PilotStage> stage;

private:
    ScratchDir dir_;
    VirtualClock fileClock_;
    std::unique_ptr<SessionWriter> writer_;
    std::unique_ptr<PilotRecord> record_;
};

/// Passes everything on to the window, and knows what its person feels.
class Feeling final : public PilotParticipant {
public:
    explicit Feeling(gui::ParticipantDesk& desk) : desk_(desk) {
        desk_.stop = [this](const char* by) { stop(by); };
    }
    void show(const PilotScreen& screen) override { desk_.show(screen); }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override { return desk_.ask(prompt); }
    void delivered(const FeltPresentation& felt) override {
        const std::scoped_lock lock(mutex_);
        felt_ = felt;
    }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return desk_.takeEarly(); }
    void cancel() noexcept override { desk_.cancel(); }
    [[nodiscard]] bool holding() const noexcept override { return desk_.holding(); }
    [[nodiscard]] Result<void> ready() const override { return desk_.ready(); }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return true; }
    [[nodiscard]] FeltPresentation felt() const {
        const std::scoped_lock lock(mutex_);
        return felt_;
    }

private:
    gui::ParticipantDesk& desk_;
    mutable std::mutex mutex_;
    FeltPresentation felt_;  // guarded by mutex_
};

class DetectionByKey : public Seated, public testing::WithParamInterface<DetectionMethod> {
protected:
    DetectionByKey() {
        QObject::connect(&desk, &gui::ParticipantDesk::screenChanged, &window, [this](const PilotScreen& screen) {
            if (screen.state == ScreenState::Interval && screen.interval > 0) ++marked[screen.interval];
        });
    }
    /// The key that this person presses for what stands on the screen.
    [[nodiscard]] Qt::Key answerTo(const FeltPresentation& felt) {
        const auto& targets = window.field().targets();
        const auto first = targets.empty() ? QString() : targets.front()->objectName();
        if (first == "nothing")
            return felt.level < kFelt_ma        ? Qt::Key_1
                   : felt.level < kStrong_ma    ? Qt::Key_2
                   : felt.level < kTooStrong_ma ? Qt::Key_3
                                                : Qt::Key_4;
        if (first == "yes") return Qt::Key_1;
        if (first != "first") return Qt::Key_H;  // to hold
        ++asked;
        const bool second = felt.level < kFelt_ma ? ++guesses % 2 == 0 : felt.inInterval == 2;
        return second ? Qt::Key_2 : Qt::Key_1;
    }
    /// Answers until the session's thread has done `work`.
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
    BenchBehind behind{people};
    std::map<int, int> marked;
    int asked = 0, guesses = 0;
};

TEST_P(DetectionByKey, FindsWhatThePersonFeels) {
    RecordProperty("hazard", "H9");
    PilotThresholds thresholds(*behind.stage);
    const auto limits = answering([&] { return thresholds.ascendingLimits(); });
    ASSERT_IN_TIME(limits);
    EXPECT_DOUBLE_EQ(thresholds.limits().felt, kFelt_ma);
    ASSERT_IN_TIME(comesTrue([this] { return window.title().contains("let go"); }));
    QTest::keyRelease(window.windowHandle(), Qt::Key_H);
    EXPECT_EQ(behind.stage->record().count(row::kParticipantStop), 0U) << "levels rise no more: nothing is held";

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
