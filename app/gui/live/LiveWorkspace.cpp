#include "app/gui/live/LiveWorkspace.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/gui/live/CommandPanel.h"
#include "app/gui/live/DrivePanel.h"
#include "app/gui/live/ProfileEditor.h"
#include "app/gui/live/RigPanel.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/look/Dialogs.h"
#include "app/gui/look/Look.h"
#include "app/scripting/ProtocolLibrary.h"
#include "core/acquisition/Recording.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::gui {

namespace {

constexpr int kSideEvery_ms = 90;                 // numbers ten times a second are as fast as one reads
constexpr int kPlaneEvery_ms = 30;                // smooth to the eye; the strips follow every picture
constexpr int kReadingEvery_ms = 100;             // captures that are measured for the trains' strip
constexpr std::size_t kLongestReading = 100'000;  // samples; a longer one belongs to the oscilloscope workspace

bool isSimulated(const OpenBench& bench, std::string_view role) {
    return std::any_of(bench.about.devices.begin(), bench.about.devices.end(),
                       [&](const auto& device) { return device.role == role && device.simulated; });
}

bool isReplay(const OpenBench& bench) {
    return std::any_of(bench.about.devices.begin(), bench.about.devices.end(),
                       [](const auto& device) { return device.uri.starts_with("recording:"); });
}

}  // namespace

void LiveWorkspace::begin() {
    const auto open = desk_.open();
    stack_->setCurrentIndex(open ? kBench : desk_.activity() == Activity::Opening ? kOpening : kEmpty);
    const bool touch = open && isSimulated(*open, "sensor"), source = open && isSimulated(*open, "stimulator");
    if (desk_.tap() != tap_) {
        tap_ = desk_.tap();
        history_.begin(open ? open->streams : std::vector<StreamInfo>{});
        freeze_->setChecked(false);
        strips_->begin(touch, source, open && open->source && open->source->drive == Drive::Current ? "mA" : "V");
        taxels_->clear();
        taxels_->setVisible(history_.info(StreamKind::Taxels) != nullptr);
        taxels_->setSimulated(touch);
        command_->setSimulated(source);
        rig_->begin(pendingSpeed_.value_or(1), open && isReplay(*open));
        if (tap_) pendingSpeed_.reset();
    }
    drive_->begin();
    plane_->setOrigin(touch, desk_.profile().roughness.calibrated);
    plane_->setConditions(desk_.profile().encoding.conditions);
}

void LiveWorkspace::refresh(const Telemetry& telemetry, bool visible) {
    if (!tap_) return;
    history_.take(*tap_, telemetry);
    if (!visible || stack_->currentIndex() != kBench) return;
    drive_->refresh(telemetry);
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

void LiveWorkspace::showPlane(const Telemetry& telemetry) {
    const bool stale = healthWords(telemetry, !history_.streams().empty(), 0).stale;
    const bool byHand = telemetry.driving == DriveSource::Manual;
    const double absent = std::nan("");
    plane_->show(history_.frames(), history_.now_s(), stale && !byHand ? absent : telemetry.roughness,
                 stale && !byHand ? absent : telemetry.pressure, byHand);
}

void LiveWorkspace::showSide(const Telemetry& telemetry) {
    const auto health = healthWords(telemetry, !history_.streams().empty(), history_.missed());
    if (health_->text() != health.text) health_->setText(health.text);
    auto colour = palette();
    if (health.stale) colour.setColor(QPalette::WindowText, colours().amberText);
    health_->setPalette(colour);
    command_->show(telemetry, health.stale);
    showTaxels(health.stale);
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
    const auto open = desk_.open();
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
    order.profile = desk_.profile();
    pendingSpeed_ = order.speed;
    desk_.openLive(order);
}

void LiveWorkspace::openSimulated() {
    LiveOrder order;
    order.uris.push_back({"sim", "", {}});
    openOrder(std::move(order));
}

bool LiveWorkspace::openRecording(const QString& path) {
    // Reading it may take a while, on the desk's thread; here only whether there is something to read.
    const std::filesystem::path file = path.toStdString();
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::is_directory(file, error) ? file / "recording.json" : file, error)) {
        const auto recording = Recording::open(file);
        emit refusedRecording(recording ? tr("%1 has just gone away.").arg(path)
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
    openRecording(QString::fromStdString((*folder / "examples" / "linen-slide").string()));
}

void LiveWorkspace::replayAgain() {
    const auto open = desk_.open();
    if (!open) return;
    LiveOrder order;
    order.seed = open->about.seed;
    order.speed = rig_->speed();
    std::set<std::string> seen;  // one "sim:" stands for several devices
    for (const auto& device : open->about.devices) {
        const auto uri = DeviceUri::parse(device.uri);
        if (uri && seen.insert(device.uri).second) order.uris.push_back(*uri);
    }
    openOrder(std::move(order));
}

void LiveWorkspace::chooseRecording() {
    FileQuestion question;
    question.title = tr("Open a recording: its recording.json");
    question.filters << tr("Recordings (*.json)") << tr("All files (*)");
    askForFile(*this, question, [this](const QString& path) { openRecording(path); });
}

void LiveWorkspace::editProfile() { openDialog(new ProfileEditor(desk_, this)); }

}  // namespace tacto::gui
