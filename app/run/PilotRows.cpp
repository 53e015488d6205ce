#include "app/run/PilotRows.h"

#include <algorithm>
#include <cstdio>

#include "core/base/JsonFields.h"
#include "core/devices/Device.h"
#include "core/pilot/FoundRows.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

/// As wallTimeUtc() writes it; the beginning of 1970 for another text.
std::chrono::sys_seconds wallTimeFrom(const std::string& iso) {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
    if (std::sscanf(iso.c_str(), "%d-%d-%dT%d:%d:%d", &year, &month, &day, &hour, &minute, &second) != 6) return {};
    using namespace std::chrono;
    const sys_days days{std::chrono::year(year) / month / day};
    return days + hours(hour) + minutes(minute) + seconds(second);
}

}  // namespace

Result<PilotRows> pilotRows(const Study& study, const StudySession& session) {
    PilotRows rows;
    rows.answeredAt = session.parts.front().begun;
    for (const auto& part : session.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        const auto& reader = *file;
        if (!reader) continue;
        auto events = reader->events();
        if (!events) return failure(events);
        const auto& about = reader->about();
        for (const auto& event : *events) {
            if (event.name == row::kPlan) rows.runSha256 = planRowFrom(event.body).runSha256;
            if (event.name == row::kSessionEnd) rows.ended = pilotEndFrom(textOr(event.body, "state"));
            if (event.name != row::kAnswer && event.name != row::kNoAnswer && event.name != row::kTrialBegin) continue;
            auto at = wallTimeFrom(about.wallStart);
            if (!about.virtualClock) at += std::chrono::floor<std::chrono::seconds>(event.at - about.wallStartAt);
            rows.answeredAt = std::max(rows.answeredAt, at);
        }
        std::ranges::move(*events, std::back_inserter(rows.events));
        if (!rows.seed) rows.seed = about.seed;
        const auto delivers = std::ranges::find_if(about.devices, [](const SessionDevice& device) {
            return device.is(Role::Stimulator) || device.is(Role::Massager);
        });
        if (!rows.delivers && delivers != about.devices.end()) rows.delivers = *delivers;
        rows.chainHead = reader->chainHead();
    }
    return rows;
}

}  // namespace tacto
