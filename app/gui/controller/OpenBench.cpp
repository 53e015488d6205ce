#include "app/gui/controller/OpenBench.h"

namespace tacto::gui {

std::shared_ptr<const OpenBench> describeBench(const OpenedBench& opened) {
    auto open = std::make_shared<OpenBench>();
    open->about = opened.about;
    open->session = opened.files.session;
    auto& bench = *opened.bench;
    auto& devices = bench.devices();
    if (devices.sensor) open->streams.assign(devices.sensor->streams().begin(), devices.sensor->streams().end());
    if (devices.stimulator) open->source = devices.stimulator->traits();
    if (devices.stimulator)
        open->output = devices.stimulator->identity();
    else if (devices.massager)
        open->output = devices.massager->identity();
    if (devices.oscilloscope) open->scope = devices.oscilloscope->traits();
    open->paced = bench.clock().isVirtual();
    open->surfaces = devices.surface != nullptr;
    open->untriggered = bench.canCaptureUntriggered();
    return open;
}

}  // namespace tacto::gui
