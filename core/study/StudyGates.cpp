#include "core/study/StudyGates.h"

#include <algorithm>

#include "core/session/SessionReader.h"
#include "core/study/Gates.h"

namespace tacto {

namespace {

/// When the participant was first stimulated in the session's last part in which they were; nothing where they never
/// were. A part that cannot be read counts from its beginning.
std::optional<std::chrono::sys_seconds> stimulatedAt(const StudyFiles& files, const StudySession& session) {
    constexpr std::string_view kTrialBegin = "trial-begin";
    if (!session.opened) return {};
    std::optional<std::chrono::sys_seconds> last;
    for (const auto& part : session.parts) {
        const auto reader = SessionReader::open(files.session(part.file));
        const auto events = reader ? reader->events() : Result<std::vector<SessionRow>>(failure(reader));
        if (!events || !reader->checkChain()) {  // gone, unreadable or changed: unknown is not none
            last = part.begun;
            continue;
        }
        const auto first = std::ranges::find(*events, kTrialBegin, &SessionRow::name);
        if (first == events->end()) continue;
        const bool runsAhead = reader->about().virtualClock;
        last = part.begun + (runsAhead ? std::chrono::seconds(0) : std::chrono::floor<std::chrono::seconds>(first->at));
    }
    return last;
}

}  // namespace

Result<std::vector<std::string>> strangersIn(const StudyFiles& files, const LedgerState& known) {
    std::error_code error;
    std::vector<std::string> strangers;
    const auto isGivenUp = [&](const std::string& name) {
        return std::ranges::any_of(known.wentBack, [&](const StudyGoingBack& each) {
            return std::ranges::find(each.files, name) != each.files.end();
        });
    };
    for (const auto& entry : std::filesystem::directory_iterator(files.sessions(), error)) {
        if (entry.path().extension() != ".tacto") continue;
        const auto name = entry.path().filename().string();
        if (known.sessionOfFile(entry.path().stem().string()) == nullptr && !isGivenUp(name)) strangers.push_back(name);
    }
    if (error) return fail(ErrorCode::Io, "{} cannot be read: {}", files.sessions().string(), error.message());
    std::ranges::sort(strangers);
    return strangers;
}

Result<void> StudyGates::record() const {
    if (auto newest = book_.isNewest(); !newest) return newest;
    for (const auto& [file, head] : book_.known.heads) {
        if (head.empty() || headOf(book_.files.session(file)) == head) continue;
        return fail(kGateRefused,
                    "the record of session {} is not the one that the ledger notes: it is gone or was changed; put "
                    "it back from your copy",
                    file);
    }
    return clockGate(book_.known.last, book_.now());
}

Result<void> StudyGates::stillApproved() const {
    if (auto sound = record(); !sound) return sound;
    return approvalGate(book_.settings, book_.today());
}

/// What a person answered and what a virtual participant did are never one participant's.
Result<void> StudyGates::basisGate(const SessionRequest& request, const Participant& participant) const {
    if (request.personAnswers && participant.isVirtual() && book_.settings.kind == StudyKind::Study)
        return fail(kGateRefused,
                    "{} is a virtual participant and answers by itself; a person answers for it in a "
                    "rehearsal only",
                    participant.code);
    const auto now = Study::basisOf(request, participant);
    for (const auto& session : book_.known.sessions) {
        if (session.participant != participant.id || !session.opened || session.basis == now) continue;
        return fail(kGateRefused,
                    "session {} of {} rests on a {}, and this one would rest on a {}; another participant, or another "
                    "seed, is expected",
                    session.number, participant.code, nameOf(session.basis), nameOf(now));
    }
    return {};
}

Result<void> StudyGates::session(const SessionRequest& request, Participant participant, bool again) const {
    if (auto holds = stillApproved(); !holds) return holds;
    if (auto holds = scriptGate(book_.settings, request.script); !holds) return holds;
    if (auto holds = procedureGate(book_.settings, request.procedure); !holds) return holds;
    if (again) --participant.sessions;
    participant.sessions -= static_cast<int>(std::ranges::count_if(book_.known.sessions, [&](const StudySession& each) {
        return each.participant == participant.id && !each.opened;
    }));
    if (auto holds = participantGate(book_.settings, participant); !holds) return holds;
    std::optional<std::chrono::sys_seconds> last;
    for (const auto& session : book_.known.sessions) {
        if (again || session.participant != participant.id) continue;
        if (const auto at = stimulatedAt(book_.files, session)) last = at;
    }
    if (auto holds = gapGate(book_.settings, last, book_.now()); !holds) return holds;
    if (!again) {
        if (auto holds = wentBackGate(book_.settings, book_.known.wentBack, book_.now()); !holds) return holds;
    }
    if (auto holds = book_.consented(participant); !holds) return holds;
    if (!request.codeConfirmed) {
        return fail(kGateRefused, "the participant has not confirmed that the code {} is theirs", participant.code);
    }
    if (const auto yes = book_.known.excluded.find(participant.id);
        yes != book_.known.excluded.end() && !(utcDay(yes->second) < book_.today())) {
        return fail(kGateRefused,
                    "{} answered yes to the exclusion checklist today; a session begins tomorrow at the "
                    "earliest",
                    participant.code);
    }
    if (auto holds = exclusionGate(request.exclusions); !holds) return holds;
    if (auto holds = simulationGate(book_.settings, participant, request.devicesSimulated); !holds) return holds;
    return basisGate(request, participant);
}

}  // namespace tacto
