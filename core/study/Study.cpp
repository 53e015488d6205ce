#include "core/study/Study.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <iterator>
#include <unistd.h>

#include "core/base/Csv.h"
#include "core/base/JsonFields.h"
#include "core/safety/LockedFile.h"
#include "core/seal/SealedText.h"
#include "core/session/Digest.h"
#include "core/session/Durable.h"
#include "core/session/Ledger.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/study/LedgerRows.h"
#include "core/study/SessionSeal.h"
#include "core/study/StudyFiles.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVirtualPrefix = "virtual:";
constexpr std::size_t kIdDigits = 16;

CalibrationDate localDay(std::chrono::sys_seconds at) {
    const std::time_t now = at.time_since_epoch().count();
    std::tm here{};
    ::localtime_r(&now, &here);
    return {std::chrono::year(here.tm_year + 1900), std::chrono::month(static_cast<unsigned>(here.tm_mon + 1)),
            std::chrono::day(static_cast<unsigned>(here.tm_mday))};
}

/// Who has the study open.
struct Holder {
    std::int64_t process = 0;
};

Result<LockedFile> lockStudy(const StudyFiles& files) {
    auto locked = LockedFile::open(files.lock(), sizeof(Checked<Holder>), 0600);
    if (locked) {
        static_cast<Checked<Holder>*>(locked->content())->write({.process = ::getpid()});
        return std::move(*locked);
    }
    if (locked.error().why != LockedFile::Refusal::Held) {
        return fail(ErrorCode::Io, "the study in {} cannot be opened for changes: its lock {} cannot be taken",
                    files.folder.string(), files.lock().string());
    }
    Checked<Holder> holder;
    const int held = ::open(files.lock().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const bool told = held >= 0 && ::read(held, &holder, sizeof holder) == sizeof holder && holder.sound();
    if (held >= 0) ::close(held);
    return fail(ErrorCode::Io, "the study in {} is open in {}; end that first. Nothing was changed",
                files.folder.string(), told ? programOf(holder.content.process) : "another program");
}

fs::path keyFileOf(const StudyFiles& files, const StudySettings& settings, const Study::Surroundings& around) {
    return settings.kind == StudyKind::Rehearsal ? files.keys() : around.keyFolder / (settings.id + ".json");
}

Result<void> keysLieOutside(const StudyFiles& files, const Study::Surroundings& around) {
    if (!liesInside(around.keyFolder, files.folder)) return {};
    return fail(ErrorCode::Unsupported,
                "the key folder {} lies inside the study folder {}; keys beside what they open protect nothing, so "
                "another place is needed",
                around.keyFolder.string(), files.folder.string());
}

/// Goes with its owner unless it was kept.
struct Draft {
    explicit Draft(fs::path made) : path(std::move(made)) {}
    ~Draft() {
        std::error_code ignored;
        if (!path.empty()) fs::remove_all(path, ignored);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    fs::path path;
};

nlohmann::json settingsRow(const StudySettings& settings, std::string_view text) {
    return {{"settings", studyFields().write(settings)}, {"sha256", sha256Hex(text)}};
}

int answersIn(const fs::path& file) {
    const auto reader = SessionReader::open(file);
    if (!reader) return 0;
    const auto events = reader->events();
    if (!events) return 0;
    return static_cast<int>(std::ranges::count(*events, "answer", &SessionRow::name));
}

/// Empty for a file that was never made or cannot be read.
std::string headOf(const fs::path& file) {
    const auto reader = SessionReader::open(file);
    return reader ? reader->chainHead() : std::string();
}

}  // namespace

struct Study::State {
    StudyFiles files;
    Surroundings around;
    StudySettings settings;
    std::optional<LockedFile> lock;
    std::optional<StudyKeys> keys;
    std::optional<Ledger> ledger;
    LedgerState known;

    [[nodiscard]] std::chrono::sys_seconds now() const { return around.time->wall(); }
    [[nodiscard]] CalibrationDate today() const { return localDay(now()); }

    [[nodiscard]] Result<void> read() {
        const auto ledgerFile = SessionReader::open(files.ledger());
        if (!ledgerFile) return failure(ledgerFile);
        auto replayed = replay(*ledgerFile, settings.id, keys ? &*keys : nullptr);
        if (!replayed) return failure(replayed);
        known = std::move(*replayed);
        return {};
    }

    [[nodiscard]] Result<void> changeable() const {
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

    /// Appends `body`, with `content` sealed under `key` where there is one.
    [[nodiscard]] Result<void> append(const char* name, nlohmann::json body, const Secret* key = nullptr,
                                      const nlohmann::json& content = {}) {
        if (key != nullptr) body["sealed"] = sealedInLedger(settings.id, *key, ledger->next(), name, content);
        auto row = ledger->append(now(), name, body);
        if (!row) return failure(row);
        return read();
    }

    /// Errors: NotFound once the key is destroyed.
    [[nodiscard]] Result<const StudyKeys::Entry*> keyOf(std::string_view participant) const {
        const auto* entry = keys ? keys->byId(participant) : nullptr;
        if (entry == nullptr) {
            return fail(ErrorCode::Unsupported, "there is no key of participant {}: it was destroyed, or the study is "
                        "opened without its passphrase", participant);
        }
        return entry;
    }

    /// The `name` row of a participant.
    [[nodiscard]] Result<void> appendOf(const Participant& participant, const char* name, nlohmann::json body,
                                        const nlohmann::json& content) {
        const auto entry = keyOf(participant.id);
        if (!entry) return failure(entry);
        body["participant"] = participant.id;
        const auto key = subkey((*entry)->key, 0);
        return append(name, std::move(body), &key, content);
    }

    [[nodiscard]] Result<Participant> find(std::string_view code) const {
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

    /// The chains of the sessions that ended are those that the ledger noted.
    [[nodiscard]] Result<void> recordGate() const {
        for (const auto& [file, head] : known.heads) {
            if (head.empty() || headOf(files.session(file)) == head) continue;
            return fail(kGateRefused,
                        "the record of session {} is not the one that the ledger notes: it is gone or was changed; put "
                        "it back from your copy", file);
        }
        return clockGate(known.last, now());
    }

    [[nodiscard]] Result<void> stillApproved() const {
        if (auto sound = recordGate(); !sound) return sound;
        return approvalGate(settings, today());
    }

    /// Every gate of the study; `again`: of a session that goes on.
    [[nodiscard]] Result<void> gates(const SessionRequest& request, Participant participant, bool again) const {
        if (auto holds = stillApproved(); !holds) return holds;
        if (auto holds = scriptGate(settings, request.script); !holds) return holds;
        if (again) --participant.sessions;
        if (auto holds = participantGate(settings, participant); !holds) return holds;
        std::optional<std::chrono::sys_seconds> last;
        for (const auto& session : known.sessions) {
            if (!again && session.participant == participant.id) last = session.parts.back().begun;
        }
        if (auto holds = gapGate(settings, last, now()); !holds) return holds;
        if (auto holds = consentGate(settings, participant, today()); !holds) return holds;
        if (!request.codeConfirmed) {
            return fail(kGateRefused, "the participant has not confirmed that the code {} is theirs", participant.code);
        }
        if (auto holds = exclusionGate(request.exclusions); !holds) return holds;
        return simulationGate(settings, participant, request.devicesSimulated);
    }

    [[nodiscard]] Result<std::shared_ptr<const RowSeal>> sealFor(const StudySession& session,
                                                                 std::string_view file) const {
        const auto entry = keyOf(session.participant);
        if (!entry) return failure(entry);
        return std::make_shared<SessionSeal>(settings.id, std::string(file),
                                             subkey((*entry)->key, static_cast<std::uint64_t>(session.number)));
    }

    /// The session as it stands in the ledger now, with the seal of its last part.
    [[nodiscard]] Result<BegunSession> begun(std::string_view id) {
        const auto* session = known.session(id);
        if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
        const auto file = session->parts.back().file;
        auto seal = sealFor(*session, file);
        if (!seal) return failure(seal);
        return BegunSession{*session, files.session(file), std::move(*seal)};
    }

    /// A program was killed between the note of a withdrawal and the end of the key.
    [[nodiscard]] Result<void> finishWithdrawals() {
        for (const auto& one : known.participants) {
            if (one.state != ParticipantState::Withdrawn) continue;
            if (auto destroyed = keys->destroy(one.id); !destroyed) return destroyed;
        }
        return {};
    }
};

namespace {

/// study.json, ledger and sessions/ in `files.folder`, which is there.
Result<void> layOut(const StudyFiles& files, const StudySettings& settings, std::chrono::sys_seconds now) {
    std::error_code error;
    if (!fs::create_directory(files.sessions(), error))
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.sessions().string(), error.message());
    SessionAbout about;
    about.programVersion = TACTOSCOPE_VERSION;
    about.protocol = "study ledger";
    about.wallStart = fmt::format("{}T00:00:00Z", dateText(std::chrono::year_month_day(
                                                      std::chrono::floor<std::chrono::days>(now))));
    auto made = Ledger::create(files.ledger(), about, now);
    if (!made) return failure(made);
    const auto text = studyText(settings);
    if (auto row = made->append(now, ledger::kStudy, settingsRow(settings, text)); !row) return failure(row);
    if (auto drafted = draftStudy(files, text); !drafted) return drafted;
    return publishStudy(files);
}

Result<void> takeFolder(const StudyFiles& files) {
    std::error_code error;
    if (Study::isThere(files.folder))
        return fail(ErrorCode::Unsupported, "{} holds a study; a new one needs a folder of its own", files.folder.string());
    if (fs::exists(files.folder, error) && (!fs::is_directory(files.folder, error) || !fs::is_empty(files.folder, error)))
        return fail(ErrorCode::Unsupported, "{} is there already; a new study needs an empty folder or a new one",
                    files.folder.string());
    return {};
}

/// Makes the study under another name first, so that a crash leaves none or a whole one.
Result<void> makeStudy(const StudyFiles& files, const StudySettings& settings, const Passphrase* passphrase,
                       const Study::Surroundings& around) {
    std::error_code error;
    const auto parent = fs::absolute(files.folder).parent_path();
    fs::create_directories(parent, error);
    StudyFiles draft{files.folder};
    draft.folder += ".new-" + std::to_string(::getpid());
    fs::remove_all(draft.folder, error);
    if (!fs::create_directory(draft.folder, error))
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.folder.string(), error.message());
    Draft made(draft.folder);
    if (auto laid = layOut(draft, settings, around.time->wall()); !laid) return laid;
    const bool rehearsal = settings.kind == StudyKind::Rehearsal;
    const auto keyFile = keyFileOf(rehearsal ? draft : files, settings, around);
    auto keys = StudyKeys::create(keyFile, settings.id, passphrase, around.cost);
    if (!keys) return failure(keys);
    fs::rename(draft.folder, files.folder, error);
    if (error) {
        if (!rehearsal) fs::remove(keyFile);
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.folder.string(), error.message());
    }
    made.path.clear();
    syncFolderOf(files.folder);
    return {};
}

std::filesystem::path withoutEnd(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();  // "study/" is "study"
}

}  // namespace

fs::path Study::defaultKeyFolder() {
    const char* data = std::getenv("XDG_DATA_HOME");
    if (data != nullptr && *data != '\0') return fs::path(data) / "tactoscope" / "keys";
    const char* home = std::getenv("HOME");
    return fs::path(home != nullptr ? home : ".") / ".local" / "share" / "tactoscope" / "keys";
}

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
    if (settings.approval.reference.empty())
        return fail(ErrorCode::InvalidArgument, "a study needs the reference of its approval");
    if (auto taken = takeFolder(files); !taken) return failure(taken);
    if (auto outside = keysLieOutside(files, around); !outside) return failure(outside);
    if (auto made = makeStudy(files, settings, &passphrase, around); !made) return failure(made);
    return open(files.folder, &passphrase, Access::Change, around);
}

Result<Study> Study::createRehearsal(const fs::path& folder, StudySettings settings, const Surroundings& around) {
    constexpr int kAsManyAsWanted = 10'000;
    const StudyFiles files{withoutEnd(folder)};
    settings.id = randomHex(kIdDigits);
    settings.kind = StudyKind::Rehearsal;
    if (settings.title.empty()) settings.title = "Rehearsal";
    if (settings.consentVersion.empty()) settings.consentVersion = "rehearsal";
    settings.participantsMax = settings.sessionsMax = kAsManyAsWanted;
    auto& approval = settings.approval;
    if (approval.reference.empty()) {
        approval.reference = "rehearsal";
        approval.from = localDay(around.time->wall());
        approval.expires = {approval.from.year() + std::chrono::years(50), std::chrono::January, std::chrono::day(1)};
    }
    approval.protocolSha256 = protocolHash(settings);
    if (auto sound = studyFields().check(settings, RecordPlace{}); !sound) return failure(sound);
    if (auto taken = takeFolder(files); !taken) return failure(taken);
    if (auto made = makeStudy(files, settings, nullptr, around); !made) return failure(made);
    return open(files.folder, nullptr, Access::Change, around);
}

Result<Study> Study::open(const fs::path& folder, const Passphrase* passphrase, Access access,
                          const Surroundings& around) {
    auto state = std::make_unique<State>();
    state->files.folder = withoutEnd(folder);
    state->around = around;
    const auto& files = state->files;
    if (!isThere(files.folder)) return fail(ErrorCode::NotFound, "there is no study in {}", files.folder.string());
    const auto text = readTextFile(files.settings());
    if (!text) return failure(text);
    // Its version comes before everything else: what a newer program wrote is not judged.
    const auto first = parseStudy(*text, files.settings().string());
    if (!first) return failure(first);
    if (access == Access::Change) {
        auto lock = lockStudy(files);
        if (!lock) return failure(lock);
        state->lock.emplace(std::move(*lock));
    }
    const auto verified = verifySession(files.ledger());
    if (!verified) return failure(verified);
    if (verified->status != SessionStatus::Intact) {
        return fail(ErrorCode::ParseError, "the ledger of the study in {} is damaged: {}", files.folder.string(),
                    verified->problems.empty() ? "it is no ledger" : verified->problems.front());
    }
    state->settings = *first;
    const bool rehearsal = first->kind == StudyKind::Rehearsal;
    if (rehearsal || passphrase != nullptr) {
        if (!rehearsal) {
            if (auto outside = keysLieOutside(files, around); !outside) return failure(outside);
        }
        auto keys = StudyKeys::open(keyFileOf(files, *first, around), first->id, rehearsal ? nullptr : passphrase,
                                    around.cost);
        if (!keys) return failure(keys);
        state->keys.emplace(std::move(*keys));
    }
    if (auto read = state->read(); !read) return failure(read);
    const auto current = readStudy(files, state->known.settingsSha256);
    if (!current) return failure(current);
    auto settings = parseStudy(*current, files.settings().string());
    if (!settings) return failure(settings);
    state->settings = std::move(*settings);
    if (access == Access::Change) {
        if (*current != *text) {
            if (auto published = publishStudy(files); !published) return failure(published);
        }
        auto opened = Ledger::open(files.ledger());
        if (!opened) return failure(opened);
        state->ledger.emplace(std::move(*opened));
        if (state->keys) {
            if (auto finished = state->finishWithdrawals(); !finished) return failure(finished);
        }
    }
    return Study(std::move(state));
}

const fs::path& Study::folder() const noexcept { return state_->files.folder; }
const StudySettings& Study::settings() const noexcept { return state_->settings; }
bool Study::isRehearsal() const noexcept { return state_->settings.kind == StudyKind::Rehearsal; }
bool Study::hasKey() const noexcept { return state_->keys.has_value(); }
std::string Study::ledgerHead() const { return state_->known.head; }
CalibrationDate Study::today() const { return state_->today(); }
Result<void> Study::stillApproved() const { return state_->stillApproved(); }
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
    if (participant.virtualSeed && state_->find(fmt::format("{}{}", kVirtualPrefix, *participant.virtualSeed))) {
        return fail(ErrorCode::Unsupported, "virtual:{} is enrolled already; another seed is expected",
                    *participant.virtualSeed);
    }
    const auto taken = [&](const std::string& code) {
        return std::ranges::find(state_->keys->entries(), code, &StudyKeys::Entry::code) !=
               state_->keys->entries().end();
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
    participant.id = randomHex(kIdDigits);
    // The key first: a row whose key was lost would never open.
    if (auto added = state_->keys->add(participant.id, participant.code); !added) return failure(added);
    const auto number = static_cast<int>(state_->known.participants.size()) + 1;
    auto noted = state_->appendOf(participant, ledger::kEnrolled, {{"number", number}}, toJson(participant));
    if (!noted) {
        static_cast<void>(state_->keys->destroy(participant.id));
        return failure(noted);
    }
    return state_->known.participants.back();
}

Result<Participant> Study::admitVirtual(std::uint64_t seed) {
    if (!isRehearsal())
        return fail(ErrorCode::Unsupported, "only in a rehearsal does a virtual participant enrol by itself");
    const auto code = fmt::format("{}{}", kVirtualPrefix, seed);
    auto found = state_->find(code);
    if (!found) {
        Participant participant;
        participant.virtualSeed = seed;
        found = enrol(std::move(participant));
        if (!found) return found;
    }
    if (consentGate(settings(), *found, today())) return found;
    if (auto given = consent(code, {settings().consentVersion, today(), "rehearsal"}); !given) return failure(given);
    return state_->find(code);
}

Result<void> Study::consent(std::string_view code, const Consent& consent) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    if (consent.version.empty() || consent.by.empty())
        return fail(ErrorCode::InvalidArgument, "a consent needs the version of the form and the initials of who took it");
    if (!consent.date.ok() || !(consent.date <= today())) {
        return fail(ErrorCode::InvalidArgument, "the consent is dated {}; a day no later than today, {}, is expected",
                    dateText(consent.date), dateText(today()));
    }
    if (participant->state != ParticipantState::Active)
        return fail(kGateRefused, "{} has left the study; only an active participant consents", participant->code);
    return state_->appendOf(*participant, ledger::kConsent, nlohmann::json::object(), toJson(consent));
}

Result<void> Study::leave(std::string_view code) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    if (participant->state == ParticipantState::Left)
        return fail(kGateRefused, "{} has left the study already", participant->code);
    return state_->append(ledger::kLeft, {{"participant", participant->id}, {"sessions", participant->sessions}});
}

Result<void> Study::withdraw(std::string_view code) {
    if (auto may = state_->changeable(); !may) return may;
    const auto participant = state_->find(code);
    if (!participant) return failure(participant);
    if (state_->settings.dataOnRequest == DataOnRequest::Keep) {
        return fail(kGateRefused,
                    "the study keeps what was collected (data_on_request keep), as its consent says; \"leave\" ends {}'s "
                    "part", participant->code);
    }
    // The note first: a key that is gone without it would look like damage. open() finishes what a crash leaves.
    auto noted =
        state_->append(ledger::kWithdrawn, {{"participant", participant->id}, {"sessions", participant->sessions}});
    if (!noted) return noted;
    if (auto destroyed = state_->keys->destroy(participant->id); !destroyed) return destroyed;
    return state_->read();
}

Result<void> Study::amend(StudySettings settings, std::string_view reference) {
    if (auto may = state_->changeable(); !may) return may;
    if (reference.empty() || reference == state_->settings.approval.reference) {
        return fail(ErrorCode::InvalidArgument, "an amendment needs a reference of its own, not \"{}\"", reference);
    }
    settings.id = state_->settings.id;
    settings.kind = state_->settings.kind;
    settings.approval.reference = reference;
    settings.approval.protocolSha256 = protocolHash(settings);
    if (auto sound = studyFields().check(settings, RecordPlace{}); !sound) return sound;
    const auto text = studyText(settings);
    if (auto drafted = draftStudy(state_->files, text); !drafted) return drafted;
    auto row = settingsRow(settings, text);
    row["reference"] = reference;
    if (auto noted = state_->append(ledger::kAmendment, std::move(row)); !noted) return noted;
    if (auto published = publishStudy(state_->files); !published) return published;
    state_->settings = std::move(settings);
    return {};
}

Result<BegunSession> Study::beginSession(const SessionRequest& request) {
    if (auto may = state_->changeable(); !may) return failure(may);
    const auto participant = state_->find(request.code);
    if (!participant) return failure(participant);
    if (const auto open = unfinished(participant->id)) {
        return fail(ErrorCode::Unsupported, "session {} of {} is unfinished; resume it or end it first", open->number,
                    participant->code);
    }
    if (auto holds = state_->gates(request, *participant, false); !holds) return failure(holds);
    const auto id = randomHex(kIdDigits);
    auto noted = state_->appendOf(*participant, ledger::kSessionBegun,
                                  {{"session", id},
                                   {"file", id},
                                   {"number", participant->sessions + 1},
                                   {"protocol", request.script.name},
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
                    participant->code, wordFor(Words<StudySessionState>(kStudySessionStates), before->state));
    }
    if (auto holds = state_->gates(request, *participant, true); !holds) return failure(holds);
    const auto& last = before->parts.back().file;
    auto noted = state_->append(ledger::kSessionPart, {{"session", before->id},
                                                       {"file", randomHex(kIdDigits)},
                                                       {"participant", participant->id},
                                                       {"after", last},
                                                       {"head", headOf(pathOf(last))}});
    if (!noted) return failure(noted);
    return state_->begun(id);
}

Result<void> Study::endSession(std::string_view id, StudySessionState ended, std::string_view chainHead) {
    if (auto may = state_->changeable(); !may) return may;
    const auto* session = state_->known.session(id);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session {}", id);
    if (ended == StudySessionState::Unfinished || session->state != StudySessionState::Unfinished) {
        return fail(ErrorCode::InvalidArgument, "session {} is {} and cannot become {}", id,
                    wordFor(Words<StudySessionState>(kStudySessionStates), session->state),
                    wordFor(Words<StudySessionState>(kStudySessionStates), ended));
    }
    const auto& file = session->parts.back().file;
    const auto head = chainHead.empty() ? headOf(pathOf(file)) : std::string(chainHead);
    return state_->append(ledger::kSessionEnded,
                          {{"session", session->id},
                           {"participant", session->participant},
                           {"state", wordFor(Words<StudySessionState>(kStudySessionStates), ended)},
                           {"file", file},
                           {"head", head}});
}

Result<std::shared_ptr<const RowSeal>> Study::sealOf(std::string_view file) const {
    const auto* session = state_->known.sessionOfFile(file);
    if (session == nullptr) return fail(ErrorCode::NotFound, "the study has no session file {}", file);
    return state_->sealFor(*session, file);
}

Result<std::vector<SessionRow>> Study::events(const StudySession& session) const {
    std::vector<SessionRow> all;
    for (const auto& part : session.parts) {
        auto seal = state_->sealFor(session, part.file);
        if (!seal) return failure(seal);
        const auto reader = SessionReader::open(pathOf(part.file), std::move(*seal));
        if (!reader && reader.error().code == ErrorCode::NotFound) continue;
        if (!reader) return failure(reader);
        auto rows = reader->events();
        if (!rows) return failure(rows);
        std::ranges::move(*rows, std::back_inserter(all));
    }
    return all;
}

Result<void> Study::adverseEvent(std::string_view session, const AdverseEvent& event) {
    if (auto may = state_->changeable(); !may) return may;
    if (state_->known.session(session) == nullptr)
        return fail(ErrorCode::NotFound, "the study has no session {}", session);
    if (event.what.empty() || event.severity < 1 || event.severity > 4 || event.relation < 1 || event.relation > 5) {
        return fail(ErrorCode::InvalidArgument,
                    "an adverse event needs what happened, a severity from 1 to 4 and a relation from 1 to 5; these are "
                    "\"{}\", {} and {}", event.what, event.severity, event.relation);
    }
    return state_->append(ledger::kAdverseEvent, {{"session", session}}, &state_->keys->study(), toJson(event));
}

Result<std::vector<std::pair<std::string, AdverseEvent>>> Study::adverseEvents() const {
    if (!state_->keys) return fail(ErrorCode::Unsupported, "adverse events are read with the study's passphrase");
    return state_->known.adverseEvents;
}

Result<void> Study::exported(const fs::path& place, std::string_view what) {
    if (auto may = state_->changeable(); !may) return may;
    if (liesInside(place, folder())) {
        return fail(ErrorCode::InvalidArgument,
                    "{} lies inside the study folder; an export there would stand unsealed beside what is sealed",
                    place.string());
    }
    return state_->append(ledger::kExported, {{"what", what}}, &state_->keys->study(), {{"place", place.string()}});
}

}  // namespace tacto
