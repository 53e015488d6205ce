// The scale of roughness from reference surfaces.
#include <cmath>
#include <set>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "core/analysis/sensor_calibration/SensorCalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"

namespace tacto::host::analysis {

Result<Json> sensorCalibration(ScriptSession& session, const Arguments& arguments) {
    const Json& rows = arguments.list("surfaces");
    const Json& rest = arguments.object("rest");
    auto levels = sensorRestFrom(rest);
    if (!levels) return failure(levels);
    std::vector<SlidSurface> surfaces;
    bool own = session.own().noted(rest);
    std::set<Json> seen;
    for (const auto& row : rows) {
        if (!row.is_object() || !row.value("slides", Json()).is_array()) {
            return arguments.wrong("a surface", row, "an object with name, ra_um, rz_um and slides");
        }
        SlidSurface surface;
        const Json name = row.value("name", Json(""));
        if (!name.is_string()) return arguments.wrong("name", name, "a text");
        surface.name = name;
        for (const auto& [key, target] : {std::pair{"ra_um", &surface.ra_um}, std::pair{"rz_um", &surface.rz_um}}) {
            const Json value = row.value(key, Json());
            const auto height = takes::number(key, "um", "of the surface").range(0, 1e5).orNull();
            if (!height.accepts(value)) return arguments.wrong(key, value, height.accepted());
            if (value.is_number()) *target = value.get<double>();
        }
        for (const auto& one : row["slides"]) {
            auto slid = slideReadingFrom(one);
            if (!slid) return failure(slid);
            surface.slides.push_back(*std::move(slid));
            own = own && session.own().noted(one) && one["material"] == surface.name && seen.insert(one).second;
        }
        surfaces.push_back(std::move(surface));
    }
    auto found = calibrateSensor(surfaces, session.bench().profile().roughness, *levels);
    if (!found) return failure(found);
    Json out = toJson(*found);
    if (own) session.own().note(out);
    return out;
}

}  // namespace tacto::host::analysis
