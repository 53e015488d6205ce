#include "app/scripting/host/report/LoadTracings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>
#include <vector>

#include "app/scripting/host/plot/PlotFigures.h"
#include "app/scripting/host/report/Cells.h"
#include "core/base/QuantityText.h"

namespace tacto::host::report {

namespace {

constexpr std::string_view kShown[] = {"500 ohm", "2 kohm", "10 kohm"};
constexpr std::string_view kNote = "From the baseline before the train; the strongest command that the limits allow.";

std::string volts(const Json& of) { return fmt::format("{:.0f} V", std::round(numberOr(of, "command_v"))); }

Json figureItem(ScriptSession& session, std::string_view caption, const std::vector<plot::Tracing>& tracings,
                std::string_view settings) {
    Json figure = plot::tracingsFigure(session, tracings);
    figure["note"] = fmt::format("{}. {}", settings, kNote);
    return {{"kind", "figure"}, {"caption", caption}, {"figure", std::move(figure)}};
}

}  // namespace

Json loadTracings(ScriptSession& session, const Json& loads, const Json& burst) {
    Json items = Json::array();
    std::vector<plot::Tracing> pulses;
    std::vector<std::string> settings;
    for (const auto name : kShown) {
        const auto load = std::ranges::find_if(
            loads, [&](const Json& each) { return textOr(each, "name") == name && !listIn(each, "steps").empty(); });
        if (load == loads.end()) continue;
        const Json& step = listIn(*load, "steps").back();
        const double width_s = numberOr(step.at("reading"), "width_s");
        const auto width = std::isnan(width_s) ? "width not measured" : scaledText(width_s, "s") + " a phase";
        const auto written = writtenLoad(std::string(name));
        pulses.push_back({textOr(step, "condition"), written + ", " + volts(step)});
        settings.push_back(fmt::format("{} into {}, {}, {:.0f} MS/s", volts(step), written, width,
                                       std::round(numberOr(step, "rate_hz") / 1e6)));
    }
    if (!pulses.empty())
        items.push_back(figureItem(session, "Single pulses", pulses, fmt::format("{}", fmt::join(settings, "; "))));
    if (burst.is_null()) return items;
    const auto load = writtenLoad(textOr(burst, "load"));
    items.push_back(
        figureItem(session, "Burst", {{textOr(burst, "condition"), load + ", " + volts(burst)}},
                   fmt::format("burst of {} every {} s into {}, {:.0f} kS/s", volts(burst),
                               numberOr(burst, "interval_s"), load, std::round(numberOr(burst, "rate_hz") / 1e3))));
    return items;
}

}  // namespace tacto::host::report
