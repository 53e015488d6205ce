#include "app/run/PilotRows.h"

#include <algorithm>

#include "core/base/JsonText.h"
#include "core/devices/Device.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"

namespace tacto {

Result<PilotRows> pilotRows(const Study& study, const StudySession& session) {
    PilotRows rows;
    rows.answeredAt = session.parts.front().begun;
    bool allTimed = true;
    for (const auto& part : session.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        const auto& reader = *file;
        if (!reader) continue;
        auto events = reader->events();
        if (!events) return failure(events);
        const auto& about = reader->about();
        const auto started = wallTimeFrom(about.wallStart);
        for (const auto& event : *events) {
            if (event.name == row::kPlan) {
                auto plan = planRowFrom(event.body);
                rows.runSha256 = std::move(plan.runSha256);
                rows.language = std::move(plan.language);
                rows.wordsSha256 = std::move(plan.wordsSha256);
            }
            if (event.name == row::kSessionEnd) rows.ended = pilotEndFrom(textOr(event.body, "state"));
            if (event.name != row::kAnswer && event.name != row::kNoAnswer && event.name != row::kTrialBegin) continue;
            allTimed = allTimed && started;
            if (!started) continue;
            auto at = *started;
            if (!about.virtualClock) at += std::chrono::floor<std::chrono::seconds>(event.at - about.wallStartAt);
            rows.answeredAt = std::max(*rows.answeredAt, at);
        }
        std::ranges::move(*events, std::back_inserter(rows.events));
        if (!rows.seed) rows.seed = about.seed;
        const auto delivers = std::ranges::find_if(about.devices, [](const SessionDevice& device) {
            return device.is(Role::Stimulator) || device.is(Role::Massager);
        });
        if (!rows.delivers && delivers != about.devices.end()) rows.delivers = *delivers;
        rows.chainHead = reader->chainHead();
    }
    if (!allTimed) rows.answeredAt.reset();
    return rows;
}

}  // namespace tacto
