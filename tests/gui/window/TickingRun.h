// TickingRun.h - a run, on the simulated bench, of a protocol that waits and logs this until it is stopped.
//
// Thread-safety: the GUI thread.
#pragma once

#include <string>

#include "app/gui/controller/BenchController.h"
#include "app/run/ProtocolRun.h"

namespace tacto::test {

[[nodiscard]] inline Result<RunOrder> tickingRun(gui::BenchController& controller, const std::string& name) {
    RunOrder order;
    order.script.name = name;
    order.script.text =
        "protocol({ title: 'T', needs: [], parameters: {} });\n"
        "function run(p) { for (;;) { bench.wait(0.1); log('tick'); } }";
    auto declaration = readDeclaration(order.script);
    if (!declaration) return failure(declaration);
    order.declaration = std::move(*declaration);
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    order.limits = controller.limits();
    return order;
}

}  // namespace tacto::test
