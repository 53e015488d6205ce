#include "app/gui/runner/ProtocolWorkspace.h"

#include "app/gui/look/ExposureTable.h"
#include "app/gui/look/Look.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/ParameterForm.h"
#include "app/gui/runner/PromptPanel.h"
#include "app/gui/runner/ResultPanel.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/runner/WorstCase.h"

namespace tacto::gui {

namespace {

enum Step { kWiring, kSettings, kRun, kResult, kAllDone };
enum Tab { kWorst, kLog, kResultTab, kReport };

QString timeText(double seconds) {
    if (seconds < 90) return QObject::tr("%1 s").arg(int(std::ceil(seconds)));
    return QObject::tr("%1 min").arg(int(std::ceil(seconds / 60)));
}

}  // namespace

void ProtocolWorkspace::fillChooser(const QString& select) {
    if (chooser_ == nullptr) return choose(fixed_);
    const QSignalBlocker quiet(chooser_);
    chooser_->clear();
    for (const auto& source : ProtocolLibrary().list()) {
        chooser_->addItem(source.shipped ? QString::fromStdString(source.name)
                                         : tr("%1 (the lab's own)").arg(QString::fromStdString(source.name)),
                          QString::fromStdString(source.name));
    }
    chooser_->setCurrentIndex(std::max(0, chooser_->findData(select)));
    choose(chooser_->currentData().toString());
}

void ProtocolWorkspace::choose(const QString& nameOrPath) {
    declaration_.reset();
    auto source = ProtocolLibrary().find(nameOrPath.toStdString());
    if (!source) return say(QString::fromStdString(source.error().message));
    source_ = std::move(*source);
    auto declaration = readDeclaration(source_);
    if (!declaration) {
        form_->show({});
        purpose_->setText({});
        wiring_->setText({});
        showButtons();
        return say(QString::fromStdString(declaration.error().message));
    }
    declaration_ = std::move(*declaration);
    say({});
    purpose_->setText(QString::fromStdString(declaration_->purpose));
    QStringList needs;
    for (const auto role : declaration_->needs) needs << text(nameOf(role));
    wiring_->setText(
        needs.isEmpty() ? tr("Needs no device.")
                        : tr("Needs: %1. \"sim:\" fills every role that no other device fills.").arg(needs.join(", ")));
    form_->show(*declaration_);
    steps_->setCurrent(kSettings);
    showButtons();
}

void ProtocolWorkspace::say(const QString& what) {
    trouble_->setText(what);
    trouble_->setVisible(!what.isEmpty());
}

void ProtocolWorkspace::preview() {
    auto load = form_->text("load");
    bool isNumber = false;
    load.toDouble(&isNumber);
    if (load.isEmpty()) load = kDefaultLoad;
    if (isNumber) load += " ohm";
    const auto worst = worstCase(desk_.profile(), desk_.limits().sets, load.toStdString());
    if (!worst) {
        worst_->show({});
        worstSays_->setText(QString::fromStdString(worst.error().message));
        return;
    }
    worst_->show(worst->rows);
    const auto strongest = tr("Strongest command of the profile: %1 every %2 into %3.")
                               .arg(settingText(desk_.profile().encoding.amplitudeMax.value(), "V"),
                                    settingText(desk_.profile().encoding.intervalMin.count(), "s"), load);
    worstSays_->setText(worst->refused.isEmpty() ? strongest + tr(" Every limit is kept.")
                                                 : strongest + " ⚠ " + worst->refused);
}

Result<RunOrder> ProtocolWorkspace::order() {
    if (!declaration_) return fail(ErrorCode::InvalidArgument, "there is no protocol to run");
    auto settings = form_->read();
    if (!settings) return failure(settings);
    RunOrder order;
    order.script = source_;
    order.declaration = *declaration_;
    order.settings = std::move(*settings);
    for (const auto& word : devices_->text().split(' ', Qt::SkipEmptyParts)) {
        auto uri = DeviceUri::parse(word.toStdString());
        if (!uri) return failure(uri);
        order.uris.push_back(std::move(*uri));
    }
    order.seed = static_cast<std::uint64_t>(seed_->value());
    order.realtime = realtime_->isChecked();
    order.profile = desk_.profile();
    order.limits = desk_.limits();
    order.out = out_->text().trimmed().toStdString();
    return order;
}

void ProtocolWorkspace::run() {
    if (running_) return;
    if (desk_.activity() == Activity::Running || desk_.activity() == Activity::Opening)
        return say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    auto asked = order();
    if (!asked) return say(QString::fromStdString(asked.error().message));
    say({});
    running_ = true;
    paused_ = false;
    since_.restart();
    result_->clear();
    log_->clear();
    plane_->begin(true);
    wave_->show(nullptr);
    progress_->setRange(0, 0);
    progress_->setFormat(tr("starting"));
    left_->setText({});
    steps_->setCurrent(kRun);
    tabs_->setCurrentIndex(kLog);
    showButtons();
    desk_.run(*asked);
}

void ProtocolWorkspace::refresh(const Telemetry&) {
    if (!running_) return;
    const auto feed = desk_.takeRunFeed();
    for (const auto& line : feed.log) log_->appendPlainText(QString::fromStdString(line));
    for (const auto& trial : feed.trials) plane_->add(trial);
    if (!feed.captures.empty()) wave_->show(feed.captures.back());
    if (const auto open = desk_.open(); open && desk_.activity() == Activity::Running && plane_->trials() == 0)
        plane_->begin(open->simulated());
    if (!feed.progress) return;
    const auto& progress = *feed.progress;
    progress_->setRange(0, int(progress.total));
    progress_->setValue(int(progress.done));
    progress_->setFormat(
        tr("%1: %2 of %3").arg(QString::fromStdString(progress.label)).arg(progress.done).arg(progress.total));
    if (progress.done > 0 && progress.total > progress.done && !paused_) {
        const double perStep = double(since_.elapsed()) / 1000 / double(progress.done);
        left_->setText(tr("about %1 left").arg(timeText(perStep * double(progress.total - progress.done))));
    }
}

void ProtocolWorkspace::ended(const FinishedRun& run) {
    if (!running_) return;
    refresh({});
    running_ = false;
    paused_ = false;
    progress_->setRange(0, 1);
    progress_->setValue(run.result.outcome.error ? 0 : 1);
    progress_->setFormat(run.result.outcome.error ? tr("ended early") : tr("done"));
    left_->setText(tr("took %1").arg(timeText(double(since_.elapsed()) / 1000)));
    steps_->setCurrent(run.result.outcome.error ? kResult : kAllDone);
    result_->show(run);
    tabs_->setCurrentIndex(kResultTab);
    showButtons();
    const auto& error = run.result.outcome.error;
    if (error && run.result.session.empty()) say(QString::fromStdString(error->message) + tr(" Output is off."));
    if (editor_ != nullptr && editor_->isVisible() && error && run.result.outcome.line > 0)
        editor_->showError(run.result.outcome.line, QString::fromStdString(error->message));
}

void ProtocolWorkspace::showButtons() {
    run_->setEnabled(!running_ && declaration_.has_value());
    pause_->setEnabled(running_);
    pause_->setText(paused_ ? tr("Res&ume") : tr("Pa&use"));
    stop_->setEnabled(running_);
    form_->setEnabled(!running_);
    if (chooser_ != nullptr) chooser_->setEnabled(!running_);
}

void ProtocolWorkspace::edit(int line, const QString& why) {
    if (editor_ == nullptr) {
        editor_ = new ScriptEditor(this);
        connect(editor_, &ScriptEditor::saved, this, [this](const QString& path) {
            const auto name = QFileInfo(path).baseName();
            if (chooser_ != nullptr)
                fillChooser(name);
            else if (name == fixed_)
                choose(fixed_);
        });
        connect(editor_, &ScriptEditor::runRequested, this, [this] { editor_->hide(); });
    }
    editor_->show(source_);
    if (line > 0) editor_->showError(line, why);
}

void ProtocolWorkspace::openReport(const QString& pdf) {
    document_->load(pdf);
    tabs_->setTabEnabled(kReport, document_->pageCount() > 0);
    if (document_->pageCount() > 0)
        tabs_->setCurrentIndex(kReport);
    else
        say(tr("%1 cannot be shown here.").arg(pdf));
}

}  // namespace tacto::gui
