#include "core/pilot/PilotSettings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/base/JsonText.h"
#include "core/pilot/PilotRecord.h"
#include "core/study/Study.h"

namespace tacto {

std::vector<PresentedCondition> presentedConditions(const PilotSettings& settings, double min, double max,
                                                    double step) {
    std::vector<PresentedCondition> out;
    const bool swapped = settings.assignment == Assignment::Swapped;
    for (const auto& condition : settings.conditions) {
        const double x = swapped ? condition.P : condition.R, y = swapped ? condition.R : condition.P;
        const double level = x == 0 ? min : x == 1 ? max : std::round((min + x * (max - min)) / step) * step;
        const auto interval = settings.longest + y * (settings.shortest - settings.longest);
        out.push_back({condition.name, level, y == 0 ? settings.longest : y == 1 ? settings.shortest : interval});
    }
    return out;
}

namespace {

constexpr const char* kPain = "pain";

/// Returns all events that held a session while it ran, answered or not.
std::vector<PilotHold> heldIn(const std::vector<SessionRow>& rows, int ceiling) {
    std::vector<PilotHold> all;
    for (const auto& each : rows) {
        if (each.name == row::kAnswer && textOr(each.body, "response") == row::kTooStrong)
            all.push_back(tooStrongHold(textOr(each.body, "name")));
        if (each.name != row::kRating) continue;
        if (auto pain = painHold(each.body, ceiling)) all.push_back(std::move(*pain));
    }
    return all;
}

/// Whether the file of a booked part is missing.
bool isMissing(const Study& study, const StudySession& session) {
    return std::ranges::any_of(session.parts, [&](const StudyPart& each) {
        std::error_code error;
        return !std::filesystem::exists(study.pathOf(each.file), error);
    });
}

}  // namespace

PilotHold tooStrongHold(std::string_view trial) {
    return {fmt::format("too strong, {}", trial), "The participant called what they felt too strong"};
}

std::optional<PilotHold> painHold(const nlohmann::json& rating, int ceiling) {
    const double pain = textOr(rating, "asked") == kPain ? numberOr(rating, "value") : 0;
    if (pain < ceiling) return std::nullopt;
    return PilotHold{
        fmt::format("pain, {}", textOr(rating, "name")),
        fmt::format("The participant rated pain {:.0f} of 10, and the study's ceiling is {}", pain, ceiling)};
}

std::vector<PilotHold> openHolds(const Study& study, const Participant& who) {
    const int ceiling = study.settings().painCeiling.value_or(kPainCeiling);
    std::vector<PilotHold> found;
    std::set<std::string> answered;
    for (const auto& session : study.sessions()) {
        const bool theirs = session.participant == who.id;
        const auto rows = study.events(session);
        if (theirs && session.opened && (!rows || isMissing(study, session))) {
            found.push_back(
                {fmt::format("session {}, not known", session.id),
                 fmt::format("The record of session {} is gone or does not open, and what was felt in it is "
                             "not known",
                             session.number)});
        }
        if (!rows) continue;
        std::set<std::string> here;
        for (const auto& each : *rows)
            if (each.name == row::kHold) here.insert(textOr(each.body, "name"));
        // The program answers as a virtual participant's operator: that releases no hold for a person.
        if (session.basis != SessionBasis::Virtual || who.isVirtual()) answered.insert(here.begin(), here.end());
        if (!theirs) continue;
        auto held = heldIn(*rows, ceiling);
        std::erase_if(held, [&](const PilotHold& each) { return here.contains(each.name); });
        if (held.empty()) continue;
        found.push_back({fmt::format("session {}, {} times", session.id, held.size()),
                         fmt::format("In session {} and unanswered: {}", session.number, held.back().said)});
    }
    const auto events = study.adverseEvents();
    for (std::size_t i = 0; events && i < events->size(); ++i) {
        const auto& [session, event] = (*events)[i];
        if (!event.serious && event.reported) continue;
        found.push_back({fmt::format("adverse event {}", i + 1),
                         fmt::format("An adverse event {} is {}{}: “{}”",
                                     session.empty() ? "outside sessions" : "of session " + session,
                                     event.serious ? "serious" : "not reported",
                                     event.serious && !event.reported ? " and not reported" : "", event.what)});
    }
    std::erase_if(found, [&](const PilotHold& each) { return answered.contains(each.name); });
    return found;
}

}  // namespace tacto
