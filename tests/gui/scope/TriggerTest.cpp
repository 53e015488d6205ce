// Tests the kinds of trigger on the oscilloscope's page: their fields, what they wait for on a simulated bench, how the
// screen draws them, and that they are remembered.
#include <QComboBox>
#include <QLineEdit>
#include <QSpinBox>
#include <gmock/gmock.h>

#include "app/gui/scope/panels/AcquisitionPanel.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Theme.h"
#include "core/base/Random.h"
#include "tests/gui/Looks.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::ScopeMode;
using testing::HasSubstr;

/// Also while the page shows that no bench is open.
template <class Widget>
Widget* named(QWidget& in, const char* name) {
    const auto all = in.findChildren<Widget*>();
    const auto found = std::ranges::find(all, QString(name), [](const Widget* its) { return its->accessibleName(); });
    return found == all.end() ? nullptr : *found;
}

void chooseKind(QWidget& in, TriggerKind kind) {
    auto* box = named<QComboBox>(in, "Kind of trigger");
    box->setCurrentIndex(box->findData(QString::fromUtf8(infoOf(kind).key.data())));
    emit box->activated(box->currentIndex());
}

void typeField(QWidget& in, const char* key, const QString& text) {
    auto* line = in.findChild<QLineEdit*>(key);
    ASSERT_NE(line, nullptr) << key;
    line->setText(text);
}

void typeLevel(QWidget& in, const QString& text) {
    auto* level = named<gui::QuantitySpin>(in, "Trigger level");
    level->setFocus();
    level->selectAll();
    QTest::keyClicks(level, text);
    QTest::keyClick(level, Qt::Key_Return);
}

class Trigger : public Scope {
protected:
    gui::AcquisitionPanel& panel() { return *scope.findChild<gui::AcquisitionPanel*>(); }
    /// A bench that delivers 20 V or more in phases of 200 µs, the first one positive, with the tools in Normal.
    void deliverInNormal() {
        openBench();
        deliver();
        ASSERT_IN_TIME(comes([this] { return triggered(); }));
        scope.setMode(ScopeMode::Normal);
    }
    /// Waits for a capture that came after the present one.
    void nextCapture() {
        const auto before = scope.model().shown();
        ASSERT_IN_TIME(comes([&] { return triggered() && scope.model().shown() != before; }));
    }
    double valueAt(double time_s) {
        const auto& shown = scope.model().shown();
        return scope.model().trace(scope.model().channelIn("V"))->valueAt(shown->zero_s + time_s);
    }
    double preTrigger() {
        const auto& capture = *scope.model().shown()->capture;
        return (capture.trigger_s - capture.start_s) * capture.rate_hz / double(capture.samples());
    }
};

TEST_F(Trigger, EveryKindHasTheFieldsOfItsDescriptionWithUnitAndRange) {
    showTwoPulses();
    letLive(50);
    const int wide = scope.screen().width();
    for (const auto& kind : triggerKinds()) {
        chooseKind(scope, kind.kind);
        letLive(50);
        EXPECT_EQ(scope.screen().width(), wide) << "the screen stays as it is";
        EXPECT_EQ(panel().trigger().kind, kind.kind);
        for (const auto& field : kind.fields) {
            const auto* line = panel().findChild<QLineEdit*>(QString::fromUtf8(field.key.data()));
            ASSERT_NE(line, nullptr) << field.key;
            EXPECT_EQ(line->accessibleName().toStdString(), field.title);
            EXPECT_FALSE(line->toolTip().isEmpty());
        }
        EXPECT_EQ(panel().findChild<QComboBox*>("edge") != nullptr, !kind.edges.empty());
        EXPECT_EQ(says("software trigger"), kind.kind != TriggerKind::Magnitude) << kind.key;
    }
}

TEST_F(Trigger, AFieldThatIsNotValidSaysWhyAndTheLastTriggerStays) {
    scope.setMode(ScopeMode::Normal);
    chooseKind(scope, TriggerKind::Runt);
    typeLevel(scope, "3 V");
    typeField(scope, "upper", "8");
    EXPECT_EQ(panel().trigger().upper, 8);
    for (const auto* wrong : {"2", "3", "nonsense", "1e9", "nan", ""}) {
        typeField(scope, "upper", wrong);
        const auto* trouble = panel().findChild<QLabel*>("trouble-upper");
        ASSERT_NE(trouble, nullptr);
        EXPECT_FALSE(trouble->text().isEmpty()) << wrong;
        EXPECT_EQ(panel().trigger().upper, 8) << wrong;
        EXPECT_EQ(panel().trigger().level, 3) << wrong;
    }
    typeField(scope, "upper", "9");
    EXPECT_EQ(panel().findChild<QLabel*>("trouble-upper")->text(), "");
    EXPECT_EQ(panel().trigger().upper, 9);
}

TEST_F(Trigger, AnyTriggerIsThereAgainAtTheNextStart) {
    Random random(12, "remembered triggers");
    for (int i = 0; i < 20; ++i) {
        QSettings settings(QDir::temp().filePath("tacto-trigger.ini"), QSettings::IniFormat);
        settings.clear();
        gui::AcquisitionPanel before;
        chooseKind(before, triggerKinds()[random.below(triggerKinds().size())].kind);
        const auto& info = infoOf(before.trigger().kind);
        const double level = std::round(100 * (1 + random.uniform())) / 100;
        named<gui::QuantitySpin>(before, "Trigger level")->setValue(level);
        for (const auto& field : info.fields)
            typeField(before, field.key.data(), QString::number(std::round(100 * (2 + random.uniform())) / 100));
        if (auto* rule = before.findChild<QComboBox*>("widths")) rule->setCurrentIndex(int(random.below(4)));
        if (auto* edge = before.findChild<QComboBox*>("edge")) edge->setCurrentIndex(int(random.below(3)));
        before.save(settings);
        gui::AcquisitionPanel next;
        next.restore(settings);
        EXPECT_EQ(next.trigger(), before.trigger()) << info.key;
        EXPECT_EQ(next.trigger().level, level);
    }
}

TEST_F(Trigger, APulseOfTheRightWidthTriggersAtItsEndAndAnotherDoesNot) {
    RecordProperty("hazard", "H12");
    deliverInNormal();
    chooseKind(scope, TriggerKind::Width);
    typeLevel(scope, "5 V");
    typeField(scope, "shortest", "0.15");
    typeField(scope, "longest", "0.25");
    nextCapture();
    ASSERT_IN_TIME(comes([this] { return std::abs(valueAt(0) - 5) < 0.5; }));
    EXPECT_GT(valueAt(-20e-6), 10) << "the leading phase";
    EXPECT_LT(valueAt(20e-6), 5);
    EXPECT_NEAR(preTrigger(), 0.1, 0.001);
    EXPECT_THAT(status(), HasSubstr("pulse width 150\u202fµs to 250\u202fµs at 5.00\u202fV"));
    typeField(scope, "longest", "2");
    typeField(scope, "shortest", "1");
    ASSERT_IN_TIME(comes([this] { return QString::fromStdString(status()).startsWith("Waiting for"); }));
    const auto last = scope.model().shown();
    ASSERT_IN_TIME(comes([this] { return controller.telemetry().state == InterlockState::Delivering; }));
    for (int i = 0; i < 20; ++i) {
        letLive(20);
        scope.refresh(controller.telemetry());
    }
    EXPECT_EQ(scope.model().shown(), last);
    EXPECT_TRUE(scope.running());
}

TEST_F(Trigger, OnlyTheLimitsThatTheRuleOfWidthsUsesAreAskedFor) {
    showTwoPulses();
    chooseKind(scope, TriggerKind::Width);
    auto* rule = panel().findChild<QComboBox*>("widths");
    for (const auto& word : kWidthRules) {
        rule->setCurrentIndex(rule->findData(QString::fromUtf8(word.text.data())));
        EXPECT_EQ(panel().trigger().widths, word.value);
        EXPECT_EQ(panel().findChild<QLineEdit*>("shortest")->isVisible(), word.value != WidthRule::Less);
        EXPECT_EQ(panel().findChild<QLineEdit*>("longest")->isVisible(), word.value != WidthRule::Greater);
    }
    typeField(scope, "shortest", "nonsense");
    rule->setCurrentIndex(rule->findData("less"));
    typeField(scope, "longest", "3");
    EXPECT_EQ(panel().trigger().longest_s, 3e-3) << "what is not asked for refuses nothing";
}

TEST_F(Trigger, AnOpenedFileIsSearchedFromMatchToMatch) {
    RecordProperty("hazard", "H12");
    Random random(51, "searched files");
    for (int trial = 0; trial < 6; ++trial) {
        Capture file;
        file.rate_hz = 1e6;
        file.start_s = 5 * random.uniform();
        file.trigger_s = std::nan("");
        file.channels.resize(1);
        file.channels[0].name = "voltage";
        file.channels[0].unit = "V";
        std::vector<double> ends_s;  // where the pulses of 200 samples end, on the axis
        const std::size_t pulses = 3 + random.below(4);
        std::vector<float> samples(pulses * 3000, 0);
        for (std::size_t i = 0; i < pulses; ++i) {
            const bool wide = i == 0 || random.below(2) == 0;
            const std::size_t from = 3000 * i + 100 + random.below(2000), width = wide ? 200 : 80;
            std::fill_n(samples.begin() + std::ptrdiff_t(from), width, 10.0F);
            if (wide) ends_s.push_back((double(from + width) - 0.5) * 1e-6);
        }
        file.channels[0].samples = samples;
        scope.show(std::make_shared<const Capture>(file), "file.csv");
        ASSERT_IN_TIME(
            comes([&] { return scope.model().shown() && scope.model().shown()->capture->start_s == file.start_s; }));
        chooseKind(scope, TriggerKind::Width);
        typeLevel(scope, "5 V");
        typeField(scope, "shortest", "0.1");
        typeField(scope, "longest", "0.3");
        const auto at = [&] { return scope.model().trigger().moment_s().value_or(-1); };
        const auto press = [&](const char* name) { panel().findChild<QPushButton*>(name)->click(); };
        scope.model().fit();
        scope.model().fit();  // the whole record
        for (std::size_t i = 0; i < ends_s.size(); ++i) {
            press("nextMatch");
            ASSERT_IN_TIME(comes([&] { return std::abs(at() - ends_s[i]) < 1e-9; })) << at() << ' ' << ends_s[i];
            EXPECT_THAT(status(), HasSubstr("Match " + std::to_string(i + 1) + " of "));
        }
        press("nextMatch");
        EXPECT_THAT(status(), HasSubstr("no further"));
        EXPECT_NEAR(at(), ends_s.back(), 1e-9);
        scope.model().setTimePerDivision(20e-6);
        scope.model().setTimeCentre(ends_s.back());
        for (std::size_t i = ends_s.size() - 1; i-- > 0;) {
            press("previousMatch");
            EXPECT_NEAR(at(), ends_s[i], 1e-9);
            EXPECT_NEAR(scope.model().viewport().left_s + scope.model().viewport().width_s() / 2, ends_s[i], 1e-6);
        }
        draw();
        EXPECT_TRUE(scope.screen().overlay().trigger->height) << "the level is drawn where it was found";
        typeField(scope, "longest", "0.15");
        press("nextMatch");
        if (trial == 0) shot(scope, "trigger-match");
        ASSERT_IN_TIME(comes([&] {
            return status().find("Match 1 of ") != std::string::npos ||
                   status().find("Nothing in") != std::string::npos;
        }));
    }
}

TEST_F(Trigger, ASingleFallingSlopeComesWithItsPreTriggerAndThenHolds) {
    deliverInNormal();
    chooseKind(scope, TriggerKind::Slope);
    typeLevel(scope, "-5 V");
    panel().findChild<QComboBox*>("edge")->setCurrentIndex(1);
    named<QSpinBox>(scope, "Pre-trigger")->setValue(40);
    scope.setMode(ScopeMode::Single);
    nextCapture();
    ASSERT_IN_TIME(comes([this] { return !scope.running(); }));
    EXPECT_NEAR(valueAt(0), -5, 0.5);
    EXPECT_GT(valueAt(-10e-6), valueAt(10e-6)) << "it falls";
    EXPECT_NEAR(preTrigger(), 0.4, 0.001);
    EXPECT_EQ(scope.model().shown()->capture->samples(), scope.settings().samples);
    const auto one = scope.model().shown();
    for (int i = 0; i < 10; ++i) {
        letLive(20);
        scope.refresh(controller.telemetry());
    }
    EXPECT_EQ(scope.model().shown(), one);
}

TEST_F(Trigger, ARuntIsAPulseThatDoesNotReachTheOtherThreshold) {
    deliverInNormal();
    chooseKind(scope, TriggerKind::Runt);
    typeLevel(scope, "2 V");
    typeField(scope, "upper", "150");
    nextCapture();
    ASSERT_IN_TIME(comes([this] { return std::abs(valueAt(0) - 2) < 0.5; }));
    typeField(scope, "upper", "4");
    ASSERT_IN_TIME(comes([this] { return QString::fromStdString(status()).startsWith("Waiting for"); }));
    EXPECT_THAT(status(), HasSubstr("runt beyond 2.00\u202fV, not reaching 4.00\u202fV"));
}

TEST_F(Trigger, BothThresholdsOfARuntAreDragged) {
    deliverInNormal();
    chooseKind(scope, TriggerKind::Runt);
    typeLevel(scope, "2 V");
    typeField(scope, "upper", "30");
    scope.refresh(controller.telemetry());
    const auto scale = scope.model().scaleOf(*scope.model().lane(scope.model().channelIn("V")));
    const auto dragTo = [&](double from, double to) {
        letLive(50);  // a longer status may take room from the screen
        draw();
        auto& screen = scope.screen();
        const int right = at(screen, 9.9, 0).x();
        const QPoint grip{right, at(screen, 0, scale.heightOf(from)).y()};
        ASSERT_EQ(screen.gripAt(grip).grip, gui::Grip::TriggerLevel) << from << " V";
        drag(screen, {right, at(screen, 0, scale.heightOf(from)).y()}, {right, at(screen, 0, scale.heightOf(to)).y()});
        scope.refresh(controller.telemetry());
    };
    const double perPixel = scale.perDivision * scope.screen().divisionsPerPixel();
    dragTo(30, 40);
    EXPECT_NEAR(panel().trigger().upper, 40, 2 * perPixel);
    EXPECT_EQ(panel().trigger().level, 2);
    dragTo(2, 10);
    EXPECT_NEAR(panel().trigger().level, 10, 2 * perPixel);
    dragTo(panel().trigger().upper, 5);
    EXPECT_GT(panel().trigger().upper, panel().trigger().level) << "below the other threshold it is refused";
    EXPECT_FALSE(panel().findChild<QLabel*>("trouble-upper")->text().isEmpty());
}

TEST_F(Trigger, TheHoldOffKeepsTriggersApart) {
    deliverInNormal();
    const double interval_s = controller.telemetry().interval_s, holdOff_s = 1.5 * interval_s;
    ASSERT_GT(interval_s, 0);
    typeField(scope, "holdOff", QString::number(1e3 * holdOff_s));
    nextCapture();
    nextCapture();
    for (int i = 0; i < 2; ++i) {
        const double before_s = scope.model().shown()->capture->trigger_s;
        nextCapture();
        EXPECT_GE(scope.model().shown()->capture->trigger_s - before_s, holdOff_s) << "a train every " << interval_s;
    }
}

TEST_F(Trigger, WhatDecidesIsDrawnOnTheScreen) {
    showTwoPulses();
    auto& model = scope.model();
    const auto volts = model.channelIn("V");
    const auto scale = model.scaleOf(*model.lane(volts));
    const auto drawn = [&](const SampleTrigger& its) {
        model.setTrigger(volts, its, false);
        return scope.screen().overlay().trigger.value();
    };
    SampleTrigger its{.kind = TriggerKind::Runt, .level = 5, .upper = 30};
    EXPECT_DOUBLE_EQ(*drawn(its).height, scale.heightOf(5));
    EXPECT_DOUBLE_EQ(drawn(its).other.value(), scale.heightOf(30));
    EXPECT_TRUE(drawn(its).hysteresis.empty());
    its.hysteresis = 2;
    for (const auto& [edge, bands] :
         std::initializer_list<std::pair<TriggerEdge, std::vector<std::pair<double, double>>>>{
             {TriggerEdge::Rising, {{3, 5}}},
             {TriggerEdge::Falling, {{30, 32}}},
             {TriggerEdge::Either, {{3, 5}, {30, 32}}}}) {
        its.edge = edge;
        const auto shown = drawn(its).hysteresis;
        ASSERT_EQ(shown.size(), bands.size());
        for (std::size_t i = 0; i < bands.size(); ++i) {
            EXPECT_DOUBLE_EQ(shown[i].first, scale.heightOf(bands[i].first));
            EXPECT_DOUBLE_EQ(shown[i].second, scale.heightOf(bands[i].second));
        }
    }
    its.kind = TriggerKind::Width;
    its.shortest_s = 100e-6;
    its.longest_s = 300e-6;
    const auto began = drawn(its).began_s.at(0);
    EXPECT_DOUBLE_EQ(began.first, -300e-6);
    EXPECT_DOUBLE_EQ(began.second, -100e-6);
    for (const auto rule : {WidthRule::Outside, WidthRule::Less, WidthRule::Greater}) {
        its.widths = rule;
        for (const double width_s : {50e-6, 200e-6, 400e-6}) {
            const auto bars = drawn(its).began_s;
            const bool inside = std::ranges::any_of(
                bars, [&](const auto& bar) { return bar.first <= -width_s && -width_s <= bar.second; });
            const bool triggers = rule == WidthRule::Outside ? width_s != 200e-6
                                  : rule == WidthRule::Less  ? width_s < 300e-6
                                                             : width_s > 100e-6;
            EXPECT_EQ(inside, triggers) << int(rule) << ' ' << width_s;
        }
    }
    its.kind = TriggerKind::Magnitude;
    EXPECT_FALSE(!drawn(its).began_s.empty() || drawn(its).other || !drawn(its).hysteresis.empty());
}

TEST_F(Trigger, EachKindLooksRight) {
    deliverInNormal();
    const auto set = [this](TriggerKind kind) {
        chooseKind(scope, kind);
        typeLevel(scope, "8 V");
        if (kind != TriggerKind::Magnitude) typeField(scope, "hysteresis", "3");
        if (kind == TriggerKind::Runt) typeField(scope, "upper", "60");
        if (kind != TriggerKind::Width) return;
        typeField(scope, "shortest", "0.1");
        typeField(scope, "longest", "0.4");
    };
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (const auto& kind : triggerKinds()) {
            if (theme == gui::Theme::Dark && kind.kind != TriggerKind::Width) continue;
            set(kind.kind);
            nextCapture();
            scope.model().setTimePerDivision(100e-6);
            draw();
            EXPECT_TRUE(scope.screen().overlay().trigger->height);
            shot(scope, QString("trigger-%1%2")
                            .arg(kind.key.data(), theme == gui::Theme::Dark ? "-dark" : "")
                            .toStdString()
                            .c_str());
        }
    }
    gui::applyTheme(gui::Theme::Light);
}

}  // namespace
}  // namespace tacto::test
