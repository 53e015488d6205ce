#include "app/cli/StudyOptions.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/Say.h"
#include "app/cli/StudyPassphrase.h"
#include "app/run/StudyProgram.h"
#include "core/study/StudySettings.h"

namespace tacto::cli {

namespace {

/// Calls `take` with the key and the value of each --set.
Result<void> forEachSet(const QCommandLineParser& parser,
                        const std::function<Result<void>(const std::string& key, const std::string& value)>& take) {
    for (const auto& set : parser.values("set")) {
        const auto text = set.toStdString();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            return fail(ErrorCode::InvalidArgument, "--set {}: KEY=VALUE is expected", text);
        if (auto done = take(text.substr(0, equals), text.substr(equals + 1)); !done) return done;
    }
    return {};
}

/// Returns the settings as changed by --set, with what this program and --profile state.
Result<StudySettings> asSetHere(const QCommandLineParser& parser, StudySettings settings) {
    if (!settings.procedure) settings.procedure.emplace();
    if (!settings.painCeiling) settings.painCeiling = kPainCeiling;
    if (!settings.ageMin) settings.ageMin = kAgeMin;
    const auto take = [&](const std::string& key, const std::string& value) {
        return setStudyField(settings, key, value);
    };
    if (auto taken = forEachSet(parser, take); !taken) return failure(taken);
    const auto profile = profileOption(parser);
    if (!profile) return failure(profile);
    const auto folder = parser.positionalArguments().value(1);  // its words are stated too
    if (auto stated = stateProgram(settings, *profile, folder.toStdString()); !stated) return failure(stated);
    return settings;
}

Result<int> scoreGiven(const QCommandLineParser& parser, const char* name, int least, int most) {
    bool isNumber = false;
    const int score = parser.value(name).toInt(&isNumber);
    if (isNumber && score >= least && score <= most) return score;
    if (!parser.isSet(name)) return fail(ErrorCode::InvalidArgument, "--{} is missing", name);
    return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a whole number from {} to {} is expected", name,
                parser.value(name).toStdString(), least, most);
}

}  // namespace

void declareStudyOptions(QCommandLineParser& parser) {
    parser.addOption({"title", "Title of the study.", "T"});
    parser.addOption({"approval", "Reference of the committee's approval.", "REF"});
    parser.addOption({"from", "First day of the approval, as 2026-11-21.", "DATE"});
    parser.addOption({"expires", "Its last day.", "DATE"});
    parser.addOption({"consent-version", "Version of the consent form in force.", "V"});
    parser.addOption({"set",
                      "A setting of the study: blocks=3, electrode.area_cm2=5, license=CC-BY-4.0, "
                      "exclusions=\"Question?;Other?\". Of "
                      "a note, a field of it.",
                      "KEY=VALUE"});
    parser.addOption({"profile", "Profile that its sessions are run with; the shipped one where left out.", "FILE"});
    parser.addOption({"reference", "Reference of the committee's amendment.", "REF"});
    parser.addOption({"virtual", "Enrols a virtual participant of this seed.", "SEED"});
    parser.addOption({"version", "Version of the consent form that was signed.", "V"});
    parser.addOption({"date", "Day on which it was signed.", "DATE"});
    parser.addOption({"by", "The investigator's initials; of release, who decides.", "INITIALS"});
    parser.addOption({"confirm",
                      "The code once more: the participant's records are lost for good. Of go-back the word that it "
                      "names: newer rows of the ledger are.",
                      "WORD"});
    parser.addOption({"session", "Number of the participant's session; the last where left out.", "N"});
    parser.addOption({"what", "What happened; never a name.", "TEXT"});
    parser.addOption(
        {"severity", QString::fromStdString("How severe it was: " + scaleText(kEventSeverities) + "."), "1..4"});
    parser.addOption({"relation",
                      QString::fromStdString("How it is related to the stimulation: " + scaleText(kRelations) + "."),
                      "1..5"});
    parser.addOption({"serious", "It was a serious adverse event."});
    parser.addOption({"action", "What was done.", "TEXT"});
    parser.addOption({"outcome", "What became of it.", "TEXT"});
    parser.addOption(
        {"expected", "Whether the approval names it among the risks: unknown, expected, unexpected.", "WORD"});
    parser.addOption({"onset", "Day on which it began, as 2026-11-21.", "DATE"});
    parser.addOption({"ended", "Day on which it ended.", "DATE"});
    parser.addOption({"reason", "Why they left, or why the study is released.", "TEXT"});
    parser.addOption(
        {"new-passphrase-file", "File whose first line is the next passphrase; asked for where left out.", "F"});
    parser.addOption({"reported", "It was reported to the committee."});
    parser.addOption({"group", "intact, or \"limb difference\"; intact where left out.", "GROUP"});
    parser.addOption({"age", "Age in whole years, where the approval asks for it.", "YEARS"});
    parser.addOption({"sex", "female, male or other, where the approval asks for it.", "SEX"});
    parser.addOption({"handedness", "right, left or ambidextrous, where the approval asks for it.", "HAND"});
    parser.addOption({"erythema", "Redness of the skin on a day after, 0 to 4.", "0..4"});
    parser.addOption({"oedema", "Swelling of the skin on a day after, 0 to 4.", "0..4"});
    parser.addOption({"side-effect", "What was noticed by then, its severity 1 to 4 and relation 1 to 5: redness:2:4.",
                      "ITEM:SEVERITY:RELATION"});
    declarePassphrase(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

std::string given(const QCommandLineParser& parser, const char* name) {
    return parser.value(name).trimmed().toStdString();
}

Result<CalibrationDate> dateGiven(const QCommandLineParser& parser, const char* name) {
    const auto text = given(parser, name);
    if (const auto date = parseDate(text)) return *date;
    return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a day as 2026-11-21 is expected", name, text);
}

Result<StudySettings> settingsGiven(const QCommandLineParser& parser) {
    StudySettings settings;
    settings.title = given(parser, "title");
    settings.approval.reference = given(parser, "approval");
    settings.consentVersion = given(parser, "consent-version");
    for (const char* name : {"title", "approval", "consent-version"}) {
        if (given(parser, name).empty()) return fail(ErrorCode::InvalidArgument, "--{} is missing", name);
    }
    const auto from = dateGiven(parser, "from");
    if (!from) return failure(from);
    const auto expires = dateGiven(parser, "expires");
    if (!expires) return failure(expires);
    settings.approval.from = *from;
    settings.approval.expires = *expires;
    return asSetHere(parser, std::move(settings));
}

Result<StudySettings> settingsAmended(const QCommandLineParser& parser, StudySettings settings) {
    if (given(parser, "reference").empty()) return fail(ErrorCode::InvalidArgument, "--reference is missing");
    for (const auto& [name, day] :
         {std::pair{"from", &settings.approval.from}, std::pair{"expires", &settings.approval.expires}}) {
        if (!parser.isSet(name)) continue;
        const auto date = dateGiven(parser, name);
        if (!date) return failure(date);
        *day = *date;
    }
    if (parser.isSet("consent-version")) settings.consentVersion = given(parser, "consent-version");
    return asSetHere(parser, std::move(settings));
}

Result<Participant> participantGiven(const QCommandLineParser& parser) {
    Participant participant;
    if (parser.isSet("group")) {
        const auto word = given(parser, "group");
        const auto group = valueFor(kParticipantGroups, word);
        if (!group) {
            return fail(ErrorCode::InvalidArgument, "--group is \"{}\"; {} or {} is expected", word,
                        kParticipantGroups[0].text, kParticipantGroups[1].text);
        }
        participant.group = *group;
    }
    participant.age = given(parser, "age");
    participant.sex = given(parser, "sex");
    participant.handedness = given(parser, "handedness");
    return participant;
}

Result<NextDay> nextDayGiven(const QCommandLineParser& parser) {
    NextDay said;
    for (const auto& [name, score] : {std::pair{"erythema", &said.erythema}, std::pair{"oedema", &said.oedema}}) {
        const auto given = scoreGiven(parser, name, 0, 4);
        if (!given) return failure(given);
        *score = *given;
    }
    for (const auto& text : parser.values("side-effect")) {
        auto effect = sideEffectFrom(text.toStdString());
        if (!effect) return failure(effect);
        said.sideEffects.push_back(std::move(*effect));
    }
    if (auto sound = checkNextDay(said); !sound) return failure(sound);
    return said;
}

Result<AdverseEvent> adverseEventGiven(const QCommandLineParser& parser) {
    AdverseEvent event;
    event.what = given(parser, "what");
    if (event.what.empty()) return fail(ErrorCode::InvalidArgument, "--what is missing");
    const auto severity = scoreGiven(parser, "severity", 1, 4);
    if (!severity) return failure(severity);
    const auto relation = scoreGiven(parser, "relation", 1, 5);
    if (!relation) return failure(relation);
    event.severity = *severity;
    event.relation = *relation;
    event.serious = parser.isSet("serious");
    event.reported = parser.isSet("reported");
    event.onset = given(parser, "onset");
    event.ended = given(parser, "ended");
    if (parser.isSet("expected")) {
        const auto word = given(parser, "expected");
        const auto expected = valueFor(kExpectedness, word);
        if (!expected) {
            return fail(ErrorCode::InvalidArgument, "--expected is \"{}\"; unknown, expected or unexpected is expected",
                        word);
        }
        event.expected = *expected;
    }
    event.action = given(parser, "action");
    event.outcome = given(parser, "outcome");
    return event;
}

namespace {

using Json = nlohmann::json;

Json sessionJson(const StudySession& session) {
    return {{"id", session.id},
            {"code", session.code.empty() ? Json() : Json(session.code)},
            {"number", session.number},
            {"protocol", session.protocol},
            {"basis", nameOf(session.basis)},
            {"state", nameOf(session.state)},
            {"answered", session.answered}};
}

Json consentJson(const Participant& participant) {
    if (participant.consents.empty()) return nullptr;
    return participant.consents.back().version;
}

Json procedureJson(const StudySettings& settings) {
    if (!settings.procedure) return nullptr;
    const auto& procedure = *settings.procedure;
    return {{"interval_min_s", procedure.intervalMin_s},
            {"interval_max_s", procedure.intervalMax_s},
            {"method", nameOf(procedure.method)},
            {"conditions_sha256", procedure.conditionsSha256},
            {"comparison", procedure.comparison}};
}

std::string dayOf(std::chrono::sys_seconds at) {
    return dateText(std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(at)));
}

}  // namespace

Json participantJson(const Participant& participant) {
    return {{"code", participant.readable ? Json(participant.code) : Json()},
            {"virtual", participant.virtualSeed ? Json(*participant.virtualSeed) : Json()},
            {"state", wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state)},
            {"consent", consentJson(participant)},
            {"sessions", participant.sessions}};
}

Result<StudyNote> noteGiven(const QCommandLineParser& parser, const std::string& kind) {
    StudyNote note{kind, {}, {}};
    const auto take = [&](const std::string& key, const std::string& value) -> Result<void> {
        note.said[key] = value;
        return {};
    };
    if (auto taken = forEachSet(parser, take); !taken) return failure(taken);
    if (auto sound = checkNote(note); !sound) return failure(sound);
    return note;
}

Json noteJson(const StudyNote& note) { return {{"kind", note.kind}, {"date", dayOf(note.at)}, {"said", note.said}}; }

Json amendmentJson(const StudyAmendment& amendment) {
    return {{"reference", amendment.reference}, {"date", dayOf(amendment.at)}, {"changed", amendment.changed}};
}

std::string changesText(const StudyAmendment& amendment, Modality modality) {
    std::vector<std::string> words;
    for (const auto& key : amendment.changed) words.push_back(amendedWords(key, modality));
    return words.empty() ? "no setting" : fmt::format("{}", fmt::join(words, ", "));
}

Json studyJson(const Study& study) {
    const auto& settings = study.settings();
    const auto& approval = settings.approval;
    auto participants = Json::array();
    int withdrawn = 0;
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn)
            ++withdrawn;
        else
            participants.push_back(participantJson(participant));
    }
    auto sessions = Json::array();
    for (const auto& session : study.sessions()) sessions.push_back(sessionJson(session));
    auto notes = Json::array();
    for (const auto& each : study.notes()) notes.push_back(noteJson(each));
    auto amendments = Json::array();
    for (const auto& amendment : study.amendments()) amendments.push_back(amendmentJson(amendment));
    auto wentBack = Json::array();
    for (const auto& back : study.goingsBack()) {
        wentBack.push_back({{"date", dayOf(back.at)},
                            {"lost", back.lost},
                            {"rows", back.rows},
                            {"files", back.files},
                            {"unsealed", back.unsealed}});
    }
    return {{"title", settings.title},
            {"rehearsal", study.isRehearsal()},
            {"modality", nameOf(settings.modality)},
            {"approval",
             {{"reference", approval.reference},
              {"from", dateText(approval.from)},
              {"expires", dateText(approval.expires)},
              {"valid", approvalGate(settings, study.today()).has_value()}}},
            {"procedure", procedureJson(settings)},
            {"amendments", std::move(amendments)},
            {"went_back", std::move(wentBack)},
            {"consent_version", settings.consentVersion},
            {"participants", std::move(participants)},
            {"withdrawn", withdrawn},
            {"sessions", std::move(sessions)},
            {"adverse_events", study.adverseEventCount()},
            {"notes", std::move(notes)},
            {"ledger_head", study.ledgerHead()}};
}

void sayStudy(const Study& study) {
    const auto& settings = study.settings();
    say("{}{}\n  modality {}\n", settings.title, study.isRehearsal() ? " (rehearsal)" : "", nameOf(settings.modality));
    say("  approval {}, {} to {}{}\n  consent form {}\n", settings.approval.reference, dateText(settings.approval.from),
        dateText(settings.approval.expires), approvalGate(settings, study.today()) ? "" : ": not valid today",
        settings.consentVersion);
    for (const auto& fact : approvedProcedure(settings)) say("    {}: {}\n", fact.what, fact.words);
    for (const auto& amendment : study.amendments())
        say("  amendment {} of {}: changed {}\n", amendment.reference, dayOf(amendment.at),
            changesText(amendment, settings.modality));
    for (const auto& back : study.goingsBack()) say("  {}\n", goingBackText(back));
    int withdrawn = 0;
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn) {
            ++withdrawn;
            continue;
        }
        const auto name = participant.readable ? participant.code : std::string("(sealed)");
        const auto consented = participant.consents.empty() ? std::string(participant.readable ? "none" : "sealed")
                                                            : participant.consents.back().version;
        say("  {}{}: {}, consent {}, sessions {}\n", name,
            participant.virtualSeed ? fmt::format(" (virtual:{})", *participant.virtualSeed) : "",
            wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state), consented,
            participant.sessions);
    }
    if (withdrawn > 0) say("  withdrawn: {}\n", withdrawn);
    for (const auto& session : study.sessions()) {
        say("  session {} of {}: {}, {}, answered {}\n", session.number,
            namedWith(session.basis, session.code.empty() ? "(sealed)" : session.code), session.protocol,
            nameOf(session.state), session.answered);
    }
    if (const auto events = study.adverseEventCount(); events > 0) say("  adverse events: {}\n", events);
    for (const auto& kind : studyLogKinds()) {
        if (const auto n = std::ranges::count(study.notes(), kind.key, &StudyNote::kind); n > 0 && !kind.lastCounts)
            say("  {}: {}\n", kind.heading, n);
    }
    if (study.hasKey()) {
        const auto known = particularsOf(study.notes());
        std::size_t unknown = 0;
        for (const auto& field : (*studyLogKind(kParticulars))->fields) {
            const auto text = known.text(field.key);
            unknown += text == kNoWord;
            if (text != kNoWord) say("  {}: {}\n", field.label, text);
        }
        if (unknown > 0) say("  {} particulars of the study are unknown; study note tells them\n", unknown);
        say("  key file {}\n", study.keyFile().string());
    }
    say("  ledger head {}\n", study.ledgerHead());
    // A ledger that is outdated, or has rows of another study, can still be read; this says so.
    if (const auto may = study.stillApproved(); !may && !study.isRehearsal())
        say(stderr, "No session can begin today: {}.\n", may.error().message);
    if (!study.hasKey()) say(stderr, "Codes, consents and who took part are sealed; --passphrase-file shows them.\n");
}

}  // namespace tacto::cli
