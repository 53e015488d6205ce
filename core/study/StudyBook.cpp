#include "core/study/StudyBook.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/seal/SealedText.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/study/Gates.h"
#include "core/study/LedgerEnd.h"
#include "core/study/StudyFiles.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace {

constexpr const char* kWayBack =
    "nothing is written to it. Put the newest back from your copy; where it is lost for good, tactoscope-cli study "
    "go-back says what that gives up";

/// The newest known end of the ledger, and what is wrong with a ledger that is not the newest.
struct Newest {
    LedgerEnd end;
    std::string missing;                ///< one sentence; empty if nothing is wrong
    std::vector<std::string> unsealed;  ///< names of the last rows, if the key did not write them
};

/// Finds the rows after the last row that the study's key vouches for, in the ledger or in the key file. If neither
/// vouches for any row, all rows are older than vouching.
void weighOwn(Newest& newest, const StudyBook& book, const SessionReader& ledger) {
    if (!book.keys) return;
    const auto& noted = book.keys->ledgerEnd();
    const auto vouched = std::max(book.known.vouched, reaches(ledger, noted) ? noted.row : 0);
    const auto& rows = book.known.rows;
    if (vouched < 1 || vouched > std::ssize(rows)) return;  // row 2 is the first in `rows`
    newest.unsealed.assign(rows.begin() + vouched - 1, rows.end());
    newest.missing = fmt::format("row {} ({}) of the study's ledger was not written with the study's key", vouched + 1,
                                 newest.unsealed.front());
}

void weigh(Newest& newest, const SessionReader& ledger, const LedgerEnd& end, std::string_view source) {
    if (end.row > newest.end.row) {
        auto rows = end.rows.empty() ? std::move(newest.end.rows) : end.rows;
        newest.end = end;
        newest.end.rows = std::move(rows);
    }
    if (reaches(ledger, end) || !newest.missing.empty()) return;
    newest.missing = fmt::format(
        "row {} of the study's ledger is not the one that {}: the ledger was cut short or recomputed, or is an older "
        "copy",
        end.row, source);
}

Result<Newest> newestKnown(const StudyBook& book) {
    Newest newest;
    if (book.settings.kind == StudyKind::Rehearsal) return newest;  // a rehearsal's keys are as old as its ledger
    const auto ledger = SessionReader::open(book.files.ledger());
    if (!ledger) return failure(ledger);
    weighOwn(newest, book, *ledger);
    const auto noted = notedLedgerEnd(book.endFile());
    if (!noted && newest.missing.empty()) newest.missing = noted.error().message;
    if (noted && *noted) weigh(newest, *ledger, **noted, "was written on this computer");
    if (book.keys && book.keys->ledgerEnd().row > 0)
        weigh(newest, *ledger, book.keys->ledgerEnd(), "the key file notes");
    for (const auto& session : book.known.sessions) {
        for (const auto& part : session.parts) {
            if (const auto end = ledgerEndOf(book.files.session(part.file)))
                weigh(newest, *ledger, *end, fmt::format("session {} was begun with", part.file));
        }
    }
    return newest;
}

}  // namespace

bool holdsStudy(const AdverseEvent& event) noexcept { return event.serious && event.releasedBy.empty(); }

CalibrationDate utcDay(std::chrono::sys_seconds at) { return std::chrono::floor<std::chrono::days>(at); }

std::string headOf(const std::filesystem::path& file) {
    const auto reader = SessionReader::open(file);
    return reader && reader->checkChain() ? reader->chainHead() : std::string();
}

Result<StudyBook> StudyBook::open(const std::filesystem::path& folder, const Passphrase* passphrase,
                                  Study::Access access, const Study::Surroundings& around) {
    StudyBook book;
    book.files.folder = folder;
    book.around = around;
    const auto& files = book.files;
    if (!Study::isThere(folder)) return fail(ErrorCode::NotFound, "there is no study in {}", folder.string());
    const auto text = readTextFile(files.settings());
    if (!text) return failure(text);
    // The version is read first: a study of a newer program is not checked any further.
    const auto first = parseStudy(*text, files.settings().string());
    if (!first) return failure(first);
    book.settings = *first;
    if (access == Study::Access::Change) {
        auto taken = StudyLock::take(files, book.keysLock());
        if (!taken) return failure(taken);
        book.lock.emplace(std::move(*taken));
    }
    const auto verified = verifySession(files.ledger());
    if (!verified) return failure(verified);
    if (verified->status != SessionStatus::Intact) {
        return fail(ErrorCode::ParseError, "the ledger of the study in {} is damaged: {}", folder.string(),
                    verified->problems.empty() ? "it is not a ledger" : verified->problems.front());
    }
    if (auto unlocked = book.unlock(passphrase); !unlocked) return failure(unlocked);
    if (auto replayed = book.read(); !replayed) return failure(replayed);
    const auto current = readStudy(files, book.known.settingsSha256);
    if (!current) return failure(current);
    auto inForce = parseStudy(*current, files.settings().string());
    if (!inForce) return failure(inForce);
    book.settings = std::move(*inForce);
    if (access == Study::Access::Read) return book;
    auto opened = Ledger::open(files.ledger());
    if (!opened) return failure(opened);
    book.ledger.emplace(std::move(*opened));
    if (!book.isNewest()) return book;  // any change will be refused, with the reason
    if (*current != *text) {
        if (auto published = publishStudy(files); !published) return failure(published);
    }
    if (book.keys) {
        if (auto finished = book.finishWithdrawals(); !finished) return failure(finished);
        book.noteEnd();
    }
    return book;
}

Result<void> StudyBook::unlock(const Passphrase* passphrase) {
    const bool rehearsal = settings.kind == StudyKind::Rehearsal;
    if (!rehearsal && passphrase == nullptr) return {};
    if (!rehearsal) {
        if (auto outside = keysLieOutside(files, around); !outside) return outside;
    }
    auto opened =
        StudyKeys::open(keyFileOf(files, settings, around), settings.id, rehearsal ? nullptr : passphrase, around.cost);
    if (!opened) return failure(opened);
    keys.emplace(std::move(*opened));
    return {};
}

CalibrationDate StudyBook::today() const { return utcDay(std::max(now(), known.last)); }

Result<void> StudyBook::notInTheFuture(std::string_view what, std::string_view day) const {
    const auto date = parseDate(day);
    if (!date || *date <= today()) return {};
    return invalid("{} is {}; a day no later than today, {}, is expected", what, day, dateText(today()));
}

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
    return tried ? Result<void>() : isNewest();  // a change that is tried at each key reads no files
}

Result<void> StudyBook::mayWrite() {
    if (!tried) return {};
    tried = true;
    return fail(ErrorCode::Stopped, "the change was only tried; nothing was written");
}

Result<void> StudyBook::isNewest() const {
    const auto newest = newestKnown(*this);
    if (!newest) return failure(newest);
    if (!newest->missing.empty()) return fail(kGateRefused, "{}; {}", newest->missing, kWayBack);
    const auto strangers = strangersIn(files, known);
    if (!strangers) return fail(kGateRefused, "{}", strangers.error().message);
    if (strangers->empty()) return {};
    return fail(kGateRefused,
                "sessions/{} is not in the ledger: the ledger is an older one, or the file is another study's and "
                "belongs elsewhere; {}",
                strangers->front(), kWayBack);
}

Result<LedgerLoss> StudyBook::lossOfGoingBack() const {
    if (!ledger || !keys) return failure(changeable());
    if (isNewest()) {
        return fail(kGateRefused,
                    "the ledger of the study in {} is the newest that this computer knows; there is nothing to go back "
                    "from",
                    files.folder.string());
    }
    const auto newest = newestKnown(*this);
    const auto strangers = strangersIn(files, known);
    if (!newest || !strangers) return newest ? failure(strangers) : failure(newest);
    LedgerLoss loss;
    loss.ends = known.last;
    loss.row = ledger->next() - 1;
    loss.newest = newest->end.row;
    loss.newestHead = newest->end.head;
    loss.newestAt = newest->end.at;
    // The rows are the same up to a point; the newer ledger's rows after that point are lost.
    const auto [ours, theirs] = std::ranges::mismatch(known.rows, newest->end.rows);
    loss.rows.assign(theirs, newest->end.rows.end());
    loss.files = *strangers;
    loss.unsealed = newest->unsealed;
    loss.withdrawn = static_cast<int>(std::ranges::count_if(known.participants, [this](const Participant& each) {
        return each.state == ParticipantState::Withdrawn && keys->byId(each.id) != nullptr;
    }));
    for (const auto& entry : keys->entries())
        if (std::ranges::find(known.participants, entry.id, &Participant::id) == known.participants.end())
            loss.enrolled.push_back(entry.code);
    loss.keysGone = static_cast<int>(std::ranges::count_if(known.participants, [](const Participant& each) {
        return each.state != ParticipantState::Withdrawn && !each.readable;
    }));
    return loss;
}

Result<void> StudyBook::goBack(std::string_view word) {
    const auto loss = lossOfGoingBack();
    if (!loss) return failure(loss);
    if (word != loss->word()) {
        return invalid("\"{}\" confirms nothing; {} is expected: {}", word, loss->word(), loss->sentence());
    }
    if (auto done = write(ledger::kWentBack, {{"row", loss->newest},
                                              {"head", loss->newestHead},
                                              {"at", loss->newestAt.time_since_epoch().count()},
                                              {"lost", loss->lost()},
                                              {"rows", loss->rows},
                                              {"files", loss->files},
                                              {"unsealed", loss->unsealed}});
        !done)
        return done;
    return finishWithdrawals();
}

Result<void> StudyBook::append(const char* name, nlohmann::json body, const Secret* key,
                               const nlohmann::json& content) {
    if (auto may = changeable(); !may) return may;
    return write(name, std::move(body), key, content);
}

Result<void> StudyBook::write(const char* name, nlohmann::json body, const Secret* key, const nlohmann::json& content) {
    if (auto may = mayWrite(); !may) return may;
    if (key != nullptr) body["sealed"] = sealedInLedger(settings.id, *key, ledger->next(), name, content);
    const auto at = now();
    body["mac"] = macInLedger(settings.id, keys->study(), ledger->next(), at, name, body, ledger->head());
    auto row = ledger->append(at, name, body);
    if (!row) return failure(row);
    if (auto replayed = read(); !replayed) return replayed;
    noteEnd();
    return {};
}

LedgerEnd StudyBook::end() const { return {ledger->next() - 1, ledger->head(), known.last, known.rows}; }

/// If one of the two notes cannot be written, the other still holds the end; if neither can, the old notes stay.
void StudyBook::noteEnd() {
    if (settings.kind == StudyKind::Rehearsal) return;
    const auto now = end();
    if (keys && keys->ledgerEnd().head != now.head) static_cast<void>(keys->noteEnd(now));
    const auto noted = notedLedgerEnd(endFile());
    if (!noted || !*noted || (*noted)->head != now.head || (*noted)->rows != now.rows) noteLedgerEnd(endFile(), now);
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
            if (usable(one) && one.virtualSeed && virtualName(*one.virtualSeed) == code) return one;
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
        return invalid("an amendment needs a reference of its own, not \"{}\"", reference);
    }
    if (amended.participantsMax < static_cast<int>(known.participants.size())) {
        return invalid("participants_max is {}, and {} are enrolled; that or more is expected", amended.participantsMax,
                       known.participants.size());
    }
    amended.id = settings.id;
    amended.kind = settings.kind;
    amended.approval.reference = reference;
    amended.approval.protocolSha256 = protocolHash(amended);
    if (auto sound = studyFields().check(amended, RecordPlace{}); !sound) return sound;
    if (auto may = mayWrite(); !may) return may;
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
    if (!session.empty() && known.session(session) == nullptr)
        return fail(ErrorCode::NotFound, "the study has no session {}", session);
    if (event.what.empty() || event.severity < 1 || event.severity > 4 || event.relation < 1 || event.relation > 5) {
        return invalid(
            "an adverse event needs what happened, a severity ({}) and a relation ({}); these are \"{}\", {} and {}",
            scaleText(kEventSeverities), scaleText(kRelations), event.what, event.severity, event.relation);
    }
    if (auto fits = checkForLedger(event); !fits) return fits;
    if (auto past = notInTheFuture("onset", event.onset); !past) return past;
    if (auto past = notInTheFuture("ended", event.ended); !past) return past;
    return append(ledger::kAdverseEvent, {{"session", session}}, &keys->study(), toJson(event));
}

Result<void> StudyBook::nextDay(std::string_view session, const NextDay& said) {
    if (auto may = changeable(); !may) return may;
    const auto* about = known.session(session);
    if (about == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", session);
    if (auto fits = checkNextDay(said); !fits) return fits;
    const Participant participant = *known.participant(about->participant);  // a copy, since a row replaces the state
    if (const auto key = keyOf(participant.id); !key) return failure(key);
    const auto begun = utcDay(about->parts.back().begun);
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
        // The last record counts, and belongs to the same adverse event.
        const auto isNoted = [&](const auto& each) { return each.first == session && each.second.what == what; };
        if (std::ranges::none_of(known.adverseEvents, isNoted)) {
            auto noted = adverseEvent(session, {.what = what, .severity = severityOfSkin(said.skin()), .relation = 5});
            if (!noted) return noted;
        }
    }
    return appendOf(participant, ledger::kNextDay, {{"session", session}}, toJson(said));
}

Result<std::uint64_t> StudyBook::labelSeed() const {
    constexpr std::uint64_t kLabels = 1;  // number of the subkey; the ledger is sealed under the key itself
    if (!keys) return fail(ErrorCode::Unsupported, "labels of participants need the study's passphrase");
    const auto key = subkey(keys->study(), kLabels);
    std::uint64_t seed = 0;
    for (const auto byte : key.bytes().first(sizeof seed)) seed = seed << 8 | std::to_integer<std::uint64_t>(byte);
    return seed;
}

CalibrationDate StudyBook::formSince(std::string_view version) const {
    const auto found = known.formSince.find(std::string(version));
    if (found != known.formSince.end()) return found->second;
    auto first = settings.approval.from;
    for (const auto& [form, since] : known.formSince) first = std::min(first, since);
    return first;
}

Result<void> StudyBook::consented(const Participant& participant) const {
    return consentGate(settings, participant, formSince(settings.consentVersion), today());
}

std::filesystem::path StudyBook::endFile() const {
    if (settings.kind == StudyKind::Rehearsal) return {};
    return around.keyFolder / (settings.id + ".end");
}

std::filesystem::path StudyBook::keysLock() const {
    if (settings.kind == StudyKind::Rehearsal) return {};
    return around.keyFolder / (settings.id + ".lock");
}

Result<std::shared_ptr<const RowSeal>> StudyBook::sealFor(const StudySession& session, std::string_view file) const {
    const auto entry = keyOf(session.participant);
    if (!entry) return failure(entry);
    return std::make_shared<SessionSeal>(settings.id, std::string(file),
                                         subkey((*entry)->key, static_cast<std::uint64_t>(session.number)));
}

Result<std::shared_ptr<const RowSeal>> StudyBook::sealOf(std::string_view file) const {
    const auto* session = known.sessionOfFile(file);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session file {}", file);
    return sealFor(*session, file);
}

Result<std::optional<SessionReader>> StudyBook::part(std::string_view file) const {
    auto seal = sealOf(file);
    if (!seal) return failure(seal);
    const auto noted = known.heads.find(std::string(file));
    const auto head = noted != known.heads.end() ? noted->second : std::string();
    auto reader = SessionReader::open(files.session(file), std::move(*seal));
    if (!reader && reader.error().code == ErrorCode::NotFound && head.empty()) return std::nullopt;
    if (!reader) return failure(reader);
    if (auto whole = reader->checkChain(); !whole) return failure(whole);
    if (!reader->sealed()) {
        return fail(ErrorCode::ParseError, "the record {} is not sealed, and those of a study are: it is another file",
                    files.session(file).filename().string());
    }
    if (!head.empty() && reader->chainHead() != head) {
        return fail(ErrorCode::ParseError,
                    "the record {} is not the one that the ledger notes; put it back from your copy",
                    files.session(file).filename().string());
    }
    return std::optional(std::move(*reader));
}

Result<BegunSession> StudyBook::begun(std::string_view id) {
    const auto* session = known.session(id);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    const auto file = session->parts.back().file;
    auto seal = sealFor(*session, file);
    if (!seal) return failure(seal);
    auto reached = end();
    return BegunSession{*session, files.session(file), std::move(*seal), reached.row, std::move(reached.head)};
}

Result<void> StudyBook::finishWithdrawals() {
    for (const auto& one : known.participants) {
        if (one.state != ParticipantState::Withdrawn) continue;
        if (auto destroyed = keys->destroy(one.id); !destroyed) return destroyed;
    }
    return {};
}

namespace {

/// Returns the time of the first trial in the last part that had trials; nothing if no part had any. For a part that
/// cannot be read, returns the time of its beginning.
std::optional<std::chrono::sys_seconds> stimulatedAt(const StudyFiles& files, const StudySession& session) {
    constexpr std::string_view kTrialBegin = "trial-begin";
    if (!session.opened) return {};
    std::optional<std::chrono::sys_seconds> last;
    for (const auto& part : session.parts) {
        const auto reader = SessionReader::open(files.session(part.file));
        const auto events = reader ? reader->events() : Result<std::vector<SessionRow>>(failure(reader));
        if (!events || !reader->checkChain()) {  // a missing or changed file may contain trials
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
    if (auto holds = eventGate(); !holds) return holds;
    return approvalGate(book_.settings, book_.today());
}

Result<void> StudyGates::eventGate() const {
    if (book_.settings.kind == StudyKind::Rehearsal) return {};
    for (std::size_t i = 0; i < book_.known.adverseEvents.size(); ++i) {
        if (!holdsStudy(book_.known.adverseEvents[i].second)) continue;
        return fail(kGateRefused,
                    "adverse event {} was serious and holds the study; who is responsible releases it by name", i + 1);
    }
    return {};
}

Result<void> StudyGates::untilWhen(Result<void> holds, const Participant& participant,
                                   std::optional<std::chrono::sys_seconds> last) const {
    if (holds) return holds;
    auto next = std::chrono::sys_seconds(std::chrono::sys_days(book_.settings.approval.from));
    if (last) next = std::max(next, gapEnd(book_.settings, *last));
    const auto& backs = book_.known.wentBack;
    if (!backs.empty()) next = std::max(next, wentBackEnd(book_.settings, backs.back(), book_.now()));
    if (const auto yes = book_.known.excluded.find(participant.id); yes != book_.known.excluded.end()) {
        const auto day = std::chrono::sys_days(utcDay(yes->second)) + std::chrono::days(1);
        next = std::max(next, std::chrono::sys_seconds(day));
    }
    const auto& approval = book_.settings.approval;
    const bool expires = utcDay(next) > approval.expires;
    return fail(kGateRefused, "{}; the next session is possible from {}{}", holds.error().message, nextText(next),
                expires ? fmt::format(" on, and approval {} expires on {}: an amendment is needed", approval.reference,
                                      dateText(approval.expires))
                        : " on");
}

/// One participant must not have both a person's answers and a virtual participant's.
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

Result<void> StudyGates::beforehand(Participant participant, bool again) const {
    if (auto holds = stillApproved(); !holds) return holds;
    if (again) --participant.sessions;
    participant.sessions -= static_cast<int>(std::ranges::count_if(book_.known.sessions, [&](const StudySession& each) {
        return each.participant == participant.id && !each.opened;
    }));
    if (auto holds = participantGate(book_.settings, participant); !holds) return holds;
    if (auto holds = ageGate(book_.settings, participant); !holds) return holds;
    std::optional<std::chrono::sys_seconds> last;
    for (const auto& session : book_.known.sessions) {
        if (again || session.participant != participant.id) continue;
        if (const auto at = stimulatedAt(book_.files, session)) last = at;
    }
    const auto waits = [&](Result<void> holds) { return untilWhen(std::move(holds), participant, last); };
    if (auto holds = gapGate(book_.settings, last, book_.now()); !holds) return waits(std::move(holds));
    if (!again) {
        if (auto holds = wentBackGate(book_.settings, book_.known.wentBack, book_.now()); !holds)
            return waits(std::move(holds));
    }
    if (auto holds = book_.consented(participant); !holds) return holds;
    if (const auto yes = book_.known.excluded.find(participant.id);
        yes != book_.known.excluded.end() && !(utcDay(yes->second) < book_.today())) {
        return waits(fail(kGateRefused, "{} answered yes to the exclusion checklist today", participant.code));
    }
    return {};
}

Result<void> StudyGates::session(const SessionRequest& request, const Participant& participant, bool again) const {
    if (auto holds = beforehand(participant, again); !holds) return holds;
    if (auto holds = scriptGate(book_.settings, request.script); !holds) return holds;
    if (auto holds = procedureGate(book_.settings, request.procedure); !holds) return holds;
    if (!request.codeConfirmed) {
        return fail(kGateRefused, "the participant has not confirmed that the code {} is theirs", participant.code);
    }
    if (auto holds = exclusionGate(request.exclusions, book_.settings); !holds) return holds;
    if (auto holds = simulationGate(book_.settings, participant, request.devicesSimulated); !holds) return holds;
    return basisGate(request, participant);
}

}  // namespace tacto
