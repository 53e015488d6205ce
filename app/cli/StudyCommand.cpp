// study: creates and shows studies with people or virtual participants; records enrolment, consent and withdrawal.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/StudyOptions.h"
#include "app/cli/StudyPassphrase.h"
#include "app/cli/Verdicts.h"
#include "app/run/PilotRows.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/base/LocaleFreeText.h"
#include "core/pilot/PilotRecord.h"
#include "core/pilot/StudyWords.h"
#include "core/sharing/results/StudyFigures.h"
#include "core/study/Study.h"

namespace tacto::cli {

namespace {

using Json = nlohmann::json;

/// Errors: InvalidArgument for a text that is not a seed.
Result<std::uint64_t> seedGiven(const QCommandLineParser& parser) {
    bool isNumber = false;
    const auto seed = parser.value("virtual").toULongLong(&isNumber);
    if (isNumber) return seed;
    return fail(ErrorCode::InvalidArgument, "--virtual is \"{}\"; a whole number from 0 is expected",
                parser.value("virtual").toStdString());
}

int show(const Study& study, const QCommandLineParser& parser) {
    if (parser.isSet("json"))
        printJson(studyJson(study));
    else
        sayStudy(study);
    return kDone;
}

int create(const QCommandLineParser& parser, const std::string& folder) {
    auto settings = settingsGiven(parser);
    if (!settings) return usage(fmt::format("study create: {}", settings.error().message));
    const auto passphrase = passphraseFor(parser, folder);
    if (!passphrase) return couldNotRun(passphrase.error());
    const auto study = Study::create(folder, std::move(*settings), *passphrase);
    if (!study) return failWith(study.error());
    say(stderr,
        "The keys are in {}. Without the passphrase or without this file the data are lost. The investigator and the "
        "person responsible for the data should each keep a copy of the file on another medium, apart from the "
        "passphrase. Write the passphrase on paper, seal it and lock it away.\n",
        study->keyFile().string());
    if (const auto valid = approvalGate(study->settings(), study->today()); !valid)
        say(stderr, "No session can begin today: {}.\n", valid.error().message);
    if (parser.isSet("json")) printJson(studyJson(*study));
    return kDone;
}

int amend(Study& study, const QCommandLineParser& parser, const QStringList&) {
    auto settings = settingsAmended(parser, study.settings());
    if (!settings) return usage(fmt::format("study amend: {}", settings.error().message));
    if (const auto done = study.amend(std::move(*settings), given(parser, "reference")); !done)
        return failWith(done.error());
    if (const auto valid = approvalGate(study.settings(), study.today()); !valid)
        say(stderr, "No session can begin today: {}.\n", valid.error().message);
    const auto& made = study.amendments().back();
    if (parser.isSet("json"))
        printJson(amendmentJson(made));
    else
        say("{}: changed {}\n", made.reference, changesText(made, study.settings().modality));
    return kDone;
}

int adverseEvent(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto event = adverseEventGiven(parser);
    if (!event) return usage(fmt::format("study adverse-event: {}", event.error().message));
    const auto session = words.value(2).toStdString();
    if (const auto noted = study.adverseEvent(session, *event); !noted) return failWith(noted.error());
    if (parser.isSet("json"))
        printJson({{"session", session}, {"adverse_events", study.adverseEventCount()}});
    else
        say("noted; adverse events: {}\n", study.adverseEventCount());
    return kDone;
}

int nextDay(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto said = nextDayGiven(parser);
    if (!said) return usage(fmt::format("study next-day: {}", said.error().message));
    const auto session = words.at(2).toStdString();
    if (const auto noted = study.nextDay(session, *said); !noted) return failWith(noted.error());
    if (parser.isSet("json")) {
        auto all = toJson(*said);
        all["session"] = session;
        all["adverse_events"] = study.adverseEventCount();
        printJson(all);
    } else {
        say("noted; adverse events: {}\n", study.adverseEventCount());
    }
    return kDone;
}

int enrol(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    auto asked = participantGiven(parser);
    if (!asked) return usage(fmt::format("study enrol: {}", asked.error().message));
    auto& participant = *asked;
    if (words.size() > 2) participant.code = words.at(2).toStdString();
    if (parser.isSet("virtual")) {
        const auto seed = seedGiven(parser);
        if (!seed) return usage(fmt::format("study enrol: {}", seed.error().message));
        participant.virtualSeed = *seed;
    }
    const auto enrolled = study.enrol(std::move(participant));
    if (!enrolled) return failWith(enrolled.error());
    if (parser.isSet("json"))
        printJson(participantJson(*enrolled));
    else
        say("{}\n", enrolled->code);
    return kDone;
}

/// Prints the result of a change to one participant.
int changed(const Result<void>& done, const Study& study, const std::string& code, const QCommandLineParser& parser) {
    if (!done) return failWith(done.error());
    if (!parser.isSet("json")) return kDone;
    const auto participant = study.find(code);
    printJson(participant ? participantJson(*participant) : Json{{"withdrawn", true}});
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
    return changed(study.leave(code, given(parser, "reason")), study, code, parser);
}

int note(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto given = noteGiven(parser, words.at(2).toStdString());
    if (!given) return usage(fmt::format("study note: {}", given.error().message));
    if (const auto noted = study.note(*given); !noted) return failWith(noted.error());
    if (parser.isSet("json"))
        printJson(noteJson(study.notes().back()));
    else
        say("noted; notes of this kind: {}\n", std::ranges::count(study.notes(), given->kind, &StudyNote::kind));
    return kDone;
}

int release(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto event = parseWhole<std::size_t>(words.at(2).toStdString());
    if (!event) {
        return usage(fmt::format("study release: EVENT is \"{}\"; the number of an adverse event is expected",
                                 words.at(2).toStdString()));
    }
    if (const auto done = study.release(*event, given(parser, "by"), given(parser, "reason")); !done)
        return failWith(done.error());
    if (parser.isSet("json"))
        printJson({{"event", *event}, {"by", given(parser, "by")}});
    else
        say("released\n");
    return kDone;
}

int passphrase(Study& study, const QCommandLineParser& parser, const QStringList&) {
    const auto next = newPassphraseFor(parser, study.folder());
    if (!next) return couldNotRun(next.error());
    if (const auto done = study.changePassphrase(*next); !done) return failWith(done.error());
    say(stderr, "Copies of {} still open with the passphrase of their time: replace them.\n", study.keyFile().string());
    if (parser.isSet("json")) printJson({{"key_file", study.keyFile().string()}});
    return kDone;
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
            "the data for anyone with the passphrase.\n");
        const auto exports = study.exports();
        say(stderr, "{}\n",
            exports.empty() ? "Nothing was exported from this study."
                            : "Exported files stay where they were saved. Delete them by hand:");
        for (const auto& each : exports) say(stderr, "  {}\n", each.place);
    }
    return changed(done, study, code, parser);
}

/// Step one of two: says what is lost, and which word confirms.
int goBack(Study& study, const QCommandLineParser& parser, const QStringList&) {
    const auto loss = study.lossOfGoingBack();
    if (!loss) return failWith(loss.error());
    if (!parser.isSet("confirm")) {
        return usage(fmt::format("study go-back: {}. Nothing was changed; --confirm {} goes on with this ledger",
                                 loss->sentence(), loss->word()));
    }
    if (const auto done = study.goBack(given(parser, "confirm")); !done) return failWith(done.error());
    const auto& back = study.goingsBack().back();
    if (parser.isSet("json"))
        printJson({{"lost", back.lost}, {"rows", back.rows}, {"files", back.files}, {"unsealed", back.unsealed}});
    else
        say("{}\n", goingBackText(back));
    return kDone;
}

/// Errors: NotFound for a number without a session.
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

/// Prints the plan of a session, its answers, and trials that began but were not answered.
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
                   {"encoding", session->encoding},
                   {"plan", found.plan},
                   {"trials", std::move(answered)},
                   {"open", std::move(open)}});
        return kDone;
    }
    say("Session {} of {}, encoding {}: {} of {} trials answered\n", session->number, participant->code,
        session->encoding, found.trials.size(), found.plan.size());
    for (const auto& trial : found.trials)
        say("  {:3} {:15} block {} {:12} {}\n", trial.number, nameOf(trial.phase), trial.block, trial.condition,
            trial.response);
    return kDone;
}

/// Prints what participants read, as a committee gets it: a language's words, or else which languages there are.
int readWords(Study& study, const QCommandLineParser& parser, const QStringList& words) {
    const auto& approved = study.settings().words;
    const auto describe = [&](const ParticipantWords& one) {
        const bool stated = std::ranges::count(approved, one.sha256(), &WordsHash::sha256) > 0;
        return Json{{"language", one.code()},
                    {"name", one.language()},
                    {"version", one.version()},
                    {"sha256", one.sha256()},
                    {"approved", stated}};
    };
    if (words.size() < 3) {
        const auto all = languagesOf(study.folder());
        if (!all) return couldNotRun(all.error());
        auto listed = Json::array();
        for (const auto& one : *all) listed.push_back(describe(one));
        if (parser.isSet("json")) {
            printJson({{"words", std::move(listed)}});
            return kDone;
        }
        for (std::size_t i = 0; i < all->size(); ++i)
            say("{}  {}{}\n", (*all)[i].code(), (*all)[i].name(), listed[i]["approved"] == true ? ", approved" : "");
        return kDone;
    }
    const auto one = languageOf(study.folder(), words.at(2).toStdString());
    if (!one) return couldNotRun(one.error());
    auto said = describe(*one);
    said["words"] = Json::array();
    for (const auto& [key, text] : one->all()) said["words"].push_back({{"key", key}, {"text", text}});
    if (parser.isSet("json")) {
        printJson(said);
        return kDone;
    }
    say("{}{}\n\n", one->name(), said["approved"] == true ? ", approved" : "");
    for (const auto& [key, text] : one->all()) say("{:32} {}\n", key, text);
    return kDone;
}

/// Prints each session with its encoding, and which encoding is better; each kind of participants for itself.
int results(Study& study, const QCommandLineParser& parser, const QStringList&) {
    auto record = readStudyRecord(study);
    if (!record) return couldNotRun(record.error());
    leaveOutUnfinished(*record);
    auto all = Json::array();
    for (const auto& [basis, part] : byBasis(*record)) {
        const auto found = studyFigures(basis, part);
        if (!found) return couldNotRun(found.error());
        auto one = toJson(*found);
        one["basis"] = nameOf(basis);
        if (!parser.isSet("json")) {
            say("{}\n", peopleOf(basis));
            printTables("study-results", one);
        }
        all.push_back(std::move(one));
    }
    if (parser.isSet("json")) printJson({{"parts", std::move(all)}});
    return kDone;
}

struct StudyWord {
    const char* name;
    int least, most;    ///< number of words, including the command's own
    const char* names;  ///< the words that may follow the command's word
    QStringList options;
    bool changes;
    int (*run)(Study& study, const QCommandLineParser& parser, const QStringList& words);
};

const std::vector<StudyWord>& studyWords() {
    static const std::vector<StudyWord> all{
        {"create",
         2,
         2,
         "STUDY",
         {"title", "approval", "from", "expires", "consent-version", "set", "profile", "passphrase-file", "json"},
         true,
         nullptr},
        {"amend",
         2,
         2,
         "STUDY",
         {"reference", "from", "expires", "consent-version", "set", "profile", "passphrase-file", "json"},
         true,
         amend},
        {"enrol",
         2,
         3,
         "STUDY and CODE",
         {"virtual", "group", "age", "sex", "handedness", "passphrase-file", "json"},
         true,
         enrol},
        {"consent", 3, 3, "STUDY and CODE", {"version", "date", "by", "passphrase-file", "json"}, true, consent},
        {"show",
         2,
         2,
         "STUDY",
         {"passphrase-file", "json"},
         false,
         [](Study& study, const QCommandLineParser& parser, const QStringList&) { return show(study, parser); }},
        {"results", 2, 2, "STUDY", {"passphrase-file", "json"}, false, results},
        {"trials", 3, 3, "STUDY and CODE", {"session", "passphrase-file", "json"}, false, trials},
        {"words", 2, 3, "STUDY and LANGUAGE", {"passphrase-file", "json"}, false, readWords},
        {"leave", 3, 3, "STUDY and CODE", {"reason", "passphrase-file", "json"}, true, leave},
        {"note", 3, 3, "STUDY and KIND", {"set", "passphrase-file", "json"}, true, note},
        {"release", 3, 3, "STUDY and EVENT", {"by", "reason", "passphrase-file", "json"}, true, release},
        {"passphrase", 2, 2, "STUDY", {"passphrase-file", "new-passphrase-file", "json"}, true, passphrase},
        {"go-back", 2, 2, "STUDY", {"confirm", "passphrase-file", "json"}, true, goBack},
        {"withdraw", 3, 3, "STUDY and CODE", {"confirm", "passphrase-file", "json"}, true, withdraw},
        {"adverse-event",
         2,
         3,
         "STUDY and SESSION",
         {"what", "severity", "relation", "serious", "expected", "onset", "ended", "action", "outcome", "reported",
          "passphrase-file", "json"},
         true,
         adverseEvent},
        {"next-day",
         3,
         3,
         "STUDY and SESSION",
         {"erythema", "oedema", "side-effect", "passphrase-file", "json"},
         true,
         nextDay}};
    return all;
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
                                 word->names));
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
    "{create STUDY --title T --approval REF --from DATE --expires DATE --consent-version V [--set KEY=VALUE]... "
    "[--profile FILE] | amend STUDY --reference REF [--from DATE] [--expires DATE] [--consent-version V] "
    "[--set KEY=VALUE]... [--profile FILE] | "
    "enrol STUDY [CODE] [--virtual SEED] [--group GROUP] [--age YEARS] [--sex SEX] [--handedness HAND] | "
    "consent STUDY CODE --version V --date DATE --by INITIALS | show STUDY | "
    "results STUDY | trials STUDY CODE [--session N] | words STUDY [LANGUAGE] | leave STUDY CODE [--reason T] | "
    "withdraw STUDY CODE --confirm CODE | "
    "go-back STUDY [--confirm WORD] | "
    "adverse-event STUDY [SESSION] --what TEXT --severity 1..4 --relation 1..5 [--serious] [--expected WORD] "
    "[--onset DATE] [--ended DATE] [--action T] [--outcome T] [--reported] | release STUDY EVENT --by NAME [--reason "
    "T] "
    "| note STUDY KIND --set KEY=VALUE... | passphrase STUDY [--new-passphrase-file F] | next-day STUDY SESSION "
    "--erythema 0..4 --oedema 0..4 [--side-effect ITEM:SEVERITY:RELATION]...} "
    "[--passphrase-file F] [--json]",
    "Studies with people or virtual participants: approval, consent, sealed records", declareStudyOptions, runStudy};

}  // namespace tacto::cli
