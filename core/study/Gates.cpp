#include "core/study/Gates.h"

#include <algorithm>
#include <ctime>
#include <utility>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

constexpr std::pair<const char*, const char*> kExclusionItems[] = {
    {"implant", "Do you have an active implant, such as a pacemaker or a pump?"},
    {"epilepsy", "Do you have epilepsy, or did you ever have a seizure?"},
    {"pregnancy", "Are you pregnant, or could you be?"},
    {"heart", "Do you have heart trouble?"},
    {"bleeding", "Do you have a bleeding disorder, or take blood thinners?"},
    {"skin", "Is the skin at the site broken, inflamed or numb, or is there metal or swelling under it?"},
    {"alcohol", "Did you have alcohol or sedatives today?"},
    {"allergy", "Did your skin ever react to gel or adhesive?"},
    {"age", "Are you under age?"},
    {"hf", "Is short-wave or surgical high-frequency equipment within 1 m?"},
};

constexpr auto kClockTolerance = std::chrono::minutes(5);

/// A participant's name in a sentence: the code, if it is known.
std::string shownName(const Participant& participant) {
    return participant.code.empty() ? fmt::format("participant {}", participant.id) : participant.code;
}

}  // namespace

std::string utcText(std::chrono::sys_seconds at) {
    const auto day = std::chrono::floor<std::chrono::days>(at);
    const std::chrono::hh_mm_ss time(at - day);
    return fmt::format("{} {:02}:{:02} UTC", dateText(std::chrono::year_month_day(day)), time.hours().count(),
                       time.minutes().count());
}

std::string nextText(std::chrono::sys_seconds at) {
    at = std::chrono::ceil<std::chrono::minutes>(at);
    const std::time_t seconds = at.time_since_epoch().count();
    std::tm here{};
    if (::localtime_r(&seconds, &here) == nullptr || here.tm_gmtoff == 0) return utcText(at);
    const auto local = utcText(at + std::chrono::seconds(here.tm_gmtoff));
    return fmt::format("{} ({} local time)", utcText(at), local.substr(0, local.rfind(' ')));
}

std::vector<ExclusionItem> exclusionItems(const StudySettings& settings) {
    std::vector<ExclusionItem> all;
    for (const auto& [key, question] : kExclusionItems) all.push_back({key, question});
    for (std::size_t i = 0; i < settings.exclusions.size(); ++i)
        all.push_back({fmt::format("own-{}", i + 1), settings.exclusions[i]});
    return all;
}

std::vector<ExclusionAnswer> nothingExcludes(const StudySettings& settings) {
    std::vector<ExclusionAnswer> all;
    for (const auto& item : exclusionItems(settings)) all.push_back({item.key, false});
    return all;
}

Result<void> exclusionGate(std::span<const ExclusionAnswer> answers, const StudySettings& settings) {
    const auto items = exclusionItems(settings);
    for (const auto& answer : answers) {
        if (std::ranges::find(items, answer.key, &ExclusionItem::key) != items.end()) continue;
        return invalid("the exclusion checklist has no item \"{}\"", answer.key);
    }
    std::size_t open = 0;
    for (const auto& item : items) {
        if (std::ranges::count(answers, item.key, &ExclusionAnswer::key) != 1) ++open;
    }
    if (open != 0) {
        return fail(kGateRefused, "{} of the {} questions of the exclusion checklist are not answered; each is asked",
                    open, items.size());
    }
    if (std::ranges::any_of(answers, &ExclusionAnswer::yes)) {
        return fail(kGateRefused,
                    "an answer to the exclusion checklist is yes: there is no session today; every answer must be no");
    }
    return {};
}

Result<void> approvalGate(const StudySettings& settings, CalibrationDate today) {
    const auto& approval = settings.approval;
    if (approval.reference.empty())
        return fail(kGateRefused, "the study has no approval; a committee's reference is needed");
    if (!(today >= approval.from)) {
        return fail(kGateRefused, "approval {} begins on {}, and today is {}; sessions can begin from that day on",
                    approval.reference, dateText(approval.from), dateText(today));
    }
    if (!(today <= approval.expires)) {
        return fail(kGateRefused, "approval {} expired on {}, and today is {}; an amendment with a later day is needed",
                    approval.reference, dateText(approval.expires), dateText(today));
    }
    if (const auto now = protocolHash(settings); now != approval.protocolSha256) {
        return fail(
            kGateRefused,
            "the study's settings and scripts hash to {:.12}…, and approval {} is for {:.12}…; a change needs an "
            "amendment",
            now, approval.reference, approval.protocolSha256);
    }
    return {};
}

Result<void> scriptGate(const StudySettings& settings, const ScriptHash& script) {
    if (settings.kind == StudyKind::Rehearsal) return {};
    const auto approved = std::ranges::find(settings.scripts, script.name, &ScriptHash::name);
    if (approved == settings.scripts.end()) {
        return fail(kGateRefused, "the script {} is none of those that approval {} names; an amendment is needed",
                    script.name, settings.approval.reference);
    }
    if (approved->sha256 != script.sha256) {
        return fail(
            kGateRefused,
            "the script {} hashes to {:.12}…, and approval {} is for {:.12}…; a changed script needs an amendment",
            script.name, script.sha256, settings.approval.reference, approved->sha256);
    }
    return {};
}

Result<void> procedureGate(const StudySettings& settings, const StudyProcedure& procedure) {
    if (settings.kind == StudyKind::Rehearsal || !settings.procedure) return {};
    const auto& approved = *settings.procedure;
    const auto refused = [&](std::string_view what, const auto& now, const auto& then, std::string_view unit) {
        return fail(kGateRefused, "{} is {}{}, and approval {} is for {}{}; a change needs an amendment", what, now,
                    unit, settings.approval.reference, then, unit);
    };
    if (procedure.intervalMin_s != approved.intervalMin_s)
        return refused("the profile's shortest interval", procedure.intervalMin_s, approved.intervalMin_s, " s");
    if (procedure.intervalMax_s != approved.intervalMax_s)
        return refused("the profile's longest interval", procedure.intervalMax_s, approved.intervalMax_s, " s");
    if (procedure.method != approved.method)
        return refused("the method of detection", nameOf(procedure.method), nameOf(approved.method), "");
    if (procedure.comparison != approved.comparison) {
        const auto said = [](bool compares) { return compares ? "measured" : "not measured"; };
        return refused("the Weber fraction of strength", said(procedure.comparison), said(approved.comparison), "");
    }
    if (procedure.conditionsSha256 != approved.conditionsSha256) {
        return fail(kGateRefused,
                    "the profile's conditions, assignment, polarity, load range and ceilings hash to {:.12}…, and "
                    "approval {} is for {:.12}…; a change needs an amendment",
                    procedure.conditionsSha256, settings.approval.reference, approved.conditionsSha256);
    }
    return {};
}

Result<void> ageGate(const StudySettings& settings, const Participant& participant) {
    const auto age = parseWhole<int>(participant.age);
    if (!settings.ageMin || !age || *age >= *settings.ageMin) return {};
    return fail(kGateRefused, "an age of {} years is below the approval's; {} years or more are accepted", *age,
                *settings.ageMin);
}

Result<void> participantGate(const StudySettings& settings, const Participant& participant) {
    if (participant.state != ParticipantState::Active) {
        return fail(kGateRefused, "{} has {} the study; only an active participant takes part", shownName(participant),
                    participant.state == ParticipantState::Left ? "left" : "withdrawn from");
    }
    if (settings.kind == StudyKind::Study && participant.sessions >= settings.sessionsMax) {
        return fail(kGateRefused, "{} has had {} sessions, and approval {} allows {}; a further one needs an amendment",
                    shownName(participant), participant.sessions, settings.approval.reference, settings.sessionsMax);
    }
    return {};
}

std::chrono::sys_seconds gapEnd(const StudySettings& settings, std::chrono::sys_seconds lastSession) {
    return lastSession +
           std::chrono::ceil<std::chrono::seconds>(std::chrono::duration<double, std::ratio<3600>>(settings.gapMin_h));
}

Result<void> gapGate(const StudySettings& settings, std::optional<std::chrono::sys_seconds> lastSession,
                     std::chrono::sys_seconds now) {
    if (settings.kind == StudyKind::Rehearsal || !lastSession) return {};
    const double hours = std::chrono::duration<double, std::ratio<3600>>(now - *lastSession).count();
    if (hours >= settings.gapMin_h) return {};
    return fail(kGateRefused,
                "the last session's first train was {:.1f} h ago; at least {:g} h must lie between two sessions", hours,
                settings.gapMin_h);
}

Result<void> consentGate(const StudySettings& settings, const Participant& participant, CalibrationDate since,
                         CalibrationDate today) {
    const auto name = shownName(participant);
    if (participant.consents.empty()) {
        return fail(kGateRefused, "{} has given no consent; a dated consent to version {} is needed", name,
                    settings.consentVersion);
    }
    const Consent* newest = nullptr;
    for (const auto& each : participant.consents) {
        if (each.version != settings.consentVersion) continue;
        newest = &each;
        if (!each.by.empty() && each.date.ok() && since <= each.date && each.date <= today) return {};
    }
    if (newest == nullptr) {
        return fail(kGateRefused, "{} has consented to version {}, and version {} is in force; consent to it is needed",
                    name, participant.consents.back().version, settings.consentVersion);
    }
    return fail(
        kGateRefused,
        "the consent of {} is dated {} and taken by \"{}\"; initials and a day from {}, from which version {} of "
        "the form is approved, to {} are needed",
        name, dateText(newest->date), newest->by, dateText(since), settings.consentVersion, dateText(today));
}

namespace {
/// The later of two times: of going back, and of the newest known row, unless that lies in the future.
std::chrono::sys_seconds wentBackAt(const StudyGoingBack& back, std::chrono::sys_seconds now) {
    return back.newestAt <= now ? std::max(back.at, back.newestAt) : back.at;
}
}  // namespace

std::chrono::sys_seconds wentBackEnd(const StudySettings& settings, const StudyGoingBack& last,
                                     std::chrono::sys_seconds now) {
    using std::chrono::days;
    const auto at = wentBackAt(last, now);
    return std::max(gapEnd(settings, at), std::chrono::sys_seconds(std::chrono::floor<days>(at) + days(1)));
}

Result<void> wentBackGate(const StudySettings& settings, std::span<const StudyGoingBack> all,
                          std::chrono::sys_seconds now) {
    if (settings.kind == StudyKind::Rehearsal || all.empty()) return {};
    const auto at = wentBackAt(all.back(), now);
    const double hours = std::chrono::duration<double, std::ratio<3600>>(now - at).count();
    using std::chrono::days;
    if (hours >= settings.gapMin_h && std::chrono::floor<days>(at) < std::chrono::floor<days>(now)) return {};
    return fail(kGateRefused,
                "the ledger went back {:.1f} h ago, and what it lost may be a session of today; the next begins on a "
                "later day, at least {:g} h after it",
                hours, settings.gapMin_h);
}

Result<void> clockGate(std::chrono::sys_seconds last, std::chrono::sys_seconds now, std::string_view of) {
    if (now + kClockTolerance >= last) return {};
    return fail(kGateRefused, "the clock says {}, and {} is of {}; set the clock", utcText(now), of, utcText(last));
}

Result<void> simulationGate(const StudySettings& settings, const Participant& participant, bool devicesSimulated) {
    if (participant.virtualSeed && !devicesSimulated) {
        return fail(kGateRefused, "{} is a virtual participant; only simulated devices are accepted",
                    shownName(participant));
    }
    if (settings.kind == StudyKind::Rehearsal && settings.modality == Modality::Electrodes && !devicesSimulated) {
        return fail(kGateRefused,
                    "{} is in a rehearsal, which no committee has approved; only simulated devices are accepted",
                    shownName(participant));
    }
    if (!participant.virtualSeed && devicesSimulated && settings.kind == StudyKind::Study) {
        return fail(kGateRefused, "{} is a person and the devices are simulated; that is accepted in a rehearsal only",
                    shownName(participant));
    }
    return {};
}

}  // namespace tacto
