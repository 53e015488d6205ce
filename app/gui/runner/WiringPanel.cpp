#include "app/gui/runner/WiringPanel.h"

#include <QFormLayout>
#include <QMenu>
#include <QRegularExpression>
#include <QToolButton>
#include <algorithm>

#include "app/gui/calibrate/InstrumentDialog.h"
#include "app/gui/runner/SimulatedBenchDialog.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/run/OpenDevices.h"

namespace tacto::gui {

namespace {

constexpr int kPause_ms = 200;  // of typing, before what was typed is looked up

}  // namespace

Result<std::vector<DeviceUri>> devicesOf(const QString& text) {
    static const QRegularExpression between(R"(\s+(?=[a-z_]+:))");
    std::vector<DeviceUri> uris;
    for (const auto& word : text.trimmed().split(between, Qt::SkipEmptyParts)) {
        auto uri = DeviceUri::parse(word.trimmed().toStdString());
        if (!uri) return failure(uri);
        uris.push_back(std::move(*uri));
    }
    return uris;
}

bool simulatesFault(const DeviceUri& device) {
    return device.scheme == "sim" &&
           std::ranges::any_of(device.parameters, [](const auto& each) { return each.first == "fault"; });
}

WiringPanel::WiringPanel(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Devices"));
    checkLater_.setSingleShot(true);
    checkLater_.setInterval(kPause_ms);
    connect(&checkLater_, &QTimer::timeout, this, &WiringPanel::check);
    auto* form = layoutIn<QFormLayout>(*this, -1, {});
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->setRowWrapPolicy(QFormLayout::WrapLongRows);
    needs_ = makeLabel({}, {.tone = Tone::Quiet, .wraps = true, .plain = true}, this);
    form->addRow(needs_);
    auto* devices = buildDevices();
    form->addRow(tr("&Devices"), devices);
    static_cast<QLabel*>(form->labelForField(devices))->setBuddy(devices_);
    trouble_ = new TroubleLine("devicesTrouble", this);
    form->addRow(trouble_);
    seed_ = new QSpinBox(this);
    seed_->setObjectName("seed");
    seed_->setRange(0, 1'000'000'000);
    seed_->setValue(1);
    seed_->setToolTip(
        tr("Seed for everything random: trial order and noise. The same seed on simulated devices gives "
           "the same run, byte for byte."));
    form->addRow(tr("S&eed"), seed_);
    realtime_ = new QCheckBox(tr("in real ti&me"), this);
    realtime_->setObjectName("realtime");
    realtime_->setToolTip(
        tr("Simulated devices otherwise run as fast as they can. Hardware always runs in real time."));
    form->addRow(QString(), realtime_);
    auto* out = buildOutput();
    form->addRow(tr("&Output"), out);
    static_cast<QLabel*>(form->labelForField(out))->setBuddy(out_);
}

QWidget* WiringPanel::buildDevices() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    devices_ = new QLineEdit("sim:", holder);
    devices_->setObjectName("devices");
    devices_->setToolTip(
        tr("Devices, a blank between them. sim: simulates what no other device does; recording:FOLDER replays a "
           "recorded fingertip; capture:FOLDER takes the oscilloscope's records from files."));
    connect(devices_, &QLineEdit::textChanged, this, &WiringPanel::judge);
    row->addWidget(devices_, 1);
    auto* add = new QToolButton(holder);
    add->setText("+");
    add->setProperty("role", "opens");
    add->setAccessibleName(tr("Add a recording or captures"));
    add->setToolTip(
        tr("Takes simulated devices with a fault, a recording or oscilloscope records in the place of a device."));
    add->setPopupMode(QToolButton::InstantPopup);
    add->setFocusPolicy(Qt::StrongFocus);
    auto* menu = new QMenu(add);
    menu->addAction(tr("&Simulated devices"), this, [this] { setDevices("sim:"); });
    menu->addAction(tr("Simulated devices with &faults…"), this, [this] {
        auto* dialog =
            new SimulatedBenchDialog(tr("&Use"), devicesOf(devices()).value_or(std::vector<DeviceUri>()), roles_, this);
        connect(dialog, &SimulatedBenchDialog::chosen, this, [this](const QString& addresses, quint64 seed) {
            setDevices(addresses);
            seed_->setValue(int(seed));
        });
        openDialog(dialog);
    });
    menu->addAction(tr("A &recording as fingertip…"), this,
                    [this] { addFolder("recording", tr("Folder of the recording")); });
    menu->addAction(tr("&Captures as oscilloscope…"), this,
                    [this] { addFolder("capture", tr("Folder of the captures")); });
    menu->addAction(tr("Saved &instruments…"), this, [this] {
        auto* dialog = new InstrumentDialog(this);
        connect(dialog, &InstrumentDialog::chosen, this, &WiringPanel::useOscilloscope);
        openDialog(dialog);
    });
    add->setMenu(menu);
    row->addWidget(add);
    return holder;
}

QWidget* WiringPanel::buildOutput() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    out_ = new QLineEdit(holder);
    out_->setObjectName("out");
    out_->setPlaceholderText(tr("the sessions folder"));
    out_->setToolTip(
        tr("Folder for the session, its report and its captures as CSV. Empty: the sessions folder, "
           "without CSV files."));
    row->addWidget(out_, 1);
    auto* choose = new QToolButton(holder);
    choose->setText("…");
    choose->setAccessibleName(tr("Choose the output folder"));
    choose->setToolTip(tr("Chooses a folder."));
    choose->setFocusPolicy(Qt::StrongFocus);
    connect(choose, &QToolButton::clicked, this, [this] {
        FileQuestion question{.title = tr("Folder for the run"), .wants = FileQuestion::Wants::Folder};
        askForFile(*this, question, [this](const QString& folder) { out_->setText(folder); });
    });
    row->addWidget(choose);
    return holder;
}

/// Replaces the oscilloscope in the list of devices.
void WiringPanel::useOscilloscope(const QString& address) {
    QStringList all{address};
    const auto before = devicesOf(devices());
    for (const auto& uri : before.value_or(std::vector<DeviceUri>())) {
        const bool simulated = uri.scheme == "sim" && uri.path == "oscilloscope";
        if (uri.scheme != "sigrok" && uri.scheme != "capture" && !simulated) all << qtext(uri.text());
    }
    if (all.size() == 1) all << "sim:";
    setDevices(all.join(' '));
}

void WiringPanel::removeFaults() {
    QStringList all;
    for (auto uri : devicesOf(devices()).value_or(std::vector<DeviceUri>())) {
        if (simulatesFault(uri)) std::erase_if(uri.parameters, [](const auto& each) { return each.first == "fault"; });
        all << qtext(uri.text());
    }
    setDevices(all.join(' '));
}

/// Shows the beginning of addresses that are longer than the field.
void WiringPanel::setDevices(const QString& addresses) {
    devices_->setText(addresses);
    devices_->setCursorPosition(0);
}

void WiringPanel::addFolder(const QString& scheme, const QString& title) {
    FileQuestion question{.title = title, .wants = FileQuestion::Wants::Folder};
    askForFile(*this, question, [this, scheme](const QString& folder) {
        setDevices(QString("%1:%2 %3").arg(scheme, folder, devices().isEmpty() ? "sim:" : devices()));
    });
}

void WiringPanel::show(const ProtocolDeclaration& declaration) {
    roles_ = declaration.needs;
    QStringList roles;
    for (const auto role : declaration.needs) roles << qtext(nameOf(role));
    needs_->setText(roles.isEmpty() ? tr("Needs no device.") : tr("Needs: %1.").arg(roles.join(", ")));
}

Result<void> WiringPanel::fill(RunOrder& order) const {
    auto uris = devicesOf(devices_->text());
    if (!uris) return failure(uris);
    if (!refused_.isEmpty()) return fail(ErrorCode::InvalidArgument, "{}", refused_.toStdString());
    order.uris = std::move(*uris);
    order.seed = static_cast<std::uint64_t>(seed_->value());
    order.realtime = realtime_->isChecked();
    order.out = out_->text().trimmed().toStdString();
    return {};
}

/// Judges the text at once, and what it names after a pause: files may have to be read for it.
void WiringPanel::judge() {
    const auto uris = devicesOf(devices_->text());
    refused_ = uris ? QString() : sentence(uris.error());
    trouble_->say(refused_);
    checking_.drop();
    if (uris && known_) checkLater_.start();
    emit edited();
}

void WiringPanel::checkWith(std::function<Result<bool>(const std::vector<DeviceUri>&)> known) {
    known_ = std::move(known);
}

void WiringPanel::check() {
    const auto uris = devicesOf(devices_->text());
    if (!uris) return;
    if (const auto known = known_(*uris); !known) return refuse(sentence(known.error()));
    checking_.start(
        this,
        [uris = *uris]() -> QString {
            const auto checked = checkAddresses(uris);
            return checked ? QString() : sentence(checked.error());
        },
        [this, of = devices()](const QString& why) {
            if (of == devices()) refuse(why);
        });
}

void WiringPanel::refuse(const QString& why) {
    if (std::exchange(refused_, why) == why) return;
    trouble_->say(why);
    emit edited();
}

}  // namespace tacto::gui

#include "moc_WiringPanel.cpp"
