#include "app/gui/window/DeviceDock.h"

#include <QCoreApplication>
#include <QGridLayout>
#include <QHeaderView>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/SafetyBar.h"
#include "app/run/ScopeStatement.h"

namespace tacto::gui {

namespace {

constexpr int kNamePad = 4, kBesideName = 24;  // pixels above and below a name; pixels for its check box
constexpr int kUriRole = Qt::UserRole;
constexpr int kOpenRole = Qt::UserRole + 1;
constexpr int kObstacleRole = Qt::UserRole + 2;
constexpr int kRoleRole = Qt::UserRole + 3;  // the role of a device with a check box
constexpr int kSerialRole = Qt::UserRole + 4;
constexpr qint64 kDescribeEvery_ms = 500;  // how often devices are asked for their reports

QString tr(const char* text) { return QCoreApplication::translate("DeviceDock", text); }

QString orDash(const std::string& text) { return text.empty() ? "–" : QString::fromStdString(text).toHtmlEscaped(); }

std::string schemeOf(const std::string& uri) { return uri.substr(0, uri.find(':')); }

/// True if `present` is the device opened as `open`: the same URI, the same serial number, or the only device that a
/// URI without a name ("sensor:") can mean.
bool isSame(const SessionDevice& open, const DeviceIdentity& present) {
    if (present.placeholder || open.role != nameOf(present.role)) return false;
    if (open.uri == present.uri) return true;
    const auto uri = DeviceUri::parse(open.uri);
    if (!uri || uri->scheme != schemeOf(present.uri)) return false;
    if (present.simulated) return open.name == present.name;
    // A device opened by its terminal is not in the list of plugged-in devices.
    const bool terminal = std::ranges::any_of(uri->parameters, [](const auto& one) { return one.first == "tty"; });
    if (terminal) return false;
    return uri->path.empty() || uri->path == present.serial || (!open.serial.empty() && open.serial == present.serial);
}

/// True if an open device was plugged in before (`seen` has its URI) and is now gone.
bool unpluggedWhileOpen(const SessionDevice& open, const std::vector<DeviceIdentity>& present,
                        const std::set<std::string>& seen) {
    return seen.contains(open.uri) &&
           std::ranges::none_of(present, [&](const auto& device) { return isSame(open, device); });
}

/// Returns identity and abilities of an open device.
QStringList factsOf(const SessionDevice& device, const OpenBench& open) {
    QStringList lines;
    lines << tr("Serial %1, firmware %2").arg(orDash(device.serial), orDash(device.firmware));
    if (device.simulated) lines << tr("Simulated: none of its numbers were measured on hardware.");
    if (device.is(Role::Stimulator) && open.source) {
        const auto drive = open.source->drive;
        lines << tr("%1 source, at most %2")
                     .arg(drive == Drive::Current ? tr("Current") : tr("Voltage"),
                          settingText(open.source->amplitudeMax, amplitudeUnit(drive)));
    }
    if (device.is(Role::Sensor)) {
        for (const auto& stream : open.streams) {
            const auto kind = nameOf(stream.kind);
            lines << tr("%1: %2, %3")
                         .arg(titled(qtext(kind)),
                              stream.channels == 1 ? tr("1 channel") : tr("%1 channels").arg(stream.channels),
                              settingText(stream.rate_hz, "Hz"));
        }
    }
    if (device.is(Role::Oscilloscope) && open.scope) {
        lines << tr("%1 bits, up to %2").arg(open.scope->bits).arg(settingText(open.scope->maxRate.value(), "S/s"));
    }
    return lines;
}

/// Returns the device's report on itself, without counts of 0 and unknown values.
QStringList rowsOf(const DeviceReport& report) {
    QStringList lines;
    for (const auto& row : report.rows()) {
        const bool count = row.unit[0] == 0;
        if (!std::isfinite(row.value) || (count && row.value == 0)) continue;
        const auto value = count                               ? decimalText(row.value, 0)
                           : std::string_view(row.unit) == "s" ? settingText(row.value, "s")
                                                               : decimalText(row.value, 1, row.unit);
        lines << QString("%1: %2").arg(titled(QString(row.name)), value);
    }
    lines << (report.losses > 0 ? tr("⚠ Something was lost between it and this program.") : tr("Nothing was lost."));
    return lines;
}

}  // namespace

DeviceDock::DeviceDock(BenchController& controller, const CalibrationBook& calibrations, QWidget* parent)
    : FoldingDock(tr("Devices"), "devices", "deviceDock", parent),
      controller_(controller),
      calibrations_(calibrations) {
    auto* body = new QWidget;
    auto* layout = columnIn(*body, -1, {0, 0, scaledPx(12), 0});
    tree_ = new QTreeWidget(body);
    tree_->setAccessibleName(tr("Devices"));
    tree_->setHeaderLabels({tr("Device")});
    tree_->setRootIsDecorated(false);
    tree_->setHeaderHidden(true);
    tree_->setWordWrap(true);
    tree_->setTextElideMode(Qt::ElideNone);
    // Queued, because a header also sends this signal while it is being destroyed.
    connect(tree_->header(), &QHeaderView::sectionResized, this, &DeviceDock::fitNames, Qt::QueuedConnection);
    tree_->setToolTip(tr("Devices that are present; open ones are bold. Select the devices for the bench (Return)."));
    tree_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
    tree_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
    tree_->setUniformRowHeights(false);
    tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);  // names wrap, and the list is as high as its rows
    layout->addWidget(tree_);
    facts_ = makeLabel({}, {.name = "deviceFacts", .wraps = true}, body);
    facts_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    layout->addWidget(facts_);

    open_ = new QPushButton(body);
    open_->setObjectName("openBench");
    nameOpen();
    auto* flaws = new QPushButton(tr("Faults…"), body);
    flaws->setToolTip(tr("A simulated bench with a source, a load and a fault of your choice."));
    auto* recording = new QPushButton(tr("Recording…"), body);
    recording->setToolTip(tr("Replays a recorded fingertip into the simulated stimulator."));
    check_ = new QPushButton(tr("Impedance"), body);
    check_->setObjectName("impedanceButton");
    check_->setToolTip(tr("One small pulse into the declared load, then disarmed again."));
    close_ = new QPushButton(tr("Close"), body);
    close_->setToolTip(tr("Output off; the session file is finished and closed."));
    auto* buttons = new QGridLayout;
    buttons->addWidget(open_, 0, 0, 1, 2);
    buttons->addWidget(flaws, 1, 0);
    buttons->addWidget(recording, 1, 1);
    buttons->addWidget(check_, 2, 0);
    buttons->addWidget(close_, 2, 1);
    layout->addLayout(buttons);
    layout->addStretch(1);
    auto* area = scrollingRows(body, this);
    area->setMinimumWidth(body->minimumSizeHint().width());
    setContent(area);

    connect(open_, &QPushButton::clicked, this, &DeviceDock::openChosen);
    // Return ticks a device, because Space stops the output everywhere.
    connect(tree_, &QTreeWidget::itemActivated, this, [](QTreeWidgetItem* item) {
        if (item->data(0, kRoleRole).isValid())
            item->setCheckState(0, item->checkState(0) == Qt::Checked ? Qt::Unchecked : Qt::Checked);
    });
    connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) { choose(item); });
    connect(flaws, &QPushButton::clicked, this, &DeviceDock::simulatedBenchRequested);
    connect(recording, &QPushButton::clicked, this, &DeviceDock::recordingRequested);
    connect(check_, &QPushButton::clicked, this, &DeviceDock::checkRequested);
    connect(close_, &QPushButton::clicked, &controller_, &BenchController::close);
    connect(tree_, &QTreeWidget::currentItemChanged, this, &DeviceDock::describe);
    connect(&controller_, &BenchController::changed, this, [this] {
        lookForCertificate();
        listed_.clear();
        list();
    });
    connect(&controller_.watch(), &DeviceWatch::changed, this, &DeviceDock::list);
    connect(&calibrations_, &CalibrationBook::changed, this, &DeviceDock::describe);
    afterLookChange(*tree_, [this] {
        listed_.clear();
        list();
    });
    list();
    refresh(Telemetry{});
}

void DeviceDock::list() {
    // Leaves out recordings and folders of captures, because the user must first choose a file for these.
    auto present = controller_.watch().devices();
    std::erase_if(present, [](const DeviceIdentity& device) { return device.placeholder; });
    const auto open = controller_.open();
    if (!open) seen_.clear();
    std::vector<std::string> keys;
    for (const auto& device : present) keys.push_back(device.uri + device.obstacle);
    if (open) {
        for (const auto& device : open->about.devices) {
            keys.push_back("open " + device.uri);
            if (std::ranges::any_of(present, [&](const auto& one) { return isSame(device, one); }))
                seen_.insert(device.uri);
        }
    }
    if (keys == listed_) return;
    listed_ = keys;
    const auto before = chosen();
    const auto* currentItem = tree_->currentItem();
    const auto current = currentItem != nullptr ? currentItem->data(0, kUriRole).toString() : QString();
    const QSignalBlocker quiet(tree_);
    tree_->clear();
    const auto add = [&](const QString& name, const QString& role, const QString& uri, bool isOpen,
                         const DeviceIdentity* ready = nullptr, const QString& obstacle = {}) {
        auto* item = new QTreeWidgetItem(tree_, {obstacle.isEmpty() ? name : "⚠ " + name});
        item->setData(0, kObstacleRole, obstacle);
        item->setData(0, kUriRole, uri);
        item->setData(0, kOpenRole, isOpen);
        if (uri == current) tree_->setCurrentItem(item);
        item->setToolTip(0, QString("%1\n%2: %3").arg(name, role, uri));
        if (ready != nullptr) {
            const auto was = before.find(ready->role);
            item->setData(0, kRoleRole, int(ready->role));
            item->setCheckState(0,
                                was != before.end() && was->second.text() == ready->uri ? Qt::Checked : Qt::Unchecked);
        }
        auto font = tree_->font();
        font.setBold(isOpen);
        item->setFont(0, font);
    };
    if (open) {
        for (const auto& device : open->about.devices) {
            const bool gone = unpluggedWhileOpen(device, present, seen_);
            add(QString::fromStdString(device.name), QString::fromStdString(device.role),
                QString::fromStdString(device.uri), true, nullptr,
                gone ? tr("It was unplugged. Plug it in again, then reset the fault.") : QString());
        }
    }
    for (const auto& device : present) {
        const bool alreadyOpen =
            open && std::ranges::any_of(open->about.devices, [&](const auto& one) { return isSame(one, device); });
        if (alreadyOpen) continue;
        add(QString::fromStdString(device.name), qtext(nameOf(device.role)), QString::fromStdString(device.uri), false,
            device.obstacle.empty() ? &device : nullptr, QString::fromStdString(device.obstacle));
        tree_->topLevelItem(tree_->topLevelItemCount() - 1)
            ->setData(0, kSerialRole, QString::fromStdString(device.serial));
    }
    if (tree_->currentItem() == nullptr && tree_->topLevelItemCount() > 0)
        tree_->setCurrentItem(tree_->topLevelItem(0));
    fitNames();
    nameOpen();
    describe();
}

std::vector<int> DeviceDock::rowEdges() const {
    std::vector<int> edges;
    for (int i = 0; i < tree_->topLevelItemCount(); ++i)
        edges.push_back(heightDownTo(*tree_->viewport(), tree_->visualItemRect(tree_->topLevelItem(i)).bottom() + 1));
    return edges;
}

void DeviceDock::fitNames() {
    const int beside = kBesideName + tree_->style()->pixelMetric(QStyle::PM_IndicatorWidth, nullptr, tree_);
    const int width = std::max(1, tree_->columnWidth(0) - beside);
    const QSignalBlocker quiet(tree_);  // a change of height must not count as a tick
    for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
        auto* item = tree_->topLevelItem(i);
        const auto lines =
            QFontMetrics(item->font(0)).boundingRect({0, 0, width, QWIDGETSIZE_MAX}, Qt::TextWordWrap, item->text(0));
        item->setSizeHint(0, {0, lines.height() + kNamePad});
    }
    tree_->updateGeometry();
}

void DeviceDock::describe() {
    described_.start();
    const auto* item = tree_->currentItem();
    if (item == nullptr) return facts_->setText(tr("No device is present."));
    const auto uri = item->data(0, kUriRole).toString();
    const auto obstacle = item->data(0, kObstacleRole).toString();
    QStringList lines{QString("<b>%1</b>").arg(item->text(0).toHtmlEscaped()), uri.toHtmlEscaped()};
    if (!obstacle.isEmpty()) lines << obstacle.toHtmlEscaped();
    if (const auto open = controller_.open(); open && item->data(0, kOpenRole).toBool()) {
        for (const auto& device : open->about.devices) {
            if (QString::fromStdString(device.uri) != uri) continue;
            lines << factsOf(device, *open);
            if (const auto stimulator = calibrations_.connected(); stimulator && device.is(Role::Stimulator))
                lines << sentence(standingText(calibrations_.standing(*stimulator)));
            if (device.is(Role::Oscilloscope) && !certificate_.isEmpty()) lines << certificate_;
            if (const auto role = valueFor(kRoles, device.role)) {
                if (const auto report = controller_.deviceReport(*role)) lines << rowsOf(*report);
            }
        }
    } else {
        if (const auto serial = item->data(0, kSerialRole).toString(); !serial.isEmpty())
            lines << tr("Serial %1").arg(serial.toHtmlEscaped());
        lines << tr("Not open.");
    }
    // Setting the same text again would remove the user's selection.
    if (const auto text = keptTogether(lines.join("<br>")); text != facts_->text()) facts_->setText(text);
}

void DeviceDock::lookForCertificate() {
    const auto open = controller_.open();
    if (!open || open->session == certificateOf_) return;
    certificateOf_ = open->session;
    certificate_.clear();
    for (const auto& device : open->about.devices) {
        if (!device.is(Role::Oscilloscope)) continue;
        const auto known = knownCertificate(
            {device.uri, Role::Oscilloscope, device.name, device.serial, device.firmware, device.simulated});
        if (!known.text.empty()) certificate_ = sentence(qtext(known.text)).toHtmlEscaped();
    }
}

std::map<Role, DeviceUri> DeviceDock::chosen() const {
    std::map<Role, DeviceUri> ticked;
    for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
        const auto* item = tree_->topLevelItem(i);
        if (!item->data(0, kRoleRole).isValid() || item->checkState(0) != Qt::Checked) continue;
        if (auto uri = DeviceUri::parse(item->data(0, kUriRole).toString().toStdString()))
            ticked.emplace(static_cast<Role>(item->data(0, kRoleRole).toInt()), std::move(*uri));
    }
    return ticked;
}

/// Only one device of each role can be ticked: ticking another one clears the first.
void DeviceDock::choose(QTreeWidgetItem* item) {
    if (item->checkState(0) == Qt::Checked) {
        const QSignalBlocker quiet(tree_);
        for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
            auto* other = tree_->topLevelItem(i);
            if (other != item && other->data(0, kRoleRole) == item->data(0, kRoleRole))
                other->setCheckState(0, Qt::Unchecked);
        }
    }
    nameOpen();
}

void DeviceDock::nameOpen() {
    const auto ticked = chosen().size();
    open_->setText(ticked == 0 ? tr("Open &simulated bench") : tr("Open what is ticked (%1)").arg(ticked));
    open_->setToolTip(ticked == 0 ? tr("Opens a fingertip, a stimulator on 1 kΩ and an oscilloscope, all simulated.")
                                  : tr("Opens the ticked devices as one bench. No output before the bench is armed."));
}

void DeviceDock::openChosen() {
    LiveOrder order;
    order.profile = controller_.profile();
    if (const auto ticked = chosen(); ticked.empty()) {
        order.uris.push_back(*DeviceUri::parse("sim:"));
    } else {
        order.needed.clear();
        for (const auto& [role, uri] : ticked) {
            order.needed.insert(role);
            order.uris.push_back(uri);
        }
    }
    controller_.openLive(order);
}

void DeviceDock::refresh(const Telemetry& telemetry) {
    const bool live = controller_.activity() == Activity::Live;
    open_->setEnabled(controller_.activity() == Activity::Closed || live);
    close_->setEnabled(live);
    check_->setEnabled(live && telemetry.state == InterlockState::Disarmed);
    if (controller_.open() && isVisible() && described_.hasExpired(kDescribeEvery_ms)) describe();
}

}  // namespace tacto::gui

#include "moc_DeviceDock.cpp"
