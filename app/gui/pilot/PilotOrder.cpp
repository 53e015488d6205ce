#include "app/gui/pilot/PilotOrder.h"

#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

Result<RunOrder> pilotOrder(const PilotStart& start, BenchController& controller) {
    auto source = ProtocolLibrary().find(start.protocol);
    if (!source) return failure(source);
    auto declaration = readDeclaration(*source);
    if (!declaration) return failure(declaration);
    std::map<std::string, std::string> given{
        {"participant", start.participant}, {"method", start.method}, {"modality", start.modality}};
    if (!start.unfinished.empty()) given["unfinished"] = start.unfinished;
    if (start.blocks) given["blocks"] = std::to_string(*start.blocks);
    auto settings = applySettings(*declaration, given);
    if (!settings) return failure(settings);
    auto order = controller.orderOf(std::move(*source), std::move(*declaration), std::move(*settings));
    order.uris = start.devices;
    order.needed = order.declaration.needs;
    order.seed = start.seed;
    order.realtime = start.person || start.realTime;
    return order;
}

}  // namespace tacto::gui
