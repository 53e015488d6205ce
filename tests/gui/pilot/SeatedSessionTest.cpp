// Runs a whole session at the two windows: every answer is a key of the participant or a click of the operator, and the
// result contains exactly these answers. Nothing on the participant's screen gives an answer away.
#include <QAbstractButton>
#include <QLineEdit>
#include <QTableWidget>
#include <map>

#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/pilot/OperatorStrip.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/pilot/PilotResult.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/pilot/PilotSession.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/BenchBehind.h"
#include "tests/gui/pilot/SeatedPeople.h"

namespace tacto::test {
namespace {

/// Participant and operator, each at their window.
class SeatedSession : public Seated {
protected:
    SeatedSession() {
        page.resize(880, 720);
        page.setVisible(true);
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&page));
        giveKeys();
        onePress = std::chrono::seconds(2);  // they press STOP once, when it is tested
        QObject::connect(&desk, &gui::ParticipantDesk::asked, &page, [this](const PilotPrompt& prompt, quint64 id) {
            asked = prompt;
            page.ask(prompt, id);
        });
        QObject::connect(&desk, &gui::ParticipantDesk::closed, &page, [this](quint64 id) { page.closeQuestion(id); });
        QObject::connect(&desk, &gui::ParticipantDesk::screenChanged, &page,
                         [this](const PilotScreen& screen) { page.show(screen); });
        QObject::connect(&page.question(), &gui::OperatorAsk::answered, &page,
                         [this](quint64 id, const PilotAnswer& given) {
                             desk.answerAsOperator(id, given);
                             giveKeys();
                         });
        QObject::connect(&strip, &gui::OperatorStrip::stopWanted, &page,
                         [this] { static_cast<void>(desk.stopBy("operator (STOP)")); });
    }
    void giveKeys() {
        window.takeKeys();
        EXPECT_IN_TIME(QTest::qWaitForWindowActive(&window));
    }
    /// Presses the key of a target, or clicks the target if it has no key.
    void pressTarget(std::size_t at) {
        const gui::AnswerKeys theirs(gui::KeySet::Figures, asked);
        for (int each = Qt::Key_0; each <= Qt::Key_Z; ++each) {
            if (theirs.targetOf(each) == static_cast<int>(at)) return key(static_cast<Qt::Key>(each));
        }
        QTest::mousePress(window.field().targets().at(at), Qt::LeftButton);
    }
    void pressTarget(const std::string& name) {
        const auto& targets = window.field().targets();
        for (std::size_t i = 0; i < targets.size(); ++i) {
            if (targets[i]->objectName().toStdString() == name) return pressTarget(i);
        }
        ADD_FAILURE() << "no target " << name << " on: " << window.title().toStdString();
    }
    [[nodiscard]] bool isOf(PromptTo to) const { return asked.to == to || asked.to == PromptTo::Both; }

    /// Answers what this person felt, not always truthfully, in a pattern that uses every answer.
    void answerAsParticipant() {
        const auto felt = people.felt();
        if (asked.name == "stop-test") return key(Qt::Key_Escape);
        if (asked.name == "on-demand") return pressTarget("go-on");
        switch (asked.kind) {
            case PromptKind::Hold:
                return QTest::keyPress(window.windowHandle(), Qt::Key_H);
            case PromptKind::Strength:
                return pressTarget(felt.level < 3   ? "nothing"
                                   : felt.level < 6 ? "weak"
                                   : felt.level < 9 ? "strong"
                                                    : "too-strong");
            case PromptKind::Interval:
                ++twoIntervals;
                return pressTarget((felt.level < 3 ? twoIntervals % 2 == 0 : felt.inInterval == 1) ? "first"
                                                                                                   : "second");
            case PromptKind::Condition: {
                const bool test = felt.drawnFor.find(" test ") != std::string::npos;
                static const std::vector<std::string> said{"rough-high", "none",       "smooth-low", "rough-low",
                                                           "not-sure",   "rough-high", "smooth-high"};
                const auto chosen = test ? said[answers.size() % said.size()] : conditionOf(felt);
                if (test) answers.emplace_back(felt, chosen);
                return pressTarget(chosen);
            }
            case PromptKind::Several:
                return pressTarget(window.field().targets().size() - 1);  // the button "done"
            case PromptKind::Scale:
                return pressTarget(3);
            case PromptKind::YesNo:
            case PromptKind::GoOn:
            case PromptKind::Choice:
            case PromptKind::Text:
                return pressTarget(0);
        }
    }
    void answerAsOperator() {
        if (asked.name == "stop-test") {
            QTest::mousePress(strip.findChild<gui::ParticipantStop*>("operatorStop"), Qt::LeftButton);
            return;
        }
        if (auto* line = page.question().findChild<QLineEdit*>("operatorAnswer")) {
            QTest::keyClicks(line, "L-2044");
            return QTest::keyClick(line, Qt::Key_Return);
        }
        for (auto* button : page.question().findChildren<QAbstractButton*>()) {
            if (button->isVisible()) return click(*button);
        }
        ADD_FAILURE() << "the operator has no answer to: " << asked.text;
    }
    /// The name that this presentation had in the familiarisation.
    [[nodiscard]] std::string conditionOf(const FeltPresentation& felt) const {
        if (felt.level <= 0) return "none";
        for (const auto& each : people.all()) {
            if (!each.named.empty() && each.level == felt.level && each.interval == felt.interval) return each.named;
        }
        return "not-sure";
    }

    Feeling people{desk};
    BenchBehind behind;
    gui::OperatorPage page;
    gui::OperatorStrip strip;
    PilotPrompt asked;
    int twoIntervals = 0;
    std::vector<std::pair<FeltPresentation, std::string>> answers;
};

TEST_F(SeatedSession, IsAnsweredByKeysAndClicksAndComesToTheMatrixOfTheseAnswers) {
    RecordProperty("hazard", "H9");
    PilotSession session(behind.bench(), people, behind.record(), behind.settings(), nullptr, 1);
    const auto script = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find("pilot-identification");
    ASSERT_TRUE(script) << script.error().message;
    RunRequest request;
    request.script = *script;
    const auto declared = readDeclaration(*script);
    ASSERT_TRUE(declared) << declared.error().message;
    request.declaration = *declared;
    request.parameters = applySettings(*declared, {{"participant", "P-7K3M"}}).value().parameters;
    request.bench = &behind.bench();
    request.asked = behind.bench().stops().mark();
    request.session = &behind.writer();
    request.pilot = &session;
    auto run = ScriptRun::start(std::move(request));
    ASSERT_TRUE(run) << run.error().message;
    auto ended = std::async(std::launch::async, [&] { return (*run)->wait(); });
    const bool done = comesTrue(
        [&] {
            if (ended.wait_for(std::chrono::seconds(0)) == std::future_status::ready) return true;
            if (window.title().contains("let go")) QTest::keyRelease(window.windowHandle(), Qt::Key_H);
            if (isOf(PromptTo::Participant) && window.asking()) answerAsParticipant();
            if (isOf(PromptTo::Operator) && page.question().open()) answerAsOperator();
            return false;
        },
        60'000);
    ASSERT_IN_TIME(done) << "still asks: " << asked.text << " / " << window.title().toStdString();
    const auto outcome = ended.get();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const auto& results = outcome.results;

    ASSERT_EQ(answers.size(), 18U) << "four of each condition and two empty ones";
    const double low = results["range"]["min_ma"], high = results["range"]["max_ma"];
    std::map<std::pair<std::string, std::string>, int> said;
    int right = 0, named = 0, empty = 0;
    for (const auto& [felt, given] : answers) {
        if (felt.level <= 0) {
            ++empty;
            named += given != "none" && given != "not-sure";
            continue;
        }
        EXPECT_TRUE(felt.level == low || felt.level == high) << felt.level;
        const auto condition = std::string(felt.level == high ? "rough-" : "smooth-") +
                               (felt.interval == behind.settings().shortest ? "high" : "low");
        ++said[{condition, given}];
        right += condition == given;
    }
    EXPECT_EQ(results["n"], 16);
    EXPECT_EQ(results["hits"], right);
    EXPECT_EQ(results["catch"]["n"], empty);
    EXPECT_EQ(results["catch"]["false_alarms"], named);
    gui::FinishedRun finished;
    finished.result.outcome = outcome;
    gui::PilotResult view;
    view.show(finished.result, "/study");
    const auto* matrix = view.findChild<QTableWidget*>("confusion");
    ASSERT_EQ(matrix->rowCount(), 4);
    std::set<std::string> columns;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto label = results["labels"][row].get<std::string>();
        for (std::size_t column = 0; column < 6; ++column) {
            const auto given = results["columns"][column].get<std::string>();
            const int expected = said[{label, given}];
            if (expected > 0) columns.insert(given);
            EXPECT_EQ(results["confusion"][row][column], expected) << label << ", " << given;
            const auto* item = matrix->item(static_cast<int>(row), static_cast<int>(column) + 1);
            ASSERT_NE(item, nullptr);
            EXPECT_EQ(item->text().toInt(), expected) << label << ", " << given;
        }
    }
    EXPECT_EQ(columns.size(), 6U) << "each answer was given";
    EXPECT_EQ(behind.record().count(row::kParticipantStop), 0U);
    EXPECT_EQ(behind.record().count(row::kSessionEnd), 1U);
}

TEST_F(SeatedSession, TheParticipantsScreenIsTheSameInATrialWhateverIsPresented) {
    RecordProperty("hazard", "H9");
    PilotStage stage(behind.bench(), people, behind.record(), behind.settings());
    auto prompt = conditionPrompt(kFour);
    prompt.within = Seconds(1e6);  // so that the drawn remaining time stands still in these pictures
    std::vector<QImage> shown;
    const auto look = [&] {
        const auto now = window.grab().toImage();
        if (shown.empty() || shown.back() != now) shown.push_back(now);
    };
    QObject::connect(&desk, &gui::ParticipantDesk::screenChanged, &window, look);
    const auto trial = [&](const std::string& name, double level, double interval_s) {
        StageTrial made;
        made.name = name;
        made.level = level;
        made.presentation = testPresentation(Milliamps(level), Seconds(interval_s));
        made.prompt = prompt;
        made.screen = testScreen(ScreenState::Feel);
        shown.clear();
        auto running = std::async(std::launch::async, [&] {
            auto said = stage.trial(made);
            if (said && level > 0) {
                if (auto kept = stage.judged(level, false, name, false); !kept)
                    return Result<StageAnswer>(failure(kept));
            }
            desk.show(testScreen(ScreenState::Rest));
            return said;
        });
        bool pressed = false;
        const auto ready = [&] { return running.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
        EXPECT_IN_TIME(comesTrue([&] {
            if (window.asking() && !pressed) {
                look();
                key(Qt::Key_2);
                pressed = true;
                look();
            }
            return ready();
        }));
        look();
        letLive(160);  // so that no key counts as held
        const auto said = running.get();
        EXPECT_TRUE(said) << said.error().message;
        return shown;
    };
    auto armed = std::async(std::launch::async, [&] { return stage.ready(); });
    ASSERT_IN_TIME(comesTrue([&] { return armed.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    ASSERT_TRUE(armed.get());
    static_cast<void>(trial("first", 0.5, 0.5));  // Qt draws letters anew the first time
    const auto expected = trial("weak and slow", 0.5, 2);
    EXPECT_GE(expected.size(), 3U) << "the dot, the targets, and nothing";
    const std::tuple<const char*, double, double> others[] = {
        {"weak and fast", 0.5, 0.5}, {"strong and slow", 1, 2}, {"strong and fast", 1, 0.5}, {"empty", 0, 0.5}};
    for (const auto& [name, level, interval_s] : others) {
        const auto seen = trial(name, level, interval_s);
        ASSERT_EQ(seen.size(), expected.size()) << name;
        for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i] == expected[i]) << name << ", picture " << i;
    }
}

}  // namespace
}  // namespace tacto::test
