#include "app/gui/runner/NextSteps.h"

#include <algorithm>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Theme.h"
#include "core/session/ResultKind.h"

namespace tacto::gui {

namespace {

constexpr int kApart = 8, kApartWithoutIcons = 4;

struct NextStepWords {
    QString text, icon, tip;
};

NextStepWords wordsOf(NextStep step) {
    switch (step) {
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
    std::vector<NextStep> steps;
    if (outcome.error || (!passed && !verdict.empty())) {
        const bool failedCheck = calibrates && memberAt(results, "type") == "check";
        steps.push_back(failedCheck && !outcome.error ? NextStep::Calibrate : NextStep::ChangeSettings);
    } else if (passed && memberAt(results, "profile.profile").is_object()) {
        steps.push_back(NextStep::UseProfile);
    }
    if (!run.result.session.empty()) {
        if (!outcome.error) steps.push_back(NextStep::Sign);
        if (passed && traits.afterPass == AfterPass::SafetyCheck) steps.push_back(NextStep::SafetyCheck);
        if (passed && calibrates && memberAt(results, "stored").is_object()) steps.push_back(NextStep::Check);
        if (passed && traits.afterPass == AfterPass::Live) steps.push_back(NextStep::Live);
        steps.push_back(NextStep::Session);
    }
    return steps;
}

NextStepBar::NextStepBar(QWidget* parent) : QWidget(parent), row_(new QHBoxLayout(this)) {
    setObjectName("nextSteps");
    setAccessibleName(tr("What comes next"));
    row_->setContentsMargins(0, 0, 0, 0);
    row_->setSpacing(kApart);
}

void NextStepBar::show(const std::vector<NextStep>& steps) {
    buttons_.clear();
    while (auto* item = row_->takeAt(0)) {
        // Later: one of them may be what was clicked.
        if (item->widget() != nullptr) item->widget()->hide(), item->widget()->deleteLater();
        delete item;
    }
    for (const auto step : steps) {
        const auto words = wordsOf(step);
        auto* button = new QPushButton(words.text, this);
        const bool first = row_->count() == 0;
        button->setToolTip(words.tip);
        button->setAutoDefault(false);
        makePrimary(*button, first);
        if (step == NextStep::Session) makeQuiet(*button);
        connect(button, &QPushButton::clicked, this, [this, step] { emit chosen(step); });
        row_->addWidget(button);
        button->show();
        Button made{button, icon(words.icon, first ? Ink::Primary : Ink::Text), button->sizeHint().width(), 0};
        button->setIcon(made.icon);
        made.whole = button->sizeHint().width();
        buttons_.push_back(std::move(made));
    }
    fit();
}

QSize NextStepBar::room(int Button::*width, int apart) const {
    int all = apart * std::max(0, int(buttons_.size()) - 1);
    for (const auto& each : buttons_) all += each.*width;
    return {all, QWidget::minimumSizeHint().height()};
}

QSize NextStepBar::sizeHint() const { return room(&Button::whole, kApart); }

QSize NextStepBar::minimumSizeHint() const { return room(&Button::bare, kApartWithoutIcons); }

void NextStepBar::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit();
}

void NextStepBar::fit() {
    const bool icons = width() >= sizeHint().width();
    row_->setSpacing(icons ? kApart : kApartWithoutIcons);
    for (const auto& each : buttons_) each.button->setIcon(icons ? each.icon : QIcon());
    updateGeometry();
}

}  // namespace tacto::gui

#include "moc_NextSteps.cpp"
