#include "app/gui/runner/ProtocolWorkspace.h"

#include <QApplication>
#include <QFileInfo>
#include <QScrollBar>
#include <set>

#include "app/gui/calibrate/CalibrationView.h"
#include "app/gui/calibrate/WiringPage.h"
#include "app/gui/look/ExposureTable.h"
#include "app/gui/look/Look.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/LoadRows.h"
#include "app/gui/runner/NotesPanel.h"
#include "app/gui/runner/ParameterForm.h"
#include "app/gui/runner/PromptPanel.h"
#include "app/gui/runner/ResultPanel.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/runner/WorstCase.h"

namespace tacto::gui {

namespace {

constexpr const char* kOfLoads = "load-safety";  // shows its loads before the first was measured
constexpr const char* kOfCalibration = "stimulator-calibration";

enum Step { kWiring, kSettings, kRun, kResult, kAllDone };

QString sentence(const Error& error) {
    auto what = QString::fromStdString(error.message);
    if (!what.isEmpty()) what[0] = what[0].toUpper();
    return what.endsWith('.') ? what : what + '.';
}

}  // namespace

void ProtocolWorkspace::fillChooser(const QString& select) {
    if (chooser_ == nullptr) return choose(fixed_);
    const QSignalBlocker quiet(chooser_);
    chooser_->clear();
    const ProtocolLibrary library;
    for (const auto& source : library.list()) {
        chooser_->addItem(source.shipped ? QString::fromStdString(source.name)
                                         : tr("%1 (the lab's own)").arg(QString::fromStdString(source.name)),
                          QString::fromStdString(source.name));
        chooser_->setItemData(chooser_->count() - 1, QString::fromStdString(originOf(source)), Qt::ToolTipRole);
    }
    for (const auto& refused : library.refused()) {
        const auto path = QString::fromStdString(refused.path.string());
        chooser_->addItem(tr("%1 (refused)").arg(path), path);
        chooser_->setItemData(chooser_->count() - 1, QString::fromStdString(refused.why), Qt::ToolTipRole);
    }
    if (chooser_->count() == 0) return panel_->say(tr("No protocol was found. Write one: New…"));
    chooser_->setCurrentIndex(std::max(0, chooser_->findData(select)));
    choose(chooser_->currentData().toString());
}

void ProtocolWorkspace::choose(const QString& nameOrPath) {
    declaration_.reset();
    asked_.reset();
    showButtons();
    auto source = ProtocolLibrary().find(nameOrPath.toStdString());
    if (!source) return panel_->say(sentence(source.error()));
    source_ = std::move(*source);
    reading_.read(source_);
}

void ProtocolWorkspace::declared(const ProtocolSource& source, const Result<ProtocolDeclaration>& declaration) {
    if (source.name != source_.name || running_) return;
    // The form is made anew: who was in it shall be in it again, or no key reaches the workspace.
    const bool wasInForm = form_->isAncestorOf(QApplication::focusWidget());
    if (!declaration) {
        form_->show({});
        wiring_->show({});
        purpose_->setText(QString::fromStdString(source.name));
        const auto why = QString::fromStdString(declaration.error().message);
        panel_->say(why + tr(" Fix this before running."), lineOf(why));
    } else {
        declaration_ = *declaration;
        panel_->say({});
        purpose_->setText(QString::fromStdString(declaration_->purpose));
        wiring_->show(*declaration_);
        showPlot(plotOf());
        const auto& needs = declaration_->needs;
        const auto has = [&](Role role) { return std::find(needs.begin(), needs.end(), role) != needs.end(); };
        tabs_->setTabVisible(tabs_->indexOf(drawing_), has(Role::Stimulator) && has(Role::Oscilloscope));
        tabs_->setTabVisible(tabs_->indexOf(worstPage_), has(Role::Stimulator));  // else nothing is judged
        form_->show(*declaration_);
    }
    steps_->setNote(kRun, {});
    steps_->setNote(kResult, {});
    steps_->setCurrent(kSettings);
    // Once the form is laid out: before that it does not know how wide it must be.
    QTimer::singleShot(0, this, &ProtocolWorkspace::giveRoom);
    judge();
    showButtons();
    if (wasInForm) QTimer::singleShot(0, this, [this] { goTo(kSettings); });
    if (declaration_) emit declaredAnew();
}

/// Settings scroll up and down only: nothing may be cut at the right.
void ProtocolWorkspace::giveRoom() {
    before_->setMinimumWidth(before_->widget()->minimumSizeHint().width() +
                             before_->verticalScrollBar()->sizeHint().width());
}

ProtocolWorkspace::Plot ProtocolWorkspace::plotOf() const {
    if (source_.name == kOfLoads) return Plot::Loads;
    if (source_.name == kOfCalibration) return Plot::Calibration;
    if (!declaration_) return Plot::Trials;
    if (declaration_->needs.contains(Role::Oscilloscope)) return Plot::Trials;
    // No trains to look at: a fingertip by itself, or nothing that would be drawn.
    return declaration_->needs == std::set{Role::Sensor} ? Plot::Slides : Plot::None;
}

void ProtocolWorkspace::set(const std::string& parameter, const QString& text) {
    if (!running_) form_->set(parameter, text);
}

void ProtocolWorkspace::goTo(int step) {
    if (step == kWiring || step == kSettings) {
        QWidget* part = step == kWiring ? static_cast<QWidget*>(wiring_) : form_;
        before_->ensureWidgetVisible(part, 0, 0);
        if (auto* first = part->findChild<QLineEdit*>())
            first->setFocus();
        else
            panel_->setFocus();
        const bool drawn = step == kWiring && tabs_->isTabVisible(tabs_->indexOf(drawing_));
        const bool judged = tabs_->isTabVisible(tabs_->indexOf(worstPage_));
        tabs_->setCurrentWidget(drawn ? static_cast<QWidget*>(drawing_) : judged ? worstPage_ : log_);
    } else {
        tabs_->setCurrentWidget(step == kRun ? static_cast<QWidget*>(log_) : result_);
    }
}

void ProtocolWorkspace::judge() {
    const auto uris = devicesOf(wiring_->devices());
    steps_->setTroubled(kWiring, !uris);
    steps_->setNote(kWiring, wiring_->devices());
    const int refused = form_->refused();
    steps_->setTroubled(kSettings, refused > 0 || !declaration_);
    steps_->setNote(kSettings, refused > 0 ? tr("%n to mend", nullptr, refused) : QString());
    asked_.reset();
    panel_->setReady(declaration_.has_value(), obstacle_);
    previewLater_.start();
}

/// A run whose strongest command the gate refuses would end there, with nothing to show for it.
void ProtocolWorkspace::setObstacle(const QString& why) {
    obstacle_ = why;
    panel_->setReady(declaration_.has_value(), obstacle_);
    emit readyChanged();
}

void ProtocolWorkspace::preview() {
    const auto settings = form_->read();
    if (!settings) {
        worst_->show({});
        setObstacle({});
        return worstSays_->setText(tr("Shown again when every setting is accepted."));
    }
    const auto load = declaredLoad(settings->parameters);
    const auto worst = worstCase(desk_.profile(), desk_.limits().sets, load);
    if (!worst) {
        worst_->show({});
        setObstacle({});
        return worstSays_->setText("⚠ " + sentence(worst.error()));
    }
    worst_->show(worst->rows);
    // Without a load of its own the protocol is judged by its script, load by load.
    const bool drives = declaration_ && declaration_->needs.contains(Role::Stimulator);
    const bool judged = drives && settings->parameters.contains("load") && !worst->refused.isEmpty();
    setObstacle(judged ? tr("%1 Choose another load or profile. Nothing is put out.").arg(worst->refused) : QString());
    bool isNumber = false;
    const auto words = QString::fromStdString(load);
    const double ohms = words.section(' ', 0, 0).toDouble(&isNumber);
    const auto strongest = tr("The profile's strongest command, %1 every %2 into %3.")
                               .arg(settingText(desk_.profile().encoding.amplitudeMax.value(), "V"),
                                    settingText(desk_.profile().encoding.intervalMin.count(), "s"),
                                    isNumber && words.endsWith(" ohm") ? settingText(ohms, "ohm") : words);
    worstSays_->setText(worst->refused.isEmpty() ? tr("%1 Every limit that can be evaluated is kept.").arg(strongest)
                                                 : tr("⚠ %1 %2").arg(strongest, worst->refused));
}

Result<RunOrder> ProtocolWorkspace::order() {
    if (!declaration_) return fail(ErrorCode::InvalidArgument, "there is no protocol to run");
    auto settings = form_->read();
    if (!settings) return failure(settings);
    RunOrder order;
    order.script = source_;
    order.declaration = *declaration_;
    order.settings = std::move(*settings);
    if (auto filled = wiring_->fill(order); !filled) return failure(filled);
    order.notes = notes_->notes();
    order.profile = desk_.profile();
    order.limits = desk_.limits();
    return order;
}

void ProtocolWorkspace::runAsked() {
    if (running_ || !declaration_) return;
    if (anotherRuns()) return panel_->say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    auto asked = order();
    if (!asked) {
        panel_->say(sentence(asked.error()));
        return form_->goToRefused();
    }
    preview();  // of these settings, not of those of a moment ago
    if (!obstacle_.isEmpty()) return;
    const auto harmless = desk_.allVirtual(asked->uris);
    if (!harmless) return panel_->say(tr("%1 Nothing was opened.").arg(sentence(harmless.error())));
    asked_ = std::move(*asked);
    askedAt_ = desk_.mark();
    askedSince_.start();
    if (*harmless) return runNow();
    panel_->say({});
    panel_->askToArm(tr("This run puts out current on hardware, into a load declared as %1. Is exactly that "
                        "connected, and no person?")
                         .arg(QString::fromStdString(declaredLoad(asked_->settings.parameters))));
}

/// Also one that is just ending: what it still says is not this page's.
bool ProtocolWorkspace::anotherRuns() const {
    return desk_.activity() != Activity::Closed && desk_.activity() != Activity::Live;
}

void ProtocolWorkspace::runNow() {
    if (running_ || !asked_) return;
    if (anotherRuns()) return panel_->say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    // The first of the two steps is void after a stop, and does not wait for ever.
    if (desk_.stoppedSince(askedAt_) || askedSince_.nsecsElapsed() > Interlock::kConfirmWithin.count())
        return panel_->say(tr("The question was answered after a stop or after 30 s. Press Run again."));
    running_ = true;
    paused_ = seenPaused_ = false;
    result_->clear();
    document_->close();
    tabs_->setTabEnabled(tabs_->indexOf(pdf_), false);
    log_->clear();
    plane_->begin(false, featuresOf(plotOf()));
    loads_->begin();
    calibration_->begin(asked_->settings.parameters);
    calibration_->setSimulated(false);
    showPlot(plotOf());
    wave_->show(nullptr);
    panel_->begin();
    steps_->setNote(kRun, {});
    steps_->setNote(kResult, {});
    steps_->setCurrent(kRun);
    tabs_->setCurrentWidget(log_);
    showButtons();
    desk_.run(*std::exchange(asked_, std::nullopt), askedAt_);
}

void ProtocolWorkspace::refresh(const Telemetry& telemetry) {
    if (!running_) return;
    const auto feed = desk_.takeRunFeed();
    for (const auto& line : feed.log) log_->appendPlainText(QString::fromStdString(line));
    for (const auto& trial : feed.trials) {
        plane_->add(trial);
        if (LoadRows::isOfLoad(trial)) {
            loads_->add(trial);
            showPlot(Plot::Loads);
        } else if (CalibrationView::isReading(trial)) {
            calibration_->add(trial);
            showPlot(Plot::Calibration);
        }
    }
    calibration_->draw();
    if (!feed.captures.empty()) {
        wave_->show(feed.captures.back());
        emit captured(feed.captures.back());
    }
    if (feed.progress) steps_->setNote(kRun, tr("%1 of %2").arg(feed.progress->done).arg(feed.progress->total));
    // It may have been paused and resumed from elsewhere.
    const bool isPaused = telemetry.state == InterlockState::Paused;
    if (isPaused != std::exchange(seenPaused_, isPaused)) paused_ = isPaused;
    panel_->show(feed.progress ? &*feed.progress : nullptr, paused_, prompt_->open());
}

void ProtocolWorkspace::ended(const FinishedRun& run) {
    if (!running_) return;
    refresh({});
    running_ = false;
    prompt_->close();
    const auto& error = run.result.outcome.error;
    plane_->setSimulated(run.result.simulated);
    calibration_->setSimulated(run.result.simulated);
    panel_->end(error.has_value());
    // A script may return anything under any name.
    const auto shows = [&](auto&& show) {
        try {
            show();
        } catch (const nlohmann::json::exception& problem) {
            panel_->say(
                tr("The results do not have the shape that is shown here (%1); the session holds them as they are.")
                    .arg(QString::fromUtf8(problem.what())));
        }
    };
    shows([&] { loads_->end(run.result.outcome.results); });
    shows([&] { calibration_->end(run.result.outcome.results); });
    shows([&] { result_->show(run); });
    steps_->setCurrent(kAllDone);
    steps_->setTroubled(kRun, false);
    steps_->setNote(kResult, result_->word());
    tabs_->setCurrentWidget(result_);
    showButtons();
    if (!error) return;
    if (run.result.session.empty()) panel_->say(tr("%1 Output is off.").arg(sentence(*error)));
    if (editor_ != nullptr && editor_->isVisible() && run.result.outcome.line > 0)
        editor_->showError(run.result.outcome.line, QString::fromStdString(error->message));
}

void ProtocolWorkspace::showButtons() {
    panel_->setReady(declaration_.has_value(), obstacle_);
    form_->setEnabled(!running_);
    wiring_->setEnabled(!running_);
    notes_->setEnabled(!running_);
    if (chooser_ != nullptr) chooser_->setEnabled(!running_);
}

void ProtocolWorkspace::edit(const ProtocolSource& source, int line, const QString& why) {
    if (editor_ == nullptr) {
        editor_ = new ScriptEditor(this);
        connect(editor_, &ScriptEditor::saved, this, &ProtocolWorkspace::saved);
        connect(editor_, &ScriptEditor::runRequested, this, [this](const QString& path) {
            editor_->hide();
            window()->activateWindow();
            saved(path);
            goTo(kSettings);
        });
    }
    editor_->edit(source);
    if (line > 0) editor_->showError(line, why);
}

void ProtocolWorkspace::saved(const QString& path) {
    if (running_) return;  // the next choice reads it
    const auto name = QFileInfo(path).completeBaseName();
    if (chooser_ != nullptr)
        fillChooser(name);
    else if (name == fixed_)
        choose(fixed_);
}

void ProtocolWorkspace::openReport(const QString& pdf) {
    document_->load(pdf);
    const bool readable = document_->pageCount() > 0;
    tabs_->setTabEnabled(tabs_->indexOf(pdf_), readable);
    if (readable)
        tabs_->setCurrentWidget(pdf_);
    else
        panel_->say(tr("%1 cannot be shown here. Open it with another program.").arg(pdf));
}

}  // namespace tacto::gui
