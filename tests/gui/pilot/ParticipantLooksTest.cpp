// Tests the participant's screen: same pixels for every condition, targets of 20 mm, nothing cut, only STOP red.
#include <QLabel>
#include <set>

#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/SeatedPeople.h"

namespace tacto::test {
namespace {

constexpr QSize kSizes[] = {QSize(1280, 720), QSize(1440, 900), QSize(1920, 1080)};

class ParticipantLooks : public Seated {
protected:
    [[nodiscard]] QImage picture() {
        QCoreApplication::processEvents();
        return window.grab().toImage();
    }
    void answerBy(Qt::Key pressed) {
        key(pressed);
        EXPECT_TRUE(answered());
        letLive(160);  // so that no key counts as held
    }
};

TEST_F(ParticipantLooks, EveryPhaseHasTheSamePixelsForEveryCondition) {
    RecordProperty("hazard", "H9");
    auto prompt = conditionPrompt(kFour);
    prompt.within = Seconds(1e6);  // so that the drawn remaining time stands still in these pictures
    std::vector<std::vector<QImage>> phases;
    const auto feel = [](double level, double interval_s) {
        FeltPresentation felt;
        felt.level = level;
        felt.interval = Seconds(interval_s);
        return felt;
    };
    const std::pair<const char*, FeltPresentation> conditions[] = {{"rough-high", feel(6.5, 0.5)},
                                                                   {"rough-low", feel(4, 0.5)},
                                                                   {"smooth-high", feel(6.5, 2)},
                                                                   {"smooth-low", feel(4, 2)},
                                                                   {"catch", {}}};
    // The first showing does not count: Qt draws letters of 92 px anew the first time, with slightly different edges.
    desk.show(testScreen(ScreenState::Dot));
    ASSERT_NO_FATAL_FAILURE(ask(prompt));
    answerBy(Qt::Key_1);
    for (const auto& [name, felt] : conditions) {
        std::vector<QImage> shown;
        desk.show(testScreen(ScreenState::Dot));
        shown.push_back(picture());
        desk.show(testScreen(ScreenState::Feel));
        shown.push_back(picture());
        EXPECT_TRUE(shown[0] == shown[1]) << "the dot tells nothing of when trains come";
        desk.delivered(felt);
        shown.push_back(picture());
        ASSERT_NO_FATAL_FAILURE(ask(prompt));
        shown.push_back(picture());
        answerBy(Qt::Key_1);
        shown.push_back(picture());
        desk.show(testScreen(ScreenState::Rest));
        shown.push_back(picture());
        phases.push_back(std::move(shown));
    }
    for (std::size_t i = 1; i < phases.size(); ++i) {
        for (std::size_t phase = 0; phase < phases[i].size(); ++phase)
            EXPECT_TRUE(phases[i][phase] == phases[0][phase]) << conditions[i].first << ", picture " << phase;
    }
    EXPECT_FALSE(phases[0][1] == phases[0][3]) << "and the pictures are of the phases";
}

TEST_F(ParticipantLooks, TheIntervalsOfADetectionTrialHaveTheSamePixelsWhicheverHoldsTheTrain) {
    RecordProperty("hazard", "H9");
    auto marked = testScreen(ScreenState::Interval);
    marked.phase = "detection";
    marked.block = marked.blocks = 0;
    std::vector<std::vector<QImage>> seen;
    for (const int holds : {1, 1, 2}) {  // the first round does not count: letters are drawn anew then
        std::vector<QImage> shown;
        for (const int interval : {0, 1, 0, 2}) {
            marked.interval = interval;
            desk.show(marked);
            shown.push_back(picture());
        }
        FeltPresentation felt;
        felt.level = 4;
        felt.inInterval = holds;
        desk.delivered(felt);
        ASSERT_NO_FATAL_FAILURE(ask(intervalPrompt()));
        shown.push_back(picture());
        answerBy(holds == 1 ? Qt::Key_1 : Qt::Key_2);
        desk.show(testScreen(ScreenState::Rest));
        seen.push_back(std::move(shown));
    }
    seen.erase(seen.begin());
    for (std::size_t i = 0; i < seen[0].size(); ++i) EXPECT_TRUE(seen[0][i] == seen[1][i]) << "picture " << i;
    EXPECT_TRUE(seen[0][0] == seen[0][2]) << "neither passes before and between";
    EXPECT_FALSE(seen[0][0] == seen[0][1]);
    EXPECT_FALSE(seen[0][1] == seen[0][3]) << "one is told from the other";
}

std::vector<PilotPrompt> allPrompts() {
    auto condition = conditionPrompt(kFour);
    condition.within = Seconds(10);
    auto scale = scalePrompt("pain", "How painful was it?", 0, 10);
    scale.leastText = "not at all";
    scale.mostText = "as much as can be";
    auto several = choicePrompt("qualities", "What was it like? Several may fit.",
                                {{"touch", "Touch"},
                                 {"pressure", "Pressure"},
                                 {"tapping", "Tapping"},
                                 {"vibration", "Vibration"},
                                 {"tingling", "Tingling"},
                                 {"pricking", "Pricking"},
                                 {"burning", "Burning"},
                                 {"twitching", "Twitching"},
                                 {"phantom", "In the phantom hand"}});
    several.kind = PromptKind::Several;
    const auto natural = choicePrompt("naturalness", "How natural was it?",
                                      {{"1", "Totally natural"},
                                       {"2", "Almost natural"},
                                       {"3", "Possibly natural"},
                                       {"4", "Rather unnatural"},
                                       {"5", "Totally unnatural"}});
    return {condition,
            strengthPrompt(),
            intervalPrompt(),
            yesNoPrompt("code", "Is P-7K3M your code?"),
            goOnPrompt("Go on?", PromptTo::Participant),
            scale,
            several,
            natural,
            holdPrompt()};
}

TEST_F(ParticipantLooks, TargetsHave20mmAndNothingIsCutInBothThemesAndSizes) {
    const auto prompts = allPrompts();
    const int least = gui::pixelsOf(gui::kTarget_mm, window);
    RecordProperty("least_px", least);
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        for (const auto theme : themesAt(percent)) {
            gui::applyTheme(theme);
            for (const auto& size : kSizes) {
                window.resize(size);
                window.setNote("rehearsal · simulated");
                for (const auto& prompt : prompts) {
                    desk.show(testScreen(ScreenState::Feel));
                    ASSERT_NO_FATAL_FAILURE(ask(prompt));
                    QCoreApplication::processEvents();
                    const auto name = QString("participant-%1-%2-%3-%4")
                                          .arg(QString::fromStdString(prompt.name))
                                          .arg(theme == gui::Theme::Dark ? "dark" : "light")
                                          .arg(size.width())
                                          .arg(percent);
                    const bool pictured = size.width() != 1440 || percent == 100;
                    if (pictured) shot(window, name);
                    EXPECT_EQ(faultsOf(window), "") << name.toStdString();
                    for (const auto* target : window.findChildren<gui::AnswerTarget*>()) {
                        if (!target->isVisible()) continue;
                        EXPECT_GE(target->width(), least) << name.toStdString() << target->text().toStdString();
                        EXPECT_GE(target->height(), least) << name.toStdString() << target->text().toStdString();
                        EXPECT_TRUE(window.rect().contains(QRect(target->mapTo(&window, QPoint(0, 0)), target->size())))
                            << name.toStdString();
                        EXPECT_FALSE(window.findChild<gui::ParticipantStop*>()->geometry().intersects(
                            QRect(target->mapTo(&window, QPoint(0, 0)), target->size())))
                            << name.toStdString();
                    }
                    std::set<int> words_px;
                    for (const auto* target : window.field().targets()) words_px.insert(target->wordsPx());
                    EXPECT_LE(words_px.size(), 1U) << name.toStdString() << ": smaller words are chosen less";
                    desk.cancel();
                    EXPECT_FALSE(answered());
                    desk.begin(nullptr);  // another session begins
                    desk.show(testScreen(ScreenState::Rest));
                }
            }
        }
    }
}

TEST_F(ParticipantLooks, TheOtherPhasesInBothThemes) {
    auto named = testScreen(ScreenState::Named);
    named.phase = "familiarisation";
    named.block = named.blocks = 0;
    named.named = "rough-high";
    auto pause = testScreen(ScreenState::Break);
    pause.text = "At least one minute. Move your arm, if you like.";
    auto interval = testScreen(ScreenState::Interval);
    interval.phase = "detection";
    interval.block = interval.blocks = 0;
    interval.interval = 1;
    auto second = interval;
    second.interval = 2;
    const std::pair<const char*, PilotScreen> screens[] = {{"feel", testScreen(ScreenState::Feel)},
                                                           {"named", named},
                                                           {"interval-1", interval},
                                                           {"interval-2", second},
                                                           {"break", pause},
                                                           {"ended", testScreen(ScreenState::Ended)}};
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const auto& [name, screen] : screens) {
            desk.show(screen);
            QCoreApplication::processEvents();
            shot(window, QString("participant-%1-%2").arg(name, theme == gui::Theme::Dark ? "dark" : "light"));
            EXPECT_EQ(faultsOf(window), "") << name;
            if (screen.state == ScreenState::Named) EXPECT_EQ(window.field().accessibleName(), "rough, firm");
            if (screen.state == ScreenState::Feel) EXPECT_EQ(window.field().accessibleName(), "");
            const auto red = gui::stateStyle(InterlockState::Faulted).ground;
            EXPECT_EQ(pixelsOf(window.grab().toImage(), red),
                      pixelsOf(window.findChild<gui::ParticipantStop*>()->grab().toImage(), red))
                << name;
        }
    }
}

TEST_F(ParticipantLooks, StopIsLargerThanAnyGroupOfAnswers) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(ask(conditionPrompt(kFour)));
    const auto area = [](const QSize& size) { return size.width() * size.height(); };
    const auto stop = window.findChild<gui::ParticipantStop*>()->size();
    for (const auto* target : window.field().targets()) EXPECT_GT(area(stop), 3 * area(target->size()));
}

}  // namespace
}  // namespace tacto::test
