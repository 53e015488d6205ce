#include "core/study/Study.h"

#include <algorithm>
#include <iterator>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/ProgramStart.h"
#include "core/seal/SealedText.h"
#include "core/session/Digest.h"
#include "core/session/SessionReader.h"
#include "core/study/StudyBook.h"
#include "core/study/StudyFiles.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kIdDigits = 16;

int answersIn(const fs::path& file) {
    const auto reader = SessionReader::open(file);
    if (!reader) return 0;
    const auto events = reader->events();
    if (!events) return 0;
    return static_cast<int>(std::ranges::count(*events, std::string("answer"), &SessionRow::name));
}

std::string lettersAndDigits(std::string code) {
    std::erase(code, '-');
    return code;
}

fs::path withoutEnd(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();  // "study/" means "study"
}

}  // namespace

struct Study::State : StudyBook {
    explicit State(StudyBook book) : StudyBook(std::move(book)) {}
};

fs::path Study::defaultKeyFolder() { return dataFolder() / "keys"; }

bool Study::isThere(const fs::path& folder) {
    std::error_code error;
    const StudyFiles files{folder};
    return fs::exists(files.settings(), error) || fs::exists(files.ledger(), error);
}

Study::Study(std::unique_ptr<State> state) : state_(std::move(state)) {}
Study::Study(Study&&) noexcept = default;
Study& Study::operator=(Study&&) noexcept = default;
Study::~Study() = default;

Result<Study> Study::create(const fs::path& folder, StudySettings settings, const Passphrase& passphrase) {
    return create(folder, std::move(settings), passphrase, Surroundings());
}
Result<Study> Study::createRehearsal(const fs::path& folder, StudySettings settings) {
    return createRehearsal(folder, std::move(settings), Surroundings());
}
Result<Study> Study::open(const fs::path& folder, const Passphrase* passphrase, Access access) {
    return open(folder, passphrase, access, Surroundings());
}

Result<Study> Study::create(const fs::path& folder, StudySettings settings, const Passphrase& passphrase,
                            const Surroundings& around) {
    const StudyFiles files{withoutEnd(folder)};
    settings.id = randomHex(kIdDigits);
    settings.kind = StudyKind::Study;
    settings.approval.protocolSha256 = protocolHash(settings);
    if (auto sound = studyFields().check(settings, RecordPlace{}); !sound) return failure(sound);
    if (settings.approval.reference.empty()) return invalid("a study needs the reference of its approval");
    if (auto strong = passphrase.checkStrength(settings.title); !strong) return failure(strong);
    if (auto outside = keysLieOutside(files, around); !outside) return failure(outside);
    if (auto made = makeStudy(files, settings, &passphrase, around); !made) return failure(made);
    return open(files.folder, &passphrase, Access::Change, around);
}

Result<Study> Study::createRehearsal(const fs::path& folder, StudySettings settings, const Surroundings& around) {
    const StudyFiles files{withoutEnd(folder)};
    settings = asRehearsal(std::move(settings), utcDay(around.time->wall()));
    settings.id = randomHex(kIdDigits);
    settings.approval.protocolSha256 = protocolHash(settings);
    if (auto sound = studyFields().check(settings, RecordPlace{}); !sound) return failure(sound);
    if (auto made = makeStudy(files, settings, nullptr, around); !made) return failure(made);
    return open(files.folder, nullptr, Access::Change, around);
}

Result<Study> Study::open(const fs::path& folder, const Passphrase* passphrase, Access access,
                          const Surroundings& around) {
    auto book = StudyBook::open(withoutEnd(folder), passphrase, access, around);
    if (!book) return failure(book);
    return Study(std::make_unique<State>(std::move(*book)));
}

const fs::path& Study::folder() const noexcept { return state_->files.folder; }
const StudySettings& Study::settings() const noexcept { return state_->settings; }
bool Study::isRehearsal() const noexcept { return state_->settings.kind == StudyKind::Rehearsal; }
bool Study::hasKey() const noexcept { return state_->keys.has_value(); }
fs::path Study::keyFile() const { return keyFileOf(state_->files, state_->settings, state_->around); }
std::string Study::ledgerHead() const { return state_->known.head; }
CalibrationDate Study::today() const { return state_->today(); }
Result<void> Study::stillApproved() const { return StudyGates(*state_).stillApproved(); }
std::vector<Participant> Study::participants() const { return state_->known.participants; }
Result<Participant> Study::find(std::string_view code) const { return state_->find(code); }
fs::path Study::pathOf(std::string_view file) const { return state_->files.session(file); }

std::vector<StudySession> Study::sessions() const {
    auto all = state_->known.sessions;
    for (auto& session : all) {
        for (const auto& part : session.parts) session.answered += answersIn(pathOf(part.file));
    }
    return all;
}

Result<StudySession> Study::session(std::string_view id) const {
    const auto* found = state_->known.session(id);
    if (found == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    auto session = *found;
    for (const auto& part : session.parts) session.answered += answersIn(pathOf(part.file));
    return session;
}

std::optional<StudySession> Study::unfinished(std::string_view participantId) const {
    for (const auto& session : state_->known.sessions) {
        if (session.participant == participantId && session.state == StudySessionState::Unfinished) return session;
    }
    return std::nullopt;
}

Result<Participant> Study::enrol(Participant participant) {
    if (auto may = state_->changeable(); !may) return failure(may);
    const auto& settings = state_->settings;
    if (static_cast<int>(state_->known.participants.size()) >= settings.participantsMax) {
        return fail(kGateRefused, "{} participants are enrolled, as many as approval {} allows",
                    state_->known.participants.size(), settings.approval.reference);
    }
    if (participant.virtualSeed && state_->find(virtualName(*participant.virtualSeed))) {
        return fail(ErrorCode::Unsupported, "{} is enrolled already; another seed is expected",
                    virtualName(*participant.virtualSeed));
    }
    const auto taken = [&](const std::string& code) {  // codes are compared with and without their hyphens
        return std::ranges::any_of(state_->known.participants, [&](const Participant& each) {
            return lettersAndDigits(each.code) == lettersAndDigits(code);
        });
    };
    if (participant.code.empty()) {
        do participant.code = newCode();
        while (taken(participant.code));
    } else {
        const auto stored = checkedCode(participant.code);
        if (!stored) return failure(stored);
        if (taken(*stored))
            return fail(ErrorCode::Unsupported, "{} is enrolled already; another code is expected", *stored);
        participant.code = *stored;
    }
    if (auto sound = checkAbout(participant); !sound) return failure(sound);
    if (auto fits = checkForLedger(participant); !fits) return failure(fits);
    if (auto old = ageGate(settings, participant); !old) return failure(old);
    if (auto may = state_->mayWrite(); !may) return failure(may);
    participant.id = randomHex(kIdDigits);
    // The key is saved first: without its key a row could never be opened.
    if (auto added = state_->keys->add(participant.id, participant.code); !added) return failure(added);
    const auto number = static_cast<int>(state_->known.participants.size()) + 1;
    auto noted = state_->appendOf(participant, ledger::kEnrolled, {{"number", number}}, toJson(participant));
    if (!noted) {
        static_cast<void>(state_->keys->destroy(participant.id));
        return failure(noted);
    }
    return state_->known.participants.back();
}

Result<void> Study::changePassphrase(const Passphrase& next) {
    if (auto may = state_->changeable(); !may) return may;
    if (auto strong = next.checkStrength(settings().title); !strong) return strong;
    return state_->keys->sealUnder(next, state_->around.cost);
}

Result<void> Study::consent(std::string_view code, const Consent& consent) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    if (consent.version.empty() || consent.by.empty())
        return invalid("a consent needs the version of the form and the initials of who took it");
    if (const auto& inForce = settings().consentVersion; consent.version != inForce) {
        return invalid("the consent is to version {} of the form; version {}, which is in force, is expected",
                       consent.version, inForce);
    }
    if (!consent.date.ok() || !(consent.date <= today())) {
        return invalid("the consent is dated {}; a day no later than today, {}, is expected", dateText(consent.date),
                       dateText(today()));
    }
    if (const auto since = state_->formSince(consent.version); !(since <= consent.date)) {
        return invalid(
            "the consent is dated {}, and version {} of the form is approved from {}; that day or a later one is "
            "expected",
            dateText(consent.date), consent.version, dateText(since));
    }
    if (auto fits = checkForLedger(consent); !fits) return fits;
    if (participant->state != ParticipantState::Active)
        return fail(kGateRefused, "{} has left the study; only an active participant consents", participant->code);
    return state_->appendOf(*participant, ledger::kConsent, nlohmann::json::object(), toJson(consent));
}

Result<void> Study::leave(std::string_view code, std::string_view reason) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    if (participant->state == ParticipantState::Left)
        return fail(kGateRefused, "{} has left the study already", participant->code);
    constexpr std::size_t kMaxBytes = 2000;
    if (reason.size() > kMaxBytes)
        return invalid("the reason has {} bytes; up to {} are accepted", reason.size(), kMaxBytes);
    return state_->appendOf(*participant, ledger::kLeft, {{"sessions", participant->sessions}}, {{"reason", reason}});
}

Result<void> Study::withdraw(std::string_view code) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    // The form to which they consented applies, whatever was amended since.
    const auto promised = state_->known.promised.find(participant->id);
    const bool mayDestroy =
        promised != state_->known.promised.end() && promised->second == nameOf(DataOnRequest::Destroy);
    if (state_->settings.dataOnRequest == DataOnRequest::Keep && !mayDestroy) {
        return fail(
            kGateRefused,
            "the study keeps what was collected (data_on_request keep), as its consent says; \"leave\" ends {}'s "
            "part",
            participant->code);
    }
    // The row comes first: a missing key without a row would look like damage. After a crash, open() does the rest.
    auto noted = state_->append(
        ledger::kWithdrawn,
        {{"participant", participant->id}, {"sessions", participant->sessions}, {"virtual", participant->isVirtual()}});
    if (!noted) return noted;
    if (auto destroyed = state_->keys->destroy(participant->id); !destroyed) return destroyed;
    return state_->read();
}

Result<void> Study::would(const std::function<Result<void>(Study&)>& change) {
    state_->tried = false;
    const auto done = change(*this);
    return std::exchange(state_->tried, std::nullopt).value_or(false) ? Result<void>() : done;
}

Result<void> Study::amend(StudySettings settings, std::string_view reference) {
    return state_->amend(std::move(settings), reference);
}

const std::vector<StudyAmendment>& Study::amendments() const noexcept { return state_->known.amendments; }
Result<void> Study::consented(const Participant& participant) const { return state_->consented(participant); }
Result<LedgerLoss> Study::lossOfGoingBack() const { return state_->lossOfGoingBack(); }
Result<void> Study::goBack(std::string_view word) { return state_->goBack(word); }
const std::vector<StudyGoingBack>& Study::goingsBack() const noexcept { return state_->known.wentBack; }

Result<void> Study::noteExclusions(const SessionRequest& request) {
    auto items = nlohmann::json::array();
    for (const auto& answer : request.exclusions)
        if (answer.yes) items.push_back(answer.key);
    if (items.empty()) return {};
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(request.code);
    if (!participant) return failure(participant);
    if (participant->virtualSeed) return {};
    return state_->appendOf(*participant, ledger::kExcluded, nlohmann::json::object(), {{"items", std::move(items)}});
}

SessionBasis Study::basisOf(const SessionRequest& request, const Participant& who) noexcept {
    if (who.isVirtual() && !request.personAnswers) return SessionBasis::Virtual;
    return request.devicesSimulated ? SessionBasis::PersonSimulated : SessionBasis::Person;
}

SessionBasis Study::basisOf(const Participant& who) const {
    for (const auto& session : state_->known.sessions) {
        if (session.participant == who.id && session.opened) return session.basis;
    }
    const bool simulated = isRehearsal() && settings().modality == Modality::Electrodes;
    return basisOf({.code = {}, .script = {}, .encoding = {}, .devicesSimulated = simulated, .exclusions = {}}, who);
}

Result<void> Study::mayTakePart(const Participant& participant, bool again) const {
    if (auto may = state_->changeable(); !may) return may;
    return StudyGates(*state_).beforehand(participant, again);
}

Result<void> Study::mayBegin(const SessionRequest& request) const {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(request.code);
    return participant ? StudyGates(*state_).session(request, *participant, false) : failure(participant);
}

Result<BegunSession> Study::beginSession(const SessionRequest& request) {
    if (auto may = state_->changeable(); !may) return failure(may);
    const auto participant = state_->find(request.code);
    if (!participant) return failure(participant);
    if (const auto open = unfinished(participant->id)) {
        return fail(ErrorCode::Unsupported, "session {} of {} is unfinished; resume it or end it first", open->number,
                    participant->code);
    }
    if (auto holds = StudyGates(*state_).session(request, *participant, false); !holds) return failure(holds);
    const auto id = randomHex(kIdDigits);
    auto noted = state_->appendOf(*participant, ledger::kSessionBegun,
                                  {{"session", id},
                                   {"file", id},
                                   {"number", participant->sessions + 1},
                                   {"protocol", request.script.name},
                                   {"basis", nameOf(basisOf(request, *participant))},
                                   {"script_sha256", request.script.sha256}},
                                  {{"encoding", request.encoding}});
    if (!noted) return failure(noted);
    return state_->begun(id);
}

Result<BegunSession> Study::continueSession(std::string_view id, const SessionRequest& request) {
    if (auto may = state_->changeable(); !may) return failure(may);
    const auto participant = state_->find(request.code);
    if (!participant) return failure(participant);
    const auto before = session(id);
    if (!before) return failure(before);
    if (before->participant != participant->id)
        return fail(ErrorCode::NotFound, "{} has no session {}", participant->code, id);
    if (before->state != StudySessionState::Unfinished) {
        return fail(kGateRefused, "session {} of {} is {}; only an unfinished one goes on", before->number,
                    participant->code, nameOf(before->state));
    }
    if (auto holds = StudyGates(*state_).session(request, *participant, true); !holds) return failure(holds);
    for (const auto& each : before->parts) {
        if (auto whole = part(each.file); !whole) return failure(whole);
    }
    const auto& last = before->parts.back().file;
    auto noted = state_->append(ledger::kSessionPart, {{"session", before->id},
                                                       {"file", randomHex(kIdDigits)},
                                                       {"participant", participant->id},
                                                       {"after", last},
                                                       {"head", headOf(pathOf(last))}});
    if (!noted) return failure(noted);
    return state_->begun(id);
}

namespace {

nlohmann::json endedBody(const StudySession& session, StudySessionState ended, const std::string& head) {
    return {{"session", session.id},
            {"participant", session.participant},
            {"state", nameOf(ended)},
            {"file", session.parts.back().file},
            {"head", head}};
}

}  // namespace

Result<void> Study::cancelSession(std::string_view id) {
    if (auto may = state_->changeable(); !may) return may;
    const auto* session = state_->known.session(id);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    if (session->state != StudySessionState::Unfinished || session->parts.size() != 1)
        return invalid("session {} was opened and cannot be cancelled", id);
    auto body = endedBody(*session, StudySessionState::Stopped, headOf(pathOf(session->parts.back().file)));
    body["opened"] = false;
    return state_->append(ledger::kSessionEnded, std::move(body));
}

Result<void> Study::endSession(std::string_view id, StudySessionState ended, std::string_view chainHead) {
    if (auto may = state_->changeable(); !may) return may;
    const auto* session = state_->known.session(id);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    if (ended == StudySessionState::Unfinished || session->state != StudySessionState::Unfinished) {
        return invalid("session {} is {} and cannot become {}", id, nameOf(session->state), nameOf(ended));
    }
    const auto head = chainHead.empty() ? headOf(pathOf(session->parts.back().file)) : std::string(chainHead);
    return state_->append(ledger::kSessionEnded, endedBody(*session, ended, head));
}

Result<std::shared_ptr<const RowSeal>> Study::sealOf(std::string_view file) const { return state_->sealOf(file); }
Result<std::optional<SessionReader>> Study::part(std::string_view file) const { return state_->part(file); }

Result<std::vector<SessionRow>> Study::events(const StudySession& session) const {
    std::vector<SessionRow> all;
    for (const auto& each : session.parts) {
        const auto reader = part(each.file);
        if (!reader) return failure(reader);
        if (!*reader) continue;
        auto rows = (*reader)->events();
        if (!rows) return failure(rows);
        std::ranges::move(*rows, std::back_inserter(all));
    }
    return all;
}

Result<void> Study::adverseEvent(std::string_view session, const AdverseEvent& event) {
    return state_->adverseEvent(session, event);
}

Result<void> Study::release(std::size_t event, std::string_view by, std::string_view reason) {
    if (auto may = state_->changeable(); !may) return may;
    const auto& events = state_->known.adverseEvents;
    if (event < 1 || event > events.size())
        return fail(ErrorCode::NotFound, "the study has no adverse event {}; it has {}", event, events.size());
    if (!holdsStudy(events[event - 1].second))
        return fail(kGateRefused, "adverse event {} holds nothing; only a serious one that was not released does",
                    event);
    constexpr std::size_t kMaxBytes = 2000;
    if (trimmed(by).empty() || by.size() + reason.size() > kMaxBytes)
        return invalid("a release needs the name of who decides, and up to {} bytes in all", kMaxBytes);
    return state_->append(ledger::kReleased, {{"event", event}}, &state_->keys->study(),
                          {{"by", by}, {"reason", reason}});
}

Result<void> Study::note(const StudyNote& note) {
    if (auto may = state_->changeable(); !may) return may;
    if (auto sound = checkNote(note); !sound) return sound;
    for (const auto& field : (*studyLogKind(note.kind))->fields) {
        if (field.is != StudyLogField::Is::Date) continue;
        if (auto past = state_->notInTheFuture(field.key, note.text(field.key)); !past) return past;
    }
    return state_->append(ledger::kNote, {{"kind", note.kind}}, &state_->keys->study(), toJson(note));
}

const std::vector<StudyNote>& Study::notes() const noexcept { return state_->known.notes; }

std::size_t Study::adverseEventCount() const noexcept { return state_->known.adverseEventRows; }

Result<std::vector<std::pair<std::string, AdverseEvent>>> Study::adverseEvents() const {
    if (!state_->keys) return fail(ErrorCode::Unsupported, "adverse events are read with the study's passphrase");
    return state_->known.adverseEvents;
}

Result<void> Study::nextDay(std::string_view session, const NextDay& said) { return state_->nextDay(session, said); }

std::optional<NextDay> Study::nextDay(std::string_view session) const {
    const auto found = state_->known.nextDays.find(std::string(session));
    if (found == state_->known.nextDays.end()) return std::nullopt;
    return found->second;
}

Result<std::uint64_t> Study::labelSeed() const { return state_->labelSeed(); }
int Study::firstPlaces() const noexcept { return state_->known.firstPlaces; }

Result<void> Study::exported(const fs::path& place, std::string_view what) {
    if (auto may = state_->changeable(); !may) return may;
    if (liesInside(place, folder())) {
        return invalid("{} lies inside the study folder; an export there would stand unsealed beside what is sealed",
                       place.string());
    }
    return state_->append(ledger::kExported, {{"what", what}}, &state_->keys->study(), {{"place", place.string()}});
}

std::vector<StudyExport> Study::exports() const { return state_->known.exports; }

}  // namespace tacto
