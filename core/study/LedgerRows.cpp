#include "core/study/LedgerRows.h"

#include <algorithm>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/seal/SealedText.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace {

constexpr const char* kMac = "mac";

constexpr AcceptedText kLedgerText{.mayBeEmpty = true, .mostBytes = 2000};

RecordFields<Participant> participantFields() {
    using P = Participant;
    RecordFields<P> all;
    all.word("group", &P::group, kParticipantGroups);
    all.number("virtual", &P::virtualSeed);
    all.texts({{"age", &P::age}, {"sex", &P::sex}, {"handedness", &P::handedness}}, kLedgerText);
    return all;
}

RecordFields<Consent> consentFields() {
    using C = Consent;
    RecordFields<C> all;
    all.text("version", &C::version, kLedgerText);
    all.add("date", &C::date, dateKind());
    all.text("by", &C::by, kLedgerText);
    return all;
}

RecordFields<AdverseEvent> adverseEventFields() {
    using A = AdverseEvent;
    RecordFields<A> all;
    all.texts({{"what", &A::what}, {"action", &A::action}, {"outcome", &A::outcome}}, kLedgerText);
    all.number("severity", &A::severity, {.low = 1, .high = 4});
    all.flag("serious", &A::serious);
    all.number("relation", &A::relation, {.low = 1, .high = 5});
    all.flag("reported", &A::reported);
    all.texts({{"onset", &A::onset}, {"ended", &A::ended}}, kLedgerText);
    all.word("expected", &A::expected, kExpectedness);
    all.rule([](const A& event) -> Result<void> {
        for (const auto& [name, day] : {std::pair{"onset", &event.onset}, {"ended", &event.ended}}) {
            if (!day->empty() && !parseDate(*day))
                return invalid("{} is \"{}\"; a day as 2026-11-21 is accepted, or nothing", name, day->substr(0, 40));
        }
        if (event.onset.empty() || event.ended.empty() || event.onset <= event.ended) return {};
        return invalid("the event began on {} and ended on {}; a later end is expected", event.onset, event.ended);
    });
    return all;
}

/// Returns keys such as "cap_ma" of the settings that changed, without those that every amendment changes.
std::vector<std::string> changedKeys(const nlohmann::json& before, const nlohmann::json& now) {
    constexpr std::string_view kOwn[] = {"approval.reference", "approval.protocol_sha256"};
    std::vector<std::string> changed;
    for (const auto& [key, value] : now.items()) {
        const auto old = valueOr(before, key.c_str());
        if (old == value) continue;
        if (!value.is_object()) {
            changed.push_back(key);
            continue;
        }
        for (const auto& [inner, held] : value.items()) {
            const auto name = fmt::format("{}.{}", key, inner);
            if (valueOr(old, inner.c_str()) != held && std::ranges::find(kOwn, name) == std::end(kOwn))
                changed.push_back(name);
        }
    }
    return changed;
}

/// Reads the ledger in one pass.
class Replay {
public:
    Replay(const std::string& study, const StudyKeys* keys) : study_(study), keys_(keys) {}

    [[nodiscard]] Result<void> take(const SessionRow& row) {
        state.last = std::max(state.last, std::chrono::sys_seconds(wholeSeconds(row.at)));
        state.rows.push_back(row.name);
        // Effects of a row start at `last`, not at the row's own time: setting the clock back dates nothing back.
        if (row.name == ledger::kStudy || row.name == ledger::kAmendment) {
            settings(row);
            return {};
        }
        if (row.name == ledger::kEnrolled) return enrolled(row);
        if (row.name == ledger::kAdverseEvent) return adverseEvent(row);
        if (row.name == ledger::kExported) return exported(row);
        if (row.name == ledger::kReleased) return released(row);
        if (row.name == ledger::kNote) return note(row);
        if (row.name == ledger::kWentBack) return wentBack(row);
        auto* participant = state.participant(textOr(row.body, "participant"));
        if (participant == nullptr) return unfit(row, "an unknown participant");
        if (row.name == ledger::kConsent) return consent(row, *participant);
        if (row.name == ledger::kExcluded) {
            if (const auto content = opened(row, participant->id); !content) return failure(content);
            state.excluded[participant->id] = state.last;
            return {};
        }
        if (row.name == ledger::kLeft) return left(row, *participant);
        if (row.name == ledger::kWithdrawn) {
            withdrawn(*participant, flagOr(row.body, "virtual"));
            return {};
        }
        if (row.name == ledger::kSessionBegun) return sessionBegun(row, *participant);
        auto* session = state.session(textOr(row.body, "session"));
        if (session == nullptr) return unfit(row, "an unknown session");
        if (row.name == ledger::kSessionPart) {
            if (session->state != StudySessionState::Unfinished) return unfit(row, "a session that has ended");
            if (!isId(textOr(row.body, "file"))) return unfit(row, "a file whose name is not 16 hexadecimal digits");
            session->parts.push_back({textOr(row.body, "file"), std::chrono::sys_seconds(wholeSeconds(row.at))});
            // The part before is complete, since nothing is ever appended to it.
            auto head = textOr(row.body, "head");
            if (!head.empty()) state.heads[textOr(row.body, "after")] = std::move(head);
            return {};
        }
        if (row.name == ledger::kNextDay) return nextDay(row, *session);
        if (row.name == ledger::kSessionEnded) return sessionEnded(row, *session);
        return unfit(row, "nothing that this program knows");
    }

    LedgerState state;

private:
    static std::chrono::seconds wholeSeconds(Instant at) noexcept {
        return std::chrono::floor<std::chrono::seconds>(at);
    }
    /// Whether the text can name a file: only hexadecimal digits, so no path.
    static bool isId(std::string_view text) noexcept { return isHex(text, 16); }
    static tl::unexpected<Error> unfit(const SessionRow& row, std::string_view what) {
        return fail(ErrorCode::ParseError, "row {} ({}) of the ledger is about {}", row.seq, row.name, what);
    }
    /// Returns nothing if there is no key for the participant.
    [[nodiscard]] Result<std::optional<nlohmann::json>> opened(const SessionRow& row, const std::string& id) const {
        const auto* entry = keys_ != nullptr ? keys_->byId(id) : nullptr;
        if (entry == nullptr) return std::nullopt;
        auto content = openedInLedger(study_, subkey(entry->key, 0), row.seq, row.name, row.body);
        if (!content) return failure(content);
        return std::optional(std::move(*content));
    }

    void settings(const SessionRow& row) {
        state.settingsSha256 = textOr(row.body, "sha256");
        auto now = valueOr(row.body, "settings");
        formInForce(row, now);
        state.references.push_back(textOr(valueOr(now, "approval"), "reference"));
        if (row.name == ledger::kAmendment) {
            state.amendments.push_back({textOr(row.body, "reference"), std::chrono::sys_seconds(wholeSeconds(row.at)),
                                        changedKeys(state.settings, now)});
        } else {
            state.firstPlaces = static_cast<int>(countOr(now, "participants_max"));
        }
        state.settings = std::move(now);
    }

    /// A consent to a version of the form is valid from the first day when that version was in force: for the first
    /// version the approval's first day, for a later one the amendment's day, or a new approval's first day.
    void formInForce(const SessionRow& row, const nlohmann::json& now) {
        const auto fromOf = [](const nlohmann::json& settings) {
            return textOr(valueOr(settings, "approval"), "from");
        };
        const auto from = parseDate(fromOf(now));
        if (!from) return;
        const auto version = textOr(now, "consent_version");
        const bool isFirst = row.name == ledger::kStudy;
        const bool moved = isFirst || fromOf(now) != fromOf(state.settings);
        const CalibrationDate written = std::chrono::floor<std::chrono::days>(state.last);
        const auto known = state.formSince.find(version);
        if (known == state.formSince.end())
            state.formSince[version] = moved ? *from : written;
        else if (moved && *from < known->second && textOr(state.settings, "consent_version") == version)
            known->second = *from;
    }

    [[nodiscard]] Result<void> wentBack(const SessionRow& row) {
        StudyGoingBack back;
        back.at = state.last;
        back.lost = static_cast<std::int64_t>(countOr(row.body, "lost"));
        back.newestAt =
            std::chrono::sys_seconds(std::chrono::seconds(static_cast<std::int64_t>(countOr(row.body, "at"))));
        for (const auto& [key, into] :
             {std::pair{"rows", &back.rows}, std::pair{"files", &back.files}, std::pair{"unsealed", &back.unsealed}}) {
            for (const auto& each : valueOr(row.body, key)) {
                if (!each.is_string()) return unfit(row, "a list of something else than names");
                into->push_back(each.get<std::string>());
            }
        }
        state.wentBack.push_back(std::move(back));
        return {};
    }

    [[nodiscard]] Result<void> enrolled(const SessionRow& row) {
        Participant participant;
        const auto id = textOr(row.body, "participant");
        if (id.empty() || state.participant(id) != nullptr) return unfit(row, "a participant who is there already");
        const auto content = opened(row, id);
        if (!content) return failure(content);
        participant.readable = content->has_value();
        if (*content) {
            if (auto read = builtOnce<participantFields>().read(**content, participant, RecordPlace{}); !read)
                return read;
            participant.code = keys_->byId(id)->code;
        }
        participant.id = id;
        participant.enrolled = static_cast<int>(state.participants.size()) + 1;
        state.participants.push_back(std::move(participant));
        return {};
    }

    [[nodiscard]] Result<void> consent(const SessionRow& row, Participant& participant) {
        state.promised[participant.id] = textOr(state.settings, "data_on_request");
        const auto content = opened(row, participant.id);
        if (!content) return failure(content);
        if (!*content) return {};
        auto read = builtOnce<consentFields>().read(**content, RecordPlace{});
        if (!read) return failure(read);
        participant.consents.push_back(std::move(*read));
        return {};
    }

    [[nodiscard]] Result<void> left(const SessionRow& row, Participant& participant) {
        participant.state = ParticipantState::Left;
        if (!row.body.contains("sealed")) return {};
        const auto content = opened(row, participant.id);
        if (!content) return failure(content);
        if (*content) participant.leftBecause = textOr(**content, "reason");
        return {};
    }

    /// Deletes what the key could still open, even before the key is destroyed.
    void withdrawn(Participant& participant, bool isVirtual) {
        Participant left;
        left.virtualGone = isVirtual;
        left.id = participant.id;
        left.enrolled = participant.enrolled;
        left.sessions = participant.sessions;
        left.state = ParticipantState::Withdrawn;
        left.readable = false;
        participant = std::move(left);
        for (auto& session : state.sessions) {
            if (session.participant != participant.id) continue;
            session.code.clear();
            session.encoding.clear();
            state.nextDays.erase(session.id);
        }
    }

    [[nodiscard]] Result<void> sessionBegun(const SessionRow& row, Participant& participant) {
        StudySession session;
        session.id = textOr(row.body, "session");
        if (session.id.empty() || state.session(session.id) != nullptr)
            return unfit(row, "a session that is there already");
        if (!isId(textOr(row.body, "file"))) return unfit(row, "a file whose name is not 16 hexadecimal digits");
        const auto content = opened(row, participant.id);
        if (!content) return failure(content);
        if (*content) session.encoding = textOr(**content, "encoding");
        session.participant = participant.id;
        session.code = participant.code;
        session.number = ++participant.sessions;
        session.protocol = textOr(row.body, "protocol");
        // Older rows do not record the basis: then people took part in studies, and virtual participants in rehearsals.
        const bool rehearsal = textOr(state.settings, "kind") == nameOf(StudyKind::Rehearsal);
        const auto usual = participant.isVirtual() || rehearsal ? SessionBasis::Virtual : SessionBasis::Person;
        session.basis = valueFor(kSessionBases, textOr(row.body, "basis")).value_or(usual);
        session.parts.push_back({textOr(row.body, "file"), std::chrono::sys_seconds(wholeSeconds(row.at))});
        state.sessions.push_back(std::move(session));
        return {};
    }

    [[nodiscard]] Result<void> sessionEnded(const SessionRow& row, StudySession& session) {
        const auto ended = valueFor(kStudySessionStates, textOr(row.body, "state"));
        if (!ended) return unfit(row, "a state that this program does not know");
        if (session.state != StudySessionState::Unfinished) return unfit(row, "a session that has ended");
        session.state = *ended;
        session.opened = valueOr(row.body, "opened") != false;
        state.heads[textOr(row.body, "file")] = textOr(row.body, "head");
        return {};
    }

    [[nodiscard]] Result<void> nextDay(const SessionRow& row, const StudySession& session) {
        const auto content = opened(row, session.participant);
        if (!content) return failure(content);
        if (!*content) return {};
        auto said = nextDayFrom(**content);
        if (!said) return failure(said);
        state.nextDays.insert_or_assign(session.id, std::move(*said));
        return {};
    }

    [[nodiscard]] Result<void> adverseEvent(const SessionRow& row) {
        ++state.adverseEventRows;
        if (keys_ == nullptr) return {};
        const auto content = openedInLedger(study_, keys_->study(), row.seq, row.name, row.body);
        if (!content) return failure(content);
        auto event = builtOnce<adverseEventFields>().read(*content, RecordPlace{});
        if (!event) return failure(event);
        state.adverseEvents.emplace_back(textOr(row.body, "session"), std::move(*event));
        return {};
    }

    [[nodiscard]] Result<void> released(const SessionRow& row) {
        if (keys_ == nullptr) return {};
        const auto content = openedInLedger(study_, keys_->study(), row.seq, row.name, row.body);
        if (!content) return failure(content);
        const auto event = countOr(row.body, "event");
        if (event < 1 || event > state.adverseEvents.size()) return unfit(row, "an unknown adverse event");
        auto& held = state.adverseEvents[event - 1].second;
        held.releasedBy = textOr(*content, "by");
        held.releasedBecause = textOr(*content, "reason");
        return {};
    }

    [[nodiscard]] Result<void> note(const SessionRow& row) {
        if (keys_ == nullptr) return {};
        const auto content = openedInLedger(study_, keys_->study(), row.seq, row.name, row.body);
        if (!content) return failure(content);
        auto said = noteTextsFrom(*content);
        if (!said) return failure(said);
        state.notes.push_back(
            {textOr(row.body, "kind"), std::chrono::sys_seconds(wholeSeconds(row.at)), std::move(*said)});
        return {};
    }

    [[nodiscard]] Result<void> exported(const SessionRow& row) {
        if (keys_ == nullptr) return {};
        const auto content = openedInLedger(study_, keys_->study(), row.seq, row.name, row.body);
        if (!content) return failure(content);
        state.exports.push_back(
            {std::chrono::sys_seconds(wholeSeconds(row.at)), textOr(row.body, "what"), textOr(*content, "place")});
        return {};
    }

    const std::string& study_;
    const StudyKeys* keys_;
};

}  // namespace

Participant* LedgerState::participant(std::string_view id) noexcept {
    const auto found = std::ranges::find(participants, id, &Participant::id);
    return found == participants.end() ? nullptr : &*found;
}

StudySession* LedgerState::session(std::string_view id) noexcept {
    const auto found = std::ranges::find(sessions, id, &StudySession::id);
    return found == sessions.end() ? nullptr : &*found;
}

const StudySession* LedgerState::sessionOfFile(std::string_view file) const noexcept {
    for (const auto& session : sessions) {
        if (std::ranges::find(session.parts, file, &StudyPart::file) != session.parts.end()) return &session;
    }
    return nullptr;
}

std::string sealedInLedger(const std::string& study, const Secret& key, std::int64_t seq, std::string_view name,
                           const nlohmann::json& content) {
    return SessionSeal(study, "ledger", Secret(key.bytes())).sealText(seq, name, dumpJson(content));
}

Result<nlohmann::json> openedInLedger(const std::string& study, const Secret& key, std::int64_t seq,
                                      std::string_view name, const nlohmann::json& body) {
    const auto text = SessionSeal(study, "ledger", Secret(key.bytes())).openText(seq, name, textOr(body, "sealed"));
    if (!text) return fail(ErrorCode::ParseError, "row {} ({}) of the ledger: {}", seq, name, text.error().message);
    return parseJson(*text, fmt::format("row {} of the ledger", seq), kRowLimits);
}

std::string macInLedger(const std::string& study, const Secret& key, std::int64_t seq, std::chrono::sys_seconds at,
                        std::string_view name, const nlohmann::json& body, std::string_view before) {
    constexpr std::uint64_t kMacs = 2;  // number of the subkey; number 1 is for labels
    return macText(subkey(key, kMacs), fmt::format("{}\n{}\n{}\n{}\n{}\n{}", study, seq, at.time_since_epoch().count(),
                                                   name, before, dumpJson(body)));
}

nlohmann::json toJson(const Participant& participant) { return builtOnce<participantFields>().write(participant); }
nlohmann::json toJson(const Consent& consent) { return builtOnce<consentFields>().write(consent); }
nlohmann::json toJson(const AdverseEvent& event) { return builtOnce<adverseEventFields>().write(event); }

Result<void> checkForLedger(const Participant& participant) {
    return builtOnce<participantFields>().check(participant, RecordPlace{});
}
Result<void> checkForLedger(const Consent& consent) { return builtOnce<consentFields>().check(consent, RecordPlace{}); }
Result<void> checkForLedger(const AdverseEvent& event) {
    return builtOnce<adverseEventFields>().check(event, RecordPlace{});
}

namespace {
Result<void> checkMac(const SessionReader& ledger, const std::string& study, const StudyKeys& keys,
                      const SessionRow& row) {
    const auto before = ledger.hashOf(row.seq - 1);
    if (!before) return failure(before);
    auto body = row.body;
    body.erase(kMac);
    const std::chrono::sys_seconds at(std::chrono::floor<std::chrono::seconds>(row.at));
    if (macInLedger(study, keys.study(), row.seq, at, row.name, body, *before) == textOr(row.body, kMac)) return {};
    return fail(
        ErrorCode::ParseError,
        "row {} ({}) of the ledger was not written with the study's key: it was changed, or is another ledger's; put "
        "the newest back from your copy",
        row.seq, row.name);
}
}  // namespace

Result<LedgerState> replay(const SessionReader& ledger, const std::string& study, const StudyKeys* keys) {
    const auto rows = ledger.events();
    if (!rows) return failure(rows);
    Replay replay(study, keys);
    for (const auto& row : *rows) {
        if (keys != nullptr && row.body.contains(kMac)) {
            if (auto own = checkMac(ledger, study, *keys, row); !own) return failure(own);
            replay.state.vouched = row.seq;
        }
        if (auto taken = replay.take(row); !taken) return failure(taken);
    }
    replay.state.head = ledger.chainHead();
    return std::move(replay.state);
}

}  // namespace tacto
