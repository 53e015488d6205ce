#include "app/gui/runner/NextSteps.h"

#include <algorithm>

#include "app/gui/runner/WiringPanel.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "core/kinds/ResultKinds.h"

namespace tacto::gui {

namespace {

constexpr int kApart = 8, kApartWithoutIcons = 4;

struct NextStepWords {
    QString text, icon, tip;
};

NextStepWords wordsOf(NextStep step) {
    switch (step) {
        case NextStep::ResetFault:
            return {QObject::tr("Reset fault and run again…"), "run",
                    QObject::tr("Once the cause is gone. Resets the fault and runs with the settings as they are; on "
                                "hardware it asks before anything is put out.")};
        case NextStep::WithoutFault:
            return {QObject::tr("Run without the fault"), "run",
                    QObject::tr("Takes the fault out of the simulated devices under Wiring, and runs again.")};
        case NextStep::UseProfile:
            return {QObject::tr("Use this profile"), "verdict-pass",
                    QObject::tr("Uses the profile that this run made, for the open bench and for later runs. Arming "
                                "asks as always.")};
        case NextStep::Check:
            return {QObject::tr("Run check"), "run",
                    QObject::tr("Checks the stored calibration at three levels of each quantity. Stores nothing.")};
        case NextStep::Calibrate:
            return {QObject::tr("Calibrate again"), "run", QObject::tr("The full run, with the settings as they are.")};
        case NextStep::SafetyCheck:
            return {QObject::tr("Go to safety check"), "safety-check",
                    QObject::tr("Does the output stay within every limit on known loads?")};
        case NextStep::Live:
            return {QObject::tr("Go to Live"), "live", QObject::tr("Touch, and drive by hand.")};
        case NextStep::Sign:
            return {QObject::tr("Sign report…"), "sign",
                    QObject::tr("Shows the report with its lines for signatures.")};
        case NextStep::Report:
            return {QObject::tr("Report"), "report", QObject::tr("Shows the report, to print, save or find it.")};
        case NextStep::Session:
            return {QObject::tr("Open session"), "open", QObject::tr("Everything that this run recorded.")};
        case NextStep::ChangeSettings:
            return {QObject::tr("Change settings"), "settings",
                    QObject::tr("Back to the settings of this run; the result is kept in its session.")};
    }
    return {};
}

}  // namespace

std::vector<NextStep> nextStepsAfter(const FinishedRun& run) {
    const auto& outcome = run.result.outcome;
    const auto& results = outcome.results;
    const auto& kind = memberAt(results, "kind");
    const auto& traits = resultTraits(kind.is_string() ? kind.get<std::string>() : std::string());
    const bool calibrates = traits.kind == ResultKind::StimulatorCalibration;
    const auto verdict = run.result.verdict();
    const bool passed = verdict == "pass";
    // A massager takes the stimulator's place, and the safety check is a stimulator's.
    const bool massaged =
        std::ranges::any_of(run.result.devices, [](const SessionDevice& device) { return device.is(Role::Massager); });
    std::vector<NextStep> steps;
    if (run.result.stoppedBySafety && std::ranges::any_of(run.order.uris, simulatesFault))
        steps.push_back(NextStep::WithoutFault);
    else if (const auto& fault = run.result.leftIn)
        steps.push_back(fault->grave() && !massaged &&
                                resultTraits(run.order.declaration.kind).kind != ResultKind::LoadSafety
                            ? NextStep::SafetyCheck
                            : NextStep::ResetFault);
    if (outcome.error || (!passed && !verdict.empty())) {
        const bool failedCheck = calibrates && memberAt(results, "type") == "check";
        steps.push_back(failedCheck && !outcome.error ? NextStep::Calibrate : NextStep::ChangeSettings);
    } else if (passed && memberAt(results, "profile.profile").is_object()) {
        steps.push_back(NextStep::UseProfile);
    }
    if (!run.result.session.empty()) {
        if (!outcome.error) steps.push_back(NextStep::Sign);
        steps.push_back(NextStep::Report);
        if (passed && calibrates) steps.push_back(NextStep::SafetyCheck);
        if (passed && calibrates && memberAt(results, "stored").is_object()) steps.push_back(NextStep::Check);
        if (passed && traits.kind == ResultKind::LoadSafety) steps.push_back(NextStep::Live);
        steps.push_back(NextStep::Session);
    }
    return steps;
}

NextStepBar::NextStepBar(QWidget* parent) : QWidget(parent) {
    nameWidget(*this, "nextSteps", tr("What comes next"));
    afterLookChange(*this, [this] { measure(); });
    onEvent(*this, QEvent::Resize, [this] { fit(); });
}

void NextStepBar::show(const std::vector<NextStep>& steps) {
    // Deleted later, since one of these buttons may be handling its click.
    for (const auto& each : buttons_) each.button->hide(), each.button->deleteLater();
    buttons_.clear();
    for (const auto step : steps) {
        const auto words = wordsOf(step);
        auto* button = add(words.text, words.tip, words.icon);
        if (step == NextStep::Session) makeQuiet(*button);
        connect(button, &QPushButton::clicked, this, [this, step] { emit chosen(step); });
        if (step != NextStep::Report) continue;
        auto* more = add(tr("Save"), tr("Saves the report elsewhere, shows its folder, or prints it."), {});
        more->setObjectName("reportMenu");
        auto* menu = new QMenu(more);
        connect(menu, &QMenu::aboutToShow, this, [this, menu] { emit reportMenuWanted(*menu); });
        more->setMenu(menu);
    }
    measure();
    tabInPlace(*this);
}

QPushButton* NextStepBar::add(const QString& text, const QString& tip, const QString& icon) {
    auto* button = new QPushButton(text, this);
    const bool first = buttons_.empty();
    button->setToolTip(tip);
    button->setAutoDefault(false);
    makePrimary(*button, first);
    button->show();
    buttons_.push_back({button, icon.isEmpty() ? QIcon() : gui::icon(icon, first ? Ink::Primary : Ink::Text), 0, 0});
    return button;
}

/// Measures the buttons, as style and text size change their widths.
void NextStepBar::measure() {
    for (auto& each : buttons_) {
        each.button->setIcon({});
        each.bare = each.button->sizeHint().width();
        each.button->setIcon(each.icon);
        each.whole = each.button->sizeHint().width();
    }
    fit();
}

int NextStepBar::across(int Button::*width, int apart) const {
    int all = apart * std::max(0, int(buttons_.size()) - 1);
    for (const auto& each : buttons_) all += each.*width;
    return all;
}

QSize NextStepBar::sizeHint() const { return {across(&Button::whole, kApart), flow()}; }

int NextStepBar::lineWidth() const { return across(&Button::bare, kApartWithoutIcons); }

QSize NextStepBar::minimumSizeHint() const {
    int widest = 0;
    for (const auto& each : buttons_) widest = std::max(widest, each.bare);
    return {widest, flow()};
}

int NextStepBar::flow(const std::function<void(const Button&, const QRect&)>& place) const {
    const bool icons = width() >= across(&Button::whole, kApart);
    const int apart = icons ? kApart : kApartWithoutIcons;
    const int high = buttons_.empty() ? 0 : buttons_.front().button->sizeHint().height();
    int left = 0, top = 0;
    for (const auto& each : buttons_) {
        const int wide = icons ? each.whole : each.bare;
        if (left > 0 && left + wide > width()) {
            left = 0;
            top += high + apart;
        }
        if (place) place(each, {left, top, wide, high});
        left += wide + apart;
    }
    return top + high;
}

void NextStepBar::fit() {
    const bool icons = width() >= across(&Button::whole, kApart);
    for (const auto& each : buttons_) each.button->setIcon(icons ? each.icon : QIcon());
    const int above = std::max(0, (height() - flow()) / 2);
    flow([above](const Button& each, const QRect& at) { each.button->setGeometry(at.translated(0, above)); });
    updateGeometry();
}

}  // namespace tacto::gui

#include "moc_NextSteps.cpp"
