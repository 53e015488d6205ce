#include "core/pilot/PilotEnding.h"

#include <fmt/format.h>

#include "core/base/JsonText.h"
#include "core/base/Words.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

constexpr Word<PilotEnd> kPilotEnds[] = {
    {"unfinished", PilotEnd::Unfinished}, {"complete", PilotEnd::Complete}, {"stopped", PilotEnd::Stopped}};

}  // namespace

std::string_view nameOf(PilotEnd end) noexcept { return wordFor<PilotEnd>(kPilotEnds, end); }

std::optional<PilotEnd> pilotEndFrom(std::string_view word) noexcept { return valueFor(kPilotEnds, word); }

std::string tooStrongNow(std::string_view level) {
    return fmt::format("{} was accepted before and is too strong now; the session ends here", level);
}

std::string endedBy(const PilotRecord& record) {
    if (record.count(row::kParticipantStop) >= kMaxParticipantStops) return kThirdStop;
    if (record.count(row::kFault) >= kMaxFaults) return kSecondFault;
    std::string ended;
    record.each([&](std::string_view kind, const nlohmann::json& body) {
        if (kind == row::kGate && flagOr(body, row::kEnds)) ended = textOr(body, "said");
        if (kind == row::kAnswer && flagOr(body, row::kRamp) && textOr(body, "response") == row::kTooStrong)
            ended = tooStrongNow("a level");
    });
    return ended;
}

}  // namespace tacto
