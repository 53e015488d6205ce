// study: studies with people or virtual participants - made, enrolled in, consented to, shown, left, withdrawn from.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/StudyPassphrase.h"
#include "app/run/PilotRows.h"
#include "app/run/StudyProgram.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/pilot/PilotRecord.h"
#include "core/study/Study.h"

namespace tacto::cli {

namespace {

using Json = nlohmann::json;

std::string given(const QCommandLineParser& parser, const char* name) {
    return parser.value(name).trimmed().toStdString();
}

/// Errors: InvalidArgument naming the option and what is accepted.
Result<CalibrationDate> dateGiven(const QCommandLineParser& parser, const char* name) {
    const auto text = given(parser, name);
    if (const auto date = parseDate(text)) return *date;
    return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a day as 2026-11-21 is expected", name, text);
}

/// Errors: InvalidArgument for a text that is no seed.
Result<std::uint64_t> seedGiven(const QCommandLineParser& parser) {
    bool isNumber = false;
    const auto seed = parser.value("virtual").toULongLong(&isNumber);
    if (isNumber) return seed;
    return fail(ErrorCode::InvalidArgument, "--virtual is \"{}\"; a whole number from 0 is expected",
                parser.value("virtual").toStdString());
}

Json consentJson(const Participant& participant) {
    if (participant.consents.empty()) return nullptr;
    return participant.consents.back().version;
}

Json toJson(const Participant& participant) {
    return {{"code", participant.readable ? Json(participant.code) : Json()},
            {"virtual", participant.virtualSeed ? Json(*participant.virtualSeed) : Json()},
            {"state", wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state)},
            {"consent", consentJson(participant)},
            {"sessions", participant.sessions}};
}

Json toJson(const StudySession& session) {
    return {{"id", session.id},
            {"code", session.code.empty() ? Json() : Json(session.code)},
            {"number", session.number},
            {"protocol", session.protocol},
            {"state", wordFor(tacto::Words<StudySessionState>(kStudySessionStates), session.state)},
            {"answered", session.answered}};
}

Json toJson(const Study& study) {
    const auto& settings = study.settings();
    const auto& approval = settings.approval;
    auto participants = Json::array();
    int withdrawn = 0;
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn)
            ++withdrawn;
        else
            participants.push_back(toJson(participant));
    }
    auto sessions = Json::array();
    for (const auto& session : study.sessions()) sessions.push_back(toJson(session));
    return {{"title", settings.title},
            {"rehearsal", study.isRehearsal()},
            {"approval",
             {{"reference", approval.reference},
              {"from", dateText(approval.from)},
              {"expires", dateText(approval.expires)},
              {"valid", approvalGate(settings, study.today()).has_value()}}},
            {"consent_version", settings.consentVersion},
            {"participants", std::move(participants)},
            {"withdrawn", withdrawn},
            {"sessions", std::move(sessions)},
            {"ledger_head", study.ledgerHead()}};
}

int show(const Study& study, const QCommandLineParser& parser) {
    const auto all = toJson(study);
    if (parser.isSet("json")) {
        printJson(all);
        return kDone;
    }
    const auto& settings = study.settings();
    say("{}{}\n", settings.title, study.isRehearsal() ? " (rehearsal)" : "");
    say("  approval {}, {} to {}{}\n  consent form {}\n", settings.approval.reference, dateText(settings.approval.from),
        dateText(settings.approval.expires), all["approval"]["valid"] == true ? "" : ": not valid today",
        settings.consentVersion);
    for (const auto& participant : study.participants()) {
        if (participant.state == ParticipantState::Withdrawn) continue;
        const auto name = participant.readable ? participant.code : std::string("(sealed)");
        const auto consented = participant.consents.empty() ? std::string(participant.readable ? "none" : "sealed")
                                                            : participant.consents.back().version;
        say("  {}{}: {}, consent {}, sessions {}\n", name,
            participant.virtualSeed ? fmt::format(" (virtual:{})", *participant.virtualSeed) : "",
            wordFor(tacto::Words<ParticipantState>(kParticipantStates), participant.state), consented,
            participant.sessions);
    }
    if (all["withdrawn"] != 0) say("  withdrawn: {}\n", all["withdrawn"].get<int>());
    for (const auto& session : study.sessions()) {
        say("  session {} of {}: {}, {}, answered {}\n", session.number,
            session.code.empty() ? std::string("(sealed)") : session.code, session.protocol,
            wordFor(tacto::Words<StudySessionState>(kStudySessionStates), session.state), session.answered);
    }
    say("  ledger head {}\n", study.ledgerHead());
    if (!study.hasKey()) say(stderr, "Codes, consents and who took part are sealed; --passphrase-file shows them.\n");
    return kDone;
}

/// Errors: InvalidArgument naming the option.
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
    for (const auto& set : parser.values("set")) {
        const auto text = set.toStdString();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            return fail(ErrorCode::InvalidArgument, "--set {}: KEY=VALUE is expected", text);
        if (auto done = setStudyField(settings, text.substr(0, equals), text.substr(equals + 1)); !done)
            return failure(done);
    }
    if (auto stated = stateProgram(settings); !stated) return failure(stated);
    return settings;
}

int create(const QCommandLineParser& parser, const std::string& folder) {
    auto settings = settingsGiven(parser);
    if (!settings) return usage(fmt::format("study create: {}", settings.error().message));
    const auto passphrase = passphraseFor(parser, folder);
    if (!passphrase) return couldNotRun(passphrase.error());
    const auto study = Study::create(folder, std::move(*settings), *passphrase);
    if (!study) return failWith(study.error());
    say(stderr,
        "The keys lie in {}. A lost passphrase or key file is lost data: copy that file to another medium, write the "
        "passphrase on paper, seal it and lock it away.\n",
        (Study::defaultKeyFolder() / (study->settings().id + ".json")).string());
    if (const auto valid = approvalGate(study->settings(), study->today()); !valid)
        say(stderr, "No session can begin today: {}.\n", valid.error().message);
    if (parser.isSet("json")) printJson(toJson(*study));
    return kDone;
}

int enrol(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    Participant participant;
    if (words.size() > 2) participant.code = words.at(2).toStdString();
    if (parser.isSet("virtual")) {
        const auto seed = seedGiven(parser);
        if (!seed) return usage(fmt::format("study enrol: {}", seed.error().message));
        participant.virtualSeed = *seed;
    }
    const auto enrolled = study.enrol(std::move(participant));
    if (!enrolled) return failWith(enrolled.error());
    if (parser.isSet("json"))
        printJson(toJson(*enrolled));
    else
        say("{}\n", enrolled->code);
    return kDone;
}

/// After a change of one participant.
int changed(const Result<void>& done, const Study& study, const std::string& code, const QCommandLineParser& parser) {
    if (!done) return failWith(done.error());
    if (!parser.isSet("json")) return kDone;
    const auto participant = study.find(code);
    printJson(participant ? toJson(*participant) : Json{{"withdrawn", true}});
    return kDone;
}

int consent(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto code = words.at(2).toStdString();
    const auto date = dateGiven(parser, "date");
    if (!date) return usage(fmt::format("study consent: {}", date.error().message));
    return changed(study.consent(code, {given(parser, "version"), *date, given(parser, "by")}), study, code, parser);
}

int leave(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto code = words.at(2).toStdString();
    return changed(study.leave(code), study, code, parser);
}

int withdraw(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto code = words.at(2).toStdString();
    if (given(parser, "confirm") != code) {
        return usage(fmt::format(
            "study withdraw destroys the key of {} and with it every record of theirs; --confirm {} is expected", code,
            code));
    }
    const auto done = study.withdraw(code);
    if (done) {
        say(stderr,
            "The key is destroyed. Copies of the key file, backups and spare blocks of a solid-state disk still open "
            "the data for anyone with the passphrase; exports lie where they were written and are deleted by hand.\n");
    }
    return changed(done, study, code, parser);
}

/// Errors: NotFound for a number that there is no session of.
Result<StudySession> sessionOf(const Study& study, const Participant& participant, const QCommandLineParser& parser) {
    std::optional<StudySession> found;
    const auto number = given(parser, "session");
    for (const auto& session : study.sessions()) {
        if (session.participant != participant.id) continue;
        if (number.empty() || std::to_string(session.number) == number) found = session;
    }
    if (found) return *found;
    return fail(ErrorCode::NotFound, "{} has no session{}; one that was begun is expected", participant.code,
                number.empty() ? "" : " " + number);
}

/// The plan of a session, what was answered, and what was begun and not answered.
int trials(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto participant = study.find(words.at(2).toStdString());
    if (!participant) return couldNotRun(participant.error());
    const auto session = sessionOf(study, *participant, parser);
    if (!session) return couldNotRun(session.error());
    const auto rows = pilotRows(study, *session);
    if (!rows) return couldNotRun(rows.error());
    const auto found = pilotTrials(rows->events);
    auto answered = Json::array();
    for (const auto& trial : found.trials) answered.push_back(toJson(trial));
    auto open = Json::array();
    for (const auto& trial : found.open) open.push_back({{"number", trial.number}, {"attempt", trial.attempt}});
    if (parser.isSet("json")) {
        printJson({{"code", participant->code},
                   {"session", session->number},
                   {"plan", found.plan},
                   {"trials", std::move(answered)},
                   {"open", std::move(open)}});
        return kDone;
    }
    say("Session {} of {}: {} of {} trials answered\n", session->number, participant->code, found.trials.size(),
        found.plan.size());
    for (const auto& trial : found.trials)
        say("  {:3} {:15} block {} {:12} {}\n", trial.number, nameOf(trial.phase), trial.block, trial.condition,
            trial.response);
    return kDone;
}

struct StudyWord {
    const char* name;
    int least, most;  ///< words, its own included
    QStringList options;
    bool changes;
    int (*run)(Study& study, const QCommandLineParser& parser, const QStringList& words);
};

const std::vector<StudyWord>& studyWords() {
    static const std::vector<StudyWord> all{
        {"create",
         2,
         2,
         {"title", "approval", "from", "expires", "consent-version", "set", "passphrase-file", "json"},
         true,
         nullptr},
        {"enrol", 2, 3, {"virtual", "passphrase-file", "json"}, true, enrol},
        {"consent", 3, 3, {"version", "date", "by", "passphrase-file", "json"}, true, consent},
        {"show",
         2,
         2,
         {"passphrase-file", "json"},
         false,
         [](Study& study, const QCommandLineParser& parser, const QStringList&) { return show(study, parser); }},
        {"trials", 3, 3, {"session", "passphrase-file", "json"}, false, trials},
        {"leave", 3, 3, {"passphrase-file", "json"}, true, leave},
        {"withdraw", 3, 3, {"confirm", "passphrase-file", "json"}, true, withdraw}};
    return all;
}

void declareStudy(QCommandLineParser& parser) {
    parser.addOption({"title", "Title of the study.", "T"});
    parser.addOption({"approval", "Reference of the committee's approval.", "REF"});
    parser.addOption({"from", "First day of the approval, as 2026-11-21.", "DATE"});
    parser.addOption({"expires", "Its last day.", "DATE"});
    parser.addOption({"consent-version", "Version of the consent form in force.", "V"});
    parser.addOption({"set", "A setting of the study: blocks=3, electrode.area_cm2=5.", "KEY=VALUE"});
    parser.addOption({"virtual", "Enrols a virtual participant of this seed.", "SEED"});
    parser.addOption({"version", "Version of the consent form that was signed.", "V"});
    parser.addOption({"date", "Day on which it was signed.", "DATE"});
    parser.addOption({"by", "Initials of who took it.", "INITIALS"});
    parser.addOption({"confirm", "The code once more: the participant's records are lost for good.", "CODE"});
    parser.addOption({"session", "Number of the participant's session; the last where left out.", "N"});
    declarePassphrase(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

int runStudy(const QCommandLineParser& parser) {
    const auto words = parser.positionalArguments();
    std::string names;
    const StudyWord* word = nullptr;
    for (const auto& one : studyWords()) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", one.name);
        if (!words.isEmpty() && words.front() == one.name) word = &one;
    }
    if (word == nullptr) {
        return usage(words.isEmpty() ? fmt::format("study: one of {} is missing", names)
                                     : fmt::format("study: there is no \"{}\"; one of {} is expected",
                                                   words.front().toStdString(), names));
    }
    if (words.size() < word->least || words.size() > word->most) {
        return usage(fmt::format("study {}: {} words are given; {} are expected ({})", word->name, words.size() - 1,
                                 word->least == word->most ? fmt::format("{}", word->least - 1)
                                                           : fmt::format("{} or {}", word->least - 1, word->most - 1),
                                 word->most == 3 ? "STUDY and CODE" : "STUDY"));
    }
    for (const auto& option : parser.optionNames()) {
        if (!word->options.contains(option))
            return usage(fmt::format("study {} takes no --{}", word->name, option.toStdString()));
    }
    const auto folder = words.at(1).toStdString();
    if (word->run == nullptr) return create(parser, folder);
    auto study = openStudy(parser, folder, word->changes ? Study::Access::Change : Study::Access::Read);
    if (!study) return couldNotRun(study.error());
    return word->run(*study, parser, words);
}

}  // namespace

const Command kStudy{
    "study",
    "{create STUDY --title T --approval REF --from DATE --expires DATE --consent-version V [--set KEY=VALUE]... | "
    "enrol "
    "STUDY [CODE] [--virtual SEED] | consent STUDY CODE --version V --date DATE --by INITIALS | show STUDY | trials "
    "STUDY CODE [--session N] | leave STUDY CODE | withdraw STUDY CODE --confirm CODE} [--passphrase-file F] [--json]",
    "Studies with people or virtual participants: approval, consent, sealed records",
    false,
    declareStudy,
    runStudy};

}  // namespace tacto::cli
