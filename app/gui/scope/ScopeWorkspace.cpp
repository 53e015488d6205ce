#include "app/gui/scope/ScopeWorkspace.h"

#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QShortcut>
#include <QStackedWidget>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/gui/scope/ScopeColumns.h"
#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/measurements/SpectrumPanel.h"
#include "app/gui/scope/panels/ScopeControls.h"
#include "app/gui/scope/panels/ScopeStatus.h"
#include "app/gui/scope/panels/ScopeTools.h"
#include "app/gui/scope/screen/ScopeGestures.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/run/CaptureFormatsList.h"
#include "core/base/Words.h"

namespace tacto::gui {

namespace {

constexpr Word<ScopeMode> kModes[] = {
    {"auto", ScopeMode::Auto}, {"normal", ScopeMode::Normal}, {"single", ScopeMode::Single}, {"roll", ScopeMode::Roll}};

std::optional<AskedDrive> askedOf(const Telemetry& telemetry) {
    if (telemetry.driving == DriveSource::Off || !std::isfinite(telemetry.amplitude_v)) return std::nullopt;
    return AskedDrive{telemetry.driving == DriveSource::Manual, telemetry.amplitude_v, telemetry.interval_s};
}

}  // namespace

ScopeWorkspace::ScopeWorkspace(BenchController& controller, QWidget* parent)
    : QWidget(parent),
      controller_(controller),
      files_(std::make_unique<ScopeFiles>(pipe_, model_, *this)),
      tools_(new ScopeTools(files_->menu(), this)),
      status_(new ScopeStatus(model_, this)),
      screen_(new ScopeScreen(model_, this)),
      gestures_(std::make_unique<ScopeGestures>(model_, *screen_)),
      controls_(new ScopeControls(model_, *screen_, this)),
      spectrum_(new SpectrumPanel(this)),
      table_(new MeasurementTable(readings_, this)),
      stack_(new QStackedWidget(this)) {
    acquisition_ = std::make_unique<ScopeAcquisition>(controller_, controls_->acquisition());
    feed_ = std::make_unique<ScopeFeed>(model_, *acquisition_);
    setAcceptDrops(true);
    files_->show(*screen_, *table_, [this] { return caption(); });
    layOut();
    connectTools();
    connectModel();
    connectPanels();
    connectBench();
    restore();
    benchChanged();
}

/// The screen still gets events while it is destroyed (it loses mouse and focus). So the objects that handle these
/// events are destroyed before the screen, and the screen before the model.
ScopeWorkspace::~ScopeWorkspace() {
    save();
    disconnect(&model_, nullptr, this, nullptr);
    gestures_.reset();
    delete stack_;
}

void ScopeWorkspace::layOut() {
    auto* empty = new EmptyState(tr("The oscilloscope shows and measures what really arrives at the electrodes.\n"
                                    "No bench is open, and no capture is loaded."),
                                 tr("Open the simulated bench"), stack_);
    connect(empty, &EmptyState::nextStep, this, &ScopeWorkspace::openBenchWanted);
    auto* open = new QPushButton(tr("Open a capture…"), empty);
    open->setToolTip(tr("As this program, an oscilloscope or sigrok saved it: CSV, ISF, WAV or .sr."));
    connect(open, &QPushButton::clicked, files_.get(), &ScopeFiles::askOpen);
    notOpened_ = new TroubleLine("scopeProblem", empty);
    notOpened_->setAlignment(Qt::AlignCenter);
    auto* column = static_cast<QVBoxLayout*>(empty->layout());
    column->insertWidget(column->count() - 1, open, 0, Qt::AlignCenter);
    column->insertWidget(column->count() - 1, notOpened_);
    stack_->addWidget(empty);
    columns_ = new ScopeColumns({*tools_, *status_, *screen_, *spectrum_, *table_, *controls_}, stack_);
    stack_->addWidget(columns_);
    auto* layout = columnIn(*this);
    layout->setSizeConstraint(QLayout::SetNoConstraint);  // see minimumSizeHint()
    layout->addWidget(stack_);
}

void ScopeWorkspace::connectTools() {
    const auto onClick = [this](ScopeTool which, auto&& does) {
        connect(&tools_->tool(which), &QToolButton::clicked, this, does);
    };
    const auto onToggle = [this](ScopeTool which, auto* whose, auto does) {
        connect(&tools_->tool(which), &QToolButton::toggled, whose, does);
    };
    connect(&tools_->run(), &QPushButton::clicked, this, [this] { running() ? hold() : run(); });
    connect(tools_, &ScopeTools::modeChosen, this, &ScopeWorkspace::setMode);
    connect(tools_, &ScopeTools::timeBaseChosen, &model_, &ScopeModel::setTimePerDivision);
    onClick(ScopeTool::Fit, [this] { model_.fit(); });
    onClick(ScopeTool::Undo, [this] { model_.undoZoom(); });
    onToggle(ScopeTool::Box, gestures_.get(), &ScopeGestures::setBoxZoom);
    onToggle(ScopeTool::TimeCursors, &model_, &ScopeModel::setTimeCursors);
    onToggle(ScopeTool::LevelCursors, &model_, &ScopeModel::setLevelCursors);
    connect(gestures_.get(), &ScopeGestures::boxZoomEnded, &tools_->tool(ScopeTool::Box),
            [this] { tools_->tool(ScopeTool::Box).setChecked(false); });
    onClick(ScopeTool::Controls, [this](bool on) { columns_->askForControls(on); });
    onClick(ScopeTool::Table, [this](bool on) { table_->setVisible(on); });
    onClick(ScopeTool::Spectrum, [this](bool on) { controls_->view().setSpectrum(on); });
    onClick(ScopeTool::Average,
            [this](bool on) { controls_->view().setAverage(on ? controls_->view().lastAverage() : 1); });
    onClick(ScopeTool::Mask, [this](bool on) {
        on ? controls_->mask().make(model_.shown()) : controls_->mask().remove();
        showState();
    });
    onClick(ScopeTool::Mark, [this] { emit markWanted(); });
    connect(status_, &ScopeStatus::cancelClicked, &pipe_, &CapturePipe::cancelOpen);
    connect(files_.get(), &ScopeFiles::openWanted, this, &ScopeWorkspace::openCaptureFile);
    connect(files_.get(), &ScopeFiles::told, this, &ScopeWorkspace::tell);
    connect(&tools_->pictures().copy(), &QToolButton::clicked, files_.get(), &ScopeFiles::copyPicture);
    connect(&tools_->pictures(), &PictureTools::plotOnlyWanted, this, &ScopeWorkspace::plotOnlyWanted);
    addKeys();
}

void ScopeWorkspace::addKeys() {
    const auto onKey = [this](const QKeySequence& key, auto task) {
        auto* shortcut = new QShortcut(key, this);
        // The tools may be in a row outside this page; the keys work wherever the focus is.
        shortcut->setContext(Qt::WindowShortcut);
        connect(shortcut, &QShortcut::activated, this, task);
        return shortcut;
    };
    onKey(Qt::Key_A, [this] { setMode(ScopeMode::Auto); });
    onKey(Qt::Key_N, [this] { setMode(ScopeMode::Normal); });
    onKey(Qt::Key_S, [this] { setMode(ScopeMode::Single); });
    onKey(Qt::Key_T, [this] { tools_->tool(ScopeTool::TimeCursors).toggle(); });
    onKey(Qt::Key_L, [this] { tools_->tool(ScopeTool::LevelCursors).toggle(); });
    onKey(Qt::Key_B, [this] { tools_->tool(ScopeTool::Box).toggle(); });
    onKey(Qt::Key_R, [this] { running() ? hold() : run(); });
    onKey(Qt::Key_D, [this] { emit driveWanted(); });
    onKey(QKeySequence::FindNext, [this] { goToMatch(1); });
    onKey(QKeySequence::FindPrevious, [this] { goToMatch(-1); });
    auto* save = onKey(QKeySequence::Save, [this] {
        if (model_.shown()) files_->askSavePicture();
    });
    save->setObjectName("savePictureKey");  // a window with a File menu has the key there
    onKey(QKeySequence::Undo, [this] { model_.undoZoom(); });
}

void ScopeWorkspace::connectModel() {
    connect(&model_, &ScopeModel::cursorsChanged, this, &ScopeWorkspace::sayCursors);
    connect(&model_, &ScopeModel::viewChanged, this, [this] {
        tools_->tool(ScopeTool::Undo).setEnabled(model_.canUndo());
        tools_->showTimeBase(model_.viewport().perDivision_s, model_.leastTimePerDivision_s());
        sayCursors();
    });
    connect(&model_, &ScopeModel::triggerLevelChosen, this, [this](double level) {
        controls_->acquisition().setLevel(level);
        acquisition_->settingsChanged();
        say();
    });
    connect(&model_, &ScopeModel::triggerUpperChosen, &controls_->acquisition(), &AcquisitionPanel::setUpper);
    connect(&model_, &ScopeModel::preTriggerChosen, &controls_->acquisition(), &AcquisitionPanel::setPreTrigger);
}

void ScopeWorkspace::connectPanels() {
    const auto* view = &controls_->view();
    const auto* mask = &controls_->mask();
    connect(&controls_->acquisition(), &AcquisitionPanel::changed, this, [this] {
        acquisition_->settingsChanged();
        say();
    });
    connect(&controls_->acquisition(), &AcquisitionPanel::matchWanted, this, &ScopeWorkspace::goToMatch);
    connect(&search_, &RecordSearch::said, this, [this](const QString& what) { tell(what, {}); });
    connect(view, &ViewPanel::mathOptionsChanged, this, [this] {
        pipe_.setMathOptions(controls_->view().mathOptions());
        pipe_.recalculate(model_.shown());
    });
    connect(view, &ViewPanel::spectrumToggled, this, &ScopeWorkspace::showSpectrum);
    spectrum_->follow(model_);
    connect(view, &ViewPanel::averageChanged, this, &ScopeWorkspace::average);
    connect(table_, &MeasurementTable::resetClicked, this, [this] {
        pipe_.setAverage(1);
        average();
    });
    connect(mask, &MaskPanel::makeWanted, this, [this] { controls_->mask().make(model_.shown()); });
    connect(mask, &MaskPanel::maskChanged, this, [this] {
        pipe_.setMask(controls_->mask().mask());
        screen_->setMask(controls_->mask().mask());
    });
    connect(mask, &MaskPanel::countsChanged, this, [this] {
        screen_->setAlarm(controls_->mask().alarm());
        showState();
    });
    connect(mask, &MaskPanel::firstOutsideWanted, this, [this] {
        if (const auto& first = controls_->mask().firstOutside()) {
            show(first->capture, tr("first capture outside the mask"));
        }
    });
}

void ScopeWorkspace::connectBench() {
    connect(&controller_, &BenchController::changed, this, &ScopeWorkspace::benchChanged);
    connect(&controller_, &BenchController::captured, this, [this](std::shared_ptr<const Capture> capture) {
        if (running()) pipe_.take(std::move(capture));
    });
    connect(&controller_, &BenchController::marked, this, [this](double at_s, const QString& word) {
        const auto open = controller_.open();  // a run's session has its own time base
        if (open && open->session == feed_->session()) model_.addMark({at_s, word});
    });
    connect(&controller_, &BenchController::loadFitted, this, [this] {  // a mean covers one load only
        pipe_.beginAnew();
        table_->clear();
    });
    connect(acquisition_.get(), &ScopeAcquisition::requested, this, [this] {
        pipe_.breakOff();
        pipe_.setTrigger(acquisition_->requestedSettings(), acquisition_->requestedTrigger());
    });
    connect(acquisition_.get(), &ScopeAcquisition::stopped, this, [this](const QString& why) { tell({}, why); });
    connect(&pipe_, &CapturePipe::prepared, this, &ScopeWorkspace::take);
    connect(&pipe_, &CapturePipe::recalculated, this, [this](const ShownPtr& shown) {
        // A newer capture already has the new calculations.
        if (model_.shown() && model_.shown()->capture == shown->capture) model_.replaceMath(shown);
    });
    connect(&pipe_, &CapturePipe::openingChanged, this, &ScopeWorkspace::showState);
    connect(&pipe_, &CapturePipe::failed, this, [this](const QString& what) {
        status_->tellProblem(what);
        showState();
    });
}

/// Ignores the column at the right, which is hidden in a narrow window: large text must not make the window larger than
/// its screen.
QSize ScopeWorkspace::minimumSizeHint() const {
    return {screen_->minimumWidth() + fontMetrics().averageCharWidth() * 4, fontMetrics().height() * 16};
}

void ScopeWorkspace::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    acquisition_->setSeen(watched_);
    save();
}

void ScopeWorkspace::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    acquisition_->setSeen(true);
    benchChanged();
}

void ScopeWorkspace::dragEnterEvent(QDragEnterEvent* event) {
    const auto urls = event->mimeData()->urls();
    if (!urls.isEmpty() && captureFormats()->knowsSuffix(urls.first().toLocalFile().toStdString())) {
        event->acceptProposedAction();
    }
}

void ScopeWorkspace::dropEvent(QDropEvent* event) { openCaptureFile(event->mimeData()->urls().first().toLocalFile()); }

void ScopeWorkspace::resetLayout() {
    controls_->view().setSpectrum(false);
    columns_->reset();
}

void ScopeWorkspace::save() const {
    QSettings settings;
    settings.beginGroup("scope");
    settings.setValue("mode", QString::fromUtf8(wordFor(kModes, mode())));
    controls_->save(settings);
    readings_.save(settings);
    spectrum_->save(settings);
    saveView(settings, model_.chosenView());
    columns_->save(settings);
}

void ScopeWorkspace::restore() {
    QSettings settings;
    settings.beginGroup("scope");
    controls_->restore(settings);
    readings_.restore(settings);
    spectrum_->restore(settings);
    model_.setChosenView(restoredView(settings));
    columns_->restore(settings);
    applyMode(valueFor(kModes, settings.value("mode").toString().toStdString()).value_or(mode()));
}

void ScopeWorkspace::benchChanged() {
    const auto session = controller_.open() ? controller_.open()->session : std::filesystem::path();
    const bool file = model_.shown() && !model_.shown()->source.isEmpty();
    if (feed_->begin(session)) {
        pipe_.beginAnew();
        if (file) pipe_.cancelOpen();
        table_->clear();
        controls_->mask().resetCounts();
    }
    if (acquisition_->benchChanged(watched_ || isVisible())) status_->forgetProblem();
    showState();
}

QWidget* ScopeWorkspace::tools() { return &columns_->head(); }

ScopeSettings ScopeWorkspace::settings() const { return controls_->acquisition().settings(); }

void ScopeWorkspace::setWatched(bool watched) {
    watched_ = watched;
    acquisition_->setSeen(watched || isVisible());
    // Triggered captures go on unseen. While the window is destroyed a dock reports that it is hidden.
    if (watched) benchChanged();
}

void ScopeWorkspace::setMode(ScopeMode mode) {
    applyMode(mode);
    run();
}

void ScopeWorkspace::applyMode(ScopeMode mode) {
    tools_->showMode(mode);
    model_.setRoll(mode == ScopeMode::Roll);
    average();
    acquisition_->setMode(mode);
}

void ScopeWorkspace::run() {
    status_->forgetProblem();
    acquisition_->run();
    showState();
}

void ScopeWorkspace::hold() {
    acquisition_->hold();
    showState();
}

void ScopeWorkspace::refresh(const Telemetry& telemetry) {
    acquisition_->refresh(telemetry);
    pipe_.setAsked(askedOf(telemetry));
    model_.setComing(comingTrain(controller_, telemetry));
    if (isVisible()) say();
}

void ScopeWorkspace::take(const ShownPtr& shown) {
    const auto taken = feed_->take(shown);
    if (taken == ScopeFeed::Taken::Nothing) return;
    if (taken == ScopeFeed::Taken::Held) {
        table_->passOverUntriggered(true);
        emit captureShown(shown);
        return say();
    }
    if (taken == ScopeFeed::Taken::ShownAnew) table_->clear();
    status_->forget();
    if (shown->source.isEmpty()) controls_->mask().take(shown);
    if (shown->capture->untriggered)
        table_->passOverUntriggered(false);
    else
        table_->add(shown);
    emit captureShown(shown);
    showState();
}

bool ScopeWorkspace::openCaptureFile(const QString& path) {
    const QFileInfo file(path);
    if (!file.isFile() || !file.isReadable()) {
        const auto why = file.exists() ? tr("%1 is not a file that can be read.") : tr("%1 does not exist.");
        status_->tellProblem(why.arg(path));
        showState();
        return false;
    }
    emit fileAsked(path);
    hold();
    status_->forgetProblem();
    pipe_.open(path);
    return true;
}

void ScopeWorkspace::show(std::shared_ptr<const Capture> capture, const QString& source) {
    hold();
    pipe_.take(std::move(capture), source);
}

void ScopeWorkspace::saveAs(const QString& path) { files_->saveAs(path); }

void ScopeWorkspace::askSavePicture() { files_->askSavePicture(); }

std::optional<QString> ScopeWorkspace::savePicture(const QString& path) const { return files_->savePicture(path); }

void ScopeWorkspace::askSaveData() { files_->askSaveData(); }

void ScopeWorkspace::tell(const QString& done, const QString& problem) {
    status_->tell(done, problem);
    showState();
}

void ScopeWorkspace::showState() {
    tools_->showRunning(running(), acquisition_->possible());
    const auto& shown = model_.shown();
    const bool triggered = shown && std::isfinite(shown->capture->trigger_s);
    auto& mask = tools_->tool(ScopeTool::Mask);
    mask.setChecked(controls_->mask().mask() != nullptr);
    mask.setEnabled(mask.isChecked() || triggered);
    controls_->mask().canMake(triggered);
    const bool empty = !model_.shown() && controller_.activity() == Activity::Closed && !pipe_.opening();
    stack_->setCurrentIndex(empty ? 0 : 1);
    status_->setVisible(!empty);
    notOpened_->say(status_->problem());
    say();
}

void ScopeWorkspace::say() {
    auto standing = acquisition_->statusText(model_.shown().get(), pipe_.skippedCaptures());
    if (const auto mask = controls_->mask().said(); !mask.isEmpty()) standing += " · " + mask;
    status_->show(pipe_.opening() ? std::optional(pipe_.percentRead()) : std::nullopt, standing);
    const auto& shown = model_.shown();
    const bool ours = !shown || shown->source.isEmpty();
    model_.setTrigger((ours && !model_.roll()) || search_.marks()
                          ? model_.channelIn(controls_->acquisition().triggersOnCurrent() ? "A" : "V")
                          : QString(),
                      controls_->acquisition().trigger(), acquisition_->levelFollows());
    model_.setPreTrigger(ours && running() && shown ? std::optional(acquisition_->requestedSettings().preTrigger)
                                                    : std::nullopt);
    tools_->tool(ScopeTool::Undo).setEnabled(model_.canUndo());
}

void ScopeWorkspace::sayCursors() {
    const auto& shown = model_.shown();
    const auto text = readoutText(model_.readout(), shown ? shown->capture->rate_hz : 0);
    screen_->setAccessibleDescription(text.isEmpty() ? screen_->whatsThis() : text);
}

/// A record that is searched must stay.
void ScopeWorkspace::goToMatch(int step) {
    if (!model_.shown()) return tell({}, tr("No record is shown yet, so there is nothing to search."));
    if (running()) hold();
    const auto& panel = controls_->acquisition();
    search_.go(step, panel.trigger(), panel.triggersOnCurrent() ? "A" : "V");
}

/// In roll mode captures stand one after the other, so they are not averaged.
void ScopeWorkspace::average() {
    const int captures = model_.roll() ? 1 : controls_->view().average();
    pipe_.setAverage(static_cast<std::size_t>(captures));
    tools_->tool(ScopeTool::Average).setChecked(captures > 1);
    if (std::exchange(averages_, captures) != captures) table_->clear();
}

PictureCaption ScopeWorkspace::caption() const {
    const auto& shown = model_.shown();
    const auto open = controller_.open();
    QStringList more{readoutText(model_.readout(), shown ? shown->capture->rate_hz : 0)};
    if (shown && shown->source.isEmpty() && !shown->capture->untriggered)
        more << tr("Trigger %1").arg(acquisition_->triggerText());
    more << table_->asLines() << controls_->mask().said();
    return captionOf(model_, open ? &open->about : nullptr, more);
}

void ScopeWorkspace::showSpectrum() {
    const bool wanted = controls_->view().wantsSpectrum();
    spectrum_->setVisible(wanted);
    tools_->tool(ScopeTool::Spectrum).setChecked(wanted);
}

}  // namespace tacto::gui

#include "moc_ScopeWorkspace.cpp"
