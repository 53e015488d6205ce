#include "app/gui/window/ArmDialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QTimer>
#include <algorithm>
#include <chrono>
#include <utility>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/devices/Driver.h"
#include "core/electrode/Load.h"
#include "core/encoding/Encoder.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

namespace {

constexpr int kPollInterval_ms = 100;
constexpr int kArmChars = 64;  // width in characters
constexpr std::chrono::seconds kAnswerWithin =
    std::chrono::duration_cast<std::chrono::seconds>(Interlock::kConfirmWithin);

}  // namespace

ArmDialog::ArmDialog(BenchController& controller, Purpose purpose, const QString& load, const DriveCommand& again,
                     QWidget* parent)
    : QDialog(parent), controller_(controller), purpose_(purpose), asked_(controller.mark()), before_(again) {
    const auto open = controller.open();
    readsBack_ = !open || !open->source || open->source->readsBack;  // without a device there is nothing to read back
    massager_ = open && !open->source;
    auto* layout = new QVBoxLayout(this);
    addPurpose(*layout);
    addLoad(*layout, load);
    addWhatIsArmed(*layout);
    auto* cancel = addButtons(*layout);
    // The first step becomes void if a stop comes or the operator waits too long.
    auto* look = new QTimer(this);
    connect(look, &QTimer::timeout, this, [this] {
        if (controller_.stoppedSince(asked_)) return reject();
        sayFirst();
    });
    look->start(kPollInterval_ms);
    QTimer::singleShot(kAnswerWithin, this, &QDialog::reject);
    if (load.isEmpty() && !massager_)
        load_->setFocus();
    else
        cancel->setFocus();
    judge();
    sayFirst();
    const int wide = fontMetrics().averageCharWidth() * kArmChars;
    resize(wide, layout->totalHeightForWidth(wide));
    growWithContent(*this);
}

void ArmDialog::addPurpose(QVBoxLayout& layout) {
    const bool check = purpose_ == Purpose::CheckImpedance;
    setWindowTitle(check ? tr("Check the impedance") : tr("Arm the output"));
    layout.addWidget(heading(check       ? tr("Check the impedance of a bench load")
                             : massager_ ? tr("Arm the massager")
                                         : tr("Arm the output on a bench load"),
                             this));
    layout.addWidget(explanation(
        check ? tr("One small pulse measures the load. Nothing else is delivered, and the output stays disarmed. Esc "
                   "stops at any time.")
        : massager_ ? tr("There is no load to measure. Once armed, the massager vibrates as the drive says. Esc stops "
                         "at any time.")
                    : tr("One small pulse measures the load first. Then trains are delivered as the drive says, each "
                         "judged against the limits over 80 to 120 % of the load you declare. Esc stops at any time."),
        this));
}

void ArmDialog::addLoad(QVBoxLayout& layout, const QString& load) {
    auto* form = new QFormLayout;
    form->setHorizontalSpacing(12);
    static const QRegularExpression close("(\\d)([kM]?ohm)");  // a load in an address: "1kohm"
    load_ = new QLineEdit(withOhmSigns(QString(load).replace(close, "\\1 \\2")), this);
    load_->setPlaceholderText(tr("what is connected, such as 1 kΩ"));
    load_->setToolTip(tr("What is connected, such as “1 kΩ” or “200 Ω + 10 kΩ || 50 nF”."));
    connect(load_, &QLineEdit::textChanged, this, &ArmDialog::judge);
    form->addRow(tr("Declared &load"), load_);
    layout.addLayout(form);
    form->setRowVisible(load_, !massager_);
}

void ArmDialog::addWhatIsArmed(QVBoxLayout& layout) {
    const auto line = [&](const char* name) {
        auto* label = makeLabel({}, {.name = name, .wraps = true}, this);
        layout.addWidget(label);
        return label;
    };
    confirmed_ = line("armingText");
    setTextSize(*confirmed_, TextSize::Body, true);
    QStringList sets;
    for (const auto& set : controller_.limits().sets) sets << QString::fromStdString(set.title);
    layout.addWidget(explanation(tr("Encoding profile: %1. Limits: %2.")
                                     .arg(QString::fromStdString(controller_.profile().name), sets.join("; ")),
                                 this));
    first_ = line("firstOutput");
    first_->setVisible(purpose_ == Purpose::Arm);
    trouble_ = line("armingTrouble");
    setTone(*trouble_, Tone::Warning);
    connected_ = new QCheckBox(tr("I checked that this load is connected"), this);
    connected_->setToolTip(tr("This stimulator cannot measure its load: your confirmation replaces the reading."));
    connected_->setVisible(!readsBack_);
    connect(connected_, &QCheckBox::toggled, this, &ArmDialog::judge);
    layout.addWidget(connected_);
}

QPushButton* ArmDialog::addButtons(QVBoxLayout& layout) {
    const bool check = purpose_ == Purpose::CheckImpedance;
    auto* buttons = new QDialogButtonBox(this);
    if (before_.source != DriveSource::Off) {
        again_ = addConfirm(
            before_.source == DriveSource::Sensor ? tr("Arm and drive by fingertip") : tr("Arm and drive by hand"),
            "armAndDrive", tr("Second step: measures the load, arms, and drives as before the fault."), before_);
        buttons->addButton(again_, QDialogButtonBox::ActionRole);
    }
    arm_ = check ? addConfirm(tr("Check impedance"), "checkImpedance",
                              tr("Second step: measures the load and ends disarmed."), {})
                 : addConfirm(tr("Arm output"), "armOutput", tr("Second step: measures the load and arms."), {});
    buttons->addButton(arm_, QDialogButtonBox::ActionRole);
    auto* cancel = buttons->addButton(QDialogButtonBox::Cancel);
    cancel->setAutoDefault(false);
    cancel->setDefault(false);
    connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
    layout.addWidget(buttons);
    return cancel;
}

QPushButton* ArmDialog::addConfirm(const QString& text, const char* name, const QString& tip,
                                   const DriveCommand& drives) {
    auto* button = new ConfirmButton(text, this);
    button->setObjectName(name);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, [this, drives] { confirm(drives); });
    return button;
}

void ArmDialog::judge() {
    const auto parsed = parseLoad(massager_ ? ArmRequest().load : load_->text().toStdString());
    trouble_->setText(parsed                    ? QString()
                      : load_->text().isEmpty() ? tr("Which load is connected?")
                                                : sentence(parsed.error()));
    trouble_->setVisible(!parsed);
    text_ = parsed ? controller_.confirmationOf(*parsed) : std::string();
    confirmed_->setText(keptTogether(titled(withOhmSigns(qtext(text_)))));
    for (auto* button : {arm_, again_})
        if (button != nullptr) button->setEnabled(parsed && (readsBack_ || connected_->isChecked()));
}

QString ArmDialog::firstWords(DriveSource source, const std::optional<Command>& first) const {
    if (source == DriveSource::Off) return tr("Drive is off: no train follows until you choose one.");
    if (source == DriveSource::Sensor)
        return tr("The fingertip drives: the first train follows as soon as it feels something.");
    if (!first) return tr("Drive is by hand and is set to a train that cannot be delivered.");
    const auto every = quantityText(first->interval.count(), "s", 3);
    if (massager_) {
        const Encoder encoder(controller_.profile().encoding);
        return tr("Drive is by hand: the first burst follows at once, at %1 of the strength, every %2.")
            .arg(quantityText(100 * encoder.massagerIntensity(first->amplitude), "%", 2), every);
    }
    return tr("Drive is by hand: the first train follows at once, %1 every %2.")
        .arg(quantityText(first->amplitude.value(), "V", 3), every);
}

/// Says what the first train will be, so that it comes as no surprise.
void ArmDialog::sayFirst() {
    const auto telemetry = controller_.telemetry();
    auto text = firstWords(telemetry.driving, firstByHand(controller_, telemetry));
    if (again_ != nullptr) {
        const auto first = Encoder(controller_.profile().encoding).encode(before_.roughness, before_.pressure);
        auto again = firstWords(before_.source, first ? std::optional(*first) : std::nullopt);
        if (before_.source == DriveSource::Manual)
            again += tr(" As before the fault: R %1, P %2.")
                         .arg(decimalText(before_.roughness, 2), decimalText(before_.pressure, 2));
        text = tr("“%1”: %2\n“%3”: %4").arg(again_->text(), again, arm_->text(), text);
    }
    setTone(*first_, telemetry.driving == DriveSource::Off && again_ == nullptr ? Tone::Quiet : Tone::Warning);
    if (first_->text() != text) first_->setText(text);
}

void ArmDialog::confirm(const DriveCommand& drives) {
    ArmRequest request;
    if (!massager_) request.load = load_->text().toStdString();
    request.operatorConfirmed = true;
    request.declaredLoadConfirmed = connected_->isChecked();
    request.confirmed = text_;
    // If arming is refused or was stopped, the controller drops this drive.
    if (drives.source != DriveSource::Off) controller_.drive(drives.source, drives.roughness, drives.pressure);
    if (purpose_ == Purpose::CheckImpedance)
        controller_.checkImpedance(request, asked_);
    else
        controller_.arm(request, asked_);
    accept();
}

namespace {

/// Returns the load of a simulated stimulator. For a real one, only the operator knows what is connected.
QString knownLoad(const SessionAbout& about) {
    for (const auto& device : about.devices) {
        const auto uri = DeviceUri::parse(device.uri);
        if (!device.is(Role::Stimulator) || !uri || uri->scheme != "sim") continue;
        const auto load = std::ranges::find(uri->parameters, "load", [](const auto& p) { return p.first; });
        return QString::fromStdString(load == uri->parameters.end() ? kDefaultLoad : load->second);
    }
    return {};
}

}  // namespace

ArmQuestion::ArmQuestion(BenchController& controller, QWidget& window)
    : QObject(&window), controller_(controller), window_(window) {
    connect(&controller_, &BenchController::changed, this, &ArmQuestion::noteBench);
    noteBench();
}

void ArmQuestion::noteBench() {
    const auto open = controller_.open();
    if (controller_.activity() != Activity::Live || !open) return;
    if (std::exchange(loadOf_, open->session) != open->session) load_ = knownLoad(open->about);
}

void ArmQuestion::ask(ArmDialog::Purpose purpose, const DriveCommand& again) {
    const auto open = controller_.open();
    const bool live = controller_.activity() == Activity::Live && open;
    if (purpose == ArmDialog::Purpose::Arm && !live)
        return emit refused(tr("Nothing to arm: no bench is open. Open the simulated bench (Ctrl+B)"));
    if (!live || (purpose == ArmDialog::Purpose::CheckImpedance && !open->source))
        return emit refused(tr("No impedance to check: no stimulator is open. Open the simulated bench (Ctrl+B)"));
    auto* dialog = new ArmDialog(controller_, purpose, load_, again, &window_);
    connect(dialog, &QDialog::accepted, this, [this, dialog] { load_ = dialog->load(); });
    connect(&controller_, &BenchController::changed, dialog, &QDialog::reject);
    openDialog(dialog);
}

}  // namespace tacto::gui

#include "moc_ArmDialog.cpp"
