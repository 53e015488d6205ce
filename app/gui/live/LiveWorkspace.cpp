#include "app/gui/live/LiveWorkspace.h"

#include <QScrollBar>
#include <QShortcut>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/live/CommandPanel.h"
#include "app/gui/live/ProfileEditor.h"
#include "app/gui/live/RigPanel.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/exchange/recordings/OpenRecording.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::gui {

namespace {

constexpr int kSideEvery_ms = 90;                 // ten numbers a second are as many as one can read
constexpr int kPlaneEvery_ms = 30;                // looks smooth; the strips are drawn with every picture
constexpr int kReadingEvery_ms = 100;             // interval at which captures are measured for the train strip
constexpr int kStripChars = 32;                   // least width of the strips in characters
constexpr std::size_t kLongestReading = 100'000;  // samples; longer captures are left to the oscilloscope workspace

bool isSimulated(const OpenBench& bench, Role role) {
    return std::any_of(bench.about.devices.begin(), bench.about.devices.end(),
                       [&](const auto& device) { return device.is(role) && device.simulated; });
}

bool isReplay(const OpenBench& bench) {
    return std::any_of(bench.about.devices.begin(), bench.about.devices.end(),
                       [](const auto& device) { return device.uri.starts_with("recording:"); });
}

/// A column that scrolls only if its parts do not fit at their least height, which wrapped text would exceed.
class LeastColumn final : public QWidget {
public:
    /// `follow`: called when the parts need a different size.
    LeastColumn(std::function<void()> follow, QWidget* parent) : QWidget(parent), follow_(std::move(follow)) {}
    [[nodiscard]] int heightForWidth(int width) const override { return layout()->totalMinimumHeightForWidth(width); }

protected:
    bool event(QEvent* event) override {
        const bool done = QWidget::event(event);
        if (event->type() == QEvent::LayoutRequest) follow_();
        return done;
    }

private:
    std::function<void()> follow_;
};

}  // namespace

LiveWorkspace::LiveWorkspace(BenchController& controller, QWidget* parent) : QWidget(parent), controller_(controller) {
    auto* layout = columnIn(*this);
    stack_ = new QStackedWidget(this);
    layout->addWidget(stack_, 1);
    stack_->addWidget(buildEmpty());
    auto* opening = new QLabel(tr("Opening…"), stack_);
    opening->setAlignment(Qt::AlignCenter);
    stack_->addWidget(opening);
    stack_->addWidget(buildBench());
    buildTools();
    layout->insertWidget(0, tools_);
    connect(&controller_, &BenchController::changed, this, &LiveWorkspace::begin);
    connect(&controller_, &BenchController::captured, this, [this](const std::shared_ptr<const Capture>& capture) {
        if (capture && !capture->untriggered) readCapture(*capture);  // the capture was triggered, so it shows a train
    });
    connect(&controller_, &BenchController::marked, this, [this](double at_s, const QString& word) {
        history_.addMark({at_s, word.toStdString()});
    });
    connect(&controller_, &BenchController::failed, this, [this] {
        if (controller_.activity() == Activity::Opening) pendingSpeed_.reset();
    });
    begin();
    onEvent(*this, QEvent::Resize, [this] { fit(); });
}

QWidget* LiveWorkspace::buildEmpty() {
    auto* empty = new QWidget(stack_);
    auto* column = new QVBoxLayout(empty);
    column->addStretch();
    auto* what = new EmptyState(tr("No device is open. Here you see what a fingertip feels, and drive the stimulator "
                                   "with it or by hand."),
                                tr("Open the simulated bench"), empty);
    connect(what, &EmptyState::nextStep, this, &LiveWorkspace::openSimulated);
    what->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    column->addWidget(what);
    auto* recording = new QPushButton(tr("Open a &recording…"), empty);
    recording->setToolTip(
        tr("The recording.json of a recorded fingertip: it is replayed into the simulated stimulator."));
    connect(recording, &QPushButton::clicked, this, &LiveWorkspace::chooseRecording);
    recording->setAutoDefault(false);
    column->addWidget(recording, 0, Qt::AlignCenter);
    auto* example = new QPushButton(tr("Replay the &example"), empty);
    example->setToolTip(tr("A simulated fingertip on smooth and on rough, each lightly and firmly."));
    connect(example, &QPushButton::clicked, this, &LiveWorkspace::replayExample);
    column->addWidget(example, 0, Qt::AlignCenter);
    column->addStretch();
    return empty;
}

QWidget* LiveWorkspace::buildBench() {
    auto* bench = new QWidget(stack_);
    auto* layout = columnIn(*bench, -1, {8, 4, 8, 4});
    staleLine_ = makeLabel<ElidedLabel>({}, {.name = "staleLine", .tone = Tone::Warning}, bench);
    staleLine_->hide();
    layout->addWidget(staleLine_);
    split_ = new QSplitter(Qt::Horizontal, bench);
    split_->setChildrenCollapsible(false);
    strips_ = new StripPlots(history_, split_);
    split_->addWidget(strips_);
    side_ = new QScrollArea(split_);
    fillSide();
    split_->addWidget(side_);
    split_->setStretchFactor(0, 1);
    split_->setStretchFactor(1, 0);
    layout->addWidget(split_, 1);
    return bench;
}

void LiveWorkspace::fillSide() {
    side_->setObjectName("fingertipSide");
    scrollDownOnly(*side_);
    side_->setWhatsThis(tr("Where the fingertip is, and what it feels. The arrow keys scroll it."));
    QWidget* side = new LeastColumn([this] { fit(); }, side_);
    auto* layout = columnIn(*side, -1, {8, 0, 8, 0});
    where_ = makeLabel({}, {.name = "whereTitle", .size = TextSize::Small, .strong = true}, side);
    layout->addWidget(where_);
    plane_ = new TactilePlane(side);
    layout->addWidget(plane_, 1);
    command_ = new CommandPanel(side);
    layout->addWidget(command_);
    taxels_ = new TaxelMap(side);
    layout->addWidget(taxels_);
    rig_ = new RigPanel(controller_, side);
    connect(rig_, &RigPanel::replayAgain, this, &LiveWorkspace::replayAgain);
    layout->addWidget(rig_);
    auto* profile = new QPushButton(tr("Encoding profile…"), side);
    profile->setToolTip(tr("How R and P become amplitude and interval, and the shape of a pulse."));
    connect(profile, &QPushButton::clicked, this, [this] { editProfile(); });
    layout->addWidget(profile);
    layout->addStretch();
    side_->setWidget(side);
    for (auto* ground : {side, side_->viewport()}) ground->setAutoFillBackground(false);
}

/// Puts the side column next to the strips if the visible width allows; there the column scrolls by itself. Otherwise
/// the column is below the strips at full height, and the page scrolls.
void LiveWorkspace::fit() {
    const auto* side = side_->widget();
    const int narrowest = side->minimumSizeHint().width() + side_->verticalScrollBar()->sizeHint().width();
    side_->setMinimumWidth(narrowest);
    strips_->setMinimumWidth(fontMetrics().averageCharWidth() * kStripChars);
    const auto edges = split_->parentWidget()->layout()->contentsMargins();
    const int room = widthInSight(*this) - edges.left() - edges.right();
    const bool beside = room >= strips_->minimumWidth() + split_->handleWidth() + narrowest;
    split_->setOrientation(beside ? Qt::Horizontal : Qt::Vertical);
    side_->setMinimumHeight(beside ? 0 : std::max(0, side->heightForWidth(room)));
    freeze_->setText(beside ? tr("Free&ze") : QString());  // if the word does not fit, only icon and tool tip are left
}

void LiveWorkspace::buildTools() {
    tools_ = new QWidget(this);
    auto* row = rowIn(*tools_, 8, {8, 0, 0, 0});
    freeze_ = new QPushButton(icon("pause"), tr("Free&ze"), tools_);
    makeQuiet(*freeze_);
    freeze_->setAccessibleName(tr("Freeze"));
    freeze_->setCheckable(true);
    freeze_->setToolTip(tr("Stops the plots so that you can drag and zoom them. Output and recording continue."));
    connect(freeze_, &QPushButton::toggled, strips_, &StripPlots::setFrozen);
    auto* window = new QComboBox(tools_);
    for (const int seconds : {2, 5, 10, 30}) window->addItem(tr("%1 s").arg(seconds), seconds);
    window->setCurrentIndex(2);
    window->setToolTip(tr("How much time the plots show."));
    window->setAccessibleName(tr("Window"));
    connect(window, &QComboBox::currentIndexChanged, this,
            [this, window] { strips_->setWindow(window->currentData().toDouble()); });
    health_ = makeLabel<ElidedLabel>({}, {.name = "sensorHealth"}, tools_);
    health_->setAccessibleName(tr("Sensor health"));
    health_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setTone(*health_, Tone::Quiet);
    setTextSize(*health_, TextSize::Small);
    addAll(*row, {freeze_, window});
    auto* holder = new QWidget(tools_);
    auto* tools = new ToolRow(holder);
    addViewTools(*tools);
    tools->addBetween(health_);
    auto* pictures = new PictureTools(holder);
    pictures->addTo(*tools);
    pictures->takeFrom([this] { return Still(*strips_); }, "live");
    connect(pictures, &PictureTools::plotOnlyWanted, this, &LiveWorkspace::plotOnlyWanted);
    captionPictures(*strips_, [this] { return caption(); });
    row->addWidget(holder, 1);
}

PictureCaption LiveWorkspace::caption() const {
    PictureCaption caption;
    const auto open = controller_.open();
    caption.title = pictureTitle(tr("Touch"), open && open->simulated());
    caption.date = pictureDate(strips_->takenAt());
    if (open) caption.lines << deviceNames(open->about.devices);
    caption.lines << strips_->scalesText() << strips_->readingsText();
    if (!strips_->frozen()) caption.lines << health_->text();  // the present health; a frozen picture has none
    return caption;
}

void LiveWorkspace::addViewTools(ToolRow& row) {
    const auto tool = [&](const QString& name, const QString& tip, const char* picture, auto&& does) {
        auto* button = makeTool(name, tip, picture, tools_);
        connect(button, &QToolButton::clicked, this, does);
        row.addWidget(button);
        return button;
    };
    auto* fit =
        tool(tr("Fit"), tr("Shows the whole frozen picture again, like a double click on it. Freeze the plots first."),
             "fit", [this] { strips_->fit(); });
    auto* undo = tool(tr("Undo zoom"), tr("Ctrl+Z: undoes the last drag or zoom of a frozen picture."), "undo-zoom",
                      [this] { strips_->undoZoom(); });
    tool(tr("Mark"), tr("Ctrl+M: marks this moment of the recording, with a word."), "mark",
         [this] { emit markWanted(); });
    const auto enable = [this, fit, undo] {
        fit->setEnabled(strips_->frozen());
        undo->setEnabled(strips_->canUndo());
    };
    connect(strips_, &StripPlots::viewChanged, this, enable);
    enable();
    auto* key = new QShortcut(QKeySequence::Undo, strips_);  // works wherever the focus is, for example after Freeze
    connect(key, &QShortcut::activated, strips_, &StripPlots::undoZoom);
}

void LiveWorkspace::begin() {
    const auto open = controller_.open();
    tools_->setEnabled(open != nullptr);
    if (!open) health_->clear();  // without a bench there is no health to report
    stack_->setCurrentIndex(open ? kBench : controller_.activity() == Activity::Opening ? kOpening : kEmpty);
    const bool touch = open && isSimulated(*open, Role::Sensor), source = open && isSimulated(*open, Role::Stimulator);
    if (controller_.tap() != tap_) {
        tap_ = controller_.tap();
        history_.begin(open ? open->streams : std::vector<StreamInfo>{});
        freeze_->setChecked(false);
        strips_->begin(touch, source, amplitudeUnit(open && open->source ? open->source->drive : Drive::Voltage));
        taxels_->clear();
        taxels_->setVisible(history_.info(StreamKind::Taxels) != nullptr);
        taxels_->setSimulated(touch);
        rig_->begin(pendingSpeed_.value_or(1), open && isReplay(*open));
        if (tap_) pendingSpeed_.reset();
    }
    plane_->setOrigin(touch, controller_.profile().roughness.calibrated);
    plane_->setConditions(controller_.profile().encoding.conditions);
}

void LiveWorkspace::refresh(const Telemetry& telemetry, bool visible) {
    if (!tap_) return;
    history_.take(*tap_, telemetry);
    if (!visible || stack_->currentIndex() != kBench) return;
    rig_->refresh(telemetry);
    strips_->redraw();
    const auto isDue = [](QElapsedTimer& since, int every_ms) {
        if (since.isValid() && since.elapsed() < every_ms) return false;
        since.start();
        return true;
    };
    if (isDue(sincePlane_, kPlaneEvery_ms)) showPlane(telemetry);
    if (isDue(sinceSide_, kSideEvery_ms)) showSide(telemetry);
}

/// Returns the telemetry with R and P as set by hand, if the hand drives.
Telemetry LiveWorkspace::asDriven(Telemetry telemetry) const {
    if (const auto ordered = orderedByHand(controller_, telemetry)) {
        telemetry.roughness = ordered->roughness;
        telemetry.pressure = ordered->pressure;
    }
    return telemetry;
}

void LiveWorkspace::showPlane(const Telemetry& telemetry) {
    const bool stale = healthWords(telemetry, !history_.streams().empty(), 0).stale;
    const bool byHand = telemetry.driving == DriveSource::Manual;
    const double absent = std::nan("");
    const auto driven = asDriven(telemetry);
    where_->setText(byHand ? tr("Set by hand") : tr("Where the fingertip is"));
    plane_->show(history_.frames(), history_.now_s(), stale && !byHand ? absent : driven.roughness,
                 stale && !byHand ? absent : driven.pressure, byHand);
}

void LiveWorkspace::showSide(const Telemetry& telemetry) {
    const auto health = healthWords(telemetry, !history_.streams().empty(), history_.missed());
    if (health_->text() != health.text) {
        health_->setText(health.text);
        health_->setToolTip(
            tr("%1\nAge of the newest sample, places where samples are missing, samples that came too fast "
               "to be kept; then "
               "the flags of R and P. Old samples drive no train.")
                .arg(health.text));
    }
    setTone(*health_, health.stale ? Tone::Warning : Tone::Quiet);
    staleLine_->setVisible(plotOnly_ && health.stale);
    if (health.stale) staleLine_->setText(health.text);
    command_->show(asDriven(telemetry), health.stale, controller_.profile().encoding.conditions);
    showTaxels(health.stale);
}

void LiveWorkspace::showPlotOnly(bool only) {
    plotOnly_ = only;
    side_->setVisible(!only);
    sinceSide_.invalidate();  // so that the next picture says whether samples are old
    if (!only) staleLine_->hide();
}

void LiveWorkspace::showTaxels(bool stale) {
    taxels_->setStale(stale);
    const auto* series = history_.samples(StreamKind::Taxels);
    if (series == nullptr || series->empty()) return;
    newest_.clear();
    for (std::size_t c = 0; c < series->channels(); ++c) newest_.push_back(series->value(series->size() - 1, c));
    const auto unit = symbolOf(history_.info(StreamKind::Taxels)->unit);
    taxels_->show(newest_, QString::fromUtf8(unit.data(), qsizetype(unit.size())));
}

void LiveWorkspace::readCapture(const Capture& capture) {
    const auto open = controller_.open();
    if (!open || !open->source || capture.samples() > kLongestReading) return;
    if (sinceReading_.isValid() && sinceReading_.elapsed() < kReadingEvery_ms) return;
    sinceReading_.start();
    const bool current = open->source->drive == Drive::Current;
    for (std::size_t i = 0; i < capture.channels.size(); ++i) {
        if (capture.channels[i].unit != (current ? "A" : "V")) continue;
        const auto measured = measureChannel(capture, i);
        for (const auto& train : measured.trains) {
            if (std::isfinite(train.amplitude))
                strips_->addScopeReading(train.onset_s, train.amplitude * (current ? 1e3 : 1));
        }
        return;
    }
}

void LiveWorkspace::openOrder(LiveOrder order) {
    order.profile = controller_.profile();
    pendingSpeed_ = order.speed;
    controller_.openLive(order);
}

void LiveWorkspace::openSimulated() {
    LiveOrder order;
    order.uris.push_back({"sim", "", {}});
    openOrder(std::move(order));
}

bool LiveWorkspace::openRecording(const QString& path) {
    // Reading may take a while and runs on the controller's thread; here we only check that the file exists.
    const std::filesystem::path file = path.toStdString();
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::is_directory(file, error) ? file / "recording.json" : file, error)) {
        const auto recording = tacto::openRecording(file);
        emit refusedRecording(recording ? tr("%1 no longer exists.").arg(path)
                                        : QString::fromStdString(recording.error().message));
        return false;
    }
    LiveOrder order;
    order.uris.push_back({"recording", path.toStdString(), {}});
    order.uris.push_back({"sim", "", {}});
    openOrder(std::move(order));
    return true;
}

void LiveWorkspace::replayExample() {
    const auto folder = resourcesFolder();
    if (!folder) {
        emit refusedRecording(QString::fromStdString(folder.error().message));
        return;
    }
    openRecording(QString::fromStdString((*folder / "examples" / "four-touches").string()));
}

void LiveWorkspace::replayAgain() {
    const auto open = controller_.open();
    if (!open) return;
    LiveOrder order;
    order.seed = open->about.seed;
    order.speed = rig_->speed();
    std::set<std::string> seen;  // devices already added: one "sim:" stands for several
    for (const auto& device : open->about.devices) {
        const auto uri = DeviceUri::parse(device.uri);
        if (uri && seen.insert(device.uri).second) order.uris.push_back(*uri);
    }
    openOrder(std::move(order));
}

void LiveWorkspace::chooseRecording() {
    FileQuestion question{
        .title = tr("Open a recording (recording.json, EDF, BDF or XDF)"),
        .filters = {tr("Recordings (*.json *.edf *.bdf *.xdf *.xdfz *.xdf.gz)"), tr("All files (*)")}};
    askForFile(*this, question, [this](const QString& path) { openRecording(path); });
}

void LiveWorkspace::editProfile(const QString& key) {
    auto* editor = new ProfileEditor(controller_, this);
    openDialog(editor);
    if (!key.isEmpty()) editor->goTo(key);
}

}  // namespace tacto::gui

#include "moc_LiveWorkspace.cpp"
