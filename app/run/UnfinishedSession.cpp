#include "app/run/UnfinishedSession.h"

#include <utility>

#include "core/base/Clock.h"

namespace tacto {

Result<UnfinishedSession> UnfinishedSession::choose(const Study& study, const Participant& who, const Choice& choice) {
    UnfinishedSession made;
    made.code_ = who.code;
    made.inWindow_ = choice.inWindow;
    auto open = study.unfinished(who.id);
    if (!open) return made;
    if (choice.wanted != "end" && choice.wanted != "resume")
        return fail(ErrorCode::NotFound,
                    "session {} of {} ({}) is unfinished; --set unfinished=resume or unfinished=end is expected",
                    open->number, who.code, open->protocol);
    auto rows = pilotRows(study, *open);
    if (choice.wanted == "end") {  // possible even if the session can no longer be read
        // Complete if the program ended before the study recorded that.
        const bool complete = rows && rows->ended == PilotEnd::Complete;
        made.ends_ = Ends{std::move(*open), complete ? StudySessionState::Complete : StudySessionState::Stopped};
        return made;
    }
    if (open->protocol != choice.protocol)
        return fail(ErrorCode::NotFound, "session {} of {} is of {}; it goes on with that protocol, or ends with {}",
                    open->number, who.code, open->protocol, made.whatEnds());
    if (!rows) return failure(rows);
    made.continued_ = std::move(open);
    made.earlier_ = std::move(*rows);
    if (auto may = made.mayResume(study); !may) return failure(may);
    return made;
}

std::string_view UnfinishedSession::whatEnds() const {
    return inWindow_ ? "“End it as stopped”" : "--set unfinished=end";
}

Result<void> UnfinishedSession::mayResume(const Study& study) const {
    const auto now = SystemTime::real().wall();
    if (earlier_.mayGoOn(now)) {
        if (auto approved = study.stillApproved(); !approved) return approved;
        if (!earlier_.answeredAt) return {};  // the session is complete
        return clockGate(*earlier_.answeredAt, now, "what was last presented or answered");
    }
    if (!earlier_.answeredAt)
        return fail(
            kGateRefused,
            "session {} of {} does not say when it began; one that can go on within 2 h does, and this one ends "
            "with {}",
            continued_->number, code_, whatEnds());
    return fail(kGateRefused,
                "session {} of {} was interrupted {:.1f} h ago; it can go on within 2 h, and ends with {}",
                continued_->number, code_,
                std::chrono::duration<double, std::ratio<3600>>(now - *earlier_.answeredAt).count(), whatEnds());
}

Result<void> UnfinishedSession::sameDevice(const DeviceSet& devices) const {
    if (!continued_ || !earlier_.delivers) return {};
    const auto& begun = *earlier_.delivers;
    const auto& now = devices.stimulator ? devices.stimulator->identity() : devices.massager->identity();
    if (now.name == begun.name && now.serial == begun.serial) return {};
    const auto named = [](const std::string& name, const std::string& serial) {
        return serial.empty() ? name : name + " " + serial;
    };
    return fail(kGateRefused,
                "session {} of {} was begun with {} and {} is connected; it goes on with the former, or ends with {}",
                continued_->number, code_, named(begun.name, begun.serial), named(now.name, now.serial), whatEnds());
}

Result<void> UnfinishedSession::sameProcedure(std::string_view runSha256) const {
    if (!continued_ || earlier_.runSha256.empty() || earlier_.runSha256 == runSha256) return {};
    return fail(kGateRefused,
                "session {} of {} was begun with a profile, method and settings that hash to {:.12}…, and those of now "
                "hash to {:.12}…; it goes on with the former, or ends with {}",
                continued_->number, code_, earlier_.runSha256, runSha256, whatEnds());
}

Result<void> UnfinishedSession::sameWords(const ParticipantWords& words) const {
    const auto& begun = earlier_.wordsSha256;
    if (!continued_ || begun.empty() || begun == words.sha256()) return {};
    return fail(kGateRefused,
                "session {} of {} was begun with the words {} ({:.12}…), and {} are those of now; it goes on with the "
                "former, or ends with {}",
                continued_->number, code_, earlier_.language, begun, words.name(), whatEnds());
}

Result<BegunSession> UnfinishedSession::begin(Study& study, const SessionRequest& request,
                                              std::vector<std::string>& remarks) const {
    if (continued_) return study.continueSession(continued_->id, request);
    if (ends_) {
        if (auto may = study.mayBegin(request); !may) return failure(may);
        const auto& [session, state] = *ends_;
        if (auto ended = study.endSession(session.id, state, ""); !ended) return failure(ended);
        remarks.push_back(fmt::format("Session {} of {} was ended as {}.", session.number, code_, nameOf(state)));
    }
    return study.beginSession(request);
}

}  // namespace tacto
