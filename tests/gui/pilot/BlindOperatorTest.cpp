// Tests that a blind operator sees the same for every condition and level: a classifier that gets all texts and pixels
// of 200 trials, by time, does no better than chance. The same classifier tells the trials apart if the operator is not
// blind, so it would find a difference.
#include <QAbstractButton>
#include <QLabel>
#include <QRegularExpression>
#include <QStatusBar>
#include <QVBoxLayout>
#include <cmath>
#include <set>

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/OperatorPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/window/NoticeBanner.h"
#include "app/gui/window/RecordingLine.h"
#include "app/gui/window/SafetyBar.h"
#include "app/run/AllDrivers.h"
#include "core/base/Random.h"
#include "core/bench/Telemetry.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/Person.h"
#include "tests/gui/pilot/BenchBehind.h"
#include "tests/gui/pilot/SeatedPeople.h"

namespace tacto::test {
namespace {

constexpr double kFrame_s = 0.25;

/// One moment of a trial: the texts of each widget, and the pixels.
using Frame = std::vector<std::size_t>;

struct SeenTrial {
    int condition = 0;  ///< 0: nothing was delivered
    std::vector<Frame> frames;
};

/// Returns everything that a widget says (text, tool tip, texts for screen readers) and whether it can be pressed.
QString textOf(const QWidget& widget) {
    auto text = widget.toolTip() + '|' + widget.accessibleName() + '|' + widget.accessibleDescription() +
                (widget.isEnabled() ? '+' : '-') + (widget.isVisible() ? '+' : '-');
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) text += label->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) text += button->text();
    return text;
}

std::size_t saidBy(const QWidget& widget) { return qHash(textOf(widget)); }

/// Returns how often the most similar other trial has the same class; draws one if several are equally similar.
double shareRight(const std::vector<SeenTrial>& trials, const std::vector<int>& classes, Random& random) {
    const auto apart = [](const SeenTrial& a, const SeenTrial& b) {
        std::size_t n = 0;
        for (std::size_t f = 0; f < std::min(a.frames.size(), b.frames.size()); ++f) {
            for (std::size_t i = 0; i < std::min(a.frames[f].size(), b.frames[f].size()); ++i)
                n += a.frames[f][i] != b.frames[f][i] ? 1 : 0;
        }
        return n;
    };
    std::size_t right = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        std::size_t least = SIZE_MAX;
        std::vector<std::size_t> nearest;
        for (std::size_t j = 0; j < trials.size(); ++j) {
            if (i == j) continue;
            const auto distance = apart(trials[i], trials[j]);
            if (distance < least) nearest.clear();
            least = std::min(least, distance);
            if (distance == least) nearest.push_back(j);
        }
        right += classes[i] == classes[nearest[random.below(nearest.size())]] ? 1 : 0;
    }
    return double(right) / double(trials.size());
}

/// Returns the score of guessing by class frequency, plus four standard deviations.
double mostByChance(const std::vector<int>& classes) {
    std::map<int, double> counts;
    for (const int each : classes) ++counts[each];
    const auto n = double(classes.size());
    double share = 0;
    for (const auto& [one, count] : counts) share += count / n * (count / n);
    return share + 4 * std::sqrt(share * (1 - share) / n);
}

class BlindOperator : public testing::Test {
protected:
    BlindOperator() {
        gui::LiveOrder order;
        order.uris = {*DeviceUri::parse("sim:")};
        order.profile = controller.profile();
        controller.day().noteAsked();
        controller.openLive(order);
        EXPECT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
        auto* column = new QVBoxLayout(&screen);
        column->addWidget(bar);
        column->addWidget(page);
        column->addWidget(status);
        screen.resize(1100, 800);
        screen.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&screen));
    }
    /// Refreshes bar and page as the window does, and returns what can be seen of them.
    Frame seen(const Telemetry& telemetry, bool blind) {
        const auto shown = blind ? blinded(telemetry) : telemetry;
        bar->refresh(shown);
        page->refresh(shown);
        notices->refresh(shown);
        Frame frame;
        for (const auto* each : screen.findChildren<QWidget*>()) frame.push_back(saidBy(*each));
        if (++frames_ % 5 != 0) return frame;
        const auto picture = screen.grab().toImage();
        frame.push_back(qHash(
            QByteArray::fromRawData(reinterpret_cast<const char*>(picture.constBits()), int(picture.sizeInBytes()))));
        return frame;
    }
    std::vector<SeenTrial> trials(bool blind, int count, Random& random) {
        BenchBehind behind;
        auto& bench = behind.bench();
        ArmRequest request;
        request.declaredLoadConfirmed = request.operatorConfirmed = true;
        EXPECT_TRUE(bench.arm(request));
        for (double level = 0.5; level <= 3; level += 0.5) {
            EXPECT_TRUE(bench.present(ascendingPresentation(Milliamps(level), Seconds(0.5))));
            EXPECT_TRUE(bench.accept(Milliamps(level)));
        }
        bar->setBlind(blind);
        line->setBlind(blind);
        std::vector<SeenTrial> all;
        for (int i = 0; i < count; ++i) {
            SeenTrial trial;
            trial.condition = int(random.below(5));
            const double level = trial.condition == 0 ? 0 : trial.condition % 2 == 0 ? 3 : 1.5;
            const Seconds interval(trial.condition > 2 ? 0.5 : 2);
            frames_ = 0;
            gui::PilotStart start;
            start.blind = blind;
            page->begin(start);
            page->count({.answers = i, .voided = i / 30, .blocks = 5});
            auto waiting = testScreen(ScreenState::Dot);
            waiting.impedance_ohm = 3200;
            page->show(waiting);
            const auto look = [&] { trial.frames.push_back(seen(bench.telemetry(), blind)); };
            const auto wait = [&](double time_s) {
                for (double gone = 0; gone < time_s; gone += kFrame_s) {
                    EXPECT_TRUE(bench.wait(Seconds(kFrame_s)));
                    look();
                }
            };
            wait(1.5);
            waiting.state = ScreenState::Feel;
            page->show(waiting);
            auto presentation = testPresentation(Milliamps(level), interval);
            presentation.notBefore = bench.clock().now() + toInstant(1.0);
            double next_s = 0;
            const auto presented = bench.present(presentation, [&](Seconds since, Instant) {
                if (since.count() < next_s) return;
                next_s += kFrame_s;
                look();
            });
            EXPECT_TRUE(presented) << presented.error().message;
            if (presented) EXPECT_EQ(presented->end, PresentationEnd::Complete) << presented->reason;
            bench.attend(Seconds(60));
            page->ask(conditionPrompt(kFour), quint64(i) + 1);
            wait(1.5);
            page->closeQuestion(quint64(i) + 1);
            waiting.state = ScreenState::Rest;
            page->show(waiting);
            wait(0.5 + 0.25 * double(random.below(4)));
            trial.frames.resize(std::min<std::size_t>(trial.frames.size(), 30));  // later frames differ in number
            all.push_back(std::move(trial));
        }
        return all;
    }

    int frames_ = 0;
    OwnDataHome home;
    gui::BenchController controller{allDrivers()};
    gui::CalibrationBook calibrations{controller};
    QWidget screen;
    gui::SafetyBar* bar = new gui::SafetyBar(controller, calibrations, &screen);
    gui::OperatorPage* page = new gui::OperatorPage(&screen);
    QStatusBar* status = new QStatusBar(&screen);
    gui::RecordingLine* line = new gui::RecordingLine(controller, *status);
    gui::NoticeBanner* notices = new gui::NoticeBanner(controller, *line, *page);
};

// Faults, stops and complaints whose words name the train must look the same for every train.
TEST_F(BlindOperator, WhatIsSaidOfAFaultIsTheSameForEveryTrain) {
    RecordProperty("hazard", "H9");
    Random random(20, "faults of trains");
    const FaultCause causes[] = {FaultCause::DeviceFault, FaultCause::OpenElectrode, FaultCause::LimitBroken,
                                 FaultCause::NetCharge};
    for (const bool blind : {true, false}) {
        bar->setBlind(blind);
        line->setBlind(blind);
        for (const auto cause : causes) {
            std::set<std::vector<std::string>> looks;
            for (int i = 0; i < 25; ++i) {
                const double level = 0.5 * double(1 + random.below(30));
                Telemetry telemetry;
                telemetry.state = InterlockState::Faulted;
                telemetry.fault = cause;
                telemetry.trainsDelivered = 1 + random.below(400);
                telemetry.trainAmplitude = level;
                const auto why = fmt::format(
                    "pulse {} of {}: {} mA was read back and {:g} V, {:E} C, where {} mA was sent", 1 + random.below(9),
                    telemetry.trainsDelivered, level, 3.3 * level, 1e-7 * level, level + 1);
                telemetry.reason = std::string_view(why);
                emit controller.failed(gui::qtext(why));
                for (int frame = 0; frame < 3; ++frame) static_cast<void>(seen(telemetry, blind));
                std::vector<std::string> texts;
                for (const auto* each : screen.findChildren<QWidget*>()) {
                    auto text = textOf(*each);
                    text.remove(QRegularExpression(R"(\d\d:\d\d:\d\d)"));  // the time of day
                    texts.push_back(text.toStdString());
                }
                looks.insert(std::move(texts));
                static_cast<void>(seen(Telemetry(), blind));
            }
            if (blind) {
                EXPECT_EQ(looks.size(), 1U) << "fault " << int(cause);
            } else {
                EXPECT_GT(looks.size(), 10U) << "they would be told apart";
            }
        }
    }
}

TEST_F(BlindOperator, AClassifierOfAllTextsAndPixelsDoesNotBeatChance) {
    RecordProperty("hazard", "H9");
    Random random(19, "blind operator");
    for (const bool blind : {true, false}) {
        const auto all = trials(blind, blind ? 200 : 40, random);
        std::vector<int> condition, empty, level, interval, before;
        int last = -1;
        for (const auto& each : all) {
            condition.push_back(each.condition);
            empty.push_back(each.condition == 0 ? 1 : 0);
            level.push_back(each.condition == 0 ? 0 : 1 + each.condition % 2);
            interval.push_back(each.condition == 0 ? 0 : each.condition > 2 ? 2 : 1);
            before.push_back(std::exchange(last, each.condition));
        }
        const std::pair<const char*, const std::vector<int>*> asked[] = {{"condition", &condition},
                                                                         {"whether it was empty", &empty},
                                                                         {"level", &level},
                                                                         {"interval", &interval},
                                                                         {"the condition before", &before}};
        for (const auto& [what, classes] : asked) {
            const double share = shareRight(all, *classes, random);
            RecordProperty((std::string(blind ? "blind " : "sighted ") + what), std::to_string(share));
            if (blind) {
                EXPECT_LE(share, mostByChance(*classes)) << what;
            } else if (classes != &before) {
                EXPECT_GT(share, mostByChance(*classes)) << what << ": the classifier would find nothing";
            }
        }
    }
}

}  // namespace
}  // namespace tacto::test
