#include "app/gui/runner/SimulatedBenchDialog.h"

#include <QDialogButtonBox>

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

SimulatedBenchDialog::SimulatedBenchDialog(const QString& accept, QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Simulated bench"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading(tr("A simulated bench"), this));
    layout->addWidget(explanation(tr("Fingertip, stimulator, load and oscilloscope, all computed: for learning, and to "
                                     "see what a fault looks like before hardware shows it."),
                                  this));
    std::vector<std::pair<QString, QString>> faults;
    for (const auto& fault : kFaults)
        faults.emplace_back(QString::number(faults.size()), QCoreApplication::translate("Faults", fault.words));
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
    connect(form_, &FieldForm::edited, this, &SimulatedBenchDialog::judge);
    judge();
    const int wide = fontMetrics().averageCharWidth() * kBenchChars;
    resize(wide, layout->totalHeightForWidth(wide));
    growWithContent(*this);
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
    for (const auto* device : {"stimulator", "finger", "oscilloscope"}) {
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
