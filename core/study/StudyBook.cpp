#include "core/study/StudyBook.h"

#include <algorithm>
#include <ctime>

#include "core/base/JsonFields.h"
#include "core/seal/SealedText.h"
#include "core/session/SessionReader.h"
#include "core/study/LedgerEnd.h"
#include "core/study/NewStudy.h"
#include "core/study/SessionSeal.h"

namespace tacto {

namespace {

std::tm localTime(std::chrono::sys_seconds at) {
    const std::time_t now = at.time_since_epoch().count();
    std::tm here{};
    ::localtime_r(&now, &here);
    return here;
}

}  // namespace

CalibrationDate localDay(std::chrono::sys_seconds at) {
    const auto here = localTime(at);
    return {std::chrono::year(here.tm_year + 1900), std::chrono::month(static_cast<unsigned>(here.tm_mon + 1)),
            std::chrono::day(static_cast<unsigned>(here.tm_mday))};
}

std::string headOf(const std::filesystem::path& file) {
    const auto reader = SessionReader::open(file);
    return reader && reader->checkChain() ? reader->chainHead() : std::string();
}

Result<std::vector<std::string>> strangersIn(const StudyFiles& files, const LedgerState& known) {
    std::error_code error;
    std::vector<std::string> strangers;
    for (const auto& entry : std::filesystem::directory_iterator(files.sessions(), error)) {
        if (entry.path().extension() != ".tacto") continue;
        if (known.sessionOfFile(entry.path().stem().string()) == nullptr)
            strangers.push_back(entry.path().filename().string());
    }
    if (error) return fail(ErrorCode::Io, "{} cannot be read: {}", files.sessions().string(), error.message());
    std::ranges::sort(strangers);
    return strangers;
}

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

CalibrationDate StudyBook::today() const { return localDay(now()); }

Result<void> StudyBook::read() {
    const auto ledgerFile = SessionReader::open(files.ledger());
    if (!ledgerFile) return failure(ledgerFile);
    auto replayed = replay(*ledgerFile, settings.id, keys ? &*keys : nullptr);
    if (!replayed) return failure(replayed);
    known = std::move(*replayed);
    return {};
}

Result<void> StudyBook::changeable() const {
    if (!ledger) {
        return fail(ErrorCode::Unsupported, "the study in {} was opened for reading; it is not changed",
                    files.folder.string());
    }
    if (!keys) {
        return fail(ErrorCode::Unsupported, "the study in {} is opened without its passphrase; it is needed here",
                    files.folder.string());
    }
    return {};
}

Result<void> StudyBook::append(const char* name, nlohmann::json body, const Secret* key,
                               const nlohmann::json& content) {
    if (key != nullptr) body["sealed"] = sealedInLedger(settings.id, *key, ledger->next(), name, content);
    auto row = ledger->append(now(), name, body);
    if (!row) return failure(row);
    if (const auto end = endFile(); !end.empty()) noteLedgerEnd(end, {*row, ledger->head()});
    return read();
}

Result<const StudyKeys::Entry*> StudyBook::keyOf(std::string_view participant) const {
    const auto* entry = keys ? keys->byId(participant) : nullptr;
    if (entry == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "there is no key of participant {}: it was destroyed, or the study is "
                    "opened without its passphrase",
                    participant);
    }
    return entry;
}

Result<void> StudyBook::appendOf(const Participant& participant, const char* name, nlohmann::json body,
                                 const nlohmann::json& content) {
    const auto entry = keyOf(participant.id);
    if (!entry) return failure(entry);
    body["participant"] = participant.id;
    const auto key = subkey((*entry)->key, 0);
    return append(name, std::move(body), &key, content);
}

Result<Participant> StudyBook::find(std::string_view code) const {
    if (!keys) {
        return fail(ErrorCode::Unsupported, "a participant is found by code only with the study's passphrase");
    }
    const auto usable = [](const Participant& one) { return one.state != ParticipantState::Withdrawn; };
    if (code.starts_with(kVirtualPrefix)) {
        for (const auto& one : known.participants) {
            if (usable(one) && one.virtualSeed && fmt::format("{}{}", kVirtualPrefix, *one.virtualSeed) == code)
                return one;
        }
        return fail(ErrorCode::NotFound, "the study has no participant {}; enrol it first", code);
    }
    const auto stored = checkedCode(code);
    if (!stored) return failure(stored);
    for (const auto& one : known.participants) {
        if (usable(one) && one.code == *stored) return one;
    }
    return fail(ErrorCode::NotFound, "the study has no participant {}; a code that is enrolled is expected", *stored);
}

Result<void> StudyBook::amend(StudySettings amended, std::string_view reference) {
    if (auto may = changeable(); !may) return may;
    if (reference.empty() || std::ranges::find(known.references, reference) != known.references.end()) {
        return fail(ErrorCode::InvalidArgument, "an amendment needs a reference of its own, not \"{}\"", reference);
    }
    if (amended.participantsMax < static_cast<int>(known.participants.size())) {
        return fail(ErrorCode::InvalidArgument, "participants_max is {}, and {} are enrolled; that or more is expected",
                    amended.participantsMax, known.participants.size());
    }
    amended.id = settings.id;
    amended.kind = settings.kind;
    amended.approval.reference = reference;
    amended.approval.protocolSha256 = protocolHash(amended);
    if (auto sound = studyFields().check(amended, RecordPlace{}); !sound) return sound;
    const auto text = studyText(amended);
    if (auto drafted = draftStudy(files, text); !drafted) return drafted;
    auto row = settingsRow(amended, text);
    row["reference"] = reference;
    if (auto noted = append(ledger::kAmendment, std::move(row)); !noted) return noted;
    if (auto published = publishStudy(files); !published) return published;
    settings = std::move(amended);
    return {};
}

Result<void> StudyBook::adverseEvent(std::string_view session, const AdverseEvent& event) {
    if (auto may = changeable(); !may) return may;
    if (known.session(session) == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", session);
    if (event.what.empty() || event.severity < 1 || event.severity > 4 || event.relation < 1 || event.relation > 5) {
        return fail(
            ErrorCode::InvalidArgument,
            "an adverse event needs what happened, a severity ({}) and a relation ({}); these are \"{}\", {} and {}",
            scaleText(kEventSeverities), scaleText(kRelations), event.what, event.severity, event.relation);
    }
    if (auto fits = checkForLedger(event); !fits) return fits;
    return append(ledger::kAdverseEvent, {{"session", session}}, &keys->study(), toJson(event));
}

Result<void> StudyBook::nextDay(std::string_view session, const NextDay& said) {
    if (auto may = changeable(); !may) return may;
    const auto* about = known.session(session);
    if (about == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", session);
    if (auto fits = checkNextDay(said); !fits) return fits;
    const Participant participant = *known.participant(about->participant);  // a row replaces what is known
    if (const auto key = keyOf(participant.id); !key) return failure(key);
    const auto begun = localDay(about->parts.back().begun);
    if (!(begun < today())) {
        return fail(kGateRefused,
                    "the session was begun on {}, and today is {}; what is noted of the day after is noted on a later "
                    "day",
                    dateText(begun), dateText(today()));
    }
    if (said.skin() >= kSkinIsAdverse) {
        const auto what = fmt::format(
            "skin on a day after the session scored {} of 4; severity and relation as noted by the program, for the "
            "investigator to judge",
            said.skin());
        // The last entry counts, and is of the same event.
        const auto isNoted = [&](const auto& each) { return each.first == session && each.second.what == what; };
        if (std::ranges::none_of(known.adverseEvents, isNoted)) {
            auto noted = adverseEvent(session, {.what = what, .severity = severityOfSkin(said.skin()), .relation = 5});
            if (!noted) return noted;
        }
    }
    return appendOf(participant, ledger::kNextDay, {{"session", session}}, toJson(said));
}

Result<std::uint64_t> StudyBook::labelSeed() const {
    constexpr std::uint64_t kLabels = 1;  // of the key's subkeys; the ledger is sealed under the key itself
    if (!keys) return fail(ErrorCode::Unsupported, "labels of participants need the study's passphrase");
    const auto key = subkey(keys->study(), kLabels);
    std::uint64_t seed = 0;
    for (const auto byte : key.bytes().first(sizeof seed)) seed = seed << 8 | std::to_integer<std::uint64_t>(byte);
    return seed;
}

std::filesystem::path StudyBook::endFile() const {
    if (settings.kind == StudyKind::Rehearsal) return {};
    return around.keyFolder / (settings.id + ".end");
}

Result<void> StudyBook::recordGate() const {
    if (const auto end = endFile(); !end.empty()) {
        const auto ledgerFile = SessionReader::open(files.ledger());
        if (!ledgerFile) return failure(ledgerFile);
        if (auto whole = reachesEnd(*ledgerFile, end); !whole) return whole;
    }
    const auto strangers = strangersIn(files, known);
    if (!strangers) return fail(kGateRefused, "{}", strangers.error().message);
    if (!strangers->empty()) {
        return fail(kGateRefused,
                    "sessions/{} is not in the ledger: the ledger is an older one, or the file is another study's; put "
                    "the ledger back from your copy, or the file where it belongs",
                    strangers->front());
    }
    for (const auto& [file, head] : known.heads) {
        if (head.empty() || headOf(files.session(file)) == head) continue;
        return fail(kGateRefused,
                    "the record of session {} is not the one that the ledger notes: it is gone or was changed; put "
                    "it back from your copy",
                    file);
    }
    if (auto zone = zoneGate(std::chrono::seconds(localTime(now()).tm_gmtoff)); !zone) return zone;
    return clockGate(known.last, now());
}

Result<void> StudyBook::stillApproved() const {
    if (auto sound = recordGate(); !sound) return sound;
    return approvalGate(settings, today());
}

Result<void> StudyBook::gates(const SessionRequest& request, Participant participant, bool again) const {
    if (auto holds = stillApproved(); !holds) return holds;
    if (auto holds = scriptGate(settings, request.script); !holds) return holds;
    if (auto holds = procedureGate(settings, request.procedure); !holds) return holds;
    if (again) --participant.sessions;
    participant.sessions -= static_cast<int>(std::ranges::count_if(
        known.sessions, [&](const StudySession& each) { return each.participant == participant.id && !each.opened; }));
    if (auto holds = participantGate(settings, participant); !holds) return holds;
    std::optional<std::chrono::sys_seconds> last;
    for (const auto& session : known.sessions) {
        if (again || session.participant != participant.id) continue;
        if (const auto at = stimulatedAt(files, session)) last = at;
    }
    if (auto holds = gapGate(settings, last, now()); !holds) return holds;
    if (auto holds = consentGate(settings, participant, today()); !holds) return holds;
    if (!request.codeConfirmed) {
        return fail(kGateRefused, "the participant has not confirmed that the code {} is theirs", participant.code);
    }
    if (const auto yes = known.excluded.find(participant.id);
        yes != known.excluded.end() && !(localDay(yes->second) < today())) {
        return fail(kGateRefused,
                    "{} answered yes to the exclusion checklist today; a session begins tomorrow at the "
                    "earliest",
                    participant.code);
    }
    if (auto holds = exclusionGate(request.exclusions); !holds) return holds;
    return simulationGate(settings, participant, request.devicesSimulated);
}

Result<std::shared_ptr<const RowSeal>> StudyBook::sealFor(const StudySession& session, std::string_view file) const {
    const auto entry = keyOf(session.participant);
    if (!entry) return failure(entry);
    return std::make_shared<SessionSeal>(settings.id, std::string(file),
                                         subkey((*entry)->key, static_cast<std::uint64_t>(session.number)));
}

Result<BegunSession> StudyBook::begun(std::string_view id) {
    const auto* session = known.session(id);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    const auto file = session->parts.back().file;
    auto seal = sealFor(*session, file);
    if (!seal) return failure(seal);
    return BegunSession{*session, files.session(file), std::move(*seal)};
}

Result<void> StudyBook::finishWithdrawals() {
    for (const auto& one : known.participants) {
        if (one.state != ParticipantState::Withdrawn) continue;
        if (auto destroyed = keys->destroy(one.id); !destroyed) return destroyed;
    }
    return {};
}

}  // namespace tacto
