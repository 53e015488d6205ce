#include "app/gui/runner/SimulatedBenchDialog.h"

#include <QDialogButtonBox>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/electrode/Load.h"

namespace tacto::gui {

namespace {

/// A fault: the device, as named in the twin's URI, and what happens.
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

constexpr int kBenchChars = 64;  // width in characters

}  // namespace

SimulatedBenchDialog::SimulatedBenchDialog(const QString& accept, const std::vector<DeviceUri>& before,
                                           const std::set<Role>& needs, QWidget* parent)
    : QDialog(parent) {
    const std::pair<const char*, Role> simulated[] = {
        {"stimulator", Role::Stimulator}, {"finger", Role::Sensor}, {"oscilloscope", Role::Oscilloscope}};
    for (const auto& [device, role] : simulated)
        if (needs.empty() || needs.contains(role)) devices_.push_back(device);
    setWindowTitle(tr("Simulated bench"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading(tr("A simulated bench"), this));
    layout->addWidget(explanation(tr("Fingertip, stimulator, load and oscilloscope, all computed: for learning, and to "
                                     "see what a fault looks like before hardware shows it."),
                                  this));
    std::vector<std::pair<QString, QString>> faults;
    for (std::size_t i = 0; i < std::size(kFaults); ++i) {
        const auto& fault = kFaults[i];
        const auto has = [&](std::string_view device) { return device == fault.device; };
        if (i == 0 || std::ranges::any_of(devices_, has))
            faults.emplace_back(QString::number(i), QCoreApplication::translate("Faults", fault.words));
    }
    form_ = new FieldForm(this, FieldForm::Labels::Beside);
    form_->show(
        {choiceField("mode", tr("&Stimulator"), {{"voltage", tr("voltage source")}, {"current", tr("current source")}},
                     tr("What the stimulator holds constant during a phase.")),
         numberField("gain", tr("&Gain"), "", 0.5, 1.5, 1,
                     tr("Delivered over commanded amplitude: 1 is perfect. Above 1.2 the bench faults.")),
         textField("load", tr("&Load"), QStringLiteral("1 kΩ"),
                   tr("What is connected, such as “1 kΩ” or “200 Ω + 10 kΩ || 50 nF”.")),
         choiceField("fault", tr("&Fault"), faults, tr("What goes wrong, and when.")),
         numberField("faultAt", tr("A&fter"), "s", 0.1, 3600, 10, tr("Time after opening at which the fault begins.")),
         wholeField("seed", tr("S&eed"), 0, 1'000'000, 1, tr("The same seed gives the same bytes."))});
    layout->addWidget(form_);
    says_ = makeLabel({}, {.tone = Tone::Quiet, .size = TextSize::Small, .wraps = true, .selectable = true}, this);
    layout->addWidget(says_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    open_ = buttons->addButton(accept, QDialogButtonBox::AcceptRole);
    makePrimary(*open_);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &SimulatedBenchDialog::take);
    begin(before);
    connect(form_, &FieldForm::edited, this, &SimulatedBenchDialog::judge);
    judge();
    const int wide = fontMetrics().averageCharWidth() * kBenchChars;
    resize(wide, layout->totalHeightForWidth(wide));
    growWithContent(*this);
}

void SimulatedBenchDialog::begin(const std::vector<DeviceUri>& before) {
    for (const auto& uri : before) {
        if (uri.scheme != "sim") continue;
        for (const auto& [key, value] : uri.parameters) {
            if (key == "mode" || key == "gain") form_->set(key, qtext(value));
            if (key == "load")
                if (const auto load = parseLoad(value)) form_->set(key, withOhmSigns(qtext(load->text())));
            if (key == "fault") beginWith(uri.path, qtext(value));
        }
    }
}

/// `fault`: such as "open@10s".
void SimulatedBenchDialog::beginWith(const std::string& device, const QString& fault) {
    const auto name = fault.section('@', 0, 0);
    for (std::size_t i = 1; i < std::size(kFaults); ++i)
        if (device == kFaults[i].device && name == kFaults[i].key) form_->set("fault", QString::number(i));
    const auto from = fault.section('@', 1).section("..", 0, 0);
    if (from.endsWith('s')) form_->set("faultAt", from.chopped(1));
}

QStringList SimulatedBenchDialog::uris(const nlohmann::json& values) const {
    const auto& fault = kFaults[form_->text("fault").toInt()];
    const auto faultOf = [&](const char* device) {
        return std::string_view(fault.device) == device
                   ? fmt::format("{}@{:g}s", fault.key, values.at("faultAt").get<double>())
                   : "";
    };
    auto load = form_->text("load");
    load.remove(' ').replace(QStringLiteral("Ω"), "ohm").replace(QChar(0x2126), "ohm");
    auto stimulator = fmt::format("sim:stimulator?mode={}&gain={:g}&load={}", values.at("mode").get<std::string>(),
                                  values.at("gain").get<double>(), load.toStdString());
    QStringList all;
    for (const auto* device : devices_) {
        auto uri = std::string_view(device) == "stimulator" ? stimulator : fmt::format("sim:{}", device);
        if (const auto what = faultOf(device); !what.empty())
            uri += fmt::format("{}fault={}", uri.find('?') == std::string::npos ? '?' : '&', what);
        all << qtext(uri);
    }
    return all;
}

void SimulatedBenchDialog::judge() {
    const auto load = parseLoad(form_->text("load").toStdString());
    form_->refuse("load", load ? QString() : sentence(load.error()));
    form_->setFieldEnabled("faultAt", form_->text("fault") != "0");
    const auto chosen = form_->read();
    open_->setEnabled(chosen && load);
    says_->setText(open_->isEnabled() ? uris(chosen->parameters).join('\n')
                   : chosen           ? sentence(load.error())
                                      : form_->refusal());
}

void SimulatedBenchDialog::take() {
    const auto read = form_->read();
    if (!read) return;
    emit chosen(uris(read->parameters).join(' '), read->parameters.at("seed").get<quint64>());
    accept();
}

}  // namespace tacto::gui

#include "moc_SimulatedBenchDialog.cpp"
