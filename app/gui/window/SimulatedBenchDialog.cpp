#include "app/gui/window/SimulatedBenchDialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/electrode/Load.h"

namespace tacto::gui {

namespace {

/// Device, as the twin's URI names it, and what happens.
struct Fault {
    const char* device;
    const char* key;
    const char* words;
};
constexpr Fault kFaults[] = {
    {"", "", QT_TRANSLATE_NOOP("Faults", "none")},
    {"stimulator", "open", QT_TRANSLATE_NOOP("Faults", "electrode lifts (open)")},
    {"stimulator", "short", QT_TRANSLATE_NOOP("Faults", "electrodes touch (short)")},
    {"stimulator", "unplug", QT_TRANSLATE_NOOP("Faults", "stimulator unplugged")},
    {"stimulator", "stuck-on", QT_TRANSLATE_NOOP("Faults", "stimulator stuck on")},
    {"stimulator", "garbage", QT_TRANSLATE_NOOP("Faults", "stimulator answers garbage")},
    {"stimulator", "drift", QT_TRANSLATE_NOOP("Faults", "amplitude drifts")},
    {"finger", "unplug", QT_TRANSLATE_NOOP("Faults", "fingertip unplugged")},
    {"finger", "stale", QT_TRANSLATE_NOOP("Faults", "fingertip data go stale")},
    {"finger", "nan", QT_TRANSLATE_NOOP("Faults", "fingertip sends no numbers (NaN)")},
    {"oscilloscope", "unplug", QT_TRANSLATE_NOOP("Faults", "oscilloscope unplugged")},
};

constexpr int kBenchChars = 64;  // wide

}  // namespace

SimulatedBenchDialog::SimulatedBenchDialog(BenchController& controller, QWidget* parent)
    : QDialog(parent), controller_(controller) {
    setWindowTitle(tr("Simulated bench"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading(tr("A simulated bench"), this));
    layout->addWidget(explanation(tr("Fingertip, stimulator, load and oscilloscope, all computed: for learning, and to "
                                     "see what a fault looks like before hardware shows it."),
                                  this));
    auto* form = new QFormLayout;
    form->setHorizontalSpacing(12);
    mode_ = new QComboBox(this);
    mode_->addItem(tr("voltage source"), "voltage");
    mode_->addItem(tr("current source"), "current");
    mode_->setToolTip(tr("What the stimulator holds constant during a phase."));
    form->addRow(tr("&Stimulator"), mode_);
    gain_ = new QDoubleSpinBox(this);
    gain_->setRange(0.5, 1.5);
    gain_->setDecimals(3);
    gain_->setSingleStep(0.005);
    gain_->setValue(1);
    gain_->setToolTip(tr("Delivered over commanded amplitude: 1 is perfect. Above 1.2 the bench faults."));
    form->addRow(tr("&Gain"), gain_);
    load_ = new QLineEdit("1 kΩ", this);
    load_->setToolTip(tr("What is connected, such as “1 kΩ” or “200 Ω + 10 kΩ || 50 nF”."));
    form->addRow(tr("&Load"), load_);
    fault_ = new QComboBox(this);
    for (const auto& fault : kFaults) fault_->addItem(QCoreApplication::translate("Faults", fault.words));
    fault_->setToolTip(tr("What goes wrong, and when."));
    form->addRow(tr("&Fault"), fault_);
    faultAt_ = new QDoubleSpinBox(this);
    faultAt_->setRange(0.1, 3600);
    faultAt_->setValue(10);
    faultAt_->setSuffix(QStringLiteral("\u202fs"));
    faultAt_->setToolTip(tr("Time after opening at which the fault begins."));
    form->addRow(tr("A&fter"), faultAt_);
    seed_ = new QSpinBox(this);
    seed_->setRange(0, 1'000'000);
    seed_->setValue(1);
    seed_->setToolTip(tr("The same seed gives the same bytes."));
    form->addRow(tr("S&eed"), seed_);
    layout->addLayout(form);
    says_ = new QLabel(this);
    says_->setWordWrap(true);
    says_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    setTextSize(*says_, TextSize::Small);
    layout->addWidget(says_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    open_ = buttons->addButton(tr("&Open"), QDialogButtonBox::AcceptRole);
    makePrimary(*open_);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &SimulatedBenchDialog::openBench);
    connect(load_, &QLineEdit::textChanged, this, &SimulatedBenchDialog::judge);
    connect(mode_, &QComboBox::currentIndexChanged, this, &SimulatedBenchDialog::judge);
    connect(fault_, &QComboBox::currentIndexChanged, this, &SimulatedBenchDialog::judge);
    connect(gain_, &QDoubleSpinBox::valueChanged, this, &SimulatedBenchDialog::judge);
    connect(faultAt_, &QDoubleSpinBox::valueChanged, this, &SimulatedBenchDialog::judge);
    judge();
    const int wide = fontMetrics().averageCharWidth() * kBenchChars;
    resize(wide, layout->totalHeightForWidth(wide));
    growWithContent(*this);
}

std::vector<std::string> SimulatedBenchDialog::uris() const {
    const auto& fault = kFaults[fault_->currentIndex()];
    const auto faultOf = [&](const char* device) {
        return std::string_view(fault.device) == device ? fmt::format("{}@{:g}s", fault.key, faultAt_->value()) : "";
    };
    auto load = load_->text().trimmed();
    load.remove(' ').replace(QStringLiteral("Ω"), "ohm").replace(QChar(0x2126), "ohm");
    auto stimulator = fmt::format("sim:stimulator?mode={}&gain={:g}&load={}",
                                  mode_->currentData().toString().toStdString(), gain_->value(), load.toStdString());
    std::vector<std::string> all;
    for (const auto* device : {"stimulator", "finger", "oscilloscope"}) {
        auto uri = std::string_view(device) == "stimulator" ? stimulator : fmt::format("sim:{}", device);
        if (const auto what = faultOf(device); !what.empty())
            uri += fmt::format("{}fault={}", uri.find('?') == std::string::npos ? '?' : '&', what);
        all.push_back(uri);
    }
    return all;
}

void SimulatedBenchDialog::judge() {
    const auto load = parseLoad(load_->text().toStdString());
    open_->setEnabled(load.has_value());
    faultAt_->setEnabled(fault_->currentIndex() > 0);
    QStringList shown;
    for (const auto& uri : uris()) shown << QString::fromStdString(uri);
    says_->setText(load ? shown.join("\n") : "⚠ " + sentence(load.error()));
    setTone(*says_, load ? Tone::Quiet : Tone::Warning);
}

void SimulatedBenchDialog::openBench() {
    LiveOrder order;
    for (const auto& text : uris()) {
        auto uri = DeviceUri::parse(text);
        if (!uri) return says_->setText(QString::fromStdString(uri.error().message));
        order.uris.push_back(std::move(*uri));
    }
    order.profile = controller_.profile();
    order.seed = static_cast<std::uint64_t>(seed_->value());
    controller_.openLive(order);
    accept();
}

}  // namespace tacto::gui

#include "moc_SimulatedBenchDialog.cpp"
