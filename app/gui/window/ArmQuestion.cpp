#include "app/gui/window/ArmQuestion.h"

#include <algorithm>
#include <utility>

#include "app/gui/theme/Dialogs.h"
#include "core/devices/Driver.h"

namespace tacto::gui {

namespace {

/// What a simulated stimulator drives. What is connected to a real one only the operator can say.
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

void ArmQuestion::ask(ArmDialog::Purpose purpose) {
    const auto open = controller_.open();
    const bool live = controller_.activity() == Activity::Live && open;
    if (purpose == ArmDialog::Purpose::Arm && !live)
        return emit refused(tr("Nothing to arm: no bench is open. Open the simulated bench (Ctrl+B)"));
    if (!live || (purpose == ArmDialog::Purpose::CheckImpedance && !open->source))
        return emit refused(tr("No impedance to check: no stimulator is open. Open the simulated bench (Ctrl+B)"));
    auto* dialog = new ArmDialog(controller_, purpose, load_, &window_);
    connect(dialog, &QDialog::accepted, this, [this, dialog] { load_ = dialog->load(); });
    connect(&controller_, &BenchController::changed, dialog, &QDialog::reject);
    openDialog(dialog);
}

}  // namespace tacto::gui

#include "moc_ArmQuestion.cpp"
