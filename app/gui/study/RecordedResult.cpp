#include "app/gui/study/RecordedResult.h"

#include "core/base/Words.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

Result<RunResult> recordedResult(const Study& study, const StudySession& session) {
    if (session.state != StudySessionState::Complete)
        return fail(kGateRefused, "session {} is {}; only a complete one has a result", session.number,
                    nameOf(session.state));
    RunResult result;
    bool found = false;
    for (const auto& part : session.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        if (!*file) continue;  // booked, and never begun
        auto verdicts = (*file)->verdicts();
        if (!verdicts) return failure(verdicts);
        const auto& about = (*file)->about();
        result.simulated = result.simulated || about.simulated;
        result.devices = about.devices;
        result.session = study.pathOf(part.file);
        if (verdicts->empty()) continue;
        auto& last = verdicts->back();
        result.outcome.verdict = valueFor(kScriptVerdicts, last.verdict).value_or(ScriptVerdict::None);
        result.outcome.reasons = std::move(last.reasons);
        result.outcome.results = std::move(last.results);
        found = true;
    }
    if (!found)
        return fail(ErrorCode::NotFound, "the record of session {} of {} holds no result", session.number,
                    session.code);
    return result;
}

}  // namespace tacto::gui
